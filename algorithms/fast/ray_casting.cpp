// What the boxes of a Tree are built around: triangles of facets.

#include "algorithms/fast/ray_casting.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>
#include <limits>
#include <numeric>
#include <span>
#include <vector>

#include "traces/scene.hpp"
#include "algorithms/ray_casting/geometry.hpp"
#include "algorithms/fast/simd.hpp"

namespace zstep::ray_casting {

struct Shape {
  glm::dvec3 low, high;  ///< its box
  glm::dvec3 n, u, v;    ///< as in Packet
  double n_0, u_0, v_0;
  std::int32_t facet;
};

/// A facet that is star-shaped around its first corner, as convex ones are, is a fan of triangles. Any other is one
/// shape, which counts as its whole plane: a ray that meets it is held against the outline.
std::vector<Shape> shapes_of(const Scene& scene);

namespace {

// Whether the triangles (0, i, i + 1) cover the facet, each place once: seen from the first corner, the others follow
// each other within half a turn.
bool is_fan(const Target& target) {
  const std::vector<glm::dvec3>& corners = target.corners;
  const glm::dvec3 normal = target.plane.normal(), first = corners[1] - corners[0];
  for (std::size_t i = 1; i + 1 < corners.size(); ++i) {
    const glm::dvec3 here = corners[i] - corners[0], next = corners[i + 1] - corners[0];
    if (glm::dot(glm::cross(here, next), normal) < 0) return false;
    if (glm::dot(glm::cross(first, next), normal) < 0) return false;
  }
  return true;
}

Shape shape_around(const Target& target, std::initializer_list<glm::dvec3> corners) {
  Shape shape{};
  shape.facet = target.facet;
  shape.n = target.plane.normal(), shape.n_0 = target.plane.d;
  shape.u_0 = shape.v_0 = 0.25;  // inside, whatever the point
  shape.low = shape.high = *corners.begin();
  for (const glm::dvec3 corner : corners)
    shape.low = glm::min(shape.low, corner), shape.high = glm::max(shape.high, corner);
  return shape;
}

// `scale`: how large coordinates are. A triangle so narrow that rounding tells in its barycentric coordinates is met
// wherever its plane is.
void add_triangle(std::vector<Shape>& shapes, const Target& target, glm::dvec3 a, glm::dvec3 b, glm::dvec3 c,
                  double scale) {
  Shape shape = shape_around(target, {a, b, c});
  const glm::dvec3 n = glm::cross(b - a, c - a);
  const double square = glm::dot(n, n);
  const glm::dvec3 u = glm::cross(c - a, n) / square, v = glm::cross(n, b - a) / square;
  if (std::max(glm::length(u), glm::length(v)) * scale < 1e5) {
    shape.u = u, shape.u_0 = -glm::dot(u, a);
    shape.v = v, shape.v_0 = -glm::dot(v, a);
  }
  shapes.push_back(shape);
}

}  // namespace

std::vector<Shape> shapes_of(const Scene& scene) {
  double scale = glm::length(scene.camera.eye);
  for (const glm::dvec3& point : scene.points) scale = std::max(scale, glm::length(point));
  std::vector<Shape> shapes;
  shapes.reserve(scene.corners.size());
  for (std::int32_t n = 0; n < size32(scene.facets); ++n) {
    const Target target = target_of(scene, n);
    if (!can_be_met(scene, target)) continue;
    const std::vector<glm::dvec3>& corners = target.corners;
    if (is_fan(target)) {
      for (std::size_t i = 1; i + 1 < corners.size(); ++i) {
        add_triangle(shapes, target, corners[0], corners[i], corners[i + 1], scale);
      }
    } else {
      Shape shape = shape_around(target, {corners[0]});
      for (const glm::dvec3& corner : corners) {
        shape.low = glm::min(shape.low, corner), shape.high = glm::max(shape.high, corner);
      }
      shapes.push_back(shape);
    }
  }
  return shapes;
}

namespace {

constexpr std::size_t most_in_leaf = 4, bins = 16;

struct Box {
  glm::dvec3 low{std::numeric_limits<double>::infinity()}, high{-std::numeric_limits<double>::infinity()};

  void include(const Box& other) { low = glm::min(low, other.low), high = glm::max(high, other.high); }
  double half_area() const {
    const glm::dvec3 size = glm::max(high - low, glm::dvec3(0));
    return size.x * size.y + size.y * size.z + size.z * size.x;
  }
};

// Shapes order[first .. end) and their box.
struct Range {
  std::size_t first, end;
  Box box;

  std::size_t size() const { return end - first; }
};

class Builder {
 public:
  Builder(const std::vector<Shape>& shapes, double scale, Tree& tree)
      : shapes_(shapes), tree_(tree), order_(shapes.size()) {
    std::iota(order_.begin(), order_.end(), 0);
    for (const Shape& shape : shapes) {
      boxes_.push_back({shape.low, shape.high});
      centres_.push_back(0.5 * (shape.low + shape.high));
      for (int axis = 0; axis < 3; ++axis) {
        scale = std::max({scale, std::abs(shape.low[axis]), std::abs(shape.high[axis])});
      }
    }
    pad_ = 2e-6 * scale;
  }

  void build() { make_node(range(0, order_.size())); }

 private:
  Range range(std::size_t first, std::size_t end) const {
    Range result{first, end, {}};
    for (std::size_t i = first; i < end; ++i) result.box.include(boxes_[order_[i]]);
    return result;
  }

  // Where to part a range so that a ray is expected to cost least: the side's area says how probably it is met, its
  // packets what that costs. Sixteen bins an axis.
  std::array<Range, 2> part(const Range& whole) {
    Box centres;
    for (std::size_t i = whole.first; i < whole.end; ++i) centres.include({centres_[order_[i]], centres_[order_[i]]});
    double least = std::numeric_limits<double>::infinity();
    int best_axis = -1;
    std::size_t best_bin = 0;
    const auto bin_of = [&](std::size_t shape, int axis) {
      const double size = centres.high[axis] - centres.low[axis];
      const double place = (centres_[shape][axis] - centres.low[axis]) / size * bins;
      return std::min(bins - 1, static_cast<std::size_t>(place));
    };
    for (int axis = 0; axis < 3; ++axis) {
      if (!(centres.high[axis] > centres.low[axis])) continue;
      std::array<Box, bins> box;
      std::array<std::size_t, bins> count{};
      for (std::size_t i = whole.first; i < whole.end; ++i) {
        const std::size_t bin = bin_of(order_[i], axis);
        box[bin].include(boxes_[order_[i]]), ++count[bin];
      }
      std::array<double, bins> cost{};  // of all bins before this one
      Box before, behind;
      std::size_t shapes = 0;
      for (std::size_t bin = 1; bin < bins; ++bin) {
        before.include(box[bin - 1]), shapes += count[bin - 1];
        cost[bin] = shapes == 0 ? 0 : before.half_area() * packets(shapes);
      }
      shapes = 0;
      for (std::size_t bin = bins - 1; bin > 0; --bin) {
        behind.include(box[bin]), shapes += count[bin];
        if (shapes == 0 || shapes == whole.size()) continue;
        const double sum = cost[bin] + behind.half_area() * packets(shapes);
        if (sum < least) least = sum, best_axis = axis, best_bin = bin;
      }
    }
    const auto begin = order_.begin() + whole.first;
    const auto end = order_.begin() + whole.end;
    auto middle = begin + (end - begin) / 2;  // all centres in one place
    if (best_axis >= 0) {
      middle = std::partition(begin, end, [&](std::size_t shape) { return bin_of(shape, best_axis) < best_bin; });
    }
    const std::size_t at = middle - order_.begin();
    return {range(whole.first, at), range(at, whole.end)};
  }

  static double packets(std::size_t shapes) { return static_cast<double>((shapes + most_in_leaf - 1) / most_in_leaf); }

  // Parts the largest until there are eight, then goes down into each.
  std::int32_t make_node(const Range& whole) {
    std::vector<Range> parts{whole};
    while (parts.size() < children) {
      std::size_t largest = children;
      for (std::size_t i = 0; i < parts.size(); ++i) {
        if (parts[i].size() <= most_in_leaf) continue;
        if (largest == children || parts[i].box.half_area() > parts[largest].box.half_area()) largest = i;
      }
      if (largest == children) break;
      const auto [one, other] = part(parts[largest]);
      parts[largest] = one;
      parts.push_back(other);
    }

    const auto made = size32(tree_.nodes);
    tree_.nodes.emplace_back();
    constexpr float infinity = std::numeric_limits<float>::infinity();
    for (std::size_t i = 0; i < children; ++i) {
      const bool some = i < parts.size() && parts[i].size() > 0;
      std::int32_t child = 0;
      if (some) child = parts[i].size() <= most_in_leaf ? ~make_packet(parts[i]) : make_node(parts[i]);
      Node& node = tree_.nodes[made];
      node.child[i] = child;
      for (int axis = 0; axis < 3; ++axis) {
        // Wider by more than single precision loses on the way to t.
        node.low[axis][i] = some ? static_cast<float>(parts[i].box.low[axis] - pad_) : infinity;
        node.high[axis][i] = some ? static_cast<float>(parts[i].box.high[axis] + pad_) : -infinity;
      }
    }
    return made;
  }

  std::int32_t make_packet(const Range& range) {
    Packet packet{};  // n = 0 where there is no triangle: t is not a number, and nothing is hit
    for (std::size_t lane = 0; lane < most_in_leaf; ++lane) {
      packet.facet[lane] = -1;
      if (lane >= range.size()) continue;
      const Shape& shape = shapes_[order_[range.first + lane]];
      for (int axis = 0; axis < 3; ++axis) {
        packet.n[axis][lane] = shape.n[axis], packet.u[axis][lane] = shape.u[axis],
        packet.v[axis][lane] = shape.v[axis];
      }
      packet.n_0[lane] = shape.n_0, packet.u_0[lane] = shape.u_0, packet.v_0[lane] = shape.v_0;
      packet.facet[lane] = shape.facet;
    }
    tree_.packets.push_back(packet);
    return size32(tree_.packets) - 1;
  }

  const std::vector<Shape>& shapes_;
  Tree& tree_;
  std::vector<std::size_t> order_;
  std::vector<Box> boxes_;
  std::vector<glm::dvec3> centres_;
  double pad_ = 0;
};

}  // namespace

Tree build_tree(const Scene& scene) {
  Tree tree;
  const glm::dvec3 eye = glm::abs(scene.camera.eye);
  Builder(shapes_of(scene), std::max({eye.x, eye.y, eye.z}), tree).build();
  for (const Facet& facet : scene.facets) {
    tree.first_corner.push_back(size32(tree.corners));
    for (std::int32_t i = 0; i < facet.corner_count; ++i) {
      const std::int32_t corner = scene.corners[facet.first_corner + i];
      tree.corners.push_back(scene.points[corner]);
    }
  }
  tree.first_corner.push_back(size32(tree.corners));
  return tree;
}

namespace {

using namespace simd;

constexpr int most_waiting = 512;
constexpr double edge_slack = 1e-9;  // barycentric: neighbours overlap by as much, so that no gap is left between them

struct Hit {
  double t;
  std::int32_t facet = std::numeric_limits<std::int32_t>::max();
};

struct Waiting {
  std::int32_t child;
  float t;
};

// The ray as the boxes see it: t = bound * scale - shift along each axis.
struct Slabs {
  Floats scale[3], shift[3];
  bool negative[3];
  float t_least;
};

ZSTEP_INLINE Slabs slabs_of(const Ray& ray) {
  Slabs slabs;
  for (int axis = 0; axis < 3; ++axis) {
    // A ray along a plane of coordinates is tilted by next to nothing, so that no infinity meets a zero.
    const double along = std::abs(ray.along[axis]) > 1e-18 ? ray.along[axis] : std::copysign(1e-18, ray.along[axis]);
    slabs.scale[axis] = static_cast<float>(1 / along) + Floats{};
    slabs.shift[axis] = static_cast<float>(ray.from[axis] / along) + Floats{};
    slabs.negative[axis] = along < 0;
  }
  slabs.t_least = std::nextafter(static_cast<float>(ray.t_least), -std::numeric_limits<float>::infinity());
  return slabs;
}

ZSTEP_INLINE void keep_greater(Floats& one, const Floats& other) { one = one > other ? one : other; }
ZSTEP_INLINE void keep_less(Floats& one, const Floats& other) { one = one < other ? one : other; }

// Which of a node's boxes the ray meets before `t_most`, a bit each, and where it enters them.
ZSTEP_INLINE unsigned meet_boxes(const Node& node, const Slabs& slabs, float t_most, float* t_enter) {
  Floats enter = slabs.t_least + Floats{}, leave = t_most + Floats{};
  for (int axis = 0; axis < 3; ++axis) {
    Floats low, high;
    load(low, slabs.negative[axis] ? node.high[axis] : node.low[axis]);
    load(high, slabs.negative[axis] ? node.low[axis] : node.high[axis]);
    keep_greater(enter, low * slabs.scale[axis] - slabs.shift[axis]);
    keep_less(leave, high * slabs.scale[axis] - slabs.shift[axis]);
  }
  store(t_enter, enter);
  const FloatMask met = enter <= leave;
  return bits_of(met);
}

bool passes_inside(const Tree& tree, std::int32_t facet, const Ray& ray) {
  const std::size_t first = tree.first_corner[facet];
  const std::size_t end = tree.first_corner[static_cast<std::size_t>(facet) + 1];
  return passes_inside(AlongRay(ray), std::span(tree.corners).subspan(first, end - first));
}

// The part of a linear map that a ray's start and its direction have, for four triangles.
struct Along {
  Doubles from, along;

  ZSTEP_INLINE Along(const double (&map)[3][4], const Ray& ray) {
    Doubles x, y, z;
    load(x, map[0]), load(y, map[1]), load(z, map[2]);
    from = (x * ray.from.x + y * ray.from.y) + z * ray.from.z;
    along = (x * ray.along.x + y * ray.along.y) + z * ray.along.z;
  }
};

// The planes of four triangles, in the order in which cross() reckons; who is inside by a wide margin or nearly so is
// asked again as the taught method asks.
ZSTEP_INLINE void meet_packet(const Tree& tree, const Packet& packet, const Ray& ray, bool cull, Hit& hit) {
  Doubles n_0, u_0, v_0;
  load(n_0, packet.n_0), load(u_0, packet.u_0), load(v_0, packet.v_0);
  const Along n(packet.n, ray), u(packet.u, ray), v(packet.v, ray);
  const Doubles t = -(n.from + n_0) / n.along;
  const Doubles u_hit = (u.from + u_0) + t * u.along, v_hit = (v.from + v_0) + t * v.along;
  Mask met = (u_hit >= -edge_slack) & (v_hit >= -edge_slack) & (u_hit + v_hit <= 1 + edge_slack);
  met &= (t >= ray.t_least) & (t <= hit.t);
  if (cull) met &= n.along < 0;
  for (unsigned left = bits_of(met); left != 0; left &= left - 1) {
    const int lane = std::countr_zero(left);
    const std::int32_t facet = packet.facet[lane];
    const bool nearer = t[lane] < hit.t || (t[lane] == hit.t && facet < hit.facet);
    if (nearer && passes_inside(tree, facet, ray)) hit = {t[lane], facet};
  }
}

// The nearest hit; its facet is that of Hit{} if there is none.
ZSTEP_INLINE Hit first_on(const Tree& tree, const Ray& ray, bool cull) {
  const Slabs slabs = slabs_of(ray);
  Hit hit{ray.t_most};
  Waiting waiting[most_waiting];
  int count = 0;
  std::int32_t at = 0;
  while (true) {
    if (at < 0) {
      meet_packet(tree, tree.packets[~at], ray, cull, hit);
    } else {
      const Node& node = tree.nodes[at];
      const float t_far = std::nextafter(static_cast<float>(hit.t), std::numeric_limits<float>::infinity());
      alignas(32) float t_enter[children];
      unsigned met = meet_boxes(node, slabs, t_far, t_enter);
      if (met != 0) {
        // The nearest is next; the others wait, the nearer ones above.
        int lane = std::countr_zero(met);
        met &= met - 1;
        Waiting next{node.child[lane], t_enter[lane]};
        const int bottom = count;
        for (; met != 0; met &= met - 1) {
          lane = std::countr_zero(met);
          Waiting other{node.child[lane], t_enter[lane]};
          if (other.t < next.t) std::swap(other, next);
          int place = count++;
          for (; place > bottom && waiting[place - 1].t < other.t; --place) waiting[place] = waiting[place - 1];
          waiting[place] = other;
        }
        at = next.child;
        continue;
      }
    }
    do {
      if (count == 0) return hit;
      --count;
    } while (waiting[count].t > hit.t);
    at = waiting[count].child;
  }
}

struct Cast {
  const Tree& tree;
  const Scene& scene;
  const Conventions& conventions;
  Picture& picture;
};

ZSTEP_INLINE void cast_all(Cast& cast) {
  const EyeRays rays(cast.scene, cast.conventions.depth);
  const bool cull = cast.conventions.cull && cast.scene.camera.kind != Camera::Kind::screen;
  for (std::int32_t y = 0; y < cast.picture.height; ++y) {
    for (std::int32_t x = 0; x < cast.picture.width; ++x) {
      const Hit hit = first_on(cast.tree, rays.through(x, y), cull);
      if (hit.facet == Hit{}.facet) continue;
      const std::size_t pixel = cast.picture.at(x, y);
      cast.picture.polygon[pixel] = cast.scene.facets[hit.facet].polygon;
      cast.picture.depth[pixel] = rays.depth(hit.t);
    }
  }
}
ZSTEP_FOR_THIS_PROCESSOR(cast_all, Cast)

}  // namespace

Picture cast_fast(const Tree& tree, const Scene& scene, const Conventions& conventions) {
  Picture picture(scene.raster.width, scene.raster.height);
  Cast cast{tree, scene, conventions, picture};
  cast_all_on_this_processor(cast);
  return picture;
}

Picture cast_fast(const Scene& scene, const Conventions& conventions) {
  return cast_fast(build_tree(scene), scene, conventions);
}

}  // namespace zstep::ray_casting
