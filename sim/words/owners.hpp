// Whose the numbers of a formula are: a polygon's plane, its vertices, its depth. The formulas know it from where their
// operands stand.
#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

#include "sim/words/notation.hpp"
#include "traces/formulas/situation.hpp"

namespace zstep::words {

/// The polygon that an operand belongs to; no_polygon for what is no polygon's or of several alike.
std::int32_t owner_of(const formulas::Situation& at, const formulas::Place& place, std::string_view name);

/// Adds one; a symbol that stands for numbers of two polygons belongs to neither.
void add_owned(std::vector<Owned>& owned, const Owned& one);
/// The polygons that own something, each once, in the order of their first number.
std::vector<std::int32_t> owners_in(const std::vector<Owned>& owned);

/// Sets the polygon of each symbol, and of the numbers that stand for it: in the next side at the same place, behind a
/// colon in the same order, right behind the equals sign, and of what the first symbol is found to be at the end.
void mark_owned(std::vector<Notation>& sides, const std::vector<Owned>& owned);

}  // namespace zstep::words
