// docs/glossary.md has every term that a lesson introduces in bold, in one sentence, with the lessons that teach it.
#include <algorithm>
#include <cctype>
#include <fstream>
#include <map>
#include <set>
#include <sstream>

#include <doctest/doctest.h>

#include "sim/classroom/markdown.hpp"
#include "tests/laws/course.hpp"
#include "tests/where.hpp"

namespace zstep {
namespace {

std::string lower(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(), [](unsigned char c) { return std::tolower(c); });
  return text;
}

struct Entry {
  std::string meaning;
  std::set<std::string> lessons;  ///< names of their files
};

/// The rows of three columns: term, meaning, links to lessons.
std::vector<std::pair<std::string, Entry>> glossary() {
  std::vector<std::pair<std::string, Entry>> entries;
  std::ifstream in(test::in_checkout("docs/glossary.md"));
  for (std::string line; std::getline(in, line);) {
    std::vector<std::string> columns;
    std::istringstream row(line);
    for (std::string column; std::getline(row, column, '|');) {
      const std::size_t first = column.find_first_not_of(' ');
      if (first != std::string::npos) columns.push_back(column.substr(first, column.find_last_not_of(' ') + 1 - first));
    }
    const std::string folder = "(../lessons/";
    if (columns.size() != 3 || columns[2].find(folder) == std::string::npos) continue;
    Entry entry{columns[1], {}};
    for (std::size_t at = columns[2].find(folder); at != std::string::npos; at = columns[2].find(folder, at)) {
      at += folder.size();
      entry.lessons.insert(columns[2].substr(at, columns[2].find(')', at) - at));
    }
    entries.emplace_back(columns[0], entry);
  }
  return entries;
}

/// What a lesson introduces in bold, in small letters.
std::set<std::string> terms_of(const Lesson& lesson) {
  std::set<std::string> terms;
  for (const Stop& stop : lesson.stops) {
    std::string text = stop.text;
    if (stop.question)
      for (const Answer& answer : stop.question->answers) text += "\n\n" + answer.reply;
    for (const TextBlock& block : parse_markdown(text))
      for (const TextRun& run : block.runs)
        if (run.bold) terms.insert(lower(run.text));
  }
  return terms;
}

TEST_CASE("the glossary has every term of the lessons, and names the lessons that introduce it") {
  std::map<std::string, std::set<std::string>> taught;
  for (const Lesson& lesson : test::course().told)
    for (const std::string& term : terms_of(lesson)) taught[term].insert(lesson.path.filename().string());
  std::string before;
  for (const auto& named : glossary()) {
    const auto& [term, entry] = named;
    CAPTURE(named.first);
    CHECK(lower(before) < lower(term));
    before = term;
    CHECK(entry.meaning.size() >= 20);
    CHECK(entry.meaning.find(". ") == std::string::npos);
    const auto found = taught.find(lower(term));
    REQUIRE(found != taught.end());
    for (const std::string& lesson : entry.lessons) CHECK_MESSAGE(found->second.count(lesson) == 1, lesson);
    for (const std::string& lesson : found->second) CHECK_MESSAGE(entry.lessons.count(lesson) == 1, lesson);
    taught.erase(found);
  }
  for (const auto& [term, lessons] : taught)
    FAIL_CHECK(term << " of " << *lessons.begin() << " is not in docs/glossary.md");
}

}  // namespace
}  // namespace zstep
