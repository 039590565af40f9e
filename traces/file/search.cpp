// Trace::next and Trace::previous: block by block, and of a block only what can be meant.
#include <algorithm>
#include <functional>
#include <utility>

#include "traces/file/visit.hpp"

namespace zstep {

namespace {

/// Gives each event of a range that is meant to `each`, until it returns false.
using Each = std::function<bool(std::int64_t, const RecordedEvent&)>;  // one type, so that reading a block is compiled once

struct Search {
  const Trace::Among& among;
  Each each;
  bool stopped = false;

  template <class E>
  bool operator()(std::int64_t position, std::uint8_t step, const E& event) {
    if (among.kind && *among.kind != kind_of<E>) return true;
    if (among.pixel) {
      if constexpr (requires { event.x, event.y; }) {
        if (event.x != among.pixel->x || event.y != among.pixel->y) return true;
      } else {
        return true;
      }
    }
    stopped = !each(position, RecordedEvent{step, event});
    return !stopped;
  }
  bool operator()(std::int64_t before, const codec::FragmentRun& run) { return take(before, run); }
  bool operator()(std::int64_t before, const codec::PaintRun& run) { return take(before, run); }

 private:
  template <class Run>
  bool take(std::int64_t before, const Run& run) {
    const bool beside = among.pixel && (among.pixel->y != run.y || among.pixel->x < run.x || among.pixel->x >= run.end());
    if (beside || (among.kind && !run.has(*among.kind))) return true;
    std::int64_t position = before;
    return run.expand([&](std::uint8_t step, const auto& event) { return (*this)(++position, step, event); });
  }
};

Search search_for(const Trace::Among& among, Each each) { return {among, std::move(each)}; }

/// The steps that record a kind; all where none is asked for.
StepSet steps_of(const Page& page, std::optional<std::uint8_t> kind) {
  StepSet steps;
  for (const StepInfo& step : page)
    if (!kind || step.kind == *kind) steps.add(step.id);
  return steps;
}

bool may_hold(const BlockInfo& info, const StepSet& steps, const std::optional<Trace::Pixel>& pixel) {
  return info.steps.meets(steps) && (!pixel || info.tiles.touched(pixel->x, pixel->y));
}

}  // namespace

std::optional<std::int64_t> Trace::next(std::int64_t from, const Predicate& predicate, const Among& among) const {
  const StepSet steps = steps_of(header().page, among.kind);
  const std::int64_t end = std::min(size(), among.until.value_or(size()));
  for (std::int64_t position = std::max<std::int64_t>(from, 0); position < end;) {
    const BlockInfo& info = impl_->blocks[impl_->block_of(position + 1)].info;
    const std::int64_t block_end = std::min(end, info.first_position + info.count);
    if (may_hold(info, steps, among.pixel)) {
      std::optional<std::int64_t> found;
      visit(position, block_end, search_for(among, [&](std::int64_t at, const RecordedEvent& recorded) {
              if (predicate(recorded)) found = at;
              return !found;
            }));
      if (found) return found;
    }
    position = block_end;
  }
  return std::nullopt;
}

std::optional<std::int64_t> Trace::previous(std::int64_t from, const Predicate& predicate, const Among& among) const {
  const StepSet steps = steps_of(header().page, among.kind);
  const std::int64_t begin = std::max<std::int64_t>(0, among.until.value_or(1) - 1);
  for (std::int64_t position = std::min(from - 1, size()); position > begin;) {
    const BlockInfo& info = impl_->blocks[impl_->block_of(position)].info;
    const std::int64_t block_begin = std::max(begin, info.first_position);
    if (may_hold(info, steps, among.pixel)) {
      std::optional<std::int64_t> found;
      visit(block_begin, position, search_for(among, [&](std::int64_t at, const RecordedEvent& recorded) {
              if (predicate(recorded)) found = at;
              return true;
            }));
      if (found) return found;
    }
    position = block_begin;
  }
  return std::nullopt;
}

void Trace::scan(const Among& among, const std::function<bool(std::int64_t, const RecordedEvent&)>& each) const {
  const StepSet steps = steps_of(header().page, among.kind);
  const std::int64_t end = std::min(size(), among.until.value_or(size()));
  for (const Impl::Block& block : impl_->blocks) {
    if (block.info.first_position >= end) return;
    if (!may_hold(block.info, steps, among.pixel)) continue;
    auto search = search_for(among, each);
    visit(block.info.first_position, std::min(end, block.info.first_position + block.info.count), search);
    if (search.stopped) return;
  }
}

}  // namespace zstep
