// A run is judged in the window: checked by itself, or compared with another.
#include <exception>
#include <new>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "sim/cost/depth_bounds.hpp"
#include "sim/viewer/stage.hpp"
#include "sim/words/numbers.hpp"
#include "traces/error.hpp"

namespace zstep::viewer {
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
  const double size = static_cast<double>(std::max<std::int64_t>(1, run.size()));
  bool ended = on_way(0);
  CheckedRun checked = judge_run(
      run, [&](std::int64_t done) { return ended = ended || on_way(static_cast<double>(done) / size); }, true);
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
                    count_text(static_cast<std::int64_t>(report.causes.size()), "cause", "causes")));
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
  const auto causes = static_cast<std::int64_t>(shown.report.causes.size());
  app().say(causes > 0 ? fmt::format("{}; . and , lead from one to the next. Ctrl+D puts the second run away.",
                                     count_text(causes, "cause parts the two runs", "causes part the two runs"))
                       : std::string("The two runs do not part. Ctrl+D puts the second run away."));
}

}  // namespace zstep::viewer
