#include <glm/vec3.hpp>

#include "traces/file/header_json.hpp"
#include "traces/file/json_members.hpp"
#include "traces/limits.hpp"

namespace zstep {

using namespace json_members;
using nlohmann::ordered_json;

namespace {

constexpr std::array<std::string_view, 3> camera_words{"screen", "perspective", "orthographic"};

std::string color_text(Color color) { return fmt::format("#{:02x}{:02x}{:02x}", color.red, color.green, color.blue); }

Color color_from(const std::string& text) {
  unsigned value = 0;
  bool good = text.size() == 7 && text[0] == '#';
  for (std::size_t i = 1; good && i < 7; ++i) {
    const char c = text[i];
    const int digit = c >= '0' && c <= '9'   ? c - '0'
                      : c >= 'a' && c <= 'f' ? c - 'a' + 10
                      : c >= 'A' && c <= 'F' ? c - 'A' + 10
                                             : -1;
    good = digit >= 0;
    value = value * 16 + static_cast<unsigned>(digit & 15);
  }
  if (!good) throw MalformedJson(fmt::format("\"{}\" is no colour (#rrggbb)", text));
  return {static_cast<std::uint8_t>(value >> 16), static_cast<std::uint8_t>(value >> 8 & 255),
          static_cast<std::uint8_t>(value & 255)};
}

glm::dvec3 vector_from(const json& value, const char* what) {
  if (!value.is_array() || value.size() != 3)
    throw MalformedJson(fmt::format("\"{}\" is not a list of three numbers", what));
  return {real_from_json(value[0], what), real_from_json(value[1], what), real_from_json(value[2], what)};
}

ordered_json vector_to(const glm::dvec3& v) {
  return ordered_json::array({real_to_json(v.x), real_to_json(v.y), real_to_json(v.z)});
}

}  // namespace

ordered_json camera_to_json(const Camera& camera) {
  ordered_json out;
  out["kind"] = word(camera.kind, camera_words);
  if (camera.kind == Camera::Kind::screen) return out;
  if (camera.polar) out.update({{"rho", camera.rho}, {"theta", camera.theta}, {"phi", camera.phi}});
  out["d"] = camera.d;
  out["window"] = camera.window;
  out["near"] = camera.near;
  out["far"] = camera.far;
  out["eye"] = vector_to(camera.eye);
  ordered_json rows = ordered_json::array();
  for (int row = 0; row < 4; ++row) {
    ordered_json cells = ordered_json::array();
    for (int column = 0; column < 4; ++column) cells.push_back(real_to_json(camera.view[column][row]));
    rows.push_back(std::move(cells));
  }
  out["view"] = std::move(rows);
  return out;
}

Camera camera_from_json(const json& in) {
  Camera camera;
  camera.kind = word_or(in, "kind", camera_words, Camera::Kind::perspective);
  if (camera.kind == Camera::Kind::screen) return camera;
  camera.polar = in.contains("rho");
  if (camera.polar) {
    camera.rho = real(in, "rho");
    camera.theta = real(in, "theta");
    camera.phi = real(in, "phi");
  }
  camera.d = real_or(in, "d", 1);
  camera.window = real_or(in, "window", 1);
  camera.near = real(in, "near");
  camera.far = real(in, "far");
  camera.eye = vector_from(member(in, "eye"), "eye");
  const json& rows = list(in, "view");
  if (rows.size() != 4) throw MalformedJson("\"view\" does not have four rows");
  for (int row = 0; row < 4; ++row) {
    const json& cells = rows[static_cast<std::size_t>(row)];
    if (!cells.is_array() || cells.size() != 4) throw MalformedJson("a row of \"view\" does not have four numbers");
    for (int column = 0; column < 4; ++column)
      camera.view[column][row] = real_from_json(cells[static_cast<std::size_t>(column)], "view");
  }
  return camera;
}

ordered_json raster_to_json(const Raster& raster) {
  return {{"width", raster.width}, {"height", raster.height}, {"y_axis", raster.y_up ? "up" : "down"}};
}

Raster raster_from_json(const json& in) {
  Raster raster;
  raster.width = whole(in, "width");
  raster.height = whole(in, "height");
  const std::string axis = text_or(in, "y_axis", "down");
  if (axis != "up" && axis != "down") throw MalformedJson("\"y_axis\" is neither \"up\" nor \"down\"");
  raster.y_up = axis == "up";
  return raster;
}

ordered_json scene_to_json(const Scene& scene) {
  ordered_json out;
  out["name"] = scene.name;
  out["source"] = scene.source;
  out["raster"] = raster_to_json(scene.raster);
  out["camera"] = camera_to_json(scene.camera);
  out["background"] = color_text(scene.background);
  ordered_json points = ordered_json::array();
  for (const glm::dvec3& point : scene.points) points.push_back(vector_to(point));
  out["points"] = std::move(points);
  if (!scene.point_lines.empty()) out["point_lines"] = scene.point_lines;
  ordered_json polygons = ordered_json::array();
  for (const Polygon& polygon : scene.polygons) {
    ordered_json entry;
    if (!polygon.name.empty()) entry["name"] = polygon.name;
    entry["color"] = color_text(polygon.color);
    if (polygon.source_line != 0) entry["line"] = polygon.source_line;
    polygons.push_back(std::move(entry));
  }
  out["polygons"] = std::move(polygons);
  ordered_json facets = ordered_json::array();
  for (const Facet& facet : scene.facets) {
    ordered_json entry;
    entry["polygon"] = facet.polygon;
    entry["points"] = std::vector<std::int32_t>(scene.corners.begin() + facet.first_corner,
                                                scene.corners.begin() + facet.first_corner + facet.corner_count);
    facets.push_back(std::move(entry));
  }
  out["facets"] = std::move(facets);
  return out;
}

Scene scene_from_json(const json& in) {
  Scene scene;
  scene.name = text_or(in, "name", "scene");
  scene.source = text_or(in, "source", "");
  scene.raster = raster_from_json(member(in, "raster"));
  scene.camera = camera_from_json(member(in, "camera"));
  scene.background = color_from(text_or(in, "background", "#ffffff"));
  for (const json& point : list(in, "points")) scene.points.push_back(vector_from(point, "points"));
  if (in.contains("point_lines")) {
    for (const json& line : list(in, "point_lines")) scene.point_lines.push_back(whole_from(line, "point_lines"));
  }
  for (const json& entry : list(in, "polygons")) {
    scene.polygons.push_back(
        {text_or(entry, "name", ""), color_from(text_or(entry, "color", "#999999")), whole_or(entry, "line", 0)});
  }
  for (const json& entry : list(in, "facets")) {
    const json& corners = list(entry, "points");
    scene.facets.push_back({whole(entry, "polygon"), static_cast<std::int32_t>(scene.corners.size()),
                            static_cast<std::int32_t>(corners.size())});
    for (const json& corner : corners) scene.corners.push_back(whole_from(corner, "points"));
  }
  check_scene(scene);
  return scene;
}

void check_scene(const Scene& scene) {
  const auto fail = [](const std::string& what) { throw MalformedJson("its scene is wrong: " + what); };
  const auto [width, height, y_up] = scene.raster;
  if (width < 1 || height < 1 || width > largest_side || height > largest_side ||
      std::int64_t{width} * height > most_pixels) {
    fail(fmt::format("a raster of {}x{} pixels (each side is 1 to {}, and there are at most {} pixels)", width, height,
                     largest_side, most_pixels));
  }
  const auto most = [&](const char* what, std::size_t count, std::int64_t limit) {
    if (count > static_cast<std::size_t>(limit))
      fail(fmt::format("{} {}, of which there can be {}", count, what, limit));
  };
  most("points", scene.points.size(), most_points);
  most("polygons", scene.polygons.size(), most_polygons);
  most("facets", scene.facets.size(), most_facets);
  most("corners", scene.corners.size(), most_corners);
  if (!scene.point_lines.empty() && scene.point_lines.size() != scene.points.size())
    fail("as many lines as points are needed, or none");
  for (std::size_t i = 0; i < scene.facets.size(); ++i) {
    const Facet& facet = scene.facets[i];
    if (facet.polygon < 0 || static_cast<std::size_t>(facet.polygon) >= scene.polygons.size())
      fail(fmt::format("facet {} is of polygon {}, which does not exist", i, facet.polygon));
    const std::int64_t end = static_cast<std::int64_t>(facet.first_corner) + facet.corner_count;
    if (facet.first_corner < 0 || facet.corner_count < 0 || end > static_cast<std::int64_t>(scene.corners.size()))
      fail(fmt::format("facet {} has corners outside the list", i));
  }
  for (const std::int32_t corner : scene.corners) {
    if (corner < 0 || static_cast<std::size_t>(corner) >= scene.points.size())
      fail(fmt::format("there is no point {}", corner));
  }
}

}  // namespace zstep
