// The replay viewer. Draws from a trace alone.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>

#include "sim/classroom/lesson.hpp"
#include "traces/file/trace.hpp"

namespace zstep {

struct ViewerOptions {
  std::int64_t at = -1;                              ///< position to open at; -1: where it was left, or the lesson's first stop
  std::optional<std::filesystem::path> screenshot;   ///< write one frame as PNG and leave; needs no display
  std::int32_t width = 1280, height = 720;           ///< of the window or the screenshot
  bool dark = false;
  bool presenter = false;
  const Lesson* lesson = nullptr;                    ///< narration beside the trace, already resolved
};

/// Opens the window and runs until it is closed; with `screenshot` draws one frame headless. Returns the exit code.
int run_viewer(const Trace& trace, const ViewerOptions& options);

/// Whether a window can be opened here.
bool display_available();

}  // namespace zstep
