// The folder that a walled-in program sees, and how its process begins.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "sim/homework/sandbox.hpp"
#include "sim/homework/temporary_folder.hpp"

namespace zstep::homework {

/// A folder with a copy of the program, the one scene and room to write; gone with it.
class Stage {
 public:
  Stage(const std::filesystem::path& program, const std::string& name, const std::string& scene, const Limits& limits);

  /// The words of the process that runs the command: bubblewrap's, or a shell's.
  std::vector<std::string> words(const std::string& command, bool walls, const Limits& limits) const;
  std::vector<std::string> environment(bool walls) const;
  /// Where it begins.
  const std::filesystem::path& folder(bool walls) const { return walls ? folder_.path() : program_; }
  /// Where it may write, without walls.
  const std::filesystem::path& scratch() const { return scratch_; }
  /// All of it.
  const std::filesystem::path& whole() const { return folder_.path(); }

 private:
  TemporaryFolder folder_;
  std::filesystem::path program_, scene_, scratch_;
  std::string name_;
};

/// The user whom programs run as where zstep runs as root: one who has no name, owns nothing, and is this process's
/// alone, so that what they start, take and leave behind is known for theirs. None where zstep runs as somebody else,
/// or as the root of a container that has no other user: then they run as who zstep runs as.
std::optional<unsigned> program_user();

}  // namespace zstep::homework
