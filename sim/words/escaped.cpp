#include "sim/words/escaped.hpp"

#include <algorithm>
#include <cstdlib>
#include <string_view>

#include <fmt/format.h>

#include "traces/text.hpp"

namespace zstep {

std::string percent_encoded(std::string_view text, std::string_view signs) {
  std::string out;
  for (const char c : text) {
    const bool plain = is_letter(c) || is_digit(c) || signs.find(c) != std::string_view::npos;
    if (plain) out.push_back(c);
    else out += fmt::format("%{:02X}", byte_of(c));
  }
  return out;
}

std::string shell_word(const std::string& text) {
  const std::string_view harmless = "/._-:+@%";
  const bool plain = !text.empty() && std::all_of(text.begin(), text.end(), [&](char c) {
    return is_letter(c) || is_digit(c) || harmless.find(c) != std::string_view::npos;
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

std::string markup(std::string_view text) {
  std::string out;
  for (const char c : text) {
    switch (c) {
      case '<':
        out += "&lt;";
        break;
      case '>':
        out += "&gt;";
        break;
      case '&':
        out += "&amp;";
        break;
      case '"':
        out += "&quot;";
        break;
      default:
        out += c;
    }
  }
  return out;
}

}  // namespace zstep
