#include "sim/words/shell_word.hpp"

#include <algorithm>
#include <cctype>
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

}  // namespace zstep
