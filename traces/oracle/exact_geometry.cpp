#include "traces/oracle/exact_geometry.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <vector>

#include "traces/formulas/of_pieces.hpp"
#include "traces/formulas/of_polygons.hpp"
#include "traces/formulas/outlines.hpp"
#include "traces/formulas/situation.hpp"
#include "traces/formulas/viewing.hpp"
#include "traces/oracle/exact_depth.hpp"
#include "traces/scene.hpp"

namespace zstep::oracle {

namespace {

Rational turn(const Point& a, const Point& b, const Point& c) {
  return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}
const Point& next_of(Outline outline, std::size_t i) { return outline[i + 1 < outline.size() ? i + 1 : 0]; }

}  // namespace

Rational exactly(double value) {
  if (!std::isfinite(value)) throw std::domain_error("a number that is not finite");
  return Rational(value);
}
Point exactly(const glm::dvec3& point) { return {exactly(point.x), exactly(point.y), exactly(point.z)}; }

double rounded(const Rational& exact) { return quotient(Whole(numerator(exact)), Whole(denominator(exact))); }

std::string decimals_of(const Rational& exact, int count) {
  if (exact == 0) return "0";
  const Whole over = abs(Whole(numerator(exact))), under = denominator(exact);
  constexpr double tenfold = 0.30102999566398120;  // log10 2
  int exponent = static_cast<int>((static_cast<double>(msb(over)) - static_cast<double>(msb(under))) * tenfold);
  std::string digits;
  for (bool fits = false; !fits;) {
    Whole above = over, below = under;
    const int places = count - 1 - exponent;
    (places > 0 ? above : below) *= pow(Whole(10), static_cast<unsigned>(std::abs(places)));
    digits = Whole((2 * above + below) / (2 * below)).str();
    fits = size32(digits) == count;
    if (!fits) exponent += size32(digits) > count ? 1 : -1;
  }
  const std::string sign = exact < 0 ? "\u2212" : "";
  if (exponent < -6 || exponent >= count - 1)
    return sign + digits.substr(0, 1) + "." + digits.substr(1) + "e" + std::to_string(exponent);
  if (exponent < 0) return sign + "0." + std::string(-exponent - 1, '0') + digits;
  const std::size_t whole = exponent + 1;
  return sign + digits.substr(0, whole) + "." + digits.substr(whole);
}

Rational floor(const Rational& exact) {
  const Rational towards_zero(Whole(Whole(numerator(exact)) / Whole(denominator(exact))));
  return exact < towards_zero ? Rational(towards_zero - 1) : towards_zero;
}
Rational ceil(const Rational& exact) { return -floor(-exact); }

double Plane::length() const { return std::sqrt(rounded(a * a + b * b + c * c)); }

Plane plane_of(std::span<const Point> corners) {
  Point normal{0, 0, 0}, sum = corners[0];
  for (std::size_t i = 1; i < corners.size(); ++i) {
    if (i + 1 < corners.size()) normal = normal + cross(corners[i] - corners[0], corners[i + 1] - corners[0]);
    sum = sum + corners[i];
  }
  return {normal.x, normal.y, normal.z, -dot(normal, sum) / Rational(corners.size())};
}

bool is_convex(Outline outline) {
  int way = 0;
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const int sign = turn(outline[i], next_of(outline, i), next_of(outline, (i + 1) % outline.size())).sign();
    if (sign != 0 && way != 0 && sign != way) return false;
    if (sign != 0) way = sign;
  }
  // Five corners and more may go round twice and turn one way all along.
  return way != 0 && outline.size() <= 4;
}

bool covers(Outline outline, const Rational& x, const Rational& y) {
  bool inside = false;
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const Point &a = outline[i], &b = next_of(outline, i);
    if ((a.y <= y) == (b.y <= y)) continue;
    if (formulas::on_line(a.x, b.x, y, a.y, b.y) <= x) inside = !inside;
  }
  return inside;
}

bool meets(const Point& a, const Point& b, const Rational& x_0, const Rational& y_0, const Rational& x_1,
           const Rational& y_1) {
  if (std::max(a.x, b.x) < x_0 || std::min(a.x, b.x) > x_1 || std::max(a.y, b.y) < y_0 || std::min(a.y, b.y) > y_1)
    return false;
  bool above = false, below = false;
  for (const Rational& x : {x_0, x_1})
    for (const Rational& y : {y_0, y_1}) {
      const int side = turn(a, b, {x, y, 0}).sign();
      above = above || side >= 0, below = below || side <= 0;
    }
  return above && below;
}

Rational area_of(Outline outline) {
  Rational area = 0;
  for (std::size_t i = 1; i + 1 < outline.size(); ++i) area += turn(outline[0], outline[i], outline[i + 1]);
  return area;
}

std::vector<Point> common_part(Outline one, Outline other) {
  const int way = area_of(other).sign();
  std::vector<Point> part(one.begin(), one.end());
  for (std::size_t i = 0; i < other.size() && way != 0; ++i) {
    std::vector<Point> kept;
    for (std::size_t k = 0; k < part.size(); ++k) {
      const Point &from = part[k], &to = next_of(part, k);
      const Point &a = other[i], &b = next_of(other, i);
      const Rational d_0 = turn(a, b, from) * way, d_1 = turn(a, b, to) * way;
      if (d_0 >= 0) kept.push_back(from);
      if (d_0.sign() * d_1.sign() >= 0) continue;
      const Rational t = formulas::where_zero(d_0, d_1);
      kept.push_back({formulas::part_of_way(from.x, to.x, t), formulas::part_of_way(from.y, to.y, t), 0});
    }
    part = std::move(kept);
    if (part.empty()) return part;
  }
  if (way == 0 || area_of(part) == 0) part.clear();
  return part;
}

namespace {

Point scaled(const Point& p, const Rational& by) { return {p.x * by, p.y * by, p.z * by}; }
Point cross(const Point& a, const Point& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

}  // namespace

Rational depth_of_view(const Camera& camera, Conventions::Depth depth, const Rational& z_v) {
  if (camera.kind == Camera::Kind::screen) return z_v;
  return formulas::vertex_depth(formulas::depth_scale(camera, depth, [](double number) { return exactly(number); }),
                                z_v);
}

const ExactRays::Ray& ExactRays::ray(std::int32_t x, std::int32_t y) {
  if (ray_.x == x && ray_.y == y) return ray_;
  ray_.x = x, ray_.y = y;
  const Camera& camera = scene_.camera;
  if (camera.kind == Camera::Kind::screen) {
    ray_.from = {x, y, 0}, ray_.along = {0, 0, 1};
    return ray_;
  }
  const auto row = [&](int i) { return exactly(glm::dvec3(camera.view[0][i], camera.view[1][i], camera.view[2][i])); };
  Point right = row(0), up = row(1), away = row(2);
  if (camera.matrices) {  // the columns of the inverse (formulas::axes_of_view)
    const Point across = cross(up, away);
    const Rational by = Rational(1) / (right.x * across.x + right.y * across.y + right.z * across.z);
    const Point axes[] = {scaled(across, by), scaled(cross(away, right), by), scaled(cross(right, up), by)};
    right = axes[0], up = axes[1], away = axes[2];
  }
  const Rational width = scene_.raster.width, height = scene_.raster.height, w_y = exactly(camera.window),
                 w_x = formulas::window_width(w_y, width, height);
  const Rational x_p = formulas::ray_x(Rational(x), w_x, width, scene_.raster),
                 y_p = formulas::ray_y(Rational(y), w_y, height, scene_.raster);
  const Point across = scaled(right, x_p) + scaled(up, y_p);
  if (camera.kind == Camera::Kind::orthographic) {
    const Point origin = exactly(glm::dvec3(camera.view[3]));  // of the world, in view coordinates
    ray_.from = across - (scaled(right, origin.x) + scaled(up, origin.y) + scaled(away, origin.z));
    ray_.along = away;
  } else {
    ray_.from = exactly(camera.eye), ray_.along = across + scaled(away, exactly(camera.d));
  }
  return ray_;
}

const std::optional<Plane>& ExactRays::plane(std::int32_t facet) {
  const auto [known, is_new] = planes_.try_emplace(facet);
  if (!is_new || facet < 0 || facet >= std::ssize(scene_.facets)) return known->second;
  const Facet& entry = scene_.facets[facet];
  std::vector<Point> corners;
  for (std::int32_t i = 0; i < entry.corner_count; ++i) {
    const std::int32_t corner = scene_.corners[entry.first_corner + i];
    const glm::dvec3& point = scene_.points[corner];
    if (!std::isfinite(point.x + point.y + point.z)) return known->second;
    corners.push_back(exactly(point));
  }
  if (corners.size() >= 3) known->second = plane_of(corners);
  return known->second;
}

std::optional<Rational> ExactRays::meet(std::int32_t facet, std::int32_t x, std::int32_t y) {
  const std::optional<Plane>& on = plane(facet);
  if (!on) return std::nullopt;
  const Ray& through = ray(x, y);
  const Rational slope = on->a * through.along.x + on->b * through.along.y + on->c * through.along.z;
  if (slope == 0) return std::nullopt;
  return -on->value(through.from) / slope;
}

Rational ExactRays::depth(const Rational& t) const {
  const bool perspective = scene_.camera.kind == Camera::Kind::perspective;
  return depth_of_view(scene_.camera, depth_, perspective ? t * exactly(scene_.camera.d) : t);
}

namespace {

using formulas::Place, formulas::Situation;

/// Asks a formula with fractions, and keeps what it gives.
template <class E>
struct Asked {
  using Number = Rational;
  const ExactVertices& vertices;
  Fields& given;

  Number number(std::string_view name, double value, const Place& place) {
    const auto known = given.find(name);
    if (place.in == Place::In::event && known != given.end()) return known->second;
    if (const Rational* exact = vertices.find(place)) return *exact;
    return exactly(value);
  }
  Number named(std::string_view, const Number& formula) { return formula; }
  void reads(const Place&) {}
  bool trusts(const Place&) const { return true; }
  bool equal(double one, double other) const { return one == other; }
  void rule(formulas::Rule, bool) {}
  void gives(formulas::Follows<E, double> field, const Number& formula) { given[field.name] = formula; }
  void within(formulas::Follows<E, double> field, const Number& formula, double) { given[field.name] = formula; }
  void near(formulas::Follows<E, double>, const formulas::Rounded&) {}
  template <class Value>
  void is(std::type_identity_t<formulas::Follows<E, Value>>, Value) {}
};

/// Of an event; nothing where an operand is not finite or something would be divided by 0.
template <class E>
Fields ask(const ExactVertices& vertices, const E& e, const Situation& at, Fields known = {}) {
  try {
    Asked<E> asked{vertices, known};
    formulas::derive(e, at, asked);
  } catch (const std::domain_error&) {
    return {};
  } catch (const std::overflow_error&) {
    return {};
  }
  return known;
}

std::optional<Point> point_in(const Fields& fields, const formulas::Stage& names) {
  const auto x = fields.find(names[0]), y = fields.find(names[1]), z = fields.find(names[2]);
  if (x == fields.end() || y == fields.end() || z == fields.end()) return std::nullopt;
  return Point{x->second, y->second, z->second};
}

std::optional<Point> if_finite(const glm::dvec3& point) {
  if (!std::isfinite(point.x + point.y + point.z)) return std::nullopt;
  return exactly(point);
}

constexpr formulas::Stage plane_stage{"x_p", "y_p", "z"}, cut_stage{"x_cut", "y_cut", "z_cut"};

}  // namespace

const Rational* ExactVertices::find(const Place& place) const {
  if (place.in != Place::In::vertex) return nullptr;
  const auto found = stages_.find(static_cast<std::int32_t>(place.number));
  if (found == stages_.end() || place.field.empty()) return nullptr;
  const Stages& known = found->second;
  const std::optional<Point>& at = place.field.ends_with("_w")   ? known.world
                                   : place.field.ends_with("_v") ? known.view
                                   : place.field.ends_with("_s") ? known.raster
                                                                 : known.plane;
  if (!at) return nullptr;
  return place.field[0] == 'x' ? &at->x : place.field[0] == 'y' ? &at->y : &at->z;
}

void ExactVertices::step(const ViewTransform& e, const Situation& at) {
  if (from_ != From::world) return;
  const auto made = stages_.find(e.vertex);
  if (made == stages_.end() || !made->second.world)
    return void(stages(e.vertex).view = point_in(ask(*this, e, at), formulas::view_stage));
  // A vertex that cutting in the world made: the formula asks the scene, which does not have it.
  if (!at.camera) return;
  const Point& w = *made->second.world;
  const auto row = [&](int i) {
    const auto t = [&](int column) { return exactly(at.camera->view[column][i]); };
    return formulas::matrix_row(t(0), t(1), t(2), t(3), w.x, w.y, w.z);
  };
  made->second.view = Point{row(0), row(1), row(2)};
}

void ExactVertices::step(const Projection& e, const Situation& at) {
  if (from_ == From::world) stages(e.vertex).plane = point_in(ask(*this, e, at), plane_stage);
}

void ExactVertices::step(const ViewportTransform& e, const Situation& at) {
  if (from_ != From::world) return;
  const Fields found = ask(*this, e, at);
  const auto x = found.find("x_s"), y = found.find("y_s");
  if (x != found.end() && y != found.end()) stages(e.vertex).raster = Point{x->second, y->second, 0};
}

void ExactVertices::step(const ClipCross& e, const Situation& at) {
  stages(e.vertex) = {};
  if (from_ == From::world) stages(e.vertex).view = point_in(ask(*this, e, at), formulas::view_stage);
}

void ExactVertices::step(const SplitVertex& e, const Situation& at) {
  stages(e.vertex) = {};
  const auto plane = plane_of(cut_by_, at);
  const auto from = cutting_point(e.vertex_0, at), to = cutting_point(e.vertex_1, at);
  std::optional<Point> made = if_finite({e.x_cut, e.y_cut, e.z_cut});
  if (plane && from && to) {
    const Rational d_0 = plane->value(*from), d_1 = plane->value(*to);
    // Else only a tolerance says that the edge crosses the plane, and the vertex is where it was put.
    if (d_0.sign() * d_1.sign() < 0)
      if (const auto cut = point_in(ask(*this, e, at, {{"t", formulas::where_zero(d_0, d_1)}}), cut_stage)) made = cut;
  }
  if (!made) return;
  if (e.space == Space::world) stages(e.vertex).world = made;
  else stages(e.vertex).raster = stages(e.vertex).plane = made;
}

std::optional<Point> ExactVertices::on_raster(std::int32_t vertex, const Situation& at) const {
  const auto recorded = at.on_raster(vertex);
  if (!recorded) return std::nullopt;
  const auto known = stages_.find(vertex);
  if (known != stages_.end() && known->second.raster && known->second.plane)
    return Point{known->second.raster->x, known->second.raster->y, known->second.plane->z};
  return if_finite({recorded->x, recorded->y, recorded->z});
}

std::optional<Point> ExactVertices::cutting_point(std::int32_t vertex, const Situation& at) const {
  if (!formulas::detail::cuts_in_world(at)) return on_raster(vertex, at);
  const auto known = stages_.find(vertex);
  if (known != stages_.end() && known->second.world) return known->second.world;
  const auto recorded = formulas::detail::cutting_point(at, vertex);
  return recorded ? if_finite(*recorded) : std::nullopt;
}

std::vector<Point> ExactVertices::corners_of(std::int32_t piece, const Situation& at) const {
  std::vector<Point> corners;
  const Piece* found = at.piece(piece);
  if (!found) return corners;
  for (const std::int32_t vertex : found->outline) {
    auto point = cutting_point(vertex, at);
    if (!point) return {};
    corners.push_back(*std::move(point));
  }
  return corners;
}

std::optional<Plane> ExactVertices::plane_of(std::int32_t piece, const Situation& at) const {
  const Piece* found = at.piece(piece);
  while (found && found->parent >= 0) piece = found->parent, found = at.piece(piece);
  if (!found) return std::nullopt;
  const auto [known, is_new] = planes_.try_emplace(piece);
  if (!is_new) return known->second;
  const std::vector<Point> corners = corners_of(piece, at);
  if (corners.size() < 3) return std::nullopt;
  const Plane plane = oracle::plane_of(corners);
  if (plane.a != 0 || plane.b != 0 || plane.c != 0) known->second = plane;
  return known->second;
}

Fields ExactVertices::fields_of(const FacingTest& e, const Situation& at) const { return ask(*this, e, at); }
Fields ExactVertices::fields_of(const ClipVertex& e, const Situation& at) const { return ask(*this, e, at); }

}  // namespace zstep::oracle
