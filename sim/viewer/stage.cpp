#include "sim/viewer/stage.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <exception>
#include <new>
#include <utility>

#include <fmt/format.h>

#include "sim/places/search.hpp"
#include "sim/viewer/panes/workspace.hpp"
#include "sim/viewer/settings.hpp"
#include "sim/words/explain.hpp"
#include "sim/words/numbers.hpp"
#include "traces/error.hpp"

namespace zstep::viewer {

std::string place_key(const Trace& trace) {
  return fmt::format("{}|{}|{}", trace.name(), trace.size(), trace.scene().points.size());
}

std::optional<std::int64_t> place_to_go_on(const Settings& settings, const Trace& trace, const Lesson* lesson) {
  const auto place = settings.place(place_key(trace));
  const bool has_stops = lesson && !lesson->stops.empty();
  if (!place || !has_stops) return place;
  const bool read = *place >= lesson->stops.back().position;
  return settings.presenter || read ? std::nullopt : place;
}

Stage::Stage(const Trace& trace, const ViewerOptions& options, const Settings& settings, int width, int height,
             float dpi_scale)
    : first_(&trace), lesson_(options.lesson), options_(options), dpi_scale_(dpi_scale) {
  begin(settings, width, height);
  if (options.checked) app().show_findings(*options.checked);
  if (options.against) app().show_against(*options.against);
}

void Stage::begin(const Settings& settings, int width, int height) {
  first_app_ = std::make_unique<App>(*first_, lesson_, settings, width, height, dpi_scale_);
  first_app_->offer(options_.offers);
  first_app_->opened_by = opened_ ? opened_->opened_by : options_.opened_by;
  first_app_->see_file();
  if (options_.run_changed) first_app_->allow_changes(options_.run_changed);
}

void Stage::open(const Offer& offer, bool for_class) {
  if (offer.what == Offer::What::scene && is_progress_file(offer.id)) return take_progress_of(offer.id);
  if (!options_.open) return app().say("Nothing else can be opened from here.");
  if (offer.what == Offer::What::method && !changes_.empty() && options_.run_changed) return switch_to(offer.id);
  std::unique_ptr<Opened> opened;
  try {
    opened = options_.open(trace(), offer);
    if (opened->lesson) check_focus(*opened->lesson, opened->trace.header());
  } catch (const std::bad_alloc&) {
    return app().say_on_start("There is not enough memory to open it; close other programs, or make it smaller.");
  } catch (const std::exception& error) {
    return app().say_on_start(error.what());
  }
  Settings settings = app().settings();
  settings.speed = app().session().speed;
  settings.presenter = settings.presenter || for_class;
  settings.remember(place_key(trace()), app().session().position());
  settings.remember(place_key(*first_), first_app_->session().position());
  pending_.reset();  // it looks at what goes
  const int width = app().renderer().width(), height = app().renderer().height();
  const Whereabouts moment = moment_of(app().session());
  Board board = app().board();
  other_app_.reset();
  other_.reset();
  first_app_.reset();  // it looks at what goes
  checked_.clear(), seconds_.clear();
  opened_ = std::move(opened);
  first_ = &opened_->trace;
  lesson_ = opened_->lesson ? &*opened_->lesson : nullptr;
  begin(settings, width, height);
  app().board() = std::move(board);
  moment_ = {};
  arrived_ = -1;
  changes_.clear(), undone_.clear(), before_change_.reset();
  Session& s = app().session();
  if (const auto place = place_to_go_on(settings, *first_, lesson_)) s.go_to(*place);
  else if (lesson_ && !lesson_->stops.empty()) s.to_stop(0);
  else if (opened_->finished) s.to_finished_picture();
  else if (offer.what == Offer::What::method) {  // of the same scene: at the same moment
    const MomentThere there = moment_in(*first_, moment);
    s.select(moment.selected);
    s.go_to(there.step);
    opened_->note += fmt::format("{}Here: {}.", opened_->note.empty() ? "" : " ", there.what);
  }
  if (!opened_->note.empty()) app().say(s.message.empty() ? opened_->note : opened_->note + " " + s.message);
}

void Stage::take_progress_of(const std::string& file) {
  Settings settings;
  try {
    settings = take_progress(file, places::kept_folder(), app().settings());
  } catch (const InputError& error) {
    return app().say_on_start(error.what());
  }
  app().take_settings(settings);
  app().places().read_bookmarks();
  app().requests.marks_kept = true;
  app().open(Overlay::none);
  app().say("Settings, progress and bookmarks are taken over; progress that was further here stays.");
}

std::int64_t last_write(const Trace& trace, Cell cell) {
  const auto writes = [&](const RecordedEvent& recorded) {
    const Event& event = recorded.event;
    const std::optional<Trace::Pixel> at = pixel_of(event);
    if (!at || at->x != cell.x || at->y != cell.y) return false;
    return holds<PixelWrite>(event) || holds<PixelPaint>(event) || holds<ColorWrite>(event) || holds<ColorBlend>(event);
  };
  return trace.previous(trace.size() + 1, writes, Trace::Pixel{cell.x, cell.y}).value_or(trace.size());
}

Whereabouts moment_of(const Session& session) {
  const StepInfo* step = session.event() ? find_step(session.header().page, session.event()->step) : nullptr;
  const MethodState& machine = session.state().machine;
  Whereabouts moment{session.selected, session.current_cell(), machine.polygon, machine.scan_line};
  if (step) moment.step = step->name;
  const std::int64_t size = std::max<std::int64_t>(1, session.size());
  moment.share = ratio(session.position(), size);
  return moment;
}

namespace {

/// The first step that fulfils a condition; none where no event of the trace could.
std::optional<std::int64_t> first_where(const Trace& trace, const std::string& condition) {
  try {
    places::Search search(trace, places::Condition(trace, condition), 0, places::Search::Way::forwards);
    while (true) {
      const auto result = search.look(std::chrono::seconds(1));
      if (result == places::Search::Result::found) return search.step();
      if (result == places::Search::Result::none) return std::nullopt;
    }
  } catch (const InputError&) {
    return std::nullopt;
  }
}

}  // namespace

MomentThere moment_in(const Trace& trace, const Whereabouts& moment) {
  const auto name = [](const Cell& cell) { return fmt::format("pixel ({}, {})", cell.x, cell.y); };
  const std::string polygon = moment.polygon < 0 ? "" : polygon_label(trace.scene(), moment.polygon);
  if (moment.selected) return {last_write(trace, *moment.selected), name(*moment.selected)};
  if (moment.share <= 0) return {0, "the beginning"};
  if (moment.share >= 1) return {trace.size(), "the end"};
  if (moment.cell) {
    const std::string touches = fmt::format("touches({}, {})", moment.cell->x, moment.cell->y);
    if (moment.polygon >= 0) {
      const std::string there = fmt::format("{} and polygon == {}", touches, moment.polygon),
                        what = fmt::format("polygon {} reaches {}", polygon, name(*moment.cell));
      if (!moment.step.empty())
        if (const auto step = first_where(trace, moment.step + " where " + there)) return {*step, what};
      if (const auto step = first_where(trace, there)) return {*step, what};
    }
    if (const auto step = first_where(trace, touches)) return {*step, fmt::format("{} is reached", name(*moment.cell))};
  }
  const std::string gone = moment.cell ? fmt::format("{} is not reached here; ", name(*moment.cell)) : "";
  if (moment.line && moment.polygon >= 0)
    if (const auto step = first_where(trace, fmt::format("line == {} and polygon == {}", *moment.line, moment.polygon)))
      return {*step, fmt::format("{}scan line {} of polygon {}", gone, *moment.line, polygon)};
  for (const PolygonMark& mark : trace.polygons())
    if (moment.polygon >= 0 && mark.polygon == moment.polygon)
      return {mark.position, fmt::format("{}work on polygon {} begins", gone, polygon)};
  return {std::llround(moment.share * static_cast<double>(trace.size())),
          fmt::format("{}as much of the run is done, {:.0f} %", gone, moment.share * 100)};
}

Stage::Before Stage::show_in_place(std::optional<OtherRun> next) {
  Settings settings = app().settings();
  settings.speed = app().session().speed;
  const int width = app().renderer().width(), height = app().renderer().height();
  Board board = app().board();
  Before before{std::exchange(other_, nullptr), std::exchange(other_app_, nullptr)};
  if (next) {
    other_ = std::make_shared<OtherRun>(*std::move(next));
    other_app_ = std::make_unique<App>(trace(), nullptr, settings, width, height, dpi_scale_);
    other_app_->offer(options_.offers);
    if (options_.run_changed) other_app_->allow_changes(options_.run_changed);
    other_app_->lesson_waits = lesson_ && !lesson_->stops.empty();
  } else {
    first_app_->take_settings(settings);
    first_app_->resize(width, height);
  }
  app().board() = std::move(board);
  return before;
}

bool Stage::serve() {
  bool other = false;
  if (const int direction = std::exchange(app().requests.back_to_lesson, 0); direction != 0)
    go_back_to_lesson(direction), other = true;
  if (const int direction = std::exchange(app().requests.switch_method, 0); direction != 0)
    switch_method(direction), other = true;
  if (const auto offer = std::exchange(app().requests.open, std::nullopt))
    open(*offer, std::exchange(app().requests.for_class, false)), other = true;
  if (std::exchange(app().requests.check, false)) check();
  if (const auto with = std::exchange(app().requests.compare_with, std::nullopt)) compare_with(*with);
  const bool goes_on = app().requests.change_goes_on;
  for (const Change& made : std::exchange(app().requests.changes, {})) change(made, goes_on);
  if (const int direction = std::exchange(app().requests.undo_change, 0); direction != 0) undo(direction);
  if (std::exchange(app().requests.end_run, false)) end_run();
  look_for_run();
  return other;
}

void Stage::go_back_to_lesson(int direction) {
  if (!other_app_ || !lesson_) return;
  end_run();
  undone_.assign(changes_.rbegin(), changes_.rend());
  changes_.clear();
  before_change_.reset();
  const Before left = show_in_place(std::nullopt);
  app().show_changes({});
  app().open(Drawer::none);
  Session& s = app().session();
  s.next_stop(direction);
  moment_ = moment_of(s);
  arrived_ = s.position();
}

void Stage::switch_method(int direction) {
  end_run();
  if (!options_.other_method) return app().say("No other method can be run from here.");
  std::optional<OtherRun> other;
  try {
    other = options_.other_method(trace(), direction);
  } catch (const InputError& error) {
    return app().say(error.what());
  }
  if (!other) return app().say("No other method can draw this scene.");
  Changed changed;
  if (!changes_.empty()) {
    // Made anew from what was opened: conventions that a method in between does not have are not lost.
    try {
      if (options_.run_changed) other = options_.run_changed(*first_, other->trace.header().algorithm, changes_);
    } catch (const InputError& error) {
      return app().say(error.what());
    }
    changed.made = app().changed().made;
  }
  show_other(*std::move(other), std::move(changed));
}

void Stage::switch_to(const std::string& method) {
  end_run();
  Changed changed;
  changed.made = app().changed().made;
  try {
    show_other(options_.run_changed(*first_, method, changes_), std::move(changed));
  } catch (const std::bad_alloc&) {
    app().say_on_start("There is not enough memory to run it.");
  } catch (const std::exception& error) {
    app().say_on_start(error.what());
  }
}

void Stage::show_other(OtherRun other, Changed changed) {
  const Session& left = app().session();
  const bool moved = left.position() != arrived_ || left.selected != moment_.selected;
  if (moved) moment_ = moment_of(left);
  const bool back = changes_.empty() && other.trace.header().algorithm == first_->header().algorithm;
  show_in_place(back ? std::nullopt : std::optional(std::move(other)));

  Session& s = app().session();
  std::string place = "here as it was left";
  if (!back || moved) {
    const MomentThere there = moment_in(trace(), moment_);
    s.select(moment_.selected);
    s.go_to(there.step);
    place = there.what;
  }
  arrived_ = s.position();
  app().show_changes(std::move(changed));
  if (other_ && !other_->whole)
    place += fmt::format("; cut off after {} steps, so the picture is not done", grouped(trace().size()));
  if (other_ && lesson_) place += "; the lesson waits where it was left";
  app().say(trace().header().title + ": " + place + ".");
}

}  // namespace zstep::viewer
