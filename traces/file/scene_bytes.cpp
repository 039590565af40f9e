#include "traces/file/scene_bytes.hpp"

#include <algorithm>

#include "traces/events/slots.hpp"
#include "traces/file/header_json.hpp"
#include "traces/limits.hpp"

namespace zstep {

namespace {

constexpr std::size_t document_limit = 4096;

void put_color(Bytes& out, Color color) {
  for (const std::uint8_t part : {color.red, color.green, color.blue}) put_u8(out, part);
}

Color take_color(ByteReader& in) {
  Color color;
  for (std::uint8_t* part : {&color.red, &color.green, &color.blue}) *part = in.u8();
  return color;
}

/// What most scenes do not have stands at the end, and is missing where a scene has none of it: light and surface as
/// JSON, then the materials, as runs of polygons that have the same.
bool has_extras(const Scene& scene) {
  return scene.light || scene.surface ||
         std::any_of(scene.polygons.begin(), scene.polygons.end(),
                     [](const Polygon& polygon) { return polygon.material != Material{}; });
}

void put_extras(Bytes& out, const Scene& scene) {
  nlohmann::ordered_json document = nlohmann::ordered_json::object();
  if (scene.light) document["light"] = light_to_json(*scene.light);
  if (scene.surface) document["surface"] = surface_to_json(*scene.surface);
  put_text(out, document.dump());
  const std::vector<Polygon>& polygons = scene.polygons;
  for (std::size_t first = 0, end = 1; first < polygons.size(); first = end++) {
    const Material& material = polygons[first].material;
    while (end < polygons.size() && polygons[end].material == material) ++end;
    put_varint(out, end - first);
    for (const double value : {material.opacity, material.reflectance, material.refraction})
      put_u64(out, bits_of(value));
  }
}

void take_extras(ByteReader& in, const nlohmann::json& document, Scene& scene) {
  if (document.contains("light")) scene.light = light_from_json(document.at("light"));
  if (document.contains("surface")) scene.surface = surface_from_json(document.at("surface"));
  for (std::size_t first = 0; first < scene.polygons.size();) {
    const std::uint64_t length = in.varint();
    if (length == 0 || length > scene.polygons.size() - first) throw MalformedBytes("a material of no polygon");
    Material material;
    for (double* value : {&material.opacity, &material.reflectance, &material.refraction}) *value = double_of(in.u64());
    for (const std::size_t end = first + length; first < end; ++first) scene.polygons[first].material = material;
  }
}

}  // namespace

Bytes scene_to_bytes(const Scene& scene) {
  Bytes out;
  out.reserve(1024 + scene.points.size() * 28 + scene.polygons.size() * 16 + scene.facets.size() * 8 + scene.corners.size() * 4);
  put_text(out, scene.name);
  put_text(out, scene.source);
  put_text(out, camera_to_json(scene.camera).dump());
  put_text(out, raster_to_json(scene.raster).dump());
  put_color(out, scene.background);
  put_varint(out, scene.points.size());
  for (int axis = 0; axis < 3; ++axis) {
    for (const glm::dvec3& point : scene.points) put_u64(out, bits_of(point[axis]));
  }
  put_varint(out, scene.point_lines.size());
  for (const std::int32_t line : scene.point_lines) put_varint(out, zigzag(line));
  put_varint(out, scene.polygons.size());
  for (const Polygon& polygon : scene.polygons) {
    put_color(out, polygon.color);
    put_varint(out, zigzag(polygon.source_line));
    put_text(out, polygon.name);
  }
  put_varint(out, scene.facets.size());
  for (const Facet& facet : scene.facets) {
    put_varint(out, zigzag(facet.polygon));
    put_varint(out, zigzag(facet.corner_count));
    for (std::int32_t i = 0; i < facet.corner_count; ++i) {
      put_varint(out, zigzag(scene.corners[static_cast<std::size_t>(facet.first_corner + i)]));
    }
  }
  if (has_extras(scene)) put_extras(out, scene);
  return out;
}

Scene scene_from_bytes(std::span<const std::uint8_t> bytes) {
  ByteReader in(bytes);
  const auto whole = [&] { return unzigzag(static_cast<std::uint32_t>(in.varint())); };
  const auto document = [&] {
    const std::string text = in.text();
    if (text.size() > document_limit) throw MalformedBytes("a camera, raster or light of more than 4 KiB");
    try {
      return nlohmann::json::parse(text);
    } catch (const nlohmann::json::exception& error) {
      throw MalformedBytes(error.what());
    }
  };
  // Held to their limits before memory is asked for: an element takes more of it than the byte or two it needs here.
  const auto count = [&](std::size_t bytes_each, std::int64_t limit) {
    const std::size_t value = in.count(bytes_each);
    if (value > static_cast<std::size_t>(limit)) throw MalformedBytes("more of a kind than a scene can have");
    return value;
  };
  Scene scene;
  scene.name = in.text();
  scene.source = in.text();
  scene.camera = camera_from_json(document());
  scene.raster = raster_from_json(document());
  scene.background = take_color(in);
  scene.points.resize(count(24, most_points));
  for (int axis = 0; axis < 3; ++axis) {
    for (glm::dvec3& point : scene.points) point[axis] = double_of(in.u64());
  }
  scene.point_lines.resize(count(1, most_points));
  for (std::int32_t& line : scene.point_lines) line = whole();
  scene.polygons.resize(count(5, most_polygons));
  for (Polygon& polygon : scene.polygons) {
    polygon.color = take_color(in);
    polygon.source_line = whole();
    polygon.name = in.text();
  }
  scene.facets.resize(count(2, most_facets));
  for (Facet& facet : scene.facets) {
    facet.polygon = whole();
    facet.first_corner = static_cast<std::int32_t>(scene.corners.size());
    facet.corner_count = whole();
    if (facet.corner_count < 0 || static_cast<std::size_t>(facet.corner_count) > in.left() ||
        scene.corners.size() + static_cast<std::size_t>(facet.corner_count) > static_cast<std::size_t>(most_corners))
      throw MalformedBytes("a facet with more corners than the data");
    for (std::int32_t i = 0; i < facet.corner_count; ++i) scene.corners.push_back(whole());
  }
  if (!in.empty()) take_extras(in, document(), scene);
  if (!in.empty()) throw MalformedBytes("the scene is followed by something");
  check_scene(scene);
  return scene;
}

}  // namespace zstep
