// A run in which one number is otherwise, as a program with a mistake prints it.
#pragma once

#include <filesystem>
#include <fstream>
#include <string>

#include <doctest/doctest.h>
#include <unistd.h>

#include "tests/golden/golden.hpp"
#include "traces/file/jsonl.hpp"

namespace zstep::test {

/// `from`: what stands in the run's JSON Lines; the first of these becomes `to`.
inline Trace with_mistake(const Trace& right, const std::string& from, const std::string& to) {
  std::string text = jsonl_of(right);
  const std::size_t at = text.find(from);
  REQUIRE(at != std::string::npos);
  text.replace(at, from.size(), to);
  const auto path = std::filesystem::temp_directory_path() / ("zstep_mistake_" + std::to_string(getpid()) + ".jsonl");
  std::ofstream(path) << text;
  Trace trace = open_jsonl(path);
  std::filesystem::remove(path);
  return trace;
}

}  // namespace zstep::test
