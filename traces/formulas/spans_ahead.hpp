// To which span a pixel belongs. A program may print several spans, or all of a polygon, a scan line or the scene, and
// their pixels afterwards: the spans that no pixel came between are kept together.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>
#include <type_traits>
#include <vector>

#include "traces/events/vocabulary.hpp"
#include "traces/file/trace.hpp"
#include "traces/scene.hpp"

namespace zstep::formulas {

class SpansAhead {
 public:
  struct Open {
    SpanBegin span{};
    std::int32_t polygon = no_polygon;  ///< that it is a part of, where that is known
    std::int64_t step = 0;              ///< that began it, where who goes through the run says so
    std::vector<bool> came{};           ///< by column from `first`, which of its pixels came
    std::int32_t x_last = -2;           ///< its last pixel that came, and its depth; beside all columns at first
    double z_last = 0;
  };

  bool of_all = false;        ///< the run prints spans of several polygons before any pixel
  bool interpolates = false;  ///< it says of each pixel how its depth is interpolated, before all else
  bool reciprocal = false;    ///< what is interpolated is the reciprocal of the depth

  template <class E>
  static constexpr bool is_of_pixel = zstep::has(at_pixel<E>, AtPixel::depth);
  /// Is it the first step of each pixel?
  template <class E>
  bool opens_pixel() const {
    return is_of_pixel<E> && !(zstep::has(at_pixel<E>, AtPixel::verdict) && interpolates);
  }

  const std::vector<Open>& spans() const { return spans_; }
  bool has_pixels() const { return has_pixels_; }
  static bool covers(const SpanBegin& span, std::int32_t x, std::int32_t y) {
    return y == span.y && x >= span.first && x <= span.last;
  }

  void begin(std::int32_t polygon) {
    turn_ = polygon;
    if (!of_all) return clear();
    its_own_ = std::any_of(spans_.begin(), spans_.end(), [&](const Open& open) { return open.polygon == polygon; });
  }
  void add(const SpanBegin& span, std::optional<std::int32_t> polygon, std::int64_t step = 0) {
    if (has_pixels_) clear();
    const std::size_t y = std::max(0, span.y);
    if (y >= lines_.size()) lines_.resize(y + 1);
    lines_[y].push_back(spans_.size());
    const std::int32_t count = std::max(0, span.last - span.first + 1);
    spans_.push_back({span, polygon.value_or(turn_), step, std::vector<bool>(static_cast<std::size_t>(count))});
    its_own_ = false;
  }
  /// The span that a pixel that comes now belongs to: of those that cover it one whose pixel has not come. Of several,
  /// as of two polygons on one line, the one at work, or the first, unless the depth says clearly that it is another's.
  std::optional<std::size_t> find(std::int32_t x, std::int32_t y, double z) const {
    const std::size_t row = y;
    if (y < 0 || row >= lines_.size()) return std::nullopt;
    const std::vector<std::size_t>& line = lines_[row];
    if (line.size() == 1) return may_own(line.front(), x, y) ? std::optional(line.front()) : std::nullopt;
    std::optional<std::size_t> best, any;
    const auto off = [&](std::size_t number) {
      return std::abs(depth_at(spans_[number].span, x) - (reciprocal ? 1 / z : z));
    };
    const auto consider = [&](std::size_t number) {
      if (!may_own(number, x, y)) return;
      any = number;
      if (spans_[number].came[x - spans_[number].span.first]) return;
      constexpr double clearly = 8;
      if (!best || clearly * off(number) < off(*best)) best = number;
    };
    if (last_ && last_->number < spans_.size()) consider(last_->number);
    constexpr std::size_t most = 4096;  // polygons over one pixel, and of them the first
    for (std::size_t i = 0; i < std::min(most, line.size()); ++i) consider(line[i]);
    return best ? best : any;
  }
  /// The same of any step at a pixel, which comes next, or has `passed`.
  template <class E>
  std::optional<std::size_t> span_of(const E& e, bool has_passed = false) const {
    if constexpr (is_of_pixel<E>) {
      if (has_passed || !opens_pixel<E>())
        if (const auto number = at_work(e.x, e.y)) return number;
      return find(e.x, e.y, e.z);
    } else {
      return at_work(e.x, e.y);
    }
  }
  /// The same of a pixel that is at work: what it began with.
  std::optional<std::size_t> at_work(std::int32_t x, std::int32_t y) const {
    if (last_ && last_->x == x && last_->y == y) return last_->number;
    return std::nullopt;
  }
  /// After a step at a pixel.
  template <class E>
  void pass(const E& e) {
    if constexpr (is_of_pixel<E>)
      if (opens_pixel<E>() || !at_work(e.x, e.y)) take(e.x, e.y, e.z);
  }

  /// Its pixels came, and are not looked at one by one.
  void pass_pixels() { has_pixels_ = true; }

  /// May this polygon be seen at a pixel of this depth, as far as its spans say? Of equal depths it may be any.
  bool may_be(std::int32_t polygon, std::int32_t x, std::int32_t y, double z) const {
    const auto own = at_work(x, y);
    if (!own || y < 0 || y >= std::ssize(lines_)) return true;
    const double sought = reciprocal ? 1 / z : z;
    const double off = std::abs(depth_at(spans_[*own].span, x) - sought);
    constexpr double rounded = 1e-6, clearly = 8;
    for (const std::size_t number : lines_[y]) {
      const Open& open = spans_[number];
      if (open.polygon == polygon && covers(open.span, x, y) &&
          std::abs(depth_at(open.span, x) - sought) <= clearly * off + rounded * std::abs(sought))
        return true;
    }
    return false;
  }

 private:
  struct Last {
    std::size_t number = 0;
    std::int32_t x = 0, y = 0;
  };

  void take(std::int32_t x, std::int32_t y, double z) {
    has_pixels_ = true;
    last_.reset();
    const auto number = find(x, y, z);
    if (!number) return;
    Open& open = spans_[*number];
    open.came[x - open.span.first] = true;
    open.x_last = x, open.z_last = z;
    last_ = Last{*number, x, y};
  }
  void clear() {
    for (const Open& open : spans_) lines_[std::max(0, open.span.y)].clear();
    spans_.clear(), last_.reset();
    has_pixels_ = its_own_ = false;
  }
  /// Where a polygon that has some began after all spans, only its own.
  bool may_own(std::size_t number, std::int32_t x, std::int32_t y) const {
    const Open& open = spans_[number];
    return covers(open.span, x, y) && (!its_own_ || open.polygon == turn_);
  }
  static double depth_at(const SpanBegin& span, std::int32_t x) {
    if (span.x_right == span.x_left) return span.z_left;
    return span.z_left + (span.z_right - span.z_left) * (x - span.x_left) / (span.x_right - span.x_left);
  }

  std::vector<Open> spans_;
  std::vector<std::vector<std::size_t>> lines_;  ///< by scan line, the numbers of its spans
  std::optional<Last> last_;                     ///< the pixel at work
  bool has_pixels_ = false;
  bool its_own_ = false;  ///< the polygon that began last has spans that came before it did
  std::int32_t turn_ = no_polygon;
};

/// Before the first step of a trace.
inline SpansAhead spans_ahead_of(const Trace& trace, const Conventions& conventions) {
  SpansAhead ahead;
  ahead.of_all = trace.spans_at_once() == Trace::SpansAtOnce::of_all;
  ahead.interpolates = trace.has(kind_of<DepthInterpolate>);
  ahead.reciprocal = conventions.depth == Conventions::Depth::corrected;
  return ahead;
}

}  // namespace zstep::formulas
