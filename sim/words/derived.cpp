#include "sim/words/derived.hpp"

#include <cmath>
#include <limits>
#include <string_view>
#include <tuple>
#include <utility>

#include <fmt/format.h>

#include "sim/words/explain.hpp"
#include "sim/words/numbers.hpp"
#include "sim/words/owners.hpp"
#include "traces/events/fields.hpp"
#include "traces/formulas/of_events.hpp"
#include "traces/formulas/rounding.hpp"
#include "traces/formulas/situation.hpp"

namespace zstep::words {
namespace {

constexpr std::string_view minus = "\u2212";

/// To the right of a sign: a negative number stands in parentheses.
std::string to_the_right(const std::string& text) {
  if (!text.starts_with(minus)) return text;
  const auto numbers = numbers_in(text);
  const std::size_t end = numbers.empty() || numbers.front().first != 0 ? text.size() : numbers.front().second;
  return "(" + text.substr(0, end) + ")" + text.substr(end);
}

std::string in_parentheses(const std::string& text) { return "(" + text + ")"; }

}  // namespace

Shown::Shown(std::string symbol, double value) : Shown(std::move(symbol), value, number(value)) {}
Shown::Shown(std::string symbol, double value, std::string text)
    : rounded_(value), symbols_(std::move(symbol)), numbers_(std::move(text)) {}
Shown::Shown(double plain) : Shown(number(plain), plain) {}

Shown Shown::of(std::int32_t polygon) const {
  Shown all = *this;
  all.owned_ = {{symbols_, polygon}};
  return all;
}

std::string Shown::equation() const {
  return symbols_ == numbers_ || symbols_.empty() ? numbers_ : symbols_ + " = " + numbers_;
}

Shown Shown::joined(const Shown& a, const Shown& b, Binding how, const char* sign, formulas::Rounded result) {
  const bool subtracts = std::string_view(sign) == " \u2212 ", divides = std::string_view(sign) == "/";
  const bool left = a.binding_ < how, right = b.binding_ < how || (b.binding_ == how && (subtracts || divides));
  // (a + b)(c + d), without a sign between.
  const bool side_by_side = left && right && how == Binding::product && !divides;
  const auto join = [&](const std::string& one, const std::string& other, bool bracketed) {
    return (left ? in_parentheses(one) : one) + (side_by_side ? "" : sign) +
           (bracketed ? in_parentheses(other) : to_the_right(other));
  };
  // Divided by what is called 1/z.
  const bool by_quotient = divides && b.leaf_ && b.symbols_.find('/') != std::string::npos;
  Shown all(join(a.symbols_, b.symbols_, right || by_quotient), result.value, join(a.numbers_, b.numbers_, right));
  all.rounded_ = result, all.binding_ = how, all.leaf_ = false;
  all.owned_ = a.owned_;
  for (const Owned& one : b.owned_) add_owned(all.owned_, one);
  return all;
}

Shown operator-(const Shown& a, const Shown& b) {
  const formulas::Rounded result = a.rounded_ - b.rounded_;
  if (!a.leaf_ || !b.leaf_ || a.numbers_ != b.numbers_)
    return Shown::joined(a, b, Shown::Binding::sum, " \u2212 ", result);
  Shown one = a, other = b;
  std::tie(one.numbers_, other.numbers_) = tell_apart(a.value(), b.value());
  return Shown::joined(one, other, Shown::Binding::sum, " \u2212 ", result);
}

Shown operator-(const Shown& a) {
  const auto negated = [&](const std::string& text) {
    return std::string(minus) + (a.binding_ == Shown::Binding::sum ? in_parentheses(text) : to_the_right(text));
  };
  Shown all(negated(a.symbols_), -a.value(), negated(a.numbers_));
  all.rounded_ = -a.rounded_, all.binding_ = Shown::Binding::product, all.leaf_ = false;
  all.owned_ = a.owned_;
  return all;
}

Shown Shown::bracketed(const Shown& a, const char* open, const char* close, formulas::Rounded result) {
  const double whole = std::round(a.value());
  const bool looks_whole = a.leaf_ && a.value() != whole && a.numbers_ == number(whole);
  const std::string inside = looks_whole ? tell_apart(a.value(), whole).first : a.numbers_;
  Shown all(open + a.symbols_ + close, result.value, open + inside + close);
  all.rounded_ = result, all.leaf_ = false;
  all.owned_ = a.owned_;
  return all;
}

}  // namespace zstep::words

namespace zstep {

namespace {

using formulas::Follows, words::Shown;

/// Keeps the formulas.
template <class E>
struct Teller {
  using Number = Shown;
  const formulas::Situation& at;
  std::vector<DerivedField> found = {};
  struct Condition {
    std::string_view field;
    std::string text;  ///< what is asked
    bool wins;         ///< and the answer
  };
  std::optional<Condition> condition = {};

  Number number(std::string_view name, double value, const formulas::Place& place) {
    return written(name, value, place).of(words::owner_of(at, place, name));
  }
  Number written(std::string_view name, double value, const formulas::Place& place) {
    // In the world z is a coordinate, on the raster a depth.
    if (name.size() == 1 && place.field.ends_with("_w")) return {std::string(place.field), value};
    // An edge carries what is interpolated, a pixel its depth.
    const auto depth = place.in == formulas::Place::In::active_edge ? symbol_along : depth_symbol;
    std::string symbol = name == "z" ? depth(at.scene, at.header.conventions) : std::string(name);
    // What is multiplied needs the digits that count, not those behind the point.
    if (place.in == formulas::Place::In::piece && name != "D") return {std::move(symbol), value, factor(value)};
    return {std::move(symbol), value};
  }
  Number named(std::string_view name, const Number& formula) {
    const std::vector<std::int32_t> owners = words::owners_in(formula.owned());
    return Number(std::string(name), formula.value()).of(owners.size() == 1 ? owners.front() : no_polygon);
  }
  void reads(const formulas::Place&) {}
  bool trusts(const formulas::Place&) const { return true; }
  bool equal(double one, double other) const { return one == other; }
  void rule(formulas::Rule, bool) {}

  void gives(Follows<E, double> field, const Number& formula) { found.push_back({field.name, formula}); }
  void within(Follows<E, double> field, const Number& formula, double off) {
    found.push_back({field.name, formula, {}, off});
  }
  void near(Follows<E, double>, const formulas::Rounded&) {}
  void whole(Follows<E, std::int32_t> field, const Number& formula, std::int32_t within) {
    found.push_back({field.name, formula, within});
  }
  template <class Value>
  void is(std::type_identity_t<Follows<E, Value>>, Value) {}
  void verdict(Follows<E, bool> field, const Number& z, const Number& stored) {
    const Comparison& comparison = at.header.comparison;
    const auto [one, other] = tell_apart(z.value(), stored.value());
    const bool wins = comparison.wins(z.value(), stored.value());
    condition = {field.name,
                 fmt::format("{0} {1} {2}:  {3} {1} {4} is {5}", z.symbols(), comparison.sign(), stored.symbols(), one,
                             other, wins ? "true" : "false"),
                 wins};
  }
};

template <class Use>
auto with_teller(const Event& event, const formulas::Situation& at, Use&& use) {
  return visit_event(
      [&]<class E>(const E& e) {
        Teller<E> teller{at};
        if constexpr (formulas::Derived<E, Teller<E>>) formulas::derive(e, at, teller);
        return use(teller.found, teller.condition);
      },
      event);
}

/// "symbols = numbers = result", the result with the digits that tell it from the recorded number.
std::string line_of(const DerivedField& derived, double recorded) {
  const Shown& formula = derived.formula;
  if (!derived.within) {
    const std::string result = tell_apart(formula.value(), recorded).first;
    if (!formula.is_operand()) return fmt::format("{} = {}", formula.equation(), result);
    return formula.equation() == zstep::number(formula.value())
               ? result
               : Shown(formula.symbols(), formula.value(), result).equation();
  }
  const std::string equation = formula.equation();
  if (formula.value() == *derived.within) return fmt::format("{} = {}", equation, *derived.within);
  return fmt::format("{} = {}, within the raster {}", equation, zstep::number(formula.value()), *derived.within);
}

/// What is recorded in a field of this name.
double recorded_in(const Event& event, std::string_view name) {
  for (const FieldOfKind& field : fields_of_kind(event.index()))
    if (field.name == name) return field.read(event);
  return std::numeric_limits<double>::quiet_NaN();
}

}  // namespace

std::vector<DerivedField> derived_fields(const Event& event, const formulas::Situation& at) {
  return with_teller(event, at, [](auto& found, auto&) { return std::move(found); });
}

std::optional<FormulaText> derived_formula(const Event& event, const formulas::Situation& at,
                                           const std::string& field) {
  const double recorded = recorded_in(event, field);
  return with_teller(event, at, [&](auto& found, auto& condition) -> std::optional<FormulaText> {
    if (condition && condition->field == field)
      return FormulaText{condition->text, condition->wins == (recorded != 0), true};
    // Of what may follow in two ways the last one said is meant.
    for (auto derived = found.rbegin(); derived != found.rend(); ++derived) {
      if (derived->field != field) continue;
      const bool follows =
          derived->within ? recorded == *derived->within
          : derived->off  ? std::abs(recorded - derived->formula.value()) <= *derived->off
                          : formulas::tolerance_of(at.scene, at.header).allows(derived->formula.rounded(), recorded);
      return FormulaText{line_of(*derived, recorded), follows, false};
    }
    return std::nullopt;
  });
}

std::optional<FormulaText> formula_of_scene(const Event& event, const formulas::Situation& at) {
  return visit_event(
      [&]<class E>(const E& e) -> std::optional<FormulaText> {
        if constexpr (requires { e.z; } && is_of_fragment(at_pixel<E>)) {
          Teller<E> teller{at};
          formulas::detail::derive_depth_in_scene(e, at, teller);
          if (!teller.found.empty()) return FormulaText{line_of(teller.found.front(), e.z), false, false};
        }
        return std::nullopt;
      },
      event);
}

std::string subject_of(const Event& event, const formulas::Situation& at) {
  const auto edge = [&](std::int32_t number) {
    const EdgeTableInsert* entry = at.edge(number);
    return entry ? fmt::format("edge e{} ({}\u2013{})", number, entry->vertex_0, entry->vertex_1)
                 : fmt::format("edge e{}", number);
  };
  return visit_event(
      [&]<class E>(const E& e) -> std::string {
        if constexpr (std::is_same_v<E, EdgeTableInsert>)
          return fmt::format("edge e{} ({}\u2013{})", e.edge, e.vertex_0, e.vertex_1);
        else if constexpr (requires { e.left_edge; })
          return fmt::format("scan line {}, from {} to {}", e.y, edge(e.left_edge), edge(e.right_edge));
        else if constexpr (requires { e.edge; }) return edge(e.edge);
        else if constexpr (requires {
                             e.x;
                             e.y;
                           })
          return fmt::format("pixel ({}, {})", e.x, e.y);
        else if constexpr (std::is_same_v<E, PlaneSlopes>)
          return fmt::format("the plane of {}", polygon_label(at.scene, e.polygon));
        else if constexpr (requires {
                             e.vertex_0;
                             e.vertex_1;
                           })
          return fmt::format("the edge from vertex {} to vertex {}", e.vertex_0, e.vertex_1);
        else if constexpr (requires { e.vertex; }) return fmt::format("vertex {}", e.vertex);
        else if constexpr (requires { e.y; }) return fmt::format("scan line {}", e.y);
        else if constexpr (requires { e.polygon; }) return polygon_label(at.scene, e.polygon);
        else return "";
      },
      event);
}

}  // namespace zstep
