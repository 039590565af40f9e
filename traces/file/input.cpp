#include "traces/file/input.hpp"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <system_error>

#include <fmt/format.h>

#if __has_include(<sys/stat.h>) && !defined(_WIN32)
#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>
#define ZSTEP_OPENS_WITHOUT_WAITING
#endif

#include "traces/error.hpp"

namespace zstep {

namespace {

namespace fs = std::filesystem;

[[noreturn]] void cannot_open(const std::string& name, int error, std::string_view mend) {
  if (error == ENOENT || error == ENOTDIR) throw InputError(name, "there is no such file", mend);
  throw InputError(name, fmt::format("cannot be opened: {}", std::strerror(error)), mend);
}

void check_kind(const std::string& name, fs::file_type type) {
  if (type == fs::file_type::directory) throw InputError(name, "is a folder", "name a file in it");
  if (type == fs::file_type::fifo)
    throw InputError(name, "is a pipe, which may never end", "write what comes out of it to a file, and name that");
  if (type != fs::file_type::regular) throw InputError(name, "is no ordinary file", "name a file, not a device");
}

/// "512 bytes", "64 MiB".
std::string size_text(std::uintmax_t bytes) {
  constexpr std::uintmax_t mib = std::uintmax_t{1} << 20;
  return bytes < mib ? fmt::format("{} bytes", bytes)
                     : fmt::format("{:.4g} MiB", static_cast<double>(bytes) / static_cast<double>(mib));
}

}  // namespace

InputFile::InputFile(const fs::path& path, std::string_view mend) : name_(path.string()) {
#ifdef ZSTEP_OPENS_WITHOUT_WAITING
  const int file = ::open(path.c_str(), O_RDONLY | O_NONBLOCK | O_NOCTTY | O_CLOEXEC);
  if (file < 0) {
    // A socket cannot be opened at all; what it is says more than why not.
    std::error_code ignored;
    const int error = errno;
    if (const fs::file_type type = fs::status(path, ignored).type(); type == fs::file_type::socket)
      check_kind(name_, type);
    cannot_open(name_, error, mend);
  }
  file_.reset(fdopen(file, "rb"));
  struct stat status {};
  if (!file_ || fstat(file, &status) != 0) cannot_open(name_, errno, mend);
  check_kind(name_, S_ISREG(status.st_mode)    ? fs::file_type::regular
                    : S_ISDIR(status.st_mode)  ? fs::file_type::directory
                    : S_ISFIFO(status.st_mode) ? fs::file_type::fifo
                                               : fs::file_type::unknown);
  size_ = static_cast<std::uint64_t>(status.st_size);
#else
  std::error_code error;
  const fs::file_type type = fs::status(path, error).type();
  if (type == fs::file_type::not_found) cannot_open(name_, ENOENT, mend);
  check_kind(name_, type);
  file_.reset(std::fopen(name_.c_str(), "rb"));
  if (!file_) cannot_open(name_, errno, mend);
  size_ = fs::file_size(path, error);
#endif
}

InputFile InputFile::standard_input() {
  InputFile input;
  input.name_ = "standard input";
#ifdef ZSTEP_OPENS_WITHOUT_WAITING
  const int file = dup(STDIN_FILENO);
  if (file >= 0) input.file_.reset(fdopen(file, "rb"));
  struct stat status {};
  if (!input.file_ || fstat(file, &status) != 0)
    cannot_open(input.name_, errno, "redirect a file or a program's output to it");
  if (S_ISDIR(status.st_mode)) check_kind(input.name_, fs::file_type::directory);
#else
  input.file_.reset(std::fopen("/dev/stdin", "rb"));
  if (!input.file_) cannot_open(input.name_, errno, "name a file");
#endif
  return input;
}

void InputFile::seek(std::uint64_t offset) {
#ifdef ZSTEP_OPENS_WITHOUT_WAITING
  const int failed = fseeko(file_.get(), static_cast<off_t>(offset), SEEK_SET);
#else
  const int failed = std::fseek(file_.get(), static_cast<long>(offset), SEEK_SET);
#endif
  if (failed != 0) throw InputError(name_, "cannot be read at any place", mend_unreadable);
}

std::size_t InputFile::read(void* to, std::size_t count) {
  errno = 0;
  const std::size_t got = std::fread(to, 1, count, file_.get());
  if (got < count && std::ferror(file_.get()) != 0)
    throw InputError(name_, fmt::format("cannot be read to its end: {}", std::strerror(errno != 0 ? errno : EIO)),
                     "check the file and the disk");
  return got;
}

InputStream::Buffer::int_type InputStream::Buffer::underflow() {
  const std::size_t got = file_.read(piece_.data(), piece_.size());
  setg(piece_.data(), piece_.data(), piece_.data() + got);
  return got == 0 ? traits_type::eof() : traits_type::to_int_type(piece_[0]);
}

template <class Bytes>
Bytes read_whole(const fs::path& path, std::uintmax_t limit, std::string_view mend, std::string_view mend_large) {
  InputFile file(path, mend);
  const auto refuse_large = [&] {
    throw InputError(file.name(), fmt::format("is larger than {}", size_text(limit)), mend_large);
  };
  if (file.size() > limit) refuse_large();
  // Its size is a hint: it may grow, and what the system makes up as it is read (/proc) has none.
  constexpr std::uintmax_t first_piece = std::uintmax_t{1} << 16;
  Bytes text;
  for (std::uintmax_t wanted = std::min(std::max<std::uintmax_t>(file.size() + 1, first_piece), limit + 1);;) {
    const std::size_t had = text.size();
    text.resize(static_cast<std::size_t>(wanted));
    const std::size_t got = file.read(text.data() + had, text.size() - had);
    const bool ended = had + got < text.size();
    text.resize(had + got);
    if (text.size() > limit) refuse_large();
    if (ended) return text;
    wanted = std::min(2 * wanted, limit + 1);
  }
}

template std::string read_whole(const fs::path&, std::uintmax_t, std::string_view, std::string_view);
template std::vector<std::uint8_t> read_whole(const fs::path&, std::uintmax_t, std::string_view, std::string_view);

}  // namespace zstep
