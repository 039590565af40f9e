// Running zstep as a person does: a command line in, exit code and text out.
#pragma once

#include <sys/types.h>

#include <filesystem>
#include <string>
#include <vector>

#include "tests/folder.hpp"

namespace zstep::test {

struct Outcome {
  int code = -1;  ///< 128 + signal when it was killed
  std::string out, err;
};

/// Runs `zstep ARGUMENTS` in `folder`, without a display. The arguments are a shell's: pipes and quotes work.
Outcome run(const Folder& folder, const std::string& arguments);
/// Runs any shell line there; $zstep is the program.
Outcome shell(const Folder& folder, const std::string& line);

/// Starts it and does not wait, with Ctrl-C at its default, as a terminal does (a shell's background jobs ignore it).
/// What it says on standard error goes to the file `err`.
pid_t start(const Folder& folder, const std::vector<std::string>& arguments);

void write_text(const std::filesystem::path& path, const std::string& text);
/// Whether a part is in a text.
inline bool has(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }
/// How often `part` stands in `text`.
int times(const std::string& text, const std::string& part);

}  // namespace zstep::test
