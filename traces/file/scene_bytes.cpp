#include "traces/file/scene_bytes.hpp"

#include <algorithm>
#include <array>
#include <tuple>

#include "traces/events/slots.hpp"
#include "traces/file/header_json.hpp"
#include "traces/scene.hpp"

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

// --- Columns: whole numbers of one kind, each as what it is more than the one before (the first: than 0), so that
// regular scenes take little room.

/// A zigzag varint of the difference.
void put_whole(Bytes& out, std::int32_t value, std::uint32_t& last) {
  const std::uint32_t now = value;
  put_varint(out, zigzag(static_cast<std::int32_t>(now - last)));
  last = now;
}

std::int32_t take_whole(ByteReader& in, std::uint32_t& last) {
  last += static_cast<std::uint32_t>(unzigzag(static_cast<std::uint32_t>(in.varint())));
  return static_cast<std::int32_t>(last);
}

/// Differences that repeat: zigzag varint, and a varint how often.
class Runs {
 public:
  void put(std::int64_t value) {
    const auto now = static_cast<std::uint32_t>(value), more = now - last_;
    last_ = now;
    if (count_ > 0 && more == more_) {
      ++count_;
      return;
    }
    end_run();
    more_ = more, count_ = 1;
  }
  void end(Bytes& out) {
    end_run();
    out.insert(out.end(), bytes_.begin(), bytes_.end());
  }

 private:
  void end_run() {
    if (count_ == 0) return;
    put_varint(bytes_, zigzag(static_cast<std::int32_t>(more_)));
    put_varint(bytes_, count_);
  }

  Bytes bytes_;
  std::uint32_t last_ = 0, more_ = 0;
  std::uint64_t count_ = 0;
};

/// Calls put(i, value) for 0 … count - 1.
void take_runs(ByteReader& in, std::size_t count, const auto& put) {
  std::uint32_t last = 0;
  for (std::size_t i = 0; i < count;) {
    const std::uint32_t more = unzigzag(static_cast<std::uint32_t>(in.varint()));
    const std::uint64_t times = in.varint();
    if (times == 0 || times > count - i) throw MalformedBytes("a column with another number of values than it says");
    for (const std::size_t end = i + static_cast<std::size_t>(times); i < end; ++i)
      put(i, static_cast<std::int32_t>(last += more));
  }
}

void put_low_bytes(std::uint8_t* to, std::uint64_t value, std::size_t count) {
  for (std::size_t i = 0; i < count; ++i) to[i] = static_cast<std::uint8_t>(value >> (8 * i));
}
std::uint64_t low_bytes(const std::uint8_t* from, std::size_t count) {
  std::uint64_t value = 0;
  for (std::size_t i = 0; i < count; ++i) value |= std::uint64_t{from[i]} << (8 * i);
  return value;
}

/// Eight words as the bytes of eight others: byte k of word i becomes byte i of word k.
void transpose(std::array<std::uint64_t, 8>& words) {
  const auto exchange = [&](std::size_t apart,
                            std::uint64_t mask) {  // blocks of apart x apart bytes, across the diagonal
    for (std::size_t i = 0; i < 8; ++i) {
      if ((i & apart) != 0) continue;
      const std::uint64_t changed = ((words[i] >> (8 * apart)) ^ words[i + apart]) & mask;
      words[i + apart] ^= changed;
      words[i] ^= changed << (8 * apart);
    }
  };
  exchange(4, 0x00000000ffffffff);
  exchange(2, 0x0000ffff0000ffff);
  exchange(1, 0x00ff00ff00ff00ff);
}

/// One coordinate of the points: the differences of the float64s' bits, zigzag, first the lowest byte of all of them,
/// then the next of all …
void put_coordinates(Bytes& out, const std::vector<glm::dvec3>& points, int axis) {
  const std::size_t begin = out.size(), count = points.size();
  out.resize(begin + 8 * count);
  std::uint8_t* const bytes = out.data() + begin;
  std::uint64_t last = 0;
  for (std::size_t first = 0; first < count; first += 8) {
    const std::size_t here = std::min<std::size_t>(8, count - first);
    std::array<std::uint64_t, 8> words{};
    for (std::size_t i = 0; i < here; ++i) {
      const std::uint64_t bits = bits_of(points[first + i][axis]);
      words[i] = difference(bits, last);
      last = bits;
    }
    transpose(words);
    for (std::size_t k = 0; k < 8; ++k) put_low_bytes(bytes + k * count + first, words[k], here);
  }
}

void take_coordinates(ByteReader& in, std::vector<glm::dvec3>& points, int axis) {
  const std::size_t count = points.size();
  const std::uint8_t* const bytes = in.take(8 * count).data();
  std::uint64_t last = 0;
  for (std::size_t first = 0; first < count; first += 8) {
    const std::size_t here = std::min<std::size_t>(8, count - first);
    std::array<std::uint64_t, 8> words;
    for (std::size_t k = 0; k < 8; ++k) words[k] = low_bytes(bytes + k * count + first, here);
    transpose(words);
    for (std::size_t i = 0; i < here; ++i) points[first + i][axis] = double_of(last = undo_difference(words[i], last));
  }
}

/// Held to its limits before memory is asked for.
std::size_t count_of_points(ByteReader& in) {
  const std::uint64_t points = in.varint();
  if (points > static_cast<std::uint64_t>(most_points)) throw MalformedBytes("more of a kind than a scene can have");
  if (points > in.left() / 24) throw MalformedBytes("a count larger than the data");
  return points;
}

/// What most scenes do not have stands at the end, and is missing where a scene has none of it: light, surface, fit and
/// textures, with the runs of polygons that have the same, as JSON, then the rest of the materials, as such runs, the
/// placements, the points as their files have them, and the attributes of vertices.
bool has_extras(const Scene& scene) {
  return scene.light || scene.surface || scene.fit || !scene.placements.empty() || !scene.attributes.empty() ||
         std::any_of(scene.polygons.begin(), scene.polygons.end(),
                     [](const Polygon& polygon) { return polygon.material != Material{}; });
}

void put_attribute(Bytes& out, const VertexAttribute& attribute) {
  put_text(out, attribute.name);
  put_varint(out, static_cast<std::uint64_t>(attribute.components));
  put_varint(out, attribute.values.size());
  for (const double value : attribute.values) put_u64(out, bits_of(value));
  const auto put_column = [&](const std::vector<std::int32_t>& column) {
    put_varint(out, column.size());
    Runs runs;
    for (const std::int32_t value : column) runs.put(value);
    runs.end(out);
  };
  put_column(attribute.lines), put_column(attribute.of_point);
  put_varint(out, attribute.own.size());
  std::array<std::uint32_t, 3> last{};
  for (const auto& [polygon, point, value] : attribute.own)
    put_whole(out, polygon, last[0]), put_whole(out, point, last[1]), put_whole(out, value, last[2]);
}

void put_extras(Bytes& out, const Scene& scene) {
  nlohmann::ordered_json document = nlohmann::ordered_json::object();
  if (scene.light) document["light"] = light_to_json(*scene.light);
  if (scene.surface) document["surface"] = surface_to_json(*scene.surface);
  if (scene.fit) document["fit"] = fit_to_json(*scene.fit);
  const std::vector<Polygon>& polygons = scene.polygons;
  if (!scene.textures.empty()) {
    document["textures"] = textures_to_json(scene.textures);
    nlohmann::ordered_json runs = nlohmann::ordered_json::array();
    for (std::size_t first = 0, end = 1; first < polygons.size(); first = end++) {
      while (end < polygons.size() && polygons[end].material->texture == polygons[first].material->texture) ++end;
      runs.push_back({end - first, polygons[first].material->texture});
    }
    document["texture_of"] = std::move(runs);
  }
  put_text(out, document.dump());
  for (std::size_t first = 0, end = 1; first < polygons.size(); first = end++) {
    const Material& material = *polygons[first].material;
    const auto of_light = [](const Material& m) { return std::tie(m.opacity, m.reflectance, m.refraction); };
    while (end < polygons.size() && of_light(*polygons[end].material) == of_light(material)) ++end;
    put_varint(out, end - first);
    for (const double value : {material.opacity, material.reflectance, material.refraction})
      put_u64(out, bits_of(value));
  }
  put_varint(out, scene.placements.size());
  for (const Placement& placement : scene.placements) {
    put_varint(out, static_cast<std::uint64_t>(placement.first_point));
    put_varint(out, static_cast<std::uint64_t>(placement.point_count));
    put_text(out, placement.source);
    put_varint(out, static_cast<std::uint64_t>(placement.line));
    for (const glm::dvec3& column : {placement.linear[0], placement.linear[1], placement.linear[2], placement.offset})
      for (int row = 0; row < 3; ++row) put_u64(out, bits_of(column[row]));
  }
  put_varint(out, scene.file_points.size());
  for (int axis = 0; axis < 3; ++axis) put_coordinates(out, scene.file_points, axis);
  if (scene.attributes.empty()) return;
  put_varint(out, scene.attributes.size());
  for (const VertexAttribute& attribute : scene.attributes) put_attribute(out, attribute);
}

VertexAttribute take_attribute(ByteReader& in, std::int64_t points) {
  // Held to its limit before memory is asked for.
  const auto count = [&](std::int64_t limit, std::size_t least_bytes) {
    const std::uint64_t value = in.varint();
    if (value > static_cast<std::uint64_t>(limit)) throw MalformedBytes("more of a kind than a scene can have");
    if (value > in.left() / std::max<std::size_t>(1, least_bytes) && least_bytes > 0)
      throw MalformedBytes("a count larger than the data");
    return static_cast<std::size_t>(value);
  };
  VertexAttribute attribute;
  attribute.name = in.text();
  attribute.components = static_cast<std::int32_t>(count(most_components, 0));
  attribute.values.resize(count(most_values * most_components, sizeof(double)));
  for (double& value : attribute.values) value = double_of(in.u64());
  const auto take_column = [&](std::vector<std::int32_t>& column, std::int64_t most) {
    column.resize(count(most, 0));
    take_runs(in, column.size(), [&](std::size_t i, std::int32_t value) { column[i] = value; });
  };
  take_column(attribute.lines, std::ssize(attribute.values));
  take_column(attribute.of_point, points);
  attribute.own.resize(count(most_corners, 3));
  std::array<std::uint32_t, 3> last{};
  for (auto& [polygon, point, value] : attribute.own)
    polygon = take_whole(in, last[0]), point = take_whole(in, last[1]), value = take_whole(in, last[2]);
  return attribute;
}

void take_textures(const nlohmann::json& document, Scene& scene) {
  if (!document.contains("textures")) return;
  scene.textures = textures_from_json(document.at("textures"));
  std::size_t first = 0;
  for (const nlohmann::json& run : document.at("texture_of")) {
    const auto length = run.at(0).get<std::uint64_t>();
    if (length == 0 || length > scene.polygons.size() - first) throw MalformedBytes("a texture of no polygon");
    for (const std::size_t end = first + static_cast<std::size_t>(length); first < end; ++first) {
      Material material = *scene.polygons[first].material;
      material.texture = run.at(1).get<std::int32_t>();
      scene.polygons[first].material = material;
    }
  }
}

void take_extras(ByteReader& in, const nlohmann::json& document, Scene& scene) {
  if (document.contains("light")) scene.light = light_from_json(document.at("light"));
  if (document.contains("surface")) scene.surface = surface_from_json(document.at("surface"));
  if (document.contains("fit")) scene.fit = fit_from_json(document.at("fit"));
  for (std::size_t first = 0; first < scene.polygons.size();) {
    const std::uint64_t length = in.varint();
    if (length == 0 || length > scene.polygons.size() - first) throw MalformedBytes("a material of no polygon");
    Material material;
    for (double* value : {&material.opacity, &material.reflectance, &material.refraction}) *value = double_of(in.u64());
    for (const std::size_t end = first + static_cast<std::size_t>(length); first < end; ++first)
      scene.polygons[first].material = material;
  }
  take_textures(document, scene);
  for (std::uint64_t left = in.varint(); left > 0; --left) {
    Placement placement;
    for (std::int32_t* whole : {&placement.first_point, &placement.point_count})
      *whole = static_cast<std::int32_t>(static_cast<std::uint32_t>(in.varint()));
    placement.source = in.text();
    placement.line = static_cast<std::int32_t>(static_cast<std::uint32_t>(in.varint()));
    for (glm::dvec3* column : {&placement.linear[0], &placement.linear[1], &placement.linear[2], &placement.offset})
      for (int row = 0; row < 3; ++row) (*column)[row] = double_of(in.u64());
    scene.placements.push_back(std::move(placement));
  }
  scene.file_points.resize(count_of_points(in));
  for (int axis = 0; axis < 3; ++axis) take_coordinates(in, scene.file_points, axis);
  if (in.empty()) return;
  const std::uint64_t attributes = in.varint();
  if (attributes > static_cast<std::uint64_t>(most_attributes))
    throw MalformedBytes("more of a kind than a scene can have");
  for (std::uint64_t k = 0; k < attributes; ++k)
    scene.attributes.push_back(take_attribute(in, std::ssize(scene.points)));
  if (attributes == 0 || !in.empty()) throw MalformedBytes("the scene is followed by something");
}

}  // namespace

Bytes scene_to_bytes(const Scene& scene) {
  Bytes out;
  out.reserve(1024 + scene.points.size() * 24 + scene.corners.size() * 2);
  put_text(out, scene.name);
  put_text(out, scene.source);
  put_text(out, camera_to_json(scene.camera).dump());
  put_text(out, raster_to_json(scene.raster).dump());
  put_color(out, scene.background);
  put_varint(out, scene.points.size());
  for (int axis = 0; axis < 3; ++axis) put_coordinates(out, scene.points, axis);
  put_varint(out, scene.point_lines.size());
  Runs lines;
  for (const std::int32_t line : scene.point_lines) lines.put(line);
  lines.end(out);

  put_varint(out, scene.polygons.size());
  std::array<Runs, 5> of_polygons;
  for (const Polygon& polygon : scene.polygons) {
    auto& [red, green, blue, line, length] = of_polygons;
    red.put(polygon.color.red), green.put(polygon.color.green), blue.put(polygon.color.blue);
    line.put(polygon.source_line), length.put(static_cast<std::int64_t>(polygon.name->size()));
  }
  for (Runs& column : of_polygons) column.end(out);
  for (const Polygon& polygon : scene.polygons) out.insert(out.end(), polygon.name->begin(), polygon.name->end());

  put_varint(out, scene.facets.size());
  Runs of_facets, counts;
  std::size_t corners = 0;
  for (const Facet& facet : scene.facets) {
    of_facets.put(facet.polygon), counts.put(facet.corner_count);
    corners += static_cast<std::size_t>(facet.corner_count);
  }
  of_facets.end(out), counts.end(out);
  put_varint(out, corners);
  std::uint32_t last = 0;
  for (const Facet& facet : scene.facets) {
    const std::int32_t* const first = scene.corners.data() + facet.first_corner;
    for (std::int32_t i = 0; i < facet.corner_count; ++i) put_whole(out, first[i], last);
  }
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
  // Held to their limits before memory is asked for.
  const auto count = [&](std::int64_t limit) {
    const std::uint64_t value = in.varint();
    if (value > static_cast<std::uint64_t>(limit)) throw MalformedBytes("more of a kind than a scene can have");
    return static_cast<std::size_t>(value);
  };
  Scene scene;
  scene.name = in.text();
  scene.source = in.text();
  const auto camera = document();
  scene.raster = raster_from_json(document());
  scene.camera = camera_from_json(camera, scene.raster);
  scene.background = take_color(in);
  scene.points.resize(count_of_points(in));
  for (int axis = 0; axis < 3; ++axis) take_coordinates(in, scene.points, axis);
  scene.point_lines.resize(count(most_points));
  take_runs(in, scene.point_lines.size(), [&](std::size_t i, std::int32_t line) { scene.point_lines[i] = line; });

  std::vector<Polygon>& polygons = scene.polygons;
  polygons.resize(count(most_polygons));
  for (const auto part : {&Color::red, &Color::green, &Color::blue})
    take_runs(in, polygons.size(),
              [&](std::size_t i, std::int32_t value) { polygons[i].color.*part = static_cast<std::uint8_t>(value); });
  take_runs(in, polygons.size(), [&](std::size_t i, std::int32_t line) { polygons[i].source_line = line; });
  std::vector<std::uint32_t> lengths(polygons.size());
  take_runs(in, polygons.size(),
            [&](std::size_t i, std::int32_t length) { lengths[i] = static_cast<std::uint32_t>(length); });
  for (std::size_t i = 0; i < polygons.size(); ++i) {
    const std::span<const std::uint8_t> name = in.take(lengths[i]);
    polygons[i].name = std::string(name.begin(), name.end());
  }

  std::vector<Facet>& facets = scene.facets;
  facets.resize(count(most_facets));
  take_runs(in, facets.size(), [&](std::size_t i, std::int32_t polygon) { facets[i].polygon = polygon; });
  std::int64_t corners = 0;
  take_runs(in, facets.size(), [&](std::size_t i, std::int32_t corner_count) {
    facets[i].first_corner = static_cast<std::int32_t>(corners);
    facets[i].corner_count = corner_count;
    corners += corner_count;
    if (corner_count < 0 || corners > most_corners) throw MalformedBytes("a facet with more corners than the data");
  });
  if (static_cast<std::int64_t>(count(most_corners)) != corners)
    throw MalformedBytes("a facet with more corners than the data");
  scene.corners.resize(corners);
  std::uint32_t last = 0;
  for (std::int32_t& corner : scene.corners) corner = take_whole(in, last);
  if (!in.empty()) take_extras(in, document(), scene);
  check_scene(scene);
  return scene;
}

}  // namespace zstep
