// Films, by a pipe to ffmpeg.
#pragma once

#include <cstdio>
#include <filesystem>
#include <string>

#include "sim/image/png.hpp"

namespace zstep::cli {

/// Is this a film's extension: .gif, .mp4, .webm, .mkv?
bool is_video(const std::filesystem::path& path);

class Video {
 public:
  /// Frames of this size, so many a second. Throws InputError where there is no ffmpeg, or the folder cannot be written
  /// to.
  Video(const std::filesystem::path& path, int width, int height, double frames_a_second);
  /// What was not finished leaves nothing.
  ~Video();
  Video(const Video&) = delete;
  Video& operator=(const Video&) = delete;

  /// Throws InputError where ffmpeg has ended.
  void frame(const Image& image);
  /// Puts the film in its place. Throws InputError where ffmpeg could not make it.
  void finish();

 private:
  [[noreturn]] void failed() const;
  std::filesystem::path path_, part_;
  std::FILE* pipe_ = nullptr;
  void (*before_)(int) = nullptr;  ///< what a broken pipe did until now
};

}  // namespace zstep::cli
