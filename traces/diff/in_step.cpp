#include "traces/diff/in_step.hpp"

#include <bit>
#include <utility>

#include "traces/diff/parting.hpp"
#include "traces/file/visit.hpp"

namespace zstep::diff {

namespace {

std::int64_t end_of_block(const Trace::Impl::Block& block) {
  return block.info.first_position + static_cast<std::int64_t>(block.info.count);
}

/// Goes through B, block by block, and reads A along with it; of a block that both have, byte for byte, only B's.
class Walk {
 public:
  Walk(const Trace& a, const Trace& b, const Both& both, Alignment& found)
      : a_(a),
        b_(b),
        both_(both),
        found_(found),
        identity_(a),
        one_code_(a.header() == b.header() && a.scene() == b.scene()) {}

  InStep run(const std::function<bool(double)>& on_way) {
    const double all = static_cast<double>(std::max<std::int64_t>(a_.size() + b_.size(), 1));
    bool identical = true, told_to_end = false;
    while (goes_on_ && !told_to_end && read_b_ < b_.size()) {
      const std::size_t block = b_.impl().block_of(read_b_ + 1);
      const std::int64_t end = end_of_block(b_.impl().blocks[block]);
      equal_ = equal_blocks(block);
      identical = identical && equal_;
      if (equal_) {
        shift_ = read_a_ - read_b_;
        next_ = ahead_.size();
        read_a_ = end + shift_;
      }
      b_.visit(read_b_, end, *this);
      read_b_ = end;
      if (found_.differences.size() > most_differences) goes_on_ = false;
      told_to_end = on_way && on_way(static_cast<double>(last_a_ + last_b_) / all);
    }
    identical = identical && goes_on_ && !told_to_end && read_a_ == a_.size();
    return {last_a_, last_b_, identity_, identity_.of_same_run(b_), std::move(begun_), identical, told_to_end};
  }

  template <class E>
  bool operator()(std::int64_t position, std::uint8_t step, const E& b) {
    if (!both_[kind_of<E>]) return true;
    if (equal_) {
      take<E>(position + shift_, position, 1);
    } else {
      const Read* a = next_of_a();
      const E* its = a ? get_if<E>(&a->event) : nullptr;
      if (!its || !same_names(*its, b)) return goes_on_ = false;
      const Parting parted = same(*its, b) ? Parting{} : parting(*its, b, [](std::size_t) { return true; });
      take<E>(a->position, position, parted.fields == 0 ? 1 : 0);
      if (parted.fields != 0)
        found_.differences.push_back(
            {a->position, position, parted.fields, static_cast<std::uint8_t>(kind_of<E>), step, parted.off});
      ++next_;
    }
    identity_.take_note_of(b);
    if constexpr (std::is_same_v<E, PolygonBegin> || std::is_same_v<E, BuffersClear> || std::is_same_v<E, PassBegin>)
      begun_.again(b);
    return true;
  }
  // Of pixels there is nothing to take note of.
  bool operator()(std::int64_t position, const codec::FragmentRun& run) {
    if (!equal_) return one_by_one(position, run);
    const std::int64_t written = run.nearer == 0 ? 0 : std::popcount(run.nearer);
    count<DepthInterpolate>(run.count, run.count), count<DepthCompare>(run.count, run.count);
    count<DepthWrite>(written, written), count<PixelWrite>(written, written);
    match(position + 1, run.events());
    return true;
  }
  bool operator()(std::int64_t position, const codec::PaintRun& run) {
    if (!equal_) return one_by_one(position, run);
    count<PixelPaint>(run.count, run.count);
    match(position + 1, run.events());
    return true;
  }

 private:
  struct Read {
    std::int64_t position;
    Event event;
  };

  template <class Run>
  bool one_by_one(std::int64_t position, const Run& run) {
    return run.expand([&](std::uint8_t step, const auto& event) { return (*this)(++position, step, event); });
  }

  /// Is this block of B, to the byte, the one that comes next in A?
  bool equal_blocks(std::size_t block_b) const {
    if (!one_code_ || next_ != ahead_.size() || read_a_ >= a_.size()) return false;
    const std::size_t block_a = a_.impl().block_of(read_a_ + 1);
    const auto &one = a_.impl().blocks[block_a].info, &other = b_.impl().blocks[block_b].info;
    if (one.first_position != read_a_ || one.count != other.count) return false;
    const Bytes *mine = a_.impl().packed(block_a), *its = b_.impl().packed(block_b);
    return mine && its && *mine == *its;
  }

  const Read* next_of_a() {
    while (next_ == ahead_.size()) {
      if (read_a_ >= a_.size()) return nullptr;
      const std::int64_t end = end_of_block(a_.impl().blocks[a_.impl().block_of(read_a_ + 1)]);
      ahead_.clear(), next_ = 0;
      a_.each(read_a_, end, [&](std::int64_t position, const RecordedEvent& recorded) {
        if (both_[recorded.event.index()]) ahead_.push_back({position, recorded.event});
        return true;
      });
      read_a_ = end;
    }
    return &ahead_[next_];
  }

  template <class E>
  void count(std::int64_t pairs, std::int64_t equal) {
    KindCount& kind = found_.kinds[kind_of<E>];
    kind.pairs += pairs, kind.equal += equal;
  }
  void match(std::int64_t b, std::int64_t steps) {
    extend(found_.by_b, b + shift_, b, steps);
    last_a_ = b + shift_ + steps - 1, last_b_ = b + steps - 1;
  }
  template <class E>
  void take(std::int64_t a, std::int64_t b, std::int64_t equal) {
    count<E>(1, equal);
    extend(found_.by_b, a, b, 1);
    last_a_ = a, last_b_ = b;
  }

  const Trace &a_, &b_;
  const Both& both_;
  Alignment& found_;
  Identity identity_;
  bool one_code_;  ///< the same bytes mean the same in both
  Begun begun_;
  std::vector<Read> ahead_;  ///< of A, of the kinds that both record
  std::size_t next_ = 0;
  std::int64_t read_a_ = 0, read_b_ = 0;  ///< steps that were read
  std::int64_t last_a_ = 0, last_b_ = 0;  ///< the last that are the same
  std::int64_t shift_ = 0;                ///< from a step of B to that of A, where blocks are equal
  bool equal_ = false, goes_on_ = true;
};

}  // namespace

void extend(std::vector<Match>& matches, std::int64_t a, std::int64_t b, std::int64_t count) {
  if (!matches.empty())
    if (Match& last = matches.back(); last.a + last.count == a && last.b + last.count == b)
      return void(last.count += count);
  matches.push_back({a, b, count});
}

InStep go_in_step(const Trace& a, const Trace& b, const Both& both, Alignment& found,
                  const std::function<bool(double)>& on_way) {
  // Vertices beyond those of the scene are known by how they were made.
  if (a.scene().points.size() != b.scene().points.size()) return {0, 0, Identity(a), Identity(b), {}, false, false};
  return Walk(a, b, both, found).run(on_way);
}

}  // namespace zstep::diff
