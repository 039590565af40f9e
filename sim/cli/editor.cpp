#include "sim/cli/editor.hpp"

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <string>
#include <vector>

#include <algorithm>
#include <fmt/format.h>
#include <utility>

#include "sim/cli/messages.hpp"
#include "traces/text.hpp"

#if defined(_WIN32) || defined(__EMSCRIPTEN__)

namespace zstep::cli {

void open_in_editor(std::string_view) {}  // programs are not started there

}  // namespace zstep::cli

#else

#include <spawn.h>
#include <unistd.h>

namespace zstep::cli {
namespace {

/// A line of a file that is there, and no option of the editor's.
bool is_line_of_file(const std::string& place) {
  const std::size_t colon = place.rfind(':');
  if (colon == std::string::npos || colon + 1 == place.size() || place[0] == '-') return false;
  for (std::size_t at = colon + 1; at < place.size(); ++at)
    if (!is_digit(place[at])) return false;
  std::error_code ignored;
  return std::filesystem::is_regular_file(place.substr(0, colon), ignored);
}

std::vector<std::string> words_of_editor(const std::string& command, const std::string& place) {
  std::vector<std::string> words;
  for (std::size_t at = 0; (at = command.find_first_not_of(' ', at)) != std::string::npos;) {
    const std::size_t end = std::min(command.find(' ', at), command.size());
    std::string word = command.substr(at, end - at);
    if (const std::size_t gap = word.find("{}"); gap != std::string::npos) word.replace(gap, 2, place);
    words.push_back(std::move(word));
    at = end;
  }
  return words;
}

}  // namespace

void open_in_editor(std::string_view place) {
  const char* command = std::getenv("ZSTEP_EDITOR");
  const std::string where(place);
  if (command == nullptr || *command == '\0' || where.empty()) return;
  if (std::strstr(command, "{}") == nullptr)
    return complain("ZSTEP_EDITOR: has no {} for the place; write for example ZSTEP_EDITOR=\"code -g {}\"");
  if (!is_line_of_file(where))
    return complain(fmt::format(
        "{}: there is no such file in this folder, or no such line is named; run zstep in the program's folder",
        where));
  std::vector<std::string> words = words_of_editor(command, where);
  std::vector<char*> arguments;
  for (std::string& word : words) arguments.push_back(word.data());
  arguments.push_back(nullptr);
  pid_t process = 0;
  if (const int failed = posix_spawnp(&process, arguments[0], nullptr, nullptr, arguments.data(), environ); failed != 0)
    complain(fmt::format("ZSTEP_EDITOR: {} cannot be started: {}; name a program that is installed", words[0],
                         std::strerror(failed)));
}

}  // namespace zstep::cli

#endif
