// The folder of a new homework.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace zstep::homework {

/// The methods that there is a homework of.
std::vector<std::string> homework_methods();

/// Fills a folder that is empty or not there yet: homework.toml, scenes as TOML and as plain numbers, hand-out,
/// starters, files to write steps with, and a solution apart. Returns what was written, from the folder. Throws
/// InputError, with nothing left behind, where there is no homework of this method or the folder holds something.
std::vector<std::string> new_homework(const std::string& method, const std::filesystem::path& folder);

}  // namespace zstep::homework
