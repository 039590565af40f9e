#include <charconv>
#include <cmath>
#include <iterator>
#include <limits>

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include "traces/file/header_json.hpp"
#include "traces/file/json_text.hpp"
#include "traces/scene.hpp"

namespace zstep {

using namespace json_members;
using nlohmann::ordered_json;

namespace {

constexpr std::array<std::string_view, 3> camera_words{"screen", "perspective", "orthographic"};
constexpr std::array<std::string_view, 2> axis_words{"down", "up"}, seen_at_words{"centres", "corners"};

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

ordered_json matrix_to(const glm::dmat4& matrix) {
  ordered_json rows = ordered_json::array();
  for (int row = 0; row < 4; ++row) {
    ordered_json cells = ordered_json::array();
    for (int column = 0; column < 4; ++column) cells.push_back(real_to_json(matrix[column][row]));
    rows.push_back(std::move(cells));
  }
  return rows;
}

glm::dmat4 matrix_from(const json& in, const char* key) {
  glm::dmat4 matrix(0);
  const json& rows = list(in, key);
  if (rows.size() != 4) throw MalformedJson(fmt::format("\"{}\" does not have four rows", key));
  for (int row = 0; row < 4; ++row) {
    const json& cells = rows[row];
    if (!cells.is_array() || cells.size() != 4)
      throw MalformedJson(fmt::format("a row of \"{}\" does not have four numbers", key));
    for (int column = 0; column < 4; ++column) {
      matrix[column][row] = real_from_json(cells[column], key);
      constexpr double most = 1e30;
      if (!(std::abs(matrix[column][row]) <= most))
        throw MalformedJson(fmt::format("\"{}\" has {}, which is too large", key, matrix[column][row]));
    }
  }
  return matrix;
}

}  // namespace

ordered_json camera_to_json(const Camera& camera) {
  ordered_json out;
  out["kind"] = word(camera.kind, camera_words);
  if (camera.kind == Camera::Kind::screen) return out;
  if (camera.polar) out.update({{"rho", camera.rho}, {"theta", camera.theta}, {"phi", camera.phi}});
  if (!camera.matrices) out["d"] = camera.d, out["window"] = camera.window;
  out["near"] = camera.near;
  out["far"] = real_to_json(is_infinitely_far(camera) ? std::numeric_limits<double>::infinity() : camera.far);
  if (const auto [low, high] = camera.depth_range; !camera.depth_range.is_standard()) out["depth_range"] = {low, high};
  if (camera.matrices) {
    out["view"] = matrix_to(camera.matrices->view), out["projection"] = matrix_to(camera.matrices->projection);
    return out;
  }
  out["eye"] = vector_to(camera.eye);
  out["view"] = matrix_to(camera.view);
  return out;
}

Camera camera_from_json(const json& in, const Raster& raster) {
  known_keys(in, "the camera",
             {"kind", "rho", "theta", "phi", "d", "window", "near", "far", "depth_range", "eye", "view", "projection"});
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
  if (std::isinf(camera.far) && camera.kind == Camera::Kind::perspective) camera.far = infinitely_far * camera.near;
  if (in.contains("depth_range")) {
    const std::vector<json>& ends = list(in, "depth_range");
    if (ends.size() == 2)
      camera.depth_range = {real_from_json(ends[0], "depth_range"), real_from_json(ends[1], "depth_range")};
    if (ends.size() != 2 || !camera.depth_range.is_right())
      throw MalformedJson(in, "depth_range", "\"depth_range\" is not two numbers, the smaller one first",
                          "write as [0, 1]");
  }
  camera.view = matrix_from(in, "view");
  if (in.contains("projection")) {
    for (const char* other : {"rho", "d", "window", "eye"})
      if (in.contains(other))
        throw MalformedJson(in, other, fmt::format("\"{}\" stands beside \"projection\"", other),
                            "take it out: the matrices say where the eye is and what it sees");
    if (camera.kind != Camera::Kind::perspective)
      throw MalformedJson(in, "projection", "\"projection\" is for a camera in perspective",
                          "give \"window\", \"near\" and \"far\" of a parallel one");
    camera.matrices = {camera.view, matrix_from(in, "projection")};
    if (!take_matrices(camera, raster))
      throw MalformedJson(in, "projection", "\"view\" and \"projection\" have no eye",
                          "the rows of x_c, y_c and w_c must go with three directions");
    if (const std::string against = planes_against_matrix(camera); !against.empty())
      throw MalformedJson(in, "projection", against, std::string(row_of_depth_remedy));
  } else {
    camera.eye = vector_from(member(in, "eye"), "eye");
  }
  return camera;
}

ordered_json raster_to_json(const Raster& raster) {
  ordered_json out{{"width", raster.width}, {"height", raster.height}, {"y_axis", axis_words[raster.y_up ? 1 : 0]}};
  if (raster.corners) out["seen_at"] = seen_at_words[1];
  return out;
}

Raster raster_from_json(const json& in) {
  known_keys(in, "the raster", {"width", "height", "y_axis", "seen_at"});
  Raster raster;
  raster.width = whole(in, "width");
  raster.height = whole(in, "height");
  raster.y_up = word_or(in, "y_axis", axis_words, 0) == 1;
  raster.corners = word_or(in, "seen_at", seen_at_words, 0) == 1;
  return raster;
}

ordered_json light_to_json(const Light& light) {
  return {{"position", vector_to(light.position)},
          {"target", vector_to(light.target)},
          {"window", real_to_json(light.window)},
          {"near", real_to_json(light.near)},
          {"far", real_to_json(light.far)}};
}

Light light_from_json(const json& in) {
  known_keys(in, "the light", {"position", "target", "window", "near", "far"});
  return {vector_from(member(in, "position"), "position"), vector_from(member(in, "target"), "target"),
          real(in, "window"), real(in, "near"), real(in, "far")};
}

ordered_json surface_to_json(const Surface& surface) {
  return {{"formula", surface.formula},
          {"x_min", real_to_json(surface.x_min)},
          {"x_max", real_to_json(surface.x_max)},
          {"z_min", real_to_json(surface.z_min)},
          {"z_max", real_to_json(surface.z_max)},
          {"columns", surface.columns},
          {"rows", surface.rows}};
}

Surface surface_from_json(const json& in) {
  known_keys(in, "the surface", {"formula", "x_min", "x_max", "z_min", "z_max", "columns", "rows"});
  return {text(in, "formula"), real(in, "x_min"),    real(in, "x_max"), real(in, "z_min"),
          real(in, "z_max"),   whole(in, "columns"), whole(in, "rows")};
}

ordered_json placement_to_json(const Placement& placement) {
  ordered_json rows = ordered_json::array();
  for (int row = 0; row < 3; ++row)
    rows.push_back(vector_to({placement.linear[0][row], placement.linear[1][row], placement.linear[2][row]}));
  return {{"first", placement.first_point}, {"points", placement.point_count}, {"source", placement.source},
          {"line", placement.line},         {"matrix", std::move(rows)},       {"offset", vector_to(placement.offset)}};
}

Placement placement_from_json(const json& in) {
  known_keys(in, "a placement", {"first", "points", "source", "line", "matrix", "offset"});
  Placement placement{whole(in, "first"), whole(in, "points"), text(in, "source"), whole_or(in, "line", 0)};
  const json& rows = list(in, "matrix");
  if (rows.size() != 3) throw MalformedJson("\"matrix\" does not have three rows");
  for (int row = 0; row < 3; ++row) {
    const glm::dvec3 cells = vector_from(rows[row], "matrix");
    for (int column = 0; column < 3; ++column) placement.linear[column][row] = cells[column];
  }
  placement.offset = vector_from(member(in, "offset"), "offset");
  return placement;
}

ordered_json fit_to_json(const Fit& fit) {
  return {{"centre", vector_to(fit.centre)}, {"radius", real_to_json(fit.radius)}};
}

Fit fit_from_json(const json& in) {
  known_keys(in, "the fit", {"centre", "radius"});
  return {vector_from(member(in, "centre"), "centre"), real(in, "radius")};
}

namespace {

ordered_json attribute_to_json(const VertexAttribute& attribute) {
  ordered_json out{{"name", attribute.name}, {"components", attribute.components}};
  ordered_json values = ordered_json::array();
  for (const double value : attribute.values) values.push_back(real_to_json(value));
  out["values"] = std::move(values);
  if (!attribute.lines.empty()) out["lines"] = attribute.lines;
  out["of_point"] = attribute.of_point;
  if (attribute.own.empty()) return out;
  ordered_json own = ordered_json::array();
  for (const auto& [polygon, point, value] : attribute.own) own.push_back({polygon, point, value});
  out["own"] = std::move(own);
  return out;
}

VertexAttribute attribute_from_json(const json& in) {
  known_keys(in, "an attribute", {"name", "components", "values", "lines", "of_point", "own"});
  VertexAttribute attribute;
  attribute.name = text(in, "name");
  attribute.components = whole(in, "components");
  for (const json& value : list(in, "values")) attribute.values.push_back(real_from_json(value, "values"));
  if (in.contains("lines"))
    for (const json& line : list(in, "lines")) attribute.lines.push_back(whole_from(line, "lines"));
  for (const json& value : list(in, "of_point")) attribute.of_point.push_back(whole_from(value, "of_point"));
  if (!in.contains("own")) return attribute;
  for (const json& entry : list(in, "own")) {
    if (!entry.is_array() || entry.size() != 3)
      throw MalformedJson("an entry of \"own\" is not a polygon, a point and a value");
    attribute.own.push_back({whole_from(entry[0], "own"), whole_from(entry[1], "own"), whole_from(entry[2], "own")});
  }
  return attribute;
}

std::string hexadecimal(const Texture& texture) {
  std::string out;
  out.reserve(6 * texture.texels.size());
  for (const Color& texel : texture.texels)
    fmt::format_to(std::back_inserter(out), "{:02x}{:02x}{:02x}", texel.red, texel.green, texel.blue);
  return out;
}

std::vector<Color> texels_from(const std::string& digits, std::size_t count) {
  if (digits.size() != 6 * count)
    throw MalformedJson(
        fmt::format("\"texels\" has {} digits, and {} texels have {}", digits.size(), count, 6 * count));
  const auto byte_at = [&](std::size_t at) {
    std::uint8_t value = 0;
    const char* const end = digits.data() + at + 2;
    if (std::from_chars(digits.data() + at, end, value, 16).ptr != end)
      throw MalformedJson("\"texels\" has something that is no hexadecimal digit");
    return value;
  };
  std::vector<Color> texels(count);
  for (std::size_t k = 0; k < count; ++k) texels[k] = {byte_at(6 * k), byte_at(6 * k + 2), byte_at(6 * k + 4)};
  return texels;
}

}  // namespace

ordered_json textures_to_json(const std::vector<Texture>& textures) {
  ordered_json out = ordered_json::array();
  for (const Texture& texture : textures)
    out.push_back({{"source", texture.source},
                   {"width", texture.width},
                   {"height", texture.height},
                   {"texels", hexadecimal(texture)}});
  return out;
}

std::vector<Texture> textures_from_json(const json& in) {
  std::vector<Texture> textures;
  std::int64_t left = most_texels;
  for (const json& entry : in) {
    known_keys(entry, "a texture", {"source", "width", "height", "texels"});
    Texture texture{text_or(entry, "source", ""), whole(entry, "width"), whole(entry, "height"), {}};
    if (std::ssize(textures) == most_textures)
      throw MalformedJson(fmt::format("there are more than {} textures", most_textures));
    const bool has_size = texture.width > 0 && texture.height > 0;
    left -= has_size ? std::int64_t{texture.width} * texture.height : 0;
    if (!has_size || left < 0)
      throw MalformedJson(fmt::format("a texture has {} x {} texels (all together have 1 to {})", texture.width,
                                      texture.height, most_texels));
    texture.texels = texels_from(text(entry, "texels"), pixel_count(texture.width, texture.height));
    textures.push_back(std::move(texture));
  }
  return textures;
}

ordered_json scene_to_json(const Scene& scene) {
  ordered_json out;
  out["name"] = scene.name;
  out["source"] = scene.source;
  out["raster"] = raster_to_json(scene.raster);
  out["camera"] = camera_to_json(scene.camera);
  out["background"] = color_text(scene.background);
  if (scene.light) out["light"] = light_to_json(*scene.light);
  if (scene.surface) out["surface"] = surface_to_json(*scene.surface);
  ordered_json points = ordered_json::array();
  for (const glm::dvec3& point : scene.points) points.push_back(vector_to(point));
  out["points"] = std::move(points);
  if (!scene.placements.empty()) {
    ordered_json placements = ordered_json::array();
    for (const Placement& placement : scene.placements) placements.push_back(placement_to_json(placement));
    out["placements"] = std::move(placements);
  }
  if (scene.fit) out["fit"] = fit_to_json(*scene.fit);
  if (!scene.file_points.empty()) {
    ordered_json of_files = ordered_json::array();
    for (const glm::dvec3& point : scene.file_points) of_files.push_back(vector_to(point));
    out["file_points"] = std::move(of_files);
  }
  if (!scene.point_lines.empty()) out["point_lines"] = scene.point_lines;
  ordered_json polygons = ordered_json::array();
  for (const Polygon& polygon : scene.polygons) {
    ordered_json entry;
    if (!polygon.name->empty()) entry["name"] = *polygon.name;
    entry["color"] = color_text(polygon.color);
    if (polygon.source_line != 0) entry["line"] = polygon.source_line;
    const Material& material = *polygon.material;
    if (material.opacity != 1) entry["opacity"] = real_to_json(material.opacity);
    if (material.reflectance != 0) entry["reflectance"] = real_to_json(material.reflectance);
    if (material.refraction != 1) entry["refraction"] = real_to_json(material.refraction);
    if (material.texture != no_texture) entry["texture"] = material.texture;
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
  if (!scene.attributes.empty()) {
    ordered_json attributes = ordered_json::array();
    for (const VertexAttribute& attribute : scene.attributes) attributes.push_back(attribute_to_json(attribute));
    out["attributes"] = std::move(attributes);
  }
  if (!scene.textures.empty()) out["textures"] = textures_to_json(scene.textures);
  return out;
}

Scene scene_from_json(const json& in) {
  known_keys(in, "the scene",
             {"name", "source", "raster", "camera", "background", "light", "surface", "points", "placements", "fit",
              "file_points", "point_lines", "polygons", "facets", "attributes", "textures"});
  Scene scene;
  scene.name = text_or(in, "name", "scene");
  scene.source = text_or(in, "source", "");
  scene.raster = raster_from_json(member(in, "raster"));
  scene.camera = camera_from_json(member(in, "camera"), scene.raster);
  scene.background = color_from(text_or(in, "background", "#ffffff"));
  if (in.contains("light")) scene.light = light_from_json(in.at("light"));
  if (in.contains("surface")) scene.surface = surface_from_json(in.at("surface"));
  for (const json& point : list(in, "points")) scene.points.push_back(vector_from(point, "points"));
  if (in.contains("placements")) {
    for (const json& entry : list(in, "placements")) scene.placements.push_back(placement_from_json(entry));
  }
  if (in.contains("fit")) scene.fit = fit_from_json(in.at("fit"));
  if (in.contains("file_points")) {
    for (const json& point : list(in, "file_points")) scene.file_points.push_back(vector_from(point, "file_points"));
  }
  if (in.contains("point_lines")) {
    for (const json& line : list(in, "point_lines")) scene.point_lines.push_back(whole_from(line, "point_lines"));
  }
  for (const json& entry : list(in, "polygons")) {
    known_keys(entry, "a polygon", {"name", "color", "line", "opacity", "reflectance", "refraction", "texture"});
    const Material material{real_or(entry, "opacity", 1), real_or(entry, "reflectance", 0),
                            real_or(entry, "refraction", 1), whole_or(entry, "texture", no_texture)};
    scene.polygons.push_back({text_or(entry, "name", ""), color_from(text_or(entry, "color", "#999999")),
                              whole_or(entry, "line", 0), material});
  }
  for (const json& entry : list(in, "facets")) {
    known_keys(entry, "a facet", {"polygon", "points"});
    const json& corners = list(entry, "points");
    scene.facets.push_back({whole(entry, "polygon"), size32(scene.corners), size32(corners)});
    for (const json& corner : corners) scene.corners.push_back(whole_from(corner, "points"));
  }
  if (in.contains("attributes")) {
    for (const json& entry : list(in, "attributes")) scene.attributes.push_back(attribute_from_json(entry));
  }
  if (in.contains("textures")) scene.textures = textures_from_json(list(in, "textures"));
  check_scene(scene);
  return scene;
}

namespace {

[[noreturn]] void wrong_scene(const std::string& what) { throw MalformedJson("its scene is wrong: " + what); }

void check_materials(const std::vector<Polygon>& polygons, std::int64_t textures) {
  for (std::size_t i = 0; i < polygons.size(); ++i) {
    const auto [opacity, reflectance, refraction, texture] = *polygons[i].material;
    if (texture < no_texture || texture >= textures)
      wrong_scene(fmt::format("polygon {} has a texture {} that does not exist", i, texture));
    const auto part = [](double value) { return value >= 0 && value <= 1; };
    if (!part(opacity)) wrong_scene(fmt::format("polygon {} has an opacity of {}, not from 0 to 1", i, opacity));
    if (!part(reflectance))
      wrong_scene(fmt::format("polygon {} has a reflectance of {}, not from 0 to 1", i, reflectance));
    if (!(refraction >= least_refraction && refraction <= most_refraction))
      wrong_scene(fmt::format("polygon {} has a refraction of {}, not from {} to {}", i, refraction, least_refraction,
                              most_refraction));
  }
}

void check_light(const Light& light) {
  const auto positive = [](double value) { return value > 0 && std::isfinite(value); };
  const double distance = glm::length(light.target - light.position);
  if (!positive(distance)) wrong_scene("the light stands at its target, or one of them nowhere");
  if (!positive(light.window)) wrong_scene(fmt::format("the light has a window of {}", light.window));
  if (!positive(light.near) || !positive(light.far) || !(light.near < light.far))
    wrong_scene(fmt::format("the light has planes at {} and {}", light.near, light.far));
}

void check_surface(const Surface& surface, std::size_t points) {
  const auto range = [](double low, double high) { return std::isfinite(low) && std::isfinite(high) && low < high; };
  if (surface.formula.empty() || surface.formula.size() > longest_formula)
    wrong_scene(fmt::format("the surface has a formula of {} characters", surface.formula.size()));
  if (!range(surface.x_min, surface.x_max) || !range(surface.z_min, surface.z_max))
    wrong_scene("the surface has a range that does not go from a smaller to a greater number");
  const std::int64_t samples = std::int64_t{surface.columns} * surface.rows;
  if (surface.columns < 1 || surface.rows < 1 || samples > most_surface_samples)
    wrong_scene(fmt::format("the surface has {} x {} samples", surface.columns, surface.rows));
  if (samples != static_cast<std::int64_t>(points))
    wrong_scene(
        fmt::format("the surface has {} x {} samples, but there are {} points", surface.columns, surface.rows, points));
}

void check_attribute(const Scene& scene, const VertexAttribute& attribute) {
  const auto wrong = [&](std::string_view what) {
    wrong_scene(fmt::format("the attribute \"{}\" {}", attribute.name, what));
  };
  if (attribute.name.empty()) wrong("has no name");
  if (attribute.components < 1 || attribute.components > most_components)
    wrong(fmt::format("has {} components (there are 1 to {})", attribute.components, most_components));
  const std::size_t count = attribute.values.size() / attribute.components;
  if (attribute.values.size() % attribute.components != 0) wrong("has a value with too few numbers");
  if (count > static_cast<std::size_t>(most_values)) wrong(fmt::format("has more than {} values", most_values));
  for (const double value : attribute.values)
    if (!(std::abs(value) <= largest_value)) wrong(fmt::format("has the number {}", value));
  if (!attribute.lines.empty() && attribute.lines.size() != count) wrong("has lines, but not one for each value");
  if (attribute.of_point.size() != scene.points.size()) wrong("does not have a value, or -1, for each point");
  for (const std::int32_t value : attribute.of_point)
    if (value < no_value || value >= std::ssize(attribute.values) / attribute.components)
      wrong(fmt::format("has no value {}", value));
  if (attribute.own.size() > static_cast<std::size_t>(most_corners)) wrong("has more values than corners");
  for (std::size_t i = 0; i < attribute.own.size(); ++i) {
    const auto& [polygon, point, value] = attribute.own[i];
    if (polygon < 0 || polygon >= std::ssize(scene.polygons) || point < 0 || point >= std::ssize(scene.points) ||
        value < 0 || static_cast<std::size_t>(value) >= count)
      wrong("has a value of a polygon or a point that does not exist");
    if (i > 0 && !(attribute.own[i - 1] < attribute.own[i])) wrong("has values of polygons that are not in order");
  }
}

void check_attributes(const Scene& scene) {
  if (scene.attributes.size() > static_cast<std::size_t>(most_attributes))
    wrong_scene(fmt::format("{} attributes, of which there can be {}", scene.attributes.size(), most_attributes));
  for (const VertexAttribute& attribute : scene.attributes) {
    check_attribute(scene, attribute);
    if (attribute_named(scene, attribute.name) != &attribute)
      wrong_scene(fmt::format("there are two attributes called \"{}\"", attribute.name));
  }
}

bool is_finite(const glm::dvec3& point) {
  return std::isfinite(point.x) && std::isfinite(point.y) && std::isfinite(point.z);
}

void check_origins(const Scene& scene) {
  if (!scene.file_points.empty() && scene.file_points.size() != scene.points.size())
    wrong_scene("as many points in files as points are needed, or none");
  if (scene.fit && !(is_finite(scene.fit->centre) && scene.fit->radius > 0 && std::isfinite(scene.fit->radius)))
    wrong_scene(fmt::format("it is fitted from a ball of radius {}", scene.fit->radius));
  if (scene.fit && scene.file_points.empty() && !scene.points.empty())
    wrong_scene("it is fitted, but what its points were before is missing");
  std::int64_t end = 0;
  for (const Placement& placement : scene.placements) {
    if (placement.first_point < end || placement.point_count < 0)
      wrong_scene("placements overlap, or are not in the order of their points");
    end = std::int64_t{placement.first_point} + placement.point_count;
    if (end > std::ssize(scene.points)) wrong_scene("a placement is of points that do not exist");
    for (int column = 0; column < 3; ++column)
      if (!is_finite(placement.linear[column]) || !is_finite(placement.offset))
        wrong_scene("a placement has a number that is none");
  }
}

}  // namespace

void check_scene(const Scene& scene) {
  const auto [width, height, y_up, corners] = scene.raster;
  if (width < 1 || height < 1 || width > largest_side || height > largest_side ||
      std::int64_t{width} * height > most_pixels) {
    wrong_scene(fmt::format("a raster of {}x{} pixels (each side is 1 to {}, and there are at most {} pixels)", width,
                            height, largest_side, most_pixels));
  }
  if (corners && scene.camera.kind == Camera::Kind::screen)
    wrong_scene("points on the raster that are seen at the corners of pixels; that is for scenes with a camera");
  if (scene.surface && y_up) wrong_scene("a surface whose rows go up; those of its picture go down");
  const auto most = [&](const char* what, std::size_t count, std::int64_t limit) {
    if (count > static_cast<std::size_t>(limit))
      wrong_scene(fmt::format("{} {}, of which there can be {}", count, what, limit));
  };
  most("points", scene.points.size(), most_points);
  most("polygons", scene.polygons.size(), most_polygons);
  most("facets", scene.facets.size(), most_facets);
  most("corners", scene.corners.size(), most_corners);
  if (!scene.point_lines.empty() && scene.point_lines.size() != scene.points.size())
    wrong_scene("as many lines as points are needed, or none");
  check_origins(scene);
  for (std::size_t i = 0; i < scene.facets.size(); ++i) {
    const Facet& facet = scene.facets[i];
    if (facet.polygon < 0 || facet.polygon >= std::ssize(scene.polygons))
      wrong_scene(fmt::format("facet {} is of polygon {}, which does not exist", i, facet.polygon));
    const std::int64_t end = static_cast<std::int64_t>(facet.first_corner) + facet.corner_count;
    if (facet.first_corner < 0 || facet.corner_count < 0 || end > std::ssize(scene.corners))
      wrong_scene(fmt::format("facet {} has corners outside the list", i));
  }
  for (const std::int32_t corner : scene.corners) {
    if (corner < 0 || corner >= std::ssize(scene.points)) wrong_scene(fmt::format("there is no point {}", corner));
  }
  check_materials(scene.polygons, std::ssize(scene.textures));
  check_attributes(scene);
  if (scene.light) check_light(*scene.light);
  if (scene.surface) check_surface(*scene.surface, scene.points.size());
}

}  // namespace zstep
