// What right programs may print in more than one way, and what becomes of lines that cannot be read.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <regex>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "tests/cli/homework_runs.hpp"
#include "tests/cli/program.hpp"
#include "tests/where.hpp"
#include "traces/events/scan_conversion.hpp"
#include "traces/file/lenient.hpp"

using namespace zstep::test;
using nlohmann::json;

namespace {

/// A scene with concave polygons of which lines have several spans, some without pixels, and which reach beyond each
/// border of the picture.
constexpr const char* odd_scene =
    "coordinates = \"screen\"\n[raster]\nwidth = 12\nheight = 10\n"
    "[[polygon]]\nname = \"W\"\npoints = [[2, 1, 0.5], [3, 6, 0.5], [4, 2, 0.5], [6, 7, 0.5], [8, 2.5, 0.5], [9, 6, "
    "0.5], "
    "[10, 1, 0.5], [9, 9, 0.5], [3, 9, 0.5]]\n"
    "[[polygon]]\nname = \"B\"\npoints = [[-4, -6, 0.3], [5, -3.5, 0.525], [15, 4, 0.775], [14.5, 14, 0.7625], [6, "
    "5.5, "
    "0.55], [-6, 13, 0.25]]\n"
    "[[polygon]]\nname = \"L\"\npoints = [[-7, 1, 0.1], [-2, 2, 0.1], [-3, 8, 0.1]]\n"
    "[[polygon]]\nname = \"R\"\npoints = [[14, 1, 0.1], [19, 2, 0.1], [15, 8, 0.1]]\n"
    "[[polygon]]\nname = \"S\"\npoints = [[1, 0, 0.3], [7, 4, 0.3], [1, 4, 0.3]]\n";

/// The homework of the Z-buffer with this scene alone, and its right run.
std::vector<json> odd_run(const Folder& folder) {
  REQUIRE(run(folder, "homework new z-buffer hw").code == 0);
  std::string toml = text_of(folder / "hw/homework.toml");
  const std::size_t first = toml.find("\n[[scene]]\n"), end = toml.find("\n\n", toml.rfind("hidden = true"));
  toml.replace(first, end - first, "\n[[scene]]\nfile = \"scenes/odd.toml\"");
  write_text(folder / "hw/homework.toml", toml);
  write_text(folder / "hw/scenes/odd.toml", odd_scene);
  REQUIRE(shell(folder,
                "$zstep record hw/scenes/odd.toml -o odd.ztrace && $zstep dump odd.ztrace --jsonl | tail -n +2 > "
                "odd.jsonl")
              .code == 0);
  std::vector<json> steps;
  std::istringstream in(text_of(folder / "odd.jsonl"));
  for (std::string line; std::getline(in, line);) steps.push_back(json::parse(line));
  return steps;
}
Outcome grade_of(const Folder& folder, const std::string& text, const std::string& format = "text") {
  write_text(folder / "odd.jsonl", text);
  return run(folder, "grade --homework hw odd.jsonl --format " + format);
}
std::string lines_of(const std::vector<json>& steps, const std::function<std::string(const json&)>& printed) {
  std::string text;
  for (const json& step : steps)
    if (const std::string line = printed(step); !line.empty()) text += line + "\n";
  return text;
}
bool is_empty_span(const json& step) { return step["step"] == "span" && step["first"] > step["last"]; }

/// The first run of the set_up homework, "crossing", line by line.
std::vector<std::string> crossing_lines(const Folder& folder) {
  set_up_runs(folder);
  std::vector<std::string> lines;
  std::istringstream in(text_of(folder / "runs/crossing.jsonl"));
  for (std::string line; std::getline(in, line);) lines.push_back(line);
  return lines;
}
Outcome graded_lines(const Folder& folder, const std::vector<std::string>& lines, const std::string& format = "text") {
  std::string text;
  for (const std::string& line : lines) text += line + "\n";
  write_text(folder / "crossing.jsonl", text);
  return run(folder, "grade --homework hw crossing.jsonl --format " + format);
}
std::size_t line_with(const std::vector<std::string>& lines, const std::string& part) {
  for (std::size_t i = 0; i < lines.size(); ++i)
    if (has(lines[i], part)) return i;
  FAIL("no line has ", part);
  return 0;
}

}  // namespace

TEST_CASE("grade: empty spans earn the same printed or left out, whatever stands in them for 0/0") {
  const Folder folder;
  const std::vector<json> steps = odd_run(folder);
  int empty = 0, of_no_width = 0;
  for (const json& step : steps)
    if (is_empty_span(step)) ++empty, of_no_width += step["x_left"] == step["x_right"];
  REQUIRE(empty > 5);
  REQUIRE(of_no_width > 0);
  const auto right = [&](const char* what, const std::function<std::string(const json&)>& printed) {
    const Outcome outcome = grade_of(folder, lines_of(steps, printed));
    CAPTURE(what);
    CAPTURE(outcome.out);
    CHECK(outcome.code == 0);
    CHECK(has(outcome.out, "65 of 65 points"));
    CHECK(has(outcome.out, "Every step is right."));
  };
  right("as they are", [](const json& step) { return step.dump(); });
  right("left out", [](const json& step) { return is_empty_span(step) ? "" : step.dump(); });
  right("those of no width left out",
        [](const json& step) { return is_empty_span(step) && step["x_left"] == step["x_right"] ? "" : step.dump(); });
  right("clamped on one side only", [](json step) {
    if (is_empty_span(step)) {
      step["first"] = std::max(0, static_cast<int>(std::ceil(step["x_left"].get<double>())));
      step["last"] = std::min(12, static_cast<int>(std::ceil(step["x_right"].get<double>()))) - 1;
    }
    return step.dump();
  });
  for (const std::string_view word : zstep::words_of_no_number)
    right(std::string(word).c_str(), [&](json step) {
      if (!is_empty_span(step) || step["x_left"] != step["x_right"]) return step.dump();
      step.erase("dz_dx");
      std::string text = step.dump();
      return text.insert(text.size() - 1, ",\"dz_dx\": " + std::string(word));
    });
  right("null", [](json step) {
    if (is_empty_span(step) && step["x_left"] == step["x_right"]) step["dz_dx"] = nullptr;
    return step.dump();
  });
  right("no slope", [](json step) {
    if (is_empty_span(step) && step["x_left"] == step["x_right"]) step.erase("dz_dx");
    return step.dump();
  });
}

TEST_CASE("grade: a slope that is no number is wrong where the span has pixels") {
  const Folder folder;
  const std::vector<json> steps = odd_run(folder);
  const Outcome outcome = grade_of(folder, lines_of(steps, [](json step) {
                                     if (step["step"] == "span" && !is_empty_span(step)) step["dz_dx"] = nullptr;
                                     return step.dump();
                                   }));
  CHECK(outcome.code == 1);
  CHECK(has(outcome.out, "\"dz_dx\" is not a number"));
}

TEST_CASE("grade: each reason that the hand-out offers for an edge that is left out is taken") {
  const Folder folder;
  const std::vector<json> steps = odd_run(folder);
  int outside = 0;
  const std::string text = lines_of(steps, [&](json step) {
    if (step["step"] == "skip_edge" && step["why"] == "between_rows") step["why"] = "outside", ++outside;
    return step.dump();
  });
  REQUIRE(outside > 0);
  const Outcome outcome = grade_of(folder, text);
  CHECK_MESSAGE(outcome.code == 0, outcome.out);
  CHECK(has(outcome.out, "65 of 65 points"));
  // The hand-outs name all of them, and no other.
  std::set<std::string> words;
  for (const std::string_view word : zstep::words_of<zstep::EdgeSkip>) words.emplace(word);
  for (const zstep::OtherWord& other : zstep::other_words)
    if (other.field == "why") words.emplace(other.word);
  for (const char* method : {"z-buffer", "scan-line"}) {
    const std::string page =
        text_of(zstep::test::in_checkout(std::string("lessons/homework/") + method + "/handout.md"));
    const std::size_t begin = page.find("the reason");
    std::size_t end = page.find(".\n", begin);
    const std::string sentence = page.substr(begin, end - begin);
    std::set<std::string> offered;
    static const std::regex quoted("`([a-z_]+)`");
    for (std::sregex_iterator at(sentence.begin(), sentence.end(), quoted), none; at != none; ++at)
      offered.insert((*at)[1]);
    CAPTURE(method);
    CHECK(offered == words);
  }
}

TEST_CASE("grade: the hand-out says of empty spans what is taken") {
  const std::string page = text_of(zstep::test::in_checkout("lessons/homework/z-buffer/handout.md"));
  const std::size_t begin = page.find("A span without pixels");
  REQUIRE(begin != std::string::npos);
  const std::string paragraph = page.substr(begin, page.find("\n\n", begin) - begin);
  static const std::regex quoted("`([^`]+)`");
  int words = 0;
  for (std::sregex_iterator at(paragraph.begin(), paragraph.end(), quoted), none; at != none; ++at) {
    const std::string word = (*at)[1];
    if (word == "dz_dx" || word == "first" || word == "last") continue;
    ++words;
    CAPTURE(word);
    json line = {{"step", "span"}, {"x_left", 2}, {"x_right", 2}};
    const auto text = zstep::with_words_quoted("{\"step\":\"span\",\"x_left\":2,\"x_right\":2,\"dz_dx\":" + word + "}");
    CHECK((word == "null" || word == "0" || text.has_value()));
  }
  CHECK(words >= 4);
}

TEST_CASE("grade: a line that cannot be read costs itself alone, and is what the report begins with") {
  const Folder folder;
  const std::vector<std::string> right = crossing_lines(folder);
  const std::size_t middle = line_with(right, "\"step\":\"compare\"");
  struct Case {
    const char* what;
    std::function<void(std::vector<std::string>&)> change;
    bool costs;
    const char* says;
  };
  const auto replaced = [&](const std::string& from, const std::string& to) {
    return [=](std::vector<std::string>& lines) { replace_first(lines[middle], from, to); };
  };
  for (const Case& one : std::vector<Case>{
           {"null", replaced("\"nearer\":true", "\"nearer\":null"), true, "is neither true nor false"},
           {"an extra field", replaced("{\"step\"", "{\"edge\":1,\"step\""), true, "is no field of"},
           {"an unknown step", replaced("\"compare\"", "\"compair\""), true, "there is no step"},
           {"a debug print",
            [&](std::vector<std::string>& lines) { lines.insert(lines.begin() + middle, "x is now 3"); }, false,
            "x is now 3"},
           {"a debug print at the beginning",
            [&](std::vector<std::string>& lines) { lines.insert(lines.begin(), "reading the scene {now}"); }, false,
            ""},
           {"a header that is none",
            [&](std::vector<std::string>& lines) { lines.insert(lines.begin(), "{\"ztrace\":1,\"conventions\":3}"); },
            false, "conventions"},
           {"a line torn in two",
            [&](std::vector<std::string>& lines) {
              const std::string line = lines[middle];
              lines[middle] = line.substr(0, 12);
              lines.insert(lines.begin() + middle + 1, line.substr(12));
            },
            true, ""}}) {
    std::vector<std::string> lines = right;
    one.change(lines);
    const Outcome outcome = graded_lines(folder, lines);
    CAPTURE(one.what);
    CAPTURE(outcome.out);
    CHECK(outcome.code == 1);
    CHECK_FALSE(has(outcome.out, "no grade"));
    CHECK(has(outcome.out, one.says));
    const json report = json::parse(graded_lines(folder, lines, "json").out);
    const double points = report["points"], most = report["of"];
    CHECK((points < most) == one.costs);
    CHECK(points > 0.95 * most);
    // The first sentence after the points names the line.
    const std::size_t after = outcome.out.find("points\n\n") + 8;
    CHECK(outcome.out.compare(after, 15, "crossing.jsonl:") == 0);
    CHECK(report["scenes"][0]["unreadable"]["lines"].get<int>() >= 1);
    // The place of a later step is still that of its line.
    std::vector<std::string> twice = lines;
    const std::size_t last = twice.size() - 2;
    std::size_t wrong = last;
    while (!has(twice[wrong], "\"step\":\"interpolate_z\"")) --wrong;
    json step = json::parse(twice[wrong]);
    step["z"] = 0.987;
    twice[wrong] = step.dump();
    const json other = json::parse(graded_lines(folder, twice, "json").out);
    if (!one.costs)
      CHECK(other["scenes"][0]["first"]["where"].get<std::string>() == "crossing.jsonl:" + std::to_string(wrong + 1));
  }
}

TEST_CASE("grade: many lines that cannot be read are counted, the first are named, and there is an end") {
  const Folder folder;
  std::vector<std::string> lines = crossing_lines(folder);
  std::vector<std::string> many;
  for (const std::string& line : lines) {
    many.push_back("debug");
    many.push_back(line);
  }
  const Outcome outcome = graded_lines(folder, many);
  CHECK_MESSAGE(has(outcome.out, "16.25 of 16.25 points"), outcome.out);
  CHECK(has(outcome.out, "crossing.jsonl:1:1: "));
  std::string text = lines[0] + "\n" + lines[1] + "\n";
  for (int i = 0; i < 150'000; ++i) text += "{\"step\":\"compare\",\"x\":null}\n";
  write_text(folder / "crossing.jsonl", text);
  const Outcome hostile = run(folder, "grade --homework hw crossing.jsonl");
  CHECK(hostile.code == 1);
  CHECK(has(hostile.out, "what comes after the last of them was not read"));
}

TEST_CASE("grade: a crash comes first, with its traceback, and a class files it as one") {
  const Folder folder;
  const std::vector<std::string> lines = crossing_lines(folder);
  REQUIRE(shell(folder, "mkdir -p class/ada").code == 0);
  std::string half;
  for (std::size_t i = 0; i < lines.size() / 2; ++i) half += lines[i] + "\n";
  write_text(folder / "class/ada/crossing.jsonl", half);
  write_text(
      folder / "class/ada/crossing.ended.txt",
      "The program ended with exit code 1.\nTraceback (most recent call last):\nZeroDivisionError: division by zero\n");
  const Outcome text = run(folder, "grade --homework hw --scene crossing class/ada");
  const std::size_t crash = text.out.find("The program ended with exit code 1."), points = text.out.find(" points\n\n"),
                    first = text.out.find("The first thing to look at");
  CAPTURE(text.out);
  CHECK(crash == points + 9);
  CHECK(has(text.out, "ZeroDivisionError: division by zero"));
  CHECK(crash < first);
  for (const std::string format : {"gradescope", "html"}) {
    const Outcome other = run(folder, "grade --homework hw --scene crossing class/ada --format " + format);
    CHECK(other.out.find("ZeroDivisionError") < other.out.find("This step is missing"));
  }
  REQUIRE(run(folder, "grade --homework hw --batch class --scene crossing -o book.csv --report class.html").code == 0);
  const std::string page = text_of(folder / "class.html");
  CHECK(has(page, "<code>crash</code>"));
  CHECK(has(text_of(folder / "book.csv"), "crossing: crash"));
}

TEST_CASE("grade: numbers that begin at 1, or anew in each polygon, are named as what is wrong") {
  const Folder folder;
  const std::vector<std::string> lines = crossing_lines(folder);
  const auto said = [&](const std::function<void(json&)>& change) {
    std::vector<std::string> other;
    for (const std::string& line : lines) {
      json step = json::parse(line);
      change(step);
      other.push_back(step.dump());
    }
    return graded_lines(folder, other).out;
  };
  const auto add_to = [](json& step, const char* key, int more) {
    if (step.contains(key)) step[key] = step[key].get<int>() + more;
  };
  const std::string polygons = said([&](json& step) { add_to(step, "polygon", 1), add_to(step, "facet", 1); });
  CHECK_MESSAGE(has(polygons, "numbered from 0"), polygons);
  CHECK(has(polygons, "Polygons are numbered from 0, in the order of the file; yours begin with 1."));
  const std::string vertices = said([&](json& step) { add_to(step, "vertex_0", 1), add_to(step, "vertex_1", 1); });
  CHECK_MESSAGE(has(vertices, "yours begin with 1."), vertices);
  int polygon = 0;
  const std::string local = said([&](json& step) {
    if (step["step"] == "polygon") polygon = step["polygon"];
    if (polygon > 0) add_to(step, "vertex_0", -3 * polygon), add_to(step, "vertex_1", -3 * polygon);
  });
  CHECK_MESSAGE(has(local, "yours are counted anew in each."), local);
}

TEST_CASE("grade: pictures and depths are worth half of their part each") {
  const Folder folder;
  const std::vector<std::string> lines = crossing_lines(folder);
  const auto part = [&](const std::function<void(json&)>& change) {
    std::vector<std::string> other;
    for (const std::string& line : lines) {
      json step = json::parse(line);
      change(step);
      if (!step.is_null()) other.push_back(step.dump());
    }
    const Outcome outcome = graded_lines(folder, other, "json");
    return json::parse(outcome.out)["scenes"][0]["parts"][0];
  };
  const double most = part([](json&) {})["of"];
  for (const json& z : {json("nan"), json("inf"), json("-inf"), json(0.5)}) {
    const json of = part([&](json& step) {
      if (step["step"] == "write_depth") step["z"] = z;
    });
    CAPTURE(z);
    CHECK(of["points"] == doctest::Approx(most / 2));
    CHECK(of["right"] == 0);
    CHECK(of["right_depths"] == 0);
  }
  // Who compares rightly against what was stored has depths; that their writes are not printed costs where writes are
  // asked for. Who compares with the empty buffer only, or with none, has no depths.
  const auto leaves_out = [](const char* other) {
    return [other](json& step) {
      if (step["step"] == "compare") step["nearer"] = true;
      if (step["step"] == "write_depth" || step["step"] == other) step = nullptr;
    };
  };
  const json compared = part([](json& step) {
    if (step["step"] == "write_depth") step = nullptr;
  });
  CHECK(compared["points"] == doctest::Approx(most));
  CHECK(compared["lost"].empty());
  for (const json& none : {part(leaves_out("write_depth")), part(leaves_out("compare"))}) {
    CHECK(none["points"] == doctest::Approx(most / 2));
    REQUIRE(none["lost"].size() == 1);
    CHECK(none["lost"][0]["why"] == "no_depths");
  }
}

TEST_CASE("grade: of scenes with other weights the points are shared by these") {
  const Folder folder;
  const std::vector<std::string> lines = crossing_lines(folder);
  std::string toml = text_of(folder / "hw/homework.toml");
  replace_first(toml, "file = \"scenes/crossing.toml\"\n", "file = \"scenes/crossing.toml\"\nweight = 3\n");
  write_text(folder / "hw/homework.toml", toml);
  std::string text;
  for (const std::string& line : lines)
    if (!has(line, "\"step\":\"interpolate_z\"")) text += line + "\n";
  write_text(folder / "runs/crossing.jsonl", text);
  const json report = json::parse(run(folder, "grade --homework hw runs --format json").out);
  double sum = 0;
  for (const json& scene : report["scenes"]) {
    const bool heavy = scene["scene"] == "crossing";
    double points = 0, most = 0;
    for (const json& part : scene["parts"]) points += part["points"].get<double>(), most += part["of"].get<double>();
    CHECK(most == doctest::Approx(65 * (heavy ? 3.0 : 1.0) / 6));
    // Of the spans, 17 of 100 steps are there: 15 of 65 points hang on these.
    CHECK(points == doctest::Approx(most - (heavy ? 32.5 * 15 / 65 * 83 / 100 : 0)));
    sum += points;
  }
  CHECK(report["points"] == doctest::Approx(sum));
  CHECK(report["of"] == doctest::Approx(65));
}
