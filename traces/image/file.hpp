// Writing whole files so that nobody ever sees half of one.
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <vector>

namespace zstep {

/// Writes `bytes` as the whole of `path`, replacing what was there. The bytes go to a temporary file beside it that is
/// renamed when it is complete, so the old file or the new one is always whole; what is no ordinary file (/dev/stdout,
/// a pipe) is written directly. Throws InputError when the folder is missing or not writable, or the file was read
/// (traces/file/files.hpp); Exhausted when the disk is full.
void write_file(const std::filesystem::path& path, std::span<const std::uint8_t> bytes);
/// The same of a file that is zstep's own to read and to write again.
void rewrite_file(const std::filesystem::path& path, std::span<const std::uint8_t> bytes);

/// Throws the InputError that write_file would throw for a missing folder, a protected file or an input, without
/// writing.
void check_writable(const std::filesystem::path& path);

/// All bytes of `path`. Throws InputError when there is no such file, it cannot be read, or has more than `limit`
/// bytes.
std::vector<std::uint8_t> read_file(const std::filesystem::path& path, std::uintmax_t limit = std::uintmax_t{1} << 30);

}  // namespace zstep
