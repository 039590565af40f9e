// Laws of outlines that cross themselves: which parts of them are inside, by the even-odd and by the non-zero rule.
#include <doctest/doctest.h>

#include <random>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "algorithms/catalog/catalog.hpp"
#include "algorithms/scene/load.hpp"
#include "tests/golden/golden.hpp"
#include "tests/unit/algorithms/scenes.hpp"
#include "tests/zoo/runs.hpp"
#include "traces/check/check.hpp"
#include "traces/file/jsonl.hpp"
#include "traces/formulas/walk.hpp"

using namespace zstep;
using namespace zstep::test;

namespace {

/// How often the outline goes round a point, by the signed crossings of the line to its right.
int winding_of(const std::vector<glm::dvec3>& outline, double x, double y) {
  int winding = 0;
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const glm::dvec3 &from = outline[i], &to = outline[(i + 1) % outline.size()];
    const double side = (to.x - from.x) * (y - from.y) - (to.y - from.y) * (x - from.x);
    if (from.y <= y && y < to.y) winding += side > 0;
    if (to.y <= y && y < from.y) winding -= side < 0;
  }
  return winding;
}

/// Outlines of some vertices that no pixel's centre lies on, many of which cross themselves, and two that go round
/// twice. Loading would cut those whose parts cancel; here all are one facet.
std::vector<std::vector<glm::dvec3>> crossing_outlines() {
  std::vector<std::vector<glm::dvec3>> all{
      {{12.3, 1.2, 1}, {19.1, 22.4, 1}, {1.3, 9.2, 1}, {22.8, 9.1, 1}, {5.4, 22.7, 1}},
      {{2.2, 2.3, 1},
       {21.3, 2.4, 1},
       {21.1, 21.2, 1},
       {4.3, 20.6, 1},
       {4.7, 4.1, 1},
       {18.6, 4.2, 1},
       {18.2, 17.4, 1},
       {2.9, 18.7, 1}}};
  std::mt19937_64 random(7);
  for (int i = 0; i < 80; ++i) {
    auto& outline = all.emplace_back();
    const int count = 4 + static_cast<int>(random() % 4);
    for (int k = 0; k < count; ++k)
      outline.push_back({static_cast<double>(random() % 2300) / 100 + 0.3 + 1e-3,
                         static_cast<double>(random() % 2300) / 100 + 0.4 + 1e-3, 1});
  }
  return all;
}

Conventions filled(const char* rule) {
  Conventions conventions;
  conventions.cull = false;
  if (std::string_view(rule) != "even-odd") conventions.options["fill"] = rule;
  return conventions;
}

}  // namespace

TEST_CASE(
    "law: by the even-odd and the non-zero rule the Z-buffer and half-space draw what is inside, and are not doubted") {
  int differ = 0;
  for (const auto& outline : crossing_outlines()) {
    const Scene scene = screen_scene(24, 24, {outline});
    std::vector<Picture> by_rule;
    for (const char* rule : {"even-odd", "non-zero"}) {
      CAPTURE(rule);
      const Trace run = recorded_by("z-buffer", scene, filled(rule)),
                  other = recorded_by("half-space", scene, filled(rule));
      const Picture picture = formulas::end_of(run).picture;
      CHECK(picture.polygon == formulas::end_of(other).picture.polygon);
      int wrong = 0;
      for (std::int32_t y = 0; y < 24; ++y)
        for (std::int32_t x = 0; x < 24; ++x) {
          const int winding = winding_of(outline, x, y);
          const bool inside = std::string_view(rule) == "non-zero" ? winding != 0 : winding % 2 != 0;
          wrong += inside != (picture.polygon[picture.at(x, y)] == 0);
        }
      CHECK(wrong == 0);
      for (const Trace* one : {&run, &other}) {
        const CheckReport report = check(*one);
        CHECK(report.causes.empty());
        CHECK(report.coverage);
      }
      by_rule.push_back(picture);
    }
    differ += by_rule[0].polygon != by_rule[1].polygon;
  }
  CHECK(differ > 10);
}

TEST_CASE("a run that fills by the other rule is found, and the rule proposed") {
  int found = 0;
  for (const auto& outline : crossing_outlines()) {
    // What the last polygon of a run lacks may be cut off.
    const Scene scene = screen_scene(24, 24, {outline, {{1.2, 1.3, 2}, {6.1, 1.4, 2}, {1.3, 7.2, 2}}});
    for (const char* rule : {"even-odd", "non-zero"}) {
      const bool non_zero = std::string_view(rule) == "non-zero";
      const Trace run = recorded_by("half-space", scene, filled(rule)),
                  declared = recorded_by("half-space", scene, filled(non_zero ? "even-odd" : "non-zero"));
      if (formulas::end_of(run).picture.polygon == formulas::end_of(declared).picture.polygon) continue;
      std::string text = jsonl_header(declared.header(), scene) + "\n";
      run.each(0, run.size(), [&](std::int64_t, const RecordedEvent& event) {
        text += jsonl_event(run.header(), scene, event) + "\n";
        return true;
      });
      const Trace read = trace_of(text);
      const CheckReport report = check(read);
      CHECK(!report.causes.empty());
      const auto other = convention_it_follows(read, report);
      REQUIRE(other);
      CHECK(other->declared.front().key == "fill");
      CHECK(other->declared.front().word == rule);
      ++found;
    }
  }
  CHECK(found > 20);
}
