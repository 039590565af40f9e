// Rays: where they begin and go, the planes and points they meet, and what they bring back.

#include <algorithm>
#include <array>
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

/// By how much boxes are larger than what is in them.
double pad_of(const Scene& scene) {
  double size = glm::length(scene.camera.eye);
  for (const std::int32_t corner : scene.corners) size = std::max(size, glm::length(scene.points[corner]));
  return 1e-9 * size;
}

/// A side of a box: a point's coordinate, less or more by the pad.
void tell_side(Datum& datum, Work& work, std::string_view field, double pads) {
  const bool low = field.ends_with("min");
  const Axis3 axis = axis_of(field);
  const double pad = pads * pad_of(work.scene), value = datum.number();
  for (const std::int32_t corner : work.scene.corners) {
    const double coordinate = work.scene.points[corner][+axis];
    if (formulas::side_of_box(coordinate, pad, low) != value) continue;
    Operands of;
    const Formula p = of("p", work.world(corner, axis)), wider = of("pad", pad);
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
void tell_at_side(Datum& datum, Work& work, std::int64_t step, Axis3 axis, const Number& bound) {
  const Step begin = work.last<RayBegin>(step);
  if (!begin) return;
  Operands of;
  const auto of_ray = [&](const std::string& field) { return of(field, work.field(*begin, field)); };
  const Formula edge = of("side", bound), from = of_ray(axis_name(axis, "_0")),
                along = of_ray("dir_" + axis_name(axis));
  datum.is(formulas::ray_at_side(edge, from, along), of);
}

/// The sides of a box: less or more along an axis.
using Sides = std::array<std::array<double, 3>, 2>;

/// The side at which t is reached; false where it is none of them (the ray's own beginning or end).
template <class Side>
bool tell_passage(Datum& datum, Work& work, std::int64_t step, const Sides& sides, Side&& bound) {
  const RayBegin* ray = ray_at_work(work);
  if (!ray) return false;
  for (const Axis3 axis : all_axes)
    for (const bool more : {false, true}) {
      const double from = formulas::detail::start_of(*ray)[+axis], along = formulas::detail::way_of(*ray)[+axis];
      if (along == 0 || formulas::ray_at_side(sides[more][+axis], from, along) != datum.number()) continue;
      tell_at_side(datum, work, step, axis, bound(axis, more));
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
  if (field == "hit") {
    const Number enter = work.field(step, "t_enter"), leave = work.field(step, "t_leave");
    if (!e.hit && enter.value <= leave.value)
      return datum.comes_of("it enters beyond the t that is kept", {enter, leave});
    return datum.holds_if("t_enter <= t_leave", {{"t_enter", enter}, {"t_leave", leave}});
  }
  const auto* known = entry(work.machine().boxes, e.box);
  if (!known || field == "box") return;
  const BoxMake box = known->entry;
  const Step made = find_first<BoxMake>(work.trace, 1, [&](const BoxMake& other) { return other.box == e.box; });
  const Sides sides{{{box.x_min, box.y_min, box.z_min}, {box.x_max, box.y_max, box.z_max}}};
  const bool told = tell_passage(datum, work, step, sides, [&](Axis3 axis, bool more) {
    return work.field(made, axis_name(axis, more ? "_max" : "_min"), sides[more][+axis]);
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
  const Sides all{{{grid.x_min, grid.y_min, grid.z_min}, {grid.x_max, grid.y_max, grid.z_max}}};
  const std::int32_t cells[] = {grid.cells_x, grid.cells_y, grid.cells_z}, cell[] = {e.cell_x, e.cell_y, e.cell_z};
  Sides sides{};
  for (const Axis3 axis : all_axes)
    for (const bool more : {false, true})
      sides[more][+axis] =
          formulas::side_of_cells<double>(all[0][+axis], all[1][+axis], cell[+axis] + more, cells[+axis]);
  const bool told = tell_passage(datum, work, step, sides, [&](Axis3 axis, bool more) {
    return work.derived(step, fmt::format("side {} {}", +axis, !more),
                        fmt::format("side of cell ({}, {}, {})", e.cell_x, e.cell_y, e.cell_z), "side",
                        sides[more][+axis], [&](Datum& inner) {
                          Operands of;
                          const auto end = [&](const char* name, const char* rest, double otherwise) {
                            return of(name, work.field(made, axis_name(axis, rest), otherwise));
                          };
                          const Formula least = end("low", "_min", all[0][+axis]),
                                        most = end("high", "_max", all[1][+axis]), k = of("k", cell[+axis] + more),
                                        count = of("cells", cells[+axis]);
                          inner.is(formulas::side_of_cells(least, most, k, count), of, false);
                        });
  });
  if (!told) datum.note("where the ray enters the grid, or begins");
}

namespace {

RayBegin begin_at(const Work& work, std::int64_t step) { return get<RayBegin>(work.trace.event(step).event); }

using Way = formulas::Vector<Formula>;
const Formula& along_axis(const Way& v, Axis3 axis) { return axis == Axis3::x ? v.x : axis == Axis3::y ? v.y : v.z; }

/// From the middle of the picture to a pixel's centre on the projection plane, along one axis of the world.
Formula across_window(Operands& of, Work& work, std::int64_t step, const viewing::Lens& lens, const RayBegin& e,
                      double right, double up) {
  const Formula x = of("x", e.x), w_x = of("w_x", work.window_width(step, "w_x", lens.window_y)),
                width = of("W", lens.width), t_1 = of("T_1", right), w_y = of("w_y", lens.window_y), y = of("y", e.y),
                height = of("H", lens.height), t_2 = of("T_2", up);
  return formulas::ray_x(x, w_x, width, lens.raster) * t_1 + formulas::ray_y(y, w_y, height, lens.raster) * t_2;
}

/// The hit that a ray kept: what it meets first.
Step kept_hit(const Work& work, std::int64_t at, std::int64_t begin) {
  // Rays that this one cast lie between its end and its hits, so look on from its beginning.
  Step kept;
  for (std::int64_t step = begin + 1; step <= at; ++step) {
    const Event event = work.trace.event(step).event;
    if (holds<RayEnd>(event) || holds<RayBegin>(event)) break;
    if (const auto* hit = get_if<RayHit>(&event); hit && hit->nearest) kept = step;
  }
  return kept;
}

/// A component of a ray's direction, of length 1.
Number unit_along(Work& work, std::int64_t begin, Axis3 axis) {
  const RayBegin ray = begin_at(work, begin);
  const glm::dvec3 along = glm::normalize(glm::dvec3(ray.dir_x, ray.dir_y, ray.dir_z));
  return work.derived(begin, "unit", fmt::format("direction of ray {}, of length 1", ray.ray), "D_" + axis_name(axis),
                      along[+axis], [&](Datum& datum) {
                        Operands of;
                        const Formula x = of("x", work.field(begin, "dir_x")), y = of("y", work.field(begin, "dir_y")),
                                      z = of("z", work.field(begin, "dir_z"));
                        const Way way{x, y, z};
                        datum.is(along_axis(way, axis) / formulas::length_of(way), of, false);
                      });
}

void tell_eye_direction(Datum& datum, Work& work, std::int64_t step, const RayBegin& e, Axis3 axis) {
  const Camera& camera = work.scene.camera;
  const viewing::Lens lens(camera, work.scene.raster, work.conventions.depth);
  if (camera.kind == Camera::Kind::screen) {
    datum.is("dz", {{"dz", axis == Axis3::z ? 1 : 0}});
    return datum.note("along z");
  }
  const glm::dmat3 axes = formulas::axes_of_view(camera);
  if (lens.orthographic) {
    datum.is("T_3", {{"T_3", axes[2][+axis]}});
    return datum.note(fmt::format("the line of sight, the third row of T_v; T_3: column {}", +axis + 1));
  }
  Operands of;
  const Formula across = across_window(of, work, step, lens, e, axes[0][+axis], axes[1][+axis]), d = of("d", lens.d),
                t_3 = of("T_3", axes[2][+axis]);
  datum.is(across + d * t_3, of);
  datum.note(fmt::format("T_1, T_2, T_3: {} {} of {}", camera.matrices ? "row" : "column", +axis + 1,
                         camera.matrices ? "the inverse of T_v" : "T_v"));
}

void tell_eye_start(Datum& datum, Work& work, std::int64_t step, const RayBegin& e, Axis3 axis) {
  const Camera& camera = work.scene.camera;
  if (camera.kind == Camera::Kind::screen) {
    datum.is("p", {{"p", axis == Axis3::x ? e.x : axis == Axis3::y ? e.y : 0}});
    return datum.note(axis == Axis3::x ? "pixel column" : axis == Axis3::y ? "pixel row" : "z = 0");
  }
  if (camera.kind == Camera::Kind::perspective) {
    datum.is("eye", {{"eye", camera.eye[+axis]}});
    return datum.note(camera.polar ? fmt::format("the eye, from rho {:.6g}, theta {:.6g}, phi {:.6g}", camera.rho,
                                                 camera.theta, camera.phi)
                                   : "the eye");
  }
  const viewing::Lens lens(camera, work.scene.raster, work.conventions.depth);
  const glm::dmat4& view = camera.view;
  Operands of;
  const double right = view[+axis][0], up = view[+axis][1];
  const Formula across = across_window(of, work, step, lens, e, right, up), o_x = of("o_x", view[3][0]),
                o_y = of("o_y", view[3][1]), o_z = of("o_z", view[3][2]), t_3 = of("T_3", view[+axis][2]);
  datum.is(across - formulas::dot(Way{o_x, o_y, o_z}, Way{of("T_1", right), of("T_2", up), t_3}), of, false);
  datum.note(fmt::format("on the plane of the eye; T_1, T_2, T_3: column {} of T_v; o: its fourth", +axis + 1));
}

void tell_secondary_direction(Datum& datum, Work& work, std::int64_t parent, std::int64_t hit, const RayBegin& e,
                              Axis3 axis) {
  if (e.role == RayRole::shadow) {
    const Number point = work.field(hit, axis_name(axis, "_hit"));
    Operands of;
    const Formula light = of("light_" + axis_name(axis), work.scene.light ? work.scene.light->position[+axis] : 0);
    return datum.is(light - of("point_" + axis_name(axis), point), of);
  }
  const std::int32_t facet = get<RayHit>(work.trace.event(hit).event).facet;
  Operands of;
  const auto direction = [&](Axis3 k) { return of("D_" + axis_name(k), unit_along(work, parent, k)); };
  const auto facing = [&](Axis3 k) {
    return of("N_" + axis_name(k), work.facet_plane(facet, static_cast<char>('A' + +k)));
  };
  const Formula d_x = direction(Axis3::x), n_x = facing(Axis3::x), d_y = direction(Axis3::y), n_y = facing(Axis3::y),
                d_z = direction(Axis3::z), n_z = facing(Axis3::z);
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

static void tell(Datum& datum, Work& work, std::int64_t step, const RayBegin& e, std::string_view field) {
  const bool start = field == "x_0" || field == "y_0" || field == "z_0";
  if (!start && !field.starts_with("dir_")) return;
  const Axis3 axis = axis_of(field);
  if (e.role == RayRole::eye)
    return start ? tell_eye_start(datum, work, step, e, axis) : tell_eye_direction(datum, work, step, e, axis);
  const Step parent = work.last(step - 1, &RayBegin::ray, e.parent);
  const Step hit = parent ? kept_hit(work, step, *parent) : std::nullopt;
  if (!hit) return;
  if (start) return datum.same_as(axis_name(axis, "_hit"), work.field(*hit, axis_name(axis, "_hit")));
  tell_secondary_direction(datum, work, *parent, *hit, e, axis);
}

static void tell(Datum& datum, Work& work, std::int64_t step, const RayPlane& e, std::string_view field) {
  const Step begin = work.last<RayBegin>(step);
  if (!begin || field == "facet") return;
  if (field == "t") return datum.comes_of("the ray runs along the plane", {work.field(step, "denominator")});
  Operands of;
  const auto normal = [&](char letter) { return of(std::string(1, letter), work.facet_plane(e.facet, letter)); };
  const auto ray = [&](Axis3 axis) {
    const std::string name = field == "numerator" ? axis_name(axis, "_0") : "dir_" + axis_name(axis);
    return of(name, work.field(*begin, name));
  };
  const Formula a = normal('A'), x = ray(Axis3::x), b = normal('B'), y = ray(Axis3::y), c = normal('C'),
                z = ray(Axis3::z);
  if (field != "numerator") return datum.is(formulas::dot(Way{a, b, c}, Way{x, y, z}), of);
  datum.is(-formulas::plane_value(a, b, c, normal('D'), x, y, z), of);
}

static void tell(Datum& datum, Work& work, std::int64_t step, const RayHit& e, std::string_view field) {
  const Step begin = work.last<RayBegin>(step);
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

/// Own colour, mirrored and transmitted light, by the material.
void tell_light_back(Datum& datum, Work& work, std::int64_t step, const RayEnd& e, int which) {
  const std::int32_t polygon = polygon_of_facet(work.scene, e.nearest_facet);
  const bool met = polygon != no_polygon;
  const Number own = work.color_of(polygon, which);
  const Step begin = work.last(step, &RayBegin::ray, e.ray);
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
    return std::optional(formulas::PartOfLight<Formula>{passed, of(name, work.field(*end, channel_names[which]))});
  };
  const auto from_mirror = part("r", mirror, "mirrored", mirrored), from_behind = part("p", passes, "through", through);
  datum.is(formulas::light_back(own_part, color, left, from_mirror, from_behind), of, false);
}

}  // namespace

static void tell(Datum& datum, Work& work, std::int64_t step, const RayEnd& e, std::string_view field) {
  if (field == "tests") return datum.note("planes that it was held against");
  const Step begin = work.last(step, &RayBegin::ray, e.ray);
  if (field == "t") {
    const Step hit = begin ? kept_hit(work, step, *begin) : std::nullopt;
    if (hit) datum.same_as("t_hit", work.field(*hit, "t"));
    else datum.note("it meets nothing");
    return;
  }
  const bool is_shadow = begin && begin_at(work, *begin).role == RayRole::shadow;
  for (int which = 0; which < 3; ++which) {
    if (field != channel_names[which]) continue;
    if (!is_shadow) return tell_light_back(datum, work, step, e, which);
    const Step hit = kept_hit(work, step, *begin);
    datum.comes_of(
        hit ? "0: something lies between the point and the light" : "1: nothing lies between the point and the light",
        {work.field(hit, "t", no_depth)});
  }
}

TellTheme* const tell_boxes = tell_one_of<BoxMake, GridMake, BoxTest, CellVisit>;
TellTheme* const tell_rays = tell_one_of<RayBegin, RayPlane, RayHit, RayEnd>;

}  // namespace zstep::answers
