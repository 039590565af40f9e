#include "sim/cost/work.hpp"

#include <algorithm>
#include <numeric>

#include "traces/events/fields.hpp"

namespace zstep::compare {
namespace {

constexpr std::array<std::string_view, work_count> words{
    "vertices transformed", "planes, boxes, rays", "tests",  "cuts",       "edges and spans",
    "interpolations",       "depth compares",      "writes", "bookkeeping"};

constexpr std::int64_t between_sums = 4096;

}  // namespace

std::string_view word_of(Work work) { return words[static_cast<std::size_t>(work)]; }
Work work_of(std::uint8_t kind) { return description_of_kind(kind).work; }

std::int64_t operations(const WorkCounts& counts) {
  return std::accumulate(counts.begin(), counts.end(), std::int64_t{0}) -
         counts[static_cast<std::size_t>(Work::bookkeeping)];
}

WorkCounts work_in(const Page& page, const std::array<std::int64_t, step_limit>& count) {
  WorkCounts counts{};
  for (const StepInfo& step : page) counts[static_cast<std::size_t>(work_of(step.kind))] += count[step.id];
  return counts;
}

WorkDone::WorkDone(const Trace& trace) {
  kinds_.reserve(static_cast<std::size_t>(trace.size()));
  WorkCounts now{};
  trace.each(0, trace.size(), [&](std::int64_t, const RecordedEvent& recorded) {
    if (kinds_.size() % between_sums == 0) sums_.push_back(now);
    kinds_.push_back(work_of(static_cast<std::uint8_t>(recorded.event.index())));
    ++now[static_cast<std::size_t>(kinds_.back())];
    return true;
  });
  sums_.push_back(now);
}

WorkCounts WorkDone::at(std::int64_t position) const {
  position = std::clamp<std::int64_t>(position, 0, static_cast<std::int64_t>(kinds_.size()));
  const std::int64_t from = position / between_sums * between_sums;
  WorkCounts counts = sums_[static_cast<std::size_t>(position / between_sums)];
  for (std::int64_t k = from; k < position; ++k)
    ++counts[static_cast<std::size_t>(kinds_[static_cast<std::size_t>(k)])];
  return counts;
}

std::int64_t WorkDone::position_of(std::int64_t wanted) const {
  if (wanted <= 0) return 0;
  const auto size = static_cast<std::int64_t>(kinds_.size());
  const auto after =
      std::partition_point(sums_.begin(), sums_.end(), [&](const WorkCounts& sum) { return operations(sum) < wanted; });
  std::int64_t position = std::clamp<std::int64_t>((after - sums_.begin() - 1) * between_sums, 0, size);
  std::int64_t done = operations(at(position));
  for (; position < size && done < wanted; ++position)
    done += kinds_[static_cast<std::size_t>(position)] != Work::bookkeeping;
  return position;
}

}  // namespace zstep::compare
