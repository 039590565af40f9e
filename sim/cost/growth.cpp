#include "sim/cost/growth.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "sim/cost/book_table.hpp"
#include "sim/cost/measure.hpp"
#include "sim/cost/work.hpp"
#include "sim/words/numbers.hpp"
#include "traces/error.hpp"

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

/// The numbers of polygons at which both were measured and one clearly costs less, with the ratio of their costs.
struct Clear {
  int polygons;
  double first, other;
};
std::vector<Clear> clear_points(const GrowthLine& first, const GrowthLine& other, Measure measure) {
  std::vector<Clear> all;
  for (const GrowthPoint& point : first.points)
    if (const GrowthPoint* there = point_at(other, point.polygons)) {
      const double a = point.by(measure), b = there->by(measure);
      if (a > 0 && b > 0 && std::max(a, b) >= clear_difference * std::min(a, b)) all.push_back({point.polygons, a, b});
    }
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

/// Two digits that count.
std::int64_t rounded_off(double value) {
  const double unit = std::pow(10, std::max(0.0, std::floor(std::log10(value)) - 1));
  return std::llround(std::round(value / unit) * unit);
}

}  // namespace

std::string_view word_of(Measure measure) { return words_of_measures[static_cast<std::size_t>(measure)]; }

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
                         measured.median_seconds(), static_cast<int>(measured.seconds.size())});
}

std::vector<Crossing> crossings(const std::vector<GrowthLine>& lines, Measure measure) {
  std::vector<Crossing> all;
  for (std::size_t i = 0; i < lines.size(); ++i)
    for (std::size_t j = i + 1; j < lines.size(); ++j) {
      const std::vector<Clear> clear = clear_points(lines[i], lines[j], measure);
      for (std::size_t k = 1; k < clear.size(); ++k) {
        const Clear &a = clear[k - 1], &b = clear[k];
        if ((a.first < a.other) == (b.first < b.other)) continue;
        // On logarithmic axes the lines are straight.
        const double before = std::log(a.first / a.other), after = std::log(b.first / b.other);
        const double share = before / (before - after);
        const auto between = [&](double from, double to) { return from * std::pow(to / from, share); };
        const bool first = a.first < a.other;
        all.push_back({first ? i : j, first ? j : i, between(a.polygons, b.polygons), between(a.first, b.first),
                       a.polygons, b.polygons});
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
  std::string text;
  const std::vector<Crossing> all = crossings(lines, measure);
  for (const Crossing& crossing : all)
    text += fmt::format("{} costs less than {} up to about {} polygons, and more beyond. ", lines[crossing.first].title,
                        lines[crossing.other].title, grouped(rounded_off(crossing.polygons)));
  const auto titles = [&](const std::vector<std::size_t>& some) {
    std::string names;
    for (const std::size_t k : some) names += (names.empty() ? "" : " and ") + lines[k].title;
    return names + (some.size() == 1 ? " costs least" : " cost least, as good as the same");
  };
  if (sizes.size() > 1) {
    const auto few = cheapest(lines, measure, sizes.front()), many = cheapest(lines, measure, sizes.back());
    if (all.empty())
      text +=
          fmt::format("From {} to {} polygons no two of them cross. ", grouped(sizes.front()), grouped(sizes.back()));
    text += few == many ? fmt::format("With {} and with {} polygons, {}.", grouped(sizes.front()),
                                      grouped(sizes.back()), titles(few))
                        : fmt::format("With {} polygons {}, with {} {}.", grouped(sizes.front()), titles(few),
                                      grouped(sizes.back()), titles(many));
  }
  for (const GrowthLine& line : lines)
    if (!line.ended.empty()) text += fmt::format("{}{}: {}.", text.empty() ? "" : " ", line.title, line.ended);
  return text;
}

}  // namespace zstep::compare
