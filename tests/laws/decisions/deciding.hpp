// What the judges of decisions share: the exact vertices, planes of whole polygons and facets, and what rounding may do
// to a distance.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <span>
#include <vector>

#include "traces/formulas/of_pieces.hpp"
#include "traces/formulas/of_polygons.hpp"
#include "tests/laws/decisions/decisions.hpp"
#include "traces/oracle/exact_geometry.hpp"

namespace zstep::oracle::deciding {

using formulas::Situation;

inline constexpr double unit = 0x1p-53;  ///< what one rounding does, as a share

enum class Outcome : std::uint8_t { right, open, wrong };
inline Outcome outcome_of(bool right, bool open = false) {
  return right ? Outcome::right : open ? Outcome::open : Outcome::wrong;
}
inline double size_of(const Rational& exact) { return std::abs(rounded(exact)); }
inline double taxi(const glm::dvec3& v) { return std::abs(v.x) + std::abs(v.y) + std::abs(v.z); }
inline double taxi(const Point& p) { return size_of(p.x) + size_of(p.y) + size_of(p.z); }

/// The sum of the terms of Newell's normal without their signs: what its rounding is a share of.
inline double terms_of(std::span<const Point> corners) {
  double terms = 0;
  for (std::size_t i = 1; i + 1 < corners.size(); ++i) {
    const Point a = corners[i] - corners[0], b = corners[i + 1] - corners[0];
    terms += taxi(a) * taxi(b);
  }
  return terms;
}

/// A polygon before anything cut it, or a facet in the world, and its plane where it has one.
struct Wholly {
  std::vector<Point> corners;
  std::optional<Plane> plane;
};

/// A plane's value at a point, as a distance, and what rounding may do to it. In Newell's normal of n corners two
/// differences, a product and a difference round each term by 4u, n - 3 sums by u each, and the division by the length
/// by 3u: (n + 4)u of the terms. That turns the plane about the mean of its corners. Ax + By + Cz + D rounds by 4u of
/// the point's coordinates, which A, B and C make no larger. D rounds by 3u of the mean's, and the mean itself by n u
/// of them where no coordinates cancel in it. Twice (n + 4)u is allowed, and 16u of the coordinates.
struct Distance {
  int sign;
  double size, bound;
};
inline Distance distance(const Plane& plane, std::span<const Point> corners, const Point& p, double slipped = 0) {
  const double length = plane.length();
  Point mean = corners[0];
  for (std::size_t i = 1; i < corners.size(); ++i) mean = mean + corners[i];
  const Rational count(corners.size());
  mean = {mean.x / count, mean.y / count, mean.z / count};
  const double bent = unit * static_cast<double>(8 + 2 * corners.size()) * terms_of(corners) / length;
  const Rational value = plane.value(p);
  return {value.sign(), size_of(value) / length, bent * taxi(p - mean) + 16 * unit * (taxi(p) + taxi(mean)) + slipped};
}

/// What all judges look things up in, and where they note what they found.
class Common {
 public:
  explicit Common(const Trace& t)
      : trace(t),
        plain(t.header().conventions.coverage == Conventions::Coverage::top_left &&
              t.header().conventions.interpolation == Conventions::Interpolation::direct &&
              t.header().conventions.number_format == NumberFormat::float64) {}

  void note(Predicate which, Outcome outcome, double margin = 0, double bound = 0) {
    Decided& decided = decisions[which];
    ++decided.decisions;
    decided.left_open += outcome == Outcome::open;
    if (outcome != Outcome::wrong) return;
    if (decided.wrong++ == 0) decided.first_wrong = step;
    constexpr double beyond = std::numeric_limits<double>::infinity();
    decided.worst = std::max(decided.worst, margin == 0 ? 0 : bound > 0 ? margin / bound : beyond);
  }
  /// How far a vertex is from where it ought to be.
  double slip(std::int32_t vertex, const Situation& at) const {
    const auto exact = vertices.on_raster(vertex, at);
    const auto recorded = at.on_raster(vertex);
    return exact && recorded ? taxi(*exact - exactly(glm::dvec3(recorded->x, recorded->y, recorded->z))) : 0;
  }
  /// The polygon that a piece was cut from.
  const Wholly& whole_of(std::int32_t piece, const Situation& at) {
    const Piece* found = at.piece(piece);
    while (found && found->parent >= 0) piece = found->parent, found = at.piece(piece);
    const auto [known, is_new] = wholes_.try_emplace(piece);
    if (is_new) known->second = {vertices.corners_of(piece, at), vertices.plane_of(piece, at)};
    return known->second;
  }
  /// The same of a point that cutting made.
  double cut_slip(std::int32_t vertex, const Situation& at) const {
    const auto exact = vertices.cutting_point(vertex, at);
    const auto recorded = formulas::detail::cutting_point(at, vertex);
    return exact && recorded ? taxi(*exact - exactly(*recorded)) : 0;
  }
  /// A facet for rays: its plane is that of its corners in the world.
  const Wholly& target(std::int32_t facet, const Situation& at) {
    const auto [known, is_new] = targets_.try_emplace(facet);
    Wholly& found = known->second;
    if (!is_new) return found;
    for (const std::int32_t corner : formulas::detail::corners_of(at, facet))
      found.corners.push_back(exactly(trace.scene().points[corner]));
    if (found.corners.size() < 3) return found;
    const Plane plane = oracle::plane_of(found.corners);
    if (plane.a != 0 || plane.b != 0 || plane.c != 0) found.plane = plane;
    return found;
  }

  const Trace& trace;
  const bool plain;  ///< span ends are where the formulas here say
  std::int64_t step = 0;
  ExactVertices vertices{ExactVertices::From::vertices};
  Decisions decisions;

 private:
  std::map<std::int32_t, Wholly> wholes_, targets_;
};

}  // namespace zstep::oracle::deciding
