// The history of a pixel against brute force: every pixel of small traces of every method.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "algorithms/catalog/catalog.hpp"
#include "algorithms/scene/load.hpp"
#include "sim/answers/explain_value.hpp"
#include "sim/answers/pixel_history.hpp"
#include "sim/answers/why_not.hpp"
#include "sim/truth/truth.hpp"
#include "tests/golden/golden.hpp"
#include "tests/unit/algorithms/scenes.hpp"
#include "tests/unit/sim/answers/altered_runs.hpp"
#include "tests/where.hpp"
#include "traces/error.hpp"
#include "traces/record/trace_recorder.hpp"
#include "traces/replay/replay.hpp"

using namespace zstep;
using answers::FacetsNear, answers::Outcome, answers::Visit, answers::pixel_history;

namespace {

/// What a run through the whole trace tells of every pixel: steps that compare or paint there in the eye's picture.
std::vector<std::vector<std::int64_t>> fragments_of(const Trace& trace) {
  const Raster& raster = trace.scene().raster;
  std::vector<std::vector<std::int64_t>> all(static_cast<std::size_t>(raster.width) *
                                             static_cast<std::size_t>(raster.height));
  Pass pass = Pass::eye;
  for (std::int64_t step = 1; step <= trace.size(); ++step) {
    const Event& event = trace.event(step).event;
    if (const auto* begin = get_if<PassBegin>(&event)) pass = begin->pass;
    const auto at = pixel_of(event);
    if (!at || pass == Pass::light) continue;
    // Stripes of an attribute belong to the write before them.
    const bool colors = holds<ColorWrite>(event) && !trace.has(kind_of<AttributeInterpolate>);
    const bool decides = holds<DepthCompare>(event) || holds<PixelPaint>(event) || holds<ColorBlend>(event) || colors;
    if (decides)
      all[static_cast<std::size_t>(at->y) * static_cast<std::size_t>(raster.width) + static_cast<std::size_t>(at->x)]
          .push_back(step);
  }
  return all;
}

bool casts_rays(const Trace& trace) { return trace.header().algorithm.starts_with("ray-"); }

/// The polygons that cover a pixel, one for each facet; nothing where rounding decides.
std::optional<std::multiset<std::int32_t>> covering(const compare::Truth& truth, std::int32_t x, std::int32_t y) {
  std::multiset<std::int32_t> there;
  for (const compare::Candidate& candidate : truth.at(x, y)) {
    if (candidate.edge <= compare::edge_tolerance) return std::nullopt;
    if (candidate.covers) there.insert(candidate.polygon);
  }
  return there;
}

}  // namespace

TEST_SUITE("pixel history") {
  TEST_CASE(
      "of every pixel of every golden trace: the same steps as by looking at all, and the last winner is what is "
      "seen") {
    test::for_each_golden([&](const std::string& name, const Trace& trace) {
      CAPTURE(name);
      const auto all = fragments_of(trace);
      const FacetsNear facets(trace);
      Replay replay(trace);
      replay.go_to(trace.size());
      const Picture picture = replay.state().picture;
      const std::int32_t step_x = std::max(1, picture.width / 12), step_y = std::max(1, picture.height / 9);
      for (std::int32_t y = 0; y < picture.height; y += step_y)
        for (std::int32_t x = 0; x < picture.width; x += step_x) {
          CAPTURE(x);
          CAPTURE(y);
          std::vector<Visit> history = pixel_history(trace, facets, {x, y});
          std::vector<std::int64_t> steps;
          std::int32_t seen = no_polygon;
          for (Visit& visit : history) {
            tell(replay, visit);
            CHECK_FALSE(visit.sentence.empty());
            const auto& fragment = replay.state().machine.fragment;
            if (fragment && fragment->x == x && fragment->y == y && holds<DepthCompare>(replay.current()->event)) {
              CHECK(visit.stored == fragment->stored);
              CHECK(visit.stored_polygon == fragment->stored_polygon);
              const auto write = trace.next(
                  visit.step, [](const RecordedEvent&) { return true; },
                  Trace::Among(Trace::Pixel{x, y}, kind_of<PixelWrite>, visit.step + 2));
              if (write) CHECK(visit.polygon == get<PixelWrite>(trace.event(*write).event).polygon);
            }
            if (visit.takes) seen = visit.polygon;
            if (visit.outcome != Outcome::rejected && visit.outcome != Outcome::behind && !casts_rays(trace))
              steps.push_back(visit.step);
          }
          if (!casts_rays(trace)) CHECK(steps == all[picture.at(x, y)]);
          const auto& options =
              trace.header().conventions.options;  // in the order of the file glass takes the pixel's polygon, too
          const bool by_file = options.contains("order") && options.at("order") == "file";
          if (!by_file) CHECK(seen == picture.polygon[picture.at(x, y)]);
        }
    });
  }

  TEST_CASE("of every pixel of the pyramid before a triangle: every polygon that covers it, drawn, hidden or culled") {
    const Trace trace = open_jsonl(test::in_checkout("tests/golden/pyramid-behind.jsonl"));
    const compare::Truth truth(trace.scene(), false);
    int culled = 0, lost = 0, over = 0;
    for (std::int32_t y = 0; y < truth.height(); ++y)
      for (std::int32_t x = 0; x < truth.width(); ++x) {
        CAPTURE(x);
        CAPTURE(y);
        const auto there = covering(truth, x, y);
        std::set<std::int32_t> told;
        for (const Visit& visit : pixel_history(trace, {x, y})) {
          told.insert(visit.polygon);
          culled += visit.outcome == Outcome::rejected;
          lost += visit.outcome == Outcome::lost;
          over += visit.over.has_value();
          if (visit.outcome == Outcome::lost) CHECK(*visit.z > *visit.stored);
          if (visit.outcome == Outcome::won && visit.stored) CHECK(*visit.z < *visit.stored);
        }
        if (there) CHECK(told == std::set(there->begin(), there->end()));
      }
    CHECK(culled > 5);
    CHECK(lost > 5);
    CHECK(over > 5);
  }

  TEST_CASE(
      "by scan line and by area: who is behind comes to no step at the pixel, and is told by the step that decided") {
    for (const char* by : {"scan-line", "warnock"}) {
      CAPTURE(by);
      const Trace trace = test::recorded_by(by, look_at_scene(load_scene("pyramid-behind").scene, {}));
      const compare::Truth truth(trace.scene(), true);
      Replay replay(trace);
      int behind = 0;
      for (std::int32_t y = 0; y < truth.height(); ++y)
        for (std::int32_t x = 0; x < truth.width(); ++x) {
          CAPTURE(x);
          CAPTURE(y);
          const auto there = covering(truth, x, y);
          if (!there) continue;
          const std::vector<Visit> history = pixel_history(trace, {x, y});
          std::set<std::int32_t> told;
          for (Visit visit : history) {
            if (visit.outcome != Outcome::rejected) told.insert(visit.polygon);
            if (visit.outcome != Outcome::behind) continue;
            ++behind;
            const Event& decided = trace.event(visit.step).event;
            CHECK((holds<SpanWinner>(decided) || holds<AreaDecide>(decided)));
            CHECK_FALSE(visit.takes);
            const double gap = *visit.z - *visit.stored;  // 0 where the triangle runs through a face
            const std::string wanted =
                std::abs(gap) < 1e-9 ? "as near; the first stays" : "behind by " + answers::depth_text(gap);
            CHECK(gap > -1e-9);
            CHECK(answers::outcome_text(trace, history, visit) == wanted);
            // Its depth is that of the Z-buffer, in the buffer's own numbers.
            for (const compare::Candidate& candidate : truth.at(x, y))
              if (candidate.polygon == visit.polygon)
                CHECK(view_depth(trace.scene().camera, trace.header().conventions, *visit.z) ==
                      doctest::Approx(candidate.z).epsilon(1e-9));
            tell(replay, visit);
            CHECK_FALSE(visit.sentence.empty());
          }
          CHECK(told == std::set(there->begin(), there->end()));
        }
      CHECK(behind > 20);
    }
  }

  TEST_CASE(
      "buffers that are cleared once more: nothing from before is there, and why-not, history and explain agree on "
      "that") {
    const std::vector<glm::dvec3> all{{-1, -1, 5}, {5, -1, 5}, {5, 5, 5}, {-1, 5, 5}},
        nearer{{-1, -1, 3}, {5, -1, 3}, {5, 5, 3}, {-1, 5, 3}};
    const Trace once = test::recorded_by("z-buffer", test::screen_scene(4, 4, {all, nearer}));
    TraceRecorder recorder(once.header(), once.scene());
    std::int64_t second = 0;
    for (std::int64_t step = 1; step <= once.size(); ++step) {
      const RecordedEvent recorded = once.event(step), clear = once.event(1);
      const auto* begin = get_if<PolygonBegin>(&recorded.event);
      if (begin && begin->polygon == 1) {
        REQUIRE(holds<BuffersClear>(clear.event));
        record_any(recorder, clear.step, clear.event);
        second = step;
      }
      record_any(recorder, recorded.step, recorded.event);
    }
    recorder.finish();
    REQUIRE(second > 1);
    const Trace trace = Trace::from_bytes(recorder.take_bytes(), "cleared twice");
    Replay replay(trace);
    replay.go_to(trace.size());
    REQUIRE(replay.state().picture.polygon[5] == 1);
    const std::vector<Visit> history = pixel_history(trace, {1, 1});
    REQUIRE(history.size() == 2);
    CHECK(history[0].wiped == second);
    CHECK_FALSE(history[0].over);
    CHECK(answers::outcome_text(trace, history, history[0]) == "nearer; cleared at step " + std::to_string(second));
    CHECK(history[1].stored == no_depth);
    CHECK(history[1].outcome == Outcome::won);
    const answers::Verdict verdict = answers::why_not(trace, 0, {1, 1});
    CHECK(verdict.kind == answers::Why::wiped);
    CHECK(verdict.step == second);
    CHECK(verdict.sentence.find("until the buffers were cleared once more") != std::string::npos);
    CHECK(answers::why_not(trace, 1, {1, 1}).kind == answers::Why::seen);
    answers::Question question;
    question.pixel = Trace::Pixel{1, 1}, question.at = second;
    CHECK_FALSE(answers::place_of(trace, question));
    question.at = trace.size();
    CHECK(answers::explain_value(trace, question).links.front().values.front().value == 3);
  }

  TEST_CASE("of a tree: every polygon that covers the pixel and faces away is told once, by the step that dropped it") {
    const Trace trace = test::recorded_by("bsp", look_at_scene(load_scene("pyramid-behind").scene, {}));
    const compare::Truth truth(trace.scene(), false);
    int culled = 0;
    for (std::int32_t y = 0; y < truth.height(); ++y)
      for (std::int32_t x = 0; x < truth.width(); ++x) {
        CAPTURE(x);
        CAPTURE(y);
        const auto there = covering(truth, x, y);
        std::multiset<std::int32_t> told;
        for (const Visit& visit : pixel_history(trace, {x, y})) {
          told.insert(visit.polygon);
          culled += visit.outcome == Outcome::rejected;
          if (visit.outcome == Outcome::rejected)
            CHECK(get<PolygonReject>(trace.event(visit.step).event).polygon == visit.polygon);
        }
        if (there) CHECK(told == *there);
      }
    CHECK(culled > 5);
  }

  TEST_CASE("a compare that says what its numbers do not is told as that, and takes no pixel that is not written") {
    const std::vector<glm::dvec3> all{{-1, -1, 7}, {5, -1, 7}, {5, 5, 7}, {-1, 5, 7}};
    const Trace honest = test::recorded_by("z-buffer", test::screen_scene(4, 4, {all, all}));
    const Trace trace = test::changed(honest, [](std::int64_t, Event& event) {
      if (auto* compare = get_if<DepthCompare>(&event)) compare->nearer = true;
      return true;
    });
    const std::vector<Visit> history = pixel_history(trace, {1, 1});
    REQUIRE(history.size() == 2);
    CHECK(answers::outcome_text(trace, history, history[0]) == "nearer");
    CHECK(answers::outcome_text(trace, history, history[1]) ==
          "the trace says nearer, but 7 < 7 is false; not written");
    CHECK(history[0].takes);
    CHECK_FALSE(history[1].takes);
  }

  TEST_CASE("of a recording that was cut off: who covers the pixel and did not come to it is told") {
    const Scene scene = test::large_scene();
    for (const char* by : {"z-buffer", "warnock", "bsp"}) {
      CAPTURE(by);
      const Trace trace = test::cut_off(by, scene);
      REQUIRE_FALSE(trace.warnings().empty());
      REQUIRE(trace.size() > 0);
      const FacetsNear facets(trace);
      const compare::Truth truth(scene, true);
      int pending = 0;
      for (std::int32_t y = 0; y < 250; y += 9)
        for (std::int32_t x = 0; x < 250; x += 9) {
          CAPTURE(x);
          CAPTURE(y);
          const std::vector<Visit> history = pixel_history(trace, facets, {x, y});
          bool covered = false;
          for (const compare::Candidate& candidate : truth.at(x, y))
            covered = covered || (candidate.covers && candidate.edge > compare::edge_tolerance);
          if (covered) CHECK_FALSE(history.empty());  // else it would be said that it shows the background
          for (const Visit& visit : history) {
            if (visit.outcome != Outcome::cut_off) continue;
            ++pending;
            CHECK_FALSE(visit.takes);
            CHECK(visit.sentence.find("cut off before its turn") != std::string::npos);
          }
        }
      CHECK(pending > 5);
    }
  }

  TEST_CASE("along a ray: what it met, in the order in which it was tested, and the tie") {
    int ties = 0, lost = 0;
    for (const char* name : {"ray-casting", "ray-casting-tree"}) {
      const Trace trace = open_jsonl(test::in_checkout("tests/golden/") + std::string(name) + ".jsonl");
      for (std::int32_t y = 0; y < trace.scene().raster.height; ++y)
        for (std::int32_t x = 0; x < trace.scene().raster.width; ++x)
          for (const Visit& visit : pixel_history(trace, {x, y}))
            ties += visit.outcome == Outcome::tie, lost += visit.outcome == Outcome::lost;
    }
    CHECK(ties > 0);
    CHECK(lost > 0);
  }

  TEST_CASE("a difference in the seventh digit is told, and shown") {
    const Trace trace = test::recorded_by(
        "z-buffer",
        test::screen_scene(4, 4,
                           {{{-1, -1, 0.5}, {5, -1, 0.5}, {5, 5, 0.5}, {-1, 5, 0.5}},
                            {{-1, -1, 0.5000003}, {5, -1, 0.5000003}, {5, 5, 0.5000003}, {-1, 5, 0.5000003}}}));
    const std::vector<Visit> history = pixel_history(trace, {1, 1});
    REQUIRE(history.size() == 2);
    CHECK(answers::depth_text(*history[1].z) == "0.5000003");
    CHECK(answers::outcome_text(trace, history, history[1]) == "behind by 3e-07");
  }

  TEST_CASE("glass takes no pixel from what shines through it") {
    Scene scene = test::screen_scene(4, 4,
                                     {{{-1, -1, 2}, {5, -1, 2}, {5, 5, 2}, {-1, 5, 2}},
                                      {{-1, -1, 1}, {5, -1, 1}, {5, 5, 1}, {-1, 5, 1}},
                                      {{-1, -1, 3}, {5, -1, 3}, {5, 5, 3}, {-1, 5, 3}}});
    scene.polygons[1].material = Material{0.5};
    const std::vector<Visit> history = pixel_history(test::recorded_by("transparency", scene), {1, 1});
    // Polygon 0 wins and colours the pixel, polygon 2 is behind it, and polygon 1 wins and is mixed in.
    REQUIRE(history.size() == 5);
    CHECK(history[0].polygon == 0);
    CHECK(history[0].takes);
    CHECK_FALSE(history[0].over);
    CHECK(history[2].outcome == Outcome::lost);
    CHECK(history[3].polygon == 1);
    CHECK_FALSE(history[3].takes);
    CHECK(history[4].outcome == Outcome::mixed);
    CHECK(history[4].opacity == 0.5);
  }

  TEST_CASE("a pixel that nothing reached has no history") {
    const Trace trace = open_jsonl(test::in_checkout("tests/golden/pyramid.jsonl"));
    CHECK(pixel_history(trace, {0, 0}).empty());
  }
}

TEST_CASE("a block that is damaged costs no history that it has no part in") {
  ViewOptions view;
  view.width = 320, view.height = 240;
  const Scene scene = look_at_scene(load_scene("teapot:4").scene, view);
  const Method& taught = method("z-buffer");
  TraceRecorder recorder(header_for(taught, {}), scene);
  taught.record(scene, {}, recorder);
  recorder.finish();
  std::vector<std::uint8_t> bytes = recorder.take_bytes();
  const Trace whole = Trace::from_bytes(bytes, "whole");
  std::vector<std::size_t> blocks;
  for (std::size_t at = 0; at + 4 < bytes.size(); ++at)
    if (std::equal(bytes.begin() + static_cast<std::ptrdiff_t>(at), bytes.begin() + static_cast<std::ptrdiff_t>(at) + 4,
                   "EVTS"))
      blocks.push_back(at);
  REQUIRE(blocks.size() > 3);
  bytes[blocks[blocks.size() / 2] + 400] ^= 0x10;
  const Trace damaged = Trace::from_bytes(std::move(bytes), "damaged");
  const FacetsNear facets(whole);
  int answered = 0, refused = 0;
  for (std::int32_t y = 0; y < 240; y += 12)
    for (std::int32_t x = 0; x < 320; x += 12) {
      const std::vector<Visit> all = pixel_history(whole, facets, {x, y});
      if (all.empty()) continue;
      try {
        const std::vector<Visit> visits = pixel_history(damaged, facets, {x, y});
        REQUIRE(visits.size() == all.size());
        for (std::size_t i = 0; i < all.size(); ++i)
          CHECK((visits[i].step == all[i].step && visits[i].polygon == all[i].polygon &&
                 visits[i].outcome == all[i].outcome));
        ++answered;
      } catch (const InputError&) {
        ++refused;
      }
    }
  CHECK(refused > 0);
  CHECK(answered > refused);
}
