#include "algorithms/hidden_line/lines.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>

#include "algorithms/scene/mesh.hpp"
#include "algorithms/viewing/back_face.hpp"
#include "traces/formulas/outlines.hpp"
#include "traces/record/all_recorders.hpp"
#include "traces/scene.hpp"

namespace zstep::lines {

namespace {

enum class Face : std::uint8_t { none, front, back };

std::vector<Face> find_facing(const Scene& scene, const viewing::Vertices& vertices) {
  std::vector<Face> faces;
  NullRecorder nothing;
  for (const Facet& facet : scene.facets) {
    const clipping::Corners corners(scene.corners.data() + facet.first_corner,
                                    static_cast<std::size_t>(facet.corner_count));
    if (clipping::degenerate(scene, corners)) {
      faces.push_back(Face::none);
      continue;
    }
    const bool front = scene.camera.kind == Camera::Kind::screen ||
                       clipping::test_facing(scene, corners, vertices, nothing) == Facing::front;
    faces.push_back(front ? Face::front : Face::back);
  }
  return faces;
}

// The cuts between the facets of one polygon: edges that stand in two of them, as (polygon, point, point).
using Cut = std::tuple<std::int32_t, std::int32_t, std::int32_t>;

std::vector<Cut> find_cuts(const Scene& scene) {
  std::vector<Cut> sides, cuts;
  const auto of_same_polygon = [&](std::size_t i, std::size_t j) {
    return j < scene.facets.size() && scene.facets[i].polygon == scene.facets[j].polygon;
  };
  for (std::size_t i = 0; i < scene.facets.size(); ++i) {
    if (!of_same_polygon(i, i + 1) && !of_same_polygon(i, i - 1)) continue;  // i - 1 of 0 is beyond the end
    const Facet& facet = scene.facets[i];
    for (std::int32_t k = 0; k < facet.corner_count; ++k) {
      const std::int32_t next = k + 1 < facet.corner_count ? k + 1 : 0;
      const auto [low, high] =
          std::minmax(scene.corners[facet.first_corner + k], scene.corners[facet.first_corner + next]);
      sides.emplace_back(facet.polygon, low, high);
    }
  }
  std::sort(sides.begin(), sides.end());
  for (std::size_t i = 1; i < sides.size(); ++i) {
    if (sides[i] == sides[i - 1]) cuts.push_back(sides[i]);
  }
  return cuts;
}

LineKind kind_of_edge(Face left, Face right) {
  if (left != Face::front && right != Face::front) return LineKind::back;
  if (left == Face::none || right == Face::none) return LineKind::boundary;
  return left == right ? LineKind::inner : LineKind::contour;
}

}  // namespace

std::vector<Edge> find_edges(const Scene& scene, const viewing::Vertices& vertices) {
  const std::vector<Face> facing = find_facing(scene, vertices);
  const std::vector<Cut> cuts = find_cuts(scene);
  const Mesh mesh = mesh_of(scene);
  const HalfEdgeMesh& half_edges = mesh.half_edges;

  std::vector<Edge> edges;
  for (const auto edge : half_edges.edges()) {
    const auto forth = half_edges.halfedge_handle(edge, 0), back = half_edges.halfedge_handle(edge, 1);
    const std::int32_t from = half_edges.data(half_edges.from_vertex_handle(forth)).point;
    const std::int32_t to = half_edges.data(half_edges.to_vertex_handle(forth)).point;
    if (from == to) continue;  // of a face without area

    bool is_cut = false;
    const auto facet_of = [&](HalfEdgeMesh::HalfedgeHandle half) {
      const std::int32_t facet = half_edges.face_handle(half).idx();
      if (facet == -1 || facing[facet] == Face::none) return -1;
      const std::int32_t polygon = scene.facets[facet].polygon;
      is_cut =
          is_cut || std::binary_search(cuts.begin(), cuts.end(), Cut{polygon, std::min(from, to), std::max(from, to)});
      return facet;
    };
    const std::int32_t left = facet_of(forth), right = facet_of(back);
    if (is_cut || (left == -1 && right == -1)) continue;
    const auto face = [&](std::int32_t f) { return f == -1 ? Face::none : facing[f]; };
    edges.push_back({from, to, left, right, kind_of_edge(face(left), face(right))});
  }
  return edges;
}

template <Recorder R>
bool bring_into_view(Edge& edge, const Scene& scene, const viewing::Lens& lens, viewing::Vertices& vertices,
                     R& record) {
  const auto vertex = [&](std::int32_t index) -> viewing::Vertex& { return vertices[index]; };
  const auto points = size32(scene.points);
  const bool on_raster = scene.camera.kind == Camera::Kind::screen;
  for (int plane = 0; plane < 6 && !on_raster; ++plane) {
    const auto which = static_cast<ClipPlane>(plane);
    const double d_0 = viewing::distance_inside(lens, vertex(edge.vertex_0).view, which);
    const double d_1 = viewing::distance_inside(lens, vertex(edge.vertex_1).view, which);
    if (!(d_0 >= 0) && !(d_1 >= 0)) return false;
    if (d_0 >= 0 && d_1 >= 0) continue;

    std::int32_t& outer = d_0 >= 0 ? edge.vertex_1 : edge.vertex_0;
    const std::int32_t inside = d_0 >= 0 ? edge.vertex_0 : edge.vertex_1;
    const double t = d_0 >= 0 ? formulas::where_zero(d_0, d_1) : formulas::where_zero(d_1, d_0);
    const glm::dvec3 view = formulas::part_of_way(vertex(inside).view, vertex(outer).view, t);
    const auto made = size32(vertices);
    record(step::clip, ClipCross{which, inside, outer, t, made, view.x, view.y, view.z});
    vertices.push_back({view, {}, 0});
    outer = made;
  }
  for (const std::int32_t end : {edge.vertex_0, edge.vertex_1}) {
    if (end >= points && !on_raster) viewing::project_vertex(lens, end, vertex(end), record);
  }
  constexpr double limit = 1e9, shortest = 1e-9;  // pixels
  const glm::dvec3 from = vertex(edge.vertex_0).raster, to = vertex(edge.vertex_1).raster;
  const bool sound = std::max({std::abs(from.x), std::abs(from.y), std::abs(to.x), std::abs(to.y)}) <= limit &&
                     std::isfinite(from.z) && std::isfinite(to.z);
  return sound && Line{from, to}.length() > shortest;
}

double Line::length() const { return glm::length(glm::dvec2(to - from)); }

namespace {

bool bright(Color color) { return 299 * color.red + 587 * color.green + 114 * color.blue > 127'500; }

std::uint8_t middle(int one, int other) { return static_cast<std::uint8_t>((one + other) / 2); }

}  // namespace

Color visible_ink(const Scene& scene) { return bright(scene.background) ? Color{0, 0, 0} : Color{255, 255, 255}; }

Color hidden_ink(const Scene& scene) {
  const Color ink = visible_ink(scene), paper = scene.background;
  return {middle(ink.red, paper.red), middle(ink.green, paper.green), middle(ink.blue, paper.blue)};
}

template <Recorder R>
void draw(const Line& line, double t_0, double t_1, Color color, bool dashed, Picture& picture, R& record) {
  const glm::dvec2 from(line.from), along = glm::dvec2(line.to) - from;
  const bool steep = std::abs(along.y) > std::abs(along.x);
  const int major = steep ? 1 : 0, minor = 1 - major;
  const auto pixel = [](double at) { return std::floor(at + 0.5); };
  const double end_0 = pixel(from[major] + t_0 * along[major]), end_1 = pixel(from[major] + t_1 * along[major]);
  const double last = (steep ? picture.height : picture.width) - 1, beside = steep ? picture.width : picture.height;

  for (double at = std::max(0.0, std::min(end_0, end_1)); at <= std::min(last, std::max(end_0, end_1)); ++at) {
    const double across = pixel(from[minor] + (at - from[major]) / along[major] * along[minor]);
    if (!(across >= 0 && across < beside)) continue;
    const auto x = static_cast<std::int32_t>(steep ? across : at), y = static_cast<std::int32_t>(steep ? at : across);
    std::uint32_t& ink = picture.ink[picture.at(x, y)];
    if (dashed && (ink != no_ink || static_cast<std::int32_t>(at) % 4 >= 2)) continue;
    ink = ink_of(color);
    record(step::draw, ColorWrite{x, y, color.red, color.green, color.blue});
  }
}

#define INSTANTIATE(R)                                                                                 \
  template bool bring_into_view<R>(Edge&, const Scene&, const viewing::Lens&, viewing::Vertices&, R&); \
  template void draw<R>(const Line&, double, double, Color, bool, Picture&, R&);
ZSTEP_FOR_EACH_RECORDER(INSTANTIATE)
#undef INSTANTIATE

}  // namespace zstep::lines
