#include "sim/viewer/model/depth_errors.hpp"

#include <algorithm>

namespace zstep::viewer {

const std::vector<oracle::DepthError>& DepthErrors::of(const Trace& trace) {
  if (found_ || too_long(trace)) return all_;
  found_ = true;
  oracle::errors_of(trace, nullptr, oracle::Truth::formula, [&](const oracle::DepthError& depth) {
    all_.push_back(depth);
    least_ = std::min(least_, depth.error), most_ = std::max(most_, depth.error);
    longest_ = std::max({longest_, depth.along_span, depth.along_edge});
  });
  return all_;
}

std::optional<Drift> drift_at(const Moment& now, DepthErrors& errors, std::optional<Cell> chosen) {
  const std::vector<oracle::DepthError>& all = errors.of(now.trace());
  const std::int64_t position = now.picture_position();
  const auto next = std::upper_bound(all.begin(), all.end(), position,
                                     [](std::int64_t p, const oracle::DepthError& depth) { return p < depth.step; });
  const oracle::DepthError* of = nullptr;
  if (chosen) {
    for (auto it = next; it != all.begin() && !of;)
      if (--it; it->x == chosen->x && it->y == chosen->y) of = &*it;
  } else if (next != all.end() && next->span <= position) {
    of = &*next;  // begun, and it has more depths
  } else if (const auto& span = now.state().machine.span; span && next != all.begin()) {
    if (const auto& last = *(next - 1); last.y == span->y && last.x <= span->last) of = &last;
  }
  const bool past = !of && !chosen && next != all.begin();
  if (past) of = &*(next - 1);
  if (!of) return std::nullopt;
  Drift drift;
  drift.y = of->y, drift.chosen = chosen.has_value(), drift.past = past;
  for (auto it = all.begin(); it != next; ++it) {
    if (it->span == of->span) drift.span.push_back(*it);
    if (it->edge == of->edge && it->along_span == 0) drift.edge.push_back(*it);
  }
  return drift;
}

}  // namespace zstep::viewer
