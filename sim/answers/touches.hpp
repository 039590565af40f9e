// What came to one pixel, and what of it was compared and written, as the trace records it: the one reading on which
// why-not and the history of a pixel rest.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "sim/answers/origin/find.hpp"

namespace zstep::answers {

/// Something that a polygon did to a pixel of the eye's picture: the steps that belong together there.
struct Touch {
  enum class How : std::uint8_t {
    compared,
    painted,  ///< by a step that takes depth and colour at once
    written,  ///< without a compare: a depth, a colour or both
    blended,
    colored,  ///< a colour that is no polygon's own
  } how = How::compared;
  std::int64_t step = 0;              ///< that decided it: the compare, where there is one
  std::int32_t polygon =
      no_polygon;  ///< at work there; where nothing says so, the one that is written; none if that is not known either
  std::optional<double> z;            ///< its depth: compared, painted or written
  bool nearer = true;                 ///< of a compare, its outcome

  double stored = no_depth;                  ///< the depth buffer's number before it
  std::int32_t stored_polygon = no_polygon;  ///< the frame's polygon before it
  bool only_cleared = true;                  ///< no depth was written here since the buffers were cleared
  bool known = false;  ///< `stored` is recorded or declared: the buffers were cleared, or a depth was written

  std::optional<double> kept;         ///< the depth that was written
  std::int64_t kept_at = 0;           ///< the step that wrote it
  std::int64_t written = 0;           ///< the step that changed the pixel's colour, 0 if none did
  bool takes = false;  ///< the pixel is one polygon's from then on: glass that is mixed in only colours it
  std::int32_t shows = no_polygon;    ///< that polygon
  double opacity = 1;                 ///< of what is blended
  std::int64_t blended = 0;           ///< the step of the blend, also where a compare came first
};

/// All that happened to a pixel after a step (standard: since its picture began), in order. A blend that follows a
/// compare is one with it.
std::vector<Touch> touches_of(const Trace& trace, Trace::Pixel pixel, std::int64_t after);
std::vector<Touch> touches_of(const Trace& trace, Trace::Pixel pixel);

/// The last that took the pixel before a step; nullptr while it shows the background.
const Touch* holder(const std::vector<Touch>& touches, std::int64_t before);

/// Is this depth nearer than what is stored, by the trace's conventions?
bool is_nearer(const Trace& trace, double z, double stored);
/// Does a compare's outcome follow from its two depths? True where the stored one is not known.
bool follows(const Trace& trace, const Touch& compared);
/// A depth was compared and found nearer, the pixel was written, and the depth was not.
bool lacks_depth(const Touch& touch);
/// The depth that was written is another than the one compared.
bool keeps_other_depth(const Touch& touch);

}  // namespace zstep::answers
