// Blocks of code in panes narrower than their lines.
#include <algorithm>
#include <string>
#include <vector>

#include <doctest/doctest.h>

#include "sim/classroom/lesson.hpp"
#include "sim/classroom/markdown.hpp"
#include "sim/viewer/panes/pseudo_code.hpp"

using namespace zstep;
using namespace zstep::viewer;

namespace {

std::vector<std::string> shown_code(const std::string& code, int columns) {
  std::vector<std::string> all;
  for (const CodeLine& line : code_lines(code, columns)) {
    const std::string indent(static_cast<std::size_t>(line.indent), ' ');
    all.push_back((line.continues ? ">" + indent.substr(1) : indent) + line.text);
  }
  return all;
}
using ShownLines = std::vector<std::string>;

int columns_in(const std::string& text) {
  return static_cast<int>(
      std::count_if(text.begin(), text.end(), [](char c) { return (static_cast<unsigned char>(c) & 0xc0u) != 0x80u; }));
}

std::string letters_alone(std::string text) {
  std::erase_if(text, [](char c) { return c == ' ' || c == '\n'; });
  return text;
}

}  // namespace

TEST_CASE("what fits stays as it is") {
  CHECK(shown_code("a = 1\n\n    + 2", 20) == ShownLines{"a = 1", "", "    + 2"});
  CHECK(shown_code("", 20) == ShownLines{""});
}

TEST_CASE("a line breaks at spaces, before a sign where it can, and goes on behind a mark") {
  CHECK(shown_code("frame[x,y] = \u03b1 \u00b7 colour of P", 16) ==
        ShownLines{"frame[x,y] = \u03b1", "> \u00b7 colour of P"});
  CHECK(shown_code("t = d_0 / (d_0 \u2212 d_1)", 12) == ShownLines{"t = d_0", "> / (d_0", "> \u2212 d_1)"});
  CHECK(shown_code("t = d_0 / (d_0 \u2212 d_1)", 16) == ShownLines{"t = d_0", "> / (d_0 \u2212 d_1)"});
  CHECK(shown_code("A = 0.4472, B = 0.8944, C = 0", 16) == ShownLines{"A = 0.4472,", "> B = 0.8944,", "> C = 0"});
  CHECK(shown_code("t (1 \u2212 t) (z_1 \u2212 z_0)", 16) == ShownLines{"t (1 \u2212 t)", "> (z_1 \u2212 z_0)"});
  CHECK(shown_code("red = 0.2\u00b71+0.16\u00b70.4+0.64\u00b70.6", 16) ==
        ShownLines{"red =", "> 0.2\u00b71+0.16\u00b70.4", "> +0.64\u00b70.6"});
  CHECK(shown_code("            + 0.5 \u00b7 frame", 12) == ShownLines{"  + 0.5", "> \u00b7 frame"});
  CHECK(shown_code("\"z\":6.0,\"nearer\":true", 16) == ShownLines{"\"z\":6.0,", "> \"nearer\":true"});
  CHECK(shown_code("abcdefghijkl", 5) == ShownLines{"abcde", "> fgh", "> ijk", "> l"});
}

TEST_CASE("a table keeps its columns: its rows break where all of them do") {
  CHECK(shown_code("polygons   100   ?  60000\n"
                   "depth sort   1  10    507\n"
                   "Z-buffer    54  54     54",
                   16) ==
        ShownLines{"polygons", "  100   ?  60000", "depth sort", "    1  10    507", "Z-buffer", "   54  54     54"});
  CHECK(shown_code("      x_v  y_v\nC     -16  -12", 11) == ShownLines{"  x_v  y_v", "C", "  -16  -12"});
}

TEST_CASE("law: a block of a lesson breaks in panes of any width, loses nothing, and leaves no letter outside") {
  int blocks = 0;
  for (Lesson& lesson : all_lessons()) {
    CAPTURE(lesson.id);
    run_lesson(lesson);
    for (const Stop& stop : lesson.stops)
      for (const TextBlock& block : parse_markdown(stop.text)) {
        if (block.kind != TextBlock::Kind::code) continue;
        const std::string& code = block.runs.front().text;
        CAPTURE(code);
        ++blocks;
        for (int columns = 8; columns < 60; ++columns) {
          CAPTURE(columns);
          std::string all;
          for (const CodeLine& line : code_lines(code, columns)) {
            REQUIRE(line.indent + columns_in(line.text) <= columns);
            all += line.text;
          }
          REQUIRE(letters_alone(all) == letters_alone(code));
        }
      }
  }
  CHECK(blocks > 30);
}
