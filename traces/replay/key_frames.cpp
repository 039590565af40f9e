#include "traces/replay/key_frames.hpp"

#include <algorithm>
#include <cstring>
#include <utility>

namespace zstep {

namespace {

bool same_ways(const std::vector<VertexWay>& one, const VertexWay* other) {
  return std::equal(one.begin(), one.end(), other, [](const VertexWay& a, const VertexWay& b) {
    return a.stage == b.stage && std::memcmp(&a.view, &b.view, sizeof a.view) == 0 && std::memcmp(&a.plane, &b.plane, sizeof a.plane) == 0 &&
           std::memcmp(&a.raster, &b.raster, sizeof a.raster) == 0 && std::memcmp(&a.world, &b.world, sizeof a.world) == 0;
  });
}

}  // namespace

KeyFrames::KeyFrames(const Beginning& beginning, std::int64_t end, std::int64_t spacing, std::size_t budget)
    : beginning_(&beginning), points_(beginning.points()), end_(end), spacing_(spacing), next_due_(spacing), budget_(budget) {
  if (next_due() <= end_) beginning_->begin_pictures(last_);
}

void KeyFrames::set_pictures(Frame& frame, std::size_t n, const State& before, const State& now) {
  const bool whole = n % group == 0;
  frame.picture = PictureChange(whole ? nullptr : &before.picture, now.picture);
  frame.light = PictureChange(whole ? nullptr : &before.light, now.light);
  frame.bytes = sizeof(Frame) + frame.made.size() * sizeof(VertexWay) + frame.picture.bytes() + frame.light.bytes();
}

void KeyFrames::add(const State& state) {
  if (std::exchange(points_changed_, false) && many_points()) {
    next_due_ = state.position + spacing_;
    return;
  }
  const auto scene_points_end = state.vertices.begin() + static_cast<std::ptrdiff_t>(points_);
  Frame frame;
  frame.position = state.position;
  frame.machine = state.machine;
  if (!points_at_hand_ && !frames_.empty() && same_ways(*frames_.back().points, state.vertices.data())) points_at_hand_ = frames_.back().points;
  if (!points_at_hand_) {
    points_at_hand_ = std::make_shared<const std::vector<VertexWay>>(state.vertices.begin(), scene_points_end);
    bytes_ += bytes_of_points();
  }
  frame.points = points_at_hand_;
  frame.made.assign(scene_points_end, state.vertices.end());
  set_pictures(frame, frames_.size(), last_, state);
  bytes_ += frame.bytes;
  frames_.push_back(std::move(frame));
  if (bytes_ > budget_ && frames_.size() > 2) thin_out();
  next_due_ = state.position + spacing_;
  if (next_due_ <= end_) last_.picture = state.picture, last_.light = state.light;
  else last_ = State();
}

std::size_t KeyFrames::count_before(std::int64_t position) const {
  const auto after = std::upper_bound(frames_.begin(), frames_.end(), position, [](std::int64_t wanted, const Frame& frame) { return wanted < frame.position; });
  return static_cast<std::size_t>(after - frames_.begin());
}

std::int64_t KeyFrames::before(std::int64_t position) const {
  const std::size_t count = count_before(position);
  return count == 0 ? 0 : frames_[count - 1].position;
}

void KeyFrames::restore_before(std::int64_t position, State& state) {
  const std::size_t count = count_before(position);
  beginning_->begin_pictures(state);
  for (std::size_t i = count == 0 ? 0 : (count - 1) / group * group; i < count; ++i) {
    frames_[i].picture.apply_to(state.picture);
    frames_[i].light.apply_to(state.light);
  }
  if (count == 0) {
    state.position = 0;
    state.machine = Machine();
    beginning_->begin_vertices(state);
    points_at_hand_ = nullptr;
    return;
  }
  const Frame& frame = frames_[count - 1];
  state.position = frame.position;
  state.machine = frame.machine;
  state.vertices.resize(points_);
  if (points_at_hand_ != frame.points) state.vertices = *frame.points;
  state.vertices.insert(state.vertices.end(), frame.made.begin(), frame.made.end());
  points_at_hand_ = frame.points;
}

void KeyFrames::thin_out() {
  State before, now;
  std::vector<Frame> kept;
  bytes_ = 0;
  for (std::size_t i = 0; i < frames_.size(); ++i) {
    Frame& frame = frames_[i];
    if (i % group == 0) beginning_->begin_pictures(now);
    frame.picture.apply_to(now.picture);
    frame.light.apply_to(now.light);
    if (i % 2 == 0 && i + 1 < frames_.size()) continue;
    set_pictures(frame, kept.size(), before, now);
    if (kept.empty() || kept.back().points != frame.points) bytes_ += bytes_of_points();
    bytes_ += frame.bytes;
    before.picture = now.picture, before.light = now.light;
    kept.push_back(std::move(frame));
  }
  frames_ = std::move(kept);
  spacing_ *= 2;
}

}  // namespace zstep
