#include "traces/replay/key_frames.hpp"

#include <algorithm>
#include <utility>

#include "traces/replay/memory.hpp"
#include "traces/replay/same.hpp"

namespace zstep {

namespace {

bool same_way(const VertexStages& one, const VertexStages& other) { return same(one, other); }

}  // namespace

KeyFrames::KeyFrames(const Beginning& beginning, std::int64_t end, std::int64_t spacing, std::size_t budget)
    : beginning_(&beginning), end_(end), spacing_(spacing), next_due_(spacing), budget_(budget) {
  if (next_due() <= end_) beginning_->begin_pictures(last_);
}

void KeyFrames::set_pictures(Frame& frame, std::size_t n, const State& before, const State& now) const {
  const bool whole = n % group == 0;
  frame.picture = PictureChange(whole ? nullptr : &before.picture, now.picture, beginning_->empty_depth());
  frame.light = PictureChange(whole ? nullptr : &before.light, now.light, beginning_->empty_depth());
}

void KeyFrames::add(const State& state) {
  Frame frame;
  frame.position = state.position;
  frame.machine = state.machine;
  frame.vertices = state.vertices;
  if (!frames_.empty()) {
    const SharedChunks<VertexStages>& before = frames_.back().vertices;
    frame.vertices.share(before, same_way);  // where the state was stepped to anew
    bytes_ += frames_.back().bytes_beyond(frame);
  }
  set_pictures(frame, frames_.size(), last_, state);
  bytes_ += frame.bytes();
  if (frames_.size() % group == 0) {
    last_.picture = state.picture, last_.light = state.light;
  } else {
    frame.picture.apply_to(last_.picture);
    frame.light.apply_to(last_.light);
  }
  frames_.push_back(std::move(frame));
  if (bytes_ > budget_ && frames_.size() > 2) thin_out();
  next_due_ = state.position + spacing_;
  if (next_due_ > end_) last_ = State();
}

std::size_t KeyFrames::Frame::bytes_beyond(const Frame& later) const {
  return heap_beyond(machine, later.machine) + heap_beyond(vertices, later.vertices);
}

std::size_t KeyFrames::count_before(std::int64_t position) const {
  const auto after = std::upper_bound(frames_.begin(), frames_.end(), position,
                                      [](std::int64_t wanted, const Frame& frame) { return wanted < frame.position; });
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
    state.machine = beginning_->machine();
    beginning_->begin_vertices(state);
    return;
  }
  const Frame& frame = frames_[count - 1];
  state.position = frame.position;
  state.machine = frame.machine;
  state.vertices = frame.vertices;
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
    if (!kept.empty()) bytes_ += kept.back().bytes_beyond(frame);
    bytes_ += frame.bytes();
    before.picture = now.picture, before.light = now.light;
    kept.push_back(std::move(frame));
  }
  frames_ = std::move(kept);
  spacing_ *= 2;
}

}  // namespace zstep
