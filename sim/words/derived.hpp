// The formula that a field must follow from, in symbols and in the numbers of the trace itself.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "sim/words/shown.hpp"
#include "traces/file/trace.hpp"
#include "traces/formulas/situation.hpp"

namespace zstep {

struct DerivedField {
  std::string_view field;
  words::Shown formula;
  std::optional<std::int32_t> within = {};  ///< of a whole number: what it is within the raster
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

/// The vertices and edges that a step is about, so that a person finds it in a program: "edge e3 (4–7)", "pixel (3,
/// 2)".
std::string subject_of(const Event& event, const formulas::Situation& at);

}  // namespace zstep
