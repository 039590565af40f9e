#include "algorithms/scan_line/front.hpp"

#include <algorithm>
#include <cmath>

#include "traces/formulas/outlines.hpp"
#include "traces/math/whole.hpp"
#include "traces/record/all_recorders.hpp"
#include "traces/scene.hpp"

namespace zstep::scan_line {

using pieces::Pieces;
using pieces::Plane;

namespace {

// The first pixel whose centre is at or beyond x, 0 … width.
std::int32_t first_pixel(double x, std::int32_t width) {
  if (!(x > 0)) return 0;
  if (x >= width) return width;
  return ceil_int(x);
}

// A depth, and how much of it may be rounding: a plane seen nearly edge-on gives large numbers that cancel.
struct Depth {
  double z, rounding;
};
constexpr double relative_rounding = 1e-13;

Depth depth_of(const Plane& plane, double x, double y) {
  const double size = std::abs(plane.a * x) + std::abs(plane.b * y) + std::abs(plane.d);
  return {plane.depth(x, y), relative_rounding * size / std::abs(plane.c)};
}

bool tie(Depth one, Depth other) { return std::abs(one.z - other.z) <= one.rounding + other.rounding; }
bool nearer(Depth one, Depth other) { return one.z < other.z && !tie(one, other); }

struct Candidate {
  std::int32_t piece;
  Depth left, right;
};

bool before(const Candidate& one, const Candidate& other) {
  if (!tie(one.left, other.left)) return one.left.z < other.left.z;
  if (!tie(one.right, other.right)) return one.right.z < other.right.z;
  return one.piece < other.piece;
}

// Where `other`, which is not in front at the left end, comes to the front of `seen`.
double crossing(const Candidate& seen, const Candidate& other, const Interval& interval) {
  const double left = std::max(0.0, other.left.z - seen.left.z), right = other.right.z - seen.right.z;
  return formulas::part_of_way(interval.x_left, interval.x_right, formulas::where_zero(left, right));
}

// The first pixel right of an implied edge. One whose centre is on it, to rounding, stays with the left piece if that
// was drawn first.
std::int32_t pixel_beyond(double x, std::int32_t left_piece, std::int32_t right_piece, const Interval& interval) {
  constexpr double on_centre = 1e-9;
  const double centre = std::round(x);
  const double from = std::abs(x - centre) > on_centre ? std::ceil(x) : left_piece < right_piece ? centre + 1 : centre;
  return static_cast<std::int32_t>(std::clamp<double>(from, interval.first, interval.last + 1));
}

}  // namespace

Interval interval_between(double y, double x_left, double x_right, std::int32_t width) {
  const double left = std::max(x_left, -0.5), right = std::min(x_right, width - 0.5);
  return {y, left, right, first_pixel(x_left, width), first_pixel(x_right, width) - 1};
}

template <Recorder R>
void find_front(const Pieces& polygons, const std::vector<std::int32_t>& inside, const Interval& interval,
                std::vector<Visible>& visible, R& record) {
  visible.clear();
  const double y = interval.y;
  if (inside.size() == 1) {
    visible.push_back({inside[0], interval});
    return;
  }

  std::vector<Candidate> candidates;
  for (const std::int32_t piece : inside) {
    const Plane& plane = polygons[piece].plane;
    const Depth left = depth_of(plane, interval.x_left, y), right = depth_of(plane, interval.x_right, y);
    record(step::depth, PlaneDepth{piece, interval.x_left, y, left.z});
    record(step::depth, PlaneDepth{piece, interval.x_right, y, right.z});
    candidates.push_back({piece, left, right});
  }

  Interval rest = interval;
  const Candidate* seen = &*std::min_element(candidates.begin(), candidates.end(), before);
  while (true) {
    // Of those that are in front of it at the right end, the one that gets there first.
    const Candidate* next = nullptr;
    double x_next = 0;
    for (const Candidate& other : candidates) {
      if (!nearer(other.right, seen->right)) continue;
      const double x = std::clamp(crossing(*seen, other, interval), rest.x_left, interval.x_right);
      if (next && (x > x_next || (x == x_next && other.right.z >= next->right.z))) continue;
      next = &other;
      x_next = x;
    }
    if (!next) break;

    const double z = polygons[seen->piece].plane.depth(x_next, y);
    record(step::implied_edge, ImpliedEdge{seen->piece, next->piece, x_next, z});
    const std::int32_t beyond = std::max(rest.first, pixel_beyond(x_next, seen->piece, next->piece, interval));
    visible.push_back({seen->piece, {y, rest.x_left, x_next, rest.first, beyond - 1}});
    rest.x_left = x_next;
    rest.first = beyond;
    seen = next;
  }
  visible.push_back({seen->piece, rest});
}

void Coherence::begin_line(const std::vector<std::int32_t>& active) {
  if (active == active_) return;
  active_ = active;
  seen_.assign(active.size(), {});
}

void Coherence::keep(const Pieces& polygons, std::size_t place, const std::vector<Visible>& visible) {
  Seen& seen = seen_[place];
  seen = {};
  if (visible.size() > 2) return;
  if (visible.size() == 2) {
    // z of one minus z of the other is p x + q y + r, and zero on the implied edge.
    const Plane &one = polygons[visible[0].piece].plane, &other = polygons[visible[1].piece].plane;
    const double p = other.a / other.c - one.a / one.c, q = other.b / other.c - one.b / one.c;
    const Interval& left = visible[0].where;
    const double rounding =
        depth_of(one, left.x_right, left.y).rounding + depth_of(other, left.x_right, left.y).rounding;
    constexpr double sharp = 1e-10;  // px: what x may be off by, as it decides about pixels
    if (!(rounding <= sharp * std::abs(p))) return;
    seen = {-1, visible[1].piece, left.x_right, left.y, -q / p};
  }
  seen.left = visible[0].piece;
}

template <Recorder R>
bool Coherence::as_before(const Pieces& polygons, std::size_t place, const std::vector<std::int32_t>& inside,
                          const Interval& interval, std::vector<Visible>& visible, R& record) {
  const Seen& seen = seen_[place];
  if (seen.left == -1) return false;
  const bool implied = seen.right != -1;
  for (const std::int32_t other : inside) {
    if (other == seen.left || other == seen.right) continue;
    if (!lie_apart(polygons, seen.left, other, record)) return false;
    if (implied && !lie_apart(polygons, seen.right, other, record)) return false;
  }
  const auto depths = 2 * size32(inside);
  if (!implied) {
    record(step::saved, Saved{zstep::Coherence::scan_line, depths});
    visible.assign(1, {seen.left, interval});
    return true;
  }

  const double x = seen.x_at(interval.y);
  constexpr double clear = 1e-6;  // px: nearer to an end of the interval than this, depths decide
  if (std::abs(x - interval.x_left) < clear || std::abs(x - interval.x_right) < clear) return false;
  record(step::saved, Saved{zstep::Coherence::implied_edge, depths});
  if (x < interval.x_left || x > interval.x_right) {
    visible.assign(1, {x < interval.x_left ? seen.right : seen.left, interval});
    return true;
  }
  record(step::implied_edge, ImpliedEdge{seen.left, seen.right, x, polygons[seen.left].plane.depth(x, interval.y)});
  const std::int32_t beyond = std::max(interval.first, pixel_beyond(x, seen.left, seen.right, interval));
  visible.assign(1, {seen.left, {interval.y, interval.x_left, x, interval.first, beyond - 1}});
  visible.push_back({seen.right, {interval.y, x, interval.x_right, beyond, interval.last}});
  return true;
}

namespace {

// Where a piece lies against the plane of another: in front of it is towards the eye. A corner counts where the piece's
// own plane has it, as depths are compared there.
template <Recorder R>
Side side_of(const Pieces& polygons, std::int32_t piece, std::int32_t plane_of, R& record) {
  const Plane &own = polygons[piece].plane, &plane = polygons[plane_of].plane;
  double least = no_depth, greatest = -no_depth, size = 0;
  for (const glm::dvec3& corner : polygons.corners(polygons[piece].outline)) {
    const double z = own.depth(corner.x, corner.y), value = plane.value({corner.x, corner.y, z});
    least = std::min(least, value);
    greatest = std::max(greatest, value);
    const double at_corner = std::abs(plane.a * corner.x) + std::abs(plane.b * corner.y) + std::abs(plane.c * z);
    size = std::max(size, at_corner + std::abs(plane.d));
  }
  const double rounding = 100 * relative_rounding * size;
  const bool towards_eye = !(plane.c > 0);
  const Side side = formulas::side_of(towards_eye ? least : -greatest, towards_eye ? greatest : -least, rounding);
  record(step::penetrate, SideTest{piece, plane_of, least, greatest, side});
  return side;
}

bool beyond(Side side) { return side == Side::front || side == Side::behind; }

}  // namespace

template <Recorder R>
bool Coherence::lie_apart(const Pieces& polygons, std::int32_t one, std::int32_t other, R& record) {
  const auto [known, unknown] = apart_.try_emplace(std::minmax(one, other), false);
  if (unknown) {
    known->second = beyond(side_of(polygons, other, one, record)) || beyond(side_of(polygons, one, other, record));
  }
  return known->second;
}

#define INSTANTIATE(R)                                                                                                 \
  template void find_front<R>(const Pieces&, const std::vector<std::int32_t>&, const Interval&, std::vector<Visible>&, \
                              R&);                                                                                     \
  template bool Coherence::as_before<R>(const Pieces&, std::size_t, const std::vector<std::int32_t>&, const Interval&, \
                                        std::vector<Visible>&, R&);
ZSTEP_FOR_EACH_RECORDER(INSTANTIATE)
#undef INSTANTIATE

}  // namespace zstep::scan_line
