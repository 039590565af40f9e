// What a step would be like if its program made a mistake.
//
// For the kinds of event in which mistakes show there is one function, `suppose(e, at, out)`, in the headers beside
// this one. From the state that the run itself has it says, for each mistake that would show in this step, what the
// mistake would have made of it, and what a right program makes of it:
//
//   out.number(Mistake::slope_inverted, e.dx_dy, {dy / dx}, dx / dy);      a number
//   out.shows(…)                                                           a number that may be right all the same
//   out.whole(Mistake::ends_one_late, e.end_row, {end + 1}, {end});       a whole number
//   out.says(Mistake::equal_wins, tie && e.nearer, e.nearer == wins);     anything else: is the step as the mistake
//   would
//                                                                         have it, and is it as it should be?
//
// Where the two are alike, the step says nothing of the mistake.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <initializer_list>
#include <iterator>
#include <map>
#include <optional>
#include <set>
#include <utility>
#include <vector>

#include "traces/check/precision.hpp"
#include "traces/formulas/rounding.hpp"
#include "traces/formulas/situation.hpp"
#include "traces/mistakes/mistake.hpp"

namespace zstep::mistakes {

using formulas::Rounded, formulas::Situation;
using enum Mistake;

/// How a mistake fits a run.
struct Fit {
  std::int64_t first = 0;    ///< the first step that is as the mistake would have it, and wrong; 0 where none is
  std::int64_t as_made = 0;  ///< all of them
  std::int64_t against_before = 0, against_after = 0;  ///< steps that the mistake would have made otherwise
  std::uint64_t numbers = 0;  ///< a sum over the numbers that are as the mistake would have them

  /// Does the mistake make the numbers of the run, from where it shows on?
  bool holds() const {
    constexpr std::int64_t many = 3;
    return as_made > 0 && against_after == 0 && (against_before == 0 || as_made >= many);
  }
};

/// Two mistakes in one number.
using Pair = std::pair<Mistake, Mistake>;

class Supposed {
 public:
  /// `with_pairs`: what two mistakes at once make of a number is looked at, too.
  explicit Supposed(const Precision& precision, bool with_pairs = false)
      : precision_(precision), with_pairs_(with_pairs) {}

  void begin(std::int64_t step) { step_ = step; }
  std::optional<SideTest> side;                ///< the last one, until the next test
  bool won_empty = false, lost_empty = false;  ///< a pixel where nothing was drawn yet
  std::vector<double> one_line;                ///< a depth buffer of a single line, by column
  std::vector<std::int32_t> winners;           ///< by pixel, the polygon that won the last compare there
  bool asks_other_way = false;          ///< a pair's tests are done, and those of the pair the other way round begin
  std::set<std::int32_t> cut_off;       ///< pieces that are not in the list yet
  std::int32_t edges_of = no_polygon;   ///< the polygon whose edge came last, until a scan line begins
  std::set<std::int32_t> spanning;             ///< pieces that were found on both sides of a plane, and not cut yet
  const Fit& fit(Mistake mistake) const { return fits_[static_cast<std::size_t>(mistake)]; }

  bool equal(double recorded, const Rounded& formula) const {
    return formulas::gives(formula, recorded, precision_.relative) ||
           std::abs(recorded - formula.value) <= precision_.absolute;
  }
  void says(Mistake mistake, bool as_made, bool as_right, double number = 0) {
    if (as_made && as_right) return;
    Fit& fit = fits_[static_cast<std::size_t>(mistake)];
    count(fit, as_made);
    if (as_made) fit.numbers += std::bit_cast<std::uint64_t>(number) ^ static_cast<std::uint64_t>(step_);
  }
  /// What may be this mistake, but shows no more than that: a later step may tell that it was.
  void note_in_plane() {
    if (in_plane_ == 0) in_plane_ = step_;
  }
  void shows_since_in_plane(Mistake mistake) {
    Fit& fit = fits_[static_cast<std::size_t>(mistake)];
    if (in_plane_ != 0 && fit.first == 0) fit.first = in_plane_;
  }
  /// The mistake is not made: it would have shown from the beginning.
  void rules_out(Mistake mistake) { ++fits_[static_cast<std::size_t>(mistake)].against_after; }
  void number(Mistake mistake, double recorded, std::initializer_list<Rounded> made, const Rounded& right) {
    says(mistake, std::any_of(made.begin(), made.end(), [&](const auto& one) { return equal(recorded, one); }),
         equal(recorded, right), recorded);
  }
  /// What two of these mistakes make of a number that each of them alone makes otherwise: `make(made)` gives the number
  /// of a program that makes the mistakes of which made(mistake) is true.
  template <class Make>
  void together(double recorded, std::initializer_list<Mistake> mistakes, Make&& make) {
    if (!with_pairs_) return;
    const auto with = [&](Mistake one, Mistake other) {
      return make([=](Mistake mistake) { return mistake == one || mistake == other; });
    };
    const Rounded right = make([](Mistake) { return false; });
    for (auto one = mistakes.begin(); one != mistakes.end(); ++one)
      for (auto other = std::next(one); other != mistakes.end(); ++other) {
        const Rounded both = with(*one, *other);
        if (!std::isfinite(both.value) || equal(both.value, right) || equal(both.value, with(*one, *one)) ||
            equal(both.value, with(*other, *other)))
          continue;
        count(pairs_[{*one, *other}], equal(recorded, both));
      }
  }
  const std::map<Pair, Fit>& pairs() const { return pairs_; }
  /// The same where a program may do without this number: then it says nothing against the mistake.
  void shows(Mistake mistake, double recorded, std::initializer_list<Rounded> made, const Rounded& right) {
    if (!equal(recorded, right)) number(mistake, recorded, made, right);
  }
  /// A sum that a variable with few digits keeps, or two such variables.
  void sum_in_float32(double recorded, double one, double other, const Rounded& right) {
    const float kept = static_cast<float>(one + other), both = static_cast<float>(one) + static_cast<float>(other);
    shows(Mistake::adds_in_float32, recorded, {static_cast<double>(kept), static_cast<double>(both)}, right);
  }
  void whole(Mistake mistake, std::int32_t recorded, std::initializer_list<std::int32_t> made,
             std::initializer_list<std::int32_t> right) {
    const auto is_one = [&](std::int32_t one) { return one == recorded; };
    says(mistake, std::any_of(made.begin(), made.end(), is_one), std::any_of(right.begin(), right.end(), is_one),
         recorded);
  }

 private:
  void count(Fit& fit, bool as_made) const {
    if (as_made) {
      if (fit.first == 0) fit.first = step_;
      ++fit.as_made;
    } else {
      ++(fit.first == 0 ? fit.against_before : fit.against_after);
    }
  }

  Precision precision_;
  bool with_pairs_;
  std::map<Pair, Fit> pairs_{};
  std::int64_t step_ = 0;
  std::int64_t in_plane_ = 0;  ///< the first step that may be a mistake with what lies in one plane
  std::array<Fit, mistake_count> fits_{};
};

}  // namespace zstep::mistakes
