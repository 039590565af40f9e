// What a change of the scene makes otherwise is marked in tables and pictures until the next change.
#include <doctest/doctest.h>

#include <cmath>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "sim/viewer/panes/number_table.hpp"
#include "sim/viewer/panes/since_change.hpp"
#include "sim/viewer/stage.hpp"
#include "tests/viewer/drive.hpp"
#include "tests/viewer/made_anew.hpp"
#include "tests/where.hpp"

using namespace zstep;
using namespace zstep::viewer;

namespace {

ViewerOptions running_anew() {
  ViewerOptions options;
  options.run_changed = test::made_anew;
  return options;
}

/// So that everything can be marked: in the middle of the picture, or at the end.
void go_to_share(Stage& stage, double share) {
  Session& s = stage.app().session();
  s.go_to(static_cast<std::int64_t>(share * static_cast<double>(s.size())));
}

/// Pixels of the colour of the mark in a pane that is shown alone, without a step's own.
int marks_in(Stage& stage, const std::string& pane) {
  App& app = stage.app();
  REQUIRE(app.show_only(pane));
  app.session().message.clear();
  const ImU32 color = app.ui().colors().bad;
  const std::uint32_t rgb = (color >> IM_COL32_R_SHIFT & 255u) << 16 | (color >> IM_COL32_G_SHIFT & 255u) << 8 |
                            (color >> IM_COL32_B_SHIFT & 255u);
  return test::count_of(test::picture(app), rgb);
}

}  // namespace

TEST_CASE(
    "law: what a change makes otherwise is marked in every method's tables and pictures until the next change, undone "
    "nothing is") {
  struct Shown {
    const char *method, *scene, *pane;
    double share;
    Change change;
  };
  for (const Shown& shown :
       {Shown{"z-buffer", "pyramid-behind", "edge_table", 0.5, {"theta", "44"}},
        {"scan-line", "lessons/scenes/abc-def.toml", "sweep", 0.5, {"vertex 0", "3 3 5"}},
        {"depth-sort", "lessons/scenes/five-tests.toml", "drawing_list", 0, {"vertex 0", "3 4 15"}},
        {"bsp", "lessons/scenes/six-walls.toml", "tree", 1, {"polygons", "F E D C B A"}},
        {"warnock", "lessons/scenes/quarters.toml", "areas", 1, {"vertex 0", "3 4 1"}},
        {"ray-casting", "pyramid-behind", "ray_tests", 0.5, {"theta", "44"}},
        {"hidden-line", "lessons/scenes/hidden-lines.toml", "lines", 1, {"theta", "50"}},
        {"floating-horizon", "lessons/scenes/ridge-valley.toml", "horizons", 1, {"theta", "44"}}}) {
    CAPTURE(std::string(shown.method));
    const bool built_in = std::string(shown.scene).find('/') == std::string::npos;
    const Trace trace = test::record_run_by(shown.method, built_in ? shown.scene : test::in_checkout(shown.scene));
    const ViewerOptions options = running_anew();
    Stage stage(trace, options, Settings{}, 1280, 720);
    go_to_share(stage, shown.share);
    const auto fill_list = [&] {
      Session& s = stage.app().session();
      while (shown.share == 0 && s.state().machine.list.size() < 4 && s.position() < s.size()) s.move(Unit::event, 1);
    };
    fill_list();
    CHECK(marks_in(stage, shown.pane) == 0);
    stage.change(shown.change, false);
    REQUIRE(stage.changes().size() == 1);
    fill_list();
    CHECK(marks_in(stage, shown.pane) > 0);
    stage.change(shown.change, false);  // the same once more: nothing is otherwise now
    CHECK(marks_in(stage, shown.pane) == 0);
    stage.undo(1);
    stage.undo(1);
    CHECK(&stage.trace() == &trace);
    CHECK(marks_in(stage, shown.pane) == 0);  // it is as it was opened
  }
}

TEST_CASE("only what a change touches is marked: of two polygons the one that has the vertex, cell by cell") {
  const Trace trace = test::record_run_by("scan-line", test::in_checkout("lessons/scenes/abc-def.toml"));
  const ViewerOptions options = running_anew();
  Stage stage(trace, options, Settings{}, 1280, 720);
  go_to_share(stage, 0.5);
  stage.change({"vertex 0", "3 3 5"}, false);
  stage.app().settle();
  Ui& ui = stage.app().ui();
  REQUIRE(ui.before);
  std::vector<TableRow> rows = polygon_rows(ui);
  mark_changed(ui, rows, polygon_rows);
  const std::vector<TableRow> were = polygon_rows(*ui.before);
  REQUIRE(rows.size() == were.size());
  int marked = 0, rows_marked = 0;
  for (std::size_t r = 0; r < rows.size(); ++r) {
    int here = 0;
    for (std::size_t k = 0; k < rows[r].cells.size(); ++k) {
      const bool differs = rows[r].cells[k].value && were[r].cells[k].value &&
                           std::abs(*rows[r].cells[k].value - *were[r].cells[k].value) > 1e-9;
      CHECK(rows[r].cells[k].was.has_value() == differs);
      here += differs;
    }
    marked += here, rows_marked += here > 0;
  }
  CHECK(marked > 0);
  CHECK(rows_marked == 1);
}

TEST_CASE("the run before a change stands at the same step as the run that is shown, wherever a reader goes") {
  const Trace trace = test::record_run("pyramid-behind");
  const ViewerOptions options = running_anew();
  Stage stage(trace, options, Settings{}, 640, 480);
  stage.change({"theta", "44"}, false);
  App& app = stage.app();
  int same = 0;
  for (int k = 1; k < 20; ++k) {
    go_to_share(stage, k / 20.0);
    app.frame();
    REQUIRE(app.ui().before);
    const Session& then = app.ui().before->session;
    same += then.event() && app.session().event() && then.event()->step == app.session().event()->step;
    CHECK(then.state().machine.polygon == app.session().state().machine.polygon);
  }
  CHECK(same > 12);
  stage.change({"theta", "44"}, true);  // a hand that holds on is compared with what was before it took hold
  stage.app().frame();
  REQUIRE(stage.app().ui().before);
  CHECK(&stage.app().ui().before->session.trace() == &trace);
}
