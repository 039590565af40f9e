// Which known mistakes explain every pixel of a run, or of a picture of another program? The scene is drawn as each of
// them would draw it, and as two of them would together (redrawn.hpp), and held against what is there.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "traces/check/precision.hpp"
#include "traces/file/trace.hpp"
#include "traces/mistakes/redrawn.hpp"

namespace zstep::mistakes {

/// Mistakes that are made together: one, or two that change different things.
using Together = std::vector<Way>;

/// Of a run that draws polygon after polygon and compares depths: what makes each of its pixels, depths, answers and
/// writes, and leaves none out. Several where they make the same; none where the scene has all of them as they are.
std::vector<Together> that_draw(const Trace& run, const Precision& precision);

/// What a picture shows, top row first: polygons by their numbers or by their colours, or depths, or both.
struct Seen {
  std::int32_t width = 0, height = 0;
  std::vector<std::int32_t> polygons;  ///< [height*width] or empty; no_polygon where none is
  std::vector<Color> colors;           ///< likewise
  std::vector<double> depths;          ///< likewise; what is not finite, or `empty`, is background
  std::optional<double> empty;         ///< the depth of the background, where it is a number
  /// By how much depths are off as they were written with few bits; 0 else. Then they are from 0, for the least depth
  /// that the scene can have, to 1, for the greatest.
  double unit = 0;
};
/// A picture as some mistakes, under some conventions, would have drawn it, beside what it shows.
struct Likeness {
  Together ways;
  struct Declared {
    std::string key, word;  ///< "depth", "zero_to_one", as headers write them
  };
  std::vector<Declared> conventions{};  ///< other than the header has them
  std::int64_t differ = 0;              ///< pixels that it has otherwise
  std::int64_t sure = 0;                ///< pixels of which rounding does not decide what they show
};
/// The right drawing first, and then those from which the picture differs in less than half as many pixels, the
/// likest first: of each convention and each mistake alone and, where none explains all, of two together. `on_done` is
/// told now and then how far it is, as a share; true ends it there.
std::vector<Likeness> likenesses(const Scene& scene, const Header& header, double roundoff, const Seen& seen,
                                 const std::function<bool(double)>& on_done = nullptr);

}  // namespace zstep::mistakes
