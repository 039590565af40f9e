// What --describe prints: what the window shows at a step, all of it in words.
#include "sim/viewer/commands.hpp"
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
  CHECK(text.find("\nTable: ACTIVE EDGES\nedge e0, x 12.27, 1 over m 0.14, z star 0.46, leaves 23, left\n") !=
        std::string::npos);
}

TEST_CASE(
    "lists for a page: every table that is drawn, each row with as many cells as it has headings, and every command") {
  const auto parted = [](const std::string& text, char by) {
    std::vector<std::string> parts{""};
    for (const char c : text)
      if (c == by) parts.emplace_back();
      else parts.back() += c;
    return parts;
  };
  Lesson lesson = find_lesson("z-buffer");
  const Trace trace = run_lesson(lesson);
  App app(trace, &lesson, {}, 1600, 900);
  app.turn_laboratory();
  app.session().go_to(867);
  app.settle();
  std::vector<TableSeen> tables;
  app.ui().tables_seen = &tables;
  app.frame();
  app.ui().tables_seen = nullptr;
  const std::vector<std::string> groups = parted(tables_as_list(tables), '\x1d');
  REQUIRE(groups.size() == 2);
  const char* const titles[] = {"EDGE TABLE", "ACTIVE EDGES"};
  const std::size_t rows_of[] = {3, 2};
  for (std::size_t k = 0; k < 2; ++k) {
    const std::vector<std::string> rows = parted(groups[k], '\x1e');
    CHECK(rows[0] == titles[k]);
    CHECK(rows.size() == rows_of[k] + 2);
    for (std::size_t row = 2; row < rows.size(); ++row)
      CHECK(parted(rows[row], '\x1f').size() == parted(rows[1], '\x1f').size());
  }
  CHECK(tables_as_list({}).empty());
  std::size_t listed = 0;
  for (const std::string& group : parted(commands_as_list(), '\x1d')) {
    const std::vector<std::string> rows = parted(group, '\x1e');
    for (std::size_t row = 1; row < rows.size(); ++row, ++listed) {
      const std::vector<std::string> cells = parted(rows[row], '\x1f');
      REQUIRE(cells.size() == 3);
      REQUIRE(command_called(cells[0]));
      CHECK(cells[1] == command_called(cells[0])->title);
      CHECK(rows[0] == command_called(cells[0])->group);
    }
  }
  CHECK(listed == commands().size());
}
