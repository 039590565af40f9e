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

#include <cstdint>
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
/// The same as a person types it and as panes write it: = and <> compare, NOT AND OR in any case, 0,42 and z* < 0.5.
Expression parse_typed(std::string_view text, std::string_view where);

/// The same as programs write it, with all digits of a number and 1.5e-10.
Expression parse_formula(std::string_view text, std::string_view where);

/// A step's name ("compare", "z_buffer.compare") at the start of `text`; empty if there is none.
std::string_view leading_step_name(std::string_view text);
std::string_view trim(std::string_view text);

}  // namespace zstep::classroom
