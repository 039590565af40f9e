// What the window shows: a trace in an App, and in its place, on a key, another method's trace of the same scene.
#pragma once

#include <memory>
#include <optional>

#include "sim/viewer/app.hpp"
#include "sim/viewer/viewer.hpp"

namespace zstep::viewer {

class Stage {
 public:
  /// `trace` and what the options point to must live as long.
  Stage(const Trace& trace, const ViewerOptions& options, const Settings& settings, int width, int height, float dpi_scale = 1);

  App& app() { return *app_; }
  const Trace& trace() const { return other_ ? other_->trace : first_; }

  /// Shows the next (or previous) method's run on this scene: at the step that gave the selected pixel its colour, or at its
  /// end. The trace that was opened, with its lesson, has its place among them. What cannot be done is said in the window.
  void switch_method(int direction);

 private:
  const Trace& first_;
  const ViewerOptions& options_;
  float dpi_scale_;
  std::optional<OtherRun> other_;  ///< nullopt while the first is shown
  std::unique_ptr<App> app_;
};

/// The last event of the trace that gave this pixel a colour; its size if none did.
std::int64_t last_write(const Trace& trace, Cell cell);

}  // namespace zstep::viewer
