// What the makers of result formats ask of a result: the fields that there are, their types and words.
#pragma once

#include <string>

namespace zstep::test {

/// Gradescope's results.json: https://gradescope-autograders.readthedocs.io/en/latest/specs/
void check_gradescope(const std::string& text);
/// PrairieLearn's results.json: https://prairielearn.readthedocs.io/en/latest/externalGrading/
void check_prairielearn(const std::string& text);
/// JUnit's XML as far as it can be wrong here: its own tags alone, each closed, counted rightly.
void check_junit(const std::string& text);
/// A page that needs nothing from elsewhere, runs nothing, and can be read by a screen reader.
void check_page(const std::string& page);
/// Whichever of these it is, by its name on the command line; of "text" and "json" there are no rules but their own.
void check_result(const std::string& format, const std::string& text);

}  // namespace zstep::test
