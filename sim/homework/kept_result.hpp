// What a batch keeps of each submission, as a JSON file: a key, which changes with what was graded, and the report.
#pragma once

#include <filesystem>
#include <string>

#include "sim/homework/batch.hpp"

namespace zstep::homework {

/// A name as that of a file: letters, digits and a few signs stay, others become %XX; what is too long is cut, and
/// ends in a number of its own.
std::string file_name_of(const std::string& name);

void keep(const std::filesystem::path& path, const std::string& key, const std::string& report,
          const std::vector<OwnRun>& own);
void keep_refused(const std::filesystem::path& path, const std::string& key, const std::string& why);

/// Whether a result with this key is there, and whole.
bool is_kept(const std::filesystem::path& path, const std::string& key);

/// Of so many scenes. Throws InputError where it cannot be read.
Result read_kept(const std::filesystem::path& path, const std::string& name, const Homework& homework,
                 std::size_t scenes);

}  // namespace zstep::homework
