#include "traces/diff/diff.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>

#include "traces/check/inheritance.hpp"
#include "traces/diff/identity.hpp"
#include "traces/formulas/follows.hpp"
#include "traces/formulas/of_events.hpp"
#include "traces/formulas/rounding.hpp"
#include "traces/formulas/situation_of.hpp"
#include "traces/replay/apply.hpp"
#include "traces/replay/beginning.hpp"

namespace zstep::diff {

namespace {

using formulas::Follows, formulas::Place, formulas::Rounded, formulas::Rule, formulas::Situation;

constexpr std::int32_t none = Inheritance::clean;

/// What going through one of the two runs says of a difference.
struct Finding {
  std::int32_t comes_from = none;  ///< an earlier difference that its operands, or what it is part of, go back to
  bool wrong = false;              ///< it does not follow from the run's own operands
  bool rounding = false;           ///< it, or what it comes from, is no more than rounding allows
  bool decides = false;            ///< what it says is no number, so that other steps may follow
  bool idle = false;               ///< an edge that ends is moved to where it ends, before it is taken out
};

/// A place that a step of the other run writes, which this run does not have.
struct Elsewhere {
  std::int64_t before = 0;  ///< the last step of this run that comes before it
  std::int32_t difference = 0;
  Place place;
  Identity::Key name = 0;  ///< of the edge, vertex or piece that the place is of; else 0
};

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

/// Which differences the operands of this step go back to.
struct Reads {
  const Inheritance &different, &rounding;
  std::int32_t from_different = none, from_rounding = none;

  void operator()(const Place& place) {
    if (from_different == none) from_different = different.of(place);
    if (from_rounding == none) from_rounding = rounding.of(place);
  }
};

/// Looks at how a step follows from its operands.
template <class E>
struct Witness {
  using Number = Rounded;
  const E& e;
  const Header& header;
  const Precision& precision;
  std::uint16_t differing;  ///< the fields in question
  Reads& reads_from;
  bool wrong = false;
  double may_be_off = 0;  ///< what rounding allows a field in question, as a share of it, at most
  bool near_tie = false;

  Number number(const auto&, double value, const Place& place) {
    if (place.in != Place::In::event && place.in != Place::In::scene) reads_from(place);
    Rounded known(value);
    if (precision.absolute > 0) known.spread += precision.absolute / precision.relative;
    return known;
  }
  Number named(std::string_view, const Number& formula) { return formula; }
  void reads(const Place& place) { reads_from(place); }
  bool trusts(const Place& place) const { return reads_from.different.of(place) == none; }
  bool equal(double one, double other) const {
    return formulas::gives(Rounded(one), other, precision.relative) || std::abs(one - other) <= precision.absolute;
  }

  void gives(Follows<E, double> field, const Number& formula) {
    if (!in_question(field)) return;
    const double value = e.*field.member;
    wrong = wrong || !(formulas::gives(formula, value, precision.relative) ||
                       std::abs(value - formula.value) <= precision.absolute);
    const double size = std::max(std::abs(value), std::abs(formula.value));
    if (size > 0)
      may_be_off = std::max(may_be_off, (2 * precision.relative * formula.spread + precision.absolute) / size);
  }
  void whole(Follows<E, std::int32_t> field, const Number&, std::int32_t within) {
    if (in_question(field)) wrong = wrong || e.*field.member != within;
  }
  template <class Value>
  void is(std::type_identity_t<Follows<E, Value>> field, Value value) {
    if (!in_question(field)) return;
    const Value recorded = e.*field.member;
    bool equal = recorded == value;
    if constexpr (std::is_same_v<Value, double>) equal = equal || this->equal(recorded, value) || value != value;
    wrong = wrong || !equal;
  }
  void verdict(Follows<E, bool> field, const Number& z, const Number& stored) {
    if (!in_question(field)) return;
    near_tie = equal(z.value, stored.value);
    const bool tie = z.value == stored.value;
    if (header.declares(tie ? Convention::ties : Convention::nearer))
      wrong = wrong || e.*field.member != header.comparison.wins(z.value, stored.value);
  }
  void rule(Rule, bool holds) { wrong = wrong || !holds; }

 private:
  template <class Value>
  bool in_question(const Follows<E, Value>& field) const {
    return (differing >> field.number & 1) != 0;
  }
};

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
  Follow(const Trace& trace, const DiffReport& report, bool of_a, std::vector<Finding>& findings,
         const std::vector<Elsewhere>& elsewhere)
      : trace_(trace),
        report_(report),
        of_a_(of_a),
        findings_(findings),
        elsewhere_(elsewhere),
        beginning_(trace),
        state_(beginning_.state()),
        at_(formulas::situation_of(trace, state_)),
        identity_(trace) {
    const auto& all = report.alignment.differences;
    for (std::size_t i = 0; i < all.size(); ++i)
      if (own_step(all[i]) != 0) own_.push_back(static_cast<std::int32_t>(i));
    std::sort(own_.begin(), own_.end(), [&](std::int32_t one, std::int32_t other) {
      return own_step(all[static_cast<std::size_t>(one)]) < own_step(all[static_cast<std::size_t>(other)]);
    });
    scopes_.fill(none);
  }

  /// Returns what the other run does not have, as places.
  std::vector<Elsewhere> run(const std::function<bool(std::int64_t)>& on_way) {
    constexpr std::int64_t now_and_then = 1 << 16;
    std::size_t next_elsewhere = 0;
    trace_.each(0, trace_.size(), [&](std::int64_t position, const RecordedEvent& recorded) {
      for (; next_elsewhere < elsewhere_.size() && elsewhere_[next_elsewhere].before < position; ++next_elsewhere)
        missing(elsewhere_[next_elsewhere]);
      visit_event([&](const auto& e) { step(position, e); }, recorded.event);
      return !(on_way && position % now_and_then == 0 && on_way(position));
    });
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
  void step(std::int64_t position, const E& e) {
    at_.look();
    std::int32_t number = none;
    if (next_own_ < own_.size() &&
        own_step(report_.alignment.differences[static_cast<std::size_t>(own_[next_own_])]) == position)
      number = own_[next_own_++];
    const bool recorded_by_both = report_.alignment.kinds[kind_of<E>].pairs > 0 || number != none;
    if (number != none) judge(e, number);
    const bool by_rounding = number != none && findings_[static_cast<std::size_t>(number)].rounding;
    if (number != none || !different_.empty() || !rounding_.empty())
      for_each_place_written(e, at_, [&](const Place& place) {
        different_.set(place, by_rounding ? none : number);
        rounding_.set(place, by_rounding ? number : none);
        if (number != none) note_alone(number, place);
      });
    if constexpr (std::is_same_v<E, EdgeRetire>)
      if (number != none) note_alone(number, Place{Place::In::active_edge, e.edge});
    if constexpr (std::is_same_v<E, BuffersClear>)
      for (const Place::In in : {Place::In::depth_buffer, Place::In::frame}) different_.clear(in), rounding_.clear(in);
    if constexpr (begins<E>() > 0)
      for (std::size_t rank = begins<E>(); rank < scopes_.size(); ++rank)
        scopes_[rank] = rank == begins<E>() ? number : none;
    if (recorded_by_both) identity_.of(e);
    try {
      apply_stores(e, state_, trace_.scene().points.size(), log_);
      apply_method_state(e, state_.machine, position);
    } catch (const Impossible&) {  // `check` says so
    }
    state_.position = position;
  }

  template <class E>
  void judge(const E& e, std::int32_t number) {
    const Difference& difference = report_.alignment.differences[static_cast<std::size_t>(number)];
    Finding& finding = findings_[static_cast<std::size_t>(number)];
    finding = {};
    Reads reads{different_, rounding_};
    Witness<E> witness{e, trace_.header(), report_.precision, difference.fields, reads};
    if constexpr (formulas::Derived<E, Witness<E>>) formulas::derive(e, at_, witness);
    if constexpr (std::is_same_v<E, EdgeEnter>) reads(Place{Place::In::edge_table, e.edge});
    if constexpr (std::is_same_v<E, EdgeRetire>) reads(Place{Place::In::active_edge, e.edge});
    finding.wrong = witness.wrong;
    if constexpr (std::is_same_v<E, EdgeStep>)
      if (const EdgeTableInsert* entry = at_.edge(e.edge); entry && (difference.only_a() || difference.only_b()))
        finding.idle = identity_.next_row(e.edge) >= entry->end_row;
    finding.comes_from = reads.from_different;
    const bool alone = difference.only_a() || difference.only_b();
    if (alone && finding.comes_from == none)
      for (const std::int32_t scope : scopes_)
        if (scope != none && !findings_[static_cast<std::size_t>(scope)].rounding) finding.comes_from = scope;
    if (finding.comes_from != none || (finding.wrong && !alone)) return;

    // Neither different operands nor a wrong result: is it rounding, or what rounding decides?
    // Whether a step is done at all hangs on what was decided, not on digits.
    std::int32_t from = reads.from_rounding;
    if (alone && from != none && !findings_[static_cast<std::size_t>(from)].decides) from = none;
    if (alone && from == none)
      for (const std::int32_t scope : scopes_)
        if (scope != none && findings_[static_cast<std::size_t>(scope)].decides) from = scope;
    bool either_way = false;  // where two edges meet, either may be the left one
    if constexpr (std::is_same_v<E, SpanBegin>) either_way = witness.equal(e.x_left, e.x_right);
    const bool numbers_near =
        either_way || difference.off <= std::max(written_off(e, difference.fields), witness.may_be_off);
    const bool decided = exact_fields<E>(difference.fields);
    const bool any_rounding = either_way || from != none || (difference.fields & ~exact_bits<E>()) != 0;
    finding.decides = alone || decided;
    finding.rounding = alone ? from != none : numbers_near && (!decided || any_rounding);
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
  const DiffReport& report_;
  bool of_a_;
  std::vector<Finding>& findings_;
  const std::vector<Elsewhere>& elsewhere_;
  std::vector<Elsewhere> alone_;
  std::vector<std::int32_t> own_;  ///< differences by this run's steps
  std::size_t next_own_ = 0;
  Inheritance different_, rounding_;
  std::array<std::int32_t, 4> scopes_{};
  Beginning beginning_;
  State state_;
  Situation at_;
  Identity identity_;
  NoLog log_;
};

/// Where each difference comes from in the end.
class Roots {
 public:
  Roots(const std::vector<Finding>& in_a, const std::vector<Finding>& in_b) : in_a_(in_a), in_b_(in_b) {
    root_.assign(in_a.size(), none);
  }
  std::int32_t of(std::int32_t difference) {
    std::vector<std::int32_t> way;
    std::int32_t at = difference;
    while (root_[index(at)] == none) {
      root_[index(at)] = on_the_way;
      way.push_back(at);
      const std::int32_t next = from(at);
      if (next == none) break;
      at = next;
    }
    std::int32_t root = root_[index(at)] >= 0 ? root_[index(at)] : at;
    // Where the orders of the two runs part, the way may lead round in a circle: then the first of all is the root.
    if (const auto circle = std::find(way.begin(), way.end(), at); circle != way.end() && from(at) != none)
      root = *std::min_element(circle, way.end());
    for (const std::int32_t one : way) root_[index(one)] = root;
    return root;
  }
  bool wrong_a(std::int32_t d) const { return in_a_[index(d)].wrong; }
  bool wrong_b(std::int32_t d) const { return in_b_[index(d)].wrong; }
  bool by_rounding(std::int32_t d, const Difference& difference) const {
    return (difference.only_b() || in_a_[index(d)].rounding) && (difference.only_a() || in_b_[index(d)].rounding);
  }

 private:
  static constexpr std::int32_t on_the_way = -2;
  static std::size_t index(std::int32_t d) { return static_cast<std::size_t>(d); }
  std::int32_t from(std::int32_t d) const {
    const Finding &a = in_a_[index(d)], &b = in_b_[index(d)];
    if (a.wrong != b.wrong) return none;  // one of the two computes it wrongly
    return b.comes_from != none ? b.comes_from : a.comes_from;
  }

  const std::vector<Finding>&in_a_, &in_b_;
  std::vector<std::int32_t> root_;
};

/// Steps that right programs do or leave out: to begin a polygon or a scan line where there is nothing to do, to change
/// neighbours on the way to a list in order. They count where something follows.
bool may_be_missing(const Difference& difference) {
  return (difference.only_a() || difference.only_b()) &&
         (difference.kind == kind_of<PolygonBegin> || difference.kind == kind_of<ScanLineBegin> ||
          difference.kind == kind_of<EdgeSwap>);
}

bool writes_pixel(std::uint8_t kind) {
  return kind == kind_of<PixelWrite> || kind == kind_of<PixelPaint> || kind == kind_of<ColorWrite> ||
         kind == kind_of<ColorBlend>;
}

void find_causes(DiffReport& report, const std::vector<Finding>& in_a, const std::vector<Finding>& in_b) {
  const auto& differences = report.alignment.differences;
  Roots roots(in_a, in_b);
  // By what parts: several of one sort are one cause that comes again.
  using Sort = std::tuple<std::uint8_t, std::uint16_t, bool, bool, Part>;
  std::map<Sort, std::size_t> known;
  std::vector<std::size_t> cause_of(differences.size());
  std::vector<bool> followed(differences.size());
  for (std::size_t i = 0; i < differences.size(); ++i)
    if (const std::int32_t root = roots.of(static_cast<std::int32_t>(i)); root != static_cast<std::int32_t>(i))
      followed[static_cast<std::size_t>(root)] = true;
  for (const bool symptoms : {false, true}) {
    for (std::size_t i = 0; i < differences.size(); ++i) {
      const auto d = static_cast<std::int32_t>(i);
      const Difference& difference = differences[i];
      const std::int32_t root = roots.of(d);
      if ((root != d) != symptoms) continue;
      if (!symptoms && (may_be_missing(difference) || in_a[i].idle || in_b[i].idle) && !followed[i]) continue;
      if (!symptoms) {
        const Part part = roots.by_rounding(d, difference) ? Part::rounding : Part::different;
        const Sort sort{difference.kind, difference.fields, difference.only_a(), difference.only_b(), part};
        const auto [found, fresh] = known.try_emplace(sort, report.causes.size());
        if (fresh) report.causes.push_back({difference, part, roots.wrong_a(d), roots.wrong_b(d), 0, 0, 0});
        else ++report.causes[found->second].again;
        cause_of[i] = found->second;
      } else {
        cause_of[i] = cause_of[static_cast<std::size_t>(root)];
        ++report.causes[cause_of[i]].symptoms;
      }
      Cause& cause = report.causes[cause_of[i]];
      cause.pixels += writes_pixel(difference.kind);
      if (!difference.only_a() && !difference.only_b()) {
        KindDifference& kind = report.kinds[difference.kind];
        ++(cause.part == Part::rounding ? kind.rounding : kind.different);
      }
    }
  }
  std::stable_sort(report.causes.begin(), report.causes.end(),
                   [](const Cause& one, const Cause& other) { return one.part < other.part; });
}

void sort_by_place(std::vector<Elsewhere>& elsewhere) {
  std::stable_sort(elsewhere.begin(), elsewhere.end(),
                   [](const Elsewhere& one, const Elsewhere& other) { return one.before < other.before; });
}

}  // namespace

std::int64_t DiffReport::differences() const {
  std::int64_t all = 0;
  for (const Cause& cause : causes)
    if (cause.part == Part::different) all += 1 + cause.again + cause.symptoms;
  return all;
}

DiffReport compare(const Trace& a, const Trace& b, const std::function<bool(double)>& on_way) {
  DiffReport report;
  bool told_to_end = false;
  const auto part_of = [&](double from, double share) {
    return [&, from, share](double done) { return on_way && (told_to_end = on_way(from + share * done)); };
  };
  report.alignment = align(a, b, part_of(0, 0.5));
  const Precision of_a = precision_of(a), of_b = precision_of(b);
  const bool a_coarser = of_a.relative > of_b.relative || of_a.absolute > of_b.absolute;
  report.precision = a_coarser ? of_a : of_b;
  report.precision.relative = std::max(of_a.relative, of_b.relative);
  report.precision.absolute = std::max(of_a.absolute, of_b.absolute);
  for (std::size_t kind = 0; kind < kind_count; ++kind) {
    const KindCount& count = report.alignment.kinds[kind];
    report.kinds[kind] = {count.equal, 0, 0, count.only_a, count.only_b};
  }
  if (report.alignment.differences.empty()) return report;

  std::vector<Finding> in_a(report.alignment.differences.size()), in_b = in_a;
  std::vector<Elsewhere> elsewhere;
  const auto follow = [&](const Trace& trace, bool of_a_run, std::vector<Finding>& findings, double from) {
    if (told_to_end) return;
    const auto on_step = part_of(from, 0.16);
    Follow walk(trace, report, of_a_run, findings, elsewhere);
    elsewhere = walk.run([&](std::int64_t position) {
      return on_step(static_cast<double>(position) / static_cast<double>(trace.size()));
    });
    sort_by_place(elsewhere);
  };
  // What only one run does is not seen in going through the other: so the one that was gone through first is gone
  // through again.
  follow(a, true, in_a, 0.5);
  follow(b, false, in_b, 0.66);
  follow(a, true, in_a, 0.82);
  if (told_to_end) report.alignment.complete = false;
  find_causes(report, in_a, in_b);
  return report;
}

}  // namespace zstep::diff
