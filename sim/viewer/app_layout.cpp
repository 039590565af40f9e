// Where the panes are, with their borders.
#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "sim/viewer/app.hpp"

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
  const std::string note =
      pane.note && (!ui_.presenter || session_.looking_back || pane.id == lesson_pane.id) ? pane.note(ui) : "";
  const float note_width = text_size(ui_, font, note).x;
  if (!note.empty() && title_width + note_width + 3 * pad + ui_.em <= size.x)
    draw_text(ui_, {at.x + size.x - pad - note_width, y}, font, session_.looking_back ? c.now : c.muted, note);
  const float body = size.y - head;
  if (body >= 8 && size.x >= 8) {
    ImGui::SetCursorScreenPos({at.x, at.y + head});
    const ImGuiWindowFlags flags = ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_AlwaysUseWindowPadding |
                                   ImGuiWindowFlags_NoNav |
                                   (pane.scrolls ? ImGuiWindowFlags_HorizontalScrollbar
                                                 : ImGuiWindowFlags_NoScrollbar | ImGuiWindowFlags_NoScrollWithMouse);
    const bool wraps = pane.id == lesson_pane.id || pane.id == happened_pane.id || pane.id == pseudo_code_pane.id;
    if (wraps ? begin_wrapped(ui, pane.id, {size.x, body}, flags)
              : ImGui::BeginChild(pane.id, {size.x, body}, false, flags)) {
      // Where a pane is scrolled to follows from what it shows, not from what it showed before.
      if (pane.id == lesson_pane.id ? ui_.speaks_now : ui_.scroll_now) ImGui::SetScrollX(0), ImGui::SetScrollY(0);
      pane.draw(ui);
    }
    ImGui::EndChild();
  }
  frame_box(ui_, at, {at.x + size.x, at.y + size.y}, c.rule);
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
  session_.touch();
  return true;
}

void App::draw_column(ImVec2 at, ImVec2 size, const Pane& upper, const Pane& lower, float& share, const char* id) {
  const float gap = std::round(ui_.em * 0.35f), first = std::round((size.y - gap) * share);
  draw_pane(upper, at, {size.x, first});
  draw_pane(lower, {at.x, at.y + first + gap}, {size.x, size.y - first - gap});
  splitter(id, {at.x, at.y + first}, {size.x, gap}, false, share, size.y - gap);
}

void App::draw_structures(ImVec2 at, ImVec2 size) {
  const float gap = std::round(ui_.em * 0.35f);
  // A pane that would be too narrow to read is left out until there is room. The last pane, the scene, always stays,
  // unless a plan of the scene does.
  std::vector<Pane> shown = structures_;
  // Beside the frame is the second run's then.
  if (against_ && beside_.id != depth_pane.id) shown.insert(shown.begin(), beside_);
  if (ui_.slice && slice_pane.serves(session_.header())) {
    // The slice is wide: of the others one stays, the active edges where there are such.
    const auto beside = std::find_if(shown.begin(), shown.end(),
                                     [](const Pane& pane) { return pane.id == active_edges_pane.id; });
    const Pane kept = beside == shown.end() ? shown.front() : *beside;
    shown = {slice_pane};
    if (kept.id != scene_pane.id) shown.insert(shown.begin(), kept);
  }
  // Two charts are all that there is room for; where there is not, the errors stay.
  const bool charts = ui_.error_charts && depth_error_pane.serves(session_.header());
  if (charts) {
    shown = {depth_error_pane};
    if (depth_units_pane.serves(session_.header()) && size.x > 40 * ui_.em) shown.push_back(depth_units_pane);
  }
  const auto narrowest = [&] { return ui_.em * 11; };
  if (ui_.presenter) {
    // A class needs one of the two: the table while it fills, the active edges once scan lines are drawn.
    const bool scanning = session_.state().machine.scan_line.has_value();
    shown.erase(std::remove_if(shown.begin(), shown.end(),
                               [&](const Pane& pane) {
                                 return pane.id == (scanning ? edge_table_pane.id : active_edges_pane.id);
                               }),
                shown.end());
  }
  const bool planned = std::any_of(shown.begin(), shown.end(), [](const Pane& pane) {
    return pane.id == ray_plan_pane.id || pane.id == plan_pane.id;
  });
  const auto too_many = [&] { return shown.size() > 1 && size.x / static_cast<float>(shown.size()) < narrowest(); };
  if (planned && too_many()) shown.pop_back();
  while (too_many()) shown.erase(shown.end() - 2);
  if (shown.empty()) return;
  const float room = size.x - gap * static_cast<float>(shown.size() - 1);
  const auto weight = [&](const Pane& pane) {
    const auto found = settings_.layout.structures.find(pane.id);
    return found == settings_.layout.structures.end() ? pane.share : found->second;
  };
  float sum = 0;
  for (const Pane& pane : shown) sum += weight(pane);
  float x = at.x;
  for (std::size_t i = 0; i < shown.size(); ++i) {
    const float width = i + 1 == shown.size() ? at.x + size.x - x : std::round(room * weight(shown[i]) / sum);
    draw_pane(shown[i], {x, at.y}, {width, size.y});
    x += width;
    if (i + 1 == shown.size()) break;
    float share = weight(shown[i]);
    if (splitter(fmt::format("structure{}", i).c_str(), {x, at.y}, {gap, size.y}, true, share, room / sum)) {
      // What one gains its neighbour loses.
      const float total = weight(shown[i]) + weight(shown[i + 1]);
      share = std::clamp(share, 0.08f, std::max(0.08f, total - 0.08f));
      settings_.layout.structures[shown[i].id] = share;
      settings_.layout.structures[shown[i + 1].id] = std::max(0.08f, total - share);
    }
    x += gap;
  }
}

/// The size of pane that shows the framebuffer as large as small letters would. Title, borders, rulers and legend take
/// their room from the raster, and all of them grow with the letters.
ImVec2 App::presented_frame() const {
  const Layout& l = settings_.layout;
  const Raster& raster = session_.scene().raster;
  const bool lesson = session_.lesson() != nullptr;
  const float digits = static_cast<float>(std::to_string(std::max(raster.width, raster.height) - 1).size());
  const auto around = [&](float em, bool legend) {
    return ImVec2{em * (1.9f + 0.46f * digits), em * (3.15f + (legend ? 1.0f : 0.0f))};
  };
  const float em = ui_.em * 16 / 24, gap = em * 0.35f;
  const float width = static_cast<float>(renderer_.width()) - 0.8f * em,
              height = static_cast<float>(renderer_.height()) - em * 8.05f;
  const float left = width * (lesson ? l.left * 0.94f : l.left), right = lesson ? width * l.right + gap : 0;
  const ImVec2 usual{(width - left - gap - right - gap) * l.frame - around(em, true).x,
                     (structures_.empty() ? height : (height - gap) * l.buffers) - around(em, true).y};
  // A little more, for pixels are rounded down to quarters.
  const float cell =
      1.03f * std::min(usual.x / static_cast<float>(raster.width), usual.y / static_cast<float>(raster.height));
  const ImVec2 now = around(ui_.em, false);
  return {std::ceil(cell * static_cast<float>(raster.width) + now.x),
          std::ceil(cell * static_cast<float>(raster.height) + now.y)};
}

void App::draw_panes(ImVec2 at, ImVec2 size) {
  if (against_) return draw_panes_of_both(at, size);
  Layout& l = settings_.layout;
  const float gap = std::round(ui_.em * 0.35f);
  // Presenter mode has larger letters and fewer words.
  const bool narrow = size.x < ui_.em * (ui_.presenter ? 40 : 44) || size.y < ui_.em * 21;
  if (narrow) {
    // Too small for everything: what happened and the framebuffer, and a sentence that says so.
    const float line = ui_.line();
    Flow how;
    how.color = ui_.colors().muted;
    ImGui::SetCursorScreenPos(at);
    const std::string why = "Only some panes fit; enlarge the window, or Ctrl+\u2212 for smaller text.";
    how.width = size.x;
    const float height = flow_height(ui_, why, how);
    if (size.y > height + 6 * line) {
      flow(ui_, why, how);
      at.y += height;
      size.y -= height;
    }
    if (size.x > size.y * 1.3f) {
      const float half = std::round((size.x - gap) / 2);
      draw_pane(session_.lesson() ? lesson_pane : happened_pane, at, {half, size.y});
      draw_pane(frame_pane, {at.x + half + gap, at.y}, {size.x - half - gap, size.y});
    } else {
      const float half = std::round((size.y - gap) / 2);
      draw_pane(frame_pane, at, {size.x, half});
      draw_pane(session_.lesson() ? lesson_pane : happened_pane, {at.x, at.y + half + gap},
                {size.x, size.y - half - gap});
    }
    return;
  }
  // With a lesson there is a column more, and the code gives way a little.
  const float shared = std::round(size.x * (session_.lesson() ? l.left * 0.94f : l.left));
  // While a class answers a question, the question and all its answers take the place of the code.
  const bool asks = ui_.presenter && session_.question_open();
  const float left = asks ? 0 : shared;
  float right = session_.lesson() ? std::round(size.x * l.right) : 0;
  if (asks) right += std::round(shared * 0.6f);
  const float x = at.x + (asks ? 0 : left + gap);
  const float middle = at.x + size.x - x - (right > 0 ? right + gap : 0);
  float upper = structures_.empty() ? size.y : std::round((size.y - gap) * l.buffers),
        frame = std::round((middle - gap) * l.frame);
  if (ui_.presenter) {
    // The framebuffer is at least as large as with small letters; what is beside and below it has the rest, but never
    // nothing.
    const ImVec2 needed = presented_frame();
    frame = std::clamp(needed.x, frame, std::max(frame, middle - gap - ui_.em * 9));
    if (!structures_.empty()) upper = std::clamp(needed.y, upper, std::max(upper, size.y - gap - ui_.em * 5));
    // A slice and a chart need some height.
    if ((ui_.slice || ui_.error_charts) && !structures_.empty())
      upper = std::clamp(size.y - gap - ui_.em * 10, size.y / 3, upper);
  }
  if (!asks) {
    // Room for a class to read all of what happened: a sentence of two lines and a formula of five.
    float code = ui_.presenter ? std::min(l.code, 1 - std::min(0.5f, ui_.em * 11 / size.y)) : l.code;
    const float code_before = code;
    draw_column(at, {left, size.y}, pseudo_code_pane, happened_pane, code, "code");
    if (code != code_before) l.code = code;
    splitter("left", {at.x + left, at.y}, {gap, size.y}, true, l.left, size.x);
  }
  draw_pane(frame_pane, {x, at.y}, {frame, upper});
  draw_pane(beside_, {x + frame + gap, at.y}, {middle - frame - gap, upper});
  splitter("frame", {x + frame, at.y}, {gap, upper}, true, l.frame, middle - gap);
  if (!structures_.empty()) {
    draw_structures({x, at.y + upper + gap}, {middle, size.y - upper - gap});
    splitter("buffers", {x, at.y + upper}, {middle, gap}, false, l.buffers, size.y - gap);
  }
  if (right > 0) {
    draw_pane(lesson_pane, {x + middle + gap, at.y}, {right, size.y});
    float others = 1 - l.right;
    if (splitter("right", {x + middle, at.y}, {gap, size.y}, true, others, size.x)) l.right = 1 - others;
  }
  l.right = std::clamp(l.right, 0.1f, 0.5f);
  l.left = std::clamp(l.left, 0.1f, 0.55f);
}

std::vector<Pane> App::all_panes(const Header& header, bool with_lesson) {
  std::vector<Pane> all{frame_pane, pseudo_code_pane, happened_pane};
  if (depth_pane.serves(header)) all.insert(all.begin() + 1, depth_pane);
  for (const Pane& pane : structure_panes(header)) all.push_back(pane);
  for (const Pane* pane : {&slice_pane, &depth_error_pane, &depth_units_pane})
    if (pane->serves(header)) all.push_back(*pane);
  if (with_lesson) all.push_back(lesson_pane);
  return all;
}

bool App::show_only(const std::string& pane) {
  for (const Pane& candidate : all_panes(session_.header(), session_.lesson() != nullptr))
    if (candidate.id == pane) only_ = candidate;
  session_.touch();
  return only_ && only_->id == pane;
}

}  // namespace zstep::viewer
