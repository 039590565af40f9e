// How costs grow with the number of polygons, and where the cost of one method overtakes another's: measured on the
// scenes of the lecture's table (comparison.hpp), whose polygons cover the same area whatever their number.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "sim/cost/comparison.hpp"

namespace zstep::compare {

// Where something begins to go wrong while one number moves: looked for between samples, by halving.

struct Sample {
  double at = 0;           ///< what was moved
  std::int64_t wrong = 0;  ///< how much was wrong there
};

struct Threshold {
  enum class Kind : std::uint8_t {
    none,        ///< nothing is wrong at any sample
    everywhere,  ///< the first sample is wrong already: it begins before
    found,
  };
  /// Where farther on less is wrong: what was found then is a threshold, not the one.
  struct Fall {
    Sample from, to;
  };
  Kind kind = Kind::none;
  double at = 0;  ///< wrong here, and right a thousandth before
  std::optional<Fall> fall;
};

/// `samples` go from where little is wrong to where much is, all above 0; `wrong_at` measures between them. What is
/// measured counts for `fall`, too.
inline Threshold threshold_of(std::vector<Sample> samples, const std::function<std::int64_t(double)>& wrong_at) {
  constexpr double fine = 1e-3;
  Threshold threshold;
  std::size_t first = 0;
  while (first < samples.size() && samples[first].wrong == 0) ++first;
  if (first == samples.size()) return threshold;
  threshold.kind = first == 0 ? Threshold::Kind::everywhere : Threshold::Kind::found;
  if (first > 0) {
    const auto far_apart = [&] {
      const double right = samples[first - 1].at, wrong = samples[first].at;
      return right > wrong * (1 + fine) || wrong > right * (1 + fine);
    };
    while (far_apart()) {
      const double middle = (samples[first - 1].at + samples[first].at) / 2;
      const Sample between{middle, wrong_at(middle)};
      samples.insert(samples.begin() + first, between);
      if (between.wrong == 0) ++first;
    }
  }
  threshold.at = samples[first].at;
  for (std::size_t k = first + 1; k < samples.size() && !threshold.fall; ++k)
    if (samples[k].wrong < samples[k - 1].wrong) threshold.fall = {samples[k - 1], samples[k]};
  return threshold;
}

/// What a run is measured by.
enum class Measure : std::uint8_t { steps, operations, time };
inline constexpr ByEnum<Measure, std::string_view, 3> words_of_measures{"steps", "operations", "time"};
std::string_view word_of(Measure measure);

inline constexpr std::array<int, 6> growth_sizes{25, 100, 250, 1000, 2500, 10000};
inline constexpr std::int32_t growth_side = 128;  ///< pixels of the raster
inline constexpr double growth_layers = 2;        ///< the sum of the polygons' areas, in rasters

struct GrowthPoint {
  int polygons = 0;
  std::int64_t steps = 0, operations = 0;
  double seconds = 0;  ///< the median of runs without a recording
  int runs = 0;
  double by(Measure measure) const;
};
struct GrowthLine {
  std::string title;
  std::vector<GrowthPoint> points;  ///< by growing number of polygons
  std::string ended;                ///< why there are no more; empty: they go on
};

/// Measures one more point, or says why the line ends. `tick` as in measure().
void measure_more(GrowthLine& line, const Entrant& entrant, int polygons, const std::function<void(double)>& tick);

/// Two lines cross: up to `polygons` the first costs less, beyond it the other one. Costs that differ by less than a
/// twentieth count as equal.
struct Crossing {
  std::size_t first = 0, other = 0;
  double polygons = 0, cost = 0;  ///< between the points measured the costs go as powers of the number
  std::int64_t rounded() const;   ///< the number of polygons, to two digits that count
};
std::vector<Crossing> crossings(const std::vector<GrowthLine>& lines, Measure measure);

/// Where they cross and who costs least, in sentences.
std::string tell_growth(const std::vector<GrowthLine>& lines, Measure measure);

}  // namespace zstep::compare
