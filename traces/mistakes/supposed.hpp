// What a step would be like if its program made a mistake.
//
// For the kinds of event in which mistakes show there is one function, `suppose(e, at, out)`, in the headers beside
// this one. From the state that the run itself has it says, for each mistake that would show in this step, what the
// mistake would have made of it, and what a right program makes of it:
//
//   out.number(Mistake::slope_inverted, "dx_dy", e.dx_dy, {dy / dx}, dx / dy);   a number, and its field
//   out.shows(…)                                                          a number that may be right all the same
//   out.whole(Mistake::ends_one_late, "end_row", e.end_row, {end + 1}, {end});   a whole number
//   out.says(Mistake::equal_wins, tie && e.nearer, e.nearer == wins, "nearer");  anything else: is the step as the
//                                                                         mistake would have it, and is it as it should
//                                                                         be? And which fields does that explain?
//   out.follows("x_edge", "dx_dy", e.x_edge, x_0 + e.dx_dy·(y − y_0));    who explains the one explains the other
//
// Where the two are alike, the step says nothing of the mistake. And a mistake is made in a step only where it explains
// the whole of it: each of its fields that is wrong, and none that is right otherwise (settle()).
#pragma once

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <initializer_list>
#include <iterator>
#include <map>
#include <optional>
#include <set>
#include <span>
#include <string_view>
#include <utility>
#include <vector>

#include "traces/check/check.hpp"
#include "traces/check/precision.hpp"
#include "traces/events/fields.hpp"
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
  std::uint64_t numbers = 0;    ///< a sum over the numbers that are as the mistake would have them
  bool explains_first = false;  ///< it is made in the first step that is wrong, or nothing is said to be wrong there

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
  /// `faults`: what is wrong in the run, in its order. `with_pairs`: what two mistakes at once make of a number is
  /// looked at, too.
  explicit Supposed(const Precision& precision, std::span<const Fault> faults = {}, bool with_pairs = false)
      : precision_(precision),
        faults_(faults),
        first_wrong_(faults.empty() ? 0 : faults.front().step),
        with_pairs_(with_pairs) {}

  /// What is said from here on is of this step.
  void begin(std::int64_t step, std::uint8_t kind) {
    settle();
    step_ = step, kind_ = kind, wrong_ = 0;
    for (; !faults_.empty() && faults_.front().step <= step; faults_ = faults_.subspan(1))
      if (faults_.front().step == step) wrong_ |= fields_called(faults_.front().field);
  }
  /// All is said of the step.
  void settle() {
    for (const Made& one : made_) {
      std::uint32_t explained = 0;
      for (const Made& other : made_)
        if (other.mistake == one.mistake) explained |= other.fields;
      Fit& fit = fits_[one.mistake];
      if (against_[one.mistake]) continue;
      if (!explains(explained)) {
        against_[one.mistake] = true;
        count(fit, false);
        continue;
      }
      count(fit, true);
      fit.explains_first = fit.explains_first || step_ == first_wrong_;
      fit.numbers += std::bit_cast<std::uint64_t>(one.number) ^ step_;
    }
    if (with_pairs_) settle_beside();
    for (const auto& [pair, as_made, fields] : made_by_pairs_) {
      std::uint32_t explained = fields;
      for (const Made& one : made_)
        if (one.mistake == pair.first || one.mistake == pair.second) explained |= one.fields;
      for (const auto& [other, also_made, other_fields] : made_by_pairs_)
        if (other == pair && also_made) explained |= other_fields;
      count(pairs_[pair], as_made && explains(explained));
    }
    made_.clear(), against_.fill(false), made_by_pairs_.clear(), follows_.clear();
  }
  std::optional<SideTest> side;                        ///< the last one, until the next test
  bool won_empty = false, lost_empty = false;          ///< a pixel where nothing was drawn yet
  std::vector<double> one_line;                        ///< a depth buffer of a single line, by column
  std::vector<std::int32_t> winners;                   ///< by pixel, the polygon that won the last compare there
  bool retired_late = false, retired_in_time = false;  ///< edges, since the last step of another kind
  bool asks_other_way = false;         ///< a pair's tests are done, and those of the pair the other way round begin
  std::set<std::int32_t> cut_off;      ///< pieces that are not in the list yet
  std::int32_t edges_of = no_polygon;  ///< the polygon whose edge came last, until a scan line begins
  std::set<std::int32_t> spanning;     ///< pieces that were found on both sides of a plane, and not cut yet
  const Fit& fit(Mistake mistake) const { return fits_[mistake]; }

  bool equal(double recorded, const Rounded& formula) const {
    if (!std::isfinite(recorded)) return false;  // what is no number is not made by any formula
    return formulas::gives(formula, recorded, precision_.relative) ||
           std::abs(recorded - formula.value) <= precision_.largest_amount();
  }
  /// `fields`: names, with blanks between, of what the mistake explains in this step; `whole_step` where there should
  /// be no such step.
  void says(Mistake mistake, bool as_made, bool as_right, std::string_view fields = {}, double number = 0) {
    if (as_made && as_right) return;
    if (as_made) return made_.push_back({mistake, fields_called(fields), number});
    against_[mistake] = ever_against_[mistake] = true;
    count(fits_[mistake], false);
  }
  static constexpr std::string_view whole_step = "*";
  /// A field that is wrong as it was computed from another one of the step: who explains that one explains both.
  void follows(std::string_view field, std::string_view from, double recorded, const Rounded& formula) {
    if (wrong_ != 0 && equal(recorded, formula)) follows_.emplace_back(fields_called(field), fields_called(from));
  }
  /// What may be this mistake, but shows no more than that: a later step may tell that it was.
  void note_in_plane() {
    if (in_plane_ == 0) in_plane_ = step_;
  }
  void shows_since_in_plane(Mistake mistake) {
    Fit& fit = fits_[mistake];
    if (in_plane_ != 0 && fit.first == 0) fit.first = in_plane_;
  }
  /// The mistake is not made: it would have shown from the beginning.
  void rules_out(Mistake mistake) {
    ++fits_[mistake].against_after;
    ever_against_[mistake] = true;
  }
  void number(Mistake mistake, std::string_view field, double recorded, std::initializer_list<Rounded> made,
              const Rounded& right) {
    says(mistake, std::any_of(made.begin(), made.end(), [&](const auto& one) { return equal(recorded, one); }),
         equal(recorded, right), field, recorded);
  }
  /// What two of these mistakes make of a number that each of them alone makes otherwise: `make(made)` gives the number
  /// of a program that makes the mistakes of which made(mistake) is true.
  template <class Make>
  void together(std::string_view field, double recorded, std::initializer_list<Mistake> mistakes, Make&& make) {
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
        const bool as_made = equal(recorded, both);
        made_by_pairs_.push_back({{*one, *other}, as_made, as_made ? fields_called(field) : 0});
      }
  }
  const std::map<Pair, Fit>& pairs() const { return pairs_; }
  /// Mistakes that are made in one step, each in other fields of it, where they explain together what neither does
  /// alone, at each step that is as one of them would have it.
  std::map<Pair, Fit> pairs_beside() const {
    std::map<Pair, Fit> found = beside_;
    std::erase_if(found, [&](const auto& one) {
      const auto is_whole = [&](Mistake mistake) {
        return !ever_against_[mistake] && unexplained_[mistake] == one.second.as_made;
      };
      return !is_whole(one.first.first) || !is_whole(one.first.second);
    });
    return found;
  }
  /// The same where a program may do without this number: then it says nothing against the mistake.
  void shows(Mistake mistake, std::string_view field, double recorded, std::initializer_list<Rounded> made,
             const Rounded& right) {
    if (!equal(recorded, right)) number(mistake, field, recorded, made, right);
  }
  /// A sum that a variable with few digits keeps, or two such variables.
  void sum_in_float32(std::string_view field, double recorded, double one, double other, const Rounded& right) {
    const float kept = static_cast<float>(one + other), both = static_cast<float>(one) + static_cast<float>(other);
    shows(Mistake::adds_in_float32, field, recorded, {kept, both}, right);
  }
  void whole(Mistake mistake, std::string_view field, std::int32_t recorded, std::initializer_list<std::int32_t> made,
             std::initializer_list<std::int32_t> right) {
    const auto is_one = [&](std::int32_t one) { return one == recorded; };
    says(mistake, std::any_of(made.begin(), made.end(), is_one), std::any_of(right.begin(), right.end(), is_one), field,
         recorded);
  }

 private:
  struct Made {
    Mistake mistake;
    std::uint32_t fields;  ///< that it explains
    double number;
  };
  struct MadeByPair {
    Pair pair;
    bool as_made;
    std::uint32_t fields;
  };

  /// Bit f: field f of this step's kind.
  std::uint32_t fields_called(std::string_view names) const {
    if (names == whole_step) return ~0u;
    std::uint32_t fields = 0;
    const std::span<const FieldOfKind> all = fields_of_kind(kind_);
    while (!names.empty()) {
      const std::size_t end = names.find(' ');
      for (std::size_t field = 0; field < all.size(); ++field)
        if (all[field].name == names.substr(0, end)) fields |= 1u << field;
      names = end == names.npos ? std::string_view{} : names.substr(end + 1);
    }
    return fields;
  }
  /// Is each field that is wrong among these, or follows from one of them?
  bool explains(std::uint32_t fields) const {
    for (const auto& [field, from] : follows_)
      if ((from & ~fields) == 0) fields |= field;
    return (wrong_ & ~fields) == 0;
  }
  /// Of what is said of a step: do two mistakes explain it together?
  void settle_beside() {
    std::map<Mistake, std::uint32_t> explained;
    for (const Made& one : made_) explained[one.mistake] |= one.fields;
    std::erase_if(explained, [&](const auto& one) { return explains(one.second); });
    for (auto one = explained.begin(); one != explained.end(); ++one) {
      ++unexplained_[one->first];
      for (auto other = std::next(one); other != explained.end(); ++other)
        if (explains(one->second | other->second)) count(beside_[{one->first, other->first}], true);
    }
  }
  void count(Fit& fit, bool as_made) const {
    if (as_made) {
      if (fit.first == 0) fit.first = step_;
      ++fit.as_made;
    } else {
      ++(fit.first == 0 ? fit.against_before : fit.against_after);
    }
  }

  Precision precision_;
  std::span<const Fault> faults_;  ///< from this step on
  std::int64_t first_wrong_;
  bool with_pairs_;
  std::uint8_t kind_ = 0;
  std::uint32_t wrong_ = 0;   ///< fields of this step
  std::vector<Made> made_{};  ///< said of this step
  ByEnum<Mistake, bool> against_{};
  std::vector<MadeByPair> made_by_pairs_{};
  std::vector<std::pair<std::uint32_t, std::uint32_t>> follows_{};
  std::map<Pair, Fit> pairs_{}, beside_{};
  ByEnum<Mistake, bool> ever_against_{};         ///< a step is not as it would have been
  ByEnum<Mistake, std::int64_t> unexplained_{};  ///< steps that are as it would have been, and wrong beyond it
  std::int64_t step_ = 0;
  std::int64_t in_plane_ = 0;  ///< the first step that may be a mistake with what lies in one plane
  ByEnum<Mistake, Fit> fits_{};
};

}  // namespace zstep::mistakes
