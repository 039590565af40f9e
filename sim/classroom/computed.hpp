// What an operator of the language gives of its operands, in any type of number: for lessons, conditions, and the
// formulas of a chain of numbers. Truths are 1 and 0.
#pragma once

#include <cmath>
#include <stdexcept>

#include "sim/classroom/expression.hpp"

namespace zstep::classroom {

/// What + - * / do not say of a type of number.
struct Doubles {
  static bool less(double a, double b) { return a < b; }
  static bool equal(double a, double b) { return a == b; }
  static double sqrt(double a) { return std::sqrt(a); }
};

/// `b` is the second operand where there are two. What may settle the matter by one operand alone is its caller's.
template <class Functions, class T>
T computed(Expression::Kind kind, const T& a, const T& b) {
  using Operator = Expression::Kind;
  const auto truth = [](bool holds) { return T(holds ? 1.0 : 0.0); };
  switch (kind) {
    case Operator::negate:
      return T(-a);
    case Operator::root:
      return Functions::sqrt(a);
    case Operator::not_:
      return truth(Functions::equal(a, T(0.0)));
    case Operator::add:
      return T(a + b);
    case Operator::subtract:
      return T(a - b);
    case Operator::multiply:
      return T(a * b);
    case Operator::divide:
      return T(a / b);
    case Operator::less:
      return truth(Functions::less(a, b));
    case Operator::less_equal:
      return truth(Functions::less(a, b) || Functions::equal(a, b));
    case Operator::greater:
      return truth(Functions::less(b, a));
    case Operator::greater_equal:
      return truth(Functions::less(b, a) || Functions::equal(a, b));
    default:
      throw std::logic_error("no operator that computes");
  }
}

}  // namespace zstep::classroom
