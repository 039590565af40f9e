// Why a polygon is not what is seen: at one pixel, or anywhere on the picture.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "sim/words/notation.hpp"
#include "traces/replay/replay.hpp"

namespace zstep::answers {

/// What became of a polygon at a pixel.
enum class Why : std::uint8_t {
  seen,          ///< it is what is seen there
  mixed,         ///< its colour is a part of the pixel's: glass, or opaque behind glass
  lost,          ///< it was held against another that is nearer
  tie,           ///< as near as another that came first
  overwritten,   ///< it was there until another was found nearer
  painted_over,  ///< it was there until another was painted over it
  wiped,         ///< it was there until the buffers were cleared once more
  taken,         ///< front to back: another was there first
  surrounded,    ///< another surrounds the area and is in front of all in it
  unreached,     ///< the ray's search ended at another before it came to this one
  horizon,       ///< its curve is hidden by the horizons
  line_hidden,   ///< its edge is hidden by a face
  back_edge,     ///< its edge is left out: all faces at it face away
  culled,        ///< it faces away and is not drawn
  clipped,       ///< its part there lies before the near plane or beyond the far plane
  // It is not at the pixel's centre in the first place:
  outside,      ///< nothing of it lies in the view volume
  edge_on,      ///< seen edge-on it covers no area
  degenerate,   ///< it has no area
  not_covered,  ///< it does not cover the pixel's centre; a line: it does not pass the pixel
  flag_out,     ///< the same by a scan line: its in/out flag is out there
  apart,        ///< the same by areas: it is disjoint from one around the pixel
  box_missed,   ///< the same by rays: the ray misses a box around it, or all cells that hold it
  // And what a trace does not make clear:
  contradicted,  ///< what the trace records of it there cannot all be so: won and not written, lost and overwritten all
                 ///< the same
  not_recorded,  ///< it covers the pixel, and the trace has no step of it there, or none after its depth was found
};
inline constexpr std::size_t why_count = static_cast<std::size_t>(Why::not_recorded) + 1;

/// Does it say that the polygon is not at the pixel's centre in the first place?
bool does_not_cover(Why kind);

/// A step on the way to the verdict.
struct Link {
  std::int64_t step = 0;
  std::int32_t polygon = no_polygon;  ///< whose step
  std::string text;                   ///< what it did, in a few words
};

struct Verdict {
  Why kind = Why::not_recorded;
  std::int64_t step = 0;            ///< that decided it, 0 where none is recorded
  std::int32_t facet = -1;          ///< of the polygon's facets the one nearest to be seen; -1 where it does not matter
  std::int32_t other = no_polygon;  ///< who is there instead
  std::optional<double> gap;        ///< its depth (along a ray its t) minus the other's: positive is behind it
  std::optional<Trace::Pixel> pixel;  ///< asked for, or picked where none was
  std::string sentence;               ///< why, in words
  std::vector<std::string> formulas;  ///< and in numbers
  std::vector<words::Owned> owned{};  ///< whose they are
  std::vector<Link> chain;            ///< the steps that led there, in order

  // Each takes a format and what stands in it.
  template <class... Part>
  void say(fmt::format_string<Part...> more, Part&&... part) {
    sentence += fmt::format(more, std::forward<Part>(part)...);
  }
  template <class... Part>
  void add_formula(fmt::format_string<Part...> formula, Part&&... part) {
    formulas.push_back(fmt::format(formula, std::forward<Part>(part)...));
  }
  template <class... Part>
  void add_step(std::int64_t step_, std::int32_t whose, fmt::format_string<Part...> did, Part&&... part) {
    chain.push_back({step_, whose, fmt::format(did, std::forward<Part>(part)...)});
  }
};

/// At a pixel. Throws InputError where the trace is damaged or tells what cannot be, std::out_of_range for a polygon or
/// a pixel that the scene does not have.
/// `replay`: one of the same trace that may be moved; with none, one begins anew where it is needed.
Verdict why_not(const Trace& trace, std::int32_t polygon, Trace::Pixel pixel, Replay* replay = nullptr);

/// On the whole picture: `pixel` is the first at which it is seen, or the one at which it came nearest to being seen.
Verdict why_not(const Trace& trace, std::int32_t polygon, Replay* replay = nullptr);

/// The polygon by its label, "B" or "P7", or by its number; nullopt for none.
std::optional<std::int32_t> polygon_called(const Scene& scene, const std::string& text);

}  // namespace zstep::answers
