// zstep grade --batch: a class, with submissions that are not what they should be.
#include <doctest/doctest.h>

#include <signal.h>
#include <sys/stat.h>
#include <sys/wait.h>

#include <filesystem>
#include <regex>
#include <string>
#include <vector>

#include "tests/cli/homework_runs.hpp"

using namespace zstep::test;

namespace {

namespace fs = std::filesystem;

void hand_in(const Folder& folder, const std::string& name) {
  fs::create_directories(folder / "class");
  fs::copy(folder / "runs", folder / "class" / name);
}

/// Cells by row and column, as RFC 4180 has them.
std::vector<std::vector<std::string>> table_of(const std::string& csv) {
  std::vector<std::vector<std::string>> rows;
  std::vector<std::string> row;
  std::string cell;
  bool quoted = false;
  for (std::size_t i = 0; i < csv.size(); ++i) {
    const char c = csv[i];
    if (quoted) {
      if (c != '"') cell += c;
      else if (i + 1 < csv.size() && csv[i + 1] == '"') cell += csv[++i];
      else quoted = false;
    } else if (c == '"') {
      quoted = true;
    } else if (c == ',' || c == '\n') {
      row.push_back(cell);
      cell.clear();
      if (c == '\n') rows.push_back(row), row.clear();
    } else if (c != '\r') {
      cell += c;
    }
  }
  return rows;
}
const std::vector<std::string>& row_of(const std::vector<std::vector<std::string>>& table, const std::string& name) {
  for (const auto& row : table)
    if (row.at(0) == name) return row;
  FAIL("no row of " << name);
  return table.front();
}
constexpr std::size_t points = 1, of = 2, state = 3, why = 4, first_part = 5, first_wrong = 11;

}  // namespace

TEST_CASE("grade --batch: every submission has a row, and bad ones say why and stop nothing") {
  const Folder folder;
  set_up_runs(folder);
  hand_in(folder, "ada");
  hand_in(folder, "=1+1");
  hand_in(folder, "Müller, \"Max\"");
  hand_in(folder, "wrong");
  std::string lines = text_of(folder / "runs/crossing.jsonl");
  replace_first(lines, "\"nearer\":true", "\"nearer\":false");
  write_text(folder / "class/wrong/crossing.jsonl", lines);
  fs::create_directory(folder / "class/empty");
  fs::create_directory(folder / "class/binary");
  write_text(folder / "class/binary/crossing.jsonl", std::string("\0\1\2\xff", 4));
  hand_in(folder, "half");
  fs::remove(folder / "class/half/crossing.jsonl");
  // Links and special files.
  fs::create_directory_symlink(folder / "runs", folder / "class/link");
  fs::create_directory(folder / "class/linked-file");
  fs::create_symlink(folder / "runs/crossing.jsonl", folder / "class/linked-file/crossing.jsonl");
  fs::create_directory(folder / "class/pipe");
  REQUIRE(mkfifo((folder / "class/pipe/crossing.jsonl").c_str(), 0600) == 0);
  REQUIRE(mkfifo((folder / "class/pipe.jsonl").c_str(), 0600) == 0);
  hand_in(folder, "new\nline");
  hand_in(folder, "a\\..\\up");
  write_text(folder / "class/single.jsonl", lines);
  write_text(folder / "class/.DS_Store", "x");

  const Outcome outcome = run(folder, "grade --homework hw --batch class --jobs 2 -o book.csv");
  CAPTURE(outcome.out);
  CAPTURE(outcome.err);
  CHECK(outcome.code == 1);
  CHECK(has(outcome.out, "wrote book.csv: 14 submissions: 4 graded, 1 partly graded, 8 ungradable, 1 missing\n"));
  CHECK(has(outcome.out, "names that begin with a dot, left out: 1\n"));
  const std::string csv = text_of(folder / "book.csv");
  CAPTURE(csv);
  const auto table = table_of(csv);
  REQUIRE(table.size() == 15);
  CHECK(table[0] == std::vector<std::string>{"name", "points", "of", "state", "why", "picture and depths", "compares",
                                             "writes", "spans", "edge table", "active edges", "first wrong step",
                                             "likely mistake"});
  for (const auto& row : table) CHECK(row.size() == table[0].size());
  for (const char* name : {"ada", "'=1+1", "Müller, \"Max\""}) {
    CAPTURE(name);
    CHECK(row_of(table, name)[points] == "65.00");
    CHECK(row_of(table, name)[state] == "graded");
    CHECK(row_of(table, name)[first_wrong].empty());
  }
  const auto wrong = row_of(table, "wrong");
  CHECK(std::stod(wrong[points]) < 65);
  CHECK(std::stod(wrong[points]) > 60);
  CHECK(wrong[of] == "65.00");
  double sum = 0;
  for (std::size_t part = first_part; part < first_wrong; ++part) sum += std::stod(wrong[part]);
  CHECK(sum == doctest::Approx(std::stod(wrong[points])).epsilon(0.001));
  CHECK(has(wrong[first_wrong], "crossing, class/wrong/crossing.jsonl:"));
  CHECK(has(wrong[first_wrong], "compare, pixel"));
  const auto half = row_of(table, "half");
  CHECK(half[state] == "partly graded");
  CHECK(half[points] == "48.75");
  CHECK(has(half[why], "crossing: there is no crossing.jsonl"));
  CHECK(row_of(table, "empty")[state] == "missing");
  CHECK(row_of(table, "empty")[why] == "nothing was handed in");
  struct Bad {
    const char *name, *why;
  };
  for (const Bad& bad : {Bad{"binary", "crossing.jsonl"},
                         {"link", "is a link"},
                         {"linked-file", "crossing.jsonl is a link"},
                         {"pipe", "crossing.jsonl is a pipe"},
                         {"pipe.jsonl", "is a pipe"},
                         {"new\\nline", "rename it"},
                         {"a\\..\\up", "rename it"},
                         {"single.jsonl", "is named after no scene"}}) {
    CAPTURE(bad.name);
    const auto row = row_of(table, bad.name);
    CHECK(row[state] == "ungradable");
    CHECK(has(row[why], bad.why));
  }
  for (const auto& row : table)
    if (row[state] == "ungradable" || row[state] == "missing") {
      CAPTURE(row[0]);
      CHECK(row[points].empty());
      for (std::size_t part = first_part; part < first_wrong; ++part) CHECK(row[part].empty());
      CHECK_FALSE(row[why].empty());
    }
}

TEST_CASE("grade --batch: the page of the class says what fails most, and nothing in a name acts in it") {
  const Folder folder;
  set_up_runs(folder);
  for (const char* name : {"ada", "bob", "cy", "<b>&\"'", "=x"}) hand_in(folder, name);
  std::string lines = text_of(folder / "runs/triangle.jsonl");
  replace_first(lines, "\"nearer\":true", "\"nearer\":false");
  for (const char* name : {"bob", "cy"}) write_text(folder / "class" / name / "triangle.jsonl", lines);
  fs::create_directory(folder / "class/empty");
  const Outcome outcome = run(folder, "grade --homework hw --batch class -o book.csv --report class.html");
  CAPTURE(outcome.err);
  CHECK(outcome.code == 0);
  CHECK(has(outcome.out, "wrote class.html: the class on one page\n"));
  const std::string page = text_of(folder / "class.html");
  CAPTURE(page);
  CHECK(page.starts_with("<!doctype html>\n<html lang=\"en\">"));
  CHECK(has(page, "<p>6 submissions: 5 graded, 1 missing.</p>"));
  CHECK(page.find("<th scope=\"row\">compares</th><td class=\"n\">2</td>") <
        page.find("<th scope=\"row\">spans</th><td class=\"n\">0</td>"));
  CHECK(has(page, "<code>compare</code></th><td>triangle</td><td class=\"n\">2</td>"));
  CHECK(has(page, "<td>bob, cy</td>"));
  CHECK(has(page, "<th scope=\"row\">&lt;b&gt;&amp;&quot;'</th>"));
  CHECK(has(page, "the 5 submissions that have a grade"));
  CHECK(has(page, "<th scope=\"row\" class=\"n\">58.5 to 65</th><td class=\"n\">5</td>"));
  for (const char* never : {"<script", "src=", "href=", "<b>", "<th>"}) CHECK_FALSE(has(page, never));
}

TEST_CASE("grade --batch: goes on where it was, and grades again what changed") {
  const Folder folder;
  set_up_runs(folder);
  for (const char* name : {"ada", "bob", "cy"}) hand_in(folder, name);
  const std::string batch = "grade --homework hw --batch class -o book.csv";
  CHECK(run(folder, batch).code == 0);
  const std::string book = text_of(folder / "book.csv");
  CHECK(has(run(folder, batch).out, "3 of them had been graded before, and nothing changed\n"));
  CHECK(text_of(folder / "book.csv") == book);
  // A file with another content, of the same time and size.
  std::string lines = text_of(folder / "class/bob/triangle.jsonl");
  const auto time = fs::last_write_time(folder / "class/bob/triangle.jsonl");
  replace_first(lines, "\"nearer\":true", "\"nearer\":null");
  write_text(folder / "class/bob/triangle.jsonl", lines);
  fs::last_write_time(folder / "class/bob/triangle.jsonl", time);
  CHECK(has(run(folder, batch).out, "2 of them had been graded before"));
  CHECK(has(text_of(folder / "book.csv"), "triangle: a line that cannot be read"));
  // A result that is no whole file, as of a machine that was switched off.
  write_text(folder / "book.csv.results/ada.json", "{\"key\":");
  CHECK(has(run(folder, batch).out, "2 of them had been graded before"));
  // Another rubric.
  std::string rubric = text_of(folder / "hw/homework.toml");
  replace_first(rubric, "value = 10", "value = 20");
  write_text(folder / "hw/homework.toml", rubric);
  const Outcome again = run(folder, batch);
  CHECK_FALSE(has(again.out, "graded before"));
  CHECK(has(text_of(folder / "book.csv"), "75.00"));
}

TEST_CASE("grade --batch: a submission that takes too much time or memory has no grade, and the others have theirs") {
  const Folder folder;
  set_up_runs(folder);
  hand_in(folder, "ada");
  hand_in(folder, "large");
  std::string many;
  const std::string line = "{\"step\":\"compare\",\"x\":3,\"y\":2,\"z\":0.4375,\"nearer\":true}\n";
  while (many.size() < 160'000'000) many += line;  // more than a second's work, which is what the system counts in
  write_text(folder / "class/large/crossing.jsonl", many);
  const Outcome slow = run(folder, "grade --homework hw --batch class -o book.csv --seconds 0.01");
  CAPTURE(slow.err);
  CHECK(slow.code == 1);
  CHECK(has(text_of(folder / "book.csv"), "\"large\",,65.00,ungradable,\"the grading took more than"));
  CHECK(has(text_of(folder / "book.csv"), "\"ada\",65.00,65.00,graded,"));
  // What was not graded for lack of time is tried again.
  const Outcome later = run(folder, "grade --homework hw --batch class -o book.csv");
  CHECK(later.code == 0);
  CHECK(has(later.out, "1 of them had been graded before"));
  CHECK(has(text_of(folder / "book.csv"), "\"large\",4"));
}

TEST_CASE("grade --batch: what does not go with it is said before anything is graded") {
  const Folder folder;
  set_up_runs(folder);
  hand_in(folder, "ada");
  struct Case {
    const char *arguments, *message;
  };
  for (const Case& one :
       {Case{"--batch class", "--batch: needs a file for the gradebook; write for example -o gradebook.csv"},
        {"--batch class -o class/book.csv", "class/book.csv: lies among the submissions"},
        {"--batch nowhere -o book.csv", "nowhere: cannot be read"},
        {"runs --batch class -o book.csv", "runs: is one submission"},
        {"--batch class -o book.csv --format json", "--format: is of one submission"},
        {"--batch class -o book.csv --jobs 0", "--jobs"},
        {"--batch class -o hw/homework.toml", "hw/homework.toml: "},
        {"runs --jobs 2", "--jobs: is of a class"},
        {"", "zstep grade: what is to be graded is missing"}}) {
    CAPTURE(one.arguments);
    const Outcome outcome = run(folder, std::string("grade --homework hw ") + one.arguments);
    CAPTURE(outcome.err);
    CHECK(outcome.code == 2);
    CHECK(has(outcome.err, one.message));
    CHECK(times(outcome.err, "\n") == 1);
  }
  CHECK(folder.names() == std::vector<std::string>{"class", "hw", "runs"});
}

TEST_CASE("grade --batch: Ctrl-C keeps what is graded") {
  const Folder folder;
  set_up_runs(folder);
  for (int i = 0; i < 300; ++i) hand_in(folder, "student" + std::to_string(i));
  const pid_t grading =
      start(folder, {"grade", "--homework", "hw", "--batch", "class", "--jobs", "1", "-o", "book.csv"});
  REQUIRE(shell(folder, "while [ $(ls book.csv.results 2>/dev/null | wc -l) -lt 3 ]; do sleep 0.01; done").code == 0);
  kill(grading, SIGINT);
  int status = 0;
  REQUIRE(waitpid(grading, &status, 0) == grading);
  REQUIRE(WIFEXITED(status));
  CHECK(WEXITSTATUS(status) == 130);
  CHECK(has(text_of(folder / "err"),
            "submissions are graded and kept in book.csv.results; the same command goes on from there"));
  CHECK_FALSE(fs::exists(folder / "book.csv"));
  const Outcome rest = run(folder, "grade --homework hw --batch class -o book.csv");
  CHECK(rest.code == 0);
  CHECK(std::regex_search(rest.out, std::regex("[0-9]+ of them had been graded before")));
  CHECK(times(text_of(folder / "book.csv"), ",65.00,65.00,graded,") == 300);
}
