// Pieces: their planes, pieces against pieces and planes: extents, sides, cuts; the eye's side of a tree's nodes;
// areas.

#include "sim/answers/origin/orders.hpp"

#include <algorithm>
#include <cmath>

#include "algorithms/bsp/traverse.hpp"
#include "algorithms/ray_casting/geometry.hpp"
#include "sim/answers/origin/work.hpp"
#include "sim/words/pieces.hpp"
#include "traces/file/header.hpp"
#include "traces/formulas/of_pieces.hpp"
#include "traces/formulas/outlines.hpp"
#include "traces/formulas/vectors.hpp"

namespace zstep::answers {

// The planes of pieces.

const Piece* piece_at(const Work& work, std::int32_t piece) {
  const std::size_t at = piece;
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
  const std::size_t number = facet;
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
    const std::size_t first = scene.facets[number].first_corner;
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

namespace {

constexpr const char* extent_fields[3][2] = {{"x_min", "x_max"}, {"y_min", "y_max"}, {"z_min", "z_max"}};

std::optional<double> extent_value(const Work& work, std::int32_t piece, std::size_t axis, bool most) {
  const Piece* of = piece_at(work, piece);
  if (!of || !of->extent) return std::nullopt;
  const Extent& box = *of->extent;
  const double values[3][2] = {{box.x_min, box.x_max}, {box.y_min, box.y_max}, {box.z_min, box.z_max}};
  return values[axis][most ? 1 : 0];
}

/// The corner of a piece at which a plane, turned or not, has a value; the one that comes nearest to it.
std::int32_t corner_with(const Work& work, const Piece& piece, const PlaneEquation& plane, double value, bool& turned) {
  std::int32_t best = piece.outline.empty() ? -1 : piece.outline.front();
  double least = std::numeric_limits<double>::infinity();
  for (const std::int32_t vertex : piece.outline) {
    const auto at = cutting_point(work.scene, work.state(), vertex);
    if (!at) continue;
    const double here = formulas::plane_value(plane, *at);
    for (const bool other : {false, true}) {
      const double off = std::abs((other ? -here : here) - value);
      if (off < least) least = off, best = vertex, turned = other;
    }
  }
  return best;
}

}  // namespace

bool cuts_in_world(const Work& work) { return formulas::run_cuts_in_world(work.trace.header(), work.scene); }

Number Work::extent(std::int32_t number, std::string_view name) {
  const std::size_t axis = index_of(axis_of(name));
  const auto value = extent_value(*this, number, axis, name.ends_with("max"));
  const auto step = find_last<Extent>(trace, step_of_plane(machine(), number).value_or(at()) + 1,
                                      [&](const Extent& e) { return e.piece == number; });
  return field(step, name, value.value_or(0));
}

static void tell(Datum& datum, Work& work, std::int64_t, const Extent& e, std::string_view field) {
  const Piece* piece = piece_at(work, e.piece);
  if (!piece || field == "piece") return;
  const Axis3 axis = axis_of(field);
  const std::vector<std::int32_t> outline = piece->outline;
  for (const std::int32_t vertex : outline) {
    if (work.raster_value(vertex, axis) != datum.number()) continue;
    datum.same_as(axis == Axis3::x ? "x_s" : axis == Axis3::y ? "y_s" : "z", work.on_raster(vertex, axis));
    return datum.note(
        fmt::format("the {} of {} corners", field.ends_with("min") ? "least" : "greatest", outline.size()));
  }
}

static void tell(Datum& datum, Work& work, std::int64_t step, const ExtentTest& e, std::string_view field) {
  const std::size_t axis = index_of(e.axis);
  if (field == "low") return datum.same_as("min", work.extent(e.piece, extent_fields[axis][0]));
  if (field == "high") return datum.same_as("max", work.extent(e.piece, extent_fields[axis][1]));
  if (field == "other_low") return datum.same_as("min", work.extent(e.other, extent_fields[axis][0]));
  if (field == "other_high") return datum.same_as("max", work.extent(e.other, extent_fields[axis][1]));
  if (field != "overlap") return;
  const Number low = work.field(step, "low"), high = work.field(step, "high"),
               other_low = work.field(step, "other_low"), other_high = work.field(step, "other_high");
  // Two conditions: the one that failed, or, where both hold, the first.
  if (low.value < other_high.value && !e.overlap)
    return datum.holds_if("other_low < high",
                          {{"other_low", other_low}, {"high", high}, {"low", low}, {"other_high", other_high}});
  datum.holds_if("low < other_high",
                 {{"low", low}, {"other_high", other_high}, {"other_low", other_low}, {"high", high}});
  if (e.overlap) datum.note("and other_low < high");
}

static void tell(Datum& datum, Work& work, std::int64_t step, const VertexSide&, std::string_view field) {
  if (field == "side") datum.comes_of("by the sign of the value", {work.field(step, "value")});
}

static void tell(Datum& datum, Work& work, std::int64_t step, const SideTest& e, std::string_view field) {
  if (field == "side")
    return datum.comes_of("by the least and the greatest value",
                          {work.field(step, "least"), work.field(step, "greatest")});
  const double value = datum.number();
  const Step vertex_side = find_last<VertexSide>(
      work.trace, step, [&](const VertexSide& other) { return other.plane_of == e.plane_of && other.value == value; },
      [&](const Event& event) { return !holds<VertexSide>(event) && !holds<SideTest>(event); });
  if (vertex_side) return datum.same_as("value", work.field(*vertex_side, "value"));
  const Piece *piece = piece_at(work, e.piece), *of = piece_at(work, e.plane_of);
  if (!piece || !of || !of->plane) return;
  bool turned = false;
  const std::int32_t corner = corner_with(work, *piece, *of->plane, value, turned);
  if (corner < 0) return;
  const bool own_depth = work.step_name(step) == "penetrate";  // there a corner counts where its own plane has it
  Operands operands;
  const Formula here = plane_at(
      operands, [&](char letter) { return work.plane(e.plane_of, letter); },
      [&](Axis3 axis) { return work.cutting(corner, axis); });
  datum.is(turned ? -here : here, operands, false);
  datum.note(fmt::format("at vertex {}{}", work.vertex_name(corner), own_depth ? ", with z from its own plane" : ""));
}

static void tell(Datum& datum, Work& work, std::int64_t, const OverlapTest& e, std::string_view field) {
  if (field == "overlap" || std::isnan(datum.number()))
    return datum.comes_of("do the outlines have a point in common?",
                          {work.extent(e.piece, "x_min"), work.extent(e.other, "x_min")});
  const std::string axis = field == "x_at" ? "x" : "y";
  datum.comes_of("of a point inside both outlines",
                 {work.extent(e.piece, axis + "_min"), work.extent(e.piece, axis + "_max"),
                  work.extent(e.other, axis + "_min"), work.extent(e.other, axis + "_max")});
}

namespace {

/// The value of the cutting plane at one end of an edge.
Number cut_distance(Work& work, std::int64_t step, std::int32_t vertex, const char* name) {
  const Step test = find_last<SideTest>(work.trace, step, [](const SideTest&) { return true; });
  if (!test) return 0;
  const std::int32_t plane_of = get<SideTest>(work.trace.event(*test).event).plane_of;
  return plane_value(work, step, name, plane_of, [&](Axis3 axis) { return work.cutting(vertex, axis); });
}

}  // namespace

static void tell(Datum& datum, Work& work, std::int64_t step, const SplitVertex& e, std::string_view field) {
  if (field != "t") return;
  const Number d_0 = cut_distance(work, step, e.vertex_0, "d_0"), d_1 = cut_distance(work, step, e.vertex_1, "d_1");
  tell_cut(datum, d_0, d_1);
}

namespace {

Number node_plane(Work& work, std::int32_t node, char letter) {
  const std::size_t at = node;
  if (node < 0 || at >= work.machine().tree.size() || work.machine().tree[at].pieces.empty()) return 0;
  return work.plane(work.machine().tree[at].pieces.front(), letter);
}

}  // namespace

static void tell(Datum& datum, Work& work, std::int64_t step, const EyeSide&, std::string_view field) {
  if (field == "front") datum.holds_if("value > 0", {{"value", work.field(step, "value")}});
}

static void tell(Datum& datum, Work& work, std::int64_t, const NodeSkip& e, std::string_view field) {
  if (field != "value") return;
  const auto plane = [&](char letter) { return node_plane(work, e.node, letter); };
  // The corner of the view volume that has this value.
  for (const glm::dvec3& corner : bsp::eye_of(work.scene.camera, work.scene.raster, true).volume) {
    Operands of;
    const Formula value = plane_at(of, plane, [&](Axis3 axis) { return corner[static_cast<glm::length_t>(axis)]; });
    if (value.value() != e.value) continue;
    datum.is(value, of);
    return datum.note("(x, y, z) is a corner of the view volume");
  }
}

static void tell(Datum& datum, Work& work, std::int64_t, const AreaBegin& e, std::string_view field) {
  const std::size_t parent = e.parent;
  if (e.parent < 0 || parent >= work.machine().areas.size()) return datum.note("the whole picture");
  const bool column = field.ends_with("column");
  const AreaBegin around = work.machine().areas[parent].entry;
  const Step step =
      find_last<AreaBegin>(work.trace, work.at(), [&](const AreaBegin& other) { return other.area == e.parent; });
  const char *first = column ? "first_column" : "first_row", *end = column ? "end_column" : "end_row";
  const Number low = work.field(step, first, column ? around.first_column : around.first_row),
               high = work.field(step, end, column ? around.end_column : around.end_row);
  if (datum.number() == low.value) return datum.same_as("first", low);
  if (datum.number() == high.value) return datum.same_as("end", high);
  datum.is("first + \u230a(end - first)/2\u230b", {{"first", low}, {"end", high}});
}

static void tell(Datum& datum, Work& work, std::int64_t step, const AreaBin& e, std::string_view field) {
  const Step area = find_last<AreaBegin>(work.trace, step, [](const AreaBegin&) { return true; });
  if (!area || field == "piece") return;
  std::vector<Number> numbers;
  for (const char* side : {"x_min", "x_max", "y_min", "y_max"}) numbers.push_back(work.extent(e.piece, side));
  for (const char* side : {"first_column", "end_column", "first_row", "end_row"})
    numbers.push_back(work.field(*area, side));
  datum.comes_of(field == "by_box" ? "does the piece's box miss the area, or lie in it?"
                                   : "the piece's edges and the corners of the area",
                 numbers);
}

void tell_orders(Datum& datum, Work& work, std::int64_t step, const Event& event, std::string_view field) {
  tell_one_of<Extent, ExtentTest, VertexSide, SideTest, OverlapTest, SplitVertex, EyeSide, NodeSkip, AreaBegin,
              AreaBin>(event, [&](const auto& e) { tell(datum, work, step, e, field); });
}

}  // namespace zstep::answers
