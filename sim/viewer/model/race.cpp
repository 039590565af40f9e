#include "sim/viewer/model/race.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "sim/cost/measure.hpp"
#include "sim/words/numbers.hpp"
#include "traces/error.hpp"
#include "traces/scene.hpp"

namespace zstep::viewer {
namespace {

using compare::Entrant;
using compare::Measure;

constexpr std::int64_t parts_of_time = 1000;

/// Parts of the clock a second, and then how long the whole race takes.
constexpr std::array<int, 6> rates{1, 2, 5, 10, 30, 100};
constexpr std::array<int, 5> lengths{60, 30, 15, 8, 4};

struct Ended {};  ///< by who waited

std::function<void(double)> tick_of(const std::function<bool()>& ends) {
  return [&ends](double) {
    if (ends && ends()) throw Ended{};
  };
}

}  // namespace

const std::vector<Entrant>& Race::all() const {
  if (all_.empty()) all_ = compare::all_entrants(shown_.scene(), shown_.header().conventions);
  return all_;
}

std::vector<std::string> Race::usual() const {
  std::vector<std::string> ids;
  for (const Entrant& one : all())
    if (one.changes.empty()) ids.push_back(one.text);
  const auto shown = std::find(ids.begin(), ids.end(), shown_.header().algorithm);
  if (shown != ids.end()) std::rotate(ids.begin(), shown, ids.end());
  ids.resize(std::min<std::size_t>(ids.size(), 3));
  return ids;
}

std::vector<std::string> Race::chosen() const {
  std::vector<std::string> all;
  for (const auto& racer : racers_) all.push_back(racer->entrant.text);
  return all;
}

void Race::choose(const std::vector<std::string>& entrants) {
  if (entrants.size() < least || entrants.size() > most)
    throw InputError("a race", fmt::format("it has {} to {} runs, not {}", least, most, entrants.size()),
                     "name them with commas between, as z-buffer,bsp,warnock");
  const double share = end() > 0 ? ratio(at_, end()) : 0;
  std::vector<std::unique_ptr<Racer>> made(entrants.size());
  for (std::size_t k = 0; k < entrants.size(); ++k) {
    if (std::find(entrants.begin(), entrants.begin() + k, entrants[k]) != entrants.begin() + k)
      throw InputError("a race", fmt::format("{} is named twice", entrants[k]), "name each once");
    const auto runs = [&](const auto& racer) { return racer->entrant.text == entrants[k]; };
    if (std::any_of(racers_.begin(), racers_.end(), runs)) continue;
    Entrant entrant = compare::read_entrant(entrants[k], "a race:");
    OtherRun run = run_by_(shown_, std::string(entrant.method->id), entrant.changes);
    made[k] = std::make_unique<Racer>(std::move(entrant), std::move(run));
  }
  for (std::size_t k = 0; k < entrants.size(); ++k)
    for (auto& racer : racers_)
      if (racer && racer->entrant.text == entrants[k]) made[k] = std::move(racer);
  racers_ = std::move(made);
  const auto measured = [](const auto& racer) { return racer->seconds.has_value(); };
  if (clock_ == Measure::time && !std::all_of(racers_.begin(), racers_.end(), measured)) clock_ = Measure::operations;
  go_to(std::llround(share * static_cast<double>(end())));
}

bool Race::set_clock(Measure clock, const std::function<bool()>& ends, std::string& why) {
  const double share = end() > 0 ? ratio(at_, end()) : 0;
  if (clock == Measure::time) try {
      for (const auto& racer : racers_) {
        if (racer->seconds) continue;
        compare::MeasureOptions how;
        how.limit = 10, how.count = false;
        const Trace& trace = racer->run.trace;
        const auto measured =
            compare::measure(*racer->entrant.method, trace.scene(), trace.header().conventions, how, tick_of(ends));
        if (!measured.done())
          return why = fmt::format("{} was not done within {:g} s.", racer->entrant.title, how.limit), false;
        racer->seconds = measured.median_seconds(), racer->runs = size32(measured.seconds);
      }
    } catch (const Ended&) {
      return why = "Measuring was ended, so there is no time to race by.", false;
    }
  clock_ = clock;
  change_speed(0);
  go_to(std::llround(share * static_cast<double>(end())));
  return true;
}

double Race::longest() const {
  double seconds = 0;
  for (const auto& racer : racers_) seconds = std::max(seconds, racer->seconds.value_or(0));
  return seconds;
}

std::int64_t Race::finish(const Racer& racer) const {
  switch (clock_) {
    case Measure::operations:
      return compare::operations(racer.work.all());
    case Measure::time:
      return std::llround(std::ceil(racer.seconds.value_or(0) / longest() * parts_of_time));
    case Measure::steps:
      break;
  }
  return racer.run.trace.size();
}

std::int64_t Race::position(const Racer& racer, std::int64_t at) const {
  const std::int64_t size = racer.run.trace.size();
  if (at >= finish(racer)) return size;
  if (clock_ == Measure::operations) return racer.work.position_of(at);
  if (clock_ == Measure::steps) return at;
  // How a run's time is shared out among its steps is not measured: evenly.
  const double share = ratio(at, parts_of_time) * longest() / *racer.seconds;
  return std::llround(std::floor(std::min(share, 1.0) * static_cast<double>(size)));
}

std::int64_t Race::end() const {
  std::int64_t last = 0;
  for (const auto& racer : racers_) last = std::max(last, finish(*racer));
  return last;
}

void Race::go_to(std::int64_t at) {
  at_ = std::clamp<std::int64_t>(at, 0, end());
  for (const auto& racer : racers_) racer->session.go_to(position(*racer, at_));
}

std::string Race::clock_text(std::int64_t at) const {
  if (clock_ == Measure::time) return seconds_text(ratio(at, parts_of_time) * longest());
  return fmt::format("{} {}", grouped(at), word_of(clock_));
}

std::string Race::finish_text(const Racer& racer) const {
  return clock_ == Measure::time ? seconds_text(racer.seconds.value_or(0)) : clock_text(finish(racer));
}

std::string Race::place_text() const {
  const std::string now = clock_ == Measure::time ? clock_text(at_) : grouped(at_);
  return fmt::format("{} of {}", now, clock_text(end()));
}

void Race::change_speed(int direction) {
  const int first = clock_ == Measure::time ? size32(rates) : 0;
  speed_ = std::clamp(speed_ + direction, first, static_cast<int>(rates.size() + lengths.size()) - 1);
}

std::string Race::speed_text() const {
  const std::size_t at = speed_;
  if (at < rates.size()) return fmt::format("{} {}/s", rates[at], word_of(clock_));
  return fmt::format("all in {} s", lengths[at - rates.size()]);
}

double Race::a_second() const {
  const std::size_t at = speed_;
  return at < rates.size() ? rates[at] : static_cast<double>(end()) / lengths[at - rates.size()];
}

double Race::play(double now) {
  constexpr double frame = 1.0 / 60;
  if (!playing) {
    played_until_ = -1, owed_ = 0;
    return 3600;
  }
  if (played_until_ < 0 || now - played_until_ > 1) played_until_ = now;
  owed_ += (now - std::exchange(played_until_, now)) * a_second();
  const double whole = std::floor(owed_);
  owed_ -= whole;
  if (whole > 0) go_to(at_ + std::llround(whole));
  playing = at_ < end();
  return std::max(frame, (1 - owed_) / std::max(a_second(), 1e-3));
}

// --- The chart

void GrowthChart::begin(const Race& race) {
  of.clear(), lines.clear();
  for (const auto& racer : race.racers()) of.push_back(racer->entrant), lines.push_back({racer->entrant.title, {}, ""});
  next = 0, shown = 0, at_work = true;
}

void GrowthChart::measure_next(const std::function<bool()>& ends) {
  const auto skips = [&] { return next < cells() && !lines[next % of.size()].ended.empty(); };
  try {
    if (next < cells() && !skips())
      measure_more(lines[next % of.size()], of[next % of.size()], compare::growth_sizes[next / of.size()],
                   tick_of(ends));
    do ++next;
    while (skips());
    at_work = next < cells();
  } catch (const Ended&) {
    at_work = false;
  }
}

std::string GrowthChart::next_text() const {
  if (next >= cells()) return "";
  return fmt::format("{}, {} polygons ({} of {})", of[next % of.size()].title,
                     grouped(compare::growth_sizes[next / of.size()]), next + 1, cells());
}

}  // namespace zstep::viewer
