// What is marked: what check found in the run, or how a second run beside it differs.
#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "sim/viewer/app.hpp"
#include "sim/words/numbers.hpp"

namespace zstep::viewer {

void App::show_findings(const CheckedRun& checked) {
  findings_.emplace(session_.trace(), checked);
  ui_.findings = &*findings_;
  ui_.marks = &*findings_;
  session_.touch();
}

void App::show_against(const AgainstRun& with) {
  against_.emplace(session_, with);
  opens_at_cause_ = with.at_first_cause;
  other_ui_ = std::make_unique<Ui>(against_->session(), renderer_);
  other_ui_->asks = false;
  ui_.other = other_ui_.get();
  ui_.marks = &against_->marks_of_a();
  other_ui_->marks = &against_->marks_of_b();
  session_.touch();
}

void App::to_first_cause() {
  if (against_) {
    against_->go_to({0, 0});
    if (const auto place = against_->next_cause(1)) against_->go_to(*place);
  } else {
    session_.go_to(0);
    if (ui_.marks && !ui_.marks->causes().empty()) to_cause(1);
  }
}

void App::to_cause(int direction) {
  if (!ui_.marks)
    return say("Nothing was checked: zstep check FILE --view opens a run with what is wrong in it marked.");
  const char* none = direction > 0 ? "There is no later cause." : "There is no earlier cause.";
  if (ui_.marks->causes().empty()) return say(against_ ? "The two runs do not part." : "Nothing is wrong.");
  if (against_) {
    const auto place = against_->next_cause(direction);
    return place ? against_->go_to(*place) : say(none);
  }
  std::optional<std::int64_t> best;
  for (const std::int64_t step : ui_.marks->causes())
    if (direction > 0 ? step > session_.position() && (!best || step < *best)
                      : step < session_.position() && (!best || step > *best))
      best = step;
  if (best) session_.go_to(*best);
  else say(none);
}

void App::to_marked(int direction) {
  if (against_) {
    const auto place = against_->next_difference(direction);
    return place ? against_->go_to(*place)
                 : say(direction > 0 ? "There is no later difference." : "There is no earlier difference.");
  }
  if (!findings_)
    return say(
        "Nothing was checked or compared: zstep check FILE --view does, or zstep view FILE.ztrace --against FILE.ztrace.");
  const auto step = findings_->next_marked(session_.position(), direction);
  if (step) session_.go_to(*step);
  else say(direction > 0 ? "No later step is marked." : "No earlier step is marked.");
}

void App::to_pixel_apart() {
  if (!against_) return say("There is no second run: zstep view FILE.ztrace --against FILE.ztrace shows two.");
  const auto& found = against_->first_pixel_apart();
  if (!found) return say("The pictures of both runs are the same at the end.");
  if (found->place) against_->go_to(*found->place);
  session_.select(found->cell);
  say(fmt::format("Pixel ({}, {}) is the first from the top that differs at the end{}.", found->cell.x, found->cell.y,
                  found->place ? "; here the runs first part at it" : ""));
}

/// What is marked at this moment; the second run comes to it.
void App::follow_marks() {
  ui_.pixel_marks = nullptr;
  if (findings_ && !session_.looking_back)
    ui_.pixel_marks = &findings_->pixels(session_.position(), session_.state().machine.pass == Pass::light);
  if (!against_) return;
  against_->follow();
  against_->session().looking_back = session_.looking_back;
  if (!session_.looking_back) ui_.pixel_marks = &against_->pixels();
  Ui& b = *other_ui_;
  b.fonts = ui_.fonts;
  b.theme = ui_.theme;
  b.depth_range = ui_.depth_range, b.range_mode = ui_.range_mode, b.hand_range = ui_.hand_range;
  b.histogram = ui_.histogram;
  b.em = ui_.em, b.thin = ui_.thin, b.presenter = ui_.presenter, b.reads = ui_.reads;
  b.view = ui_.view;
  b.pointed = ui_.pointed;
  b.scroll_now = ui_.scroll_now;
  b.pixel_marks = ui_.pixel_marks;
}

/// A pane of either run. What a reader does in the second one's, zooming and selecting, both take.
void App::draw_of(bool first, const Pane& pane, ImVec2 at, ImVec2 size) {
  const std::string title = fmt::format("{}: {}", first ? "A" : "B", pane.title);
  if (first) return draw_pane(ui_, pane, title, at, size);
  Ui& b = *other_ui_;
  Session& session = against_->session();
  const std::uint64_t revision = session.revision();
  b.mouse_help.clear();
  b.pointed_next.reset();
  b.view = ui_.view;
  ImGui::PushID("second run");
  draw_pane(b, pane, title, at, size);
  ImGui::PopID();
  if (!b.mouse_help.empty()) ui_.mouse_help = b.mouse_help;
  if (b.pointed_next) ui_.pointed_next = b.pointed_next;
  if (session.revision() == revision) return;
  ui_.view = b.view;
  if (session.selected != session_.selected) session_.select(session.selected);
  session_.touch();
}

/// The frames of both side by side, and their depth buffers, in one row or two, whichever shows larger pixels; below
/// them the slice with both.
void App::draw_panes_of_both(ImVec2 at, ImVec2 size) {
  Layout& l = settings_.layout;
  const float gap = std::round(ui_.em * 0.35f);
  const Header &header = session_.header(), &other = against_->session().header();
  const bool depths = depth_pane.serves(header) && depth_pane.serves(other);
  const bool narrow = size.x < ui_.em * 44 || size.y < ui_.em * 21;
  const bool sliced = slice_pane.serves(header) && slice_pane.serves(other) && !narrow;
  const float left = narrow ? 0 : std::round(size.x * l.left);
  if (!narrow) {
    // A class needs no code beside two runs.
    const float code = ui_.presenter ? 0 : std::round(size.y * 0.34f),
                said = std::round((size.y - code - (ui_.presenter ? gap : 2 * gap)) / 2);
    float y = at.y;
    if (!ui_.presenter) {
      draw_pane(pseudo_code_pane, {at.x, y}, {left, code});
      y += code + gap;
    }
    draw_of(true, happened_pane, {at.x, y}, {left, said});
    draw_of(false, happened_pane, {at.x, y + said + gap}, {left, at.y + size.y - y - said - gap});
    splitter("left", {at.x + left, at.y}, {gap, size.y}, true, l.left, size.x);
    l.left = std::clamp(l.left, 0.1f, 0.55f);
  }
  const float x = narrow ? at.x : at.x + left + gap, middle = at.x + size.x - x;
  const float upper = sliced ? std::round((size.y - gap) * l.buffers) : size.y;
  std::vector<std::pair<bool, const Pane*>> panes{{true, &frame_pane}, {false, &frame_pane}};
  if (depths && !narrow) panes.insert(panes.end(), {{true, &depth_pane}, {false, &depth_pane}});
  const Raster& raster = session_.scene().raster;
  const auto pixel = [&](int columns, int rows) {
    return std::min((middle / static_cast<float>(columns) - 3 * ui_.em) / static_cast<float>(raster.width),
                    (upper / static_cast<float>(rows) - 4 * ui_.em) / static_cast<float>(raster.height));
  };
  const int count = static_cast<int>(panes.size());
  const int rows = count > 2 && pixel(2, 2) > pixel(4, 1) ? 2 : 1, columns = count / rows;
  for (int i = 0; i < count; ++i) {
    const auto part = [gap](float from, float room, int place, int parts) {
      const float each = (room - gap * static_cast<float>(parts - 1)) / static_cast<float>(parts);
      return std::make_pair(std::round(from + static_cast<float>(place) * (each + gap)), std::floor(each));
    };
    const auto [px, width] = part(x, middle, i % columns, columns);
    const auto [py, height] = part(at.y, upper, i / columns, rows);
    const auto& [first, pane] = panes[static_cast<std::size_t>(i)];
    draw_of(first, *pane, {px, py}, {width, height});
  }
  if (!sliced) return;
  draw_pane(slice_pane, {x, at.y + upper + gap}, {middle, size.y - upper - gap});
  splitter("buffers", {x, at.y + upper}, {middle, gap}, false, l.buffers, size.y - gap);
}

}  // namespace zstep::viewer
