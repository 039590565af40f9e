#include "traces/diff/before_first.hpp"

#include <algorithm>

#include "traces/file/visit.hpp"
#include "traces/replay/beginning.hpp"

namespace zstep::diff {

namespace {

struct Approach {
  const DiffReport& report;
  Replaying run;
  Identity identity;
  GoOn go_on;

  template <class E>
  bool operator()(std::int64_t position, std::uint8_t, const E& e) {
    run.apply(position, e);
    if (report.alignment.kinds[kind_of<E>].pairs > 0 || (says_whose_turn<E> && report.alignment.turns))
      identity.take_note_of(e);
    return go_on(position);
  }
  bool operator()(std::int64_t position, const codec::FragmentRun& pixels) { return pass(position, pixels); }
  bool operator()(std::int64_t position, const codec::PaintRun& pixels) { return pass(position, pixels); }

 private:
  bool pass(std::int64_t position, const auto& pixels) {
    run.apply_pixels(position, pixels);
    return go_on(position);
  }
};

}  // namespace

BeforeFirst go_to_first(const Trace& trace, bool of_a, const DiffReport& report,
                        const std::function<bool(std::int64_t)>& on_way, Way way) {
  std::int64_t first = trace.size(), last = 0;
  for (const Difference& difference : report.alignment.differences) {
    const std::int64_t own = own_step(difference, of_a);
    first = std::min(first, own != 0 ? own - 1 : step_before(report.alignment, difference, of_a));
    last = std::max(last, own);
  }
  if (way == Way::plain) first = 0, last = trace.size();
  Approach approach{report, {trace, Beginning(trace).state()}, Identity(trace), GoOn(on_way)};
  if (first < last) trace.visit(0, first, approach);
  return {first, last, approach.run.state(), std::move(approach.identity)};
}

}  // namespace zstep::diff
