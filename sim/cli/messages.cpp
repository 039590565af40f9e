#include "sim/cli/messages.hpp"

#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "traces/outcome.hpp"
#include "traces/text.hpp"

namespace zstep::cli {
namespace {

bool incomplete = false;
std::vector<std::string> after_zstep;  // in a printed command

}  // namespace

void set_commands(std::vector<std::string> names) {
  after_zstep = std::move(names);
  after_zstep.push_back("--help");
}

std::string as_typed(std::string text) {
  const char* const called = std::getenv("ZSTEP_CALLED");
  if (called == nullptr || *called == '\0') return text;
  for (const std::string& word : after_zstep) {
    const std::string printed = "zstep " + word, typed = called + (" " + word);
    for (std::size_t at = text.find(printed); at != std::string::npos; at = text.find(printed, at)) {
      const char next = at + printed.size() < text.size() ? text[at + printed.size()] : '\n';
      const bool command =
          (at == 0 || std::strchr(" \n'\"`(", text[at - 1]) != nullptr) && next != '-' && (next < 'a' || next > 'z');
      if (command) text.replace(at, printed.size(), typed);
      at += command ? typed.size() : printed.size();
    }
  }
  return text;
}

void complain(std::string_view line) {
  std::fflush(stdout);
  std::fputs((printable_lines(as_typed(std::string(line))) + "\n").c_str(), stderr);
}

void complain_incomplete(std::string_view line) {
  incomplete = true;
  complain(line);
}

bool is_incomplete() { return incomplete; }

void say_written(std::string_view path, std::string_view what) {
  fmt::print("wrote {}: {}\n", printable(path), printable(what));
}

void stdout_failed() { throw Exhausted("standard output", "cannot be written", "make room on the disk"); }

}  // namespace zstep::cli
