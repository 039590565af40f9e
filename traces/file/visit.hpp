// Trace::visit: every event of a range, typed, straight from the packed columns.
#pragma once

#include <algorithm>

#include "traces/file/trace_impl.hpp"

namespace zstep {

namespace detail {

/// Gives a reader of a range what it is to see of a block's events, with their positions.
template <class Visit>
struct VisitRange {
  Visit& visit;
  std::int64_t first, last, position;
  bool go_on = true;

  template <class E>
  bool operator()(std::uint8_t step, const E& event) {
    ++position;
    if (position <= first) return true;
    if (position > last) return false;
    go_on = visit(position, step, event);
    return go_on;
  }
  bool operator()(const codec::Row& row) { return take(row); }
  bool operator()(const codec::FragmentRun& run) { return take(run); }
  bool operator()(const codec::PaintRun& run) { return take(run); }

 private:
  template <class Run>
  bool take(const Run& run) {
    const std::int64_t end = position + run.events();
    if (end <= first) {
      position = end;
      return true;
    }
    if (position >= first && end <= last) {
      if constexpr (requires { visit(position, run); }) {
        go_on = visit(position, run);
        position = end;
      } else {
        std::int64_t at = position;
        go_on = run.expand(
            [&](std::uint8_t step, const auto& event) { return static_cast<bool>(visit(++at, step, event)); });
        position = at;
      }
      return go_on;
    }
    return run.expand([&](std::uint8_t step, const auto& event) { return (*this)(step, event); });
  }
};

}  // namespace detail

template <class Visit>
void Trace::visit(std::int64_t first, std::int64_t last, Visit&& visit) const {
  first = std::max<std::int64_t>(first, 0);
  last = std::min(last, size());
  while (first < last) {
    const std::size_t index = impl_->block_of(first + 1);
    const Impl::Block& block = impl_->blocks[index];
    detail::VisitRange<Visit> range{visit, first, last, block.info.first_position};
    const Bytes* packed = impl_->packed(index);
    if (packed == nullptr) {
      first = block.info.first_position + block.info.count;
      continue;
    }
    try {
      BlockDecoder decoder(*packed, block.info.count, *impl_->meanings, *impl_->facts);
      decoder.visit_all(range);
    } catch (const MalformedBytes& error) {
      impl_->damaged(index, error.what());
    }
    if (!range.go_on) return;
    first = block.info.first_position + block.info.count;
  }
}

}  // namespace zstep
