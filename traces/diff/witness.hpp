// How a step follows from its operands, and which differences these go back to.
#pragma once

#include <algorithm>
#include <cmath>
#include <type_traits>

#include "traces/check/precision.hpp"
#include "traces/diff/follow.hpp"
#include "traces/formulas/follows.hpp"
#include "traces/formulas/rounding.hpp"

namespace zstep::diff {

using formulas::Follows, formulas::Place, formulas::Rounded, formulas::Rule;

/// Which differences the operands of this step go back to.
struct Reads {
  const Inheritance &different, &rounding;
  const std::vector<Finding>& findings;
  std::int32_t from_different = no_difference, from_rounding = no_difference;
  std::int32_t stored_different = no_difference;  ///< what a compare holds its depth against; the depth does not follow
  float operands_off = 0;                         ///< how far operands are off by rounding, as a share of them, at most

  void operator()(const Place& place) {
    if (from_different == no_difference) from_different = different.of(place);
    const std::int32_t from = rounding.of(place);
    if (from_rounding == no_difference) from_rounding = from;
    if (from != no_difference) operands_off = std::max(operands_off, findings[static_cast<std::size_t>(from)].off);
  }
  /// The stored depth decides a compare, and nothing else of it.
  void stored(const Place& place) {
    Reads reads{different, rounding, findings};
    reads(place);
    stored_different = reads.from_different;
    if (from_rounding == no_difference) from_rounding = reads.from_rounding;
    operands_off = std::max(operands_off, reads.operands_off);
  }
};

/// Looks at how a step follows from its operands.
template <class E>
struct Witness {
  using Number = Rounded;
  const E& e;
  const Header& header;
  const Precision& precision;
  std::uint16_t differing;  ///< the fields in question
  Reads& reads_from;
  bool wrong = false;
  double may_be_off = 0;  ///< what rounding allows a field in question, as a share of it, at most
  /// The same where operands may be off by more than the number format has them: where they are small differences of
  /// large numbers.
  double may_be_off_here() const {
    const double more = reads_from.operands_off / (2 * precision.relative);
    constexpr double digits_of_shares = 1 + 1e-6;
    return may_be_off * std::max(1.0, more * digits_of_shares);
  }
  bool undeclared = false;  ///< the header does not say which verdict is right
  bool decides = false;     ///< a verdict is in question
  double gap = 0;           ///< by how much the two depths differ that it is about
  std::uint16_t told = 0;   ///< the fields in question that were held against something

  Number number(const auto&, double value, const Place& place) {
    if (std::is_same_v<E, DepthCompare> && place.in == Place::In::depth_buffer) reads_from.stored(place);
    else if (place.in != Place::In::event && place.in != Place::In::scene) reads_from(place);
    Rounded known(value);
    if (precision.largest_amount() > 0) known.spread += precision.amount(place) / precision.relative;
    return known;
  }
  Number named(std::string_view, const Number& formula) { return formula; }
  void reads(const Place& place) { reads_from(place); }
  bool trusts(const Place& place) const { return reads_from.different.of(place) == no_difference; }
  bool equal(double one, double other) const {
    return formulas::gives(Rounded(one), other, precision.relative) ||
           std::abs(one - other) <= precision.largest_amount();
  }

  void gives(Follows<E, double> field, const Number& formula) {
    if (!asks(field)) return;
    const double value = e.*field.member, amount = precision.amount(field.unit);
    wrong =
        wrong || !(formulas::gives(formula, value, precision.relative) || std::abs(value - formula.value) <= amount);
    const double size = std::max(std::abs(value), std::abs(formula.value));
    // What is 0 in one run the other run is asked about: there it has a size.
    may_be_off = std::max(may_be_off, (2 * precision.relative * formula.spread + amount) / size);
  }
  void near(Follows<E, double> field, const Rounded& number) {
    if (in_question(field)) gives(field, number);
  }
  void whole(Follows<E, std::int32_t> field, const Number&, std::int32_t within) {
    if (asks(field)) wrong = wrong || e.*field.member != within;
  }
  template <class Value>
  void is(std::type_identity_t<Follows<E, Value>> field, Value value) {
    if (!asks(field)) return;
    const Value recorded = e.*field.member;
    bool equal = recorded == value;
    if constexpr (std::is_same_v<Value, double>) equal = equal || this->equal(recorded, value) || value != value;
    wrong = wrong || !equal;
  }
  void verdict(Follows<E, bool> field, const Number& z, const Number& stored) {
    if (!asks(field)) return;
    decides = true, gap = z.value == stored.value ? 0 : std::abs(z.value - stored.value);
    const bool tie = z.value == stored.value;
    if (header.declares(tie ? Convention::ties : Convention::nearer))
      wrong = wrong || e.*field.member != header.comparison.wins(z.value, stored.value);
    else undeclared = true;
  }
  /// That a pixel before was not written is a difference of its own, and not this step's.
  void rule(Rule rule, bool holds) { wrong = wrong || (!holds && rule != Rule::win_is_written); }

 private:
  template <class Value>
  bool in_question(const Follows<E, Value>& field) const {
    return (differing >> field.number & 1) != 0;
  }
  template <class Value>
  bool asks(const Follows<E, Value>& field) {
    if (in_question(field)) told = static_cast<std::uint16_t>(told | 1u << field.number);
    return in_question(field);
  }
};

}  // namespace zstep::diff
