// Events from others are hostile until checked: do their numbers lie within their scene?
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "traces/events/vocabulary.hpp"
#include "traces/scene.hpp"

namespace zstep {

/// The most vertices that clipping one facet can make and the most edges a table can hold are bounded by the scene's
/// size; what lies beyond these bounds cannot come from a run on this scene.
class EventCheck {
 public:
  explicit EventCheck(const Scene& scene);

  /// Empty when all is well; else what is wrong ("column 900 lies outside the raster").
  template <class E>
  std::string operator()(const E& event);
  /// Of which field that was; empty where it is not one field's.
  std::string_view field() const { return field_; }

 private:
  std::int32_t width_, height_, polygons_, facets_, vertices_, edges_;
  std::int64_t clears_left_;  ///< a clear costs as much as the raster is large; one check is for one block
  std::string_view field_;
};

/// The limits of vertex and edge numbers for a scene.
std::int32_t vertex_limit(const Scene& scene);
std::int32_t edge_limit(const Scene& scene);

}  // namespace zstep
