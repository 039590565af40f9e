// How a step follows from its operands, and which differences these go back to.

#include "traces/diff/follow.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <type_traits>
#include <utility>

#include "traces/check/precision.hpp"
#include "traces/diff/parting.hpp"
#include "traces/file/visit.hpp"
#include "traces/formulas/of_events.hpp"
#include "traces/formulas/rounding.hpp"
#include "traces/formulas/situation.hpp"
#include "traces/formulas/walk.hpp"
#include "traces/replay/key_frames.hpp"
#include "traces/scene.hpp"

namespace zstep::diff {

namespace {

struct Approach {
  const DiffReport& report;
  Replaying run;
  Identity identity;
  GoOn go_on;

  template <class E>
  bool operator()(std::int64_t position, std::uint8_t, const E& e) {
    run.apply(position, e);
    if (report.alignment.kinds[kind_of<E>].pairs > 0 || (says_whose_turn<E> && report.alignment.turns))
      identity.take_note_of(e);
    return go_on(position);
  }
  bool operator()(std::int64_t position, const codec::FragmentRun& pixels) { return pass(position, pixels); }
  bool operator()(std::int64_t position, const codec::PaintRun& pixels) { return pass(position, pixels); }

 private:
  bool pass(std::int64_t position, const auto& pixels) {
    run.apply_pixels(position, pixels);
    return go_on(position);
  }
};

}  // namespace

BeforeFirst go_to_first(const Trace& trace, bool of_a, const DiffReport& report,
                        const std::function<bool(std::int64_t)>& on_way, Way way) {
  std::int64_t first = trace.size(), last = 0;
  for (const Difference& difference : report.alignment.differences) {
    const std::int64_t own = own_step(difference, of_a);
    first = std::min(first, own != 0 ? own - 1 : step_before(report.alignment, difference, of_a));
    last = std::max(last, own);
  }
  if (way == Way::plain) first = 0, last = trace.size();
  Approach approach{report, {trace, Beginning(trace).state()}, Identity(trace), GoOn(on_way)};
  if (first < last) trace.visit(0, first, approach);
  return {first, last, approach.run.state(), std::move(approach.identity)};
}

using formulas::Follows, formulas::Place, formulas::Rounded, formulas::Rule;

/// Which differences the operands of this step go back to.
struct Reads {
  const Inheritance &different, &rounding;
  const std::vector<Finding>& findings;
  std::int32_t from_different = no_difference, from_rounding = no_difference;
  std::int32_t stored_different = no_difference;  ///< what a compare holds its depth against; the depth does not follow
  float operands_off = 0;                         ///< how far operands are off by rounding, as a share of them, at most

  void operator()(const Place& place) {
    if (from_different == no_difference) from_different = different.of(place);
    const std::int32_t from = rounding.of(place);
    if (from_rounding == no_difference) from_rounding = from;
    if (from != no_difference) operands_off = std::max(operands_off, findings[from].off);
  }
  /// The stored depth decides a compare, and nothing else of it.
  void stored(const Place& place) {
    Reads reads{different, rounding, findings};
    reads(place);
    stored_different = reads.from_different;
    if (from_rounding == no_difference) from_rounding = reads.from_rounding;
    operands_off = std::max(operands_off, reads.operands_off);
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
  /// The same where operands may be off by more than the number format has them: where they are small differences of
  /// large numbers.
  double may_be_off_here() const {
    const double more = reads_from.operands_off / (2 * precision.relative);
    constexpr double digits_of_shares = 1 + 1e-6;
    return may_be_off * std::max(1.0, more * digits_of_shares);
  }
  bool undeclared = false;  ///< the header does not say which verdict is right
  bool decides = false;     ///< a verdict is in question
  double gap = 0;           ///< by how much the two depths differ that it is about
  std::uint16_t told = 0;   ///< the fields in question that were held against something

  Number number(const auto&, double value, const Place& place) {
    if (has(at_pixel<E>, AtPixel::verdict) && place.in == Place::In::depth_buffer) reads_from.stored(place);
    else if (place.in != Place::In::event && place.in != Place::In::scene) reads_from(place);
    Rounded known(value);
    if (precision.largest_amount() > 0) known.spread += precision.amount(place) / precision.relative;
    return known;
  }
  Number named(std::string_view, const Number& formula) { return formula; }
  void reads(const Place& place) { reads_from(place); }
  bool trusts(const Place& place) const { return reads_from.different.of(place) == no_difference; }
  bool equal(double one, double other) const {
    return formulas::gives(Rounded(one), other, precision.relative) ||
           std::abs(one - other) <= precision.largest_amount();
  }

  void gives(Follows<E, double> field, const Number& formula) {
    if (!asks(field)) return;
    const double value = e.*field.member, amount = precision.amount(field.unit);
    wrong =
        wrong || !(formulas::gives(formula, value, precision.relative) || std::abs(value - formula.value) <= amount);
    const double size = std::max(std::abs(value), std::abs(formula.value));
    // What is 0 in one run the other run is asked about: there it has a size.
    may_be_off = std::max(may_be_off, (2 * precision.relative * formula.spread + amount) / size);
  }
  void within(Follows<E, double> field, const Number& formula, double off) {
    if (!asks(field)) return;
    const double value = e.*field.member, amount = precision.amount(field.unit) + off;
    wrong = wrong || !(std::abs(value - formula.value) <= amount);
    may_be_off = std::max(may_be_off, 2 * amount / std::max(std::abs(value), std::abs(formula.value)));
  }
  void near(Follows<E, double> field, const Rounded& number) {
    if (in_question(field)) gives(field, number);
  }
  void whole(Follows<E, std::int32_t> field, const Number&, std::int32_t within) {
    if (asks(field)) wrong = wrong || e.*field.member != within;
  }
  template <class Value>
  void is(std::type_identity_t<Follows<E, Value>> field, Value value) {
    if (!asks(field)) return;
    const Value recorded = e.*field.member;
    bool equal = recorded == value;
    if constexpr (std::is_same_v<Value, double>) equal = equal || this->equal(recorded, value) || value != value;
    wrong = wrong || !equal;
  }
  void verdict(Follows<E, bool> field, const Number& z, const Number& stored) {
    if (!asks(field)) return;
    decides = true, gap = z.value == stored.value ? 0 : std::abs(z.value - stored.value);
    const bool tie = z.value == stored.value;
    if (header.declares(tie ? Convention::ties : Convention::nearer))
      wrong = wrong || e.*field.member != header.comparison.wins(z.value, stored.value);
    else undeclared = true;
  }
  /// That a pixel before was not written is a difference of its own, and not this step's.
  void rule(Rule rule, bool holds) { wrong = wrong || (!holds && rule != Rule::win_is_written); }

 private:
  template <class Value>
  bool in_question(const Follows<E, Value>& field) const {
    return (differing >> field.number & 1) != 0;
  }
  template <class Value>
  bool asks(const Follows<E, Value>& field) {
    if (in_question(field)) told = static_cast<std::uint16_t>(told | 1u << field.number);
    return in_question(field);
  }
};

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
  else if constexpr (std::is_same_v<E, ScanLineBegin> || std::is_same_v<E, CurveSegment> ||
                     std::is_same_v<E, TriangleSetup>)
    return 2;
  else if constexpr (std::is_same_v<E, SpanBegin> || std::is_same_v<E, SpanFlags>) return 3;
  else return 0;
}

/// What has to be begun for a step, by the same ranks: its scan line, its pair; 0 for nothing.
template <class E>
constexpr std::size_t belongs_to() {
  if constexpr (std::is_same_v<E, SpanBegin> || std::is_same_v<E, SpanFlags> || std::is_same_v<E, EdgeEnter>) return 2;
  else if constexpr (std::is_same_v<E, ExtentTest> || std::is_same_v<E, OverlapTest>) return 1;
  else return 0;
}

/// Goes through one of the two runs and follows what is different from step to step.
class Follow {
 public:
  Follow(const Trace& trace, bool of_a, const DiffReport& report, const BeforeFirst& before,
         const std::vector<Elsewhere>& elsewhere, std::vector<Finding>& findings, GoOn go_on, bool plain)
      : trace_(trace),
        of_a_(of_a),
        report_(report),
        elsewhere_(elsewhere),
        findings_(findings),
        run_(trace, before.state),
        at_(formulas::situation_of(trace, run_.state())),
        identity_(before.identity),
        go_on_(go_on),
        last_(before.last),
        plain_(plain),
        rows_(static_cast<std::size_t>(trace.scene().raster.height)),
        box_margin_(formulas::detail::box_margin(trace.scene())) {
    const auto& all = report.alignment.differences;
    for (std::size_t i = 0; i < all.size(); ++i)
      if (own_step(all[i], of_a_) != 0) own_.push_back(index32(i));
    const auto step_of = [&](std::int32_t number) { return own_step(all[number], of_a_); };
    std::sort(own_.begin(), own_.end(),
              [&](std::int32_t one, std::int32_t other) { return step_of(one) < step_of(other); });
    scopes_.fill(no_difference);
  }

  template <class E>
  bool operator()(std::int64_t position, std::uint8_t, const E& e) {
    for (; next_missing() < position; ++next_elsewhere_) missing(elsewhere_[next_elsewhere_]);
    at_.look();
    step(position, e);
    run_.apply(position, e);
    at_.passed(position, e);
    return go_on_(position) && (position < last_ || may_be_needed());
  }
  bool operator()(std::int64_t position, const codec::FragmentRun& pixels) { return pass(position, pixels); }
  bool operator()(std::int64_t position, const codec::PaintRun& pixels) { return pass(position, pixels); }

  /// What the other run does not have, as places.
  std::vector<Elsewhere> take_alone() { return std::move(alone_); }

 private:
  static constexpr std::int64_t never = std::numeric_limits<std::int64_t>::max();
  std::int64_t next_missing() const {
    return next_elsewhere_ < elsewhere_.size() ? elsewhere_[next_elsewhere_].before : never;
  }
  std::int64_t next_difference() const {
    return next_own_ < own_.size() ? own_step(report_.alignment.differences[own_[next_own_]], of_a_) : never;
  }

  /// Pixels at which nothing is different are passed at once.
  template <class Run>
  bool pass(std::int64_t position, const Run& pixels) {
    const std::int64_t end = position + pixels.events();
    const bool here = next_missing() < end || next_difference() <= end;
    const bool several = at_.ahead.spans().size() > 1;
    if (!here && !several && !plain_ && !fragment_ && !rows_[pixels.y]) {
      run_.apply_pixels(position, pixels);
      at_.ahead.pass_pixels();
      return go_on_(position);
    }
    const bool going_on = pixels.expand([&](std::uint8_t line, const auto& e) { return (*this)(++position, line, e); });
    const Place fragment{Place::In::fragment, 0};
    fragment_ = different_.of(fragment) != no_difference || rounding_.of(fragment) != no_difference;
    return going_on;
  }
  /// There is, or was, something different here.
  void mark(const Place& place) {
    if (place.in == Place::In::fragment) fragment_ = true;
    if (place.in != Place::In::depth_buffer && place.in != Place::In::light_buffer && place.in != Place::In::frame)
      return;
    const std::size_t row = place.number / trace_.scene().raster.width;
    if (row < rows_.size()) rows_[row] = true;
  }

  /// The other run has written something there that this one has not.
  void missing(const Elsewhere& what) {
    Place place = what.place;
    if (const Thing thing = thing_in(place.in); thing != Thing::none) {
      const auto number = identity_.number_of(thing, what.name);
      if (!number) return;
      place.number = *number;
    }
    (findings_[what.difference].rounding ? rounding_ : different_).set(place, what.difference);
    const std::uint8_t kind = report_.alignment.differences[what.difference].kind;
    if (list_ == no_difference && (kind == kind_of<EdgeEnter> || kind == kind_of<EdgeRetire>)) list_ = what.difference;
    mark(place);
  }

  template <class E>
  void step(std::int64_t position, const E& e) {
    const std::int32_t number = next_difference() == position ? own_[next_own_++] : no_difference;
    if constexpr (std::is_same_v<E, PairBegin>) note_pair(e);
    if (number != no_difference) judge(e, number);
    else if constexpr (belongs_to<E>() != 0) need(scopes_[belongs_to<E>()]);
    const bool by_rounding = number != no_difference && findings_[number].rounding;
    if (number != no_difference || !different_.empty() || !rounding_.empty())
      for_each_place_written(e, at_, [&](const Place& place) {
        if (adds_to_place<E> && number == no_difference) return;
        different_.set(place, by_rounding ? no_difference : number);
        rounding_.set(place, by_rounding ? number : no_difference);
        if (number != no_difference) note_alone(number, place), mark(place);
      });
    // What enters the list takes its numbers from the table.
    if constexpr (std::is_same_v<E, EdgeEnter>)
      if (number == no_difference) {
        const Place from{Place::In::edge_table, e.edge}, to{Place::In::active_edge, e.edge};
        different_.set(to, different_.of(from)), rounding_.set(to, rounding_.of(from));
      }
    if constexpr (std::is_same_v<E, EdgeRetire>)
      if (number != no_difference) note_alone(number, Place{Place::In::active_edge, e.edge});
    if constexpr (std::is_same_v<E, EdgeEnter> || std::is_same_v<E, EdgeRetire> || std::is_same_v<E, EdgeSwap>)
      if (number != no_difference && list_ == no_difference) list_ = number;
    if constexpr (begins<E>() == 1) list_ = no_difference;
    if constexpr (std::is_same_v<E, BuffersClear>)
      for (const Place::In in : {Place::In::depth_buffer, Place::In::frame}) different_.clear(in), rounding_.clear(in);
    if constexpr (begins<E>() > 0)
      for (std::size_t rank = begins<E>(); rank < scopes_.size(); ++rank)
        scopes_[rank] = rank == begins<E>() && !is_empty(e) ? number : no_difference;
    if (report_.alignment.kinds[kind_of<E>].pairs > 0 || number != no_difference ||
        (says_whose_turn<E> && report_.alignment.turns))
      identity_.take_note_of(e);
  }

  /// A span without pixels begins nothing.
  template <class E>
  static bool is_empty(const E& e) {
    if constexpr (std::is_same_v<E, SpanBegin> || std::is_same_v<E, SpanFlags>) return e.first > e.last;
    else return false;
  }

  /// Has the last difference begun something that is not over yet?
  bool may_be_needed() const { return scopes_[1] != no_difference || scopes_[2] != no_difference; }
  /// A step that both runs have belongs to what only this one begins.
  void need(std::int32_t begun) {
    if (begun != no_difference) findings_[begun].needed = true;
  }

  template <class E>
  void judge(const E& e, std::int32_t number) {
    const formulas::Situation& at = at_;
    const Difference& difference = report_.alignment.differences[number];
    Finding& finding = findings_[number];
    finding = {};
    Reads reads{different_, rounding_, findings_};
    Witness<E> witness{e, trace_.header(), report_.precision, difference.fields, reads};
    if constexpr (formulas::Derived<E, Witness<E>>) formulas::derive(e, at, witness);
    if constexpr (std::is_same_v<E, EdgeEnter>) reads(Place{Place::In::edge_table, e.edge});
    if constexpr (std::is_same_v<E, EdgeRetire>) reads(Place{Place::In::active_edge, e.edge});
    finding.wrong = witness.wrong;
    bool either_way = false;  // where two edges meet, either may be the left one
    if constexpr (std::is_same_v<E, SpanBegin>) {
      either_way = witness.equal(e.x_left, e.x_right);
      finding.says_nothing = either_way && !witness.wrong ? bit_of<SpanBegin>("dz_dx") : says_nothing(e);
    }
    finding.told = (difference.fields & ~exact_bits<E>() & ~witness.told & ~finding.says_nothing) == 0;
    if constexpr (std::is_same_v<E, EdgeStep>)
      if (const EdgeTableInsert* entry = at.edge(e.edge); entry && (difference.only_a() || difference.only_b()))
        finding.idle = identity_.next_row(e.edge) >= entry->end_row;
    const bool alone = difference.only_a() || difference.only_b();
    if constexpr (std::is_same_v<E, PairBegin>) finding.idle = alone && undecided_ >= 0;
    else if constexpr (tests_pair<E>()) finding.idle = alone && is_undecided();
    const bool empty = alone && is_empty(e);  // what has no pixels does not follow from the span before it
    finding.idle = finding.idle || empty;
    // Of a plane whose normal has another length; of opposite signs they would be off by more than the larger one.
    const bool of_longer_normal =
        only_as_long_as_normal<E>(difference.fields) && reads.from_rounding != no_difference && difference.off < 1;
    const double margin = formulas::off_by_margin(e, at, box_margin_, share_apart);
    const double allowed =
        std::max({written_off(e, difference.fields), witness.may_be_off_here(), double{reads.operands_off}, margin});
    const bool slope_is_noise = either_way && says_nothing(e) == 0;
    const bool numbers_near = slope_is_noise || of_longer_normal || difference.off <= allowed;

    if constexpr (std::is_same_v<E, SpanBegin>) {
      finding.free = !alone && names_either(e, difference.fields & ~finding.says_nothing, witness);
      finding.rounding = finding.free;
      if (finding.free) return;
    }
    finding.tie = witness.decides && witness.gap == 0;
    finding.unjudged = witness.undeclared || (difference.fields & exact_bits<E>() & ~witness.told) != 0;
    finding.comes_from = reads.from_different;
    // Which edges a span goes between follows from the list that they stand in.
    if constexpr (std::is_same_v<E, SpanBegin>) {
      constexpr auto edges = bit_of<SpanBegin>("left_edge") | bit_of<SpanBegin>("right_edge");
      if (list_ != no_difference && (alone || (difference.fields & edges) != 0)) {
        finding.wrong = false;
        if (finding.comes_from == no_difference) finding.comes_from = list_;
      }
    }
    // Where the depth of a compare is as it should be, the verdict follows from what is stored there.
    if (!alone && numbers_near && finding.comes_from == no_difference) finding.comes_from = reads.stored_different;
    if constexpr (std::is_same_v<E, ScanLineBegin> || std::is_same_v<E, EdgeStep>)
      if (alone && finding.comes_from == no_difference) finding.comes_from = rows_of_edges(e);
    if (alone && !empty && finding.comes_from == no_difference)
      for (const std::int32_t scope : scopes_)
        if (scope != no_difference && !findings_[scope].rounding) finding.comes_from = scope;
    if (finding.comes_from != no_difference || (finding.wrong && !alone)) return;

    // Neither different operands nor a wrong result: is it rounding, or what rounding decides?
    // Whether a step is done at all hangs on what was decided, not on digits.
    std::int32_t from = reads.from_rounding;
    if (alone && from != no_difference && !findings_[from].decides) from = no_difference;
    if (alone && !empty && from == no_difference)
      for (const std::int32_t scope : scopes_)
        if (scope != no_difference && findings_[scope].decides) from = scope;
    const bool decided = exact_fields<E>(difference.fields);
    const bool any_rounding = either_way || from != no_difference || (difference.fields & ~exact_bits<E>()) != 0;
    finding.decides = alone || decided;
    const bool may_turn = !witness.decides || witness.gap <= 2 * may_move(e, allowed);
    finding.rounding = alone ? from != no_difference : numbers_near && may_turn && (!decided || any_rounding);
    if (finding.rounding) finding.comes_from = from, finding.off = of_longer_normal ? 0 : difference.off;
  }

  /// Whether an edge is moved, and whether there is a scan line at all, follows from the lines that edges are on: what
  /// differs in those of this edge, or of an edge of this line.
  std::int32_t rows_of_edges(const EdgeStep& e) const {
    constexpr std::uint16_t rows = bit_of<EdgeTableInsert>("first_row") | bit_of<EdgeTableInsert>("end_row");
    const std::int32_t from = different_.of(Place{Place::In::edge_table, e.edge});
    if (from == no_difference) return no_difference;
    const Difference& entry = report_.alignment.differences[from];
    const bool differ = entry.only_a() || entry.only_b() || (entry.fields & rows) != 0;
    return entry.kind == kind_of<EdgeTableInsert> && differ ? from : no_difference;
  }
  std::int32_t rows_of_edges(const ScanLineBegin& e) const {
    std::int32_t found = no_difference;
    const auto& table = at_.method().edge_table;
    for (std::size_t edge = 0; edge < table.size() && found == no_difference; ++edge)
      if (table[edge].first_row <= e.y && e.y < table[edge].end_row)
        found = rows_of_edges(EdgeStep{index32(edge), 0, 0});
    return found;
  }

  /// Does a span only name another edge, with that edge's z, where two of them meet the scan line at one x?
  bool names_either(const SpanBegin& e, int fields, const Witness<SpanBegin>& witness) const {
    constexpr std::uint16_t left = bit_of<SpanBegin>("left_edge"), right = bit_of<SpanBegin>("right_edge");
    const auto shared = [&](std::int32_t edge, double x) {
      bool there = false, another = false;
      for (const ActiveEdge& active : at_.method().active)
        if (witness.equal(active.x, x)) (active.edge == edge ? there : another) = true;
      return there && another;
    };
    bool either = e.left_edge != e.right_edge;
    for_each_index<SpanBegin>([&]<std::size_t I>() {
      constexpr std::string_view name = field_at<SpanBegin, I>.name;
      if ((fields >> I & 1) == 0) return;
      either = either && (name == "left_edge"    ? shared(e.left_edge, e.x_left)
                          : name == "right_edge" ? shared(e.right_edge, e.x_right)
                          : name == "z_left"     ? !witness.wrong && (fields & left) != 0
                          : name == "z_right"    ? !witness.wrong && (fields & right) != 0
                                                 : false);
    });
    return either;
  }

  /// Steps by which a pair of pieces is tested.
  template <class E>
  static constexpr bool tests_pair() {
    return std::is_same_v<E, PairBegin> || std::is_same_v<E, ExtentTest> || std::is_same_v<E, SideTest> ||
           std::is_same_v<E, OverlapTest>;
  }
  /// Where z extents meet but for rounding, other tests are made or left out, with this piece of the list and later
  /// ones. Of a pair that both runs test, only if it is this pair's own z extents that meet.
  bool is_undecided() const {
    const auto& pair = at_.method().pair;
    return undecided_ >= 0 && pair && pair->piece == undecided_ && (pair_meets_ || scopes_[1] != no_difference);
  }
  void note_pair(const PairBegin& e) {
    const Piece *piece = at_.piece(e.piece), *other = at_.piece(e.other);
    if (undecided_ != e.piece) undecided_ = -1;
    pair_meets_ = false;
    if (!piece || !other || !piece->extent || !other->extent) return;
    const double z = piece->extent->z_min, z_other = other->extent->z_max;
    const auto equal = [&](double one, double end) {
      return formulas::gives(Rounded(one), end, report_.precision.relative) ||
             std::abs(one - end) <= report_.precision.absolute;
    };
    const double largest = std::max({std::abs(z), std::abs(z_other), std::abs(piece->extent->z_max)});
    if (formulas::extents_meet(z, z_other, largest, equal)) undecided_ = e.piece, pair_meets_ = true;
  }

  /// By what share the format alone lets the numbers of these fields be off, of the least of them.
  template <class E>
  double written_off(const E& e, std::uint16_t fields) const {
    const Precision& precision = report_.precision;
    double share = precision.relative;
    for_each_index<E>([&]<std::size_t I>() {
      if constexpr (std::is_same_v<FieldValue<E, I>, double>) {
        const double size = std::abs(e.*field_at<E, I>.member);
        if (const double amount = precision.amount(field_at<E, I>.unit); (fields >> I & 1) != 0 && amount > 0)
          share = std::max(share, precision.relative + 2 * amount / size);
        if (const double bound = depth_bound(e); bound > 0 && (fields >> I & 1) != 0)
          share = std::max(share, bound / size);
      }
    });
    return share;
  }
  /// What theory allows the depth of a pixel; 0 of other steps, and where it is not known.
  template <class E>
  double depth_bound(const E& e) const {
    if constexpr (has(at_pixel<E>, AtPixel::depth | AtPixel::keeps)) return report_.precision.allowed_depth(e.x, e.y);
    else return 0;
  }
  /// By how much rounding may move a depth that is compared, of which it may be off by such a share.
  template <class E>
  double may_move(const E& e, double share) const {
    if constexpr (has(at_pixel<E>, AtPixel::verdict))
      return std::max(depth_bound(e), share * std::max(std::abs(e.z), std::abs(at_.stored(e.x, e.y))));
    else return std::numeric_limits<double>::infinity();
  }

  /// Are these fields, as far as they are numbers, values of a plane that are as long as its normal?
  template <class E>
  static constexpr bool only_as_long_as_normal(std::uint16_t fields) {
    bool only = true;
    for_each_index<E>([&]<std::size_t I>() {
      constexpr std::string_view name = field_at<E, I>.name;
      if ((fields >> I & 1) != 0 && std::is_same_v<FieldValue<E, I>, double>)
        only = only && as_long_as_normal(name) && !either_way_round(name);
    });
    return only;
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
    const Difference& difference = report_.alignment.differences[number];
    if (!difference.only_a() && !difference.only_b()) return;
    const std::int64_t before = step_before(report_.alignment, difference, !of_a_);
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
  Replaying run_;
  formulas::Situation at_;
  Identity identity_;
  GoOn go_on_;
  std::int64_t last_;
  bool plain_;
  std::vector<Elsewhere> alone_;
  std::vector<std::int32_t> own_;  ///< differences by this run's steps
  std::size_t next_own_ = 0, next_elsewhere_ = 0;
  Inheritance different_, rounding_;
  bool fragment_ = false;   ///< the pixel at work may be in one of these
  std::vector<bool> rows_;  ///< some pixel of the scan line may be
  std::array<std::int32_t, 4> scopes_{};
  std::int32_t list_ = no_difference;  ///< the first difference in what enters, leaves and moves in the active list
  double box_margin_;
  std::int32_t undecided_ = -1;  ///< the piece of the last pair whose z extents met, while it is held against others
  bool pair_meets_ = false;      ///< those of the pair at work do
};

}  // namespace

std::vector<Elsewhere> follow(const Trace& trace, bool of_a, const DiffReport& report, const BeforeFirst& before,
                              const std::vector<Elsewhere>& elsewhere, std::vector<Finding>& findings,
                              const std::function<bool(std::int64_t)>& on_way, Way way) {
  Follow following(trace, of_a, report, before, elsewhere, findings, GoOn(on_way), way == Way::plain);
  if (before.position < before.last) trace.visit(before.position, trace.size(), following);
  std::vector<Elsewhere> alone = following.take_alone();
  std::stable_sort(alone.begin(), alone.end(),
                   [](const Elsewhere& one, const Elsewhere& other) { return one.before < other.before; });
  return alone;
}

}  // namespace zstep::diff
