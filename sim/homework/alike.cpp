#include "sim/homework/alike.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <map>
#include <numeric>
#include <set>
#include <type_traits>

#include "traces/events/slots.hpp"

namespace zstep::homework {

namespace {

/// So many hashes are kept of a run; a run has as many entries in the index by which like ones are found.
constexpr std::size_t kept_hashes = 128, indexed_hashes = 16;
/// Runs are alike from this share on; scenes are different up to that one.
constexpr double alike_from = 0.8, different_to = 0.2;
/// Fewer steps or numbers can be the same by chance: of a program that was hardly begun, say.
constexpr std::int64_t fewest_telling = 20;

std::uint64_t mixed_bits(std::uint64_t value) {  // the finalizer of SplitMix64 (G. L. Steele et al., 2014)
  value += 0x9e3779b97f4a7c15;
  value = (value ^ value >> 30) * 0xbf58476d1ce4e5b9;
  value = (value ^ value >> 27) * 0x94d049bb133111eb;
  return value ^ value >> 31;
}

/// The number to about 12 bits. Where it goes to the next one lies off the numbers of few bits, which scenes have.
double number_of_few_bits(double value) {
  constexpr int bits = 12;
  constexpr double off = 0.3;
  int exponent = 0;
  const double part = std::frexp(value, &exponent);
  return std::ldexp(std::floor(std::ldexp(part, bits) + 0.5 + off), exponent - bits);
}

struct OwnItem {
  std::size_t who = 0;
  bool right = false;  ///< the right run of the student's scene; else what the student handed in
  const OwnRun* of = nullptr;
  const Sketch& sketch() const { return right ? of->right : of->run; }
};

/// Who belongs together; each set is known by one of its members.
class JoinedSets {
 public:
  explicit JoinedSets(std::size_t count) : up_(count) { std::iota(up_.begin(), up_.end(), std::size_t{0}); }
  std::size_t of(std::size_t one) {
    while (up_[one] != one) one = up_[one] = up_[up_[one]];
    return one;
  }
  void join(std::size_t a, std::size_t b) {
    a = of(a), b = of(b);
    up_[std::max(a, b)] = std::min(a, b);
  }

 private:
  std::vector<std::size_t> up_;
};

bool is_telling(const Sketch& sketch) { return sketch.steps >= fewest_telling && sketch.numbers >= fewest_telling; }

class AlikeFinder {
 public:
  explicit AlikeFinder(std::vector<OwnItem> items) : items_(std::move(items)), sets_(items_.size()) { compare(); }

  /// The sets of runs that are alike.
  std::vector<AlikeRuns> found(const std::vector<HandedIn>& all) {
    std::map<std::size_t, std::vector<const OwnItem*>> by_set;
    std::map<std::size_t, std::set<std::string>> right_for;
    for (std::size_t i = 0; i < items_.size(); ++i)
      if (!items_[i].right) by_set[sets_.of(i)].push_back(&items_[i]);
    for (const auto& [run, right] : answers_) right_for[sets_.of(run)].insert(all[items_[right].who].name);
    std::vector<AlikeRuns> found;
    for (const auto& [set, runs] : by_set) {
      const std::set<std::string>& whose = right_for[set];
      if (runs.size() < 2 && whose.empty()) continue;
      AlikeRuns one;
      one.scene = runs.front()->of->scene;
      one.steps = runs.front()->sketch().steps;
      for (const OwnItem* run : runs) {
        one.names.push_back(all[run->who].name);
        one.same = one.same && run->sketch().whole == runs.front()->sketch().whole;
        one.share = std::min(one.share, in_common(run->sketch(), runs.front()->sketch()));
      }
      one.right_for.assign(whose.begin(), whose.end());
      found.push_back(std::move(one));
    }
    return found;
  }

 private:
  /// Those with a hash of the least in common are held against the first few of them that are not alike.
  void compare() {
    std::vector<std::pair<std::uint64_t, std::size_t>> index;
    for (std::size_t i = 0; i < items_.size(); ++i) {
      const std::vector<std::uint64_t>& least = items_[i].sketch().least;
      for (std::size_t k = 0; k < std::min(indexed_hashes, least.size()); ++k) index.emplace_back(least[k], i);
    }
    std::sort(index.begin(), index.end());
    constexpr std::size_t few = 8;
    std::vector<std::size_t> first;
    for (std::size_t at = 0; at < index.size(); ++at) {
      if (at == 0 || index[at].first != index[at - 1].first) first.clear();
      const std::size_t item = index[at].second;
      bool known = false;
      for (const std::size_t other : first) known = look_at(other, item) || known;
      if (!known && first.size() < few) first.push_back(item);
    }
  }
  /// Whether they are two runs that are alike.
  bool look_at(std::size_t a, std::size_t b) {
    const OwnItem &one = items_[a], &other = items_[b];
    if (one.who == other.who || (one.right && other.right)) return false;
    if (in_common(one.sketch(), other.sketch()) < alike_from) return false;
    if (in_common(one.of->right, other.of->right) > different_to) return false;  // their scenes explain it
    if (one.right || other.right) {
      answers_.emplace_back(one.right ? b : a, one.right ? a : b);
      return false;
    }
    sets_.join(a, b);
    return true;
  }

  std::vector<OwnItem> items_;
  JoinedSets sets_;
  std::vector<std::pair<std::size_t, std::size_t>> answers_;  ///< runs, and the right runs of others that they are
};

}  // namespace

Sketch sketch_of(const Trace& run, const std::vector<grade::Part>& parts) {
  std::set<std::size_t> kinds;
  for (const grade::Part& part : parts) kinds.insert(part.kinds.begin(), part.kinds.end());
  std::vector<std::uint64_t> hashes, numbers;
  run.each(0, run.size(), [&](std::int64_t, const RecordedEvent& recorded) {
    if (!kinds.contains(recorded.event.index())) return true;
    std::uint64_t hash = mixed_bits(recorded.event.index());
    bool holds_number = false;
    visit_event(
        [&]<class E>(const E& event) {
          for_each_field<E>([&](const auto& field) {
            using Value = typename std::remove_cvref_t<decltype(field)>::value_type;
            if constexpr (std::is_same_v<Value, double>) {
              const double value = event.*field.member;
              const bool tells = std::isfinite(value) && value != 0;
              const auto bits = std::bit_cast<std::uint64_t>(tells ? number_of_few_bits(value) : 0.0);
              if (tells) numbers.push_back(bits);
              holds_number = holds_number || tells;
              hash = mixed_bits(hash ^ bits);
            } else {
              hash = mixed_bits(hash ^ static_cast<std::uint64_t>(event.*field.member));
            }
          });
        },
        recorded.event);
    if (holds_number) hashes.push_back(hash);
    return true;
  });
  for (auto* of : {&hashes, &numbers}) {
    std::sort(of->begin(), of->end());
    of->erase(std::unique(of->begin(), of->end()), of->end());
  }
  Sketch sketch;
  sketch.steps = static_cast<std::int64_t>(hashes.size());
  sketch.numbers = static_cast<std::int64_t>(numbers.size());
  sketch.whole = std::accumulate(hashes.begin(), hashes.end(), std::uint64_t{0});
  hashes.resize(std::min(hashes.size(), kept_hashes));
  sketch.least = std::move(hashes);
  return sketch;
}

double in_common(const Sketch& a, const Sketch& b) {
  std::size_t both = 0, either = 0;
  auto in_a = a.least.begin(), in_b = b.least.begin();
  // The least of what either has: as far as one is known to its end, or both are.
  while (either < kept_hashes && (in_a != a.least.end() || in_b != b.least.end())) {
    const bool from_a = in_b == b.least.end() || (in_a != a.least.end() && *in_a <= *in_b);
    const bool from_b = in_a == a.least.end() || (in_b != b.least.end() && *in_b <= *in_a);
    both += from_a && from_b, ++either;
    in_a += from_a, in_b += from_b;
  }
  return either == 0 ? 0 : static_cast<double>(both) / static_cast<double>(either);
}

std::vector<AlikeRuns> alike_runs(const std::vector<HandedIn>& all, const std::vector<Sketch>& right_public) {
  std::map<std::string, std::vector<OwnItem>> by_scene;
  for (std::size_t who = 0; who < all.size(); ++who)
    for (const OwnRun& run : all[who].runs) {
      const bool is_public = std::any_of(right_public.begin(), right_public.end(),
                                         [&](const Sketch& right) { return in_common(run.run, right) >= alike_from; });
      if (is_telling(run.run) && !is_public) by_scene[run.scene].push_back({who, false, &run});
      if (is_telling(run.right)) by_scene[run.scene].push_back({who, true, &run});
    }
  std::vector<AlikeRuns> found;
  for (auto& [scene, items] : by_scene)
    for (AlikeRuns& one : AlikeFinder(std::move(items)).found(all)) found.push_back(std::move(one));
  return found;
}

}  // namespace zstep::homework
