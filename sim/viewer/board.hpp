// What a lecturer does over the window: writes on it, points at it, lights a part of it, and looks at the clock.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <imgui.h>

#include "sim/viewer/panes/ui.hpp"

namespace zstep::viewer {

class Board {
 public:
  /// The pen writes where the mouse is dragged; what it wrote goes with the next step, or stays until it is put down.
  void turn_pen(bool stays);
  bool writes() const { return writes_; }
  void turn_spotlight() { lit_ = !lit_; }
  bool lit() const { return lit_; }
  /// A spot where the mouse is, for the far end of a lecture room.
  void turn_laser() { points_ = !points_; }
  bool points() const { return points_; }
  /// Starts a clock, or ends it. `now` in seconds.
  void turn_clock(double now) { begun_ = begun_ < 0 ? now : -1; }
  bool clock_runs() const { return begun_ >= 0; }
  /// "12:34" since it was started.
  std::string clock(double now) const;
  /// Puts everything away.
  bool put_away();

  std::size_t strokes() const { return strokes_.size(); }
  /// Takes the mouse between these corners while the pen writes, and draws over all panes.
  void draw(Ui& ui, ImVec2 at, ImVec2 size);

 private:
  void write(Ui& ui, ImVec2 at, ImVec2 size);
  void darken(const Ui& ui, ImVec2 mouse) const;
  std::vector<std::vector<ImVec2>> strokes_;  ///< in parts of the window, so that they stay where it grows
  bool writes_ = false, stays_ = false, lit_ = false, points_ = false, down_ = false;
  double begun_ = -1;
  std::int64_t step_ = -1;
};

}  // namespace zstep::viewer
