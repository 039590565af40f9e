// Slots: one number for each name that fields have, so that a `y` told by a scan line and the `y` of the compare that
// follows can stand for each other.
#pragma once

#include <array>
#include <cstdint>
#include <cstring>
#include <string_view>
#include <type_traits>

#include "traces/events/vocabulary.hpp"

namespace zstep {

namespace detail {

constexpr std::size_t count_fields() {
  std::size_t count = 0;
  for_each_kind([&]<class E>() { count += field_count<E>; });
  return count;
}

// Every header that records includes this, so it is reckoned once and with a table of hashes.
struct Slots {
  std::array<std::string_view, count_fields()> name{};  ///< of each slot
  std::array<std::uint16_t, 1024> by_hash{};  ///< slot + 1, at or after the place its name's hash says; 0: none
  std::array<std::uint8_t, count_fields()> of_field{};      ///< slot of each field, by kind and then by field
  std::array<std::uint16_t, kind_count + 1> first_field{};  ///< of each kind
  std::size_t size = 0;

  /// The place of a name in by_hash, or the free place where it belongs.
  constexpr std::size_t place_of(std::string_view wanted) const {
    std::uint32_t hash = 2166136261u;  // FNV-1a
    for (const char c : wanted) hash = (hash ^ static_cast<std::uint8_t>(c)) * 16777619u;
    std::size_t place = (hash ^ hash >> 16) % by_hash.size();
    while (by_hash[place] != 0 && name[by_hash[place] - 1u] != wanted) place = (place + 1) % by_hash.size();
    return place;
  }
};

constexpr Slots assign_slots() {
  Slots slots;
  std::size_t field_number = 0, kind = 0;
  for_each_kind([&]<class E>() {
    slots.first_field[kind++] = static_cast<std::uint16_t>(field_number);
    for_each_field<E>([&](const auto& field) {
      const std::size_t place = slots.place_of(field.name);
      if (slots.by_hash[place] == 0) {
        slots.name[slots.size++] = field.name;
        slots.by_hash[place] = static_cast<std::uint16_t>(slots.size);
      }
      slots.of_field[field_number++] = static_cast<std::uint8_t>(slots.by_hash[place] - 1u);
    });
  });
  return slots;
}

inline constexpr Slots slots = assign_slots();
static_assert(slots.size <= 256, "a slot's number is one byte");

}  // namespace detail

/// How many registers there are.
inline constexpr std::size_t slot_count = detail::slots.size;

/// The register of a field name; a compile-time error for a name no event has.
consteval std::size_t slot_of(std::string_view name) {
  const std::uint16_t found = detail::slots.by_hash[detail::slots.place_of(name)];
  if (found == 0) throw "no event has a field of this name";
  return found - 1u;
}
/// The register of the I-th field of an event.
template <class E, std::size_t I>
inline constexpr std::size_t slot_at = detail::slots.of_field[detail::slots.first_field[kind_of<E>] + I];

/// The name of a register.
constexpr std::string_view slot_name(std::size_t slot) { return detail::slots.name[slot]; }

/// The I-th field of an event, as a constant.
template <class E, std::size_t I>
inline constexpr auto field_at = field_in<I>(fields_of<E>);

template <class E, std::size_t I>
using FieldValue = typename std::remove_const_t<decltype(field_at<E, I>)>::value_type;

/// Calls function.template operator()<I>() for every field of E, in order.
template <class E, class Function>
constexpr void for_each_index(Function&& function) {
  [&]<std::size_t... I>(std::index_sequence<I...>) { (function.template operator()<I>(), ...); }
  (std::make_index_sequence<field_count<E>>{});
}

/// A double's bits: NaNs and signed zeros must come back as they went in.
inline std::uint64_t bits_of(double value) {
  std::uint64_t bits;
  std::memcpy(&bits, &value, sizeof bits);
  return bits;
}
inline double double_of(std::uint64_t bits) {
  double value;
  std::memcpy(&value, &bits, sizeof value);
  return value;
}

}  // namespace zstep
