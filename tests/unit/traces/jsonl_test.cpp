// JSON Lines of other programs: what is wrong is said with its place and its cure, what a header declares is kept, and
// the file of a program that crashed is read as far as it goes.
#include <doctest/doctest.h>

#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include "tests/unit/traces/some_trace.hpp"
#include "tests/where.hpp"
#include "traces/error.hpp"
#include "traces/file/jsonl.hpp"
#include "traces/replay/replay.hpp"

using namespace zstep;

namespace {

std::string foreign(const std::string& name) {
  std::ifstream in(test::in_checkout("tests/data/foreign/" + name), std::ios::binary);
  std::stringstream text;
  text << in.rdbuf();
  return text.str();
}

struct Read {
  std::string error;
  std::optional<std::string> cut;
  std::optional<Trace> trace;
};

Read read(const std::string& text) {
  std::istringstream in(text);
  Scene kept;
  std::optional<TraceRecorder> recorder;
  Read result;
  try {
    result.cut = read_jsonl(in, "run.jsonl", [&](const Header& header, Scene scene) -> TraceRecorder& {
      kept = std::move(scene);
      return recorder.emplace(header, kept);
    });
    recorder->finish(!result.cut);
    result.trace = Trace::from_bytes(recorder->take_bytes(), "run.jsonl", result.cut.value_or(""));
  } catch (const InputError& error) {
    result.error = error.what();
  }
  return result;
}

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);) lines.push_back(line);
  return lines;
}

bool has(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

std::string replaced(std::string text, const std::string& what, const std::string& with) {
  const std::size_t at = text.find(what);
  REQUIRE(at != std::string::npos);
  return text.replace(at, what.size(), with);
}

/// A trace of someone else with these conventions in its header.
std::string with_conventions(const std::string& conventions) {
  return replaced(foreign("greater.jsonl"), R"("conventions": {"nearer": "greater"})",
                  R"("conventions": )" + conventions);
}

/// A good trace with one more line, its twenty-first.
std::string with_line(const std::string& line) {
  const std::string text = foreign("greater.jsonl");
  std::size_t at = 0;
  for (int k = 0; k < 20; ++k) at = text.find('\n', at) + 1;
  return text.substr(0, at) + line + "\n" + text.substr(at);
}

std::string dumped(const Trace& trace) {
  std::stringstream text;
  write_jsonl(trace, text);
  return text.str();
}

}  // namespace

TEST_CASE("jsonl: what is wrong is said with its line and column") {
  const Trace trace = record_events({});
  const std::string head = jsonl_header(trace.header(), trace.scene()) + "\n";
  const auto says = [&](const std::string& line, int column, const std::string& part) {
    const std::string said = read(head + line + "\n").error;
    CAPTURE(said);
    CHECK(said.find("run.jsonl:2:" + std::to_string(column) + ": ") == 0);
    CHECK(has(said, part));
    CHECK(!has(said, "\n"));
  };
  CHECK(read(head).error == "");
  CHECK(read("").error.find("run.jsonl:1:1: there is no header line") == 0);
  CHECK(read("{}").error.find("run.jsonl:1:1: \"ztrace\" is missing") == 0);
  CHECK(has(read("{\"step\":\"depth_write\"}").error,
            "run.jsonl:1:1: the header line is missing: this is an event already"));
  says(R"({"step":"depth_write","x":1,"y":2})", 1, "\"z\" is missing");
  says(R"({"step":"depth_write","x":1.5,"y":2,"z":1})", 27, "\"x\" is not a whole number");
  says(R"({"step":"depth_write","x":1e99,"y":2,"z":1})", 27, "\"x\" is not a whole number");
  says(R"({"step":"depth_write","x":1,"y":2,"z":1,"w":0})", 41,
       "\"w\" is no field of depth_write; its fields are x, y, z");
  says(R"({"step":"depth_write","x":1,"y":2,"Z":1})", 35, "did you mean \"z\"?");
  says(
      R"({"step":"facing_test","determinant":1,"plane_at_eye":1,"view_dot_normal":1,"projected_normal_z":1,"facing":"font"})",
      108, "front, back, edge_on; did you mean \"front\"?");
  says(R"({"step":"depth_write","x":900,"y":2,"z":1})", 23, "column 900 lies outside the raster");
  says(R"({"step":"pixel_write","x":1,"y":2,"polygon":2})", 35, "polygon 2 does not exist (there are 2)");
  says(R"({"step":"paint"})", 2, "there is no step \"paint\" in the header's list; ");
  says(R"({"step":"depth_wirte","x":1,"y":2,"z":1})", 2, "did you mean \"depth_write\"?");
  says(R"({"step":"depth_write","x":1,"y":2,"x":3,"z":1})", 35, "\"x\" is given twice in one object; keep one of them");
  says(R"({"step":"depth_write","x":1,"y":2,"\u0078":3,"z":1})", 35, "\"x\" is given twice in one object");
  says(R"({"step":"depth_write","x":{"a":":","a":2},"y":2,"z":1})", 36, "\"a\" is given twice in one object");
  says(R"({"step":"cut \"off\": {","step":1})", 26, "\"step\" is given twice in one object");
  std::string twice = head;
  twice.insert(1, "\"conventions\":{\"nearer\":\"greater\"},");
  CHECK(read(twice).error.find("run.jsonl:1:") == 0);
  CHECK(has(read(twice).error, "\"conventions\" is given twice in one object"));
  says("[1]", 1, "not a JSON object");
  says("{", 2, "ends within an object");
  says(R"({"stép":1,"x":NaN})", 15, "NaN is no number");  // a character is one column
}

TEST_CASE("jsonl: what is no JSON is told with its likely cause") {
  const auto says = [&](const std::string& line, int column, const std::string& part) {
    const std::string said = read(with_line(line)).error;
    CAPTURE(said);
    CHECK(said.find("run.jsonl:21:" + std::to_string(column) + ": ") == 0);
    CHECK(has(said, part));
    CHECK(!has(said, "\n"));
  };
  says(R"({"step":"compare","x":1,"y":1,"z":NaN,"nearer":true})", 35,
       "NaN is no number of JSON's; write \"nan\", in quotes");
  says(R"({"step":"compare","x":1,"y":1,"z":-Infinity,"nearer":true})", 35, "write \"-inf\", in quotes");
  says(R"({"step":"compare","x":1,"y":1,"z":inf,"nearer":true})", 35, "write \"inf\", in quotes");
  says(R"({"step":"compare","x":1,"y":1,"z":1,"nearer":True})", 46,
       "True is Python's, and JSON has true; print json.dumps(event)");
  says(R"({"step":"compare","x":1,"y":1,"z":None,"nearer":true})", 35, "None is no value");
  says(R"({'step':'compare','x':1,'y':1,'z':1,'nearer':1})", 2, "single quotes");
  says(R"({"step":"compare","x":1,"y":1,"z":1,"nearer":true,})", 51, "a comma stands before }");
  says(R"({"step":"compare","x":1,"y":1,"z":0,5,"nearer":true})", 36, "a number is written with a comma");
  says(R"({"step":"compare","x":1,"y":1,"z":.5,"nearer":true})", 35, ".5 is no number as JSON writes it");
  says(R"({step:"compare","x":1})", 2, "the name step has no quotes");
  says(R"({"step":"compare" "x":1})", 19, "a comma or a colon is missing");
  says(R"({"step":"scan","y":1} {"step":"scan","y":1})", 23, "a second object begins on the line");
  says(R"({"step":"scan","y":1},)", 22, "a comma stands behind the object");
  says(R"({"step":"scan","y":1} // the first)", 23, "stands behind the object");
  says("{\"step\":\"scan\" /* the first */,\"y\":1}", 16, "JSON has no comments");
  says("scan line 4", 1, "\"scan line 4\" is not JSON");
  says(R"({"step":"scan","y":1e999})", 1, "a number is too large");
  says("{\"step\":\"scan\",\"y\":1,\"a\\nb\":1}", 22, "\"a\\nb\" is no field of scan_line_begin");  // still one line
}

TEST_CASE("jsonl: a whole file that is written otherwise is told in one line") {
  const std::string good = foreign("greater.jsonl");
  const auto one = [](const std::string& said, const std::string& part) {
    CAPTURE(said);
    CHECK(has(said, part));
    CHECK(!has(said, "\n"));
  };
  std::string wide = "\xff\xfe";
  for (const char c : good) wide += std::string{c, '\0'};
  one(read(wide).error, "run.jsonl:1:1: the file is UTF-16; save it as UTF-8");
  one(read("[" + good + "]").error, "run.jsonl:1:1: the file is one list; write each object on a line of its own");
  const std::string pretty =
      replaced(replaced(good, "{\"ztrace\": 1, ", "{\n \"ztrace\": 1,\n "), "\"steps\": [", "\"steps\": [\n  ");
  one(read(pretty).error, "run.jsonl:1:1: the object goes on over several lines; write each object on one line");
  CHECK(read("\xef\xbb\xbf" + good).error == "");  // UTF-8 as Windows' editors mark it
  CHECK(dumped(*read("\xef\xbb\xbf" + good).trace) == dumped(*read(good).trace));
}

TEST_CASE("jsonl: the first ten mistakes are told, each on a line") {
  std::string text =
      replaced(with_line(R"({"step":"wp","x":-1,"y":1,"polygon":0})"), "{\"step\": \"scan\", \"y\": 1}\n",
               "{\"step\": \"scan\", \"y\": 1}\n{\"step\":\"wq\"}\n");
  std::vector<std::string> said = lines_of(read(text).error);
  REQUIRE(said.size() == 2);
  CHECK(has(said[0], "run.jsonl:21:14: column -1 lies outside the raster"));
  CHECK(has(said[1], "did you mean \"wz\"? Its steps are clear, polygon, "));
  for (int k = 0; k < 20; ++k) text += "{\"step\":\"scan\",\"y\":99}\n";
  said = lines_of(read(text).error);
  REQUIRE(said.size() == 11);
  CHECK(said.back() == "run.jsonl: there may be more mistakes; mend these first");
  CHECK(lines_of(read(with_conventions(R"({"nearer": "greatest", "coverage": "nearest", "Ties": "last"})")).error)
            .size() == 3);
}

TEST_CASE("jsonl: a header is obeyed and kept, or refused with the words that there are") {
  const auto refused = [](const std::string& conventions, const std::string& part) {
    const std::string said = read(with_conventions(conventions)).error;
    CAPTURE(said);
    CHECK(said.find("run.jsonl:1:") == 0);
    CHECK(has(said, part));
    CHECK(!has(said, "\n"));
  };
  refused(R"({"Nearer": "greater"})",
          "1:80: \"Nearer\" is no key of \"conventions\"; did you mean \"nearer\"? It can have depth, interpolation, ");
  refused(R"({"nearer": "greatest"})",
          "\"nearer\" is \"greatest\", but can only be one of: smaller, greater; did you mean \"greater\"?");
  refused(R"({"nearer": "larger"})", "smaller, greater");
  refused(R"({"coverage": "nearest"})", "top_left, inclusive");
  refused(R"({"depth": "distance"})", "pseudodepth, view");
  refused(R"({"number_format": "float16"})", "float64, float32");
  refused(R"({"pixel_centre": "corner"})", "can only be one of: integer, half");
  refused(R"({"view_coordinates": "left"})", "can only be one of: left_handed, right_handed");
  refused(R"({"ties": "second"})", "first, last");
  refused(R"({"initial_depth": "nan"})", "\"initial_depth\" is no number");
  refused(R"({"initial_depth": "far"})", "\"initial_depth\" is not a number");
  const std::string good = foreign("greater.jsonl");
  CHECK(has(read(replaced(good, "\"writer\"", "\"writter\"")).error,
            "\"writter\" is no key of a trace's header; did you mean \"writer\"?"));
  CHECK(has(read(replaced(good, "\"text\": \"scan\"", "\"txt\": \"scan\"")).error, "\"txt\" is no key of a step"));
  CHECK(has(read(replaced(good, "\"event\": \"scan_line_begin\"", "\"event\": \"scanline_begin\"")).error,
            "did you mean \"scan_line_begin\"?"));
  CHECK(has(read(replaced(good, "\"height\": 8", "\"height\": 8, \"y_axis\": \"upwards\"")).error,
            "\"y_axis\" is \"upwards\", but can only be one of: down, up"));
  CHECK(has(read(replaced(good, "\"height\": 8", "\"height\": 8, \"yaxis\": \"up\"")).error,
            "\"yaxis\" is no key of the raster; did you mean \"y_axis\"?"));

  const auto kept = [](const std::string& conventions) {
    const Read first = read(with_conventions(conventions));
    REQUIRE(first.error == "");
    const std::string out = dumped(*first.trace);
    CHECK(has(out, "\"conventions\":" + conventions + ",\"steps\""));
    CHECK(dumped(*read(out).trace) == out);
    return first.trace->header();
  };
  // What is computed in is found out from the numbers then, as where nothing is said of it.
  const Read unknown = read(with_conventions(R"({"number_format": "as computed", "nearer": "greater"})"));
  REQUIRE(unknown.error == "");
  CHECK(!unknown.trace->header().declares(Convention::number_format));
  CHECK(unknown.trace->header().declares(Convention::nearer));
  refused(R"({"number_format": "as comuted"})", "did you mean \"as computed\"?");
  const Header none = kept("{}");
  CHECK(!none.declares(Convention::nearer));
  CHECK(!none.declares(Convention::depth));
  const Header greater = kept(R"({"number_format":"float32","nearer":"greater","ties":"last","initial_depth":0.0})");
  CHECK(greater.declares(Convention::nearer));
  CHECK(!greater.declares(Convention::coverage));
  CHECK(greater.conventions.number_format == NumberFormat::float32);
  CHECK(greater.comparison.wins(5, 0));
  CHECK(greater.comparison.wins(5, 5));
  CHECK(!greater.comparison.wins(4, 5));
  CHECK(greater.comparison.sign() == "\u2265");
  CHECK(greater.empty_depth() == 0);
  CHECK(kept(R"({"nearer":"greater"})").empty_depth() == -no_depth);
}

TEST_CASE("jsonl: depths begin as the header declares, in every state that a replay comes to") {
  const Read first = read(replaced(with_conventions(R"({"nearer": "greater", "initial_depth": -3})"),
                                   "{\"step\": \"clear\", \"z\": 0.0}\n", ""));
  REQUIRE(first.error == "");
  Replay replay(*first.trace, {40, 8, 24, 100});
  CHECK(replay.state().picture.depth[7] == -3);
  replay.go_to(first.trace->size());
  const double drawn = replay.state().picture.depth[0];
  CHECK(drawn == 5);
  CHECK(replay.state().picture.depth[63] == -3);
  replay.go_to(1);
  CHECK(replay.state().picture.depth[0] == -3);
  replay.go_to(first.trace->size());
  CHECK(replay.state().picture.depth[63] == -3);
}

TEST_CASE("jsonl: the file of a program that crashed is read up to its last whole line") {
  const Read torn = read(foreign("torn.jsonl"));
  CHECK(torn.error == "");
  REQUIRE(torn.cut);
  CHECK(*torn.cut ==
        "run.jsonl:152: the recording was cut off here, at \u201c{\"step\":\"compare\",\"x\":1,\"y\":\u201d; 150 steps "
        "could be read");
  CHECK(torn.trace->size() == 150);
  REQUIRE(torn.trace->warnings().size() == 1);
  CHECK(torn.trace->warnings()[0] == *torn.cut);

  const Read traceback = read(foreign("torn_trace.jsonl"));
  REQUIRE(traceback.cut);
  CHECK(has(*traceback.cut, "run.jsonl:152: "));
  CHECK(has(*traceback.cut,
            "\u201cTraceback (most recent call last):\u201d, \u201c  File \"zb.py\", line 3\u201d, "
            "\u201cZeroDivisionError: division by zero\u201d"));
  CHECK(traceback.trace->size() == 150);

  // What comes before the end is no end, and where nothing was recorded there is nothing to read.
  CHECK(has(read(with_line("Traceback")).error, "run.jsonl:21:1: \"Traceback\" is not JSON"));
  const std::string head = foreign("torn.jsonl").substr(0, foreign("torn.jsonl").find('\n') + 1);
  CHECK(has(read(head + "Traceback\n").error, "run.jsonl:2:1: "));
  CHECK(has(read(head.substr(0, 100)).error, "run.jsonl:1:101: the line ends within an object"));
  // A line without its end is whole all the same.
  const std::string whole = foreign("greater.jsonl");
  CHECK(!read(whole.substr(0, whole.size() - 1)).cut);
  // What steers a terminal is quoted so that it does not.
  CHECK(has(*read(whole + "\x1b[2J\x9b").cut, "\u201c\\x1b[2J\\x9b\u201d"));
}
