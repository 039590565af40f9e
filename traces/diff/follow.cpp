#include "traces/diff/follow.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "traces/diff/witness.hpp"
#include "traces/formulas/of_events.hpp"
#include "traces/formulas/walk.hpp"

namespace zstep::diff {

namespace {

Thing thing_in(Place::In in) {
  switch (in) {
    case Place::In::vertex:
      return Thing::vertex;
    case Place::In::edge_table:
    case Place::In::active_edge:
      return Thing::edge;
    case Place::In::piece:
      return Thing::piece;
    default:
      return Thing::none;
  }
}

/// What a step is part of: 1 the polygon, ray, area, line or curve, 2 the scan line, 3 the span; 0 begins nothing.
template <class E>
constexpr std::size_t begins() {
  if constexpr (std::is_same_v<E, PolygonBegin> || std::is_same_v<E, PieceDraw> || std::is_same_v<E, RayBegin> ||
                std::is_same_v<E, AreaBegin> || std::is_same_v<E, LineBegin> || std::is_same_v<E, CurveBegin> ||
                std::is_same_v<E, PairBegin> || std::is_same_v<E, NodeMake>)
    return 1;
  else if constexpr (std::is_same_v<E, ScanLineBegin> || std::is_same_v<E, CurveSegment>) return 2;
  else if constexpr (std::is_same_v<E, SpanBegin> || std::is_same_v<E, SpanFlags>) return 3;
  else return 0;
}

/// Goes through one of the two runs and follows what is different from step to step.
class Follow {
 public:
  Follow(const Trace& trace, bool of_a, const DiffReport& report, const std::vector<Elsewhere>& elsewhere,
         std::vector<Finding>& findings)
      : trace_(trace),
        of_a_(of_a),
        report_(report),
        elsewhere_(elsewhere),
        findings_(findings),
        identity_(trace) {
    const auto& all = report.alignment.differences;
    for (std::size_t i = 0; i < all.size(); ++i)
      if (own_step(all[i]) != 0) own_.push_back(static_cast<std::int32_t>(i));
    std::sort(own_.begin(), own_.end(), [&](std::int32_t one, std::int32_t other) {
      return own_step(all[static_cast<std::size_t>(one)]) < own_step(all[static_cast<std::size_t>(other)]);
    });
    scopes_.fill(no_difference);
  }

  /// Returns what the other run does not have, as places.
  std::vector<Elsewhere> run(const std::function<bool(std::int64_t)>& on_way) {
    constexpr std::int64_t now_and_then = 1 << 16;
    std::size_t next_elsewhere = 0;
    formulas::walk(
        trace_,
        [&](std::int64_t position, const auto& e, const formulas::Situation& at) {
          for (; next_elsewhere < elsewhere_.size() && elsewhere_[next_elsewhere].before < position; ++next_elsewhere)
            missing(elsewhere_[next_elsewhere]);
          step(position, e, at);
          return !(on_way && position % now_and_then == 0 && on_way(position));
        },
        [](std::int64_t, const Impossible&) {});  // `check` says so
    return std::move(alone_);
  }

 private:
  std::int64_t own_step(const Difference& difference) const { return of_a_ ? difference.a : difference.b; }

  /// The other run has written something there that this one has not.
  void missing(const Elsewhere& what) {
    Place place = what.place;
    if (const Thing thing = thing_in(place.in); thing != Thing::none) {
      const auto number = identity_.number_of(thing, what.name);
      if (!number) return;
      place.number = *number;
    }
    (findings_[static_cast<std::size_t>(what.difference)].rounding ? rounding_ : different_)
        .set(place, what.difference);
  }

  template <class E>
  void step(std::int64_t position, const E& e, const formulas::Situation& at) {
    std::int32_t number = no_difference;
    if (next_own_ < own_.size() &&
        own_step(report_.alignment.differences[static_cast<std::size_t>(own_[next_own_])]) == position)
      number = own_[next_own_++];
    const bool recorded_by_both = report_.alignment.kinds[kind_of<E>].pairs > 0 || number != no_difference;
    if (number != no_difference) judge(e, at, number);
    const bool by_rounding = number != no_difference && findings_[static_cast<std::size_t>(number)].rounding;
    if (number != no_difference || !different_.empty() || !rounding_.empty())
      for_each_place_written(e, at, [&](const Place& place) {
        different_.set(place, by_rounding ? no_difference : number);
        rounding_.set(place, by_rounding ? number : no_difference);
        if (number != no_difference) note_alone(number, place);
      });
    if constexpr (std::is_same_v<E, EdgeRetire>)
      if (number != no_difference) note_alone(number, Place{Place::In::active_edge, e.edge});
    if constexpr (std::is_same_v<E, BuffersClear>)
      for (const Place::In in : {Place::In::depth_buffer, Place::In::frame}) different_.clear(in), rounding_.clear(in);
    if constexpr (begins<E>() > 0)
      for (std::size_t rank = begins<E>(); rank < scopes_.size(); ++rank)
        scopes_[rank] = rank == begins<E>() ? number : no_difference;
    if (recorded_by_both) identity_.of(e);
  }

  template <class E>
  void judge(const E& e, const formulas::Situation& at, std::int32_t number) {
    const Difference& difference = report_.alignment.differences[static_cast<std::size_t>(number)];
    Finding& finding = findings_[static_cast<std::size_t>(number)];
    finding = {};
    Reads reads{different_, rounding_};
    Witness<E> witness{e, trace_.header(), report_.precision, difference.fields, reads};
    if constexpr (formulas::Derived<E, Witness<E>>) formulas::derive(e, at, witness);
    if constexpr (std::is_same_v<E, EdgeEnter>) reads(Place{Place::In::edge_table, e.edge});
    if constexpr (std::is_same_v<E, EdgeRetire>) reads(Place{Place::In::active_edge, e.edge});
    finding.wrong = witness.wrong;
    if constexpr (std::is_same_v<E, EdgeStep>)
      if (const EdgeTableInsert* entry = at.edge(e.edge); entry && (difference.only_a() || difference.only_b()))
        finding.idle = identity_.next_row(e.edge) >= entry->end_row;
    finding.comes_from = reads.from_different;
    const bool alone = difference.only_a() || difference.only_b();
    if (alone && finding.comes_from == no_difference)
      for (const std::int32_t scope : scopes_)
        if (scope != no_difference && !findings_[static_cast<std::size_t>(scope)].rounding) finding.comes_from = scope;
    if (finding.comes_from != no_difference || (finding.wrong && !alone)) return;

    // Neither different operands nor a wrong result: is it rounding, or what rounding decides?
    // Whether a step is done at all hangs on what was decided, not on digits.
    std::int32_t from = reads.from_rounding;
    if (alone && from != no_difference && !findings_[static_cast<std::size_t>(from)].decides) from = no_difference;
    if (alone && from == no_difference)
      for (const std::int32_t scope : scopes_)
        if (scope != no_difference && findings_[static_cast<std::size_t>(scope)].decides) from = scope;
    bool either_way = false;  // where two edges meet, either may be the left one
    if constexpr (std::is_same_v<E, SpanBegin>) either_way = witness.equal(e.x_left, e.x_right);
    const bool numbers_near =
        either_way || difference.off <= std::max(written_off(e, difference.fields), witness.may_be_off);
    const bool decided = exact_fields<E>(difference.fields);
    const bool any_rounding = either_way || from != no_difference || (difference.fields & ~exact_bits<E>()) != 0;
    finding.decides = alone || decided;
    finding.rounding = alone ? from != no_difference : numbers_near && (!decided || any_rounding);
    if (finding.rounding) finding.comes_from = from;
  }

  /// By what share the format alone lets the numbers of these fields be off, of the least of them.
  template <class E>
  double written_off(const E& e, std::uint16_t fields) const {
    const Precision& precision = report_.precision;
    double share = precision.relative;
    for_each_index<E>([&]<std::size_t I>() {
      if constexpr (std::is_same_v<FieldValue<E, I>, double>)
        if ((fields >> I & 1) != 0 && precision.absolute > 0)
          share = std::max(share, precision.relative + 2 * precision.absolute / std::abs(e.*field_at<E, I>.member));
    });
    return share;
  }

  /// The fields that are no numbers: what is decided by a number must part by more than rounding, or hang on one that
  /// does.
  template <class E>
  static constexpr std::uint16_t exact_bits() {
    std::uint16_t bits = 0;
    for_each_index<E>([&]<std::size_t I>() {
      if (!std::is_same_v<FieldValue<E, I>, double>) bits = static_cast<std::uint16_t>(bits | 1u << I);
    });
    return bits;
  }
  template <class E>
  static bool exact_fields(std::uint16_t fields) {
    return (fields & exact_bits<E>()) != 0;
  }

  void note_alone(std::int32_t number, const Place& place) {
    const Difference& difference = report_.alignment.differences[static_cast<std::size_t>(number)];
    if (!difference.only_a() && !difference.only_b()) return;
    const std::int64_t before =
        of_a_ ? report_.alignment.before_in_b(difference.a) : report_.alignment.before_in_a(difference.b);
    Identity::Key name = 0;
    if (const Thing thing = thing_in(place.in); thing != Thing::none)
      name = identity_.name_of(thing, static_cast<std::int32_t>(place.number));
    alone_.push_back({before, number, place, name});
  }

  const Trace& trace_;
  bool of_a_;
  const DiffReport& report_;
  const std::vector<Elsewhere>& elsewhere_;
  std::vector<Finding>& findings_;
  std::vector<Elsewhere> alone_;
  std::vector<std::int32_t> own_;  ///< differences by this run's steps
  std::size_t next_own_ = 0;
  Inheritance different_, rounding_;
  std::array<std::int32_t, 4> scopes_{};
  Identity identity_;
};

}  // namespace

std::vector<Elsewhere> follow(const Trace& trace, bool of_a, const DiffReport& report,
                              const std::vector<Elsewhere>& elsewhere, std::vector<Finding>& findings,
                              const std::function<bool(std::int64_t)>& on_way) {
  std::vector<Elsewhere> alone = Follow(trace, of_a, report, elsewhere, findings).run(on_way);
  std::stable_sort(alone.begin(), alone.end(),
                   [](const Elsewhere& one, const Elsewhere& other) { return one.before < other.before; });
  return alone;
}

}  // namespace zstep::diff
