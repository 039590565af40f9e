#include "traces/file/check_events.hpp"

#include <algorithm>
#include <string_view>

#include <fmt/format.h>

#include "traces/events/slots.hpp"

namespace zstep {

namespace {

// Clipping a facet of n corners against one plane makes at most n vertices, and there are six planes.
constexpr std::int64_t clip_factor = 8, spare = 64;

// Cutting makes vertices, too; how many depends on the scene. A replay asks for them one by one, so this only bounds.
constexpr std::int32_t cut_vertices = 1 << 26;

constexpr std::int64_t clear_budget = std::int64_t{1} << 31;  // pixels a block may clear

// Scenes are held to traces/scene.hpp, so these fit.
std::int32_t count_of(std::size_t size) { return static_cast<std::int32_t>(size); }

}  // namespace

std::int32_t vertex_limit(const Scene& scene) {
  return count_of(scene.points.size()) + edge_limit(scene) + cut_vertices;
}

std::int32_t edge_limit(const Scene& scene) {
  return static_cast<std::int32_t>(clip_factor * std::ssize(scene.corners) + spare);
}

EventCheck::EventCheck(const Scene& scene)
    : width_(scene.raster.width),
      height_(scene.raster.height),
      polygons_(count_of(scene.polygons.size())),
      facets_(count_of(scene.facets.size())),
      vertices_(vertex_limit(scene)),
      edges_(edge_limit(scene)),
      clears_left_(clear_budget / (std::int64_t{width_} * height_)) {}

template <class E>
std::string EventCheck::operator()(const E& event) {
  std::string fault;
  if constexpr (std::is_same_v<E, BuffersClear>) {
    if (clears_left_-- <= 0) return "the buffers are cleared too often";
  }
  const auto within = [&](std::string_view what, std::int32_t value, std::int32_t least, std::int32_t most) {
    if (value < least || value > most) fault = fmt::format("{} {} lies outside the raster", what, value);
  };
  const auto below = [&](std::string_view what, std::int32_t value, std::int32_t limit) {
    if (value < 0 || value >= limit) fault = fmt::format("{} {} does not exist (there are {})", what, value, limit);
  };
  const auto below_or_none = [&](std::string_view what, std::int32_t value, std::int32_t limit) {
    if (value != -1) below(what, value, limit);
  };
  for_each_index<E>([&]<std::size_t I>() {
    if constexpr (constexpr Bound bound = field_at<E, I>.bound; bound != Bound::none) {
      const std::int32_t value = event.*field_at<E, I>.member;
      const bool well = fault.empty();
      switch (bound) {
        case Bound::polygon:
          below("polygon", value, polygons_);
          break;
        case Bound::polygon_or_none:
          below_or_none("polygon", value, polygons_);
          break;
        case Bound::facet:
          below("facet", value, facets_);
          break;
        case Bound::facet_or_none:
          below_or_none("facet", value, facets_);
          break;
        case Bound::vertex:
          below("vertex", value, vertices_);
          break;
        case Bound::edge:
          below("edge", value, edges_);
          break;
        case Bound::column:
          within("column", value, 0, width_ - 1);
          break;
        case Bound::row:
          within("row", value, 0, height_ - 1);
          break;
        case Bound::span_end:
          within("column", value, -2, width_);
          break;
        case Bound::column_or_end:
          within("column", value, 0, width_);
          break;
        case Bound::row_or_end:
          within("row", value, 0, height_);
          break;
        case Bound::shade:
          below("shade", value, 256);
          break;
        case Bound::none:
          break;
      }
      if (well && !fault.empty()) field_ = field_at<E, I>.name;
    }
  });
  return fault;
}

#define ZSTEP_INSTANTIATE(E) template std::string EventCheck::operator()<E>(const E&);
ZSTEP_EVERY_KIND(ZSTEP_INSTANTIATE)
#undef ZSTEP_INSTANTIATE

}  // namespace zstep
