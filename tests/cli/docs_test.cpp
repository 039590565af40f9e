// Some pages of docs/ show commands and what they print. It is true: every `$` line is run, in order, in one folder a
// page, which has the lessons in it as the clone does.
#include <doctest/doctest.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <sstream>
#include <string>
#include <vector>

#include "tests/cli/program.hpp"
#include "tests/where.hpp"

using namespace zstep::test;

namespace {

struct Example {
  std::string command;
  std::vector<std::string> lines;  ///< what it prints; "…" stands for any number of lines, at a line's end for its rest
};

std::vector<Example> examples_of(const std::string& page) {
  std::vector<Example> examples;
  std::istringstream in(page);
  bool inside = false;
  for (std::string line; std::getline(in, line);) {
    if (line.starts_with("```")) inside = line == "```console";
    else if (inside && line.starts_with("$ ")) examples.push_back({line.substr(2), {}});
    else if (inside && line.starts_with(">") && examples.back().lines.empty())  // as a shell asks for more lines
      examples.back().command += "\n" + line.substr(std::min<std::size_t>(2, line.size()));
    else if (inside) examples.back().lines.push_back(line);
  }
  return examples;
}

bool there_is_python() {
  static const bool found = std::system("python3 -c '' >/dev/null 2>&1") == 0;
  return found;
}

bool match_line(const std::string& pattern, const std::string& text) {
  const std::string rest = "…";
  if (!pattern.ends_with(rest)) return pattern == text;
  return text.starts_with(pattern.substr(0, pattern.size() - rest.size()));
}

bool match(const std::vector<std::string>& pattern, const std::vector<std::string>& text, std::size_t p = 0,
           std::size_t t = 0) {
  if (p == pattern.size()) return t == text.size();
  if (pattern[p] == "…") {
    for (std::size_t skip = t; skip <= text.size(); ++skip)
      if (match(pattern, text, p + 1, skip)) return true;
    return false;
  }
  return t < text.size() && match_line(pattern[p], text[t]) && match(pattern, text, p + 1, t + 1);
}

}  // namespace

TEST_CASE("docs: every command prints what its page says") {
  for (const char* page :
       {"command-line.md", "querying.md", "checking-a-run.md", "comparing-runs.md", "interpolation.md", "homework.md",
        "setting-a-homework.md", "teaching.md", "writing-a-run.md", "barycentric-rasteriser.md"}) {
    const Folder folder;
    std::filesystem::create_directory_symlink(in_checkout("lessons"), folder / "lessons");
    const std::vector<Example> examples = examples_of(text_of(in_checkout("docs/" + std::string(page))));
    CHECK(examples.size() >= 3);
    for (const Example& example : examples) {
      CAPTURE(page);
      CAPTURE(example.command);
      if (example.command.find("python3") != std::string::npos && !there_is_python()) {
        MESSAGE("not run, as there is no python3: the rest of docs/" << page);
        break;
      }
      const Outcome outcome = shell(folder, "zstep() { '" + program_path() + "' \"$@\"; }; " + example.command);
      CAPTURE(outcome.out);
      CAPTURE(outcome.err);
      std::vector<std::string> lines;
      std::istringstream printed(outcome.out + outcome.err);
      for (std::string line; std::getline(printed, line);) lines.push_back(line);
      CHECK(match(example.lines, lines));
    }
  }
}
