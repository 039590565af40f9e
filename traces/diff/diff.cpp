#include "traces/diff/diff.hpp"

#include <algorithm>

#include "traces/diff/causes.hpp"
#include "traces/diff/moved.hpp"
#include "traces/diff/order.hpp"

namespace zstep::diff {

std::int64_t DiffReport::differences() const {
  std::int64_t all = 0;
  for (const Cause& cause : causes)
    if (cause.part == Part::different) all += 1 + cause.again + cause.symptoms;
  return all;
}

DiffReport compare(const Trace& a, const Trace& b, const std::function<bool(double)>& on_way, Way way,
                   const HeldTo& held, std::size_t keeps, Unrecorded unrecorded) {
  DiffReport report;
  bool told_to_end = false;
  const auto part_of = [&](double from, double share) {
    return [&, from, share](double done) { return on_way && (told_to_end = on_way(from + share * done)); };
  };
  report.alignment = align(a, b, part_of(0, 0.5), way, keeps, unrecorded);
  const Precision of_a = precision_of(a, held), of_b = precision_of(b, held);
  const bool a_coarser = of_a.relative > of_b.relative || of_a.absolute > of_b.absolute;
  report.precision = a_coarser ? of_a : of_b;
  report.precision.relative = std::max(of_a.relative, of_b.relative);
  report.precision.absolute = std::max(of_a.absolute, of_b.absolute);
  if (of_a.positions != of_b.positions) report.precision.positions = std::max(of_a.amount("px"), of_b.amount("px"));
  for (std::size_t kind = 0; kind < kind_count; ++kind) {
    const KindCount& count = report.alignment.kinds[kind];
    report.kinds[kind] = {count.equal, 0, 0, count.only_a, count.only_b, 0, 0, count.not_kept};
  }
  if (report.alignment.differences.empty()) {
    find_wrong_order(b, report);
    return report;
  }

  std::vector<Finding> in_a(report.alignment.differences.size()), in_b = in_a;
  std::vector<Elsewhere> elsewhere;
  const auto at_step = [&](const Trace& trace, double from, double share) {
    return [&, on_share = part_of(from, share)](std::int64_t position) {
      return on_share(static_cast<double>(position) / static_cast<double>(trace.size()));
    };
  };
  const BeforeFirst begin_a = go_to_first(a, true, report, at_step(a, 0.5, 0.1), way);
  const BeforeFirst begin_b = go_to_first(b, false, report, at_step(b, 0.6, 0.1), way);
  const auto go_through = [&](bool of_a_run, double from) {
    if (told_to_end) return;
    const Trace& trace = of_a_run ? a : b;
    elsewhere = follow(trace, of_a_run, report, of_a_run ? begin_a : begin_b, elsewhere, of_a_run ? in_a : in_b,
                       at_step(trace, from, 0.1), way);
  };
  // What only one run does is not seen in going through the other: so the one that was gone through first is gone
  // through again.
  go_through(true, 0.7);
  go_through(false, 0.8);
  go_through(true, 0.9);
  if (told_to_end) report.alignment.complete = false;
  find_causes(report, in_a, in_b);
  join_moved(a, b, report);
  find_other_order(a, b, report);
  find_wrong_order(b, report);
  return report;
}

}  // namespace zstep::diff
