// A folder of its own in which a test writes a lesson and what the lesson opens, gone afterwards; and a file's text.
#pragma once

#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>

#include "tests/fuzz/temporary_folder.hpp"

namespace zstep::test {

struct LessonFolder : fuzz::TemporaryFolder {
  std::filesystem::path write(const std::string& name, const std::string& text) const {
    std::ofstream(path() / name) << text;
    return path() / name;
  }
};

inline std::string text_of(const std::filesystem::path& path) {
  std::ostringstream text;
  text << std::ifstream(path).rdbuf();
  return text.str();
}

}  // namespace zstep::test
