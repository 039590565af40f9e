// What a kind of event says of itself: what it is called and what begins with it, and of each field what it is called,
// measured in, and how well it can be guessed.
//
// Every event in vocabulary.hpp lists its fields once, as Fields: what each is called, measured in and means, what it
// is to its step, and how it can be guessed. Codec, JSON Lines, SQL, documentation, check and diff read that list;
// nothing else in zstep repeats it.
#pragma once

#include <cstdint>
#include <string_view>
#include <type_traits>
#include <utility>

#include "traces/conventions.hpp"

namespace zstep {

// What there is to say of a kind of event besides its fields, once: what it is called, what work it is, what it belongs
// to, and what begins with it. Codec, judge, answers and window read it here; fields.hpp has it as a table for what
// asks by number while it runs.

/// What kind of work it is, in words that all methods have in common. An operation computes, decides or writes
/// something; what begins a loop, or keeps lists, trees and tables in order, is bookkeeping.
enum class WorkKind : std::uint8_t {
  vertices,  ///< transformed
  planes,    ///< and boxes, and rays
  tests,
  cuts,
  edges,   ///< and spans
  depths,  ///< interpolated
  compares,
  writes,
  bookkeeping,
};

/// Values of an enumeration that are said together: one | other.
template <class Enumeration>
inline constexpr bool said_together = false;
template <class Enumeration>
requires said_together<Enumeration>
constexpr Enumeration operator|(Enumeration one, Enumeration other) {
  return static_cast<Enumeration>(static_cast<std::uint8_t>(one) | static_cast<std::uint8_t>(other));
}
/// Is any of these among them?
template <class Enumeration>
requires said_together<Enumeration>
constexpr bool has(Enumeration all, Enumeration any) {
  return (static_cast<std::uint8_t>(all) & static_cast<std::uint8_t>(any)) != 0;
}

/// What an event belongs to, besides what its own fields name: whatever of these is at work.
enum class Within : std::uint8_t {
  nothing = 0,
  polygon = 1,
  scan_line = 2,
  area = 4,
  ray = 8,
  curve = 16,  ///< the curve, the line or the piece
  node = 32,   ///< the node of the tree that was made last
  triangle = 64,
};
template <>
inline constexpr bool said_together<Within> = true;

/// In what a reader goes through a trace.
enum class Unit : std::uint8_t { event, pixel, span, scan_line, polygon };

struct Begins {
  Unit unit = Unit::event;
  std::string_view word{};  ///< what methods call the unit that have areas, edges or curves in its stead
};

/// What a step does at the pixel that it names, where the depth buffer and the frame are concerned.
enum class AtPixel : std::uint8_t {
  nothing = 0,
  depth = 1,    ///< it has the depth there of what is at work
  verdict = 2,  ///< it says whether that is nearer
  keeps = 4,    ///< it stores a depth
  colors = 8,   ///< it stores a polygon's colour
};
template <>
inline constexpr bool said_together<AtPixel> = true;

struct Description {
  std::string_view name;     ///< as it stands in traces: "depth_compare"
  std::string_view meaning;  ///< one phrase for what it records
  WorkKind work = WorkKind::bookkeeping;
  /// One event of the kind, by its numbers: "span of scan line {y}", where {field} stands for what a field names. Empty
  /// where its meaning does.
  std::string_view called{};
  Within within = Within::nothing;
  bool either_way = false;  ///< vertex_0 and vertex_1 may stand the other way round
  Begins begins{};          ///< the unit that begins with it
  /// Where it gives a piece to several pixels at once, seen from one of them: "in the area around it".
  std::string_view gives_around{};
  bool after_polygons = false;  ///< it is about all polygons at once, after the work on each of them
  AtPixel at_pixel = AtPixel::nothing;
};
template <class Event>
inline constexpr Description description_of{};

template <class Event>
inline constexpr AtPixel at_pixel = description_of<Event>.at_pixel;
/// The depth of a polygon on its way into the buffer: interpolated, or held against the stored one.
constexpr bool is_of_fragment(AtPixel does) { return has(does, AtPixel::depth) && !has(does, AtPixel::colors); }

/// How the codec guesses a value before it looks. A right guess costs no bits in the file (docs/trace-format.md,
/// "Guesses"). There is a register for each field name, holding the last value any event gave to a field of that name.
enum class Guess : std::uint8_t {
  same,     ///< the register of the same name, unchanged
  next,     ///< that register plus one (integers only)
  told,     ///< what the scene and the events before tell, before the event's other fields are known
  formula,  ///< what the event's formula gives for the fields before it; those of an event are guessed together
};

/// What a field is to its step. Where a value comes from is one of the first three; the others are said besides it.
enum class As : std::uint8_t {
  input = 0,     ///< what the method decided, or what the step is about: nothing before says it
  formula = 1,   ///< it follows from what was before: `derive` gives it (traces/formulas)
  recorded = 2,  ///< the method computes it, and no formula says how yet: it is taken as the trace has it
  subject = 4,   ///< it names what the step is about, so that the same step is known in another run
  made = 8,      ///< it is the number of the thing that the step makes
  aside = 16,    ///< two runs may differ in it and yet do the same
  ruled = 32,    ///< rules say what it may be, though no formula does
};
template <>
inline constexpr bool said_together<As> = true;

/// What a run numbers for itself. Polygons and facets are the scene's, and have one number for all runs.
enum class Thing : std::uint8_t { none, vertex, edge, piece, node, area, box, ray, curve, line, count };

/// What a whole number may be in a trace from outside (traces/file/check_events.cpp).
enum class Bound : std::uint8_t {
  none,
  polygon,
  polygon_or_none,
  facet,
  facet_or_none,
  vertex,
  edge,
  column,
  row,
  span_end,  ///< two columns outside the raster at most
  column_or_end,
  row_or_end,
  shade,  ///< 0 to 255
};

/// The unit of a field, "px", "row", "world", "depth", "index", "1" …; and of a whole number, what it may be.
struct Measure {
  std::string_view name;
  Bound bound = Bound::none;
  Thing thing = Thing::none;
  constexpr Measure(const char* name_, Bound bound_ = Bound::none) : name(name_), bound(bound_) {}  // NOLINT: its name
  constexpr explicit Measure(Thing thing_, Bound bound_ = Bound::none) : name("index"), bound(bound_), thing(thing_) {}

  static const Measure vertex, edge, piece, node, area, box, ray, curve, line;
  static const Measure polygon, polygon_or_none, facet, facet_or_none;
  static const Measure column, row, pixel_row, span_end, column_or_end, row_or_end, shade;
};
inline constexpr Measure Measure::vertex{Thing::vertex, Bound::vertex}, Measure::edge{Thing::edge, Bound::edge},
    Measure::piece{Thing::piece}, Measure::node{Thing::node}, Measure::area{Thing::area}, Measure::box{Thing::box},
    Measure::ray{Thing::ray}, Measure::curve{Thing::curve}, Measure::line{Thing::line};
inline constexpr Measure Measure::polygon{"index", Bound::polygon},
    Measure::polygon_or_none{"index", Bound::polygon_or_none}, Measure::facet{"index", Bound::facet},
    Measure::facet_or_none{"index", Bound::facet_or_none};
inline constexpr Measure Measure::column{"px", Bound::column}, Measure::row{"row", Bound::row},
    Measure::pixel_row{"px", Bound::row}, Measure::span_end{"px", Bound::span_end},
    Measure::column_or_end{"px", Bound::column_or_end}, Measure::row_or_end{"row", Bound::row_or_end},
    Measure::shade{"1", Bound::shade};

template <class Event, class Value>
struct Field {
  using value_type = Value;
  std::string_view name;     ///< the name in JSONL, SQL and the documentation
  Value Event::*member;      ///< where the value lives
  std::string_view unit;     ///< as in Measure
  Bound bound;               ///< as in Measure
  Thing thing;               ///< of which this is the number
  std::string_view meaning;  ///< one phrase for the documentation and the viewer
  As as;
  Guess guess;

  constexpr Field(std::string_view name_, Value Event::*member_, Measure measure, std::string_view meaning_, As as_,
                  Guess guess_ = Guess::same)
      : name(name_),
        member(member_),
        unit(measure.name),
        bound(measure.bound),
        thing(measure.thing),
        meaning(meaning_),
        as(as_),
        guess(guess_) {}
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

template <class Event>
inline constexpr std::size_t field_count = std::remove_const_t<decltype(fields_of<Event>)>::count;

template <class Event, class Function>
constexpr void for_each_field(Function&& function) {
  [&]<std::size_t... place>(std::index_sequence<place...>) { (function(field_in<place>(fields_of<Event>)), ...); }
  (std::make_index_sequence<field_count<Event>>{});
}

}  // namespace zstep
