#include "traces/diff/align.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <limits>
#include <optional>
#include <tuple>
#include <unordered_map>
#include <unordered_set>

#include "traces/diff/identity.hpp"
#include "traces/file/visit.hpp"
#include "traces/replay/same.hpp"

namespace zstep::diff {

namespace {

/// Steps whose partner has not come yet, and differences that were found: beyond so many the comparison ends.
constexpr std::size_t most_waiting = 3'000'000, most_differences = 20'000'000;

struct Keyed {
  Identity::Known known;
  std::int64_t position = 0;
  RecordedEvent event;
};

/// One run, read ahead a little, with what its steps are about.
class Reader {
 public:
  Reader(const Trace& trace, const std::array<bool, kind_count>& both) : trace_(trace), both_(both), identity_(trace) {}

  bool next(Keyed& out) {
    while (next_ == ahead_.size()) {
      if (position_ >= trace_.size()) return false;
      ahead_.clear(), next_ = 0;
      trace_.each(position_, std::min(position_ + at_once, trace_.size()),
                  [&](std::int64_t position, const RecordedEvent& event) {
                    if (!both_[event.event.index()]) return true;
                    const Identity::Known known = identity_.of(event.event);
                    if (!taken_up_again(event.event)) ahead_.push_back({known, position, event});
                    return true;
                  });
      position_ = std::min(position_ + at_once, trace_.size());
    }
    out = ahead_[next_++];
    return true;
  }
  std::int64_t position() const { return position_; }

 private:
  /// Who works scan line by scan line comes back to a polygon.
  bool taken_up_again(const Event& event) {
    if (holds<BuffersClear>(event) || holds<PassBegin>(event)) begun_.clear();
    const auto* polygon = get_if<PolygonBegin>(&event);
    return polygon && !begun_.insert(polygon->polygon).second;
  }

  static constexpr std::int64_t at_once = 4096;
  const Trace& trace_;
  const std::array<bool, kind_count>& both_;
  Identity identity_;
  std::unordered_set<std::int32_t> begun_;  ///< polygons
  std::vector<Keyed> ahead_;
  std::size_t next_ = 0;
  std::int64_t position_ = 0;
};

/// Steps that wait for their partner, first come, first served: a chain of places for each thing that they are about.
class Waiting {
 public:
  bool empty() const { return chains_.empty(); }
  std::size_t size() const { return steps_.size() - free_.size(); }
  void put(Keyed&& step) {
    std::uint32_t place = 0;
    if (free_.empty()) {
      place = static_cast<std::uint32_t>(steps_.size());
      steps_.push_back({std::move(step), end});
    } else {
      place = free_.back();
      free_.pop_back();
      steps_[place] = {std::move(step), end};
    }
    const auto [chain, fresh] = chains_.try_emplace(steps_[place].step.known.about, Chain{place, place});
    if (fresh) return;
    steps_[chain->second.last].next = place;
    chain->second.last = place;
  }
  std::optional<Keyed> take(Identity::Key key) {
    const auto chain = chains_.find(key);
    if (chain == chains_.end()) return std::nullopt;
    const std::uint32_t place = chain->second.first;
    free_.push_back(place);
    if (place == chain->second.last) chains_.erase(chain);
    else chain->second.first = steps_[place].next;
    return steps_[place].step;
  }
  template <class Visit>
  void each(Visit&& visit) const {
    for (const auto& [key, chain] : chains_)
      for (std::uint32_t place = chain.first; place != end; place = steps_[place].next) visit(steps_[place].step);
  }

 private:
  static constexpr std::uint32_t end = 0xffffffff;
  struct Place {
    Keyed step;
    std::uint32_t next = end;
  };
  struct Chain {
    std::uint32_t first = 0, last = 0;
  };
  std::vector<Place> steps_;
  std::vector<std::uint32_t> free_;
  std::unordered_map<Identity::Key, Chain> chains_;
};

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

void extend(std::vector<Match>& matches, std::int64_t a, std::int64_t b) {
  if (!matches.empty()) {
    Match& last = matches.back();
    if (last.a + last.count == a && last.b + last.count == b) return void(++last.count);
  }
  matches.push_back({a, b, 1});
}

class Aligner {
 public:
  Aligner(const Trace& a, const Trace& b) : a_(a), b_(b), read_a_(a, both_), read_b_(b, both_) {
    for (std::size_t kind = 0; kind < kind_count; ++kind)
      both_[kind] = may_record(a, static_cast<std::uint8_t>(kind)) && may_record(b, static_cast<std::uint8_t>(kind));
    // One list of all polygons' edges is another list than that of each polygon.
    if (a.has(kind_of<TablesBegin>) != b.has(kind_of<TablesBegin>))
      for (const std::uint8_t kind : {kind_of<ScanLineBegin>, kind_of<EdgeEnter>, kind_of<EdgeSwap>})
        both_[kind] = false;
  }

  Alignment run(const std::function<bool(double)>& on_way) {
    const double all = static_cast<double>(std::max<std::int64_t>(a_.size() + b_.size(), 1));
    Keyed a, b;
    for (std::int64_t round = 0;; ++round) {
      const bool more_a = read_a_.next(a), more_b = read_b_.next(b);
      if (!more_a && !more_b) break;
      if (more_a && more_b && a.known.about == b.known.about && wait_a_.empty() && wait_b_.empty()) {
        pair(a, b);
      } else {
        if (more_a)
          meet(std::move(a), wait_b_, wait_a_, [&](const Keyed& one, const Keyed& other) { pair(one, other); });
        if (more_b)
          meet(std::move(b), wait_a_, wait_b_, [&](const Keyed& one, const Keyed& other) { pair(other, one); });
      }
      if (wait_a_.size() + wait_b_.size() > most_waiting || found_.differences.size() > most_differences) {
        found_.complete = false;
        break;
      }
      if (round % 16384 == 0 && on_way &&
          on_way(static_cast<double>(read_a_.position() + read_b_.position()) / all)) {
        found_.complete = false;
        break;
      }
    }
    if (found_.complete) leave_over();
    return finish();
  }

 private:
  template <class Pair>
  void meet(Keyed&& step, Waiting& others, Waiting& own, Pair&& pair) {
    if (const auto partner = others.take(step.known.about)) pair(step, *partner);
    else own.put(std::move(step));
  }

  void pair(const Keyed& a, const Keyed& b) {
    extend(found_.by_b, a.position, b.position);
    const auto kind = static_cast<std::uint8_t>(a.event.event.index());
    KindCount& count = found_.kinds[kind];
    ++count.pairs;
    float off = 0;
    if (const std::uint16_t fields = differing(a, b, off); fields != 0)
      found_.differences.push_back({a.position, b.position, fields, kind, b.event.step, off});
    else ++count.equal;
  }

  /// Which results differ; of numbers for things, whether they are the same thing.
  static std::uint16_t differing(const Keyed& one, const Keyed& other, float& off) {
    return visit_event(
        [&]<class E>(const E& a) -> std::uint16_t {
          const E* b = get_if<E>(&other.event.event);
          if (!b) return 0;  // two keys that are equal by chance
          std::uint16_t bits = 0;
          std::size_t thing = 0;
          for_each_index<E>([&]<std::size_t I>() {
            if constexpr (is_result<E, I>()) {
              const auto& mine = a.*field_at<E, I>.member;
              const auto& its = b->*field_at<E, I>.member;
              bool equal = false;
              if constexpr (thing_at<E, I>() != Thing::none) {
                equal = one.known.results[thing] == other.known.results[thing];
                ++thing;
              } else {
                equal = mine == its || same(mine, its);  // 0 and -0, NaN and NaN
              }
              if (!equal) bits = static_cast<std::uint16_t>(bits | 1u << I);
              if constexpr (std::is_same_v<FieldValue<E, I>, double>)
                if (!equal) off = std::max(off, static_cast<float>(share(mine, its)));
            }
          });
          return bits;
        },
        one.event.event);
  }

  static double share(double one, double other) {
    const double larger = std::max(std::abs(one), std::abs(other)), apart = std::abs(one - other);
    return std::isfinite(apart) ? apart / larger : std::numeric_limits<double>::infinity();
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
  std::array<bool, kind_count> both_{};
  Reader read_a_, read_b_;
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

namespace {

/// Runs of one program that are the same have the same blocks: then no event needs to be matched.
bool same_bytes(const Trace& a, const Trace& b) {
  if (a.size() != b.size() || !(a.header() == b.header()) || !(a.scene() == b.scene())) return false;
  const Trace::Impl &one = a.impl(), &other = b.impl();
  if (one.blocks.size() != other.blocks.size()) return false;
  for (std::size_t block = 0; block < one.blocks.size(); ++block) {
    if (one.blocks[block].info.count != other.blocks[block].info.count) return false;
    const Bytes *mine = one.packed(block), *its = other.packed(block);
    if (mine == nullptr || its == nullptr || *mine != *its) return false;
  }
  return true;
}

Alignment all_the_same(const Trace& trace) {
  Alignment found{};
  found.identical = true;
  if (trace.size() > 0) found.by_a = found.by_b = {{1, 1, trace.size()}};
  trace.visit(0, trace.size(), [&]<class E>(std::int64_t, std::uint8_t, const E&) {
    ++found.kinds[kind_of<E>].pairs;
    ++found.kinds[kind_of<E>].equal;
    return true;
  });
  return found;
}

}  // namespace

Alignment align(const Trace& a, const Trace& b, const std::function<bool(double)>& on_way) {
  return same_bytes(a, b) ? all_the_same(a) : Aligner(a, b).run(on_way);
}

}  // namespace zstep::diff
