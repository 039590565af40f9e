// A homework as the services take it that courses use: what they run, and the program in it.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "sim/homework/homework.hpp"

namespace zstep::homework {

// This very program as it can be carried to another machine.

/// Makes the folder `to`: zstep, a script that starts it, with it and all the libraries that it has loaded, down to the
/// C library. It runs on every Linux of the same kind of processor. Throws InputError on other systems.
void carry_program(const std::filesystem::path& to);

// The scripts of the services, as text.

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

enum class Service : std::uint8_t { gradescope, prairielearn, github };

/// Makes the autograder's zip file, or the folder of the other services, which is new: the homework without its
/// solution, this zstep with the libraries that it needs, and the service's scripts. Returns what there is to say of
/// it. Throws InputError, with nothing left behind, where it cannot be made.
std::vector<std::string> pack_homework(const std::filesystem::path& folder, Service service,
                                       const std::filesystem::path& out);

}  // namespace zstep::homework
