// The folder of a new homework, and what in it is made from the rest.
#pragma once

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "sim/homework/homework.hpp"

namespace zstep::homework {

/// A scene as programs read it: width and height, the points, each polygon as the number of its vertices and these, and
/// the colours, for programs that draw: of the background and of each polygon. Then, of a scene in space, the rays
/// through the pixels' centres: X_0 of pixel (0, 0), its change by a column and by a row, the same of dX, and the least
/// and the greatest t. For a method that draws surfaces: width and height, how many rows of how many samples, the
/// points of these, T_v, d (0 in parallel projection), half the height of the window, near and far.
std::string plain_numbers(const Method& method, const Scene& scene);
/// What is made from homework.toml and the scenes, where it is missing or no longer agrees with them: the scenes in
/// plain numbers, the files that write steps, in starter/ and solution/, and the schema of a line; each with the text
/// that it should have.
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
