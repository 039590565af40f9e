// What --describe prints: what the window shows at a step, all of it in words.
#include "sim/viewer/description.hpp"

#include <doctest/doctest.h>

#include <set>
#include <string>

#include "sim/classroom/lesson.hpp"
#include "sim/words/explain.hpp"
#include "sim/words/spoken.hpp"
#include "tests/golden/golden.hpp"
#include "traces/replay/replay.hpp"

using namespace zstep;
using namespace zstep::viewer;

namespace {

std::string described_at(const Trace& trace, std::int64_t at, const Lesson* lesson = nullptr) {
  ViewerOptions options;
  options.at = at, options.lesson = lesson;
  return described(trace, options);
}

/// A line of it with what is no letter, digit or mark of a sentence.
std::string unspeakable_line(const std::string& text) {
  std::size_t begin = 0;
  for (std::size_t at = 0; at < text.size(); ++at) {
    const char c = text[at];
    if (c == '\n') begin = at + 1;
    const bool speaks = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') ||
                        std::string_view(" .,:;?!()'\"-\n").find(c) != std::string_view::npos;
    if (!speaks) return text.substr(begin, text.find('\n', at) - begin);
  }
  return {};
}

}  // namespace

TEST_CASE("described: every golden trace, the sentence, each formula, tables, and nothing but words") {
  int tables = 0, traces = 0;
  std::set<std::string> titles;
  test::for_each_golden([&](const std::string& name, const Trace& trace) {
    ++traces;
    for (const int quarter : {traces % 4 + 1, traces == 1 ? 0 : (traces + 2) % 4 + 1}) {  // each draws all panes
      const std::int64_t at = trace.size() * quarter / 4;
      const std::string text = described_at(trace, at);
      CAPTURE(name);
      CAPTURE(at);
      CHECK(unspeakable_line(text) == "");
      for (std::size_t t = text.find("\nTable: "); t != std::string::npos; t = text.find("\nTable: ", t + 1))
        ++tables, titles.insert(text.substr(t + 8, text.find('\n', t + 1) - t - 8));
      if (at == 0) {
        CHECK(text.find("Nothing has happened yet.") != std::string::npos);
        continue;
      }
      Replay replay(trace);
      replay.go_to(at);
      const Explanation told = explain(trace, replay.state(), trace.event(at));
      CHECK(text.find(words::spoken(told.sentence)) != std::string::npos);
      for (const std::string& formula : told.formulas)
        CHECK(text.find("\n" + words::spoken_formula(formula) + "\n") != std::string::npos);
    }
  });
  CHECK(tables > 50);
  CHECK(titles.count("EDGE TABLE") == 1);
  CHECK(titles.count("ACTIVE EDGES") == 1);
  CHECK(titles.size() > 5);
}

TEST_CASE("described: a lesson's stop, its question and the answers, but not which is right") {
  Lesson lesson = find_lesson("z-buffer");
  const Trace trace = run_lesson(lesson);
  int asked = 0;
  for (const Stop& stop : lesson.stops) {
    if (!stop.question) continue;
    const std::string text = described_at(trace, stop.position, &lesson);
    CHECK(unspeakable_line(text) == "");
    CHECK(text.find("Lesson: " + words::spoken(lesson.title) + ", stop ") != std::string::npos);
    const std::size_t at = text.find("\nQuestion\n");
    if (at == std::string::npos) continue;  // another stop speaks at the same step
    ++asked;
    int listed = 0;
    for (std::size_t k = 1; text.find("\nAnswer " + std::to_string(k) + ": ", at) != std::string::npos; ++k) ++listed;
    CHECK(listed >= 2);
    for (const Answer& answer : stop.question->answers)
      if (!answer.reply.empty()) CHECK(text.find(words::spoken(answer.reply)) == std::string::npos);
  }
  CHECK(asked > 0);
}

TEST_CASE("described: a row of a table as it is drawn, with its headings") {
  Lesson lesson = find_lesson("z-buffer");
  const Trace trace = run_lesson(lesson);
  const std::string text = described_at(trace, 867, &lesson);
  CHECK(text.find("\nTable: ACTIVE EDGES\nedge e0, x 12.27, z star 0.46, leaves 23, left\n") != std::string::npos);
}
