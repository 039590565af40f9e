// The scan-line method's sweep, as far as a block has told of it: the pieces whose flag is true, in the order in which
// they became so.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace zstep::codec {

class KnownSweep {
 public:
  void clear() { inside_.clear(); }

  std::size_t count() const { return inside_.size(); }
  /// -1 where the block has not told which it is.
  std::int32_t piece(std::size_t place) const { return inside_[place]; }
  bool is_inside(std::int32_t piece) const { return std::find(inside_.begin(), inside_.end(), piece) != inside_.end(); }

  void flip(std::int32_t piece, bool inside) {
    if (inside) {
      if (inside_.size() < most) inside_.push_back(piece);
      return;
    }
    auto gone = std::find(inside_.begin(), inside_.end(), piece);
    if (gone == inside_.end()) gone = std::find(inside_.begin(), inside_.end(), -1);
    if (gone != inside_.end()) inside_.erase(gone);
  }
  /// So many are inside: those that the block has not told of became so before the others.
  void expect(std::int32_t count) {
    const auto wanted = std::min(static_cast<std::size_t>(std::max(count, 0)), most);
    if (wanted > inside_.size()) inside_.insert(inside_.begin(), wanted - inside_.size(), -1);
    else inside_.erase(inside_.begin(), inside_.end() - static_cast<std::ptrdiff_t>(wanted));
  }
  /// The one at this place is this piece.
  void learn(std::size_t place, std::int32_t piece) {
    if (place < inside_.size()) inside_[place] = piece;
  }

 private:
  static constexpr std::size_t most = 4096;
  std::vector<std::int32_t> inside_;
};

}  // namespace zstep::codec
