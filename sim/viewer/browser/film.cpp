// Films, where the window is a page: by the browser's own encoder (sim/web/page/film.js).
#include <emscripten.h>

#include "sim/viewer/film.hpp"
#include "sim/viewer/system.hpp"
#include "traces/error.hpp"

// clang-format off
EM_JS(int, film_begin, (const char* name, int width, int height, double rate), {
  return Module.film.begin(UTF8ToString(name), width, height, rate) ? 1 : 0;
})
EM_JS(int, film_takes_more, (), { return Module.film.takesMore() ? 1 : 0; })
EM_JS(int, film_frame, (const unsigned char* rgb), { return Module.film.frame(HEAPU8, rgb) ? 1 : 0; })
EM_JS(void, film_finish, (), { Module.film.finish(); })
EM_JS(void, film_drop, (), { Module.film.drop(); })
// clang-format on

namespace zstep::viewer::system {
namespace {

class ByBrowser : public FilmMaker {
 public:
  ByBrowser(const std::filesystem::path& path, int width, int height, double frames_a_second) : path_(path) {
    if (film_begin(path.c_str(), width, height, frames_a_second) == 0) failed();
  }
  ~ByBrowser() override { film_drop(); }
  bool takes_more() override { return film_takes_more() != 0; }
  void frame(const Image& image) override {
    if (film_frame(image.rgb.data()) == 0) failed();
  }
  void finish() override { film_finish(); }

 private:
  [[noreturn]] void failed() const {
    throw InputError(path_.string(), "this browser makes no films", "take another, or zstep on a desktop");
  }
  std::filesystem::path path_;
};

}  // namespace

std::unique_ptr<FilmMaker> make_film(const std::filesystem::path& path, int width, int height, double frames_a_second) {
  return std::make_unique<ByBrowser>(path, width, height, frames_a_second);
}

std::filesystem::path film_path(const std::string& name) { return name + ".webm"; }

}  // namespace zstep::viewer::system
