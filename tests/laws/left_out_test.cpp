// Law: a step that a run never has is taken as not printed. Of every golden trace each kind of step is left out in
// turn, all of them, and nothing is wrong with what remains.
#include <algorithm>
#include <string>
#include <string_view>

#include <doctest/doctest.h>
#include <fmt/format.h>

#include "tests/golden/golden.hpp"
#include "tests/zoo/runs.hpp"
#include "traces/check/check.hpp"
#include "traces/events/fields.hpp"

namespace zstep {
namespace {

/// Kinds without which a run contradicts itself: in all golden traces that have them, or in those of this name.
struct Needed {
  std::string_view kind, golden, why;
};
constexpr Needed needed[] = {
    {"clip_cross", "", "outlines go through vertices that it alone makes"},
    {"split_vertex", "", "outlines go through vertices that it alone makes"},
    {"pass_begin", "", "what the light sees would be what the eye sees"},
    {"tables_begin", "transparency", "opaque polygons come one by one, and glass after them all at once"},
};

TEST_CASE("law: a run that leaves out a kind of step is not wrong") {
  int runs = 0;
  test::for_each_golden([&](const std::string& golden, const Trace& right) {
    for (std::size_t kind = 0; kind < kind_count; ++kind) {
      const std::string_view name = description_of_kind(kind).name;
      if (!right.has(static_cast<std::uint8_t>(kind))) continue;
      if (std::any_of(std::begin(needed), std::end(needed), [&](const Needed& one) {
            return one.kind == name && (one.golden.empty() || one.golden == golden);
          }))
        continue;
      ++runs;
      std::string text = test::jsonl_of(right), kept = text.substr(0, text.find('\n') + 1);
      std::size_t line = kept.size();
      for (std::int64_t step = 1; step <= right.size(); ++step) {
        const std::size_t end = text.find('\n', line) + 1;
        if (right.event(step).event.index() != kind) kept.append(text, line, end - line);
        line = end;
      }
      std::string impossible;
      const Trace run = test::trace_of(kept, &impossible);
      const CheckReport report = check(run);
      CAPTURE(golden);
      CAPTURE(name);
      CHECK(impossible == "");
      std::string wrong;
      for (const Cause& cause : report.causes)
        wrong += fmt::format("{} {}{} at {}; ", description_of_kind(cause.first.kind).name,
                             cause.first.rule ? rule_text(*cause.first.rule).name : std::string_view(cause.first.field),
                             cause.first.impossible, cause.first.step);
      CHECK(wrong == "");
    }
  });
  CHECK(runs > 500);
}

}  // namespace
}  // namespace zstep
