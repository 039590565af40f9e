// Folders that are made whole or not at all.
#pragma once

#include <filesystem>

namespace zstep::homework {

/// An empty folder, .NAME.part, beside the one that it becomes. It is gone when this goes; what a run left there that
/// was killed gives way to the next one's. Its name is no student's, as those do not begin with a dot.
class UnfinishedFolder {
 public:
  explicit UnfinishedFolder(const std::filesystem::path& becomes);
  ~UnfinishedFolder();
  UnfinishedFolder(const UnfinishedFolder&) = delete;
  UnfinishedFolder& operator=(const UnfinishedFolder&) = delete;

  const std::filesystem::path& path() const { return path_; }
  /// Gives it its name. An empty folder of that name gives way. Throws filesystem_error.
  void finish();

 private:
  std::filesystem::path becomes_, path_;
};

}  // namespace zstep::homework
