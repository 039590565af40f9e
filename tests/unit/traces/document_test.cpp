// What the documentation says of the format is what the code does.
#include <doctest/doctest.h>

#include <cstdlib>
#include <fstream>
#include <memory>
#include <sstream>

#include "tests/where.hpp"
#include "traces/events/fields.hpp"
#include "traces/file/jsonl.hpp"
#include "traces/replay/replay.hpp"

using namespace zstep;

namespace {

const std::string document_path = test::in_checkout("docs/trace-format.md");

std::string read_document() {
  std::ifstream in(document_path);
  std::stringstream text;
  text << in.rdbuf();
  return text.str();
}

}  // namespace

TEST_CASE("docs: the vocabulary's table is the one the code generates") {
  const std::string document = read_document();
  const std::size_t begin = document.find("\n### ");
  const std::string before = document.substr(0, begin);
  REQUIRE(before.find("## The vocabulary") != std::string::npos);
  if (std::getenv("ZSTEP_UPDATE_DOCS") != nullptr) std::ofstream(document_path) << before << vocabulary_markdown();
  CHECK(read_document() == before + vocabulary_markdown());
}

TEST_CASE("docs: the JSON Lines example is a trace") {
  const std::string document = read_document();
  const std::size_t begin = document.find("```json\n") + 8;
  std::istringstream example(document.substr(begin, document.find("```", begin) - begin));
  Scene kept;
  std::unique_ptr<TraceRecorder> recorder;
  read_jsonl(example, "docs/trace-format.md", [&](const Header& header, Scene scene) -> TraceRecorder& {
    kept = std::move(scene);
    recorder = std::make_unique<TraceRecorder>(header, kept);
    return *recorder;
  });
  recorder->finish();
  const Trace trace = Trace::from_bytes(recorder->take_bytes(), "the example");
  Replay replay(trace);
  replay.go_to(trace.size());
  CHECK(trace.size() == 3);
  CHECK(replay.state().picture.polygon[9] == 0);
  CHECK(replay.state().picture.depth[9] == 5.0);
}
