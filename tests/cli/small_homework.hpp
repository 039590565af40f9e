// A small homework whose programs are `sh program.sh`.
#pragma once

#include <doctest/doctest.h>

#include <filesystem>
#include <string>

#include "tests/cli/program.hpp"

namespace zstep::test {

inline void replace_in(const std::filesystem::path& file, const std::string& from, const std::string& to) {
  std::string text = text_of(file);
  REQUIRE(has(text, from));
  text.replace(text.find(from), from.size(), to);
  write_text(file, text);
}

/// A folder hw with one public and one hidden scene and small limits, without programs.
inline void small_homework(const Folder& folder) {
  REQUIRE(run(folder, "homework new z-buffer hw").code == 0);
  for (const char* scene : {"crossing", "neighbours"}) {
    replace_in(folder / "hw/homework.toml", std::string("[[scene]]\nfile = \"scenes/") + scene + ".toml\"\n", "");
    for (const char* kind : {".toml", ".txt"})
      std::filesystem::remove(folder / (std::string("hw/scenes/") + scene + kind));
  }
  for (const char* place : {"hw/starter", "hw/solution"}) std::filesystem::remove_all(folder / place);
  replace_in(folder / "hw/homework.toml", "\n[options]\n",
             "\n[program]\ncommand = \"sh program.sh\"\nseconds = 1\nmemory = 128\noutput = 1\nfiles = 4\n"
             "processes = 12\n\n[options]\n");
}
inline void write_program(const Folder& folder, const std::string& text) {
  std::filesystem::create_directories(folder / "program");
  write_text(folder / "program/program.sh", text);
  std::filesystem::remove_all(folder / "runs");
}

}  // namespace zstep::test
