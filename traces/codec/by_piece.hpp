// What a block has told of pieces by their numbers, as far as it is remembered.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace zstep::codec {

/// A Value for each piece that was told of: an open hash table.
template <class Value>
class ByPiece {
 public:
  /// nullptr where the block has not told of the piece.
  const Value* find(std::int32_t piece) const {
    if (entries_.empty()) return nullptr;
    const std::size_t place = place_of(piece);
    return index_[place] != 0 ? &entries_[index_[place] - 1u].value : nullptr;
  }
  /// Makes room for a piece, unless so many are remembered that no more will be.
  Value& take(std::int32_t piece) {
    if (index_.empty()) index_.resize(places);
    const std::size_t place = place_of(piece);
    if (index_[place] != 0) return entries_[index_[place] - 1u].value;
    if (entries_.size() == most) return beyond_ = Value{};
    entries_.push_back({piece, Value{}});
    index_[place] = static_cast<std::uint16_t>(entries_.size());
    return entries_.back().value;
  }
  void clear() {
    if (!entries_.empty()) entries_.clear(), index_.clear();
  }

 private:
  static constexpr std::size_t most = 4096, places = 2 * most;
  struct Entry {
    std::int32_t piece;
    Value value;
  };

  /// Where the index names this piece, or has room for it.
  std::size_t place_of(std::int32_t piece) const {
    std::size_t place = (static_cast<std::uint32_t>(piece) * 0x9e3779b1u) >> 19;  // of 8192
    while (index_[place] != 0 && entries_[index_[place] - 1u].piece != piece) place = (place + 1) % places;
    return place;
  }

  std::vector<Entry> entries_;        ///< in the order in which they were told of
  std::vector<std::uint16_t> index_;  ///< numbers of entries, from 1; 0 is none
  Value beyond_{};                    ///< one that is forgotten at once
};

}  // namespace zstep::codec
