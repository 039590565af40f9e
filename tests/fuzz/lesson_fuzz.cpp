// libFuzzer target: lessons, read, run where their scene is small, and their text laid out.
#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>

#include "algorithms/scene/load.hpp"
#include "sim/classroom/lesson.hpp"
#include "sim/classroom/markdown.hpp"
#include "tests/folder.hpp"
#include "tests/fuzz/questions.hpp"
#include "tests/fuzz/text_mutator.hpp"
#include "tests/where.hpp"

using namespace zstep;

namespace {

namespace fs = std::filesystem;

/// A lesson's file in a folder of its own, with the scenes of the checkout beside it.
fs::path lesson_file() {
  static const test::Folder folder;
  if (!fs::exists(folder / "scenes"))
    fs::create_directory_symlink(test::in_checkout("lessons/scenes"), folder / "scenes");
  return folder / "1-fuzz.md";
}

/// Whether a run takes no more than a moment.
bool is_small(const Lesson& lesson) {
  const std::string& scene = lesson.scene;
  if (names_formula(scene)) return true;
  if (scene.find('/') != std::string::npos)
    return scene.starts_with("scenes/") && scene.find("..") == std::string::npos;
  return !scene.starts_with("teapot") && !scene.starts_with("torus");
}

}  // namespace

extern "C" std::size_t LLVMFuzzerCustomMutator(std::uint8_t* data, std::size_t size, std::size_t most, unsigned seed) {
  static const fuzz::TextMutator mutate({"docs/writing-a-lesson.md", "docs/trace-format.md"});
  return mutate(data, size, most, seed);
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const fs::path file = lesson_file();
  std::ofstream(file, std::ios::binary).write(reinterpret_cast<const char*>(data), static_cast<std::streamsize>(size));
  fuzz::answered([&] {
    Lesson lesson = load_lesson(file);
    for (const Stop& stop : lesson.stops) {
      plain_text(parse_markdown(stop.text));
      if (stop.question) plain_text(parse_markdown(stop.question->text));
    }
    if (!is_small(lesson)) return;
    lesson.view.width = std::min(lesson.view.width.value_or(32), 32);
    lesson.view.height = std::min(lesson.view.height.value_or(24), 24);
    const Trace trace = run_lesson(lesson);
    for (const Stop& stop : lesson.stops) fuzz::check(stop.position >= 0 && stop.position <= trace.size());
  });
  return 0;
}
