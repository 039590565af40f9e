#include "sim/viewer/touch.hpp"

#include <algorithm>
#include <cmath>

#include "traces/math/portable_math.hpp"

namespace zstep::viewer {
namespace {

using Kind = Touch::Act::Kind;

float distance_between(Touch::Point a, Touch::Point b) { return portable::length(a.x - b.x, a.y - b.y); }

}  // namespace

Touch::Finger* Touch::find(std::int64_t finger) {
  const auto found = std::find_if(fingers_.begin(), fingers_.end(), [&](const Finger& f) { return f.id == finger; });
  return found == fingers_.end() ? nullptr : &*found;
}

Touch::Point Touch::middle() const {
  return {(fingers_[0].at.x + fingers_[1].at.x) / 2, (fingers_[0].at.y + fingers_[1].at.y) / 2};
}

/// Between two fingers; a least distance keeps the zoom bounded where they nearly meet.
float Touch::apart() const { return std::max(2 * slop, distance_between(fingers_[0].at, fingers_[1].at)); }

/// What is under way ends, as where the last finger goes up.
std::vector<Touch::Act> Touch::stop() {
  const Means was = std::exchange(means_, Means::done);
  if (was == Means::drags) return {{.kind = Kind::release}};
  if (was == Means::two_move) return {{.kind = Kind::let_go}};
  return {};
}

std::vector<Touch::Act> Touch::down(std::int64_t finger, Point at, std::int64_t now) {
  std::vector<Act> acts;
  if (find(finger)) acts = end();  // that it went up was not told
  fingers_.push_back({finger, at});
  if (fingers_.size() == 1) {
    means_ = Means::rests, began_ = at, since_ = now;
    acts.push_back({.kind = Kind::point, .at = at});
    return acts;
  }
  acts = stop();
  if (fingers_.size() > 2) return acts;  // a whole hand means nothing
  means_ = scrolls_(middle()) ? Means::two_scroll : Means::two_move;
  acts.push_back({.kind = Kind::point, .at = middle()});
  if (means_ == Means::two_move) acts.push_back({.kind = Kind::hold, .at = middle()});
  return acts;
}

std::vector<Touch::Act> Touch::move(std::int64_t finger, Point at) {
  Finger* const moved = find(finger);
  if (!moved) return {};
  const Point was = moved->at;
  if (means_ == Means::two_move || means_ == Means::two_scroll) {
    const Point from = middle();
    const float before = apart();
    moved->at = at;
    const Point to = middle();
    if (means_ == Means::two_scroll) return {{.kind = Kind::scroll, .at = to, .by = {to.x - from.x, to.y - from.y}}};
    std::vector<Act> acts{{.kind = Kind::point, .at = to}};
    if (apart() != before) acts.push_back({.kind = Kind::zoom, .at = to, .factor = apart() / before});
    return acts;
  }
  if (means_ == Means::rests && distance_between(began_, at) <= slop) return {};  // its place stays where it began
  moved->at = at;
  std::vector<Act> acts;
  if (means_ == Means::rests) {
    means_ = scrolls_(began_) ? Means::scrolls : Means::drags;
    if (means_ == Means::drags) acts.push_back({.kind = Kind::press, .at = began_});
  }
  if (means_ == Means::scrolls) acts.push_back({.kind = Kind::scroll, .at = at, .by = {at.x - was.x, at.y - was.y}});
  if (means_ == Means::drags) acts.push_back({.kind = Kind::point, .at = at});
  return acts;
}

std::vector<Touch::Act> Touch::up(std::int64_t finger) {
  if (!find(finger)) return {};
  std::vector<Act> acts;
  if (means_ == Means::rests) {
    acts.push_back({.kind = Kind::tap, .at = began_});
    means_ = Means::done;
  } else {
    acts = stop();  // also where the other of two stays
  }
  std::erase_if(fingers_, [&](const Finger& f) { return f.id == finger; });
  if (!fingers_.empty()) return acts;
  means_ = Means::nothing;
  acts.push_back({.kind = Kind::leave});
  return acts;
}

std::vector<Touch::Act> Touch::wait(std::int64_t now) {
  if (!due() || now < *due()) return {};
  means_ = Means::done;
  return {{.kind = Kind::right_click, .at = began_}};
}

std::optional<std::int64_t> Touch::due() const {
  return means_ == Means::rests ? std::optional(since_ + long_press) : std::nullopt;
}

std::vector<Touch::Act> Touch::end() {
  if (fingers_.empty()) return {};
  std::vector<Act> acts = stop();
  fingers_.clear();
  means_ = Means::nothing;
  acts.push_back({.kind = Kind::leave});
  return acts;
}

}  // namespace zstep::viewer
