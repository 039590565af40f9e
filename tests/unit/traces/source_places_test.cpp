// Where in a program's source its steps were printed: read, kept in the file, and never believed.
#include <doctest/doctest.h>

#include <algorithm>
#include <fstream>
#include <sstream>
#include <string>

#include "tests/where.hpp"
#include "traces/error.hpp"
#include "traces/events/fields.hpp"
#include "traces/file/jsonl.hpp"
#include "traces/file/source_places.hpp"
#include "traces/file/visit.hpp"

using namespace zstep;

namespace {

std::string delhi() {
  std::ifstream in(test::in_checkout("tests/golden/delhi.jsonl"), std::ios::binary);
  std::stringstream text;
  text << in.rdbuf();
  return text.str();
}

/// The same run, of which each step says where it was printed: in turn one of a few lines, and every ninth nowhere.
std::string placed(const std::string& run, const std::string& folder = "") {
  std::istringstream in(run);
  std::string out, line;
  for (int number = 0; std::getline(in, line); ++number) {
    if (number > 0 && number % 9 != 0)
      line =
          line.substr(0, line.size() - 1) + ",\"at\":\"" + folder + "raster.cpp:" + std::to_string(number % 4) + "\"}";
    out += line + "\n";
  }
  return out;
}

Bytes bytes_of(const std::string& text, bool whole = true) {
  std::istringstream in(text);
  Scene kept;
  std::optional<TraceRecorder> recorder;
  read_jsonl(in, "run.jsonl", [&](const Header& header, Scene scene) -> TraceRecorder& {
    kept = std::move(scene);
    return recorder.emplace(header, kept);
  });
  recorder->finish(whole);
  return recorder->take_bytes();
}

std::string dumped(const Trace& trace) {
  std::ostringstream out;
  write_jsonl(trace, out);
  return out.str();
}

std::string error_of(const std::string& line) {
  std::istringstream in(delhi() + line + "\n");
  try {
    open_jsonl(in, "run.jsonl");
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

const std::string step = R"({"step":"write_depth","x":1,"y":1,"z":5)";

}  // namespace

TEST_CASE("places: no field of an event is called as they are") {
  for (std::size_t kind = 0; kind < kind_count; ++kind) CHECK(field_of_kind(kind, at_key) == nullptr);
}

TEST_CASE("places: a run goes into a trace and back with all of them, and its steps are known by them") {
  const std::string run = placed(delhi());
  const Trace trace = Trace::from_bytes(bytes_of(run), "run");
  CHECK(trace.whole());
  CHECK(trace.warnings().empty());
  CHECK(dumped(trace) == run);
  CHECK(trace.printed_at(1) == "raster.cpp:1");
  CHECK(trace.printed_at(6) == "raster.cpp:2");
  CHECK(trace.printed_at(9) == "");
  CHECK(trace.printed_at(0) == "");
  CHECK(trace.printed_at(trace.size() + 1) == "");
}

TEST_CASE("places: a run without them is the same bytes as before there were any") {
  const Bytes without = bytes_of(delhi()), with = bytes_of(placed(delhi()));
  const std::string tag = "PLAC";
  const auto has_tag = [&](const Bytes& bytes) {
    return std::search(bytes.begin(), bytes.end(), tag.begin(), tag.end()) != bytes.end();
  };
  CHECK_FALSE(has_tag(without));
  CHECK(has_tag(with));
  // All but the chunk itself, and what the trailer says of the index, is that of the run without.
  const MemoryView source(with);
  const auto chunk = find_places(source, *index_offset(source));
  REQUIRE(chunk);
  Bytes cut = with;
  cut.erase(cut.begin() + static_cast<std::ptrdiff_t>(chunk->offset),
            cut.begin() + static_cast<std::ptrdiff_t>(chunk->end()));
  CHECK(cut == without);
}

TEST_CASE("places: those of a run that was cut off are kept, and it is one all the same") {
  const std::string run = placed(delhi());
  const Trace trace = Trace::from_bytes(bytes_of(run, false), "run");
  CHECK_FALSE(trace.whole());
  REQUIRE(trace.warnings().size() == 1);
  CHECK(trace.warnings()[0].find("was cut off before its end") != std::string::npos);
  CHECK(trace.printed_at(6) == "raster.cpp:2");
  CHECK(dumped(trace) == run + "{\"cut_off\":true}\n");
}

TEST_CASE("places: where they are damaged the steps are told without") {
  Bytes bytes = bytes_of(placed(delhi()));
  const auto chunk = find_places(MemoryView(bytes), *index_offset(MemoryView(bytes)));
  REQUIRE(chunk);
  bytes[chunk->end() - 1] ^= 0xffu;
  const Trace trace = Trace::from_bytes(bytes, "run");
  CHECK(dumped(trace) == delhi());
  REQUIRE(trace.warnings().size() == 1);
  CHECK(trace.warnings()[0].find("cannot be read") != std::string::npos);
}

TEST_CASE("places: what stands in their chunk is held against what there can be") {
  SourcePlaces places;
  places.add(1, 3, "a.c:1"), places.add(5, 3, "a.c:2"), places.add(7, 4, "a.c:2");
  const Bytes right = places.bytes();
  const SourcePlaces read(right);
  CHECK(read.of(4, 3) == "a.c:1");
  CHECK(read.of(5, 3) == "a.c:2");
  CHECK(read.of(6, 4) == "");
  CHECK(read.of(7, 4) == "a.c:2");
  CHECK(read.bytes() == right);
  for (std::size_t cut = 1; cut < right.size(); ++cut) {
    Bytes bytes = right;
    bytes.resize(cut);
    CAPTURE(cut);
    try {
      const SourcePlaces shorter(bytes);
      CHECK((cut == 13 || cut == 19));  // between two steps' lists nothing is missing that could be known
    } catch (const MalformedBytes&) {
    }
  }
  Bytes other = right;
  other.back() = 9;  // of two places the ninth
  CHECK_THROWS_AS(SourcePlaces{other}, MalformedBytes);
  other = right;
  other[2] = 0x1b;  // an escape in a place's text
  CHECK_THROWS_AS(SourcePlaces{other}, MalformedBytes);
}

TEST_CASE("places: one that is no line of a program's source is refused with its cure") {
  CHECK(error_of(step + R"(,"at":"raster.cpp:417"})") == "");
  CHECK(error_of(R"({"at":"raster.cpp:417",)" + step.substr(1) + "}") == "");
  const auto refused = [](const std::string& at, const std::string& what) {
    const std::string error = error_of(step + ",\"at\":" + at + "}");
    CAPTURE(at);
    CAPTURE(error);
    CHECK(error.find("run.jsonl:") == 0);
    CHECK(error.find("\"at\" " + what + "; write the program's file and line, as \"raster.cpp:417\"") !=
          std::string::npos);
    CHECK(error.find('\n') == std::string::npos);
  };
  refused("417", "is not a text");
  refused("\"\"", "is empty");
  refused("\"" + std::string(1025, 'x') + "\"", "is longer than 1024 bytes");
  refused(R"("a.c:1\u001b[2J")", "has characters that cannot be shown");
  refused(R"("a.c:1\n2")", "has characters that cannot be shown");
  CHECK(error_of(step + ",\"at\":\"" + std::string(1024, 'x') + "\"}") == "");
  CHECK(error_of(step + R"(,"at":"a.c:1","at":"a.c:2"})").find("\"at\" is given twice") != std::string::npos);
  CHECK(error_of(step + R"(,"att":"a.c:1"})").find("\"att\" is no field") != std::string::npos);
}

TEST_CASE("places: who publishes a run publishes no paths") {
  const std::string run = placed(delhi(), "/home/ada/");
  const std::string shown = placed(delhi());
  CHECK(without_paths_of_jsonl(run).substr(run.find('\n')) == shown.substr(shown.find('\n')));
  const auto shortened = [](const std::string& at) {
    const std::string lines = without_paths_of_jsonl("{\"ztrace\":1}\n{\"step\":\"clear\", \"at\" : \"" + at);
    return lines.substr(lines.find(" : ") + 4);
  };
  CHECK(shortened(R"(C:\\ada\\a.c:1"})") == R"(a.c:1"})");
  CHECK(shortened(R"(\/home\/a.c:1", "x":1})") == R"(a.c:1", "x":1})");
  CHECK(shortened(R"(/home/a\"b.c:1"})") == R"(a\"b.c:1"})");
  CHECK(shortened("/home/ada/torn") == "torn");
  for (const bool whole : {true, false}) {
    CAPTURE(whole);
    const Trace trace = Trace::from_bytes(without_paths(bytes_of(run, whole)), "run");
    CHECK(trace.whole() == whole);
    CHECK(trace.printed_at(6) == "raster.cpp:2");
    CHECK(dumped(trace).find("/home/ada") == std::string::npos);
  }
}

TEST_CASE("places: the line of each step is known, whatever stands between the steps") {
  const std::string run = delhi();
  const std::size_t second = run.find('\n', run.find('\n') + 1) + 1;
  std::istringstream in(run.substr(0, second) + "\n\n" + run.substr(second));
  const Trace trace = open_jsonl(in, "run.jsonl");
  CHECK(trace.line_of(1) == 2);
  CHECK(trace.line_of(2) == 5);
  CHECK(trace.line_of(trace.size()) == trace.size() + 3);
  CHECK(trace.line_of(0) == 0);
  CHECK(Trace::from_bytes(bytes_of(run), "run").line_of(1) == 0);
}
