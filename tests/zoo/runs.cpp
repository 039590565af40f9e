#include "tests/zoo/runs.hpp"

#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <map>
#include <memory>
#include <random>
#include <sstream>
#include <string_view>

#include <doctest/doctest.h>
#include <unistd.h>
#include <fmt/format.h>
#include <glm/matrix.hpp>
#include <nlohmann/json.hpp>

#include "algorithms/catalog/catalog.hpp"
#include "tests/where.hpp"
#include "traces/file/jsonl.hpp"
#include "traces/record/trace_recorder.hpp"

namespace zstep::test {

zoo::Task triangles(std::uint64_t seed, int count, int size) {
  std::mt19937_64 random(seed);
  zoo::Task task;
  task.width = size, task.height = size - 4;
  const auto eighths = [&](int whole) {
    return static_cast<double>(random() % static_cast<std::uint64_t>(8 * whole)) / 8;
  };
  for (int i = 0; i < count; ++i) {
    for (int corner = 0; corner < 3; ++corner)
      task.points.push_back({eighths(size - 1), eighths(size - 5), 0.25 + eighths(4) / 8});
    task.polygons.push_back({i, {3 * i, 3 * i + 1, 3 * i + 2}});
  }
  return task;
}

zoo::Task ties() {
  zoo::Task task;
  task.width = 14, task.height = 12;
  task.points = {{1, 1, 0.5}, {12, 1, 0.5},  {1, 10, 0.5}, {3, 2, 0.5},  {12, 9, 0.5},
                 {2, 9, 0.5}, {12, 10, 0.5}, {2, 1, 0.75}, {9, 2, 0.75}, {3, 8, 0.75}};
  task.polygons = {{0, {0, 1, 2}}, {1, {3, 4, 5}}, {2, {1, 6, 2}}, {3, {7, 8, 9}}};
  return task;
}

zoo::Task concave() {
  zoo::Task task;
  task.width = 20, task.height = 16;
  task.points = {{2, 3, 0.25}, {7, 1, 0.5},  {13, 5, 0.25}, {13, 11, 0.75}, {7, 7, 0.5},
                 {2, 9, 0.25}, {1, 2, 0.75}, {18, 4, 0.25}, {10, 14, 0.5},  {9, 5, 0.5}};
  task.polygons = {{0, {0, 1, 2, 3, 4, 5}}, {1, {6, 9, 7, 8}}, {2, {0, 2, 3, 4}}, {3, {1, 8, 2, 5}}};
  return task;
}

std::string head(const zoo::Task& task, const char* number_format, const char* interpolation) {
  using nlohmann::ordered_json;
  ordered_json steps = ordered_json::array(), points = ordered_json::array(), polygons = ordered_json::array(),
               facets = ordered_json::array();
  int id = 0;
  for (const auto& [name, event] : std::vector<std::pair<const char*, const char*>>{{"clear", "buffers_clear"},
                                                                                    {"polygon", "polygon_begin"},
                                                                                    {"insert", "edge_table_insert"},
                                                                                    {"skip", "edge_table_skip"},
                                                                                    {"line", "scan_line_begin"},
                                                                                    {"retire", "edge_retire"},
                                                                                    {"step", "edge_step"},
                                                                                    {"swap", "edge_swap"},
                                                                                    {"enter", "edge_enter"},
                                                                                    {"span", "span_begin"},
                                                                                    {"z", "depth_interpolate"},
                                                                                    {"compare", "depth_compare"},
                                                                                    {"wz", "depth_write"},
                                                                                    {"wp", "pixel_write"}})
    steps.push_back({{"id", ++id}, {"name", name}, {"event", event}});
  for (const zoo::Point& p : task.points) points.push_back({p.x, p.y, p.z});
  for (const zoo::Polygon& polygon : task.polygons) {
    polygons.push_back({{"name", std::string(1, static_cast<char>('A' + polygon.number))},
                        {"color", fmt::format("#{:02x}72b2", 20 * polygon.number)}});
    facets.push_back({{"polygon", polygon.number}, {"points", polygon.corners}});
  }
  const ordered_json header{{"ztrace", 1},
                            {"writer", "a program"},
                            {"algorithm", "z-buffer"},
                            {"conventions",
                             {{"number_format", number_format},
                              {"interpolation", interpolation},
                              {"coverage", "top_left"},
                              {"nearer", "smaller"},
                              {"ties", "first"},
                              {"cull", false}}},
                            {"steps", steps},
                            {"scene",
                             {{"raster", {{"width", task.width}, {"height", task.height}}},
                              {"camera", {{"kind", "screen"}}},
                              {"points", points},
                              {"polygons", polygons},
                              {"facets", facets}}}};
  return header.dump() + "\n";
}

zoo::Task task_of(const Scene& scene) {
  const auto point = [](const auto& p) { return zoo::Point{p.x, p.y, p.z}; };
  zoo::Task task;
  task.width = scene.raster.width, task.height = scene.raster.height;
  for (const glm::dvec3& p : scene.points) task.points.push_back(point(p));
  for (const Facet& facet : scene.facets) {
    const auto first = scene.corners.begin() + facet.first_corner;
    const Color color = scene.polygons[static_cast<std::size_t>(facet.polygon)].color;
    task.polygons.push_back({facet.polygon,
                             {first, first + facet.corner_count},
                             {color.red / 255.0, color.green / 255.0, color.blue / 255.0}});
  }
  if (scene.surface) task.columns = scene.surface->columns;
  const Camera& camera = scene.camera;
  if (camera.kind == Camera::Kind::screen) return task;
  REQUIRE(camera.kind == Camera::Kind::perspective);  // the programs know no other
  const glm::dmat4 rows = glm::transpose(camera.view);
  task.camera = {true,     point(rows[0]), point(rows[1]), point(rows[2]), point(camera.eye), point(camera.view[3]),
                 camera.d, camera.window,  camera.near,    camera.far};
  return task;
}

namespace {

/// The first line that a command prints; "" where it cannot be run.
std::string first_line_of(const char* command) {
  std::string line;
  if (FILE* pipe = popen(command, "r")) {
    for (int c = std::fgetc(pipe); c != EOF && c != '\n'; c = std::fgetc(pipe)) line += static_cast<char>(c);
    pclose(pipe);
  }
  return line;
}

// Interpreters themselves, where the first one on the path only looks for it; "" where there is none.
const std::string& python_program() {
  static const std::string found = first_line_of("python3 -c 'import sys; print(sys.executable)' 2>/dev/null");
  return found;
}
const std::string& node_program() {
  static const std::string found = first_line_of("node -p process.execPath 2>/dev/null");
  return found;
}

/// As such programs read it (tools.py).
std::string given_as(const zoo::Task& task) {
  std::string given =
      fmt::format("{} {} {} {} {}\n", task.width, task.height, task.points.size(), task.polygons.size(), task.mistake);
  for (const zoo::Point& p : task.points) given += fmt::format("{} {} {}\n", p.x, p.y, p.z);
  for (const zoo::Polygon& polygon : task.polygons) given += fmt::format("{}\n", fmt::join(polygon.corners, " "));
  return given;
}

std::string printed_of(const char* file, const std::string& given) {
  const std::string interpreter = std::string_view(file).ends_with(".js") ? fmt::format("'{}'", node_program())
                                                                          : fmt::format("'{}' -B", python_program());
  const std::string path = (std::filesystem::temp_directory_path() / fmt::format("zstep_zoo_{}", getpid())).string();
  const std::string out = path + ".out";
  std::ofstream(path) << given;
  const int code =
      std::system(fmt::format("{} '{}' '{}' > '{}'", interpreter, in_checkout("tests/zoo/") + file, path, out).c_str());
  std::stringstream text;
  text << std::ifstream(out).rdbuf();
  std::filesystem::remove(path);
  std::filesystem::remove(out);
  REQUIRE(code == 0);
  return text.str();
}

}  // namespace

std::vector<std::string> printed_by_file(const char* file, std::span<const zoo::Task> tasks) {
  // A right run is asked for once for each mistake.
  static std::map<std::string, std::string> known;
  std::vector<std::string> keys, unknown;
  std::string given;
  for (const zoo::Task& task : tasks) {
    const std::string one = given_as(task);
    keys.push_back(std::string(file) + "\n" + one);
    if (known.count(keys.back()) > 0) continue;
    given += one, unknown.push_back(keys.back());
  }
  if (!unknown.empty()) {
    const std::string text = printed_of(file, given);
    std::size_t at = 0;
    for (const std::string& key : unknown) {
      const std::size_t end = text.find("\n\n", at);
      REQUIRE(end != std::string::npos);
      known[key] = text.substr(at, end + 1 - at), at = end + 2;
    }
    REQUIRE(at == text.size());
  }
  std::vector<std::string> printed;
  for (const std::string& key : keys) printed.push_back(known[key]);
  return printed;
}

std::string printed_by_file(const char* file, const zoo::Task& task) {
  return printed_by_file(file, {&task, 1}).front();
}

bool there_is_python() { return !python_program().empty(); }
bool there_is_node() { return !node_program().empty(); }

Scene scene_of(const zoo::Task& task) { return trace_of(head(task, "float64", "direct")).scene(); }

std::string head(const std::string& id, const Scene& scene, const Conventions& conventions) {
  return jsonl_header(header_for(method(id), conventions), scene) + "\n";
}

Trace trace_of(const std::string& text, std::string* impossible) {
  std::istringstream in(text);
  std::unique_ptr<Scene> kept;
  std::unique_ptr<TraceRecorder> recorder;
  const auto left = read_jsonl(
      in, "run.jsonl",
      [&](const Header& header, Scene scene) -> TraceRecorder& {
        kept = std::make_unique<Scene>(std::move(scene));
        recorder = std::make_unique<TraceRecorder>(header, *kept);
        return *recorder;
      },
      impossible);
  CHECK(!left);
  recorder->finish();
  return Trace::from_bytes(recorder->take_bytes(), "run.jsonl");
}

std::int64_t first_difference(const std::string& right, const std::string& wrong) {
  std::istringstream a(right), b(wrong);
  std::string one, other;
  for (std::int64_t line = 1;; ++line) {
    const bool more_a = static_cast<bool>(std::getline(a, one)), more_b = static_cast<bool>(std::getline(b, other));
    if (!more_a && !more_b) return 0;
    if (more_a != more_b || one != other) return line;
  }
}

std::int64_t shown_at(const Trace& run, std::int64_t step) {
  for (++step; step <= run.size(); ++step) {
    const Event event = run.event(step).event;
    if (holds<SpanBegin>(event) || holds<DepthInterpolate>(event) || holds<DepthCompare>(event) ||
        holds<PixelPaint>(event) || holds<RayEnd>(event))
      return step;
  }
  return run.size();
}

bool is_at(const diff::Cause& cause, const Trace& reference, const diff::Alignment& alignment, const Trace& right,
           std::int64_t step, std::int64_t shows) {
  if (!cause.first.only_a()) return step <= cause.first.b && cause.first.b <= shows;
  const std::int64_t before = alignment.before_in_b(cause.first.a);
  if (step - 1 <= before && before <= shows) return true;
  if (step > right.size()) return false;
  const Event missing = reference.event(cause.first.a).event, instead = right.event(step).event;
  const auto here = pixel_of(missing), there = pixel_of(instead);
  return here && there && here->x == there->x && here->y == there->y;
}

}  // namespace zstep::test
