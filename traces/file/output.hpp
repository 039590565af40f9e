// Files that are written: never over what was read, never two at a time, never through what others put in the way,
// never waiting for a pipe that nobody reads.
#pragma once

#include <filesystem>
#include <string>

#include "traces/file/input.hpp"

namespace zstep {

/// Remembers a file that was read, or that one which was read names: nothing is written over it from now on, under
/// whatever name.
void note_input(const std::filesystem::path& path);

/// Whether a place keeps what was read from being written over. Only what is zstep's own to read and to write again
/// (bookmarks, settings) is no input.
enum class Inputs { kept, no_matter };

/// A link in the place of an output: the file that it leads to is replaced, as it is asked for when the place is made
/// and not later; or the link itself is, as for traces, which others may be reading where it leads.
enum class Links { followed, replaced };

/// Where a file is to be written: a name in a folder that is held open. Whatever has the name when the new file is
/// whole is replaced, and never written through.
class OutputPlace {
 public:
  /// Throws InputError where there is no such folder, or `path` is one, or is a file that may not be written to, or may
  /// not be replaced.
  explicit OutputPlace(const std::filesystem::path& path, Inputs inputs = Inputs::kept, Links links = Links::followed);
  ~OutputPlace();
  OutputPlace(const OutputPlace&) = delete;
  OutputPlace& operator=(const OutputPlace&) = delete;

  const std::filesystem::path& path() const { return path_; }
  /// A device or a pipe, which is written to as it stands. Everything else gets a new file.
  bool is_device() const { return device_; }
  OpenFile open_device() const;  ///< Throws InputError for a pipe without a reader, which would wait for one.

  /// A new file in the folder, to be put in this place once it is whole.
  OpenFile make(const std::string& name) const;
  /// The same for a recording: it is this process's until it is closed, and one that was left behind is taken over.
  /// Throws InputError where another process has it.
  OpenFile make_own(const std::string& name) const;
  /// Puts the file `name` of the folder in this place. Throws InputError where that would replace an input or a
  /// recording that goes on.
  void take(const std::string& name) const;
  /// Of a file of the folder.
  std::filesystem::path beside(const std::string& name) const { return path_.parent_path() / name; }

 private:
  struct Found;
  Found look() const;
  void check_replaceable() const;
  std::filesystem::path path_;
  std::string shown_, name_;
  Inputs inputs_;
  bool device_ = false;
  int folder_ = -1;
};

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
