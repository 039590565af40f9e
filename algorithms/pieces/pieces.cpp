
#include "algorithms/pieces/pieces.hpp"

#include <cmath>

#include "traces/formulas/outlines.hpp"
#include "algorithms/scan_conversion/spans.hpp"
#include "traces/record/all_recorders.hpp"
#include "traces/scene.hpp"

namespace zstep::pieces {

Plane plane_of(std::span<const glm::dvec3> corners) {
  const auto corner = [&](std::size_t i) { return corners[i]; };
  const auto [normal, d] = formulas::plane_through(corners.size(), corner, formulas::Mean::of_parts);
  return {normal.x, normal.y, normal.z, d};
}

double bend_of(const Plane& plane, std::span<const glm::dvec3> corners) {
  double most = 0;
  for (const glm::dvec3& corner : corners) most = std::fmax(most, std::abs(plane.value(corner)));
  return most;
}

std::vector<glm::dvec3> Pieces::corners(const clipping::Outline& outline) const {
  std::vector<glm::dvec3> points;
  points.reserve(outline.size());
  for (const std::int32_t vertex : outline) points.push_back(corner(vertex));
  return points;
}

namespace {

// A piece's plane and extents, from its outline.
Piece make_piece(const Pieces& all, std::int32_t polygon, std::int32_t parent, clipping::Outline outline) {
  const std::vector<glm::dvec3> corners = all.corners(outline);
  Piece piece{polygon, parent, std::move(outline), plane_of(corners), corners[0], corners[0]};
  for (const glm::dvec3& corner : corners) {
    piece.low = glm::min(piece.low, corner);
    piece.high = glm::max(piece.high, corner);
  }
  piece.bend = bend_of(piece.plane, corners);
  return piece;
}

template <Recorder R>
void describe(const Piece& piece, std::int32_t number, R& record) {
  const Plane& plane = piece.plane;
  record(step::plane, PlaneEquation{number, plane.a, plane.b, plane.c, plane.d});
  record(step::extent, Extent{number, piece.low.x, piece.high.x, piece.low.y, piece.high.y, piece.low.z, piece.high.z});
}

}  // namespace

template <Recorder R>
Pieces gather(const Scene& scene, const Conventions& conventions, R& record) {
  const viewing::Lens lens(scene.camera, scene.raster, conventions.depth);
  record(step::tables, TablesBegin{size32(scene.polygons)});
  Pieces all;
  all.vertices = viewing::view_vertices(scene, lens, record);

  clipping::Outline outline;
  std::int32_t facet_number = 0;
  for (const Facet& facet : scene.facets) {
    record(step::polygon, PolygonBegin{facet.polygon, facet_number});
    ++facet_number;

    if (!clipping::find_outline(scene, facet, conventions.cull, lens, all.vertices, outline, record)) continue;
    Piece piece = make_piece(all, facet.polygon, -1, outline);
    if (std::abs(piece.plane.c) < 1e-12) {  // screen scenes only; of others, the facing test has found it
      record(clipping::step::reject, PolygonReject{facet.polygon, Reject::edge_on});
      continue;
    }
    const auto number = size32(all.pieces);
    record(step::make, PieceMake{number, facet.polygon, -1});
    describe(piece, number, record);
    piece.facet = facet_number - 1;
    all.pieces.push_back(std::move(piece));
  }
  return all;
}

namespace {

template <Recorder R>
std::int32_t add_part(Pieces& all, std::int32_t parent, const clipping::Outline& outline, R& record) {
  const auto number = size32(all.pieces);
  const std::int32_t polygon = all[parent].polygon;
  for (const std::int32_t vertex : outline) {
    record(cutting::step::outline, OutlineVertex{vertex});
  }
  record(cutting::step::part, PieceMake{number, polygon, parent});
  Piece piece = make_piece(all, polygon, parent, outline);
  piece.plane = all[parent].plane;  // the same plane, and none of the digits that a sliver would lose
  describe(piece, number, record);
  piece.facet = all[parent].facet;
  piece.bend = all[parent].bend;
  all.pieces.push_back(std::move(piece));
  return number;
}

}  // namespace

template <Recorder R>
Parts cut(Pieces& all, std::int32_t number, const Plane& plane, double tolerance, R& record) {
  const clipping::Outline outline = all[number].outline;
  const Halves halves = split(
      outline, all[number].plane, all[number].bend, plane, tolerance,
      [&](std::int32_t vertex) { return all.corner(vertex); },
      [&](std::int32_t from, std::int32_t to, double t, glm::dvec3 point) {
        const auto made = size32(all.vertices);
        record(cutting::step::cut, SplitVertex{from, to, t, made, Space::raster, point.x, point.y, point.z});
        all.vertices.push_back({{}, point, 0});
        return made;
      });
  const std::int32_t first = add_part(all, number, halves.positive, record);
  return {first, add_part(all, number, halves.negative, record)};
}

template <Recorder R>
void paint(const Pieces& all, const clipping::Outline& outline, std::int32_t polygon, const Scene& scene,
           Picture& picture, R& record) {
  paint(all.vertices, outline, polygon, scene.raster, picture, record);
}

template <Recorder R>
void paint(const viewing::Vertices& vertices, const clipping::Outline& outline, std::int32_t polygon,
           const Raster& raster, Picture& picture, R& record) {
  scan_conversion::for_each_span(polygon, outline, vertices, raster, record, [&](const SpanBegin& span) {
    for (std::int32_t x = span.first, y = span.y; x <= span.last; ++x) {
      const double z = scan_conversion::depth_on(span, x);
      const std::size_t pixel = picture.at(x, y);
      picture.polygon[pixel] = polygon;
      picture.depth[pixel] = z;
      record(painting::step::paint, PixelPaint{x, y, z, polygon});
    }
  });
}

#define INSTANTIATE(R)                                                                                       \
  template Pieces gather<R>(const Scene&, const Conventions&, R&);                                           \
  template Parts cut<R>(Pieces&, std::int32_t, const Plane&, double, R&);                                    \
  template void paint<R>(const Pieces&, const clipping::Outline&, std::int32_t, const Scene&, Picture&, R&); \
  template void paint<R>(const viewing::Vertices&, const clipping::Outline&, std::int32_t, const Raster&, Picture&, R&);
ZSTEP_FOR_EACH_RECORDER(INSTANTIATE)
#undef INSTANTIATE

}  // namespace zstep::pieces
