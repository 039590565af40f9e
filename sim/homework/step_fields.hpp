// The fields of the steps that a program prints, as the vocabulary has them: emitters and the schema are made from it.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "traces/events/fields.hpp"
#include "traces/file/header.hpp"

namespace zstep::homework {

struct StepFields {
  std::string step, meaning;
  std::span<const FieldOfKind> fields;
};
StepFields fields_of_step(const StepInfo& step);

/// JSON Schema (draft 2020-12) of one line of a run that prints these steps: a step, or the header that may come first.
std::string run_schema(const std::vector<StepInfo>& steps);

}  // namespace zstep::homework
