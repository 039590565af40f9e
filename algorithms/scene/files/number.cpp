#include "algorithms/scene/files/number.hpp"

#include <array>
#include <cstdlib>
#include <limits>
#include <string>

namespace zstep::scene {

namespace {

bool is_digit(char c) { return c >= '0' && c <= '9'; }
char lower(char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; }

bool same_word(std::string_view token, std::string_view word) {
  if (token.size() != word.size()) return false;
  for (std::size_t i = 0; i < token.size(); ++i)
    if (lower(token[i]) != word[i]) return false;
  return true;
}

std::optional<double> parse_word(std::string_view word, bool negative) {
  if (same_word(word, "inf") || same_word(word, "infinity"))
    return negative ? -std::numeric_limits<double>::infinity() : std::numeric_limits<double>::infinity();
  if (same_word(word, "nan")) return std::numeric_limits<double>::quiet_NaN();
  return std::nullopt;
}

constexpr std::array<double, 23> powers_of_ten{1e0,  1e1,  1e2,  1e3,  1e4,  1e5,  1e6,  1e7,  1e8,  1e9,  1e10, 1e11,
                                               1e12, 1e13, 1e14, 1e15, 1e16, 1e17, 1e18, 1e19, 1e20, 1e21, 1e22};

constexpr std::size_t longest_number = 400;  // more digits than any program prints

}  // namespace

std::optional<double> parse_number(std::string_view token) {
  if (token.empty() || token.size() > longest_number) return std::nullopt;
  std::size_t at = 0;
  const bool negative = token[0] == '-';
  if (token[0] == '-' || token[0] == '+') ++at;
  if (at < token.size() && !is_digit(token[at]) && token[at] != '.') return parse_word(token.substr(at), negative);

  std::uint64_t mantissa = 0;
  int significant = 0, exponent = 0;
  std::string digits;  // all of them, for numbers too long for the fast way
  bool any = false, fraction = false;
  for (; at < token.size(); ++at) {
    const char c = token[at];
    if (c == '.' && !fraction) {
      fraction = true;
      continue;
    }
    if (!is_digit(c)) break;
    any = true;
    if (fraction) --exponent;
    if (significant == 0 && c == '0') continue;
    if (++significant <= 19) mantissa = mantissa * 10 + static_cast<std::uint64_t>(c - '0');
    if (significant > 19 && digits.empty()) digits = std::to_string(mantissa);
    if (significant > 19) digits += c;
  }
  if (!any) return std::nullopt;
  if (at < token.size()) {
    if (lower(token[at]) != 'e') return std::nullopt;
    ++at;
    const bool down = at < token.size() && token[at] == '-';
    if (at < token.size() && (token[at] == '-' || token[at] == '+')) ++at;
    if (at == token.size()) return std::nullopt;
    int written = 0;
    for (; at < token.size(); ++at) {
      if (!is_digit(token[at])) return std::nullopt;
      if (written < 100000) written = written * 10 + (token[at] - '0');
    }
    exponent += down ? -written : written;
  }

  double value = 0;
  constexpr std::uint64_t exact =
      1ULL << 53;  // up to here both operands are exact, so one operation rounds once (Clinger 1990)
  if (mantissa == 0) {
    value = 0;
  } else if (significant <= 19 && mantissa <= exact && exponent >= -22 && exponent <= 22) {
    const double power = powers_of_ten[static_cast<std::size_t>(exponent < 0 ? -exponent : exponent)];
    value = exponent < 0 ? static_cast<double>(mantissa) / power : static_cast<double>(mantissa) * power;
  } else {
    if (digits.empty()) digits = std::to_string(mantissa);
    digits += 'e';
    digits += std::to_string(exponent);
    value = std::strtod(digits.c_str(), nullptr);  // no decimal point in it, so the locale has no say
  }
  return negative ? -value : value;
}

std::optional<std::int64_t> parse_integer(std::string_view token) {
  if (token.empty()) return std::nullopt;
  const bool negative = token[0] == '-';
  if (token[0] == '-' || token[0] == '+') token.remove_prefix(1);
  if (token.empty()) return std::nullopt;
  std::int64_t value = 0;
  for (const char c : token) {
    if (!is_digit(c)) return std::nullopt;
    const int digit = c - '0';
    if (value > (std::numeric_limits<std::int64_t>::max() - digit) / 10) return std::nullopt;
    value = value * 10 + digit;
  }
  return negative ? -value : value;
}

std::string in_quotes(std::string_view token) {
  constexpr std::size_t longest = 40;
  std::string text = "'";
  for (const char c : token.substr(0, longest)) text += c >= ' ' && c <= '~' ? c : '?';
  if (token.size() > longest) text += "...";
  return text + "'";
}

}  // namespace zstep::scene
