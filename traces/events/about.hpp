// What each kind of step is about: the fields that name the thing, apart from those that say what came out.
//
// Two programs give different numbers to the same edge and do things in another order. So steps of two runs are matched
// by what they are about: the depth compare of polygon 3 at pixel (9, 4), the entry of the edge from vertex 1 to vertex
// 2 of polygon 0. The table below says so for each kind; all other fields are what may differ.
#pragma once

#include <cstdint>
#include <string_view>

#include "traces/events/slots.hpp"

namespace zstep::diff {

/// What else a step belongs to, besides what its own fields name.
enum Within : std::uint8_t {
  nothing = 0,
  polygon = 1,    ///< the polygon at work, if one is
  scan_line = 2,  ///< the scan line at work
  area = 4,       ///< the area at work
  ray = 8,        ///< the ray at work
  curve = 16,     ///< the curve, the line or the piece at work
  node = 32,      ///< the node of the tree that was made last
};

struct About {
  std::uint8_t within = nothing;
  std::array<std::string_view, 4> fields{};
  bool either_way = false;  ///< vertex_0 and vertex_1 may stand the other way round

  constexpr bool names(std::string_view field) const {
    for (const std::string_view& name : fields)
      if (!name.empty() && name == field) return true;
    return false;
  }
};

template <class E>
inline constexpr About about{};  // a few kinds are about nothing but the order in which they come

// clang-format off
template <> inline constexpr About about<ViewTransform>{nothing, {"vertex"}};
template <> inline constexpr About about<Projection>{nothing, {"vertex"}};
template <> inline constexpr About about<ViewportTransform>{nothing, {"vertex"}};

template <> inline constexpr About about<PolygonBegin>{nothing, {"polygon"}};
template <> inline constexpr About about<FacingTest>{polygon};
template <> inline constexpr About about<PolygonReject>{nothing, {"polygon"}};
template <> inline constexpr About about<ClipTest>{polygon};
template <> inline constexpr About about<ClipVertex>{polygon, {"plane", "vertex"}};
template <> inline constexpr About about<ClipCross>{polygon, {"plane", "vertex_inside", "vertex_outside"}};
template <> inline constexpr About about<OutlineVertex>{polygon, {"vertex"}};

template <> inline constexpr About about<EdgeTableInsert>{nothing, {"polygon", "vertex_0", "vertex_1"}, true};
template <> inline constexpr About about<EdgeTableSkip>{polygon, {"vertex_0", "vertex_1"}, true};
template <> inline constexpr About about<ScanLineBegin>{polygon, {"y"}};
template <> inline constexpr About about<EdgeEnter>{nothing, {"edge"}};
template <> inline constexpr About about<EdgeRetire>{nothing, {"edge"}};
template <> inline constexpr About about<EdgeStep>{nothing, {"edge"}};
template <> inline constexpr About about<EdgeSwap>{polygon | scan_line, {}};
template <> inline constexpr About about<PlaneSlopes>{nothing, {"polygon"}};
template <> inline constexpr About about<SpanBegin>{polygon, {"y"}};

template <> inline constexpr About about<DepthInterpolate>{polygon, {"x", "y"}};
template <> inline constexpr About about<DepthCompare>{polygon, {"x", "y"}};
template <> inline constexpr About about<DepthWrite>{polygon, {"x", "y"}};
template <> inline constexpr About about<PixelWrite>{polygon, {"x", "y"}};
template <> inline constexpr About about<AttributeInterpolate>{polygon, {"x", "y"}};
template <> inline constexpr About about<PixelPaint>{polygon, {"x", "y"}};
template <> inline constexpr About about<ColorWrite>{curve, {"x", "y"}};
template <> inline constexpr About about<ColorBlend>{nothing, {"x", "y", "polygon"}};
template <> inline constexpr About about<PassBegin>{nothing, {"pass"}};
template <> inline constexpr About about<ShadowCompare>{nothing, {"x", "y"}};

template <> inline constexpr About about<PieceMake>{nothing, {"polygon", "parent"}};
template <> inline constexpr About about<PlaneEquation>{nothing, {"piece"}};
template <> inline constexpr About about<Extent>{nothing, {"piece"}};
template <> inline constexpr About about<PlaneDepth>{scan_line | area, {"piece"}};
template <> inline constexpr About about<VertexSide>{node, {"vertex", "plane_of"}};
template <> inline constexpr About about<SideTest>{node, {"piece", "plane_of"}};
template <> inline constexpr About about<ExtentTest>{nothing, {"piece", "other", "axis"}};
template <> inline constexpr About about<OverlapTest>{nothing, {"piece", "other"}};
template <> inline constexpr About about<SplitVertex>{nothing, {"vertex_0", "vertex_1"}, true};
template <> inline constexpr About about<PieceDraw>{nothing, {"piece"}};
template <> inline constexpr About about<Saved>{area | scan_line | ray, {"coherence"}};

template <> inline constexpr About about<ListInsert>{nothing, {"piece"}};
template <> inline constexpr About about<ListRemove>{nothing, {"piece"}};
template <> inline constexpr About about<ListMark>{nothing, {"piece"}};
template <> inline constexpr About about<PairBegin>{nothing, {"piece", "other"}};
template <> inline constexpr About about<RootCandidate>{node, {"piece"}};
template <> inline constexpr About about<NodeMake>{nothing, {"parent", "front"}};
template <> inline constexpr About about<NodeAdd>{nothing, {"node", "piece"}};
template <> inline constexpr About about<EyeSide>{nothing, {"node"}};
template <> inline constexpr About about<NodeSkip>{nothing, {"node", "front"}};

template <> inline constexpr About about<FlagFlip>{scan_line, {"edge"}};
template <> inline constexpr About about<SpanFlags>{nothing, {"y"}};
template <> inline constexpr About about<ImpliedEdge>{scan_line, {"piece", "other"}};
template <> inline constexpr About about<SpanWinner>{scan_line, {"first"}};
template <> inline constexpr About about<CoverageAdd>{nothing, {"x", "y", "owner"}};

template <> inline constexpr About about<AreaBegin>{nothing, {"first_column", "first_row", "end_column", "end_row"}};
template <> inline constexpr About about<AreaBin>{area, {"piece"}};
template <> inline constexpr About about<AreaDecide>{nothing, {"area"}};

template <> inline constexpr About about<BoxMake>{nothing, {"parent"}};
template <> inline constexpr About about<BoxHold>{nothing, {"box", "facet"}};
template <> inline constexpr About about<CellHold>{nothing, {"cell_x", "cell_y", "cell_z", "facet"}};
template <> inline constexpr About about<RayBegin>{nothing, {"x", "y", "role", "parent"}};
template <> inline constexpr About about<CellVisit>{ray, {"cell_x", "cell_y", "cell_z"}};
template <> inline constexpr About about<BoxTest>{ray, {"box"}};
template <> inline constexpr About about<RayPlane>{ray, {"facet"}};
template <> inline constexpr About about<RayHit>{ray, {"facet"}};
template <> inline constexpr About about<RayEnd>{nothing, {"ray"}};

template <> inline constexpr About about<CurveBegin>{nothing, {"row", "across"}};
template <> inline constexpr About about<CurveSegment>{curve, {"vertex_0", "vertex_1"}};
template <> inline constexpr About about<HorizonTest>{curve, {"x"}};
template <> inline constexpr About about<HorizonMove>{curve, {"x", "upper"}};
template <> inline constexpr About about<HorizonCross>{curve, {"upper"}};
template <> inline constexpr About about<LineBegin>{nothing, {"vertex_0", "vertex_1"}, true};
template <> inline constexpr About about<LineAgainst>{nothing, {"line", "facet"}};
template <> inline constexpr About about<LineCross>{nothing, {"line", "facet"}};
template <> inline constexpr About about<LineHide>{nothing, {"line", "facet"}};
template <> inline constexpr About about<LinePiece>{nothing, {"line"}};
// clang-format on

/// What a run numbers for itself.
enum class Thing : std::uint8_t { none, vertex, edge, piece, node, area, box, ray, curve, line, count };

/// The thing that a field of this name refers to; none where the field is a number like any other, or one of the
/// scene's polygons and facets, which have one number for all.
constexpr Thing thing_of(std::string_view field) {
  if (field.starts_with("vertex")) return Thing::vertex;
  if (field == "edge" || field == "left_edge" || field == "right_edge") return Thing::edge;
  if (field == "piece" || field == "other" || field == "plane_of") return Thing::piece;
  if (field == "node") return Thing::node;
  if (field == "area") return Thing::area;
  if (field == "box") return Thing::box;
  if (field == "ray") return Thing::ray;
  if (field == "curve") return Thing::curve;
  if (field == "line") return Thing::line;
  return Thing::none;
}
/// The thing that a kind of event makes, with a number of its own.
template <class E>
constexpr Thing made_by() {
  if constexpr (std::is_same_v<E, ClipCross> || std::is_same_v<E, SplitVertex>) return Thing::vertex;
  else if constexpr (std::is_same_v<E, EdgeTableInsert>) return Thing::edge;
  else if constexpr (std::is_same_v<E, PieceMake>) return Thing::piece;
  else if constexpr (std::is_same_v<E, NodeMake>) return Thing::node;
  else if constexpr (std::is_same_v<E, AreaBegin>) return Thing::area;
  else if constexpr (std::is_same_v<E, BoxMake>) return Thing::box;
  else if constexpr (std::is_same_v<E, RayBegin>) return Thing::ray;
  else if constexpr (std::is_same_v<E, CurveBegin>) return Thing::curve;
  else if constexpr (std::is_same_v<E, LineBegin>) return Thing::line;
  else return Thing::none;
}

}  // namespace zstep::diff
