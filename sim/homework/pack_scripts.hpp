// The scripts of the services, as text.
#pragma once

#include <string>

#include "sim/homework/homework.hpp"

namespace zstep::homework {

/// Debian's and Ubuntu's packages by which programs are run: bubblewrap, and what the command needs.
std::string packages_for(const std::string& command);

/// The file in a pack that is the result where the grader itself was stopped.
inline constexpr const char* stopped_file = "stopped.json";

std::string gradescope_setup(const Homework& homework);
std::string gradescope_run(const Homework& homework);
std::string prairielearn_dockerfile(const Homework& homework);
std::string prairielearn_run(const Homework& homework);
/// A question's info.json, whole but for the name of the image; its uuid follows from title and method, so that what is
/// packed once more is the same question.
std::string prairielearn_info(const Homework& homework);
/// What the question shows, the place to hand files in, and the results.
std::string prairielearn_question(const Homework& homework);
/// The scenes' points are whole numbers, as Classroom reads no others; their sum is that of the homework, rounded.
std::string github_workflow(const Homework& homework);

}  // namespace zstep::homework
