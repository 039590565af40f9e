#include "traces/diff/in_step.hpp"

#include <algorithm>
#include <bit>

#include "traces/diff/identity.hpp"
#include "traces/diff/parting.hpp"
#include "traces/file/visit.hpp"
#include "traces/scene.hpp"

namespace zstep::diff {

namespace {

/// A run, and its span, which is the reader's only as long as it reads.
template <class AnyRun>
struct Kept {
  AnyRun run;
  SpanBegin span;
};

/// visit(event) for one of each kind that a pixel of a run of fragments has, at this pixel.
template <class Visit>
void for_each_of_fragment(Visit&& visit, std::int32_t x = 0, std::int32_t y = 0) {
  codec::visit_fragment({}, x, y, 0, true, 0, [&](std::uint8_t, const auto& event) { return visit(event), true; });
}

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
    bool whole = true;
    for_each_of_fragment([&]<class E>(const E&) {
      whole = whole && (both[kind_of<E>] || (!is_of_fragment(at_pixel<E>) && run.nearer == 0));
    });
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
  run.x += index32(pixels);
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

namespace {

/// So many pixels at the beginning of both have the same depths.
template <class OneRun>
std::uint32_t same_depths(const OneRun& a, const OneRun& b, std::uint32_t most) {
  if (same(*a.span, *b.span) && a.increments == b.increments && (!a.increments || same(a.before, b.before)))
    return most;
  std::array<double, codec::run_limit> of_a, of_b;
  codec::depths_along(*a.span, a.increments, a.x, most, a.before, of_a.data());
  codec::depths_along(*b.span, b.increments, b.x, most, b.before, of_b.data());
  std::uint32_t pixels = 0;
  while (pixels < most && same(of_a[pixels], of_b[pixels])) ++pixels;
  return pixels;
}

std::uint32_t same_verdicts(const codec::FragmentRun& a, const codec::FragmentRun& b) {
  return static_cast<std::uint32_t>(std::countr_zero(a.nearer ^ b.nearer));
}
std::uint32_t same_verdicts(const codec::PaintRun&, const codec::PaintRun&) { return codec::run_limit; }

}  // namespace

void extend(std::vector<Match>& matches, std::int64_t a, std::int64_t b, std::int64_t count) {
  if (!matches.empty())
    if (Match& last = matches.back(); last.a + last.count == a && last.b + last.count == b)
      return void(last.count += count);
  matches.push_back({a, b, count});
}

std::optional<Keyed> Run::read() {
  for (;;) {
    const Steps::Next next = steps.next();
    if (next == Steps::Next::end) return std::nullopt;
    if (next != Steps::Next::step) steps.open(1);
    if (pass_turn() || pass_repeated()) continue;
    Keyed read = with_kind(steps.kind(), [this]<class E>() {
      const E event = steps.event<E>();
      begun.again(event);
      return Keyed{identity.of(event), steps.position(), {steps.line(), event}};
    });
    steps.skip();
    return read;
  }
}

bool Run::pass_turn() {
  if (both[steps.kind()]) return false;
  with_kind(steps.kind(), [this]<class E>() { identity.take_note_of(steps.event<E>()); });
  steps.skip();
  return true;
}

bool Run::pass_repeated() {
  if (steps.kind() != kind_of<PolygonBegin>) return false;
  const auto begin = steps.event<PolygonBegin>();
  if (!begun.has(begin)) return false;
  identity.take_note_of(begin);
  steps.skip();
  return true;
}

InStep::InStep(Run& a, Run& b, Alignment& found, bool plain)
    : a_(a),
      b_(b),
      found_(found),
      plain_(plain),
      one_code_(a.trace.header() == b.trace.header() && a.trace.scene() == b.trace.scene()),
      // Vertices beyond those of the scene are known by how they were made.
      one_identity_(a.trace.scene().points.size() == b.trace.scene().points.size()) {}

void InStep::part() {
  if (!one_identity_) return;
  one_identity_ = false;
  b_.identity = a_.identity.of_same_run(b_.trace);
  b_.begun = a_.begun;
}

bool InStep::go_on(const std::function<bool(double)>& on_way) {
  constexpr std::int64_t now_and_then = 1 << 14;
  const std::int64_t all = std::max<std::int64_t>(a_.trace.size() + b_.trace.size(), 1);
  for (std::int64_t round = 0;; ++round) {
    if (round % now_and_then == 0 && on_way && on_way(ratio(a_.steps.read() + b_.steps.read(), all))) return false;
    if (pass_equal_block()) continue;
    if (!along()) return true;
  }
}

/// A block that both have: it is read once.
struct InStep::EqualBlock {
  InStep& self;
  std::int64_t shift;  ///< from a step of B to that of A

  template <class E>
  bool operator()(std::int64_t position, std::uint8_t, const E& event) {
    self.count<E>(1, 1);
    extend(self.found_.by_b, position + shift, position, 1);
    self.a_.identity.take_note_of(event);
    self.a_.begun.again(event);
    return true;
  }
  // Of pixels there is nothing to take note of.
  bool operator()(std::int64_t position, const codec::FragmentRun& run) { return pixels(position, run); }
  bool operator()(std::int64_t position, const codec::PaintRun& run) { return pixels(position, run); }

 private:
  bool pixels(std::int64_t position, const auto& run) {
    self.count_run(run);
    extend(self.found_.by_b, position + shift + 1, position + 1, run.events());
    return true;
  }
};

bool InStep::pass_equal_block() {
  if (!one_code_ || !one_identity_ || plain_ || !a_.steps.at_block() || !b_.steps.at_block()) return false;
  const std::int64_t at_a = a_.steps.read(), at_b = b_.steps.read();
  if (at_a >= a_.trace.size() || at_b >= b_.trace.size()) return false;
  const std::size_t block_a = a_.trace.impl().block_of(at_a + 1), block_b = b_.trace.impl().block_of(at_b + 1);
  const auto &one = a_.trace.impl().blocks[block_a].info, &other = b_.trace.impl().blocks[block_b].info;
  if (one.first_position != at_a || other.first_position != at_b || one.count != other.count) return false;
  const auto mine = a_.trace.impl().packed(block_a), its = b_.trace.impl().packed(block_b);
  if (!mine || !its || *mine != *its) return false;
  const std::int64_t count = one.count;
  EqualBlock equal{*this, at_a - at_b};
  b_.trace.visit(at_b, at_b + count, equal);
  a_.steps.skip_block(at_a + count), b_.steps.skip_block(at_b + count);
  equal_ += count;
  return true;
}

template <class E>
void InStep::count(std::int64_t pairs, std::int64_t equal) {
  KindCount& kind = found_.kinds[kind_of<E>];
  kind.pairs += pairs, kind.equal += equal;
}

void InStep::count_run(const codec::FragmentRun& run) {
  const std::int64_t written = run.nearer == 0 ? 0 : std::popcount(run.nearer);
  for_each_of_fragment([&]<class E>(const E&) {
    const std::int64_t pairs = is_of_fragment(at_pixel<E>) ? run.count : written;
    count<E>(pairs, pairs);
  });
}
void InStep::count_run(const codec::PaintRun& run) { count<PixelPaint>(run.count, run.count); }

template <class E>
bool InStep::waits(const E& event) {
  constexpr std::uint8_t kind = kind_of<E>;
  if (a_.waiting.empty() && b_.waiting.empty()) return false;
  const Identity::Hint hint = a_.identity.hint(event);
  if (!a_.waiting.may_have(kind, hint) && !b_.waiting.may_have(kind, hint)) return false;
  const Identity::Key key = a_.identity.known(event).about;
  return a_.waiting.has(key) || b_.waiting.has(key);
}

/// How many pixels both runs can go along at once.
template <class OneRun>
std::uint32_t InStep::pixels_along(const OneRun& a, const OneRun& b) {
  if (plain_ || a.x != b.x || a.y != b.y || a.polygon != b.polygon) return 0;
  if (!one_identity_ && !a_.identity.same_pixels(b_.identity)) return 0;
  const auto may_wait = [&]<class... E>(const E&... events) {
    return ((a_.waiting.may_have(kind_of<E>, a_.identity.hint(events)) ||
             b_.waiting.may_have(kind_of<E>, a_.identity.hint(events))) ||
            ...);
  };
  if (!a_.waiting.empty() || !b_.waiting.empty()) {
    if constexpr (std::is_same_v<OneRun, codec::PaintRun>) {
      if (may_wait(PixelPaint{a.x, a.y, 0, 0})) return 0;
    } else {
      bool waits = false;
      for_each_of_fragment([&](const auto& event) { waits = waits || may_wait(event); }, a.x, a.y);
      if (waits) return 0;
    }
  }
  return same_depths(a, b, std::min({a.count, b.count, same_verdicts(a, b)}));
}

/// As many pixels of two runs as are the same; where the first is not, both are taken apart.
template <class OneRun>
bool InStep::go_along(const OneRun& a, const OneRun& b) {
  const std::uint32_t pixels = pixels_along(a, b);
  if (pixels == 0) {
    const std::uint32_t both = std::min(a.count, b.count);
    a_.steps.open(both), b_.steps.open(both);
    return false;
  }
  OneRun same = a;
  same.count = pixels;
  if constexpr (std::is_same_v<OneRun, codec::FragmentRun>)
    same.nearer &= pixels < codec::run_limit ? (std::uint64_t{1} << pixels) - 1 : ~std::uint64_t{0};
  count_run(same);
  extend(found_.by_b, a_.steps.run_position(), b_.steps.run_position(), same.events());
  a_.steps.skip_pixels(pixels), b_.steps.skip_pixels(pixels);
  return true;
}

/// One step further in both, or several pixels; false where they part.
bool InStep::along() {
  using Next = Steps::Next;
  const Next next_a = a_.steps.next(), next_b = b_.steps.next();
  if (next_a == Next::end || next_b == Next::end) return false;
  if (next_a != Next::step && next_a == next_b) {
    if (next_a == Next::fragments ? go_along(a_.steps.fragments(), b_.steps.fragments())
                                  : go_along(a_.steps.paints(), b_.steps.paints()))
      return true;
  } else {
    if (next_a != Next::step) a_.steps.open(1);
    if (next_b != Next::step) b_.steps.open(1);
  }
  if (!a_.both[a_.steps.kind()] || !b_.both[b_.steps.kind()]) part();
  if (a_.pass_turn() || b_.pass_turn()) return true;
  if (!one_identity_ && (a_.pass_repeated() || b_.pass_repeated())) return true;
  if (a_.steps.kind() != b_.steps.kind()) return false;
  return with_kind(a_.steps.kind(), [this]<class E>() { return step_along<E>(); });
}

template <class E>
bool InStep::step_along() {
  const E a = a_.steps.event<E>(), b = b_.steps.event<E>();
  Parting parted;
  if (one_identity_ && !same_names(a, b)) part();
  if (one_identity_) {
    if (!same(a, b)) parted = parting(a, b, [](std::size_t) { return true; });
  } else {
    if (!a_.identity.same_about(a, b_.identity, b) || waits(a)) return false;
    if constexpr (things_among_results<E>() > 0) {
      const auto of_a = a_.identity.known(a).results, of_b = b_.identity.known(b).results;
      parted = parting(a, b, [&](std::size_t thing) { return of_a[thing] == of_b[thing]; });
    } else if (!same(a, b)) {
      parted = parting(a, b, [](std::size_t) { return true; });
    }
    b_.identity.take_note_of(b);
    b_.begun.again(b);
  }
  a_.identity.take_note_of(a);
  a_.begun.again(a);
  count<E>(1, parted.fields == 0 ? 1 : 0);
  const std::int64_t at_a = a_.steps.position(), at_b = b_.steps.position();
  extend(found_.by_b, at_a, at_b, 1);
  if (parted.fields != 0) found_.differs({at_a, at_b, parted.fields, kind_of<E>, b_.steps.line(), parted.off});
  a_.steps.skip(), b_.steps.skip();
  return true;
}

}  // namespace zstep::diff
