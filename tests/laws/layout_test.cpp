// The house rules that a compiler does not see: which way includes point, what may lie where.
#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <fstream>
#include <regex>
#include <set>
#include <string>
#include <vector>

#include "tests/where.hpp"

namespace fs = std::filesystem;

namespace {

const fs::path root = zstep::test::in_checkout("");

std::vector<std::string> lines_of(const fs::path& path) {
  std::ifstream in(path);
  std::vector<std::string> lines;
  for (std::string line; std::getline(in, line);) lines.push_back(line);
  return lines;
}

bool is_code(const fs::path& path) {
  const std::string ext = path.extension().string();
  return ext == ".hpp" || ext == ".cpp" || ext == ".h" || ext == ".cc" || ext == ".c" || ext == ".def";
}

/// All files below a folder of the tree, as paths from the root with forward slashes.
std::vector<std::string> files_below(const std::string& folder) {
  std::vector<std::string> found;
  if (!fs::exists(root / folder)) return found;
  for (const fs::directory_entry& entry : fs::recursive_directory_iterator(root / folder))
    if (entry.is_regular_file()) found.push_back(fs::relative(entry.path(), root).generic_string());
  std::sort(found.begin(), found.end());
  return found;
}

std::string first_folder(const std::string& path) { return path.substr(0, path.find('/')); }

/// The name between the quotes or brackets of an #include line, with its opening sign; empty for every other line.
std::string included(const std::string& line) {
  std::size_t at = line.find_first_not_of(" \t");
  if (at == std::string::npos || line[at] != '#') return {};
  at = line.find_first_not_of(" \t", at + 1);
  if (at == std::string::npos || line.compare(at, 7, "include") != 0) return {};
  at = line.find_first_of("\"<", at);
  if (at == std::string::npos) return {};
  const std::size_t end = line.find_first_of("\">", at + 1);
  return end == std::string::npos ? std::string{} : line.substr(at, end - at);
}

/// Whether a file in the folder `from` may include one in the folder `to`: traces <- algorithms <- sim <- tests.
bool may_include(const std::string& from, const std::string& to) {
  static const std::array<std::string, 4> order{"traces", "algorithms", "sim", "tests"};
  const auto place = [](const std::string& folder) {
    return std::find(order.begin(), order.end(), folder) - order.begin();
  };
  return place(to) < 4 && place(from) < 4 && place(to) <= place(from);
}

/// What is wrong with one line of a file; empty if nothing is.
std::string offence(const std::string& file, const std::string& line) {
  const std::string name = included(line);
  if (name.empty()) return {};
  const std::string target = name.substr(1);
  if (name[0] == '"') {
    if (!fs::exists(root / target)) return "is not a path from the root of the repository";
    if (!may_include(first_folder(file), first_folder(target))) return "points against traces <- algorithms <- sim";
    return {};
  }
  const std::string folder = first_folder(file);
  const auto any_of = [&](std::initializer_list<const char*> starts) {
    return std::any_of(starts.begin(), starts.end(), [&](const char* start) { return target.rfind(start, 0) == 0; });
  };
  if (folder == "tests") return {};
  if (any_of({"SDL", "imgui"}) && file.rfind("sim/viewer/", 0) != 0) return "belongs to sim/viewer alone";
  if (any_of({"CLI/"}) && file.rfind("sim/cli/", 0) != 0) return "belongs to sim/cli alone";
  if (any_of({"OpenMesh"}) && file.rfind("algorithms/", 0) != 0) return "belongs to algorithms alone";
  return {};
}

}  // namespace

TEST_CASE("the law of includes tells right from wrong") {
  CHECK(included("  # include \"traces/scene.hpp\"  // why") == "\"traces/scene.hpp");
  CHECK(included("#include <vector>") == "<vector");
  CHECK(included("// #include <vector>").empty());
  CHECK(offence("algorithms/a.cpp", "#include \"traces/scene.hpp\"").empty());
  CHECK(offence("sim/a.cpp", "#include \"algorithms/catalog/catalog.hpp\"").empty());
  CHECK_FALSE(offence("traces/a.cpp", "#include \"algorithms/catalog/catalog.hpp\"").empty());
  CHECK_FALSE(offence("algorithms/a.cpp", "#include \"sim/viewer/viewer.hpp\"").empty());
  CHECK_FALSE(offence("sim/a.cpp", "#include \"tests/main.cpp\"").empty());
  CHECK_FALSE(offence("traces/events/a.cpp", "#include \"vocabulary.hpp\"").empty());
  CHECK_FALSE(offence("sim/cli/a.cpp", "#include <SDL.h>").empty());
  CHECK_FALSE(offence("sim/viewer/a.cpp", "#include <OpenMesh/Core/IO/MeshIO.hh>").empty());
  CHECK(offence("sim/viewer/draw/a.cpp", "#include <SDL.h>").empty());
}

TEST_CASE("includes point one way, from the root: traces <- algorithms <- sim") {
  int seen = 0;
  for (const char* folder : {"traces", "algorithms", "sim", "tests"})
    for (const std::string& file : files_below(folder)) {
      if (!is_code(file)) continue;
      int number = 0;
      for (const std::string& line : lines_of(root / file)) {
        ++number;
        if (included(line).empty()) continue;
        ++seen;
        const std::string wrong = offence(file, line);
        CHECK_MESSAGE(wrong.empty(), file, ":", number, ": ", line, " ", wrong);
      }
    }
  CHECK(seen > 100);
}

bool judges(std::string_view path) {
  if (path.starts_with('"')) path.remove_prefix(1);
  for (const char* part : {"check", "diff", "grade", "mistakes", "oracle"})
    if (path.starts_with(std::string("traces/") + part + "/")) return true;
  return false;
}

TEST_CASE("what a run leaves behind knows nothing of what judges it") {
  CHECK(judges(included("#include \"traces/check/check.hpp\"")));
  int seen = 0;
  for (const std::string& file : files_below("traces")) {
    if (!is_code(file) || judges(file)) continue;
    ++seen;
    for (const std::string& line : lines_of(root / file))
      CHECK_MESSAGE(!judges(included(line)), file, ": ", line, " is of zstep_judge, which is built on zstep_traces");
  }
  CHECK(seen > 50);
}

namespace {

/// Functions that a C library may round as it likes: what is called with one of them is not the same everywhere.
std::string platforms_own(const std::string& line) {
  const std::string code = line.substr(0, line.find("//"));
  static const std::regex call(
      R"(\bstd::(a?(?:sin|cos|tan)h?|atan2|exp2?|expm1|log(?:2|10|1p)?|pow|cbrt|hypot|[lt]gamma|erfc?)f?\b)"
      R"(|\bglm::(a?(?:sin|cos|tan)h?|exp2?|log2?|pow|rotate|perspective|frustum|angleAxis)\b)");
  std::smatch found;
  return std::regex_search(code, found, call) ? found.str() : std::string();
}

}  // namespace

TEST_CASE("what a trace holds is computed by portable functions alone") {
  CHECK(platforms_own("  return std::sin(x);") == "std::sin");
  CHECK(platforms_own("  one(\"exp\", std::exp);") == "std::exp");
  CHECK(platforms_own("  x = glm::rotate(m, a, axis);") == "glm::rotate");
  CHECK(platforms_own("  return portable::sin(x) + std::sqrt(y);  // not std::sin(x)").empty());
  CHECK(platforms_own("  std::rotate(first, middle, last);").empty());
  int seen = 0;
  for (const char* folder : {"traces", "algorithms"})
    for (const std::string& file : files_below(folder)) {
      if (!is_code(file) || file == "traces/math/portable_math.cpp") continue;
      ++seen;
      int number = 0;
      for (const std::string& line : lines_of(root / file)) {
        ++number;
        const std::string name = platforms_own(line);
        CHECK_MESSAGE(name.empty(), file, ":", number, ": take ", name, " from traces/math/portable_math.hpp");
      }
    }
  CHECK(seen > 200);
}

TEST_CASE("one library a folder, so that the linker sees what leans on what") {
  int targets = 0;
  for (const char* folder : {"traces", "algorithms", "sim"})
    for (const std::string& file : files_below(folder)) {
      if (fs::path(file).filename() != "CMakeLists.txt") continue;
      int here = 0;
      for (const std::string& line : lines_of(root / file))
        if (line.rfind("add_library(", 0) == 0) ++here;
      const int most = file == "traces/CMakeLists.txt" ? 2 : 1;  // the traces, and what judges them
      CHECK_MESSAGE(here <= most, file, " declares ", here, " libraries");
      targets += here;
    }
  CHECK(targets >= 3);
}

TEST_CASE("every file lies where the house has a room for it") {
  const std::set<std::string> rooms{"traces", "algorithms", "sim", "lessons", "tests", "docs", "out"};
  for (const fs::directory_entry& entry : fs::directory_iterator(root)) {
    const std::string name = entry.path().filename().string();
    if (entry.is_directory() && name[0] != '.' && name.rfind("build", 0) != 0)
      CHECK_MESSAGE(rooms.count(name) == 1, name, "/ is not a folder of the house");
    if (entry.is_regular_file()) CHECK_MESSAGE(!is_code(name), name, ": code belongs into a folder");
  }
  for (const char* folder : {"lessons", "docs"})
    for (const std::string& file : files_below(folder))
      CHECK_MESSAGE((!is_code(file) || file.starts_with("lessons/homework/")), file, ": no code among texts");
  for (const char* folder : {"traces", "algorithms", "sim"})
    for (const std::string& file : files_below(folder)) {
      const std::string stem = fs::path(file).stem().string();
      const bool snake = std::all_of(stem.begin(), stem.end(), [](char c) {
        return (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '_';
      });
      if (is_code(file)) CHECK_MESSAGE(snake, file, ": file names are snake_case");
    }
}

TEST_CASE("what a document links to in the tree is there") {
  std::vector<fs::path> documents;
  for (const fs::directory_entry& entry : fs::directory_iterator(root))
    if (entry.path().extension() == ".md") documents.push_back(entry.path());
  for (const std::string& file : files_below("docs"))
    if (fs::path(file).extension() == ".md") documents.push_back(root / file);
  int links = 0;
  for (const fs::path& document : documents) {
    std::string text;
    for (const std::string& line : lines_of(document)) text += line + "\n";
    for (std::size_t at = text.find("]("); at != std::string::npos; at = text.find("](", at + 1)) {
      const std::string target = text.substr(at + 2, text.find_first_of(")#", at + 2) - at - 2);
      if (target.empty() || target.find("://") != std::string::npos ||
          target.find_first_of(" \n(") != std::string::npos)
        continue;
      CAPTURE(document.string());
      CAPTURE(target);
      CHECK(fs::exists(document.parent_path() / target));
      ++links;
    }
  }
  CHECK(links > 10);
}

TEST_CASE("law: what C libraries compute differently is asked of none: pictures and traces are the same everywhere") {
  // Square roots, roundings and remainders are the same in all of them.
  const std::regex asks(
      R"(\bstd::(sin|cos|tan|a(sin|cos|tan2?)|(sin|cos|tan)h|exp2?|expm1|log(2|10|1p)?|pow|cbrt|hypot|[tl]gamma|erfc?)\()");
  // Dear ImGui's lines are as thick as the processor estimates (sim/viewer/draw/canvas.hpp).
  const std::regex strokes(R"(->(Add(Line|Polyline|Circle|CircleFilled|Ngon|NgonFilled|Ellipse|Bezier)|PathArcTo)\()");
  int files = 0;
  for (const char* folder : {"traces", "algorithms", "sim"})
    for (const std::string& path : files_below(folder)) {
      if (!is_code(path) || path.starts_with("traces/math/")) continue;
      ++files;
      int number = 0;
      for (const std::string& line : lines_of(root / path)) {
        ++number;
        CHECK_MESSAGE(!std::regex_search(line, asks), path, ":", number, ": take it of zstep::portable: ", line);
        CHECK_MESSAGE(!std::regex_search(line, strokes), path, ":", number, ": take stroke_line and its like: ", line);
      }
    }
  CHECK(files > 500);
}
