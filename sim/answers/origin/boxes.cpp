// Boxes around facets, the cells of a grid, and the interval of a ray inside them.
#include <algorithm>
#include <cmath>

#include "algorithms/ray_casting/geometry.hpp"
#include "algorithms/ray_casting/space.hpp"
#include "sim/answers/origin/work.hpp"
#include "traces/formulas/boxes.hpp"

namespace zstep::answers {
namespace {

constexpr const char* low_fields[] = {"x_min", "y_min", "z_min"};
constexpr const char* high_fields[] = {"x_max", "y_max", "z_max"};
constexpr const char* from_fields[] = {"x_0", "y_0", "z_0"};
constexpr const char* along_fields[] = {"dir_x", "dir_y", "dir_z"};

int number_of_axis(std::string_view field) { return field[0] == 'x' ? 0 : field[0] == 'y' ? 1 : 2; }

/// By how much boxes are larger than what is in them.
double pad_of(const Scene& scene) {
  double size = glm::length(scene.camera.eye);
  for (const std::int32_t corner : scene.corners)
    size = std::max(size, glm::length(scene.points[static_cast<std::size_t>(corner)]));
  return 1e-9 * size;
}

/// A side of a box: a point's coordinate, less or more by the pad.
void tell_side(Datum& datum, Work& work, std::string_view field, double pads) {
  const bool low = field.ends_with("min");
  const int axis = number_of_axis(field);
  const double pad = pads * pad_of(work.scene), value = datum.number();
  for (const std::int32_t corner : work.scene.corners) {
    const double coordinate = work.scene.points[static_cast<std::size_t>(corner)][axis];
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
  const auto at = static_cast<std::size_t>(e.box);
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

}  // namespace zstep::answers
