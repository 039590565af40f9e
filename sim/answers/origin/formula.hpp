// A number that remembers the formula it was made by, in the form that a chain has it: what the formulas of
// traces/formulas are evaluated with where a number is followed back. The text has as many parentheses as it takes to
// compute it in the same order, so that it gives the same bits.
#pragma once

#include <cmath>
#include <memory>
#include <string>
#include <vector>

#include "traces/formulas/situation.hpp"

namespace zstep::answers {

class Formula {
 public:
  struct Operand {
    std::string symbol;
    double value = 0;
    formulas::Place place = {};
    std::shared_ptr<const Formula> inner = {};  ///< of a number that has a name and a formula of its own
  };

  explicit Formula(double plain);
  explicit Formula(Operand operand) : value_(operand.value), text_(operand.symbol) {
    operands_.push_back(std::move(operand));
  }

  double value() const { return value_; }
  const std::string& text() const { return text_; }  ///< empty where it would be longer than a person reads
  const std::vector<Operand>& operands() const { return operands_; }  ///< in order; of a text that is too long, some
  bool is_operand() const { return operands_.size() == 1 && text_ == operands_[0].symbol; }

  /// Limited to what the raster holds, where that changes it.
  Formula within(double limit) const;
  /// A condition between two numbers: "z < stored".
  static Formula compared(const Formula& a, const std::string& sign, const Formula& b, bool holds) {
    return joined(a, b, sum, " " + sign + " ", holds);
  }

  friend Formula operator+(const Formula& a, const Formula& b) {
    return a.text_ == "0" ? b : joined(a, b, sum, " + ", a.value_ + b.value_);
  }
  friend Formula operator-(const Formula& a, const Formula& b) { return joined(a, b, sum, " - ", a.value_ - b.value_); }
  friend Formula operator*(const Formula& a, const Formula& b) {
    return joined(a, b, product, "*", a.value_ * b.value_);
  }
  friend Formula operator/(const Formula& a, const Formula& b) {
    return joined(a, b, product, "/", a.value_ / b.value_);
  }
  friend Formula operator-(const Formula& a) {
    return a.wrapped(a.binding_ == sum ? "-(" : "-", a.binding_ == sum ? ")" : "", -a.value_, product);
  }
  friend Formula floor(const Formula& a) { return a.wrapped("\u230a", "\u230b", std::floor(a.value_), single); }
  friend Formula ceil(const Formula& a) { return a.wrapped("\u2308", "\u2309", std::ceil(a.value_), single); }
  friend Formula round(const Formula& a) { return a.wrapped("round(", ")", std::round(a.value_), single); }
  friend Formula sqrt(const Formula& a) { return a.wrapped("sqrt(", ")", std::sqrt(a.value_), single); }
  friend double value_of(const Formula& a) { return a.value_; }

 private:
  enum Binding { sum, product, single };
  static Formula joined(const Formula& a, const Formula& b, Binding how, const std::string& sign, double result);
  Formula wrapped(const std::string& open, const std::string& close, double result, Binding how) const;
  void limit_length();

  double value_ = 0;
  std::string text_;
  std::vector<Operand> operands_;
  Binding binding_ = single;
};

}  // namespace zstep::answers
