#include "sim/words/derived.hpp"

#include <limits>

#include <fmt/format.h>

#include "sim/words/explain.hpp"
#include "sim/words/numbers.hpp"
#include "sim/words/owners.hpp"
#include "sim/words/shown.hpp"
#include "traces/events/fields.hpp"
#include "traces/formulas/follows.hpp"
#include "traces/formulas/of_events.hpp"
#include "traces/formulas/rounding.hpp"

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
                          : formulas::tolerance_of(at.scene, at.header).allows(derived->formula.rounded(), recorded);
      return FormulaText{line_of(*derived, recorded), follows, false};
    }
    return std::nullopt;
  });
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
