
#include "algorithms/ray_casting/space.hpp"

#include <algorithm>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>
#include <numeric>
#include <span>

#include "traces/math/whole.hpp"
#include "traces/record/all_recorders.hpp"
#include "traces/scene.hpp"

namespace zstep::ray_casting {

namespace {

using Places = std::span<std::int32_t>;  // of targets
constexpr std::size_t most_in_box = 2;
constexpr std::int32_t most_cells = 32;  // along one axis

Box box_around(const Space& space, std::span<const std::int32_t> places, double pad) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  Box box{glm::dvec3(infinity), glm::dvec3(-infinity)};
  for (const std::int32_t place : places) {
    for (const glm::dvec3& corner : space.targets[place].corners) {
      box.low = glm::min(box.low, corner - pad), box.high = glm::max(box.high, corner + pad);
    }
  }
  return box;
}

template <Recorder R>
std::int32_t make_box(Space& space, std::int32_t parent, Places places, double pad, R& record) {
  const auto number = size32(space.boxes);
  const Box box = box_around(space, places, pad);
  space.boxes.push_back({box, {-1, -1}, {}});
  const BoxMake made{number, parent, box.low.x, box.high.x, box.low.y, box.high.y, box.low.z, box.high.z};
  record(boxes::step::box, made);
  return number;
}

template <Recorder R>
void fill_box(Space& space, std::int32_t number, Places places, R& record) {
  for (const std::int32_t place : places) {
    space.boxes[number].targets.push_back(place);
    record(boxes::step::hold, BoxHold{number, space.targets[place].facet});
  }
}

// A box, and if it holds many a box around each half of them, parted across its longest side.
template <Recorder R>
std::int32_t make_hierarchy(Space& space, std::int32_t parent, Places places, double pad, R& record) {
  const std::int32_t number = make_box(space, parent, places, pad, record);
  if (places.size() <= most_in_box) {
    fill_box(space, number, places, record);
    return number;
  }
  const Box box = space.boxes[number].box;
  const glm::dvec3 size = box.high - box.low;
  const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
  const auto centre = [&](std::int32_t place) {
    const Box around = box_around(space, std::span(&place, 1), 0);
    return around.low[axis] + around.high[axis];
  };
  std::stable_sort(places.begin(), places.end(), [&](std::int32_t a, std::int32_t b) { return centre(a) < centre(b); });
  const std::size_t half = places.size() / 2;
  const std::int32_t one = make_hierarchy(space, number, places.first(half), pad, record);
  const std::int32_t other = make_hierarchy(space, number, places.subspan(half), pad, record);
  space.boxes[number].inner = {one, other};
  return number;
}

// About as many cells as facets, as nearly cubes as the box allows.
std::array<std::int32_t, 3> cells_for(const Box& box, std::size_t facets) {
  const glm::dvec3 size = box.high - box.low;
  const double longest = std::max({size.x, size.y, size.z});
  std::size_t along_longest = 1;  // the cube root of three times as many, rounded up
  while (along_longest < most_cells && along_longest * along_longest * along_longest < 3 * facets) ++along_longest;
  std::array<std::int32_t, 3> cells{};
  for (int axis = 0; axis < 3; ++axis) {
    cells[axis] = std::max(1, ceil_int(size[axis] / longest * static_cast<double>(along_longest) - 1e-6));
  }
  return cells;
}

std::int32_t cell_of(const Grid& grid, int axis, double coordinate) {
  const std::int32_t cells = grid.cells[axis];
  const double place = (coordinate - grid.box.low[axis]) / (grid.box.high[axis] - grid.box.low[axis]) * cells;
  return std::clamp(static_cast<std::int32_t>(place), 0, cells - 1);
}

template <Recorder R>
void make_grid(Space& space, Places places, double pad, R& record) {
  Grid& grid = space.grid;
  grid.box = box_around(space, places, 2 * pad);
  grid.cells = cells_for(grid.box, places.size());
  const auto [cells_x, cells_y, cells_z] = grid.cells;
  grid.targets.resize(static_cast<std::size_t>(cells_x) * cells_y * static_cast<std::size_t>(cells_z));
  const Box& box = grid.box;
  const GridMake made{cells_x, cells_y, cells_z, box.low.x, box.high.x, box.low.y, box.high.y, box.low.z, box.high.z};
  record(boxes::step::grid, made);

  for (const std::int32_t place : places) {
    const Box around = box_around(space, std::span(&place, 1), pad);
    std::array<std::int32_t, 3> first{}, last{};
    for (int axis = 0; axis < 3; ++axis) {
      first[axis] = cell_of(grid, axis, around.low[axis]);
      last[axis] = cell_of(grid, axis, around.high[axis]);
    }
    std::array<std::int32_t, 3> cell{};
    for (cell[2] = first[2]; cell[2] <= last[2]; ++cell[2]) {
      for (cell[1] = first[1]; cell[1] <= last[1]; ++cell[1]) {
        for (cell[0] = first[0]; cell[0] <= last[0]; ++cell[0]) {
          grid.targets[grid.place(cell)].push_back(place);
          const std::int32_t facet = space.targets[place].facet;
          record(boxes::step::cell_hold, CellHold{cell[0], cell[1], cell[2], facet});
        }
      }
    }
  }
}

}  // namespace

Passage Box::pass(const Ray& ray) const {
  Passage passage{ray.t_least, ray.t_most};
  for (int axis = 0; axis < 3; ++axis) {
    const double from = ray.from[axis], along = ray.along[axis];
    if (along == 0) {
      if (from < low[axis] || from > high[axis]) passage.t_leave = -std::numeric_limits<double>::infinity();
      continue;
    }
    const double to_low = (low[axis] - from) / along, to_high = (high[axis] - from) / along;
    passage.t_enter = std::max(passage.t_enter, std::min(to_low, to_high));
    passage.t_leave = std::min(passage.t_leave, std::max(to_low, to_high));
  }
  return passage;
}

template <Recorder R>
Space make_space(const Scene& scene, Boxes kind, R& record) {
  Space space;
  space.kind = kind;
  double size = glm::length(scene.camera.eye);
  for (std::int32_t facet = 0; facet < size32(scene.facets); ++facet) {
    const Target target = target_of(scene, facet);
    if (!can_be_met(scene, target)) {
      const std::int32_t polygon = scene.facets[facet].polygon;
      record(boxes::step::reject, PolygonReject{polygon, Reject::degenerate});
      continue;
    }
    space.targets.push_back(target);
    for (const glm::dvec3& corner : space.targets.back().corners) size = std::max(size, glm::length(corner));
  }
  space.met_by.assign(space.targets.size(), -1);

  const double pad = 1e-9 * size;
  std::vector<std::int32_t> places(space.targets.size());
  std::iota(places.begin(), places.end(), 0);
  if (places.empty()) return space;
  if (kind == Boxes::hierarchy) make_hierarchy(space, -1, places, pad, record);
  if (kind == Boxes::grid) make_grid(space, places, pad, record);
  if (kind == Boxes::facet) {
    for (std::int32_t& place : places) {
      const std::int32_t number = make_box(space, -1, Places(&place, 1), pad, record);
      fill_box(space, number, Places(&place, 1), record);
    }
  }
  return space;
}

#define INSTANTIATE(R) template Space make_space<R>(const Scene&, Boxes, R&);
ZSTEP_FOR_EACH_RECORDER(INSTANTIATE)
#undef INSTANTIATE

}  // namespace zstep::ray_casting
