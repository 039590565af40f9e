// Scenes made from a seed, one for each student, and how hard they are.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "algorithms/catalog/catalog.hpp"
#include "traces/file/trace.hpp"
#include "traces/scene.hpp"

namespace zstep::homework {

// What makes a student's scenes the student's own: the homework's secret key and the student's name.

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

struct Range {
  std::int64_t least = 0, most = 0;
  bool holds(std::int64_t number) const { return number >= least && number <= most; }
};

/// How a scene is made, and how hard it may be: [[scene]] generate = … of homework.toml.
struct Generator {
  enum class What : std::uint8_t { triangles, polygons };
  What what = What::triangles;
  Range count{2, 2}, width{14, 14}, height{12, 12};
  Range corners{4, 6};  ///< of each polygon, where they are no triangles
  Range steps, losing, crossing;
  std::int32_t tries = 0;  ///< seeds
};

/// How hard a run is to get right, in what happens in it.
struct Difficulty {
  std::int64_t steps = 0;
  std::int64_t losing = 0;       ///< compares that lose
  std::int64_t crossing = 0;     ///< spans in which some pixels win over another polygon's, and some lose
  std::set<std::uint8_t> kinds;  ///< of events that appear
};
Difficulty difficulty_of(const Trace& run);

/// A scene file. The same seed gives the same on every machine: whole numbers, and coordinates in quarters.
std::string generated_scene(const Generator& generator, const std::string& name, std::uint64_t seed);

}  // namespace zstep::homework
