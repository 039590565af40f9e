// The charts of depth: errors up to the step, from exact depths, and which depths the buffer can hold.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

#include "algorithms/catalog/catalog.hpp"
#include "algorithms/scene/load.hpp"
#include "sim/viewer/model/depth_errors.hpp"
#include "sim/viewer/panes/pane.hpp"
#include "sim/viewer/pictures.hpp"
#include "tests/golden/golden.hpp"
#include "tests/viewer/drive.hpp"
#include "tests/viewer/letters.hpp"
#include "tests/viewer/words/some_runs.hpp"
#include "traces/formulas/rounding.hpp"
#include "traces/oracle/exact_depth.hpp"

using namespace zstep;
using namespace zstep::viewer;

namespace {

Scene scene_of(int width, int height) {
  ViewOptions view;
  view.width = width, view.height = height;
  return look_at_scene(load_scene("pyramid-behind").scene, view);
}

Trace adding_slopes(int width = 24, int height = 20) {
  Conventions conventions;
  conventions.interpolation = Conventions::Interpolation::increments;
  conventions.number_format = NumberFormat::fixed16;
  return test::recorded_by("z-buffer", scene_of(width, height), conventions);
}

}  // namespace

TEST_CASE("law: what has added up is the errors of the span at work until the step, in its order") {
  const Trace trace = adding_slopes(40, 32);
  Session session(trace, nullptr);
  DepthErrors errors;
  const double unit = depth_unit(trace.scene(), trace.header().conventions);
  std::int64_t depths = 0, edges = 0;
  for (std::int64_t at = 1; at <= trace.size(); ++at) {
    const Event event = trace.event(at).event;
    const auto* z = get_if<DepthInterpolate>(&event);
    if (!z) continue;
    session.go_to(at);
    CAPTURE(at);
    const auto drift = drift_at(Moment(session), errors, std::nullopt);
    REQUIRE(drift);
    const SpanBegin span = *session.state().machine.span;
    CHECK(drift->y == z->y);
    REQUIRE(std::ssize(drift->span) == z->x - span.first + 1);
    CHECK(drift->span.back().step == at);
    CHECK(drift->span.back().z == z->z);
    // The exact depth between the two edges of the span, found by another way: from the state.
    const auto edge = [&](std::int32_t number) {
      const EdgeTableInsert entry = session.state().machine.edge_table[static_cast<std::size_t>(number)];
      const auto vertex = [&](std::int32_t v) {
        const VertexStages stages = session.state().vertices[static_cast<std::size_t>(v)];
        return oracle::Vertex{stages.raster.x, stages.raster.y, stages.plane.z};
      };
      return oracle::Edge{vertex(entry.vertex_0), vertex(entry.vertex_1)};
    };
    const auto exact = oracle::ExactDepth::between(edge(span.left_edge), edge(span.right_edge), z->y);
    REQUIRE(exact);
    CHECK(drift->span.back().error == doctest::Approx(exact->error_of(z->z, z->x) / unit));
    for (const oracle::DepthError& depth : drift->edge) {
      CHECK(depth.along_span == 0);
      CHECK(depth.step <= at);
    }
    CHECK(std::is_sorted(drift->edge.begin(), drift->edge.end(),
                         [](const auto& a, const auto& b) { return a.along_edge < b.along_edge; }));
    ++depths, edges += drift->edge.size() > 5;
  }
  CHECK(depths > 200);
  CHECK(edges > 50);
  session.go_to(0);
  CHECK_FALSE(drift_at(Moment(session), errors, std::nullopt));
}

TEST_CASE("of a pixel that is chosen the errors are those of the last span that reached it") {
  const Trace trace = adding_slopes();
  Session session(trace, nullptr);
  DepthErrors errors;
  session.go_to(trace.size());
  const oracle::DepthError last = errors.of(trace).back();
  const auto drift = drift_at(Moment(session), errors, Cell{last.x, last.y});
  REQUIRE(drift);
  CHECK(drift->chosen);
  CHECK(drift->span.back().step == last.step);
  CHECK_FALSE(drift_at(Moment(session), errors, Cell{0, 0}));
}

TEST_CASE("a buffer of n bits has 2^n depths between its planes, in fixed point half before twice the near distance") {
  Scene scene = scene_of(24, 20);
  scene.camera.near = 1, scene.camera.far = 1e6;
  Conventions conventions;
  conventions.number_format = NumberFormat::fixed16;
  CHECK(1 + formulas::depths_between(scene, conventions, 1, 1e6) == doctest::Approx(65536).epsilon(1e-9));
  CHECK(formulas::middle_depth(scene, conventions) == doctest::Approx(2).epsilon(1e-5));
  // Of float32 they are counted one by one.
  conventions.number_format = NumberFormat::float32;
  conventions.depth = Conventions::Depth::view;
  float z = 5;
  for (int i = 0; i < 1000; ++i) z = std::nextafter(z, 9.0f);
  CHECK(formulas::depths_between(scene, conventions, 5, static_cast<double>(z)) == 1000);
}

TEST_CASE("law: the window with the charts is the same, walked to or jumped to, and each pane as the picture of it") {
  const Trace trace = adding_slopes();
  for (const char* name : {"depth_error", "depth_units"}) {
    CAPTURE(name);
    App walked(trace, nullptr, {}, 1280, 720);
    test::press(walked, SDLK_i, KMOD_LSHIFT);
    REQUIRE(walked.lead() == depth_error_pane.id);
    PictureOptions options;
    options.pane = name;
    options.width = 700, options.height = 300;
    const std::int64_t from = trace.size() / 2;
    walked.session().go_to(from);
    test::Bytes before;
    for (int i = 0; i < 19; ++i) {
      test::press(walked, SDLK_RIGHT);
      walked.frame();
      if (i % 6 != 0) continue;
      const std::int64_t at = walked.session().position();
      CAPTURE(at);
      App jumped(trace, nullptr, {}, 1280, 720);
      jumped.set_lead(depth_error_pane.id);
      jumped.session().go_to(at);
      const bool same = test::picture(walked) == test::picture(jumped);
      CHECK(same);
      App pane(trace, nullptr, {}, 700, 300);
      REQUIRE(pane.show_only(name));
      pane.session().go_to(trace.size());
      (void)test::picture(pane);
      pane.session().go_to(at);
      const test::Bytes shown = test::picture(pane);
      const bool pane_same = shown == Pictures(trace, options).at(at).rgb;
      CHECK(pane_same);
      const bool moves = shown != before;
      CHECK(moves);
      before = shown;
    }
  }
}

TEST_CASE("slice and charts take each other's place, and a method without spans has no charts of errors, and says so") {
  const Trace trace = adding_slopes();
  App app(trace, nullptr, {}, 1280, 720);
  test::press(app, SDLK_s, KMOD_LSHIFT);
  test::press(app, SDLK_i, KMOD_LSHIFT);
  CHECK(app.lead() == depth_error_pane.id);
  test::press(app, SDLK_s, KMOD_LSHIFT);
  CHECK(app.lead() == slice_pane.id);
  const Trace rays = test::recorded_by("ray-casting", scene_of(8, 8), {});
  App other(rays, nullptr, {}, 1280, 720);
  test::press(other, SDLK_i, KMOD_LSHIFT);
  CHECK(other.lead().empty());
  CHECK(other.session().message.find("no errors add up") != std::string::npos);
  CHECK_FALSE(other.show_only("depth_error"));
}

TEST_CASE("between two spans the errors of the last one stay") {
  const Trace trace = adding_slopes();
  Session session(trace, nullptr);
  DepthErrors errors;
  std::int64_t between = 0;
  for (std::int64_t at = 1; at < trace.size(); ++at)
    if (holds<ScanLineBegin>(trace.event(at).event) && at > errors.of(trace).front().step) between = at;
  REQUIRE(between > 0);
  session.go_to(between);
  const auto drift = drift_at(Moment(session), errors, std::nullopt);
  REQUIRE(drift);
  CHECK(drift->past);
  CHECK(drift->span.back().step < between);
}

TEST_CASE("a chart that has nothing to show leaves the stage to the other, but for its title") {
  const auto title_at = [](App& app, const std::string& title) {
    app.settle();
    const test::Letters drawn = test::letters_of(app.ui().fonts);
    for (const test::Letter& letter : drawn.all)
      if (drawn.words[letter.word] == title) return letter.first;
    return ImVec2{-1, -1};
  };
  const auto below_each_other = [&](App& app) {
    const ImVec2 error = title_at(app, "ERROR ALONG SPAN AND EDGE"), units = title_at(app, "DEPTHS OF THE BUFFER");
    REQUIRE((error.x > 0 && units.x > 0));
    return std::abs(error.x - units.x) < 2 && std::abs(error.y - units.y) > 200;
  };
  const Trace pyramid = test::record_run("pyramid");
  for (const bool presenter : {false, true}) {
    Settings settings;
    settings.presenter = presenter;
    App app(pyramid, nullptr, settings, 1280, 720);
    app.set_lead("depth_error");
    CHECK(below_each_other(app));
    app.session().go_to(500);
    CHECK_FALSE(below_each_other(app));
    const Trace on_screen = test::record_run("delhi");  // no near plane, no far one
    App other(on_screen, nullptr, settings, 1280, 720);
    other.set_lead("depth_error");
    other.session().go_to(on_screen.size() / 2);
    CHECK(below_each_other(other));
  }
}
