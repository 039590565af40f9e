// The slice: what it holds follows from the trace and the step alone, and what a compare holds against what is seen.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

#include "sim/classroom/lesson.hpp"
#include "sim/viewer/model/slice.hpp"
#include "sim/viewer/panes/pane.hpp"
#include "sim/viewer/pictures.hpp"
#include "tests/golden/golden.hpp"
#include "tests/viewer/drive.hpp"
#include "tests/viewer/letters.hpp"
#include "tests/viewer/words/some_runs.hpp"
#include "tests/where.hpp"

using namespace zstep;
using namespace zstep::viewer;

namespace {

Trace golden(const char* name) { return open_jsonl(test::in_checkout(std::string("tests/golden/") + name + ".jsonl")); }

/// The spans on a line since its picture was begun, read step by step.
std::vector<SpanBegin> spans_until(const Trace& trace, const SliceAt& at, std::int64_t position) {
  std::vector<SpanBegin> spans;
  Pass pass = Pass::eye;
  for (std::int64_t p = 1; p <= position; ++p) {
    const Event& event = trace.event(p).event;
    if (const auto* begin = get_if<PassBegin>(&event)) pass = begin->pass;
    if ((holds<PassBegin>(event) || holds<BuffersClear>(event)) && pass == at.pass) spans.clear();
    if (const auto* span = get_if<SpanBegin>(&event); span && span->y == at.y && pass == at.pass)
      spans.push_back(*span);
  }
  return spans;
}

Slice slice_at(Session& session, SliceLines& lines, std::int64_t position) {
  session.go_to(position);
  const Moment now(session);
  return slice_of(now, lines, *slice_line(now, session.selected));
}

std::string sentence_at(Session& session, SliceLines& lines, std::int64_t position) {
  const Slice slice = slice_at(session, lines, position);
  return slice_sentence(Moment(session), slice);
}

}  // namespace

TEST_CASE("law: the slice has the spans up to the step, and the depth buffer's line") {
  std::int64_t lines_seen = 0;
  test::for_each_golden([&](const std::string& name, const Trace& trace) {
    if (!slice_pane.serves(trace.header())) return;
    CAPTURE(name);
    Session session(trace, nullptr);
    SliceLines lines;
    for (std::int64_t at = 1; at <= trace.size(); at += 17) {
      session.go_to(at);
      const Moment now(session);
      const auto line = slice_line(now, std::nullopt);
      if (!line) continue;
      CAPTURE(at);
      const Slice slice = slice_of(now, lines, *line);
      CHECK(slice.complete);
      if (trace.has(kind_of<SpanBegin>)) {
        const std::vector<SpanBegin> wanted = spans_until(trace, *line, at);
        REQUIRE(slice.spans.size() == wanted.size());
        for (std::size_t i = 0; i < wanted.size(); ++i) {
          CHECK(slice.spans[i].x_left == wanted[i].x_left);
          CHECK(slice.spans[i].z_left == wanted[i].z_left);
          CHECK(slice.spans[i].x_right == wanted[i].x_right);
          CHECK(slice.spans[i].z_right == wanted[i].z_right);
          CHECK(slice.spans[i].polygon != no_polygon);
        }
      }
      const bool lights = line->pass == Pass::light && session.state().machine.pass != Pass::light;
      const Picture& picture = lights ? session.state().light : session.picture();
      for (std::int32_t x = 0; x < picture.width && line->y >= 0 && line->y < picture.height; ++x)
        CHECK(slice.stored[static_cast<std::size_t>(x)] == picture.depth[picture.at(x, line->y)]);
      for (const SliceSample& sample : slice.samples) CHECK(sample.step <= at);
      ++lines_seen;
    }
  });
  CHECK(lines_seen > 300);
}

TEST_CASE("the slice says which of two depths is nearer, as the step found it") {
  const Trace trace = golden("delhi");
  Session session(trace, nullptr);
  SliceLines lines;
  int compares = 0;
  for (std::int64_t at = 1; at <= trace.size(); ++at) {
    const Event event = trace.event(at).event;
    const auto* compare = get_if<DepthCompare>(&event);
    if (!compare) continue;
    const Slice slice = slice_at(session, lines, at);
    CAPTURE(at);
    REQUIRE(slice.compare);
    CHECK(slice.compare->z == compare->z);
    CHECK(slice.compare->x == compare->x);
    CHECK(slice.compare->nearer == compare->nearer);
    CHECK(slice.compare->stored == session.state().machine.fragment->stored);
    ++compares;
  }
  CHECK(compares == 49);
  const auto hidden = trace.next(0, [](const RecordedEvent& e) {
    const auto* compare = get_if<DepthCompare>(&e.event);
    return compare && compare->z == 6 && !compare->nearer;
  });
  REQUIRE(hidden);
  CHECK(sentence_at(session, lines, *hidden) == "At x = 2, 6 < 5 is false: B is not nearer than A.");
  // After the write what was stored is gone, and nothing is held against it.
  const auto written = trace.next(0, [](const RecordedEvent& e) { return holds<DepthWrite>(e.event); });
  CHECK(slice_at(session, lines, *written).compare->written);
  CHECK(sentence_at(session, lines, *written).empty());
}

TEST_CASE("the slice of an attribute has what the run found, and what it would be if it were linear on the picture") {
  Lesson lesson = find_lesson("perspective-correct");
  const Trace trace = run_lesson(lesson);
  const auto with_linear =
      std::find_if(lesson.stops.begin(), lesson.stops.end(), [](const Stop& stop) { return !stop.beside.empty(); });
  REQUIRE(with_linear != lesson.stops.end());
  int seen = 0, apart = 0;
  for (const Trace* run : {&trace, with_linear->beside[0].run.get()}) {
    const bool linear = run != &trace;
    Session session(*run, nullptr);
    for (std::int64_t at = 1; at <= run->size(); at += 7) {
      const Event event = run->event(at).event;
      const auto* found = get_if<AttributeInterpolate>(&event);
      session.go_to(at);
      const auto slice = attribute_slice(Moment(session));
      CHECK(slice.has_value() == (found != nullptr));
      if (!slice || !found) continue;
      CHECK(slice->upright);  // floor and card have one a along a scan line
      CHECK(slice->at.y == found->x);
      const auto there = std::find_if(slice->correct.begin(), slice->correct.end(),
                                      [&](const SliceSample& one) { return one.x == found->y; });
      REQUIRE(there != slice->correct.end());
      CHECK(found->attribute == doctest::Approx(linear ? slice->compare->stored : there->z));
      apart += std::abs(slice->compare->stored - there->z) > 0.1 ? 1 : 0;
      ++seen;
    }
  }
  CHECK(seen > 200);
  CHECK(apart > 100);
}

TEST_CASE("where flags tell which polygons are there, the slice has their planes and the nearest of them") {
  const Trace trace = golden("scan-line");
  Session session(trace, nullptr);
  SliceLines lines;
  int decided = 0;
  for (std::int64_t at = 1; at <= trace.size(); ++at) {
    if (!holds<SpanWinner>(trace.event(at).event)) continue;
    const Slice slice = slice_at(session, lines, at);
    if (slice.rivals.size() < 2) continue;
    CAPTURE(at);
    REQUIRE(slice.winner);
    for (const SliceSample& rival : slice.rivals) {
      const auto nearest = std::min_element(slice.rivals.begin(), slice.rivals.end(),
                                            [](const SliceSample& a, const SliceSample& b) { return a.z < b.z; });
      CHECK((rival.polygon != *slice.winner || rival.z == nearest->z));
      // It lies on its polygon's line.
      bool on_line = false;
      for (const SliceSpan& span : slice.spans)
        if (span.polygon == rival.polygon && rival.x >= span.x_left - 1e-9 && rival.x <= span.x_right + 1e-9)
          on_line = on_line ||
                    std::abs(span.z_left +
                             (span.z_right - span.z_left) * ((rival.x - span.x_left) / (span.x_right - span.x_left)) -
                             rival.z) < 1e-9;
      CHECK(on_line);
    }
    CHECK(slice_sentence(Moment(session), slice).find(" is nearest.") != std::string::npos);
    ++decided;
  }
  CHECK(decided > 3);
}

TEST_CASE("a pixel that is selected or pointed at has the slice of its scan line, the step at work else") {
  const Trace trace = golden("delhi");
  Session session(trace, nullptr);
  CHECK_FALSE(slice_line(Moment(session), std::nullopt));
  session.go_to(120);
  const auto usual = slice_line(Moment(session), std::nullopt);
  REQUIRE(usual);
  CHECK(usual->y == *session.state().machine.scan_line);
  CHECK(slice_line(Moment(session), Cell{3, 7})->y == 7);
}

TEST_CASE("law: the window with the slice is the same, walked to or jumped to, and the pane as the picture of it") {
  for (const char* name : {"delhi", "scan-line", "shadow-buffer", "transparency"}) {
    CAPTURE(name);
    const Trace trace = golden(name);
    App walked(trace, nullptr, {}, 1280, 720);
    test::press(walked, SDLK_s, KMOD_LSHIFT);
    REQUIRE(walked.lead() == slice_pane.id);
    PictureOptions options;
    options.pane = "slice";
    options.width = 700, options.height = 300;
    const std::int64_t from = trace.size() / 2;
    walked.session().go_to(from);
    for (int i = 0; i < 24; ++i) {
      test::press(walked, SDLK_RIGHT);
      walked.frame();
      if (i % 6 != 0) continue;
      const std::int64_t at = walked.session().position();
      CAPTURE(at);
      App jumped(trace, nullptr, {}, 1280, 720);
      jumped.set_lead(slice_pane.id);
      jumped.session().go_to(at);
      const bool same = test::picture(walked) == test::picture(jumped);
      CHECK(same);
      App pane(trace, nullptr, {}, 700, 300);
      REQUIRE(pane.show_only("slice"));
      pane.session().go_to(trace.size());
      (void)test::picture(pane);
      pane.session().go_to(at);
      const bool pane_same = test::picture(pane) == Pictures(trace, options).at(at).rgb;
      CHECK(pane_same);
    }
  }
}

TEST_CASE("depths that rounding alone sets apart have an axis with room for numbers") {
  const Trace trace = golden("with-attribute");
  Session session(trace, nullptr);
  SliceLines lines;
  int told_apart_by_rounding = 0;
  for (std::int64_t at = 1; at <= trace.size(); ++at) {
    session.go_to(at);
    const Moment now(session);
    const auto line = slice_line(now, std::nullopt);
    if (!line) continue;
    CAPTURE(at);
    const Slice slice = slice_of(now, lines, *line);
    CHECK(slice.high - slice.low > 1e-9 * std::abs(slice.high));
    for (const SliceSpan& span : slice.spans)
      if (span.z_left != span.z_right && std::abs(span.z_left - span.z_right) < 1e-12) ++told_apart_by_rounding;
  }
  CHECK(told_apart_by_rounding > 0);
}

TEST_CASE("a method without scan lines has no slice, and says so") {
  const Trace trace = golden("ray-casting");
  App app(trace, nullptr, {}, 1280, 720);
  test::press(app, SDLK_s, KMOD_LSHIFT);
  CHECK(app.lead().empty());
  CHECK(app.session().message.find("no slice") != std::string::npos);
  CHECK_FALSE(app.show_only("slice"));
}

TEST_CASE("where z_v is interpolated as if it were linear, the slice names the true depth") {
  Lesson lesson = find_lesson("which-z");
  const Trace trace = run_lesson(lesson);
  App app(trace, &lesson, {}, 1280, 720);
  app.session().to_stop(10);  // the wall in the middle of the picture: 25 is interpolated, 16 is true
  app.settle();
  const auto says = [&](const std::string& text) {
    const test::Letters drawn = test::letters_of(app.ui().fonts);
    return std::any_of(drawn.words.begin(), drawn.words.end(),
                       [&](const std::string& words) { return words.find(text) != std::string::npos; });
  };
  CHECK(says("true 16"));
  CHECK(says("true depth"));
  app.session().go_to(0);
  app.settle();
  CHECK_FALSE(says("true depth"));
}

namespace {

/// Whether the window of a lesson's stop writes this; after its answer where `answered`.
bool writes(const char* id, int stop, const std::string& text, bool answered = false) {
  Lesson lesson = find_lesson(id);
  const Trace trace = run_lesson(lesson);
  App app(trace, &lesson, {}, 1280, 720);
  app.session().to_stop(stop);
  if (answered) app.session().show_answer();
  app.settle();
  const test::Letters drawn = test::letters_of(app.ui().fonts);
  return std::any_of(drawn.words.begin(), drawn.words.end(),
                     [&](const std::string& words) { return words.find(text) != std::string::npos; });
}

}  // namespace

TEST_CASE("in fixed point the slice has whole units, and what the depths are without rounding") {
  for (const char* text : {"z* in units", "C exactly 65234.07", "R exactly 65233.66", "stored 65234"}) {
    CAPTURE(text);
    CHECK(writes("how-many-bits", 9, text));
  }
}

TEST_CASE("beside the slice in z* one in z_v has the depth that a straight line would give") {
  CHECK(writes("z-buffer", 16, "linear 37.21"));
  CHECK(writes("z-buffer", 16, "B 33.39"));
  CHECK_FALSE(writes("z-buffer", 15, "33.39"));  // asked there
}

TEST_CASE("the depth curve is marked at the stop's view depths once its question is answered") {
  const std::string middle = "18 \u2192 0";
  CHECK_FALSE(writes("z-buffer", 14, middle));
  CHECK(writes("z-buffer", 14, middle, true));
  CHECK(writes("z-buffer", 14, "near 10 \u2192 \u22121"));
}
