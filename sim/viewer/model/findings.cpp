#include "sim/viewer/model/findings.hpp"

#include <algorithm>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "sim/words/numbers.hpp"
#include "traces/formulas/walk.hpp"

namespace zstep::viewer {

using formulas::Place;

Findings::Findings(const Trace& trace, const CheckedRun& checked) : trace_(trace), checked_(checked) {
  for (const Cause& cause : checked.report.causes) causes_.push_back(cause.first.step);
  for (const CheckMarks::Change& change : checked.marks.changes) {
    std::vector<Since>& history = places_[key(change.place)];
    const bool pixel = change.place.in == Place::In::frame || change.place.in == Place::In::depth_buffer ||
                       change.place.in == Place::In::light_buffer;
    if (history.empty() && pixel) pixels_ever_.push_back(change.place);
    const CheckMarks::Step* mark = mark_of(change.step);
    history.push_back({change.step, change.cause == CheckMarks::none ? Trust::right
                                    : mark && mark->wrong            ? Trust::wrong
                                                                     : Trust::follows});
  }
}

const CheckMarks::Step* Findings::mark_of(std::int64_t step) const {
  const std::vector<CheckMarks::Step>& steps = checked_.marks.steps;
  const auto found = std::lower_bound(steps.begin(), steps.end(), step,
                                      [](const CheckMarks::Step& mark, std::int64_t s) { return mark.step < s; });
  return found != steps.end() && found->step == step ? &*found : nullptr;
}

std::optional<std::int64_t> Findings::next_marked(std::int64_t from, int direction) const {
  const std::vector<CheckMarks::Step>& steps = checked_.marks.steps;
  const auto next = std::lower_bound(steps.begin(), steps.end(), direction > 0 ? from + 1 : from,
                                     [](const CheckMarks::Step& one, std::int64_t s) { return one.step < s; });
  if (direction > 0) return next == steps.end() ? std::nullopt : std::optional(next->step);
  return next == steps.begin() ? std::nullopt : std::optional(std::prev(next)->step);
}

bool Findings::any_follows(std::int64_t first, std::int64_t last) const {
  const std::vector<CheckMarks::Step>& steps = checked_.marks.steps;
  auto mark = std::lower_bound(steps.begin(), steps.end(), first,
                               [](const CheckMarks::Step& one, std::int64_t s) { return one.step < s; });
  while (mark != steps.end() && mark->step <= last && mark->wrong) ++mark;
  return mark != steps.end() && mark->step <= last;
}

Findings::Trust Findings::trust(const Place& place, std::int64_t position) const {
  const auto found = places_.find(key(place));
  if (found == places_.end()) return Trust::right;
  const auto after = std::upper_bound(found->second.begin(), found->second.end(), position,
                                      [](std::int64_t p, const Since& since) { return p < since.step; });
  return after == found->second.begin() ? Trust::right : std::prev(after)->trust;
}

const std::vector<PixelMark>& Findings::pixels(std::int64_t position, bool light) {
  if (position == pixels_at_ && light == pixels_light_) return pixels_;
  pixels_at_ = position, pixels_light_ = light;
  pixels_.clear();
  for (const Place& place : pixels_ever_) {
    if ((place.in == Place::In::light_buffer) != light) continue;
    if (const Trust found = trust(place, position); found != Trust::right)
      pixels_.push_back({place.number, found == Trust::wrong});
  }
  // Frame and depth of a pixel are one mark, the worse of the two.
  std::stable_sort(pixels_.begin(), pixels_.end(), [](const PixelMark& a, const PixelMark& b) {
    return a.pixel != b.pixel ? a.pixel < b.pixel : a.filled > b.filled;
  });
  pixels_.erase(std::unique(pixels_.begin(), pixels_.end(),
                            [](const PixelMark& a, const PixelMark& b) { return a.pixel == b.pixel; }),
                pixels_.end());
  return pixels_;
}

std::string Findings::name_of(std::size_t cause) const {
  const std::string subject = cause < checked_.texts.size() ? checked_.texts[cause].subject : "";
  return fmt::format("Cause {} of {}, {}", cause + 1, causes_.size(),
                     step_and_subject(trace_, checked_.report.causes[cause].first.line, subject));
}

const StepMarks::Told& Findings::told(Session& session) {
  const std::int64_t step = session.position();
  if (told_at_ == step) return told_;
  told_at_ = step;
  told_ = {"Wrong: ", {}, ""};
  const auto& faults = checked_.marks.faults;
  const auto first = std::lower_bound(faults.begin(), faults.end(), step,
                                      [](const Fault& fault, std::int64_t s) { return fault.step < s; });
  if (first != faults.end() && first->step == step) {
    const Event event = trace_.event(step).event;
    session.look_elsewhere([&](Replay& replay) {
      formulas::look_before(trace_, replay, step, [&](const formulas::Situation& before) {
        for (auto fault = first; fault != faults.end() && fault->step == step; ++fault) {
          told_.lines.push_back(what_is_wrong(*fault, fault_text(*fault, event, before)));
          if (!told_.lines.back().ends_with('.')) told_.lines.back() += '.';  // what a rule says is a whole sentence
        }
      });
    });
  }
  if (const CheckMarks::Step* mark = mark_of(step)) {
    const std::size_t cause = mark->cause;
    if (causes_[cause] == step) {
      const std::string follows = what_follows(checked_.report.causes[cause]);
      told_.note = name_of(cause) + (follows.empty() ? "." : ": " + follows + ".");
      if (const auto likely = likely_in_words(checked_.likely); cause == 0 && !likely.empty())
        told_.note += fmt::format(" {}", fmt::join(likely, " "));
    } else {
      told_.note =
          fmt::format("{} step {}. {}.", mark->wrong ? "The same fault as at" : "This follows from what is wrong at",
                      grouped(causes_[cause]), name_of(cause));
    }
  }
  if (step == session.size() && !checked_.impossible.empty())
    told_.note += fmt::format("{}The run is judged up to here. The next step is impossible: {}",
                              told_.note.empty() ? "" : " ", checked_.impossible);
  else if (!checked_.marks.complete && checked_.marks.steps.back().step < step)
    told_.note = "So much is wrong before this step that what comes here is not marked.";
  return told_;
}

}  // namespace zstep::viewer
