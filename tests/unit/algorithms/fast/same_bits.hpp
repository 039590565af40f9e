// Pictures compared bit by bit. For tests.
#pragma once

#include <cstring>

#include "traces/scene.hpp"

namespace zstep::test {

/// Of both buffers: a depth may be -0, or NaN.
inline bool same_bits(const Picture& one, const Picture& other) {
  return one.width == other.width && one.height == other.height && one.polygon == other.polygon &&
         one.depth.size() == other.depth.size() &&
         std::memcmp(one.depth.data(), other.depth.data(), one.depth.size() * sizeof(double)) == 0;
}

}  // namespace zstep::test
