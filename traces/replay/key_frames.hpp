// Whole states along a trace: the beginning, and key frames, from which a seek starts. Of a picture, a frame keeps the
// pixels that differ from the frame before; every sixteenth keeps all that was drawn, so that no more than sixteen make
// a picture.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "traces/file/container.hpp"
#include "traces/file/trace.hpp"
#include "traces/replay/state.hpp"
#include "traces/scene.hpp"

namespace zstep {

// The pixels in which one picture differs from another of the same size, in few bytes.

/// Intervales of changed pixels that show one polygon: how many pixels come between, how many there are, the polygon,
/// and of each depth how far it is from where the two before it lead. Along a span that is next to nothing, and a byte
/// does.
class PictureChange {
 public:
  PictureChange() = default;
  /// `before`: nullptr for a picture that nothing was drawn to, whose depths are all `empty_depth`.
  PictureChange(const Picture* before, const Picture& after, double empty_depth = no_depth);
  /// Makes of the one picture the other.
  void apply_to(Picture& picture) const;
  std::size_t bytes() const { return bytes_.size(); }

 private:
  Bytes bytes_;
};

// What a state is before anything has happened.

class Beginning {
 public:
  /// The trace must live as long as this does.
  explicit Beginning(const Trace& trace);

  std::size_t points() const { return scene_->points.size(); }
  State state() const;
  MethodState machine() const;
  /// The same for parts of a state that there is already.
  void begin_pictures(State& state) const;
  void begin_vertices(State& state) const;
  double empty_depth() const { return empty_depth_; }

 private:
  const Scene* scene_;
  double empty_depth_;   ///< what depth buffers hold where nothing was drawn
  bool colors_ = false;  ///< pixels have colours of their own
  bool light_ = false;   ///< there is a pass for the light
  std::int32_t samples_a_pixel_ = 0;
  bool compares_write_ = false, edges_told_ = false, enters_told_ = false, polygons_told_ = false, rays_told_ = false,
       tables_not_told_ = false;
};

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
