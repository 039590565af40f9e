// The small language of lessons: `nearer and stored < infinity`, `x_left + (x - x_left)/2`, `count(compare where
// not nearer)`.
//
// One grammar serves the conditions of anchors and the numbers in the text:
//
//     either     = both { "or" both }
//     both       = negation { "and" negation }
//     negation   = "not" negation | comparison
//     comparison = sum [ ("==" | "!=" | "<" | "<=" | ">" | ">=") sum ]
//     sum        = product { ("+" | "-") product }
//     product    = sign { ("*" | "/") sign }
//     sign       = "-" sign | "√" sign | primary
//     primary    = number | "word" | name | name "(" either { "," either } ")"
//                | "count" "(" step [ "where" either ] ")" | "(" either ")" | "⌊" either "⌋" | "⌈" either "⌉"
//
// The signs of the lectures (− · × ≤ ≥ ≠ ∞) mean what they look like; && || ! are `and`, `or` and `not`.
#pragma once

#include <cmath>
#include <cstdint>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace zstep::classroom {

struct Expression {
  enum class Kind : std::uint8_t {
    number,  ///< `number`
    quoted,  ///< `text`, a polygon's name
    name,    ///< `text`: a field, something the run knows, or a word of an enumeration
    call,    ///< `text` of `parts`
    count,   ///< how often the step `text` happens, where parts[0] holds if there is one
    negate,
    root,
    not_,
    add,
    subtract,
    multiply,
    divide,
    equal,
    unequal,
    less,
    less_equal,
    greater,
    greater_equal,
    and_,
    or_,
  };
  Kind kind = Kind::number;
  double number = 0;
  std::string text;
  std::vector<Expression> parts;
  bool operator==(const Expression&) const = default;
  bool is_truth() const { return kind >= Kind::equal || kind == Kind::not_; }
};

/// Reads the start of `text` as far as it is an expression; `rest` is what follows. `where` is FILE:LINE.
/// Throws InputError.
Expression parse_expression(std::string_view text, std::string_view& rest, std::string_view where);
/// The same for a text that is an expression and nothing else.
Expression parse_expression(std::string_view text, std::string_view where);
/// Expressions with commas between them.
std::vector<Expression> parse_list(std::string_view text, std::string_view where);
/// The same as a person types it and as panes write it: = and <> compare, NOT AND OR in any case, 0,42 and z* < 0.5.
Expression parse_typed(std::string_view text, std::string_view where);

/// The same as programs write it, with all digits of a number and 1.5e-10.
Expression parse_formula(std::string_view text, std::string_view where);

/// A step's name ("compare", "z_buffer.compare") at the start of `text`; empty if there is none.
std::string_view leading_step_name(std::string_view text);
std::string_view trim(std::string_view text);

// What an operator of the language gives of its operands, in any type of number: for lessons, conditions, and the
// formulas of a chain of numbers. Truths are 1 and 0.

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
