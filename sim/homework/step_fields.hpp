// The fields of the steps that a program prints, as the vocabulary has them: emitters and the schema are made from it.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "traces/file/header.hpp"

namespace zstep::homework {

enum class FieldType : std::uint8_t { whole, real, truth, word };
struct StepField {
  std::string name;
  FieldType type;
  std::string meaning;
  std::vector<std::string> words;  ///< that it may be, where it is one
};
struct StepFields {
  std::string step, meaning;
  std::vector<StepField> fields;
};
StepFields fields_of_step(const StepInfo& step);

/// JSON Schema (draft 2020-12) of one line of a run that prints these steps: a step, or the header that may come first.
std::string run_schema(const std::vector<StepInfo>& steps);

}  // namespace zstep::homework
