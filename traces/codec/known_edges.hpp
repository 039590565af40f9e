// The edge table and the active edge list, as far as the events of a block have told them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "traces/codec/scene_geometry.hpp"

namespace zstep::codec {

struct KnownEdge : EdgeLine {
  std::int32_t first_row = 0, end_row = 0;
  double x = 0, z = 0;  ///< where it met the last scan line that told of it
  double dx_dy = 0, dz_dy = 0;
  bool entered = false;
};

class KnownEdges {
 public:
  /// The table is empty, and the list.
  void clear();

  /// An edge of the table; nullptr when this block has not told of it.
  const KnownEdge* at(std::int32_t number) const {
    const std::int64_t place = std::int64_t{number} - base_;
    return place >= 0 && place < static_cast<std::int64_t>(edges_.size()) ? &edges_[static_cast<std::size_t>(place)]
                                                                          : nullptr;
  }
  KnownEdge* at(std::int32_t number) { return const_cast<KnownEdge*>(std::as_const(*this).at(number)); }
  void insert(std::int32_t number, const KnownEdge& edge);
  /// The number that the next edge will have if the table goes on as it does.
  std::int32_t next_number() const;
  /// The smallest first row of the edges in the table; -1 when there are none.
  std::int32_t first_row() const { return edges_.empty() ? -1 : first_row_; }

  /// The first two active edges; nullptr where the block has not told of both.
  std::pair<const KnownEdge*, const KnownEdge*> first_two() const {
    if (active_.size() < 2) return {};
    const KnownEdge *one = at(active_[0]), *other = at(active_[1]);
    return one != nullptr && other != nullptr ? std::pair{one, other} : std::pair<const KnownEdge*, const KnownEdge*>{};
  }
  std::int32_t number(const KnownEdge& edge) const { return base_ + static_cast<std::int32_t>(&edge - edges_.data()); }

  void begin_row();

  // --- Which edge an event will be about; -1 when that is not known.
  std::int32_t to_enter(std::int32_t row) const;
  std::int32_t place_for(const KnownEdge& edge) const;  ///< by x and then by slope
  std::int32_t to_retire(std::int32_t row) const;
  std::int32_t to_step() const { return active_at(step_); }
  std::int32_t to_begin_span(std::size_t side) const { return active_at(span_ + side); }

  // --- What events do
  void enter(std::int32_t number, std::int32_t place);
  void retire(std::int32_t number);
  void step() { ++step_; }
  void swap(std::int32_t place);
  void span() { span_ += 2; }

 private:
  std::int32_t active_at(std::size_t place) const { return place < active_.size() ? active_[place] : -1; }

  std::int32_t base_ = 0;  ///< the number of the first edge in the table
  std::vector<KnownEdge> edges_;
  std::int32_t first_row_ = 0;
  std::vector<std::int32_t> active_;
  std::size_t step_ = 0, span_ = 0, retire_ = 0;  ///< places in the list that come next
  std::size_t enter_ = 0;                         ///< place in the table after the edge that entered last
};

}  // namespace zstep::codec
