#include "traces/image/file.hpp"

#include <cerrno>
#include <cstdio>
#include <random>
#include <string>

#include <fmt/format.h>

#include "traces/file/files.hpp"

namespace zstep {
namespace {

namespace fs = std::filesystem;

void put(const fs::path& path, OpenFile file, std::span<const std::uint8_t> bytes) {
  errno = 0;
  const bool written = std::fwrite(bytes.data(), 1, bytes.size(), file.get()) == bytes.size();
  const int error = errno;
  // Closing flushes: a full disk may show only here.
  const bool closed = std::fclose(file.release()) == 0;
  if (!written || !closed) output_failed(path, !written && error != 0 ? error : errno != 0 ? errno : EIO);
}

std::string unlikely_name() {
  std::random_device device;
  return fmt::format(".{:08x}{:08x}.part", device(), device());
}

void write(const fs::path& path, std::span<const std::uint8_t> bytes, Inputs inputs) {
  const OutputPlace place(path, inputs);
  if (place.is_device()) return put(path, place.open_device(), bytes);
  const std::string name = place.path().filename().string() + unlikely_name();
  const Unfinished part(place.beside(name));
  put(path, place.make(name), bytes);
  place.take(name);
}

}  // namespace

void check_writable(const fs::path& path) { const OutputPlace place(path); }
void write_file(const fs::path& path, std::span<const std::uint8_t> bytes) { write(path, bytes, Inputs::kept); }
void rewrite_file(const fs::path& path, std::span<const std::uint8_t> bytes) { write(path, bytes, Inputs::no_matter); }

std::vector<std::uint8_t> read_file(const fs::path& path, std::uintmax_t limit) {
  return read_whole<std::vector<std::uint8_t>>(path, limit);
}

}  // namespace zstep
