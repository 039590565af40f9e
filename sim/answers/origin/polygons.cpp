// The back-face test's result, and outcodes.
#include <cmath>

#include "sim/answers/origin/work.hpp"

namespace zstep::answers {
namespace {

std::vector<std::int32_t> corners_at_work(const Work& work) {
  const auto piece = static_cast<std::size_t>(work.machine().piece);
  if (work.machine().piece >= 0 && piece < work.machine().pieces.size()) return work.machine().pieces[piece].outline;
  const auto at = static_cast<std::size_t>(work.machine().facet);
  if (work.machine().facet < 0 || at >= work.scene.facets.size()) return {};
  const Facet& facet = work.scene.facets[at];
  const auto first = work.scene.corners.begin() + facet.first_corner;
  return {first, first + facet.corner_count};
}

}  // namespace

static void tell(Datum& datum, Work& work, std::int64_t step, const FacingTest&, std::string_view field) {
  if (field == "facing") datum.comes_of("by the sign of (p - e)·n", {work.field(step, "view_dot_normal")});
  if (field == "projected_normal_z" && std::isnan(datum.number())) datum.note("a vertex lies behind the eye");
}

static void tell(Datum& datum, Work& work, std::int64_t, const ClipTest&, std::string_view field) {
  std::vector<Number> numbers;
  for (const std::int32_t corner : corners_at_work(work)) {
    if (numbers.size() >= 3 * most_corners) break;
    for (const Axis3 axis : {Axis3::x, Axis3::y, Axis3::z}) numbers.push_back(work.viewed(corner, axis));
  }
  datum.comes_of(field == "outside_some"
                     ? "the vertices' outcodes, or-ed; bits from the right: near, far, left, right, bottom, top"
                     : "the vertices' outcodes, and-ed; bits from the right: near, far, left, right, bottom, top",
                 numbers);
}

void tell_polygons(Datum& datum, Work& work, std::int64_t step, const Event& event, std::string_view field) {
  tell_one_of<FacingTest, ClipTest>(event, [&](const auto& e) { tell(datum, work, step, e, field); });
}

}  // namespace zstep::answers
