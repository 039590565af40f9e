// zstep check: compares and writes that do not come as zstep has them. Right programs may do so; wrong ones show it
// here and nowhere else.
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include <doctest/doctest.h>

#include "algorithms/scene/load.hpp"
#include "sim/words/explain.hpp"
#include "tests/golden/golden.hpp"
#include "tests/unit/sim/answers/altered_runs.hpp"
#include "tests/unit/sim/answers/reordered_runs.hpp"
#include "tests/where.hpp"
#include "traces/check/check.hpp"
#include "traces/diff/diff.hpp"
#include "traces/file/jsonl.hpp"
#include "traces/oracle/errors.hpp"
#include "traces/record/trace_recorder.hpp"
#include "traces/replay/replay.hpp"

using namespace zstep;
using test::all_pixels_last, test::as_they_are, test::by_picture, test::pixels_last, test::steps_of, test::with_steps;

namespace {

Trace golden(const char* name) { return open_jsonl(test::in_checkout(std::string("tests/golden/") + name + ".jsonl")); }

template <class E>
Trace without(const Trace& trace) {
  return test::changed(trace, [](std::int64_t, const Event& event) { return !holds<E>(event); });
}
Trace without_step(const Trace& trace, std::int64_t step) {
  return test::changed(trace, [&](std::int64_t number, const Event&) { return number != step; });
}
/// "RULE@STEP" of each cause, or its field.
std::string causes_of(const Trace& trace) {
  std::string names;
  for (const Cause& cause : check(trace).causes)
    names += (names.empty() ? "" : " ") +
             (cause.first.rule ? std::string(rule_text(*cause.first.rule).name) : cause.first.field) + "@" +
             std::to_string(cause.first.step);
  return names;
}

/// Writes colours before the compares that they belong to; of compares that are lost as well where `always`.
Trace written_first(const Trace& right, bool always) {
  std::vector<RecordedEvent> steps;
  std::optional<RecordedEvent> write;
  std::int32_t polygon = 0;
  for (const RecordedEvent& step : steps_of(right)) {
    if (const auto* begin = get_if<PolygonBegin>(&step.event)) polygon = begin->polygon;
    if (holds<PixelWrite>(step.event)) {
      write = write ? write : step;
      continue;
    }
    if (const auto* compare = get_if<DepthCompare>(&step.event); compare && (compare->nearer || always)) {
      const auto any = right.next<PixelWrite>(0, [](const PixelWrite&) { return true; });
      steps.push_back({right.event(*any).step, PixelWrite{compare->x, compare->y, polygon}});
    }
    steps.push_back(step);
  }
  return with_steps(right, steps);
}

TEST_CASE("check: a colour may be written before the compare of its pixel, but only where that is won") {
  for (const char* name : {"delhi", "pyramid-view"}) {
    CAPTURE(name);
    const Trace right = golden(name);
    std::int64_t lost = 0;
    for (const RecordedEvent& step : steps_of(right))
      if (const auto* compare = get_if<DepthCompare>(&step.event)) lost += !compare->nearer;
    REQUIRE(lost > 1);
    const auto may_be_left_out = [](const Event& event, int what) {
      return what == 1 ? holds<DepthInterpolate>(event) : what == 2 && holds<DepthWrite>(event);
    };
    for (const int what : {0, 1, 2}) {
      CAPTURE(what);
      const Trace run =
          test::changed(right, [&](std::int64_t, const Event& event) { return !may_be_left_out(event, what); });
      CHECK(causes_of(written_first(run, false)) == "");
      const Trace wrong = written_first(run, true);
      const CheckReport report = check(wrong);
      REQUIRE(report.causes.size() == 1);
      CHECK(report.causes[0].first.rule == formulas::Rule::write_after_win);
      CHECK(report.wrong_steps == lost);
      CHECK(holds<PixelWrite>(wrong.event(report.causes[0].first.step).event));
    }
  }
}

TEST_CASE("check: each pixel that is won takes its colour, unless the run ends there or never says so") {
  const Trace right = golden("delhi");
  const auto ends_pixel = [](const RecordedEvent& step) {
    return holds<DepthInterpolate>(step.event) || holds<DepthCompare>(step.event) || holds<ScanLineBegin>(step.event) ||
           holds<PolygonBegin>(step.event);
  };
  int dropped = 0;
  for (std::int64_t step = 1; step <= right.size(); ++step) {
    if (!holds<PixelWrite>(right.event(step).event)) continue;
    ++dropped;
    // It is noticed where the pixel is done; after the last one, where an edge leaves.
    const std::int64_t noticed = right.next(step, ends_pixel).value_or(step + 1) - 1;
    CHECK(causes_of(without_step(right, step)) == "win_is_painted@" + std::to_string(noticed));
    // The run is cut off before the write.
    const Trace cut = test::changed(right, [&](std::int64_t number, const Event&) { return number < step; });
    CHECK(causes_of(cut) == "");
    CHECK(verdict_of(check(cut)) == Verdict::right_where_judged);
  }
  CHECK(dropped > 20);
  CHECK(causes_of(without<PixelWrite>(right)) == "");
}

TEST_CASE("check: colours may be written once a polygon's compares are done, but not left out") {
  const Trace right = golden("delhi");
  const auto later = [&](int without) {  // the nth of the first polygon's writes is left out
    std::vector<RecordedEvent> steps, writes;
    const auto write_now = [&] {
      if (without >= 0 && !writes.empty()) writes.erase(writes.begin() + std::exchange(without, -1));
      steps.insert(steps.end(), writes.begin(), writes.end()), writes.clear();
    };
    for (const RecordedEvent& step : steps_of(right)) {
      if (holds<PolygonBegin>(step.event)) write_now();
      (holds<PixelWrite>(step.event) ? writes : steps).push_back(step);
    }
    write_now();
    return with_steps(right, steps);
  };
  CHECK(causes_of(later(-1)) == "");
  CHECK(causes_of(later(0)).find("win_is_painted@") == 0);
  CHECK(causes_of(later(3)).find("win_is_painted@") == 0);
}

TEST_CASE("check: a pixel lies on its span's own scan line") {
  const Trace right = golden("delhi");
  const std::int32_t last = right.scene().raster.height - 1;
  const auto moved = [&](auto&& change) {
    return test::changed(right, [&](std::int64_t, Event& event) {
      visit_event(
          [&]<class E>(E& e) {
            if constexpr (requires {
                            e.x;
                            e.y;
                          })
              change(e);
          },
          event);
      return true;
    });
  };
  CHECK(causes_of(moved([&](auto& e) { e.y = last - e.y; })).find("pixel_in_span@") == 0);
  // The depths are interpolated where they belong, and only compared and written elsewhere.
  const Trace exchanged = moved([&]<class E>(E& e) {
    if constexpr (!std::is_same_v<E, DepthInterpolate>) std::swap(e.x, e.y);
  });
  const CheckReport report = check(exchanged);
  REQUIRE(!report.causes.empty());
  CHECK(holds<DepthCompare>(exchanged.event(report.causes[0].first.step).event));
}

TEST_CASE("check: pixels may come after all spans of their polygon, where each lies in one of these") {
  for (const char* name : {"delhi", "pyramid-view"}) {
    CAPTURE(name);
    const Trace right = golden(name);
    const std::int32_t last = right.scene().raster.height - 1;
    const Trace run = pixels_last(right, [](auto&) {});
    CHECK(causes_of(run) == "");
    CHECK(verdict_of(check(run)) == verdict_of(check(right)));
    CHECK(causes_of(pixels_last(right, [&](auto& e) { e.y = last - e.y; })).find("pixel_in_span@") !=
          std::string::npos);
    // A depth goes by the span on its own line, and is wrong by itself.
    const auto depth = run.next<DepthInterpolate>(0, [](const DepthInterpolate&) { return true; });
    REQUIRE(depth);
    const auto wrong = [&](auto&& change) {
      return test::changed(run, [&](std::int64_t step, Event& event) {
        if (step == *depth) change(*get_if<DepthInterpolate>(&event));
        return true;
      });
    };
    CHECK(causes_of(wrong([](DepthInterpolate& e) { e.z += 1; })).find("z@" + std::to_string(*depth)) == 0);
    CHECK(causes_of(wrong([](DepthInterpolate& e) {
            e.y = 0, e.x = 0;
          })).find("pixel_in_span@" + std::to_string(*depth)) == 0);
    // A pixel that is missing among them is missed.
    const auto pixel = get<DepthInterpolate>(run.event(*depth).event);
    const Trace fewer = test::changed(run, [&](std::int64_t step, const Event& event) {
      return step < *depth || step > *depth + 3 ||
             visit_event(
                 [&]<class E>(const E& e) {
                   if constexpr (requires { e.x, e.y; }) return e.x != pixel.x || e.y != pixel.y;
                   return true;
                 },
                 event);
    });
    CHECK(causes_of(fewer).find("span_is_filled@") != std::string::npos);
  }
}

TEST_CASE("check: each pixel of a span has its depth interpolated, and compared") {
  const Trace right = golden("delhi");
  const auto moved = [&]<class E>(E) {
    int tried = 0;
    for (std::int64_t step = 1; step < right.size(); ++step) {
      const auto* here = get_if<E>(&right.event(step).event);
      if (!here) continue;
      // The next pixel's step names this pixel again: of one depth all over a polygon no number tells.
      const auto next = right.next<E>(step, [](const E&) { return true; });
      if (!next || get<E>(right.event(*next).event).x != here->x + 1) continue;
      const Trace wrong = test::changed(right, [&](std::int64_t at, Event& event) {
        if (at == *next) --get_if<E>(&event)->x;
        return true;
      });
      CAPTURE(*next);
      CHECK(causes_of(wrong).find("span_is_filled@") != std::string::npos);
      ++tried;
    }
    return tried;
  };
  CHECK(moved(DepthInterpolate{}) > 20);
  CHECK(moved(DepthCompare{}) > 20);
}

TEST_CASE("check: where one table has all polygons, pixels may come after all spans of their scan line") {
  const Trace right = golden("scan-line-buffer");
  REQUIRE(right.has(kind_of<TablesBegin>));
  const Trace run = pixels_last<ScanLineBegin>(right, [](auto&) {});
  CHECK(causes_of(run) == "");
  CHECK(verdict_of(check(run)) == verdict_of(check(right)));
  CHECK(diff::compare(right, run).causes.empty());
  int lines = 0;  // that differ in order
  std::int32_t last = -1;
  for (std::int64_t step = 1; step <= run.size(); ++step)
    if (const auto* depth = get_if<DepthInterpolate>(&run.event(step).event)) {
      if (right.event(step).event.index() == kind_of<DepthInterpolate> || depth->y == last) continue;
      ++lines, last = depth->y;
      const Trace wrong = test::changed(run, [&](std::int64_t at, Event& event) {
        if (at == step) get_if<DepthInterpolate>(&event)->z += 1;
        return true;
      });
      CHECK(causes_of(wrong).find("z@" + std::to_string(step)) == 0);
      const diff::DiffReport report = diff::compare(right, wrong);
      CHECK((!report.causes.empty() && report.causes.front().first.b == step));
    }
  CHECK(lines > 3);
}

TEST_CASE("check: pixels may come after all spans of the scene, polygon by polygon or in the picture's order") {
  for (const char* name : {"delhi", "pyramid-view", "pyramid", "intersecting", "plane", "with-attribute"}) {
    const std::string scene = name;
    CAPTURE(scene);
    const Trace right = scene == "intersecting"
                            ? test::recorded_by("z-buffer", look_at_scene(load_scene("intersecting").scene, {}))
                            : golden(name);
    CHECK(causes_of(all_pixels_last(right, as_they_are)) == "");
    CHECK(causes_of(all_pixels_last(right, by_picture)) == "");
  }
}

TEST_CASE("check: of pixels after all spans one with another span's depth or polygon is found") {
  const Trace right = test::recorded_by("z-buffer", look_at_scene(load_scene("intersecting").scene, {}));
  const auto in_order = [&](bool picture) {
    return picture ? all_pixels_last(right, by_picture) : all_pixels_last(right, as_they_are);
  };
  for (const bool picture : {false, true}) {
    CAPTURE(picture);
    const Trace run = in_order(picture);
    // A pixel of the first polygon with the depth that the second one has there, and the other way round.
    std::map<std::pair<std::int32_t, std::int32_t>, std::vector<std::int64_t>> came;
    run.each(0, run.size(), [&](std::int64_t step, const RecordedEvent& recorded) {
      if (const auto* depth = get_if<DepthInterpolate>(&recorded.event)) came[{depth->x, depth->y}].push_back(step);
      return true;
    });
    int tried = 0;
    for (const auto& [at, steps] : came) {
      if (steps.size() != 2 || tried >= 12) continue;
      const double first = get<DepthInterpolate>(run.event(steps[0]).event).z,
                   second = get<DepthInterpolate>(run.event(steps[1]).event).z;
      if (std::abs(first - second) < 1e-6) continue;
      ++tried;
      for (const bool later : {false, true}) {
        const std::int64_t wrong = steps[later];
        const Trace changed = test::changed(run, [&](std::int64_t step, Event& event) {
          if (step == wrong) get_if<DepthInterpolate>(&event)->z = later ? first : second;
          return true;
        });
        CHECK(causes_of(changed) != "");
        if (later) CHECK(causes_of(changed).find("z@" + std::to_string(wrong)) == 0);
      }
    }
    CHECK(tried == 12);
    const auto write = run.next<PixelWrite>(0, [](const PixelWrite&) { return true; });
    const Trace other = test::changed(run, [&](std::int64_t step, Event& event) {
      if (step == *write) get_if<PixelWrite>(&event)->polygon ^= 1;
      return true;
    });
    CHECK(causes_of(other).find("polygon@" + std::to_string(*write)) == 0);
  }
}

TEST_CASE("error, explain and diff take a pixel's own span where all spans come first") {
  const Trace right = test::recorded_by("z-buffer", look_at_scene(load_scene("intersecting").scene, {}));
  const Trace run = all_pixels_last(right, as_they_are), by_line = pixels_last(right, [](auto&) {});
  const oracle::Errors own = oracle::errors_of(right);
  const Trace in_picture = all_pixels_last(right, by_picture);
  CHECK(diff::compare(right, in_picture).causes.empty());
  CHECK(diff::compare(run, in_picture).causes.empty());
  for (const Trace* other : {&run, &by_line}) {
    const oracle::Errors errors = oracle::errors_of(*other);
    CHECK(errors.all.depths == own.all.depths);
    CHECK(errors.all.largest == own.all.largest);
    CHECK(errors.all.sum_of_squares == own.all.sum_of_squares);
    CHECK(errors.polygons.size() == own.polygons.size());
    CHECK(errors.wrong_pixels == own.wrong_pixels);
    CHECK(diff::compare(right, *other).causes.empty());
    CHECK(diff::compare(*other, right).causes.empty());
    // The same pixel is told in the same words.
    std::vector<std::int64_t> there, here;
    const auto depths = [](const Trace& of) {
      std::vector<std::int64_t> steps;
      of.each(0, of.size(), [&](std::int64_t step, const RecordedEvent& recorded) {
        if (holds<DepthInterpolate>(recorded.event)) steps.push_back(step);
        return true;
      });
      return steps;
    };
    there = depths(right), here = depths(*other);
    REQUIRE(there.size() == here.size());
    Replay of_right(right), of_other(*other);
    for (std::size_t i = 0; i < there.size(); i += 7) {
      of_right.go_to(there[i]), of_other.go_to(here[i]);
      const Explanation one = explain(right, of_right.state(), *of_right.current()),
                        its = explain(*other, of_other.state(), *of_other.current());
      CHECK(one.sentence == its.sentence);
      CHECK(one.formulas == its.formulas);
      CHECK(its.doubt.value_or("") == one.doubt.value_or(""));
    }
  }
}

TEST_CASE("diff: of pixels after all spans the one that is wrong is the first cause, whichever polygon's it is") {
  const Trace right = test::recorded_by("z-buffer", look_at_scene(load_scene("intersecting").scene, {}));
  for (const bool picture : {false, true}) {
    CAPTURE(picture);
    const Trace run = picture ? all_pixels_last(right, by_picture) : all_pixels_last(right, as_they_are);
    std::vector<std::int64_t> depths, compares;
    run.each(0, run.size(), [&](std::int64_t step, const RecordedEvent& recorded) {
      if (holds<DepthInterpolate>(recorded.event)) depths.push_back(step);
      if (holds<DepthCompare>(recorded.event)) compares.push_back(step);
      return true;
    });
    for (std::size_t i = 3; i < depths.size(); i += depths.size() / 5) {
      const std::int64_t wrong = depths[i], turned = compares[i];
      CAPTURE(wrong);
      const diff::DiffReport of_depth = diff::compare(right, test::changed(run, [&](std::int64_t step, Event& event) {
                                                        if (step == wrong) get_if<DepthInterpolate>(&event)->z *= 1.001;
                                                        return true;
                                                      }));
      REQUIRE(of_depth.causes.size() == 1);
      CHECK(of_depth.causes.front().first.b == wrong);
      const diff::DiffReport of_verdict = diff::compare(right, test::changed(run, [&](std::int64_t step, Event& event) {
                                                          if (step == turned)
                                                            get_if<DepthCompare>(&event)->nearer ^= true;
                                                          return true;
                                                        }));
      REQUIRE(!of_verdict.causes.empty());
      CHECK(of_verdict.causes.front().first.b == turned);
    }
  }
}

/// The pixels of each scan line kind by kind: all interpolations, all compares, all depths, all colours.
Trace kind_by_kind(const Trace& right) {
  std::vector<RecordedEvent> steps, pixels;
  const auto put = [&] {
    std::stable_sort(pixels.begin(), pixels.end(), [](const RecordedEvent& one, const RecordedEvent& other) {
      return one.event.index() < other.event.index();
    });
    steps.insert(steps.end(), pixels.begin(), pixels.end()), pixels.clear();
  };
  for (const RecordedEvent& step : steps_of(right)) {
    const bool of_pixel = visit_event(
        []<class E>(const E& e) {
          return requires { e.x, e.y; };
        },
        step.event);
    if (!of_pixel) put();
    (of_pixel ? pixels : steps).push_back(step);
  }
  put();
  return with_steps(right, steps);
}

TEST_CASE("check: a depth or a colour that is missing is missed where a scan line is printed kind by kind") {
  const Trace right = golden("delhi"), run = kind_by_kind(right);
  CHECK(causes_of(run) == "");
  CHECK(check(run).coverage);
  const auto left_out = [&]<class E>(E, const char* rule) {
    int tried = 0, missed = 0;
    std::int64_t step = 0;
    while (const auto found = run.next<E>(step, [](const E&) { return true; })) {
      step = *found;
      if (++tried % 3 != 0) continue;
      const E write = get<E>(run.event(step).event);
      const CheckReport report = check(without_step(run, step));
      const bool told = std::any_of(report.causes.begin(), report.causes.end(), [&](const Cause& cause) {
        return cause.first.rule && rule_text(*cause.first.rule).name == rule;
      });
      const bool listed = verdict_of(report) != Verdict::right && !report.coverage;
      CAPTURE(write.x);
      CAPTURE(write.y);
      CHECK((told || listed));
      missed += told;
    }
    return std::pair(tried / 3, missed);
  };
  const auto [depths, depths_missed] = left_out(DepthWrite{}, "win_is_written");
  const auto [colors, colors_missed] = left_out(PixelWrite{}, "win_is_painted");
  CHECK(2 * depths_missed > depths);
  CHECK(2 * colors_missed > colors);
}

TEST_CASE("check: nothing follows from a pixel that was not written but what is held against its depth") {
  const Trace right = golden("delhi");
  const auto last_of = [&]<class E>(E) {
    std::int64_t found = 0;
    for (std::int64_t step = 1; step < right.size(); ++step)
      if (holds<E>(right.event(step).event) && holds<DepthInterpolate>(right.event(step + 1).event)) found = step;
    return found;
  };
  const CheckReport colour = check(without_step(right, last_of(PixelWrite{})));
  REQUIRE(colour.causes.size() == 1);
  CHECK(colour.causes.front().first.rule == formulas::Rule::win_is_painted);
  CHECK(colour.causes.front().inherited == 0);
}

TEST_CASE("check: where no compare is recorded, which pixels are painted is not judged, and that is said") {
  const Trace right = golden("delhi");
  const Trace run = without<DepthCompare>(without<DepthWrite>(right));
  CHECK(causes_of(run) == "");
  CHECK(verdict_of(check(run)) == Verdict::right_where_judged);
  CHECK_FALSE(check(run).coverage);
}

TEST_CASE("check: glass is mixed into the pixel that was won") {
  const Trace right = golden("transparency");
  REQUIRE(causes_of(right) == "");
  const auto blend = right.next<ColorBlend>(0, [](const ColorBlend&) { return true; });
  const Trace wrong = test::changed(right, [&](std::int64_t step, Event& event) {
    if (step == *blend) ++get_if<ColorBlend>(&event)->x;
    return true;
  });
  CHECK(causes_of(wrong).find("write_after_win@" + std::to_string(*blend)) == 0);
}

TEST_CASE("check: what was written and then cleared counts as written") {
  const Trace right = golden("delhi");
  const auto first = right.next<BuffersClear>(0, [](const BuffersClear&) { return true; });
  const auto second = right.next<PolygonBegin>(0, [](const PolygonBegin& e) { return e.polygon == 1; });
  REQUIRE(first);
  REQUIRE(second);
  std::vector<RecordedEvent> steps = steps_of(right);
  steps.insert(steps.begin() + *second - 1, steps[static_cast<std::size_t>(*first - 1)]);
  const std::string causes = causes_of(with_steps(right, steps));
  CHECK(causes.find("win_is_written") == causes.npos);
  // The depth of the pixel before it is not written at all.
  const auto last_write = [&] {
    std::int64_t found = 0;
    for (std::int64_t step = 1; step < *second; ++step)
      if (holds<DepthWrite>(right.event(step).event)) found = step;
    return found;
  }();
  steps.erase(steps.begin() + last_write - 1);
  CHECK(causes_of(with_steps(right, steps)).find("win_is_written@" + std::to_string(*second - 1)) == 0);
}

TEST_CASE("check: of a span whose end is no number nothing is said of its pixels") {
  const Trace right = golden("delhi");
  const auto span = right.next<SpanBegin>(0, [](const SpanBegin&) { return true; });
  const Trace wrong = test::changed(right, [&](std::int64_t step, Event& event) {
    if (step == *span) get_if<SpanBegin>(&event)->x_right = std::numeric_limits<double>::quiet_NaN();
    return true;
  });
  const CheckReport report = check(wrong);
  CHECK(std::any_of(report.causes.begin(), report.causes.end(),
                    [](const Cause& cause) { return cause.first.field == "x_right"; }));
  CHECK(std::none_of(report.causes.begin(), report.causes.end(),
                     [](const Cause& cause) { return cause.first.field == "last"; }));
}

TEST_CASE("check: a depth that is written after another pixel's compare needs a win at its own pixel") {
  const Trace right = golden("delhi");
  // Where a pixel is lost and a later one of its line is won: after that one's colour the lost depth is written, too.
  std::vector<RecordedEvent> steps;
  std::optional<DepthCompare> lost;
  std::int64_t written = 0;
  for (const RecordedEvent& step : steps_of(right)) {
    steps.push_back(step);
    const auto* compare = get_if<DepthCompare>(&step.event);
    if (compare && !compare->nearer) lost = *compare;
    const auto* write = get_if<PixelWrite>(&step.event);
    if (!write || !lost || written != 0 || write->y != lost->y) continue;
    const auto any = right.next<DepthWrite>(0, [](const DepthWrite&) { return true; });
    steps.push_back({right.event(*any).step, DepthWrite{lost->x, lost->y, lost->z}});
    written = static_cast<std::int64_t>(steps.size());
  }
  REQUIRE(written != 0);
  CHECK(causes_of(with_steps(right, steps)).find("write_after_win@" + std::to_string(written)) == 0);
}

}  // namespace
