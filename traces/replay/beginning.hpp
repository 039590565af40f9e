// What a state is before anything has happened.
#pragma once

#include "traces/file/trace.hpp"
#include "traces/replay/state.hpp"

namespace zstep {

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
  bool compares_write_ = false, edges_told_ = false, enters_told_ = false, polygons_told_ = false, rays_told_ = false,
       tables_not_told_ = false;
};

}  // namespace zstep
