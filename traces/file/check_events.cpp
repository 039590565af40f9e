#include "traces/file/check_events.hpp"

#include <algorithm>
#include <string_view>

#include <fmt/format.h>

#include "traces/events/registers.hpp"

namespace zstep {

namespace {

// Clipping against six planes adds at most two vertices a crossing edge and plane; a generous multiple of that.
constexpr std::int64_t spare_vertices = 1 << 16;

std::int32_t limited(std::size_t size) {
  return static_cast<std::int32_t>(std::min<std::size_t>(size, INT32_MAX - spare_vertices));
}

}  // namespace

std::int32_t vertex_limit(const Scene& scene) {
  const std::int64_t limit = static_cast<std::int64_t>(limited(scene.points.size())) +
                             16 * static_cast<std::int64_t>(limited(scene.corners.size())) + spare_vertices;
  return static_cast<std::int32_t>(std::min<std::int64_t>(limit, INT32_MAX));
}

std::int32_t edge_limit(const Scene& scene) { return vertex_limit(scene); }

EventCheck::EventCheck(const Scene& scene)
    : width_(scene.raster.width),
      height_(scene.raster.height),
      polygons_(limited(scene.polygons.size())),
      facets_(limited(scene.facets.size())),
      vertices_(vertex_limit(scene)),
      edges_(edge_limit(scene)) {}

template <class E>
std::string EventCheck::operator()(const E& event) const {
  std::string fault;
  const auto below = [&](std::string_view what, std::int32_t value, std::int32_t limit) {
    if (value < 0 || value >= limit) fault = fmt::format("{} {} does not exist (there are {})", what, value, limit);
  };
  for_each_index<E>([&]<std::size_t I>() {
    if constexpr (std::is_same_v<FieldValue<E, I>, std::int32_t>) {
      constexpr std::string_view name = field_at<E, I>.name;
      const std::int32_t value = event.*field_at<E, I>.member;
      if constexpr (name == "polygon") below("polygon", value, polygons_);
      else if constexpr (name == "facet") below("facet", value, facets_);
      else if constexpr (name.substr(0, 6) == "vertex") below("vertex", value, vertices_);
      else if constexpr (name == "edge" || name == "left_edge" || name == "right_edge") below("edge", value, edges_);
      else if constexpr (name == "place") below("place", value, edges_);
      else if constexpr (name == "x") below("column", value, width_);
      else if constexpr (name == "y") below("row", value, height_);
    }
  });
  return fault;
}

#define ZSTEP_INSTANTIATE(E) template std::string EventCheck::operator()<E>(const E&) const;
ZSTEP_INSTANTIATE(BuffersClear)
ZSTEP_INSTANTIATE(ViewTransform) ZSTEP_INSTANTIATE(Projection) ZSTEP_INSTANTIATE(ViewportTransform)
    ZSTEP_INSTANTIATE(PolygonBegin) ZSTEP_INSTANTIATE(FacingTest) ZSTEP_INSTANTIATE(PolygonReject)
        ZSTEP_INSTANTIATE(ClipTest) ZSTEP_INSTANTIATE(ClipVertex) ZSTEP_INSTANTIATE(ClipCross)
            ZSTEP_INSTANTIATE(OutlineVertex) ZSTEP_INSTANTIATE(EdgeTableInsert) ZSTEP_INSTANTIATE(EdgeTableSkip)
                ZSTEP_INSTANTIATE(ScanLineBegin) ZSTEP_INSTANTIATE(EdgeEnter) ZSTEP_INSTANTIATE(EdgeRetire)
                    ZSTEP_INSTANTIATE(EdgeStep) ZSTEP_INSTANTIATE(EdgeSwap) ZSTEP_INSTANTIATE(SpanBegin)
                        ZSTEP_INSTANTIATE(DepthInterpolate) ZSTEP_INSTANTIATE(DepthCompare)
                            ZSTEP_INSTANTIATE(DepthWrite) ZSTEP_INSTANTIATE(PixelWrite)
#undef ZSTEP_INSTANTIATE

}  // namespace zstep
