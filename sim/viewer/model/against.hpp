// A second run beside the one that a reader steps through, another or the one before the last change: it goes to the
// same moment, as `zstep diff` matches the steps of the two, and what differs between them is marked in both.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "sim/viewer/model/findings.hpp"
#include "sim/viewer/model/session.hpp"
#include "sim/viewer/viewer.hpp"
#include "traces/diff/diff.hpp"

namespace zstep::viewer {

// The run before the last change of the scene. It goes to the same moment as the run that is shown, so that what a
// table or a picture shows can be held against what it showed then.

/// Beyond so many steps of both runs together, matching them would keep a reader waiting.
inline constexpr std::int64_t most_steps_matched = 400'000;

class BeforeChange {
 public:
  /// `now` must outlive this.
  BeforeChange(const Session& now, std::shared_ptr<const Trace> before);

  Session& session() { return session_; }
  /// Brings it to where the run that is shown is.
  void follow();

 private:
  const Session& now_;
  std::shared_ptr<const Trace> trace_;
  diff::Alignment both_;  ///< A is the run that is shown
  Session session_;
};

/// Where run B is when run A is there: at the partner of that step, or else behind what comes before it.
std::int64_t moment_in_b(const diff::Alignment& both, std::int64_t at, std::int64_t size_a, std::int64_t size_b);

class Against {
 public:
  /// All of it must outlive this.
  Against(Session& a, const AgainstRun& with);

  /// The second run, which is shown and not stepped through.
  Session& session() { return b_; }
  /// Brings it to where the first one is, unless both were brought here together.
  void follow();

  /// A step of each run.
  struct Place {
    std::int64_t a = 0, b = 0;
    auto operator<=>(const Place&) const = default;
  };
  /// The next (1) or previous (-1) cause, or step that is not the same in both.
  std::optional<Place> next_cause(int direction) const;
  std::optional<Place> next_difference(int direction) const;
  void go_to(const Place& place);
  /// The second run was brought somewhere by itself: the first one comes to the same moment.
  void follow_second();
  /// The next or previous difference in the fields in which the runs part here or, where this was gone to from another
  /// such place, parted there; and which one it is of how many.
  struct Alike {
    Place place;
    std::string what;  ///< "z of write_depth"
    std::size_t number = 0, all = 0;
  };
  std::optional<Alike> next_alike(int direction);
  /// The first pixel from the top in which the pictures differ at the end, and the first step that is not the same in
  /// both and touches it.
  struct PixelApart {
    Cell cell;
    std::optional<Place> place;
  };
  const std::optional<PixelApart>& first_pixel_apart();

  /// Pixels that differ at this moment; by their depth alone where the mark is hollow.
  const std::vector<PixelMark>& pixels();

  StepMarks& marks_of_a() { return marks_a_; }
  StepMarks& marks_of_b() { return marks_b_; }

 private:
  struct Parted {
    Place place;
    std::size_t number = 0;  ///< among the differences
  };
  class Marks : public StepMarks {
   public:
    Marks(Against& of, bool first);
    std::string name_of(std::size_t cause) const override;
    bool any_follows(std::int64_t first, std::int64_t last) const override;
    const Told& told(Session& session) override;

   private:
    Against& of_;
    bool first_;  ///< of the first run
    std::vector<std::int64_t> steps_;
    Told told_;
    std::optional<Place> told_at_;
  };
  Place here() const { return {a_.position(), b_.position()}; }
  Place place_of(const diff::Difference& difference) const;
  const Parted* parted_here() const;
  std::string fields_of(const diff::Difference& difference) const;

  Session& a_;
  const diff::DiffReport& report_;
  Session b_;
  std::optional<std::int64_t> followed_;  ///< where the first run was then
  std::vector<Parted> parted_;            ///< by place
  std::vector<Place> causes_;             ///< as the report has them
  std::size_t alike_ = 0;                 ///< the difference whose fields are gone through
  std::optional<Place> alike_at_;         ///< where going through them has led
  std::vector<PixelMark> pixels_;
  std::optional<Place> pixels_at_;
  bool looked_for_pixel_ = false;
  std::optional<PixelApart> pixel_apart_;
  Marks marks_a_, marks_b_;
};

}  // namespace zstep::viewer
