// zstep homework: its commands, and the folder of each student with scenes of the student's own.
#pragma once

#include <string>

namespace zstep::cli {

/// `names`: the file with the students' names; `seed`: what the key is made from, where the homework has none yet and
/// it is not left to chance. Returns the exit code.
int seed_homework(const std::string& folder, const std::string& names, const std::string& out, const std::string& seed);

}  // namespace zstep::cli
