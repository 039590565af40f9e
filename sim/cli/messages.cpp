#include "sim/cli/messages.hpp"

#include <cstdio>
#include <string>

#include <fmt/format.h>

#include "traces/outcome.hpp"
#include "traces/text.hpp"

namespace zstep::cli {
namespace {

bool incomplete = false;

}  // namespace

void complain(std::string_view line) {
  std::fflush(stdout);
  std::fputs((printable_lines(line) + "\n").c_str(), stderr);
}

void complain_incomplete(std::string_view line) {
  incomplete = true;
  complain(line);
}

bool is_incomplete() { return incomplete; }

void say_written(std::string_view path, std::string_view what) { fmt::print("wrote {}: {}\n", printable(path), printable(what)); }

void stdout_failed() { throw Exhausted("standard output", "cannot be written", "make room on the disk"); }

}  // namespace zstep::cli
