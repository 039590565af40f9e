// The desktop's own dialogue for a file, where it has one.
#pragma once

#include <filesystem>
#include <string>
#include <thread>
#include <vector>

#include <sys/types.h>

namespace zstep::viewer {

/// A process that asks for a file. The file that is chosen comes to the window as one that is dropped on it does, and
/// where none is chosen nothing comes.
class FileDialogue {
 public:
  FileDialogue() = default;
  FileDialogue(const FileDialogue&) = delete;
  FileDialogue& operator=(const FileDialogue&) = delete;
  ~FileDialogue() { close(); }

  /// Opens it at a folder, unless it is open. False where the desktop has none: neither zenity nor kdialog is on PATH.
  bool ask(const std::filesystem::path& folder);
  /// Ends it, if it is open.
  void close();

 private:
  pid_t process_ = 0;
  std::thread waits_;
};

/// The program that asks for a file in this folder, with its arguments; empty where none is on PATH.
std::vector<std::string> dialogue_command(const std::filesystem::path& folder);

}  // namespace zstep::viewer
