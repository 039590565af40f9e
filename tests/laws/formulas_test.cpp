// Law: in every golden trace in float64 each field that a formula gives has the bits that the formula gives, and each
// field that the table has as given is given by one.
#include <doctest/doctest.h>

#include <array>
#include <cmath>
#include <string>

#include "tests/golden/golden.hpp"
#include "tests/where.hpp"
#include "traces/formulas/of_events.hpp"
#include "traces/formulas/situation.hpp"
#include "traces/formulas/walk.hpp"

namespace zstep {
namespace {

using formulas::Follows, formulas::Place;

/// How often each field of each kind was given.
using Given = std::array<std::array<std::int64_t, 16>, kind_count>;

/// Holds the fields of one event against formulas in plain float64.
template <class E>
struct Bits {
  using Number = double;
  const E& e;
  const Header& header;
  std::array<std::int64_t, 16>& given;
  std::string wrong = {};

  double number(const auto&, double value, const Place&) { return value; }
  double named(std::string_view, double formula) { return formula; }
  void reads(const Place&) {}
  bool trusts(const Place&) const { return true; }
  bool equal(double one, double other) const { return one == other; }
  void rule(formulas::Rule, bool) {}

  void gives(Follows<E, double> field, double formula) { is(field, formula); }
  void within(Follows<E, double> field, double formula, double off) {
    ++given[field.number];
    if (!(std::abs(formula - e.*field.member) <= off)) wrong += std::string(field.name) + " ";
  }
  void near(Follows<E, double> field, const formulas::Rounded& number) {
    ++given[field.number];
    const bool same = formulas::gives(number, e.*field.member, formulas::rounding_of_float64);
    if (!same) wrong += std::string(field.name) + " ";
  }
  void whole(Follows<E, std::int32_t> field, double, std::int32_t within) { is(field, within); }
  template <class Value>
  void is(std::type_identity_t<Follows<E, Value>> field, Value value) {
    ++given[field.number];
    const Value recorded = e.*field.member;
    bool same = recorded == value;
    if constexpr (std::is_same_v<Value, double>)
      same = bits_of(recorded) == bits_of(value) || (std::isnan(recorded) && std::isnan(value)) ||
             (recorded == 0 && value == 0);  // -0, which JSON Lines may write as 0
    if (!same) wrong += std::string(field.name) + " ";
  }
  void verdict(Follows<E, bool> field, double z, double stored) { is(field, header.comparison.wins(z, stored)); }
};

void walk(const Trace& trace, Given& given) {
  formulas::walk(
      trace,
      [&]<class E>(std::int64_t step, const E& e, const formulas::Situation& at) {
        Bits<E> bits{e, trace.header(), given[kind_of<E>]};
        if constexpr (formulas::Derived<E, Bits<E>>) formulas::derive(e, at, bits);
        // A run in fewer digits rounds elsewhere: check holds it to those (tests/laws/check_test.cpp).
        const bool float64 = trace.header().conventions.number_format == NumberFormat::float64;
        if (float64 && !bits.wrong.empty())
          FAIL_CHECK(description_of<E>.name << " at step " << step << ": " << bits.wrong);
        return true;
      },
      [](std::int64_t step, const Impossible& why) { FAIL_CHECK("step " << step << ": " << why.what()); });
}

TEST_CASE("law: of every golden trace the formulas give every bit, and every field that is given") {
  Given given{};
  test::for_each_golden([&](const std::string& name, const Trace& trace) {
    CAPTURE(name);
    walk(trace, given);
  });
  // No golden trace has the ways of interpolating that only some runs ask for.
  const Trace golden = open_jsonl(test::in_checkout("tests/golden/pyramid.jsonl"));
  for (const auto how : {Conventions::Interpolation::plane, Conventions::Interpolation::plane_increments})
    for (std::size_t depth = 0; depth < words_of<Conventions::Depth>.size(); ++depth) {
      CAPTURE(depth);
      Conventions conventions;
      conventions.interpolation = how, conventions.depth = static_cast<Conventions::Depth>(depth);
      // There 1/z_v is added to, of which the trace has the reciprocal alone: the last digit may differ.
      if (how == Conventions::Interpolation::plane_increments && conventions.depth == Conventions::Depth::corrected)
        continue;
      walk(test::recorded_by("z-buffer", golden.scene(), conventions), given);
    }
  // Only a header of another program declares to what depths are cleared.
  given[kind_of<BuffersClear>][0] = 1;
  for_each_kind([&]<class E>() {
    for_each_index<E>([&]<std::size_t I>() {
      const std::string_view field = field_at<E, I>.name;
      if (has(field_at<E, I>.as, As::formula) && given[kind_of<E>][I] == 0)
        FAIL_CHECK("no golden trace has a " << description_of<E>.name << " whose " << field << " a formula gives");
    });
  });
}

}  // namespace
}  // namespace zstep
