
#include "algorithms/scene/files/tokens.hpp"

#include <array>
#include <cmath>
#include <cstdlib>
#include <fmt/format.h>
#include <limits>
#include <string>
#include <utility>

#include "traces/error.hpp"
#include "traces/text.hpp"

namespace zstep::scene {

bool same_word(std::string_view token, std::string_view word) {
  if (token.size() != word.size()) return false;
  for (std::size_t i = 0; i < token.size(); ++i)
    if (lower_case(token[i]) != word[i]) return false;
  return true;
}

namespace {

std::optional<double> parse_word(std::string_view word, bool negative) {
  if (same_word(word, "inf") || same_word(word, "infinity"))
    return negative ? -std::numeric_limits<double>::infinity() : std::numeric_limits<double>::infinity();
  if (same_word(word, "nan") || same_word(word, "nan(ind)") || same_word(word, "nan(snan)"))
    return std::numeric_limits<double>::quiet_NaN();
  return std::nullopt;
}

/// Whether the # at this place belongs to what Microsoft's library wrote for no finite
/// number: 1.#IND, 1.#QNAN, 1.#INF00 and, rounded, 1.#J.
bool is_hash_of_number(std::string_view text, std::size_t at) {
  constexpr std::string_view first_letters = "IQSJ";
  return at >= 2 && text[at - 1] == '.' && text[at - 2] == '1' && at + 1 < text.size() &&
         first_letters.find(text[at + 1]) != std::string_view::npos;
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
    if (token[at] == '#' && is_hash_of_number(token, at)) return std::numeric_limits<double>::quiet_NaN();
    if (lower_case(token[at]) != 'e') return std::nullopt;
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
    const double power = powers_of_ten[exponent < 0 ? -exponent : exponent];
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

namespace {

bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\v' || c == '\f'; }
bool ends_line(char c) { return c == '\n' || c == '\r'; }

}  // namespace

Tokens::Tokens(std::string_view text, std::string name, Comments comments, Joining joining, std::int32_t first_line)
    : text_(text),
      name_(std::move(name)),
      comments_(comments),
      joining_(joining),
      line_(first_line),
      token_line_(first_line) {
  if (text_.substr(0, 3) == "\xEF\xBB\xBF") at_ = 3;  // the byte order mark that some editors write
}

bool Tokens::at_line_end() const { return at_ == text_.size() || ends_line(text_[at_]); }

bool Tokens::at_comment() const {
  return text_[at_] == '#' && comments_ == Comments::hash && !is_hash_of_number(text_, at_);
}

void Tokens::skip_blanks() {
  while (at_ < text_.size()) {
    const char c = text_[at_];
    if (is_blank(c)) {
      ++at_;
    } else if (at_comment()) {
      while (!at_line_end()) ++at_;
    } else if (c == '\\' && joining_ == Joining::backslash && at_ + 1 < text_.size() && ends_line(text_[at_ + 1])) {
      ++at_;
      at_ += text_[at_] == '\r' && at_ + 1 < text_.size() && text_[at_ + 1] == '\n' ? 2 : 1;
      ++line_;
    } else {
      return;
    }
  }
}

std::string_view Tokens::next_in_line() {
  skip_blanks();
  token_line_ = line_;
  const std::size_t begin = at_;
  while (!at_line_end() && !is_blank(text_[at_]) && !at_comment() &&
         !(text_[at_] == '\\' && joining_ == Joining::backslash && at_ + 1 < text_.size() && ends_line(text_[at_ + 1])))
    ++at_;
  return text_.substr(begin, at_ - begin);
}

std::string_view Tokens::next() {
  for (;;) {
    const std::string_view token = next_in_line();
    if (!token.empty() || !next_line()) return token;
  }
}

std::string_view Tokens::rest_of_line() {
  skip_blanks();
  token_line_ = line_;
  const std::size_t begin = at_;
  std::size_t end = at_;
  while (!at_line_end() && !at_comment()) {
    if (!is_blank(text_[at_])) end = at_ + 1;
    ++at_;
  }
  return text_.substr(begin, end - begin);
}

bool Tokens::next_line() {
  while (!at_line_end()) ++at_;
  if (at_ == text_.size()) return false;
  at_ += text_[at_] == '\r' && at_ + 1 < text_.size() && text_[at_ + 1] == '\n' ? 2 : 1;
  ++line_;
  return true;
}

std::string Tokens::where() const { return fmt::format("{}:{}", name_, token_line_); }

void Tokens::fail(std::string_view what, std::string_view mend) const { throw InputError(where(), what, mend); }

double Tokens::number(std::string_view token, std::string_view what) const {
  if (token.empty()) fail(fmt::format("{} is missing", what), "write it as a decimal number");
  const auto value = parse_number(token);
  if (!value)
    fail(fmt::format("{} is {}, which is not a number", what, in_quotes(token)),
         token.find(',') == std::string_view::npos ? "write a decimal number"
                                                   : "write decimals with a point, and blanks between numbers");
  return *value;
}

double Tokens::coordinate(std::string_view token, std::string_view what) const {
  const double value = number(token, what);
  if (!(std::abs(value) <= largest_coordinate)) checked_coordinate(value, where(), what);
  return value;
}

double Tokens::coordinate_or_nan(std::string_view token, std::string_view what) const {
  const double value = number(token, what);
  if (!std::isfinite(value)) return std::numeric_limits<double>::quiet_NaN();
  if (std::abs(value) > largest_coordinate) checked_coordinate(value, where(), what);
  return value;
}

std::int64_t Tokens::count(std::string_view token, std::string_view what, std::int64_t most) const {
  if (token.empty()) fail(fmt::format("{} is missing", what), "the file seems to be cut short");
  const auto value = parse_integer(token);
  if (!value || *value < 0)
    fail(fmt::format("{} is {}, which is not a whole number", what, in_quotes(token)), "write a whole number from 0");
  if (*value > most)
    fail(fmt::format("{} is {}, but what follows can hold at most {}", what, *value, most),
         "correct the count, or get the file again if it was cut short");
  return *value;
}

double checked_coordinate(double value, std::string_view where, std::string_view what) {
  if (!std::isfinite(value))
    throw InputError(where, fmt::format("{} is not a finite number", what), "repair the mesh where it was made");
  if (std::abs(value) > largest_coordinate)
    throw InputError(where, fmt::format("{} is {}, beyond {}", what, value, largest_coordinate), "scale the mesh down");
  return value;
}

}  // namespace zstep::scene
