#include "sim/homework/plain_scene.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <ranges>
#include <span>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "algorithms/pieces/pieces.hpp"
#include "algorithms/scene/builder.hpp"
#include "algorithms/viewing/clip.hpp"
#include "traces/error.hpp"
#include "traces/events/vocabulary.hpp"
#include "traces/formulas/viewing.hpp"
#include "traces/scene.hpp"

namespace zstep::homework {

namespace {

using Corners = std::vector<std::int32_t>;

/// Twice the signed area of the triangle of three corners, as the eye sees it.
double turn_at(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) {
  return (b.x - a.x) * (c.y - b.y) - (b.y - a.y) * (c.x - b.x);
}

/// Of an outline on the screen, whether it turns one way, and once round; and where it turns most.
struct Turns {
  bool convex = true;
  std::size_t sharpest = 0;    ///< the first of the three corners that enclose most
  double first = 0, most = 0;  ///< what the first three corners enclose, and these
};
Turns turns_of(std::span<const glm::dvec3> corners) {
  Turns turns;
  const auto at = [&](std::size_t i) { return corners[i % corners.size()]; };
  int left = 0, right = 0, changes_of_side = 0;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const double turn = turn_at(at(i), at(i + 1), at(i + 2));
    const double size = glm::length(at(i + 1) - at(i)) * glm::length(at(i + 2) - at(i + 1));
    if (turn > 1e-12 * size) ++left;
    if (turn < -1e-12 * size) ++right;
    // An outline that turns one way goes to the right, and back to the left, once.
    changes_of_side += (at(i + 1).x > at(i).x) != (at(i + 2).x > at(i + 1).x);
    if (i == 0) turns.first = std::abs(turn);
    if (std::abs(turn) > turns.most) turns.sharpest = i, turns.most = std::abs(turn);
  }
  turns.convex = (left == 0 || right == 0) && changes_of_side <= 2;
  return turns;
}

/// A coordinate on the screen without what rounding left beside a centre or a border of pixels. There decisions fall,
/// and a program that computes as exactly in another order must not fall to the other side.
double on_half(double coordinate) {
  const double half = std::round(2 * coordinate) / 2;
  return std::abs(coordinate - half) < 1e-11 ? half : coordinate;
}

/// Puts together what is handed out.
class Builder {
 public:
  Builder(const Scene& from, const Conventions& conventions, const PolygonsAsked& asked)
      : from_(from), asked_(asked), lens_(from.camera, from.raster, conventions.depth), cull_(conventions.cull) {
    scene_.name = from.name, scene_.source = from.source;
    scene_.background = from.background, scene_.raster = from.raster;
    scene_.textures = from.textures;
    if (on_screen()) {
      NullRecorder nothing;
      vertices_ = viewing::view_vertices(from, lens_, nothing);
      scene_.camera.kind = Camera::Kind::screen;
      scene_.camera.polar = false;
    } else {
      scene_.camera = from.camera;
    }
  }

  Scene build() {
    for (const Facet& facet : from_.facets) add(facet);
    kept_ = scene_.polygons.size();
    if (scene_.facets.empty())
      throw InputError(from_.source, "no polygon of it can be seen, so there is nothing to be drawn",
                       "turn the camera to it, or take out the scene");
    name_polygons();
    return std::move(scene_);
  }
  /// Whether each polygon of the scene came through as it was.
  bool changed() const {
    return changed_ || (on_screen() && from_.camera.kind != Camera::Kind::screen) || kept_ != from_.polygons.size() ||
           kept_ != from_.facets.size();
  }

 private:
  bool on_screen() const { return asked_.space == PolygonsAsked::Space::screen; }

  glm::dvec3 point_at(std::int32_t vertex) const {
    const std::size_t i = vertex;
    if (!on_screen()) return from_.points[i];
    const glm::dvec3 raster = vertices_[i].raster;
    if (from_.camera.kind == Camera::Kind::screen) return raster;
    return {on_half(raster.x), on_half(raster.y), raster.z};
  }
  std::vector<glm::dvec3> points_of(const Corners& corners) const {
    std::vector<glm::dvec3> points;
    for (const std::int32_t corner : corners) points.push_back(point_at(corner));
    return points;
  }

  void add(const Facet& facet) {
    Corners outline;
    if (on_screen()) {
      NullRecorder nothing;
      vertices_.resize(from_.points.size());  // without those that clipping made for the facet before
      if (!clipping::find_outline(from_, facet, cull_, lens_, vertices_, outline, nothing)) return;
    } else {
      const auto first = from_.corners.begin() + facet.first_corner;
      outline.assign(first, first + facet.corner_count);
    }
    const std::vector<glm::dvec3> corners = points_of(outline);
    const pieces::Plane plane = pieces::plane_of(corners);
    if (glm::length(plane.normal()) == 0 || (on_screen() && std::abs(plane.c) < 1e-12)) return;
    const Turns turns = turns_of(corners);
    glm::dvec3 low = corners.front(), high = low;
    for (const glm::dvec3& corner : corners) low = glm::min(low, corner), high = glm::max(high, corner);
    const bool bent = asked_.planar && corners.size() > 3 &&
                      pieces::bend_of(plane, corners) > 1e-12 * std::max(1.0, glm::length(high - low));
    if (bent || (asked_.convex && !turns.convex)) return add_triangles(facet, outline, corners);
    // A plane may be asked for by the first three vertices.
    if (asked_.convex && turns.first < 1e-3 * turns.most) {
      std::rotate(outline.begin(), outline.begin() + turns.sharpest, outline.end());
      changed_ = true;
    }
    add_polygon(facet, outline);
  }

  void add_triangles(const Facet& facet, const Corners& outline, const std::vector<glm::dvec3>& corners) {
    Corners places(outline.size()), triangles;
    for (std::size_t i = 0; i < places.size(); ++i) places[i] = static_cast<std::int32_t>(i);
    if (!clipper_.cut(corners, places, triangles))
      throw InputError(from_.source, "has polygons with too many vertices to cut them into triangles",
                       "triangulate them in a modelling program");
    for (std::size_t i = 0; i + 2 < triangles.size(); i += 3) {
      Corners triangle;
      std::vector<glm::dvec3> points;
      for (std::size_t k = i; k < i + 3; ++k) {
        triangle.push_back(outline[triangles[k]]);
        points.push_back(corners[triangles[k]]);
      }
      const pieces::Plane plane = pieces::plane_of(points);
      if (glm::length(plane.normal()) > 0 && (!on_screen() || std::abs(plane.c) >= 1e-12)) add_polygon(facet, triangle);
    }
    changed_ = true;
  }

  void add_polygon(const Facet& facet, const Corners& outline) {
    const auto number = size32(scene_.polygons);
    changed_ = changed_ || facet.polygon != number;
    parts_of_[facet.polygon].push_back(number);
    scene_.polygons.push_back(from_.polygons[facet.polygon]);
    scene_.facets.push_back({number, size32(scene_.corners), size32(outline)});
    for (const std::int32_t vertex : outline) scene_.corners.push_back(number_of(vertex));
  }

  /// The point's number among those that are handed out. What clipping made belongs to one polygon alone.
  std::int32_t number_of(std::int32_t vertex) {
    const auto next = size32(scene_.points);
    const bool made = static_cast<std::size_t>(vertex) >= from_.points.size();
    const auto [place, fresh] = made ? std::pair(made_.end(), true) : made_.try_emplace(vertex, next);
    if (!fresh) return place->second;
    scene_.points.push_back(point_at(vertex));
    return next;
  }

  /// Of a polygon that is several now, each gets a number behind its name.
  void name_polygons() {
    for (const auto& [polygon, parts] : parts_of_)
      for (std::size_t k = 0; parts.size() > 1 && k < parts.size(); ++k) {
        Polygon& part = scene_.polygons[parts[k]];
        if (!part.name->empty()) part.name = fmt::format("{}{}", *part.name, k + 1);
      }
  }

  const Scene& from_;
  const PolygonsAsked asked_;
  const viewing::Lens lens_;
  const bool cull_;
  viewing::Vertices vertices_;
  scene::EarClipper clipper_;
  std::map<std::int32_t, std::int32_t> made_;                   ///< vertices that are handed out, with their numbers
  std::map<std::int32_t, std::vector<std::int32_t>> parts_of_;  ///< what became of each polygon
  std::size_t kept_ = 0;
  bool changed_ = false;
  Scene scene_;
};

bool has_step(const Method& method, std::uint8_t kind) {
  const Page page = method.page();
  return std::any_of(page.begin(), page.end(), [&](const StepInfo& step) { return step.kind == kind; });
}

std::string rays_as_numbers(const Scene& scene) {
  const formulas::EyeRays rays(scene.camera, scene.raster);
  const auto first = rays.through(0, 0), right = rays.through(1, 0), down = rays.through(0, 1);
  std::string text;
  for (const glm::dvec3& v : {first.from, right.from - first.from, down.from - first.from, first.along,
                              right.along - first.along, down.along - first.along})
    text += fmt::format("{} {} {}\n", v.x, v.y, v.z);
  const double unit = scene.camera.kind == Camera::Kind::orthographic ? 1 : scene.camera.d;
  return text + fmt::format("{} {}\n", scene.camera.near / unit, scene.camera.far / unit);
}

/// Rows of samples, and what takes them to the screen: T_v, d, half the height of the window, near and far.
std::string surface_as_numbers(const Scene& scene) {
  const Surface& surface = scene.surface.value();
  std::string text = fmt::format("{} {}\n", surface.rows, surface.columns);
  for (const glm::dvec3& p : scene.points) text += fmt::format("{} {} {}\n", p.x, p.y, p.z);
  const Camera& camera = scene.camera;
  for (int row = 0; row < 3; ++row) {
    const auto t = [&](int column) { return camera.view[column][row]; };
    text += fmt::format("{} {} {} {}\n", t(0), t(1), t(2), t(3));
  }
  const double d = camera.kind == Camera::Kind::orthographic ? 0 : camera.d;
  return text + fmt::format("{} {} {} {}\n", d, camera.window, camera.near, camera.far);
}

}  // namespace

PolygonsAsked polygons_asked(const Method& method, const Conventions& conventions,
                             const std::set<std::uint8_t>& printed, const std::vector<std::string>& free) {
  using enum Conventions::Depth;
  PolygonsAsked asked;
  if (method.gives != Gives::surfaces || method.needs != Needs::polygons) return asked;
  const bool by_rays = has_step(method, kind_of<RayBegin>);
  asked.planar = by_rays || has_step(method, kind_of<PlaneEquation>);
  if (by_rays) asked.space = PolygonsAsked::Space::world;
  if (by_rays || !has_step(method, kind_of<ViewportTransform>)) return asked;
  const bool viewing =
      std::ranges::any_of(std::array{kind_of<ViewTransform>, kind_of<Projection>, kind_of<ViewportTransform>,
                                     kind_of<FacingTest>, kind_of<ClipTest>, kind_of<ClipVertex>, kind_of<ClipCross>},
                          [&](std::uint8_t kind) { return printed.contains(kind); });
  // What these say of a run begins with the camera.
  const bool by_camera =
      (conventions.depth != pseudodepth && conventions.depth != view) ||
      conventions.positions != Conventions::Positions::exact || conventions.attribute != Conventions::Attribute::none ||
      std::ranges::any_of(
          free, [](const std::string& key) { return key == "depth" || key == "positions" || key == "attribute"; });
  if (!viewing && !by_camera) asked.space = PolygonsAsked::Space::screen;
  return asked;
}

Scene scene_for_programs(Scene scene, const Conventions& conventions, const PolygonsAsked& asked) {
  if (asked.space == PolygonsAsked::Space::as_given) return scene;
  Builder builder(scene, conventions, asked);
  Scene built = builder.build();
  return builder.changed() ? built : scene;
}

std::string why_not_plain(const Method& method, const Scene& scene) {
  const Camera& camera = scene.camera;
  if (method.gives == Gives::surfaces && has_step(method, kind_of<RayBegin>) && camera.kind == Camera::Kind::screen)
    return "has no eye that rays could come from: its points are on the screen";
  if (method.needs != Needs::surface || !scene.surface) return "";
  if (camera.kind != Camera::Kind::perspective) return "is not seen in perspective";
  double first = scene.points.front().y, last = first;
  for (const glm::dvec3& point : scene.points) {
    const double depth = (camera.view * glm::dvec4(point, 1)).z;
    if (!(depth >= camera.near && depth <= camera.far)) return "has samples that are not between near and far plane";
    first = std::min(first, point.y), last = std::max(last, point.y);
  }
  return camera.eye.y > first && camera.eye.y < last ? "is seen from between two of its curves" : "";
}

std::string plain_numbers(const Method& method, const Scene& scene) {
  std::string text = fmt::format("{} {}\n", scene.raster.width, scene.raster.height);
  if (method.needs == Needs::surface) return text + surface_as_numbers(scene);
  text += fmt::format("{}\n", scene.points.size());
  for (const glm::dvec3& p : scene.points) text += fmt::format("{} {} {}\n", p.x, p.y, p.z);
  text += fmt::format("{}\n", scene.facets.size());
  for (const Facet& facet : scene.facets) {
    text += fmt::format("{}", facet.corner_count);
    for (std::int32_t k = 0; k < facet.corner_count; ++k)
      text += fmt::format(" {}", scene.corners[facet.first_corner + k]);
    text += '\n';
  }
  const auto add = [&](Color color) { text += fmt::format("{} {} {}\n", color.red, color.green, color.blue); };
  add(scene.background);
  for (const Facet& facet : scene.facets) add(scene.polygons[facet.polygon].color);
  if (scene.camera.kind != Camera::Kind::screen) text += rays_as_numbers(scene);
  return text;
}

}  // namespace zstep::homework
