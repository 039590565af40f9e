// What a formula of a chain gives, in any type of number: rounded as it was computed, or exact.
#pragma once

#include <algorithm>
#include <cctype>
#include <cstdlib>
#include <functional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "sim/answers/origin/chain.hpp"
#include "traces/formulas/rounding.hpp"

namespace zstep::answers {

namespace detail {

inline bool begins_name(char c) { return std::isalpha(static_cast<unsigned char>(c)) != 0; }
inline bool in_name(char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_'; }

inline std::string name_at(const std::string& formula, std::size_t from) {
  std::size_t end = from;
  while (end < formula.size() && in_name(formula[end])) ++end;
  return formula.substr(from, end - from);
}

inline const Operand* operand_of(const ChainValue& value, const std::string& symbol) {
  for (const Operand& operand : value.operands)
    if (operand.symbol == symbol) return &operand;
  return nullptr;
}

}  // namespace detail

/// What + - * / do not say. Others are specialised where the type of number is.
template <class T>
struct Functions;
template <>
struct Functions<formulas::Rounded> {
  using Rounded = formulas::Rounded;
  static bool less(const Rounded& a, const Rounded& b) { return a.value < b.value; }
  static bool equal(const Rounded& a, const Rounded& b) { return a.value == b.value; }
  static Rounded floor(const Rounded& a) { return formulas::floor(a); }
  static Rounded ceil(const Rounded& a) { return formulas::ceil(a); }
  static Rounded round(const Rounded& a) { return formulas::round(a); }
  static Rounded sqrt(const Rounded& a) { return formulas::sqrt(a); }
};

/// Recursive descent over a formula; the order of evaluation is that of the text.
template <class T>
class Evaluation {
 public:
  using OfOperand = std::function<T(const Operand&)>;

  Evaluation(const ChainValue& value, OfOperand of_operand)
      : value_(value), text_(value.formula), of_operand_(std::move(of_operand)) {}
  T run() {
    const T result = comparison();
    skip();
    if (at_ != text_.size()) wrong();
    return result;
  }

 private:
  [[noreturn]] void wrong() const {
    throw std::logic_error(fmt::format("'{}' is no formula at character {}", text_, at_));
  }
  void skip() {
    while (at_ < text_.size() && text_[at_] == ' ') ++at_;
  }
  bool take(const char* sign) {
    skip();
    const std::string wanted = sign;
    if (text_.compare(at_, wanted.size(), wanted) != 0) return false;
    at_ += wanted.size();
    return true;
  }
  T comparison() {
    T left = sum();
    const auto less = Functions<T>::less;
    for (const char* sign : {"<=", "<", ">=", ">"}) {
      if (!take(sign)) continue;
      const T right = sum();
      const bool equal = sign[1] == '=' && Functions<T>::equal(left, right);
      return T(equal || (sign[0] == '<' ? less(left, right) : less(right, left)) ? 1.0 : 0.0);
    }
    return left;
  }
  T sum() {
    T result = product();
    while (true) {
      if (take("+")) result = result + product();
      else if (take("-")) result = result - product();
      else return result;
    }
  }
  T product() {
    T result = factor();
    while (true) {
      if (take("*")) result = result * factor();
      else if (take("/")) result = result / factor();
      else return result;
    }
  }
  T factor() {
    if (take("-")) return -factor();
    if (take("(")) {
      const T inner = sum();
      if (!take(")")) wrong();
      return inner;
    }
    if (take("\u230a")) return closed(Functions<T>::floor(sum()), "\u230b");
    if (take("\u2308")) return closed(Functions<T>::ceil(sum()), "\u2309");
    skip();
    if (at_ >= text_.size()) wrong();
    if (detail::begins_name(text_[at_])) return named();
    const char* from = text_.c_str() + at_;
    char* end = nullptr;
    const double number = std::strtod(from, &end);
    if (end == from) wrong();
    at_ += static_cast<std::size_t>(end - from);
    return T(number);
  }
  T closed(const T& inner, const char* sign) {
    if (!take(sign)) wrong();
    return inner;
  }
  T named() {
    const std::string name = detail::name_at(text_, at_);
    at_ += name.size();
    if (const Operand* operand = detail::operand_of(value_, name)) return of_operand_(*operand);
    if (!take("(")) wrong();
    std::vector<T> arguments{sum()};
    while (take(",")) arguments.push_back(sum());
    if (!take(")")) wrong();
    if (name == "sqrt") return Functions<T>::sqrt(arguments[0]);
    if (name == "abs") return Functions<T>::less(arguments[0], T(0.0)) ? -arguments[0] : arguments[0];
    if (name == "round") return Functions<T>::round(arguments[0]);
    if (name == "min") return *std::min_element(arguments.begin(), arguments.end(), Functions<T>::less);
    if (name == "max") return *std::max_element(arguments.begin(), arguments.end(), Functions<T>::less);
    wrong();
  }

  const ChainValue& value_;
  const std::string& text_;
  OfOperand of_operand_;
  std::size_t at_ = 0;
};

}  // namespace zstep::answers
