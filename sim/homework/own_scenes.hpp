// Scenes of each student's own: made from a seed, as hard as the others'; and how much two runs have in common,
// whatever their scenes are.
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
#include "traces/grade/grade.hpp"
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

// Scenes of each student's own: how much two runs have in common, whatever their scenes are.

/// What a run has in steps that hold numbers, in any order, numbers up to rounding: the least of the steps' hashes, by
/// which the share of what two runs have in common is known without either run (A. Z. Broder, 1997).
struct Sketch {
  std::vector<std::uint64_t> least;  ///< ascending
  std::int64_t steps = 0;            ///< different ones
  std::int64_t numbers = 0;          ///< different ones in them, but for 0
  std::uint64_t whole = 0;           ///< the same where all steps are
};
/// Of the steps of these parts.
Sketch sketch_of(const Trace& run, const std::vector<grade::Part>& parts);
/// Of the steps that either has, the share that both have.
double in_common(const Sketch& a, const Sketch& b);

/// A run of a scene of the student's own, and the right run.
struct OwnRun {
  std::string scene;
  Sketch run, right;
};

/// Who handed in what.
struct HandedIn {
  std::string name;
  std::vector<OwnRun> runs;
};

/// Runs of one scene's name that are nearly the same, although the scenes are not.
struct AlikeRuns {
  std::string scene;
  std::vector<std::string> names;      ///< of who handed them in
  bool same = true;                    ///< all steps that hold numbers
  double share = 1;                    ///< of them that any has in common with the first, at least
  std::int64_t steps = 0;              ///< of the first
  std::vector<std::string> right_for;  ///< students on whose scenes they are right, or nearly
};
/// Finds them in n log n. Runs that are those of a public scene are none: who mixes up files has them, too.
std::vector<AlikeRuns> alike_runs(const std::vector<HandedIn>& all, const std::vector<Sketch>& right_public);

}  // namespace zstep::homework
