#include "sim/viewer/description.hpp"

#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "sim/viewer/commands.hpp"
#include "sim/words/explain.hpp"
#include "sim/words/judged.hpp"
#include "sim/words/spoken.hpp"
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
  if (stop.task) text.markdown(stop.task->text);
  if (stop.marking) text.markdown(stop.marking->text);
  if (!stop.question) return;
  text.title("Question");
  text.markdown(stop.question->text);
  int number = 0;
  for (const Answer& answer : stop.question->answers) text.line(fmt::format("Answer {}: {}", ++number, answer.text));
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
  return text.take();
}

std::string describe(App& app) {
  Text text;
  tell_step(text, app);
  tell_lesson(text, app.session());
  tell_tables(text, app);
  return text.take();
}

}  // namespace zstep::viewer
