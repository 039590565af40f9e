#include "traces/file/header_json.hpp"

#include <array>
#include <cmath>
#include <string_view>

#include <fmt/format.h>

#include "traces/events/vocabulary.hpp"

namespace zstep {

using nlohmann::json;
using nlohmann::ordered_json;

namespace {

constexpr std::array<std::string_view, 3> camera_words{"screen", "perspective", "orthographic"};
constexpr std::array<std::string_view, 2> depth_words{"pseudodepth", "view"};
constexpr std::array<std::string_view, 2> interpolation_words{"direct", "increments"};
constexpr std::array<std::string_view, 2> coverage_words{"top_left", "inclusive"};

const json& member(const json& object, const char* key) {
  if (!object.is_object() || !object.contains(key)) throw MalformedJson(fmt::format("\"{}\" is missing", key));
  return object.at(key);
}

std::string text(const json& object, const char* key) {
  const json& value = member(object, key);
  if (!value.is_string()) throw MalformedJson(fmt::format("\"{}\" is not a text", key));
  return value.get<std::string>();
}

std::string text_or(const json& object, const char* key, const std::string& otherwise) {
  return object.is_object() && object.contains(key) ? text(object, key) : otherwise;
}

double real(const json& object, const char* key) { return real_from_json(member(object, key), key); }
double real_or(const json& object, const char* key, double otherwise) {
  return object.is_object() && object.contains(key) ? real(object, key) : otherwise;
}

std::int32_t whole_from(const json& value, const char* key) {
  if (!value.is_number_integer()) throw MalformedJson(fmt::format("\"{}\" is not a whole number", key));
  const auto wide = value.get<std::int64_t>();
  if (wide < INT32_MIN || wide > INT32_MAX || (value.is_number_unsigned() && value.get<std::uint64_t>() > INT32_MAX)) {
    throw MalformedJson(fmt::format("\"{}\" is out of range", key));
  }
  return static_cast<std::int32_t>(wide);
}
std::int32_t whole(const json& object, const char* key) { return whole_from(member(object, key), key); }
std::int32_t whole_or(const json& object, const char* key, std::int32_t otherwise) {
  return object.is_object() && object.contains(key) ? whole(object, key) : otherwise;
}

bool truth_or(const json& object, const char* key, bool otherwise) {
  if (!object.is_object() || !object.contains(key)) return otherwise;
  if (!object.at(key).is_boolean()) throw MalformedJson(fmt::format("\"{}\" is neither true nor false", key));
  return object.at(key).get<bool>();
}

template <class Enumeration, std::size_t N>
Enumeration word_or(const json& object, const char* key, const std::array<std::string_view, N>& words, Enumeration otherwise) {
  if (!object.is_object() || !object.contains(key)) return otherwise;
  const std::string word = text(object, key);
  for (std::size_t i = 0; i < N; ++i) {
    if (words[i] == word) return static_cast<Enumeration>(i);
  }
  throw MalformedJson(fmt::format("\"{}\" is \"{}\", but can only be one of: {}", key, word, fmt::join(words, ", ")));
}

template <class Enumeration, std::size_t N>
std::string word(Enumeration value, const std::array<std::string_view, N>& words) {
  return std::string(words[static_cast<std::size_t>(value)]);
}

const json& list(const json& object, const char* key) {
  const json& value = member(object, key);
  if (!value.is_array()) throw MalformedJson(fmt::format("\"{}\" is not a list", key));
  return value;
}

std::string color_text(Color color) { return fmt::format("#{:02x}{:02x}{:02x}", color.red, color.green, color.blue); }

Color color_from(const std::string& text) {
  unsigned value = 0;
  bool good = text.size() == 7 && text[0] == '#';
  for (std::size_t i = 1; good && i < 7; ++i) {
    const char c = text[i];
    const int digit = c >= '0' && c <= '9' ? c - '0' : c >= 'a' && c <= 'f' ? c - 'a' + 10 : c >= 'A' && c <= 'F' ? c - 'A' + 10 : -1;
    good = digit >= 0;
    value = value * 16 + static_cast<unsigned>(digit & 15);
  }
  if (!good) throw MalformedJson(fmt::format("\"{}\" is no colour (#rrggbb)", text));
  return {static_cast<std::uint8_t>(value >> 16), static_cast<std::uint8_t>(value >> 8 & 255), static_cast<std::uint8_t>(value & 255)};
}

glm::dvec3 vector_from(const json& value, const char* what) {
  if (!value.is_array() || value.size() != 3) throw MalformedJson(fmt::format("\"{}\" is not a list of three numbers", what));
  return {real_from_json(value[0], what), real_from_json(value[1], what), real_from_json(value[2], what)};
}

ordered_json vector_to(const glm::dvec3& v) { return ordered_json::array({real_to_json(v.x), real_to_json(v.y), real_to_json(v.z)}); }

}  // namespace

ordered_json real_to_json(double value) {
  if (std::isnan(value)) return "nan";
  if (std::isinf(value)) return value > 0 ? "inf" : "-inf";
  return value;
}

double real_from_json(const json& value, const char* what) {
  if (value.is_number()) return value.get<double>();
  if (value == "inf") return no_depth;
  if (value == "-inf") return -no_depth;
  if (value == "nan") return std::nan("");
  throw MalformedJson(fmt::format("\"{}\" is not a number (\"inf\", \"-inf\" and \"nan\" are written as texts)", what));
}

ordered_json header_to_json(const Header& header) {
  ordered_json steps = ordered_json::array();
  for (const StepInfo& step : header.page) {
    ordered_json entry;
    entry["id"] = step.id;
    entry["module"] = step.module;
    entry["name"] = step.name;
    for_each_kind([&]<class E>() { if (kind_of<E> == step.kind) entry["event"] = kind_text<E>.name; });
    entry["indent"] = step.indent;
    entry["text"] = step.text;
    steps.push_back(std::move(entry));
  }
  ordered_json out;
  out["ztrace"] = 1;
  out["writer"] = header.writer;
  out["algorithm"] = header.algorithm;
  out["title"] = header.title;
  out["conventions"] = {
      {"depth", word(header.conventions.depth, depth_words)},
      {"interpolation", word(header.conventions.interpolation, interpolation_words)},
      {"coverage", word(header.conventions.coverage, coverage_words)},
      {"cull", header.conventions.cull},
      {"number_format", "float64"},
      {"pixel_centre", "integer"},
      {"nearer", "smaller"},
      {"ties", "first"},
  };
  out["steps"] = std::move(steps);
  return out;
}

Header header_from_json(const json& in) {
  const std::int32_t version = whole(in, "ztrace");
  Header header;
  header.writer = text_or(in, "writer", "an unnamed program");
  if (version != 1) throw MalformedJson(fmt::format("it has version {} and was written by {}; this zstep reads version 1", version, header.writer));
  header.algorithm = text(in, "algorithm");
  header.title = text_or(in, "title", header.algorithm);
  const json conventions = in.contains("conventions") ? in.at("conventions") : json::object();
  if (!conventions.is_object()) throw MalformedJson("\"conventions\" is not an object");
  header.conventions.depth = word_or(conventions, "depth", depth_words, Conventions::Depth::pseudodepth);
  header.conventions.interpolation = word_or(conventions, "interpolation", interpolation_words, Conventions::Interpolation::direct);
  header.conventions.coverage = word_or(conventions, "coverage", coverage_words, Conventions::Coverage::top_left);
  header.conventions.cull = truth_or(conventions, "cull", true);
  std::array<bool, step_limit> taken{};
  for (const json& entry : list(in, "steps")) {
    StepInfo step;
    const std::int32_t id = whole(entry, "id");
    if (id < 0 || id >= step_limit) throw MalformedJson(fmt::format("step id {} is not below {}", id, step_limit));
    if (taken[static_cast<std::size_t>(id)]) throw MalformedJson(fmt::format("step id {} stands twice", id));
    taken[static_cast<std::size_t>(id)] = true;
    step.id = static_cast<std::uint8_t>(id);
    step.module = text_or(entry, "module", "");
    step.name = text(entry, "name");
    step.text = text_or(entry, "text", step.name);
    const std::int32_t indent = whole_or(entry, "indent", 0);
    if (indent < 0 || indent > 32) throw MalformedJson(fmt::format("step \"{}\" is indented {} deep", step.name, indent));
    step.indent = static_cast<std::uint8_t>(indent);
    const std::string kind = text(entry, "event");
    bool known = false;
    for_each_kind([&]<class E>() {
      if (kind_text<E>.name != kind) return;
      step.kind = kind_of<E>;
      known = true;
    });
    if (!known) throw MalformedJson(fmt::format("step \"{}\" records \"{}\", a kind of event this zstep does not know; {} wrote it", step.name, kind, header.writer));
    header.page.push_back(std::move(step));
  }
  return header;
}

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
    for (int column = 0; column < 4; ++column) camera.view[column][row] = real_from_json(cells[static_cast<std::size_t>(column)], "view");
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
    entry["points"] = std::vector<std::int32_t>(scene.corners.begin() + facet.first_corner, scene.corners.begin() + facet.first_corner + facet.corner_count);
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
    scene.polygons.push_back({text_or(entry, "name", ""), color_from(text_or(entry, "color", "#999999")), whole_or(entry, "line", 0)});
  }
  for (const json& entry : list(in, "facets")) {
    const json& corners = list(entry, "points");
    scene.facets.push_back({whole(entry, "polygon"), static_cast<std::int32_t>(scene.corners.size()), static_cast<std::int32_t>(corners.size())});
    for (const json& corner : corners) scene.corners.push_back(whole_from(corner, "points"));
  }
  check_scene(scene);
  return scene;
}

void check_scene(const Scene& scene) {
  const auto fail = [](const std::string& what) { throw MalformedJson("its scene is wrong: " + what); };
  if (scene.raster.width < 1 || scene.raster.height < 1 || scene.raster.width > raster_limit || scene.raster.height > raster_limit) {
    fail(fmt::format("a raster of {}x{} pixels (1x1 to {}x{} can be)", scene.raster.width, scene.raster.height, raster_limit, raster_limit));
  }
  if (!scene.point_lines.empty() && scene.point_lines.size() != scene.points.size()) fail("as many lines as points are needed, or none");
  for (std::size_t i = 0; i < scene.facets.size(); ++i) {
    const Facet& facet = scene.facets[i];
    if (facet.polygon < 0 || static_cast<std::size_t>(facet.polygon) >= scene.polygons.size()) fail(fmt::format("facet {} is of polygon {}, which does not exist", i, facet.polygon));
    const std::int64_t end = static_cast<std::int64_t>(facet.first_corner) + facet.corner_count;
    if (facet.first_corner < 0 || facet.corner_count < 0 || end > static_cast<std::int64_t>(scene.corners.size())) fail(fmt::format("facet {} has corners outside the list", i));
  }
  for (const std::int32_t corner : scene.corners) {
    if (corner < 0 || static_cast<std::size_t>(corner) >= scene.points.size()) fail(fmt::format("there is no point {}", corner));
  }
}

const StepInfo* find_step(const Page& page, std::uint8_t id) {
  for (const StepInfo& step : page) {
    if (step.id == id) return &step;
  }
  return nullptr;
}

const StepInfo* find_step(const Page& page, std::string_view name) {
  for (const StepInfo& step : page) {
    if (step.name == name || (name.size() == step.module.size() + 1 + step.name.size() && name.substr(0, step.module.size()) == step.module &&
                              name[step.module.size()] == '.' && name.substr(step.module.size() + 1) == step.name)) {
      return &step;
    }
  }
  return nullptr;
}

}  // namespace zstep
