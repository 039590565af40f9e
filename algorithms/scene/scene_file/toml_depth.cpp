#include "algorithms/scene/scene_file/toml_depth.hpp"

#include <fmt/format.h>

#include "traces/error.hpp"

namespace zstep::scene {

std::size_t skip_string(std::string_view text, std::size_t at, int& line) {
  const char quote = text[at];
  const bool escapes = quote == '"';
  const std::string triple(3, quote);
  if (text.substr(at, 3) == triple) {
    for (at += 3; at < text.size() && text.substr(at, 3) != triple; ++at) {
      if (text[at] == '\n') ++line;
      if (escapes && text[at] == '\\' && at + 1 < text.size() && text[at + 1] != '\n') ++at;
    }
    at += 3;
    // Up to two more quotes belong to the string itself ("""a""""").
    for (int extra = 0; extra < 2 && at < text.size() && text[at] == quote; ++extra) ++at;
    return at;
  }
  for (++at; at < text.size() && text[at] != quote && text[at] != '\n'; ++at)
    if (escapes && text[at] == '\\' && at + 1 < text.size() && text[at + 1] != '\n') ++at;
  return at < text.size() && text[at] == quote ? at + 1 : at;
}

void check_toml_depth(std::string_view text, const std::string& name, int first_line) {
  constexpr int most_parts = 32;
  int line = first_line, dots = 0;
  for (std::size_t at = 0; at < text.size();) {
    switch (text[at]) {
      case '"':
      case '\'':
        at = skip_string(text, at, line);
        continue;
      case '#':
        while (at < text.size() && text[at] != '\n') ++at;
        continue;
      case '\n':
        ++line;
        dots = 0;
        break;
      case '=':
      case ',':
      case '{':
      case '}':
      case '[':
      case ']':
        dots = 0;
        break;
      case '.':
        if (++dots >= most_parts)
          throw InputError(fmt::format("{}:{}", name, line), fmt::format("a key has more than {} parts", most_parts),
                           "a key of a scene has one part, as in: rho = 4");
        break;
      default:
        break;
    }
    ++at;
  }
}

}  // namespace zstep::scene
