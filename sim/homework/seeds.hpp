// What makes a student's scenes the student's own: the homework's secret key and the student's name.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace zstep::homework {

/// 128 bits; in the file secret.key of a homework's folder as 32 hexadecimal digits.
using Key = std::array<std::uint64_t, 2>;
inline constexpr const char* key_file = "secret.key";

/// SipHash-2-4 (J.-P. Aumasson and D. J. Bernstein, 2012): who does not have the key cannot tell the number of any
/// text, nor the key from the numbers of others.
std::uint64_t keyed_number(const Key& key, std::string_view text);

/// None where the folder has no key. Throws InputError where the file is no key.
std::optional<Key> key_of(const std::filesystem::path& folder);
/// Any key; of a text, always the same.
Key new_key(const std::string& from);
void write_key(const std::filesystem::path& folder, const Key& key);

/// Names of students, one a line. Throws InputError at FILE:LINE where a name cannot be that of a folder, or is there
/// twice.
std::vector<std::string> names_in(const std::filesystem::path& file);
/// Why a name cannot be that of a student's folder; empty where it can.
std::string why_no_name(std::string_view name);

}  // namespace zstep::homework
