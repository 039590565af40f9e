// Whole states along a trace, from which a seek starts. Of a picture, a frame keeps the pixels that differ from the
// frame before; every sixteenth keeps all that was drawn, so that no more than sixteen make a picture.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "traces/replay/beginning.hpp"
#include "traces/replay/picture_change.hpp"
#include "traces/replay/state.hpp"

namespace zstep {

class KeyFrames {
 public:
  /// `end`: the last position at which a frame can stand. `spacing`: events from frame to frame; it is doubled, and
  /// every other frame let go, when all of them take more than `budget` bytes. `beginning` must live as long as this
  /// does.
  KeyFrames(const Beginning& beginning, std::int64_t end, std::int64_t spacing, std::size_t budget);

  /// Where the next frame is due; frames stand in the order of their positions.
  std::int64_t next_due() const { return next_due_; }
  /// A frame at this state.
  void add(const State& state);

  /// The last position up to this one at which a frame stands, or 0.
  std::int64_t before(std::int64_t position) const;
  /// Makes the state what it was there.
  void restore_before(std::int64_t position, State& state);
  std::size_t bytes() const { return bytes_; }  ///< beyond what the state itself holds

 private:
  struct Frame {
    std::int64_t position = 0;
    MethodState machine;
    SharedChunks<VertexStages> vertices;
    PictureChange picture, light;
    std::size_t bytes() const {
      return sizeof(Frame) + picture.bytes() + light.bytes();
    }  ///< of what it does not share
    std::size_t bytes_beyond(
        const Frame& later) const;  ///< of machine and vertices, without what a later frame holds, too
  };
  static constexpr std::size_t group = 16;
  /// The changes of the n-th frame from what it is told from: the pictures of the frame before, or nothing.
  void set_pictures(Frame& frame, std::size_t n, const State& before, const State& now) const;
  std::size_t count_before(std::int64_t position) const;
  void thin_out();

  const Beginning* beginning_;
  std::int64_t end_, spacing_, next_due_;
  std::size_t budget_, bytes_ = 0;
  std::vector<Frame> frames_;
  State last_;  ///< its pictures are those of the last frame, while more are to come
};

}  // namespace zstep
