#include "sim/words/shell_word.hpp"

#include <algorithm>
#include <cctype>
#include <cstdlib>
#include <string_view>

namespace zstep {

std::string shell_word(const std::string& text) {
  const std::string_view harmless = "/._-:+@%";
  const bool plain = !text.empty() && std::all_of(text.begin(), text.end(), [&](unsigned char c) {
    return std::isalnum(c) != 0 || harmless.find(static_cast<char>(c)) != std::string_view::npos;
  });
  if (plain) return text;
  std::string out(1, '\'');
  for (const char c : text) {
    if (c == '\'') out.append("'\\'");
    out.push_back(c);
  }
  out.push_back('\'');
  return out;
}

std::string as_command(std::span<const std::string> words) {
  const char* const called = std::getenv("ZSTEP_CALLED");
  std::string line = called != nullptr && *called != '\0' ? called : "zstep";
  for (const std::string& word : words) line += " " + shell_word(word);
  return line;
}

}  // namespace zstep
