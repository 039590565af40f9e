#include "traces/check/pixels.hpp"

#include <type_traits>
#include <utility>

#include "traces/file/header.hpp"
#include "traces/file/visit.hpp"

namespace zstep {

namespace {

/// The last compare of a pixel, and what was written there.
struct PixelTold {
  std::uint32_t turn = 0;  ///< of the polygon at work
  bool won = false, painted = false, written = false;
  std::int64_t compare = 0;  ///< its step; 0 where there is none
  std::int64_t early = 0;    ///< the step of a write that waits for its compare
};

}  // namespace

ColorWrites::ColorWrites(const Trace& trace) {
  const bool colors = trace.has(kind_of<PixelWrite>), depths = trace.has(kind_of<DepthWrite>);
  if (!trace.has(AtPixel::verdict)) all_known_ = !colors && !depths;  // which are won does not show
  if (!trace.has(AtPixel::verdict) || (!colors && !depths)) return;
  const Raster& raster = trace.scene().raster;
  std::vector<PixelTold> pixels(pixel_count(raster.width, raster.height));
  struct Win {
    std::int64_t step = 0;
    std::uint32_t turn = 0;
  };
  std::vector<Win> open, open_depths;  // wins without a colour, and without a depth
  std::uint32_t turn = 1;
  std::int64_t last_compare = 0, last_else = 0;
  bool at_once = true, depths_at_once = true;  // they are written before the next pixel's turn
  bool eye = true;                             // the picture is the eye's
  const bool interpolates = trace.has(kind_of<DepthInterpolate>);
  std::int32_t x = -1, y = -1;  // of the depth that was interpolated last
  const auto leave = [&](PixelTold& pixel) {
    if (pixel.won && !pixel.painted && colors) open.push_back({pixel.compare, pixel.turn});
    if (pixel.won && !pixel.written && depths) open_depths.push_back({pixel.compare, pixel.turn});
    if (pixel.early != 0) early_.push_back({pixel.early, Early::never_compared});
    pixel = {.turn = turn};
  };
  const auto told = [&](std::int32_t column, std::int32_t row) -> PixelTold& {
    PixelTold& pixel = pixels[std::int64_t{row} * raster.width + column];
    if (pixel.turn != turn) leave(pixel);
    return pixel;
  };
  const auto paint = [&](PixelTold& pixel) {
    pixel.painted = true;
    at_once = at_once && pixel.compare == last_compare;
  };
  trace.visit(0, trace.size(), [&]<class E>(std::int64_t step, std::uint8_t, const E& e) {
    if constexpr (!only_writes<E>) last_else = step;
    if constexpr (ends_pixel<E>) last_end_ = step;
    if constexpr (std::is_same_v<E, PassBegin>) eye = e.pass != Pass::light;
    if constexpr (std::is_same_v<E, PolygonBegin> || std::is_same_v<E, BuffersClear> || std::is_same_v<E, PassBegin>)
      ++turn;
    if (!eye) return true;
    if constexpr (std::is_same_v<E, DepthInterpolate>) x = e.x, y = e.y;
    if constexpr (has(at_pixel<E>, AtPixel::verdict)) {
      PixelTold& pixel = told(e.x, e.y);
      const std::int64_t before = std::exchange(pixel.early, 0);
      if (before != 0) early_.push_back({before, e.nearer ? Early::wins : Early::loses});
      leave(pixel);
      pixel.compare = last_compare = step;
      pixel.won = e.nearer, pixel.painted = before != 0;
    } else if constexpr (std::is_same_v<E, DepthWrite>) {
      PixelTold& pixel = told(e.x, e.y);
      pixel.written = true;
      depths_at_once = depths_at_once && pixel.compare == last_compare;
    } else if constexpr (std::is_same_v<E, PixelWrite>) {
      PixelTold& pixel = told(e.x, e.y);
      if (pixel.won && !pixel.painted) return paint(pixel), true;
      if (pixel.early != 0) early_.push_back({pixel.early, Early::never_compared});
      // Where work on its pixel has not begun it is one at a wrong place; and right after a compare that is lost it
      // goes with that one.
      if (interpolates && (e.x != x || e.y != y)) return pixel.early = 0, true;
      pixel.early = pixel.compare != 0 && pixel.compare == last_compare ? 0 : step;
    } else if constexpr (std::is_same_v<E, ColorWrite>) {
      PixelTold& pixel = told(e.x, e.y);
      if (pixel.won && !pixel.painted) paint(pixel);
    }
    return true;
  });
  const std::uint32_t last_turn = turn++;
  for (PixelTold& pixel : pixels)
    if (pixel.turn != 0) leave(pixel);
  // A write after the last compare may be one whose compare is cut off, or one of a pixel that was won and written.
  std::erase_if(early_,
                [&](const EarlyWrite& one) { return one.early == Early::never_compared && one.step > last_compare; });
  const auto by_step = [](const auto& one, const auto& other) { return one.step < other.step; };
  std::sort(early_.begin(), early_.end(), by_step);
  // Glass is mixed in, and writes no colour of its own.
  if (records<ColorBlend>(trace.header())) return;
  for (const Win& win : open) {
    const bool over = at_once ? win.step < last_else : win.turn < last_turn;
    if (over) unpainted_.push_back(win.step);
    else all_known_ = false;
  }
  std::sort(unpainted_.begin(), unpainted_.end());
  // Where each depth is written before the next pixel's turn, that turn tells.
  if (depths_at_once) return;
  for (const Win& win : open_depths)
    if (win.turn < last_turn) unwritten_.push_back(win.step);
    else all_known_ = false;
  std::sort(unwritten_.begin(), unwritten_.end());
}

ColorWrites::Early ColorWrites::early(std::int64_t step) const {
  const auto found = std::lower_bound(early_.begin(), early_.end(), step,
                                      [](const EarlyWrite& one, std::int64_t sought) { return one.step < sought; });
  return found != early_.end() && found->step == step ? found->early : Early::no;
}

}  // namespace zstep
