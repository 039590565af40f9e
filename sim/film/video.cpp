#include "sim/film/video.hpp"

#include <algorithm>
#include <cmath>
#include <csignal>
#include <cstdlib>
#include <random>
#include <string_view>

#include <fmt/format.h>

#include "sim/words/escaped.hpp"
#include "traces/error.hpp"
#include "traces/scene.hpp"

namespace zstep {
namespace {

namespace fs = std::filesystem;

bool have_ffmpeg() {
#if defined(_WIN32)
  constexpr char between = ';';
  constexpr const char* program = "ffmpeg.exe";
#else
  constexpr char between = ':';
  constexpr const char* program = "ffmpeg";
#endif
  const char* path = std::getenv("PATH");
  for (std::string_view left = path ? path : ""; !left.empty();) {
    const std::size_t end = std::min(left.find(between), left.size());
    std::error_code ignored;
    if (end > 0 && fs::is_regular_file(fs::path(left.substr(0, end)) / program, ignored)) return true;
    left.remove_prefix(std::min(end + 1, left.size()));
  }
  return false;
}

std::FILE* open_pipe(const std::string& command) {
#if defined(_WIN32)
  return _popen(command.c_str(), "wb");
#else
  return popen(command.c_str(), "w");
#endif
}
int close_pipe(std::FILE* pipe) {
#if defined(_WIN32)
  return _pclose(pipe);
#else
  return pclose(pipe);
#endif
}

}  // namespace

bool is_video(const fs::path& path) {
  const std::string extension = path.extension().string();
  return extension == ".gif" || extension == ".mp4" || extension == ".webm" || extension == ".mkv";
}

std::vector<std::int64_t> film_steps(std::int64_t first, std::int64_t last, std::int64_t count) {
  if (count <= 0) count = std::min(last - first + 1, most_unasked);
  std::vector<std::int64_t> steps;
  if (count == 1) return {last};
  for (std::int64_t i = 0; i < count; ++i) {
    const double share = ratio(i, count - 1);
    const std::int64_t step = first + std::llround(share * static_cast<double>(last - first));
    if (steps.empty() || steps.back() != step) steps.push_back(step);
  }
  return steps;
}

Video::Video(const fs::path& path, int width, int height, double frames_a_second) : place_(path) {
  if (!have_ffmpeg())
    throw InputError(path.string(), "films are made by ffmpeg, which is not installed",
                     "install ffmpeg, or write a contact sheet: zstep export run.ztrace --sheet 12 -o sheet.png");
  // ffmpeg knows a film by its extension, so that it stays the last one.
  std::random_device device;
  part_ = place_.path();
  part_.replace_extension(fmt::format("{:08x}.part{}", device(), path.extension().string()));
  const bool gif = path.extension() == ".gif";
  // A GIF has 256 colours of its own; other films want even sizes.
  const std::string how = gif ? "-filter_complex 'split[a][b];[a]palettegen[p];[b][p]paletteuse'"
                              : "-vf 'pad=ceil(iw/2)*2:ceil(ih/2)*2' -pix_fmt yuv420p";
  const std::string file =
      part_.is_absolute() ? part_.string() : "./" + part_.string();  // no option of ffmpeg's, whatever its name
#if !defined(_WIN32)
  before_ = std::signal(SIGPIPE, SIG_IGN);
#endif
  pipe_ = open_pipe(fmt::format(
      "ffmpeg -loglevel error -y -f rawvideo -pixel_format rgb24 -video_size {}x{} -framerate {} -i - {} {}", width,
      height, frames_a_second, how, shell_word(file)));
  if (!pipe_) failed();
}

Video::~Video() {
  if (pipe_) close_pipe(pipe_);
  std::error_code ignored;
  fs::remove(part_, ignored);
#if !defined(_WIN32)
  if (before_ != nullptr && before_ != SIG_ERR) std::signal(SIGPIPE, before_);
#endif
}

void Video::failed() const {
  throw InputError(place_.path().string(), "ffmpeg could not make it",
                   "what it wrote to the terminal tells why; another extension may do");
}

void Video::frame(const Image& image) {
  if (std::fwrite(image.rgb.data(), 1, image.rgb.size(), pipe_) != image.rgb.size()) failed();
}

void Video::finish() {
  std::FILE* pipe = pipe_;
  pipe_ = nullptr;
  std::error_code error;
  if (close_pipe(pipe) != 0 || !fs::is_regular_file(part_, error)) failed();
  place_.take(part_.filename().string());
}

}  // namespace zstep
