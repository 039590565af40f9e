// A film of what the window shows, while it is made: which steps, how far it is, and where the reader was.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "traces/image/png.hpp"
#include "sim/viewer/board.hpp"
#include "traces/events/fields.hpp"

namespace zstep::viewer {

/// Steps that make a film, and what they are.
struct FilmRange {
  std::string what;
  std::int64_t first = 0, last = 0;
};

/// Writes frames into a film. Without finish() there is no file afterwards.
class FilmMaker {
 public:
  virtual ~FilmMaker() = default;
  /// Whether it has done most of what it was given.
  virtual bool takes_more() { return true; }
  /// Throws InputError where no film can be made of it, as does finish(), which puts the file where it belongs.
  virtual void frame(const Image& image) = 0;
  virtual void finish() = 0;
};

struct Film {
  std::filesystem::path path;
  std::vector<std::int64_t> steps;
  std::unique_ptr<FilmMaker> maker;
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
