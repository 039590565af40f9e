// How one event of a run is judged: its numbers against the formulas, with bounds for rounding, and what is wrong
// against what it follows from. For check.cpp.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <map>
#include <string_view>
#include <tuple>
#include <type_traits>
#include <utility>

#include "traces/check/check.hpp"
#include "traces/check/inheritance.hpp"
#include "traces/check/pixels.hpp"
#include "traces/events/fields.hpp"
#include "traces/formulas/of_events.hpp"
#include "traces/formulas/rounding.hpp"
#include "traces/formulas/situation.hpp"

namespace zstep::judging {

using formulas::Follows, formulas::Place, formulas::Rounded, formulas::Rule, formulas::Situation;

/// What is noticed only at whatever comes next.
inline bool is_of_before(Rule rule) {
  return rule == Rule::win_is_written || rule == Rule::win_is_painted || rule == Rule::pixel_is_drawn ||
         rule == Rule::nearer_is_painted || rule == Rule::facet_is_drawn;
}

struct Checker {
  const Trace& trace;
  const Header& header;  ///< by which it is judged
  const OnCause& on_cause;
  CheckReport report{};
  Inheritance inheritance{};
  std::map<std::tuple<int, std::uint8_t, std::size_t>, std::size_t> known{};  ///< causes by what is wrong, kind, field
  CheckMarks* marks = nullptr;  ///< for who wants them, until there are too many

  // Of the step at work.
  std::int64_t step = 0;
  std::uint8_t line = 0;
  bool any_judged = false, any_fault = false;
  std::uint32_t fields = 0;  ///< bit f: something says what its field f must be
  Wins wins;
  Rule broken = Rule::count;  ///< the last one that does not hold
  std::int32_t inherited = Inheritance::clean, charged = Inheritance::clean;
  const Situation* at = nullptr;
  Event held{};  ///< what is wrong, for who wants to see it

  void begin(std::int64_t position, std::uint8_t id) {
    step = position, line = id;
    any_judged = any_fault = false, fields = 0;
    broken = Rule::count;
    inherited = charged = Inheritance::clean;
  }
  void read(const Place& place) {
    if (inheritance.empty()) return;
    if (const std::int32_t cause = inheritance.of(place);
        cause != Inheritance::clean && inherited == Inheritance::clean)
      inherited = cause;
  }

  /// `what`: 0 a field, 1 a rule, 2 a step that cannot be, 3 a field that is not what the scene has.
  void fault(int what, std::size_t number, Fault fault) {
    fault.step = step, fault.line = line;
    report.wrong_steps += !any_fault;
    any_fault = true;
    if (marks) marks->faults.push_back(fault);
    const bool of_any_kind = fault.rule && is_of_before(*fault.rule);
    const auto [found, fresh] =
        known.try_emplace({what, of_any_kind ? std::uint8_t{0} : fault.kind, number}, report.causes.size());
    if (!fresh) {
      Cause& cause = report.causes[found->second];
      cause.again += cause.first.step != step;
    } else {
      report.causes.push_back({std::move(fault), 0, 0});
      if (on_cause) on_cause(report.causes.back(), *at, RecordedEvent{line, held});
    }
    inherited = static_cast<std::int32_t>(found->second);
  }

  /// What is written to a place follows from the same as the step does.
  void written(const Place& place) {
    if (marks && inheritance.of(place) != inherited) marks->changes.push_back({step, place, inherited});
    inheritance.set(place, inherited);
  }
  void cleared(Place::In in) {
    if (marks)
      inheritance.for_each(in, [&](const Place& place) { marks->changes.push_back({step, place, CheckMarks::none}); });
    inheritance.clear(in);
  }
  void mark_step() {
    const std::int32_t cause = inherited != Inheritance::clean ? inherited : charged;
    if (!marks || cause == Inheritance::clean) return;
    marks->steps.push_back({step, cause, any_fault});
    if (marks->steps.size() + marks->changes.size() + marks->faults.size() > CheckMarks::most)
      marks->complete = false, marks = nullptr;
  }

  /// How far apart two numbers of any unit may be.
  double amount_of_any() const {
    return report.precision.whole ? report.precision.absolute : report.precision.largest_amount();
  }
  bool within_rounding(const Rounded& formula, double recorded, double amount) const {
    if (formulas::gives(formula, recorded, report.precision.relative)) return true;
    return std::abs(recorded - formula.value) <= amount;
  }
  /// Counts a number of this unit that is right; false where it is not.
  bool holds(const Rounded& formula, double recorded, std::string_view of_unit) {
    ++report.numbers;
    if (recorded == formula.value) return ++report.exact, true;
    // NaN is right nowhere, but follows from what is wrong already.
    if (std::isnan(recorded) && std::isnan(formula.value)) return inherited != Inheritance::clean;
    if (!within_rounding(formula, recorded, report.precision.amount(of_unit))) return false;
    // Of a small difference of large numbers, the last digit of these: it has none of its own.
    round(recorded - formula.value, std::max(std::abs(recorded), formula.spread), of_unit);
    return true;
  }
  /// Counts a number that is off by so much, of this size.
  void round(double off, double size, std::string_view of_unit) {
    ++report.rounded;
    const bool has_own_unit = of_unit == "px" && report.precision.positions > 0;
    const double unit = has_own_unit ? 1 / fixed_positions_a_pixel : report.precision.unit;
    const double digit = report.precision.digits > 0 ? last_written_digit(size, report.precision.digits)
                                                     : formulas::last_digit(size, report.precision.format, unit);
    report.largest_rounding = std::max(report.largest_rounding, std::abs(off) / digit);
  }
};

/// Judges the fields of one event.
template <class E>
struct Judge {
  using Number = Rounded;
  Checker& checker;
  const E& e;
  bool by_scene = false;  ///< what is given now is what the scene says

  Number number(const auto&, double value, const Place& place) {
    if (place.in != Place::In::event && place.in != Place::In::scene) checker.read(place);
    Rounded known(value);
    if (checker.report.precision.absolute > 0)
      known.spread += checker.report.precision.amount(place) / checker.report.precision.relative;
    return known;
  }
  Number named(std::string_view, const Number& formula) { return formula; }
  void reads(const Place& place) { checker.read(place); }
  bool trusts(const Place& place) const { return checker.inheritance.of(place) == Inheritance::clean; }
  bool every_digit() const { return checker.report.precision.every_digit; }
  bool equal(double one, double other) const { return equal(one, other, checker.amount_of_any()); }
  bool equal(double one, double other, double amount) const {
    return checker.within_rounding(Rounded(one), other, amount);
  }

  void gives(Follows<E, double> field, const Number& formula) {
    judges(field.number);
    if (!checker.holds(formula, e.*field.member, field.unit)) wrong(field, e.*field.member, formula.value);
  }
  void near(Follows<E, double> field, const Rounded& number) {
    judges(field.number);
    const double recorded = e.*field.member;
    if (!checker.within_rounding(number, recorded, checker.report.precision.amount(field.unit)))
      wrong(field, recorded, number.value);
  }
  void whole(Follows<E, std::int32_t> field, const Number& formula, std::int32_t within) {
    if (std::isnan(formula.value)) return;  // of no number
    judges(field.number);
    const std::int32_t recorded = e.*field.member;
    if (recorded == within) return;
    // Just beside a pixel's centre digits that are not printed may decide either way.
    const Precision& precision = checker.report.precision;
    const bool beside = recorded == within + 1 || recorded == within - 1;
    if (beside && !precision.every_digit && formula.turns <= precision.relative) return;
    wrong(field, recorded, within);
  }
  template <class Value>
  void is(std::type_identity_t<Follows<E, Value>> field, Value value) {
    judges(field.number);
    const Value recorded = e.*field.member;
    if (recorded == value || (value != value && recorded != recorded)) return;
    if constexpr (std::is_same_v<Value, double>)
      if (equal(recorded, value, checker.report.precision.amount(field.unit))) return;
    wrong(field, static_cast<double>(recorded), static_cast<double>(value));
  }
  void verdict(Follows<E, bool> field, const Number& z, const Number& stored) {
    const Header& header = checker.header;
    const bool tie = z.value == stored.value;
    if (!header.declares(tie ? Convention::ties : Convention::nearer)) return;
    if (!checker.report.precision.every_digit &&
        checker.within_rounding(z, stored.value, checker.report.precision.absolute))
      return;
    const bool wins = header.comparison.wins(z.value, stored.value);
    judges(field.number);
    if (e.*field.member != wins) wrong(field, e.*field.member, wins);
  }
  void within(Follows<E, double> field, const Number& formula, double off) {
    const double recorded = e.*field.member, expected = formula.value;
    const Precision& precision = checker.report.precision;
    const double digits =
        precision.every_digit ? 0 : precision.relative * std::max(std::abs(recorded), std::abs(expected));
    const bool right = std::abs(recorded - expected) <= off + digits + precision.amount(field.unit);
    if (by_scene) {
      if (!right) wrong(field, recorded, expected);
      return;
    }
    judges(field.number);
    ++checker.report.numbers;
    if (recorded == expected) ++checker.report.exact;
    else if (right) checker.round(recorded - expected, std::max(std::abs(recorded), off), field.unit);
    else wrong(field, recorded, expected);
  }
  /// What a field must be by the scene, where it goes with what the run has.
  template <class Judges>
  void judged_by_scene(const Judges& judge) {
    by_scene = true;
    judge();
    by_scene = false;
  }
  /// Nothing is wrong with the step, nor with what it follows from.
  bool is_clean() const { return !checker.any_fault && checker.inherited == Inheritance::clean; }
  bool breaks(Rule rule) const { return checker.broken == rule; }
  void rule(Rule rule, bool holds) {
    checker.any_judged = true;
    if (!holds) this->rule(rule, false, Fault());
  }
  /// `fault`: with what is known of it besides.
  void rule(Rule rule, bool holds, Fault fault) {
    checker.any_judged = true;
    if (holds) return;
    fault.kind = kind_of<E>, fault.rule = rule;
    checker.held = e, checker.broken = rule;
    const std::int32_t inherited = checker.inherited;
    checker.fault(1, static_cast<std::size_t>(rule), std::move(fault));
    // That the pixel before was not written is noticed here, and nothing of this step follows from it.
    if (is_of_before(rule)) {
      const auto last = checker.wins.last_compared();
      if (last && rule == Rule::win_is_written) checker.written(checker.at->depth_place(last->x, last->y));
      checker.charged = std::exchange(checker.inherited, inherited);
    }
  }

  /// A number stands where one must be, also where no formula says which.
  void has_numbers() {
    for_each_index<E>([&]<std::size_t I>() {
      if constexpr (std::is_same_v<FieldValue<E, I>, double>) {
        const double value = e.*field_at<E, I>.member;
        if (std::isfinite(value) || (checker.fields >> I & 1u) != 0 ||
            may_be(checker.header, kind_of<E>, field_at<E, I>.name, value))
          return;
        checker.any_judged = true;
        wrong(field_at<E, I>.name, I, value, std::numeric_limits<double>::quiet_NaN());
      }
    });
  }

 private:
  void judges(std::size_t field) {
    static_assert(field_count<E> <= KindJudged::most_fields);
    checker.any_judged = true;
    checker.fields |= 1u << field;
  }
  template <class Value>
  void wrong(const Follows<E, Value>& field, double recorded, double expected) {
    wrong(field.name, field.number, recorded, expected);
  }
  void wrong(std::string_view name, std::size_t number, double recorded, double expected) {
    Fault fault;
    fault.kind = kind_of<E>, fault.recorded = recorded, fault.expected = expected;
    fault.field = name, fault.by_scene = by_scene;
    checker.held = e;
    checker.fault(by_scene ? 3 : 0, number, std::move(fault));
  }
};

/// Whether an event is right to the last bit, in float64 and without bounds. Most events of most runs are; the Judge
/// looks at the others. Nothing may be wrong with what the event follows from.
template <class E>
struct ToTheBit {
  using Number = double;
  const Checker& checker;
  const E& e;
  bool right = true, judged = false;
  std::int64_t numbers = 0;
  std::uint32_t fields = 0;

  Number number(const auto&, double value, const Place&) const { return value; }
  Number named(std::string_view, Number formula) const { return formula; }
  void reads(const Place&) const {}
  bool trusts(const Place&) const { return true; }
  bool every_digit() const { return checker.report.precision.every_digit; }
  bool equal(double one, double other) const { return equal(one, other, checker.amount_of_any()); }
  bool equal(double one, double other, double amount) const {
    return checker.within_rounding(Rounded(one), other, amount);
  }

  void gives(Follows<E, double> field, Number formula) {
    ++numbers;
    look(field.number, e.*field.member == formula);
  }
  void near(Follows<E, double> field, const Rounded& number) { look(field.number, e.*field.member == number.value); }
  void whole(Follows<E, std::int32_t> field, Number formula, std::int32_t within) {
    if (!std::isnan(formula)) look(field.number, e.*field.member == within);
  }
  template <class Value>
  void is(std::type_identity_t<Follows<E, Value>> field, Value value) {
    const Value recorded = e.*field.member;
    look(field.number, recorded == value || (value != value && recorded != recorded));
  }
  void verdict(Follows<E, bool> field, Number z, Number stored) {
    if (!checker.header.declares(z == stored ? Convention::ties : Convention::nearer)) return;
    look(field.number, every_digit() && e.*field.member == checker.header.comparison.wins(z, stored));
  }
  void within(Follows<E, double> field, Number formula, double) { gives(field, formula); }
  void rule(Rule, bool holds) { judged = true, right = right && holds; }

 private:
  void look(std::size_t field, bool is_right) {
    judged = true, right = right && is_right;
    fields |= 1u << field;
  }
};

/// How often it was worth while of each kind: a run in float32 has few numbers to the bit of float64.
class WorthLooking {
 public:
  bool at(std::size_t kind) const { return right_[kind] + few >= wrong_[kind]; }
  void count(std::size_t kind, bool right) { ++(right ? right_ : wrong_)[kind]; }

 private:
  static constexpr std::int64_t few = 100;
  std::array<std::int64_t, kind_count> right_{}, wrong_{};
};

/// Counts an event that is right to the bit; false where it is for the Judge.
template <class E>
bool is_to_the_bit(const E& e, Checker& checker, WorthLooking& worth) {
  ToTheBit<E> exact{checker, e};
  formulas::derive(e, *checker.at, exact);
  worth.count(kind_of<E>, exact.right);
  if (!exact.right) return false;
  checker.any_judged = checker.any_judged || exact.judged;
  checker.fields |= exact.fields;
  checker.report.numbers += exact.numbers, checker.report.exact += exact.numbers;
  return true;
}

}  // namespace zstep::judging
