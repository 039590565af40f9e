// The files that a hand-out names.
#pragma once

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

namespace zstep::homework {

/// Of the files and folders that a page names in its commands and code spans, those that are neither in the homework's
/// folder nor in its starter/, each with its line. Runs and pictures are left out: students make them.
std::vector<std::pair<int, std::string>> missing_in_handout(const std::string& page,
                                                            const std::filesystem::path& folder);

}  // namespace zstep::homework
