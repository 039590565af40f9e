// Trace::visit: every event of a range, typed, straight from the packed columns; and the inside of a Trace, for those
// who walk its blocks.
#pragma once

#include <algorithm>
#include <functional>
#include <list>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "traces/codec/block.hpp"
#include "traces/file/container.hpp"
#include "traces/file/trace.hpp"

namespace zstep {

// The inside of a Trace, for those who walk its blocks.

/// What to do about a trace that cannot be used.
inline constexpr const char* mend_trace =
    "record it again with `zstep record`, or import its JSONL form with `zstep import`";

struct Trace::Impl {
  struct Block {
    BlockInfo info;
    std::size_t first_mark = 0;  ///< in `polygons`
    ChunkPlace place;
    std::uint64_t frame_offset = 0;  ///< of the zstd frame within the chunk's bytes
    mutable bool checked =
        false;  ///< its events' numbers were found to lie within the scene, and what its info says of them to be true
    mutable bool lost = false;  ///< it is damaged
  };

  std::string name;
  std::unique_ptr<ByteSource> source;
  bool of_file = false;  ///< `name` is its path
  Header header;
  Scene scene;
  std::optional<StepMeanings> meanings;       ///< of the header
  std::optional<codec::SceneGeometry> facts;  ///< of header and scene
  std::vector<Block> blocks;
  std::vector<PolygonMark> polygons;
  std::vector<Box> boxes;  ///< of each of these marks
  std::vector<std::string> warnings;
  bool whole = true;  ///< the warnings are of nothing that is missing
  /// Told once of each block that is damaged, which is passed over then. Without it, reading such a block throws.
  mutable std::function<void(const std::string&)> on_loss;
  std::int64_t size = 0;
  StepSet steps;  ///< that occur
  SourcePlaces places;
  StepLines lines;

  /// When polygons come one after the other: the last of them that does, in `polygons`, and where what is about all of
  /// them begins.
  struct Turns {
    std::size_t last = 0;
    std::int64_t end = 0;
  };
  const Turns& turns(const Trace& trace) const;

  /// The block that holds the event leading to this position.
  std::size_t block_of(std::int64_t position) const;

  /// The last position of a block that may touch a pixel; 0 if none may.
  std::int64_t last_touch(std::size_t block, Trace::Pixel pixel) const;

  using Packed = std::shared_ptr<const Bytes>;
  /// A block's packed columns, from the file or from the few kept at hand. Of one that is damaged null, where losses
  /// are told, else it throws InputError.
  Packed packed(std::size_t block) const;
  /// Whether the step that leads to this position can be read, or is lost with its block.
  bool readable(std::int64_t position) const {
    const std::size_t block = block_of(position);
    return blocks[block].checked || packed(block) != nullptr;
  }
  mutable bool any_lost = false;
  /// A block's events, unpacked; a few blocks are kept at hand, and others by whom they are given to.
  using Events = std::shared_ptr<const std::vector<RecordedEvent>>;
  const Events& events(std::size_t block) const;
  /// visit(position, event) for the events leading to positions first+1 … last, whose blocks stay at hand: for who goes
  /// through the same few again and again. What is lost is passed over.
  template <class Visit>
  void visit_at_hand(std::int64_t first, std::int64_t last, Visit&& visit) const {
    while (first < last) {
      const std::size_t block = block_of(first + 1);
      const std::int64_t before = blocks[block].info.first_position;
      const std::int64_t end = std::min(last, before + static_cast<std::int64_t>(blocks[block].info.count));
      if (readable(first + 1)) {
        const Events held = events(block);
        for (; first < end; ++first) visit(first + 1, (*held)[first - before].event);
      }
      first = end;
    }
  }
  /// Throws MalformedBytes when an event of a block names what the scene does not have, or is one that the block's info
  /// denies.
  void check(std::size_t block, const Bytes& packed) const;
  /// Throws MalformedBytes when the info of some block denies what is in it.
  void refuse_lies() const;
  /// A block that is damaged: tells or throws.
  void lose(std::size_t block, const std::string& what) const;
  /// Turns what a damaged block throws into an InputError that says which events are lost.
  [[noreturn]] void damaged(std::size_t block, const std::string& what) const;

  // Found out once somebody asks.
  mutable std::optional<Turns> known_turns;
  mutable std::optional<SpansAtOnce> known_spans_at_once;
  mutable std::optional<std::vector<std::int32_t>> polygon_by_piece;
  mutable std::optional<std::vector<RejectMark>> rejects;
  mutable std::optional<std::vector<std::int64_t>> clears;

  mutable std::list<std::pair<std::size_t, Packed>> packed_at_hand;
  mutable std::list<std::pair<std::size_t, Events>> events_at_hand;
  mutable RecordedEvent one_event;                   ///< that of a block which was asked for no other
  mutable std::size_t asked_once = ~std::size_t{0};  ///< that block
};

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
    const Impl::Packed packed = impl_->packed(index);  // held while others are asked for, which may take its place
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
