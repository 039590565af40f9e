#include "sim/answers/origin/chain.hpp"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdlib>
#include <stdexcept>

#include <fmt/format.h>

#include "sim/answers/origin/evaluate.hpp"
#include "sim/words/explain.hpp"

namespace zstep::answers {

using formulas::Rounded;

namespace {

using detail::begins_name, detail::name_at, detail::operand_of;

Rounded evaluated(const ChainValue& value) {
  return Evaluation<Rounded>(value, [](const Operand& operand) { return Rounded(operand.value); }).run();
}

constexpr const char* minus = "\u2212";

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
    const double computed = computed_value(value);
    text += " = " +
            (holds(value) ? as_held(computed, value.value, result_text(value), value.rounds) : full_digits(computed));
  }
  if (!value.note.empty()) text += "   " + value.note;
  return text;
}

double computed_value(const ChainValue& value) {
  const bool taken_over = value.operands.size() == 1 && value.operands[0].symbol == value.formula;
  return value.formula.empty() || taken_over ? value.value : evaluate(value);
}

double evaluate(const ChainValue& value) { return evaluated(value).value; }

bool holds(const ChainValue& value) {
  return value.formula.empty() || value.tolerance.allows(evaluated(value), value.value);
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
