// Files that are read (ordinary ones and nothing else, so that none is waited for) and files that are written (never
// over what was read, never two at a time).
#pragma once

#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <istream>
#include <memory>
#include <streambuf>
#include <string>
#include <string_view>
#include <vector>

namespace zstep {

struct CloseFile {
  void operator()(std::FILE* file) const { std::fclose(file); }
};
using OpenFile = std::unique_ptr<std::FILE, CloseFile>;

inline constexpr std::string_view mend_unreadable = "check its name and that it may be read";

/// An ordinary file, open. That it is one is asked of what was opened, without waiting, so nothing can be put in its
/// place between the question and the reading.
class InputFile {
 public:
  /// Throws InputError for what is not there, may not be read or is no ordinary file: a folder, a pipe, a device.
  /// `mend` ends its line.
  explicit InputFile(const std::filesystem::path& path, std::string_view mend = mend_unreadable);
  /// What stands at standard input, a pipe too: who asks for it knows who writes there.
  static InputFile standard_input();

  const std::string& name() const { return name_; }
  std::uint64_t size() const { return size_; }  ///< bytes, when it was opened
  void seek(std::uint64_t offset);
  /// The next `count` bytes, fewer at its end alone. Throws InputError where the disk, or the system, cannot give them.
  std::size_t read(void* to, std::size_t count);

 private:
  InputFile() = default;
  std::string name_;
  OpenFile file_;
  std::uint64_t size_ = 0;
};

/// An InputFile for who reads streams. What it throws comes through the stream's functions.
class InputStream : public std::istream {
 public:
  explicit InputStream(InputFile file) : std::istream(nullptr), buffer_(std::move(file)) {
    rdbuf(&buffer_);
    exceptions(std::ios::badbit);
  }

 private:
  class Buffer : public std::streambuf {
   public:
    explicit Buffer(InputFile file) : file_(std::move(file)), piece_(std::size_t{1} << 16) {}

   private:
    int_type underflow() override;
    InputFile file_;
    std::vector<char> piece_;
  };
  Buffer buffer_;
};

/// The whole of a file. Throws InputError as InputFile does, and for more than `limit` bytes, of which none are read
/// where the file tells its size. `mend_large` ends that line. As a std::string or a std::vector<std::uint8_t>.
template <class Bytes = std::string>
Bytes read_whole(const std::filesystem::path& path, std::uintmax_t limit, std::string_view mend = mend_unreadable,
                 std::string_view mend_large = "give a smaller file");
extern template std::string read_whole(const std::filesystem::path&, std::uintmax_t, std::string_view,
                                       std::string_view);
extern template std::vector<std::uint8_t> read_whole(const std::filesystem::path&, std::uintmax_t, std::string_view,
                                                     std::string_view);

// Files that are written: never over what was read, never two at a time, never through what others put in the way,
// never waiting for a pipe that nobody reads.

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
