#include "traces/replay/key_frames.hpp"

#include <algorithm>
#include <bit>
#include <cstring>
#include <utility>

namespace zstep {

namespace {

bool same_bits(double one, double other) { return std::memcmp(&one, &other, sizeof one) == 0; }

bool same_ways(const std::vector<VertexWay>& one, const VertexWay* other) {
  return std::equal(one.begin(), one.end(), other, [](const VertexWay& a, const VertexWay& b) {
    return a.stage == b.stage && std::memcmp(&a.view, &b.view, sizeof a.view) == 0 && std::memcmp(&a.plane, &b.plane, sizeof a.plane) == 0 &&
           std::memcmp(&a.raster, &b.raster, sizeof a.raster) == 0 && std::memcmp(&a.world, &b.world, sizeof a.world) == 0;
  });
}

}  // namespace

PictureChange::PictureChange(const Picture& before, const Picture& after) : changed_((after.depth.size() + 63) / 64) {
  const bool ink = !after.ink.empty();
  const std::size_t size = after.depth.size();
  for (std::size_t word = 0; word < changed_.size(); ++word) {
    const std::size_t first = word * 64, end = std::min(size, first + 64);
    std::uint64_t bits = 0;
    for (std::size_t pixel = first; pixel < end; ++pixel) {
      const bool differs = !same_bits(before.depth[pixel], after.depth[pixel]) || before.polygon[pixel] != after.polygon[pixel] ||
                           (ink && before.ink[pixel] != after.ink[pixel]);
      bits |= std::uint64_t{differs} << (pixel - first);
    }
    changed_[word] = bits;
    for (; bits != 0; bits &= bits - 1) {
      const std::size_t pixel = first + static_cast<std::size_t>(std::countr_zero(bits));
      depth_.push_back(after.depth[pixel]);
      polygon_.push_back(after.polygon[pixel]);
      if (ink) ink_.push_back(after.ink[pixel]);
    }
  }
  depth_.shrink_to_fit(), polygon_.shrink_to_fit(), ink_.shrink_to_fit();
}

void PictureChange::apply_to(Picture& picture) const {
  std::size_t next = 0;
  for (std::size_t word = 0; word < changed_.size(); ++word) {
    for (std::uint64_t bits = changed_[word]; bits != 0; bits &= bits - 1, ++next) {
      const std::size_t pixel = word * 64 + static_cast<std::size_t>(std::countr_zero(bits));
      picture.depth[pixel] = depth_[next];
      picture.polygon[pixel] = polygon_[next];
      if (!ink_.empty()) picture.ink[pixel] = ink_[next];
    }
  }
}

std::size_t PictureChange::bytes() const {
  return changed_.size() * sizeof(std::uint64_t) + depth_.size() * (sizeof(double) + sizeof(std::int32_t)) + ink_.size() * sizeof(std::uint32_t);
}

KeyFrames::KeyFrames(State beginning, std::int64_t spacing, std::size_t budget)
    : beginning_(std::move(beginning)), spacing_(spacing), budget_(budget), last_picture_(beginning_.picture), last_light_(beginning_.light) {}

void KeyFrames::add(const State& state) {
  const std::size_t points = beginning_.vertices.size();
  Frame frame;
  frame.position = state.position;
  frame.machine = state.machine;
  if (!frames_.empty() && same_ways(*frames_.back().points, state.vertices.data())) {
    frame.points = frames_.back().points;
  } else {
    frame.points = std::make_shared<const std::vector<VertexWay>>(state.vertices.begin(), state.vertices.begin() + static_cast<std::ptrdiff_t>(points));
    frame.bytes += points * sizeof(VertexWay);
  }
  frame.made.assign(state.vertices.begin() + static_cast<std::ptrdiff_t>(points), state.vertices.end());
  frame.picture = PictureChange(last_picture_, state.picture);
  frame.light = PictureChange(last_light_, state.light);
  frame.bytes += sizeof(Frame) + frame.made.size() * sizeof(VertexWay) + frame.picture.bytes() + frame.light.bytes();
  bytes_ += frame.bytes;
  last_picture_ = state.picture, last_light_ = state.light;
  frames_.push_back(std::move(frame));
  if (bytes_ > budget_ && frames_.size() > 2) thin_out();
}

std::size_t KeyFrames::count_before(std::int64_t position) const {
  const auto after = std::upper_bound(frames_.begin(), frames_.end(), position, [](std::int64_t wanted, const Frame& frame) { return wanted < frame.position; });
  return static_cast<std::size_t>(after - frames_.begin());
}

std::int64_t KeyFrames::before(std::int64_t position) const {
  const std::size_t count = count_before(position);
  return count == 0 ? 0 : frames_[count - 1].position;
}

void KeyFrames::restore_before(std::int64_t position, State& state) const {
  const std::size_t count = count_before(position);
  state.picture = beginning_.picture;
  state.light = beginning_.light;
  for (std::size_t i = 0; i < count; ++i) {
    frames_[i].picture.apply_to(state.picture);
    frames_[i].light.apply_to(state.light);
  }
  if (count == 0) {
    state.position = 0;
    state.machine = beginning_.machine;
    state.vertices = beginning_.vertices;
    return;
  }
  const Frame& frame = frames_[count - 1];
  state.position = frame.position;
  state.machine = frame.machine;
  state.vertices = *frame.points;
  state.vertices.insert(state.vertices.end(), frame.made.begin(), frame.made.end());
}

/// Two changes become one: that from the frame before the first to the second.
void KeyFrames::thin_out() {
  Picture before = beginning_.picture, now = before, light_before = beginning_.light, light_now = light_before;
  std::vector<Frame> kept;
  bytes_ = 0;
  for (std::size_t i = 0; i < frames_.size(); ++i) {
    Frame& frame = frames_[i];
    frame.picture.apply_to(now);
    frame.light.apply_to(light_now);
    if (i % 2 == 0 && i + 1 < frames_.size()) continue;
    frame.picture = PictureChange(before, now);
    frame.light = PictureChange(light_before, light_now);
    frame.bytes = sizeof(Frame) + frame.made.size() * sizeof(VertexWay) + frame.picture.bytes() + frame.light.bytes();
    if (kept.empty() || kept.back().points != frame.points) frame.bytes += frame.points->size() * sizeof(VertexWay);
    bytes_ += frame.bytes;
    before = now, light_before = light_now;
    kept.push_back(std::move(frame));
  }
  frames_ = std::move(kept);
  spacing_ *= 2;
}

}  // namespace zstep
