// Warnock's areas, as far as a block has told of them: which pieces an area will be asked about, and in which order.
// The quarters of an area are asked about the same pieces: those that surround it, and then those that lie in it
// partly.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "traces/events/areas.hpp"

namespace zstep::codec {

class KnownAreas {
 public:
  void clear() {
    around_.clear();
    told_whole_ = false;
    forget_bins();
  }

  /// The area at work; false where the block has not told of its beginning.
  bool at_work() const { return told_whole_; }
  const AreaBegin& area() const { return area_; }
  /// The piece whose bin will be told next; -1 where that is not known.
  std::int32_t next_piece() const {
    const bool known = told_whole_ && asked_.size() < around_.back().pieces.size();
    return known ? around_.back().pieces[asked_.size()] : -1;
  }
  /// Is it one that surrounded the area around this one already?
  bool surrounded_before() const { return told_whole_ && asked_.size() < around_.back().surrounding; }
  /// Those of the area at work that are not disjoint from it, in the order in which their depths are compared.
  std::size_t piece_count() const { return surrounding_.size() + partly_.size(); }
  std::int32_t piece(std::size_t place) const {
    return place < surrounding_.size() ? surrounding_[place] : partly_[place - surrounding_.size()];
  }

  void begin(const AreaBegin& event) {
    while (!around_.empty() && around_.back().area != event.parent) around_.pop_back();
    if (around_.empty()) around_.push_back({event.parent, 0, {}});
    area_ = event;
    told_whole_ = true;
    forget_bins();
  }
  void bin(const AreaBin& event) {
    asked_.push_back(event.piece);
    if (event.bin == Bin::surrounding) surrounding_.push_back(event.piece);
    else if (event.bin != Bin::disjoint) partly_.push_back(event.piece);
    if (surrounding_.size() == asked_.size()) ++leading_;
  }
  void decide() {
    if (!told_whole_) return;
    told_whole_ = false;
    // What the area around it was is told by its first quarter.
    if (Area& parent = around_.back(); parent.pieces.empty()) parent = {parent.area, leading_, asked_};
    Area decided{area_.area, surrounding_.size(), std::move(surrounding_)};
    decided.pieces.insert(decided.pieces.end(), partly_.begin(), partly_.end());
    around_.push_back(std::move(decided));
    forget_bins();
  }

 private:
  struct Area {
    std::int32_t area;
    std::size_t surrounding;           ///< how many of them surround it
    std::vector<std::int32_t> pieces;  ///< that its quarters are asked about
  };
  void forget_bins() { asked_.clear(), surrounding_.clear(), partly_.clear(), leading_ = 0; }

  std::vector<Area> around_;  ///< the area at work, from the outermost inwards, and maybe one beside it
  AreaBegin area_{};
  bool told_whole_ = false;
  std::vector<std::int32_t> asked_, surrounding_, partly_;  ///< of the area at work
  std::size_t leading_ = 0;                                 ///< that were found to surround it before any that does not
};

}  // namespace zstep::codec
