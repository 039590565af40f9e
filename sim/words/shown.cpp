#include "sim/words/shown.hpp"

#include <cmath>
#include <string_view>
#include <tuple>
#include <utility>

#include "sim/words/numbers.hpp"
#include "sim/words/owners.hpp"

namespace zstep::words {
namespace {

constexpr std::string_view minus = "\u2212";

/// To the right of a sign: a negative number stands in parentheses.
std::string to_the_right(const std::string& text) {
  if (!text.starts_with(minus)) return text;
  const auto numbers = numbers_in(text);
  const std::size_t end = numbers.empty() || numbers.front().first != 0 ? text.size() : numbers.front().second;
  return "(" + text.substr(0, end) + ")" + text.substr(end);
}

std::string in_parentheses(const std::string& text) { return "(" + text + ")"; }

}  // namespace

Shown::Shown(std::string symbol, double value) : Shown(std::move(symbol), value, number(value)) {}
Shown::Shown(std::string symbol, double value, std::string text)
    : rounded_(value), symbols_(std::move(symbol)), numbers_(std::move(text)) {}
Shown::Shown(double plain) : Shown(number(plain), plain) {}

Shown Shown::of(std::int32_t polygon) const {
  Shown all = *this;
  all.owned_ = {{symbols_, polygon}};
  return all;
}

std::string Shown::equation() const {
  return symbols_ == numbers_ || symbols_.empty() ? numbers_ : symbols_ + " = " + numbers_;
}

Shown Shown::joined(const Shown& a, const Shown& b, Binding how, const char* sign, formulas::Rounded result) {
  const bool subtracts = std::string_view(sign) == " \u2212 ", divides = std::string_view(sign) == "/";
  const bool left = a.binding_ < how, right = b.binding_ < how || (b.binding_ == how && (subtracts || divides));
  // (a + b)(c + d), without a sign between.
  const bool side_by_side = left && right && how == Binding::product && !divides;
  const auto join = [&](const std::string& one, const std::string& other, bool bracketed) {
    return (left ? in_parentheses(one) : one) + (side_by_side ? "" : sign) +
           (bracketed ? in_parentheses(other) : to_the_right(other));
  };
  // Divided by what is called 1/z.
  const bool by_quotient = divides && b.leaf_ && b.symbols_.find('/') != std::string::npos;
  Shown all(join(a.symbols_, b.symbols_, right || by_quotient), result.value, join(a.numbers_, b.numbers_, right));
  all.rounded_ = result, all.binding_ = how, all.leaf_ = false;
  all.owned_ = a.owned_;
  for (const Owned& one : b.owned_) add_owned(all.owned_, one);
  return all;
}

Shown operator-(const Shown& a, const Shown& b) {
  const formulas::Rounded result = a.rounded_ - b.rounded_;
  if (!a.leaf_ || !b.leaf_ || a.numbers_ != b.numbers_)
    return Shown::joined(a, b, Shown::Binding::sum, " \u2212 ", result);
  Shown one = a, other = b;
  std::tie(one.numbers_, other.numbers_) = tell_apart(a.value(), b.value());
  return Shown::joined(one, other, Shown::Binding::sum, " \u2212 ", result);
}

Shown operator-(const Shown& a) {
  const auto negated = [&](const std::string& text) {
    return std::string(minus) + (a.binding_ == Shown::Binding::sum ? in_parentheses(text) : to_the_right(text));
  };
  Shown all(negated(a.symbols_), -a.value(), negated(a.numbers_));
  all.rounded_ = -a.rounded_, all.binding_ = Shown::Binding::product, all.leaf_ = false;
  all.owned_ = a.owned_;
  return all;
}

Shown Shown::bracketed(const Shown& a, const char* open, const char* close, formulas::Rounded result) {
  const double whole = std::round(a.value());
  const bool looks_whole = a.leaf_ && a.value() != whole && a.numbers_ == number(whole);
  const std::string inside = looks_whole ? tell_apart(a.value(), whole).first : a.numbers_;
  Shown all(open + a.symbols_ + close, result.value, open + inside + close);
  all.rounded_ = result, all.leaf_ = false;
  all.owned_ = a.owned_;
  return all;
}

}  // namespace zstep::words
