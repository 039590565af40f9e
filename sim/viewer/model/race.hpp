// Two to four runs of one scene side by side, at one clock: where each of them is follows from the clock alone.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "sim/cost/comparison.hpp"
#include "sim/cost/growth.hpp"
#include "sim/cost/operations.hpp"
#include "sim/viewer/model/session.hpp"
#include "sim/viewer/viewer.hpp"

namespace zstep::viewer {

class Race {
 public:
  static constexpr std::size_t least = 2, most = 4;
  using RunBy = std::function<OtherRun(const Trace&, const std::string& method, const std::vector<Change>&)>;

  struct Racer {
    Racer(compare::Entrant entrant_, OtherRun run_)
        : entrant(std::move(entrant_)), run(std::move(run_)), session(run.trace, nullptr), work(run.trace) {}
    compare::Entrant entrant;
    OtherRun run;
    Session session;  ///< where it is
    compare::WorkDone work;
    std::optional<double> seconds;  ///< the median of so many runs without a recording, once they were measured
    int runs = 0;
  };

  /// `shown` must live as long.
  Race(const Trace& shown, RunBy run_by) : shown_(shown), run_by_(std::move(run_by)) {}

  /// Who may take part, and who does where nobody was chosen: the method shown and the two after it.
  const std::vector<compare::Entrant>& all() const;
  std::vector<std::string> usual() const;
  /// Runs those that do not run yet. Throws InputError, and all stays as it is, where one cannot draw the scene.
  void choose(const std::vector<std::string>& entrants);
  const std::vector<std::unique_ptr<Racer>>& racers() const { return racers_; }
  std::vector<std::string> chosen() const;

  /// What the clock counts. Time is measured where that was not done yet: false where that was ended, and why.
  compare::Measure clock() const { return clock_; }
  bool set_clock(compare::Measure clock, const std::function<bool()>& ends, std::string& why);
  /// Parts of the clock from the beginning: steps, operations, or thousandths of the longest time.
  std::int64_t at() const { return at_; }
  std::int64_t end() const;
  void go_to(std::int64_t at);
  /// Where the clock stands when a run is done, and where the run is at a clock.
  std::int64_t finish(const Racer& racer) const;
  std::int64_t position(const Racer& racer, std::int64_t at) const;
  std::string finish_text(const Racer& racer) const;
  std::string clock_text(std::int64_t at) const;  ///< "4 000 steps", "81.0 µs"
  std::string place_text() const;                 ///< "4 000 of 14 935 steps"

  bool playing = false;
  int speed() const { return speed_; }
  void change_speed(int direction);
  std::string speed_text() const;
  /// As Session::play().
  double play(double now);

 private:
  double longest() const;  ///< seconds
  double a_second() const;

  const Trace& shown_;
  RunBy run_by_;
  mutable std::vector<compare::Entrant> all_;
  std::vector<std::unique_ptr<Racer>> racers_;
  compare::Measure clock_ = compare::Measure::operations;
  std::int64_t at_ = 0;
  int speed_ = 8;  ///< the whole race in 15 seconds
  double played_until_ = -1, owed_ = 0;
};

/// What costs are as the number of polygons grows, measured cell by cell while somebody waits.
struct GrowthChart {
  std::vector<compare::Entrant> of;
  std::vector<compare::GrowthLine> lines;
  std::size_t next = 0;  ///< cell to be measured: one entrant after the other at each number of polygons
  bool at_work = false;
  int shown = 0;  ///< frames since it began, so that one sees that it does

  void begin(const Race& race);
  /// Measures the next cell; `ends` is asked meanwhile, and ends all.
  void measure_next(const std::function<bool()>& ends);
  std::string next_text() const;  ///< "Warnock, 1 000 polygons (14 of 24)"
  std::size_t cells() const { return of.size() * compare::growth_sizes.size(); }
};

}  // namespace zstep::viewer
