// A folder for a while, gone afterwards, whatever was put into it.
#pragma once

#include <filesystem>
#include <string>

namespace zstep::homework {

class TemporaryFolder {
 public:
  /// Where the system keeps what is temporary (TMPDIR), as NAME-XXXXXX. Throws InputError where none can be made there.
  explicit TemporaryFolder(const std::string& name);
  ~TemporaryFolder();
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;
  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

/// Removes a file, or a folder with all that is in it: links are not followed, and however deep folders are nested and
/// however long their names are, no more than two are open and no path has more than two names. False where something
/// is left.
bool remove_all_of(const std::filesystem::path& path);

}  // namespace zstep::homework
