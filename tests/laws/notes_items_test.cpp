// Law: what the lecture notes teach is shown, each item at the stop that tests/notes/items.md names, by what holds
// there.
#include <doctest/doctest.h>

#include <filesystem>
#include <map>
#include <sstream>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "sim/classroom/lesson.hpp"
#include "tests/folder.hpp"
#include "tests/where.hpp"
#include "traces/error.hpp"

namespace zstep {
namespace {

namespace fs = std::filesystem;

struct Item {
  int line = 0;
  std::string item, lesson, stop, shows;  ///< shows: claims in braces; "—" where the stop says it in words
};

/// The cells of a row, without the blanks around them; a bar inside one is written \|.
std::vector<std::string> cells_of(const std::string& row) {
  std::vector<std::string> cells;
  std::string cell;
  for (std::size_t i = 1; i < row.size(); ++i) {
    if (row[i] == '\\' && i + 1 < row.size() && row[i + 1] == '|') {
      cell += row[++i];
    } else if (row[i] == '|') {
      const std::size_t from = cell.find_first_not_of(' ');
      cells.push_back(from == cell.npos ? "" : cell.substr(from, cell.find_last_not_of(' ') - from + 1));
      cell.clear();
    } else {
      cell += row[i];
    }
  }
  return cells;
}

/// The rows that name a lesson, a stop and what shows it.
std::vector<Item> items() {
  std::vector<Item> all;
  std::istringstream lines(test::text_of(test::in_checkout("tests/notes/items.md")));
  int number = 0;
  for (std::string line; std::getline(lines, line);) {
    ++number;
    if (line.empty() || line[0] != '|') continue;
    const std::vector<std::string> cells = cells_of(line);
    if (cells.size() == 4 && cells[0] != "item" && cells[0].find("---") == cells[0].npos)
      all.push_back({number, cells[0], cells[1], cells[2], cells[3]});
  }
  return all;
}

TEST_CASE("law: each item of the lecture notes is shown at its stop") {
  std::map<std::string, std::vector<Item>> by_lesson;
  int shown = 0, in_words = 0;
  for (const Item& item : items()) {
    by_lesson[item.lesson].push_back(item);
    ++(item.shows.find('{') == std::string::npos ? in_words : shown);
  }
  // Beside it what lessons open.
  const test::Folder folder;
  for (const char* beside : {"scenes", "runs", "homework"})
    fs::create_directory_symlink(test::in_checkout(std::string("lessons/") + beside), folder / beside);
  for (const auto& entry : by_lesson) {
    const std::string& id = entry.first;
    CAPTURE(id);
    const Lesson lesson = find_lesson(id);
    std::string text = test::text_of(lesson.path);
    for (const Item& item : entry.second) {
      const std::string where = fmt::format("tests/notes/items.md:{}: {}", item.line, item.item);
      CAPTURE(where);
      const std::size_t heading = text.find("\n## " + item.stop + " {");
      REQUIRE(heading != std::string::npos);
      if (item.shows.find('{') == std::string::npos) continue;
      const std::size_t end = text.find('\n', heading + 1);
      text.insert(end + 1, "\n" + item.shows + "\n");
    }
    std::string wrong;
    try {
      Lesson with_claims = load_lesson(folder.write(fs::path(lesson.path).filename().string(), text));
      run_lesson(with_claims);
    } catch (const InputError& error) {
      wrong = error.what();
    }
    CHECK_MESSAGE(wrong == "", wrong);
  }
  MESSAGE(shown, " items are shown by what holds at their stop, ", in_words, " in words");
  CHECK(shown + in_words >= 150);
}

}  // namespace
}  // namespace zstep
