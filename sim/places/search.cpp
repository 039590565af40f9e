#include "sim/places/search.hpp"

#include <algorithm>

#include "traces/file/visit.hpp"
#include "traces/scene.hpp"

namespace zstep::places {

Search::Search(const Trace& trace, Condition condition, std::int64_t from, Way way)
    : trace_(&trace),
      condition_(std::move(condition)),
      way_(way),
      from_(std::clamp<std::int64_t>(from, 0, trace.size() + 1)),
      at_(from_) {
  const Bounds& bounds = condition_.bounds();
  const std::int64_t first = std::max(bounds.first, forwards() ? from_ + 1 : 1);
  const std::int64_t last = std::min({bounds.last, trace.size(), forwards() ? trace.size() : from_ - 1});
  const auto add = [&](std::int64_t begin, std::int64_t end) {
    begin = std::max(begin, first), end = std::min(end, last);
    if (begin <= end) intervals_.push_back({begin, end});
  };
  // Where work on polygons begins is known without reading a block.
  const auto marks = trace.polygons();
  std::bitset<kind_count> marked;
  marked.set(kind_of<PolygonBegin>).set(kind_of<PieceDraw>);
  if ((bounds.kinds & ~marked).none() || bounds.polygon) {
    const bool beginnings = (bounds.kinds & ~marked).none();
    for (std::size_t i = 0; i < marks.size(); ++i) {
      if (bounds.polygon && marks[i].polygon != *bounds.polygon) continue;
      add(marks[i].position, beginnings             ? marks[i].position
                             : i + 1 < marks.size() ? marks[i + 1].position - 1
                                                    : trace.size());
    }
    if (bounds.polygon == no_polygon) add(1, marks.empty() ? trace.size() : marks[0].position - 1);
  } else {
    add(first, last);
  }
  std::sort(intervals_.begin(), intervals_.end(),
            [&](const Interval& a, const Interval& b) { return forwards() ? a.first > b.first : a.first < b.first; });
}

double Search::share() const {
  const std::int64_t end = forwards() ? trace_->size() : 0;
  return end == from_ ? 1 : ratio(at_ - from_, end - from_);
}

/// Drops intervals that are behind, and goes to the beginning of the next one.
bool Search::next_interval() {
  while (!intervals_.empty() && (forwards() ? intervals_.back().last <= at_ : intervals_.back().first >= at_))
    intervals_.pop_back();
  if (intervals_.empty()) return false;
  at_ = forwards() ? std::max(at_, intervals_.back().first - 1) : std::min(at_, intervals_.back().last + 1);
  return true;
}

Search::Result Search::look_in_interval() {
  if (waiting_.empty()) look_in_block();
  const bool found = !waiting_.empty();
  at_ = found ? waiting_.back() : looked_to_;
  if (found) waiting_.pop_back();
  return found ? Result::found : Result::not_yet;
}

/// All that is found in the rest of a block.
void Search::look_in_block() {
  const Interval& interval = intervals_.back();
  const Bounds& bounds = condition_.bounds();
  Trace::Among among(bounds.pixel);
  if (bounds.kinds.count() == 1)
    for (std::size_t kind = 0; kind < kind_count; ++kind)
      if (bounds.kinds[kind]) among.kind = static_cast<std::uint8_t>(kind);
  const BlockInfo& block = trace_->impl().blocks[trace_->impl().block_of(forwards() ? at_ + 1 : at_ - 1)].info;
  looked_to_ = forwards() ? std::min(interval.last, block.first_position + block.count)
                          : std::max(interval.first, block.first_position + 1);
  among.until = looked_to_;
  const auto take = [&](std::int64_t step, const RecordedEvent& event) {
    if (condition_.holds(step, event)) waiting_.push_back(step);
    return false;
  };
  if (forwards()) trace_->next_at(at_, take, among);
  else trace_->previous_at(at_, take, among);
  if (forwards()) std::reverse(waiting_.begin(), waiting_.end());
}

Search::Result Search::look(std::chrono::microseconds time) {
  const auto end = std::chrono::steady_clock::now() + time;
  for (bool looked = false; result_ == Result::not_yet; looked = true) {
    if (!next_interval()) {
      at_ = forwards() ? trace_->size() : 0;
      return result_ = Result::none;
    }
    if (looked && std::chrono::steady_clock::now() >= end) return Result::not_yet;  // there is more to look at
    if (look_in_interval() == Result::found) return result_ = Result::found;
  }
  return result_;
}

}  // namespace zstep::places
