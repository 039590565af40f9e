// What the explanations of single events share. For explain*.cpp only.
#pragma once

#include <cmath>
#include <string>

#include <fmt/format.h>

#include "sim/words/derived.hpp"
#include "sim/words/explain.hpp"
#include "sim/words/numbers.hpp"
#include "sim/words/owners.hpp"
#include "traces/formulas/coverage.hpp"
#include "traces/formulas/of_pieces.hpp"
#include "traces/formulas/outlines.hpp"
#include "traces/formulas/rounding.hpp"
#include "traces/formulas/walk.hpp"

namespace zstep::words {

struct Telling {
  const Trace& trace;
  const State& after;
  const Scene& scene;
  const Conventions& conventions;
  const formulas::Situation at;  ///< the state that the event led to
  const MethodState& machine;
  std::string z;                    ///< what depths are called
  std::string along;                ///< what is interpolated to get them
  std::int32_t about = no_polygon;  ///< the polygon that the event's own numbers belong to
  Explanation out;
  std::vector<DerivedField> derived;  ///< once `derive` was called

  Telling(const Trace& trace_, const State& after_)
      : trace(trace_),
        after(after_),
        scene(trace_.scene()),
        conventions(trace_.header().conventions),
        at(formulas::situation_after(trace_, after_)),
        machine(after_.machine),
        z(depth_symbol(trace_.scene(), trace_.header().conventions)),
        along(symbol_along(trace_.scene(), trace_.header().conventions)) {}

  void say(std::string sentence) { out.sentence = std::move(sentence); }
  /// What the trace says and its own numbers contradict.
  void contradict(std::string sentence) {
    out.doubt = sentence, out.besides.clear();
    say(std::move(sentence));
  }
  /// `field`: of the event, whose number the line ends in.
  void formula(std::string line, std::string_view field = {}) {
    out.formulas.push_back(std::move(line)), out.given.emplace_back(field);
  }
  /// A symbol of the formulas stands for a number of this polygon.
  void owns(std::string symbol, std::int32_t polygon) { add_owned(out.owned, {std::move(symbol), polygon}); }
  void value(std::string name, double v) { out.values.emplace_back(std::move(name), v); }
  std::string label(std::int32_t polygon) const { return polygon_label(scene, polygon); }
  /// The polygon at work; of a pixel whose span came earlier than that one, the span's.
  std::int32_t polygon() const { return pixels_polygon().value_or(machine.polygon); }
  std::int32_t at_work() const { return pixels_polygon().value_or(polygon_at_work(machine)); }
  std::optional<std::int32_t> pixels_polygon() const {
    const auto& pixel = machine.fragment;
    return at.ahead.of_all && pixel ? at.polygon_of_pixel(pixel->x, pixel->y) : std::nullopt;
  }
  std::string here() const { return label(at_work()); }
  std::string piece(std::int32_t number) const { return piece_label(scene, machine, number); }
  /// The name of the step that recorded the event, "" in a trace whose page lacks it.
  std::string step() const {
    const StepInfo* found = find_step(trace.header().page, trace.event(after.position).step);
    return found ? found->name : "";
  }

  /// What the trace's numbers may be off by.
  formulas::Tolerance tolerance() const { return formulas::tolerance_of(scene, trace.header()); }
  void doubt(const std::string& text) {
    out.doubt = out.doubt ? *out.doubt + " " + text : text;
    out.besides += (out.besides.empty() ? "" : " ") + text;
  }
  /// Holds the recorded number against what the shown formula gives; rounding of an honest computation passes.
  bool hold_against(const std::string& name, double recorded, const formulas::Rounded& computed) {
    if (tolerance().allows(computed, recorded)) return true;
    const auto [is, ought] = tell_apart(recorded, computed.value);
    doubt(fmt::format("The trace records {} = {}, but this formula gives {}.", name, is, ought));
    return false;
  }
  /// "name = symbols = numbers = recorded" as a line of its own, held against what it gives: then that is what it ends
  /// in.
  void gives(const std::string& name, std::string_view field, const Shown& formula, double recorded) {
    gives(name, field, formula, recorded, formula.rounded());
  }
  /// The same of what may be off by more than its formula's rounding.
  void gives(const std::string& name, std::string_view field, const Shown& formula, double recorded,
             const formulas::Rounded& computed) {
    for (const Owned& one : formula.owned()) owns(one.symbol, one.polygon);
    owns(name, about);
    const bool so = hold_against(name, recorded, computed);
    this->formula(so ? fmt::format("{} = {} = {}", name, formula.equation(),
                                   as_held(formula.value(), recorded, number(recorded), rounding_word(conventions)))
                     : contradicted(name, formula, recorded),
                  field);
  }
  /// Finds what the formulas give for the event's fields: of those whose operands the event leaves as they were.
  void derive(const Event& event) { derived = derived_fields(event, at); }
  /// The same where the event changed its operands: `put_back(machine)` makes them what they were.
  template <class PutBack>
  void derive_from(const Event& event, PutBack&& put_back) {
    State before;
    before.vertices = after.vertices, before.machine = after.machine, before.position = after.position - 1;
    put_back(before.machine);
    derived = derived_fields(event, formulas::situation_of(trace, before));
  }
  const DerivedField* derived_of(std::string_view field) const {
    for (const DerivedField& one : derived)
      if (one.field == field) return &one;
    return nullptr;
  }
  /// A line for a field, by the formula that gives it; false where none does.
  bool follows(const std::string& name, std::string_view field, double recorded) {
    const DerivedField* found = derived_of(field);
    if (found) gives(name, field, found->formula, recorded);
    return found != nullptr;
  }
  /// Holds a field against its formula without a line for it.
  void hold_derived(const std::string& name, std::string_view field, double recorded) {
    if (const DerivedField* found = derived_of(field)) hold_against(name, recorded, found->formula.rounded());
  }
  /// The depth that the span at work has at a pixel, held against the recorded one.
  void depth_on_span(double recorded) {
    const DerivedField* found = derived_of("z");
    if (found) gives(found->formula.is_operand() ? "x_L = x_R: " + z : z, "z", found->formula, recorded);
  }
  /// A depth that was taken over from the step before: "The trace writes z = 0.35, but had compared z = 0.3."
  bool taken_over(const char* does, double recorded, const char* had, double before) {
    if (tolerance().allows(before, recorded)) return true;
    const auto [is, was] = tell_apart(recorded, before);
    doubt(fmt::format("The trace {} {} = {}, but had {} {} = {}.", does, z, is, had, z, was));
    return false;
  }
  /// The same of a whole number, which the raster may limit to another one.
  bool whole(const std::string& name, std::string_view field, std::int32_t recorded) {
    const DerivedField* found = derived_of(field);
    if (!found || !found->within) return true;
    const Shown& formula = found->formula;
    for (const Owned& one : formula.owned()) owns(one.symbol, one.polygon);
    const std::int32_t within_raster = *found->within;
    const bool limited = formula.value() != within_raster;
    const std::string ought = limited ? fmt::format("{}, within the raster {}", number(formula.value()), within_raster)
                                      : number(formula.value());
    if (recorded == within_raster) {
      this->formula(fmt::format("{} = {} = {}", name, formula.equation(), ought), field);
      return true;
    }
    this->formula(fmt::format("{} = {} = {}, but the trace records {}", name, formula.equation(), ought, recorded),
                  field);
    doubt(fmt::format("The trace records {} = {}, but this formula gives {}.", name, recorded, within_raster));
    return false;
  }
  static std::string contradicted(const std::string& name, const Shown& formula, double recorded) {
    const auto [is, ought] = tell_apart(recorded, formula.value());
    return fmt::format("{} = {} = {}, but the trace records {}", name, formula.equation(), ought, is);
  }
};

/// In parentheses when negative, so that "3 − (−2)" reads right.
inline std::string operand(double value, std::string text) {
  return value < 0 && text.find("\u2212") == 0 ? "(" + text + ")" : text;
}

inline std::string operand(double value) { return operand(value, number(value)); }

/// A formula's text, over names that here have no number.
template <class Formula>
std::string in_symbols(Formula&& formula) {
  return formula([](const char* name) { return Shown(name, 0); }).symbols();
}
/// "V = V_0 + t(V_1 − V_0)" of points.
inline std::string point_on_way(const char* from, const char* to) {
  return "V = " + in_symbols([&](auto&& name) { return formulas::part_of_way(name(from), name(to), name("t")); });
}
/// What the coordinates of a space are called.
struct PointNames {
  std::string x, y, z;
};
inline const PointNames world_names{"x_w", "y_w", "z_w"};
/// Those of the space in which this run cuts pieces: the world's, or the raster's with its depth.
inline PointNames cutting_names(const Telling& t) {
  return formulas::detail::cuts_in_world(t.at) ? world_names : PointNames{"x", "y", t.z};
}
/// "A·x + B·y + C·z + D" of a plane in that space; without its D where that is empty.
inline std::string plane_in_symbols(const PointNames& at, const std::string& d = "D") {
  const auto name = [](const std::string& symbol) { return Shown(symbol, 0); };
  return formulas::plane_value(name("A"), name("B"), name("C"), d.empty() ? Shown(0.0) : name(d), name(at.x),
                               name(at.y), name(at.z))
      .symbols();
}

// One for each kind.
#define ZSTEP_TELL(E) void tell(Telling& t, const E& e);
ZSTEP_EVERY_KIND(ZSTEP_TELL)
#undef ZSTEP_TELL

}  // namespace zstep::words
