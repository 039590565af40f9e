// A described field: what an event's member is called, measured in, and how well it can be guessed.
//
// Every event in vocabulary.hpp lists its fields once, as Fields. The binary codec, JSONL in and out and the
// documentation table are all generated from that list; nothing else in zstep repeats it.
#pragma once

#include <cstdint>
#include <string_view>
#include <type_traits>
#include <utility>

#include "traces/words_of.hpp"

namespace zstep {

/// How the codec guesses a value before it looks. A right guess costs no bits in the file (docs/trace-format.md,
/// "Guesses"). There is a register for each field name, holding the last value any event gave to a field of that name.
enum class Guess : std::uint8_t {
  same,     ///< the register of the same name, unchanged
  next,     ///< that register plus one (integers only)
  told,     ///< what the scene and the events before tell, before the event's other fields are known
  formula,  ///< what the event's formula gives for the fields before it; those of an event are guessed together
};

template <class Event, class Value>
struct Field {
  using value_type = Value;
  std::string_view name;     ///< the name in JSONL, SQL and the documentation
  Value Event::*member;      ///< where the value lives
  std::string_view unit;     ///< "px", "row", "world", "depth", "index", "1" …
  std::string_view meaning;  ///< one phrase for the documentation and the viewer
  Guess guess;

  constexpr Field(std::string_view name_, Value Event::*member_, std::string_view unit_, std::string_view meaning_,
                  Guess guess_ = Guess::same)
      : name(name_), member(member_), unit(unit_), meaning(meaning_), guess(guess_) {}
};

/// Several fields of an event, one after another: what a std::tuple is, in a form that a compiler reads in no time.
namespace detail {
template <std::size_t place, class Field>
struct PlacedField {
  Field field;
};
template <class Places, class... Field>
struct FieldsAt;
template <std::size_t... place, class... Field>
struct FieldsAt<std::index_sequence<place...>, Field...> : PlacedField<place, Field>... {};
}  // namespace detail
template <class... Field>
struct Fields : detail::FieldsAt<std::index_sequence_for<Field...>, Field...> {
  static constexpr std::size_t count = sizeof...(Field);
  constexpr explicit Fields(Field... field)
      : detail::FieldsAt<std::index_sequence_for<Field...>, Field...>{{field}...} {}
};
template <std::size_t place, class Field>
constexpr const Field& field_in(const detail::PlacedField<place, Field>& placed) {
  return placed.field;
}

/// The fields of an event, in file order. Specialised in vocabulary.hpp for every event.
template <class Event>
inline constexpr auto fields_of = nullptr;

/// The name of an event's kind as it stands in traces ("depth_compare") and one phrase saying what it records.
struct KindText {
  std::string_view name;
  std::string_view meaning;
};
template <class Event>
inline constexpr KindText kind_text{};

template <class Event>
inline constexpr std::size_t field_count = std::remove_const_t<decltype(fields_of<Event>)>::count;

template <class Event, class Function>
constexpr void for_each_field(Function&& function) {
  [&]<std::size_t... place>(std::index_sequence<place...>) { (function(field_in<place>(fields_of<Event>)), ...); }
  (std::make_index_sequence<field_count<Event>>{});
}

}  // namespace zstep
