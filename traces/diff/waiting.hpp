// Steps of a run that wait for their partner in the other one.
#pragma once

#include <cstdint>
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
  void put(const Keyed& step) {
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

}  // namespace zstep::diff
