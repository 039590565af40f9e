// Recording a golden trace's scene again gives the same lines. When a change is meant, tests/golden/regenerate writes
// them anew, and the difference is read in review.
#include <doctest/doctest.h>

#include <algorithm>
#include <fstream>
#include <map>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "tests/golden/golden.hpp"

using namespace zstep;
using namespace zstep::test;

namespace {

std::vector<std::string> lines_of(const std::string& text) {
  std::istringstream in(text);
  std::vector<std::string> lines;
  for (std::string line; std::getline(in, line);) lines.push_back(line);
  return lines;
}

/// The header line without the version of the zstep that wrote it.
std::string without_writer(std::string line) {
  const std::string key = "\"writer\":\"";
  const std::size_t at = line.find(key);
  if (at != std::string::npos) line.erase(at, line.find('"', at + key.size()) + 1 - at);
  return line;
}

}  // namespace

TEST_CASE("golden: recording again gives the same lines") {
  REQUIRE(golden_files().size() >= 5);
  for (const std::filesystem::path& path : golden_files()) {
    CAPTURE(path.filename().string());
    std::ifstream in(path, std::ios::binary);
    std::ostringstream text;
    text << in.rdbuf();
    const std::vector<std::string> golden = lines_of(text.str()),
                                   again = lines_of(jsonl_of(record_again(open_jsonl(path))));
    REQUIRE_FALSE(golden.empty());
    CHECK(without_writer(golden[0]) == without_writer(again[0]));
    const std::size_t common = std::min(golden.size(), again.size());
    for (std::size_t k = 1; k < common; ++k) {
      CAPTURE(k);
      REQUIRE(golden[k] == again[k]);
    }
    CHECK(golden.size() == again.size());
  }
}

TEST_CASE("golden: every step of every method's pseudo-code occurs in some golden trace") {
  std::map<std::string, std::set<std::string>> missing;  // by method
  for (const Method& m : methods())
    for (const StepInfo& step : m.page()) missing[std::string(m.id)].insert(step.module + "." + step.name);
  for_each_golden([&](const std::string&, const Trace& trace) {
    std::set<std::string>& steps = missing[trace.header().algorithm];
    for (std::int64_t position = 1; position <= trace.size(); ++position) {
      const StepInfo* step = find_step(trace.header().page, trace.event(position).step);
      REQUIRE(step != nullptr);
      steps.erase(step->module + "." + step->name);
    }
  });
  for (const auto& [id, steps] : missing)
    for (const std::string& step : steps) FAIL_CHECK("no golden trace of ", id, " takes the step ", step);
}

TEST_CASE("golden: every reason to reject a polygon or skip an edge, and every plane of the view volume, occurs") {
  std::set<std::string> seen;
  for_each_golden([&](const std::string&, const Trace& trace) {
    for (std::int64_t position = 1; position <= trace.size(); ++position) {
      const Event& event = trace.event(position).event;
      if (const auto* reject = get_if<PolygonReject>(&event))
        seen.insert("reject " + std::string(word_of(reject->reason)));
      if (const auto* skip = get_if<EdgeTableSkip>(&event)) seen.insert("skip " + std::string(word_of(skip->why)));
      if (const auto* cross = get_if<ClipCross>(&event)) seen.insert("cross " + std::string(word_of(cross->plane)));
      if (const auto* compare = get_if<DepthCompare>(&event)) seen.insert(compare->nearer ? "nearer" : "not nearer");
      if (const auto* span = get_if<SpanBegin>(&event)) seen.insert(span->first > span->last ? "empty span" : "span");
    }
  });
  for (const char* what : {"reject back_facing", "reject edge_on", "reject outside", "reject degenerate",
                           "skip horizontal", "skip between_rows", "cross near", "cross far", "cross left",
                           "cross right", "cross bottom", "cross top", "nearer", "not nearer", "span", "empty span"}) {
    CAPTURE(what);
    CHECK(seen.count(what) == 1);
  }
}
