// Law: polygons that are drawn in another order than they must be are found at the first that comes too early, though
// every step is as it should be; and an order by which the picture and what it covers stay the same is right.
#include <doctest/doctest.h>

#include <cmath>
#include <map>
#include <set>
#include <sstream>
#include <utility>
#include <vector>

#include <nlohmann/json.hpp>

#include "tests/golden/golden.hpp"
#include "tests/zoo/runs.hpp"
#include "tests/zoo/wrong_programs.hpp"
#include "traces/grade/grade.hpp"

using namespace zstep;
using nlohmann::json;

namespace {

struct Drawn {
  std::string text;
  int polygon = 0;
  std::map<std::pair<int, int>, double> pixels;  ///< depths
};

/// A run of which nothing is left but what is drawn, and before it what that needs: how the order was found is left
/// out.
struct DrawnRun {
  std::string before;
  std::vector<Drawn> all;

  explicit DrawnRun(const std::string& text) {
    static const std::set<std::string> of_order{
        "insert", "pair",   "z_extents",      "test_1",         "test_2",      "test_3",
        "test_4", "test_5", "split",          "remove",         "take_out",    "move",
        "mark",   "drawn",  "test_3_swapped", "test_4_swapped", "insert_part", "eye_side"};
    std::istringstream lines(text);
    for (std::string line; std::getline(lines, line);) {
      const json step = json::parse(line);
      const std::string name = step["step"];
      if (name == "draw") all.push_back({line + "\n", step["polygon"], {}});
      else if (name == "paint") all.back().text += line + "\n", all.back().pixels[{step["x"], step["y"]}] = step["z"];
      else if (name == "clipping.outline" && !all.empty()) all.back().text += line + "\n";
      else if (!of_order.contains(name)) before += line + "\n";
    }
  }
  std::string text() const {
    std::string text = before;
    for (const Drawn& one : all) text += one.text;
    return text;
  }
  /// The step by which this one is begun.
  std::int64_t step_of(std::size_t which) const {
    std::string earlier = before;
    for (std::size_t i = 0; i < which; ++i) earlier += all[i].text;
    return std::count(earlier.begin(), earlier.end(), '\n') + 1;
  }
  std::map<std::pair<int, int>, int> picture() const {
    std::map<std::pair<int, int>, int> seen;
    for (const Drawn& one : all)
      for (const auto& [pixel, z] : one.pixels) seen[pixel] = one.polygon;
    return seen;
  }
};

/// Do these two share a pixel where one is nearer?
bool cover(const Drawn& one, const Drawn& other) {
  for (const auto& [pixel, z] : one.pixels)
    if (const auto found = other.pixels.find(pixel); found != other.pixels.end() && std::abs(found->second - z) > 1e-9)
      return true;
  return false;
}

}  // namespace

TEST_CASE("order: of two neighbours that change places, the first is found where they share pixels, and only there") {
  int wrong = 0, free = 0;
  for (const char* method : {"depth-sort", "bsp"})
    for (const test::WrongPrograms& programs : test::wrong_programs(method))
      for (const Scene& scene : programs.scenes) {
        CAPTURE(std::string(method));
        CAPTURE(scene.name);
        const DrawnRun right(test::printed_by(programs.program, scene, ""));
        const Trace reference = test::recorded_by(method, scene, test::conventions_of(programs.program));
        for (std::size_t first = 0; first + 1 < right.all.size(); ++first) {
          DrawnRun other = right;
          std::swap(other.all[first], other.all[first + 1]);
          if (other.all[first].polygon == other.all[first + 1].polygon) continue;
          const Trace run = test::trace_of(test::head_of(programs.program, scene) + other.text());
          const grade::Judgement found = grade::judge(reference, run, {});
          const bool matters = cover(other.all[first], other.all[first + 1]) || other.picture() != right.picture();
          CAPTURE(first);
          CHECK_MESSAGE(found.first.has_value() == matters, (found.first ? test::said_of(*found.first) : "nothing"));
          if (!found.first || !matters) {
            ++free;
            continue;
          }
          ++wrong;
          CHECK(found.first->step == other.step_of(first));
          REQUIRE(found.first->too_early);
          CHECK(found.first->too_early->before == other.step_of(first + 1));
        }
      }
  MESSAGE(wrong, " orders are wrong, ", free, " are free");
  CHECK(wrong > 20);
  CHECK(free > 30);
}

TEST_CASE("order: what is drawn backwards is found, and a program that draws later than it decides is right") {
  for (const test::WrongPrograms& programs : test::wrong_programs("depth-sort")) {
    for (const Scene& scene : programs.scenes) {
      CAPTURE(scene.name);
      DrawnRun run(test::printed_by(programs.program, scene, ""));
      const Trace reference = test::recorded_by("depth-sort", scene, test::conventions_of(programs.program));
      const auto judged = [&] {
        return grade::judge(reference, test::trace_of(test::head_of(programs.program, scene) + run.text()), {});
      };
      const grade::Judgement right = judged();
      CHECK_MESSAGE(!right.first, test::said_of(*right.first));
      const auto picture = run.picture();
      std::reverse(run.all.begin(), run.all.end());
      if (picture != run.picture()) CHECK(judged().first);
    }
  }
}
