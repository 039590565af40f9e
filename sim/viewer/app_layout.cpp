// Where the panes are, with their borders.

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

#include "sim/viewer/app.hpp"
#include "sim/viewer/draw/canvas.hpp"
#include "sim/viewer/drawer/drawer.hpp"
#include "sim/viewer/lists.hpp"
#include "sim/viewer/panes/legend.hpp"
#include "sim/viewer/panes/lesson_chart.hpp"
#include "sim/viewer/panes/raster_words.hpp"
#include "sim/viewer/panes/viewing_steps.hpp"
#include "sim/viewer/panes/workspace.hpp"
#include "sim/viewer/stage.hpp"
#include "sim/words/explain.hpp"
#include "sim/words/numbers.hpp"

namespace zstep::viewer {

void App::draw_pane(Ui& ui, const Pane& pane, const std::string& title, ImVec2 at, ImVec2 size) {
  const Theme& c = ui_.colors();
  size = {std::floor(size.x), std::floor(size.y)};
  at = {std::floor(at.x), std::floor(at.y)};
  const float head = std::round(ui_.em * 1.5f);
  ImDrawList* list = ImGui::GetWindowDrawList();
  list->AddRectFilled(at, {at.x + size.x, at.y + size.y}, c.pane);
  list->AddRectFilled(at, {at.x + size.x, at.y + head}, c.head);
  const float pad = std::round(ui_.em * 0.5f);
  const ImFont* font = ui_.fonts.small;
  const float y = at.y + std::round((head - font->FontSize) / 2) - 1;
  const float title_width = text_size(ui_, font, title).x;
  if (title_width + 2 * pad <= size.x) draw_text(ui_, {at.x + pad, y}, font, c.text, title);
  const std::string note = pane.note && (!ui_.presenter || session_.looking_back || pane.id == lesson_pane.id ||
                                         (session_.at_rest() && pane.id == pseudo_code_pane.id))
                               ? pane.note(ui)
                               : "";
  const float note_width = label_size(ui_, font, note).x;
  if (!note.empty() && title_width + note_width + 3 * pad + ui_.em <= size.x)
    draw_label(ui_, {at.x + size.x - pad - note_width, y}, font, session_.looking_back ? c.now : c.muted, note);
  draw_pane_body(ui, pane, {at.x, at.y + head}, {size.x, size.y - head});
  frame_box(ui_, at, {at.x + size.x, at.y + size.y}, c.rule);
}

void App::draw_pane_body(Ui& ui, const Pane& pane, ImVec2 at, ImVec2 size) {
  if (size.x >= 8 && size.y >= 8) {
    ImGui::SetCursorScreenPos(at);
    const ImGuiWindowFlags flags = ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_AlwaysUseWindowPadding |
                                   ImGuiWindowFlags_NoNav |
                                   (pane.scrolls ? ImGuiWindowFlags_HorizontalScrollbar
                                                 : ImGuiWindowFlags_NoScrollbar | ImGuiWindowFlags_NoScrollWithMouse);
    const bool wraps = pane.id == lesson_pane.id || pane.id == happened_pane.id || pane.id == pseudo_code_pane.id;
    if (wraps ? begin_wrapped(ui, pane.id, size, flags) : ImGui::BeginChild(pane.id, size, false, flags)) {
      // Where a pane is scrolled to follows from what it shows, not from what it showed before.
      if (pane.id == lesson_pane.id ? ui_.speaks_now : ui_.scroll_now) ImGui::SetScrollX(0), ImGui::SetScrollY(0);
      const std::size_t tables = ui.tables_seen ? ui.tables_seen->size() : 0;
      ui.given_way = 0;
      pane.draw(ui);
      Ui::TextHeight& its = ui.text_heights[pane.id];
      const float height = ImGui::GetCursorPosY() - ImGui::GetStyle().WindowPadding.y + ui.given_way;
      if (pane.id != pseudo_code_pane.id) its.height = height, its.moment = ui.read_now();  // its lines follow its room
      if (ui.tables_seen)
        for (std::size_t k = tables; k < ui.tables_seen->size(); ++k) (*ui.tables_seen)[k].title = pane.title;
    }
    ImGui::EndChild();
  }
}

bool App::splitter(const char* id, ImVec2 at, ImVec2 size, bool vertical, float& share, float whole) {
  ImGui::SetCursorScreenPos(at);
  ImGui::InvisibleButton(id, {std::max(1.0f, size.x), std::max(1.0f, size.y)});
  const bool hot = ImGui::IsItemHovered() || ImGui::IsItemActive();
  if (hot) {
    ui_.mouse_help = "Drag: move this border. Ctrl+L puts all borders back.";
    ImGui::GetWindowDrawList()->AddRectFilled(at, {at.x + size.x, at.y + size.y}, ui_.colors().button_hovered);
  }
  // The frame in which it is taken hold of may still hold the way of the mouse to it.
  if (!ImGui::IsItemActive() || ImGui::IsItemActivated() || whole <= 0) return false;
  const float moved = vertical ? ImGui::GetIO().MouseDelta.x : ImGui::GetIO().MouseDelta.y;
  if (moved == 0) return false;
  share = std::clamp(share + moved / whole, 0.08f, 0.92f);
  return true;
}

namespace {

/// While T_1 … T_4 are shown, the scene has the stage alone: its matrices need the room.
Workspace stage_of(const Ui& ui, const std::string& lead) {
  Workspace stage = workspace(ui.session.header(), lead);
  if (lead != scene_pane.id || viewing_step(ui) == 0) return stage;
  for (const Pane& pane : stage.leading)
    if (pane.id != lead) stage.small.insert(stage.small.begin(), pane);
  stage.leading = {scene_pane};
  return stage;
}

/// What is asked is asked of pixels: where the frame would stand small and no small pane is shown, it leads.
void keep_frame(const Ui& ui, std::vector<Pane>& leading) {
  const auto is_frame = [](const Pane& pane) { return pane.id == frame_pane.id; };
  if (viewing_step(ui) > 0 || std::any_of(leading.begin(), leading.end(), is_frame)) return;
  leading.erase(leading.begin() + 1, leading.end());
  leading.insert(leading.begin(), frame_pane);
}

}  // namespace

void App::draw_column(ImVec2 at, ImVec2 size, const Pane& upper, const Pane& lower, float& share, const char* id) {
  const float gap = std::round(ui_.em * 0.35f), first = std::round((size.y - gap) * share);
  draw_pane(upper, at, {size.x, first});
  draw_pane(lower, {at.x, at.y + first + gap}, {size.x, size.y - first - gap});
  splitter(id, {at.x, at.y + first}, {size.x, gap}, false, share, size.y - gap);
}

namespace {

const char* what_a_click_does(bool two_runs, bool leading, bool asked_for) {
  if (two_runs) return asked_for ? "Click: back to its usual place." : "Click: first in this row.";
  if (asked_for) return "Click: the stage as the method has it.";
  return leading ? "Click: this pane alone on the stage." : "Click: large, on the stage.";
}

}  // namespace

/// A pane of the stage. A click on its title makes it lead, and a second one puts it back; a sign says which it is.
void App::draw_on_stage(const Pane& pane, ImVec2 goal, ImVec2 goal_size, bool leading) {
  const auto [at, size] = motion_.of_pane(pane.id, {goal, goal_size});
  draw_pane(pane, at, size);
  const float head = std::round(ui_.em * 1.5f), pad = std::round(ui_.em * 0.5f), side = std::round(ui_.em * 0.45f);
  const float x = at.x + 2 * pad + text_size(ui_, ui_.fonts.small, pane.title).x;
  ImGui::SetCursorScreenPos(at);
  ImGui::PushID(pane.id);
  const bool asked_for = pane.id == lead() || lead_together(pane, lead());
  if (ImGui::InvisibleButton("lead", {size.x, head})) set_lead(asked_for ? "" : pane.id);
  ImGui::PopID();
  const bool hot = ImGui::IsItemHovered();
  if (hot)
    ui_.mouse_help = std::string(what_a_click_does(against_.has_value(), leading, asked_for)) + " Tab: the next pane.";
  if (x + side + pad > at.x + size.x) return;
  const Theme& c = ui_.colors();
  const float y = at.y + std::round((head - side) / 2);
  const ImU32 color = hot ? c.now : c.muted;
  if (leading) ImGui::GetWindowDrawList()->AddRectFilled({x, y}, {x + side, y + side}, color);
  else frame_box(ui_, {x, y}, {x + side, y + side}, color);
}

void App::draw_leading(const std::vector<Pane>& leading, ImVec2 at, ImVec2 size) {
  const float gap = std::round(ui_.em * 0.35f);
  stage_at_ = {at, size}, leading_ = leading;
  if (leading.size() == 1) return draw_on_stage(leading[0], at, size, true);
  // A chart that has nothing to show leaves its room to the other, but for its title.
  const bool charts = std::all_of(leading.begin(), leading.end(), [](const Pane& pane) { return pane.wide; });
  const auto empty = std::find_if(leading.begin(), leading.end(),
                                  [&](const Pane& pane) { return charts && pane.waits && pane.waits(ui_); });
  if (empty != leading.end() && leading.size() == 2) {
    const Pane& other = leading[empty == leading.begin() ? 1 : 0];
    const float head = std::round(ui_.em * 1.5f), upper = size.y - head - gap;
    if (!other.waits || !other.waits(ui_)) {
      draw_on_stage(other, at, {size.x, upper}, true);
      return draw_on_stage(*empty, {at.x, at.y + upper + gap}, {size.x, head}, true);
    }
  }
  // A table needs less room than a picture.
  const bool table = leading[1].scrolls && !leading[0].scrolls;
  float& share = table ? settings_.layout.table : settings_.layout.frame;
  const float first = std::round((size.x - gap) * share), x = at.x + first + gap, second = size.x - first - gap;
  draw_on_stage(leading[0], at, {first, size.y}, true);
  const float upper = leading.size() == 2 ? size.y : std::round((size.y - gap) / 2);
  draw_on_stage(leading[1], {x, at.y}, {second, upper}, true);
  if (leading.size() == 3) draw_on_stage(leading[2], {x, at.y + upper + gap}, {second, size.y - upper - gap}, true);
  splitter("frame", {at.x + first, at.y}, {gap, size.y}, true, share, size.x - gap);
}

/// Titles below each other: of panes that nothing has come to yet, and of those for which there is no room.
void App::draw_folded(const std::vector<Pane>& panes, ImVec2 at, ImVec2 size) {
  const float head = std::round(ui_.em * 1.5f), pad = std::round(ui_.em * 0.5f);
  ImDrawList* list = ImGui::GetWindowDrawList();
  for (const Pane& pane : panes) {
    if (at.y + head > size.y) return;
    motion_.of_pane(pane.id, {at, {size.x, head}});  // from where it sets out when it unfolds
    ImGui::SetCursorScreenPos(at);
    ImGui::PushID(pane.id);
    if (ImGui::InvisibleButton("lead", {size.x, head})) set_lead(pane.id);
    ImGui::PopID();
    const bool hot = ImGui::IsItemHovered();
    if (hot)
      ui_.mouse_help = pane.waits && pane.waits(ui_)
                           ? "Empty: the run has not come to it yet. Click: shown all the same."
                           : "No room for it here. Click: large, on the stage.";
    list->AddRectFilled(at, {at.x + size.x, at.y + head}, ui_.colors().head);
    draw_text(ui_, {at.x + pad, at.y + std::round((head - ui_.fonts.small->FontSize) / 2) - 1}, ui_.fonts.small,
              hot ? ui_.colors().text : ui_.colors().muted, pane.title);
    frame_box(ui_, at, {at.x + size.x, at.y + head}, ui_.colors().rule);
    at.y += head + std::round(ui_.em * 0.2f);
  }
}

/// A row of small panes. What would be too narrow to read, or is empty so far, is folded to its title at the right.
void App::draw_small(std::vector<Pane> panes, ImVec2 at, ImVec2 size) {
  const float gap = std::round(ui_.em * 0.35f), narrowest = ui_.em * 11;
  std::vector<Pane> folded;
  const auto fold = [&](auto which) {
    folded.insert(folded.begin(), *which);
    panes.erase(which);
  };
  for (auto pane = panes.end(); pane != panes.begin();)
    if (--pane; pane->waits && pane->waits(ui_)) fold(pane), pane = panes.end();
  float titles = 0;
  const auto titled = [&](const std::vector<Pane>& all) {
    float widest = 0;
    for (const Pane& pane : all) widest = std::max(widest, text_size(ui_, ui_.fonts.small, pane.title).x + ui_.em);
    return all.empty() ? 0 : std::round(widest) + gap;
  };
  const auto weight = [&](const Pane& pane) {
    const auto found = settings_.layout.structures.find(pane.id);
    return found == settings_.layout.structures.end() ? std::max(pane.share, 0.25f) : found->second;
  };
  const auto all_weights = [&] {
    float sum = 0;
    for (const Pane& pane : panes) sum += weight(pane);
    return sum;
  };
  // As wide as they can be read, all of them together and a table by itself.
  const auto too_narrow = [&] {
    const float width = size.x - titles, sum = all_weights();
    return width / to_float(panes.size()) < narrowest || std::any_of(panes.begin(), panes.end(), [&](const Pane& pane) {
             return !settings_.layout.structures.contains(pane.id) && width * weight(pane) / sum < 8 * ui_.em;
           });
  };
  while (titles = titled(folded), !panes.empty() && too_narrow()) fold(panes.end() - 1);
  if (!folded.empty()) draw_folded(folded, {at.x + size.x - titles + gap, at.y}, {titles - gap, at.y + size.y});
  if (panes.empty()) return;
  const float end = at.x + size.x - titles;
  const float room = end - at.x - gap * to_float(panes.size() - 1);
  const float sum = all_weights();
  float x = at.x;
  for (std::size_t i = 0; i < panes.size(); ++i) {
    const float width = i + 1 == panes.size() ? end - x : std::round(room * weight(panes[i]) / sum);
    draw_on_stage(panes[i], {x, at.y}, {width, size.y}, false);
    x += width;
    if (i + 1 == panes.size()) break;
    float share = weight(panes[i]);
    if (splitter(fmt::format("structure{}", i).c_str(), {x, at.y}, {gap, size.y}, true, share, room / sum)) {
      // What one gains its neighbour loses.
      const float total = weight(panes[i]) + weight(panes[i + 1]);
      share = std::clamp(share, 0.08f, std::max(0.08f, total - 0.08f));
      settings_.layout.structures[panes[i].id] = share;
      settings_.layout.structures[panes[i + 1].id] = std::max(0.08f, total - share);
    }
    x += gap;
  }
}

/// How high a frame as wide as this is, with its title and its numbers along the sides.
float App::frame_height(float width) const {
  const Raster& raster = session_.scene().raster;
  const Rulers rulers = room_for_rulers(ui_, raster);
  const ImVec2 pad = ImGui::GetStyle().WindowPadding;
  const float picture =
      (width - 2 * pad.x - rulers.left) * to_float(raster.height) / to_float(std::max(1, raster.width));
  return std::round(ui_.em * 1.5f + 2 * pad.y + picture + rulers.below + (ui_.presenter ? 0 : legend_height(ui_)));
}

/// What a lesson's layout says of the step: its formula, between stops also its sentence, and the lines of code around
/// it.
std::vector<Pane> App::words_of_step() {
  const bool nothing_to_say = session_.message.empty();
  if (viewing_step(ui_) > 0 && nothing_to_say) return {};  // the picture has its matrices
  const RecordedEvent *event = session_.event(), *told = session_.event_told();
  const bool stop_tells = session_.speaks() && nothing_to_say && !has_causes();
  const bool tells = !stop_tells || (told && !explain(session_.trace(), session_.state(), *told).formulas.empty());
  std::vector<Pane> words;
  if (tells && !(session_.at_rest() && nothing_to_say)) words.push_back(happened_pane);
  if (event && find_step(session_.header().page, event->step)) words.push_back(pseudo_code_pane);
  return words;
}

/// Below each other: the first has all the room that those after it leave, each of which is as high as its text. What
/// there is no room for is left out, but for what is said nowhere else; code and formulas have fewer lines first.
void App::draw_words(std::vector<Pane> panes, ImVec2 at, ImVec2 size) {
  const float gap = std::round(ui_.em * 0.35f), around = ui_.em * 1.5f + 2 * ImGui::GetStyle().WindowPadding.y;
  const float guess = 4 * ui_.line();
  const auto height = [&](const Pane& pane) {
    return std::ceil(around + ui_.text_heights.try_emplace(pane.id, Ui::TextHeight{guess, 0}).first->second.height);
  };
  const std::size_t kept = session_.speaks() && session_.message.empty() ? 1 : 2;
  float left = size.y - height(panes[0]), below = 0;
  std::vector<float> heights;
  for (std::size_t k = 1; k < panes.size(); ++k) {
    const bool code = panes[k].id == pseudo_code_pane.id, must = k < kept;
    const float room = must ? std::round(size.y * 0.55f) : std::floor(left - gap);
    float whole = height(panes[k]);
    Ui::TextHeight& text = ui_.text_heights[panes[k].id];
    text.gone = 0;
    // A pane not yet measured at this moment is tried: whether it is shown must not depend on what was shown before.
    if (text.moment != ui_.read_now()) {
      whole = std::min(whole, around + guess);
    } else if (!must && whole > room) {
      const float for_code = k + 1 < panes.size() ? gap + around + 3 * ui_.line() : 0;
      whole = std::ceil(around + text.fit(room - for_code - around));
    }
    if (!must && room < (code ? around + 3 * ui_.line() : whole)) {
      panes.erase(panes.begin() + static_cast<std::ptrdiff_t>(k--));
      continue;
    }
    const float its = std::min(whole, room);
    heights.push_back(its), left -= its + gap, below += its + gap;
  }
  draw_pane(panes[0], at, {size.x, size.y - below});
  at.y += size.y - below + gap;
  for (std::size_t k = 1; k < panes.size(); at.y += heights[k - 1] + gap, ++k)
    draw_pane(panes[k], at, {size.x, heights[k - 1]});
}

namespace {

/// A run of another scene, whose picture is not held against the lesson's own.
bool stands_alone(const std::vector<RunBeside>& runs, std::string_view lead) {
  return runs.size() == 1 && !runs[0].file.empty() && !lead.empty();
}

/// Two runs of another scene, in place of the lesson's own.
bool shows_others_alone(const std::vector<RunBeside>& runs) {
  return runs.size() == 2 && !runs[0].file.empty() && !runs[1].file.empty();
}

}  // namespace

/// The runs whose pictures the stop of the lesson shows, one beside its own, or two instead of it: slices at this
/// moment, rays where this pixel is done, scenes before anything is at work, all else at the end.
std::vector<Ui*> App::runs_beside() {
  const Lesson* lesson = session_.lesson();
  static const std::vector<RunBeside> none;
  const std::vector<RunBeside>& shown = lesson && session_.stop() >= 0 ? lesson->stops[session_.stop()].beside : none;
  const bool rays = lead() == ray_plan_pane.id, here = rays || lead() == slice_pane.id,
             before = lead() == scene_pane.id;
  Whereabouts moment = moment_of(session_);
  if (rays) moment.selected = session_.cell_looked_at(false);
  beside_.resize(shown.size());
  std::vector<Ui*> looks;
  for (std::size_t k = 0; k < shown.size(); ++k) {
    std::unique_ptr<Beside>& one = beside_[k];
    if (!one || &one->session.trace() != shown[k].run.get()) one = std::make_unique<Beside>(*shown[k].run, renderer_);
    const std::int64_t of = here ? session_.position() : before ? -1 : -2;
    if (std::exchange(one->of, of) != of)
      one->session.go_to(here ? moment_in(*shown[k].run, moment).step : before ? 0 : shown[k].run->size());
    one->ui.asks = false, one->ui.still = !here, one->ui.laboratory = !stands_alone(shown, lead());
    one->ui.marked_depths =
        session_.question_open() ? std::vector<double>() : lesson->stops[session_.stop()].marked_depths;
    looks.push_back(&one->ui);
    share_look(one->ui);
  }
  return looks;
}

void App::draw_runs_beside(ImVec2 at, ImVec2 first, ImVec2 second_at, ImVec2 second) {
  const std::vector<Ui*> others = runs_beside();
  const std::vector<RunBeside>& runs = session_.lesson()->stops[session_.stop()].beside;
  const bool alone = stands_alone(runs, lead());
  const std::vector<Pane> panes = stage_panes((alone ? others[0]->session : session_).header());
  const auto led = std::find_if(panes.begin(), panes.end(), [&](const Pane& one) { return one.id == lead(); });
  const Pane& pane = led == panes.end() ? frame_pane : *led;
  leading_ = {pane};
  const std::string when = pane.id == slice_pane.id || pane.id == ray_plan_pane.id ? ", HERE"
                           : pane.id == scene_pane.id                              ? ""
                                                                                   : ", AT ITS END";
  const auto draw = [&](std::size_t k, ImVec2 place, ImVec2 size) {
    const float room = std::floor(size.x) - std::ceil(1.1f * ui_.em);
    std::string title = fmt::format("ANOTHER RUN{}: {}", when, runs[k].name());
    if (text_size(ui_, ui_.fonts.small, title).x > room) title = fitted(ui_, ui_.fonts.small, runs[k].name(), room);
    draw_beside(*others[k], pane, title, place, size);
  };
  if (alone) return draw(0, at, {second_at.x + second.x - at.x, second.y});
  if (others.size() == 1) draw_on_stage(pane, at, first, true);
  else draw(0, at, first);
  draw(others.size() - 1, second_at, second);
}

/// A lesson, and whatever is shown to a class: one large picture, or two that belong together, and beside it what the
/// lesson says, or without one what happens, with the formula and the few lines of code that matter now. Two pictures
/// are as high as their frame needs, and have the formula and the code below them. The drawer stands where the words
/// stand, so that the pictures stay where they are.
void App::draw_lesson_layout(ImVec2 at, ImVec2 size) {
  constexpr float low_row = 11;  // in em
  std::vector<Pane> leading = lesson_pictures(session_.header(), lead()), said = words_of_step();
  const bool other = !runs_beside().empty();
  const bool alone = other && stands_alone(session_.lesson()->stops[session_.stop()].beside, lead());
  const bool of_others = alone || (other && shows_others_alone(session_.lesson()->stops[session_.stop()].beside));
  if (other) leading = std::vector<Pane>(alone ? 1 : 2, lead().empty() ? frame_pane : leading[0]);
  else if (drawer_ != Drawer::none) keep_frame(ui_, leading);
  float& share = settings_.layout.lesson;
  share = std::clamp(share, 0.15f, 0.45f);
  // Beside one picture stand formula and code, too.
  const float gap = std::round(ui_.em * 0.35f), larger = ui_.presenter ? 0.07f : leading.size() == 1 ? 0.03f : 0;
  float words = std::round(size.x * (share + larger));
  if (drawer_ != Drawer::none)
    words = std::max(words, std::min(std::round(page_of(drawer_)->least.x * ui_.em), std::round(size.x * 0.5f)));
  const float x = at.x + size.x - words;
  ImVec2 stage{size.x - words - gap, size.y};
  if (leading.size() > 1) {
    constexpr float least = 0.451f;  // of the window
    const float window = to_float(renderer_.width()) * to_float(renderer_.height());
    const float needed =
        std::max(frame_height((stage.x - gap) / 2) - std::round(0.8f * ui_.em), std::ceil(least * window / stage.x));
    if (size.y - needed >= 7.5f * ui_.em) stage.y = needed;
  }
  if (other) {
    const float first = std::round((stage.x - gap) * settings_.layout.frame);
    draw_runs_beside(at, {first, stage.y}, {at.x + first + gap, at.y}, {stage.x - first - gap, stage.y});
    stage_at_ = {at, stage};
    if (of_others) said.clear();  // of this run's step
  } else {
    draw_leading(leading, at, stage);
  }
  if (stage.y < size.y) {
    const ImVec2 row{stage.x, size.y - stage.y - gap};
    std::vector<Pane> below = said;
    said.clear();
    // Where the row is low a formula has all of its width, and the code stands below the lesson, if that leaves it
    // room.
    const Ui::TextHeight& text = ui_.text_heights[lesson_pane.id];
    const float code = 2 * (1.5f * ui_.em + 2 * ImGui::GetStyle().WindowPadding.y) + gap + 3 * ui_.line();
    const bool has_room = text.moment != ui_.read_now() || text.height + code <= size.y;
    if (session_.lesson() && drawer_ == Drawer::none && has_room && below.size() == 2 && row.y < low_row * ui_.em)
      said.push_back(below.back()), below.pop_back();
    const float width = (row.x - gap * to_float(below.size() - 1)) / to_float(std::max<std::size_t>(1, below.size()));
    ImVec2 place{at.x, at.y + stage.y + gap};
    const float inner = row.y - 1.5f * ui_.em - 2 * ImGui::GetStyle().WindowPadding.y;
    for (const Pane& pane : below) {
      Ui::TextHeight& its = ui_.text_heights[pane.id];
      its.gone = 0;
      if (its.moment == ui_.read_now() && its.height > inner) its.fit(inner);
    }
    for (const Pane& pane : below) draw_pane(pane, place, {width, row.y}), place.x += width + gap;
  }
  float others = 1 - share - larger;
  if (splitter("lesson", {x - gap, at.y}, {gap, size.y}, true, others, size.x)) share = 1 - others - larger;
  if (session_.lesson()) said.insert(said.begin(), lesson_pane);
  else if (said.empty() || said[0].id != happened_pane.id) said.insert(said.begin(), happened_pane);
  ImVec2 place{x, at.y}, room{words, size.y};
  if (drawer_ != Drawer::none) {
    // Words that wait for an answer stay, above it.
    const float kept = session_.question_open() ? std::round(size.y * 0.5f) : 0;
    drawer_at_ = {{x, at.y + kept}, {words, size.y - kept}};
    if (kept == 0) return;
    room.y = kept - gap;
  }
  draw_words(std::move(said), place, room);
}

void App::draw_panes(ImVec2 at, ImVec2 size) {
  if (against_) return draw_panes_of_both(at, size);
  if (embedded()) return draw_embedded(at, size);
  if (!ui_.laboratory) return draw_lesson_layout(at, size);
  Layout& l = settings_.layout;
  const float gap = std::round(ui_.em * 0.35f);
  const float left = std::round(size.x * l.left), x = at.x + left + gap;
  float right = session_.lesson() ? std::round(size.x * l.right) : 0;
  ImVec2 all{at.x + size.x - x - (right > 0 ? right + gap : 0), size.y};  // of stage and small panes
  Workspace stage = stage_of(ui_, lead());
  // What a lesson asks to be tried stands in the drawer itself: there it has the lesson's place.
  const bool for_lesson = drawer_ == Drawer::what_if && right > 0;
  const Docked dock = docked(size, {all.x + (for_lesson ? right + gap : 0), all.y}, all, stage.leading.size());
  if (dock.side == Docked::Side::beside) {
    if (for_lesson) all.x += right + gap, right = 0;
    all.x -= dock.room + gap;
    drawer_at_ = {{x + all.x + gap, at.y}, {dock.room, size.y}};
  } else if (dock.side == Docked::Side::below) {
    all.y -= dock.room + gap;
    drawer_at_ = {{at.x, at.y + all.y + gap}, {left + gap + all.x, dock.room}};
  }
  draw_column(at, {left, all.y}, pseudo_code_pane, happened_pane, l.code, "code");
  splitter("left", {at.x + left, at.y}, {gap, all.y}, true, l.left, size.x);
  const bool small = dock.side != Docked::Side::below;
  if (small) {
    const float upper = std::round((all.y - gap) * l.stage);
    draw_small(stage.small, {x, at.y + upper + gap}, {all.x, all.y - upper - gap});
    draw_leading(stage.leading, {x, at.y}, {all.x, upper});  // over what makes room for it
    splitter("stage", {x, at.y + upper}, {all.x, gap}, false, l.stage, all.y - gap);
  } else {
    keep_frame(ui_, stage.leading);
    draw_leading(stage.leading, {x, at.y}, all);
  }
  if (drawer_ != Drawer::none) pull_drawer(dock, size);
  if (right > 0) {
    const float lesson = at.x + size.x - right;
    draw_pane(lesson_pane, {lesson, at.y}, {right, size.y});
    float others = 1 - l.right;
    if (splitter("right", {lesson - gap, at.y}, {gap, size.y}, true, others, size.x)) l.right = 1 - others;
  }
  l.right = std::clamp(l.right, 0.1f, 0.5f);
  l.left = std::clamp(l.left, 0.1f, 0.55f);
}

std::vector<Pane> App::all_panes(const Header& header, bool with_lesson) {
  std::vector<Pane> all = stage_panes(header);
  all.insert(all.end(), {pseudo_code_pane, happened_pane});
  if (with_lesson) all.insert(all.end(), {lesson_pane, chart_pane});
  return all;
}

bool App::show_only(const std::string& pane) {
  for (const Pane& candidate : all_panes(session_.header(), session_.lesson() != nullptr))
    if (candidate.id == pane) only_ = candidate;
  return only_ && only_->id == pane;
}

}  // namespace zstep::viewer
