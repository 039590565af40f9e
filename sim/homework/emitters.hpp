// One small file by which a program writes its run: a function for each step, made from the vocabulary.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
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

enum class Language : std::uint8_t { c, python, javascript, java, cpp, rust };
inline constexpr std::size_t homework_languages = 4;  ///< the first so many: what a homework's students write in

struct LanguageText {
  std::string_view id, name, extension;  ///< "python", "Python", "py"
};
inline constexpr std::array<LanguageText, 6> languages{{{"c", "C and C++", "h"},
                                                        {"python", "Python", "py"},
                                                        {"js", "JavaScript", "js"},
                                                        {"java", "Java", "java"},
                                                        {"cpp", "C++", "hpp"},
                                                        {"rust", "Rust", "rs"}}};
/// "emit.py", "Emit.java".
std::string emitter_file(Language language, std::string_view name);

/// A file by which a program writes its run: a function for each of these steps of a page, called by the step's name,
/// with its fields in the order of the vocabulary, and with the place that calls it. It needs nothing but the language.
/// `header`: with a function that writes a run's first line, from a file, or where it is not empty, this line. `name`
/// is what the file and all in it are called.
std::string emitter(Language language, const std::vector<StepInfo>& steps,
                    const std::optional<std::string>& header = {}, std::string_view name = "emit");

}  // namespace zstep::homework
