#include "sim/image/file.hpp"

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <random>
#include <string>
#include <system_error>

#include <fmt/format.h>

#include "traces/error.hpp"
#include "traces/file/output.hpp"

namespace zstep {
namespace {

namespace fs = std::filesystem;

/// 0, or errno of what went wrong.
int put(const fs::path& path, std::span<const std::uint8_t> bytes) {
  OpenFile file = open_output(path);
  if (!file) return errno != 0 ? errno : EIO;
  const bool written = std::fwrite(bytes.data(), 1, bytes.size(), file.get()) == bytes.size();
  const int error = errno;
  // Closing flushes: a full disk may show only here.
  if (std::fclose(file.release()) != 0) return errno != 0 ? errno : EIO;
  return written ? 0 : (error != 0 ? error : EIO);
}

std::string unlikely_name() {
  std::random_device device;
  return fmt::format(".{:08x}{:08x}.part", device(), device());
}

}  // namespace

namespace {

void check_place(const fs::path& path) {
  std::error_code ignored;
  const fs::path target = where_it_leads(path);
  if (path.filename().empty() || fs::is_directory(target, ignored))
    throw InputError(path.string(), "is a folder", "name a file in it");
  const fs::path folder = target.has_parent_path() ? target.parent_path() : fs::path(".");
  if (!fs::is_directory(folder, ignored))
    throw InputError(path.string(), fmt::format("there is no folder {}", folder.string()),
                     "make it first, or write to another place");
  // Renaming over a file asks only the folder; a file that its owner protected stays as it is.
  if (fs::is_regular_file(target, ignored) && !OpenFile(std::fopen(target.string().c_str(), "r+b")))
    output_failed(path, errno);
}

}  // namespace

void check_writable(const fs::path& path) {
  check_place(path);
  check_replaceable(where_it_leads(path));
}

void write_file(const fs::path& path, std::span<const std::uint8_t> bytes) {
  check_writable(path);
  rewrite_file(path, bytes);
}

void rewrite_file(const fs::path& path, std::span<const std::uint8_t> bytes) {
  check_place(path);
  std::error_code ignored;
  const fs::path target = where_it_leads(path);
  if (fs::exists(target, ignored) && !fs::is_regular_file(target, ignored)) {
    if (const int error = put(target, bytes)) output_failed(path, error);
    return;
  }

  const Unfinished part(target.string() + unlikely_name());
  if (const int error = put(part.path(), bytes)) output_failed(path, error);
  std::error_code error;
  fs::rename(part.path(), target, error);
  if (error) output_failed(path, error.value());
}

std::vector<std::uint8_t> read_file(const fs::path& path, std::uintmax_t limit) {
  std::error_code ignored;
  if (fs::is_directory(path, ignored)) throw InputError(path.string(), "is a folder", "name a file in it");
  OpenFile file(std::fopen(path.string().c_str(), "rb"));
  if (!file)
    throw InputError(path.string(), fmt::format("cannot be opened: {}", std::strerror(errno)),
                     "check its name and that it may be read");
  std::vector<std::uint8_t> bytes;
  std::vector<std::uint8_t> piece(std::size_t{1} << 16);
  while (const std::size_t count = std::fread(piece.data(), 1, piece.size(), file.get())) {
    bytes.insert(bytes.end(), piece.begin(), piece.begin() + static_cast<std::ptrdiff_t>(count));
    if (bytes.size() > limit)
      throw InputError(path.string(), fmt::format("has more than {} bytes", limit), "give a smaller file");
  }
  if (std::ferror(file.get()))
    throw InputError(path.string(), "cannot be read to its end", "check the file and the disk");
  return bytes;
}

}  // namespace zstep
