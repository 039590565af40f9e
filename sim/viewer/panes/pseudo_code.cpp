// The page of the lecture, the line at work lit, with how often each line ran. A click runs on to the next time.

#include "sim/viewer/panes/pseudo_code.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <numeric>
#include <optional>
#include <string_view>

#include "sim/viewer/draw/canvas.hpp"
#include "sim/viewer/model/label_spots.hpp"
#include "sim/viewer/panes/pane.hpp"
#include "sim/words/numbers.hpp"
#include "traces/scene.hpp"
#include "traces/text.hpp"

namespace zstep::viewer {
namespace {

constexpr int hanging = 2;  // columns

/// Characters, each a column wide.
using Glyphs = std::vector<std::string>;
Glyphs glyphs_of(std::string_view text) {
  Glyphs glyphs;
  for (const char c : text) {
    if (!continues_character(c) || glyphs.empty()) glyphs.emplace_back();
    glyphs.back() += c;
  }
  return glyphs;
}

int glyph_count(const Glyphs& line) { return size32(line); }
bool is_space(const Glyphs& line, int at) { return at >= glyph_count(line) || line[at] == " "; }

std::string text_between(const Glyphs& line, int from, int to) {
  std::string text;
  for (int at = from; at < std::min(to, glyph_count(line)); ++at) text += line[at];
  return text.erase(text.find_last_not_of(' ') + 1);
}

int first_of(const Glyphs& line) {
  int at = 0;
  while (at < glyph_count(line) && is_space(line, at)) ++at;
  return at;
}

/// Where each row of a table breaks, from left to right; nothing where the lines are no table, or do not fit so.
class TableBreaks {
 public:
  TableBreaks(const std::vector<Glyphs>& rows, int columns) : rows_(rows), columns_(columns) {
    for (const Glyphs& row : rows) widest_ = std::max(widest_, glyph_count(row));
  }

  std::optional<std::vector<int>> found() {
    std::vector<int> breaks;
    if (rows_.size() < 2 || !from(0, breaks)) return std::nullopt;
    return breaks;
  }

  /// The least indentation that rows have from there on.
  int begins(int at) const {
    int least = widest_;
    for (const Glyphs& row : rows_) {
      int first = at;
      while (first < glyph_count(row) && is_space(row, first)) ++first;
      if (first < glyph_count(row)) least = std::min(least, first);
    }
    return least;
  }

 private:
  /// Between two columns: a cell ends or is missing in every row, and the first column is empty at most in the heading.
  bool is_gutter(int at) const {
    bool wide = false;
    for (const Glyphs& row : rows_) {
      if (!is_space(row, at - 1)) return false;
      const bool named = first_of(row) < at || &row == &rows_.front();
      if (!named) return false;
      wide = wide || (at > 1 && is_space(row, at - 2) && at < glyph_count(row));
    }
    return wide;
  }
  int width_between(int from, int to) const {
    int width = 0;
    for (const Glyphs& row : rows_)
      width = std::max(width, glyph_count(glyphs_of(text_between(row, begins(from), to))));
    return width;
  }
  /// As few parts as there can be, and of these the ones with the most in the last.
  bool from(int at, std::vector<int>& breaks) const {
    const int room = columns_ - (at == 0 ? 0 : hanging);
    if (width_between(at, widest_) <= room) return true;
    std::optional<std::vector<int>> best;
    for (int next = begins(at) + 1; next < widest_ && width_between(at, next) <= room; ++next) {
      if (!is_gutter(next) || begins(next) != next) continue;
      std::vector<int> rest;
      if (from(next, rest) && (!best || rest.size() + 1 < best->size())) {
        best = std::vector<int>{next};
        best->insert(best->end(), rest.begin(), rest.end());
      }
    }
    if (!best) return false;
    breaks.insert(breaks.end(), best->begin(), best->end());
    return true;
  }

  const std::vector<Glyphs>& rows_;
  int columns_, widest_ = 0;
};

bool is_sign(const Glyphs& line, int at) {
  static constexpr std::string_view before[] = {"=", "+", "\u2212", "\u00b7", "/", "<", "\u2264"};
  return at + 1 < glyph_count(line) && is_space(line, at + 1) &&
         std::find(std::begin(before), std::end(before), line[at]) != std::end(before);
}

/// BreakPlaces where a line may break, the better ones first; of each kind the last that fits.
struct BreakPlaces {
  int behind_comma = 0, before_sign = 0, outside_brackets = 0, before_sign_in_brackets = 0, at_space = 0,
      beside_sign = 0;
};

/// Where a line that begins there and has so much room ends.
int end_of_line(const Glyphs& line, int from, int room) {
  if (glyph_count(line) - from <= room) return glyph_count(line);
  const auto glyph = [&](int at) -> std::string_view { return line[at]; };
  BreakPlaces found;
  int depth = 0;
  for (int at = from; at <= from + room; ++at) {
    if (at > from && is_space(line, at - 1) && !is_space(line, at)) {
      found.at_space = at;
      if (depth == 0) found.outside_brackets = at;
      if (is_sign(line, at)) (depth == 0 ? found.before_sign : found.before_sign_in_brackets) = at;
      if (depth == 0 && at - 2 > from && glyph(at - 2) == ",") found.behind_comma = at;
    } else if (at > from && is_space(line, at)) {  // what follows the space may be beyond the room
      found.at_space = at;
      if (depth == 0) found.outside_brackets = at;
      if (at == from + room && is_sign(line, at + 1))
        (depth == 0 ? found.before_sign : found.before_sign_in_brackets) = at;
      if (at == from + room && depth == 0 && glyph(at - 1) == ",") found.behind_comma = at;
    } else if (at > from && (glyph(at - 1) == "," || glyph(at) == "+" || glyph(at) == "\u00b7" || glyph(at) == "/")) {
      found.beside_sign = at;
    }
    if (glyph(at) == "(") ++depth;
    if (glyph(at) == ")") --depth;
  }
  const int far_enough = from + room / 4;
  for (const int place : {found.behind_comma, found.before_sign, found.outside_brackets, found.before_sign_in_brackets})
    if (place > far_enough) return place;
  for (const int place : {found.at_space, found.beside_sign})
    if (place > from) return place;
  return from + room;
}

void break_line(std::vector<CodeLine>& lines, const Glyphs& line, int columns) {
  int at = first_of(line), indent = at;
  if (glyph_count(line) > columns) indent = std::min(indent, hanging);
  for (bool continues = false; at < glyph_count(line) || !continues; continues = true) {
    const int end = end_of_line(line, at, std::max(1, columns - indent));
    lines.push_back({text_between(line, at, end), indent, continues});
    at = end, indent = hanging;
    while (at < glyph_count(line) && is_space(line, at)) ++at;
  }
}

}  // namespace

std::vector<CodeLine> code_lines(const std::string& code, int columns) {
  std::vector<Glyphs> rows;
  for (std::size_t at = 0; at <= code.size();) {
    const std::size_t end = std::min(code.find('\n', at), code.size());
    rows.push_back(glyphs_of(std::string_view(code).substr(at, end - at)));
    at = end + 1;
  }
  std::vector<CodeLine> lines;
  TableBreaks table(rows, columns);
  const bool fit =
      std::all_of(rows.begin(), rows.end(), [&](const Glyphs& row) { return glyph_count(row) <= columns; });
  const auto breaks = fit ? std::nullopt : table.found();
  for (const Glyphs& row : rows) {
    if (!breaks) {
      break_line(lines, row, columns);
      continue;
    }
    for (std::size_t part = 0; part <= breaks->size(); ++part) {
      const int from = part == 0 ? table.begins(0) : (*breaks)[part - 1],
                to = part < breaks->size() ? (*breaks)[part] : glyph_count(row);
      std::string text = text_between(row, from, to);
      const std::size_t blank = std::min(text.find_first_not_of(' '), text.size());
      if (blank == text.size()) continue;
      lines.push_back({text.substr(blank), index32(blank) + (part == 0 ? 0 : hanging), false});
    }
  }
  return lines;
}

namespace {

/// How far in a level stands: the deepest line of the page keeps most of the pane for its words.
float indent_of(const Ui& ui, const Page& page, float width) {
  int deepest = 1;
  for (const StepInfo& step : page) deepest = std::max(deepest, static_cast<int>(step.indent));
  return std::max(3.0f, std::round(std::min(ui.em * 0.8f, width * 0.22f / to_float(deepest))));
}

float gutter(const Ui& ui) { return std::round(ui.em * 1.15f); }

/// How a line of the page is written, and how often it ran.
struct Line {
  Flow how;
  float indent, height;
  std::string hits;
  float hits_width;
};
Line line_of(Ui& ui, const StepInfo& step, bool now, float level, float width) {
  const Theme& c = ui.colors();
  const auto count = ui.hits.of(step.id);
  Line line;
  line.indent = gutter(ui) + to_float(step.indent) * level;
  line.hits = count && *count > 0 && (ui.laboratory || ui.session.at_rest()) ? grouped(*count) : "";
  line.hits_width = line.hits.empty() ? 0 : text_size(ui, ui.fonts.small, line.hits).x + ui.em * 0.4f;
  line.how.font = ui.fonts.mono;
  line.how.indent = std::round(std::min(ui.em * 0.9f, width * 0.05f));
  line.how.width = std::max(ui.em * 4, width - line.indent - line.hits_width - 2);
  line.how.color = now ? c.text : count && *count == 0 ? c.muted : c.text;
  line.height = flow_height(ui, step.text, line.how) + 2;
  return line;
}

void draw_line(Ui& ui, const StepInfo& step, bool now, float level) {
  const Theme& c = ui.colors();
  const float width = ImGui::GetContentRegionAvail().x;
  const auto [how, indent, height, hits, hits_width] = line_of(ui, step, now, level, width);
  const ImVec2 at = ImGui::GetCursorScreenPos();
  ImGui::PushID(step.id);
  const bool clicked = ImGui::InvisibleButton("line", {width, height});
  const bool hovered = ImGui::IsItemHovered();
  ImGui::PopID();
  ImDrawList* list = ImGui::GetWindowDrawList();
  const ImVec2 end{at.x + width, at.y + height};
  can_be_hit(ui, at, end);
  if (now) {
    list->AddRectFilled(at, end, c.now_soft);
    list->AddRectFilled(at, {at.x + 3, end.y}, c.now);
    draw_text(ui, {at.x + 5, at.y + 1}, ui.fonts.text, c.now, "\u25b6");
  } else if (hovered) {
    list->AddRectFilled(at, end, c.head);
  }
  const ImVec2 after = ImGui::GetCursorScreenPos();
  ImGui::SetCursorScreenPos({at.x + indent, at.y + 1});
  flow(ui, step.text, how);
  ImGui::SetCursorScreenPos(after);
  if (!hits.empty()) draw_text(ui, {end.x - hits_width + ui.em * 0.2f, at.y + 3}, ui.fonts.small, c.muted, hits);

  if (now) follow(ui, at.y, height);
  if (hovered)
    ui.mouse_help = "Click: on to the next time this line runs. Shift+click: back to the last time. Right click: more.";
  if (hovered && ui.asks && ImGui::IsMouseClicked(ImGuiMouseButton_Right)) {
    const std::uint8_t id = step.id;
    const auto run = [id](int direction) { return [id, direction](Session& s) { s.to_step(id, direction); }; };
    ui.here = {{.text = "On to the next time this line runs", .first = run(1)},
               {.text = "Back to the last time it ran", .first = run(-1)},
               {.text = "Run until a condition is true", .command = "run-until"},
               {.text = "The whole page, or folded", .command = "whole-code"},
               {.text = "Copy its name: " + step.name, .copies = step.name}};
  }
  if (clicked) ui.session.to_step(step.id, ImGui::GetIO().KeyShift ? -1 : 1);
}

float fold_height(const Ui& ui) { return std::round(ui.fonts.small->FontSize * 1.35f); }

/// Stands for lines that are folded; a click shows them all.
void draw_fold(Ui& ui, const StepInfo& first, std::size_t lines, float level) {
  const ImVec2 at = ImGui::GetCursorScreenPos();
  const float width = ImGui::GetContentRegionAvail().x, height = fold_height(ui);
  ImGui::PushID(first.id);
  if (ImGui::InvisibleButton("fold", {width, height})) ui.whole_code = true;
  ImGui::PopID();
  if (ImGui::IsItemHovered()) {
    ImGui::GetWindowDrawList()->AddRectFilled(at, {at.x + width, at.y + height}, ui.colors().head);
    ui.mouse_help = "Click: the whole page. 7: folded again, around the line at work.";
  }
  draw_text(ui, {at.x + gutter(ui) + to_float(first.indent) * level, at.y}, ui.fonts.small, ui.colors().muted,
            lines == 1 ? "\u2026 1 line" : fmt::format("\u2026 {} lines", lines));
}

float height_of(const std::vector<bool>& shown, const std::vector<float>& heights, float fold) {
  float height = 0;
  for (std::size_t i = 0; i < shown.size(); ++i) height += shown[i] ? heights[i] : i == 0 || shown[i - 1] ? fold : 0;
  return height;
}

/// What is near the line at work, and as many lines more as there is room for, the nearest first.
std::vector<bool> lines_that_fit(const Page& page, std::size_t now, const std::vector<float>& heights, float fold,
                                 float room) {
  std::vector<bool> shown = lines_near(page, now);
  // In a low pane what comes after the line at work is folded first.
  for (std::size_t i = page.size(); --i > now && height_of(shown, heights, fold) > room;) shown[i] = false;
  for (std::size_t away = 1; away < page.size(); ++away)
    for (const std::size_t i : {now + away, now - away}) {  // before the first is beyond the last
      if (i >= page.size() || shown[i]) continue;
      shown[i] = true;
      if (height_of(shown, heights, fold) <= room) continue;
      shown[i] = false;
      return shown;
    }
  return shown;
}

/// In a lesson's layout: what is near the line at work, and where there is no room for all of that the lines around it.
std::vector<bool> few_lines(Ui& ui, const Page& page, std::size_t now, const std::vector<float>& heights) {
  std::vector<bool> shown = lines_near(page, now);
  const float wanted = std::min(height_of(shown, heights, 0), 10 * ui.line());
  ui.text_heights[pseudo_code_pane.id] = {wanted, ui.read_now()};
  const float room = std::min(ImGui::GetContentRegionAvail().y, wanted);
  for (std::size_t away = page.size(); away > 0 && height_of(shown, heights, 0) > room; --away)
    for (const std::size_t i : {now - away, now + away})  // before the first is beyond the last
      if (i < page.size() && height_of(shown, heights, 0) > room) shown[i] = false;
  return shown;
}

Page::const_iterator line_of(const Page& page, const RecordedEvent* event) {
  return std::find_if(page.begin(), page.end(), [&](const StepInfo& step) { return event && event->step == step.id; });
}
/// None where the picture is looked at as a whole, or the last step does not belong to what is asked.
Page::const_iterator line_at_work(const Ui& ui, const Page& page) {
  return line_of(page, ui.session.at_rest() ? nullptr : ui.session.event_told());
}

/// All of the page where it fits or is asked for, else what is near the line at work.
std::vector<bool> lines_shown(Ui& ui, const Page& page, float level) {
  std::vector<bool> all(page.size(), true);
  const auto line = line_of(page, ui.session.at_rest() ? nullptr : ui.session.event());
  if (line == page.end() || (ui.whole_code && ui.laboratory)) return all;
  const std::size_t now = line - page.begin();
  std::vector<float> heights;
  for (const StepInfo& step : page)
    heights.push_back(line_of(ui, step, false, level, ImGui::GetContentRegionAvail().x).height);
  if (!ui.laboratory) return few_lines(ui, page, now, heights);
  // With room to spare: counts beside the lines grow, and the page must not fold for that.
  const float room = ImGui::GetContentRegionAvail().y - ui.line();
  if (std::accumulate(heights.begin(), heights.end(), 0.0f) <= room) return all;
  return lines_that_fit(page, now, heights, fold_height(ui), room);
}

/// How far each line is from one that the lesson's stop counts; where it counts none, from what ran most often.
std::vector<std::size_t> distances(const Ui& ui, const Page& page) {
  const Session& s = ui.session;
  std::vector<std::size_t> at;
  for (std::size_t k = 0; s.lesson() && s.stop() >= 0 && k < page.size(); ++k)
    for (const std::string& name : s.lesson()->stops[s.stop()].names)
      if (name == page[k].name || name == page[k].module + "." + page[k].name) at.push_back(k);
  const auto ran = [&](const StepInfo& step) { return ui.hits.of(step.id); };
  if (at.empty()) at.push_back(static_cast<std::size_t>(std::ranges::max_element(page, {}, ran) - page.begin()));
  std::vector<std::size_t> distances(page.size(), page.size());
  for (std::size_t k = 0; k < page.size(); ++k)
    for (const std::size_t line : at) distances[k] = std::min(distances[k], k > line ? k - line : line - k);
  return distances;
}

/// How often each line ran, in as many columns as there is room for; what is farthest from what counts gives way.
void draw_counts(Ui& ui, const Page& page) {
  const ImVec2 room = ImGui::GetContentRegionAvail(), corner = ImGui::GetCursorScreenPos();
  const int columns = std::clamp(static_cast<int>(room.x / (24 * ui.em)), 1, 3);
  const float width = std::floor(room.x / to_float(columns)), level = indent_of(ui, page, width), inner = width - ui.em;
  std::vector<float> heights;
  for (const StepInfo& step : page) heights.push_back(line_of(ui, step, false, level, inner).height);
  ui.text_heights[pseudo_code_pane.id] = {std::accumulate(heights.begin(), heights.end(), 0.0f), ui.read_now()};
  const std::vector<std::size_t> distance = distances(ui, page);
  std::vector<std::size_t> shown(page.size());
  std::iota(shown.begin(), shown.end(), std::size_t{0});
  /// In which column each line is.
  const auto filled = [&] {
    std::vector<int> places;
    float used = 0;
    int column = 0;
    for (const std::size_t line : shown) {
      if (used + heights[line] > room.y && used > 0) ++column, used = 0;
      used += heights[line], places.push_back(column);
    }
    return places;
  };
  while (shown.size() > 1 && filled().back() >= columns)
    shown.erase(std::ranges::max_element(shown, {}, [&](std::size_t line) { return distance[line]; }));
  const std::vector<int> places = filled();
  for (std::size_t k = 0, column = 0; k < shown.size(); ++column) {
    ImGui::SetCursorScreenPos({corner.x + to_float(column) * width, corner.y});
    ImGui::BeginChild(fmt::format("column {}", column).c_str(), {inner, room.y}, false, ImGuiWindowFlags_NoScrollbar);
    for (; k < shown.size() && places[k] == static_cast<int>(column); ++k) draw_line(ui, page[shown[k]], false, level);
    ImGui::EndChild();
  }
}

void draw_pseudo_code(Ui& ui) {
  const Page& page = ui.session.header().page;
  if (page.empty()) return say_empty(ui, "This trace has no step table, so there is no pseudo-code to show.");
  ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, {0, 0});
  if (ui.session.at_rest() && !ui.laboratory) {
    draw_counts(ui, page);
    return ImGui::PopStyleVar();
  }
  const float level = indent_of(ui, page, ImGui::GetContentRegionAvail().x);
  const std::vector<bool> shown = lines_shown(ui, page, level);
  const auto now = line_at_work(ui, page);
  for (std::size_t i = 0; i < page.size(); ++i) {
    if (shown[i]) {
      draw_line(ui, page[i], now != page.end() && now->id == page[i].id, level);
      continue;
    }
    const std::size_t first = i;
    while (i + 1 < page.size() && !shown[i + 1]) ++i;
    if (ui.laboratory) draw_fold(ui, page[first], i + 1 - first, level);
  }
  ImGui::PopStyleVar();
}

std::string note_of_pseudo_code(Ui& ui) {
  if (ui.session.at_rest()) return "how often each line ran";
  const RecordedEvent* event = ui.session.event_told();
  const StepInfo* step = event ? find_step(ui.session.header().page, event->step) : nullptr;
  return step ? step->module + "." + step->name : "";
}

}  // namespace

const Pane pseudo_code_pane{"pseudo_code", "PSEUDO-CODE", draw_pseudo_code, note_of_pseudo_code, nullptr, 0, true};

}  // namespace zstep::viewer
