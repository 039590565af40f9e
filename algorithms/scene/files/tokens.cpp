#include "algorithms/scene/files/tokens.hpp"

#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "algorithms/scene/files/number.hpp"
#include "traces/error.hpp"

namespace zstep::scene {

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

void Tokens::skip_blanks() {
  while (at_ < text_.size()) {
    const char c = text_[at_];
    if (is_blank(c)) {
      ++at_;
    } else if (c == '#' && comments_ == Comments::hash) {
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
  while (!at_line_end() && !is_blank(text_[at_]) && !(text_[at_] == '#' && comments_ == Comments::hash) &&
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
  while (!at_line_end() && !(text_[at_] == '#' && comments_ == Comments::hash)) {
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

double Tokens::coordinate(std::string_view token, std::string_view what) const {
  if (token.empty()) fail(fmt::format("{} is missing", what), "write it as a decimal number");
  const auto value = parse_number(token);
  if (!value) fail(fmt::format("{} is {}, which is not a number", what, in_quotes(token)), "write a decimal number");
  if (!(std::abs(*value) <= largest_coordinate)) checked_coordinate(*value, where(), what);
  return *value;
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
