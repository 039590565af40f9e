// Enumerations whose values are numbered from 0: the words that stand for them in traces, on the command line and in
// lessons, and tables with one entry for each.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string_view>
#include <type_traits>

namespace zstep {

/// The words that stand for the values of an enumeration, in value order from 0. Specialised, as an array of texts,
/// beside every enumeration that an event or a header carries.
template <class Enumeration>
inline constexpr auto words_of = nullptr;

/// The place of a value in value order, from 0.
template <class Enumeration>
requires std::is_enum_v<Enumeration>
constexpr std::size_t index_of(Enumeration value) { return static_cast<std::size_t>(value); }

/// How many values there are: those before `count`, or those that have words.
template <class Enumeration>
inline constexpr std::size_t value_count = [] {
  if constexpr (requires { Enumeration::count; }) return index_of(Enumeration::count);
  else return words_of<Enumeration>.size();
}();

/// All of them, in value order.
template <class Enumeration>
inline constexpr auto values_of = [] {
  std::array<Enumeration, value_count<Enumeration>> values{};
  for (std::size_t k = 0; k < values.size(); ++k) values[k] = static_cast<Enumeration>(k);
  return values;
}();

template <class Enumeration>
constexpr std::string_view word_of(Enumeration value) {
  return words_of<Enumeration>[index_of(value)];
}

/// The value that a word stands for; none if it is not one of them.
template <class Enumeration>
constexpr std::optional<Enumeration> value_called(std::string_view word) {
  for (const Enumeration value : values_of<Enumeration>)
    if (word_of(value) == word) return value;
  return std::nullopt;
}

/// One T for each value. `size` is told where an enumeration has neither `count` nor words.
template <class Enumeration, class T, std::size_t size = value_count<Enumeration>>
struct ByEnum : std::array<T, size> {
  using std::array<T, size>::operator[];
  constexpr T& operator[](Enumeration value) { return std::array<T, size>::operator[](index_of(value)); }
  constexpr const T& operator[](Enumeration value) const { return std::array<T, size>::operator[](index_of(value)); }
};

}  // namespace zstep
