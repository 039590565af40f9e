#include "sim/viewer/model/outside.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <span>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <glm/trigonometric.hpp>
#include <glm/vec4.hpp>

#include "sim/words/explain.hpp"
#include "sim/words/numbers.hpp"
#include "traces/math/portable_math.hpp"
#include "traces/math/whole.hpp"
#include "traces/scene.hpp"
#include "traces/text.hpp"

namespace zstep::viewer {
namespace {

std::span<const std::int32_t> corners_of(const Scene& scene, const Facet& facet) {
  return std::span(scene.corners).subspan(facet.first_corner, facet.corner_count);
}

EdgeEnds edge_at(std::span<const std::int32_t> corners, std::size_t k) {
  return std::minmax(corners[k], corners[(k + 1) % corners.size()]);
}

}  // namespace

std::vector<EdgeEnds> edges_of(const Scene& scene) {
  if (scene.corners.size() > most_corners_picked) return {};
  std::set<EdgeEnds> edges;
  for (const Facet& facet : scene.facets) {
    const auto corners = corners_of(scene, facet);
    for (std::size_t k = 0; k < corners.size(); ++k) edges.insert(edge_at(corners, k));
  }
  return {edges.begin(), edges.end()};
}

std::vector<std::int32_t> polygons_with(const Scene& scene, const ScenePart& part) {
  std::vector<std::int32_t> polygons;
  for (const Facet& facet : scene.facets) {
    const auto corners = corners_of(scene, facet);
    bool has = part.vertex && std::find(corners.begin(), corners.end(), *part.vertex) != corners.end();
    for (std::size_t k = 0; part.edge && !has && k < corners.size(); ++k) has = edge_at(corners, k) == *part.edge;
    if (has && (polygons.empty() || polygons.back() != facet.polygon)) polygons.push_back(facet.polygon);
  }
  return polygons;
}

std::string name_of(const Scene& scene, const ScenePart& part) {
  if (part.vertex) return "vertex " + vertex_label(scene, *part.vertex);
  if (!part.edge) return "";
  const std::string from = vertex_label(scene, part.edge->first), to = vertex_label(scene, part.edge->second);
  const bool letters = from[0] >= 'A' && to[0] >= 'A';
  return fmt::format("edge {}{}{}", from, letters ? "" : "\u2013", to);
}

std::string place_in_file(const Scene& scene, const ScenePart& part) {
  const std::int32_t vertex = part.vertex ? *part.vertex : part.edge ? part.edge->first : -1;
  const std::size_t at = vertex;
  if (vertex < 0 || at >= scene.point_lines.size() || scene.point_lines[at] == 0) return "";
  return fmt::format("{}:{}", scene.source, scene.point_lines[at]);
}

std::string told_of(const Scene& scene, const ScenePart& part) {
  std::vector<std::string> names;
  for (const std::int32_t polygon : polygons_with(scene, part)) names.push_back(polygon_label(scene, polygon));
  if (names.size() > 6) names.resize(6), names.emplace_back("\u2026");
  std::string text = with_capital(name_of(scene, part));
  if (part.vertex && static_cast<std::size_t>(*part.vertex) < scene.points.size()) {
    const glm::dvec3& p = scene.points[*part.vertex];
    text += fmt::format(" at ({}, {}, {})", number(p.x), number(p.y), number(p.z));
  }
  if (!names.empty()) text += fmt::format(", of {}", fmt::join(names, ", "));
  const std::string place = place_in_file(scene, part);
  return text + (place.empty() ? "." : fmt::format("; {}.", place));
}

bool is_about(const Event& event, const ScenePart& part) {
  return visit_event(
      [&]<class E>(const E& e) {
        if constexpr (requires {
                        e.vertex_0;
                        e.vertex_1;
                      }) {
          const EdgeEnds ends = std::minmax(e.vertex_0, e.vertex_1);
          if (part.edge) return ends == *part.edge;
          return part.vertex && (ends.first == *part.vertex || ends.second == *part.vertex);
        } else if constexpr (requires { e.vertex; }) {
          return part.vertex && static_cast<std::int32_t>(e.vertex) == *part.vertex;
        } else {
          return false;
        }
      },
      event);
}

namespace {

constexpr std::size_t most_apart = 20'000;  ///< corners: beyond, what lies in one plane is as rounding has it
constexpr double infinity = std::numeric_limits<double>::infinity();

struct Box {
  glm::dvec3 low{infinity}, high{-infinity};
  void include(glm::dvec3 point) { low = glm::min(low, point), high = glm::max(high, point); }
  double size() const { return glm::length(high - low); }
};

Box around(const std::vector<glm::dvec3>& points) {
  Box box;
  for (const glm::dvec3& point : points) box.include(point);
  return box;
}

/// So much of its light, never so little that its colour is another.
Color dimmed(Color color, double share) {
  const auto part = [&](std::uint8_t value) { return nearest_byte(value * share); };
  return {part(color.red), part(color.green), part(color.blue)};
}

/// Brighter where light from above meets a face.
Color shaded(Color color, glm::dvec3 normal) {
  const double length = glm::length(normal);
  const glm::dvec3 light = glm::normalize(glm::dvec3(0.35, -0.5, 0.8));
  return dimmed(color, length > 0 ? 0.72 + 0.28 * std::abs(glm::dot(normal / length, light)) : 1);
}

/// Of a scene with a light of its own: brighter where that meets the side which the eye sees.
Color lit(Color color, glm::dvec3 normal, glm::dvec3 to_light, glm::dvec3 to_eye) {
  const double lengths = glm::length(normal) * glm::length(to_light);
  if (!(lengths > 0)) return color;
  const double cosine = glm::dot(normal, to_light) / lengths * (glm::dot(normal, to_eye) < 0 ? -1 : 1);
  return dimmed(color, 0.5 + 0.5 * std::max(0.0, cosine));
}

glm::dvec3 normal_of(const Scene& scene, const Facet& facet) {
  const auto corner = [&](std::int32_t k) {
    return scene.points[scene.corners[facet.first_corner + k % facet.corner_count]];
  };
  glm::dvec3 sum(0);
  for (std::int32_t k = 0; k < facet.corner_count; ++k) sum += glm::cross(corner(k), corner(k + 1));
  return sum;
}

}  // namespace

Room::Room(const Scene& scene, bool by_lamp)
    : polygons_(scene),
      camera_(scene.camera),
      raster_(scene.raster),
      sight_(std::in_place, scene.camera, scene.raster) {
  Box given = around(scene.points);
  if (scene.points.empty()) given.low = given.high = glm::dvec3(0);
  low_given_ = given.low, high_given_ = given.high;
  const bool screen = camera_.kind == Camera::Kind::screen;
  if (screen) {
    const double reach = std::max(raster_.width, raster_.height), range = given.high.z - given.low.z;
    depth_scale_ = range > 0 ? 0.75 * reach / range : 1;
    depth_middle_ = (given.low.z + given.high.z) / 2;
    near_ = given.low.z - 0.25 * reach / depth_scale_, end_ = given.high.z + 0.1 * reach / depth_scale_;
  }
  Box box;
  for (glm::dvec3& point : polygons_.points) box.include(point = place(point));
  if (scene.points.empty()) box.low = box.high = glm::dvec3(0);
  low_ = box.low, high_ = box.high;
  for (const Facet& facet : polygons_.facets) {
    Polygon& polygon = polygons_.polygons[facet.polygon];
    const Color own = scene.polygons[facet.polygon].color;
    const glm::dvec3 normal = normal_of(polygons_, facet), at = polygons_.points[polygons_.corners[facet.first_corner]];
    polygon.color =
        scene.light && has_eye() ? lit(own, normal, scene.light->position - at, camera_.eye - at) : shaded(own, normal);
  }
  constexpr std::size_t few = 200;  // points; of more, the corners of their box
  if (!scene.points.empty() && polygons_.points.size() <= few) {
    marks_ = polygons_.points;
  } else {
    for (int corner = 0; corner < 8; ++corner)
      marks_.emplace_back((corner & 1) ? low_.x : high_.x, (corner & 2) ? low_.y : high_.y,
                          (corner & 4) ? low_.z : high_.z);
  }
  if (!screen) {
    double farthest = 0;
    for (const glm::dvec3& point : marks_) farthest = std::max(farthest, (camera_.view * glm::dvec4(point, 1)).z);
    near_ = camera_.near > 0 || !has_eye() ? camera_.near : 0.1 * farthest;
    far_is_there_ = camera_.far > near_ && camera_.far <= 1.6 * farthest;
    end_ = far_is_there_ ? camera_.far : std::max(1.05 * farthest, near_ + 1e-9);
  }
  if (has_eye()) marks_.push_back(camera_.eye);
  if (scene.light) marks_.push_back(scene.light->position);
  for (const glm::dvec3& corner : window(has_eye() ? camera_.d : near_)) marks_.push_back(corner);
  // The far end only where the rest does not become small for it.
  std::vector<glm::dvec3> all = marks_;
  for (const glm::dvec3& corner : window(end_)) all.push_back(corner);
  if (around(all).size() <= 1.35 * around(marks_).size()) marks_ = std::move(all);
  if (!screen) towards_ = has_eye() ? camera_.eye - (low_ + high_) / 2.0 : camera_.eye;
  by_lamp_ = by_lamp && scene.light.has_value();
  if (!by_lamp_) return;
  camera_ = viewing::camera_of(*scene.light);
  sight_.emplace(camera_, raster_);
  near_ = camera_.near, end_ = camera_.far;
  far_is_there_ = true;
}

glm::dvec3 Room::place(glm::dvec3 p) const {
  if (camera_.kind != Camera::Kind::screen) return p;
  return {p.x, (p.z - depth_middle_) * depth_scale_, raster_.y_up ? p.y : -p.y};
}

glm::dvec3 Room::point_at(glm::dvec3 p) const {
  if (camera_.kind != Camera::Kind::screen) return p;
  return {p.x, raster_.y_up ? p.z : -p.z, p.y / depth_scale_ + depth_middle_};
}

glm::dvec3 Room::behind(double x, double y, double z_v) const {
  if (camera_.kind == Camera::Kind::screen) return place({x, y, z_v});
  const formulas::EyeRays::Ray ray = sight_->through(x, y);
  return ray.from + ray.along * (has_eye() ? z_v / camera_.d : z_v);
}

std::array<glm::dvec3, 4> Room::rectangle(double left, double top, double right, double bottom, double z_v) const {
  return {behind(left, top, z_v), behind(right, top, z_v), behind(right, bottom, z_v), behind(left, bottom, z_v)};
}

std::array<glm::dvec3, 4> Room::rectangle_in_view(double left, double right, double bottom, double top,
                                                  double z_v) const {
  const glm::dmat4 to_world = glm::inverse(camera_.view);
  const auto at = [&](double x, double y) { return glm::dvec3(to_world * glm::dvec4(x, y, z_v, 1)); };
  return {at(left, bottom), at(right, bottom), at(right, top), at(left, top)};
}

std::array<glm::dvec3, 4> Room::window(double z_v) const {
  return rectangle(-0.5, -0.5, raster_.width - 0.5, raster_.height - 0.5, z_v);
}

double Room::size() const { return std::max(glm::length(high_ - low_), 1e-9); }

std::vector<glm::dvec3> Room::section(double a, double b, double c, double d) const {
  const glm::dvec3 more = 0.06 * (high_given_ - low_given_) + glm::dvec3(1e-6), low = low_given_ - more,
                   high = high_given_ + more, normal(a, b, c);
  if (!(glm::length(normal) > 0)) return {};
  std::vector<glm::dvec3> corners;
  for (int axis = 0; axis < 3; ++axis)
    for (int k = 0; k < 4; ++k) {
      glm::dvec3 from = low;
      from[(axis + 1) % 3] = (k & 1) ? high[(axis + 1) % 3] : low[(axis + 1) % 3];
      from[(axis + 2) % 3] = (k & 2) ? high[(axis + 2) % 3] : low[(axis + 2) % 3];
      glm::dvec3 to = from;
      to[axis] = high[axis];
      const double first = glm::dot(normal, from) + d, last = glm::dot(normal, to) + d;
      if ((first < 0) != (last < 0)) corners.push_back(from + (to - from) * (first / (first - last)));
    }
  if (corners.size() < 3) return {};
  glm::dvec3 middle(0);
  for (const glm::dvec3& corner : corners) middle += corner / static_cast<double>(corners.size());
  const glm::dvec3 right = glm::normalize(corners[0] - middle), up = glm::cross(glm::normalize(normal), right);
  const auto angle = [&](const glm::dvec3& p) {
    return portable::atan2(glm::dot(up, p - middle), glm::dot(right, p - middle));
  };
  std::stable_sort(corners.begin(), corners.end(),
                   [&](const glm::dvec3& p, const glm::dvec3& q) { return angle(p) < angle(q); });
  for (glm::dvec3& corner : corners) corner = place(corner);
  return corners;
}

Outside::Outside(const Room& room, const Look& look, int width, int height) {
  raster_ = {std::max(1, width), std::max(1, height), false};
  const double aspect = ratio(raster_.width, raster_.height);
  const Box box = around(room.marks());
  glm::dvec3 target = (box.low + box.high) / 2.0;
  const double radius = std::max(box.size() / 2, 1e-9), distance = 3.5 * radius;
  const double azimuth = portable::atan2(room.towards().y, room.towards().x);
  const auto direction = [&](double turn, double tilt) {
    const double around = azimuth + glm::radians(34 + turn),
                 above = glm::radians(std::clamp(tilt, least_tilt, most_tilt) + first_tilt);
    return glm::dvec3(portable::cos(above) * portable::cos(around), portable::cos(above) * portable::sin(around),
                      portable::sin(above));
  };
  // As large as it goes from where one begins; then that stays, so that walking round changes no size.
  camera_.polar = false;
  camera_.d = 1;
  double half = 1;
  for (int time = 0; time < 3; ++time) {
    const glm::dmat4 view = viewing::look_at_view(target + distance * direction(0, 0), target, {0, 0, 1});
    Box flat;
    for (const glm::dvec3& point : room.marks()) {
      const glm::dvec4 v = view * glm::dvec4(point, 1);
      flat.include({v.x / v.z, v.y / v.z, 0});
    }
    half = std::max({(flat.high.y - flat.low.y) / 2, (flat.high.x - flat.low.x) / 2 / aspect, 1e-9}) * 1.05;
    const glm::dvec3 middle = (flat.low + flat.high) / 2.0 * distance;
    target += middle.x * glm::dvec3(view[0][0], view[1][0], view[2][0]) +
              middle.y * glm::dvec3(view[0][1], view[1][1], view[2][1]);
  }
  camera_.window = half / look.zoom;
  camera_.eye = target + distance * direction(look.turn, look.tilt);
  camera_.view = viewing::look_at_view(camera_.eye, target, {0, 0, 1});
  const glm::dvec3 moved(-2 * look.across * camera_.window * aspect * distance,
                         -2 * look.up * camera_.window * distance, 0);
  camera_.view[3] -= glm::dvec4(moved, 0);
  camera_.eye = glm::dvec3(glm::inverse(camera_.view)[3]);
  camera_.near = radius;
  camera_.far = 20 * radius;
  lens_.emplace(camera_, raster_, Conventions::Depth::pseudodepth);
}

Scene Outside::seen(const Scene& polygons) const {
  Scene scene = polygons;
  scene.camera = camera_;
  scene.raster = raster_;
  scene.light.reset();
  scene.surface.reset();
  // Of polygons in one plane the first is to be seen: each lies a little farther from this eye than the one before it,
  // along its lines of sight, so that it stays where it is in the picture.
  if (scene.corners.size() > most_apart) return scene;
  std::vector<glm::dvec3> points;
  for (const Facet& facet : scene.facets)
    for (std::int32_t k = 0; k < facet.corner_count; ++k) {
      std::int32_t& corner = scene.corners[facet.first_corner + k];
      const glm::dvec3 point = scene.points[corner];
      corner = size32(points);
      points.push_back(camera_.eye + (point - camera_.eye) * (1 + 1e-7 * facet.polygon));
    }
  scene.points = std::move(points);
  return scene;
}

Outside::Spot Outside::spot_of(glm::dvec3 view) const {
  const glm::dvec3 plane = lens_->project(view);
  const glm::dvec2 at = lens_->to_viewport(plane.x, plane.y);
  return {at.x + 0.5, at.y + 0.5, plane.z};
}

std::optional<Outside::Spot> Outside::spot(glm::dvec3 point) const {
  const glm::dvec3 view(camera_.view * glm::dvec4(point, 1));
  if (!(view.z >= camera_.near)) return std::nullopt;
  return spot_of(view);
}

glm::dvec3 Outside::pulled(glm::dvec3 point, double right, double down) const {
  const glm::dmat4& view = camera_.view;
  const double z = (view * glm::dvec4(point, 1)).z, pixel = 2 * camera_.window / raster_.height * z / camera_.d;
  const glm::dvec3 x(view[0][0], view[1][0], view[2][0]), y(view[0][1], view[1][1], view[2][1]);
  return point + pixel * (right * x - down * y);
}

std::optional<std::array<Outside::Spot, 2>> Outside::line(glm::dvec3 from, glm::dvec3 to) const {
  glm::dvec3 a(camera_.view * glm::dvec4(from, 1)), b(camera_.view * glm::dvec4(to, 1));
  if (!(a.z >= camera_.near) && !(b.z >= camera_.near)) return std::nullopt;
  if (a.z < camera_.near) a += (b - a) * ((camera_.near - a.z) / (b.z - a.z));
  if (b.z < camera_.near) b += (a - b) * ((camera_.near - b.z) / (a.z - b.z));
  return std::array{spot_of(a), spot_of(b)};
}

}  // namespace zstep::viewer
