// The folder that a walled-in program sees, and how its process begins.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "sim/homework/sandbox.hpp"

namespace zstep::homework {

/// A folder with a copy of the program, the one scene and room to write; gone with it.
class Stage {
 public:
  Stage(const std::filesystem::path& program, const std::string& name, const std::string& scene, const Limits& limits);
  ~Stage();
  Stage(const Stage&) = delete;
  Stage& operator=(const Stage&) = delete;

  /// The words of the process that runs the command: bubblewrap's, or a shell's.
  std::vector<std::string> words(const std::string& command, bool walls, const Limits& limits) const;
  std::vector<std::string> environment(bool walls) const;
  /// Where it begins.
  const std::filesystem::path& folder(bool walls) const { return walls ? folder_ : program_; }

 private:
  std::filesystem::path folder_, program_, scene_, scratch_;
  std::string name_;
};

/// The user whom programs run as where zstep runs as root: nobody, who owns nothing.
inline constexpr unsigned nobody = 65534;
/// Whether they are: zstep runs as root, and not as the root of a container that has no other user.
bool runs_as_nobody();

}  // namespace zstep::homework
