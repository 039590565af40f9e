// Whole sentences, as a person has read and approved them: tests/golden/sentences.txt has at least one for every kind
// of event.
#include <algorithm>
#include <fstream>
#include <map>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include <doctest/doctest.h>

#include "sim/words/explain.hpp"
#include "tests/golden/golden.hpp"
#include "tests/where.hpp"
#include "traces/replay/replay.hpp"

using namespace zstep;

namespace {

struct Approved {
  std::int64_t step = 0;
  std::string kind, sentence;
};

/// By trace. "TRACE STEP KIND", then the sentence, on lines that begin with two spaces.
std::map<std::string, std::vector<Approved>> approved_sentences() {
  std::ifstream file(test::in_checkout("tests/golden/sentences.txt"));
  REQUIRE(file);
  std::map<std::string, std::vector<Approved>> all;
  Approved* last = nullptr;
  for (std::string line; std::getline(file, line);) {
    if (line.empty() || line[0] == '#') continue;
    if (line.starts_with("  ")) {
      REQUIRE(last != nullptr);
      last->sentence += (last->sentence.empty() ? "" : " ") + line.substr(2);
      continue;
    }
    std::istringstream head(line);
    std::string trace;
    Approved one;
    REQUIRE((head >> trace >> one.step >> one.kind));
    all[trace].push_back(one);
    last = &all[trace].back();
  }
  return all;
}

std::string kind_of_event(const Event& event) {
  return visit_event([](const auto& known) { return std::string(description_of<std::decay_t<decltype(known)>>.name); },
                     event);
}

}  // namespace

TEST_CASE("every kind of event: whole sentences as they were approved, tests/golden/sentences.txt") {
  std::set<std::string> kinds;
  for (const auto& [name, sentences] : approved_sentences()) {
    const Trace trace = open_jsonl(test::in_checkout("tests/golden/" + name + ".jsonl"));
    Replay replay(trace);
    for (const Approved& approved : sentences) {
      CAPTURE(name);
      CAPTURE(approved.step);
      REQUIRE(approved.step <= trace.size());
      replay.go_to(approved.step);
      CHECK(kind_of_event(replay.current()->event) == approved.kind);
      CHECK(explain(trace, replay.state(), *replay.current()).sentence == approved.sentence);
      kinds.insert(approved.kind);
    }
  }
  for_each_kind([&]<class E>() {
    const std::string kind(description_of<E>.name);
    CAPTURE(kind);
    CHECK(kinds.contains(kind));
  });
}
