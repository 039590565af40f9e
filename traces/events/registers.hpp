// Registers and guesses: how an event is foretold from the ones before it.
//
// There is one register per field name, so that a `y` told by a scan line is already known to the span, the
// interpolation and the compare that follow. Encoder and decoder walk an event's fields in order; each field is guessed
// from the registers, and the value then becomes its register. What is guessed right is not stored
// (docs/trace-format.md).
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
  for_each_kind([&]<class E>() { count += std::tuple_size_v<std::remove_const_t<decltype(fields_of<E>)>>; });
  return count;
}

// Every header that records includes this, so it is reckoned once and with a table of hashes.
struct Slots {
  std::array<std::string_view, count_fields()> name{};  ///< of each slot
  std::array<std::uint16_t, 1024> by_hash{};               ///< slot + 1, at or after the place its name's hash says; 0: none
  std::array<std::uint8_t, count_fields()> of_field{};     ///< slot of each field, by kind and then by field
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

template <class E>
inline constexpr std::size_t field_count = std::tuple_size_v<std::remove_const_t<decltype(fields_of<E>)>>;

/// The I-th field of an event, as a constant.
template <class E, std::size_t I>
inline constexpr auto field_at = std::get<I>(fields_of<E>);

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

class Registers {
 public:
  /// `increments`: depths along a span are guessed by z + dz_dx instead of the direct formula.
  explicit Registers(bool increments) : increments_(increments) {}

  /// The guess for the I-th field of the next event E, given that its earlier fields have been set.
  template <class E, std::size_t I>
  auto guess() const {
    constexpr auto field = field_at<E, I>;
    constexpr std::size_t slot = slot_at<E, I>;
    if constexpr (std::is_same_v<FieldValue<E, I>, double>) {
      if constexpr (field.guess == Guess::on_span) return increments_ ? stepped(slot) : on_span();
      else return real_[slot];
    } else {
      if constexpr (field.guess == Guess::next)
        return static_cast<std::int32_t>(static_cast<std::uint32_t>(whole_[slot]) + 1u);
      else return whole_[slot];
    }
  }

  template <class E, std::size_t I>
  void set(double value) {
    real_[slot_at<E, I>] = value;
  }
  template <class E, std::size_t I>
  void set(std::int32_t value) {
    whole_[slot_at<E, I>] = value;
    // A span foretells where its first pixel is.
    if constexpr (std::is_same_v<E, SpanBegin> && field_at<E, I>.name == "first") {
      whole_[slot_of("x")] = static_cast<std::int32_t>(static_cast<std::uint32_t>(value) - 1u);
    }
  }

 private:
  double stepped(std::size_t slot) const { return real_[slot] + real_[slot_of("dz_dx")]; }

  /// z = z_L + (z_R - z_L)(x - x_L)/(x_R - x_L), evaluated as scan conversion evaluates it.
  double on_span() const {
    const double x_left = real_[slot_of("x_left")], x_right = real_[slot_of("x_right")];
    const double z_left = real_[slot_of("z_left")], z_right = real_[slot_of("z_right")];
    if (x_right == x_left) return z_left;
    return z_left + (z_right - z_left) * (static_cast<double>(whole_[slot_of("x")]) - x_left) / (x_right - x_left);
  }

  std::array<std::int32_t, slot_count> whole_{};
  std::array<double, slot_count> real_{};
  bool increments_;
};

}  // namespace zstep
