// What a formula of a chain gives, in any type of number: rounded as it was computed, or exact.
#pragma once

#include <algorithm>
#include <cctype>
#include <functional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "sim/answers/origin/chain.hpp"
#include "sim/classroom/computed.hpp"
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

/// In the order of the formula's text.
template <class T>
class Evaluation {
 public:
  using OfOperand = std::function<T(const Operand&)>;

  Evaluation(const ChainValue& value, OfOperand of_operand) : value_(value), of_operand_(std::move(of_operand)) {}
  T run() { return of(classroom::parse_formula(value_.formula, "formula")); }

 private:
  using Expression = classroom::Expression;

  T of(const Expression& part) {
    if (part.kind == Expression::Kind::number) return T(part.number);
    if (part.kind == Expression::Kind::name)
      if (const Operand* operand = detail::operand_of(value_, part.text)) return of_operand_(*operand);
    std::vector<T> given;
    for (const Expression& one : part.parts) given.push_back(of(one));
    if (given.empty()) wrong();
    return part.kind == Expression::Kind::call
               ? called(part.text, given)
               : classroom::computed<Functions<T>>(part.kind, given.front(), given.back());
  }
  T called(const std::string& name, const std::vector<T>& given) {
    using F = Functions<T>;
    if (name == "floor") return F::floor(given[0]);
    if (name == "ceil") return F::ceil(given[0]);
    if (name == "round") return F::round(given[0]);
    if (name == "sqrt") return F::sqrt(given[0]);
    if (name == "abs") return F::less(given[0], T(0.0)) ? T(-given[0]) : given[0];
    if (name == "min") return *std::min_element(given.begin(), given.end(), F::less);
    if (name == "max") return *std::max_element(given.begin(), given.end(), F::less);
    wrong();
  }
  [[noreturn]] void wrong() const { throw std::logic_error(fmt::format("'{}' is no formula", value_.formula)); }

  const ChainValue& value_;
  OfOperand of_operand_;
};

}  // namespace zstep::answers
