// What moves to its place on the window, and is there within 300 ms by the clock. What is drawn then is what is drawn
// where nothing moves.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>

#include <imgui.h>

namespace zstep::viewer {

class Motion {
 public:
  static constexpr double seconds = 0.18;         ///< of panes and rows
  static constexpr double seconds_of_step = 0.3;  ///< of what a step does
  struct Place {
    ImVec2 at{0, 0}, size{0, 0};
  };

  /// Before a frame: the time; whether anything moves; what panes go to another place for when it changes, such as the
  /// one that leads; what puts them there at once when it changes, such as the window's size; the step.
  void begin(double time, bool on, std::uint64_t moves, std::uint64_t jumps, std::int64_t step);
  bool panes_move() const { return panes_since_.has_value(); }
  bool row_moves() const { return row_since_.has_value(); }
  bool moving() const { return panes_move() || row_moves(); }

  /// After begin(), where the reader came here by one step forwards: what it did is shown on its way, unless the step
  /// before still is, as where a key is held.
  void step_forwards();
  void skip() { step_since_.reset(); }
  /// How far what the step did has come, from 0 to 1; 1 where nothing moves.
  double arrived() const;

  /// Where a pane is now that goes there.
  Place of_pane(const std::string& id, Place goal);
  /// Where a row is now that goes from one place to another since this step.
  Place of_row(Place from, Place to) const;

 private:
  Place between(Place from, Place to, double since) const;

  double time_ = 0;
  bool begun_ = false, on_ = false;
  std::uint64_t moves_ = 0, jumps_ = 0;
  std::int64_t step_ = 0;
  std::optional<double> panes_since_, row_since_, step_since_;
  std::map<std::string, Place> from_, now_, last_;  ///< of panes: where they set out, are, and were a frame ago
};

}  // namespace zstep::viewer
