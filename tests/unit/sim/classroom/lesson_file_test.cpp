#include <cstdlib>
#include <filesystem>
#include <fstream>

#include <unistd.h>

#include "sim/classroom/chart_table.hpp"
#include "sim/classroom/lesson.hpp"
#include "tests/folder.hpp"
#include "tests/unit/sim/classroom/small_run.hpp"

namespace zstep {
namespace {

using classroom::complaint;
using classroom::contains;

const std::string head =
    "+++\ntitle = \"T\"\nsummary = \"S\"\nscene = \"delhi\"\nmethod = \"z-buffer\"\n+++\n";  // six lines
const std::string question =
    "::: question\nWhich?\n\n- [ ] one\n  more of one\n  > No,\n  > not one.\n- [x] {z}\n  > Yes.\n:::\n";

/// A file of its own for each test, gone with it.
class LessonFile {
 public:
  explicit LessonFile(const std::string& text, const std::string& name = "7-made-up.md") {
    path = folder_.write(name, text);
  }

  std::filesystem::path path;

 private:
  test::Folder folder_;
};

/// The complaint about a lesson, without the folder its file lies in.
std::string load_error(const std::string& text) {
  const LessonFile file(text);
  const std::string error = complaint([&] { load_lesson(file.path); });
  const std::size_t name = error.find("7-made-up.md");
  return name == std::string::npos ? error : error.substr(name);
}
std::string run_error(const std::string& text) {
  const LessonFile file(text);
  const std::string error = complaint([&] {
    Lesson lesson = load_lesson(file.path);
    run_lesson(lesson);
  });
  const std::size_t name = error.find("7-made-up.md");
  return name == std::string::npos ? error : error.substr(name);
}

TEST_CASE("a lesson is a head and stops") {
  const LessonFile file(
      head + "\n## First {at: start}\n\nHello,\n**you**.\n\n## A tie at {x} {before: compare where not nearer}\n\n" +
      question + "\n");
  Lesson lesson = load_lesson(file.path);
  CHECK(lesson.id == "made-up");
  CHECK(lesson.title == "T");
  CHECK(lesson.summary == "S");
  CHECK(lesson.scene == "delhi");
  REQUIRE(lesson.stops.size() == 2);
  CHECK(lesson.stops[0].heading == "First");
  CHECK(lesson.stops[0].text == "Hello,\n**you**.");
  CHECK(lesson.stops[0].line == 8);
  CHECK(lesson.stops[0].text_line == 10);
  CHECK(lesson.stops[1].anchor == "before: compare where not nearer");
  REQUIRE(lesson.stops[1].question.has_value());
  const Question& asked = *lesson.stops[1].question;
  CHECK(asked.text == "Which?");
  REQUIRE(asked.answers.size() == 2);
  CHECK(asked.answers[0].text == "one\nmore of one");
  CHECK(asked.answers[0].reply == "No,\nnot one.");
  CHECK_FALSE(asked.answers[0].right);
  CHECK(asked.answers[1].right);
  CHECK(asked.answers[1].text == "{z}");

  const Trace trace = run_lesson(lesson);
  CHECK(lesson.stops[0].position == 0);
  CHECK(lesson.stops[1].heading == "A tie at 1");  // pixel (1, 3), the first tie of the Delhi example
  CHECK(get<DepthCompare>(trace.event(lesson.stops[1].position + 1).event).y == 3);
  CHECK(lesson.stops[1].question->answers[1].text == "5");
}

TEST_CASE("the head sets view and conventions") {
  const LessonFile file(
      "+++\ntitle = \"T\"\nsummary = \"S\"\nscene = \"pyramid\"\nmethod = \"z-buffer\"\n[camera]\nrho = 6\ntheta = "
      "10.5\northographic = true\n"
      "[raster]\nwidth = 16\nheight = 12\n[conventions]\ndepth = \"view\"\ninterpolation = \"increments\"\ncoverage = "
      "\"inclusive\"\ncull = false\n"
      "+++\n## Here {at: start}\nText.\n");
  Lesson lesson = load_lesson(file.path);
  const Trace trace = run_lesson(lesson);
  CHECK(trace.scene().camera.rho == 6);
  CHECK(trace.scene().camera.theta == 10.5);
  CHECK(trace.scene().camera.kind == Camera::Kind::orthographic);
  CHECK(trace.scene().raster.width == 16);
  CHECK(trace.scene().raster.height == 12);
  Conventions chosen;
  chosen.depth = Conventions::Depth::view, chosen.interpolation = Conventions::Interpolation::increments;
  chosen.coverage = Conventions::Coverage::inclusive, chosen.cull = false;
  CHECK(trace.header().conventions == chosen);
}

TEST_CASE("unset conventions stay the scene's own") {
  const LessonFile file(head + "## Here {at: start}\nText.\n");
  Lesson lesson = load_lesson(file.path);
  CHECK(run_lesson(lesson).header().conventions.coverage == Conventions::Coverage::inclusive);
}

TEST_CASE("a scene file is looked for beside the lesson") {
  const LessonFile file(
      "+++\ntitle = \"T\"\nsummary = \"S\"\nscene = \"own.toml\"\nmethod = \"z-buffer\"\n+++\n## Here {at: "
      "end}\n{count(compare)}\n");
  Lesson lesson = load_lesson(file.path);
  CHECK(contains(complaint([&] { run_lesson(lesson); }), "own.toml"));
  std::ofstream(file.path.parent_path() / "own.toml")
      << "coordinates = \"screen\"\n[raster]\nwidth = 4\nheight = 4\n[[polygon]]\npoints = [[0, 0, 1], [2, 0, 1], [2, "
         "2, 1], [0, 2, 1]]\n";
  run_lesson(lesson);
  CHECK(lesson.stops[0].text == "4");
}

TEST_CASE("Windows line ends and a byte order mark are taken") {
  std::string text = "\xEF\xBB\xBF";
  for (const char c : head + "## Here {at: start}\nText.\n") {
    if (c == '\n') text += '\r';
    text += c;
  }
  const LessonFile file(text);
  CHECK(load_lesson(file.path).stops[0].text == "Text.");
}

TEST_CASE("a block of code goes in whole") {
  const LessonFile file(head + "## Here {at: start}\n```\n## no stop\n::: question\nx < 3 {{\n```\n");
  CHECK(load_lesson(file.path).stops.size() == 1);
}

TEST_CASE("slips in the head") {
  CHECK(load_error("") == "7-made-up.md:1: the lesson has no head; begin with a line +++, then title = \"…\"");
  CHECK(contains(load_error("## Here {at: start}\n"), ":1: the lesson has no head"));
  CHECK(contains(load_error("+++\ntitle = \"T\"\n"), ":1: the head is not closed; add a second line +++"));
  CHECK(contains(load_error("+++\ntitle = \"T\"\nsummary = \n+++\n"), ":3: the head is no TOML"));
  CHECK(contains(load_error("+++\nsummary = \"S\"\n+++\n"),
                 ":2: the head needs a text for `title`; write title = \"…\""));
  CHECK(contains(load_error("+++\ntitle = 3\n+++\n"), ":2: the head needs a text for `title`"));
  CHECK(contains(load_error("+++\ntitle = \"T\"\nsumary = \"S\"\n+++\n"),
                 ":3: a lesson's head has no `sumary` (did you mean `summary`?)"));
  const auto with = [](const std::string& more) {
    return head.substr(0, head.size() - 4) + more + "+++\n## Here {at: start}\nText.\n";
  };
  CHECK(load_error(with("")) == "");
  std::string dotted = "a";
  for (int i = 0; i < 100000; ++i) dotted += ".a";
  CHECK(contains(load_error(with(dotted + " = 1\n")), "7-made-up.md:6: "));
  CHECK(contains(load_error(with("[camera]\nrh = 3\n")), ":7: [camera] has no `rh`"));
  CHECK(contains(load_error(with("[camera]\nrho = \"far\"\n")), ":7: `rho` is no number"));
  CHECK(contains(load_error(with("[camera]\nrho = inf\n")), ":7: `rho` is no number"));
  CHECK(contains(load_error(with("[raster]\nwidth = 0\n")), ":7: `width` is not a number of pixels"));
  CHECK(contains(load_error(with("[raster]\nwidth = 2.5\n")), ":7: `width` is not a number of pixels"));
  CHECK(contains(load_error(with("[conventions]\ndepth = \"w\"\n")),
                 ":7: `depth` has a value it does not know; write depth = \"pseudodepth\" or \"view\""));
  CHECK(contains(load_error(with("[conventions]\ncull = 1\n")), ":7: `cull` is no truth"));
  CHECK(contains(load_error(with("camera = 3\n")), ":6: `camera` is no table"));
  CHECK(contains(load_error("+++\ntitle = \"T\"\nsummary = \"S\"\nscene = \"delhi\"\nmethod = \"warnok\"\n+++\n## Here "
                            "{at: start}\nText.\n"),
                 "warnok"));
}

TEST_CASE("a table in the text is a chart, and one that cannot be drawn is refused") {
  const std::string stop = "## Here {at: start; focus: chart}\nText.\n\n```plain\n", end = "```\n";
  const LessonFile file(head + "## Here {at: start}\n```\nno 1 table\n```\nText.\n\n```cost, in units\n" +
                        "polygons N  100  ?  60000\n\ndepth sort  {polygons}  4\u20138  0.5\nas N  1  \u2026  600\n" +
                        end + "## There {at: end; focus: chart}\nMore.\n");
  Lesson lesson = load_lesson(file.path);
  const Trace trace = run_lesson(lesson);
  for (const int at : {0, 1}) {
    bool own = false;
    const auto table = classroom::chart_of(lesson, at, own);
    REQUIRE(table);
    CHECK(own == (at == 0));
    CHECK(table->up == "cost, in units");
    CHECK(table->across == "polygons N");
    CHECK(table->columns == std::vector<std::optional<double>>{100, std::nullopt, 60000});
    REQUIRE(table->rows.size() == 2);
    CHECK(table->rows[0].name == "depth sort");
    const double polygons = static_cast<double>(trace.scene().polygons.size());
    CHECK(table->rows[0].values[0]->x == polygons);
    CHECK((table->rows[0].values[1]->x == 4 && table->rows[0].values[1]->y == 8));
    CHECK(!table->rows[1].values[1]);
  }
  CHECK(contains(run_error(head + "## Here {at: start; focus: chart}\nText.\n"), ":7: there is no table for"));
  for (const char* columns : {"polygons 100", "100 200", "N ? ? 100 200", "N 100 ?", "N 0 100", "N -1 1e300"})
    CHECK_MESSAGE(contains(run_error(head + stop + columns + "\na 1 2\n" + end), ":11: "), columns);
  for (const char* row : {"a 1", "1 2", "a b 2", "a 1 2 3", "a 8\u20134 1", "a 0 1", "a -1 1", "a \u2026 \u2026",
                          "a 1e13 1", "a nan 1", "a 1 inf", "a 1\u2013 2"})
    CHECK_MESSAGE(contains(run_error(head + stop + "N 1 2\na 1 2\n" + row + "\n" + end), ":13: `"), row);
  CHECK(contains(run_error(head + stop + "N 1 2\n" + end), ": a chart's table has no rows"));
  CHECK(contains(run_error(head + stop + "N 1 2\na 1 2\nb 1 2\nc 1 2\nd 1 2\ne 1 2\nf 1 2\n" + end), ":17: `f 1 2`"));
}

TEST_CASE("slips in the stops") {
  CHECK(contains(load_error(head), "the lesson has no stop"));
  CHECK(contains(load_error(head + "Hello.\n"), ":7: text before the first stop"));
  CHECK(contains(load_error(head + "# Title\n"), ":7: a heading with one #"));
  CHECK(contains(load_error(head + "## Here\nText.\n"),
                 ":7: the stop `Here` has no anchor; end its heading with {at: step}"));
  const LessonFile focused(head + "## Here {at: start; focus: edge-table}\nText.\n");
  CHECK(load_lesson(focused.path).stops.at(0).focus == "edge_table");
  CHECK(contains(load_error(head + "## Here {at: start; look: scene}\nText.\n"),
                 ":7: `look: scene` is left over in the anchor; after ; write `focus:`, `viewing:`, `order:`, "));
  const LessonFile marked(head + "## Here {at: start; pixel: (2, 1); pixels: compare where nearer}\nText.\n");
  Lesson marks = load_lesson(marked.path);
  REQUIRE(marks.stops.at(0).pixel);
  CHECK(marks.stops[0].pixel->x == 2);
  CHECK(marks.stops[0].pixel->y == 1);
  const Trace its_run = run_lesson(marks);
  CHECK(!marks.stops[0].pixels.right.empty());  // of steps that are still to come
  const LessonFile labelled(head + "## Here {at: start; viewing: T_v; label: scan line 0}\nOn scan line {\"0\"}.\n");
  Lesson spoken = load_lesson(labelled.path);
  CHECK(spoken.stops.at(0).viewing_step == 5);
  CHECK(spoken.stops[0].labels.at(0).scan_line == 0);
  const Trace labelled_run = run_lesson(spoken);  // it is spoken of
  for (const char* wrong :
       {"pixel: (2)", "pixel: (2, -1)", "pixel: 2 x", "label: 1-x", "label:", "label: scan line -1", "viewing: T_5"})
    CHECK(contains(load_error(head + "## Here {at: start; " + wrong + "}\nText.\n"), ":7: `"));
  for (const char* wrong :
       {"pixel: (9999, 0)", "label: V_9999", "label: scan line 9999", "pixels: compare where x < 0", "pixels: fly"}) {
    const LessonFile refused(head + "## Here {at: start; " + wrong + "}\nText.\n");
    Lesson lesson = load_lesson(refused.path);
    CHECK_THROWS_WITH(run_lesson(lesson), doctest::Contains("7-made-up.md:7"));
  }
  CHECK(contains(load_error(head + "## Here {at: start; beside: runs/none.jsonl}\nText.\n"),
                 ":7: there is no run `runs/none.jsonl`; give the path of its .jsonl from the lesson's folder"));
  CHECK(contains(load_error(head + "## Here {at: start; beside: " + std::string(5000, 'x') + "}\nText.\n"),
                 ":7: there is no run `xxx"));
  const LessonFile beside(head + "## Here {at: start; beside: 7-made-up.md}\nText.\n");
  Lesson no_run = load_lesson(beside.path);
  CHECK_THROWS_WITH(run_lesson(no_run), doctest::Contains("7-made-up.md:1"));
  const LessonFile labels(head +
                          "## V_5 and V_0 {at: start; label: V_5, V_0 = 2, way = 1-2-0, V_01 = 0>1, W, plane = C}\n" +
                          "The way and plane V_01 of W.\n");
  const std::vector<StopLabel> read = load_lesson(labels.path).stops.at(0).labels;
  REQUIRE(read.size() == 7);
  CHECK((read[0].name == "V_5" && read[0].vertex == 5 && read[0].to < 0));
  CHECK((read[1].name == "V_0" && read[1].vertex == 2));
  CHECK((read[2].name == "way" && read[2].vertex == 1 && read[2].to == 2 && !read[2].arrow));
  CHECK((read[3].name.empty() && read[3].vertex == 2 && read[3].to == 0));
  CHECK((read[4].name == "V_01" && read[4].to == 1 && read[4].arrow));
  CHECK((read[5].name == "W" && read[5].vertex < 0 && read[5].plane_of.empty()));
  CHECK((read[6].name == "plane" && read[6].plane_of == "C"));
  CHECK(contains(load_error(head + "## Here {at: start; label: way = 1-x}\nWay.\n"), ":7: `way = 1-x` is no label"));
  const LessonFile unspoken(head + "## Here {at: start; label: V_1}\nText.\n");
  Lesson of_nothing = load_lesson(unspoken.path);
  CHECK_THROWS_WITH(run_lesson(of_nothing), doctest::Contains("`V_1` is labelled, and the stop does not speak of it"));
  const LessonFile windowed(head + "## Here {at: start; focus: scene; window: -1 2 -3 4 5 \u03b1}\nText.\n");
  CHECK(load_lesson(windowed.path).stops.at(0).window == StopWindow{-1, 2, -3, 4, 5, 0, true});
  CHECK(
      contains(load_error(head + "## Here {at: start; window: 2 1 -3 4 5}\nText.\n"), ":7: `2 1 -3 4 5` is no window"));
  const LessonFile coarse(head + "## Here {at: start; beside: size = 4x4}\nText.\n");
  Lesson with_coarse = load_lesson(coarse.path);
  CHECK(run_lesson(with_coarse).scene().raster.width != 4);
  REQUIRE(with_coarse.stops.at(0).beside.size() == 1);
  CHECK(with_coarse.stops.at(0).beside[0].run->scene().raster.width == 4);
  CHECK(contains(load_error(head + "## Here {at: start; beside: = 4x4}\nText.\n"), ":7"));
  CHECK(contains(run_error(head + "## Here {at: start; beside: none = 4}\nText.\n"), ":7"));
  const LessonFile viewing(head + "## Here {at: start; focus: scene; viewing: T_3}\nText.\n");
  CHECK(load_lesson(viewing.path).stops.at(0).focus == "scene");
  CHECK(load_lesson(viewing.path).stops.at(0).viewing_step == 3);
  const LessonFile order(head + "## Here {at: start; focus: scene; order: T_2 T_1, T_1 T_2}\nText.\n");
  CHECK(load_lesson(order.path).stops.at(0).orders == std::vector<std::vector<int>>{{2, 1}, {1, 2}});
  const LessonFile no_order(head + "## Here {at: start; order: T_2 T_5}\nText.\n");
  CHECK_THROWS_WITH(load_lesson(no_order.path), doctest::Contains(":7: `order: T_2 T_5` is not"));
  const LessonFile one_too_many(head + "## Here {at: start; order: T_2 T_1,}\nText.\n");
  CHECK_THROWS_WITH(load_lesson(one_too_many.path), doctest::Contains(":7: `order: T_2 T_1,` has a comma"));
  for (const char* wrong : {"T_5", "T_0", "3", "T_12", ""}) {
    const LessonFile refused(head + "## Here {at: start; viewing: " + wrong + "}\nText.\n");
    CHECK_THROWS_WITH(load_lesson(refused.path), doctest::Contains(":7: `viewing:"));
  }
  CHECK(contains(load_error(head + "## {at: start}\nText.\n"), ":7: the stop has no heading"));
  CHECK(contains(load_error(head + "## Here {at: start}\n\n## There {at: end}\nText.\n"), ":7: the stop says nothing"));
  CHECK(contains(load_error(head + "## Here {at: cmpare}\nText.\n"),
                 ":7: the method has no step named `cmpare` (did you mean `compare`?)"));
  CHECK(contains(load_error(head + "## Here {at: compare where w < 3}\nText.\n"), ":7: nothing is called `w`"));
  CHECK(contains(load_error(head + "## Here {at: compare}\n\nText {z} and\n{zz}.\n"), ":10: nothing is called `zz`"));
  CHECK(contains(load_error(head + "## Here {at: compare}\nText {z.\n"), ":8: a `{` is not closed on its line"));
  CHECK(contains(load_error(head + "## Here {at: start}\n```\ncode\n"), ":8: a code block is not closed"));
  CHECK(contains(load_error(head + "## Here {at: start}\nText \xFF.\n"), ":8: the line is not UTF-8"));
  CHECK(contains(run_error(head + "## Here {at: clip_cross}\nText.\n"), ":7: `clip_cross` never happens in this run"));
  CHECK(contains(run_error(head + "## Here {at: end}\nText.\n## There {at: compare}\nText.\n"),
                 ":9: `compare` happens as described 49 times, but not after the stop before this one"));
  CHECK(contains(run_error(head + "## Here {at: compare}\nText.\n\n{z = 4}\n"),
                 ":10: `{z = 4}` does not hold: it is 5 here"));
}

TEST_CASE("a task that the lesson's own run does is refused, and a run without what it asks about does not do it") {
  const std::string stop = head + "## Here {at: compare}\n::: task\nDo it.\n";
  const auto with = [&](const std::string& done) { return stop + "done: " + done + "\nsolution: size = 40x40\n:::\n"; };
  // The run compares 49 times.
  CHECK(contains(run_error(with("count(compare) == 49")), ":10: the lesson's own run does the task already"));
  CHECK(run_error(with("count(compare) == 48")).empty());
  CHECK(run_error(with("not (count(compare) == 49)")).empty());
  // On 8x8 pixels none is at (30, 30); of a larger run it is asked.
  const LessonFile file(with("depth(30, 30) > 0"));
  Lesson lesson = load_lesson(file.path);
  const Trace trace = run_lesson(lesson);
  REQUIRE(lesson.stops[0].task);
  Task task = *lesson.stops[0].task;
  CHECK_FALSE(state_of(task, trace).done);
  task.done = "depth(3, 3) > 0";
  CHECK(state_of(task, trace).done);
}

TEST_CASE("slips in tasks") {
  const std::string stop = head + "## Here {at: compare}\n";  // line 7
  const std::string task = stop + "::: task\nDo it.\n", done = "done: width > 3\n", solved = "solution: size = 40x40\n";
  CHECK(contains(load_error(task), ":8: the task is not closed; add a line `:::`"));
  CHECK(contains(load_error(stop + "::: task\n" + done + solved + ":::\n"), ":8: the task asks for nothing"));
  CHECK(contains(load_error(task + solved + ":::\n"), ":8: the task is never done"));
  CHECK(contains(load_error(task + done + ":::\n"), ":8: the task has no solution"));
  CHECK(contains(load_error(task + done + done + solved + ":::\n"), ":11: a second `done:`"));
  CHECK(contains(load_error(task + "done: width\n" + solved + ":::\n"), ":10: `width` is neither true nor false"));
  CHECK(contains(load_error(task + "done: wdth > 3\n" + solved + ":::\n"), ":10: "));
  CHECK(contains(load_error(task + done + "now: {wdth}\n" + solved + ":::\n"), ":11: "));
  CHECK(contains(load_error(task + done + "hint:\n" + solved + ":::\n"), ":11: nothing stands after `hint:`"));
  CHECK(contains(load_error(task + done + "solution: wider\n:::\n"), ":11: "));
  CHECK(contains(load_error(task + done + "and more\n" + solved + ":::\n"),
                 ":11: a line that does not belong to the task"));
  CHECK(contains(load_error(task + done + solved + ":::\nmore\n"), ":13: text after a task"));
  CHECK(contains(load_error(task + done + solved + ":::\n::: task\n"), ":13: a second task at one stop"));
  CHECK(contains(load_error(head + "::: task\n"), ":7: a task before the first stop"));
}

TEST_CASE("slips in what is to be marked") {
  const std::string stop = head + "## Here {at: clear}\n";  // line 7
  const std::string mark = stop + "::: mark\nMark it.\n", why = "why: It is so.\n";
  CHECK(run_error(mark + "pixels: compare where y == 3\n" + why + ":::\n") == "");
  CHECK(contains(load_error(mark), ":8: the mark is not closed; add a line `:::`"));
  CHECK(
      contains(load_error(stop + "::: mark\npixels: compare\n" + why + ":::\n"), ":8: nothing is asked to be marked"));
  CHECK(contains(load_error(mark + why + ":::\n"), ":8: nothing says which marks are right"));
  CHECK(contains(load_error(mark + "pixels: compare\n:::\n"), ":8: nothing says why the marks are right"));
  CHECK(contains(load_error(mark + "pixels: compare\npixels: compare\n" + why + ":::\n"),
                 ":11: a second line that says what is right"));
  CHECK(contains(load_error(mark + "pixels: cmpare\n" + why + ":::\n"), ":10: the method has no step named `cmpare`"));
  CHECK(contains(load_error(mark + "pixels: compare, first\n" + why + ":::\n"), ":10: `compare, first` does not name"));
  CHECK(
      contains(load_error(mark + "pixels: insert_edge\n" + why + ":::\n"), ":10: `insert_edge` is no step of a pixel"));
  CHECK(
      contains(load_error(mark + "scan line: insert_edge\n" + why + ":::\n"), ":10: `insert_edge` does not say what"));
  CHECK(contains(load_error(mark + "scan line: polygon of insert_edge\n" + why + ":::\n"),
                 ":10: `polygon` is no number"));
  CHECK(contains(load_error(mark + "order: y of compare\n" + why + ":::\n"), ":10: `y` is no polygon"));
  CHECK(contains(load_error(mark + "pixels: compare\nand more\n" + why + ":::\n"),
                 ":11: a line that does not belong to what is marked"));
  CHECK(contains(load_error(mark + "pixels: compare\n" + why + ":::\nmore\n"), ":13: text after what is to be marked"));
  CHECK(contains(load_error(mark + "pixels: compare\n" + why + ":::\n" + question),
                 ":13: a mark and a question at one stop"));
  CHECK(contains(run_error(mark + "pixels: compare where x > 90\n" + why + ":::\n"),
                 ":10: no step `compare` after this stop"));
  CHECK(contains(run_error(mark + "scan line: y of compare\n" + why + ":::\n"),
                 "7 scan lines are right; add a condition"));
  CHECK(contains(run_error(mark + "order: polygon of compare where polygon == \"A\"\n" + why + ":::\n"),
                 ":10: an order of 1 is asked for"));
}

TEST_CASE("slips in questions") {
  const std::string stop = head + "## Here {at: compare}\n";  // line 7
  CHECK(load_error(stop + question) == "");
  CHECK(contains(load_error(stop + "::: question\nWhich?\n- [x] a\n  > b\n"),
                 ":8: the question is not closed; add a line `:::`"));
  CHECK(contains(load_error(stop + "::: question\nWhich?\n- [x] a\n  > b\n## Next {at: end}\nText.\n"),
                 ":8: the question is not closed"));
  CHECK(contains(load_error(stop + ":::\n"), ":8: `:::` closes nothing"));
  CHECK(contains(load_error(stop + "::: quiz\n:::\n"), ":8: a block of the unknown kind `quiz`"));
  CHECK(contains(load_error(stop + "::: question\n- [x] a\n  > b\n:::\n"), ":8: the question asks nothing"));
  CHECK(contains(load_error(stop + "::: question\nWhich?\n- [x] a\n  > b\n:::\n"),
                 ":8: the question has fewer than two answers"));
  CHECK(contains(load_error(stop + "::: question\nWhich?\n- [ ] a\n  > b\n- [ ] c\n  > d\n:::\n"),
                 ":8: the question has 0 right answers; mark exactly one"));
  CHECK(contains(load_error(stop + "::: question\nWhich?\n- [x] a\n  > b\n- [x] c\n  > d\n:::\n"),
                 ":8: the question has 2 right answers"));
  CHECK(contains(load_error(stop + "::: question\nWhich?\n- [x] a\n- [ ] c\n  > d\n:::\n"),
                 ":10: the answer has no reply; say under it, after `  > `"));
  CHECK(contains(load_error(stop + "::: question\nWhich?\n- [x] a\n  > b\n- c\n:::\n"),
                 ":12: an answer without its box"));
  CHECK(contains(load_error(stop + "::: question\nWhich?\n- [x] a\n  > b\nmore\n:::\n"),
                 ":12: a line that is neither answer nor reply"));
  CHECK(contains(load_error(stop + "::: question\nWhich?\n- [x] a\n  > b {q}\n- [ ] c\n  > d\n:::\n"),
                 ":11: nothing is called `q`"));
  CHECK(contains(load_error(stop + question + question), ":18: a second question at one stop"));
  CHECK(contains(load_error(stop + question + "More.\n"), ":18: text after a question"));
  CHECK(contains(load_error(head + question), ":7: a question before the first stop"));
}

TEST_CASE("speaker's notes: beside a question, filled from the run, with their minutes, slips in them") {
  const std::string stop = head + "## Here {at: compare}\nText.\n";  // line 7
  const std::string file = stop + question + "::: notes\nminutes: 1.5\nPoint at z = {z}.\n:::\n";
  CHECK(load_error(file) == "");
  CHECK(load_error(stop + "::: notes\nSay it.\n:::\n" + question) == "");
  CHECK(contains(load_error(stop + "::: notes\nSay it.\n"), ":9: the notes block is not closed"));
  CHECK(contains(load_error(stop + "::: notes\nminutes: 2\n:::\n"), ":9: the notes say nothing"));
  CHECK(
      contains(load_error(stop + "::: notes\nSay it.\n:::\n::: notes\nMore.\n:::\n"), ":12: second notes at one stop"));
  for (const char* minutes : {"0", "-1", "two", "91", "1.5 min", "nan"})
    CHECK(contains(load_error(stop + "::: notes\nSay it.\nminutes: " + minutes + "\n:::\n"),
                   ":11: `" + std::string(minutes) + "` is not a number of minutes"));
  CHECK(contains(load_error(stop + "::: notes\nSay it.\nminutes: 1\nminutes: 1\n:::\n"), ":12: a second `minutes:`"));
  CHECK(contains(load_error(stop + "::: notes\nminutes: 1\nSay {q}.\n:::\n"), ":11: nothing is called `q`"));
  CHECK(contains(load_error(head + "::: notes\nSay it.\n:::\n"), ":7: notes before the first stop"));
}

TEST_CASE("a number that nothing checks is refused wherever a lesson has text") {
  const std::string refused = " stands outside braces, where nothing checks it; write {… = ";
  const auto number = [&](const std::string& line) { return ":" + line + ": `12`" + refused + "12}"; };
  const std::string stop = head + "## Here {at: compare}\n";  // line 7
  CHECK(load_error(head + "## Test {\"12\"} {at: compare where x < 12}\nText.\n") == "");
  CHECK(contains(load_error(head + "## Test 12 {at: start}\nText.\n"), number("7")));
  CHECK(contains(load_error(stop + "\nText\nof 12.\n"), number("10")));
  CHECK(contains(load_error(stop + "::: question\nWhy 12?\n- [x] a\n  > b\n- [ ] c\n  > d\n:::\n"), number("9")));
  CHECK(contains(load_error(stop + "::: question\nWhy?\n- [x] a\n  > b\n- [ ] 12\n  > d\n:::\n"), number("12")));
  CHECK(contains(load_error(stop + "::: question\nWhy?\n- [x] a\n  > b\n- [ ] c\n  > d\n  > 12\n:::\n"), number("14")));
  const std::string done = "done: width > 30\n", solved = "solution: size = 40x40\n";
  CHECK(contains(load_error(stop + "::: task\nDo 12.\n" + done + solved + ":::\n"), number("9")));
  CHECK(contains(load_error(stop + "::: task\nDo.\n" + done + "now: 12\n" + solved + ":::\n"), number("11")));
  CHECK(contains(load_error(stop + "::: task\nDo.\n" + done + "hint: a\nhint: 12\n" + solved + ":::\n"), number("12")));
  const std::string pixels = "pixels: compare where y == 3\n", why = "why: So.\n";
  CHECK(contains(load_error(stop + "::: mark\nMark 12.\n" + pixels + why + ":::\n"), number("9")));
  CHECK(contains(load_error(stop + "::: mark\nMark.\n" + pixels + "why: 12\n:::\n"), number("11")));
  CHECK(contains(load_error(stop + "::: mark\nMark.\n" + pixels + "hint: 12\n" + why + ":::\n"), number("11")));
  CHECK(contains(load_error(stop + "Text.\n::: notes\nminutes: 2\nSay 12.\n:::\n"), number("11")));
}

TEST_CASE("hints are filled from the lesson's own run") {
  const LessonFile file(head +
                        "## Mark {at: clear}\n::: mark\nMark.\npixels: compare\nhint: {width = 8} a line.\nwhy: "
                        "So.\n:::\n## Do {at: end}\n::: task\nDo.\ndone: width > 30\nhint: It is {width}, not "
                        "{\"30\"}.\nsolution: size = 40x40\n:::\n");
  Lesson lesson = load_lesson(file.path);
  run_lesson(lesson);
  CHECK(lesson.stops.at(0).marking->hints == std::vector<std::string>{"8 a line."});
  CHECK(lesson.stops.at(1).task->hints == std::vector<std::string>{"It is 8, not 30."});
}

TEST_CASE("what is no lesson file is told so") {
  CHECK(contains(complaint([] { load_lesson("/nowhere/at-all.md"); }), "there is no such file; name a Markdown file"));
  CHECK(contains(complaint([] { load_lesson("/tmp"); }), "is a folder"));
  CHECK(contains(load_error(std::string((1 << 20) + 1, 'x')), "is larger than 1 MiB"));
  CHECK(contains(complaint([] { find_lesson("zbuffer"); }),
                 "there is no lesson of this name (did you mean `z-buffer`?); the lessons are viewing, back-faces"));
}

TEST_CASE("a lesson cut off anywhere is a lesson or one clear complaint") {
  const std::string whole = head + "\n## First {at: compare where not nearer, first}\n\nHello {z = 5}.\n\n" + question +
                            "\n## Last {at: end}\nEnd.\n";
  int good = 0;
  for (std::size_t size = 0; size <= whole.size(); ++size) {
    const std::string error = load_error(whole.substr(0, size));
    if (error.empty()) ++good;
    else CHECK(error.find('\n') == std::string::npos);
  }
  CHECK(good > 0);
}

TEST_CASE("$ZSTEP_LESSONS names another folder, read in the order of its numbers") {
  const LessonFile file(head + "## Here {at: start}\nText.\n", "10-last.md");
  const std::filesystem::path folder = file.path.parent_path();
  std::ofstream(folder / "9-first.md") << head << "## Here {at: start}\nText.\n";
  std::ofstream(folder / "notes.md") << "not a lesson";
  setenv("ZSTEP_LESSONS", folder.c_str(), 1);
  const std::vector<Lesson> lessons = all_lessons();
  unsetenv("ZSTEP_LESSONS");
  REQUIRE(lessons.size() == 2);
  CHECK(lessons[0].id == "first");
  CHECK(lessons[1].id == "last");
}

}  // namespace
}  // namespace zstep
