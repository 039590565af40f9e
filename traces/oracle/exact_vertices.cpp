#include "traces/oracle/exact_vertices.hpp"

#include <cmath>
#include <stdexcept>

#include "traces/formulas/follows.hpp"
#include "traces/formulas/of_pieces.hpp"
#include "traces/formulas/of_polygons.hpp"
#include "traces/formulas/of_vertices.hpp"

namespace zstep::oracle {

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
