// What if, on the stage: the run is made anew with what was changed, at the same moment, and what differs is marked.

#include <algorithm>
#include <array>
#include <cstdlib>
#include <exception>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <new>
#include <system_error>
#include <utility>

#include "sim/cost/bounds.hpp"
#include "sim/viewer/stage.hpp"
#include "sim/words/numbers.hpp"
#include "traces/error.hpp"
#include "traces/replay/replay.hpp"

namespace zstep::viewer {
namespace {

Picture end_of(const Trace& trace) {
  Replay replay(trace);
  replay.go_to(trace.size());
  return replay.state().picture;
}

/// Pixels of two pictures that differ: in colour, or in depth alone; none where they are not of one size.
struct Apart {
  std::vector<PixelMark> colors, depths;
};
Apart apart(const Picture& before, const Scene& scene_before, const Picture& now, const Scene& scene) {
  Apart marks;
  if (before.width != now.width || before.height != now.height) return marks;
  for (std::size_t at = 0; at < now.polygon.size(); ++at) {
    // Not by polygons' numbers: their order may be what was changed.
    if (color_at(before, scene_before, at) != color_at(now, scene, at))
      marks.colors.push_back({static_cast<std::int64_t>(at), true});
    else if (!before.depth.empty() && !now.depth.empty() && before.depth[at] != now.depth[at])
      marks.depths.push_back({static_cast<std::int64_t>(at), false});
  }
  return marks;
}

/// How often each line of the page ran.
std::array<std::int64_t, step_limit + 1> runs_of_lines(const Trace& trace) {
  std::array<std::int64_t, step_limit + 1> counts{};
  trace.each(0, trace.size(), [&](std::int64_t, const RecordedEvent& recorded) {
    ++counts[recorded.step];
    return true;
  });
  return counts;
}

/// "1 144 steps, now 1 198; compare 512, now 530", the two lines that differ most.
std::string counts_text(const Trace& before, const Trace& now) {
  std::string text = before.size() == now.size()
                         ? fmt::format("As many steps, {}", grouped(now.size()))
                         : fmt::format("{} steps, now {}", grouped(before.size()), grouped(now.size()));
  const auto was = runs_of_lines(before), is = runs_of_lines(now);
  std::vector<const StepInfo*> lines;
  for (const StepInfo& line : now.header().page)
    if (was[line.id] != is[line.id]) lines.push_back(&line);
  std::stable_sort(lines.begin(), lines.end(), [&](const StepInfo* a, const StepInfo* b) {
    return std::abs(is[a->id] - was[a->id]) > std::abs(is[b->id] - was[b->id]);
  });
  for (std::size_t k = 0; k < std::min<std::size_t>(2, lines.size()); ++k)
    text += fmt::format("; {} {}, now {}", lines[k]->name, grouped(was[lines[k]->id]), grouped(is[lines[k]->id]));
  return text + ".";
}

/// A run of so many steps is made anew before anybody waits for it; a longer one while the window goes on.
constexpr std::int64_t made_at_once = 400'000;

std::string value_in(const Trace& trace, const std::string& name) {
  for (const Method& method : methods())
    if (method.id == trace.header().algorithm)
      for (const Changeable& one : changeables(method, trace.scene(), trace.header().conventions))
        if (one.name == name) return one.value;
  return "";
}

}  // namespace

Changed Stage::told_of(const std::vector<Change>& changes, const Trace& before) {
  Changed changed;
  for (const Change& change : changes) {
    const auto same = [&](const Changed::Made& made) { return made.change.name == change.name; };
    const auto known = std::find_if(changed.made.begin(), changed.made.end(), same);
    if (known != changed.made.end()) known->change = change;
    else changed.made.push_back({change, value_in(*first_, change.name)});
  }
  const Picture was = end_of(before), is = end_of(trace());
  Apart differ = apart(was, before.scene(), is, trace().scene());
  const auto pixels = [](const std::vector<PixelMark>& marks) {
    return marks.size() == 1 ? std::string("1 pixel has") : grouped(std::ssize(marks)) + " pixels have";
  };
  // What only lies elsewhere is marked where nothing else is.
  if (was.width != is.width || was.height != is.height) changed.told = "Another raster. ";
  else if (!differ.colors.empty())
    changed.told = fmt::format("In the end {} another colour, marked. ", pixels(differ.colors));
  else if (!differ.depths.empty())
    changed.told = fmt::format("The picture ends the same, but {} another depth, marked. ", pixels(differ.depths));
  else changed.told = "The picture ends the same. ";
  changed.pixels = std::move(differ.colors.empty() ? differ.depths : differ.colors);
  changed.told += counts_text(before, trace());
  return changed;
}

template <class Make>
std::optional<OtherRun> Stage::made_by(Make&& make) {
  try {
    return make();
  } catch (const std::bad_alloc&) {
    app().say_unchanged("There is not enough memory to run it so.");
  } catch (const InputError& error) {
    app().say_unchanged(error.what());
  }
  return std::nullopt;
}

Stage::Asked Stage::asked() const { return pending_ ? pending_->asked : Asked{changes_, undone_, false, false}; }

void Stage::ask(Asked asked) {
  if (!options_.run_changed) return app().say_unchanged("This run cannot be changed from here.");
  end_run();
  const std::string method = trace().header().algorithm;
  if (options_.run_watched && trace().size() > made_at_once) {
    try {
      pending_.reset(new Pending{asked, 0, RunBehind([this, method, changes = asked.changes](const RunWatch& watch) {
                                   return options_.run_watched(*first_, method, changes, watch);
                                 })});
      app().waits_for_run = true;
      return app().say("Made anew while you go on. Esc: as it was.");
    } catch (const std::system_error&) {  // no threads here
    }
  }
  if (auto made = made_by([&] { return options_.run_changed(*first_, method, asked.changes); }))
    show_made(*std::move(made), std::move(asked));
}

void Stage::look_for_run() {
  if (!pending_) return;
  if (!pending_->run.done()) {
    const std::int64_t steps = pending_->run.steps();
    if (steps == std::exchange(pending_->told, steps)) return;
    return app().say(fmt::format("Made anew while you go on: {} steps; before it had {}. Esc: as it was.",
                                 grouped(steps), grouped(trace().size())));
  }
  const std::unique_ptr<Pending> pending = std::move(pending_);
  app().waits_for_run = false;
  if (auto made = made_by([&] { return pending->run.take(); })) show_made(*std::move(made), std::move(pending->asked));
}

void Stage::end_run() {
  if (!pending_) return;
  pending_.reset();
  app().waits_for_run = false;
  app().say("As it was.");
}

void Stage::show_made(OtherRun run, Asked asked) {
  const std::vector<Change>& changes = asked.changes;
  const bool goes_on = asked.goes_on;
  std::optional<OtherRun> made = std::move(run);
  const bool moved = app().session().position() != arrived_ || app().session().selected != moment_.selected;
  if (moved) moment_ = moment_of(app().session());
  const bool back = changes.empty() && made->trace.header().algorithm == first_->header().algorithm;

  // What was shown stays until the new run was compared with it.
  Before before = show_in_place(back ? std::nullopt : std::move(made));
  App& left = before.app ? *before.app : *first_app_;
  if (&left != &app()) app().look_as(left);
  if (&left == first_app_.get() && !back) first_app_->open(Drawer::none);
  Session& s = app().session();
  const Raster& raster = trace().scene().raster;
  if (moment_.selected && (moment_.selected->x >= raster.width || moment_.selected->y >= raster.height))
    moment_.selected.reset();
  std::string place;
  // What is as it was opened is where its lesson left it: what the lesson says is of that step.
  const bool as_left = back && lesson_ && !first_app_->session().lesson()->stops.empty();
  if (!back || (moved && !as_left)) {
    const MomentThere there = moment_in(trace(), moment_);
    s.select(moment_.selected);
    s.go_to(there.step);
    place = there.what;
  }
  arrived_ = s.position();
  // While a hand still holds a vertex, each run is compared with the one before the hand took it.
  const std::shared_ptr<OtherRun> against = goes_on ? before_change_ : before.run;
  Changed changed = told_of(changes, against ? against->trace : *first_);
  if (back) changed.pixels.clear(), changed.told = "As it was before the changes.";  // nothing is changed any more
  if (const Task* task = app().task()) changed.task = state_of(*task, trace());
  if (other_ && !other_->whole) changed.told += " Cut off, as it would take too long.";
  if (other_ && lesson_) changed.told += " The lesson waits.";
  if (!place.empty()) changed.told += fmt::format(" Here: {}.", place);
  if (app().drawer() != Drawer::what_if) app().say(changed.told);
  app().show_changes(std::move(changed), back      ? nullptr
                                         : against ? std::shared_ptr<const Trace>(against, &against->trace)
                                                   : std::shared_ptr<const Trace>(std::shared_ptr<void>(), first_));
  before.app.reset();  // it looks at that run
  if (!goes_on) before_change_ = std::move(before.run);
  changes_ = std::move(asked.changes);
  undone_ = std::move(asked.undone);
  if (asked.typed && app().drawer() == Drawer::what_if) app().put("");
}

void Stage::change(const Change& change, bool goes_on) {
  Asked next = asked();
  next.goes_on = goes_on && !next.changes.empty() && next.changes.back().name == change.name;
  if (next.goes_on) next.changes.pop_back();
  next.changes.push_back(change);
  next.undone.clear();
  next.typed = !next.goes_on;
  ask(std::move(next));
}

void Stage::undo(int direction) {
  Asked next = asked();
  next.goes_on = next.typed = false;
  std::vector<Change>& from = direction > 0 ? next.changes : next.undone;
  if (from.empty()) return app().say_unchanged(direction > 0 ? "Nothing is changed." : "Nothing was taken back.");
  (direction > 0 ? next.undone : next.changes).push_back(from.back());
  from.pop_back();
  ask(std::move(next));
}

// A run is judged in the window: checked by itself, or compared with another.

namespace {

std::string count_text(std::int64_t count, const char* one, const char* several) {
  return fmt::format("{} {}", grouped(count), count == 1 ? one : several);
}

/// " Not judged: z of compare (58 steps); which pixels are drawn".
std::string not_judged_text(const Trace& trace, const CheckReport& report) {
  const std::vector<std::string> left = not_judged_in_words(trace, report);
  return left.empty() ? "" : fmt::format(" Not judged: {}.", fmt::join(left, "; "));
}

std::string sizes_text(const Raster& raster) { return fmt::format("{}x{}", raster.width, raster.height); }

}  // namespace

bool Stage::on_way(double share) { return app().session().on_way && app().session().on_way(share); }

bool Stage::check_run() {
  if (app().ui().findings) return true;
  const Trace& run = trace();
  const std::int64_t size = std::max<std::int64_t>(1, run.size());
  bool ended = on_way(0);
  CheckedRun checked = judge_run(
      run, [&](std::int64_t done) { return ended = ended || on_way(ratio(done, size)); }, true);
  if (ended) return false;
  if (&run == first_ && opened_) checked.impossible = opened_->impossible;
  app().show_findings(checked_.emplace_back(std::move(checked)));
  return true;
}

void Stage::check() {
  try {
    if (!check_run()) return app().say("The check was ended; nothing is marked.");
  } catch (const InputError& error) {
    return app().say(error.what());
  }
  const CheckedRun& checked = app().ui().findings->checked();
  const CheckReport& report = checked.report;
  if (!report.causes.empty()) {
    app().to_first_cause();
    return app().say(
        fmt::format("{} to mend. This is the first; . and , go to the others, > and < to all that is marked.",
                    count_text(std::ssize(report.causes), "cause", "causes")));
  }
  if (checked.impossible.empty())
    return app().say(fmt::format("{} {} of {} can be judged by a formula or a rule.{}", verdict_in_words(report),
                                 grouped(report.judged), count_text(report.steps, "step", "steps"),
                                 not_judged_text(trace(), report)));
  app().session().go_to(trace().size());
  app().say("Up to here nothing is wrong, but the next step cannot be: " + checked.impossible);
}

Stage::Second Stage::second_run(const std::string& path) {
  if (path.empty()) {
    if (!options_.run_changed)
      throw InputError("this run", "cannot be made anew from here", "type the path of a trace");
    OtherRun own = options_.run_changed(trace(), trace().header().algorithm, {});
    if (!own.whole)
      throw InputError("zstep's own run", fmt::format("is cut off after {} steps", grouped(own.trace.size())),
                       "record it, and type the path of that trace");
    return {std::move(own.trace)};
  }
  if (!options_.open) throw InputError(path, "nothing can be opened from here", "leave it out");
  return {std::move(options_.open(trace(), {Offer::What::scene, path, {}, {}})->trace)};
}

void Stage::compare_with(const std::string& path) {
  const auto refuse = [&](std::string why) {
    if (app().drawer() != Drawer::compare) app().open(Drawer::compare), app().put(path);
    app().wrong = std::move(why);
  };
  try {
    const Raster& here = trace().scene().raster;
    Second second = second_run(path);
    const Raster& there = second.trace.scene().raster;
    if (here.width != there.width || here.height != there.height)
      return refuse(fmt::format("That run has {} pixels, and this one {}; record both with one size.",
                                sizes_text(there), sizes_text(here)));
    bool ended = on_way(0);
    second.report = diff::compare(
        trace(), second.trace, [&](double share) { return ended = ended || on_way(share); }, diff::Way::fast,
        compare::held_to_bounds(trace(), second.trace));
    if (ended) return refuse("Comparing was ended.");
    app().end_against();
    if (!first_app_->compares()) seconds_.clear();
    seconds_.push_back(std::move(second));
  } catch (const std::bad_alloc&) {
    return refuse("There is not enough memory for a second run; close other programs, or make both smaller.");
  } catch (const std::exception& error) {
    return refuse(error.what());
  }
  Second& shown = seconds_.back();
  shown.with = {&shown.trace, &shown.report, true};
  app().open(Drawer::none);
  app().show_against(shown.with);
  app().to_first_cause();
  const std::int64_t causes = shown.report.causes.size();
  app().say(causes > 0 ? fmt::format("{}; . and , lead from one to the next. Ctrl+D puts the second run away.",
                                     count_text(causes, "cause parts the two runs", "causes part the two runs"))
                       : std::string("The two runs do not part. Ctrl+D puts the second run away."));
}

}  // namespace zstep::viewer
