#include "traces/events/called.hpp"

#include <algorithm>
#include <array>
#include <utility>

#include "traces/events/vocabulary.hpp"

namespace zstep {

std::string_view called(std::size_t kind) {
  static constexpr auto names = [] {
    std::array<std::string_view, kind_count> all;
    for_each_kind([&]<class E>() { all[kind_of<E>] = kind_text<E>.meaning; });
    constexpr std::pair<std::uint8_t, std::string_view> own[] = {
        {kind_of<ViewTransform>, "vertex {vertex}, viewed"},
        {kind_of<Projection>, "vertex {vertex}, projected"},
        {kind_of<ViewportTransform>, "vertex {vertex} on the raster"},
        {kind_of<ClipCross>, "vertex {vertex}, made where the edge from {vertex_inside} to {vertex_outside} is clipped"},
        {kind_of<SplitVertex>, "vertex {vertex}, made where the edge from {vertex_0} to {vertex_1} is cut"},
        {kind_of<EdgeTableInsert>, "edge {edge} in the edge table, from vertex {vertex_0} to vertex {vertex_1}"},
        {kind_of<EdgeStep>, "active edge {edge} on scan line {scan_line}"},
        {kind_of<PlaneSlopes>, "slopes of the plane of {polygon}"},
        {kind_of<SpanBegin>, "span of scan line {y} from edge {left_edge} to edge {right_edge}"},
        {kind_of<DepthInterpolate>, "depth at x = {x} on the span"},
        {kind_of<DepthCompare>, "compare at pixel ({x}, {y})"},
        {kind_of<DepthWrite>, "depth written at pixel ({x}, {y})"},
        {kind_of<AttributeInterpolate>, "attribute at pixel ({x}, {y})"},
        {kind_of<PixelPaint>, "pixel ({x}, {y}) painted with {polygon}"},
        {kind_of<PlaneEquation>, "plane of {piece}"},
        {kind_of<Extent>, "extents of {piece}"},
        {kind_of<PlaneDepth>, "depth of the plane of {piece}"},
        {kind_of<ImpliedEdge>, "implied edge of {piece} and {other}"},
        {kind_of<VertexSide>, "vertex {vertex} against the plane of {plane_of}"},
        {kind_of<SideTest>, "{piece} against the plane of {plane_of}"},
        {kind_of<ExtentTest>, "{axis} extents of {piece} and {other}"},
        {kind_of<EyeSide>, "the eye against the plane of node {node}"},
        {kind_of<SpanFlags>, "interval of scan line {y}"},
        {kind_of<AreaBegin>, "area {area}"},
        {kind_of<BoxMake>, "box {box}"},
        {kind_of<BoxTest>, "the ray against box {box}"},
        {kind_of<CellVisit>, "the ray in cell ({cell_x}, {cell_y}, {cell_z})"},
        {kind_of<RayBegin>, "{role} ray {ray} of pixel ({x}, {y})"},
        {kind_of<RayPlane>, "the ray against the plane of {facet}"},
        {kind_of<RayHit>, "the point on the plane of {facet}"},
        {kind_of<RayEnd>, "ray {ray} ends"},
        {kind_of<HorizonTest>, "the curve at column {x}"},
        {kind_of<HorizonMove>, "{upper} horizon of column {x} moves"},
        {kind_of<LineCross>, "line {line} crosses {facet}"},
        {kind_of<LineHide>, "line {line} is hidden by {facet}"},
        {kind_of<LinePiece>, "a piece of line {line}"},
        {kind_of<ShadowCompare>, "pixel ({x}, {y}) as the light sees it"},
    };
    for (const auto& [number, name] : own) all[number] = name;
    return all;
  }();
  return names[kind];
}

std::string_view gives_around(std::size_t kind) {
  return kind == kind_of<AreaDecide>   ? "in the area around it"
         : kind == kind_of<SpanWinner> ? "on the interval of the scan line around it"
                                       : "";
}

bool after_polygons(std::size_t kind) {
  constexpr std::array all{kind_of<VertexSide>, kind_of<SideTest>, kind_of<RootCandidate>, kind_of<NodeMake>,
                           kind_of<ListInsert>, kind_of<PairBegin>, kind_of<AreaBegin>, kind_of<BoxMake>,
                           kind_of<GridMake>, kind_of<RayBegin>, kind_of<CurveBegin>, kind_of<LineBegin>};
  return std::find(all.begin(), all.end(), kind) != all.end();
}

}  // namespace zstep
