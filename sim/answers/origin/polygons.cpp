// The back-face test in its four formulations, and outcodes.
#include <cmath>

#include "sim/answers/origin/work.hpp"
#include "sim/words/explain.hpp"

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

/// ((p1 - p0) x (p2 - p0)) . v summed over the fan, v being named v_x, v_y, v_z.
std::string fan_times(std::size_t count, const std::string& v) {
  const auto cross = [&](char u, char w) {
    std::string sum;
    for (std::size_t i = 1; i + 1 < count; ++i)
      sum += fmt::format("{4}((p{0}_{2} - p0_{2})*(p{1}_{3} - p0_{3}) - (p{1}_{2} - p0_{2})*(p{0}_{3} - p0_{3}))", i,
                         i + 1, u, w, i > 1 ? " + " : "");
    return sum;
  };
  return fmt::format("{0}_x*({1}) + {0}_y*({2}) + {0}_z*({3})", v, cross('y', 'z'), cross('z', 'x'), cross('x', 'y'));
}

}  // namespace

void tell(Datum& datum, Work& work, std::int64_t step, const FacingTest&, std::string_view field) {
  if (field == "facing") return datum.comes_of("by the sign of (p - e)·n", {work.field(step, "view_dot_normal")});
  const std::vector<std::int32_t> corners = corners_at_work(work);
  if (corners.size() < 3) return;
  const Camera camera = camera_at_work(work.scene, work.machine());
  const bool orthographic = camera.kind == Camera::Kind::orthographic;
  constexpr const char* names[] = {"x", "y", "z"};
  std::vector<Given> given;
  const std::size_t told = std::min(corners.size(), most_corners);
  for (std::size_t i = 0; i < told; ++i)
    for (const Axis3 axis : {Axis3::x, Axis3::y, Axis3::z}) {
      const auto a = static_cast<std::size_t>(axis);
      if (field == "projected_normal_z" && axis == Axis3::z) continue;
      const Number number = field == "determinant"          ? work.viewed(corners[i], axis)
                            : field == "projected_normal_z" ? work.on_raster(corners[i], axis)
                                                            : work.world(corners[i], axis);
      given.push_back({fmt::format("p{}_{}", i, names[a]), number});
    }
  if (corners.size() > most_corners || std::isnan(datum.number())) {
    std::vector<Number> numbers;
    for (const Given& one : given) numbers.push_back(one.number);
    return datum.comes_of(std::isnan(datum.number())
                              ? "a corner lies behind the eye"
                              : fmt::format("summed over {} corners, of which {} are told", corners.size(), told),
                          numbers);
  }
  std::string text;
  if (field == "projected_normal_z") {
    for (std::size_t i = 0; i < told; ++i)
      text += fmt::format("{2}(p{0}_x*p{1}_y - p{1}_x*p{0}_y)", i, (i + 1) % told, i ? " + " : "");
    return datum.is(text, std::move(given), false);
  }
  if (field == "determinant") {
    const auto cross = [&](char u, char w) {
      std::string sum;
      for (std::size_t i = 0; i < told; ++i)
        sum += fmt::format("{4}(p{0}_{2}*p{1}_{3} - p{1}_{2}*p{0}_{3})", i, (i + 1) % told, u, w, i ? " + " : "");
      return sum;
    };
    if (orthographic) return datum.is(cross('x', 'y'), std::move(given), false);
    return datum.is(fmt::format("p0_x*({}) + p0_y*({}) + p0_z*({})", cross('y', 'z'), cross('z', 'x'), cross('x', 'y')),
                    std::move(given), false);
  }
  // (p - e) . n, and A x + B y + C z + D at the eye, which is its negative; n is Newell's.
  for (int axis = 0; axis < 3; ++axis) given.push_back({fmt::format("e_{}", names[axis]), camera.eye[axis]});
  std::string dot = fan_times(told, "s");
  for (const char* name : names) {
    const std::string whole = fmt::format("({}e_{})", orthographic ? "-" : fmt::format("p0_{} - ", name), name);
    for (std::size_t at = dot.find(fmt::format("s_{}*", name)); at != std::string::npos;
         at = dot.find(fmt::format("s_{}*", name), at + 1))
      dot.replace(at, 3, whole);
  }
  datum.is(field == "view_dot_normal" ? dot : "-(" + dot + ")", std::move(given), false);
}

void tell(Datum& datum, Work& work, std::int64_t, const ClipTest&, std::string_view field) {
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

}  // namespace zstep::answers
