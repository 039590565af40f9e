// The way of a vertex, backwards: raster, projection plane, view coordinates, the world, the file's line.

#include <cmath>

#include "sim/answers/origin/work.hpp"
#include "sim/words/explain.hpp"
#include "traces/formulas/shading.hpp"
#include "traces/formulas/viewing.hpp"

namespace zstep::answers {
namespace {

const VertexStages* way_of(const Work& work, std::int32_t vertex) { return entry(work.state().vertices, vertex); }

// --- From the file into the world

/// Did the scene's file move it?
bool is_moved(const Scene& scene, std::int32_t vertex) {
  const Placement* placement = scene.file_points.empty() ? nullptr : placement_of(scene, vertex);
  return placement != nullptr && (placement->linear != glm::dmat3(1) || placement->offset != glm::dvec3(0));
}

void tell_fit(Datum& datum, Work& work, std::int32_t vertex, Axis3 axis) {
  const Number before = work.in_scene(vertex, axis);
  datum.is(
      fmt::format("({} - {})/r", before.name, "c_" + axis_name(axis)),
      {{before.name, before}, {"c_" + axis_name(axis), work.scene.fit->centre[+axis]}, {"r", work.scene.fit->radius}});
}

/// The row of the matrix times the point of the file; what is multiplied by 0 is left out.
void tell_placement(Datum& datum, Work& work, std::int32_t vertex, Axis3 axis) {
  const Placement& placement = *placement_of(work.scene, vertex);
  std::string formula;
  std::vector<Given> given;
  for (const Axis3 from : all_axes) {
    const double entry = placement.linear[+from][+axis];
    if (entry == 0) continue;
    if (!formula.empty()) formula += " + ";
    const Number coordinate = work.in_file(vertex, from);
    if (entry != 1) {
      const std::string symbol = fmt::format("m_{}{}", +axis + 1, +from + 1);
      given.push_back({symbol, entry});
      formula += symbol + "*";
    }
    formula += coordinate.name;
    given.push_back({coordinate.name, coordinate});
  }
  if (const double offset = placement.offset[+axis]; offset != 0) {
    given.push_back({"t_" + axis_name(axis), offset});
    formula += (formula.empty() ? "" : " + ") + given.back().symbol;
  }
  if (formula.empty()) formula = "0";
  datum.is(std::move(formula), std::move(given));
  datum.at_source(work.source_line(placement.line));
}

bool is_split(const Work& work, const Step& made) { return made && holds<SplitVertex>(work.trace.event(*made).event); }

}  // namespace

Number Work::attribute(std::int32_t vertex, std::string_view component) {
  const formulas::Shading shading = formulas::shading_of(scene, conventions);
  const std::int32_t polygon = machine().polygon;
  const std::int32_t value = shading.attribute ? shading.attribute->value_of(polygon, vertex) : no_value;
  const std::string what = fmt::format("{} at vertex {}", component, vertex_name(vertex));
  std::int32_t number = 0;
  while (number + 1 < shading.components() && shading.name(number) != component) ++number;
  if (value == no_value)
    return derived(0, what, what, std::string(component), 0, [](Datum& datum) { datum.note("the vertex has none"); });
  const double known = formulas::at_vertex(shading, polygon, vertex, number);
  return derived(0, fmt::format("{} {}", shading.attribute->name, value), what, std::string(component), known,
                 [&](Datum& datum) {
                   if (shading.shade == formulas::Shade::gouraud) datum.note("light at the vertex, by its normal");
                   else datum.given();
                   datum.at_source(source_of_value(*shading.attribute, value, vertex));
                 });
}

Number Work::world(std::int32_t vertex, Axis3 axis) {
  const std::size_t number = vertex;
  if (vertex < 0) return 0;
  if (number >= scene.points.size()) {
    const Step made = steps_of(vertex).made;
    const VertexStages* way = way_of(*this, vertex);
    return is_split(*this, made) ? field(*made, axis_name(axis, "_cut")) : Number(way ? way->world[+axis] : 0);
  }
  const bool screen = scene.camera.kind == Camera::Kind::screen;
  const std::string what =
      fmt::format("vertex {} of the scene{}", vertex_name(vertex),
                  screen      ? ", on the raster"
                  : scene.fit ? ", fitted: c the centre of the bounding box, r how far the farthest vertex is"
                              : ", in the world");
  return derived(0, fmt::format("point {}", vertex), what, axis_name(axis), scene.points[number][+axis],
                 [&](Datum& datum) {
                   datum.given();
                   if (scene.fit) return tell_fit(datum, *this, vertex, axis);
                   if (is_moved(scene, vertex)) return tell_placement(datum, *this, vertex, axis);
                   datum.at_source(source_of_point(vertex));
                   if (scene.surface && axis == Axis3::z)
                     datum.note("y = " + scene.surface->formula + ", drawn upwards");
                 });
}

Number Work::in_scene(std::int32_t vertex, Axis3 axis) {
  if (!is_moved(scene, vertex)) return in_file(vertex, axis);
  const std::size_t number = vertex;
  const double value = (*placement_of(scene, vertex))(scene.file_points[number])[+axis];
  return derived(0, fmt::format("placed {}", vertex),
                 fmt::format("vertex {} where the scene places it", vertex_name(vertex)), axis_name(axis, "_m"), value,
                 [&](Datum& datum) { datum.given(), tell_placement(datum, *this, vertex, axis); });
}

Number Work::in_file(std::int32_t vertex, Axis3 axis) {
  const double value = scene.file_points[vertex][+axis];
  return derived(0, fmt::format("file {}", vertex), fmt::format("vertex {} in its file", vertex_name(vertex)),
                 axis_name(axis, "_f"), value,
                 [&](Datum& datum) { datum.given(), datum.at_source(source_of_point(vertex)); });
}

Number Work::viewed(std::int32_t vertex, Axis3 axis) {
  const VertexSteps& steps = steps_of(vertex);
  const VertexStages* way = way_of(*this, vertex);
  const double value = way ? way->view[+axis] : 0;
  if (!steps.viewed && steps.made && !is_split(*this, steps.made)) return field(*steps.made, axis_name(axis, "_v"));
  return field(steps.viewed, axis_name(axis, "_v"), value);
}

Number Work::projected(std::int32_t vertex, std::string_view name) {
  const VertexStages* way = way_of(*this, vertex);
  const double value = !way ? 0 : name == "x_p" ? way->plane.x : name == "y_p" ? way->plane.y : way->plane.z;
  return field(steps_of(vertex).projected, name, value);
}

Number Work::window_width(std::int64_t step, const std::string& name, double w_y) {
  const Raster& raster = scene.raster;
  return derived(
      step, "", "", name, formulas::window_width<double>(w_y, raster.width, raster.height), [&](Datum& datum) {
        Operands of;
        const Formula half_height = of("w_y", w_y), width = of("W", raster.width), height = of("H", raster.height);
        datum.is(formulas::window_width(half_height, width, height), of);
      });
}

Number Work::on_raster(std::int32_t vertex, Axis3 axis) {
  if (scene.camera.kind == Camera::Kind::screen && static_cast<std::size_t>(vertex) < scene.points.size())
    return world(vertex, axis);
  const VertexSteps& steps = steps_of(vertex);
  if (is_split(*this, steps.made) && get<SplitVertex>(trace.event(*steps.made).event).space == Space::raster)
    return field(*steps.made, axis_name(axis, "_cut"));
  if (axis == Axis3::z) return projected(vertex, "z");
  const VertexStages* way = way_of(*this, vertex);
  return field(steps.on_raster, axis == Axis3::x ? "x_s" : "y_s",
               !way               ? 0
               : axis == Axis3::x ? way->raster.x
                                  : way->raster.y);
}

double Work::raster_value(std::int32_t vertex, Axis3 axis) const {
  const auto at = zstep::on_raster(scene, state(), vertex);
  return !at ? 0 : axis == Axis3::x ? at->x : axis == Axis3::y ? at->y : at->z;
}

Number Work::cutting(std::int32_t vertex, Axis3 axis) {
  return cuts_in_world(*this) ? world(vertex, axis) : on_raster(vertex, axis);
}

static void tell(Datum& datum, Work& work, std::int64_t step, const ClipVertex&, std::string_view field) {
  if (field == "inside") datum.holds_if("distance >= 0", {{"distance", work.field(step, "distance")}});
}

// The back-face test's result, and outcodes.

namespace {

std::vector<std::int32_t> corners_at_work(const Work& work) {
  if (const Piece* piece = entry(work.machine().pieces, work.machine().piece)) return piece->outline;
  const Facet* facet = entry(work.scene.facets, work.machine().facet);
  if (!facet) return {};
  const auto first = work.scene.corners.begin() + facet->first_corner;
  return {first, first + facet->corner_count};
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
    for (const Axis3 axis : all_axes) numbers.push_back(work.viewed(corner, axis));
  }
  datum.comes_of(field == "outside_some"
                     ? "the vertices' outcodes, or-ed; bits from the right: near, far, left, right, bottom, top"
                     : "the vertices' outcodes, and-ed; bits from the right: near, far, left, right, bottom, top",
                 numbers);
}

TellTheme* const tell_vertices = tell_one_of<ClipVertex>;
TellTheme* const tell_polygons = tell_one_of<FacingTest, ClipTest>;

}  // namespace zstep::answers
