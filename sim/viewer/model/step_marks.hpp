// Steps that a window marks, and what it says of them: those that check found, or those at which two runs part.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "sim/viewer/model/session.hpp"

namespace zstep::viewer {

class StepMarks {
 public:
  virtual ~StepMarks() = default;

  /// The first steps of the causes, by their number.
  std::span<const std::int64_t> causes() const { return causes_; }
  /// "Cause 1 of 3, insert_edge, edge e1 (1–2)".
  virtual std::string name_of(std::size_t cause) const = 0;
  /// Whether a step from `first` to `last` follows from a cause.
  virtual bool any_follows(std::int64_t first, std::int64_t last) const = 0;

  /// What is said of the step where the session is: a line for each thing that is wrong, then what follows.
  struct Told {
    std::string head;  ///< of each line: "Wrong: "
    std::vector<std::string> lines;
    std::string note;
  };
  virtual const Told& told(Session& session) = 0;

 protected:
  std::vector<std::int64_t> causes_;
};

/// A pixel of frame and depth buffer that is marked.
struct PixelMark {
  std::int64_t pixel = 0;  ///< as Picture::at counts
  bool filled = false;     ///< written wrongly, or of another colour; hollow: follows, or another depth alone
  bool operator==(const PixelMark&) const = default;
};

}  // namespace zstep::viewer
