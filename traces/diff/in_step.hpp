// Two runs read step by step, and how far they do the same steps in the same order: there, what a step is about need
// not be found out.
#pragma once

#include <array>
#include <cstdint>
#include <cstring>
#include <functional>
#include <optional>
#include <unordered_set>
#include <vector>

#include "traces/codec/runs.hpp"
#include "traces/diff/diff.hpp"
#include "traces/diff/identity.hpp"
#include "traces/file/trace.hpp"

namespace zstep::diff {

// One of two runs, read step by step; pixels of a span in runs as long as nobody needs them one by one.

/// By kind: whether both runs record it.
struct Both : std::array<bool, kind_count> {
  bool turns = false;  ///< of two methods, each says in its own way whose turn it is: such steps are read, too
  bool ahead = false;  ///< one of them prints spans of several polygons before any pixel: each pixel is read by itself
};

/// function.operator()<E>(), by the number of a kind.
template <class Function>
decltype(auto) with_kind(std::uint8_t kind, Function&& function) {
  switch (static_cast<zstep::detail::KindNumber>(kind)) {
#define ZSTEP_CASE(E)                \
  case zstep::detail::KindNumber::E: \
    return function.template operator()<E>();
    ZSTEP_EVERY_KIND(ZSTEP_CASE)
#undef ZSTEP_CASE
    case zstep::detail::KindNumber::count:
      break;
  }
  zstep::detail::wrong_kind();
}

/// Steps as they were read, packed: events differ much in size.
class ReadSteps {
 public:
  struct Head {
    std::uint32_t at = 0;        ///< of the event among the words
    std::uint32_t position = 0;  ///< of the step, or of the first of the run, counted from where the block begins
    std::uint8_t kind = 0, line = 0;
  };
  /// In place of a kind.
  static constexpr std::uint8_t fragments = kind_count, paints = kind_count + 1;

  bool empty() const { return next_ == heads_.size(); }
  const Head& head() const { return heads_[next_]; }
  template <class T>
  T read() const {
    T value;
    std::memcpy(static_cast<void*>(&value), &words_[heads_[next_].at], sizeof(T));
    return value;
  }
  template <class T>
  void put(std::uint32_t position, std::uint8_t kind, std::uint8_t line, const T& value) {
    constexpr std::size_t size = (sizeof(T) + sizeof(std::uint64_t) - 1) / sizeof(std::uint64_t);
    const std::size_t at = words_.size();
    words_.resize(at + size);
    std::memcpy(&words_[at], &value, sizeof(T));
    heads_.push_back({static_cast<std::uint32_t>(at), position, kind, line});
  }
  void skip() { ++next_; }
  void clear() { heads_.clear(), words_.clear(), next_ = 0; }

 private:
  std::vector<Head> heads_;
  std::vector<std::uint64_t> words_;
  std::size_t next_ = 0;
};

class Steps {
 public:
  Steps(const Trace& trace, const Both& both) : trace_(trace), both_(both) {}

  enum class Next : std::uint8_t { end, step, fragments, paints };
  /// What comes next: a step, a run of pixels, or nothing more.
  Next next();

  // Of a step that comes next.
  std::uint8_t kind() const { return source().head().kind; }
  std::uint8_t line() const { return source().head().line; }
  std::int64_t position() const { return base_ + source().head().position; }
  template <class E>
  E event() const {
    return source().read<E>();
  }
  void skip() { opened_.empty() ? block_.skip() : opened_.skip(); }

  // Of a run that comes next.
  const codec::FragmentRun& fragments() const { return fragments_; }
  const codec::PaintRun& paints() const { return paints_; }
  std::int64_t run_position() const { return base_ + run_position_; }
  /// Passes over the first pixels of the run.
  void skip_pixels(std::uint32_t pixels);
  /// Takes the first pixels of the run apart: their steps come next.
  void open(std::uint32_t pixels);

  /// How many steps were read, other kinds included.
  std::int64_t read() const { return read_; }
  /// Nothing of what was read is left.
  bool at_block() const { return opened_.empty() && block_.empty() && !in_run_; }
  void skip_block(std::int64_t end) { read_ = end; }

 private:
  bool read_block();
  void take_run();
  template <class AnyRun>
  void shorten(AnyRun& run, std::uint32_t pixels, double before);
  const ReadSteps& source() const { return opened_.empty() ? block_ : opened_; }

  const Trace& trace_;
  const Both& both_;
  ReadSteps block_, opened_;
  std::int64_t base_ = 0, read_ = 0;
  bool in_run_ = false;  ///< the run at hand is not at its end
  std::uint32_t run_position_ = 0;
  codec::FragmentRun fragments_;
  codec::PaintRun paints_;
  SpanBegin span_;  ///< of that run
};

/// Polygons that were begun. Who works scan line by scan line comes back to them.
class Begun {
 public:
  template <class E>
  bool again(const E& event) {
    if constexpr (std::is_same_v<E, BuffersClear> || std::is_same_v<E, PassBegin>) polygons_.clear();
    if constexpr (std::is_same_v<E, PolygonBegin>) return !polygons_.insert(event.polygon).second;
    return false;
  }
  bool has(const PolygonBegin& event) const { return polygons_.contains(event.polygon); }

 private:
  std::unordered_set<std::int32_t> polygons_;
};

/// One of the two runs: what was read of it, what it calls things by then.
struct Run {
  const Trace& trace;
  const Both& both;
  Steps steps;
  Identity identity;
  Begun begun;
  Waiting waiting;        ///< steps that the other run has not done yet
  std::int64_t last = 0;  ///< the last step that was read by itself

  Run(const Trace& trace_, const Both& both_)
      : trace(trace_),
        both(both_),
        steps(trace_, both_),
        identity(trace_, {both_[kind_of<EdgeTableInsert>], both_[kind_of<PieceDraw>], both_.ahead}) {}
  /// The next step; none at the end.
  std::optional<Keyed> read();
  /// Passes over a polygon that is begun again, if that comes next.
  bool pass_repeated();
  /// Passes over a step that the other run has none of, and that says whose turn it is.
  bool pass_turn();
};

/// Steps a and b are the same, and so are those after them, so many in all.
void extend(std::vector<Match>& matches, std::int64_t a, std::int64_t b, std::int64_t count);

/// Goes through both runs while their steps are the same, but for numbers that came out otherwise, and takes note of
/// pairs and differences.
class InStep {
 public:
  /// `plain`: every step for itself. It takes longer and gives the same.
  InStep(Run& a, Run& b, Alignment& found, bool plain);

  /// Until their steps part, or one of them waits for the step that comes next in the other; false where it was told to
  /// end.
  bool go_on(const std::function<bool(double)>& on_way);
  /// Both to their ends, and byte for byte.
  bool identical() const { return equal_ == a_.trace.size() && equal_ == b_.trace.size(); }
  /// Their steps have parted: from here on each run may call things by numbers of its own.
  void part();

 private:
  struct EqualBlock;
  bool pass_equal_block();
  bool along();
  template <class E>
  bool step_along();
  template <class OneRun>
  std::uint32_t pixels_along(const OneRun& a, const OneRun& b);
  template <class OneRun>
  bool go_along(const OneRun& a, const OneRun& b);
  void count_run(const codec::FragmentRun& run);
  void count_run(const codec::PaintRun& run);
  template <class E>
  bool waits(const E& event);
  template <class E>
  void count(std::int64_t pairs, std::int64_t equal);

  Run &a_, &b_;
  Alignment& found_;
  bool plain_, one_code_;   ///< the same bytes mean the same in both
  bool one_identity_;       ///< both call all things by the same numbers; that of B is not kept then
  std::int64_t equal_ = 0;  ///< steps in blocks that are the same, byte for byte
};

}  // namespace zstep::diff
