#include "sim/answers/origin/chain.hpp"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdlib>
#include <fmt/format.h>
#include <stdexcept>

#include "sim/answers/origin/exact.hpp"
#include "sim/words/explain.hpp"
#include "traces/formulas/of_events.hpp"
#include "traces/formulas/situation.hpp"
#include "traces/text.hpp"

namespace zstep::answers {
namespace {

constexpr std::size_t longest_text = 1200, most_operands = 18;

/// A name that is one in the formula of a chain: of letters, digits and _.
std::string symbol_of(std::string_view name, const formulas::Place& place) {
  if (place.in == formulas::Place::In::depth_buffer || place.in == formulas::Place::In::light_buffer) return "stored";
  if (std::all_of(name.begin(), name.end(), detail::in_name)) return std::string(name);
  return std::string(place.field.substr(0, place.field.find("_edge")));
}

/// Keeps the formula of each field.
template <class E>
struct Collector {
  using Number = Formula;
  const formulas::Situation& at;
  std::vector<Derivation>& found;

  Number number(std::string_view name, double value, const formulas::Place& place) {
    if (name == "0" || name == "1") return Formula(value);
    constexpr bool adds = std::is_same_v<E, EdgeStep> || std::is_same_v<E, DepthInterpolate>;
    const bool before =
        adds && (place.in == formulas::Place::In::active_edge || place.in == formulas::Place::In::fragment);
    return Formula(Formula::Operand{symbol_of(name, place) + (before ? "_b" : ""), value, place});
  }
  Number named(std::string_view name, const Number& formula) {
    return Formula(Formula::Operand{std::string(name), formula.value(), {}, std::make_shared<const Formula>(formula)});
  }
  void reads(const formulas::Place&) {}
  bool trusts(const formulas::Place&) const { return true; }
  bool equal(double one, double other) const { return one == other; }
  void rule(formulas::Rule, bool) {}

  void gives(formulas::Follows<E, double> field, const Number& formula) { found.push_back({field.name, formula}); }
  void within(formulas::Follows<E, double> field, const Number& formula, double) { gives(field, formula); }
  void near(formulas::Follows<E, double>, const formulas::Rounded&) {}
  void whole(formulas::Follows<E, std::int32_t> field, const Number& formula, std::int32_t within) {
    found.push_back({field.name, formula.within(within)});
  }
  template <class Value>
  void is(std::type_identity_t<formulas::Follows<E, Value>>, Value) {}
  void verdict(formulas::Follows<E, bool> field, const Number& z, const Number& stored) {
    const Comparison& comparison = at.header.comparison;
    const std::string sign = fmt::format("{}{}", comparison.nearer == Comparison::Nearer::smaller ? '<' : '>',
                                         comparison.ties == Comparison::Ties::first ? "" : "=");
    const bool wins = comparison.wins(z.value(), stored.value());
    found.push_back({field.name, Formula::compared(z, sign, stored, wins)});
  }
};

}  // namespace

Formula::Formula(double plain) : value_(plain), text_(fmt::format("{}", plain)) {
  if (text_.ends_with(".0")) text_.erase(text_.size() - 2);
  if (plain < 0) binding_ = product;
}

Formula Formula::within(double limit) const {
  if (value_ == limit) return *this;
  Formula all = wrapped(fmt::format("{}({}, ", value_ < limit ? "max" : "min", limit), ")", limit, single);
  return all;
}

Formula Formula::joined(const Formula& a, const Formula& b, Binding how, const std::string& sign, double result) {
  const auto bracketed = [](const std::string& text, bool in_parentheses) {
    return in_parentheses ? "(" + text + ")" : text;
  };
  Formula all(result);
  all.binding_ = how;
  const bool too_long = a.text_.empty() || b.text_.empty();
  all.text_ = too_long ? "" : bracketed(a.text_, a.binding_ < how) + sign + bracketed(b.text_, b.binding_ <= how);
  all.operands_ = a.operands_;
  for (const Operand& operand : b.operands_)
    if (std::none_of(all.operands_.begin(), all.operands_.end(),
                     [&](const Operand& known) { return known.symbol == operand.symbol; }))
      all.operands_.push_back(operand);
  all.limit_length();
  return all;
}

Formula Formula::wrapped(const std::string& open, const std::string& close, double result, Binding how) const {
  Formula all = *this;
  all.value_ = result, all.binding_ = how;
  if (!text_.empty()) all.text_ = open + text_ + close;
  all.limit_length();
  return all;
}

void Formula::limit_length() {
  if (text_.size() > longest_text) text_.clear();
  if (text_.empty() && operands_.size() > most_operands) operands_.resize(most_operands);
}

std::vector<Derivation> derivations_of(const Event& event, const formulas::Situation& before) {
  std::vector<Derivation> found;
  visit_event(
      [&]<class E>(const E& e) {
        Collector<E> collector{before, found};
        if constexpr (formulas::Derived<E, Collector<E>>) formulas::derive(e, before, collector);
      },
      event);
  return found;
}

using formulas::Rounded;

namespace {

using detail::name_at, detail::operand_of;

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
    if (is_letter(formula[at])) {
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
  return text == "-0" ? "0" : with_minus_signs(std::move(text));
}

std::string with_minus_signs(std::string text) {
  for (std::size_t at = text.find('-'); at != std::string::npos; at = text.find('-', at)) text.replace(at, 1, minus);
  return text;
}

bool is_taken_over(const ChainValue& value) {
  return value.operands.size() == 1 && value.operands[0].symbol == value.formula;
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
    if (!value.formula.empty() && value.formula != value.name) text += " = " + formula_text(value);
    if (!value.formula.empty() && !is_taken_over(value)) text += " = " + numbers_text(value);
    const double computed = computed_value(value);
    text += " = " +
            (holds(value) ? as_held(computed, value.value, result_text(value), value.rounds) : full_digits(computed));
  }
  if (!value.note.empty()) text += "   " + value.note;
  return text;
}

double computed_value(const ChainValue& value) {
  return value.formula.empty() || is_taken_over(value) ? value.value : evaluate(value);
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
  return fmt::format("The trace records {}, but {} {}.", full_digits(value.value),
                     is_taken_over(value) ? "it was taken from" : "this formula gives", full_digits(computed));
}

}  // namespace zstep::answers
