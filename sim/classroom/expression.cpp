#include "sim/classroom/expression.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include <fmt/core.h>

#include "traces/error.hpp"
#include "traces/math/portable_math.hpp"
#include "traces/text.hpp"

namespace zstep::classroom {
namespace {

using Kind = Expression::Kind;

/// Every operator and operand is a node of a tree that is walked by recursion, so there is an end to it.
constexpr int most_nodes = 1000;

bool begins_name(char c) { return is_letter(c) || c == '_'; }

/// What of an expression fits on the line of an error; not cut within a character.
std::string shortened(std::string_view text) {
  constexpr std::size_t most = 200;
  if (text.size() <= most) return std::string(text);
  std::size_t end = most;
  while (end > 0 && continues_character(text[end])) --end;
  return std::string(text.substr(0, end)) + "…";
}

struct Parser {
  std::string_view all, left;
  std::string_view where;
  bool typed = false;    ///< by a person in haste, see parse_typed
  bool formula = false;  ///< by a program, see parse_formula
  int depth = 0, nodes = 0, arguments = 0;

  [[noreturn]] void fail(std::string_view what, std::string_view mend) const {
    throw InputError(where, fmt::format("{} in `{}`", what, shortened(trim(all))), mend);
  }
  std::string here() const {
    const std::string_view rest = trim(left);
    return rest.empty() ? "the end" : fmt::format("`{}`", rest.substr(0, 24));
  }

  void skip_space() {
    while (!left.empty() && (left.front() == ' ' || left.front() == '\t' || left.front() == '\n'))
      left.remove_prefix(1);
  }
  bool take(std::string_view sign) {
    skip_space();
    if (left.substr(0, sign.size()) != sign) return false;
    left.remove_prefix(sign.size());
    return true;
  }
  std::string_view peek_word() {
    skip_space();
    std::size_t size = 0;
    while (size < left.size() && (begins_name(left[size]) || (size > 0 && is_digit(left[size])))) ++size;
    return left.substr(0, size);
  }
  /// `and` is a word in any case where it is typed.
  bool is_word(std::string_view found, std::string_view word) const {
    const auto same = [&](char a, char b) { return a == b || (typed && a >= 'A' && a <= 'Z' && a - 'A' + 'a' == b); };
    return std::equal(found.begin(), found.end(), word.begin(), word.end(), same);
  }
  bool take_word(std::string_view word) {
    if (!is_word(peek_word(), word)) return false;
    left.remove_prefix(word.size());
    return true;
  }
  void close(std::string_view opened) {
    if (!take(")")) fail(fmt::format("`{}` is not closed at {}", opened, here()), "add `)`");
  }

  Expression node() {
    if (++nodes > most_nodes)
      fail(fmt::format("there are more than {} numbers, names and signs", most_nodes), "write it in parts");
    return {};
  }
  Expression of(Kind kind, Expression first, Expression second) {
    Expression made = node();
    made.kind = kind;
    made.parts.push_back(std::move(first));
    made.parts.push_back(std::move(second));
    return made;
  }
  Expression of(Kind kind, Expression first) {
    Expression made = node();
    made.kind = kind;
    made.parts.push_back(std::move(first));
    return made;
  }

  Expression either() {
    if (++depth > 64) fail("brackets nest more than 64 deep", "write it flatter");
    Expression first = both();
    while (take_word("or") || take("||")) first = of(Kind::or_, std::move(first), both());
    --depth;
    return first;
  }
  Expression both() {
    Expression first = negation();
    while (take_word("and") || take("&&")) first = of(Kind::and_, std::move(first), negation());
    return first;
  }
  Expression negation() {
    bool negated = false;
    while (take_word("not") || take("!")) negated = !negated;
    Expression inner = comparison();
    return negated ? of(Kind::not_, std::move(inner)) : inner;
  }

  Expression comparison() {
    static constexpr std::array<std::pair<std::string_view, Kind>, 11> signs{{{"<>", Kind::unequal},
                                                                              {"==", Kind::equal},
                                                                              {"!=", Kind::unequal},
                                                                              {"≠", Kind::unequal},
                                                                              {"<=", Kind::less_equal},
                                                                              {"≤", Kind::less_equal},
                                                                              {">=", Kind::greater_equal},
                                                                              {"≥", Kind::greater_equal},
                                                                              {"<", Kind::less},
                                                                              {">", Kind::greater},
                                                                              {"=", Kind::equal}}};
    Expression first = sum();
    for (const auto& [sign, kind] : signs) {
      if (!typed && (sign == "=" || sign == "<>")) continue;
      if (take(sign)) return of(kind, std::move(first), sum());
    }
    return first;
  }
  Expression sum() {
    Expression first = product();
    while (true) {
      if (take("+")) first = of(Kind::add, std::move(first), product());
      else if (take("-") || take("−")) first = of(Kind::subtract, std::move(first), product());
      else return first;
    }
  }
  Expression product() {
    Expression first = sign();
    while (true) {
      if (take("*") || take("·") || take("×")) first = of(Kind::multiply, std::move(first), sign());
      else if (take("/")) first = of(Kind::divide, std::move(first), sign());
      else return first;
    }
  }
  Expression sign() {
    if (++depth > 64) fail("signs nest more than 64 deep", "write it flatter");
    Expression made;
    if (take("-") || take("−")) made = of(Kind::negate, sign());
    else if (take("√")) made = of(Kind::root, sign());
    else made = primary();
    --depth;
    return made;
  }

  Expression primary() {
    skip_space();
    if (take("(")) {
      Expression inner = either();
      close("(");
      return inner;
    }
    if (take("⌊")) return rounded("floor", "⌊", "⌋");
    if (take("⌈")) return rounded("ceil", "⌈", "⌉");
    if (take("\"")) return quoted();
    Expression made = node();
    if (take("∞")) {
      made.number = std::numeric_limits<double>::infinity();
      return made;
    }
    if (!left.empty() && (is_digit(left.front()) || left.front() == '.')) return number(std::move(made));
    const std::string_view word = peek_word();
    if (word.empty() || is_word(word, "and") || is_word(word, "or") || word == "where") {
      fail(fmt::format("a number or a name is missing at {}", here()), "write `x == 3`, `not nearer`, `z < stored` …");
    }
    left.remove_prefix(word.size());
    if (word == "infinity") {
      made.number = std::numeric_limits<double>::infinity();
      return made;
    }
    made.kind = Kind::name;
    made.text = word;
    if (typed && word == "z" && star_is_of_name()) {
      left.remove_prefix(1);
      made.text += "*";
      const std::string_view index = peek_word();
      if (index.starts_with('_')) made.text += index, left.remove_prefix(index.size());
      return made;
    }
    if (!take("(")) return made;
    if (word == "count") return count(std::move(made));
    made.kind = Kind::call;
    ++arguments;
    do made.parts.push_back(either());
    while (take(","));
    --arguments;
    close(fmt::format("{}(", word));
    return made;
  }

  Expression rounded(std::string_view function, std::string_view opened, std::string_view closed) {
    Expression made = of(Kind::call, either());
    made.text = function;
    if (!take(closed)) fail(fmt::format("`{}` is not closed at {}", opened, here()), fmt::format("add `{}`", closed));
    return made;
  }

  /// Whether the * in `z* < 0.5`, `z*_L` belongs to the name: nothing comes after it that could be multiplied.
  bool star_is_of_name() const {
    if (!left.starts_with('*')) return false;
    const std::string_view after = trim(left.substr(1));
    const std::string_view word = leading_step_name(after);
    const char first = after.empty() ? ')' : after.front();
    return std::string_view("<>=!)&|_").find(first) != std::string_view::npos || after.starts_with("≠") ||
           after.starts_with("≤") || after.starts_with("≥") || is_word(word, "and") || is_word(word, "or");
  }

  Expression number(Expression made) {
    if (formula) {
      const std::size_t length = read_number(left, made.number);
      if (length == 0) fail(fmt::format("a number that cannot be read at {}", here()), "write its digits");
      left.remove_prefix(length);
      return made;
    }
    double digits = 0;
    int places = 0;
    bool any = false, point = false;
    // 0,42 where a person types it; between arguments a comma parts them.
    const auto is_point = [&](char c) {
      return !point &&
             (c == '.' || (typed && c == ',' && arguments == 0 && any && left.size() > 1 && is_digit(left[1])));
    };
    while (!left.empty() && (is_digit(left.front()) || is_point(left.front()))) {
      if (is_point(left.front())) {
        point = true;
      } else {
        any = true;
        digits = digits * 10 + (left.front() - '0');
        if (point) ++places;
      }
      left.remove_prefix(1);
    }
    if (!any || places > 22 || digits > 9007199254740992.0) {
      fail("a number that cannot be read exactly", "write at most 15 digits");
    }
    made.number = digits / portable::pow(10.0, places);
    return made;
  }

  Expression quoted() {
    const std::size_t end = left.find('"');
    if (end == std::string_view::npos) fail("a quote is not closed", "add `\"`");
    Expression made = node();
    made.kind = Kind::quoted;
    made.text = left.substr(0, end);
    left.remove_prefix(end + 1);
    return made;
  }

  Expression count(Expression made) {
    skip_space();
    const std::string_view step = leading_step_name(left);
    if (step.empty()) fail(fmt::format("`count(` needs a step's name at {}", here()), "write `count(compare)`");
    left.remove_prefix(step.size());
    made.kind = Kind::count;
    made.text = step;
    if (take_word("where")) made.parts.push_back(either());
    close("count(");
    return made;
  }
};

Expression parsed(Parser parser, std::string_view& rest) {
  Expression made = parser.either();
  parser.skip_space();
  rest = parser.left;
  return made;
}

}  // namespace

std::string_view trim(std::string_view text) {
  constexpr std::string_view space = " \t\r\n";
  const std::size_t first = text.find_first_not_of(space);
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(space) - first + 1);
}

std::string_view leading_step_name(std::string_view text) {
  std::size_t size = 0;
  while (size < text.size() && (begins_name(text[size]) || (size > 0 && (is_digit(text[size]) || text[size] == '.'))))
    ++size;
  return text.substr(0, size);
}

Expression parse_expression(std::string_view text, std::string_view& rest, std::string_view where) {
  return parsed(Parser{text, text, where}, rest);
}

namespace {

Expression parsed_whole(Parser parser) {
  std::string_view rest;
  const std::string_view text = parser.all, where = parser.where;
  Expression made = parsed(std::move(parser), rest);
  if (rest.empty()) return made;
  throw InputError(where, fmt::format("`{}` is left over in `{}`", rest.substr(0, 24), trim(text)),
                   "join comparisons with `and` or `or`; write == to compare");
}

}  // namespace

Expression parse_expression(std::string_view text, std::string_view where) {
  return parsed_whole(Parser{text, text, where});
}

std::vector<Expression> parse_list(std::string_view text, std::string_view where) {
  std::vector<Expression> all;
  for (std::string_view rest = text;; text = rest.substr(1)) {
    all.push_back(parse_expression(text, rest, where));
    if (rest.empty()) return all;
    if (rest.front() != ',')
      throw InputError(where, fmt::format("`{}` is left over", rest), "write a comma between two values");
  }
}

Expression parse_typed(std::string_view text, std::string_view where) {
  return parsed_whole(Parser{text, text, where, true});
}

Expression parse_formula(std::string_view text, std::string_view where) {
  return parsed_whole(Parser{text, text, where, false, true});
}

}  // namespace zstep::classroom
