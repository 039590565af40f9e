// The law of degenerate input: what docs/degenerate-input.md says holds for every method of the catalog, on every
// class. A case that is marked to fail says what ought to be and is not.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "algorithms/catalog/catalog.hpp"
#include "algorithms/scene/scene_file/read_scene.hpp"
#include "tests/laws/degenerate_checks.hpp"
#include "tests/laws/degenerate_scenes.hpp"
#include "tests/unit/algorithms/floating_horizon/surfaces.hpp"
#include "tests/unit/algorithms/scenes.hpp"
#include "traces/error.hpp"
#include "traces/file/trace.hpp"
#include "traces/record/trace_recorder.hpp"

using namespace zstep;
using namespace zstep::test;

namespace {

/// Two rectangles beside each other in the plane y = x_slope x + z_slope z, and a light in that plane.
Scene edge_on_to_the_light(double x_slope, double z_slope, double z_light) {
  Scene scene = degenerate_scene("", parallel);
  const auto at = [&](double x, double z) { return glm::dvec3(x, x_slope * x + z_slope * z, z); };
  for (const double x : {-5.5, 0.5}) {
    add_polygon(scene, {at(x, -2.5), at(x + 5, -2.5), at(x + 5, 2.5), at(x, 2.5)});
    scene.polygons.back().color = {200, 100, 50};
  }
  scene.light = Light{at(-20, z_light), {0, 0, 0}, 1, 1, 40};
  return scene;
}

int dark_pixels(const char* id, const Scene& scene) {
  const Picture picture = drawn(method(id), scene);
  CHECK(std::count(picture.polygon.begin(), picture.polygon.end(), no_polygon) == 169 - 50);
  return pixels_apart(picture, scene,
                      [&](std::size_t pixel) { return color_of_letter(scene, letters_of(picture)[pixel]); });
}

bool has_colors(const Method& m) { return m.gives != Gives::surfaces && m.gives != Gives::lines; }

std::vector<std::string> notes_of(const std::string& polygons) {
  return scene::read_scene(polygons, "s", "s", [](const std::string&) { return scene::PolygonSoup{}; }).notes;
}

}  // namespace

TEST_SUITE("degenerate input") {
  TEST_CASE("surfaces: the nearest at each pixel, in one plane the first of the file, the painter's own order") {
    for (const Method& m : methods()) {
      if (m.gives == Gives::lines) continue;
      REQUIRE((m.exact || m.id == "painter"));
      // These hold depths at one pixel against each other, so that rounding decides between equal ones.
      const bool rays = m.id == "ray-casting" || m.id == "ray-tracing";
      const bool pixels = rays || m.id == "z-buffer" || m.id == "half-space" || has_colors(m);
      for (const Degenerate& input : degenerate_inputs()) {
        for (const auto kind : {parallel, perspective}) {
          CAPTURE(m.id);
          CAPTURE(input.name);
          const std::string seen = letters_of(drawn(m, degenerate_scene(input.polygons, kind)));
          const bool either = (pixels && input.tie == Tie::rounding) || (rays && input.tie == Tie::seen_by_rays);
          std::string expected = letters_of(m.exact || input.painted.empty() ? input.layers[0] : input.painted);
          if (either) allow_second(input, seen, expected);
          CHECK(seen == expected);
        }
      }
    }
  }

  TEST_CASE("lines: each edge once, what lies in a face's plane is not hidden by it, and penetrations are no edges") {
    for (const Method& m : methods()) {
      if (m.gives != Gives::lines || m.needs == Needs::surface) continue;
      const bool hides = m.id == "hidden-line";
      REQUIRE((hides || m.id == "wireframe"));
      for (const Degenerate& input : degenerate_inputs()) {
        CAPTURE(m.id);
        CAPTURE(input.name);
        const Scene scene = degenerate_scene(input.polygons, parallel);
        const Conventions conventions = conventions_for(m);
        TraceRecorder recorder(header_for(m, conventions), scene);
        const Picture picture = m.record(scene, conventions, recorder);
        recorder.finish();
        const Trace trace = Trace::from_bytes(recorder.take_bytes(), input.name);
        int edges = 0, visible = 0, hidden = 0;
        double edge = 0, length = 0;
        for (std::int64_t position = 1; position <= trace.size(); ++position) {
          const Event event = trace.event(position).event;
          if (const auto* begin = get_if<LineBegin>(&event)) {
            const auto point = [&](std::int32_t i) { return scene.points[static_cast<std::size_t>(i)]; };
            const glm::dvec3 along = point(begin->vertex_1) - point(begin->vertex_0);
            edge = std::hypot(along.x, along.z);
            ++edges;
          }
          if (const auto* piece = get_if<LinePiece>(&event)) {
            ++(piece->visible ? visible : hidden);
            if (piece->visible) length += (piece->t_1 - piece->t_0) * edge;
          }
        }
        CHECK(edges == input.lines.edges);
        CHECK(visible == (hides ? input.lines.visible : input.lines.edges));
        CHECK(hidden == (hides ? input.lines.hidden : 0));
        CHECK(length == doctest::Approx(hides ? input.lines.visible_length : input.lines.length).epsilon(1e-9));
        CHECK(letters_of(picture) == letters_of(Rows{}));  // lines are ink alone
        const bool inked =
            std::any_of(picture.ink.begin(), picture.ink.end(), [](std::uint32_t ink) { return ink != no_ink; });
        CHECK(inked == (edges > 0));
      }
    }
  }

  TEST_CASE("glass: every layer is seen, of those in one plane the first of the file on top") {
    for (const Method& m : methods())  // whose colours this file looks at
      REQUIRE((!has_colors(m) || m.id == "transparency" || m.id == "ray-tracing" || m.id == "shadow-buffer"));
    for (const Degenerate& input : degenerate_inputs()) {
      for (const auto kind : {parallel, perspective}) {
        CAPTURE(input.name);
        CHECK(wrong_glass("transparency", input, kind) == 0);
        CHECK(wrong_glass("ray-tracing", input, kind) == 0);
      }
    }
  }

  TEST_CASE("shadows: nothing that faces a light at the eye is dark") {
    for (const Degenerate& input : degenerate_inputs()) {
      CAPTURE(input.name);
      CHECK(wrongly_dark("shadow-buffer", input) == 0);
      CHECK(wrongly_dark("ray-tracing", input) == 0);
    }
  }

  TEST_CASE("ray tracing: in one plane, each layer of glass is seen once and none is dark") {
    for (const Degenerate& input : degenerate_inputs()) {
      if (input.layers.size() < 2 || input.name == "crossing itself, equal parts") continue;
      CAPTURE(input.name);
      CHECK(wrong_glass("ray-tracing", input, parallel) == 0);
      CHECK(wrongly_dark("ray-tracing", input) == 0);
    }
  }

  TEST_CASE("shadows: on a wall behind, which alone is seen, there is the silhouette, edge-on throws none") {
    for (const Degenerate& input : degenerate_inputs()) {
      const std::string wall =
          "[[polygon]]\nname = \"wall\"\npoints = [[-20, 10, -20], [20, 10, -20], [20, 10, 20], [-20, 10, 20]]\n";
      Scene scene = degenerate_scene(input.polygons + wall, perspective);
      scene.light = at_the_eye;
      scene.camera.near = 1005;
      const auto number = static_cast<std::int32_t>(scene.polygons.size()) - 1;
      const Color lit = scene.polygons.back().color;
      for (const char* id : {"shadow-buffer", "ray-tracing"}) {
        CAPTURE(id);
        CAPTURE(input.name);
        const Picture picture = drawn(method(id), scene);
        CHECK(std::count(picture.polygon.begin(), picture.polygon.end(), number) == 169);
        const std::string shape = letters_of(input.layers[0]);
        CHECK(pixels_apart(picture, scene,
                           [&](std::size_t pixel) { return shape[pixel] == '.' ? lit : shaded(lit); }) == 0);
      }
    }
  }

  TEST_CASE("shadows: edge-on to the light a polygon throws none, is lit, and so is its neighbour in the same plane") {
    for (const double slope : {0.0, 0.25, 0.3}) {
      CAPTURE(slope);
      CHECK(dark_pixels("shadow-buffer", edge_on_to_the_light(slope, 0, 0)) == 0);
      CHECK(dark_pixels("ray-tracing", edge_on_to_the_light(slope, 0, 0)) == 0);
    }
    CHECK(dark_pixels("shadow-buffer", edge_on_to_the_light(0.25, 0.25, 2)) == 0);
  }

  TEST_CASE("ray tracing: the same where the plane slants both ways") {
    CHECK(dark_pixels("ray-tracing", edge_on_to_the_light(0.25, 0.25, 2)) == 0);
  }

  TEST_CASE("mirrors: mirrored rays see of degenerate input, behind the eye, what the eye would see") {
    const std::string mirror =
        "[[polygon]]\nname = \"mirror\"\nreflectance = 1\npoints = [[-20, 10, -20], [20, 10, -20], [20, 10, 20], [-20, "
        "10, 20]]\n";
    for (const Degenerate& input : degenerate_inputs()) {
      Scene scene = degenerate_scene(input.polygons + mirror, parallel);
      for (glm::dvec3& point : scene.points)
        if (point.y < 10) point.y = -60 - point.y;  // what was nearest to the eye is nearest to the mirror
      CAPTURE(input.name);
      const Picture picture = drawn(method("ray-tracing"), scene);
      std::string seen, expected = letters_of(input.layers[0]);
      for (std::size_t pixel = 0; pixel < expected.size(); ++pixel)
        seen += letter_of_color(scene, color_at(picture, scene, pixel));
      if (input.tie == Tie::rounding || input.tie == Tie::seen_by_rays) allow_second(input, seen, expected);
      CHECK(seen == expected);
    }
  }

  TEST_CASE("floating horizon: polygons alone are refused, curves that touch are seen, and a curve needs two samples") {
    const Method& m = method("floating-horizon");
    for (const Degenerate& input : degenerate_inputs())
      CHECK_THROWS_AS(check_run(m, degenerate_scene(input.polygons, parallel), Conventions{}), InputError);
    for (const DegenerateSurface& surface : degenerate_surfaces()) {
      CAPTURE(surface.name);
      CHECK(drawn(run_horizon(surface.scene).picture) == surface.drawn);
      check_recording(m, surface.scene);
    }
  }

  TEST_CASE("floating horizon: a curve edge-on along a column reaches from its lowest row to its highest") {
    CHECK(drawn(run_horizon(surface_of({{3, 0, {5, 3, 2}}})).picture) ==
          drawn(run_horizon(surface_of({{3.25, 0, {5, 3, 2}}})).picture));
  }

  TEST_CASE("loading: what is cut, what is not drawn, and nothing to draw at all") {
    using Notes = std::vector<std::string>;
    for (const Degenerate& input : degenerate_inputs()) {
      CAPTURE(input.name);
      if (input.name == "none") CHECK_THROWS_AS(notes_of(input.polygons), InputError);
      else if (input.name == "zero area")
        CHECK(notes_of(input.polygons) == Notes{"s: 1 polygon is not drawn, having fewer than three different corners",
                                                "s: 2 polygons are not drawn, enclosing no area"});
      else if (input.name == "non-planar" || input.name == "crossing itself, equal parts")
        CHECK(notes_of(input.polygons) == Notes{"s: 1 polygon is not planar and cut into triangles"});
      else CHECK(notes_of(input.polygons).empty());
    }
  }

  TEST_CASE(
      "loading: in screen coordinates a polygon without area is not said to be left out, and the coverage decides") {
    const auto file = scene::read_scene(
        "coordinates = \"screen\"\nraster = { width = 12, height = 8 }\n[[polygon]]\npoints = [[1, 1, 1], [5, 3, 2], "
        "[9, 5, 3]]\n",
        "s", "s", [](const std::string&) { return scene::PolygonSoup{}; });
    REQUIRE(file.notes.size() == 1);
    CHECK(file.notes[0].find("not drawn") == std::string::npos);
    CHECK(file.notes[0].find("where the coverage counts them") != std::string::npos);
    const auto pixels = [&](const char* id, Conventions::Coverage coverage) {
      Conventions conventions = conventions_for(method(id));
      conventions.coverage = coverage;
      NullRecorder nothing;
      const Picture picture = method(id).render(file.scene, conventions, nothing);
      return std::count_if(picture.polygon.begin(), picture.polygon.end(), [](auto p) { return p != no_polygon; });
    };
    using enum Conventions::Coverage;
    CHECK(pixels("z-buffer", top_left) == 0);
    CHECK(pixels("z-buffer", inclusive) == 5);
    CHECK(pixels("z-buffer", round) > 0);
    CHECK(pixels("z-buffer", ceil_floor) > 0);
    for (const char* id : {"scan-line", "depth-sort", "painter", "bsp", "warnock", "ray-casting", "transparency"}) {
      CAPTURE(id);
      CHECK(pixels(id, top_left) == 0);
    }
  }

  TEST_CASE("recording changes no picture, and a replay rebuilds it") {
    for (const Method& m : methods()) {
      if (m.needs == Needs::surface) continue;
      for (const Degenerate& input : degenerate_inputs()) {
        CAPTURE(m.id);
        CAPTURE(input.name);
        Scene scene = has_colors(m) ? glass(input, perspective) : degenerate_scene(input.polygons, perspective);
        scene.light = at_the_eye;
        check_recording(m, scene);
      }
    }
  }
}
