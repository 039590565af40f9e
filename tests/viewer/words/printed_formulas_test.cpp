// The law of formulas: what is printed is evaluated as it stands on the line, and must give the number behind it; and
// that number must be the event's own.
#include <algorithm>
#include <cmath>
#include <map>
#include <string>
#include <vector>

#include <doctest/doctest.h>

#include "sim/words/explain.hpp"
#include "tests/golden/golden.hpp"
#include "tests/viewer/words/printed.hpp"
#include "traces/replay/replay.hpp"

using namespace zstep;
using namespace zstep::test;

namespace {

/// Is the number behind this name one of the event's fields that the name may stand for? A name that none of them has
/// is an operand's.
bool is_field(const std::map<std::string, double>& fields, std::string name, const std::string& number) {
  static const std::map<std::string, std::string> others = {{"1/m", "dx_dy"},
                                                            {"dz/dy", "dz_dy"},
                                                            {"dz/dx", "dz_dx"},
                                                            {"the value", "value"},
                                                            {"first scan line", "first_row"},
                                                            {"leaves at y", "end_row"},
                                                            {"z*", "z"},
                                                            {"z_v", "z"}};
  if (const std::size_t after = name.rfind(": "); after != std::string::npos) name = name.substr(after + 2);
  if (const std::size_t of = name.find(" of "); of != std::string::npos) name = name.substr(0, of);
  const auto known = others.find(name);
  const std::string wanted = known == others.end() || fields.contains(name) ? name : known->second;
  const auto named = [&](const auto& field) { return field.first == wanted || field.first.starts_with(wanted + "_"); };
  return std::none_of(fields.begin(), fields.end(), named) ||
         std::any_of(fields.begin(), fields.end(),
                     [&](const auto& field) { return named(field) && shown_as(field.second, number); });
}

}  // namespace

TEST_CASE(
    "law: what is printed as a formula gives, when it is evaluated, the number behind it, and that is the event's") {
  std::map<std::string, int> evaluated;  // of each kind
  test::for_each_golden([&](const std::string& name, const Trace& trace) {
    CAPTURE(name);
    Replay replay(trace);
    while (replay.position() < trace.size()) {
      replay.step_forward();
      const Event event = replay.current()->event;
      const Explanation told = explain(trace, replay.state(), *replay.current());
      const auto step = replay.position();
      const std::string kind(
          visit_event([](const auto& known) { return description_of<std::decay_t<decltype(known)>>.name; }, event));
      CAPTURE(step);
      for (const std::string& line : told.formulas) {
        CAPTURE(line);
        const std::vector<std::string> sides = parts(line, " = ");
        for (std::size_t k = 1; k + 1 < sides.size(); ++k) {
          const auto formula = read(sides[k]), result = read(sides[k + 1]);
          if (!formula || !formula->computes || !result) continue;
          const bool meets = formula->value.low <= result->value.high && result->value.low <= formula->value.high;
          REQUIRE(meets);
          if (std::isinf(formula->value.high)) continue;
          ++evaluated[kind];
          REQUIRE(is_field(fields_by_name(event), sides[0], sides[k + 1]));
        }
        // "z < zbuffer[x,y]:  5 < 7  is true"
        const std::size_t colon = line.find(":  "), is = line.find("  is ");
        if (colon == std::string::npos || is == std::string::npos) continue;
        const std::string test = line.substr(colon + 3, is - colon - 3);
        for (const std::string sign : {" < ", " \u2264 ", " \u2265 "}) {
          const std::vector<std::string> both = parts(test, sign);
          if (both.size() != 2) continue;
          const auto left = number_of(both[0]), right = number_of(both[1]);
          REQUIRE((left && right));
          REQUIRE(so(*left, sign.substr(1, sign.size() - 2), *right) == (line.substr(is + 5) == "true"));
          ++evaluated[kind];
        }
      }
    }
  });
  for (const char* kind : {"view_transform", "projection",   "viewport_transform", "clip_cross",    "edge_table_insert",
                           "edge_step",      "span_begin",   "depth_interpolate",  "depth_compare", "pixel_paint",
                           "plane_depth",    "implied_edge", "vertex_side",        "eye_side",      "split_vertex",
                           "ray_plane",      "ray_hit",      "horizon_test",       "horizon_cross", "line_cross"}) {
    CAPTURE(kind);
    CHECK(evaluated[kind] > 0);
  }
}
