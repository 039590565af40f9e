// A polygon that is drawn as triangles, each as three half-planes: which edge, or which tile, leaves a pixel out.

#include <algorithm>
#include <array>
#include <limits>

#include "sim/answers/why_not_parts.hpp"
#include "sim/answers/seen_point.hpp"
#include "traces/formulas/half_space.hpp"

namespace zstep::answers {
namespace {

template <class E>
bool has_pixel(const E& tile, Trace::Pixel pixel) {
  return pixel.x >= tile.first_column && pixel.x < tile.end_column && pixel.y >= tile.first_row &&
         pixel.y < tile.end_row;
}

/// Calls look(step, event) for the steps of one facet, from its mark on.
template <class Look>
void each_of_facet(const Asked& q, std::int64_t mark, Look&& look) {
  q.trace.each(mark, next_mark(q.trace, mark) - 1, [&](std::int64_t step, const RecordedEvent& recorded) {
    look(step, recorded.event);
    return true;
  });
}

/// "the pixel's centre lies on the wrong side of e1: E_1(3, 4) = −2.5 < 0"
std::string beyond_text(const InsideTest& test, const std::vector<bool>& owns, const Raster& raster) {
  const std::array<double, 3> values{test.e_0, test.e_1, test.e_2};
  std::size_t worst = 0;
  for (std::size_t i = 1; i < 3; ++i)
    if (values[i] < values[worst]) worst = i;
  const std::string of = fmt::format("E_{}({}, {})", worst, test.x, test.y);
  if (values[worst] < 0)
    return fmt::format("the pixel's {} lies on the wrong side of e{}: {} = {} < 0", seen_point(raster), worst, of,
                       number(values[worst]));
  for (std::size_t i = 0; i < 3; ++i)
    if (values[i] == 0 && i < owns.size() && !owns[i])
      return fmt::format("the pixel's {3} lies on e{0}, which the triangle does not own: E_{0}({1}, {2}) = 0", i,
                         test.x, test.y, seen_point(raster));
  return fmt::format("the trace says that the pixel's {} lies outside, though {} = {}", seen_point(raster), of,
                     number(values[worst]));
}

}  // namespace

std::optional<LeftOut> left_out_by_triangles(const Asked& q, std::int64_t mark) {
  if (mark == 0 || !q.trace.has(kind_of<EdgeFunction>)) return std::nullopt;
  std::optional<LeftOut> found;
  double nearest = -std::numeric_limits<double>::infinity();
  int tests = 0;
  std::vector<bool> owns;
  each_of_facet(q, mark, [&](std::int64_t step, const Event& event) {
    if (const auto* edge = get_if<EdgeFunction>(&event)) {
      if (edge->edge_function == 0) owns.clear();
      owns.push_back(edge->owns);
    }
    if (const auto* tile = get_if<TileTest>(&event);
        tile && tile->cover == TileCover::outside && has_pixel(*tile, q.pixel) && !found)
      found = LeftOut{step, "the tile around the pixel lies beyond one edge, and was rejected as a whole"};
    const auto* test = get_if<InsideTest>(&event);
    if (!test || test->inside || test->x != q.pixel.x || test->y != q.pixel.y) return;
    const double value = std::min({test->e_0, test->e_1, test->e_2});
    ++tests;
    if (value > nearest) nearest = value, found = LeftOut{step, beyond_text(*test, owns, q.scene.raster)};
  });
  if (found && tests > 1) found->text += ", in the one of its triangles that comes nearest";
  return found;
}

std::optional<Verdict> why_tile_hidden(Asked& q, const std::vector<FacetThere>& facets,
                                       const std::vector<Visit>& visits) {
  if (!q.trace.has(kind_of<TileDepthTest>)) return std::nullopt;
  for (const FacetThere& there : facets) {
    if (there.mark == 0 || !there.covers()) continue;
    std::optional<std::pair<std::int64_t, TileDepthTest>> hidden;
    each_of_facet(q, there.mark, [&](std::int64_t step, const Event& event) {
      const auto* tile = get_if<TileDepthTest>(&event);
      if (tile && !tile->nearer && has_pixel(*tile, q.pixel)) hidden = {step, *tile};
    });
    if (!hidden) continue;
    const auto [nearest, farthest] = told_apart(hidden->second.z_nearest, hidden->second.z_farthest);
    Verdict verdict = q.verdict(Why::lost, hidden->first,
                                fmt::format("at step {} the tile around the pixel was rejected: its nearest {} there, "
                                            "{}, is not nearer than the farthest that was stored in it, {}",
                                            grouped(hidden->first), q.z, nearest, farthest));
    verdict.gap = q.trace.header().comparison.behind(hidden->second.z_nearest, hidden->second.z_farthest);
    if (const Visit* holding = holder(visits, hidden->first)) verdict.other = holding->shows;
    verdict.facet = there.facet;
    q.add_formulas(verdict, hidden->first);
    verdict.chain.push_back({hidden->first, q.polygon, fmt::format("a tile is too far for {}", q.name)});
    return verdict;
  }
  return std::nullopt;
}

}  // namespace zstep::answers
