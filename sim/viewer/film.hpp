// A film of what the window shows, while it is made: which steps, how far it is, and where the reader was.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "sim/film/video.hpp"
#include "sim/viewer/board.hpp"
#include "traces/replay/units.hpp"

namespace zstep::viewer {

/// Steps that make a film, and what they are.
struct FilmRange {
  std::string what;
  std::int64_t first = 0, last = 0;
};

struct Film {
  std::filesystem::path path;
  std::vector<std::int64_t> steps;
  Video video;
  std::size_t made = 0;
  bool draws = false;  ///< a frame of the film, which does not tell of itself
  /// Where the reader was.
  std::int64_t position = 0;
  Unit unit = Unit::event;
  int stop = -1;
  std::optional<std::int32_t> edge;
  Board board;
};

/// "121 frames, 12 s"
std::string film_length(std::int64_t frames);

}  // namespace zstep::viewer
