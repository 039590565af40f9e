// What the window is drawn with: colours that are told apart, depths near and far, strips of time, letters, lines,
// buttons.
#include <cmath>

#include <doctest/doctest.h>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>
#include <imgui_internal.h>

#include "algorithms/scene/mesh.hpp"
#include "sim/classroom/lesson.hpp"
#include "sim/viewer/commands.hpp"
#include "sim/viewer/panes/pane.hpp"
#include "sim/viewer/panes/strip_marks.hpp"
#include "sim/viewer/panes/viewing_steps.hpp"
#include "sim/viewer/panes/workspace.hpp"
#include "sim/words/numbers.hpp"
#include "tests/viewer/drive.hpp"
#include "tests/viewer/tones.hpp"
#include "tests/viewer/words/some_runs.hpp"

using namespace zstep;
using namespace zstep::viewer;
using test::contrast;
using test::distance;
using test::Tone;

namespace {

Scene polygon_at(const std::vector<double>& depths) {
  Scene scene;
  scene.camera.kind = Camera::Kind::orthographic;
  scene.camera.near = 1, scene.camera.far = 5, scene.camera.window = 1;
  scene.camera.view = glm::dmat4(1);
  scene.raster = {8, 8, false};
  for (const double z : depths) {
    const auto polygon = static_cast<std::int32_t>(scene.polygons.size());
    const auto first = static_cast<std::int32_t>(scene.points.size());
    for (const glm::dvec3 p : {glm::dvec3(0, 0, z), glm::dvec3(1, 0, z), glm::dvec3(0, 1, z + 0.5)})
      scene.points.push_back(p);
    scene.polygons.push_back({"", {200, 0, 0}, 0});
    Facet facet;
    facet.polygon = polygon, facet.first_corner = static_cast<std::int32_t>(scene.corners.size()),
    facet.corner_count = 3;
    scene.facets.push_back(facet);
    for (std::int32_t k = 0; k < 3; ++k) scene.corners.push_back(first + k);
  }
  return scene;
}

DepthRange range_in(const Scene& scene, Header header = {}) {
  header.writer = "a program";
  header.algorithm = "mine";
  TraceRecorder record(header, scene);
  record.finish();
  return depth_range(Trace::from_bytes(record.take_bytes(), "made"));
}

/// What the bottom line says where the mouse is.
std::string help_at(App& app, float x, float y) {
  test::move_mouse(app, static_cast<int>(x), static_cast<int>(y));
  return app.ui().mouse_help;
}

}  // namespace

TEST_CASE("no accent can be taken for a polygon, or for another accent, and each can be read") {
  for (const Theme* theme : {&light_theme(), &dark_theme()}) {
    const Tone accents[] = {Tone(to_pixel(theme->now)), Tone(to_pixel(theme->changed)),
                            Tone(to_pixel(theme->selected))};
    for (const Tone& accent : accents) {
      for (const Color polygon : scene::palette) CHECK(distance(accent, Tone(polygon)) >= 0.13);
      for (const ImU32 back : {theme->pane, theme->window, theme->head})
        CHECK(contrast(accent, Tone(to_pixel(back))) >= 3);
      CHECK(contrast(accent, Tone(to_pixel(theme->pane))) >= 4.5);
      for (const Tone& other : accents) CHECK((&accent == &other || distance(accent, other) >= 0.18));
    }
  }
}

// A polygon may look like an accent then; that is why each accent has a second sign, and each polygon its letter.
TEST_CASE("accents are told from one another, from text and from their soft bands by colour-blind readers") {
  for (const Theme* theme : {&light_theme(), &dark_theme()})
    for (const test::Sight sight : test::every_sight) {
      CAPTURE(static_cast<int>(sight));
      const auto seen = [&](ImU32 color) { return test::as_seen(Tone(to_pixel(color)), sight); };
      const std::pair<ImU32, ImU32> accents[] = {{theme->now, theme->now_soft},
                                                 {theme->changed, theme->changed_soft},
                                                 {theme->selected, theme->selected_soft}};
      for (const auto& [accent, soft] : accents) {
        CHECK(distance(seen(accent), seen(theme->text)) >= 0.15);
        CHECK(contrast(seen(accent), seen(soft)) >= 3);
        CHECK(contrast(seen(theme->text), seen(soft)) >= 4.5);
        for (const auto& other : accents)
          CHECK((other.first == accent || distance(seen(accent), seen(other.first)) >= 0.1));
      }
    }
}

TEST_CASE("near is brighter than far for every sight, step by step") {
  const DepthScale scale;
  for (const test::Sight sight : test::every_sight)
    for (int k = 1; k <= 64; ++k) {
      const auto light = [&](int n) { return test::as_seen(Tone(scale.at(n / 64.0)), sight).luminance(); };
      CAPTURE(static_cast<int>(sight));
      CAPTURE(k);
      CHECK(light(k) < light(k - 1));
    }
}

TEST_CASE("the ink on a cell is read on every colour that a cell may have") {
  for (unsigned red = 0; red < 256; red += 15)
    for (unsigned green = 0; green < 256; green += 15)
      for (unsigned blue = 0; blue < 256; blue += 15) {
        const Pixel32 back = 0xff000000u | red << 16 | green << 8 | blue;
        CHECK(contrast(Tone(to_pixel(ink_on(back))), Tone(back)) >= 4.5);
      }
}

TEST_CASE("the colours of depths span what is in view, near bright, and know no way to a step") {
  // In the buffer −1 is near and 1 far: 2 to 2.5 of 1 to 5.
  const DepthRange one = range_in(polygon_at({2}));
  CHECK(one.near == doctest::Approx(-0.5));
  CHECK(one.far == doctest::Approx(-0.25));
  // What lies beyond far or before near is not drawn.
  for (const double unseen : {7.0, 0.2}) {
    const DepthRange both = range_in(polygon_at({2, unseen}));
    CHECK(both.near == one.near);
    CHECK(both.far == one.far);
  }
  // What reaches through a plane is cut there.
  CHECK(range_in(polygon_at({2, 4.75})).far == doctest::Approx(1));
  CHECK(range_in(polygon_at({2, 0.75})).near == doctest::Approx(-1));
  CHECK_FALSE(range_in(polygon_at({9})).known);
  CHECK(one.share(one.near) == 0);
  CHECK(one.share(one.far) == 1);
  const DepthScale scale;
  CHECK(Tone(scale.at(0)).luminance() > 0.6);
  CHECK(Tone(scale.at(1)).luminance() < 0.1);
  for (int i = 0; i < 100; ++i)
    CHECK(Tone(scale.at(i / 100.0)).luminance() >= Tone(scale.at((i + 1) / 100.0)).luminance());
}

TEST_CASE("near is bright where the greater depth is nearer, too, and no end is called near where none is declared") {
  const DepthRange usual = range_in(polygon_at({2}));
  Header header;
  header.comparison.nearer = Comparison::Nearer::greater;
  const DepthRange greater = range_in(polygon_at({2}), header);
  CHECK(greater.near == usual.far);
  CHECK(greater.far == usual.near);
  CHECK(greater.share(greater.near) == 0);
  CHECK(greater.share(greater.far) == 1);
  CHECK_FALSE(greater.flat());
  CHECK(greater.named);
  header = {};
  header.undeclared = 1u << static_cast<unsigned>(Convention::nearer);
  CHECK_FALSE(range_in(polygon_at({2}), header).named);
}

TEST_CASE("a ray's depths have colours: the range is the scene's, not that of the first depth that was seen") {
  for (Lesson& lesson : all_lessons()) {
    if (lesson.id != "ray-casting") continue;
    const Trace trace = run_lesson(lesson);
    const DepthRange range = depth_range(trace);
    CHECK(range.known);
    CHECK_FALSE(range.flat());
    Replay end(trace);
    end.go_to(trace.size());
    for (const double z : end.state().picture.depth)
      CHECK((!std::isfinite(z) || (z >= range.near - 1e-9 && z <= range.far + 1e-9)));
  }
}

TEST_CASE("a strip that begins late leads from a step to its place and back, and marks both its ends") {
  const Strip strip{{10, 5}, 600, 20, 1000, 1300};
  for (std::int64_t step = strip.first; step <= strip.last; ++step) CHECK(strip.position(strip.x(step)) == step);
  CHECK(strip.x(1000) == 10);
  CHECK(strip.x(1300) == 610);
  CHECK(strip.position(-50) == 1000);
  CHECK(strip.position(5000) == 1300);
  CHECK(strip.holds(1000));
  CHECK(strip.holds(1300));
  CHECK_FALSE(strip.holds(999));
  CHECK_FALSE(strip.holds(1301));
}

TEST_CASE("dragging on the strip of a polygon goes to its steps, and the marker stands at the last step of the whole") {
  const Trace trace = test::record_run("delhi");
  App app(trace, nullptr, {}, 1280, 720);
  Session& s = app.session();
  s.go_to(trace.polygons().back().position + 3);
  (void)test::picture(app);
  const std::int64_t first = trace.polygons().back().position;
  REQUIRE(first > 0);
  // The second strip.
  test::move_mouse(app, 640, 667);
  test::mouse_button(app, 640, 667, true);
  for (const int x : {200, 800, 1100}) {
    test::move_mouse(app, x, 667);
    const double share = (x - 6.4) / (1280 - 12.8);
    const double expected = static_cast<double>(first) + share * static_cast<double>(trace.size() - first);
    CAPTURE(x);
    CHECK(std::abs(static_cast<double>(s.position()) - expected) <= 1);
  }
  test::mouse_button(app, 1100, 667, false);
  s.go_to(trace.size());
  test::move_mouse(app, 640, 300);
  const test::Bytes shown = test::picture(app);
  int marked = 0;
  for (int y = 626; y < 650; ++y)
    for (int x = 1265; x < 1280; ++x) {
      const std::size_t i = 3 * static_cast<std::size_t>(y * 1280 + x);
      marked += (std::uint32_t{shown[i]} << 16 | std::uint32_t{shown[i + 1]} << 8 | shown[i + 2]) ==
                (to_pixel(light_theme().now) & 0xffffffu);
    }
  CHECK(marked > 20);
}

TEST_CASE("a diamond leads to its stop, the transport says what it does, and a held key can be clicked") {
  std::vector<Lesson> lessons = all_lessons();
  Lesson& lesson = lessons[3];
  const Trace trace = run_lesson(lesson);
  for (const bool presenter : {false, true}) {
    Settings settings;
    settings.presenter = presenter;
    App app(trace, &lesson, settings, 1280, 720);
    CAPTURE(presenter);
    (void)test::picture(app);
    Session& s = app.session();
    const float pad = std::round(app.ui().em * (presenter ? 0.3f : 0.4f)), top = 720 - timeline_height(app.ui()) - pad;
    for (std::size_t i = 0; i < lesson.stops.size(); ++i) {
      const Strip whole{{pad, top}, 1280 - 2 * pad, 20, 0, trace.size()};
      const float x = std::floor(whole.x(lesson.stops[i].position));
      bool alone = true;
      for (std::size_t k = 0; k < lesson.stops.size(); ++k)
        alone = alone && (k == i || std::abs(whole.x(lesson.stops[k].position) - x) > 8);
      if (!alone) continue;
      test::click(app, static_cast<int>(std::clamp(x + 2, pad, 1279 - pad)), static_cast<int>(top) + 8);
      CAPTURE(i);
      CHECK(s.stop() == static_cast<int>(i));
      CHECK(s.position() == lesson.stops[i].position);
    }
    std::string said;
    for (float x = pad + 4; x < 640; x += 8) said += help_at(app, x, 720 - pad - app.ui().em) + "\n";
    for (const char* what : {"To the beginning", "One step back", "Play or pause (Space)", "One step on", "To the end",
                             "Slower", "Faster"}) {
      CAPTURE(what);
      CHECK(said.find(what) != std::string::npos);
    }
  }
  App app(trace, &lesson, {}, 1280, 720);
  app.session().go_to(trace.size());
  (void)test::picture(app);
  for (const Command& command : commands())
    if (command.release) app.hold(command);
  CHECK(app.session().looking_back);
  test::press(app, SDLK_RIGHT);
  CHECK_FALSE(app.session().looking_back);
}

TEST_CASE(
    "presenter mode draws the framebuffer at least as large as the laboratory, and a question with all its answers") {
  const auto cell = [](App& app) {
    (void)test::picture(app);
    const Canvas& canvas = app.ui().canvases["frame"].made;
    return RasterMap(app.session().scene().raster, {}, canvas.width(), canvas.height()).cell;
  };
  for (Lesson& lesson : all_lessons()) {
    const Trace trace = run_lesson(lesson);
    Settings large;
    large.presenter = true;
    App usual(trace, &lesson, {}, 1280, 720), presented(trace, &lesson, large, 1280, 720);
    usual.turn_laboratory();
    CAPTURE(lesson.id);
    for (int stop = 0; stop < static_cast<int>(lesson.stops.size()); ++stop) {
      const bool asks = lesson.stops[static_cast<std::size_t>(stop)].question.has_value();
      if (stop > 0 && !(asks && stop % 2 == 0)) continue;
      usual.session().to_stop(stop), presented.session().to_stop(stop);
      CAPTURE(stop);
      const auto leads = lesson_pictures(trace.header(), presented.lead());
      if (std::any_of(leads.begin(), leads.end(), [](const Pane& pane) { return pane.id == frame_pane.id; }))
        CHECK(cell(presented) >= cell(usual));
      if (!asks) continue;
      (void)test::picture(presented);
      for (const ImGuiWindow* window : ImGui::GetCurrentContext()->Windows)
        if (window->Active && std::string(window->Name).find("/lesson_") != std::string::npos)
          CHECK(window->Scroll.y >= window->ScrollMax.y);
    }
  }
}

TEST_CASE(
    "a vertex's numbers are the same however narrow the pane: what does not fit is set smaller, or below each other") {
  const Trace trace = test::record_run("delhi");
  App app(trace, nullptr, {}, 1280, 720);
  (void)test::picture(app);
  const std::vector<StageRow> rows{{"world", glm::dvec3(1.25, -13.5, 100), false, "_w"},
                                   {"plane", glm::dvec3(0.5, 0.25, 0.75), false, "_p"}};
  const int wide = lay_out_stages(app.ui(), rows, 1000).decimals;
  CHECK(wide == 2);
  for (float room = 60; room < 600; room += 20) {
    const StageLayout how = lay_out_stages(app.ui(), rows, room);
    CHECK(how.decimals == wide);
    CHECK((room < 130 || how.name + static_cast<float>(how.across) * how.column <= room));
  }
  CHECK(lay_out_stages(app.ui(), rows, 1000).across == 3);
  CHECK(lay_out_stages(app.ui(), rows, 140).across == 1);
}

TEST_CASE("each polygon that is seen gets its letter far inside it, where pixels are too small for one each") {
  for (const bool y_up : {false, true}) {
    Picture picture(20, 10);
    for (std::int32_t y = 2; y < 7; ++y)
      for (std::int32_t x = 1; x < 8; ++x) picture.polygon[picture.at(x, y)] = 4;
    for (std::int32_t y = 0; y < 10; ++y)
      for (std::int32_t x = 12; x < 20; ++x) picture.polygon[picture.at(x, y)] = 7;
    Raster raster{20, 10, y_up};
    std::vector<LabelSpot> spots;
    find_label_spots(spots, RasterMap(raster, {}, 200, 100), picture);
    REQUIRE(spots.size() == 2);
    CHECK(spots[0].polygon == 7);
    CHECK(spots[0].pixels == 80);
    CHECK(spots[1].polygon == 4);
    CHECK(spots[1].pixels == 35);
    CHECK(spots[1].cell.x == 4);
    CHECK(spots[1].cell.y == 4);
    // Of what is zoomed to alone: the pixels around (2, 3).
    RasterView view;
    view.zoom = 5, view.center_x = 2.5 - 10, view.center_y = (y_up ? 9 - 3 : 3) + 0.5 - 5;
    find_label_spots(spots, RasterMap(raster, view, 200, 100), picture);
    REQUIRE(spots.size() == 1);
    CHECK(spots[0].polygon == 4);
    CHECK(std::abs(spots[0].cell.y - 3) <= 1);
  }
  const Trace trace = test::record_run("pyramid", test::of_size(40, 40));
  for (const bool presenter : {false, true}) {
    Settings settings;
    settings.presenter = presenter;
    App app(trace, nullptr, settings, 1280, 720);
    app.session().go_to(trace.size());
    (void)test::picture(app);
    CHECK(app.ui().spots["frame"].made.size() >= 2);
  }
}

TEST_CASE("lines grow with the screen") {
  const Trace trace = test::record_run("delhi");
  for (const int times : {1, 3}) {
    App app(trace, nullptr, {}, 1280 * times, 720 * times);
    const test::Bytes shown = test::picture(app);
    const int left = static_cast<int>(std::round(app.ui().em * 0.4f)), y = 360 * times;
    int line = 0;
    for (int x = left; x < left + 6; ++x) {
      const std::size_t i = 3 * static_cast<std::size_t>(y * 1280 * times + x);
      line += (std::uint32_t{shown[i]} << 16 | std::uint32_t{shown[i + 1]} << 8 | shown[i + 2]) ==
              (to_pixel(light_theme().rule) & 0xffffffu);
    }
    CHECK(line == (times == 1 ? 1 : 2));
  }
}
