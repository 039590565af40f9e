// Expressions against a run: checked before it, evaluated at a moment of it.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "sim/classroom/expression.hpp"
#include "sim/classroom/names.hpp"
#include "traces/record/recorder.hpp"

namespace zstep::classroom {

/// Checks every name of an expression against the vocabulary and returns its type. `kind` is the event's kind, or
/// no_kind where no step is spoken of. Throws InputError: an unknown name, a word that the field never takes, a number
/// used as a truth.
inline constexpr std::uint8_t no_kind = 255;
Quantity::Type check(const Expression& expression, std::uint8_t kind, const Page& page, std::string_view where);

/// Evaluates a checked expression. Throws InputError where the run has no such thing at that moment.
/// Equality is to 1e-9 of the larger number (of 1 at least): what lessons ask about is arithmetic, not its last bit.
Quantity evaluate(const Expression& expression, const Moment& moment);
bool holds(const Expression& condition, const Moment& moment);
bool same_number(double a, double b);

/// The step of a page by name; throws InputError naming those there are.
const StepInfo& require_step(const Page& page, std::string_view name, std::string_view where);

/// "clip_tset" -> "; did you mean clip_test?" when one of the candidates is close, else empty.
std::string did_you_mean(std::string_view written, const std::vector<std::string_view>& candidates);
/// The candidates, those that are written most like it first, "x, y, z"; of many "x, y, z, … (40 in all)".
std::string nearest_first(std::string_view written, std::vector<std::string_view> candidates);

}  // namespace zstep::classroom
