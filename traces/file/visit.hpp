// Trace::visit: every event of a range, typed, straight from the packed columns.
#pragma once

#include "traces/file/trace_impl.hpp"

namespace zstep {

template <class Visit>
void Trace::visit(std::int64_t first, std::int64_t last, Visit&& visit) const {
  first = std::max<std::int64_t>(first, 0);
  last = std::min(last, size());
  while (first < last) {
    const std::size_t index = impl_->block_of(first + 1);
    const Impl::Block& block = impl_->blocks[index];
    std::int64_t position = block.info.first_position;
    bool go_on = true;
    const Bytes& packed = impl_->packed(index);
    try {
      BlockDecoder decoder(packed, block.info.count, impl_->kinds, impl_->increments);
      decoder.visit_all([&](std::uint8_t step, const auto& event) {
        ++position;
        if (position <= first) return true;
        if (position > last) return false;
        go_on = visit(position, step, event);
        return go_on;
      });
    } catch (const MalformedBytes& error) {
      impl_->damaged(index, error.what());
    }
    if (!go_on) return;
    first = block.info.first_position + block.info.count;
  }
}

}  // namespace zstep
