// The list of pieces still to be drawn, the farthest first.
#pragma once

#include <cstdint>
#include <vector>

#include "algorithms/pieces/pieces.hpp"

namespace zstep::depth_sort {

/// Does `a` come before `b` by its farthest z? Of equal ones the later in the file comes first: it is drawn first, so
/// that the earlier one is seen, as with the Z-buffer.
bool farther(const pieces::Pieces& all, std::int32_t a, std::int32_t b);

/// Numbers of pieces in the order in which they are to be drawn. The first `moved` were moved there and are marked; the
/// others are sorted.
struct DrawingList {
  std::vector<std::int32_t> pieces;
  std::size_t moved = 0;

  /// The place among the sorted ones where a piece belongs.
  std::int32_t place_for(const pieces::Pieces& all, std::int32_t piece) const;
  void insert(std::int32_t piece, std::int32_t place);
  void remove(std::size_t place);
  /// Makes an unmarked piece the first, and marks it.
  void move_to_front(std::size_t place);
};

}  // namespace zstep::depth_sort
