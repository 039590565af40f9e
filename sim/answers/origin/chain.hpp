// The chain behind a number: every step, and at last every line of the mesh file, that it comes from.
#pragma once

#include <cmath>
#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "traces/formulas/rounding.hpp"
#include "traces/formulas/situation.hpp"

namespace zstep::answers {

// What the fields of an event follow from, by the formulas of traces/formulas.

/// A number that remembers the formula it was made by, in the form that a chain has it. The text has as many
/// parentheses as it takes to compute it in the same order, so that it gives the same bits.
class Formula {
 public:
  struct Operand {
    std::string symbol;
    double value = 0;
    formulas::Place place = {};
    std::shared_ptr<const Formula> inner = {};  ///< of a number that has a name and a formula of its own
  };

  explicit Formula(double plain);
  explicit Formula(Operand operand) : value_(operand.value), text_(operand.symbol) {
    operands_.push_back(std::move(operand));
  }

  double value() const { return value_; }
  const std::string& text() const { return text_; }  ///< empty where it would be longer than a person reads
  const std::vector<Operand>& operands() const { return operands_; }  ///< in order; of a text that is too long, some
  bool is_operand() const { return operands_.size() == 1 && text_ == operands_[0].symbol; }

  /// Limited to what the raster holds, where that changes it.
  Formula within(double limit) const;
  /// A condition between two numbers: "z < stored".
  static Formula compared(const Formula& a, const std::string& sign, const Formula& b, bool holds) {
    return joined(a, b, sum, " " + sign + " ", holds);
  }

  friend Formula operator+(const Formula& a, const Formula& b) {
    return a.text_ == "0" ? b : joined(a, b, sum, " + ", a.value_ + b.value_);
  }
  friend Formula operator-(const Formula& a, const Formula& b) { return joined(a, b, sum, " - ", a.value_ - b.value_); }
  friend Formula operator*(const Formula& a, const Formula& b) {
    return joined(a, b, product, "*", a.value_ * b.value_);
  }
  friend Formula operator/(const Formula& a, const Formula& b) {
    return joined(a, b, product, "/", a.value_ / b.value_);
  }
  friend Formula operator-(const Formula& a) {
    return a.wrapped(a.binding_ == sum ? "-(" : "-", a.binding_ == sum ? ")" : "", -a.value_, product);
  }
  friend Formula floor(const Formula& a) { return a.wrapped("\u230a", "\u230b", std::floor(a.value_), single); }
  friend Formula ceil(const Formula& a) { return a.wrapped("\u2308", "\u2309", std::ceil(a.value_), single); }
  friend Formula round(const Formula& a) { return a.wrapped("round(", ")", std::round(a.value_), single); }
  friend Formula sqrt(const Formula& a) { return a.wrapped("sqrt(", ")", std::sqrt(a.value_), single); }
  friend double value_of(const Formula& a) { return a.value_; }

 private:
  enum Binding { sum, product, single };
  static Formula joined(const Formula& a, const Formula& b, Binding how, const std::string& sign, double result);
  Formula wrapped(const std::string& open, const std::string& close, double result, Binding how) const;
  void limit_length();

  double value_ = 0;
  std::string text_;
  std::vector<Operand> operands_;
  Binding binding_ = single;
};

struct Derivation {
  std::string_view field;  ///< of the event
  Formula formula;
};

/// Of each field that a formula gives, in the order in which they are given.
std::vector<Derivation> derivations_of(const Event& event, const formulas::Situation& before);

/// A number in a formula. It is one of the chain's own, or a plain one (a row, a size of the raster, an entry of a
/// matrix).
struct Operand {
  std::string symbol;  ///< letters, digits and _: as it stands in the formula
  double value = 0;
  std::int32_t link = -1;  ///< the link that tells where it comes from; -1 for a plain number
  std::string name;        ///< its name there
};

/// One number, and how it was made.
struct ChainValue {
  std::string name;  ///< "x_L"; of a condition, the condition's own name, with value 1 (true) or 0
  double value = 0;
  std::string formula;  ///< over the operands' symbols, "z_L + (z_R - z_L)*(x - x_L)/(x_R - x_L)"; empty: taken over
  std::vector<Operand> operands;
  bool exact = true;  ///< of zstep's own runs in float64 it gives the recorded bits; else but for rounding
  bool condition = false;
  std::string word;                                              ///< of a choice between words, the one: "front"
  std::string note;                                              ///< what no formula says, in a few words
  formulas::Tolerance tolerance{formulas::rounding_of_float64};  ///< that the trace's numbers are allowed
  std::string_view rounds{};  ///< what numbers are that the trace's format cannot hold: "rounded", "cut off"
};

/// A step of the run, or a datum of the scene, and the numbers of it that matter here.
struct ChainLink {
  std::int64_t step = 0;     ///< 0: the scene itself
  std::int32_t parent = -1;  ///< the link that asked for it; -1 for the first
  std::int32_t depth = 0;    ///< how many links lead to it
  std::string what;          ///< "depth at x = 9 on the span"
  std::vector<ChainValue> values;
  std::string source;  ///< "pyramid.obj:12", where the scene has lines
  bool given = false;  ///< a datum of the scene: its numbers are exact as they stand
};

/// The links in the order in which they are read: each right behind the one that asked for it, or behind what that one
/// had asked for before. The first value of the first link is the number that was asked about.
struct Chain {
  std::vector<ChainLink> links;
  bool cut = false;  ///< there was more than a chain may hold
};

/// With signs as they are printed: "z_L + (z_R − z_L)·(x − x_L)/(x_R − x_L)".
std::string formula_text(const ChainValue& value);
/// The same with numbers in the place of symbols, each with all the digits it needs.
std::string numbers_text(const ChainValue& value);
/// "z = z_L + … = 5 + … = 7"; "z = 7" where it was taken over.
std::string line_text(const ChainValue& value);
/// As many digits as it takes to read back the same bits; "true" and "false" of a condition.
std::string full_digits(double value);
std::string result_text(const ChainValue& value);

/// Is it what its one operand is?
bool is_taken_over(const ChainValue& value);
/// With a real minus sign for each hyphen.
std::string with_minus_signs(std::string text);

/// What the formula gives, in the order in which it is written: in the language of sim/classroom/expression.hpp, with
/// sqrt, abs, round, min and max.
double evaluate(const ChainValue& value);
/// The number with which line_text ends: the same, or what was taken over or is given.
double computed_value(const ChainValue& value);
/// Is that what was recorded, but for rounding?
bool holds(const ChainValue& value);
/// What is to be said where it is not: "The trace records 0.35, but this formula gives 0.3."; else nothing.
std::string doubt_text(const ChainValue& value);

}  // namespace zstep::answers
