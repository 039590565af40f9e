// What `zstep check` and `zstep diff` say of a step, on the command line and in the window, and where it comes from:
// its line of a file, and the place in the program's source.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "traces/check/check.hpp"
#include "traces/diff/diff.hpp"
#include "traces/file/trace.hpp"
#include "traces/mistakes/name.hpp"

namespace zstep {

/// What is said of a fault beside its numbers.
struct FaultText {
  std::string subject;    ///< "edge e1 (1–2)"
  std::string formula{};  ///< that the wrong field should follow from; may be empty
  bool compares = false;  ///< that formula is a compare
  std::string detail{};   ///< of a rule about pixels of the scene: where the pixel lies; may be empty
};
/// Made from the state before the step, which is gone later.
FaultText fault_text(const Fault& fault, const Event& event, const formulas::Situation& before);
/// What is wrong, in one line: "dx_dy = (x_1 − x_0)/(y_1 − y_0) = … = 1.5, but the trace has 1.25".
std::string what_is_wrong(const Fault& fault, const FaultText& text);
/// "1 later step has the same fault; 30 steps follow from it"; may be empty.
std::string what_follows(const Cause& cause);
/// "insert_edge, edge e1 (1–2)".
std::string step_and_subject(const Trace& trace, std::uint8_t line, const std::string& subject);

/// A run that was checked, with its words and what a window marks.
struct CheckedRun {
  CheckReport report;
  std::vector<FaultText> texts;  ///< by cause
  std::string impossible;        ///< why the step that would come next cannot be; the run is judged up to it
  CheckMarks marks;
  mistakes::Diagnosis likely;
};
/// "Likely: Two of the three weights are exchanged.", what to ask oneself, and where that is taught; a line each. Of
/// several mistakes that a run does not tell apart their names.
std::vector<std::string> likely_in_words(const mistakes::Diagnosis& likely);
/// What nothing in the run says whether it is right, a line each: "compare: z (of 12 of its 58 steps)".
std::vector<std::string> not_judged_in_words(const Trace& trace, const CheckReport& report);
/// "Nothing is wrong."
std::string verdict_in_words(const CheckReport& report);
CheckedRun judge_run(const Trace& trace, const OnChecked& on_checked, bool with_marks);

/// Why a step at which two runs part is a cause.
std::string why_cause(const diff::Cause& cause);
/// "At pixel (3, 4) z is 0.25 here and 0.5 there, and what is drawn last is seen."
std::string why_too_early(const diff::TooEarly& order);
/// "28 later steps differ likewise; 3 differences follow from it"; may be empty.
std::string what_follows(const diff::Cause& cause);
/// What a step has in a field, and what that should follow from.
struct FieldText {
  std::string name, value;  ///< "dx_dy", "1.5"; no name for what is said of a whole step
  std::string formula;      ///< "(x_1 − x_0)/(y_1 − y_0) = … = 1.5"; may be empty
  bool follows = true;      ///< the value does follow from it
  /// "from", or where it does not follow, "by its formula:".
  std::string_view origin() const { return follows ? "from" : "by its formula:"; }
  std::string line() const;
};
std::vector<FieldText> fields_in_words(const Event& event, const formulas::Situation& before, std::uint16_t fields);
/// The same in lines: "dx_dy = 1.5   from (x_1 − x_0)/(y_1 − y_0) = … = 1.5"; of a number that does not follow:
/// "dx_dy = 1.25   by its formula: … = 1.5".
std::vector<std::string> field_texts(const Event& event, const formulas::Situation& before, std::uint16_t fields);

/// "printed at raster.cpp:417": the place in the program's source; empty where the run does not say.
std::string printed_at(const Trace& trace, std::int64_t step);
/// "run.jsonl:12" for step 11, or "run.ztrace, step 11", and where it was printed.
std::string place_of_step(const Trace& trace, std::int64_t step);

}  // namespace zstep
