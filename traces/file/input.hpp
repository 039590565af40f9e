// Files that are read: ordinary ones and nothing else, so that none is waited for and each of them has an end.
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

}  // namespace zstep
