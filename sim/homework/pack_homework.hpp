// A homework as the services take it that courses use.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace zstep::homework {

enum class Service : std::uint8_t { gradescope, prairielearn, github };

/// Makes the autograder's zip file, or the folder of the other services, which is new: the homework without its
/// solution, this zstep with the libraries that it needs, and the service's scripts. Returns what there is to say of
/// it. Throws InputError, with nothing left behind, where it cannot be made.
std::vector<std::string> pack_homework(const std::filesystem::path& folder, Service service,
                                       const std::filesystem::path& out);

}  // namespace zstep::homework
