// All that stays from run to run in one file, which a reader can carry to another computer or browser: settings, how
// far lessons were read, and their bookmarks.
//
//     # zstep: settings, progress and bookmarks
//     [viewer.ini]
//     dark = 1
//     lesson z-buffer = 4
//     [lessons/z-buffer.marks]
//     219 the first tie
//
// Below a name in brackets stands what the file of that name in kept_folder() says.
#pragma once

#include <filesystem>
#include <string>

#include "sim/viewer/settings.hpp"

namespace zstep::viewer {

/// Its name where it is saved, and how the name of one ends.
constexpr const char* progress_file_name = "zstep-progress.ini";
bool is_progress_file(const std::string& path);

/// What the folder keeps, in this form.
std::string progress_text(const std::filesystem::path& folder);

/// Takes over what such a file says: its settings, of each lesson and each trace the place that is further, and the
/// bookmarks whose names are not there yet, which are written to `folder`. Returns what the settings are then. Throws
/// InputError, and has changed nothing, where the file is none or what is kept cannot be read.
Settings take_progress(const std::filesystem::path& file, const std::filesystem::path& folder, const Settings& here);

}  // namespace zstep::viewer
