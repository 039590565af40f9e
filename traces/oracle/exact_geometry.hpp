// Points, planes, outlines and the rays that meet them in fractions: what is decided about them has no rounding. Of a
// trace, they are known step by step.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <boost/multiprecision/cpp_int.hpp>
#include <glm/vec3.hpp>

#include "traces/formulas/coverage.hpp"
#include "traces/formulas/situation.hpp"
#include "traces/formulas/vectors.hpp"
#include "traces/scene.hpp"

namespace zstep::oracle {

/// A fraction. Without expression templates, so that `auto` holds a number as it does with doubles.
using Rational =
    boost::multiprecision::number<boost::multiprecision::cpp_rational_backend, boost::multiprecision::et_off>;
using Point = formulas::Vector<Rational>;

/// As it is, every digit; throws std::domain_error where it is not finite.
Rational exactly(double value);
Point exactly(const glm::dvec3& point);
/// Rounded once to the nearest double.
double rounded(const Rational& exact);
/// So many digits, rounded: "0.3333", "\u22123.333e-12".
std::string decimals_of(const Rational& exact, int count);
/// The largest whole number that is not above it, and the least that is not below.
Rational floor(const Rational& exact);
Rational ceil(const Rational& exact);

/// A x + B y + C z + D; (A, B, C) of any length, so that there is no square root.
struct Plane {
  Rational a, b, c, d;
  Rational value(const Point& p) const { return a * p.x + b * p.y + c * p.z + d; }
  Rational depth(const Rational& x, const Rational& y) const { return -(a * x + b * y + d) / c; }
  double length() const;  ///< of (A, B, C)
};
/// Newell's normal through the mean of the corners.
Plane plane_of(std::span<const Point> corners);

using Outline = std::span<const Point>;  ///< on the raster; z is left out of account

/// Do the corners turn one way only?
bool is_convex(Outline outline);
/// Is (x, y) inside by the even-odd rule? Of edges the left and the upper ones count.
bool covers(Outline outline, const Rational& x, const Rational& y);
/// Does the edge from `a` to `b` meet the closed rectangle?
bool meets(const Point& a, const Point& b, const Rational& x_0, const Rational& y_0, const Rational& x_1,
           const Rational& y_1);
/// What two convex outlines have in common; empty where it has no area.
std::vector<Point> common_part(Outline one, Outline other);
/// Twice the area, with its sign.
Rational area_of(Outline outline);

}  // namespace zstep::oracle

namespace zstep::formulas {
template <>
inline oracle::Rational to_nearest(const oracle::Rational& x) {
  return oracle::floor(x + oracle::Rational(1, 2));
}
}  // namespace zstep::formulas

namespace zstep::oracle {

// Where the rays from the eye meet facets, in fractions: from the scene's points and the camera.

/// The number in the depth buffer for a point at z_v; in a screen scene z itself.
Rational depth_of_view(const Camera& camera, Conventions::Depth depth, const Rational& z_v);

class ExactRays {
 public:
  ExactRays(const Scene& scene, Conventions::Depth depth) : scene_(scene), depth_(depth) {}

  /// t of the ray through a pixel's centre in a facet's plane, Newell's through the mean of its corners; nothing where
  /// it has none or the ray runs along it.
  std::optional<Rational> meet(std::int32_t facet, std::int32_t x, std::int32_t y);
  /// The depth of such a point.
  Rational depth(const Rational& t) const;

 private:
  struct Ray {
    std::int32_t x = -1, y = -1;
    Point from, along;
  };
  const Ray& ray(std::int32_t x, std::int32_t y);
  const std::optional<Plane>& plane(std::int32_t facet);

  const Scene& scene_;
  Conventions::Depth depth_;
  Ray ray_;  ///< the last one
  std::map<std::int32_t, std::optional<Plane>> planes_;
};

// Vertices and planes as they are without any rounding, while a trace is gone through.

/// What an event's numbers follow from, in fractions: by the formulas of traces/formulas, which are asked with exact
/// operands where these are known and with the recorded ones where not.
using Fields = std::map<std::string_view, Rational>;

class ExactVertices {
 public:
  /// Which numbers count as exact.
  enum class From : std::uint8_t {
    vertices,  ///< each vertex as the method was given it; only what cutting makes is computed anew
    world,     ///< the scene's points and its camera: view, projection, clipping and cutting are computed anew
  };
  explicit ExactVertices(From from) : from_(from) {}

  /// To be called for each step before it is applied; other kinds than these change nothing.
  template <class E>
  void step(const E&, const formulas::Situation&) {}
  void step(const ViewTransform& e, const formulas::Situation& at);
  void step(const Projection& e, const formulas::Situation& at);
  void step(const ViewportTransform& e, const formulas::Situation& at);
  void step(const ClipCross& e, const formulas::Situation& at);
  void step(const SideTest& e, const formulas::Situation&) { cut_by_ = e.plane_of; }
  void step(const SplitVertex& e, const formulas::Situation& at);

  /// (x_s, y_s, depth); nothing where the vertex has not come there, or is not finite.
  std::optional<Point> on_raster(std::int32_t vertex, const formulas::Situation& at) const;
  /// Where pieces are cut: in the world or on the raster.
  std::optional<Point> cutting_point(std::int32_t vertex, const formulas::Situation& at) const;
  /// Of the whole that a piece was cut from; nothing where it encloses no area.
  std::optional<Plane> plane_of(std::int32_t piece, const formulas::Situation& at) const;
  /// The corners of a piece; empty where one is not known.
  std::vector<Point> corners_of(std::int32_t piece, const formulas::Situation& at) const;

  /// The number at a place, where it is known to be other than recorded.
  const Rational* find(const formulas::Place& place) const;

  Fields fields_of(const FacingTest& e, const formulas::Situation& at) const;
  Fields fields_of(const ClipVertex& e, const formulas::Situation& at) const;

 private:
  struct Stages {
    std::optional<Point> world, view, plane, raster;  ///< as VertexStages; plane has (x_p, y_p, z), raster.z is unused
  };
  Stages& stages(std::int32_t vertex) { return stages_[vertex]; }

  From from_;
  std::map<std::int32_t, Stages> stages_;
  std::int32_t cut_by_ = -1;  ///< the piece by whose plane the next cut is
  mutable std::map<std::int32_t, std::optional<Plane>> planes_;
};

}  // namespace zstep::oracle
