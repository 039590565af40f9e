// Printed formulas and numbers, read back from the line they stand on. Every printed number stands for all that would
// be written so.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <map>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "sim/words/numbers.hpp"
#include "traces/events/slots.hpp"

namespace zstep::test {

struct Interval {
  double low, high;
};
inline constexpr double infinite = std::numeric_limits<double>::infinity();

inline Interval hull(std::initializer_list<double> ends) { return {std::min(ends), std::max(ends)}; }
inline Interval operator+(Interval a, Interval b) { return {a.low + b.low, a.high + b.high}; }
inline Interval operator-(Interval a, Interval b) { return {a.low - b.high, a.high - b.low}; }
inline Interval operator*(Interval a, Interval b) {
  return hull({a.low * b.low, a.low * b.high, a.high * b.low, a.high * b.high});
}
inline Interval operator/(Interval a, Interval b) {
  if (b.low <= 0 && b.high >= 0) return {-infinite, infinite};  // too few digits to say
  return hull({a.low / b.low, a.low / b.high, a.high / b.low, a.high / b.high});
}

/// What a printed number may stand for: at least four decimals are written where a number has them.
inline Interval meant_by(std::string_view text) {
  std::string plain(text);
  for (std::size_t at = plain.find("\u2212"); at != std::string::npos; at = plain.find("\u2212", at))
    plain.replace(at, 3, "-");
  const double value = std::strtod(plain.c_str(), nullptr);
  const std::size_t power = std::min(plain.find('e'), plain.size()), point = std::min(plain.find('.'), power);
  const int written = point == power ? 0 : static_cast<int>(power - point) - 1;
  const int exponent = power < plain.size() ? std::atoi(plain.c_str() + power + 1) : 0;
  const int decimals = power < plain.size() ? written : std::max(written, usual_decimals);
  const double half = 0.500001 * std::pow(10.0, exponent - decimals);
  return {value - half, value + half};
}

/// A printed expression of numbers alone; throws std::invalid_argument for anything else. Each number, and each result
/// on the way, may be off by such a share of itself besides.
class Reading {
 public:
  explicit Reading(std::string_view text, double rounding = 0)
      : text_(text), numbers_(numbers_in(text)), rounding_(rounding) {}
  Interval all() {
    const Interval value = sum();
    if (at_ != text_.size()) fail();
    return value;
  }
  bool computes() const { return computes_; }  ///< it is more than a number

 private:
  [[noreturn]] static void fail() { throw std::invalid_argument("not an expression of numbers"); }
  bool take(std::string_view sign) {
    if (!text_.substr(at_).starts_with(sign)) return false;
    at_ += sign.size();
    return true;
  }
  Interval sum() {
    Interval value = product();
    while (true) {
      if (take(" + ")) value = off(value + product()), computes_ = true;
      else if (take(" \u2212 ")) value = off(value - product()), computes_ = true;
      else return value;
    }
  }
  Interval product() {
    Interval value = single();
    while (true) {
      if (take("\u00b7")) value = off(value * single()), computes_ = true;
      else if (take("/")) value = off(value / single()), computes_ = true;
      else if (text_.substr(at_).starts_with("(")) value = off(value * single()), computes_ = true;
      else return value;
    }
  }
  Interval single() {
    if (take("(")) return closed(sum(), ")");
    if (take("\u2308")) return rounded(closed(sum(), "\u2309"), [](double x) { return std::ceil(x); });
    if (take("\u230a")) return rounded(closed(sum(), "\u230b"), [](double x) { return std::floor(x); });
    const auto here =
        std::find_if(numbers_.begin(), numbers_.end(), [&](const auto& number) { return number.first == at_; });
    if (here != numbers_.end() && text_.substr(at_, here->second).find("\u221e") == std::string_view::npos) {
      at_ += here->second;
      return off(meant_by(text_.substr(here->first, here->second)));
    }
    if (take("\u2212")) return Interval{0, 0} - single();
    fail();
  }
  Interval off(Interval value) const {
    return {value.low - rounding_ * std::abs(value.low), value.high + rounding_ * std::abs(value.high)};
  }
  Interval closed(Interval value, std::string_view sign) {
    if (!take(sign)) fail();
    return value;
  }
  template <class Round>
  Interval rounded(Interval value, Round&& round) {
    computes_ = true;
    return {round(value.low), round(value.high)};
  }

  std::string_view text_;
  std::vector<std::pair<std::size_t, std::size_t>> numbers_;
  double rounding_;
  std::size_t at_ = 0;
  bool computes_ = false;
};

inline std::vector<std::string> parts(const std::string& line, const std::string& sign) {
  std::vector<std::string> all;
  std::size_t from = 0;
  for (std::size_t at = line.find(sign); at != std::string::npos; from = at + sign.size(), at = line.find(sign, from))
    all.push_back(line.substr(from, at - from));
  all.push_back(line.substr(from));
  return all;
}

struct Read {
  Interval value;
  bool computes;
};
inline std::optional<Read> read(const std::string& text, double rounding = 0) {
  try {
    Reading reading(text, rounding);
    const Interval value = reading.all();
    return Read{value, reading.computes()};
  } catch (const std::invalid_argument&) {
    return std::nullopt;
  }
}

/// A number that stands by itself; nothing for other text.
inline std::optional<double> number_of(const std::string& text) {
  if (text == "\u221e") return infinite;
  if (text == "\u2212\u221e") return -infinite;
  const auto all = numbers_in(text);
  if (all.size() != 1 || all[0].first != 0 || all[0].second != text.size()) return std::nullopt;
  return (meant_by(text).low + meant_by(text).high) / 2;
}

/// Does "a < b" hold, of two numbers as they are printed?
inline bool so(double a, const std::string& sign, double b) {
  if (sign == "<") return a < b;
  if (sign == ">") return a > b;
  if (sign == "\u2264") return a <= b;
  if (sign == "\u2265") return a >= b;
  return sign == "=" ? a == b : a != b;
}
inline constexpr const char* signs[] = {"<", ">", "\u2264", "\u2265", "=", "\u2260"};

/// The event's fields by name.
inline std::map<std::string, double> fields_by_name(const Event& event) {
  std::map<std::string, double> fields;
  visit_event(
      [&](const auto& known) {
        for_each_field<std::decay_t<decltype(known)>>(
            [&](const auto& field) { fields[std::string(field.name)] = static_cast<double>(known.*(field.member)); });
      },
      event);
  return fields;
}

}  // namespace zstep::test
