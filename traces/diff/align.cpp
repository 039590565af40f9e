#include "traces/diff/align.hpp"

#include <algorithm>
#include <iterator>
#include <tuple>
#include <utility>

#include "traces/diff/in_step.hpp"
#include "traces/diff/parting.hpp"
#include "traces/diff/waiting.hpp"
#include "traces/file/trace_impl.hpp"

namespace zstep::diff {

namespace {

/// Beyond so many steps whose partner has not come yet the comparison ends.
constexpr std::size_t most_waiting = 3'000'000;

/// Does a run record this kind? What is done to pixels, and that edges leave the list, it does where its pseudo-code
/// has a line for it, also if it never came to it: that may be the mistake.
bool may_record(const Trace& trace, std::uint8_t kind) {
  if (trace.has(kind)) return true;
  constexpr std::array of_pixels{kind_of<DepthCompare>, kind_of<DepthWrite>, kind_of<PixelWrite>, kind_of<PixelPaint>};
  const Page& page = trace.header().page;
  const bool of_list = kind == kind_of<EdgeRetire> && trace.has(kind_of<EdgeEnter>);
  return (of_list || std::find(of_pixels.begin(), of_pixels.end(), kind) != of_pixels.end()) &&
         std::any_of(page.begin(), page.end(), [&](const StepInfo& step) { return step.kind == kind; });
}

/// One run, read ahead a little, with what its steps are about.
class Reader {
 public:
  /// From the step after `position`.
  Reader(const Trace& trace, const Both& both, std::int64_t position, Identity identity, Begun begun)
      : trace_(trace), both_(both), identity_(std::move(identity)), begun_(std::move(begun)), position_(position) {}

  /// The next step, until it is asked for again; nullptr at the end.
  const Keyed* next() {
    while (next_ == ahead_.size()) {
      if (position_ >= trace_.size()) return nullptr;
      ahead_.clear(), next_ = 0;
      // Each block is decoded from its beginning: a part of it would cost as much.
      const auto& block = trace_.impl().blocks[trace_.impl().block_of(position_ + 1)].info;
      const std::int64_t end = block.first_position + static_cast<std::int64_t>(block.count);
      trace_.each(position_, end, [&](std::int64_t position, const RecordedEvent& event) {
        if (!both_[event.event.index()]) return true;
        const Identity::Known known = identity_.of(event.event);
        if (!begun_.again(event.event)) ahead_.push_back({known, position, event});
        return true;
      });
      position_ = end;
    }
    return &ahead_[next_++];
  }
  std::int64_t position() const { return position_; }

 private:
  const Trace& trace_;
  const Both& both_;
  Identity identity_;
  Begun begun_;
  std::vector<Keyed> ahead_;
  std::size_t next_ = 0;
  std::int64_t position_;
};

class Aligner {
 public:
  Aligner(const Trace& a, const Trace& b) : a_(a), b_(b) {
    for (std::size_t kind = 0; kind < kind_count; ++kind)
      both_[kind] = may_record(a, static_cast<std::uint8_t>(kind)) && may_record(b, static_cast<std::uint8_t>(kind));
    // One list of all polygons' edges is another list than that of each polygon.
    if (a.has(kind_of<TablesBegin>) != b.has(kind_of<TablesBegin>))
      for (const std::uint8_t kind : {kind_of<ScanLineBegin>, kind_of<EdgeEnter>, kind_of<EdgeSwap>})
        both_[kind] = false;
  }

  Alignment run(const std::function<bool(double)>& on_way) {
    InStep begun = go_in_step(a_, b_, both_, found_, on_way);
    found_.identical = begun.identical;
    found_.complete = !begun.told_to_end;
    if (found_.complete && !found_.identical) {
      Reader read_a(a_, both_, begun.a, std::move(begun.of_a), begun.begun);
      Reader read_b(b_, both_, begun.b, std::move(begun.of_b), begun.begun);
      match(read_a, read_b, on_way);
      if (found_.complete) leave_over();
    }
    return finish();
  }

 private:
  /// By what the steps are about.
  void match(Reader& read_a, Reader& read_b, const std::function<bool(double)>& on_way) {
    const double all = static_cast<double>(std::max<std::int64_t>(a_.size() + b_.size(), 1));
    for (std::int64_t round = 0;; ++round) {
      const Keyed *a = read_a.next(), *b = read_b.next();
      if (!a && !b) return;
      if (a && b && a->known.about == b->known.about && wait_a_.empty() && wait_b_.empty()) {
        pair(*a, *b);
      } else {
        if (a) meet(*a, wait_b_, wait_a_, [&](const Keyed& one, const Keyed& other) { pair(one, other); });
        if (b) meet(*b, wait_a_, wait_b_, [&](const Keyed& one, const Keyed& other) { pair(other, one); });
      }
      const bool too_many = wait_a_.size() + wait_b_.size() > most_waiting ||
                            found_.differences.size() > most_differences;
      if (too_many || (round % 16384 == 0 && on_way &&
                       on_way(static_cast<double>(read_a.position() + read_b.position()) / all))) {
        found_.complete = false;
        return;
      }
    }
  }
  template <class Pair>
  void meet(const Keyed& step, Waiting& others, Waiting& own, Pair&& pair) {
    if (const auto partner = others.take(step.known.about)) pair(step, *partner);
    else own.put(step);
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
    if (parted.fields != 0)
      found_.differences.push_back({a.position, b.position, parted.fields, kind, b.event.step, parted.off});
    else ++count.equal;
  }

  void leave_over() {
    wait_b_.each([&](const Keyed& step) { only(0, step.position, step); });
    wait_a_.each([&](const Keyed& step) { only(step.position, 0, step); });
  }
  void only(std::int64_t a, std::int64_t b, const Keyed& step) {
    const auto kind = static_cast<std::uint8_t>(step.event.event.index());
    found_.differences.push_back({a, b, 0, kind, step.event.step, 0});
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
      if (last && last->a + last->count == match.a && last->b + last->count == match.b)
        last->count += match.count;
      else found_.by_b.push_back(match);
    }
    found_.by_a = found_.by_b;
    std::sort(found_.by_a.begin(), found_.by_a.end(),
              [](const auto& one, const auto& other) { return one.a < other.a; });
    std::vector<std::pair<std::int64_t, Difference>> placed;
    placed.reserve(found_.differences.size());
    for (const Difference& difference : found_.differences)
      placed.emplace_back(difference.only_a() ? found_.before_in_b(difference.a) : difference.b, difference);
    std::sort(placed.begin(), placed.end(), [](const auto& one, const auto& other) {
      const auto order = [](const auto& place) {
        return std::tuple(place.first, place.second.only_a(), place.second.a);
      };
      return order(one) < order(other);
    });
    for (std::size_t i = 0; i < placed.size(); ++i) found_.differences[i] = placed[i].second;
    return std::move(found_);
  }

  const Trace &a_, &b_;
  Both both_{};
  Waiting wait_a_, wait_b_;
  Alignment found_{};
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

std::int64_t Alignment::in_b(std::int64_t step) const { return partner<&Match::a, &Match::b>(by_a, step); }
std::int64_t Alignment::in_a(std::int64_t step) const { return partner<&Match::b, &Match::a>(by_b, step); }
std::int64_t Alignment::before_in_b(std::int64_t step) const {
  return partner_before<&Match::a, &Match::b>(by_a, step);
}
std::int64_t Alignment::before_in_a(std::int64_t step) const {
  return partner_before<&Match::b, &Match::a>(by_b, step);
}

Alignment align(const Trace& a, const Trace& b, const std::function<bool(double)>& on_way) {
  return Aligner(a, b).run(on_way);
}

}  // namespace zstep::diff
