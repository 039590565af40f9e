// What leads on the stage: by method, by lesson, by the reader's hand; and how much of the window it has.
#include <algorithm>
#include <map>

#include <doctest/doctest.h>
#include <fmt/format.h>

#include "algorithms/catalog/catalog.hpp"
#include "sim/classroom/lesson.hpp"
#include "sim/viewer/commands.hpp"
#include "sim/viewer/panes/workspace.hpp"
#include "tests/viewer/drive.hpp"
#include "tests/viewer/words/some_runs.hpp"
#include "traces/error.hpp"

using namespace zstep;
using namespace zstep::viewer;

namespace {

std::string names(const std::vector<Pane>& panes) {
  std::string all;
  for (const Pane& pane : panes) all += (all.empty() ? "" : " ") + std::string(pane.id);
  return all;
}

struct Shown {
  int width, height;
  bool presenter;
};

double stage_share(App& app, const Shown& how) {
  app.settle();
  return static_cast<double>(app.stage_place().size.x * app.stage_place().size.y) / (how.width * how.height);
}

}  // namespace

TEST_CASE("each method's workspace leads with what it lives by") {
  const std::map<std::string, std::string> expected{{"z-buffer", "frame depth"},
                                                    {"scan-line", "frame sweep"},
                                                    {"painter", "frame drawing_list"},
                                                    {"depth-sort", "frame drawing_list"},
                                                    {"bsp", "tree plan"},
                                                    {"warnock", "frame areas"},
                                                    {"ray-casting", "frame ray_plan"},
                                                    {"ray-tracing", "frame ray_plan"},
                                                    {"floating-horizon", "frame horizons"},
                                                    {"hidden-line", "frame lines"},
                                                    {"wireframe", "frame lines"},
                                                    {"shadow-buffer", "frame shadow_buffer"},
                                                    {"transparency", "frame depth"}};
  for (const auto& named : expected) {
    const std::string &id = named.first, &leading = named.second;
    CAPTURE(id);
    Header header;
    header.page = method(id).page();
    CHECK(names(workspace(header, "").leading) == leading);
    // Every pane can lead, none is lost or shown twice, and the charts and the section are there only when asked.
    const std::vector<Pane> all = stage_panes(header);
    for (const std::string& lead : leads_to_choose(header)) {
      const Workspace stage = workspace(header, lead);
      CAPTURE(lead);
      CHECK((stage.leading.size() >= 1 && stage.leading.size() <= 3));
      if (!lead.empty())
        CHECK(std::any_of(stage.leading.begin(), stage.leading.end(), [&](const Pane& p) { return p.id == lead; }));
      for (const Pane& pane : all) {
        const auto is = [&](const Pane& other) { return std::string(other.id) == pane.id; };
        const auto times = std::count_if(stage.leading.begin(), stage.leading.end(), is) +
                           std::count_if(stage.small.begin(), stage.small.end(), is);
        const bool chart = pane.id == depth_error_pane.id || pane.id == depth_units_pane.id ||
                           pane.id == depth_curve_pane.id || pane.id == slice_view_pane.id ||
                           pane.id == canonical_pane.id;
        const bool is_asked = lead == pane.id || lead_together(pane, lead);
        CHECK(times == ((chart || pane.id == section_pane.id) && !is_asked ? 0 : 1));
      }
    }
  }
}

TEST_CASE(
    "the stage has 45 % of the window beside a lesson, and half of it without one, in the window and before a class") {
  for (Lesson& lesson : all_lessons()) {
    const Trace trace = run_lesson(lesson);
    CAPTURE(lesson.id);
    for (const Shown& how : {Shown{1280, 720, false},
                             {1600, 900, false},
                             {1920, 1080, false},
                             {3840, 2160, false},
                             {1280, 720, true},
                             {1920, 1080, true},
                             {3840, 2160, true}}) {
      Settings settings;
      settings.presenter = how.presenter;
      App with(trace, &lesson, settings, how.width, how.height);
      CAPTURE(how.width);
      CAPTURE(how.presenter);
      for (const int stop : {0, static_cast<int>(lesson.stops.size()) - 1}) {
        with.session().to_stop(stop);
        CHECK(stage_share(with, how) >= 0.45);
      }
      if (how.width != 1280 && how.width != 3840) continue;
      App without(trace, nullptr, settings, how.width, how.height);
      CHECK(stage_share(without, how) >= (how.presenter ? 0.45 : 0.5));
    }
  }
}

TEST_CASE("a click on a small pane's title makes it lead, a second one puts it back, and Tab goes through all") {
  const Trace trace = test::record_run("pyramid-behind");
  App app(trace, nullptr, {}, 1280, 720);
  app.session().go_to(900);
  app.settle();
  const test::Bytes before = test::picture(app);
  const auto click_title = [&](const std::string& pane) {
    // Where a title is: the row of small panes and the stage are tried from the left.
    for (const int y : {static_cast<int>(720 * 0.715f), 42})
      for (int x = 300; x < 1270; x += 12) {
        test::move_mouse(app, x, y);
        test::move_mouse(app, x, y);
        if (app.ui().mouse_help.find("Tab: the next pane") == std::string::npos) continue;
        const std::string was = app.lead();
        test::click(app, x, y);
        if (app.lead() == pane || (app.lead().empty() && was == pane)) return true;
        app.set_lead(was);
      }
    return false;
  };
  REQUIRE(click_title("edge_table"));
  CHECK(names(workspace(trace.header(), app.lead()).leading) == "frame edge_table active_edges");
  REQUIRE(click_title("edge_table"));
  CHECK(app.lead().empty());
  test::move_mouse(app, -1, -1);
  CHECK(test::picture(app) == before);
  std::string way;
  for (std::size_t i = 0; i < leads_to_choose(trace.header()).size(); ++i) {
    test::press(app, SDLK_TAB);
    way += app.lead() + " ";
  }
  CHECK(way == "frame depth edge_table scene canonical slice slice_view depth_error depth_curve  ");
  CHECK(test::picture(app) == before);
}

TEST_CASE("a pane that the run has not come to is folded to its title, however one got there") {
  const Trace trace = test::record_run("pyramid-behind");
  App app(trace, nullptr, {}, 1280, 720);
  const auto folded = [&] {
    app.settle();
    std::string all;
    for (const Pane& pane : workspace(trace.header(), app.lead()).small)
      if (pane.waits && pane.waits(app.ui())) all += std::string(pane.id) + " ";
    return all;
  };
  CHECK(folded() == "edge_table active_edges slice ");
  app.session().go_to(trace.size());
  CHECK(folded().empty());
  app.session().go_to(0);
  CHECK(folded() == "edge_table active_edges slice ");
}

TEST_CASE("a stop's focus leads while it speaks, one that is no pane is refused by its line") {
  Lesson lesson = find_lesson("edge-table");
  const Trace trace = run_lesson(lesson);
  lesson.stops[1].focus.clear(), lesson.stops[2].focus = "edge_table";
  App app(trace, &lesson, {}, 1280, 720);
  app.session().to_stop(1);
  CHECK(app.lead().empty());
  app.session().to_stop(2);
  CHECK(app.lead() == "edge_table");
  // A reader's choice lasts until a stop that is about something else.
  app.set_lead("");
  CHECK(app.lead().empty());
  app.session().to_stop(3);
  CHECK(app.lead() == lesson.stops[3].focus);
  app.set_lead("scene");
  CHECK(app.lead() == "scene");
  lesson.stops[4].focus.clear();
  app.session().to_stop(4);
  CHECK(app.lead() == "scene");
  lesson.stops[2].focus = "no_such";
  std::string said;
  try {
    const App wrong(trace, &lesson, {}, 1280, 720);
  } catch (const InputError& error) {
    said = error.what();
  }
  CHECK(said.find(fmt::format("3-edge-table.md:{}: this run has no pane `no_such`", lesson.stops[2].line)) !=
        std::string::npos);
  CHECK(said.find("edge_table") != std::string::npos);
}
