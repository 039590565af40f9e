// Going to places: by what is typed, by conditions and bookmarks; and marks that a reader sets.

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <utility>

#include "sim/viewer/app.hpp"
#include "sim/viewer/commands.hpp"
#include "sim/viewer/panes/workspace.hpp"
#include "sim/viewer/stage.hpp"
#include "sim/words/link.hpp"
#include "sim/words/numbers.hpp"
#include "traces/error.hpp"
#include "traces/scene.hpp"
#include "traces/text.hpp"

namespace zstep::viewer {

void App::run_until(const std::string& condition, Places::Way way) {
  wrong = places_.run_until(condition, way);
  if (wrong.empty()) open(Drawer::none);
}

void App::keep_bookmark() {
  const bool named = typed.find_first_not_of(' ') != std::string::npos;
  const std::string name = named ? typed : fmt::format("step {}", session_.position());
  wrong = places_.bookmark(name);
  if (!wrong.empty()) return;
  requests.marks_kept = true;
  open(Drawer::none);
  say(fmt::format("Step {} is kept as {}; L lists all bookmarks.", grouped(session_.position()), name));
}

void App::go_to_bookmark(std::size_t place) {
  const auto& all = places_.bookmarks();
  if (place >= all.size()) return;
  const places::Bookmark mark = all[place];
  open(Drawer::none);
  session_.go_to(mark.step);
  say(fmt::format("Bookmark: {}", mark.name));
}

void App::remove_bookmark(std::size_t place) {
  const auto& all = places_.bookmarks();
  if (all.empty()) return;
  const std::string name = all[std::min(place, all.size() - 1)].name;
  const std::string fault = places_.remove_bookmark(place);
  requests.marks_kept = fault.empty();
  say(fault.empty() ? fmt::format("Removed the bookmark {}.", name) : fault);
  picked = std::clamp(index32(place), 0, std::max(0, size32(places_.bookmarks()) - 1));
}

void App::turn_overlay(int direction) {
  if (ui_.heat && !pixel_overlay_.shown()) end_painting();  // a query's
  pixel_overlay_.turn(direction);
  if (!pixel_overlay_.shown()) end_painting();
  say(pixel_overlay_.shown() ? fmt::format("Over the frame: {}, up to the step where you are. O turns on, Esc ends it.",
                                           PixelOverlay::name(*pixel_overlay_.shown()))
                             : "Nothing over the frame.");
}

void App::end_painting() {
  ui_.heat.reset();
  ui_.heat_behind.clear();
  if (pixel_overlay_.shown()) pixel_overlay_.show(std::nullopt);
}

/// Brings what is painted over the frame to the reader's step, as far as its share of a frame's time allows.
void App::follow_overlay() {
  if (pixel_overlay_.look_on()) {
    if (pixel_overlay_.shown()) pixel_overlay_.take_picture(ui_.heat);
    else end_painting();
  }
  ui_.heat_behind = pixel_overlay_.behind();
}

void App::take_range() {
  const char* text = typed.c_str();
  char *first = nullptr, *second = nullptr;
  const double near = std::strtod(text, &first), far = std::strtod(first, &second);
  const bool empty = typed.find_first_not_of(' ') == std::string::npos;
  const DepthRange range = range_between(std::min(near, far), std::max(near, far), session_.header());
  const bool in_order = std::isfinite(near) && std::isfinite(far) && near != far && near == range.near;
  if (!empty && (first == text || second == first || !in_order ||
                 std::string(second).find_first_not_of(' ') != std::string::npos)) {
    wrong = fmt::format("Type two numbers, the {} first: {}", range.named ? "nearer" : "smaller",
                        session_.header().comparison.nearer == Comparison::Nearer::greater ? "0.8 0.2" : "0.2 0.8");
    return;
  }
  open(Drawer::none);
  ui_.range_mode = empty ? Ui::RangeMode::whole : Ui::RangeMode::by_hand;
  ui_.hand_range = range;
  say(empty ? "The colours span all depths of the trace."
            : fmt::format("The colours span {} to {}; R ends that.", number(near), number(far)));
}

bool App::edit_range(SDL_Keycode code, unsigned) { return code == SDLK_RETURN ? take_range(), true : false; }
bool App::name_typed(SDL_Keycode code, unsigned) { return code == SDLK_RETURN ? keep_bookmark(), true : false; }

bool App::edit_until(SDL_Keycode code, unsigned modifiers) {
  if (code == SDLK_RETURN)
    return run_until(typed, (modifiers & Chord::shift) != 0 ? Places::Way::backwards : Places::Way::forwards), true;
  const auto suggestions = places_.suggestions();
  if (!pick_among(suggestions.size(), code)) return false;
  if (!suggestions.empty()) put(suggestions[picked].condition);
  wrong.clear();
  return true;
}

bool App::pick_bookmark(SDL_Keycode code, unsigned) {
  const std::size_t place = std::max(0, picked);
  if (code == SDLK_RETURN) return go_to_bookmark(place), true;
  if (code == SDLK_DELETE) return remove_bookmark(place), true;
  return pick_among(places_.bookmarks().size(), code);
}

// Goes to what is typed: a step, a percentage, a polygon, a scan line, a stop, a pixel, a bookmark.

places::Place App::place_typed() const {
  return places::find_place({session_.trace(), places_.marks(), session_.lesson(), session_.position()}, typed,
                            "go to");
}

void App::go_to_typed() {
  places::Place place;
  try {
    place = place_typed();
  } catch (const InputError& error) {
    wrong = error.what();  // what was typed stays, to be mended
    return;
  }
  open(Overlay::none);
  go_to(place);
}

void App::go_to(const places::Place& place) {
  if (place.pixel) {
    session_.select(Cell{place.pixel->x, place.pixel->y});
    return say("Selected; F runs to the next step that touches it.");
  }
  if (place.stop) return session_.to_stop(*place.stop);
  session_.go_to(place.step, place.unit);
  if (place.step > session_.size())
    say(fmt::format("This trace has {} steps; this is its end.", grouped(session_.size())));
  if (!place.note.empty()) say(place.note);
}

bool App::go_to_link(const std::string& link) {
  std::vector<std::string> opens, at, pixel, lead;
  for (const std::string& word : words_of_link(link)) {
    const auto is = [&](std::string_view option) { return word.starts_with(option); };
    const std::string value = word.substr(word.find('=') + 1);
    if (is("--at=")) at.push_back(value);
    else if (is("--pixel=")) pixel.push_back(value);
    else if (is("--lead=")) lead.push_back(value);
    else opens.push_back(word);
  }
  if (at.size() != 1 || racing() || link_of(opens) != link_of(opening_words())) return false;
  const places::Place place =
      places::find_place({session_.trace(), places_.marks(), session_.lesson(), session_.position()}, at[0], "link");
  open(Overlay::none);
  session_.select(std::nullopt);
  set_lead("");
  if (place.stop) session_.to_stop(*place.stop);
  else session_.go_to(place.step, place.unit);
  std::optional<Trace::Pixel> selected;
  if (!pixel.empty())
    selected = places::find_place({session_.trace(), places_.marks(), nullptr, 0}, pixel[0], "link").pixel;
  look_at(selected, lead.empty() ? "" : lead[0]);
  return true;
}

void App::look_at(std::optional<Trace::Pixel> pixel, const std::string& lead) {
  if (pixel) session_.select(Cell{pixel->x, pixel->y});
  if (lead.empty()) return;
  std::string id = lead;
  std::replace(id.begin(), id.end(), '-', '_');
  const std::vector<std::string> all = leads_to_choose(session_.header());
  if (std::find(all.begin(), all.end(), id) == all.end()) {
    std::string names =
        fmt::format("{}", fmt::join(all.begin() + 1, all.end(), ", "));  // the first is the method's own
    std::replace(names.begin(), names.end(), '_', '-');
    throw InputError("--lead", fmt::format("no pane '{}' can lead here", printable(lead)),
                     "those that can are " + names);
  }
  set_lead(id);
}

void go_to_start(App& app, const ViewerOptions& options) {
  Session& s = app.session();
  if (options.stop) s.to_stop(*options.stop);
  else if (options.at >= 0) s.go_to(options.at);
  else if (app.opens_at_cause()) app.to_first_cause();
  else if (const auto place = place_to_go_on(app.settings(), s.trace(), options.lesson)) s.go_to(*place);
  else if (options.lesson && !options.lesson->stops.empty()) s.to_stop(0);
  else if (options.finished) s.to_finished_picture();
  app.look_at(options.pixel, options.lead);
  if (!options.note.empty()) app.say(options.note);
}

// What is marked: what check found in the run, or how a second run beside it differs.

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
  say(moved ? fmt::format("The runs part in {}: {} of {}.", found->what, grouped(found->number), grouped(found->all))
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
    const std::size_t at = mark.pixel;
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
