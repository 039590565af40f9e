// What the link of a step is called.
#include <utility>

#include "sim/answers/origin/fields.hpp"
#include "sim/answers/origin/work.hpp"

namespace zstep::answers {
namespace {

/// By kind; {field} stands for what a field names. Other kinds are called what the vocabulary says.
constexpr std::pair<std::uint8_t, std::string_view> names[] = {
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

std::string named(const Work& work, const Event& event, std::string_view field) {
  if (field == "scan_line") return fmt::format("{}", work.machine().scan_line.value_or(0));
  const auto number = static_cast<std::int32_t>(field_number(event, field).value_or(0));
  if (field.starts_with("vertex")) return work.vertex_name(number);
  if (field.ends_with("edge")) return fmt::format("e{}", number);
  if (field == "piece" || field == "other" || field == "plane_of") return work.piece(number);
  if (field == "polygon") return work.label(number);
  if (field == "upper") return number != 0 ? "upper" : "lower";
  const auto facet = static_cast<std::size_t>(number);
  if (field == "facet" && facet < work.scene.facets.size()) return work.label(work.scene.facets[facet].polygon);
  if (field == "facet") return fmt::format("facet {}", number);
  const std::string word = field_word(event, field);
  return word.empty() ? fmt::format("{}", number) : word;
}

}  // namespace

std::string what_happens(const Work& work, const Event& event) {
  for (const auto& [kind, pattern] : names) {
    if (kind != event.index()) continue;
    std::string text;
    std::size_t from = 0;
    for (std::size_t open = pattern.find('{'); open != pattern.npos; open = pattern.find('{', from)) {
      const std::size_t close = pattern.find('}', open);
      text.append(pattern.substr(from, open - from));
      text += named(work, event, pattern.substr(open + 1, close - open - 1));
      from = close + 1;
    }
    return text.append(pattern.substr(from));
  }
  return visit_event([]<class E>(const E&) { return std::string(kind_text<E>.meaning); }, event);
}

}  // namespace zstep::answers
