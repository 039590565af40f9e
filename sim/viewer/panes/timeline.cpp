// The whole trace as a strip to scrub, polygons marked; below it the polygon at work, its scan lines marked. Transport.

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <string>
#include <utility>

#include "sim/viewer/commands.hpp"
#include "sim/viewer/draw/canvas.hpp"
#include "sim/viewer/model/label_spots.hpp"
#include "sim/viewer/panes/pane.hpp"
#include "sim/viewer/panes/strip_marks.hpp"
#include "sim/words/explain.hpp"
#include "sim/words/numbers.hpp"

namespace zstep::viewer {
namespace {

void scrub(Ui& ui, const char* id, const Strip& strip, bool with_stops) {
  ImGui::SetCursorScreenPos(strip.at);
  ImGui::InvisibleButton(id, {strip.width, strip.height});
  can_be_hit(ui, strip.at, {strip.at.x + strip.width, strip.at.y + strip.height});
  const bool hovered = ImGui::IsItemHovered(), active = ImGui::IsItemActive();
  if (!hovered && !active) return;
  const std::optional<Sign> sign = sign_under(ui, strip, with_stops);
  if (hovered) {
    ui.mouse_help = sign ? sign->help : "Click or drag: go to any step.";
    if (sign && !active) tooltip(ui, {sign->help});
  }
  if (hovered && ui.asks && ImGui::IsMouseClicked(ImGuiMouseButton_Right)) {
    const std::int64_t step = sign ? sign->step : strip.position(ImGui::GetIO().MousePos.x);
    const auto go = [step](Session& session) { session.go_to(step); };
    ui.here = {{.text = fmt::format("Go to step {}", grouped(step)), .first = go},
               {"Set a bookmark there", "bookmark", go},
               {"Repeat from there", "loop-first", go},
               {"Repeat up to there", "loop-last", go},
               {.text = "Copy its number: " + std::to_string(step), .copies = std::to_string(step)}};
  }
  if (!active) return;
  Session& s = ui.session;
  s.playing = false;
  if (!sign) s.go_to(strip.position(ImGui::GetIO().MousePos.x));
  else if (sign->stop < 0) s.go_to(sign->step);
  else if (s.stop() != sign->stop || s.position() != sign->step) s.to_stop(sign->stop);
}

ImU32 color_of(const Session& s, std::int32_t polygon) {
  const std::size_t at = polygon;
  return polygon >= 0 && at < s.scene().polygons.size() ? to_im(opaque(s.scene().polygons[at].color))
                                                        : IM_COL32(128, 128, 128, 255);
}

/// Where a method that gathers all polygons first is done with that: what comes then is no polygon's own. The end if it
/// is none.
std::int64_t end_of_gathering(const Session& s) {
  const auto marks = s.trace().polygons();
  const bool gathers = records<AreaBegin>(s.header()) || records<LineBegin>(s.header());
  if (!gathers || marks.empty()) return s.size();
  return s.trace()
      .next(marks.back().position,
            [](const RecordedEvent& e) { return holds<AreaBegin>(e.event) || holds<LineBegin>(e.event); })
      .value_or(s.size());
}

/// A curve of a surface, or a row of pixels: what a trace consists of that has no polygons one after another.
struct Section {
  std::int64_t position;
  std::int32_t number;
};
struct Sections {
  const char* word = "";  ///< "curve"
  std::vector<Section> all;
  std::ptrdiff_t at = -1;  ///< the one at work; −1 before the first
};
Sections sections_of(Ui& ui) {
  const Trace& trace = ui.session.trace();
  const std::int64_t position = ui.session.position();
  Sections sections;
  for (const CurveMarks::Mark& mark : ui.curves.of(trace)) sections.all.push_back({mark.position, mark.curve.curve});
  if (!sections.all.empty()) {
    sections.word = "curve", sections.at = ui.curves.at(trace, position);
    return sections;
  }
  for (const RowMarks::Mark& mark : ui.rows.of(trace)) sections.all.push_back({mark.position, mark.y});
  sections.word = "scan line", sections.at = ui.rows.at(trace, position);
  return sections;
}

void draw_sections(Ui& ui, const Strip& strip, const Sections& sections, StripWords& words) {
  const Theme& c = ui.colors();
  ImDrawList* list = ImGui::GetWindowDrawList();
  const std::vector<Section>& marks = sections.all;
  const float end = strip.at.x + strip.width, bottom = strip.at.y + strip.height;
  float drawn_to = -1;
  for (std::size_t i = 0; i < marks.size(); ++i) {
    const float x0 = std::floor(strip.x(marks[i].position)),
                x1 = std::floor(i + 1 < marks.size() ? strip.x(marks[i + 1].position) : end);
    if (x1 <= drawn_to) continue;
    drawn_to = x1;
    list->AddRectFilled({x0, bottom - 5}, {std::max(x0 + 1, x1), bottom}, i % 2 == 0 ? c.muted : c.grid);
    if (x1 - x0 < 4) continue;
    list->AddRectFilled({x0, strip.at.y}, {x0 + ui.thin, bottom}, c.rule);
    const std::string number = std::to_string(marks[i].number),
                      label = (x1 - x0 > ui.em * 6 ? sections.word + std::string(" ") : "") + number;
    words.write_between(x0, x1, c.text, label);
  }
}

void draw_whole(Ui& ui, const Strip& strip, const Sections& sections) {
  const Session& s = ui.session;
  const Theme& c = ui.colors();
  ImDrawList* list = ImGui::GetWindowDrawList();
  StripWords words(ui, strip);
  const ImVec2 end{strip.at.x + strip.width, strip.at.y + strip.height};
  list->AddRectFilled(strip.at, end, c.head);
  const auto marks = s.trace().polygons();
  float drawn_to = -1;
  const auto sweep = ui.lines.sweep_from(s.trace());
  const std::int64_t gathered = sweep ? *sweep : end_of_gathering(s);
  if (gathered < s.size()) {
    const char* units = sweep ? "lines of all polygons" : records<AreaBegin>(s.header()) ? "areas" : "edges";
    const float x0 = std::floor(strip.x(gathered));
    list->AddRectFilled({x0, strip.at.y}, {x0 + ui.thin, end.y}, c.rule);
    words.write_between(x0, end.x, c.text, units);
  }
  const ScenePart lit = s.lit_part();
  const std::vector<std::int32_t> have = lit.any() ? polygons_with(s.scene(), lit) : std::vector<std::int32_t>{};
  for (std::size_t i = 0; i < marks.size(); ++i) {
    const float x0 = std::floor(strip.x(marks[i].position)),
                x1 = std::floor(strip.x(i + 1 < marks.size() ? marks[i + 1].position : gathered));
    if (std::find(have.begin(), have.end(), marks[i].polygon) != have.end()) {
      // Of a polygon that has what is picked, as of its scan lines in the lower strip.
      list->AddRectFilled({x0, strip.at.y}, {std::max(x0 + 1, x1), end.y}, c.selected_soft);
      list->AddRectFilled({x0, strip.at.y}, {std::max(x0 + 1, x1), strip.at.y + std::round(3 * ui.thin)}, c.selected);
    }
    if (x1 <= drawn_to) continue;  // many polygons in one pixel: the first stands for them
    drawn_to = x1;
    list->AddRectFilled({x0, end.y - 5}, {std::max(x0 + 1, x1), end.y}, color_of(s, marks[i].polygon));
    if (x1 - x0 < 4) continue;
    list->AddRectFilled({x0, strip.at.y}, {x0 + ui.thin, end.y}, c.rule);
    const std::string label = (x1 - x0 > ui.em * 6 ? "polygon " : "") + polygon_label(s.scene(), marks[i].polygon);
    words.write_between(x0, x1, c.text, label);
  }
  if (!sections.all.empty()) draw_sections(ui, strip, sections, words);
  else if (marks.empty())
    words.write_first(c.muted, records<LineBegin>(s.header()) ? "edge by edge" : "this trace marks no polygons");
  if (s.lesson())
    for (const Stop& stop : s.lesson()->stops) {
      const float arm = arm_of_stop(ui), x = std::floor(strip.x(stop.position)), y = end.y - arm;
      list->AddQuadFilled({x, y - arm}, {x + arm, y}, {x, y + arm}, {x - arm, y},
                          stop.question ? c.selected : c.changed);
    }
  frame_box(ui, strip.at, end, c.rule);
  draw_step_marks(ui, strip);
  draw_places(ui, strip);
  draw_place(ui, strip);
}

void draw_polygon(Ui& ui, const Strip& strip, const ScanLineMarks::Interval& interval, const Sections& sections) {
  const Session& s = ui.session;
  const Theme& c = ui.colors();
  const ImFont* font = ui.fonts.small;
  ImDrawList* list = ImGui::GetWindowDrawList();
  StripWords words(ui, strip);
  const ImVec2 end{strip.at.x + strip.width, strip.at.y + strip.height};
  list->AddRectFilled(strip.at, end, c.head);
  std::optional<std::pair<std::int32_t, std::int32_t>> lit;
  const auto& table = s.state().machine.edge_table;
  if (const auto edge = s.lit_edge(); edge && static_cast<std::size_t>(*edge) < table.size())
    lit = {table[*edge].first_row, table[*edge].end_row};
  float labelled_to = strip.at.x;
  const float needed = text_size(ui, font, "y 000").x + 6;
  for (std::size_t i = 0; i < interval.lines.size(); ++i) {
    const auto& mark = interval.lines[i];
    const float x0 = std::floor(strip.x(mark.position)),
                x1 = i + 1 < interval.lines.size() ? std::floor(strip.x(interval.lines[i + 1].position)) : end.x;
    if (lit && mark.y >= lit->first && mark.y < lit->second) {
      list->AddRectFilled({x0, strip.at.y}, {x1, end.y}, c.selected_soft);
      list->AddRectFilled({x0, end.y - 3}, {x1, end.y}, c.selected);
    }
    list->AddRectFilled({x0, strip.at.y}, {x0 + ui.thin, end.y}, c.rule);
    if (x0 < labelled_to || x0 + needed > end.x) continue;
    words.write(x0 + 3, x0, x0 + needed, c.muted, fmt::format("y {}", mark.y));
    labelled_to = x0 + needed;
  }
  if (!sections.all.empty()) {
    const std::string which = sections.at < 0 ? fmt::format("before the first {}", sections.word)
                                              : fmt::format("{} {}", sections.word, sections.all[sections.at].number);
    words.write_first(c.muted, which);
  } else if (interval.polygon == no_polygon && interval.lines.empty() && interval.complete &&
             !s.trace().polygons().empty())
    words.write_first(c.muted, "before the first polygon: clearing and viewing");
  else if (!records<ScanLineBegin>(s.header())) words.write_first(c.muted, "this method has no scan lines");
  else if (!interval.complete) words.write_first(c.muted, "too many events to mark the scan lines");
  else if (interval.lines.empty()) words.write_first(c.muted, why_no_lines(s.trace(), interval, s.position()));
  frame_box(ui, strip.at, end, c.rule);
  draw_step_marks(ui, strip);
  draw_places(ui, strip);
  draw_place(ui, strip);
}

struct StripSizes {
  float height, gap;
};
/// With large letters the strips lie closer.
StripSizes strip_sizes(const Ui& ui) {
  return ui.presenter ? StripSizes{std::round(ui.em), std::round(ui.em * 0.25f)}
                      : StripSizes{std::round(ui.em * 1.25f), std::round(ui.em * 0.55f)};
}

}  // namespace

void draw_small_timeline(Ui& ui, ImVec2 size, float row) {
  const Session& s = ui.session;
  const ImVec2 origin = ImGui::GetCursorScreenPos();
  const bool below = size.y >= 2 * row;
  const float gap = std::round(ui.em * 0.5f), wide = below ? size.x : std::round(size.x * 0.45f);
  ImGui::SetCursorScreenPos({origin.x, origin.y + size.y - row});
  draw_small_transport(ui, s.playing, {wide, row});
  const std::string step = fmt::format("step {} of {}", grouped(s.position()), grouped(s.size()));
  const float told = below ? 0 : text_size(ui, ui.fonts.text, step).x + ui.em,
              left = below ? origin.x : origin.x + wide + gap;
  const bool tells = !below && origin.x + size.x - left - told > 8 * ui.em;
  Strip strip{{left, origin.y}, origin.x + size.x - left - (tells ? told : 0), row, 0, s.size()};
  if (strip.width < 8) return;
  scrub(ui, "whole", strip, true);
  if (tells)
    draw_text(ui, {origin.x + size.x - told + ui.em, origin.y + std::round((row - ui.em) / 2) - 1}, ui.fonts.text,
              ui.colors().text, step);
  strip.height = std::min(row, strip_sizes(ui).height);
  strip.at.y += std::round((row - strip.height) / 2);
  draw_whole(ui, strip, sections_of(ui));
}

float timeline_height(const Ui& ui) {
  const auto [height, gap] = strip_sizes(ui);
  return std::round((ui.other ? 3.0f : ui.laboratory ? 2.0f : 1.0f) * (height + gap) + ui.em * 1.75f);
}

void draw_timeline(Ui& ui, ImVec2 size) {
  const ImVec2 origin = ImGui::GetCursorScreenPos();
  const StripSizes sizes = strip_sizes(ui);
  const float strip_height = sizes.height, gap = sizes.gap;
  ScanLineMarks::Interval interval = ui.lines.at(ui.session.trace(), ui.session.position());
  const Sections sections = sections_of(ui);
  if (!sections.all.empty()) {
    const std::size_t next = sections.at + 1;
    interval.first = next == 0 ? 0 : sections.all[next - 1].position;
    interval.last = next == sections.all.size() ? ui.session.size() : sections.all[next].position;
  }
  // With a second run each has its name in front.
  const float named = ui.other ? std::round(ui.em * 1.2f) : 0;
  float y = origin.y;
  const auto next_strip = [&](const char* name, std::int64_t first, std::int64_t last) {
    const Strip strip{{origin.x + named, y}, size.x - named, strip_height, first, last};
    if (ui.other)
      draw_text(ui, {origin.x, y + std::round((strip_height - ui.fonts.bold->FontSize) / 2) - 1}, ui.fonts.bold,
                ui.colors().text, name);
    y += strip_height + gap;
    return strip;
  };
  const Strip whole = next_strip("A", 0, ui.session.size());
  scrub(ui, "whole", whole, true);
  draw_whole(ui, whole, sections);
  if (Ui* b = ui.other) {
    const Strip of_b = next_strip("B", 0, b->session.size());
    b->mouse_help.clear();
    scrub(*b, "whole of B", of_b, false);
    if (!b->mouse_help.empty()) ui.mouse_help = b->mouse_help;
    draw_whole(*b, of_b, sections_of(*b));
  }
  if (ui.laboratory) {
    const Strip polygon = next_strip("A", interval.first, interval.last);
    scrub(ui, "polygon", polygon, false);
    draw_polygon(ui, polygon, interval, sections);
  }
  ImGui::SetCursorScreenPos({origin.x, y});
  const Session& s = ui.session;
  float widest = 0;
  for (const auto& speed : Session::speeds()) widest = std::max(widest, text_size(ui, ui.fonts.text, speed.name).x);
  draw_transport(ui, s.playing, Session::speeds()[s.speed].name, widest, size.x);
  ImGui::SameLine(0, ui.em);
  // What the mouse does here, else where this is; only when there is room for all of it.
  const std::string percent = s.size() ? fmt::format("{:.1f} %", ratio(100 * s.position(), s.size())) : "0 %";
  const float room = origin.x + size.x - ImGui::GetCursorScreenPos().x;
  const float right = text_size(ui, ui.fonts.mono, percent).x;
  const float line = ImGui::GetCursorScreenPos().y + std::round(ui.em * 0.3f);
  if (right < room) draw_text(ui, {origin.x + size.x - right, line}, ui.fonts.mono, ui.colors().text, percent);
  const bool lines = records<ScanLineBegin>(s.header()) || !sections.all.empty(),
             polygons = !s.trace().polygons().empty();
  const std::string every =
      fmt::format("\u2192 step    Shift+\u2192 pixel    {}{}Space play    ? all keys",
                  lines ? fmt::format("Ctrl+\u2192 {}    ", sections.all.empty() ? "scan line" : sections.word) : "",
                  polygons ? "Page down polygon    " : "");
  for (const std::string& hint : {ui.mouse_help, every, std::string("\u2192 step    Shift+\u2192 pixel    ? all keys"),
                                  std::string("? all keys")})
    if (!hint.empty() && text_size(ui, ui.fonts.text, hint).x + right + ui.em < room) {
      draw_text(ui, {ImGui::GetCursorScreenPos().x, line}, ui.fonts.text, ui.colors().muted, hint);
      break;
    }
}

// The buttons that move and play.

namespace {

/// A button that does what a key does, and says so.
void command_button(Ui& ui, const char* label, const char* id, bool lit = false) {
  const Command* command = command_called(id);
  if (!command) return;
  if (button(ui, label, lit)) ui.clicked = command;
  if (!ImGui::IsItemHovered()) return;
  const std::string says = fmt::format("{} ({})", command->title, key_names(*command));
  tooltip(ui, {says});
  ui.mouse_help = says;
}

/// What a finger that rests on an arrow, or a right click there, is offered: longer ways.
void offer_units(Ui& ui, bool on) {
  if (!ImGui::IsItemHovered() || !ImGui::IsMouseClicked(ImGuiMouseButton_Right)) return;
  const auto line = [](const char* id) { return HereLine{.text = command_called(id)->title, .command = id}; };
  if (on) ui.here = {line("next-pixel"), line("next-span"), line("next-line"), line("next-polygon")};
  else ui.here = {line("previous-pixel"), line("previous-span"), line("previous-line"), line("previous-polygon")};
}

}  // namespace

void draw_transport(Ui& ui, bool playing, const std::string& speed, float widest, float room) {
  const float gap = ui.em * 0.25f, from = ImGui::GetCursorScreenPos().x;
  command_button(ui, "|\u25c0", "first");
  ImGui::SameLine(0, gap);
  command_button(ui, "\u25c0", "previous");
  ImGui::SameLine(0, gap);
  command_button(ui, playing ? "Pause" : "Play \u25b6\u25b6", "play", playing);
  ImGui::SameLine(0, gap);
  command_button(ui, "\u25b6", "next");
  ImGui::SameLine(0, gap);
  command_button(ui, "\u25b6|", "last");
  ImGui::SameLine(0, ui.em * 0.7f);
  const float sign = text_size(ui, ui.fonts.text, "\u2212").x + 2 * std::round(ui.em * 0.55f);
  if (ImGui::GetCursorScreenPos().x - from + widest + 2 * (sign + gap) > room) return;
  command_button(ui, "\u2212##slower", "slower");
  ImGui::SameLine(0, gap);
  const ImVec2 at = ImGui::GetCursorScreenPos();
  draw_text(ui, {at.x + (widest - text_size(ui, ui.fonts.text, speed).x) / 2, at.y + std::round(ui.em * 0.25f)},
            ui.fonts.text, ui.colors().text, speed);
  ImGui::Dummy({widest, ui.em});
  ImGui::SameLine(0, gap);
  command_button(ui, "+##faster", "faster");
}

void draw_small_transport(Ui& ui, bool playing, ImVec2 size) {
  const float gap = std::round(ui.em * 0.25f), x = ImGui::GetCursorScreenPos().x, y = ImGui::GetCursorScreenPos().y;
  // Where there is no room for five buttons, three.
  const int most = size.x - 4 * gap < 5 * (text_size(ui, ui.fonts.text, "Pause").x + ui.em) ? 1 : 2;
  const float room = size.x - 2 * gap * to_float(most);
  const float width = std::max(1.0f, std::floor(room / to_float(2 * most + 1)));
  const char* const play = width < 5.2f * ui.em ? "\u25b6\u25b6" : "Play \u25b6\u25b6";
  const std::pair<const char*, const char*> all[] = {{"|\u25c0", "first"},
                                                     {"\u25c0", "previous"},
                                                     {playing ? "Pause" : play, "play"},
                                                     {"\u25b6##one", "next"},
                                                     {"\u25b6|", "last"}};
  for (int k = -most; k <= most; ++k) {
    const auto& [label, id] = all[k + 2];
    ImGui::SetCursorScreenPos({x + to_float(k + most) * (width + gap), y});
    if (button_of(ui, label, {width, size.y}, k == 0 && playing)) ui.clicked = command_called(id);
    if (ImGui::IsItemHovered()) ui.mouse_help = command_called(id)->title;
    if (k != 0) offer_units(ui, k > 0);
  }
}

}  // namespace zstep::viewer
