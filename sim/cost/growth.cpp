#include "sim/cost/growth.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <optional>

#include "sim/cost/comparison.hpp"
#include "sim/cost/measure.hpp"
#include "sim/cost/operations.hpp"
#include "sim/words/numbers.hpp"
#include "traces/error.hpp"
#include "traces/math/portable_math.hpp"
#include "traces/scene.hpp"

namespace zstep::compare {
namespace {

constexpr unsigned growth_seed = 1;
constexpr double growth_limit = 3;         // seconds that all runs of one point may take
constexpr double clear_difference = 1.05;  // by this factor at least

/// The line's point with so many polygons, if it was measured.
const GrowthPoint* point_at(const GrowthLine& line, int polygons) {
  for (const GrowthPoint& point : line.points)
    if (point.polygons == polygons) return &point;
  return nullptr;
}

/// What two lines cost where both were measured.
struct Pair {
  double polygons, first, other;
  /// Below 0 where the first costs less; on logarithmic axes, where the lines are straight.
  double apart() const { return portable::log(first / other); }
  bool clear() const { return std::abs(apart()) >= portable::log(clear_difference); }
};
std::vector<Pair> pairs_of(const GrowthLine& first, const GrowthLine& other, Measure measure) {
  std::vector<Pair> all;
  for (const GrowthPoint& point : first.points)
    if (const GrowthPoint* there = point_at(other, point.polygons); there && point.by(measure) > 0)
      all.push_back({static_cast<double>(point.polygons), point.by(measure), there->by(measure)});
  return all;
}

/// Who costs least of those measured there: more than one where they are as good as equal.
std::vector<std::size_t> cheapest(const std::vector<GrowthLine>& lines, Measure measure, int polygons) {
  double least = INFINITY;
  for (const GrowthLine& line : lines)
    if (const GrowthPoint* point = point_at(line, polygons)) least = std::min(least, point->by(measure));
  std::vector<std::size_t> all;
  for (std::size_t k = 0; k < lines.size(); ++k)
    if (const GrowthPoint* point = point_at(lines[k], polygons); point && point->by(measure) < clear_difference * least)
      all.push_back(k);
  return all;
}

}  // namespace

std::string_view word_of(Measure measure) { return words_of_measures[measure]; }

double GrowthPoint::by(Measure measure) const {
  return measure == Measure::time    ? seconds
         : measure == Measure::steps ? static_cast<double>(steps)
                                     : static_cast<double>(operations);
}

void measure_more(GrowthLine& line, const Entrant& entrant, int polygons, const std::function<void(double)>& tick) {
  Scene scene = random_scene(polygons, growth_layers, growth_side, growth_seed);
  Conventions conventions;
  conventions.cull = false;
  try {
    check_run(*entrant.method, scene, conventions, "");
    for (const Change& change : entrant.changes) make_change(*entrant.method, change, scene, conventions, "");
  } catch (const InputError&) {
    line.ended = "it cannot draw these scenes";
    return;
  }
  MeasureOptions how;
  how.limit = growth_limit, how.most_runs = 11, how.enough = 0.1;
  const Measured measured = measure(*entrant.method, scene, conventions, how, tick);
  if (!measured.done()) {
    line.ended = measured.end == Apart::End::out_of_time
                     ? fmt::format("{} polygons take it more than {:g} s", grouped(polygons), growth_limit)
                     : "it failed: " + measured.what;
    return;
  }
  line.points.push_back({polygons, measured.steps(), operations(work_in(entrant.method->page(), measured.count)),
                         measured.median_seconds(), size32(measured.seconds)});
}

std::int64_t Crossing::rounded() const {
  const double unit = portable::pow(10, std::max(0.0, std::floor(portable::log10(polygons)) - 1));
  return std::llround(std::round(polygons / unit) * unit);
}

std::vector<Crossing> crossings(const std::vector<GrowthLine>& lines, Measure measure) {
  std::vector<Crossing> all;
  for (std::size_t i = 0; i < lines.size(); ++i)
    for (std::size_t j = i + 1; j < lines.size(); ++j) {
      const std::vector<Pair> pairs = pairs_of(lines[i], lines[j], measure);
      const Pair* last = nullptr;  // that was clear
      std::optional<Crossing> found;
      for (std::size_t k = 0; k < pairs.size(); ++k) {
        if (k > 0 && !found && (pairs[k - 1].apart() < 0) != (pairs[k].apart() < 0)) {
          const Pair &a = pairs[k - 1], &b = pairs[k];
          const double share = a.apart() / (a.apart() - b.apart());
          const auto between = [&](double from, double to) { return from * portable::pow(to / from, share); };
          found = Crossing{i, j, between(a.polygons, b.polygons), between(a.first, b.first)};
        }
        if (!pairs[k].clear()) continue;
        if (last && found && (last->apart() < 0) != (pairs[k].apart() < 0)) {
          if (last->apart() > 0) std::swap(found->first, found->other);
          all.push_back(*found);
        }
        last = &pairs[k];
        found.reset();
      }
    }
  std::stable_sort(all.begin(), all.end(),
                   [](const Crossing& a, const Crossing& b) { return a.polygons < b.polygons; });
  return all;
}

std::string tell_growth(const std::vector<GrowthLine>& lines, Measure measure) {
  std::vector<int> sizes;
  for (const int size : growth_sizes)
    if (std::all_of(lines.begin(), lines.end(), [&](const GrowthLine& line) { return point_at(line, size); }))
      sizes.push_back(size);
  std::string text = fmt::format("By {}: ", word_of(measure));
  const std::vector<Crossing> all = crossings(lines, measure);
  for (const Crossing& crossing : all)
    text += fmt::format("{} costs less than {} up to about {} polygons, and more beyond. ", lines[crossing.first].title,
                        lines[crossing.other].title, grouped(crossing.rounded()));
  const auto titles = [&](const std::vector<std::size_t>& some) {
    std::string names;
    for (const std::size_t k : some) names += (names.empty() ? "" : " and ") + lines[k].title;
    return names + (some.size() == 1 ? " costs least" : " cost least, within a twentieth of each other");
  };
  if (sizes.size() > 1) {
    const auto few = cheapest(lines, measure, sizes.front()), many = cheapest(lines, measure, sizes.back());
    if (all.empty())
      text +=
          fmt::format("From {} to {} polygons no two of them cross. ", grouped(sizes.front()), grouped(sizes.back()));
    text += few == many ? fmt::format("With {} and with {} polygons, {}.", grouped(sizes.front()),
                                      grouped(sizes.back()), titles(few))
                        : fmt::format("With {} polygons {}; with {} {}.", grouped(sizes.front()), titles(few),
                                      grouped(sizes.back()), titles(many));
  }
  for (const GrowthLine& line : lines)
    if (!line.ended.empty()) text += fmt::format(" {}: {}.", line.title, line.ended);
  return text;
}

}  // namespace zstep::compare
