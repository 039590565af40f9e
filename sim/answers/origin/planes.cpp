// The planes of pieces.
#include "sim/answers/origin/planes.hpp"

#include <algorithm>
#include <cmath>

#include "algorithms/ray_casting/geometry.hpp"
#include "traces/formulas/facet_planes.hpp"
#include "traces/formulas/lines.hpp"

namespace zstep::answers {

const Piece* piece_at(const Work& work, std::int32_t piece) {
  const auto at = static_cast<std::size_t>(piece);
  return piece >= 0 && at < work.machine().pieces.size() ? &work.machine().pieces[at] : nullptr;
}
namespace {

using Point = formulas::Vector<Formula>;

double value_of(const PlaneEquation& plane, char letter) {
  return letter == 'A' ? plane.plane_a : letter == 'B' ? plane.plane_b : letter == 'C' ? plane.plane_c : plane.plane_d;
}

const char* field_of(char letter) {
  return letter == 'A' ? "plane_a" : letter == 'B' ? "plane_b" : letter == 'C' ? "plane_c" : "plane_d";
}

char letter_of(std::string_view field) { return static_cast<char>('A' + (field.back() - 'a')); }

}  // namespace

void tell_plane(Datum& datum, Work& work, std::int64_t step, const std::string& subject, char letter, std::size_t count,
                const Corner& corner) {
  if (count > most_corners || count < 3) {
    std::vector<Number> some;
    for (std::size_t i = 0; i < std::min<std::size_t>(count, 3); ++i)
      for (const Axis3 axis : {Axis3::x, Axis3::y, Axis3::z}) some.push_back(corner(i, axis));
    return datum.comes_of(fmt::format("by Newell's formula over {} vertices, of which three are shown", count), some);
  }
  Operands of;
  std::vector<Point> points;
  for (std::size_t i = 0; i < count; ++i) {
    const auto along = [&](char name, Axis3 axis) { return of(fmt::format("p{}_{}", i, name), corner(i, axis)); };
    const Formula x = along('x', Axis3::x), y = along('y', Axis3::y), z = along('z', Axis3::z);
    points.push_back({x, y, z});
  }
  const auto point = [&](std::size_t i) { return points[i]; };
  if (letter == 'D') {
    const auto of_plane = [&](char own) {
      return of(std::string(1, own), subject.empty() ? work.field(step, field_of(own))
                                                     : work.facet_plane(std::stoi(subject.substr(6)), own));
    };
    const Formula a = of_plane('A'), b = of_plane('B'), c = of_plane('C');
    return datum.is(formulas::d_through_mean({a, b, c}, count, point, Formula(static_cast<double>(count))), of, false);
  }
  const Point none{Formula(0), Formula(0), Formula(0)}, normal = formulas::newell_normal(none, count, point);
  Operands sides;
  const auto side = [&](const char* name, const Formula& along) {
    return sides(name,
                 work.derived(step, subject, "", name, along.value(), [&](Datum& inner) { inner.is(along, of); }));
  };
  const Formula x = side("n_x", normal.x), y = side("n_y", normal.y), z = side("n_z", normal.z);
  datum.is((letter == 'A' ? x : letter == 'B' ? y : z) / formulas::length_of(Point{x, y, z}), sides, false);
}

Formula plane_at(Operands& of, const std::function<Number(char)>& plane, const std::function<Number(Axis3)>& point) {
  const Formula a = of("A", plane('A')), x = of("x", point(Axis3::x)), b = of("B", plane('B')),
                y = of("y", point(Axis3::y)), c = of("C", plane('C')), z = of("z", point(Axis3::z)),
                d = of("D", plane('D'));
  return formulas::plane_value(a, b, c, d, x, y, z);
}

Number plane_value(Work& work, std::int64_t step, const char* name, std::int32_t piece,
                   const std::function<Number(Axis3)>& point) {
  Operands of;
  const Formula value = plane_at(
      of, [&](char letter) { return work.plane(piece, letter); }, point);
  return work.derived(step, "", "", name, value.value(), [&](Datum& datum) { datum.is(value, of); });
}

void tell_cut(Datum& datum, const Number& d_0, const Number& d_1) {
  Operands of;
  const Formula one = of("d_0", d_0), other = of("d_1", d_1);
  datum.is(formulas::where_zero(one, other), of, false);
}

Number Work::plane(std::int32_t number, char letter) {
  const Piece* piece = piece_at(*this, number);
  if (!piece || !piece->plane) return 0;
  const Step step = step_of_plane(machine(), number);
  return field(step, field_of(letter), value_of(*piece->plane, letter));
}

Number Work::facet_plane(std::int32_t facet, char letter) {
  const auto number = static_cast<std::size_t>(facet);
  if (facet < 0 || number >= scene.facets.size()) return 0;
  const ray_casting::Target target = ray_casting::target_of(scene, facet);
  const double value = letter == 'A'   ? target.plane.a
                       : letter == 'B' ? target.plane.b
                       : letter == 'C' ? target.plane.c
                                       : target.plane.d;
  const std::string subject = fmt::format("facet {}", facet),
                    what = "plane of " + label(scene.facets[number].polygon) + ", in the world";
  return derived(0, subject, what, std::string(1, letter), value, [&](Datum& datum) {
    datum.at_source(source_of_polygon(scene.facets[number].polygon));
    const auto first = static_cast<std::size_t>(scene.facets[number].first_corner);
    tell_plane(datum, *this, 0, subject, letter, target.corners.size(),
               [&](std::size_t i, Axis3 axis) { return world(scene.corners[first + i], axis); });
  });
}

static void tell(Datum& datum, Work& work, std::int64_t step, const PlaneEquation& e, std::string_view field) {
  // A part lies in the plane of the whole that it was cut from.
  const Piece* whole = piece_at(work, e.piece);
  while (whole && whole->parent >= 0 && piece_at(work, whole->parent)) whole = piece_at(work, whole->parent);
  if (!whole) return;
  const std::vector<std::int32_t> outline = whole->outline;
  tell_plane(datum, work, step, "", letter_of(field), outline.size(),
             [&](std::size_t i, Axis3 axis) { return work.cutting(outline[i], axis); });
}

void tell_planes(Datum& datum, Work& work, std::int64_t step, const Event& event, std::string_view field) {
  tell_one_of<PlaneEquation>(event, [&](const auto& e) { tell(datum, work, step, e, field); });
}

}  // namespace zstep::answers
