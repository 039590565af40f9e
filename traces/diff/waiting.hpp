// Steps of a run that wait for their partner in the other one.
#pragma once

#include <array>
#include <bitset>
#include <cstdint>
#include <limits>
#include <optional>
#include <unordered_map>
#include <vector>

#include "traces/diff/identity.hpp"

namespace zstep::diff {

/// A step, and what it is about.
struct Keyed {
  Identity::Known known;
  std::int64_t position = 0;
  RecordedEvent event;
};

/// First come, first served: a chain of places for each thing that they are about.
class Waiting {
 public:
  bool empty() const { return chains_.empty(); }
  std::size_t size() const { return steps_.size() - free_.size(); }
  bool has(Identity::Key key) const { return chains_.contains(key); }
  /// Can a step of this kind with this hint be among them? Mostly not, and then nothing else needs to be asked.
  bool may_have(std::uint8_t kind, Identity::Hint hint) const { return of_kind_[kind] != 0 && hinted_[hint]; }
  void put(const Keyed& step) {
    if (++put_ > few + 2 * size()) {
      put_ = 0;
      hinted_.reset();
      each([&](const Keyed& other) { hinted_.set(other.known.hint); });
    }
    hinted_.set(step.known.hint);
    ++of_kind_[step.event.event.index()];
    std::uint32_t place = 0;
    if (free_.empty()) {
      place = static_cast<std::uint32_t>(steps_.size());
      steps_.push_back({step, end});
    } else {
      place = free_.back();
      free_.pop_back();
      steps_[place] = {step, end};
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
    --of_kind_[steps_[place].step.event.event.index()];
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
  static constexpr std::size_t few = 4096;
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
  std::array<std::uint32_t, kind_count> of_kind_{};
  std::bitset<std::size_t{std::numeric_limits<Identity::Hint>::max()} + 1> hinted_;  ///< also of some that have left
  std::size_t put_ = 0;                                                              ///< since those were forgotten
};

}  // namespace zstep::diff
