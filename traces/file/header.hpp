// What a trace says about itself, besides its scene and its events, and what its run can have recorded.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "traces/events/vocabulary.hpp"
#include "traces/record/recorder.hpp"
#include "traces/scene.hpp"

namespace zstep {

/// Which of two depths wins a pixel. Of zstep's own methods the smaller one, and of equals the first, unless they are
/// asked otherwise.
struct Comparison {
  enum class Nearer : std::uint8_t { smaller, greater };
  enum class Ties : std::uint8_t { first, last };
  Nearer nearer = Nearer::smaller;
  Ties ties = Ties::first;

  bool wins(double z, double stored) const { return behind(z, stored) < 0 || (ties == Ties::last && z == stored); }
  /// By how much z is farther than what is stored; negative where it is nearer.
  double behind(double z, double stored) const { return nearer == Nearer::smaller ? z - stored : stored - z; }
  /// "<" where z wins if z < stored; "\u2264", ">" or "\u2265".
  std::string_view sign() const;
  /// Behind all others.
  double farthest() const { return nearer == Nearer::smaller ? no_depth : -no_depth; }
  bool operator==(const Comparison&) const = default;
};

/// What a header may leave undeclared; then it is as in a trace of zstep's own, and nobody may state it as a fact.
enum class Convention : std::uint8_t {
  depth,
  interpolation,
  coverage,
  cull,
  number_format,
  pixel_centre,
  nearer,
  ties
};

/// Where it stands in Header::undeclared.
constexpr std::uint8_t bit_of(Convention convention) { return static_cast<std::uint8_t>(1u << index_of(convention)); }

/// How a program writes numbers that zstep has otherwise (written.hpp).
struct WrittenAs {
  enum class Centre : std::uint8_t { integer, half };  ///< the centre of pixel (x, y): (x, y), or (x + 1/2, y + 1/2)
  enum class Axes : std::uint8_t { left_handed, right_handed };  ///< of view coordinates: z_v, or -z_v, is the distance
  Centre centre = Centre::integer;
  Axes axes = Axes::left_handed;
  bool operator==(const WrittenAs&) const = default;
};
template <>
inline constexpr std::array<std::string_view, 2> words_of<WrittenAs::Centre>{"integer", "half"};
template <>
inline constexpr std::array<std::string_view, 2> words_of<WrittenAs::Axes>{"left_handed", "right_handed"};

struct Header {
  std::string writer;     ///< who wrote it: "zstep 0.2.0", or a student's program
  std::string algorithm;  ///< the method's id: "z-buffer"
  std::string title;      ///< the method's title: "Z-buffer"
  Conventions conventions;
  Page page;  ///< the step table, in the order in which the pseudo-code is read
  Comparison comparison;
  WrittenAs written;
  std::optional<double> initial_depth;  ///< in the depth buffer before the first step, where the header declares it
  std::uint8_t undeclared = 0;          ///< bits of Conventions

  bool declares(Convention which) const { return (undeclared & bit_of(which)) == 0; }
  double empty_depth() const { return initial_depth.value_or(comparison.farthest()); }
  bool operator==(const Header&) const = default;
};

/// The step with this id, or nullptr.
const StepInfo* find_step(const Page& page, std::uint8_t id);
/// The step with this name ("compare", or "z_buffer.compare" where two modules share a name), or nullptr.
const StepInfo* find_step(const Page& page, std::string_view name);

// What a run can have recorded, by its pseudo-code.

/// Events of this kind?
inline bool records(const Header& header, std::size_t kind) {
  return std::any_of(header.page.begin(), header.page.end(), [&](const StepInfo& step) { return step.kind == kind; });
}
template <class E>
bool records(const Header& header) {
  return records(header, kind_of<E>);
}

/// Events that do any of this at a pixel?
inline bool records(const Header& header, AtPixel any) {
  return std::any_of(header.page.begin(), header.page.end(),
                     [&](const StepInfo& step) { return has(at_pixel_of(step.kind), any); });
}

/// Where the method itself keeps depths to compare with: for the whole picture, for one scan line, or nowhere. What is
/// painted has a depth in the trace even where the method never looks at it.
enum class DepthBuffer : std::uint8_t { none, line, picture };
inline DepthBuffer depth_buffer(const Header& header) {
  const bool keeps = std::any_of(header.page.begin(), header.page.end(), [](const StepInfo& step) {
    const AtPixel does = at_pixel_of(step.kind);
    return does != AtPixel::nothing && !has(does, AtPixel::colors);
  });
  if (!keeps) return DepthBuffer::none;
  if (!records<SpanFlags>(header)) return DepthBuffer::picture;
  // The scan-line method has steps for both of its ways.
  const auto resolve = header.conventions.options.find("resolve");
  const bool by_line = resolve != header.conventions.options.end() && resolve->second == "line-buffer";
  return by_line ? DepthBuffer::line : DepthBuffer::none;
}

/// Scan lines that go through all polygons at once, whose edges stand in one table?
inline bool sweeps(const Header& header) { return records<FlagFlip>(header); }

}  // namespace zstep
