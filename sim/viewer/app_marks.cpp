// What is marked: what check found in the run, or how a second run beside it differs.
#include <utility>

#include <fmt/format.h>

#include "sim/viewer/app.hpp"
#include "sim/words/numbers.hpp"

namespace zstep::viewer {

void App::show_findings(const CheckedRun& checked) {
  end_against();
  findings_.emplace(session_.trace(), checked);
  ui_.findings = &*findings_;
  ui_.marks = &*findings_;
}

void App::show_against(const AgainstRun& with) {
  end_against();
  findings_.reset(), ui_.findings = nullptr;
  against_.emplace(session_, with);
  opens_at_cause_ = with.at_first_cause;
  other_ui_ = std::make_unique<Ui>(against_->session(), renderer_);
  other_ui_->asks = false;
  ui_.other = other_ui_.get();
  lead_before_against_ = chosen_lead_;
  if (slice_pane.serves(session_.header()) && slice_pane.serves(against_->session().header())) set_lead(slice_pane.id);
  ui_.marks = &against_->marks_of_a();
  other_ui_->marks = &against_->marks_of_b();
}

void App::end_against() {
  if (!against_) return;
  ui_.other = nullptr, ui_.marks = nullptr, ui_.pixel_marks = nullptr;
  other_ui_.reset();
  against_.reset();
  opens_at_cause_ = false;
  chosen_lead_ = lead_before_against_;
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
  if (!ui_.marks) return say("Nothing was checked: Ctrl+K checks this run, Ctrl+D compares it with another.");
  const char* none = direction > 0 ? "There is no later cause." : "There is no earlier cause.";
  if (ui_.marks->causes().empty())
    return say(against_ ? "The two runs do not part." : "Nothing that can be judged is wrong.");
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

static constexpr const char* no_second_run = "There is no second run: Ctrl+D compares this one with another.";

void App::to_marked(int direction) {
  if (against_) {
    const auto place = against_->next_difference(direction);
    return place ? against_->go_to(*place)
                 : say(direction > 0 ? "There is no later difference." : "There is no earlier difference.");
  }
  if (!findings_)
    return say("Nothing was checked or compared: Ctrl+K checks this run, Ctrl+D compares it with another.");
  const auto step = findings_->next_marked(session_.position(), direction);
  if (step) session_.go_to(*step);
  else say(direction > 0 ? "No later step is marked." : "No earlier step is marked.");
}

void App::to_pixel_apart() {
  if (!against_) return say(no_second_run);
  const auto& found = against_->first_pixel_apart();
  if (!found) return say("The pictures of both runs are the same at the end.");
  if (found->place) against_->go_to(*found->place);
  session_.select(found->cell);
  say(fmt::format("Pixel ({}, {}) is the first from the top that differs at the end{}.", found->cell.x, found->cell.y,
                  found->place ? "; here the runs first part at it" : ""));
}

void App::to_alike(int direction) {
  if (!against_) return say(no_second_run);
  const Session& b = against_->session();
  const std::pair here{session_.position(), b.position()};
  const auto found = against_->next_alike(direction);
  if (!found) return say("The runs do not part here; . and > go to where they do.");
  against_->go_to(found->place);
  const bool moved = here != std::pair{session_.position(), b.position()};
  say(moved ? fmt::format("The runs part in {}: {} of {}.", found->what,
                          grouped(static_cast<std::int64_t>(found->number)),
                          grouped(static_cast<std::int64_t>(found->all)))
            : fmt::format("There is no {} difference in {}.", direction > 0 ? "later" : "earlier", found->what));
}

/// Another run's panes look as this one's.
void App::share_look(Ui& b) const {
  b.fonts = ui_.fonts;
  b.theme = ui_.theme;
  b.depth_range = ui_.depth_range, b.range_mode = ui_.range_mode, b.hand_range = ui_.hand_range;
  b.histogram = ui_.histogram;
  b.em = ui_.em, b.thin = ui_.thin, b.presenter = ui_.presenter, b.reads = ui_.reads;
  b.view = ui_.view;
  b.pointed = ui_.pointed;
  b.scroll_now = ui_.scroll_now;
}

/// Of the pixels that end otherwise since the change, those that are otherwise at this moment already. Where the run
/// before does not come along, they are marked at the end alone.
void App::mark_changed_pixels() {
  ui_.pixel_marks = nullptr;
  if (changed_.pixels.empty()) return;
  if (session_.position() == session_.size()) return void(ui_.pixel_marks = &changed_.pixels);
  if (!before_) return;
  before_->follow();
  const Picture &now = session_.state().picture, &was = before_->session().state().picture;
  changed_here_.clear();
  if (now.width != was.width || now.height != was.height) return;
  for (const PixelMark& mark : changed_.pixels) {
    const auto at = static_cast<std::size_t>(mark.pixel);
    const bool color = color_at(now, session_.scene(), at) != color_at(was, before_->session().scene(), at);
    const bool depth = !now.depth.empty() && !was.depth.empty() && now.depth[at] != was.depth[at];
    if (mark.filled ? color : depth) changed_here_.push_back(mark);
  }
  if (!changed_here_.empty()) ui_.pixel_marks = &changed_here_;
}

/// What is marked at this moment; the second run comes to it.
void App::follow_marks() {
  mark_changed_pixels();
  if (findings_ && !session_.looking_back)
    ui_.pixel_marks = &findings_->pixels(session_.position(), session_.state().machine.pass == Pass::light);
  if (before_ui_) {
    before_->follow();
    share_look(*before_ui_);
    ui_.before = before_ui_.get();
  }
  if (!against_) return;
  against_->follow();
  against_->session().looking_back = session_.looking_back;
  if (!session_.looking_back) ui_.pixel_marks = &against_->pixels();
  share_look(*other_ui_);
  other_ui_->pixel_marks = ui_.pixel_marks;
}

}  // namespace zstep::viewer
