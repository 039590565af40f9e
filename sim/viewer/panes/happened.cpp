// What the step did: a sentence, and the formula with its numbers.

#include "sim/viewer/panes/happened.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>
#include <utility>

#include "sim/answers/origin/exact.hpp"
#include "sim/viewer/panes/pane.hpp"
#include "sim/viewer/panes/typeset.hpp"
#include "sim/words/explain.hpp"
#include "sim/words/judged.hpp"
#include "sim/words/numbers.hpp"
#include "sim/words/owners.hpp"
#include "traces/error.hpp"
#include "traces/text.hpp"

namespace zstep::viewer {
namespace {

std::string line_of(const answers::Chain& chain, const Trace& trace) {
  if (chain.links.empty() || chain.links[0].values.empty()) return "";
  const answers::ChainValue& value = chain.links[0].values[0];
  const answers::Exact exact = answers::exactness_of(chain, trace).of[0][0];
  return exact.known && value.word.empty() ? answers::exact_text(value, exact) : "";
}

}  // namespace

std::string exact_line(Session& session, const answers::Question& question) {
  std::string line;
  try {
    session.look_elsewhere([&](Replay& replay) {
      line = line_of(answers::explain_value(session.trace(), replay, question), session.trace());
    });
  } catch (const InputError&) {
    return "";  // a click says what is wrong with it
  }
  return line;
}

std::string exact_line(const Trace& trace, const answers::Question& question) {
  constexpr std::int64_t most_steps = 100'000;  // a frame must not wait for a seek through more
  if (trace.size() > most_steps) return "";
  try {
    return line_of(answers::explain_value(trace, question), trace);
  } catch (const InputError&) {
    return "";
  }
}

std::vector<HereLine> lines_of_polygon(const Session& s, std::int32_t polygon) {
  std::vector<HereLine> lines;
  std::optional<std::int64_t> earlier, later;
  for (const PolygonMark& mark : s.trace().polygons()) {
    if (mark.polygon != polygon) continue;
    if (mark.position < s.position()) earlier = mark.position;
    if (mark.position > s.position() && !later) later = mark.position;
  }
  const auto go = [](std::int64_t position) { return [position](Session& session) { session.go_to(position); }; };
  const std::string name = polygon_label(s.scene(), polygon);
  if (later) lines.push_back({fmt::format("On to where work on polygon {} begins", name), "", go(*later)});
  if (earlier) lines.push_back({fmt::format("Back to where work on polygon {} began", name), "", go(*earlier)});
  const std::int32_t line = s.scene().polygons[polygon].source_line;
  const std::string place = fmt::format("{}:{}", s.scene().source, line);
  if (line > 0) lines.push_back({.text = "Copy where the file has its polygon: " + place, .copies = place});
  return lines;
}

std::vector<HereLine> lines_of_part(const Session& s, const ScenePart& part) {
  const std::string name = name_of(s.scene(), part);
  const auto go = [part, name](int direction) {
    return [part, name, direction](Session& session) {
      const auto about = [&](const RecordedEvent& event) { return is_about(event.event, part); };
      session.pick(part);
      const auto step = direction > 0 ? session.trace().next(session.position(), about)
                                      : session.trace().previous(session.position(), about);
      if (step) session.go_to(*step);
      else session.message = fmt::format("No {} step is about {}.", direction > 0 ? "later" : "earlier", name);
    };
  };
  std::vector<HereLine> lines{
      {fmt::format("On to the next step about {}", name), "", go(1)},
      {fmt::format("Back to the last step about {}", name), "", go(-1)},
      {part.vertex ? "Move it: by its handle, or type where to" : "Move its vertices: by their handles", "what-if",
       [part](Session& session) { session.pick(part); }},
  };
  if (const std::string place = place_in_file(s.scene(), part); !place.empty())
    lines.push_back({.text = "Copy where the file has it: " + place, .copies = place});
  const std::vector<std::int32_t> polygons = polygons_with(s.scene(), part);
  constexpr std::size_t few = 3;
  for (std::size_t k = 0; k < std::min(few, polygons.size()); ++k)
    for (HereLine& line : lines_of_polygon(s, polygons[k])) lines.push_back(std::move(line));
  return lines;
}

std::vector<HereLine> lines_of_pixel(const Session& s, Cell cell, const std::optional<answers::Question>& depth) {
  const auto select = [cell](Session& session) { session.select(cell); };
  std::vector<HereLine> lines{
      {fmt::format("All that happened to pixel ({}, {})", cell.x, cell.y), "history", select},
      {"Why a polygon is not seen here", "why-not", select},
      {"On to the next step that touches it", "next-touch", select},
      {"Back to the last one", "previous-touch", select},
      {"Run until something is so there", "run-until", select},
      {"Compare this run with another", "compare", select},
      {"Zoom to it", "center", select},
  };
  if (depth) lines.push_back({.text = "Where its depth comes from", .asks = depth});
  const Picture& shown = s.picture();
  const std::int32_t polygon = shown.polygon[shown.at(cell.x, cell.y)];
  if (polygon == no_polygon) return lines;
  for (HereLine& line : lines_of_polygon(s, polygon)) lines.push_back(std::move(line));
  return lines;
}

namespace {

/// Does `name` stand in the text, and not as a part of a longer name?
bool names_in_words(const std::string& text, const std::string& name) {
  const auto goes_on = [&](std::size_t at) {
    return at < text.size() &&
           (is_letter(text[at]) || is_digit(text[at]) || std::string_view("_*/'").find(text[at]) != std::string::npos);
  };
  for (std::size_t at = text.find(name); !name.empty() && at != std::string::npos; at = text.find(name, at + 1))
    if ((at == 0 || !goes_on(at - 1)) && !goes_on(at + name.size())) return true;
  return false;
}

}  // namespace

int how_named(const Stop& stop, const std::string& formula, const std::string& field) {
  const std::string text = stop.text + '\n' + (stop.question ? stop.question->text : "");
  const std::vector<words::Notation> sides = words::read_notation(formula);
  const words::Notation& last = sides.back();
  const bool is_named = std::ranges::find(stop.names, field) != stop.names.end();
  const bool by_symbol = sides.size() > 1 && names_in_words(text, words::on_one_line(sides.front()));
  bool by_value = false;
  if (sides.size() > 1 && last.parts.size() == 1 && last.parts[0].kind == words::Notation::Kind::number)
    for (const auto& [from, bytes] : numbers_in(text))
      by_value = by_value || text.substr(from, bytes) == last.parts[0].text;
  return 4 * is_named + 2 * by_symbol + by_value;
}

std::vector<std::size_t> order_of_giving_way(const Session& s, const Explanation& told) {
  std::vector<std::size_t> order(told.formulas.size());
  for (std::size_t k = 0; k < order.size(); ++k) order[k] = order.size() - 1 - k;
  if (s.lesson() && s.speaks()) {
    const Stop& stop = s.lesson()->stops[s.stop()];
    std::ranges::stable_sort(order, {},
                             [&](std::size_t k) { return how_named(stop, told.formulas[k], told.given[k]); });
  }
  if (!order.empty()) order.pop_back();
  return order;
}

namespace {

/// Lengths of what is drawn and what is left out, in turn, in thin lines.
struct Dashes {
  std::array<float, 4> lengths;
};
constexpr std::array<Dashes, 4> dashes_by_place{{{{1e6f, 0, 1e6f, 0}}, {{6, 3, 6, 3}}, {{2, 2, 2, 2}}, {{7, 2, 2, 2}}}};

}  // namespace

float underline_height(const Ui& ui) { return std::round(3 * ui.thin); }

void underline_of_polygon(const Ui& ui, std::int32_t polygon, std::ptrdiff_t place, ImVec2 from, float width) {
  const std::size_t at = polygon;
  if (polygon < 0 || at >= ui.session.scene().polygons.size()) return;
  const ImU32 color = to_im(opaque(ui.session.scene().polygons[at].color));
  const auto style = std::min(static_cast<std::size_t>(place), dashes_by_place.size() - 1);
  const float top = std::round(from.y), edge = std::round(ui.thin), right = from.x + width;
  ImDrawList* list = ImGui::GetWindowDrawList();
  float x = std::round(from.x);
  for (std::size_t k = 0; x < right; ++k) {
    const float length = std::round(dashes_by_place[style].lengths[k % 4] * ui.thin), end = std::min(right, x + length);
    if (k % 2 == 0) {
      list->AddRectFilled({x, top}, {end, top + underline_height(ui)}, color);
      // A colour near the background's is seen by its edge.
      list->AddRectFilled({x, top + underline_height(ui) - edge}, {end, top + underline_height(ui)}, ui.colors().text);
    }
    x += length;
  }
}

void key_to_owners(Ui& ui, const std::vector<words::Owned>& owned) {
  const std::vector<std::int32_t> owners = words::owners_in(owned);
  if (owners.empty()) return;
  const ImFont* font = ui.fonts.small;
  const float side = std::round(ui.em * 0.55f), height = std::round(font->FontSize * 1.3f) + underline_height(ui);
  const ImVec2 origin = ImGui::GetCursorScreenPos();
  const float right = origin.x + ImGui::GetContentRegionAvail().x;
  ImVec2 at{origin.x + ui.em, origin.y};
  draw_text(ui, at, font, ui.colors().muted, "numbers of");
  at.x += text_size(ui, font, "numbers of").x + ui.em * 0.5f;
  for (std::size_t k = 0; k < owners.size(); ++k) {
    const std::string label = polygon_label(ui.session.scene(), owners[k]);
    const float width = side + 4 + text_size(ui, font, label).x;
    if (at.x + width > right) at = {origin.x + ui.em, at.y + height};
    const std::size_t polygon = owners[k];
    const float y = at.y + std::round((font->FontSize - side) / 2);
    if (polygon < ui.session.scene().polygons.size())
      ImGui::GetWindowDrawList()->AddRectFilled({at.x, y}, {at.x + side, y + side},
                                                to_im(opaque(ui.session.scene().polygons[polygon].color)));
    frame_box(ui, {at.x, y}, {at.x + side, y + side}, ui.colors().text);
    draw_text(ui, {at.x + side + 4, at.y}, font, ui.colors().text, label);
    underline_of_polygon(ui, owners[k], static_cast<std::ptrdiff_t>(k), {at.x, at.y + font->FontSize}, width);
    at.x += width + ui.em * 0.75f;
  }
  ImGui::Dummy({1, at.y + height - origin.y});
}

namespace {

/// A number of the step's own in the sentence tells where it comes from.
void tell(Ui& ui, const std::string& sentence) {
  Flow how;
  how.on_number = [&](const std::string& number, ImVec2 a, ImVec2 b) {
    if (!ImGui::IsMouseHoveringRect(a, b)) return;
    const std::string field = answers::field_shown_as(ui.session.trace(), ui.session.position(), number);
    if (!field.empty()) number_at(ui, a, b, {ui.session.position(), field});
  };
  flow(ui, sentence, how);
}

/// A click on a formula asks about the number that it gives, or else about the step's main one; on one of its numbers,
/// about that.
void tell_formula(Ui& ui, const std::string& formula, const std::string& field,
                  const std::vector<words::Owned>& owned) {
  Flow how;
  const ImVec2 top = ImGui::GetCursorScreenPos();
  const float right = top.x + ImGui::GetContentRegionAvail().x;
  const auto ask = [&](ImVec2 a, ImVec2 b, const std::string& number) {
    if (!ImGui::IsMouseHoveringRect(a, b)) return false;
    return number_at(ui, a, b, {ui.session.position(), field}, number);
  };
  bool on_number = false;
  how.on_number = [&](const std::string& number, ImVec2 a, ImVec2 b) { on_number = ask(a, b, number) || on_number; };
  set_formula(ui, formula, how, owned);
  if (!on_number) ask(top, {right, ImGui::GetCursorScreenPos().y}, "");
}

/// What check or diff says of the step, in its own words.
void draw_told(Ui& ui, const StepMarks::Told& told) {
  const Flow wrong{.color = ui.colors().bad, .font = ui.fonts.bold};
  for (const std::string& what : told.lines) flow(ui, "! " + told.head + what, wrong);
  Flow note;
  note.color = ui.colors().bad;
  if (!told.note.empty()) flow(ui, (told.lines.empty() ? "\u2190 " : "") + told.note, note);
  if (!told.lines.empty() || !told.note.empty()) ImGui::Dummy({1, ui.em * 0.25f});
}

void tell_formulas(Ui& ui, const Explanation& told) {
  Ui::TextHeight& its = ui.text_heights[happened_pane.id];
  if (its.moment != ui.read_now()) its.spared.clear(), its.gone = 0;
  const std::vector<std::size_t> order = order_of_giving_way(ui.session, told);
  std::vector<float> heights;
  for (std::size_t k = 0; k < told.formulas.size(); ++k) {
    const float top = ImGui::GetCursorPosY();
    const auto place = static_cast<std::size_t>(std::find(order.begin(), order.end(), k) - order.begin());
    if (place < order.size() && place < its.gone) ui.given_way += its.spared[place];
    else tell_formula(ui, told.formulas[k], told.given[k], told.owned);
    heights.push_back(ImGui::GetCursorPosY() - top);
  }
  if (its.gone > 0 || !its.spared.empty()) return;
  for (const std::size_t k : order) its.spared.push_back(heights[k]);
}

void draw_happened(Ui& ui) {
  const Theme& c = ui.colors();
  const StepMarks::Told found = ui.marks ? ui.marks->told(ui.session) : StepMarks::Told{};  // moves the replay
  const RecordedEvent* event = ui.session.event();
  if (!ui.session.message.empty()) {
    flow(ui, ui.session.message, {.color = c.now, .font = ui.fonts.bold});
    if (ui.session.proposes_why()) return;  // of the picture, not of its last step
  }
  if (!event) {
    if (ui.session.size() == 0) return say_empty(ui, "This trace has no events: the run recorded nothing.");
    flow(ui, "Nothing has happened yet. \u2192 takes the first step, Space plays, ? shows every key.", {});
    std::vector<std::string> lacks = ui.session.trace().warnings();
    if (!ui.fonts.lacking.empty()) lacks.push_back(ui.fonts.lacking);
    for (const std::string& lack : lacks) {
      flow(ui, lack, {.color = c.bad});
    }
    return;
  }
  draw_told(ui, found);
  const Explanation told = explain(ui.session.trace(), ui.session.state(), *event);
  const Flow in_doubt{.color = c.bad, .font = ui.fonts.bold};
  const bool doubts = told.doubt && found.lines.empty(), doubts_all = doubts && *told.doubt == told.sentence;
  // A stop of the lesson tells in its own words what its step did.
  const bool told_by_lesson = !ui.laboratory && ui.session.speaks();
  if (doubts_all) flow(ui, told.sentence, in_doubt);
  else if (!told_by_lesson) tell(ui, told.sentence);
  if (doubts_all || !told_by_lesson) ImGui::Dummy({1, ui.em * 0.25f});
  const ImVec2 top = ImGui::GetCursorScreenPos();
  tell_formulas(ui, told);
  const ImVec2 bottom{top.x + ImGui::GetContentRegionAvail().x, ImGui::GetCursorScreenPos().y};
  key_to_owners(ui, told.owned);
  if (doubts && !doubts_all) flow(ui, *told.doubt, in_doubt);
  if (const std::string place = printed_at(ui.session.trace(), ui.session.position()); !place.empty())
    flow(ui, with_capital(place), {.color = c.muted});
  if (!told.values.empty() && ImGui::IsMouseHoveringRect(top, bottom) && ImGui::IsWindowHovered()) {
    std::vector<std::string> lines = exact_lines(told.values);
    if (const std::string line = exact_line(ui.session, {ui.session.position()}); !line.empty())  // moves the replay
      lines.push_back(line);
    tooltip(ui, lines, ImVec2{top.x, bottom.y + ui.em * 0.5f});
  }
}

}  // namespace

const Pane happened_pane{"happened", "WHAT JUST HAPPENED", draw_happened, nullptr, nullptr, 0, true};

}  // namespace zstep::viewer
