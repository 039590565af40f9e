// Which steps of two runs are the same step, and which of those part.
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "traces/file/trace.hpp"

namespace zstep::diff {

/// A step of one run that is not, to the last bit, what the other run has for it.
struct Difference {
  std::int64_t a = 0, b = 0;  ///< the steps, counted from 1; 0 where the run has no such step
  std::uint16_t fields = 0;   ///< bit I: the I-th field differs
  std::uint8_t kind = 0;      ///< of the event
  std::uint8_t line = 0;      ///< of the pseudo-code of B, or of A where B has no such step: the step's id
  float off = 0;              ///< of the numbers that differ: how far, as a share of the larger one, at most
  bool only_a() const { return b == 0; }
  bool only_b() const { return a == 0; }
};

/// Steps a + i and b + i are the same step, for i from 0 to below count.
struct Match {
  std::int64_t a = 0, b = 0, count = 0;
};

/// How many steps of a kind.
struct KindCount {
  std::int64_t pairs = 0, equal = 0, only_a = 0, only_b = 0;
  std::int64_t not_kept = 0;  ///< pairs that differ, beyond as many as are kept
};

/// So many differences are kept, the first that are found: until their causes are known each takes about 100 bytes.
inline constexpr std::size_t most_differences = 4'000'000;

struct Alignment {
  std::vector<Match> by_a, by_b;            ///< the same, ordered by one run's steps and by the other's
  std::vector<Difference> differences;      ///< by the steps of B; what B does not have stands where it would have been
  std::array<KindCount, kind_count> kinds;  ///< of the kinds that are compared
  std::array<bool, kind_count> compared{};  ///< which these are
  bool turns = false;                       ///< of two methods, each says whose turn it is
  std::size_t keeps = most_differences;
  std::int64_t not_kept = 0;  ///< differences beyond those, which are only counted
  bool identical = false;     ///< byte for byte
  bool complete = true;       ///< false where it ended at a limit, or was told to

  /// Takes note of a difference.
  void differs(const Difference& difference);

  /// The other run's step for one's own; 0 where there is none.
  std::int64_t in_b(std::int64_t a) const;
  std::int64_t in_a(std::int64_t b) const;
  /// The last of the other run's steps that comes before what one's own step would be there; 0 where there is none.
  std::int64_t before_in_b(std::int64_t a) const;
  std::int64_t before_in_a(std::int64_t b) const;
};

/// Fast: together where the runs do the same. Plain: every step for itself, which gives the same (tests compare both).
enum class Way : std::uint8_t { fast, plain };

/// Steps of a kind that one run never records: it may do them all the same, and not print them. Or it was to print what
/// its pseudo-code has a line for; then what is done to pixels is missing.
enum class Unrecorded : std::uint8_t { left_out, missing_of_pixels };

/// Matches the steps of two runs by what they are about: steps may be missing, additional or in another order.
/// `on_way` is called now and then with the share done; true ends it.
Alignment align(const Trace& a, const Trace& b, const std::function<bool(double)>& on_way = nullptr,
                Way way = Way::fast, std::size_t keeps = most_differences,
                Unrecorded unrecorded = Unrecorded::left_out);

}  // namespace zstep::diff
