#include "sim/viewer/description.hpp"

#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "sim/viewer/commands.hpp"
#include "sim/viewer/model/slice.hpp"
#include "sim/viewer/panes/lesson_chart.hpp"
#include "sim/viewer/panes/pane.hpp"
#include "sim/viewer/panes/scene_outside.hpp"
#include "sim/viewer/stage.hpp"
#include "sim/words/explain.hpp"
#include "sim/words/judged.hpp"
#include "sim/words/numbers.hpp"
#include "sim/words/spoken.hpp"
#include "traces/replay/replay.hpp"
#include "traces/text.hpp"

namespace zstep::viewer {
namespace {

class Text {
 public:
  void title(const std::string& words) { text_ += (text_.empty() ? "" : "\n") + words::spoken(words) + "\n"; }
  void line(const std::string& words) {
    if (!words.empty()) text_ += words::spoken(words) + "\n";
  }
  void as_it_stands(const std::string& words) {
    if (!words.empty()) text_ += words + "\n";
  }
  void formula(const std::string& line) { text_ += words::spoken_formula(line) + "\n"; }
  void markdown(const std::string& source) {
    const std::string plain = plain_text(parse_markdown(source));
    for (std::size_t from = 0; from < plain.size();) {
      const std::size_t end = std::min(plain.find('\n', from), plain.size());
      line(plain.substr(from, end - from));
      from = end + 1;
    }
  }
  std::string take() { return std::move(text_); }

 private:
  std::string text_;
};

void tell_step(Text& text, App& app) {
  Session& s = app.session();
  StepMarks::Told found;
  if (StepMarks* marks = app.ui().marks) found = marks->told(s);  // moves the replay
  const RecordedEvent* event = s.event();
  const StepInfo* step = event ? find_step(s.header().page, event->step) : nullptr;
  text.title(fmt::format("Step {} of {}{}", s.position(), s.size(), step ? ": " + step->text : ""));
  for (const std::string& what : found.lines) text.line(found.head + what);
  text.line(found.note);
  text.line(s.message);
  if (!event) return text.line(s.size() == 0 ? "This trace has no events." : "Nothing has happened yet.");
  const Explanation told = explain(s.trace(), s.state(), *event);
  text.line(told.sentence);
  for (const std::string& formula : told.formulas) text.formula(formula);
  if (!told.besides.empty() && found.lines.empty()) text.line(told.besides);
  text.as_it_stands(with_capital(printed_at(s.trace(), s.position())));
}

void tell_lesson(Text& text, const Session& s) {
  if (!s.lesson() || s.stop() < 0) return;
  const Stop& stop = s.lesson()->stops[s.stop()];
  text.title(fmt::format("Lesson: {}, stop {} of {}", s.lesson()->title, s.stop() + 1, s.lesson()->stops.size()));
  text.line(stop.heading);
  text.markdown(stop.text);
  for (const std::string& line : chart_told(s)) text.line(line);
  if (stop.task) text.markdown(stop.task->text);
  if (stop.marking) text.markdown(stop.marking->text);
  if (!stop.question) return;
  text.title("Question");
  text.markdown(stop.question->text);
  int number = 0;
  for (const Answer& answer : stop.question->answers) text.line(fmt::format("Answer {}: {}", ++number, answer.text));
}

/// The polygons in the canonical view volume by their vertices there, where the lesson shows it.
void tell_canonical(Text& text, const Session& s) {
  if (!s.lesson() || s.stop() < 0 || s.lesson()->stops[s.stop()].focus != canonical_pane.id) return;
  constexpr std::size_t most = 26;
  const Scene cube = in_canonical_volume(s.scene());
  text.title("Canonical view volume: x*, y* and z* from \u22121 to 1");
  for (std::size_t k = 0; k < std::min(most, cube.facets.size()); ++k) {
    const Facet& facet = cube.facets[k];
    std::string row;
    for (std::int32_t i = 0; i < facet.corner_count; ++i) {
      const glm::dvec3 p = cube.points[cube.corners[facet.first_corner + i]];
      row += fmt::format("{}({}, {}, {})", i == 0 ? "" : ", ", number(p.x), number(p.z), number(p.y));
    }
    text.line(fmt::format("Polygon {}: {}.", polygon_label(cube, facet.polygon), row));
  }
}

/// What is compared in another run's slice, or what its frame shows at its end, scan line by scan line: the polygons
/// from left to right.
void tell_runs_beside(Text& text, const Session& s) {
  if (!s.lesson() || s.stop() < 0) return;
  for (const RunBeside& beside : s.lesson()->stops[s.stop()].beside) {
    if (s.lesson()->stops[s.stop()].focus == slice_pane.id) {
      Session there(*beside.run, nullptr);
      there.go_to(moment_in(*beside.run, moment_of(s)).step);
      const Moment now(there);
      SliceLines lines;
      text.title(fmt::format("Slice of another run, here: {}", beside.name()));
      if (const auto line = slice_line(now, s.selected)) text.line(slice_sentence(now, slice_of(now, lines, *line)));
      continue;
    }
    text.title(fmt::format("Picture of another run, at its end: {}", beside.name()));
    Replay replay(*beside.run);
    replay.go_to(beside.run->size());
    const Picture& picture = replay.state().picture;
    const Scene& scene = beside.run->scene();
    for (std::int32_t y = 0; y < picture.height; ++y) {
      std::string row;
      const auto shown = [&](std::int32_t x) {
        const std::size_t at = picture.at(x, y);
        if (picture.polygon[at] < 0) return std::string();
        const bool own = !picture.ink.empty() && picture.ink[at] != no_ink;
        return polygon_label(scene, picture.polygon[at]) + (own ? " darker" : "");
      };
      for (std::int32_t x = 0, end = 0; x < picture.width; x = end) {
        for (end = x + 1; end < picture.width && shown(end) == shown(x);) ++end;
        if (const std::string what = shown(x); !what.empty())
          row += fmt::format("{}{} {}", row.empty() ? "" : ", ", what,
                             end - x == 1 ? fmt::format("at x = {}", x) : fmt::format("from x = {} to {}", x, end - 1));
      }
      if (!row.empty()) text.line(fmt::format("Scan line {}: {}.", y, row));
    }
  }
}

/// "edge AB, x 3, z 4.25, leaves 5, right".
std::string row_text(const std::vector<std::string>& headings, const TableSeen::Row& row) {
  std::string line;
  for (std::size_t k = 0; k < row.cells.size(); ++k) {
    const std::string cell = words::spoken(row.cells[k]);
    if (cell.empty()) continue;
    line += (line.empty() ? "" : ", ") + (headings[k].empty() ? cell : headings[k] + " " + cell);
  }
  return line + (row.now ? ", now" : "");
}

void tell_tables(Text& text, App& app) {
  Ui& ui = app.ui();
  for (const Pane& pane : App::all_panes(app.session().header(), false)) {
    std::vector<TableSeen> tables;
    app.show_only(pane.id);
    app.settle();
    ui.tables_seen = &tables;
    app.frame();
    ui.tables_seen = nullptr;
    bool titled = false;
    for (const TableSeen& table : tables)
      for (const TableSeen::Row& row : table.rows) {
        if (!std::exchange(titled, true)) text.title(std::string("Table: ") + pane.title);
        text.line(row_text(table.headings, row));
      }
  }
}

constexpr char between_cells = '\x1f', between_rows = '\x1e', between_groups = '\x1d';

void add_row(std::string& list, const std::vector<std::string>& cells) {
  if (!list.empty() && list.back() != between_groups) list += between_rows;
  list += fmt::format("{}", fmt::join(cells, std::string_view(&between_cells, 1)));
}

}  // namespace

std::string tables_as_list(const std::vector<TableSeen>& tables) {
  std::string list;
  for (const TableSeen& table : tables) {
    if (table.rows.empty()) continue;
    if (!list.empty()) list += between_groups;
    add_row(list, {table.title});
    std::vector<std::string> headings;
    for (const std::string& heading : table.headings) headings.push_back(words::spoken(heading));
    add_row(list, headings);
    for (const TableSeen::Row& row : table.rows) {
      std::vector<std::string> cells;
      for (const std::string& cell : row.cells) cells.push_back(words::spoken(cell));
      add_row(list, cells);
    }
  }
  return list;
}

std::string commands_as_list() {
  std::string list, group;
  for (const Command& command : commands()) {
    if (group != command.group) {
      if (!list.empty()) list += between_groups;
      add_row(list, {group = command.group});
    }
    add_row(list, {command.id, command.title, key_names(command)});
  }
  return list;
}

std::string describe_step(App& app) {
  Text text;
  tell_step(text, app);
  tell_lesson(text, app.session());
  tell_canonical(text, app.session());
  tell_runs_beside(text, app.session());
  return text.take();
}

std::string describe(App& app) {
  Text text;
  tell_step(text, app);
  tell_lesson(text, app.session());
  tell_canonical(text, app.session());
  tell_runs_beside(text, app.session());
  tell_tables(text, app);
  return text.take();
}

}  // namespace zstep::viewer
