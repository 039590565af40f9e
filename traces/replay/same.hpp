// Equality to the bit: NaN equals itself, and -0 is not 0. States are compared so; and how much memory one takes beyond
// another.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstring>
#include <optional>
#include <tuple>
#include <type_traits>
#include <utility>
#include <vector>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "traces/events/slots.hpp"
#include "traces/replay/shared_chunks.hpp"

namespace zstep {

/// A struct that lists its members: `auto members() const { return std::tie(…); }`
template <class T>
concept ListsMembers = requires(const T& value) {
  value.members();
};
/// A kind of event.
template <class T>
concept Described = !std::is_same_v<std::remove_cv_t<decltype(fields_of<T>)>, std::nullptr_t>;

inline bool same(double a, double b) { return bits_of(a) == bits_of(b); }
template <class T>
requires std::is_integral_v<T> || std::is_enum_v<T>
bool same(T a, T b) { return a == b; }
inline bool same(const glm::dvec2& a, const glm::dvec2& b) { return same(a.x, b.x) && same(a.y, b.y); }
inline bool same(const glm::dvec3& a, const glm::dvec3& b) {
  return same(a.x, b.x) && same(a.y, b.y) && same(a.z, b.z);
}

template <class T>
requires Described<T> || ListsMembers<T>
bool same(const T& a, const T& b);
template <class T>
bool same(const std::optional<T>& a, const std::optional<T>& b);
template <class T>
bool same(const std::vector<T>& a, const std::vector<T>& b);
template <class T, std::size_t N>
bool same(const std::array<T, N>& a, const std::array<T, N>& b);
template <class T>
bool same(const SharedChunks<T>& a, const SharedChunks<T>& b);
template <class T, std::int32_t T::*key>
bool same(const SharedList<T, key>& a, const SharedList<T, key>& b);

template <class T>
requires Described<T> || ListsMembers<T>
bool same(const T& a, const T& b) {
  if constexpr (Described<T>) {
    bool equal = true;
    for_each_field<T>([&](const auto& field) { equal = equal && same(a.*field.member, b.*field.member); });
    return equal;
  } else {
    const auto of_a = a.members(), of_b = b.members();
    return [&]<std::size_t... I>(std::index_sequence<I...>) {
      return (same(std::get<I>(of_a), std::get<I>(of_b)) && ...);
    }
    (std::make_index_sequence<std::tuple_size_v<std::remove_cvref_t<decltype(of_a)>>>{});
  }
}

template <class T>
bool same(const std::optional<T>& a, const std::optional<T>& b) {
  return a.has_value() == b.has_value() && (!a || same(*a, *b));
}

template <class T>
bool same(const std::vector<T>& a, const std::vector<T>& b) {
  if (a.size() != b.size()) return false;
  if constexpr (std::is_arithmetic_v<T> && !std::is_same_v<T, bool>) {
    return a.empty() || std::memcmp(a.data(), b.data(), a.size() * sizeof(T)) == 0;
  } else {
    for (std::size_t i = 0; i < a.size(); ++i) {
      if (!same(a[i], b[i])) return false;
    }
    return true;
  }
}

template <class T, std::size_t N>
bool same(const std::array<T, N>& a, const std::array<T, N>& b) {
  for (std::size_t i = 0; i < N; ++i) {
    if (!same(a[i], b[i])) return false;
  }
  return true;
}

template <class T>
bool same(const SharedChunks<T>& a, const SharedChunks<T>& b) {
  return a.shares_with(b) || std::equal(a.begin(), a.end(), b.begin(), b.end(),
                                        [](const T& one, const T& other) { return same(one, other); });
}
template <class T, std::int32_t T::*key>
bool same(const SharedList<T, key>& a, const SharedList<T, key>& b) {
  return a.shares_with(b) || std::equal(a.begin(), a.end(), b.begin(), b.end(),
                                        [](const T& one, const T& other) { return same(one, other); });
}

// How much memory a copy of a state takes, beyond another copy that it shares with.

inline constexpr std::size_t bytes_of_allocation = 16;  ///< that the allocator keeps for itself, more or less

template <class T>
std::size_t heap_of(const T& value);
template <class T>
std::size_t heap_of(const std::optional<T>& value);
template <class T>
std::size_t heap_of(const std::vector<T>& items);

/// What a value holds outside of itself, in bytes.
template <class T>
std::size_t heap_of(const T& value) {
  if constexpr (ListsMembers<T>)
    return std::apply([](const auto&... member) { return (heap_of(member) + ... + std::size_t{0}); }, value.members());
  else return 0;
}
template <class T>
std::size_t heap_of(const std::optional<T>& value) {
  return value ? heap_of(*value) : 0;
}
template <class T>
std::size_t heap_of(const std::vector<T>& items) {
  std::size_t bytes = items.capacity() == 0 ? 0 : items.capacity() * sizeof(T) + bytes_of_allocation;
  if constexpr (!std::is_trivially_copyable_v<T>)
    for (const T& item : items) bytes += heap_of(item);
  return bytes;
}

/// What one of two values of a type holds outside of itself, without what it shares with the other.
template <class T>
std::size_t heap_beyond(const T& one, const T& other);
template <class T>
std::size_t heap_beyond(const SharedChunks<T>& one, const SharedChunks<T>& other) {
  std::size_t bytes = 0;
  one.for_each_beyond(other, [&](const std::vector<T>& items) { bytes += heap_of(items); });
  return bytes;
}
template <class T, std::int32_t T::*key>
std::size_t heap_beyond(const SharedList<T, key>& one, const SharedList<T, key>& other) {
  std::size_t bytes = 0;
  one.for_each_beyond(other, [&](const auto& items) { bytes += heap_of(items); });
  return bytes;
}
template <class T>
std::size_t heap_beyond(const T& one, const T& other) {
  if constexpr (ListsMembers<T>) {
    const auto of_one = one.members(), of_other = other.members();
    return [&]<std::size_t... I>(std::index_sequence<I...>) {
      return (heap_beyond(std::get<I>(of_one), std::get<I>(of_other)) + ... + std::size_t{0});
    }
    (std::make_index_sequence<std::tuple_size_v<std::remove_cvref_t<decltype(of_one)>>>{});
  } else {
    return heap_of(one);
  }
}

}  // namespace zstep
