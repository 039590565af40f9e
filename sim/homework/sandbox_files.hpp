// What the programs of a user write where everybody may: counted while they run, removed after them.
#pragma once

#include <filesystem>
#include <optional>

#include "sim/homework/sandbox.hpp"

namespace zstep::homework {

/// Files and folders of a program may be nested so deep, and there may be so many of them.
inline constexpr int most_files = 10000, deepest_folders = 200;

/// Whether a user has more in a folder, and in those where everybody may write (/tmp, /dev/shm …), than `limits` allow.
/// Without a user of their own, programs are looked for in the folder alone.
bool writes_too_much(std::optional<unsigned> user, const std::filesystem::path& folder, const Limits& limits);
/// Removes what a user has where everybody may write.
void remove_files_of(unsigned user);

}  // namespace zstep::homework
