#include "sim/viewer/model/typed_place.hpp"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <optional>
#include <string_view>

#include "sim/classroom/expression.hpp"

namespace zstep::viewer {
namespace {

bool is_digit(char c) { return c >= '0' && c <= '9'; }
bool is_letter(char c) { return std::isalpha(static_cast<unsigned char>(c)) != 0; }

/// In small letters, with common spaces in place of those that do not break.
std::string plain(std::string text) {
  for (const std::string_view space : {"\u00a0", "\u202f", "\u2009"})
    for (std::size_t at = text.find(space); at != std::string::npos; at = text.find(space, at)) text.replace(at, space.size(), " ");
  std::transform(text.begin(), text.end(), text.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return text;
}

/// Digits, which spaces, ' and _ may set apart. A number with more than 18 of them is cut to these: no trace is as long.
std::optional<std::int64_t> whole(std::string_view text) {
  text = classroom::trim(text);
  if (text.empty() || !is_digit(text.front()) || !is_digit(text.back())) return std::nullopt;
  std::int64_t value = 0;
  int digits = 0;
  for (const char c : text) {
    if (is_digit(c) && digits < 18) value = value * 10 + (c - '0'), digits += value > 0;
    else if (!is_digit(c) && c != ' ' && c != '\'' && c != '_') return std::nullopt;
  }
  return value;
}

/// "37.5 %" as 37.5, from 0 to 100.
std::optional<double> percentage(std::string_view text) {
  if (!text.ends_with('%')) return std::nullopt;
  text = classroom::trim(text.substr(0, text.size() - 1));
  if (text.empty() || !is_digit(text.front())) return std::nullopt;
  double value = 0;
  const auto [end, fault] = std::from_chars(text.data(), text.data() + text.size(), value, std::chars_format::fixed);
  if (fault != std::errc() || end != text.data() + text.size() || value > 100) return std::nullopt;
  return value;
}

/// "9, 17" or "(9, 17)".
std::optional<TypedPlace> pixel(std::string_view text) {
  if (text.starts_with('(') && text.ends_with(')')) text = classroom::trim(text.substr(1, text.size() - 2));
  const std::size_t comma = text.find(',');
  if (comma == std::string_view::npos) return std::nullopt;
  const auto column = whole(text.substr(0, comma)), row = whole(text.substr(comma + 1));
  if (!column || !row) return std::nullopt;
  return TypedPlace{TypedPlace::Kind::pixel, *column, *row, 0};
}

}  // namespace

TypedPlace read_place(const std::string& text) {
  using Kind = TypedPlace::Kind;
  const std::string copy = plain(text);
  const std::string_view all = classroom::trim(copy);
  const auto after_word = static_cast<std::size_t>(std::find_if_not(all.begin(), all.end(), [](char c) { return is_letter(c) || c == ' '; }) - all.begin());
  const std::string_view word = classroom::trim(all.substr(0, after_word)), rest = all.substr(after_word);
  if (word.empty())
    if (const auto percent = percentage(rest)) return {Kind::percent, 0, 0, *percent};
  if (word.empty() || word == "pixel")
    if (const auto place = pixel(rest)) return *place;
  const auto number = whole(rest);
  if (!number) return {};
  if (word.empty() || word == "step") return {Kind::step, *number, 0, 0};
  if (word == "p" || word == "polygon") return {Kind::polygon, *number, 0, 0};
  if (word == "y" || word == "line" || word == "scan line") return {Kind::scan_line, *number, 0, 0};
  return {};
}

const char* const what_to_type = "Type a step (12041), a percentage (25 %), a polygon (p 3), a scan line (line 17), a pixel (9, 17) or a bookmark's name.";

}  // namespace zstep::viewer
