// Laws of cameras that are given by a view and a projection matrix.
#include <doctest/doctest.h>

#include <array>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "algorithms/catalog/catalog.hpp"
#include "algorithms/scene/load.hpp"
#include "tests/golden/golden.hpp"
#include "tests/matrices.hpp"
#include "tests/zoo/runs.hpp"
#include "traces/check/check.hpp"
#include "traces/error.hpp"
#include "traces/file/jsonl.hpp"
#include "traces/file/written.hpp"
#include "traces/formulas/walk.hpp"
#include "traces/oracle/errors.hpp"

using namespace zstep;
using namespace zstep::test;

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

struct Frustum {
  double l, r, b, t, n, f;
  glm::dmat4 matrix() const { return frustum(l, r, b, t, n, f); }
};
/// In the middle and with the picture's shape; beside it and of another shape; with a far plane at infinity.
constexpr std::array<Frustum, 3> frusta{
    {{-0.3, 0.3, -0.2, 0.2, 0.5, 9}, {-0.1, 0.4, -0.25, 0.15, 0.5, 9}, {-0.35, 0.2, -0.2, 0.3, 0.5, infinity}}};

Scene seen(const std::string& name, const Frustum& by, bool y_up = false) {
  ViewOptions view;
  view.width = 33, view.height = 22, view.theta = 33, view.phi = 62, view.y_up = y_up;
  return seen_through(look_at_scene(load_scene(name).scene, view), by.matrix(), by.n, by.f);
}

}  // namespace

TEST_CASE("law: through matrices each vertex and its depth come to where these say, worked out apart") {
  int vertices = 0;
  for (const char* name : {"pyramid-behind", "cube", "dodecahedron"})
    for (const Frustum& by : frusta) {
      const Scene scene = seen(name, by);
      Conventions conventions;
      conventions.depth = Conventions::Depth::zero_to_one, conventions.cull = false;
      TraceRecorder recorder(header_for(method("z-buffer"), conventions), scene);
      method("z-buffer").record(scene, conventions, recorder);
      recorder.finish();
      const Trace run = Trace::from_bytes(recorder.take_bytes(), name);
      const glm::dmat4 all = scene.camera.matrices->projection * scene.camera.matrices->view;
      CAPTURE(name);
      CAPTURE(by.l);
      run.each(0, run.size(), [&](std::int64_t, const RecordedEvent& recorded) {
        const auto clip_of = [&](std::int32_t vertex) { return all * glm::dvec4(scene.points[vertex], 1); };
        const auto is_point = [&](std::int32_t vertex) { return vertex < std::ssize(scene.points); };
        if (const auto* e = get_if<ViewportTransform>(&recorded.event); e && is_point(e->vertex)) {
          const glm::dvec4 c = clip_of(e->vertex);
          CHECK(e->x_s == doctest::Approx((c.x / c.w + 1) / 2 * 33 - 0.5));
          CHECK(e->y_s == doctest::Approx((1 - c.y / c.w) / 2 * 22 - 0.5));
          ++vertices;
        }
        if (const auto* e = get_if<Projection>(&recorded.event); e && is_point(e->vertex)) {
          const glm::dvec4 c = clip_of(e->vertex);
          CHECK(e->z == doctest::Approx((c.z / c.w + 1) / 2));
        }
        return true;
      });
      CHECK(check(run).causes.empty());
    }
  CHECK(vertices > 100);
}

TEST_CASE("law: a run is written in the view coordinates of its matrices and read back from them") {
  for (const char* method_of : {"z-buffer", "half-space", "warnock", "bsp", "depth-sort"})
    for (const Frustum& by : frusta)
      for (const bool written_right_handed : {false, true}) {
        const Scene scene = seen("pyramid-behind", by, true);
        const Trace run = recorded_by(method_of, scene);
        Header header = run.header();
        if (written_right_handed) header.written.axes = WrittenAs::Axes::right_handed;
        if (!kind_that_cannot_turn(header).empty()) continue;
        std::string text = jsonl_header(header, scene) + "\n";
        bool behind = false;
        run.each(0, run.size(), [&](std::int64_t, const RecordedEvent& event) {
          text += jsonl_event(header, scene, event) + "\n";
          if (const auto* e = get_if<ViewTransform>(&event.event); e && e->vertex == 0) {
            const glm::dvec4 v = scene.camera.matrices->view * glm::dvec4(scene.points[0], 1);
            const std::string line = text.substr(text.rfind('\n', text.size() - 2) + 1);
            const double z_v = std::stod(line.substr(line.find("\"z_v\":") + 6));
            behind = z_v < 0;
            CHECK(z_v == doctest::Approx(v.z));
          }
          return true;
        });
        CAPTURE(method_of);
        CAPTURE(by.l);
        CHECK((behind || !run.has(kind_of<ViewTransform>)));
        const Trace again = trace_of(text);
        CHECK(again.scene().camera.view == scene.camera.view);
        CHECK(check(again).causes.empty());
        CHECK(formulas::end_of(again).picture.polygon == formulas::end_of(run).picture.polygon);
      }
}

TEST_CASE(
    "a camera by matrices: what stands beside them, what has no eye, and planes that are not theirs are refused") {
  const Scene scene = seen("pyramid", frusta[1]);
  const std::string line = jsonl_header(recorded_by("z-buffer", scene).header(), scene);
  const auto with = [&](const std::string& from, const std::string& to) {
    std::string text = line;
    const std::size_t at = text.find(from);
    REQUIRE(at != text.npos);
    return text.replace(at, from.size(), to) + "\n";
  };
  CHECK_NOTHROW(trace_of(line + "\n"));
  CHECK_THROWS_WITH_AS(trace_of(with("\"near\":", "\"window\":1,\"near\":")),
                       doctest::Contains("\"window\" stands beside \"projection\""), InputError);
  CHECK_THROWS_WITH_AS(trace_of(with("0.0,0.0,-1.0,0.0]]", "0.0,0.0,0.0,1.0]]")), doctest::Contains("have no eye"),
                       InputError);
  CHECK_THROWS_WITH_AS(trace_of(with("\"near\":0.5", "\"near\":0.75")),
                       doctest::Contains("the row of z_c of its projection gives"), InputError);
  CHECK_NOTHROW(trace_of(with("\"near\":0.5", "\"depth_range\":[0.25,0.75],\"near\":0.5")));
  CHECK_THROWS_WITH_AS(trace_of(with("\"near\":0.5", "\"depth_range\":[0.75,0.25],\"near\":0.5")),
                       doctest::Contains("the smaller one first"), InputError);
  Scene aslant = scene;  // a near plane of its own, as for a mirror
  aslant.camera.matrices->projection[0][2] = 0.5;
  CHECK(planes_against_matrix(aslant.camera).find("does not go with the distance") != std::string::npos);
  aslant.camera.matrices->projection = glm::dmat4(scene.camera.matrices->projection);
  for (int column = 0; column < 4; ++column) aslant.camera.matrices->projection[column][2] = 0;
  CHECK(planes_against_matrix(aslant.camera).empty());  // it says nothing of depths
}

TEST_CASE("law: rays through a matrix meet what the Z-buffer draws through it, and are not doubted") {
  for (const char* name : {"cube", "dodecahedron", "cyclic"})
    for (const Frustum& by : frusta) {
      const Scene scene = seen(name, by);
      const Picture drawn = formulas::end_of(recorded_by("z-buffer", scene)).picture;
      for (const char* method_of : {"ray-casting", "ray-tracing"}) {
        CAPTURE(name);
        CAPTURE(by.l);
        CAPTURE(method_of);
        const Trace run = recorded_by(method_of, scene);
        CHECK(check(run).causes.empty());
        const Picture cast = formulas::end_of(run).picture;
        if (std::string_view(method_of) == "ray-casting") {
          CHECK(cast.polygon == drawn.polygon);
          const oracle::Errors errors = oracle::errors_of(run);
          CHECK(errors.wrong_pixels == 0);
        }
        std::string text = jsonl_header(run.header(), scene) + "\n";
        run.each(0, run.size(), [&](std::int64_t, const RecordedEvent& event) {
          text += jsonl_event(run.header(), scene, event) + "\n";
          return true;
        });
        CHECK(formulas::end_of(trace_of(text)).picture.polygon == cast.polygon);
      }
    }
}
