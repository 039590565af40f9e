// Films, where zstep is a program of a desktop: by ffmpeg.
#include "sim/film/video.hpp"
#include "sim/viewer/film.hpp"
#include "sim/viewer/system.hpp"

namespace zstep::viewer::system {
namespace {

class ByFfmpeg : public FilmMaker {
 public:
  ByFfmpeg(const std::filesystem::path& path, int width, int height, double frames_a_second)
      : video_(path, width, height, frames_a_second) {}
  void frame(const Image& image) override { video_.frame(image); }
  void finish() override { video_.finish(); }

 private:
  Video video_;
};

}  // namespace

std::unique_ptr<FilmMaker> make_film(const std::filesystem::path& path, int width, int height, double frames_a_second) {
  return std::make_unique<ByFfmpeg>(path, width, height, frames_a_second);
}

std::filesystem::path film_path(const std::string& name) { return std::filesystem::current_path() / (name + ".mp4"); }

}  // namespace zstep::viewer::system
