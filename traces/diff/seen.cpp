#include "traces/diff/seen.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <utility>
#include <vector>

#include "traces/file/visit.hpp"
#include "traces/formulas/rounding.hpp"
#include "traces/scene.hpp"

namespace zstep::diff {

namespace {

/// Beyond so many painted pixels a wrong order is not looked for.
constexpr std::size_t most_paints = 8'000'000;

/// Of B: a pixel that it paints, and when A does.
struct Paint {
  std::int64_t a = 0;
  std::int64_t begin = 0;  ///< the step by which B begins to draw what it paints here; the pixel's own where none is
  double z = 0;
  std::int32_t polygon = no_polygon;
};

class Order {
 public:
  Order(const Trace& b, const DiffReport& report)
      : b_(b),
        report_(report),
        width_(static_cast<std::size_t>(b.scene().raster.width)),
        pixels_(width_ * static_cast<std::size_t>(b.scene().raster.height)) {}

  void gather() {
    std::size_t match = 0, paints = 0;
    const std::vector<Match>& matches = report_.alignment.by_b;
    std::int64_t drawing = 0;
    b_.visit(0, b_.size(), [&]<class E>(std::int64_t step, std::uint8_t, const E& e) {
      if constexpr (std::is_same_v<E, PieceDraw>) drawing = step;
      if constexpr (std::is_same_v<E, BuffersClear>)
        for (std::vector<Paint>& pixel : pixels_) pixel.clear();
      if constexpr (std::is_same_v<E, PixelPaint>) {
        while (match < matches.size() && matches[match].b + matches[match].count <= step) ++match;
        if (match == matches.size()) return false;
        if (step < matches[match].b) return true;
        const std::int64_t a = matches[match].a + (step - matches[match].b);
        const std::size_t pixel = static_cast<std::size_t>(e.y) * width_ + e.x;
        if (pixel < pixels_.size()) pixels_[pixel].push_back({a, drawing != 0 ? drawing : step, e.z, e.polygon});
        return ++paints < most_paints;
      }
      return true;
    });
  }

  /// Calls too_early(what B paints first, what A paints first, pixel, another one is seen at the end).
  template <class Each>
  void each_wrong(Each&& too_early) const {
    for (std::size_t pixel = 0; pixel < pixels_.size(); ++pixel) {
      const std::vector<Paint>& painted = pixels_[pixel];
      if (std::is_sorted(painted.begin(), painted.end(), [](auto& one, auto& other) { return one.a < other.a; }))
        continue;
      const Paint& last_in_a =
          *std::max_element(painted.begin(), painted.end(), [](auto& one, auto& other) { return one.a < other.a; });
      const bool seen = look_different(last_in_a, painted.back());
      for (std::size_t later = 1; later < painted.size(); ++later)
        for (std::size_t earlier = 0; earlier < later; ++earlier) {
          const Paint &one = painted[earlier], &other = painted[later];
          if (one.a < other.a || one.polygon == other.polygon) continue;
          const bool of_seen = seen && &one == &last_in_a && later + 1 == painted.size();
          const bool covers_nearer = !near(one.z, other.z) && b_.header().comparison.wins(one.z, other.z);
          if (of_seen || covers_nearer) too_early(one, other, pixel, of_seen);
        }
    }
  }

 private:
  bool near(double one, double other) const {
    return formulas::gives(formulas::Rounded(one), other, report_.precision.relative) ||
           std::abs(one - other) <= report_.precision.absolute;
  }
  bool look_different(const Paint& one, const Paint& other) const {
    const auto& polygons = b_.scene().polygons;
    const auto color = [&](const Paint& of) {
      const std::size_t number = of.polygon;
      return number < polygons.size() ? polygons[number].color : Color{};
    };
    return one.polygon != other.polygon && (!(color(one) == color(other)) || !near(one.z, other.z));
  }

  const Trace& b_;
  const DiffReport& report_;
  std::size_t width_;
  std::vector<std::vector<Paint>> pixels_;
};

/// Do steps of this kind only put colours and depths into pixels, so that no order follows from them?
bool fills_pixels(std::uint8_t kind) {
  return kind == kind_of<PixelPaint> || kind == kind_of<SpanBegin> || kind == kind_of<EdgeStep> ||
         kind == kind_of<EdgeTableInsert> || kind == kind_of<EdgeEnter> || kind == kind_of<EdgeRetire>;
}

}  // namespace

namespace {

/// The last compare at a pixel before a step of one run whose partner comes after a step of the other run; 0 for none.
template <class Partner>
std::int64_t earlier_here(const Trace& run, const Trace::Among& compares, std::int64_t step, std::int64_t other_step,
                          Partner&& partner) {
  const auto found = run.previous_at(
      step, [&](std::int64_t at, const RecordedEvent&) { return partner(at) > other_step; }, compares);
  return found.value_or(0);
}

}  // namespace

void find_other_order(const Trace& a, const Trace& b, DiffReport& report) {
  const Alignment& alignment = report.alignment;
  for (Cause& cause : report.causes) {
    if (!cause.operands_differ || !has(at_pixel_of(cause.first.kind), AtPixel::verdict)) continue;
    const Trace::Among here(pixel_of(a.event(cause.first.a).event), cause.first.kind);
    const auto in_b = [&](std::int64_t step) { return alignment.in_b(step); };
    const auto in_a = [&](std::int64_t step) { return alignment.in_a(step); };
    if (const std::int64_t one = earlier_here(a, here, cause.first.a, cause.first.b, in_b))
      cause.other_order = OtherOrder{one, in_b(one), true};
    else if (const std::int64_t other = earlier_here(b, here, cause.first.b, cause.first.a, in_a))
      cause.other_order = OtherOrder{in_a(other), other, false};
  }
}

void find_wrong_order(const Trace& b, DiffReport& report) {
  const std::vector<Match>& matches = report.alignment.by_b;
  const auto earlier_in_a = [](const Match& one, const Match& other) { return one.a < other.a; };
  if (std::is_sorted(matches.begin(), matches.end(), earlier_in_a) || !b.has(kind_of<PixelPaint>) ||
      !report.alignment.complete)
    return;
  Order order(b, report);
  order.gather();

  std::set<std::int64_t> steps, pixels;
  Cause wrong;
  order.each_wrong([&](const Paint& one, const Paint& other, std::size_t pixel, bool seen) {
    // Where both are drawn in A's order, one of the two pixels is of another piece there.
    const std::int64_t begin = report.alignment.in_a(one.begin), begin_other = report.alignment.in_a(other.begin);
    if (begin != 0 && begin < begin_other) return;
    steps.insert(one.begin);
    if (seen) pixels.insert(static_cast<std::int64_t>(pixel));
    if (wrong.too_early && wrong.first.b <= one.begin) return;
    wrong.first.b = one.begin, wrong.first.a = report.alignment.in_a(one.begin);
    const std::int32_t width = b.scene().raster.width;
    const auto place = index32(pixel);
    wrong.too_early = TooEarly{other.begin, place % width, place / width, one.z, other.z};
  });
  if (!wrong.too_early || wrong.first.a == 0) return;
  const RecordedEvent step = b.event(wrong.first.b);
  wrong.first.kind = static_cast<std::uint8_t>(step.event.index()), wrong.first.line = step.step;
  wrong.again = std::ssize(steps) - 1, wrong.pixels = std::ssize(pixels);

  const auto by_b = [&](const Cause& cause) {
    return cause.first.only_a() ? report.alignment.before_in_b(cause.first.a) : cause.first.b;
  };
  // An order that was decided otherwise before, in a list or a tree, shows here and is no mistake of its own.
  for (Cause& cause : report.causes)
    if (cause.part == Part::different && !fills_pixels(cause.first.kind) && by_b(cause) <= wrong.first.b) {
      cause.symptoms += wrong.again + 1;
      return;
    }
  const auto place = std::find_if(report.causes.begin(), report.causes.end(), [&](const Cause& cause) {
    return cause.part == Part::rounding || by_b(cause) > wrong.first.b;
  });
  auto& differences = report.alignment.differences;
  differences.insert(std::find_if(differences.begin(), differences.end(),
                                  [&](const Difference& one) { return one.b > wrong.first.b; }),
                     wrong.first);
  report.causes.insert(place, std::move(wrong));
}

namespace {

using Pixel = std::pair<std::int32_t, std::int32_t>;

/// Takes note of what a run does at some pixels.
class Watching {
 public:
  Watching(const Trace& trace, const std::vector<SeenApart>& groups) {
    for (const SeenApart& group : groups) watched_.try_emplace(Pixel{group.x, group.y});
    trace.visit(0, trace.size(), [&]<class E>(std::int64_t step, std::uint8_t, const E& e) { return see(step, e); });
  }
  DrawnAt of(const SeenApart& group, std::int32_t polygon) const {
    const auto& here = watched_.at(Pixel{group.x, group.y});
    const auto found = here.find(polygon);
    return found == here.end() ? DrawnAt{} : found->second;
  }

 private:
  template <class E>
  bool see(std::int64_t step, const E& e) {
    if constexpr (std::is_same_v<E, PassBegin>) light_ = e.pass == Pass::light;
    if constexpr (std::is_same_v<E, PolygonBegin> || std::is_same_v<E, PieceDraw>) polygon_ = e.polygon;
    if constexpr (std::is_same_v<E, EdgeTableInsert>) owner_[e.edge] = e.polygon;
    if constexpr (std::is_same_v<E, SpanBegin>)
      if (const auto owner = owner_.find(e.left_edge); owner != owner_.end()) polygon_ = owner->second;
    if (light_) return true;
    if constexpr (std::is_same_v<E, BuffersClear>)
      for (auto& [pixel, drawn] : watched_) drawn.clear();
    if constexpr (has(at_pixel<E>, AtPixel::verdict)) {
      if (const auto here = watched_.find(Pixel{e.x, e.y}); here != watched_.end())
        here->second[polygon_].found = step, here->second[polygon_].z = e.z;
    } else if constexpr (std::is_same_v<E, PixelWrite> || std::is_same_v<E, PixelPaint>) {
      if (const auto here = watched_.find(Pixel{e.x, e.y}); here != watched_.end()) {
        here->second[e.polygon].step = step;
        if constexpr (std::is_same_v<E, PixelPaint>) here->second[e.polygon].z = e.z;
      }
    }
    return true;
  }

  std::map<Pixel, std::map<std::int32_t, DrawnAt>> watched_;
  std::map<std::int32_t, std::int32_t> owner_;  ///< of edges
  std::int32_t polygon_ = no_polygon;
  bool light_ = false;
};

}  // namespace

std::vector<SeenApart> seen_apart(const Trace& a, const Picture& end_a, const Trace& b, const Picture& end_b) {
  std::map<std::pair<std::int32_t, std::int32_t>, SeenApart> by_pair;
  for (std::int32_t y = 0; y < end_a.height; ++y)
    for (std::int32_t x = 0; x < end_a.width; ++x) {
      const std::int32_t one = end_a.polygon[end_a.at(x, y)], other = end_b.polygon[end_b.at(x, y)];
      if (one == other) continue;
      SeenApart& group = by_pair[{one, other}];
      if (++group.pixels == 1) group.polygon_a = one, group.polygon_b = other, group.x = x, group.y = y;
    }
  std::vector<SeenApart> groups;
  for (const auto& [pair, group] : by_pair) groups.push_back(group);
  std::stable_sort(groups.begin(), groups.end(),
                   [](const SeenApart& one, const SeenApart& other) { return one.pixels > other.pixels; });
  constexpr std::size_t most = 10;
  if (groups.size() > most) groups.resize(most);
  if (groups.empty()) return groups;
  const Watching in_a(a, groups), in_b(b, groups);
  for (SeenApart& group : groups) {
    group.a_in_a = in_a.of(group, group.polygon_a), group.b_in_a = in_a.of(group, group.polygon_b);
    group.a_in_b = in_b.of(group, group.polygon_a), group.b_in_b = in_b.of(group, group.polygon_b);
  }
  return groups;
}

}  // namespace zstep::diff
