// Whole states along a trace, from which a seek starts. Of a picture, a frame keeps the pixels that differ from the frame before.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "traces/replay/state.hpp"

namespace zstep {

/// The pixels in which one picture differs from another of the same size.
class PictureChange {
 public:
  PictureChange() = default;
  PictureChange(const Picture& before, const Picture& after);
  void apply_to(Picture& picture) const;
  std::size_t bytes() const;

 private:
  std::vector<std::uint64_t> changed_;  ///< a bit a pixel, row by row
  std::vector<double> depth_;           ///< of those pixels, in order
  std::vector<std::int32_t> polygon_;
  std::vector<std::uint32_t> ink_;  ///< empty where the picture has none
};

class KeyFrames {
 public:
  /// `beginning`: the state at position 0. `spacing`: events from frame to frame; it is doubled, and every other frame let go, when all of
  /// them take more than `budget` bytes.
  KeyFrames(State beginning, std::int64_t spacing, std::size_t budget);

  /// Where the next frame is due; frames stand in the order of their positions.
  std::int64_t next_due() const { return frames_.empty() ? spacing_ : frames_.back().position + spacing_; }
  void add(const State& state);

  /// The last position up to this one at which a frame stands, or 0.
  std::int64_t before(std::int64_t position) const;
  /// Makes the state what it was there.
  void restore_before(std::int64_t position, State& state) const;
  std::size_t bytes() const { return bytes_; }

 private:
  struct Frame {
    std::int64_t position = 0;
    Machine machine;
    std::shared_ptr<const std::vector<VertexWay>> points;  ///< shared by frames between which no scene point went on
    std::vector<VertexWay> made;                           ///< the vertices beyond the scene's points
    PictureChange picture, light;
    std::size_t bytes = 0;
  };
  std::size_t count_before(std::int64_t position) const;
  void thin_out();

  State beginning_;
  std::int64_t spacing_;
  std::size_t budget_, bytes_ = 0;
  std::vector<Frame> frames_;
  Picture last_picture_, last_light_;  ///< as they were at the last frame
};

}  // namespace zstep
