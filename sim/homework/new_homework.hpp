// The folder of a new homework, and what in it is made from the rest.
#pragma once

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "sim/homework/homework.hpp"
#include "sim/homework/plain_scene.hpp"

namespace zstep::homework {

/// What is made from homework.toml and the scenes, where it is missing or no longer agrees with them: the scenes in
/// plain numbers, the files that write steps, in starter/ and solution/, the schema of a line, and the hand-out as a
/// page; and the hand-out and the starters without what they say of steps that are not asked for (asked_text.hpp). Each
/// with the text that it should have. Throws InputError where the hand-out's blocks are not as they must be.
std::vector<std::pair<std::filesystem::path, std::string>> made_files(const Homework& homework);
/// Writes these. Returns what it wrote, from the folder.
std::vector<std::string> refresh_homework(const std::filesystem::path& folder);

/// The methods that there is a homework of.
std::vector<std::string> homework_methods();

/// Fills a folder that is empty or not there yet: homework.toml, scenes as TOML and as plain numbers, hand-out,
/// starters, files to write steps with, and a solution apart. Returns what was written, from the folder. Throws
/// InputError, with nothing left behind, where there is no homework of this method or the folder holds something.
std::vector<std::string> new_homework(const std::string& method, const std::filesystem::path& folder);

}  // namespace zstep::homework
