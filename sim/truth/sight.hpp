// How a facet lies to the lines of sight, in long double and without any code of the methods. For truth.cpp and
// facet_at.cpp only.
#pragma once

#include <cstdint>
#include <glm/matrix.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <optional>
#include <vector>

#include "sim/truth/truth.hpp"

namespace zstep::compare {

// One facet at one pixel: what of the brute force of truth.hpp a question about a single polygon needs.

/// One facet at one pixel's centre, whether it covers it or not.
struct FacetAt {
  Candidate candidate;
  bool in_square = false;  ///< a part of it that has an area lies in the pixel's square, |dx| <= 1/2 and |dy| <= 1/2
};
/// nullopt if nothing of the facet may be drawn: facing away where `cull`, without area, wholly before near or beyond
/// far. Looks at this facet only.
std::optional<FacetAt> facet_at(const Scene& scene, std::int32_t facet, bool cull, std::int32_t x, std::int32_t y,
                                bool non_zero = false);

/// z_v (a screen scene's own z) at which the line of sight through a pixel's centre meets a facet inside its outline,
/// near and far plane and facing left aside; negative behind the eye. nullopt if it misses it or runs along its plane.
std::optional<double> depth_on_sight(const Scene& scene, std::int32_t facet, std::int32_t x, std::int32_t y,
                                     bool non_zero = false);

using Real = long double;
using Vec2 = glm::vec<2, Real>;
using Vec3 = glm::vec<3, Real>;

inline constexpr Real edge_on_sine = 1e-9L;  // below: rounding decides which way a facet faces, and what its plane says

Vec3 in_view(const Camera& camera, const glm::dvec3& world);

/// Where lines of sight and the raster meet. Pixels are seen at integers.
struct Sight {
  const Camera& camera;
  Real half_x, half_y, width, height;
  Real down;     ///< 1 where rows go down, -1 where they go up
  Real seen_at;  ///< where in a pixel it is seen

  explicit Sight(const Scene& scene)
      : camera(scene.camera),
        half_y(scene.camera.window),
        width(scene.raster.width),
        height(scene.raster.height),
        down(scene.raster.y_up ? -1 : 1),
        seen_at(scene.raster.corners ? 0 : 0.5L) {
    half_x = half_y * width / height;
  }
  bool screen() const { return camera.kind == Camera::Kind::screen; }
  bool perspective() const { return camera.kind == Camera::Kind::perspective; }

  Vec2 on_raster(const Vec3& view) const {
    if (screen()) return {view.x, view.y};
    const Real shrink = perspective() ? static_cast<Real>(camera.d) / view.z : 1;
    return {(view.x * shrink / half_x + 1) / 2 * width - seen_at,
            (1 - down * view.y * shrink / half_y) / 2 * height - seen_at};
  }
  /// A point of the line of sight, and how it moves for z growing by one: at depth z it is from + z * along.
  void line(const Vec2& raster, Vec3& from, Vec3& along) const {
    from = {raster.x, raster.y, 0}, along = {0, 0, 1};
    if (screen()) return;
    const Real x_p = ((raster.x + seen_at) / width * 2 - 1) * half_x,
               y_p = (1 - (raster.y + seen_at) / height * 2) * half_y * down;
    from = perspective() ? Vec3(0) : Vec3(x_p, y_p, 0);
    if (perspective()) along = {x_p / static_cast<Real>(camera.d), y_p / static_cast<Real>(camera.d), 1};
  }
  /// How far the line of sight moves sideways at depth z when the raster's point moves by one pixel.
  Real pixel_at(Real z) const {
    if (screen()) return 1;
    const Real pixel = 2 * half_y / height;
    return perspective() ? pixel * std::fabs(z) / static_cast<Real>(camera.d) : pixel;
  }
};

struct Seen {
  std::vector<Vec2> outline;  // on the raster
  Vec3 middle, normal;        // its plane, in view space; unit normal, 0 if there is none
  Real bend = 0;              // the largest distance of a corner from it
  Real z_low = 0, z_high = 0;
  bool edge_on = false;
};

/// A facet as it is seen; false if nothing of it may be drawn.
bool see(const Scene& scene, const Facet& facet, const Sight& sight, bool cull, Seen& seen);

/// Inside by the even-odd or the non-zero rule, and how far from the nearest edge.
void locate(const Seen& seen, const Vec2& place, bool non_zero, Candidate& candidate);

/// The depth of the facet's plane on the line of sight.
void measure_depth(const Seen& seen, const Sight& sight, const Vec2& place, Candidate& candidate);

}  // namespace zstep::compare
