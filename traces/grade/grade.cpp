#include "traces/grade/grade.hpp"

#include <algorithm>
#include <array>
#include <set>

#include <fmt/format.h>

#include "traces/formulas/walk.hpp"
#include "traces/mistakes/name.hpp"
#include "traces/mistakes/turned.hpp"

namespace zstep::grade {

namespace {

/// The length of the longest run of ascending numbers that others may stand between.
std::int64_t longest_ascending(const std::vector<std::int64_t>& numbers) {
  std::vector<std::int64_t> ends;  // the least last number of a run of each length
  for (const std::int64_t number : numbers) {
    const auto place = std::lower_bound(ends.begin(), ends.end(), number);
    if (place == ends.end()) ends.push_back(number);
    else *place = number;
  }
  return static_cast<std::int64_t>(ends.size());
}

std::array<std::int64_t, kind_count> steps_by_kind(const Trace& trace) {
  std::array<std::int64_t, kind_count> counts{};
  trace.each(0, trace.size(), [&](std::int64_t, const RecordedEvent& recorded) {
    ++counts[recorded.event.index()];
    return true;
  });
  return counts;
}

class Counter {
 public:
  Counter(const Trace& reference, const Trace& run, const diff::DiffReport& difference, const CheckMarks& marks,
          const std::set<std::uint8_t>& aside)
      : run_(run), difference_(difference), aside_(aside), expected_(steps_by_kind(reference)) {
    std::int64_t last = 0;
    for (const Fault& fault : marks.faults) {
      if (fault.step == last || difference.alignment.in_a(fault.step) == 0) continue;
      last = fault.step;
      ++miscomputed_[fault.kind];
    }
  }

  PartCount steps(const Part& part) const {
    PartCount count;
    for (const std::uint8_t kind : part.kinds) {
      const diff::KindDifference& of = difference_.kinds[kind];
      count.expected += expected_[kind] - of.idle_a;
      if (aside_.contains(kind)) continue;
      count.additional += of.only_b - of.idle_b;
      count.same += of.same + of.rounding;
      count.computed += of.same + of.rounding + of.different - miscomputed_[kind];
    }
    if (part.level == Level::ordered) {
      const std::int64_t moved = out_of_order(part);
      count.same = std::max<std::int64_t>(0, count.same - moved);
      count.computed = std::max<std::int64_t>(0, count.computed - moved);
    }
    return count;
  }

 private:
  /// How many of a part's steps would have to be moved for the rest to be in the reference's order.
  std::int64_t out_of_order(const Part& part) const {
    const std::set<std::uint8_t> kinds(part.kinds.begin(), part.kinds.end());
    std::vector<std::int64_t> matched;
    run_.each(0, run_.size(), [&](std::int64_t position, const RecordedEvent& recorded) {
      if (!kinds.contains(static_cast<std::uint8_t>(recorded.event.index()))) return true;
      if (const std::int64_t a = difference_.alignment.in_a(position); a != 0) matched.push_back(a);
      return true;
    });
    return static_cast<std::int64_t>(matched.size()) - longest_ascending(matched);
  }

  const Trace& run_;
  const diff::DiffReport& difference_;
  const std::set<std::uint8_t>& aside_;
  std::array<std::int64_t, kind_count> expected_, miscomputed_{};
};

/// What is in the buffers at the end. A step that cannot be does nothing.
Picture picture_of(const Trace& trace) {
  return formulas::walk(
             trace, [](std::int64_t, const auto&, const formulas::Situation&) { return true; },
             [](std::int64_t, const Impossible&) {})
      .picture;
}

/// Where a cause of a difference shows in the run: at its step, or before the one where something is missing.
std::int64_t shows_at(const Judgement& found, const diff::Cause& cause) {
  return cause.first.only_a() ? found.difference.alignment.before_in_b(cause.first.a) + 1 : cause.first.b;
}

/// The first of what parts and what is computed wrongly, in the order of the run.
std::optional<Divergence> first_divergence(const Judgement& found, const std::set<std::uint8_t>& aside) {
  std::optional<Divergence> first;
  for (const diff::Cause& cause : found.difference.causes) {
    if (cause.part != diff::Part::different || aside.contains(cause.first.kind)) continue;
    const std::int64_t step = shows_at(found, cause);
    if (!first || step < first->step) first = Divergence{cause.first, std::nullopt, cause.too_early, step};
  }
  const auto cause = std::find_if(found.checked.causes.begin(), found.checked.causes.end(),
                                  [&](const Cause& one) { return !aside.contains(one.first.kind); });
  if (cause != found.checked.causes.end()) {
    const Fault& fault = cause->first;
    if (!first || fault.step < first->step) first = Divergence{std::nullopt, fault, std::nullopt, fault.step};
    else if (fault.step == first->step) first->fault = fault;
  }
  return first;
}

/// Does a run first part from the reference in the depth of a pixel, by far more than rounding?
bool depth_is_wrong(const Divergence& first) {
  constexpr float far_more = 1e-4f;
  if (!first.parts || first.parts->only_a() || first.parts->only_b() || !(first.parts->off > far_more)) return false;
  const auto has_depth = [&]<class E>(const E*) {
    bool found = false;
    for_each_index<E>([&]<std::size_t I>() {
      found = found || (field_at<E, I>.name == "z" && (first.parts->fields >> I & 1u) != 0);
    });
    return kind_of<E> == first.parts->kind && found;
  };
  const DepthInterpolate* const interpolated = nullptr;
  const DepthCompare* const compared = nullptr;
  return has_depth(interpolated) || has_depth(compared);
}

}  // namespace

std::vector<bool> drawn(const Picture& picture) {
  std::vector<bool> pixels(picture.polygon.size());
  for (std::size_t i = 0; i < pixels.size(); ++i)
    pixels[i] = picture.polygon[i] != no_polygon || (!picture.ink.empty() && picture.ink[i] != no_ink);
  return pixels;
}

PartCount count_pixels(const std::vector<bool>& reference, const std::vector<bool>& other,
                       const std::vector<float>& apart) {
  PartCount count;
  for (std::size_t i = 0; i < reference.size(); ++i) {
    count.expected += reference[i];
    count.additional += other[i] && !reference[i];
    count.same += reference[i] && apart[i] == 0;
  }
  count.computed = count.same;
  return count;
}

std::set<std::uint8_t> kinds_of_unknown_edges(const Trace& run) {
  std::set<std::uint8_t> kinds;
  if (!run.has(kind_of<EdgeTableInsert>))
    for (const std::uint8_t kind : {kind_of<EdgeEnter>, kind_of<EdgeStep>, kind_of<EdgeSwap>, kind_of<EdgeRetire>})
      if (run.has(kind)) kinds.insert(kind);
  return kinds;
}

Judgement judge(const Trace& reference, const Trace& run, const std::vector<Part>& parts,
                const HeldTo& held) {
  Judgement found;
  const std::set<std::uint8_t> aside = kinds_of_unknown_edges(run);
  CheckMarks marks;
  found.checked = check(run, nullptr, nullptr, &marks, held);
  found.difference = diff::compare(reference, run, nullptr, diff::Way::fast, held);
  Ends& ends = found.ends = {picture_of(reference), picture_of(run), {}};
  ends.apart =
      diff::compare_pictures(diff::buffers_of(reference, ends.reference), diff::buffers_of(run, ends.run),
                             found.difference.precision);
  const Counter counter(reference, run, found.difference, marks, aside);
  for (const Part& part : parts) {
    if (part.level != Level::buffers) {
      found.parts.push_back(counter.steps(part));
      continue;
    }
    found.parts.push_back(count_pixels(drawn(ends.reference), drawn(ends.run), ends.apart.apart));
  }
  found.first = first_divergence(found, aside);
  return found;
}

std::optional<Likely> mistake_in(const Trace& reference, const Trace& run, const Judgement& found,
                                 std::vector<mistakes::Mistake>* either) {
  if (!found.first) return std::nullopt;
  std::int64_t next = 0;
  const auto look_at = [&](std::int64_t step) {
    if (step > found.first->step && (next == 0 || step < next)) next = step;
  };
  for (const diff::Cause& cause : found.difference.causes)
    if (cause.part == diff::Part::different) look_at(shows_at(found, cause));
  for (const Cause& cause : found.checked.causes) look_at(cause.first.step);
  const Precision& precision = found.checked.precision;
  std::optional<Likely> likely;
  const std::int64_t first = found.first->step;
  const std::vector<mistakes::Mistake> some =
      mistakes::mistakes_of(run, first, next, depth_is_wrong(*found.first), precision);
  if (some.size() == 1) {
    likely.emplace().mistake = some.front();
  } else if (!some.empty()) {
    if (either) *either = some;
  } else if (const auto turned = mistakes::turned_of(reference, run, precision)) {
    likely.emplace().mistake = *turned;
  } else if (const auto two = mistakes::pair_of(run, first, precision)) {
    likely.emplace().mistake = two->first;
    likely->also = two->second;
  }
  return likely;
}

HeldTo held_to(int digits, const std::vector<std::string>& free) {
  std::uint32_t fixed = 0;
  for (std::size_t k = 0; k < words_of<NumberFormat>.size(); ++k)
    if (std::find(free.begin(), free.end(), fmt::format("number_format {}", words_of<NumberFormat>[k])) != free.end())
      fixed |= 1u << k;
  return {digits, fixed};
}

GivenRun given_run(const Header& reference, const Scene& scene, std::vector<std::string> free) {
  return {&reference, &scene, [&reference, free = std::move(free)](const Header& declared) {
            Header header = reference;
            const auto is_free = [&](std::string_view what) {
              return std::find(free.begin(), free.end(), what) != free.end();
            };
            // Fixed point is allowed larger errors, so a run may declare it only where the homework names it.
            const NumberFormat format = declared.conventions.number_format;
            const bool accepted = bits_of(format) == 0 || is_free(fmt::format("number_format {}", word_of(format)));
            if (is_free("number_format") && !(accepted && declared.declares(Convention::number_format)))
              header.undeclared |= 1u << static_cast<unsigned>(Convention::number_format);
            header.page = declared.page;
            header.writer = declared.writer;
            for_each_convention([&]<class E>(std::string_view key, E Conventions::*member) {
              if (is_free(key) && (accepted || key != "number_format"))
                header.conventions.*member = declared.conventions.*member;
            });
            return header;
          }};
}

}  // namespace zstep::grade
