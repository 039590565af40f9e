#include "sim/answers/facets_near.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "traces/codec/scene_geometry.hpp"

namespace zstep::answers {

namespace {

constexpr double side = 16;   // pixels
constexpr double margin = 1;  // by which a facet may reach farther than its corners say

struct Squares {
  std::int32_t left = 0, right = -1, top = 0, bottom = -1;  // both ends included; none when right < left
};

std::vector<bool> begun_polygons(const Trace& trace) {
  // Rays come to no polygon; and what is dropped without its work beginning is in the list of rejects.
  if (trace.polygons().empty() || trace.has(kind_of<RayBegin>) || trace.has(kind_of<PolygonReject>)) return {};
  std::vector<bool> begun(trace.scene().polygons.size(), false);
  for (const PolygonMark& mark : trace.polygons()) begun[static_cast<std::size_t>(mark.polygon)] = true;
  const bool all = std::find(begun.begin(), begun.end(), false) == begun.end();
  return all ? std::vector<bool>{} : begun;
}

}  // namespace

FacetsNear::FacetsNear(const Trace& trace) : begun_(begun_polygons(trace)) {
  const Scene& scene = trace.scene();
  const codec::SceneGeometry facts(scene, trace.header());
  squares_across_ = static_cast<std::int32_t>(std::ceil(scene.raster.width / side));
  const auto squares_down = static_cast<std::int32_t>(std::ceil(scene.raster.height / side));
  const double nearest = scene.camera.near;

  const auto square = [](double at, std::int32_t count) {
    return static_cast<std::int32_t>(std::floor(std::clamp(at / side, -1.0, count + 1.0)));
  };
  std::vector<Squares> of_facet(scene.facets.size());
  for (std::size_t i = 0; i < scene.facets.size(); ++i) {
    double left = 1e300, right = -1e300, top = 1e300, bottom = -1e300;
    bool before_eye = true;
    for (const std::int32_t corner : facts.corners(static_cast<std::int32_t>(i))) {
      const codec::VertexGeometry& vertex = facts.of_point(corner);
      before_eye = before_eye && (!facts.viewed() || vertex.view.z >= nearest) && std::isfinite(vertex.raster.x) &&
                   std::isfinite(vertex.raster.y);
      left = std::min(left, vertex.raster.x), right = std::max(right, vertex.raster.x);
      top = std::min(top, vertex.raster.y), bottom = std::max(bottom, vertex.raster.y);
    }
    if (!before_eye) {
      anywhere_.push_back(static_cast<std::int32_t>(i));
      continue;
    }
    Squares& squares = of_facet[i];
    squares.left = std::max(0, square(left - margin, squares_across_)),
    squares.right = std::min(squares_across_ - 1, square(right + margin, squares_across_));
    squares.top = std::max(0, square(top - margin, squares_down)),
    squares.bottom = std::min(squares_down - 1, square(bottom + margin, squares_down));
  }

  first_.assign(static_cast<std::size_t>(squares_across_) * static_cast<std::size_t>(squares_down) + 1, 0);
  const auto for_each_square = [&](const Squares& squares, const auto& each) {
    for (std::int32_t row = squares.top; row <= squares.bottom; ++row)
      for (std::int32_t column = squares.left; column <= squares.right; ++column)
        each(static_cast<std::size_t>(row * squares_across_ + column));
  };
  for (const Squares& squares : of_facet) for_each_square(squares, [&](std::size_t at) { ++first_[at + 1]; });
  for (std::size_t at = 1; at < first_.size(); ++at) first_[at] += first_[at - 1];
  facets_.resize(first_.back());
  std::vector<std::size_t> next = first_;
  for (std::size_t i = 0; i < of_facet.size(); ++i)
    for_each_square(of_facet[i], [&](std::size_t at) { facets_[next[at]++] = static_cast<std::int32_t>(i); });
}

std::vector<std::int32_t> FacetsNear::near(Trace::Pixel pixel) const {
  const auto column = static_cast<std::int32_t>(pixel.x / static_cast<std::int32_t>(side)),
             row = static_cast<std::int32_t>(pixel.y / static_cast<std::int32_t>(side));
  std::vector<std::int32_t> found;
  const auto at = static_cast<std::size_t>(row * squares_across_ + column);
  if (pixel.x < 0 || pixel.y < 0 || column >= squares_across_ || at + 1 >= first_.size()) return found;
  std::merge(facets_.begin() + static_cast<std::ptrdiff_t>(first_[at]),
             facets_.begin() + static_cast<std::ptrdiff_t>(first_[at + 1]), anywhere_.begin(), anywhere_.end(),
             std::back_inserter(found));
  return found;
}

}  // namespace zstep::answers
