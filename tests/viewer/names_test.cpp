// What a lesson's text names stands in its picture under the same name.
#include <algorithm>
#include <string>
#include <vector>

#include <doctest/doctest.h>

#include "sim/classroom/lesson.hpp"
#include "tests/viewer/letters.hpp"

using namespace zstep;
using namespace zstep::viewer;

namespace {

struct Shown {
  std::vector<std::string> words;
  std::vector<test::Letter> letters;
  std::ptrdiff_t count(const std::string& word) const { return std::count(words.begin(), words.end(), word); }
  /// In bold, with a letter below: formulas have none in bold.
  std::ptrdiff_t symbols(const std::string& letter, const std::string& below) const {
    std::ptrdiff_t found = 0;
    for (std::size_t k = 0; k + 1 < letters.size(); ++k) {
      const test::Letter &one = letters[k], &next = letters[k + 1];
      found += one.bold && words[one.word] == letter && next.word == one.word + 1 && words[next.word] == below &&
               next.first.y > one.first.y && next.first.x - one.last.x < one.size / 4;
    }
    return found;
  }
};

Shown words_at(const char* id, int stop, bool presenter = false) {
  Lesson lesson = find_lesson(id);
  const Trace trace = run_lesson(lesson);
  Settings settings;
  settings.presenter = presenter;
  App app(trace, &lesson, settings, presenter ? 1920 : 1280, presenter ? 1080 : 720);
  app.session().to_stop(stop - 1);
  app.settle();
  test::Letters drawn = test::letters_of(app.ui().fonts);
  return {std::move(drawn.words), std::move(drawn.all)};
}

}  // namespace

TEST_CASE("edges have the names of the edge table at the outline, those that come into it next, too") {
  for (const bool presenter : {false, true}) {
    CAPTURE(presenter);
    const Shown first = words_at("edge-table", 3, presenter);  // only e0 is in the table by then
    for (const char* name : {"e1", "e2", "e3", "e4", "e5"}) CHECK(first.count(name) == 1);
    CHECK(first.count("e0") >= 1);
    const Shown span = words_at("edge-table", 12, presenter);
    CHECK(span.symbols("x", "L") == 1);
    CHECK(span.symbols("x", "R") == 1);
    // At the outline and among the active edges; in the table, too, where it stands apart from its scan line.
    CHECK(span.count("e0") == (presenter ? 2 : 3));
  }
  CHECK(words_at("z-buffer", 8).count("e0") == 0);  // where pixels are compared
}

TEST_CASE("an edge at work is named with its vertices, and so is the polygon that it is tested against") {
  for (const bool presenter : {false, true}) {
    CAPTURE(presenter);
    const Shown crosses = words_at("hidden-line", 7, presenter);
    for (const char* name : {"edge 0", "0", "1", "P", "t = 0.35"}) CHECK_MESSAGE(crosses.count(name) >= 1, name);
    CHECK(words_at("wireframe", 9, presenter).count("edge 6") == 1);
  }
}

TEST_CASE(
    "the scene shows a polygon's normal where its facing is tested, and those at vertices where light is computed") {
  for (const bool presenter : {false, true}) {
    CAPTURE(presenter);
    const Shown facing = words_at("back-faces", 2, presenter);
    for (const char* name : {"n", "p \u2212 e"}) CHECK_MESSAGE(facing.count(name) == 1, name);
    CHECK(words_at("back-faces", 1, presenter).count("n") == 0);
    const Shown vertex = words_at("light-at-vertices", 4, presenter);
    for (const char* name : {"n", "l"}) CHECK_MESSAGE(vertex.count(name) == 1, name);
  }
}

TEST_CASE("polygons are named at their outlines over Warnock's areas") {
  const Shown shown = words_at("warnock", 3);
  CHECK(shown.count("C") == 2);  // among the polygons of the timeline, too
}

TEST_CASE("the rays from above show what the text speaks of: a miss, boxes by their numbers, the window") {
  for (const bool presenter : {false, true}) {
    CAPTURE(presenter);
    const Shown miss = words_at("ray-casting", 4, presenter);
    CHECK(miss.count("t = 3") == 1);
    CHECK(miss.count("window") == 1);
    const Shown missed = words_at("ray-casting", 15, presenter);
    for (const char* name : {"box 0", "box 1", "box 4"}) CHECK_MESSAGE(missed.count(name) == 1, name);
  }
}

TEST_CASE("symbols in a lesson's text are set with their subscripts, names of files and steps are not") {
  const Shown shown = words_at("which-z", 1);
  CHECK(shown.count("v") == 3);  // of z_v
  for (const std::string& word : shown.words) CHECK_MESSAGE(word.find("z_v") == std::string::npos, word);
  // In code, too: a formula in columns, and one within a sentence.
  for (const std::string& word : words_at("near-and-far", 2).words)
    CHECK_MESSAGE(word.find("z_v") == std::string::npos, word);
  const Shown files = words_at("find-the-bug", 6);
  CHECK(std::any_of(files.words.begin(), files.words.end(),
                    [](const std::string& word) { return word.find("write_pixel") != std::string::npos; }));
}

TEST_CASE("a plan shows the vertex that a cut makes, and the surface of a floating horizon its curves alone") {
  CHECK(words_at("bsp", 6).count("24") == 1);
  CHECK(words_at("floating-horizon", 1).count("A") == 0);
}
