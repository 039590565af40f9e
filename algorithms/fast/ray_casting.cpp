#include "algorithms/fast/ray_casting.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <span>

#include "algorithms/fast/simd.hpp"
#include "algorithms/ray_casting/geometry.hpp"

namespace zstep::ray_casting {

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
  const auto first = static_cast<std::size_t>(tree.first_corner[static_cast<std::size_t>(facet)]);
  const auto end = static_cast<std::size_t>(tree.first_corner[static_cast<std::size_t>(facet) + 1]);
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
      meet_packet(tree, tree.packets[static_cast<std::size_t>(~at)], ray, cull, hit);
    } else {
      const Node& node = tree.nodes[static_cast<std::size_t>(at)];
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
    } while (static_cast<double>(waiting[count].t) > hit.t);
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
      cast.picture.polygon[pixel] = cast.scene.facets[static_cast<std::size_t>(hit.facet)].polygon;
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
