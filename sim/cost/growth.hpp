// How costs grow with the number of polygons, and where the cost of one method overtakes another's: measured on the
// scenes of the lecture's table (book_table.hpp), whose polygons cover the same area whatever their number.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "sim/cost/entrant.hpp"

namespace zstep::compare {

/// What a run is measured by.
enum class Measure : std::uint8_t { steps, operations, time };
inline constexpr std::array<std::string_view, 3> words_of_measures{"steps", "operations", "time"};
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
