// What a block has told of pieces that are held against one another, as far as it is remembered: their extents, and which came after which.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "traces/events/pieces.hpp"

namespace zstep::codec {

class KnownExtents {
 public:
  struct Range {
    double low = 0, high = 0;
  };

  /// Nothing where the block has not told of it.
  std::optional<Range> of(std::int32_t piece, Axis axis) const {
    const Entry* entry = find(piece);
    return entry != nullptr ? entry->ranges[static_cast<std::size_t>(axis)] : std::nullopt;
  }
  void learn(std::int32_t piece, Axis axis, Range range) { take(piece).ranges[static_cast<std::size_t>(axis)] = range; }

  /// The piece that came after this one when it was last told of; `piece` itself where none is known.
  std::int32_t after(std::int32_t piece) const {
    const Entry* entry = find(piece);
    return entry != nullptr ? entry->next : piece;
  }
  void learn_after(std::int32_t piece, std::int32_t next) { take(piece).next = next; }

  void clear() { entries_.clear(), index_.clear(); }

 private:
  static constexpr std::size_t most = 4096, places = 2 * most;  // more pieces are not remembered
  struct Entry {
    std::int32_t piece = -1, next = -1;
    std::array<std::optional<Range>, 3> ranges{};
  };

  /// Where the index names this piece, or has room for it: an open hash table.
  std::size_t place_of(std::int32_t piece) const {
    std::size_t place = (static_cast<std::uint32_t>(piece) * 0x9e3779b1u) >> 19;  // of 8192
    while (index_[place] != 0 && entries_[index_[place] - 1u].piece != piece) place = (place + 1) % places;
    return place;
  }
  const Entry* find(std::int32_t piece) const {
    if (entries_.empty()) return nullptr;
    const std::size_t place = place_of(piece);
    return index_[place] != 0 ? &entries_[index_[place] - 1u] : nullptr;
  }
  Entry& take(std::int32_t piece) {
    if (index_.empty()) index_.resize(places);
    const std::size_t place = place_of(piece);
    if (index_[place] != 0) return entries_[index_[place] - 1u];
    if (entries_.size() == most) return beyond_ = {piece, piece, {}};
    entries_.push_back({piece, piece, {}});
    index_[place] = static_cast<std::uint16_t>(entries_.size());
    return entries_.back();
  }

  std::vector<Entry> entries_;        ///< in the order in which they were told of
  std::vector<std::uint16_t> index_;  ///< numbers of entries, from 1; 0 is none
  Entry beyond_;                      ///< one that is forgotten at once
};

}  // namespace zstep::codec
