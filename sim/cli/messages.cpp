#include "sim/cli/messages.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#if __has_include(<poll.h>)
#include <fcntl.h>
#include <poll.h>
#include <unistd.h>
#define ZSTEP_HAS_DESCRIPTORS
#endif

#include "traces/error.hpp"
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
  std::fputs((printable(as_typed(std::string(line))) + "\n").c_str(), stderr);
}

void complain_lines(std::string_view lines) {
  while (!lines.empty()) {
    const std::size_t end = std::min(lines.find('\n'), lines.size());
    complain(lines.substr(0, end));
    lines.remove_prefix(std::min(end + 1, lines.size()));
  }
}

void complain_incomplete(std::string_view line) {
  incomplete = true;
  complain(line);
}

bool is_incomplete() { return incomplete; }

void say_written(std::string_view path, std::string_view what) {
  fmt::print("wrote {}: {}\n", printable(path), printable(what));
}

void hold_standard_streams() {
#ifdef ZSTEP_HAS_DESCRIPTORS
  for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO})
    if (fcntl(stream, F_GETFD) < 0) {
      const int refuses = stream == STDIN_FILENO ? O_WRONLY : O_RDONLY;
      if (::open("/dev/null", refuses) != stream) break;
    }
#endif
}

int after_printing(int code) {
  if (std::fflush(stdout) == 0 && std::ferror(stdout) == 0) return code;
  std::string_view mend = "make room on the disk";
#ifdef ZSTEP_HAS_DESCRIPTORS
  const int flags = fcntl(STDOUT_FILENO, F_GETFL);
  if (flags < 0 || (flags & O_ACCMODE) == O_RDONLY) mend = "it is closed: redirect it to a file or to a program";
  pollfd reader{STDOUT_FILENO, POLLOUT, 0};
  if (poll(&reader, 1, 0) > 0 && (reader.revents & POLLERR) != 0) mend = "its reader has ended";
#endif
  complain(fmt::format("standard output: cannot be written; {}", mend));
  return code == exit_code::mistake ? code : exit_code::exhausted;
}

nlohmann::ordered_json json_number(double value) {
  return std::isfinite(value) ? nlohmann::ordered_json(value) : nlohmann::ordered_json(fmt::format("{}", value));
}

}  // namespace zstep::cli
