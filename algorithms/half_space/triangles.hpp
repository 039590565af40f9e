// An outline on the raster as triangles.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "algorithms/scene/builder.hpp"
#include "algorithms/viewing/clip.hpp"

namespace zstep::half_space {

using Corners = std::array<std::int32_t, 3>;

class Triangulation {
 public:
  /// Indices of vertices, three by three: a fan where the outline is convex, else its ears. No vertex is added.
  const std::vector<Corners>& cut(const clipping::Outline& outline, const viewing::Vertices& vertices);
  /// May a pixel lie in several of them, or in none though it is covered by some? Only where the outline is not convex.
  bool may_overlap() const { return !convex_; }

 private:
  bool convex_ = true;
  scene::EarClipper clipper_;
  std::vector<Corners> triangles_;
};

}  // namespace zstep::half_space
