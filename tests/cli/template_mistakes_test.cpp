// Homeworks that come with zstep, with one line of the solution made wrong: each loses points, at the step that it is
// about, and the mistake is named where the catalogue has it.
#include <doctest/doctest.h>

#include <set>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "tests/cli/program.hpp"

using namespace zstep::test;
using nlohmann::json;

namespace {

struct WrongLine {
  std::string right, wrong;
  std::string step;     ///< the first that is wrong
  std::string mistake;  ///< as the catalogue calls it; empty where it has none
};

const std::vector<WrongLine> horizon_lines{
    {"    emit.view_vertex(", "    z_v = -z_v\n    emit.view_vertex(", "view_vertex", "depth_axis_reversed"},
    {"(far + near - 2 * far * near / z_v) / (far - near)", "z_v", "project", "z_v_for_depth"},
    {"d * x_v / z_v, d * y_v / z_v", "d * x_v, d * y_v", "project", "no_divide"},
    {"(window_y - y_p)", "(window_y + y_p)", "to_viewport", "y_upside_down"},
    {"* width - 0.5\n    y_s = (window_y - y_p) / (2 * window_y) * height - 0.5",
     "* width\n    y_s = (window_y - y_p) / (2 * window_y) * height", "to_viewport", "centres_half_off"},
    {"if view[2][1] < 0", "if view[2][1] > 0", "move", "farthest_first"},
    {"a[1] + (b[1] - a[1]) * (x - a[0]) / (b[0] - a[0])", "a[1]", "test", "not_interpolated"},
    {"\"below\" if y >= lower else \"hidden\"", "\"hidden\"", "test", "only_upper"},
    {"if y > lower:", "if False:", "move", "lower_never_moves"},
    {"t = d_0 / (d_0 - d_1)", "t = d_1 / (d_1 - d_0)", "cross", "crossing_from_end"},
    {"\"below\": (213, 94, 0)", "\"below\": (0, 0, 0)", "draw", "one_ink"},
};

const std::vector<WrongLine> scan_line_lines{
    {"-(a * x + b * y + c * z)", "a * x + b * y + c * z", "plane", "plane_d_sign"},
    {"dx_dy = (b[1] - a[1]) / (b[2] - a[2])", "dx_dy = (b[2] - a[2]) / (b[1] - a[1] or 1e9)", "insert_edge",
     "slope_inverted"},
    {"math.ceil(b[2])\n", "math.ceil(b[2]) + 1\n", "insert_edge", "ends_one_late"},
    {"a, b = b, a", "a, b = (*b[:3], a[3]), (*a[:3], b[3])", "insert_edge", "z_not_swapped"},
    {"if edge[\"end\"] == y", "if edge[\"end\"] + 1 == y", "flags", "retired_one_late"},
    {"while i > 0 and", "while False and", "flags", "not_sorted"},
    {"        inside = []",
     "        active = [e for i, e in enumerate(active)\n"
     "                  if i == 0 or (e[\"x\"], e[\"polygon\"]) !=\n"
     "                  (active[i - 1][\"x\"], active[i - 1][\"polygon\"])]\n"
     "        inside = []",
     "flip", "flag_missed"},
    {"math.ceil(right) - 1", "math.floor(right)", "flags", "right_end_included"},
    {"depths[polygon] = self.depth(polygon, x, y)\n                emit.depth(polygon, x, y, depths[polygon])",
     "depths[polygon] = -self.depth(polygon, x, y)\n                emit.depth(polygon, x, y, -depths[polygon])",
     "winner", "wrong_of_two"},
    {"if d_1 < -TIE:", "if False:", "winner", "implied_edge_missed"},
    {"emit.paint(x, y, self.depth(polygon, x, y)", "emit.paint(x, y, self.depth(polygon, first, y)", "paint", "z_kept_along_span"},
};

void each_is_found(const std::string& method, const std::string& program, const std::vector<WrongLine>& lines) {
  const Folder folder;
  if (shell(folder, "python3 --version").code != 0) return;
  REQUIRE(run(folder, "homework new " + method + " hw").code == 0);
  const std::string right = text_of(folder / ("hw/solution/" + program));
  for (const WrongLine& line : lines) {
    CAPTURE(line.wrong);
    REQUIRE(times(right, line.right) == 1);
    std::string wrong = right;
    wrong.replace(wrong.find(line.right), line.right.size(), line.wrong);
    write_text(folder / ("hw/solution/" + program), wrong);
    shell(folder, "rm -rf runs; mkdir runs; for s in hw/scenes/*.txt hw/hidden/*.txt; do python3 hw/solution/" +
                      program + " $s > runs/$(basename $s .txt).jsonl; done");
    const json report = json::parse(run(folder, "grade --homework hw runs --format json").out);
    REQUIRE(report["gradable"] == true);
    CHECK(report["points"].get<double>() < report["of"].get<double>());
    std::set<std::string> mistakes;
    std::string step, names;
    for (const json& scene : report["scenes"]) {
      if (!scene.contains("first")) continue;
      if (step.empty()) step = scene["first"]["step"].get<std::string>();
      mistakes.insert(scene.contains("mistake") ? scene["mistake"]["id"].get<std::string>() : "");
    }
    for (const std::string& name : mistakes) names += (names.empty() ? "" : ",") + name;
    CHECK(step == line.step);
    CHECK(names == line.mistake);
  }
}

}  // namespace

TEST_CASE("templates: each wrong line of a floating horizon is found where it is") {
  each_is_found("floating-horizon", "horizon.py", horizon_lines);
}

TEST_CASE("templates: each wrong line of a scan-line program is found where it is") {
  each_is_found("scan-line", "scanline.py", scan_line_lines);
}
