#include "tests/golden/run_edits.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <fstream>
#include <sstream>

#include <nlohmann/json.hpp>

#include "tests/where.hpp"
#include "tests/zoo/runs.hpp"

namespace zstep::test {

RunLines lines_of_run(const std::string& path) {
  std::ifstream in(in_checkout(path));
  RunLines lines;
  for (std::string line; std::getline(in, line);) lines.push_back(line);
  return lines;
}

namespace {

/// The line of the nth step of this name.
std::size_t line_of_step(const RunLines& lines, const std::string& step, int nth) {
  for (std::size_t i = 1; i < lines.size(); ++i)
    if (nlohmann::json::parse(lines[i]).value("step", "") == step && --nth == 0) return i;
  FAIL("no such step: " << step);
  return 0;
}

}  // namespace

RunLines with_edit(RunLines lines, const std::string& edit) {
  std::istringstream words(edit);
  std::string verb, step, change;
  int nth = 0;
  words >> verb >> step >> nth >> change;
  const std::size_t at = line_of_step(lines, step, nth);
  const auto place = lines.begin() + static_cast<std::ptrdiff_t>(at);
  if (verb == "drop") {
    lines.erase(place);
  } else if (verb == "repeat") {
    lines.insert(place, std::string(*place));
  } else if (verb == "swap") {
    std::swap(lines[at], lines[at + 1]);
  } else {
    const std::size_t equals = change.find('=');
    auto line = nlohmann::ordered_json::parse(lines[at]);
    REQUIRE(line.contains(change.substr(0, equals)));
    line[change.substr(0, equals)] = nlohmann::ordered_json::parse(change.substr(equals + 1));
    lines[at] = line.dump();
  }
  return lines;
}

Trace trace_of_lines(const RunLines& lines) {
  std::string text, impossible;
  for (const std::string& line : lines) text += line + '\n';
  return trace_of(text, &impossible);
}

}  // namespace zstep::test
