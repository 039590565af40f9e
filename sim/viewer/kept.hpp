// What is painted once and kept until what it is painted from changes. The function that paints is a plain one and sees
// nothing but its inputs, and the inputs decide whether it is called again: so nothing that is drawn can be left out of
// the decision.
#pragma once

#include <bit>
#include <concepts>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <type_traits>
#include <vector>

#include "traces/image/png.hpp"
#include "sim/viewer/charts/chart.hpp"
#include "sim/viewer/draw/canvas.hpp"
#include "sim/viewer/draw/fonts.hpp"
#include "sim/viewer/draw/theme.hpp"
#include "sim/viewer/model/inquiry.hpp"
#include "sim/viewer/model/moment.hpp"
#include "sim/viewer/model/outside.hpp"
#include "sim/viewer/model/raster_view.hpp"
#include "sim/viewer/model/summary.hpp"
#include "traces/text.hpp"

namespace zstep::viewer {

/// A number for all that it was given.
class Fingerprint {
 public:
  void take(std::uint64_t bits) {
    value_ = (value_ ^ bits) * 0x9e3779b97f4a7c15u;
    value_ ^= value_ >> 29;
  }
  std::uint64_t value() const { return value_; }

 private:
  std::uint64_t value_ = 0x2545f4914f6cdd1du;
};

template <class T>
struct Kept {
  T made;
  std::uint64_t key = 0;  ///< 0: never made
};

// --- How inputs are taken in: one of these for each type of input.

template <class Number>
requires std::is_arithmetic_v<Number> || std::is_enum_v<Number>
void take(Fingerprint& print, Number value) { print.take(std::bit_cast<std::uint64_t>(static_cast<double>(value))); }

template <class T>
void take(Fingerprint& print, const std::optional<T>& value) {
  take(print, value.has_value());
  if (value) take(print, *value);
}

template <class T>
void take(Fingerprint& print, const Kept<T>& kept) {
  print.take(kept.key);
}

/// There is one trace in a window, and its scene does not change.
inline void take(Fingerprint& print, const Scene& scene) { print.take(std::bit_cast<std::uintptr_t>(&scene)); }
inline void take(Fingerprint& print, const std::vector<CurveMarks::Mark>& marks) {
  print.take(std::bit_cast<std::uintptr_t>(marks.data()));
}
inline void take(Fingerprint&, const DepthScale&) {}  // there is but one

inline void take(Fingerprint& print, const Stop* const& stop) { print.take(std::bit_cast<std::uintptr_t>(stop)); }

/// The state is a function of the step.
inline void take(Fingerprint& print, const Moment& moment) {
  print.take(static_cast<std::uint64_t>(moment.position()));
  print.take(static_cast<std::uint64_t>(moment.picture_position()));
  print.take(std::uint64_t{moment.at_rest()});
  print.take(std::uint64_t{moment.event_told() != nullptr});
  take(print, moment.told());
}

inline void take(Fingerprint& print, const Theme& theme) {
  static_assert(std::has_unique_object_representations_v<Theme>);
  for (const ImU32 color : std::bit_cast<std::array<ImU32, sizeof(Theme) / sizeof(ImU32)>>(theme)) print.take(color);
}

inline void take(Fingerprint& print, const RasterMap& map) {
  for (const int value : {map.width, map.height, static_cast<int>(map.y_up), map.box_width, map.box_height})
    take(print, value);
  for (const double value : {map.cell, map.left, map.top}) take(print, value);
}

inline void take(Fingerprint& print, const DepthRange& range) {
  take(print, range.near);
  take(print, range.far);
  take(print, range.known);
  take(print, range.named);
}

inline void take(Fingerprint& print, const HeatMap& heat) {
  for (const double value : {heat.least, heat.most}) take(print, value);
  take(print, heat.polygons);
  for (const double value : heat.values) take(print, value);
}

inline void take(Fingerprint& print, const std::string& text) {
  print.take(text.size());
  for (const char c : text) print.take(byte_of(c));
}

inline void take(Fingerprint& print, const std::vector<std::int32_t>& numbers) {
  print.take(numbers.size());
  for (const std::int32_t number : numbers) take(print, number);
}

inline void take(Fingerprint& print, const glm::dvec2& point) {
  take(print, point.x);
  take(print, point.y);
}

/// An offer's picture, which stays as it is.
inline void take(Fingerprint& print, const Image& image) {
  print.take(std::bit_cast<std::uintptr_t>(image.rgb.data()));
}

inline void take(Fingerprint& print, const Cell& cell) {
  take(print, cell.x);
  take(print, cell.y);
}

inline void take(Fingerprint& print, const Look& look) {
  for (const double value : {look.turn, look.tilt, look.zoom, look.across, look.up}) take(print, value);
}

/// All that a pane draws of it: title and subtitle are the pane's own.
inline void take(Fingerprint& print, const LineChart& chart) {
  for (const std::string* title : {&chart.x_title, &chart.y_title}) take(print, *title);
  take(print, chart.scale);
  for (const double tick : chart.x_ticks) take(print, tick);
  for (const glm::dvec2& reach : {chart.x_reach, chart.y_reach}) take(print, reach);
  take(print, chart.lines.size());
  for (const LineChart::Line& line : chart.lines) {
    take(print, line.points.size());
    take(print, line.name);
    take(print, line.dashed);
    take(print, line.look);
    take(print, line.bare);
    for (const glm::dvec2& point : line.points) take(print, point);
  }
  for (const glm::dvec2& point : chart.led) take(print, point);
  for (const LineChart::Now& now : chart.now) {
    take(print, now.at);
    take(print, now.text);
  }
}

/// The same fonts in the size of their letters.
inline void take(Fingerprint& print, const Fonts& fonts) { take(print, fonts.small->FontSize); }

/// What is kept, by what it is.
template <class T>
using KeptThings = std::map<std::string, Kept<T>>;

/// The thing of this name, made anew when an input differs from what it was made from; never null.
template <class T, class... Inputs>
const Kept<T>* keep(KeptThings<T>& things, const std::string& name, void (*make)(T&, const Inputs&...),
                    const std::type_identity_t<Inputs>&... inputs) {
  Fingerprint print;
  (take(print, inputs), ...);
  Kept<T>& kept = things[name];
  const std::uint64_t key = print.value() | 1u;
  if (kept.key != key) {
    make(kept.made, inputs...);
    kept.key = key;
  }
  return &kept;
}

/// The canvas of this name and size.
template <class... Inputs>
const Kept<Canvas>* keep_canvas(KeptThings<Canvas>& canvases, const std::string& name, int width, int height,
                                void (*paint)(Canvas&, const Inputs&...),
                                const std::type_identity_t<Inputs>&... inputs) {
  Fingerprint print;
  take(print, width);
  take(print, height);
  (take(print, inputs), ...);
  Kept<Canvas>& kept = canvases[name];
  const std::uint64_t key = print.value() | 1u;
  if (kept.key != key) {
    kept.made.resize(width, height);
    paint(kept.made, inputs...);
    kept.key = key;
  }
  return &kept;
}

}  // namespace zstep::viewer
