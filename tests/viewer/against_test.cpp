// Two runs in one window: at the same moment by meaning, and marked where they differ.
#include <doctest/doctest.h>
#include <unistd.h>

#include <fstream>
#include <utility>

#include <fmt/format.h>

#include "sim/viewer/model/against.hpp"
#include "sim/viewer/panes/number_table.hpp"
#include "sim/viewer/pictures.hpp"
#include "tests/golden/golden.hpp"
#include "tests/unit/sim/answers/altered_runs.hpp"
#include "tests/viewer/drive.hpp"
#include "tests/where.hpp"

using namespace zstep;
using namespace zstep::viewer;

namespace {

Trace from_text(const std::string& text) {
  const auto path = std::filesystem::temp_directory_path() / ("zstep_against_" + std::to_string(getpid()) + ".jsonl");
  std::ofstream(path) << text;
  Trace trace = open_jsonl(path);
  std::filesystem::remove(path);
  return trace;
}

/// The worked example, and the same with a line less and with one depth changed.
struct Pair {
  Trace a, b;
  diff::DiffReport report;
  AgainstRun with;

  explicit Pair(bool missing)
      : a(open_jsonl(test::in_checkout("tests/golden/delhi.jsonl"))),
        b(from_text(altered(test::jsonl_of(a), missing))),
        report(diff::compare(a, b)),
        with{&b, &report, true} {}

  static std::string altered(std::string text, bool missing) {
    const std::string line = missing ? "{\"step\":\"write_pixel\",\"x\":1,\"y\":2,\"polygon\":1}\n"
                                     : "{\"step\":\"interpolate_z\",\"x\":2,\"y\":2,\"z\":5.0}\n";
    const std::size_t at = text.find(line);
    REQUIRE(at != std::string::npos);
    return text.replace(at, line.size(), missing ? "" : "{\"step\":\"interpolate_z\",\"x\":2,\"y\":2,\"z\":4.5}\n");
  }
};

}  // namespace

TEST_CASE("the second run goes where the first one is: the same step, or the last before it") {
  const Pair runs(true);
  Session session(runs.a, nullptr);
  Against against(session, runs.with);
  REQUIRE(runs.b.size() == runs.a.size() - 1);
  const auto gone = against.next_cause(1);
  REQUIRE(gone);
  for (std::int64_t at = 0; at <= runs.a.size(); ++at) {
    session.go_to(at);
    against.follow();
    CAPTURE(at);
    CHECK(against.session().position() == (at < gone->a ? at : at - 1));
  }
  session.go_to(gone->a);
  against.follow();
  CHECK(against.marks_of_a().told(session).note.find("A has this step, B does not") != std::string::npos);
  CHECK(against.marks_of_b().told(against.session()).note.find("this run does not have") != std::string::npos);
  // The pixel was not written in B: from here on it differs.
  REQUIRE(against.pixels().size() == 1);
  CHECK(against.pixels()[0].pixel == static_cast<std::int64_t>(session.state().picture.at(1, 2)));
  CHECK(against.pixels()[0].filled);
}

TEST_CASE("where the second run is brought by itself, the first one comes to the same moment") {
  const Pair runs(true);
  Session session(runs.a, nullptr);
  Against against(session, runs.with);
  const std::int64_t gone = runs.report.causes[0].first.a;
  for (std::int64_t at = 0; at <= runs.b.size(); ++at) {
    against.session().go_to(at);
    against.follow_second();
    CAPTURE(at);
    CHECK(session.position() == (at < gone ? at : at + 1));
    CHECK(against.session().position() == at);
  }
}

TEST_CASE("keys go through the differences of one field, there and back") {
  const Trace a = open_jsonl(test::in_checkout("tests/golden/delhi.jsonl"));
  // All depths that are interpolated part, and one slope.
  bool slope = false;
  const Trace b = test::changed(a, [&](std::int64_t, Event& event) {
    if (holds<DepthInterpolate>(event)) event.as<DepthInterpolate>().z += 0.25;
    if (holds<EdgeTableInsert>(event) && !std::exchange(slope, true)) event.as<EdgeTableInsert>().dx_dy += 1;
    return true;
  });
  const diff::DiffReport report = diff::compare(a, b);
  const AgainstRun with{&b, &report, true};
  App app(a, nullptr, {}, 1280, 720);
  app.show_against(with);
  (void)test::picture(app);
  Session& s = app.session();
  test::send_text(app, ";");
  CHECK(s.message.find("do not part here") != std::string::npos);
  std::vector<std::int64_t> depths;
  for (const diff::Difference& one : report.alignment.differences)
    if (one.kind == kind_of<DepthInterpolate>) depths.push_back(one.a);
  REQUIRE(depths.size() > 3);
  REQUIRE(depths.size() < report.alignment.differences.size());
  s.go_to(depths[0]);
  (void)test::picture(app);
  for (std::size_t i = 1; i < depths.size(); ++i) {
    test::send_text(app, ";");
    CHECK(s.position() == depths[i]);
  }
  CHECK(s.message == fmt::format("The runs part in z of interpolate_z: {0} of {0}.", depths.size()));
  test::send_text(app, ";");
  CHECK(s.message == "There is no later difference in z of interpolate_z.");
  test::send_text(app, ":");
  CHECK(s.position() == depths[depths.size() - 2]);
}

namespace {

std::vector<TableRow> edges_of(Ui& ui) {
  std::vector<TableRow> rows;
  for (const EdgeTableInsert& edge : ui.session.state().machine.edge_table) {
    TableRow row;
    row.cells = {TableCell("edge"), TableCell(edge.x_edge), TableCell(edge.dx_dy)};
    row.about = about_edge(edge);
    rows.push_back(row);
  }
  return rows;
}

}  // namespace

TEST_CASE("below a row of a table is what the second run has otherwise, and nothing where it has the same") {
  const Trace a = open_jsonl(test::in_checkout("tests/golden/delhi.jsonl"));
  std::int64_t first = 0, second = 0;
  const Trace b = test::changed(a, [&](std::int64_t step, Event& event) {
    if (!holds<EdgeTableInsert>(event)) return true;
    if (first == 0) return first = step, event.as<EdgeTableInsert>().dx_dy += 1, true;
    if (second == 0) return second = step, false;
    return true;
  });
  REQUIRE(second > first);
  Renderer renderer(16, 16);
  Session of_a(a, nullptr), of_b(b, nullptr);
  Ui ui(of_a, renderer), other(of_b, renderer);
  of_a.go_to(second), of_b.go_to(second - 1);
  CHECK(rows_of_both(ui, edges_of).size() == 2);
  ui.other = &other;
  const std::vector<TableRow> rows = rows_of_both(ui, edges_of);
  REQUIRE(rows.size() == 4);
  CHECK(rows[1].look == TableRow::Look::other);
  CHECK(rows[1].cells[0].text == "\u2260 B");
  CHECK(!rows[1].cells[1].value);
  CHECK(*rows[1].cells[2].value == *rows[0].cells[2].value + 1);
  CHECK(rows[3].cells[0].text == "\u2260 B: not in it");
  // And the other way round: what only the second run has comes last.
  ui.other = nullptr, other.other = &ui;
  const std::vector<TableRow> turned = rows_of_both(other, edges_of);
  REQUIRE(turned.size() == 3);
  CHECK(turned[2].cells[0].text == "\u2260 B: edge");
}

TEST_CASE("of rows about the same the first is the first in the second run, and words that are results count") {
  const Trace a = open_jsonl(test::in_checkout("tests/golden/delhi.jsonl"));
  Renderer renderer(16, 16);
  Session of_a(a, nullptr), of_b(a, nullptr);
  Ui ui(of_a, renderer), other(of_b, renderer);
  ui.other = &other;
  of_b.go_to(1);
  const std::vector<TableRow> rows = rows_of_both(ui, [](Ui& of) {
    const bool is_b = of.session.position() == 1;
    std::vector<TableRow> table(3);
    for (TableRow& row : table) {
      row.about = "A";
      row.cells = {TableCell("A"), TableCell::result_of("out"), TableCell(is_b ? "now" : "then")};
    }
    if (is_b) table[1].cells[1] = TableCell::result_of("in", "i");
    return table;
  });
  REQUIRE(rows.size() == 4);
  CHECK(rows[2].look == TableRow::Look::other);
  CHECK(rows[2].cells[1].text == "in");
  CHECK(rows[2].cells[1].brief == "i");
  CHECK(rows[2].cells[2].text.empty());
}

namespace {

/// The tables of two runs, the second with one change, at the last step where a row is shown to differ.
template <class Change>
std::vector<TableRow> rows_where_they_part(const char* golden, std::vector<TableRow> (*rows_of)(Ui&), Change&& change) {
  const Trace a = open_jsonl(test::in_checkout(fmt::format("tests/golden/{}.jsonl", golden)));
  bool changed = false;
  const Trace b = test::changed(a, [&](std::int64_t, Event& event) {
    changed = changed || change(event);
    return true;
  });
  Renderer renderer(16, 16);
  Session of_a(a, nullptr), of_b(b, nullptr);
  Ui ui(of_a, renderer), other(of_b, renderer);
  std::vector<TableRow> parted;
  for (std::int64_t step = 1; step <= a.size(); ++step) {
    of_a.go_to(step), of_b.go_to(step);
    ui.other = nullptr;
    const std::size_t alone = rows_of(ui).size();
    ui.other = &other;
    std::vector<TableRow> both = rows_of_both(ui, rows_of);
    CHECK(both.size() >= alone);
    if (both.size() > alone) parted = std::move(both);
  }
  return parted;
}

/// The line of the second run; its text cells by their text, a number as "number".
std::vector<std::string> line_of_b(const std::vector<TableRow>& rows) {
  std::vector<std::string> texts;
  for (const TableRow& row : rows)
    if (row.look == TableRow::Look::other && texts.empty())
      for (const TableCell& cell : row.cells) texts.push_back(cell.value ? "number" : cell.text);
  return texts;
}

}  // namespace

TEST_CASE("the tables of the sweep, the lines, the rays and the tree show what the second run has otherwise") {
  using Texts = std::vector<std::string>;
  const std::string b = "\u2260 B";
  const auto once = [](auto&& apply) {
    return [apply, done = false](Event& event) mutable { return done || (done = apply(event)); };
  };
  CHECK(line_of_b(rows_where_they_part("scan-line", polygon_rows, once([](Event& event) {
                                         if (holds<PlaneEquation>(event)) event.as<PlaneEquation>().plane_c += 1;
                                         return holds<PlaneEquation>(event);
                                       }))) == Texts{b, "", "", "", "number", ""});
  CHECK(line_of_b(rows_where_they_part("hidden-line", interval_rows, once([](Event& event) {
                                         if (holds<LineHide>(event)) event.as<LineHide>().t_1 += 0.125;
                                         return holds<LineHide>(event);
                                       }))) == Texts{b, "", "number"});
  CHECK(line_of_b(rows_where_they_part("ray-casting", ray_test_rows, once([](Event& event) {
                                         if (holds<RayHit>(event)) event.as<RayHit>().t += 0.125;
                                         return holds<RayHit>(event);
                                       })))[1] == "number");
  CHECK(line_of_b(rows_where_they_part("ray-tracing", ray_tree_rows, once([](Event& event) {
                                         const auto* end = get_if<RayEnd>(&event);
                                         if (!end || end->nearest_facet < 0) return false;
                                         event.as<RayEnd>().t += 0.125;
                                         return true;
                                       }))) == Texts{b, "", "number", ""});
  CHECK(line_of_b(rows_where_they_part("bsp", path_rows, once([](Event& event) {
                                         if (holds<EyeSide>(event)) event.as<EyeSide>().value += 1;
                                         return holds<EyeSide>(event);
                                       }))) == Texts{"", b, "", "number", "", ""});
}

TEST_CASE("keys lead to the next cause, the next difference and the first pixel that differs") {
  const Pair runs(false);
  App app(runs.a, nullptr, {}, 1280, 720);
  app.show_against(runs.with);
  (void)test::picture(app);
  Session& s = app.session();
  test::send_text(app, ".");
  const std::int64_t cause = s.position();
  REQUIRE(holds<DepthInterpolate>(s.event()->event));
  const StepMarks::Told& told = app.ui().marks->told(s);
  REQUIRE(told.lines.size() == 1);
  CHECK(told.lines[0].find("z = 5") == 0);
  CHECK(told.note.find("B computes it wrongly from its own operands") != std::string::npos);
  std::int64_t last = cause, count = 1;
  for (test::send_text(app, ">"); s.position() != last; test::send_text(app, ">")) last = s.position(), ++count;
  CHECK(count == static_cast<std::int64_t>(runs.report.alignment.differences.size()));
  CHECK(s.message == "There is no later difference.");
  test::send_text(app, "#");
  CHECK(s.message.find("same at the end") != std::string::npos);

  const Pair other(true);
  App shown(other.a, nullptr, {}, 1280, 720);
  shown.show_against(other.with);
  (void)test::picture(shown);
  test::send_text(shown, "#");
  CHECK(shown.session().selected == Cell{1, 2});
  CHECK(shown.session().position() == other.report.causes[0].first.a);
}

TEST_CASE("law: two runs in one window look the same, walked to or jumped to, and differences are marked in both") {
  const Pair runs(true);
  App walked(runs.a, nullptr, {}, 1280, 720);
  walked.show_against(runs.with);
  const std::int64_t cause = runs.report.causes[0].first.a;
  walked.session().go_to(cause - 4);
  PictureOptions options;
  options.against = &runs.with;
  const std::uint32_t bad = to_pixel(light_theme().bad) & 0xffffffu;
  for (int i = 0; i < 8; ++i) {
    test::press(walked, SDLK_RIGHT);
    walked.frame();
    const std::int64_t at = walked.session().position();
    CAPTURE(at);
    const bool same = test::picture(walked) == Pictures(runs.a, options).at(at).rgb;
    CHECK(same);
  }
  CHECK(test::count_of(test::picture(walked), bad) > 100);
  // Opened without a step it is where they first part.
  const bool at_cause = Pictures(runs.a, options).at(-1).rgb == Pictures(runs.a, options).at(cause).rgb;
  CHECK(at_cause);
}
