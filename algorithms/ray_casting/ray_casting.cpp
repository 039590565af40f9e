
#include "algorithms/ray_casting/ray_casting.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "traces/record/all_recorders.hpp"
#include "traces/scene.hpp"

namespace zstep::ray_casting {

template <Recorder R>
Picture run(const Scene& scene, const Conventions& conventions, R& record) {
  Picture picture(scene.raster.width, scene.raster.height);
  record(step::clear, BuffersClear{no_depth});

  Space space = make_space(scene, choice_of<Boxes>(options, conventions, "boxes"), record);
  const EyeRays rays(scene, conventions.depth);
  const Meets meets{conventions.cull && scene.camera.kind != Camera::Kind::screen, -1};

  std::int32_t number = 0;
  for (std::int32_t y = 0; y < picture.height; ++y) {
    for (std::int32_t x = 0; x < picture.width; ++x, ++number) {
      const Ray ray = rays.through(x, y);
      const glm::dvec3 from = ray.from, along = ray.along;
      const RayBegin begin{number, -1, RayRole::eye, x, y, from.x, from.y, from.z, along.x, along.y, along.z};
      record(step::ray, begin);

      const Nearest nearest = first_hit(space, ray, meets, record);
      const bool met = nearest.facet >= 0;
      const std::int32_t polygon = met ? scene.facets[nearest.facet].polygon : no_polygon;
      const Color color = met ? scene.polygons[polygon].color : scene.background;
      const double red = color.red / 255.0, green = color.green / 255.0, blue = color.blue / 255.0;
      record(step::ray_end, RayEnd{number, nearest.facet, met ? nearest.t : no_depth, nearest.tests, red, green, blue});
      if (!met) continue;

      const double z = rays.depth(nearest.t);
      picture.polygon[picture.at(x, y)] = polygon;
      picture.depth[picture.at(x, y)] = z;
      record(step::paint, PixelPaint{x, y, z, polygon});
    }
  }
  return picture;
}

#define INSTANTIATE(R) template Picture run<R>(const Scene&, const Conventions&, R&);
ZSTEP_FOR_EACH_RECORDER(INSTANTIATE)
#undef INSTANTIATE

namespace {

template <Recorder R>
struct Search {
  Space& space;
  const Ray& ray;
  const AlongRay along;
  const Meets meets;
  Nearest nearest;
  R& record;

  // Is there something to be found at t_enter or beyond it?
  bool worth_it(Passage passage) const { return passage.t_enter <= passage.t_leave && passage.t_enter <= nearest.t; }

  void test_facet(std::int32_t place) {
    const std::size_t i = place;
    const Target& target = space.targets[i];
    if (space.met_by[i] == space.rays || target.facet == meets.not_facet) return;  // a facet lies in several cells
    space.met_by[i] = space.rays;

    ++nearest.tests;
    const Crossing crossing = cross(ray, target.plane);
    record(meeting::step::plane, RayPlane{target.facet, crossing.numerator, crossing.denominator, crossing.t});
    double t = crossing.t;
    if (meets.not_facet >= 0 && std::abs(t) <= meets.here) {
      if (!meets.layers || target.facet < meets.not_facet) return;
      t = 0;
    }
    if (!(t >= ray.t_least && t <= ray.t_most)) return;
    if (meets.cull && crossing.denominator > 0) return;  // the normal points away from where the ray comes from

    const bool inside = passes_inside(along, target.corners);
    const bool nearer = t < nearest.t || (t == nearest.t && (nearest.facet < 0 || target.facet < nearest.facet));
    const glm::dvec3 point = ray.at(t);
    const RayHit hit{target.facet, t, point.x, point.y, point.z, inside, inside && nearer};
    record(meeting::step::hit, hit);
    if (hit.nearest) nearest.facet = target.facet, nearest.t = t;
  }

  void test_facets(const std::vector<std::int32_t>& places) {
    for (const std::int32_t place : places) test_facet(place);
  }

  Passage test_box(std::int32_t number) {
    const Passage passage = space.boxes[number].box.pass(ray);
    record(meeting::step::box_test, BoxTest{number, passage.t_enter, passage.t_leave, worth_it(passage)});
    return passage;
  }

  void search_each_box() {
    for (std::int32_t number = 0; number < size32(space.boxes); ++number) {
      if (worth_it(test_box(number))) test_facets(space.boxes[number].targets);
    }
  }

  // What is in a box that the ray meets; the inner box that it enters first comes first.
  void search_inside(std::int32_t number) {
    const BoxNode& node = space.boxes[number];
    test_facets(node.targets);
    auto [first, second] = node.inner;
    if (first < 0) return;
    Passage to_first = test_box(first), to_second = test_box(second);
    if (to_second.t_enter < to_first.t_enter) std::swap(first, second), std::swap(to_first, to_second);
    if (worth_it(to_first)) search_inside(first);
    if (worth_it(to_second)) search_inside(second);
  }

  // J. Amanatides, A. Woo, "A Fast Voxel Traversal Algorithm for Ray Tracing", Eurographics 1987. Where the ray leaves
  // a cell is reckoned anew each time rather than added up.
  void search_cells() {
    const Grid& grid = space.grid;
    const Passage passage = grid.box.pass(ray);
    if (!(passage.t_enter <= passage.t_leave)) return;
    const glm::dvec3 start = ray.at(passage.t_enter);
    std::array<std::int32_t, 3> cell{};
    for (int axis = 0; axis < 3; ++axis) {
      const double size = grid.box.high[axis] - grid.box.low[axis];
      const std::int32_t cells = grid.cells[axis];
      const double place = (start[axis] - grid.box.low[axis]) / size * cells;
      cell[axis] = std::clamp(static_cast<std::int32_t>(place), 0, cells - 1);
    }
    double t_enter = passage.t_enter;
    while (t_enter <= nearest.t) {
      double t_leave = std::numeric_limits<double>::infinity();
      int through = 0;  // the side by which it leaves
      for (int axis = 0; axis < 3; ++axis) {
        const double go = ray.along[axis];
        if (go == 0) continue;
        const double t = (grid.edge(axis, cell[axis] + (go > 0)) - ray.from[axis]) / go;
        if (t < t_leave) t_leave = t, through = axis;
      }
      record(meeting::step::cell, CellVisit{cell[0], cell[1], cell[2], t_enter, t_leave});
      test_facets(grid.targets[grid.place(cell)]);

      std::int32_t& number = cell[through];
      number += ray.along[through] > 0 ? 1 : -1;
      if (number < 0 || number >= grid.cells[through]) return;
      t_enter = std::max(t_enter, t_leave);
    }
  }
};

}  // namespace

template <Recorder R>
Nearest first_hit(Space& space, const Ray& ray, Meets meets, R& record) {
  Search<R> search{space, ray, AlongRay(ray), meets, {-1, ray.t_most, 0}, record};
  if (space.kind == Boxes::none) {
    for (std::size_t place = 0; place < space.targets.size(); ++place)
      search.test_facet(static_cast<std::int32_t>(place));
  }
  if (space.kind == Boxes::facet) search.search_each_box();
  if (space.kind == Boxes::hierarchy && !space.boxes.empty() && search.worth_it(search.test_box(0)))
    search.search_inside(0);
  if (space.kind == Boxes::grid && !space.targets.empty()) search.search_cells();

  const auto spared = size32(space.targets) - search.nearest.tests;
  if (space.kind != Boxes::none) {
    record(meeting::step::saved, Saved{Coherence::extent, spared});
  }
  ++space.rays;
  return search.nearest;
}

#define INSTANTIATE(R) template Nearest first_hit<R>(Space&, const Ray&, Meets, R&);
ZSTEP_FOR_EACH_RECORDER(INSTANTIATE)
#undef INSTANTIATE

}  // namespace zstep::ray_casting
