#include "traces/events/vocabulary.hpp"

#include <array>
#include <typeinfo>

namespace zstep {

void detail::wrong_kind() { throw std::bad_cast(); }

AtPixel at_pixel_of(std::size_t kind) {
  static const std::array<AtPixel, kind_count> all = [] {
    std::array<AtPixel, kind_count> does{};
    for_each_kind([&]<class E>() { does[kind_of<E>] = at_pixel<E>; });
    return does;
  }();
  return kind < all.size() ? all[kind] : AtPixel::nothing;
}

}  // namespace zstep
