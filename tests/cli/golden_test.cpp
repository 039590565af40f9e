// tests/golden/cases.txt says how each golden trace was made; the command line makes the same again.
#include <doctest/doctest.h>

#include <sstream>
#include <string>

#include "tests/cli/program.hpp"
#include "tests/where.hpp"

using namespace zstep::test;

namespace {

/// The text from the first event on: the header's line names the version that wrote it.
std::string events_of(const std::string& jsonl) { return jsonl.substr(jsonl.find('\n') + 1); }

std::string header_without_writer(const std::string& jsonl) {
  const std::string line = jsonl.substr(0, jsonl.find('\n')), key = "\"writer\":\"";
  const std::size_t at = line.find(key);
  return at == std::string::npos ? line : line.substr(0, at) + line.substr(line.find('"', at + key.size()) + 1);
}

}  // namespace

TEST_CASE("golden: zstep record and zstep dump --jsonl write the golden traces") {
  const Folder folder;
  std::istringstream cases(text_of(in_checkout("tests/golden/cases.txt")));
  int count = 0;
  for (std::string line; std::getline(cases, line);) {
    if (line.empty() || line[0] == '#') continue;
    std::istringstream words(line);
    std::string name, arguments;
    words >> name;
    std::getline(words, arguments);
    CAPTURE(name);
    const Outcome again =
        shell(folder, "here=$PWD; cd '" + in_checkout("") + "' && \"$zstep\" record" + arguments +
                          " -o \"$here/a.ztrace\" > \"$here/said\" && \"$zstep\" dump --jsonl \"$here/a.ztrace\"");
    CHECK(again.code == 0);
    CHECK(times("\n" + again.err, "\n") - 1 == times("\n" + again.err, "\nnote: "));
    const std::string golden = text_of(in_checkout("tests/golden/") + name + ".jsonl");
    CHECK(events_of(again.out) == events_of(golden));
    CHECK(header_without_writer(again.out) == header_without_writer(golden));
    ++count;
  }
  CHECK(count >= 5);
}
