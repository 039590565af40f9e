// What `zstep check` found in a run, by step and by place: which steps are wrong or follow from what is, and at each
// position which numbers of the tables and which pixels are.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <unordered_map>
#include <vector>

#include "sim/viewer/model/session.hpp"
#include "sim/words/judged.hpp"

namespace zstep::viewer {

// Steps that a window marks, and what it says of them: those that check found, or those at which two runs part.

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

class Findings : public StepMarks {
 public:
  /// How far a number can be trusted: it is right, follows from what is wrong, or is wrong itself.
  enum class Trust : std::uint8_t { right, follows, wrong };

  /// Both must outlive it.
  Findings(const Trace& trace, const CheckedRun& checked);
  const CheckedRun& checked() const { return checked_; }

  Trust trust(const formulas::Place& place, std::int64_t position) const;
  /// The pixels of frame and depth buffer, or of the light's, that are not right at a position.
  const std::vector<PixelMark>& pixels(std::int64_t position, bool light);

  /// The next (1) or previous (-1) step that is wrong or follows from what is.
  std::optional<std::int64_t> next_marked(std::int64_t from, int direction) const;

  std::string name_of(std::size_t cause) const override;
  bool any_follows(std::int64_t first, std::int64_t last) const override;
  const Told& told(Session& session) override;

 private:
  struct Since {
    std::int64_t step;
    Trust trust;
  };
  static std::uint64_t key(const formulas::Place& place) {
    constexpr unsigned shift = 56;
    return static_cast<std::uint64_t>(place.in) << shift |
           (static_cast<std::uint64_t>(place.number) & ((std::uint64_t{1} << shift) - 1));
  }
  const CheckMarks::Step* mark_of(std::int64_t step) const;

  const Trace& trace_;
  const CheckedRun& checked_;
  std::unordered_map<std::uint64_t, std::vector<Since>> places_;
  std::vector<formulas::Place> pixels_ever_;
  std::vector<PixelMark> pixels_;
  std::int64_t pixels_at_ = -1;
  bool pixels_light_ = false;
  Told told_;
  std::int64_t told_at_ = -1;
};

}  // namespace zstep::viewer
