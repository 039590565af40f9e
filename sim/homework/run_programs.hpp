// The programs of a submission, run on the scenes of a homework.
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "sim/homework/homework.hpp"

namespace zstep::homework {

struct ProgramRun {
  const Task* task = nullptr;
  Ended ended;
  std::filesystem::path file;  ///< what it printed
};

/// Runs the command, or the homework's own where it is empty, once for each scene in a copy of the folder `program`.
/// What it prints is SCENE.jsonl in the folder `runs`, which is made; how it ended, where it did not end well, is
/// SCENE.ended.txt; so is why it was not run. Throws InputError where there is no command or a folder is not as it must
/// be.
std::vector<ProgramRun> run_programs(const Homework& homework, const std::string& command,
                                     const std::filesystem::path& program, const std::filesystem::path& runs,
                                     const std::function<void(const Task&)>& on_task);

/// What is noted of the program beside its run: "The program was stopped after 10 s of processor time." Of a run that
/// may not be shown its first line alone. Empty where nothing is.
std::string how_it_ended(const std::filesystem::path& run, bool hidden);

/// The command that compiles and runs a source file, by its name: "python3 zbuffer.py"; none where it is no program.
struct SourceCommand {
  std::string tool, command;  ///< the tool that must be there, "python3"
};
std::optional<SourceCommand> command_of_source(const std::filesystem::path& source);

}  // namespace zstep::homework
