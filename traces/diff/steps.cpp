#include "traces/diff/steps.hpp"

#include "traces/diff/identity.hpp"
#include "traces/file/visit.hpp"

namespace zstep::diff {

namespace {

/// A run, and its span, which is the reader's only as long as it reads.
template <class AnyRun>
struct Kept {
  AnyRun run;
  SpanBegin span;
};

/// Takes note of a block's steps.
struct Keep {
  const Both& both;
  ReadSteps& steps;
  std::int64_t base;

  template <class E>
  bool operator()(std::int64_t position, std::uint8_t line, const E& event) {
    if (both[kind_of<E>] || (says_whose_turn<E> && both.turns))
      steps.put(static_cast<std::uint32_t>(position - base), kind_of<E>, line, event);
    return true;
  }
  bool operator()(std::int64_t position, const codec::FragmentRun& run) {
    const bool writes = both[kind_of<DepthWrite>] && both[kind_of<PixelWrite>];
    const bool whole = both[kind_of<DepthInterpolate>] && both[kind_of<DepthCompare>] && (run.nearer == 0 || writes);
    return keep(position, run, ReadSteps::fragments, whole);
  }
  bool operator()(std::int64_t position, const codec::PaintRun& run) {
    return keep(position, run, ReadSteps::paints, both[kind_of<PixelPaint>]);
  }

 private:
  template <class AnyRun>
  bool keep(std::int64_t position, const AnyRun& run, std::uint8_t kind, bool whole) {
    if (whole) {
      steps.put(static_cast<std::uint32_t>(position + 1 - base), kind, 0, Kept<AnyRun>{run, *run.span});
      return true;
    }
    return run.expand([&](std::uint8_t line, const auto& event) { return (*this)(++position, line, event); });
  }
};

}  // namespace

bool Steps::read_block() {
  if (read_ >= trace_.size()) return false;
  const Trace::Impl::Block& block = trace_.impl().blocks[trace_.impl().block_of(read_ + 1)];
  block_.clear();
  base_ = read_;
  read_ = block.info.first_position + static_cast<std::int64_t>(block.info.count);
  Keep keep{both_, block_, base_};
  trace_.visit(base_, read_, keep);
  return true;
}

void Steps::take_run() {
  run_position_ = block_.head().position;
  if (block_.head().kind == ReadSteps::fragments) {
    const auto kept = block_.read<Kept<codec::FragmentRun>>();
    fragments_ = kept.run, span_ = kept.span;
    fragments_.span = &span_;
  } else {
    const auto kept = block_.read<Kept<codec::PaintRun>>();
    paints_ = kept.run, span_ = kept.span;
    paints_.span = &span_;
  }
  in_run_ = true;
}

Steps::Next Steps::next() {
  if (!opened_.empty()) return Next::step;
  opened_.clear();
  while (block_.empty())
    if (!read_block()) return Next::end;
  const std::uint8_t kind = block_.head().kind;
  if (kind < kind_count) return Next::step;
  if (!in_run_) take_run();
  return kind == ReadSteps::fragments ? Next::fragments : Next::paints;
}

template <class AnyRun>
void Steps::shorten(AnyRun& run, std::uint32_t pixels, double before) {
  run.count -= pixels;
  run.x += static_cast<std::int32_t>(pixels);
  run.before = before;
  in_run_ = run.count > 0;
  if (!in_run_) block_.skip();
}

void Steps::skip_pixels(std::uint32_t pixels) {
  if (block_.head().kind == ReadSteps::paints) {
    run_position_ += pixels;
    double before = paints_.before;
    if (paints_.increments)
      paints_.for_each([&](std::uint32_t k, std::int32_t, double z) {
        before = z;
        return k + 1 < pixels;
      });
    shorten(paints_, pixels, before);
    return;
  }
  run_position_ += fragments_.events_before(pixels - 1) + (fragments_.is_nearer(pixels - 1) ? 4 : 2);
  const double before = fragments_.increments && pixels < fragments_.count ? fragments_.depth(pixels - 1) : 0;
  fragments_.nearer = pixels < codec::run_limit ? fragments_.nearer >> pixels : 0;
  shorten(fragments_, pixels, before);
}

void Steps::open(std::uint32_t pixels) {
  std::uint32_t position = run_position_;
  const auto put = [&]<class E>(std::uint8_t line, const E& event) {
    opened_.put(position++, kind_of<E>, line, event);
    return true;
  };
  if (block_.head().kind == ReadSteps::paints) {
    codec::PaintRun first = paints_;
    first.count = pixels;
    first.expand(put);
  } else {
    codec::FragmentRun first = fragments_;
    first.count = pixels;
    first.expand(put);
  }
  skip_pixels(pixels);
}

}  // namespace zstep::diff
