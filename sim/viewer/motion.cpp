#include "sim/viewer/motion.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace zstep::viewer {

void Motion::begin(double time, bool on, std::uint64_t moves, std::uint64_t jumps, std::int64_t step) {
  const bool same_window = begun_ && std::exchange(jumps_, jumps) == jumps;
  jumps_ = jumps, time_ = time, on_ = on;
  last_ = std::exchange(now_, {});
  if (begun_ && std::exchange(moves_, moves) != moves) panes_since_ = time, from_ = last_;
  if (begun_ && std::exchange(step_, step) != step) row_since_ = time;
  moves_ = moves, step_ = step, begun_ = true;
  const auto over = [&](const std::optional<double>& since) { return !on || !since || time - *since >= seconds; };
  if (over(panes_since_) || !same_window) panes_since_.reset();
  if (over(row_since_)) row_since_.reset();
  if (arrived() == 1 || !on || !same_window) skip();
}

void Motion::step_forwards() {
  if (!on_) return;
  if (step_since_) skip();
  else step_since_ = time_;
}

double Motion::arrived() const {
  return step_since_ ? std::clamp((time_ - *step_since_) / seconds_of_step, 0.0, 1.0) : 1.0;
}

Motion::Place Motion::between(Place from, Place to, double since) const {
  const double share = std::clamp((time_ - since) / seconds, 0.0, 1.0), left = (1 - share) * (1 - share);
  const auto mix = [&](float a, float b) { return b + (a - b) * static_cast<float>(left); };
  return {{mix(from.at.x, to.at.x), mix(from.at.y, to.at.y)},
          {mix(from.size.x, to.size.x), mix(from.size.y, to.size.y)}};
}

Motion::Place Motion::of_pane(const std::string& id, Place goal) {
  const auto from = from_.find(id);
  return now_[id] = panes_since_ && from != from_.end() ? between(from->second, goal, *panes_since_) : goal;
}

Motion::Place Motion::of_row(Place from, Place to) const { return row_since_ ? between(from, to, *row_since_) : to; }

}  // namespace zstep::viewer
