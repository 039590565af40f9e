// Edges cut into pieces that are seen and pieces that are hidden; on small scenes to the digit, on others against rays.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "algorithms/hidden_line/cover.hpp"
#include "algorithms/hidden_line/hidden_line.hpp"
#include "algorithms/hidden_line/wireframe.hpp"
#include "algorithms/scene/load.hpp"
#include "tests/unit/algorithms/scenes.hpp"
#include "traces/record/collect_recorder.hpp"

using namespace zstep;
using namespace zstep::hidden_line;

namespace {

struct Run {
  Picture picture;
  CollectRecorder record;
  std::map<std::int32_t, LineBegin> lines;
  std::map<std::int32_t, std::vector<LinePiece>> pieces;

  int pieces_of(bool visible) const {
    int count = 0;
    for (const auto& [line, parts] : pieces) count += static_cast<int>(std::count_if(parts.begin(), parts.end(), [&](const LinePiece& p) { return p.visible == visible; }));
    return count;
  }
  int lines_of(LineKind kind) const {
    return static_cast<int>(std::count_if(lines.begin(), lines.end(), [&](const auto& l) { return l.second.kind == kind; }));
  }
  int inked() const { return static_cast<int>(std::count_if(picture.ink.begin(), picture.ink.end(), [](std::uint32_t ink) { return ink != no_ink; })); }
};

template <class Method>
Run run_with(Method method, const Scene& scene, const Conventions& conventions) {
  Run run;
  run.picture = method(scene, conventions, run.record);
  for (const LineBegin& line : run.record.all<LineBegin>()) run.lines[line.line] = line;
  for (const LinePiece& piece : run.record.all<LinePiece>()) run.pieces[piece.line].push_back(piece);
  return run;
}

Run hide(const Scene& scene, bool cull = true, const char* hidden = "none") {
  Conventions conventions;
  conventions.cull = cull;
  conventions.options["hidden"] = hidden;
  return run_with(hidden_line::run<CollectRecorder>, scene, conventions);
}

Run wires(const Scene& scene, const char* edges = "all") {
  Conventions conventions;
  conventions.options["edges"] = edges;
  return run_with(wireframe::run<CollectRecorder>, scene, conventions);
}

Scene seen(const char* name, const ViewOptions& view = {}) { return look_at_scene(load_scene(name).scene, view); }

// The pieces of each edge follow each other from end to end, hidden and visible by turns.
void check_sums(const Run& run) {
  CHECK(run.pieces.size() == run.lines.size());
  for (const auto& row : run.pieces) {
    const std::int32_t line = row.first;
    const std::vector<LinePiece>& parts = row.second;
    CAPTURE(line);
    double sum = 0;
    REQUIRE(parts.front().t_0 == 0);
    REQUIRE(parts.back().t_1 == 1);
    for (std::size_t i = 0; i < parts.size(); ++i) {
      REQUIRE(parts[i].t_0 < parts[i].t_1);
      if (i > 0) REQUIRE(parts[i].t_0 == parts[i - 1].t_1);
      if (i > 0) REQUIRE(parts[i].visible != parts[i - 1].visible);
      sum += parts[i].t_1 - parts[i].t_0;
    }
    REQUIRE(sum == doctest::Approx(1).epsilon(1e-14));
  }
}

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
      corners.push_back(scene.points[static_cast<std::size_t>(scene.corners[static_cast<std::size_t>(facet.first_corner + k)])]);
    glm::dvec3 normal(0);
    for (std::size_t k = 1; k + 1 < corners.size(); ++k) normal += glm::cross(corners[k] - corners[0], corners[k + 1] - corners[0]);
    const double toward = glm::dot(normal, ray);
    if (toward == 0 || (cull && toward > 0)) continue;
    const double t = glm::dot(normal, corners[0] - eye) / toward;
    if (t <= 0 || t > 1 + 1e-4) continue;
    // In the plane of the two axes that see most of the face.
    const glm::dvec3 at = eye + t * ray, size = glm::abs(normal);
    const int drop = size.x > size.y && size.x > size.z ? 0 : size.y > size.z ? 1 : 2, u = (drop + 1) % 3, v = (drop + 2) % 3;
    bool inside = false;
    double nearest = 1e9;
    for (std::size_t i = 0, j = corners.size() - 1; i < corners.size(); j = i++) {
      const glm::dvec3 &p = corners[i], &q = corners[j];
      if ((p[v] <= at[v]) != (q[v] <= at[v]) && at[u] >= p[u] + (q[u] - p[u]) * (at[v] - p[v]) / (q[v] - p[v])) inside = !inside;
      const glm::dvec3 along = q - p;
      const double along2 = std::max(glm::dot(along, along), 1e-300), s = std::clamp(glm::dot(at - p, along) / along2, 0.0, 1.0);
      nearest = std::min(nearest, glm::length(at - p - s * along));
    }
    if (nearest < 1e-4 || t > 1 - 1e-4) unsure = unsure || inside || nearest < 1e-4;
    else if (inside) return Seen::no;
  }
  return unsure ? Seen::unsure : Seen::yes;
}

struct Trial { int agreed = 0, unsure = 0, wrong = 0; };

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

  TEST_CASE("hidden stretches become pieces, hidden and visible by turns") {
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
    struct Subject { std::string name; bool cull, ortho; };
    for (const Subject& subject : {Subject{"cube", true, false}, {"pyramid", true, false}, {"pyramid-behind", false, false}, {"cyclic", false, false},
                                   {"intersecting", false, false}, {"dodecahedron", true, true}, {"cyclic", false, true}, {"teapot:4", true, false},
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
    CHECK(std::all_of(run.picture.polygon.begin(), run.picture.polygon.end(), [](std::int32_t p) { return p == no_polygon; }));
    CHECK(std::all_of(run.picture.depth.begin(), run.picture.depth.end(), [](double z) { return z == no_depth; }));
  }
}

TEST_SUITE("hidden_line/degenerate") {
  const std::vector<glm::dvec3> flat = {{2, 2, 1}, {20, 2, 1}, {20, 20, 1}, {2, 20, 1}};

  TEST_CASE("nothing, a single polygon, and what is no polygon") {
    CHECK(hide(test::screen_scene(32, 32, {})).inked() == 0);
    CHECK(hide(test::screen_scene(32, 32, {flat})).pieces_of(true) == 4);
    CHECK(hide(test::screen_scene(32, 32, {flat})).lines_of(LineKind::boundary) == 4);
    CHECK(hide(test::screen_scene(32, 32, {{{1, 1, 0}, {5, 5, 0}, {3, 3, 0}}})).inked() == 0);
    CHECK(hide(test::screen_scene(32, 32, {{{1, 1, 0}, {5, 5, 0}}})).inked() == 0);
    const double nan = std::numeric_limits<double>::quiet_NaN();
    CHECK(hide(test::screen_scene(32, 32, {{{1, 1, 0}, {nan, 5, 0}, {3, 9, 0}}})).inked() == 0);
  }

  TEST_CASE("duplicates and coplanar polygons hide nothing of each other") {
    const Run twice = hide(test::screen_scene(32, 32, {flat, flat}));
    CHECK(twice.pieces_of(true) == 8);
    CHECK(twice.pieces_of(false) == 0);
    const Run overlap = hide(test::screen_scene(32, 32, {flat, {{10, 10, 1}, {28, 10, 1}, {28, 28, 1}, {10, 28, 1}}}));
    CHECK(overlap.pieces_of(false) == 0);
  }

  TEST_CASE("cyclic: each of three hides a part of the next") {
    const Run run = hide(seen("cyclic"), false);
    check_sums(run);
    CHECK(run.lines.size() == 9);
    CHECK(run.pieces_of(false) >= 3);
    CHECK(run.pieces_of(true) >= 9);
  }

  TEST_CASE("intersecting: edges end where they go into a face") {
    const Run run = hide(seen("intersecting"), false);
    check_sums(run);
    const std::vector<LineCross> crossings = run.record.all<LineCross>();
    CHECK(std::any_of(crossings.begin(), crossings.end(), [](const LineCross& c) { return c.in_space; }));
  }

  TEST_CASE("a face seen edge-on hides nothing; its edges are drawn") {
    const Run run = hide(test::screen_scene(32, 32, {{{5, 5, 0}, {15, 15, 3}, {15, 15, 0}}, {{2, 8, 5}, {28, 8, 5}, {20, 28, 5}}}));
    check_sums(run);
    CHECK(run.pieces_of(false) == 0);
  }

  TEST_CASE("an edge seen end-on is a point, and is not drawn") {
    const Run run = hide(test::screen_scene(32, 32, {{{5, 5, 0}, {5, 5, 3}, {15, 9, 0}}}));
    CHECK(run.lines.size() == 2);
  }

  TEST_CASE("a polygon that is not planar: the cuts between its facets are no edges") {
    Scene scene = test::screen_scene(32, 32, {});
    scene.points = {{2, 2, 0}, {20, 2, 0}, {20, 20, 5}, {2, 20, 0}};
    scene.polygons.push_back({"A", {}, 0});
    scene.corners = {0, 1, 2, 0, 2, 3};
    scene.facets = {{0, 0, 3}, {0, 3, 3}};
    CHECK(hide(scene).lines.size() == 4);
    CHECK(wires(scene).lines.size() == 4);
  }

  TEST_CASE("a third face at an edge and neighbours that run the other way round: all is drawn") {
    Scene scene = test::screen_scene(32, 32, {});
    scene.points = {{2, 2, 0}, {20, 2, 0}, {20, 20, 5}, {2, 20, 0}, {9, 28, 0}};
    for (const auto& corners : std::vector<std::vector<std::int32_t>>{{0, 1, 2}, {0, 1, 3}, {0, 1, 4}, {2, 1, 4}}) test::add_polygon(scene, corners);
    const Run run = hide(scene);
    check_sums(run);
    CHECK(run.lines.size() >= 8);
  }

  TEST_CASE("lines far beyond the raster cost no more than the raster") {
    const Run run = hide(test::screen_scene(32, 32, {{{-9e8, 16, 0}, {9e8, 16, 0}, {0, 9e8, 0}}}));
    CHECK(run.inked() == 32);
  }
}

TEST_SUITE("wireframe") {
  TEST_CASE("all edges, or none of which all faces face away") {
    const Scene cube = seen("cube");
    const Run all = wires(cube), front = wires(cube, "front");
    CHECK(all.pieces_of(true) == 12);
    CHECK(front.pieces_of(true) == 9);
    CHECK(front.pieces_of(false) == 3);
    // For one convex solid that is hidden-line removal already.
    CHECK(front.picture == hide(cube).picture);
    // For two it is not.
    const Scene behind = seen("pyramid-behind");
    CHECK(wires(behind, "front").picture != hide(behind).picture);
  }

  TEST_CASE("one pixel a column or row, the nearest to the line") {
    const Run run = wires(test::screen_scene(16, 16, {{{1, 1, 0}, {9, 5, 0}, {1, 9, 0}}}));
    std::vector<std::pair<int, int>> first;
    for (const ColorWrite& pixel : run.record.all<ColorWrite>()) first.emplace_back(pixel.x, pixel.y);
    const std::vector<std::pair<int, int>> along{{1, 1}, {2, 2}, {3, 2}, {4, 3}, {5, 3}, {6, 4}, {7, 4}, {8, 5}, {9, 5}};
    first.resize(along.size());
    std::sort(first.begin(), first.end());
    CHECK(first == along);
  }

  TEST_CASE("lines are cut at the raster's border") {
    const Run run = wires(test::screen_scene(8, 8, {{{-5, 3, 0}, {20, 3, 0}, {20, 30, 0}, {-5, 30, 0}}}));
    CHECK(run.inked() == 8);
  }
}
