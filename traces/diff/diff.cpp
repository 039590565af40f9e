#include "traces/diff/diff.hpp"

#include <algorithm>
#include <iterator>
#include <optional>
#include <tuple>
#include <unordered_map>
#include <utility>

#include "traces/diff/causes.hpp"
#include "traces/diff/in_step.hpp"
#include "traces/diff/parting.hpp"
#include "traces/diff/seen.hpp"
#include "traces/scene.hpp"

namespace zstep::diff {

namespace {

/// Beyond so many steps whose partner has not come yet the comparison ends.
constexpr std::size_t most_waiting = 3'000'000;

/// Is this kind compared? What is done to pixels also where a run never came to it, if it was to print what its
/// pseudo-code has a line for: that may be the mistake.
bool may_record(const Trace& trace, std::uint8_t kind, Unrecorded unrecorded) {
  if (trace.has(kind)) return true;
  if (unrecorded == Unrecorded::left_out) return false;
  using enum AtPixel;
  return has(at_pixel_of(kind), verdict | keeps | colors) && records(trace.header(), kind);
}

Both recorded_by_both(const Trace& a, const Trace& b, Unrecorded unrecorded) {
  Both both{};
  for (std::size_t at = 0; at < kind_count; ++at) {
    const auto kind = static_cast<std::uint8_t>(at);
    both[at] = may_record(a, kind, unrecorded) && may_record(b, kind, unrecorded);
  }
  // A program of the same method that has no such step says nothing of turns.
  both.turns = a.header().algorithm != b.header().algorithm && says_turns(a) && says_turns(b);
  for (const Trace* run : {&a, &b}) both.ahead = both.ahead || run->spans_at_once() != Trace::SpansAtOnce::of_polygon;
  // One list of all polygons' edges is another list than that of each polygon.
  if (a.has(kind_of<TablesBegin>) != b.has(kind_of<TablesBegin>))
    for (const std::uint8_t kind : {kind_of<ScanLineBegin>, kind_of<EdgeEnter>, kind_of<EdgeSwap>}) both[kind] = false;
  return both;
}

class Aligner {
 public:
  Aligner(const Trace& a, const Trace& b, bool plain, std::size_t keeps, Unrecorded unrecorded)
      : both_(recorded_by_both(a, b, unrecorded)),
        a_(a, both_),
        b_(b, both_),
        in_step_(a_, b_, found_, plain || both_.ahead),
        plain_(plain) {
    found_.keeps = keeps, found_.compared = both_, found_.turns = both_.turns;
  }

  /// In step as far as that goes; then each step by what it is about, until the runs are in step again. Which steps are
  /// pairs does not hang on that: of steps about the same, the first is the partner of the first, and so on.
  Alignment run(const std::function<bool(double)>& on_way) {
    do {
      if (in_step_.go_on(on_way)) continue;
      found_.complete = false;
      break;
    } while (apart(on_way));
    found_.identical = found_.complete && in_step_.identical();
    if (found_.complete) leave_over();
    return finish();
  }

 private:
  /// By what the steps are about; true where both runs are in step again.
  bool apart(const std::function<bool(double)>& on_way) {
    in_step_.part();
    const std::int64_t all = std::max<std::int64_t>(a_.trace.size() + b_.trace.size(), 1);
    bool turn_of_a = true;
    for (std::int64_t round = 1;; ++round) {
      const bool too_many = a_.waiting.size() + b_.waiting.size() > most_waiting;
      if (too_many || (round % 16384 == 0 && on_way && on_way(ratio(a_.steps.read() + b_.steps.read(), all))))
        return found_.complete = false;
      // Whose steps come later than their partners catches up first.
      Turn a, b;
      if (turn_of_a) a = take_turn(a_, b_);
      if (!a.paired) b = take_turn(b_, a_);
      if ((a.in_step || b.in_step) && !plain_) return true;
      if (turn_of_a && !a.read && !b.read) return false;
      turn_of_a = !b.paired;
    }
  }

  struct Turn {
    bool read = false, paired = false;
    bool in_step = false;  ///< with the step that the other run did last
  };
  Turn take_turn(Run& own, Run& other) {
    const std::optional<Keyed> step = own.read();
    if (!step) return {};
    own.last = step->position;
    if (const auto partner = other.waiting.take(step->known.about)) {
      &own == &a_ ? pair(*step, *partner) : pair(*partner, *step);
      return {true, true, partner->position == other.last};
    }
    own.waiting.put(*step);
    return {true, false, false};
  }

  void pair(const Keyed& a, const Keyed& b) {
    extend(found_.by_b, a.position, b.position, 1);
    const auto kind = static_cast<std::uint8_t>(a.event.event.index());
    KindCount& count = found_.kinds[kind];
    ++count.pairs;
    const Parting parted = visit_event(
        [&]<class E>(const E& of_a) {
          const E* of_b = get_if<E>(&b.event.event);
          if (!of_b) return Parting{};  // two keys that are equal by chance
          return parting(of_a, *of_b,
                         [&](std::size_t thing) { return a.known.results[thing] == b.known.results[thing]; });
        },
        a.event.event);
    if (parted.fields != 0) found_.differs({a.position, b.position, parted.fields, kind, b.event.step, parted.off});
    else ++count.equal;
  }

  void leave_over() {
    // A polygon may be cut otherwise in the other run, so that a pixel is painted of another piece of it.
    std::unordered_map<Identity::Key, std::vector<Keyed>> paints;
    each_in_order(a_.waiting, [&](const Keyed& step) {
      if (const auto* paint = get_if<PixelPaint>(&step.event.event))
        paints[Identity::of_any_piece(*paint)].push_back(step);
      else only(step.position, 0, step);
    });
    each_in_order(b_.waiting, [&](const Keyed& step) {
      const auto* paint = get_if<PixelPaint>(&step.event.event);
      const auto partners = paint ? paints.find(Identity::of_any_piece(*paint)) : paints.end();
      if (partners == paints.end() || partners->second.empty()) return only(0, step.position, step);
      pair(partners->second.front(), step);
      partners->second.erase(partners->second.begin());
    });
    for (const auto& [key, steps] : paints)
      for (const Keyed& step : steps) only(step.position, 0, step);
  }
  template <class Visit>
  static void each_in_order(const Waiting& waiting, Visit&& visit) {
    std::vector<Keyed> steps;
    waiting.each([&](const Keyed& step) { steps.push_back(step); });
    std::sort(steps.begin(), steps.end(),
              [](const Keyed& one, const Keyed& other) { return one.position < other.position; });
    for (const Keyed& step : steps) visit(step);
  }
  void only(std::int64_t a, std::int64_t b, const Keyed& step) {
    const auto kind = static_cast<std::uint8_t>(step.event.event.index());
    found_.differs({a, b, 0, kind, step.event.step, 0});
    ++(a != 0 ? found_.kinds[kind].only_a : found_.kinds[kind].only_b);
  }

  Alignment finish() {
    // Pairs are found in the order in which the later of their two steps comes.
    const auto of_b = [](const auto& one, const auto& other) { return one.b < other.b; };
    std::vector<Match> sorted = std::move(found_.by_b);
    std::sort(sorted.begin(), sorted.end(), of_b);
    found_.by_b.clear();
    for (const Match& match : sorted) {
      Match* last = found_.by_b.empty() ? nullptr : &found_.by_b.back();
      if (last && last->a + last->count == match.a && last->b + last->count == match.b) last->count += match.count;
      else found_.by_b.push_back(match);
    }
    found_.by_a = found_.by_b;
    std::sort(found_.by_a.begin(), found_.by_a.end(),
              [](const auto& one, const auto& other) { return one.a < other.a; });
    // Most runs that differ often do so in step, and their differences are in order already.
    std::vector<Difference>& differences = found_.differences;
    const auto place_of = [&](const Difference& one) { return one.only_a() ? found_.before_in_b(one.a) : one.b; };
    const auto earlier = [](const auto& one, const auto& other) {
      const auto order = [](const auto& place) {
        return std::tuple(place.first, place.second.only_a(), place.second.a);
      };
      return order(one) < order(other);
    };
    if (std::is_sorted(differences.begin(), differences.end(), [&](const Difference& one, const Difference& other) {
          return earlier(std::pair(place_of(one), one), std::pair(place_of(other), other));
        }))
      return std::move(found_);
    std::vector<std::pair<std::int64_t, Difference>> placed;
    placed.reserve(differences.size());
    for (const Difference& difference : differences) placed.emplace_back(place_of(difference), difference);
    std::sort(placed.begin(), placed.end(), earlier);
    for (std::size_t i = 0; i < placed.size(); ++i) differences[i] = placed[i].second;
    return std::move(found_);
  }

  const Both both_;
  Run a_, b_;
  Alignment found_{};
  InStep in_step_;
  bool plain_;
};

}  // namespace

namespace {

/// The last match that begins at or before a step.
template <std::int64_t Match::*own>
const Match* match_at(const std::vector<Match>& matches, std::int64_t step) {
  const auto next = std::upper_bound(matches.begin(), matches.end(), step,
                                     [](std::int64_t at, const Match& match) { return at < match.*own; });
  return next == matches.begin() ? nullptr : &*std::prev(next);
}

template <std::int64_t Match::*own, std::int64_t Match::*other>
std::int64_t partner(const std::vector<Match>& matches, std::int64_t step) {
  const Match* match = match_at<own>(matches, step);
  return match && step < match->*own + match->count ? match->*other + (step - match->*own) : 0;
}
template <std::int64_t Match::*own, std::int64_t Match::*other>
std::int64_t partner_before(const std::vector<Match>& matches, std::int64_t step) {
  const Match* match = match_at<own>(matches, step);
  return match ? match->*other + std::min(step - match->*own, match->count - 1) : 0;
}

}  // namespace

void Alignment::differs(const Difference& difference) {
  if (differences.size() < keeps) return differences.push_back(difference);
  ++not_kept;
  if (!difference.only_a() && !difference.only_b()) ++kinds[difference.kind].not_kept;
}

std::int64_t Alignment::in_b(std::int64_t step) const { return partner<&Match::a, &Match::b>(by_a, step); }
std::int64_t Alignment::in_a(std::int64_t step) const { return partner<&Match::b, &Match::a>(by_b, step); }
std::int64_t Alignment::before_in_b(std::int64_t step) const {
  return partner_before<&Match::a, &Match::b>(by_a, step);
}
std::int64_t Alignment::before_in_a(std::int64_t step) const {
  return partner_before<&Match::b, &Match::a>(by_b, step);
}

Alignment align(const Trace& a, const Trace& b, const std::function<bool(double)>& on_way, Way way, std::size_t keeps,
                Unrecorded unrecorded) {
  return Aligner(a, b, way == Way::plain, keeps, unrecorded).run(on_way);
}

std::int64_t DiffReport::differences() const {
  std::int64_t all = 0;
  for (const Cause& cause : causes)
    if (cause.part == Part::different) all += 1 + cause.again + cause.symptoms;
  return all;
}

DiffReport compare(const Trace& a, const Trace& b, const std::function<bool(double)>& on_way, Way way,
                   const HeldTo& held, std::size_t keeps, Unrecorded unrecorded) {
  DiffReport report;
  bool told_to_end = false;
  const auto part_of = [&](double from, double share) {
    return [&, from, share](double done) { return on_way && (told_to_end = on_way(from + share * done)); };
  };
  report.alignment = align(a, b, part_of(0, 0.5), way, keeps, unrecorded);
  const Precision of_a = precision_of(a, held), of_b = precision_of(b, held);
  const bool a_coarser = of_a.relative > of_b.relative || of_a.absolute > of_b.absolute;
  report.precision = a_coarser ? of_a : of_b;
  report.precision.relative = std::max(of_a.relative, of_b.relative);
  report.precision.absolute = std::max(of_a.absolute, of_b.absolute);
  if (of_a.positions != of_b.positions) report.precision.positions = std::max(of_a.amount("px"), of_b.amount("px"));
  for (std::size_t kind = 0; kind < kind_count; ++kind) {
    const KindCount& count = report.alignment.kinds[kind];
    report.kinds[kind] = {count.equal, 0, 0, count.only_a, count.only_b, 0, 0, count.not_kept};
  }
  if (report.alignment.differences.empty()) {
    find_wrong_order(b, report);
    return report;
  }

  std::vector<Finding> in_a(report.alignment.differences.size()), in_b = in_a;
  std::vector<Elsewhere> elsewhere;
  const auto at_step = [&](const Trace& trace, double from, double share) {
    return
        [&, on_share = part_of(from, share)](std::int64_t position) { return on_share(ratio(position, trace.size())); };
  };
  const BeforeFirst begin_a = go_to_first(a, true, report, at_step(a, 0.5, 0.1), way);
  const BeforeFirst begin_b = go_to_first(b, false, report, at_step(b, 0.6, 0.1), way);
  const auto go_through = [&](bool of_a_run, double from) {
    if (told_to_end) return;
    const Trace& trace = of_a_run ? a : b;
    elsewhere = follow(trace, of_a_run, report, of_a_run ? begin_a : begin_b, elsewhere, of_a_run ? in_a : in_b,
                       at_step(trace, from, 0.1), way);
  };
  // What only one run does is not seen in going through the other: so the one that was gone through first is gone
  // through again.
  go_through(true, 0.7);
  go_through(false, 0.8);
  go_through(true, 0.9);
  if (told_to_end) report.alignment.complete = false;
  find_causes(report, in_a, in_b);
  join_moved(a, b, report);
  find_other_order(a, b, report);
  find_wrong_order(b, report);
  return report;
}

}  // namespace zstep::diff
