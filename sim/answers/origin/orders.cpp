// Pieces: their planes, pieces against pieces and planes: extents, sides, cuts; the eye's side of a tree's nodes;
// areas.

#include "sim/answers/origin/work.hpp"

#include <algorithm>
#include <cmath>

#include "algorithms/bsp/traverse.hpp"
#include "algorithms/ray_casting/geometry.hpp"
#include "sim/words/pieces.hpp"
#include "traces/file/header.hpp"
#include "traces/formulas/of_pieces.hpp"
#include "traces/formulas/outlines.hpp"
#include "traces/formulas/vectors.hpp"

namespace zstep::answers {

// The planes of pieces.

namespace {

using Point = formulas::Vector<Formula>;

std::string field_of(char letter) { return fmt::format("plane_{}", static_cast<char>(letter - 'A' + 'a')); }
char letter_of(std::string_view field) { return static_cast<char>('A' + (field.back() - 'a')); }

}  // namespace

void tell_plane(Datum& datum, Work& work, std::int64_t step, const std::string& subject, char letter, std::size_t count,
                const Corner& corner) {
  if (count > most_corners || count < 3) {
    std::vector<Number> some;
    for (std::size_t i = 0; i < std::min<std::size_t>(count, 3); ++i)
      for (const Axis3 axis : all_axes) some.push_back(corner(i, axis));
    return datum.comes_of(fmt::format("by Newell's formula over {} vertices, of which three are shown", count), some);
  }
  Operands of;
  std::vector<Point> points;
  for (std::size_t i = 0; i < count; ++i) {
    const auto along = [&](Axis3 axis) { return of(fmt::format("p{}_{}", i, axis_name(axis)), corner(i, axis)); };
    const Formula x = along(Axis3::x), y = along(Axis3::y), z = along(Axis3::z);
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
    const auto told = [&](Datum& inner) { inner.is(along, of); };
    return sides(name, work.derived(step, subject, "", name, along.value(), told));
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
  return work.part(step, name, value, of);
}

void tell_cut(Datum& datum, const Number& d_0, const Number& d_1) {
  Operands of;
  const Formula one = of("d_0", d_0), other = of("d_1", d_1);
  datum.is(formulas::where_zero(one, other), of, false);
}

Number Work::plane(std::int32_t number, char letter) {
  const Piece* piece = entry(machine().pieces, number);
  if (!piece || !piece->plane) return 0;
  const Step step = step_of_plane(machine(), number);
  return field(step, field_of(letter), field_number(*piece->plane, field_of(letter)).value_or(0));
}

Number Work::facet_plane(std::int32_t facet, char letter) {
  const Facet* found = entry(scene.facets, facet);
  if (!found) return 0;
  const ray_casting::Target target = ray_casting::target_of(scene, facet);
  const double value = letter == 'A'   ? target.plane.a
                       : letter == 'B' ? target.plane.b
                       : letter == 'C' ? target.plane.c
                                       : target.plane.d;
  const std::string subject = fmt::format("facet {}", facet),
                    what = "plane of " + label(found->polygon) + ", in the world";
  return derived(0, subject, what, std::string(1, letter), value, [&](Datum& datum) {
    datum.at_source(source_of_polygon(found->polygon));
    tell_plane(datum, *this, 0, subject, letter, target.corners.size(),
               [&](std::size_t i, Axis3 axis) { return world(scene.corners[found->first_corner + i], axis); });
  });
}

static void tell(Datum& datum, Work& work, std::int64_t step, const PlaneEquation& e, std::string_view field) {
  // A part lies in the plane of the whole that it was cut from.
  const Piece* whole = entry(work.machine().pieces, e.piece);
  while (whole && whole->parent >= 0 && entry(work.machine().pieces, whole->parent))
    whole = entry(work.machine().pieces, whole->parent);
  if (!whole) return;
  const std::vector<std::int32_t> outline = whole->outline;
  tell_plane(datum, work, step, "", letter_of(field), outline.size(),
             [&](std::size_t i, Axis3 axis) { return work.cutting(outline[i], axis); });
}

namespace {

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
  const Piece* piece = entry(machine().pieces, number);
  const auto value = piece && piece->extent ? field_number(*piece->extent, name) : std::nullopt;
  const Step step = last(step_of_plane(machine(), number).value_or(at()) + 1, &Extent::piece, number);
  return field(step, name, value.value_or(0));
}

static void tell(Datum& datum, Work& work, std::int64_t, const Extent& e, std::string_view field) {
  const Piece* piece = entry(work.machine().pieces, e.piece);
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
  const std::string_view axis = word_of(e.axis);
  if (field == "low" || field == "other_low" || field == "high" || field == "other_high") {
    const bool least = field.ends_with("low");
    return datum.same_as(least ? "min" : "max", work.extent(field.starts_with("other") ? e.other : e.piece,
                                                            fmt::format("{}_{}", axis, least ? "min" : "max")));
  }
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
  const Piece *piece = entry(work.machine().pieces, e.piece), *of = entry(work.machine().pieces, e.plane_of);
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
  const Step test = work.last<SideTest>(step);
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
  const TreeNode* found = entry(work.machine().tree, node);
  return found && !found->pieces.empty() ? work.plane(found->pieces.front(), letter) : Number(0);
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
    const Formula value = plane_at(of, plane, [&](Axis3 axis) { return corner[+axis]; });
    if (value.value() != e.value) continue;
    datum.is(value, of);
    return datum.note("(x, y, z) is a corner of the view volume");
  }
}

static void tell(Datum& datum, Work& work, std::int64_t, const AreaBegin& e, std::string_view field) {
  const auto* parent = entry(work.machine().areas, e.parent);
  if (!parent) return datum.note("the whole picture");
  const bool column = field.ends_with("column");
  const AreaBegin around = parent->entry;
  const Step step = work.last(work.at(), &AreaBegin::area, e.parent);
  const char *first = column ? "first_column" : "first_row", *end = column ? "end_column" : "end_row";
  const Number low = work.field(step, first, column ? around.first_column : around.first_row),
               high = work.field(step, end, column ? around.end_column : around.end_row);
  if (datum.number() == low.value) return datum.same_as("first", low);
  if (datum.number() == high.value) return datum.same_as("end", high);
  datum.is("first + \u230a(end - first)/2\u230b", {{"first", low}, {"end", high}});
}

static void tell(Datum& datum, Work& work, std::int64_t step, const AreaBin& e, std::string_view field) {
  const Step area = work.last<AreaBegin>(step);
  if (!area || field == "piece") return;
  std::vector<Number> numbers;
  for (const char* side : {"x_min", "x_max", "y_min", "y_max"}) numbers.push_back(work.extent(e.piece, side));
  for (const char* side : {"first_column", "end_column", "first_row", "end_row"})
    numbers.push_back(work.field(*area, side));
  datum.comes_of(field == "by_box" ? "does the piece's box miss the area, or lie in it?"
                                   : "the piece's edges and the corners of the area",
                 numbers);
}

TellTheme* const tell_orders = tell_one_of<PlaneEquation, Extent, ExtentTest, VertexSide, SideTest, OverlapTest,
                                           SplitVertex, EyeSide, NodeSkip, AreaBegin, AreaBin>;

}  // namespace zstep::answers
