// One of two runs, read step by step; pixels of a span in runs as long as nobody needs them one by one.
#pragma once

#include <array>
#include <cstdint>
#include <cstring>
#include <vector>

#include "traces/codec/runs.hpp"
#include "traces/file/trace.hpp"

namespace zstep::diff {

/// By kind: whether both runs record it.
struct Both : std::array<bool, kind_count> {
  bool turns = false;  ///< of two methods, each says in its own way whose turn it is: such steps are read, too
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

}  // namespace zstep::diff
