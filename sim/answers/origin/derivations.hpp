// What the fields of an event follow from, by the formulas of traces/formulas.
#pragma once

#include <string_view>
#include <vector>

#include "sim/answers/origin/formula.hpp"

namespace zstep::answers {

struct Derivation {
  std::string_view field;  ///< of the event
  Formula formula;
};

/// Of each field that a formula gives, in the order in which they are given.
std::vector<Derivation> derivations_of(const Event& event, const formulas::Situation& before);

}  // namespace zstep::answers
