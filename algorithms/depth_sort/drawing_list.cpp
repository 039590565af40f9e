#include "algorithms/depth_sort/drawing_list.hpp"

#include <algorithm>

namespace zstep::depth_sort {

namespace {

std::ptrdiff_t offset(std::size_t place) { return static_cast<std::ptrdiff_t>(place); }

}  // namespace

bool farther(const pieces::Pieces& all, std::int32_t a, std::int32_t b) {
  const pieces::Piece &one = all[a], &other = all[b];
  if (one.high.z != other.high.z) return one.high.z > other.high.z;
  return one.polygon != other.polygon ? one.polygon > other.polygon : a > b;
}

std::int32_t DrawingList::place_for(const pieces::Pieces& all, std::int32_t piece) const {
  const auto place = std::lower_bound(pieces.begin() + offset(moved), pieces.end(), piece,
                                      [&](std::int32_t a, std::int32_t b) { return farther(all, a, b); });
  return static_cast<std::int32_t>(place - pieces.begin());
}

void DrawingList::insert(std::int32_t piece, std::int32_t place) { pieces.insert(pieces.begin() + place, piece); }

void DrawingList::remove(std::size_t place) {
  pieces.erase(pieces.begin() + offset(place));
  if (place < moved) --moved;
}

void DrawingList::move_to_front(std::size_t place) {
  std::rotate(pieces.begin(), pieces.begin() + offset(place), pieces.begin() + offset(place) + 1);
  ++moved;
}

}  // namespace zstep::depth_sort
