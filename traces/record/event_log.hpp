// What a run has recorded since the last block: events as they came, and the pixels of a span already drawn together
// into runs.
//
// This is the half of recording that runs within the method that is recorded, so it does little: it sees whether pixels
// follow one another along their span, and copies everything else. Whether the depths are those that the span foretells
// is the packer's to find out. The other half, packing, may be another thread's (codec/block_encoder.hpp).
#pragma once

#include <array>
#include <atomic>
#include <bit>
#include <cstdint>
#include <cstring>
#include <memory>
#include <span>
#include <type_traits>
#include <utility>

#include "traces/events/slots.hpp"
#include "traces/events/vocabulary.hpp"
#include "traces/scene.hpp"

namespace zstep {

inline constexpr std::uint32_t block_events = 1u << 14;  ///< the most that a block holds

namespace codec {

inline constexpr std::uint32_t run_limit = 64;  ///< pixels, as many as a word has bits

// Tokens that stand for several events; all others are the ids of steps.
inline constexpr std::uint8_t row_token = 125, fragments_token = 126, paints_token = 127;
inline constexpr std::uint8_t unknown_step = 0xff;

/// Pixels that follow one another along a span, as the log keeps them; their y, polygon and steps are those of the
/// events before.
struct LoggedRun {
  bool painted = false;
  std::int32_t x = 0;  ///< of the first pixel
  std::uint32_t count = 0;
  std::uint64_t nearer = 0;              ///< bit k: the k-th pixel's compare; of painted pixels, 0
  const std::uint8_t* depths = nullptr;  ///< where `count` doubles stand in the log, without regard to alignment

  double depth(std::uint32_t pixel) const {
    double z;
    std::memcpy(&z, depths + pixel * sizeof z, sizeof z);
    return z;
  }
};

/// A scan line that begins, two active edges that step, and a span that begins.
struct LoggedRow {
  std::array<std::uint8_t, 4> steps;
  ScanLineBegin line;
  std::array<EdgeStep, 2> edges;
  SpanBegin span;
};

/// The steps by which a run's events were recorded when they last came one by one.
struct RunSteps {
  std::array<std::uint8_t, 4> fragment{unknown_step, unknown_step, unknown_step, unknown_step};
  std::uint8_t paint = unknown_step;

  template <class E>
  void learn(std::uint8_t step) {
    if constexpr (std::is_same_v<E, DepthInterpolate>) fragment[0] = step;
    else if constexpr (std::is_same_v<E, DepthCompare>) fragment[1] = step;
    else if constexpr (std::is_same_v<E, DepthWrite>) fragment[2] = step;
    else if constexpr (std::is_same_v<E, PixelWrite>) fragment[3] = step;
    else if constexpr (std::is_same_v<E, PixelPaint>) paint = step;
  }
};

}  // namespace codec

class EventLog {
 public:
  static const std::size_t most_bytes;  ///< of a log

  EventLog();
  /// In this memory, `most_bytes` long, which must live as long as the log does.
  explicit EventLog(std::uint8_t* memory);
  /// What stood in a log's memory, as far as a recording can have left it so: the first bytes of it that are whole
  /// events of the steps of these kinds.
  EventLog(std::span<const std::uint8_t> bytes, const std::array<std::uint8_t, 128>& kind_of_step);

  /// True when the next event needs an empty log.
  template <class E>
  bool put(std::uint8_t step, const E& event) {
    if (take(step, event)) return false;
    put_one(step, event);
    return count_ > block_events - longest_run;
  }
  /// Whether the block may end here, if work on another polygon or ray begins: guesses start anew with a block, and
  /// lose least there.
  bool may_end() const { return count_ > block_events / 2; }

  std::uint32_t count() const { return count_; }  ///< events, without those of a run that goes on
  /// Ends the run at work; afterwards all that was put is in count() and for_each().
  void close();
  void clear();
  void swap(EventLog& other) noexcept;
  const std::uint8_t* memory() const { return begin_; }

  /// Calls row(const LoggedRow&), run(const LoggedRun&) and one(step, const E&) for what stands in the log, in order.
  template <class Row, class Run, class One>
  void for_each(Row&& row, Run&& run, One&& one) const {
    using Give = void (*)(std::uint8_t, const std::uint8_t*, std::remove_reference_t<One>&);
    static constexpr auto give = []<std::size_t... K>(std::index_sequence<K...>) {
      return std::array<Give, kind_count>{&EventLog::give_one<KindAt<K>, One>...};
    }
    (std::make_index_sequence<kind_count>{});
    static constexpr auto sizes = []<std::size_t... K>(std::index_sequence<K...>) {
      return std::array<std::size_t, kind_count>{sizeof(KindAt<K>)...};
    }
    (std::make_index_sequence<kind_count>{});
    codec::LoggedRow logged_row;
    codec::LoggedRun logged_run;
    for (const std::uint8_t* at = begin_; at != end_;) {
      const std::uint8_t step = at[0], kind = at[1];
      if (step == run_mark) {
        RunHead head;
        std::memcpy(&head, at + 2, sizeof head);
        at += 2 + sizeof head;
        logged_run.painted = kind != 0, logged_run.x = head.x, logged_run.count = head.count,
        logged_run.nearer = head.nearer;
        logged_run.depths = at;
        at += head.count * sizeof(double);
        run(logged_run);
      } else if (kind == kind_of<ScanLineBegin> && row_stands(at)) {
        take_row(at, logged_row);
        row(logged_row);
      } else {
        give[kind](step, at + 2, one);
        at += 2 + sizes[kind];
      }
    }
  }

 private:
  static constexpr std::uint32_t longest_run =
      4 * codec::run_limit + 8;                                    ///< events of a run at work, and of what ends it
  static constexpr std::uint8_t run_mark = 0xff, end_mark = 0xfe;  ///< in the place of a step: pixels; nothing yet
  struct RunHead {
    std::int32_t x;
    std::uint32_t count;
    std::uint64_t nearer;
  };

  template <class E>
  static constexpr std::size_t logged_size = 2 + sizeof(E);
  static constexpr std::size_t edges_at = logged_size<ScanLineBegin>, span_at = edges_at + 2 * logged_size<EdgeStep>,
                               row_size = span_at + logged_size<SpanBegin>;
  bool row_stands(const std::uint8_t* at) const {
    const auto is = [&]<class E>(std::size_t offset, std::type_identity<E>) {
      return at[offset] != run_mark && at[offset + 1] == kind_of<E>;
    };
    const std::type_identity<EdgeStep> edge;
    return static_cast<std::size_t>(end_ - at) >= row_size && is(edges_at, edge) &&
           is(edges_at + logged_size<EdgeStep>, edge) && is(span_at, std::type_identity<SpanBegin>{});
  }
  static void take_row(const std::uint8_t*& at, codec::LoggedRow& row) {
    const auto take = [&](std::size_t place, auto& event) {
      row.steps[place] = at[0];
      std::memcpy(&event, at + 2, sizeof event);
      at += 2 + sizeof event;
    };
    take(0, row.line), take(1, row.edges[0]), take(2, row.edges[1]), take(3, row.span);
  }

  template <class E, class One>
  static void give_one(std::uint8_t step, const std::uint8_t* bytes, std::remove_reference_t<One>& one) {
    E event;
    std::memcpy(&event, bytes, sizeof event);
    one(step, event);
  }

  enum class Stage : std::uint32_t { closed, ready, interpolated, compared, depth_written };

  template <class E>
  bool take(std::uint8_t, const E&) {
    return false;
  }
  bool take(std::uint8_t step, const DepthInterpolate& event) {
    if (stage_ != Stage::ready || step != steps_.fragment[0] || event.x != x_ || event.y != y_) return false;
    stage_ = Stage::interpolated;
    depths_[pixels_] = event.z;
    return true;
  }
  bool take(std::uint8_t step, const DepthCompare& event) {
    if (stage_ != Stage::interpolated || step != steps_.fragment[1] || event.x != x_ || event.y != y_ ||
        !same(event.z, depths_[pixels_]))
      return false;
    nearer_ |= std::uint64_t{event.nearer} << pixels_;
    if (event.nearer) stage_ = Stage::compared;
    else end_pixel();
    return true;
  }
  bool take(std::uint8_t step, const DepthWrite& event) {
    if (stage_ != Stage::compared || step != steps_.fragment[2] || event.x != x_ || event.y != y_ ||
        !same(event.z, depths_[pixels_]))
      return false;
    stage_ = Stage::depth_written;
    return true;
  }
  bool take(std::uint8_t step, const PixelWrite& event) {
    if (stage_ != Stage::depth_written || step != steps_.fragment[3] || event.x != x_ || event.y != y_ ||
        event.polygon != polygon_)
      return false;
    end_pixel();
    return true;
  }
  bool take(std::uint8_t step, const PixelPaint& event) {
    const bool begins = stage_ == Stage::ready && pixels_ == 0 && step == steps_.paint;
    if (!(painting_ || begins) || step != steps_.paint || event.polygon != polygon_ || event.x != x_ || event.y != y_)
      return false;
    painting_ = painted_ = true;
    stage_ = Stage::closed;  // to fragments
    depths_[pixels_] = event.z;
    ++x_;
    if (++pixels_ == codec::run_limit) painting_ = false;
    return true;
  }
  void end_pixel() {
    ++x_;
    stage_ = ++pixels_ == codec::run_limit ? Stage::closed : Stage::ready;
  }

  /// What stands at the end of a log that is read: its bytes and events, 0 where nothing whole does.
  struct Whole {
    std::size_t size = 0;
    std::uint32_t events = 0;
  };
  Whole whole_run(std::size_t left, const codec::RunSteps& steps) const;
  Whole whole_event(std::size_t left, const std::array<std::uint8_t, 128>& kind_of_step, codec::RunSteps& steps) const;

  static bool same(double one, double other) { return std::memcmp(&one, &other, sizeof one) == 0; }
  /// An event that does not go on with a run.
  template <class E>
  void put_one(std::uint8_t step, const E& event) {
    constexpr bool begins_pixel = std::is_same_v<E, DepthInterpolate> || std::is_same_v<E, PixelPaint>;
    if (pixels_ != 0 || stage_ > Stage::ready) {
      const bool was_full = pixels_ == codec::run_limit;
      close_run();
      if constexpr (begins_pixel) {
        if (was_full) {
          stage_ = Stage::ready;
          if (take(step, event)) return;
        }
      }
    }
    append(step, event);
  }

  template <class E>
  void append(std::uint8_t step, const E& event) {
    std::uint8_t* const to = end_;  // as one variable, so that it is not read again after every byte written
    to[1] = kind_of<E>;
    // Field by field: a copy as a whole would wait until the event's fields, just written, have reached memory.
    for_each_index<E>([&]<std::size_t I>() {
      const auto& value = event.*field_at<E, I>.member;
      std::memcpy(
          to + 2 + (reinterpret_cast<const std::uint8_t*>(&value) - reinterpret_cast<const std::uint8_t*>(&event)),
          &value, sizeof value);
    });
    stands(step, logged_size<E>);
    ++count_;
    stage_ = Stage::closed;

    // What the next pixel will be like.
    steps_.learn<E>(step);
    if constexpr (requires { event.polygon; }) polygon_ = event.polygon;
    if constexpr (std::is_same_v<E, SpanBegin>) {
      in_span_ = true;
      x_ = event.first, y_ = event.y;
      stage_ = Stage::ready;
    } else if constexpr (std::is_same_v<E, DepthInterpolate> || std::is_same_v<E, DepthCompare> ||
                         std::is_same_v<E, DepthWrite> || std::is_same_v<E, PixelWrite> ||
                         std::is_same_v<E, PixelPaint>) {
      x_ = static_cast<std::int32_t>(static_cast<std::uint32_t>(event.x) + 1u), y_ = event.y;
      constexpr bool ends_pixel =
          std::is_same_v<E, DepthCompare> || std::is_same_v<E, PixelWrite> || std::is_same_v<E, PixelPaint>;
      if (ends_pixel && in_span_) stage_ = Stage::ready;
    } else {
      // Any of these may take a register that the next pixel would be foretold from.
      if constexpr (
          requires { event.x; } || requires { event.y; } || requires { event.z; } || is_break<E>)
        in_span_ = false;
    }
  }
  template <class E>
  static constexpr bool is_break =
      std::is_same_v<E, PolygonBegin> || std::is_same_v<E, PieceDraw> || std::is_same_v<E, ScanLineBegin>;

  void close_run();

  /// What was written after the first byte counts from now on. In this order, so that at every moment the memory holds
  /// whole events only.
  void stands(std::uint8_t step, std::size_t size) {
    std::uint8_t* const from = end_;
    from[size] = end_mark;
    std::atomic_signal_fence(std::memory_order_release);
    from[0] = step;
    end_ = from + size;
  }

  std::unique_ptr<std::uint8_t[]> own_;
  std::uint8_t* begin_ = nullptr;
  std::uint8_t* end_ = nullptr;
  std::uint32_t count_ = 0;

  // The pixels of a span as they come in.
  Stage stage_ = Stage::closed;
  std::uint32_t pixels_ = 0;  ///< whole ones that wait to be written as a run
  bool painting_ = false;     ///< they are painted, and more may follow
  bool painted_ = false;
  bool in_span_ = false;
  // Of the next pixel. x_ and y_ stand apart: together they would be read as one word, which waits until x_, just
  // written, is in memory.
  std::int32_t x_ = 0, polygon_ = 0;
  std::uint64_t nearer_ = 0;
  std::int32_t y_ = 0;
  // Of those that wait, and of the pixel at work: not in the log itself, as a compiler takes what is written there for
  // anything.
  std::array<double, codec::run_limit> depths_{};
  codec::RunSteps steps_;
};

inline void EventLog::close_run() {
  const Stage stage = std::exchange(stage_, Stage::closed);
  const std::uint32_t pixels = std::exchange(pixels_, 0);
  const std::uint64_t nearer = std::exchange(nearer_, 0);
  const bool painted = painted_;
  painting_ = painted_ = false;
  if (pixels > 0) {
    const RunHead head{x_ - index32(pixels), pixels, nearer & (~std::uint64_t{0} >> (64 - pixels))};
    end_[1] = painted;
    std::memcpy(end_ + 2, &head, sizeof head);
    std::memcpy(end_ + 2 + sizeof head, depths_.data(), pixels * sizeof(double));
    stands(run_mark, 2 + sizeof head + pixels * sizeof(double));
    count_ += painted ? pixels : 2 * (pixels + static_cast<std::uint32_t>(std::popcount(head.nearer)));
  }
  if (stage <= Stage::ready) return;
  // A pixel that was told in part: its events one by one.
  const std::int32_t x = x_, y = y_;
  const double z = depths_[pixels];
  append(steps_.fragment[0], DepthInterpolate{x, y, z});
  if (stage > Stage::interpolated) append(steps_.fragment[1], DepthCompare{x, y, z, true});
  if (stage == Stage::depth_written) append(steps_.fragment[2], DepthWrite{x, y, z});
}

}  // namespace zstep
