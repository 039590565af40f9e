#include "traces/file/scene_bytes.hpp"

#include <algorithm>
#include <array>

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

// --- Columns: numbers of one kind in a row, each as what it is more than the one before, so that regular scenes take little room.

/// What is written of them: each number's difference to `last`, as a zigzag varint.
class Wholes {
 public:
  explicit Wholes(Bytes& out) : out_(out) {}
  Wholes(const Wholes&) = delete;
  Wholes& operator=(const Wholes&) = delete;
  ~Wholes() { flush(); }

  void put(std::int64_t value, std::uint32_t& last) {
    if (at_ > at_hand_.size() - longest) flush();
    std::uint32_t left = zigzag(static_cast<std::int32_t>(static_cast<std::uint32_t>(value) - last));
    for (; left >= 0x80; left >>= 7) at_hand_[at_++] = static_cast<std::uint8_t>(left | 0x80);
    at_hand_[at_++] = static_cast<std::uint8_t>(left);
    last = static_cast<std::uint32_t>(value);
  }

 private:
  static constexpr std::size_t longest = 5;
  void flush() {
    out_.insert(out_.end(), at_hand_.begin(), at_hand_.begin() + static_cast<std::ptrdiff_t>(at_));
    at_ = 0;
  }

  Bytes& out_;
  std::array<std::uint8_t, 4096> at_hand_;  ///< what comes next, as a vector asks at each byte whether it has room
  std::size_t at_ = 0;
};

void put_wholes(Bytes& out, std::size_t count, const auto& value_at) {
  Wholes column(out);
  for (std::uint32_t i = 0, last = 0; i < count; ++i) column.put(value_at(i), last);
}

std::int32_t take_whole(ByteReader& in, std::uint32_t& last) {
  last += static_cast<std::uint32_t>(unzigzag(static_cast<std::uint32_t>(in.varint())));
  return static_cast<std::int32_t>(last);
}

void take_wholes(ByteReader& in, std::size_t count, const auto& put) {
  for (std::uint32_t i = 0, last = 0; i < count; ++i) put(i, take_whole(in, last));
}

/// One coordinate of the points: the differences of the float64s' bits, zigzag, first the lowest byte of all of them, then the next of all …
void put_coordinates(Bytes& out, const std::vector<glm::dvec3>& points, int axis) {
  const std::size_t begin = out.size(), count = points.size();
  out.resize(begin + 8 * count);
  std::uint8_t* const bytes = out.data() + begin;
  std::uint64_t last = 0;
  for (std::size_t i = 0; i < count; ++i) {
    const std::uint64_t bits = bits_of(points[i][axis]);
    const std::uint64_t more = difference(bits, last);
    for (std::size_t k = 0; k < 8; ++k) bytes[k * count + i] = static_cast<std::uint8_t>(more >> (8 * k));
    last = bits;
  }
}

void take_coordinates(ByteReader& in, std::vector<glm::dvec3>& points, int axis) {
  const std::size_t count = points.size();
  const std::uint8_t* const bytes = in.take(8 * count).data();
  std::uint64_t last = 0;
  for (std::size_t i = 0; i < count; ++i) {
    std::uint64_t more = 0;
    for (std::size_t k = 0; k < 8; ++k) more |= std::uint64_t{bytes[k * count + i]} << (8 * k);
    last = undo_difference(more, last);
    points[i][axis] = double_of(last);
  }
}

}  // namespace

Bytes scene_to_bytes(const Scene& scene) {
  Bytes out;
  out.reserve(1024 + scene.points.size() * 28 + scene.polygons.size() * 25 + scene.facets.size() * 10 + scene.corners.size() * 5);
  put_text(out, scene.name);
  put_text(out, scene.source);
  put_text(out, camera_to_json(scene.camera).dump());
  put_text(out, raster_to_json(scene.raster).dump());
  put_color(out, scene.background);
  put_varint(out, scene.points.size());
  for (int axis = 0; axis < 3; ++axis) put_coordinates(out, scene.points, axis);
  put_varint(out, scene.point_lines.size());
  put_wholes(out, scene.point_lines.size(), [&](std::size_t i) { return scene.point_lines[i]; });

  const std::vector<Polygon>& polygons = scene.polygons;
  put_varint(out, polygons.size());
  {
    Wholes columns(out);
    std::uint32_t red = 0, green = 0, blue = 0, line = 0, length = 0;
    for (const Polygon& polygon : polygons) {
      columns.put(polygon.color.red, red), columns.put(polygon.color.green, green), columns.put(polygon.color.blue, blue);
      columns.put(polygon.source_line, line);
      columns.put(static_cast<std::int64_t>(polygon.name.size()), length);
    }
  }
  for (const Polygon& polygon : polygons) out.insert(out.end(), polygon.name.begin(), polygon.name.end());

  const std::vector<Facet>& facets = scene.facets;
  put_varint(out, facets.size());
  put_wholes(out, facets.size(), [&](std::size_t i) { return facets[i].polygon; });
  put_wholes(out, facets.size(), [&](std::size_t i) { return facets[i].corner_count; });
  std::size_t corners = 0;
  for (const Facet& facet : facets) corners += static_cast<std::size_t>(facet.corner_count);
  put_varint(out, corners);
  auto facet = facets.begin();
  std::int32_t of_facet = 0;
  put_wholes(out, corners, [&](std::size_t) {
    while (of_facet == facet->corner_count) ++facet, of_facet = 0;
    return scene.corners[static_cast<std::size_t>(facet->first_corner + of_facet++)];
  });
  if (has_extras(scene)) put_extras(out, scene);
  return out;
}

Scene scene_from_bytes(std::span<const std::uint8_t> bytes) {
  ByteReader in(bytes);
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
  for (int axis = 0; axis < 3; ++axis) take_coordinates(in, scene.points, axis);
  scene.point_lines.resize(count(1, most_points));
  take_wholes(in, scene.point_lines.size(), [&](std::size_t i, std::int32_t line) { scene.point_lines[i] = line; });

  std::vector<Polygon>& polygons = scene.polygons;
  polygons.resize(count(5, most_polygons));
  std::vector<std::uint32_t> lengths;
  lengths.reserve(polygons.size());
  std::uint32_t red = 0, green = 0, blue = 0, line = 0, length = 0;
  for (Polygon& polygon : polygons) {
    polygon.color.red = static_cast<std::uint8_t>(take_whole(in, red));
    polygon.color.green = static_cast<std::uint8_t>(take_whole(in, green));
    polygon.color.blue = static_cast<std::uint8_t>(take_whole(in, blue));
    polygon.source_line = take_whole(in, line);
    take_whole(in, length);
    lengths.push_back(length);
  }
  for (std::size_t i = 0; i < polygons.size(); ++i) {
    const std::span<const std::uint8_t> name = in.take(lengths[i]);
    polygons[i].name.assign(name.begin(), name.end());
  }

  std::vector<Facet>& facets = scene.facets;
  facets.resize(count(2, most_facets));
  take_wholes(in, facets.size(), [&](std::size_t i, std::int32_t polygon) { facets[i].polygon = polygon; });
  std::int64_t corners = 0;
  take_wholes(in, facets.size(), [&](std::size_t i, std::int32_t corner_count) {
    facets[i].first_corner = static_cast<std::int32_t>(corners);
    facets[i].corner_count = corner_count;
    corners += corner_count;
    if (corner_count < 0 || corners > most_corners) throw MalformedBytes("a facet with more corners than the data");
  });
  scene.corners.resize(count(1, most_corners));
  if (corners != static_cast<std::int64_t>(scene.corners.size())) throw MalformedBytes("a facet with more corners than the data");
  take_wholes(in, scene.corners.size(), [&](std::size_t i, std::int32_t corner) { scene.corners[i] = corner; });
  if (!in.empty()) take_extras(in, document(), scene);
  if (!in.empty()) throw MalformedBytes("the scene is followed by something");
  check_scene(scene);
  return scene;
}

}  // namespace zstep
