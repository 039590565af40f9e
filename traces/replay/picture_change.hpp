// The pixels in which one picture differs from another of the same size, in few bytes.
#pragma once

#include <cstddef>
#include <span>

#include "traces/file/bytes.hpp"
#include "traces/scene.hpp"

namespace zstep {

/// Intervales of changed pixels that show one polygon: how many pixels come between, how many there are, the polygon,
/// and of each depth how far it is from where the two before it lead. Along a span that is next to nothing, and a byte
/// does.
class PictureChange {
 public:
  PictureChange() = default;
  /// `before`: nullptr for a picture that nothing was drawn to, whose depths are all `empty_depth`.
  PictureChange(const Picture* before, const Picture& after, double empty_depth = no_depth);
  /// Makes of the one picture the other.
  void apply_to(Picture& picture) const;
  std::size_t bytes() const { return bytes_.size(); }

 private:
  Bytes bytes_;
};

}  // namespace zstep
