// The solution of a homework with one line of it made wrong: the report names the mistake.
#include <doctest/doctest.h>

#include <cstdlib>
#include <string>

#include <nlohmann/json.hpp>

#include "tests/cli/program.hpp"

using namespace zstep::test;
using nlohmann::json;

namespace {

struct Wrong {
  const char *line, *instead, *mistake;
};

constexpr Wrong wrong_lines[] = {
    {"nearer = z < depth[y][x]", "nearer = z > depth[y][x]", "compare_reversed"},
    {"nearer = z < depth[y][x]", "nearer = z <= depth[y][x]", "equal_wins"},
    {"dx_dy = (b[1] - a[1]) / (b[2] - a[2])", "dx_dy = (b[2] - a[2]) / (b[1] - a[1] or 1e9)", "slope_inverted"},
    {"dx_dy = (b[1] - a[1]) / (b[2] - a[2])", "dx_dy = (b[1] - a[1]) // (b[2] - a[2])", "slope_whole"},
    {"dz_dy = (b[3] - a[3])", "dz_dy = (b[1] - a[1])", "z_slope_of_x"},
    {"a, b = b, a", "a, b = (*b[:3], a[3]), (*a[:3], b[3])", "z_not_swapped"},
    {"min(height, math.ceil(b[2]))", "min(height, math.ceil(b[2]) + 1)", "ends_one_late"},
    {"max(0, math.ceil(a[2]))", "max(0, math.floor(a[2]))", "starts_one_early"},
    {"if edge[\"end\"] == y", "if edge[\"end\"] + 1 == y", "retired_one_late"},
    {"if edge[\"end\"] == y", "if edge[\"end\"] == -1", "never_retired"},
    {"min(width, math.ceil(right[\"x\"])) - 1", "min(width - 1, math.floor(right[\"x\"]) + 1)", "right_end_included"},
    {"max(0, math.ceil(left[\"x\"]))", "max(0, math.floor(left[\"x\"]) + 1)", "left_end_excluded"},
    {"max(0, math.ceil(left[\"x\"])), min(width, math.ceil(right[\"x\"]))",
     "max(0, int(left[\"x\"])), min(width, int(right[\"x\"]))", "ends_truncated"},
    {"max(0, math.ceil(left[\"x\"])), min(width, math.ceil(right[\"x\"]))",
     "max(0, math.floor(left[\"x\"] + 0.5)), min(width, math.floor(right[\"x\"] + 0.5))", "ends_rounded"},
    {"(x - left[\"x\"]) / across", "(x - first) / across", "z_not_to_centre"},
    {"(x - left[\"x\"]) / across", "(x + 1 - left[\"x\"]) / across", "z_stepped_before_use"},
    {"            depth[y][x] = z\n            emit.write_depth(x, y, z)\n", "", "depth_not_written"},
    {"            emit.write_pixel(x, y, polygon)", "        emit.write_pixel(x, y, polygon)", "colour_always"},
    {"            emit.write_pixel(x, y, polygon)", "            emit.write_pixel(y, x, polygon)", "x_y_exchanged"},
    {"        buckets = edge_table(",
     "        depth = [[math.inf] * width for _ in range(height)]\n        buckets = edge_table(", "buffer_reset"},
    {"    depth = [[math.inf] * width for _ in range(height)]\n    emit.clear(math.inf)",
     "    depth = [[0.0] * width for _ in range(height)]\n    emit.clear(0.0)", "buffer_begins_at_0"},
    {"depth = [[math.inf] * width for _ in range(height)]", "depth = [[math.inf] * width] * height",
     "buffer_of_one_line"},
};

bool in(const Folder& folder, const std::string& command) {
  return std::system(("cd '" + folder.path().string() + "' && " + command).c_str()) == 0;
}

}  // namespace

TEST_CASE("grade: a solution with one wrong line gets the name of the mistake") {
  if (std::system("python3 --version >/dev/null 2>&1") != 0) return;
  const Folder folder;
  REQUIRE(run(folder, "homework new z-buffer hw").code == 0);
  REQUIRE(in(folder, "mkdir runs"));
  const std::string solution = text_of(folder / "hw/solution/zbuffer.py");
  int right = 0, none = 0, wrong = 0;
  std::string table;
  for (const Wrong& one : wrong_lines) {
    CAPTURE(std::string(one.mistake));
    std::string program = solution;
    const std::size_t at = program.find(one.line);
    REQUIRE(at != std::string::npos);
    program.replace(at, std::string(one.line).size(), one.instead);
    write_text(folder / "hw/solution/wrong.py", program);
    for (const char* scene : {"scenes/triangle", "scenes/crossing", "scenes/neighbours", "hidden/overlap"})
      in(folder, std::string("python3 hw/solution/wrong.py hw/") + scene + ".txt > runs/$(basename " + scene +
                     ").jsonl 2>/dev/null");
    const json report = json::parse(run(folder, "grade --homework hw runs --format json").out);
    bool named = false;
    for (const json& task : report["scenes"]) {
      if (!task.contains("first")) continue;
      const std::string name = task.contains("mistake") ? task["mistake"]["id"].get<std::string>() : "";
      named = named || name == one.mistake;
      (name == one.mistake ? right : name.empty() ? none : wrong)++;
      if (name != one.mistake)
        table += std::string("\n") + one.mistake + ": " + (name.empty() ? "no name" : name) + " in " +
                 task["scene"].get<std::string>();
    }
    CHECK(named);
  }
  MESSAGE(right, " of ", right + none + wrong, " named rightly, ", none, " not, ", wrong, " wrongly", table);
  CHECK(right >= 0.95 * (right + none + wrong));
}
