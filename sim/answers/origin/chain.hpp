// The chain behind a number: every step, and at last every line of the mesh file, that it comes from.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "sim/answers/origin/formula.hpp"
#include "traces/formulas/rounding.hpp"

namespace zstep::answers {

// What the fields of an event follow from, by the formulas of traces/formulas.

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
