// Films, by a pipe to ffmpeg.
#pragma once

#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <string>
#include <vector>

#include "traces/image/png.hpp"
#include "traces/file/files.hpp"

namespace zstep {

/// Is this a film's extension: .gif, .mp4, .webm, .mkv?
bool is_video(const std::filesystem::path& path);

/// Which steps a film of these has a frame of: each, or as many as are asked for (0: at most `most_unasked`), evenly
/// apart, the first and the last among them where there are two; none twice.
std::vector<std::int64_t> film_steps(std::int64_t first, std::int64_t last, std::int64_t count = 0);
constexpr std::int64_t most_unasked = 200;
constexpr double usual_frames_a_second = 10;

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
  OutputPlace place_;
  std::filesystem::path part_;
  std::FILE* pipe_ = nullptr;
  void (*before_)(int) = nullptr;  ///< what a broken pipe did until now
};

}  // namespace zstep
