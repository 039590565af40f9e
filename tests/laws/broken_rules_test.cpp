// Law: each rule of check is named at the step that breaks it. By table: a golden run, one edit of it, and where.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "tests/golden/golden.hpp"
#include "tests/golden/run_edits.hpp"
#include "traces/check/check.hpp"
#include "traces/events/fields.hpp"
#include "traces/formulas/situation.hpp"

namespace zstep {
namespace {

using Json = nlohmann::ordered_json;

struct BrokenRun {
  const char *rule, *golden, *edit;  ///< as test::with_edit takes it
  std::int64_t step;                 ///< at which the rule is broken
};
constexpr BrokenRun broken_runs[] = {
    {"area_case", "warnock", "drop intersecting 20", 134},
    {"box_decides", "warnock", "set contained 1 by_box=true", 26},
    {"box_entered", "ray-casting-facet", "set box_test 1 hit=true", 13},
    {"box_holds", "ray-casting-facet", "set hold 1 facet=1", 3},
    {"box_in_parent", "ray-casting-facet", "set box 2 parent=0", 4},
    {"box_is_tight", "ray-casting-facet", "set box 5 x_max=9.1", 10},
    {"box_is_tight", "ray-casting-grid", "set grid 1 x_max=9.1", 2},
    {"cell_holds", "ray-casting-grid", "set cell_hold 1 cell_x=0", 3},
    {"cell_is_next", "ray-casting-grid", "set cell 2 cell_x=0", 20},
    {"cross_beside", "floating-horizon-across", "set cross 1 x_at=-2.5", 162},
    {"cut_in_edge", "bsp", "set cut 1 t=-0.5", 53},
    {"edge_in_bucket", "scan-line", "set scan_line 1 y=0", 44},
    {"edge_left_behind", "painter-clipping", "drop retire_edge 1", 222},
    {"edge_left_behind", "bsp-walls", "set span 19 left_edge=1", 464},
    {"edge_left_behind", "cyclic", "drop retire_edge 3", 212},
    {"edge_missing", "edges", "drop enter_edge 8", 302},
    {"edge_moves_once", "cyclic", "set span 1 y=8", 41},
    {"edge_of_outline", "clipping", "set insert_edge 1 vertex_0=0", 106},
    {"edge_of_outline", "clipping", "set skip_edge 1 vertex_0=0", 107},
    {"edge_retires", "bsp-walls", "set retire_edge 20 edge=2", 466},
    {"edge_sorted", "transparency", "drop step_edge 2", 116},
    {"facet_of_polygon", "bsp", "set polygon 9 facet=0", 44},
    {"far_side_first", "bsp-walls", "set eye_side 6 node=5", 363},
    {"flip_own_edge", "scan-line", "set flip 1 edge=1", 46},
    {"hides_of_line", "hidden-line-clipping", "set hide 10 t_0=1.0", 411},
    {"hides_of_line", "wireframe", "set back 1 t_1=2.0", 27},
    {"horizon_moves_out", "floating-horizon", "set fill 1 upper=false", 244},
    {"ink_on_curve", "floating-horizon", "set draw 1 y=0", 157},
    {"kept_inside", "ray-casting-tree", "set hit 3 nearest=true", 70},
    {"line_is_next", "bsp", "repeat scan_line 14", 440},
    {"list_in_order", "scan-line-buffer", "drop swap_edges 1", 230},
    {"list_in_order", "scan-line", "drop step_edge 2", 51},
    {"list_is_whole", "painter-clipping", "swap insert 4", 203},
    {"list_is_whole", "depth-sort", "swap insert 8", 71},
    {"node_is_free", "bsp", "set node 10 front=true", 181},
    {"node_skip_side", "bsp", "set skip 1 front=false", 268},
    {"number_is_next", "ray-casting", "repeat ray 1", 3},
    {"number_is_next", "floating-horizon", "set curve 1 curve=1", 154},
    {"outline_is_closed", "delhi", "drop insert_edge 2", 8},
    {"outline_of_facet", "bsp", "drop corner 2", 4},
    {"outline_of_facet", "cyclic", "swap outline 3", 34},
    {"pair_has_span", "delhi", "set span 1 last=-1", 17},
    {"pair_in_list", "depth-sort", "drop drawn 1", 203},
    {"pixel_in_area", "warnock", "set paint 153 x=0", 293},
    {"pixel_in_span", "clipping", "set interpolate_z 1 x=0", 114},
    {"pixel_in_span", "with-attribute", "set attribute 1 x=0", 40},
    {"pixel_in_span", "bsp", "set paint 1 x=0", 303},
    {"pixel_in_span", "scan-line", "set winner 1 first=0", 53},
    {"point_in_both", "depth-sort", "set test_5 1 overlap=true", 82},
    {"ray_paints_own", "ray-casting", "set paint 1 x=0", 111},
    {"ray_paints_own", "ray-tracing-facet", "set color 1 x=0", 108},
    {"reject_is_right", "bsp", "drop polygon 9", 44},
    {"sample_inside", "half-space-samples", "drop sample 1", 16},
    {"sample_is_tested", "half-space-samples", "drop sample 2", 18},
    {"share_of_pixel", "scan-line-areas", "set cover 1 coverage=-0.75", 56},
    {"side_is_right", "bsp", "set vertex_side 1 side=\"crossing\"", 48},
    {"side_is_right", "bsp", "set side 10 side=\"crossing\"", 103},
    {"skip_is_right", "bsp", "set skip_edge 1 vertex_0=0", 296},
    {"span_is_filled", "delhi", "drop compare 1", 16},
    {"span_line", "bsp", "set span 1 y=0", 302},
    {"span_line", "scan-line", "set flags 1 y=0", 52},
    {"span_pairs", "delhi", "set span 1 left_edge=0", 12},
    {"swap_needed", "delhi", "swap step_edge 22", 246},
    {"test_of_pair", "depth-sort", "set test_3 2 piece=-1", 89},
    {"test_of_pair", "depth-sort", "drop pair 19", 272},
    {"test_of_pair", "depth-sort", "set test_5 1 other=0", 82},
    {"weights_inside", "half-space", "drop test 10", 22},
    {"win_is_written", "clipping", "drop write_depth 1", 117},
    {"win_is_written", "foley", "drop write_depth 49", 244},  // the last one of a span, before another on its line
    {"winner_inside", "scan-line", "set winner 1 piece=-1", 53},
    {"win_is_painted", "clipping", "drop write_pixel 1", 117},
    {"write_after_win", "clipping", "set compare 1 nearer=false", 116},
    {"write_after_win", "clipping", "set compare 1 nearer=false", 117},
    {"write_after_win", "with-attribute", "set compare 1 nearer=false", 40},
};

/// Of a golden run by its name.
test::RunLines golden_lines(const std::string& name) { return test::lines_of_run("tests/golden/" + name + ".jsonl"); }

/// Of runs that say nothing of how their pixels came about: of a golden run only these steps are left.
struct BrokenPixels {
  const char* rule;
  const char* golden;
  const char* edit;
  std::set<std::string> kept;
  std::int64_t step;
};
const std::set<std::string> compared{"clear", "polygon", "compare", "write_depth", "write_pixel"},
    written{"clear", "polygon", "write_pixel"};
const std::vector<BrokenPixels> broken_pixels{
    {"pixel_on_facet", "delhi", "set compare 1 x=7", compared, 3},
    {"pixel_is_drawn", "delhi", "drop compare 2", compared, 86},  // where the next polygon begins
    {"facet_is_drawn", "delhi", "drop polygon 1", compared, 133},
    {"back_is_dropped", "pyramid-view", "", compared, 28},  // its header says that backs are dropped
    {"nearest_is_kept", "delhi", "set write_pixel 40 x=2", written, 43},
    {"nearer_is_painted", "delhi", "drop write_pixel 2", written, 30},
};
test::RunLines left_of(const test::RunLines& run, const std::set<std::string>& kept) {
  test::RunLines left{run.front()};
  for (std::size_t line = 1; line < run.size(); ++line)
    if (kept.contains(Json::parse(run[line])["step"].get<std::string>())) left.push_back(run[line]);
  return left;
}

TEST_CASE("law: each rule of check is named at the step that breaks it") {
  std::set<std::string> named;
  for (const BrokenRun& broken : broken_runs) {
    CAPTURE(broken.rule);
    CAPTURE(broken.golden);
    CAPTURE(broken.edit);
    named.insert(broken.rule);
    const CheckReport report = check(test::trace_of_lines(test::with_edit(golden_lines(broken.golden), broken.edit)));
    const bool found = std::any_of(report.causes.begin(), report.causes.end(), [&](const Cause& cause) {
      return cause.first.rule && rule_text(*cause.first.rule).name == broken.rule && cause.first.step == broken.step;
    });
    CHECK(found);
  }
  for (const BrokenPixels& broken : broken_pixels) {
    CAPTURE(broken.rule);
    named.insert(broken.rule);
    const test::RunLines right = left_of(golden_lines(broken.golden), broken.kept);
    CHECK(check(test::trace_of_lines(right)).causes.empty());
    test::RunLines wrong = right;
    if (*broken.edit == 0) wrong[0].replace(wrong[0].find(R"("cull":false)"), 12, R"("cull":true)");
    else wrong = test::with_edit(right, broken.edit);
    const CheckReport report = check(test::trace_of_lines(wrong));
    REQUIRE_FALSE(report.causes.empty());
    std::string all;
    for (const Cause& cause : report.causes)
      all += (cause.first.rule ? std::string(rule_text(*cause.first.rule).name) : cause.first.field) + "@" +
             std::to_string(cause.first.step) + " ";
    CAPTURE(all);
    CHECK(all.find(broken.rule + ("@" + std::to_string(broken.step) + " ")) != std::string::npos);
  }
  for (std::size_t rule = 0; rule < static_cast<std::size_t>(formulas::Rule::count); ++rule) {
    const std::string name(rule_text(static_cast<formulas::Rule>(rule)).name);
    CAPTURE(name);
    CHECK(named.contains(name));
  }
}

/// The same value, but wrong by more than any rounding; null where that cannot be said. Of words, another one.
Json wrong(const Json& value, std::span<const std::string_view> words) {
  if (value.is_boolean()) return !value.get<bool>();
  if (value == "inf") return "nan";
  if (value.is_string() && words.size() > 1) return std::string(value == words[0] ? words[1] : words[0]);
  if (value.is_number_integer()) return value.get<std::int64_t>() + 1;
  if (value.is_number()) return value.get<double>() + 1 + std::abs(value.get<double>());
  return nullptr;
}

TEST_CASE("law: each field that a formula gives is doubted where it is wrong, at its step and by its name") {
  std::set<std::string> wanted;
  for (std::size_t kind = 0; kind < kind_count; ++kind)
    for (const FieldOfKind& field : fields_of_kind(kind))
      if (has(field.as, As::formula)) wanted.insert(fmt::format("{}.{}", kind_names()[kind], field.name));
  const std::size_t all = wanted.size();
  for (const auto& path : test::golden_files()) {
    if (wanted.empty()) break;
    const test::RunLines lines = golden_lines(path.stem().string());
    const Trace golden = test::trace_of_lines(lines);
    std::map<std::string, int> times;  // a few steps of a name in each golden run: not every one is judged
    for (std::size_t i = 1; i < lines.size(); ++i) {
      const Json line = Json::parse(lines[i]);
      const std::string kind(kind_names()[golden.event(static_cast<std::int64_t>(i)).event.index()]);
      for (const auto& item : line.items()) {
        const std::string field = item.key(), name = kind + "." + field;
        const Json& value = item.value();
        if (!wanted.contains(name)) continue;
        const auto described = field_of_kind(golden.event(static_cast<std::int64_t>(i)).event.index(), field);
        const Json other = wrong(value, described ? described->words : std::span<const std::string_view>{});
        if (other.is_null() || ++times[name + line.value("step", "")] > 12) continue;
        test::RunLines changed = lines;
        Json with = line;
        with[field] = other;
        changed[i] = with.dump();
        const CheckReport report = check(test::trace_of_lines(changed));
        if (std::any_of(report.causes.begin(), report.causes.end(), [&](const Cause& cause) {
              return cause.first.step == static_cast<std::int64_t>(i) && cause.first.field == field;
            }))
          wanted.erase(name);
      }
    }
  }
  std::string missed;
  for (const std::string& name : wanted) missed += name + " ";
  CAPTURE(missed);
  CHECK(wanted.empty());
  CHECK(all > 120);
}

}  // namespace
}  // namespace zstep
