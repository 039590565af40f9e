// Laws of the picture: it is a function of the place in the trace, and nothing in it is cut.
#include <doctest/doctest.h>
#include <unistd.h>

#include "tests/viewer/drive.hpp"
#include "traces/image/png.hpp"
#include "tests/viewer/words/some_runs.hpp"

using namespace zstep;
using namespace zstep::viewer;

namespace {

std::uint32_t hex(ImU32 color) { return to_pixel(color) & 0xffffffu; }

/// Letters that a clip rectangle cuts on their left or right: the text does not fit its pane. Scrolling panes may cut
/// above and below, and sideways only where they have a scroll bar for it.
int letters_cut(App& app) {
  app.settle();
  int cut = 0;
  const ImDrawData& data = *ImGui::GetDrawData();
  for (int n = 0; n < data.CmdListsCount; ++n) {
    const ImDrawList& list = *data.CmdLists[n];
    for (const ImDrawCmd& command : list.CmdBuffer) {
      if (command.GetTexID() != ImGui::GetIO().Fonts->TexID) continue;
      for (unsigned i = 0; i + 5 < command.ElemCount; i += 6) {
        const auto vertex = [&](unsigned k) -> const ImDrawVert& {
          return list.VtxBuffer[static_cast<int>(list.IdxBuffer[static_cast<int>(command.IdxOffset + i + k)] +
                                                 command.VtxOffset)];
        };
        const ImDrawVert &a = vertex(0), &b = vertex(2);
        if (a.uv.x == b.uv.x) continue;  // a filled shape
        const bool visible = b.pos.y > command.ClipRect.y && a.pos.y < command.ClipRect.w;
        if (visible && (a.pos.x < command.ClipRect.x - 1 || b.pos.x > command.ClipRect.z + 1)) ++cut;
      }
    }
  }
  return cut;
}

}  // namespace

TEST_CASE("the same place gives the same bytes, from another App too") {
  const Trace trace = test::record_run("pyramid", test::of_size(32, 32));
  for (const std::int64_t at : {std::int64_t{0}, std::int64_t{9}, trace.size() / 2, trace.size()}) {
    App one(trace, nullptr, {}, 1280, 720), other(trace, nullptr, {}, 1280, 720);
    one.session().go_to(at);
    other.session().go_to(trace.size());
    (void)test::picture(other);
    other.session().go_to(at);
    const bool same = test::picture(one) == test::picture(other);
    CAPTURE(at);
    CHECK(same);
  }
}

TEST_CASE("stepping on and back by any unit returns to the same bytes") {
  const Trace trace = test::record_run("delhi");
  App app(trace, nullptr, {}, 1280, 720);
  for (const Unit unit : {Unit::event, Unit::pixel, Unit::span, Unit::scan_line, Unit::polygon}) {
    app.session().go_to(0);
    int checked = 0;
    // Each unit's own places: from one to the next and back.
    for (app.session().move(unit, 1); app.session().position() < trace.size() && checked < 12 / test::sparse;
         app.session().move(unit, 1), ++checked) {
      const std::int64_t from = app.session().position();
      const test::Bytes before = test::picture(app);
      app.session().move(unit, 1);
      if (app.session().position() == trace.size() || app.session().position() == from) break;
      const bool moved = test::picture(app) != before;
      app.session().move(unit, -1);
      CAPTURE(from);
      CHECK(moved);
      CHECK(app.session().position() == from);
      const bool same = test::picture(app) == before;
      CHECK(same);
    }
    CHECK((checked > 0 || unit == Unit::polygon));
  }
}

TEST_CASE("the pixel at work is framed in both buffers, in the colour of now") {
  const Trace trace = test::record_run("delhi");
  App app(trace, nullptr, {}, 1280, 720);
  const auto at = trace.next(0, [](const RecordedEvent& e) { return holds<DepthCompare>(e.event); });
  REQUIRE(at);
  app.session().go_to(*at);
  const test::Bytes shown = test::picture(app);
  const std::uint32_t now = hex(light_theme().now);
  // Four sides of three pixels around cells of some 36 pixels, twice.
  CHECK(test::count_of(shown, now) > 2 * 4 * 3 * 30);
}

TEST_CASE("what a step changed is marked, and holding B shows the buffers without it") {
  const Trace trace = test::record_run("delhi");
  App app(trace, nullptr, {}, 1280, 720);
  const auto at = trace.next(0, [](const RecordedEvent& e) { return holds<PixelWrite>(e.event); });
  REQUIRE(at);
  app.session().go_to(*at);
  REQUIRE(app.session().changed().size() == 1);
  const test::Bytes after = test::picture(app);
  CHECK(test::count_of(after, hex(light_theme().changed)) > 20);
  test::press(app, SDLK_b);
  const Picture& before = app.session().picture();
  const Cell cell = app.session().changed()[0];
  CHECK(before.polygon[before.at(cell.x, cell.y)] == no_polygon);
  const bool differs = test::picture(app) != after;
  CHECK(differs);
  test::release(app, SDLK_b);
  const bool same = test::picture(app) == after;
  CHECK(same);
}

TEST_CASE("no letter is cut at the side, at any step of the lessons' scenes") {
  for (const char* name : {"delhi", "foley", "pyramid", "pyramid-behind"}) {
    const Trace trace = test::record_run(name);
    for (const bool presenter : {false, true}) {
      Settings settings;
      settings.presenter = presenter;
      App app(trace, nullptr, settings, 1280, 720);
      for (std::int64_t at = 0; at <= trace.size(); at += std::max<std::int64_t>(1, trace.size() / 23)) {
        app.session().go_to(at);
        CAPTURE(name);
        CAPTURE(at);
        CAPTURE(presenter);
        CHECK(letters_cut(app) == 0);
      }
    }
  }
}

TEST_CASE("no letter is cut beside a lesson, at any of its stops") {
  for (Lesson& lesson : all_lessons()) {
    const Trace trace = run_lesson(lesson);
    for (const int width : {1280, 1920}) {
      App app(trace, &lesson, {}, width, width * 9 / 16);
      for (int stop = 0; stop < static_cast<int>(lesson.stops.size()); stop += test::sparse) {
        app.session().to_stop(stop);
        for (int steps = width < 1500 ? 0 : 1; steps < 2; ++steps, app.session().move(Unit::event, 1)) {
          CAPTURE(lesson.id);
          CAPTURE(stop);
          CAPTURE(width);
          CHECK(letters_cut(app) == 0);
        }
      }
    }
  }
}

TEST_CASE("what is followed is seen whole, however many rows it has") {
  for (const float view : {40.0f, 160.0f, 333.0f, 900.0f})
    for (float height = 10; height < view * 0.9f; height += 13)
      for (float at = 0; at < 3 * view; at += 7) {
        const float scroll = scroll_for(at, height, view);
        CAPTURE(view);
        CAPTURE(height);
        CAPTURE(at);
        CHECK(scroll >= 0);
        CHECK(scroll <= at + 1);
        CHECK(at + height <= scroll + view);
      }
  CHECK(scroll_for(500, 300, 100) == 500);  // too long for the pane: its beginning
}

TEST_CASE(
    "the line at work lies within the pane with all its rows, also where a scroll bar came and wrapped them anew") {
  const Trace trace = test::record_run_by("warnock", "pyramid-behind");
  for (const auto& [width, height] : {std::pair{257, 370}, {200, 300}, {310, 240}}) {
    App app(trace, nullptr, {}, width, height);
    REQUIRE(app.show_only("pseudo_code"));
    for (std::int64_t at = 1; at <= trace.size(); at += 41 * test::sparse) {
      app.session().go_to(at);
      const test::Bytes shown = test::picture(app);
      const std::uint32_t soft = hex(light_theme().now_soft);
      int first = height, last = 0;
      for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
          const std::size_t i = 3 * static_cast<std::size_t>(y * width + x);
          if ((std::uint32_t{shown[i]} << 16 | std::uint32_t{shown[i + 1]} << 8 | shown[i + 2]) == soft)
            first = std::min(first, y), last = y;
        }
      CAPTURE(width);
      CAPTURE(at);
      CHECK(first < last);
      CHECK(last < height - 3);
    }
  }
}

TEST_CASE("windows of every size draw, and tiny ones say what they lack") {
  const Trace trace = test::record_run("pyramid", test::of_size(16, 16));
  for (const auto& [width, height] :
       {std::pair{1, 1}, {40, 30}, {200, 120}, {320, 240}, {640, 360}, {800, 600}, {1366, 768}, {2560, 1440}}) {
    App app(trace, nullptr, {}, width, height);
    app.session().go_to(trace.size() / 2);
    CHECK(test::picture(app).size() == static_cast<std::size_t>(width) * static_cast<std::size_t>(height) * 3);
  }
}

TEST_CASE("a foreign trace without most kinds of events opens, and its panes say what they lack") {
  Scene scene;
  scene.camera.kind = Camera::Kind::screen;
  scene.raster = {4, 4, false};
  scene.polygons.push_back({"", {200, 0, 0}, 0});
  Header header;
  header.writer = "somebody's homework";
  header.algorithm = "mine";
  header.page.push_back({1, kind_of<PixelWrite>, 0, "mine", "write", "write the pixel"});
  TraceRecorder record(header, scene);
  const Step<PixelWrite> write{1};
  for (std::int32_t x = 0; x < 3; ++x) record(write, PixelWrite{x, 1, 0});
  record.finish();
  const Trace trace = Trace::from_bytes(record.take_bytes(), "homework.jsonl");
  CHECK(structure_panes(trace.header()).size() == 1);
  App app(trace, nullptr, {}, 1280, 720);
  for (const Unit unit : {Unit::event, Unit::pixel, Unit::span, Unit::scan_line, Unit::polygon})
    for (const int direction : {1, -1}) {
      app.session().move(unit, direction);
      CHECK(letters_cut(app) == 0);
    }
  app.session().go_to(2);
  (void)test::picture(app);
  CHECK(app.session().changed().size() == 1);

  TraceRecorder nothing(Header{}, scene);
  nothing.finish();
  const Trace empty = Trace::from_bytes(nothing.take_bytes(), "empty");
  App of_nothing(empty, nullptr, {}, 1280, 720);
  CHECK(letters_cut(of_nothing) == 0);
  of_nothing.session().move(Unit::event, 1);
  CHECK(of_nothing.session().position() == 0);
}

TEST_CASE("a screenshot is written without a display, and is the picture at that step") {
  const Trace trace = test::record_run("delhi");
  const auto path = std::filesystem::temp_directory_path() / ("zstep_viewer_test_" + std::to_string(getpid()) + ".png");
  ViewerOptions options;
  options.at = 120;
  options.screenshot = path;
  CHECK(run_viewer(trace, options) == 0);
  const Image image = read_png(path);
  std::filesystem::remove(path);
  App app(trace, nullptr, {}, 1280, 720);
  app.session().go_to(120);
  CHECK(image.width == 1280);
  const bool same = image.rgb == test::picture(app);
  CHECK(same);
}
