// Files that are written: never over what was read, never two at a time, never waiting for a pipe that nobody reads.
#pragma once

#include <cstdio>
#include <filesystem>
#include <memory>

namespace zstep {

/// Remembers a file that was read, or that one which was read names: nothing is written over it from now on, under
/// whatever name.
void note_input(const std::filesystem::path& path);

/// Throws InputError where writing to `path` would replace such a file, or one that a recording is writing at the
/// moment.
void check_replaceable(const std::filesystem::path& path);

/// Where a link leads, so that the file is replaced and not the link.
std::filesystem::path where_it_leads(const std::filesystem::path& path);

struct CloseFile {
  void operator()(std::FILE* file) const { std::fclose(file); }
};
using OpenFile = std::unique_ptr<std::FILE, CloseFile>;

/// Opens for writing from the beginning; null, with the reason in errno, where that cannot be. Throws InputError for a
/// pipe without a reader, which would wait for one.
OpenFile open_output(const std::filesystem::path& path);
/// The same for a recording: it is this process's until it is closed. Throws InputError where another one records to
/// it.
OpenFile open_own_output(const std::filesystem::path& path);

/// A file that is not yet what it will be: gone when this goes, unless it has another name by then.
class Unfinished {
 public:
  explicit Unfinished(std::filesystem::path path);
  ~Unfinished();
  Unfinished(const Unfinished&) = delete;
  Unfinished& operator=(const Unfinished&) = delete;
  const std::filesystem::path& path() const { return path_; }
  /// All that there are at the moment, for who ends the program.
  static void remove_all();

 private:
  std::filesystem::path path_;
};

/// Throws what an errno means to who wanted to write there: Exhausted for a disk that is full, else InputError.
[[noreturn]] void output_failed(const std::filesystem::path& path, int error);

}  // namespace zstep
