// What the link of a step is called.
#include "sim/answers/origin/work.hpp"

namespace zstep::answers {
namespace {

struct Name {
  const Work& work;

  std::string edge(std::int32_t number) const { return fmt::format("edge e{}", number); }
  std::string facet(std::int32_t number) const {
    const auto at = static_cast<std::size_t>(number);
    return number >= 0 && at < work.scene.facets.size() ? work.label(work.scene.facets[at].polygon)
                                                        : fmt::format("facet {}", number);
  }

  std::string operator()(const ViewTransform& e) const {
    return fmt::format("vertex {}, viewed", work.vertex_name(e.vertex));
  }
  std::string operator()(const Projection& e) const {
    return fmt::format("vertex {}, projected", work.vertex_name(e.vertex));
  }
  std::string operator()(const ViewportTransform& e) const {
    return fmt::format("vertex {} on the raster", work.vertex_name(e.vertex));
  }
  std::string operator()(const ClipCross& e) const {
    return fmt::format("vertex {}, made where the edge from {} to {} is clipped", e.vertex,
                       work.vertex_name(e.vertex_inside), work.vertex_name(e.vertex_outside));
  }
  std::string operator()(const SplitVertex& e) const {
    return fmt::format("vertex {}, made where the edge from {} to {} is cut", e.vertex, work.vertex_name(e.vertex_0),
                       work.vertex_name(e.vertex_1));
  }
  std::string operator()(const EdgeTableInsert& e) const {
    return fmt::format("{} in the edge table, from vertex {} to vertex {}", edge(e.edge), work.vertex_name(e.vertex_0),
                       work.vertex_name(e.vertex_1));
  }
  std::string operator()(const EdgeStep& e) const {
    const auto line = work.machine().scan_line;
    return line ? fmt::format("active {} on scan line {}", edge(e.edge), *line) : "active " + edge(e.edge);
  }
  std::string operator()(const PlaneSlopes& e) const {
    return fmt::format("slopes of the plane of {}", work.label(e.polygon));
  }
  std::string operator()(const SpanBegin& e) const {
    return fmt::format("span of scan line {} from {} to {}", e.y, edge(e.left_edge), edge(e.right_edge));
  }
  std::string operator()(const DepthInterpolate& e) const { return fmt::format("depth at x = {} on the span", e.x); }
  std::string operator()(const DepthCompare& e) const { return fmt::format("compare at pixel ({}, {})", e.x, e.y); }
  std::string operator()(const DepthWrite& e) const { return fmt::format("depth written at pixel ({}, {})", e.x, e.y); }
  std::string operator()(const PixelPaint& e) const {
    return fmt::format("pixel ({}, {}) painted with {}", e.x, e.y, work.label(e.polygon));
  }
  std::string operator()(const PlaneEquation& e) const { return fmt::format("plane of {}", work.piece(e.piece)); }
  std::string operator()(const Extent& e) const { return fmt::format("extents of {}", work.piece(e.piece)); }
  std::string operator()(const PlaneDepth& e) const {
    return fmt::format("depth of the plane of {}", work.piece(e.piece));
  }
  std::string operator()(const ImpliedEdge& e) const {
    return fmt::format("implied edge of {} and {}", work.piece(e.piece), work.piece(e.other));
  }
  std::string operator()(const VertexSide& e) const {
    return fmt::format("vertex {} against the plane of {}", work.vertex_name(e.vertex), work.piece(e.plane_of));
  }
  std::string operator()(const SideTest& e) const {
    return fmt::format("{} against the plane of {}", work.piece(e.piece), work.piece(e.plane_of));
  }
  std::string operator()(const ExtentTest& e) const {
    return fmt::format("{} extents of {} and {}", words_of<Axis>[static_cast<std::size_t>(e.axis)], work.piece(e.piece),
                       work.piece(e.other));
  }
  std::string operator()(const EyeSide& e) const { return fmt::format("the eye against the plane of node {}", e.node); }
  std::string operator()(const SpanFlags& e) const { return fmt::format("interval of scan line {}", e.y); }
  std::string operator()(const AreaBegin& e) const { return fmt::format("area {}", e.area); }
  std::string operator()(const BoxMake& e) const { return fmt::format("box {}", e.box); }
  std::string operator()(const BoxTest& e) const { return fmt::format("the ray against box {}", e.box); }
  std::string operator()(const CellVisit& e) const {
    return fmt::format("the ray in cell ({}, {}, {})", e.cell_x, e.cell_y, e.cell_z);
  }
  std::string operator()(const RayBegin& e) const {
    return fmt::format("{} ray {} of pixel ({}, {})", words_of<RayRole>[static_cast<std::size_t>(e.role)], e.ray, e.x,
                       e.y);
  }
  std::string operator()(const RayPlane& e) const {
    return fmt::format("the ray against the plane of {}", facet(e.facet));
  }
  std::string operator()(const RayHit& e) const { return fmt::format("the point on the plane of {}", facet(e.facet)); }
  std::string operator()(const RayEnd& e) const { return fmt::format("ray {} ends", e.ray); }
  std::string operator()(const HorizonTest& e) const { return fmt::format("the curve at column {}", e.x); }
  std::string operator()(const HorizonMove& e) const {
    return fmt::format("{} horizon of column {} moves", e.upper ? "upper" : "lower", e.x);
  }
  std::string operator()(const LineCross& e) const { return fmt::format("line {} crosses {}", e.line, facet(e.facet)); }
  std::string operator()(const LineHide& e) const {
    return fmt::format("line {} is hidden by {}", e.line, facet(e.facet));
  }
  std::string operator()(const LinePiece& e) const { return fmt::format("a piece of line {}", e.line); }
  std::string operator()(const ShadowCompare& e) const {
    return fmt::format("pixel ({}, {}) as the light sees it", e.x, e.y);
  }
  template <class E>
  std::string operator()(const E&) const {
    return std::string(kind_text<E>.meaning);
  }
};

}  // namespace

std::string what_happens(const Work& work, const Event& event) { return visit_event(Name{work}, event); }

}  // namespace zstep::answers
