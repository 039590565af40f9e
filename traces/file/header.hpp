// What a trace says about itself, besides its scene and its events.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "traces/record/step.hpp"
#include "traces/scene.hpp"

namespace zstep {

/// Which of two depths wins a pixel. Of zstep's own methods the smaller one, and of equals the first.
struct Comparison {
  enum class Nearer : std::uint8_t { smaller, greater };
  enum class Ties : std::uint8_t { first, last };
  Nearer nearer = Nearer::smaller;
  Ties ties = Ties::first;

  bool wins(double z, double stored) const { return behind(z, stored) < 0 || (ties == Ties::last && z == stored); }
  /// By how much z is farther than what is stored; negative where it is nearer.
  double behind(double z, double stored) const { return nearer == Nearer::smaller ? z - stored : stored - z; }
  /// "<" where z wins if z < stored; "\u2264", ">" or "\u2265".
  std::string_view sign() const;
  /// Behind all others.
  double farthest() const { return nearer == Nearer::smaller ? no_depth : -no_depth; }
  bool operator==(const Comparison&) const = default;
};

/// What a header may leave undeclared; then it is as in a trace of zstep's own, and nobody may state it as a fact.
enum class Convention : std::uint8_t {
  depth,
  interpolation,
  coverage,
  cull,
  number_format,
  pixel_centre,
  nearer,
  ties
};

struct Header {
  std::string writer;     ///< who wrote it: "zstep 0.2.0", or a student's program
  std::string algorithm;  ///< the method's id: "z-buffer"
  std::string title;      ///< the method's title: "Z-buffer"
  Conventions conventions;
  Page page;  ///< the step table, in the order in which the pseudo-code is read
  Comparison comparison;
  std::optional<double> initial_depth;  ///< in the depth buffer before the first step, where the header declares it
  std::uint8_t undeclared = 0;          ///< bit k: the k-th Convention

  bool declares(Convention which) const { return (undeclared >> static_cast<unsigned>(which) & 1u) == 0; }
  double empty_depth() const { return initial_depth.value_or(comparison.farthest()); }
  bool operator==(const Header&) const = default;
};

/// The step with this id, or nullptr.
const StepInfo* find_step(const Page& page, std::uint8_t id);
/// The step with this name ("compare", or "z_buffer.compare" where two modules share a name), or nullptr.
const StepInfo* find_step(const Page& page, std::string_view name);

}  // namespace zstep
