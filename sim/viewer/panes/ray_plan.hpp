// The rays of the pixel at work, seen from above: where a point lies on this plan, and the boxes and cells on it.
#pragma once

#include <array>
#include <limits>
#include <optional>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <glm/vec2.hpp>

#include "sim/viewer/panes/plan_frame.hpp"
#include "sim/viewer/panes/raster_words.hpp"
#include "sim/viewer/panes/ui.hpp"

namespace zstep::viewer {

/// From above: what lies away from the eye is drawn upwards, or to the right where the pane is wider than high. A
/// screen scene is seen along its rows: x and z.
class PlanOfRays {
 public:
  /// On the ray through this part of the window's half width from its middle, at this t.
  static glm::dvec3 on_window(const Scene& scene, double share, double t) {
    const Camera& camera = scene.camera;
    const double half = camera.window * scene.raster.width / scene.raster.height;
    const glm::dmat3 to_world = glm::transpose(glm::dmat3(camera.view));
    return camera.eye + t * (to_world * glm::dvec3(share * half, 0, camera.d));
  }

  PlanOfRays(const Scene& scene, ImVec2 at, ImVec2 size, float margin)
      : screen_(scene.camera.kind == Camera::Kind::screen), wide_(size.x > size.y), at_(at) {
    const glm::dmat4& view = scene.camera.view;
    const glm::dvec2 away(view[0][2], view[1][2]), right(view[0][0], view[1][0]);
    if (glm::length(away) > 1e-6) away_ = glm::normalize(away);
    right_ = glm::length(right) > 1e-6 ? glm::normalize(right) : glm::dvec2(away_.y, -away_.x);
    for (const glm::dvec3& point : scene.points) include(flat(point));
    if (scene.camera.kind == Camera::Kind::perspective) include(flat(scene.camera.eye));
    if (scene.light) include(flat(scene.light->position));
    show_rays(scene);
    const glm::dvec2 span = glm::max(high_ - low_, glm::dvec2(1e-9));
    const glm::dvec2 pane(size.x, size.y);
    scale_ = std::min((pane.x - 2 * margin) / span.x, (pane.y - 2 * margin) / span.y);
    middle_ = 0.5 * (low_ + high_);
    half_ = 0.5 * pane;
  }

  glm::dvec2 flat(glm::dvec3 point) const {
    const double across = screen_ ? point.x : glm::dot(right_, glm::dvec2(point));
    const double away = screen_ ? point.z : glm::dot(away_, glm::dvec2(point));
    return wide_ ? glm::dvec2(away, -across) : glm::dvec2(across, away);
  }
  glm::dvec2 inside(glm::dvec3 point) const {
    const glm::dvec2 p = (flat(point) - middle_) * scale_;
    return {half_.x + p.x, half_.y - p.y};
  }
  ImVec2 place(glm::dvec3 point) const {
    const glm::dvec2 p = inside(point);
    return moved_by(at_, p.x, p.y);
  }
  ImVec2 at() const { return at_; }
  double scale() const { return scale_; }  ///< pixels of a unit
  /// Far enough for a ray that meets nothing to leave the pane.
  double farthest() const { return 2 * glm::length(high_ - low_) + 1; }

 private:
  /// What rays meet of planes lies beside polygons, too: as far as the outer rays reach, where that is not much
  /// farther.
  void show_rays(const Scene& scene) {
    const Camera& camera = scene.camera;
    if (camera.kind != Camera::Kind::perspective) return;
    const glm::dvec2 least = low_, most = high_, more = 0.05 * (high_ - low_);
    double deepest = 0;
    for (const glm::dvec3& point : scene.points)
      deepest = std::max(deepest, (glm::dmat3(camera.view) * (point - camera.eye)).z);
    for (const double side : {-1.0, 1.0})
      include(glm::clamp(flat(on_window(scene, side, deepest / std::max(1e-9, camera.d))), least - more, most + more));
  }
  void include(glm::dvec2 p) { low_ = glm::min(low_, p), high_ = glm::max(high_, p); }

  bool screen_, wide_;
  ImVec2 at_;
  glm::dvec2 right_{1, 0}, away_{0, 1}, middle_{0}, half_{0};
  glm::dvec2 low_{std::numeric_limits<double>::infinity()}, high_{-std::numeric_limits<double>::infinity()};
  double scale_ = 1;
};

/// The ray at work; none before the first.
const RayBegin* ray_in(const RayWork& rays);
/// The ray that the step is about: where one ends, that one, though the run is back at its parent.
std::optional<std::int32_t> ray_now(const Session& s);
inline glm::dvec3 from_of(const RayBegin& ray) { return {ray.x_0, ray.y_0, ray.z_0}; }
inline glm::dvec3 along_of(const RayBegin& ray) { return {ray.dir_x, ray.dir_y, ray.dir_z}; }

/// A lesson shows boxes and cells from its first stop on at which one is tested.
bool shows_boxes(const Ui& ui);
/// Those that the ray meets before what it has met are drawn through, the others dashed.
void draw_boxes(const Ui& ui, const PlanOfRays& plan);
/// Of those that the ray was tested against, at their corners.
void name_boxes(const Ui& ui, const PlanOfRays& plan, WordPlaces& words);
/// Of the box that the ray is tested against, or that is asked for: its slabs along x and y, and on the ray with which
/// t it comes into each and out of it.
void draw_slabs(const Ui& ui, const PlanOfRays& plan, WordPlaces& words);
/// The grid, and the cells that the ray has visited.
void draw_cells(const Ui& ui, const PlanOfRays& plan);

}  // namespace zstep::viewer
