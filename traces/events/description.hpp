// What there is to say of a kind of event besides its fields, once: what it is called, what work it is, what it belongs
// to, and what begins with it. Codec, judge, answers and window read it here; fields.hpp has it as a table for what
// asks by number while it runs.
#pragma once

#include <cstdint>
#include <string_view>

namespace zstep {

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

/// What an event belongs to, besides what its own fields name: whatever of these is at work.
enum class Within : std::uint8_t {
  nothing = 0,
  polygon = 1,
  scan_line = 2,
  area = 4,
  ray = 8,
  curve = 16,  ///< the curve, the line or the piece
  node = 32,   ///< the node of the tree that was made last
};
constexpr Within operator|(Within one, Within other) {
  return static_cast<Within>(static_cast<std::uint8_t>(one) | static_cast<std::uint8_t>(other));
}
constexpr bool has(Within all, Within one) {
  return (static_cast<std::uint8_t>(all) & static_cast<std::uint8_t>(one)) != 0;
}

/// In what a reader goes through a trace.
enum class Unit : std::uint8_t { event, pixel, span, scan_line, polygon };

struct Begins {
  Unit unit = Unit::event;
  std::string_view word{};  ///< what methods call the unit that have areas, edges or curves in its stead
};

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
};
template <class Event>
inline constexpr Description description_of{};

}  // namespace zstep
