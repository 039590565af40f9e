// Rays: where they begin and go, the planes and points they meet, and what they bring back.

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "algorithms/ray_casting/geometry.hpp"
#include "algorithms/ray_casting/space.hpp"
#include "algorithms/ray_tracing/ray_tracing.hpp"
#include "sim/answers/origin/work.hpp"
#include "sim/words/explain.hpp"
#include "traces/formulas/of_colors.hpp"
#include "traces/formulas/of_rays.hpp"
#include "traces/formulas/vectors.hpp"

namespace zstep::answers {

// Boxes around facets, the cells of a grid, and the interval of a ray inside them.

namespace {

constexpr const char* low_fields[] = {"x_min", "y_min", "z_min"};
constexpr const char* high_fields[] = {"x_max", "y_max", "z_max"};
constexpr const char* from_fields[] = {"x_0", "y_0", "z_0"};
constexpr const char* along_fields[] = {"dir_x", "dir_y", "dir_z"};

int number_of_axis(std::string_view field) { return field[0] == 'x' ? 0 : field[0] == 'y' ? 1 : 2; }

/// By how much boxes are larger than what is in them.
double pad_of(const Scene& scene) {
  double size = glm::length(scene.camera.eye);
  for (const std::int32_t corner : scene.corners) size = std::max(size, glm::length(scene.points[corner]));
  return 1e-9 * size;
}

/// A side of a box: a point's coordinate, less or more by the pad.
void tell_side(Datum& datum, Work& work, std::string_view field, double pads) {
  const bool low = field.ends_with("min");
  const int axis = number_of_axis(field);
  const double pad = pads * pad_of(work.scene), value = datum.number();
  for (const std::int32_t corner : work.scene.corners) {
    const double coordinate = work.scene.points[corner][axis];
    if (formulas::side_of_box(coordinate, pad, low) != value) continue;
    Operands of;
    const Formula p = of("p", work.world(corner, static_cast<Axis3>(axis))), wider = of("pad", pad);
    datum.is(formulas::side_of_box(p, wider, low), of);
    return datum.note(fmt::format("the {} of all that is in it", low ? "least" : "greatest"));
  }
}

const RayBegin* ray_at_work(const Work& work) {
  for (const RayRow& row : work.machine().rays.tree)
    if (work.machine().rays.ray == row.entry.ray) return &row.entry;
  return nullptr;
}

/// t at one side of a box along one axis.
void tell_at_side(Datum& datum, Work& work, std::int64_t step, int axis, const Number& bound) {
  const Step begin = last_ray(work, step);
  if (!begin) return;
  Operands of;
  const Formula edge = of("side", bound), from = of(from_fields[axis], work.field(*begin, from_fields[axis])),
                along = of(along_fields[axis], work.field(*begin, along_fields[axis]));
  datum.is(formulas::ray_at_side(edge, from, along), of);
}

struct Sides {
  double low[3], high[3];
};

/// The side at which t is reached; false where it is none of them (the ray's own beginning or end).
template <class Side>
bool tell_passage(Datum& datum, Work& work, std::int64_t step, const Sides& sides, Side&& bound) {
  const RayBegin* ray = ray_at_work(work);
  if (!ray) return false;
  const double from[] = {ray->x_0, ray->y_0, ray->z_0}, along[] = {ray->dir_x, ray->dir_y, ray->dir_z};
  for (int axis = 0; axis < 3; ++axis)
    for (const bool low : {true, false}) {
      const double bounded = (low ? sides.low : sides.high)[axis];
      if (along[axis] == 0 || formulas::ray_at_side(bounded, from[axis], along[axis]) != datum.number()) continue;
      tell_at_side(datum, work, step, axis, bound(axis, low));
      return true;
    }
  return false;
}

}  // namespace

static void tell(Datum& datum, Work& work, std::int64_t, const BoxMake&, std::string_view field) {
  if (field.ends_with("min") || field.ends_with("max")) tell_side(datum, work, field, 1);
}

static void tell(Datum& datum, Work& work, std::int64_t, const GridMake&, std::string_view field) {
  if (field.ends_with("min") || field.ends_with("max")) return tell_side(datum, work, field, 2);
  datum.note("about as many cells as facets, as nearly cubes as the box allows");
}

static void tell(Datum& datum, Work& work, std::int64_t step, const BoxTest& e, std::string_view field) {
  const std::size_t at = e.box;
  if (field == "hit") {
    const Number enter = work.field(step, "t_enter"), leave = work.field(step, "t_leave");
    if (!e.hit && enter.value <= leave.value)
      return datum.comes_of("it enters beyond the t that is kept", {enter, leave});
    return datum.holds_if("t_enter <= t_leave", {{"t_enter", enter}, {"t_leave", leave}});
  }
  if (e.box < 0 || at >= work.machine().boxes.size() || field == "box") return;
  const BoxMake box = work.machine().boxes[at].entry;
  const Step made = find_first<BoxMake>(work.trace, 1, [&](const BoxMake& other) { return other.box == e.box; });
  const Sides sides{{box.x_min, box.y_min, box.z_min}, {box.x_max, box.y_max, box.z_max}};
  const bool told = tell_passage(datum, work, step, sides, [&](int axis, bool low) {
    return work.field(made, low ? low_fields[axis] : high_fields[axis], low ? sides.low[axis] : sides.high[axis]);
  });
  if (!told)
    datum.note(std::isinf(datum.number()) ? "the ray runs beside the box"
               : field == "t_enter"       ? "where the ray begins"
                                          : "where the ray ends");
}

static void tell(Datum& datum, Work& work, std::int64_t step, const CellVisit& e, std::string_view field) {
  if (!field.starts_with("t_") || !work.machine().grid) return;
  const GridMake grid = *work.machine().grid;
  const Step made = find_first<GridMake>(work.trace, 1, [](const GridMake&) { return true; });
  const double lows[] = {grid.x_min, grid.y_min, grid.z_min}, highs[] = {grid.x_max, grid.y_max, grid.z_max};
  const std::int32_t cells[] = {grid.cells_x, grid.cells_y, grid.cells_z}, cell[] = {e.cell_x, e.cell_y, e.cell_z};
  Sides sides{};
  for (int axis = 0; axis < 3; ++axis)
    for (const int beyond : {0, 1}) {
      (beyond ? sides.high : sides.low)[axis] =
          formulas::side_of_cells<double>(lows[axis], highs[axis], cell[axis] + beyond, cells[axis]);
    }
  const bool told = tell_passage(datum, work, step, sides, [&](int axis, bool low) {
    const double edge = low ? sides.low[axis] : sides.high[axis];
    return work.derived(step, fmt::format("side {} {}", axis, low),
                        fmt::format("side of cell ({}, {}, {})", e.cell_x, e.cell_y, e.cell_z), "side", edge,
                        [&](Datum& inner) {
                          Operands of;
                          const Formula least = of("low", work.field(made, low_fields[axis], lows[axis])),
                                        most = of("high", work.field(made, high_fields[axis], highs[axis])),
                                        k = of("k", cell[axis] + (low ? 0 : 1)), all = of("cells", cells[axis]);
                          inner.is(formulas::side_of_cells(least, most, k, all), of, false);
                        });
  });
  if (!told) datum.note("where the ray enters the grid, or begins");
}

void tell_boxes(Datum& datum, Work& work, std::int64_t step, const Event& event, std::string_view field) {
  tell_one_of<BoxMake, GridMake, BoxTest, CellVisit>(event, [&](const auto& e) { tell(datum, work, step, e, field); });
}

namespace {

constexpr const char* hit_fields[] = {"x_hit", "y_hit", "z_hit"};
constexpr const char* axis_names[] = {"x", "y", "z"};

int axis_in(std::string_view field) {
  for (int axis = 0; axis < 3; ++axis)
    if (field.find(axis_names[axis]) != std::string_view::npos) return axis;
  return 0;
}

Step begin_of_ray(const Work& work, std::int64_t at, std::int32_t ray) {
  return find_last<RayBegin>(work.trace, at, [&](const RayBegin& e) { return e.ray == ray; });
}

RayBegin begin_at(const Work& work, std::int64_t step) { return get<RayBegin>(work.trace.event(step).event); }

double component(const glm::dvec3& v, int axis) { return v[axis]; }

using Way = formulas::Vector<Formula>;
const Formula& along_axis(const Way& v, int axis) { return axis == 0 ? v.x : axis == 1 ? v.y : v.z; }

/// From the middle of the picture to a pixel's centre on the projection plane, along one axis of the world.
Formula across_window(Operands& of, Work& work, std::int64_t step, const viewing::Lens& lens, const RayBegin& e,
                      double right, double up) {
  const Formula x = of("x", e.x), w_x = of("w_x", work.window_width(step, "w_x", lens.window_y)),
                width = of("W", lens.width), t_1 = of("T_1", right), w_y = of("w_y", lens.window_y), y = of("y", e.y),
                height = of("H", lens.height), t_2 = of("T_2", up);
  return formulas::ray_x(x, w_x, width) * t_1 + formulas::ray_y(y, w_y, height) * t_2;
}

/// The hit that a ray kept: what it meets first.
Step kept_hit(const Work& work, std::int64_t at, std::int64_t begin) {
  const auto stop = [](const Event& event) { return holds<RayBegin>(event); };
  // Rays that this one cast lie between its end and its hits, so look on from its beginning.
  Step kept;
  for (std::int64_t step = begin + 1; step <= at; ++step) {
    const Event event = work.trace.event(step).event;
    if (holds<RayEnd>(event) || stop(event)) break;
    if (const auto* hit = get_if<RayHit>(&event); hit && hit->nearest) kept = step;
  }
  return kept;
}

/// A component of a ray's direction, of length 1.
Number unit_along(Work& work, std::int64_t begin, int axis) {
  const RayBegin ray = begin_at(work, begin);
  const glm::dvec3 along = glm::normalize(glm::dvec3(ray.dir_x, ray.dir_y, ray.dir_z));
  return work.derived(begin, "unit", fmt::format("direction of ray {}, of length 1", ray.ray),
                      fmt::format("D_{}", axis_names[axis]), component(along, axis), [&](Datum& datum) {
                        Operands of;
                        const Formula x = of("x", work.field(begin, "dir_x")), y = of("y", work.field(begin, "dir_y")),
                                      z = of("z", work.field(begin, "dir_z"));
                        const Way way{x, y, z};
                        datum.is(along_axis(way, axis) / formulas::length_of(way), of, false);
                      });
}

void tell_eye_direction(Datum& datum, Work& work, std::int64_t step, const RayBegin& e, int axis) {
  const Camera& camera = work.scene.camera;
  const viewing::Lens lens(camera, work.scene.raster, work.conventions.depth);
  if (camera.kind == Camera::Kind::screen) {
    datum.is("dz", {{"dz", axis == 2 ? 1 : 0}});
    return datum.note("along z");
  }
  const glm::dmat4& view = camera.view;
  if (lens.orthographic) {
    datum.is("T_3", {{"T_3", view[axis][2]}});
    return datum.note(fmt::format("the line of sight, the third row of T_v; T_3: column {}", axis + 1));
  }
  Operands of;
  const Formula across = across_window(of, work, step, lens, e, view[axis][0], view[axis][1]), d = of("d", lens.d),
                t_3 = of("T_3", view[axis][2]);
  datum.is(across + d * t_3, of);
  datum.note(fmt::format("T_1, T_2, T_3: column {} of T_v", axis + 1));
}

void tell_eye_start(Datum& datum, Work& work, std::int64_t step, const RayBegin& e, int axis) {
  const Camera& camera = work.scene.camera;
  if (camera.kind == Camera::Kind::screen) {
    datum.is("p", {{"p", axis == 0 ? e.x : axis == 1 ? e.y : 0}});
    return datum.note(axis == 0 ? "pixel column" : axis == 1 ? "pixel row" : "z = 0");
  }
  if (camera.kind == Camera::Kind::perspective) {
    datum.is("eye", {{"eye", component(camera.eye, axis)}});
    return datum.note(camera.polar ? fmt::format("the eye, from rho {:.6g}, theta {:.6g}, phi {:.6g}", camera.rho,
                                                 camera.theta, camera.phi)
                                   : "the eye");
  }
  const viewing::Lens lens(camera, work.scene.raster, work.conventions.depth);
  const glm::dmat4& view = camera.view;
  Operands of;
  const double right = view[axis][0], up = view[axis][1];
  const Formula across = across_window(of, work, step, lens, e, right, up), o_x = of("o_x", view[3][0]),
                o_y = of("o_y", view[3][1]), o_z = of("o_z", view[3][2]), t_3 = of("T_3", view[axis][2]);
  datum.is(across - formulas::dot(Way{o_x, o_y, o_z}, Way{of("T_1", right), of("T_2", up), t_3}), of, false);
  datum.note(fmt::format("on the plane of the eye; T_1, T_2, T_3: column {} of T_v; o: its fourth", axis + 1));
}

void tell_secondary_direction(Datum& datum, Work& work, std::int64_t parent, std::int64_t hit, const RayBegin& e,
                              int axis) {
  const std::string name = axis_names[axis];
  if (e.role == RayRole::shadow) {
    const Number point = work.field(hit, hit_fields[axis]);
    Operands of;
    const Formula light = of("light_" + name, work.scene.light ? component(work.scene.light->position, axis) : 0);
    return datum.is(light - of("point_" + name, point), of);
  }
  const std::int32_t facet = get<RayHit>(work.trace.event(hit).event).facet;
  Operands of;
  const auto direction = [&](int k) { return of(fmt::format("D_{}", axis_names[k]), unit_along(work, parent, k)); };
  const auto facing = [&](int k) {
    return of(fmt::format("N_{}", axis_names[k]), work.facet_plane(facet, static_cast<char>('A' + k)));
  };
  const Formula d_x = direction(0), n_x = facing(0), d_y = direction(1), n_y = facing(1), d_z = direction(2),
                n_z = facing(2);
  const Way along{d_x, d_y, d_z}, normal{n_x, n_y, n_z};
  if (e.role == RayRole::reflected) return datum.is(along_axis(formulas::mirrored(along, normal), axis), of, false);
  const bool entering = formulas::dot(along, normal).value() < 0;
  const std::size_t polygon = work.scene.facets[facet].polygon;
  const double n = work.scene.polygons[polygon].material->refraction, ratio = entering ? 1 / n : n;
  const auto way = formulas::refracted(along, normal, of("r", ratio));
  if (way) datum.is(along_axis(*way, axis), of, false);
  datum.note("r = n_1/n_2, by Snell's law");
}

}  // namespace

Step last_ray(const Work& work, std::int64_t step) {
  return find_last<RayBegin>(work.trace, step, [](const RayBegin&) { return true; });
}
Step last_plane_test(const Work& work, std::int64_t step) {
  return find_last<RayPlane>(work.trace, step, [](const RayPlane&) { return true; });
}

static void tell(Datum& datum, Work& work, std::int64_t step, const RayBegin& e, std::string_view field) {
  const bool start = field == "x_0" || field == "y_0" || field == "z_0";
  if (!start && !field.starts_with("dir_")) return;
  const int axis = axis_in(start ? field : field.substr(4));
  if (e.role == RayRole::eye)
    return start ? tell_eye_start(datum, work, step, e, axis) : tell_eye_direction(datum, work, step, e, axis);
  const Step parent = begin_of_ray(work, step - 1, e.parent);
  const Step hit = parent ? kept_hit(work, step, *parent) : std::nullopt;
  if (!hit) return;
  if (start) return datum.same_as(hit_fields[axis], work.field(*hit, hit_fields[axis]));
  tell_secondary_direction(datum, work, *parent, *hit, e, axis);
}

static void tell(Datum& datum, Work& work, std::int64_t step, const RayPlane& e, std::string_view field) {
  const Step begin = last_ray(work, step);
  if (!begin || field == "facet") return;
  if (field == "t") return datum.comes_of("the ray runs along the plane", {work.field(step, "denominator")});
  const auto plane = [&](char letter) { return work.facet_plane(e.facet, letter); };
  const auto* fields = field == "numerator" ? from_fields : along_fields;
  Operands of;
  const auto normal = [&](char letter) { return of(std::string(1, letter), plane(letter)); };
  const auto ray = [&](std::size_t axis) { return of(fields[axis], work.field(*begin, fields[axis])); };
  const Formula a = normal('A'), x = ray(0), b = normal('B'), y = ray(1), c = normal('C'), z = ray(2);
  if (field != "numerator") return datum.is(formulas::dot(Way{a, b, c}, Way{x, y, z}), of);
  datum.is(-formulas::plane_value(a, b, c, normal('D'), x, y, z), of);
}

static void tell(Datum& datum, Work& work, std::int64_t step, const RayHit& e, std::string_view field) {
  const Step begin = last_ray(work, step);
  if (!begin || field == "facet") return;
  if (field == "nearest") {
    double kept = std::numeric_limits<double>::infinity();
    Step keeper;
    for (std::int64_t before = *begin + 1; before < step; ++before)
      if (const auto* hit = get_if<RayHit>(&work.trace.event(before).event); hit && hit->nearest)
        kept = hit->t, keeper = before;
    const std::vector<Number> numbers{work.field(step, "t"), work.field(keeper, "t", kept)};
    if (!e.inside || !keeper)
      return datum.comes_of(!e.inside ? "the point lies outside the facet" : "nothing was kept before", numbers);
    const bool tie = e.t == kept;
    datum.holds_if(tie && e.nearest ? "t <= kept" : "t < kept", {{"t", numbers[0]}, {"kept", numbers[1]}});
    if (!tie) return;
    const std::int32_t other = get<RayHit>(work.trace.event(*keeper).event).facet;
    return datum.note(keeps_first(work.trace.header()) && e.nearest == (e.facet < other)
                          ? "a tie: of two as near the first in the file is kept"
                          : "a tie");
  }
  if (field == "inside")
    datum.comes_of("by the even-odd rule along the ray",
                   {work.field(step, "x_hit"), work.field(step, "y_hit"), work.field(step, "z_hit")});
}

namespace {

constexpr const char* light_names[] = {"red", "green", "blue"};

/// Own colour, mirrored and transmitted light, by the material.
void tell_light(Datum& datum, Work& work, std::int64_t step, const RayEnd& e, int which) {
  const std::size_t facet = e.nearest_facet;
  const bool met = e.nearest_facet >= 0 && facet < work.scene.facets.size();
  const std::int32_t polygon = met ? work.scene.facets[facet].polygon : no_polygon;
  const Number own = work.color_of(polygon, which);
  const Step begin = begin_of_ray(work, step, e.ray);
  Step mirrored, through, shadow;
  bool dark = false;
  // The rays that it cast ended between its beginning and its end.
  for (std::int64_t at = begin.value_or(step); at < step; ++at) {
    const Event event = work.trace.event(at).event;
    const auto* cast = get_if<RayBegin>(&event);
    if (!cast || cast->parent != e.ray) continue;
    const std::int32_t ray = cast->ray;
    const RayRole role = cast->role;
    const Step end = find_first<RayEnd>(work.trace, at, [&](const RayEnd& other) { return other.ray == ray; });
    if (!end) continue;
    if (role == RayRole::shadow) shadow = end, dark = get<RayEnd>(work.trace.event(*end).event).nearest_facet >= 0;
    else (role == RayRole::reflected ? mirrored : through) = end;
  }
  Operands of;
  const Formula color = of("colour", own);
  const auto left = dark ? std::optional(of("in_shadow", formulas::in_shadow)) : std::nullopt;
  if (shadow) datum.note(fmt::format("the light {} the point: step {}", dark ? "does not reach" : "reaches", *shadow));
  const Material none, &material = met ? *work.scene.polygons[polygon].material : none;
  const double passes = (1 - material.reflectance) * (1 - material.opacity),
               mirror = material.reflectance + (through ? 0 : passes);
  const Formula own_part = of("own_part", (1 - material.reflectance) * material.opacity);
  const auto part = [&](const char* share, double value, const char* name, const Step& end) {
    if (!end) return std::optional<formulas::PartOfLight<Formula>>();
    const Formula passed = of(share, value);
    return std::optional(formulas::PartOfLight<Formula>{passed, of(name, work.field(*end, light_names[which]))});
  };
  const auto from_mirror = part("r", mirror, "mirrored", mirrored), from_behind = part("p", passes, "through", through);
  datum.is(formulas::light_back(own_part, color, left, from_mirror, from_behind), of, false);
}

}  // namespace

static void tell(Datum& datum, Work& work, std::int64_t step, const RayEnd& e, std::string_view field) {
  if (field == "tests") return datum.note("planes that it was held against");
  const Step begin = begin_of_ray(work, step, e.ray);
  if (field == "t") {
    const Step hit = begin ? kept_hit(work, step, *begin) : std::nullopt;
    if (hit) datum.same_as("t_hit", work.field(*hit, "t"));
    else datum.note("it meets nothing");
    return;
  }
  const bool is_shadow = begin && begin_at(work, *begin).role == RayRole::shadow;
  for (int which = 0; which < 3; ++which) {
    if (field != light_names[which]) continue;
    if (!is_shadow) return tell_light(datum, work, step, e, which);
    const Step hit = kept_hit(work, step, *begin);
    datum.comes_of(
        hit ? "0: something lies between the point and the light" : "1: nothing lies between the point and the light",
        {work.field(hit, "t", no_depth)});
  }
}

void tell_rays(Datum& datum, Work& work, std::int64_t step, const Event& event, std::string_view field) {
  tell_one_of<RayBegin, RayPlane, RayHit, RayEnd>(event, [&](const auto& e) { tell(datum, work, step, e, field); });
}

}  // namespace zstep::answers
