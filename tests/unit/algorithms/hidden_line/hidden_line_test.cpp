// Edges cut into pieces that are seen and pieces that are hidden; on small scenes to the digit, on others against rays.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

#include "algorithms/hidden_line/cover.hpp"
#include "algorithms/scene/load.hpp"
#include "tests/unit/algorithms/hidden_line/line_runs.hpp"
#include "tests/unit/algorithms/scenes.hpp"

using namespace zstep;
using namespace zstep::hidden_line;
using namespace zstep::test;

namespace {

// What hides a point of the world, by a ray from the eye and the planes of all faces in world coordinates. Nothing is
// said where the ray passes close to an edge of a face or meets it close to the point.
enum class Seen { yes, no, unsure };

Seen look_from_eye(const Scene& scene, glm::dvec3 point, const LineBegin& line, bool cull) {
  const bool parallel = scene.camera.kind == Camera::Kind::orthographic;
  const double far = 100;
  const glm::dvec3 eye = parallel ? point + far * scene.camera.eye : scene.camera.eye, ray = point - eye;
  bool unsure = false;
  for (std::size_t f = 0; f < scene.facets.size(); ++f) {
    const auto number = static_cast<std::int32_t>(f);
    if (number == line.left_facet || number == line.right_facet) continue;
    const Facet& facet = scene.facets[f];
    std::vector<glm::dvec3> corners;
    for (std::int32_t k = 0; k < facet.corner_count; ++k)
      corners.push_back(
          scene.points[static_cast<std::size_t>(scene.corners[static_cast<std::size_t>(facet.first_corner + k)])]);
    glm::dvec3 normal(0);
    for (std::size_t k = 1; k + 1 < corners.size(); ++k)
      normal += glm::cross(corners[k] - corners[0], corners[k + 1] - corners[0]);
    const double toward = glm::dot(normal, ray);
    if (toward == 0 || (cull && toward > 0)) continue;
    const double t = glm::dot(normal, corners[0] - eye) / toward;
    if (t <= 0 || t > 1 + 1e-4) continue;
    // In the plane of the two axes that see most of the face.
    const glm::dvec3 at = eye + t * ray, size = glm::abs(normal);
    const int drop = size.x > size.y && size.x > size.z ? 0
                     : size.y > size.z                  ? 1
                                                        : 2,
              u = (drop + 1) % 3, v = (drop + 2) % 3;
    bool inside = false;
    double nearest = 1e9;
    for (std::size_t i = 0, j = corners.size() - 1; i < corners.size(); j = i++) {
      const glm::dvec3 &p = corners[i], &q = corners[j];
      if ((p[v] <= at[v]) != (q[v] <= at[v]) && at[u] >= p[u] + (q[u] - p[u]) * (at[v] - p[v]) / (q[v] - p[v]))
        inside = !inside;
      const glm::dvec3 along = q - p;
      const double along2 = std::max(glm::dot(along, along), 1e-300),
                   s = std::clamp(glm::dot(at - p, along) / along2, 0.0, 1.0);
      nearest = std::min(nearest, glm::length(at - p - s * along));
    }
    if (nearest < 1e-4 || t > 1 - 1e-4) unsure = unsure || inside || nearest < 1e-4;
    else if (inside) return Seen::no;
  }
  return unsure ? Seen::unsure : Seen::yes;
}

struct Trial {
  int agreed = 0, unsure = 0, wrong = 0;
};

// Holds the middle of every piece, and two more points of it, against rays.
Trial try_pieces(const Scene& scene, const Run& run, bool cull) {
  Trial trial;
  const viewing::Lens lens(scene.camera, scene.raster, Conventions::Depth::pseudodepth);
  const auto vertex_in_view = [&](std::int32_t vertex) {
    if (static_cast<std::size_t>(vertex) < scene.points.size())
      return glm::dvec3(scene.camera.view * glm::dvec4(scene.points[static_cast<std::size_t>(vertex)], 1));
    for (const ClipCross& cut : run.record.all<ClipCross>())
      if (cut.vertex == vertex) return glm::dvec3(cut.x_v, cut.y_v, cut.z_v);
    return glm::dvec3(0);
  };
  const glm::dmat4 to_world = glm::inverse(scene.camera.view);
  for (const auto& [number, parts] : run.pieces) {
    const LineBegin& line = run.lines.at(number);
    if (line.kind == LineKind::back && cull) continue;
    const glm::dvec3 from = vertex_in_view(line.vertex_0), to = vertex_in_view(line.vertex_1);
    for (const LinePiece& part : parts) {
      for (const double share : {0.5, 0.13, 0.91}) {
        // Equal steps on the picture are not equal steps in space: 1/z_v is straight on the picture.
        const double t = part.t_0 + share * (part.t_1 - part.t_0);
        const double s = lens.orthographic ? t : t * from.z / ((1 - t) * to.z + t * from.z);
        const glm::dvec3 world(to_world * glm::dvec4(from + s * (to - from), 1));
        const Seen seen = look_from_eye(scene, world, line, cull);
        if (seen == Seen::unsure) ++trial.unsure;
        else if ((seen == Seen::yes) == part.visible) ++trial.agreed;
        else ++trial.wrong;
      }
    }
  }
  return trial;
}

const glm::dvec3 square[] = {{2, 2, 1}, {8, 2, 1}, {8, 8, 1}, {2, 8, 1}};
const pieces::Plane square_plane{0, 0, 1, -1};

}  // namespace

TEST_SUITE("hidden_line/cover") {
  TEST_CASE("a square before, around and behind a line") {
    const Cover behind = find_cover({{0, 5, 3}, {10, 5, 3}}, square, square_plane);
    CHECK(behind.outcome == LineFace::covered);
    REQUIRE(behind.hidden.size() == 1);
    CHECK(behind.hidden[0].t_0 == doctest::Approx(0.2));
    CHECK(behind.hidden[0].t_1 == doctest::Approx(0.8));
    CHECK(behind.crossings.size() == 2);
    CHECK(find_cover({{0, 5, 0}, {10, 5, 0}}, square, square_plane).outcome == LineFace::in_front);
    CHECK(find_cover({{0, 5, 1}, {10, 5, 1}}, square, square_plane).outcome == LineFace::in_front);
    CHECK(find_cover({{0, 9, 3}, {10, 9, 3}}, square, square_plane).outcome == LineFace::behind);
    CHECK(find_cover({{0, 5, 3}, {10, 5, 3}}, square, square_plane.flipped()).outcome == LineFace::covered);
    // Through it, at x = 5.
    const Cover through = find_cover({{0, 5, 0}, {10, 5, 2}}, square, square_plane);
    REQUIRE(through.hidden.size() == 1);
    CHECK(through.hidden[0].t_0 == doctest::Approx(0.5));
    CHECK(through.hidden[0].t_1 == doctest::Approx(0.8));
    REQUIRE(through.crossings.size() == 3);
    CHECK(through.crossings[0].in_space);
  }

  TEST_CASE("a concave face hides a line in two places") {
    const glm::dvec3 u[] = {{0, 0, 0}, {2, 0, 0}, {2, 6, 0}, {8, 6, 0}, {8, 0, 0}, {10, 0, 0}, {10, 9, 0}, {0, 9, 0}};
    const Cover cover = find_cover({{-10, 3, 1}, {10, 3, 1}}, u, {0, 0, 1, 0});
    REQUIRE(cover.hidden.size() == 2);
    CHECK(cover.hidden[0].t_0 == doctest::Approx(0.5));
    CHECK(cover.hidden[0].t_1 == doctest::Approx(0.6));
    CHECK(cover.hidden[1].t_0 == doctest::Approx(0.9));
    CHECK(cover.hidden[1].t_1 == doctest::Approx(1));
  }

  TEST_CASE("an end on the plane is not behind it") {
    const Cover cover = find_cover({{5, 5, 1}, {10, 5, 2}}, square, square_plane);
    REQUIRE(cover.hidden.size() == 1);
    CHECK(cover.hidden[0].t_0 == 0);
    CHECK(cover.hidden[0].t_1 == doctest::Approx(0.6));
    CHECK(find_cover({{5, 5, 1}, {10, 5, 0}}, square, square_plane).outcome == LineFace::in_front);
  }

  TEST_CASE("hidden intervals become pieces, hidden and visible by turns") {
    const auto as_text = [](const std::vector<Part>& parts) {
      std::string text;
      for (const Part& part : parts) text += part.visible ? "v" : "h";
      return text;
    };
    CHECK(as_text(cut({}, 10)) == "v");
    CHECK(as_text(cut({{0, 1}}, 10)) == "h");
    CHECK(as_text(cut({{0.2, 0.4}}, 10)) == "vhv");
    CHECK(as_text(cut({{0.5, 1}, {0, 0.25}}, 10)) == "hvh");
    CHECK(as_text(cut({{0.2, 0.5}, {0.3, 0.4}, {0.4, 0.7}}, 10)) == "vhv");
    CHECK(cut({{0.2, 0.5}, {0.3, 0.4}, {0.4, 0.7}}, 10)[1].t_1 == 0.7);
    // Two faces that share an edge leave no gap of rounding between them.
    CHECK(as_text(cut({{0.2, 0.5}, {0.5 + 1e-12, 0.7}}, 10)) == "vhv");
    CHECK(as_text(cut({{1e-12, 0.5}}, 10)) == "hv");
    CHECK(as_text(cut({{0.5, 1 - 1e-12}}, 10)) == "vh");
  }
}

TEST_SUITE("hidden_line") {
  TEST_CASE("a cube: three faces of six, nine edges of twelve") {
    const Scene cube = seen("cube");
    const Run run = hide(cube);
    check_sums(run);
    CHECK(run.lines.size() == 12);
    CHECK(run.lines_of(LineKind::contour) == 6);
    CHECK(run.lines_of(LineKind::inner) == 3);
    CHECK(run.lines_of(LineKind::back) == 3);
    CHECK(run.pieces_of(true) == 9);
    CHECK(run.pieces_of(false) == 3);
    // Without culling the back faces' edges are hidden by the faces before them.
    const Run all = hide(cube, false);
    check_sums(all);
    CHECK(all.pieces_of(true) == 9);
    CHECK(all.pieces_of(false) == 3);
    CHECK(all.picture == run.picture);
  }

  TEST_CASE("pieces sum to the edge, and rays from the eye agree on every one") {
    struct Subject {
      std::string name;
      bool cull, ortho;
    };
    for (const Subject& subject : {Subject{"cube", true, false},
                                   {"pyramid", true, false},
                                   {"pyramid-behind", false, false},
                                   {"cyclic", false, false},
                                   {"intersecting", false, false},
                                   {"dodecahedron", true, true},
                                   {"cyclic", false, true},
                                   {"teapot:4", true, false},
                                   {"teapot:3", false, false}}) {
      CAPTURE(subject.name);
      CAPTURE(subject.ortho);
      ViewOptions view;
      view.orthographic = subject.ortho;
      const Scene scene = seen(subject.name.c_str(), view);
      const Run run = hide(scene, subject.cull);
      check_sums(run);
      const Trial trial = try_pieces(scene, run, subject.cull);
      MESSAGE(subject.name, ": ", trial.agreed, " points agree, ", trial.unsure, " are too close to call");
      CHECK(trial.wrong == 0);
      CHECK(trial.agreed > trial.unsure);  // of pyramid-behind, a card that is there twice
      CHECK(trial.agreed > 10);
    }
  }

  TEST_CASE("an edge that leaves the view volume is cut there") {
    ViewOptions close;
    close.rho = 1.4, close.near = 0.3, close.far = 9;
    const Scene scene = seen("pyramid", close);
    const Run run = hide(scene, false);
    check_sums(run);
    CHECK(run.record.all<ClipCross>().size() > 0);
    CHECK(try_pieces(scene, run, false).wrong == 0);
  }

  TEST_CASE("hidden pieces dashed: visible pixels stay, others join them") {
    const Scene scene = seen("cube");
    const Run plain = hide(scene), dashed = hide(scene, true, "dashed");
    CHECK(dashed.inked() > plain.inked());
    for (std::size_t i = 0; i < plain.picture.ink.size(); ++i) {
      if (plain.picture.ink[i] != no_ink) REQUIRE(dashed.picture.ink[i] == plain.picture.ink[i]);
    }
  }

  TEST_CASE("no polygon and no depth at any pixel") {
    const Run run = hide(seen("cube"));
    CHECK(std::all_of(run.picture.polygon.begin(), run.picture.polygon.end(),
                      [](std::int32_t p) { return p == no_polygon; }));
    CHECK(std::all_of(run.picture.depth.begin(), run.picture.depth.end(), [](double z) { return z == no_depth; }));
  }
}
