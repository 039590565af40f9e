#include "sim/answers/origin/derivations.hpp"

#include <algorithm>
#include <cctype>

#include <fmt/format.h>

#include "traces/formulas/follows.hpp"
#include "traces/formulas/of_events.hpp"

namespace zstep::answers {
namespace {

constexpr std::size_t longest_text = 1200, most_operands = 18;

/// A name that is one in the formula of a chain: of letters, digits and _.
std::string symbol_of(std::string_view name, const formulas::Place& place) {
  if (place.in == formulas::Place::In::depth_buffer || place.in == formulas::Place::In::light_buffer) return "stored";
  if (std::all_of(name.begin(), name.end(),
                  [](char c) { return std::isalnum(static_cast<unsigned char>(c)) || c == '_'; }))
    return std::string(name);
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

}  // namespace zstep::answers
