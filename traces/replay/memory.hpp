// How much memory a copy of a state takes, beyond another copy that it shares with.
#pragma once

#include <cstddef>
#include <optional>
#include <tuple>
#include <type_traits>
#include <utility>
#include <vector>

#include "traces/replay/same.hpp"
#include "traces/replay/shared_chunks.hpp"
#include "traces/replay/shared_list.hpp"

namespace zstep {

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
