#include "sim/answers/chain.hpp"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdlib>
#include <stdexcept>

#include <fmt/format.h>

namespace zstep::answers {
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
      const bool in_front = text.empty() || text.back() == '(';
      text += operand ? shown(*operand, in_front) : name;
      at += name.size();
      continue;
    }
    const char c = formula[at++];
    if (c == '-') text += minus;
    else if (c == '*') text += "\u00b7";
    else text += c;
  }
  return text;
}

/// Recursive descent over a formula; the order of evaluation is that of the text.
class Evaluation {
 public:
  explicit Evaluation(const ChainValue& value) : value_(value), text_(value.formula) {}
  double run() {
    const double result = comparison();
    skip();
    if (at_ != text_.size()) wrong();
    return result;
  }

 private:
  [[noreturn]] void wrong() const { throw std::logic_error(fmt::format("'{}' is no formula at character {}", text_, at_)); }
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
  double comparison() {
    const double left = sum();
    if (take("<=")) return left <= sum() ? 1 : 0;
    if (take("<")) return left < sum() ? 1 : 0;
    if (take(">=")) return left >= sum() ? 1 : 0;
    if (take(">")) return left > sum() ? 1 : 0;
    return left;
  }
  double sum() {
    double result = product();
    while (true) {
      if (take("+")) result = result + product();
      else if (take("-")) result = result - product();
      else return result;
    }
  }
  double product() {
    double result = factor();
    while (true) {
      if (take("*")) result = result * factor();
      else if (take("/")) result = result / factor();
      else return result;
    }
  }
  double factor() {
    if (take("-")) return -factor();
    if (take("(")) {
      const double inner = sum();
      if (!take(")")) wrong();
      return inner;
    }
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
  double named() {
    const std::string name = name_at(text_, at_);
    at_ += name.size();
    if (const Operand* operand = operand_of(value_, name)) return operand->value;
    if (!take("(")) wrong();
    std::vector<double> arguments{sum()};
    while (take(",")) arguments.push_back(sum());
    if (!take(")")) wrong();
    if (name == "sqrt") return std::sqrt(arguments[0]);
    if (name == "abs") return std::abs(arguments[0]);
    if (name == "round") return std::round(arguments[0]);
    if (name == "floor") return std::floor(arguments[0]);
    if (name == "min") return *std::min_element(arguments.begin(), arguments.end());
    if (name == "max") return *std::max_element(arguments.begin(), arguments.end());
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
    text += ": " + value.word + (value.formula.empty() ? "" : ", as " + formula_text(value) + " = " + numbers_text(value));
  } else if (value.condition) {
    if (!value.formula.empty()) text += ": " + formula_text(value) + ":  " + numbers_text(value) + "  is " + result_text(value);
    else text += ": " + result_text(value);
  } else {
    // What was taken over as it was needs its number once.
    const bool taken_over = value.operands.size() == 1 && value.operands[0].symbol == value.formula;
    if (!value.formula.empty()) text += " = " + formula_text(value);
    if (!value.formula.empty() && !taken_over) text += " = " + numbers_text(value);
    text += " = " + result_text(value);
  }
  if (!value.note.empty()) text += "   " + value.note;
  return text;
}

double evaluate(const ChainValue& value) { return Evaluation(value).run(); }

bool holds(const ChainValue& value) {
  if (value.formula.empty()) return true;
  const double computed = evaluate(value);
  if (computed == value.value || (std::isnan(computed) && std::isnan(value.value))) return true;
  if (value.exact) return false;
  double scale = std::max(1.0, std::abs(value.value));
  for (const Operand& operand : value.operands)
    if (std::isfinite(operand.value)) scale = std::max(scale, std::abs(operand.value));
  return std::abs(computed - value.value) <= 1e-9 * scale;
}

}  // namespace zstep::answers
