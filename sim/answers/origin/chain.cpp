#include "sim/answers/origin/chain.hpp"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdlib>
#include <stdexcept>

#include <fmt/format.h>

namespace zstep::answers {

using formulas::Rounded;

namespace {

constexpr const char* minus = "\u2212";

bool begins_name(char c) { return std::isalpha(static_cast<unsigned char>(c)) != 0; }
bool in_name(char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_'; }

std::string name_at(const std::string& formula, std::size_t from) {
  std::size_t end = from;
  while (end < formula.size() && in_name(formula[end])) ++end;
  return formula.substr(from, end - from);
}

const Operand* operand_of(const ChainValue& value, const std::string& symbol) {
  for (const Operand& operand : value.operands)
    if (operand.symbol == symbol) return &operand;
  return nullptr;
}

/// The formula with printed signs; names are replaced by what `shown` makes of them.
template <class Shown>
std::string printed(const ChainValue& value, Shown&& shown) {
  const std::string& formula = value.formula;
  std::string text;
  for (std::size_t at = 0; at < formula.size();) {
    if (begins_name(formula[at])) {
      const std::string name = name_at(formula, at);
      const Operand* operand = operand_of(value, name);
      const bool in_front = text.empty() || text.ends_with('(') || text.ends_with("\u230a") || text.ends_with("\u2308");
      text += operand ? shown(*operand, in_front) : name;
      at += name.size();
      continue;
    }
    const char c = formula[at++];
    const bool or_equal = (c == '<' || c == '>') && at < formula.size() && formula[at] == '=';
    if (or_equal) text += c == '<' ? "\u2264" : "\u2265", ++at;
    else if (c == '-') text += minus;
    else if (c == '*') text += "\u00b7";
    else text += c;
  }
  return text;
}

/// Recursive descent over a formula; the order of evaluation is that of the text.
class Evaluation {
 public:
  explicit Evaluation(const ChainValue& value) : value_(value), text_(value.formula) {}
  Rounded run() {
    const Rounded result = comparison();
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
  Rounded comparison() {
    const Rounded left = sum();
    if (take("<=")) return left.value <= sum().value ? 1 : 0;
    if (take("<")) return left.value < sum().value ? 1 : 0;
    if (take(">=")) return left.value >= sum().value ? 1 : 0;
    if (take(">")) return left.value > sum().value ? 1 : 0;
    return left;
  }
  Rounded sum() {
    Rounded result = product();
    while (true) {
      if (take("+")) result = result + product();
      else if (take("-")) result = result - product();
      else return result;
    }
  }
  Rounded product() {
    Rounded result = factor();
    while (true) {
      if (take("*")) result = result * factor();
      else if (take("/")) result = result / factor();
      else return result;
    }
  }
  Rounded factor() {
    if (take("-")) return -factor();
    if (take("(")) {
      const Rounded inner = sum();
      if (!take(")")) wrong();
      return inner;
    }
    if (take("\u230a")) return closed(floor(sum()), "\u230b");
    if (take("\u2308")) return closed(ceil(sum()), "\u2309");
    skip();
    if (at_ >= text_.size()) wrong();
    if (begins_name(text_[at_])) return named();
    const char* from = text_.c_str() + at_;
    char* end = nullptr;
    const double number = std::strtod(from, &end);
    if (end == from) wrong();
    at_ += static_cast<std::size_t>(end - from);
    return number;
  }
  Rounded closed(const Rounded& inner, const char* sign) {
    if (!take(sign)) wrong();
    return inner;
  }
  Rounded named() {
    const std::string name = name_at(text_, at_);
    at_ += name.size();
    if (const Operand* operand = operand_of(value_, name)) return operand->value;
    if (!take("(")) wrong();
    std::vector<Rounded> arguments{sum()};
    while (take(",")) arguments.push_back(sum());
    if (!take(")")) wrong();
    const auto smaller = [](const Rounded& a, const Rounded& b) { return a.value < b.value; };
    if (name == "sqrt") return sqrt(arguments[0]);
    if (name == "abs") return abs(arguments[0]);
    if (name == "round") return round(arguments[0]);
    if (name == "min") return *std::min_element(arguments.begin(), arguments.end(), smaller);
    if (name == "max") return *std::max_element(arguments.begin(), arguments.end(), smaller);
    wrong();
  }

  const ChainValue& value_;
  const std::string& text_;
  std::size_t at_ = 0;
};

}  // namespace

std::string full_digits(double value) {
  if (std::isnan(value)) return "undefined";
  if (std::isinf(value)) return value < 0 ? "\u2212\u221e" : "\u221e";
  std::string text = fmt::format("{}", value);
  if (text.ends_with(".0")) text.erase(text.size() - 2);
  if (text == "-0") return "0";
  for (std::size_t at = text.find('-'); at != std::string::npos; at = text.find('-', at)) text.replace(at, 1, minus);
  return text;
}

std::string result_text(const ChainValue& value) {
  if (!value.word.empty()) return value.word;
  if (value.condition) return value.value != 0 ? "true" : "false";
  return full_digits(value.value);
}

std::string formula_text(const ChainValue& value) {
  return printed(value, [](const Operand& operand, bool) { return operand.symbol; });
}

std::string numbers_text(const ChainValue& value) {
  return printed(value, [](const Operand& operand, bool in_front) {
    const std::string number = full_digits(operand.value);
    return operand.value < 0 && !in_front ? "(" + number + ")" : number;
  });
}

std::string line_text(const ChainValue& value) {
  std::string text = value.name;
  if (!value.word.empty()) {
    text +=
        ": " + value.word + (value.formula.empty() ? "" : ", as " + formula_text(value) + " = " + numbers_text(value));
  } else if (value.condition) {
    if (!value.formula.empty())
      text += ": " + formula_text(value) + ":  " + numbers_text(value) + "  is " + result_text(value);
    else text += ": " + result_text(value);
  } else {
    // What was taken over as it was needs its number once.
    const bool taken_over = value.operands.size() == 1 && value.operands[0].symbol == value.formula;
    if (!value.formula.empty() && value.formula != value.name) text += " = " + formula_text(value);
    if (!value.formula.empty() && !taken_over) text += " = " + numbers_text(value);
    const double computed = value.formula.empty() || taken_over ? value.value : evaluate(value);
    text += " = " + (holds(value) ? result_text(value) : full_digits(computed));
  }
  if (!value.note.empty()) text += "   " + value.note;
  return text;
}

double evaluate(const ChainValue& value) { return Evaluation(value).run().value; }

bool holds(const ChainValue& value) {
  return value.formula.empty() || formulas::gives(Evaluation(value).run(), value.value, value.rounding);
}

std::string doubt_text(const ChainValue& value) {
  if (holds(value)) return "";
  const double computed = evaluate(value);
  if (value.condition)
    return fmt::format("The trace says {}, but by these numbers it is {}.", result_text(value),
                       computed != 0 ? "true" : "false");
  const bool copied = value.operands.size() == 1 && value.operands[0].symbol == value.formula;
  return fmt::format("The trace records {}, but {} {}.", full_digits(value.value),
                     copied ? "it was taken from" : "this formula gives", full_digits(computed));
}

}  // namespace zstep::answers
