// What a submission earned, for people and in the formats that courses read.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "sim/homework/assess.hpp"

namespace zstep::homework {

/// For a student: what works, where the first thing goes wrong, and how the points come about. `command` opens the
/// viewer on a task: "zstep grade … --scene one --view".
std::string report_text(const Assessment& assessment, const std::string& command);
/// The same as one page that opens from disk, with the pictures of the scene of the first wrong step. `steps_page`:
/// what shows both runs from there on, as a link names it; empty where there is none.
std::string report_html(const Assessment& assessment, const std::string& command, const std::string& steps_page = "");
/// What the link to it says; a report without it leads to no such page.
inline constexpr std::string_view steps_link = "Step through both runs from here";
/// All of it as one JSON object.
std::string report_json(const Assessment& assessment);
/// Gradescope's results.json: https://gradescope-autograders.readthedocs.io/en/latest/specs/
std::string report_gradescope(const Assessment& assessment, double seconds);
/// PrairieLearn's results.json: https://prairielearn.readthedocs.io/en/latest/externalGrading/
std::string report_prairielearn(const Assessment& assessment);
/// A test suite with a test case for each part of each task.
std::string report_junit(const Assessment& assessment);

}  // namespace zstep::homework
