// Law: in any golden trace, one value of one step changed, or one step left out, is named by `check` or `diff` as the
// first cause, at its step. What neither can notice, or only at a later step, is listed with the reason.
#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <functional>
#include <map>
#include <random>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "tests/golden/golden.hpp"
#include "tests/sparse.hpp"
#include "traces/check/check.hpp"
#include "traces/diff/diff.hpp"
#include "traces/events/fields.hpp"
#include "traces/events/slots.hpp"
#include "traces/file/check_events.hpp"
#include "traces/record/trace_recorder.hpp"

using namespace zstep;

namespace {

enum class Change : std::uint8_t { digit, sign, neighbour, whole, other, no_such, verdict, left_out, count };
constexpr std::array<const char*, 8> change_words{"a digit from the ninth upwards",
                                                  "its sign",
                                                  "a neighbour's value",
                                                  "a whole number beside it",
                                                  "another step's number",
                                                  "a number that nothing has",
                                                  "another verdict",
                                                  "left out"};

/// What shows nowhere, or only at a later step. A name alone is a step that is left out.
struct Undetectable {
  std::string_view name, reason;
};
constexpr std::string_view silent = "a program may pass over in silence what it does nothing with",
                           alike = "of several steps about one thing, as of two parts of a polygon, the last is missed",
                           idle = "an edge that ends may be moved once more, or not",
                           later = "what a list lacks, or that it is out of order, shows where the list is used",
                           shared = "any point that two pieces share will do",
                           either = "edges at one x may stand either way",
                           nothing = "whether a span without pixels is spoken of changes nothing";
constexpr std::array undetectable{
    Undetectable{"clip_test", alike},
    Undetectable{"clip_cross.vertex",
                 "a number that is given to something new shows at the first step that asks for it"},
    Undetectable{"color_write", alike},
    Undetectable{"edge_enter.place", either},
    Undetectable{"edge_step", idle},
    Undetectable{"edge_step.edge", idle},
    Undetectable{"edge_swap", later},
    Undetectable{"edge_swap.place", later},
    Undetectable{"edge_table_insert", alike},
    Undetectable{"edge_table_insert.edge",
                 "a number that is given to something new shows at the first step that asks for it"},
    Undetectable{"edge_table_skip", alike},
    Undetectable{"extent_test", alike},
    Undetectable{"horizon_move", alike},
    Undetectable{"horizon_move.upper", alike},
    Undetectable{"horizon_test", alike},
    Undetectable{"line_piece", alike},
    Undetectable{"list_remove.piece", alike},
    Undetectable{"outline_vertex", alike},
    Undetectable{"outline_vertex.vertex", alike},
    Undetectable{"overlap_test.x_at", shared},
    Undetectable{"overlap_test.y_at", shared},
    Undetectable{"pair_begin.other", alike},
    Undetectable{"piece_make", alike},
    Undetectable{"plane_depth", alike},
    Undetectable{"polygon_begin", silent},
    Undetectable{"polygon_begin.facet", "which facet of its polygon is meant shows at its first test"},
    Undetectable{"polygon_reject", silent},
    Undetectable{"saved", alike},
    Undetectable{"scan_line_begin", alike},
    Undetectable{"scan_line_begin.y", alike},
    Undetectable{"side_test", alike},
    Undetectable{"span_begin", "one without pixels changes nothing; of two facets' on one line the last is missed"},
    Undetectable{"span_begin.dz_dx", "the slope of a span without width says nothing"},
    Undetectable{"span_flags", nothing},
    Undetectable{"span_winner", alike},
    Undetectable{"vertex_side", alike},
    Undetectable{"vertex_side.vertex", alike},
};
std::string_view reason_for(const std::string& name) {
  const auto found =
      std::find_if(undetectable.begin(), undetectable.end(), [&](const Undetectable& one) { return one.name == name; });
  return found == undetectable.end() ? std::string_view{} : found->reason;
}

/// One run, taken apart.
struct TakenApart {
  const Trace& trace;
  std::vector<RecordedEvent> events = {};
  std::array<std::vector<std::size_t>, kind_count> by_kind = {};
  std::vector<std::uint8_t> kinds = {};

  explicit TakenApart(const Trace& whole) : trace(whole) {
    trace.each(0, trace.size(), [&](std::int64_t, const RecordedEvent& event) {
      by_kind[event.event.index()].push_back(events.size());
      events.push_back(event);
      return true;
    });
    for (std::size_t kind = 0; kind < kind_count; ++kind)
      if (!by_kind[kind].empty()) kinds.push_back(static_cast<std::uint8_t>(kind));
  }
  /// Half of the time any step, else one of any kind: what a run does once must be tried as well.
  std::size_t any_step(std::mt19937_64& random) const {
    if (random() % 2 == 0) return random() % events.size();
    const auto& of_kind = by_kind[kinds[random() % kinds.size()]];
    return of_kind[random() % of_kind.size()];
  }
  /// The next step of its kind, or the one before.
  std::size_t neighbour(std::size_t step) const {
    const auto& of_kind = by_kind[events[step].event.index()];
    const auto next = std::upper_bound(of_kind.begin(), of_kind.end(), step);
    return next != of_kind.end() ? *next : of_kind.size() > 1 ? of_kind[of_kind.size() - 2] : step;
  }
  std::size_t any_of_kind(std::size_t step, std::mt19937_64& random) const {
    const auto& of_kind = by_kind[events[step].event.index()];
    return of_kind[random() % of_kind.size()];
  }
  Trace with(std::size_t step, const Event* instead) const {
    TraceRecorder recorder(trace.header(), trace.scene());
    for (std::size_t i = 0; i < events.size(); ++i) {
      if (i != step) record_any(recorder, events[i].step, events[i].event);
      else if (instead) record_any(recorder, events[i].step, *instead);
    }
    recorder.finish();
    return Trace::from_bytes(recorder.take_bytes(), "changed");
  }
};

/// Changes a value of the step; its name, "kind.field", or "" where it has none that can be changed so.
std::string change(Event& event, Change how, const TakenApart& run, std::size_t step, std::mt19937_64& random) {
  std::vector<std::pair<std::string_view, std::function<void()>>> ways;
  const Event& beside = run.events[run.neighbour(step)].event;
  const Event& any = run.events[run.any_of_kind(step, random)].event;
  std::string_view kind;
  visit_event(
      [&]<class E>(E& e) {
        kind = description_of<E>.name;
        for_each_index<E>([&]<std::size_t I>() {
          constexpr auto member = field_at<E, I>.member;
          using Value = FieldValue<E, I>;
          Value& value = e.*member;
          const auto way = [&](std::function<void()> make) { ways.emplace_back(field_at<E, I>.name, std::move(make)); };
          const auto take = [&](const Event& from) {
            if (const Value its = get<E>(from).*member; its != value && its == its) way([&value, its] { value = its; });
          };
          if constexpr (std::is_same_v<Value, double>) {
            if (!std::isfinite(value)) return;
            if (how == Change::digit)
              way([&] {
                const double off = std::pow(10.0, -static_cast<double>(random() % 9));
                value += (random() % 2 ? off : -off) * std::max(std::abs(value), 1e-3);
              });
            if (how == Change::sign && value != 0) way([&] { value = -value; });
            if (how == Change::neighbour && std::abs(get<E>(beside).*member - value) > 1e-8 * std::abs(value))
              take(beside);
          } else if constexpr (std::is_same_v<Value, std::int32_t>) {
            if (how == Change::whole) way([&] { value += random() % 2 ? -1 : 1; });
            if (how == Change::neighbour) take(beside);
            if (how == Change::other) take(any);
            if (how == Change::no_such) way([&] { value = 1'000'000; });
          } else if constexpr (std::is_same_v<Value, bool>) {
            if (how == Change::verdict) way([&] { value = !value; });
          } else if (how == Change::verdict) {
            way([&] {
              constexpr std::size_t words = words_of<Value>.size();
              value = static_cast<Value>((static_cast<std::size_t>(value) + 1 + random() % (words - 1)) % words);
            });
          }
        });
      },
      event);
  if (ways.empty()) return "";
  const auto& [field, apply] = ways[random() % ways.size()];
  apply();
  return fmt::format("{}.{}", kind, field);
}

/// Can it be read at all? `check` names the line where not, and what is before it is right.
bool can_be_read(const Event& event, const Scene& scene) {
  EventCheck check(scene);
  return visit_event([&](const auto& e) { return check(e).empty(); }, event);
}

struct Counts {
  int changes = 0, refused = 0, by_check = 0, by_diff = 0, once = 0;
};

TEST_CASE("law: what is changed anywhere in a golden trace is the first cause, at its step") {
  constexpr int changes_a_trace = 200 / (test::sparse * test::sparse);
  const char* given = std::getenv("ZSTEP_SEED");  // for other draws, by hand
  std::mt19937_64 random(given ? std::strtoull(given, nullptr, 10) : 16);
  Counts all;
  std::map<std::string, std::pair<int, std::string>> unnoticed;  // by field: how often, and the last one
  test::for_each_golden([&](const std::string& golden, const Trace& trace) {
    const TakenApart run(trace);
    for (int made = 0, tries = 0; made < changes_a_trace && tries < 10 * changes_a_trace; ++tries) {
      const auto how = static_cast<Change>(random() % static_cast<std::size_t>(Change::count));
      const std::size_t step = run.any_step(random);
      Event event = run.events[step].event;
      std::string field;
      if (how == Change::left_out)
        field = visit_event([]<class E>(const E&) { return std::string(description_of<E>.name); }, event);
      else field = change(event, how, run, step, random);
      if (field.empty()) continue;
      ++made, ++all.changes;
      if (!can_be_read(event, trace.scene())) {
        ++all.refused;
        continue;
      }
      const auto at = static_cast<std::int64_t>(step) + 1;
      const Trace wrong = run.with(step, how == Change::left_out ? nullptr : &event);
      const CheckReport report = check(wrong);
      if (!report.causes.empty() && report.causes.front().first.step == at) {
        ++all.by_check;
        continue;
      }
      const diff::DiffReport parts = diff::compare(trace, wrong);
      const diff::Cause* cause = parts.causes.empty() ? nullptr : &parts.causes.front();
      if (cause && (cause->first.a == at || cause->first.b == at)) {
        ++all.by_diff;
        continue;
      }
      if (how == Change::left_out && run.by_kind[event.index()].size() == 1) {
        ++all.once;
        continue;
      }
      ++unnoticed[field].first;
      unnoticed[field].second = fmt::format(
          "{}, at step {} of {}, where check names {} and diff {}", change_words[static_cast<std::size_t>(how)], at,
          golden, report.causes.empty() ? "nothing" : fmt::format("step {}", report.causes.front().first.step),
          cause ? fmt::format("step {} for {}", cause->first.b, cause->first.a) : "nothing");
    }
  });
  const int named = all.refused + all.by_check + all.by_diff;
  MESSAGE("of ", all.changes, " changes ", named, " are named: ", all.refused, " cannot be read, ", all.by_check,
          " by check, ", all.by_diff, " by diff alone; ", all.once,
          " leave out what a run does once only, which it may as well never say");
  for (const auto& [field, which] : unnoticed) {
    const std::string_view reason = reason_for(field);
    MESSAGE(which.first, " x ", field, " (", which.second, "): ", std::string(reason.empty() ? "UNKNOWN" : reason));
    if (reason.empty()) FAIL_CHECK(field << " goes unnoticed: " << which.second);
  }
  CHECK(all.changes >= 50 * changes_a_trace);                      // 10,000 without sanitizers
  CHECK(named >= (test::sparse > 1 ? 0.97 : 0.98) * all.changes);  // of fewer, luck has a larger share
}

/// What `check` may pass over although a formula gives it, and why.
constexpr std::array passed_over{
    Undetectable{"area_bin.corners_inside", "what only touches an area may be counted either way"},
    Undetectable{"box_make", "a box may be larger than what it holds, as long as its sides go through points"},
    Undetectable{"color_blend", "a shade may be rounded either way"},
    Undetectable{"color_write", "a shade may be rounded either way"},
    Undetectable{"depth_compare.z", "a neighbour's depth may be as near as rounding"},
    Undetectable{"depth_interpolate.z", "a neighbour's depth may be as near as rounding"},
    Undetectable{"depth_write.z", "a neighbour's depth may be as near as rounding"},
    Undetectable{"edge_step.z_edge", "a neighbour's depth may be as near as rounding"},
    Undetectable{"edge_table_insert.dz_dy", "a neighbour's depth may be as near as rounding"},
    Undetectable{"edge_table_insert.z_edge", "a neighbour's depth may be as near as rounding"},
    Undetectable{"edge_table_skip.why", "a horizontal edge is also one between two rows"},
    Undetectable{"line_hide", "a face may hide a line up to any place where its edges cross it"},
    Undetectable{"line_piece", "parts of a line may be cut at any end of what hides it"},
    Undetectable{"plane_equation", "a number so near 0 has no sign that counts"},
    Undetectable{"ray_begin", "a number so near 0 has no sign that counts"},
    Undetectable{"ray_hit", "a number so near 0 has no sign that counts"},
    Undetectable{"ray_plane", "a number so near 0 has no sign that counts"},
    Undetectable{"side_test.greatest", "what lies on a plane is as near to it as rounding lets it be"},
    Undetectable{"side_test.least", "what lies on a plane is as near to it as rounding lets it be"},
    Undetectable{"span_begin.dz_dx", "a number so near 0 has no sign that counts"},
    Undetectable{"span_winner.last", "an interval may be told in parts"},
    Undetectable{"vertex_side.value", "a number so near 0 has no sign that counts"},
};
bool may_be_passed_over(const std::string& field) {
  return std::any_of(passed_over.begin(), passed_over.end(), [&](const Undetectable& one) {
    return field == one.name || field.substr(0, field.find('.')) == one.name;
  });
}

TEST_CASE("law: what a step computes is judged by check, or listed as not judged, field by field") {
  constexpr int of_a_field = 6 / test::sparse, tries_a_trace = 1500 / (test::sparse * test::sparse);
  std::map<std::string, std::pair<int, std::string>> neither, passed;  // by field: how often, and the last one
  int tried = 0, noticed = 0, listed = 0;
  test::for_each_golden([&](const std::string& golden, const Trace& trace) {
    const TakenApart run(trace);
    std::map<std::string, int> made;
    std::mt19937_64 random(golden.size());  // of its own, so that another golden run changes nothing
    for (int tries = 0; tries < tries_a_trace; ++tries) {
      // By more than any rounding: a change of digits may be none that counts.
      const auto how = static_cast<Change>(1 + random() % (static_cast<std::size_t>(Change::left_out) - 1));
      const auto& of_kind = run.by_kind[run.kinds[random() % run.kinds.size()]];
      const std::size_t step = of_kind[random() % of_kind.size()];
      Event event = run.events[step].event;
      const std::string field = change(event, how, run, step, random);
      const std::string name = field.substr(field.find('.') + 1);
      const FieldOfKind* described = field.empty() ? nullptr : field_of_kind(event.index(), name);
      if (!described || !(has(described->as, As::formula) || has(described->as, As::recorded))) continue;
      if (!can_be_read(event, trace.scene()) || ++made[field] > of_a_field) continue;
      ++tried;
      const CheckReport report = check(run.with(step, &event));
      const auto says = [&](const NotJudged& one) {
        const auto& fields = one.fields;
        return one.kind == event.index() &&
               (fields.empty() || std::find(fields.begin(), fields.end(), name) != fields.end());
      };
      const std::vector<NotJudged> left = not_judged(report);
      if (!report.causes.empty()) ++noticed;
      else if (std::any_of(left.begin(), left.end(), says)) ++listed;
      else {
        auto& [times, last] = (may_be_passed_over(field) ? passed : neither)[field];
        ++times,
            last = fmt::format("{}, at step {} of {}", change_words[static_cast<std::size_t>(how)], step + 1, golden);
      }
    }
  });
  MESSAGE("of ", tried, " changes ", noticed, " are noticed, of ", listed, " others the field is listed");
  for (const auto& [field, which] : passed) MESSAGE(which.first, " x ", field, " is passed over: ", which.second);
  for (const auto& [field, which] : neither)
    FAIL_CHECK(field << " is neither judged nor listed: " << which.first << " x " << which.second);
  CHECK(tried > 50 * of_a_field);
  CHECK(noticed > tried / 2);
}

}  // namespace
