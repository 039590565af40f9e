#include "sim/viewer/panes/pair_tests.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "sim/words/explain.hpp"
#include "sim/words/numbers.hpp"

namespace zstep::viewer {
namespace {

std::string range(double low, double high) {
  return fmt::format("{}\u2026{}", number(low, 2, true), number(high, 2, true));
}

TestLine line_of(std::int64_t at, const Event& event, bool wants_behind) {
  TestLine line;
  line.made = true;
  if (const auto* extents = get_if<ExtentTest>(&event)) {
    line.numbers = range(extents->low, extents->high) + " | " + range(extents->other_low, extents->other_high);
    line.passed = !extents->overlap;
    line.outcome = extents->overlap ? "overlap" : "apart";
    line.question = answers::made_by<ExtentTest>(
        at, "overlap",
        {{"piece", extents->piece}, {"other", extents->other}, {"axis", static_cast<std::int32_t>(extents->axis)}});
  } else if (const auto* sides = get_if<SideTest>(&event)) {
    line.numbers = range(sides->least, sides->greatest);
    line.outcome =
        sides->side == Side::front ? "before" : std::string(words_of<Side>[static_cast<std::size_t>(sides->side)]);
    line.passed = sides->side == (wants_behind ? Side::behind : Side::front);
    if (sides->side == Side::crossing) line.outcome = "both sides";
    if (sides->side == Side::on) line.outcome = "in it";
    line.question = answers::made_by<SideTest>(at, "side", {{"piece", sides->piece}, {"plane_of", sides->plane_of}});
  } else if (const auto* projections = get_if<OverlapTest>(&event)) {
    line.passed = !projections->overlap;
    if (projections->overlap)
      line.numbers = fmt::format("at ({}, {})", number(projections->x_at, 2, true), number(projections->y_at, 2, true));
    line.outcome = projections->overlap ? "overlap" : "apart";
    line.question =
        answers::made_by<OverlapTest>(at, "x_at", {{"piece", projections->piece}, {"other", projections->other}});
  }
  return line;
}

struct KnownTest {
  const char* step;
  const char* what;
  bool wants_behind;
};
constexpr std::array<KnownTest, 7> known_tests{{
    {"test_1", "1 x extents", false},
    {"test_2", "2 y extents", false},
    {"test_3", "3 P behind Q", true},
    {"test_4", "4 Q before P", false},
    {"test_5", "5 projections", false},
    {"test_3_swapped", "3 Q behind P", true},
    {"test_4_swapped", "4 P before Q", false},
}};

std::vector<TestLine> lines_of(const Session& s, const std::vector<RecordedEvent>& made) {
  std::vector<TestLine> lines;
  for (const KnownTest& known : known_tests) {
    const StepInfo* step = find_step(s.header().page, known.step);
    TestLine line;
    for (std::size_t i = 0; step && i < made.size(); ++i) {
      if (made[i].step != step->id) continue;
      line = line_of(s.position(), made[i].event, known.wants_behind);
      const bool last = i + 1 == made.size();
      line.now = last;
      // Coplanar pieces are ordered by their place in the file, so the pair is settled if no test follows.
      if (line.outcome == "in it") {
        const StepInfo* next = last ? nullptr : find_step(s.header().page, made[i + 1].step);
        line.passed = !next || !next->name.starts_with("test_");
      }
    }
    line.what = known.what;
    lines.push_back(std::move(line));
  }
  return lines;
}

float line_height(const ImFont& font) { return std::round(font.FontSize * 1.3f); }

}  // namespace

std::optional<std::vector<RecordedEvent>> since_pair(const Session& s) {
  std::vector<RecordedEvent> made;
  const std::int64_t first = std::max<std::int64_t>(1, s.position() - 200);  // a split makes events, too
  for (std::int64_t position = s.position(); position >= first; --position) {
    const RecordedEvent recorded = s.trace().event(position);
    if (holds<PairBegin>(recorded.event)) {
      std::reverse(made.begin(), made.end());
      return made;
    }
    if (holds<ListInsert>(recorded.event) || holds<PieceDraw>(recorded.event)) return std::nullopt;
    made.push_back(recorded);
  }
  return std::nullopt;
}

TestTable lay_out_tests(Ui& ui, const std::vector<RecordedEvent>& made, float room) {
  TestTable table;
  table.lines = lines_of(ui.session, made);
  if (!table.lines[5].made) table.lines.resize(5);
  table.gap = ui.em * 0.7f;
  for (const ImFont* font : {ui.fonts.mono, ui.fonts.small}) {
    table.font = font;
    // The numbers' column keeps a width, so that lines stay where they are while they fill.
    table.column = {text_size(ui, font, "5 projections").x,
                    text_size(ui, font, "15.25\u202615.25 | 15.25\u202615.25").x,
                    text_size(ui, font, "\u2713 both sides").x};
    for (const TestLine& line : table.lines)
      table.column[1] = std::max(table.column[1], text_size(ui, font, line.numbers).x);
    table.width = table.column[0] + table.column[1] + table.column[2] + 2 * table.gap + ui.em * 0.7f;
    if (table.width <= room) break;
  }
  if (table.width > room) {  // the mark alone says what came out
    table.words = false;
    table.width -= table.column[2];
    table.column[2] = text_size(ui, table.font, "\u2713").x;
    table.width += table.column[2];
  }
  table.height = line_height(*ui.fonts.bold) + line_height(*table.font) * static_cast<float>(table.lines.size());
  return table;
}

void draw_tests(Ui& ui, const PairBegin& pair, const TestTable& table) {
  const Session& s = ui.session;
  const MethodState& machine = s.state().machine;
  const Theme& c = ui.colors();
  const float height = line_height(*table.font);
  ImDrawList* list = ImGui::GetWindowDrawList();
  draw_text(ui, ImGui::GetCursorScreenPos(), ui.fonts.bold, c.text,
            fmt::format("May P = {} come before Q = {}?", piece_label(s.scene(), machine, pair.piece),
                        piece_label(s.scene(), machine, pair.other)));
  ImGui::Dummy({table.width, line_height(*ui.fonts.bold)});
  for (std::size_t i = 0; i < table.lines.size(); ++i) {
    const TestLine& line = table.lines[i];
    const ImVec2 at = ImGui::GetCursorScreenPos();
    if (line.now) {
      list->AddRectFilled(at, {at.x + table.width, at.y + height}, c.now_soft);
      list->AddRectFilled(at, {at.x + 3, at.y + height}, c.now);
    }
    if (i == 5) list->AddRectFilled({at.x, at.y}, {at.x + table.width, at.y + 1}, c.rule);
    const ImU32 color = line.made ? c.text : c.muted;
    float x = at.x + ui.em * 0.4f;
    draw_text(ui, {x, at.y}, table.font, color, line.what);
    x += table.column[0] + table.gap;
    draw_text(ui, {x, at.y}, table.font, color, line.numbers);
    if (line.question && !line.numbers.empty())
      number_at(ui, {x - 2, at.y}, {x + text_size(ui, table.font, line.numbers).x + 2, at.y + height}, *line.question);
    x += table.column[1] + table.gap;
    if (line.made)
      draw_text(ui, {x, at.y}, table.font, line.passed ? c.good : c.text,
                (line.passed ? "\u2713" : "\u2717") + (table.words ? " " + line.outcome : ""));
    ImGui::Dummy({table.width, height});
    if (line.now) follow(ui, at.y, height);
  }
}

}  // namespace zstep::viewer
