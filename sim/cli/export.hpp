// What zstep export is asked for; tables in export.cpp, pictures in export_pictures.cpp.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>

#include "traces/file/trace.hpp"

namespace zstep::cli {

struct ExportOptions {
  std::string trace, out;
  std::string at;      ///< a step or a bookmark; empty: the end
  std::string buffer;  ///< empty: depth
  std::optional<std::int64_t> sheet, from, to, frames, columns;
  std::optional<double> fps;
  std::string steps;  ///< "12,40,the first tie"
  std::string pane;   ///< empty: the window, and on a sheet the frame
  std::optional<std::array<std::int32_t, 2>> size;
  bool dark = false;
};

/// Writes a picture, a contact sheet or a film. Returns the exit code.
int export_pictures(const Trace& trace, const ExportOptions& options);

}  // namespace zstep::cli
