
#include "sim/cost/operations.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <string_view>
#include <type_traits>

#include "traces/events/fields.hpp"
#include "traces/formulas/attributes.hpp"
#include "traces/formulas/shading.hpp"
#include "traces/formulas/of_edges.hpp"
#include "traces/formulas/of_pixels.hpp"
#include "traces/formulas/walk.hpp"

namespace zstep::compare {
namespace {

constexpr ByEnum<Work, std::string_view, work_count> words{
    "vertices transformed", "planes, boxes, rays", "tests",  "cuts",       "edges and spans",
    "interpolations",       "depth compares",      "writes", "bookkeeping"};

constexpr std::int64_t between_sums = 4096;

}  // namespace

std::string_view word_of(Work work) { return words[work]; }
Work work_of(std::uint8_t kind) { return description_of_kind(kind).work; }

std::int64_t operations(const WorkCounts& counts) {
  return std::accumulate(counts.begin(), counts.end(), std::int64_t{0}) - counts[Work::bookkeeping];
}

WorkCounts work_in(const Page& page, const std::array<std::int64_t, step_limit>& count) {
  WorkCounts counts{};
  for (const StepInfo& step : page) counts[work_of(step.kind)] += count[step.id];
  return counts;
}

WorkDone::WorkDone(const Trace& trace) {
  kinds_.reserve(trace.size());
  WorkCounts now{};
  trace.each(0, trace.size(), [&](std::int64_t, const RecordedEvent& recorded) {
    if (kinds_.size() % between_sums == 0) sums_.push_back(now);
    kinds_.push_back(work_of(static_cast<std::uint8_t>(recorded.event.index())));
    ++now[kinds_.back()];
    return true;
  });
  sums_.push_back(now);
}

WorkCounts WorkDone::at(std::int64_t position) const {
  position = std::clamp<std::int64_t>(position, 0, std::ssize(kinds_));
  const std::int64_t from = position / between_sums * between_sums;
  WorkCounts counts = sums_[position / between_sums];
  for (std::int64_t k = from; k < position; ++k) ++counts[kinds_[k]];
  return counts;
}

std::int64_t WorkDone::position_of(std::int64_t wanted) const {
  if (wanted <= 0) return 0;
  const std::int64_t size = kinds_.size();
  const auto after =
      std::partition_point(sums_.begin(), sums_.end(), [&](const WorkCounts& sum) { return operations(sum) < wanted; });
  std::int64_t position = std::clamp<std::int64_t>((after - sums_.begin() - 1) * between_sums, 0, size);
  std::int64_t done = operations(at(position));
  for (; position < size && done < wanted; ++position) done += kinds_[position] != Work::bookkeeping;
  return position;
}

namespace {

using formulas::Place;
using formulas::Situation;

/// A number, and what it took to make it.
struct Counted {
  double value = 0;
  Operations cost{};
  Counted() = default;
  Counted(double known) : value(known) {}  // NOLINT: an operand costs nothing
};
Counted made(double value, const Counted& a, const Counted& b, std::int64_t Operations::*what) {
  Counted result(value);
  result.cost = {a.cost.additions + b.cost.additions, a.cost.multiplications + b.cost.multiplications,
                 a.cost.divisions + b.cost.divisions, 0};
  ++(result.cost.*what);
  return result;
}
Counted operator+(const Counted& a, const Counted& b) { return made(a.value + b.value, a, b, &Operations::additions); }
Counted operator-(const Counted& a, const Counted& b) { return made(a.value - b.value, a, b, &Operations::additions); }
Counted operator*(const Counted& a, const Counted& b) {
  return made(a.value * b.value, a, b, &Operations::multiplications);
}
Counted operator/(const Counted& a, const Counted& b) { return made(a.value / b.value, a, b, &Operations::divisions); }
Counted floor(const Counted& a) { return {std::floor(a.value)}; }  // rounding is no arithmetic
Counted ceil(const Counted& a) { return {std::ceil(a.value)}; }

/// So many times what this cost.
void add(Operations& all, const Counted& made, std::int64_t times = 1) {
  all.additions += times * made.cost.additions;
  all.multiplications += times * made.cost.multiplications;
  all.divisions += times * made.cost.divisions;
}

/// Takes what the formulas of one event give.
template <class E>
struct Counter {
  using Number = Counted;
  Operations& all;
  bool adds;

  Number number(std::string_view, double value, const Place&) { return value; }
  Number named(std::string_view, const Number& formula) { return formula; }
  void reads(const Place&) {}
  bool trusts(const Place&) const { return false; }
  bool equal(double one, double other) const { return one == other; }
  void gives(double E::*member, const Number& formula) {
    if constexpr (std::is_same_v<E, SpanBegin> || std::is_same_v<E, EdgeTableInsert>)
      if (!adds && is_slope(member)) return;
    add(all, formula);
  }
  void within(double E::*, const Number&, double) {}  // how the run computed it is not known
  void whole(std::int32_t E::*, const Number&, std::int32_t) {}
  template <class Value>
  void is(Value E::*, Value) {}
  void verdict(bool E::*, const Number&, const Number&) {}
  void rule(formulas::Rule, bool) {}

 private:
  static bool is_slope(double E::*member) {
    if constexpr (std::is_same_v<E, SpanBegin>) return member == &SpanBegin::dz_dx;
    if constexpr (std::is_same_v<E, EdgeTableInsert>)
      return member == &EdgeTableInsert::dx_dy || member == &EdgeTableInsert::dz_dy;
    return false;
  }
};

template <class E>
constexpr bool interpolates =
    std::is_same_v<E, EdgeTableInsert> || std::is_same_v<E, EdgeStep> || std::is_same_v<E, SpanBegin> ||
    std::is_same_v<E, PlaneSlopes> || std::is_same_v<E, DepthInterpolate>;

/// What an attribute costs: the same at every vertex, on every edge, at every pixel.
struct AttributeCosts {
  Operations of_span, of_pixel, of_narrow_pixel;  ///< narrow: the span's two ends are one place

  explicit AttributeCosts(bool divides) {
    using formulas::OverDepth;
    const Counted known(1);  // whatever was computed before costs nothing here
    const OverDepth<Counted> one{known, known};
    const auto add_pair = [&](Operations& all, const OverDepth<Counted>& pair, std::int64_t times) {
      add(all, pair.over_z, times);
      if (divides) add(all, pair.one_over_z, times);
    };
    if (divides) add_pair(of_span, formulas::over_depth(known, known), 2 * 2);  // two vertices of each of two edges
    const OverDepth<Counted> on_line = formulas::on_line(one, one, known, known, known);
    add_pair(of_span, on_line, 2);
    if (divides) add(of_narrow_pixel, known / known);
    of_pixel = of_narrow_pixel;
    add_pair(of_pixel, on_line, 1);
  }
};
void add(Operations& all, const Operations& more) {
  all.additions += more.additions;
  all.multiplications += more.multiplications;
  all.divisions += more.divisions;
}

}  // namespace

Operations operations_of(const Trace& trace) {
  Operations all;
  const bool adds = adds_slopes(trace.header().conventions);
  formulas::walk(
      trace,
      [&]<class E>(std::int64_t, const E& e, const Situation& at) {
        if constexpr (interpolates<E>) {
          all.pixels += std::is_same_v<E, DepthInterpolate>;
          Counter<E> counter{all, adds};
          derive(e, at, counter);
        }
        return true;
      },
      [](std::int64_t, const Impossible&) {});
  return all;
}

Operations attribute_operations_of(const Trace& trace) {
  Operations all;
  const AttributeCosts costs(formulas::attribute_over_depth(trace.scene(), trace.header().conventions));
  const std::int32_t components = formulas::shading_of(trace.scene(), trace.header().conventions).components();
  bool narrow = false;
  trace.each(0, trace.size(), [&](std::int64_t, const RecordedEvent& recorded) {
    if (const auto* span = get_if<SpanBegin>(&recorded.event)) {
      narrow = span->x_left == span->x_right;
      for (std::int32_t k = 0; k < components; ++k) add(all, costs.of_span);
    } else if (holds<AttributeInterpolate>(recorded.event)) {
      ++all.pixels;
      add(all, narrow ? costs.of_narrow_pixel : costs.of_pixel);
    }
    return true;
  });
  return all;
}

}  // namespace zstep::compare
