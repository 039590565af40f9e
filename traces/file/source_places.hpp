// Where a step comes from: the place in the program's source that printed it, and its line in a file of JSON Lines.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "traces/file/container.hpp"

namespace zstep {

/// The member of a step in JSON Lines that names the place: "at":"raster.cpp:417". No field of an event is called so.
inline constexpr const char* at_key = "at";

/// The places in the program's source, by step. A line of pseudo-code is mostly printed by one line of a program: so
/// only the steps are kept at which the place is not that of the step of the same name before.
class SourcePlaces {
 public:
  static constexpr std::size_t longest = 1024;  ///< bytes of a place: paths are long
  static constexpr std::size_t most_places = std::size_t{1} << 16, most_changes = std::size_t{1} << 23;

  /// Why a text is no place, or cannot be kept; empty where it can.
  std::string fault_of(std::string_view place) const;
  /// Is it that of the last step of this name?
  bool goes_on(std::uint8_t step, std::string_view place) const { return names_[last_[step]] == place; }
  /// The place that printed the step which leads to `position`, empty where nothing says it; positions go up, and the
  /// place is one without a fault.
  void add(std::int64_t position, std::uint8_t step, std::string_view place);

  /// The place of a step by its position; empty where nothing says it.
  std::string_view of(std::int64_t position, std::uint8_t step) const;
  bool empty() const { return names_.size() == 1; }

  /// With nothing but the names left of the files.
  SourcePlaces without_paths() const;

  Bytes bytes() const;
  /// Throws MalformedBytes.
  explicit SourcePlaces(std::span<const std::uint8_t> bytes);
  SourcePlaces() = default;

 private:
  struct Change {
    std::int64_t position;
    std::uint32_t place;  ///< in names_
  };
  std::vector<std::string> names_ = {""};  ///< the first: no place
  std::map<std::string, std::uint32_t, std::less<>> numbers_{{"", 0}};
  std::array<std::uint32_t, 256> last_{};
  std::array<std::vector<Change>, 256> changes_;  ///< by step
  std::size_t count_ = 0;                         ///< of all changes
};

/// What holds them in a file: behind the index, where a reader that does not know it does not look, or behind the last
/// block of a recording without an end. Nothing where there are none.
void put_places(Bytes& out, const SourcePlaces& places);
/// The chunk that holds them, among the chunks that follow one another from this offset on.
std::optional<ChunkPlace> find_places(const ByteSource& source, std::uint64_t offset);
/// What stands in it; throws MalformedBytes.
SourcePlaces take_places(const ByteSource& source, const ChunkPlace& chunk);

/// The lines of a file at which its steps stand: mostly the next line is the next step.
class StepLines {
 public:
  /// Steps and lines go up.
  void add(std::int64_t step, std::int64_t line) {
    if (shifts_.empty() || shifts_.back().second != line - step) shifts_.emplace_back(step, line - step);
  }
  /// 0 where nothing is known of it.
  std::int64_t of(std::int64_t step) const;

 private:
  std::vector<std::pair<std::int64_t, std::int64_t>> shifts_;  ///< from this step on: how far the line is from it
};

}  // namespace zstep
