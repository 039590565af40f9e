#include "sim/cli/words.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <optional>

#include <fmt/format.h>

#include "traces/error.hpp"
#include "traces/text.hpp"

namespace zstep::cli {
namespace {

std::optional<std::int64_t> whole(const std::string& text) {
  if (text.empty() || text.size() > 18) return std::nullopt;
  std::int64_t value = 0;
  for (const char c : text) {
    if (c < '0' || c > '9') return std::nullopt;
    value = value * 10 + (c - '0');
  }
  return value;
}

}  // namespace

std::string nearest(std::string_view word, std::span<const std::string> known) {
  const std::vector<std::string_view> views(known.begin(), known.end());
  return std::string(near_word(word, views));
}

std::string did_you_mean(std::string_view word, std::span<const std::string> known, std::string_view otherwise) {
  const std::string near = nearest(word, known);
  return near.empty() ? std::string(otherwise) : fmt::format("did you mean {}?", near);
}

double parse_number(std::string_view where, const std::string& text) {
  const char* begin = text.c_str();
  char* end = nullptr;
  const bool starts_well =
      !text.empty() && (text[0] == '-' || text[0] == '+' || text[0] == '.' || (text[0] >= '0' && text[0] <= '9'));
  const double value = starts_well ? std::strtod(begin, &end) : 0;
  if (!starts_well || end != begin + text.size())
    throw InputError(where, fmt::format("'{}' is not a number", text), fmt::format("write for example {} 2.5", where));
  if (!std::isfinite(value))
    throw InputError(where, fmt::format("'{}' is not a finite number", text), "write a smaller one");
  return value;
}

std::optional<std::int64_t> read_whole(std::string text) {
  for (const std::string_view space : {"\u00a0", "\u202f", " "})
    for (std::size_t at = text.find(space, 1); at != std::string::npos; at = text.find(space, at))
      text.erase(at, space.size());
  return whole(text);
}

std::int64_t parse_whole(std::string_view where, const std::string& text, std::int64_t least) {
  const std::optional<std::int64_t> value = read_whole(text);
  if (!value || *value < least)
    throw InputError(where, fmt::format("'{}' is not a whole number of at least {}", text, least),
                     fmt::format("write for example {} {}", where, least));
  return *value;
}

std::array<std::int32_t, 2> parse_size(std::string_view where, const std::string& text) {
  const std::size_t cross = text.find_first_of("xX");
  const std::optional<std::int64_t> width = whole(text.substr(0, cross));
  const std::optional<std::int64_t> height = cross == std::string::npos ? std::nullopt : whole(text.substr(cross + 1));
  const auto fits = [](std::optional<std::int64_t> length) {
    return length && *length >= 1 && *length <= std::numeric_limits<std::int32_t>::max();
  };
  if (!fits(width) || !fits(height))
    throw InputError(where, fmt::format("'{}' is not WIDTHxHEIGHT in pixels", text),
                     fmt::format("write for example {} 640x480", where));
  return {static_cast<std::int32_t>(*width), static_cast<std::int32_t>(*height)};
}

std::size_t parse_choice(std::string_view where, const std::string& text, std::span<const std::string> choices) {
  for (std::size_t k = 0; k < choices.size(); ++k)
    if (choices[k] == text) return k;
  throw InputError(
      where, fmt::format("'{}' is not {}", text, enumerate(choices)),
      did_you_mean(text, choices, fmt::format("write for example {} {}", where, choices.empty() ? "" : choices[0])));
}

std::string enumerate(std::span<const std::string> words, std::string_view last_link) {
  std::string text;
  for (std::size_t k = 0; k < words.size(); ++k) {
    if (k > 0) text += k + 1 == words.size() ? fmt::format(" {} ", last_link) : ", ";
    text += words[k];
  }
  return text;
}

std::string grouped(std::int64_t number) {
  std::string text = fmt::format("{}", number);
  const std::size_t sign = number < 0 ? 1 : 0;
  for (std::size_t at = text.size(); at > sign + 3;) text.insert(at -= 3, 1, ' ');
  return text;
}

std::string counted(std::int64_t number, std::string_view singular, std::string_view plural) {
  return fmt::format("{} {}", grouped(number), number == 1 ? singular : plural);
}

}  // namespace zstep::cli
