// One small file by which a student's program writes its run: a function for each step, made from the vocabulary.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "traces/events/fields.hpp"
#include "traces/file/header.hpp"
#include "traces/record/recorder.hpp"

namespace zstep::homework {

// The fields of the steps that a program prints, as the vocabulary has them: emitters and the schema are made from it.

struct StepFields {
  std::string step, meaning;
  std::span<const FieldOfKind> fields;
};
StepFields fields_of_step(const StepInfo& step);

/// JSON Schema (draft 2020-12) of one line of a run that prints these steps: a step, or the header that may come first.
std::string run_schema(const std::vector<StepInfo>& steps);

enum class Language : std::uint8_t { c, python, javascript, java };

struct LanguageText {
  std::string_view name, file;  ///< "Python", "emit.py"
};
inline constexpr std::array<LanguageText, 4> languages{
    {{"C and C++", "emit.h"}, {"Python", "emit.py"}, {"JavaScript", "emit.js"}, {"Java", "Emit.java"}}};

/// The file: a function for each of these steps of a page, called by the step's name, with its fields in the order of
/// the vocabulary. It needs nothing but the language.
std::string emitter(Language language, const std::vector<StepInfo>& steps);

}  // namespace zstep::homework
