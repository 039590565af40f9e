// The formula that a field must follow from, in symbols and in the numbers of the trace itself, and the number that
// remembers how it was made, which it is evaluated with.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "sim/words/notation.hpp"
#include "traces/file/trace.hpp"
#include "traces/formulas/rounding.hpp"
#include "traces/formulas/situation.hpp"

namespace zstep::words {

// A number that remembers how it was made, in symbols and in numbers: what the formulas of traces/formulas are
// evaluated with where a person reads them. So what is printed, what it gives and how far rounding may be in it cannot
// part.

class Shown {
 public:
  /// A number under a name: x_0. `text` where it is not to be written as number() does.
  Shown(std::string symbol, double value);
  Shown(std::string symbol, double value, std::string text);
  /// A number that has no name: 1, 255.
  explicit Shown(double plain);
  /// The same as a number of this polygon.
  Shown of(std::int32_t polygon) const;

  double value() const { return rounded_.value; }
  const formulas::Rounded& rounded() const { return rounded_; }
  const std::string& symbols() const { return symbols_; }  ///< "p_0 + (p_1 − p_0)(t − t_0)/(t_1 − t_0)"
  const std::string& numbers() const {
    return numbers_;
  }  ///< the same with numbers, where they differ with the digits that tell them apart
  /// Whose the numbers in it are.
  const std::vector<Owned>& owned() const { return owned_; }
  /// A number as it stands, and nothing computed.
  bool is_operand() const { return leaf_; }
  /// 0, without a name.
  bool is_zero() const { return leaf_ && symbols_ == "0"; }
  /// "symbols = numbers"; the numbers alone where nothing has a name, or nothing is computed.
  std::string equation() const;

  /// A plain 0 is left out, and what it is a factor of.
  friend Shown operator+(const Shown& a, const Shown& b) {
    if (a.is_zero() || b.is_zero()) return a.is_zero() ? b : a;
    return joined(a, b, Binding::sum, " + ", a.rounded_ + b.rounded_);
  }
  friend Shown operator-(const Shown& a, const Shown& b);
  friend Shown operator*(const Shown& a, const Shown& b) {
    if (a.is_zero()) return a;
    return joined(a, b, Binding::product, "\u00b7", a.rounded_ * b.rounded_);
  }
  friend Shown operator/(const Shown& a, const Shown& b) {
    return joined(a, b, Binding::product, "/", a.rounded_ / b.rounded_);
  }
  friend Shown operator-(const Shown& a);
  /// What lies just beside a whole number does not look like it in these: which pixel comes next hangs on that.
  friend Shown floor(const Shown& a) { return bracketed(a, "\u230a", "\u230b", floor(a.rounded_)); }
  friend Shown ceil(const Shown& a) { return bracketed(a, "\u2308", "\u2309", ceil(a.rounded_)); }

 private:
  enum class Binding { sum, product, single };
  static Shown joined(const Shown& a, const Shown& b, Binding how, const char* sign, formulas::Rounded result);
  static Shown bracketed(const Shown& a, const char* open, const char* close, formulas::Rounded result);

  formulas::Rounded rounded_;
  std::string symbols_, numbers_;
  std::vector<Owned> owned_;
  Binding binding_ = Binding::single;
  bool leaf_ = true;
};

}  // namespace zstep::words

namespace zstep {

struct DerivedField {
  std::string_view field;
  words::Shown formula;
  std::optional<std::int32_t> within = {};  ///< of a whole number: what it is within the raster
  std::optional<double> off = {};           ///< by how much any sensible way of computing it may be off
};
/// Each field for which a formula gives a number.
std::vector<DerivedField> derived_fields(const Event& event, const formulas::Situation& at);

/// A field's formula beside what is recorded.
struct FormulaText {
  std::string text;  ///< "z_L + (z_R − z_L)(x − x_L)/(x_R − x_L) = 0.5 + (0.7 − 0.5)(4 − 2)/(6 − 2) = 0.6"
  bool follows;      ///< the recorded number follows from it, but for rounding
  bool compares;     ///< it is a compare, and ends in true or false
};
/// Its result has the digits that tell it from the recorded number. Nothing where no formula gives the field, or the
/// trace does not have what it needs.
std::optional<FormulaText> derived_formula(const Event& event, const formulas::Situation& at, const std::string& field);

/// The same of the depth at a pixel, as the scene has it there.
std::optional<FormulaText> formula_of_scene(const Event& event, const formulas::Situation& at);

/// The vertices and edges that a step is about, so that a person finds it in a program: "edge e3 (4–7)", "pixel (3,
/// 2)".
std::string subject_of(const Event& event, const formulas::Situation& at);

}  // namespace zstep
