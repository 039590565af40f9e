#include "traces/check/check.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <functional>
#include <limits>
#include <map>
#include <string_view>
#include <tuple>
#include <vector>

#include "traces/check/inheritance.hpp"
#include "traces/check/pixels.hpp"
#include "traces/check/scene_pixels.hpp"
#include "traces/events/fields.hpp"
#include "traces/file/visit.hpp"
#include "traces/file/written.hpp"
#include "traces/formulas/of_events.hpp"
#include "traces/formulas/rounding.hpp"
#include "traces/formulas/situation.hpp"
#include "traces/formulas/walk.hpp"
#include "traces/record/trace_recorder.hpp"
#include "traces/replay/apply.hpp"
#include "traces/replay/key_frames.hpp"
#include "traces/scene.hpp"

namespace zstep {

namespace {

using formulas::Follows, formulas::Place, formulas::Rounded, formulas::Rule, formulas::Situation;

/// What is noticed only at whatever comes next.
bool is_of_before(Rule rule) {
  return rule == Rule::win_is_written || rule == Rule::win_is_painted || rule == Rule::pixel_is_drawn ||
         rule == Rule::nearer_is_painted || rule == Rule::facet_is_drawn;
}

struct Checker {
  const Trace& trace;
  const Header& header;  ///< by which it is judged
  const OnCause& on_cause;
  CheckReport report{};
  Inheritance inheritance{};
  std::map<std::tuple<int, std::uint8_t, std::size_t>, std::size_t> known{};  ///< causes by what is wrong, kind, field
  CheckMarks* marks = nullptr;  ///< for who wants them, until there are too many

  // Of the step at work.
  std::int64_t step = 0;
  std::uint8_t line = 0;
  bool any_judged = false, any_fault = false;
  std::uint32_t fields = 0;  ///< bit f: something says what its field f must be
  Wins wins;
  Rule broken = Rule::count;  ///< the last one that does not hold
  std::int32_t inherited = Inheritance::clean, charged = Inheritance::clean;
  const Situation* at = nullptr;
  Event held{};  ///< what is wrong, for who wants to see it

  void begin(std::int64_t position, std::uint8_t id) {
    step = position, line = id;
    any_judged = any_fault = false, fields = 0;
    broken = Rule::count;
    inherited = charged = Inheritance::clean;
  }
  void read(const Place& place) {
    if (inheritance.empty()) return;
    if (const std::int32_t cause = inheritance.of(place);
        cause != Inheritance::clean && inherited == Inheritance::clean)
      inherited = cause;
  }

  /// `what`: 0 a field, 1 a rule, 2 a step that cannot be, 3 a field that is not what the scene has.
  void fault(int what, std::size_t number, Fault fault) {
    fault.step = step, fault.line = line;
    report.wrong_steps += !any_fault;
    any_fault = true;
    if (marks) marks->faults.push_back(fault);
    const bool of_any_kind = fault.rule && is_of_before(*fault.rule);
    const auto [found, fresh] =
        known.try_emplace({what, of_any_kind ? std::uint8_t{0} : fault.kind, number}, report.causes.size());
    if (!fresh) {
      Cause& cause = report.causes[found->second];
      cause.again += cause.first.step != step;
    } else {
      report.causes.push_back({std::move(fault), 0, 0});
      if (on_cause) on_cause(report.causes.back(), *at, RecordedEvent{line, held});
    }
    inherited = static_cast<std::int32_t>(found->second);
  }

  /// What is written to a place follows from the same as the step does.
  void written(const Place& place) {
    if (marks && inheritance.of(place) != inherited) marks->changes.push_back({step, place, inherited});
    inheritance.set(place, inherited);
  }
  void cleared(Place::In in) {
    if (marks)
      inheritance.for_each(in, [&](const Place& place) { marks->changes.push_back({step, place, CheckMarks::none}); });
    inheritance.clear(in);
  }
  void mark_step() {
    const std::int32_t cause = inherited != Inheritance::clean ? inherited : charged;
    if (!marks || cause == Inheritance::clean) return;
    marks->steps.push_back({step, cause, any_fault});
    if (marks->steps.size() + marks->changes.size() + marks->faults.size() > CheckMarks::most)
      marks->complete = false, marks = nullptr;
  }

  bool within_rounding(const Rounded& formula, double recorded, double amount) const {
    if (formulas::gives(formula, recorded, report.precision.relative)) return true;
    return std::abs(recorded - formula.value) <= amount;
  }
  /// Counts a number of this unit that is right; false where it is not.
  bool holds(const Rounded& formula, double recorded, std::string_view of_unit) {
    ++report.numbers;
    if (recorded == formula.value) return ++report.exact, true;
    // NaN is right nowhere, but follows from what is wrong already.
    if (std::isnan(recorded) && std::isnan(formula.value)) return inherited != Inheritance::clean;
    if (!within_rounding(formula, recorded, report.precision.amount(of_unit))) return false;
    // Of a small difference of large numbers, the last digit of these: it has none of its own.
    round(recorded - formula.value, std::max(std::abs(recorded), formula.spread), of_unit);
    return true;
  }
  /// Counts a number that is off by so much, of this size.
  void round(double off, double size, std::string_view of_unit) {
    ++report.rounded;
    const bool has_own_unit = of_unit == "px" && report.precision.positions > 0;
    const double unit = has_own_unit ? 1 / fixed_positions_a_pixel : report.precision.unit;
    const double digit = report.precision.digits > 0 ? last_written_digit(size, report.precision.digits)
                                                     : formulas::last_digit(size, report.precision.format, unit);
    report.largest_rounding = std::max(report.largest_rounding, std::abs(off) / digit);
  }
};

/// Judges the fields of one event.
template <class E>
struct Judge {
  using Number = Rounded;
  Checker& checker;
  const E& e;
  bool by_scene = false;  ///< what is given now is what the scene says

  Number number(const auto&, double value, const Place& place) {
    if (place.in != Place::In::event && place.in != Place::In::scene) checker.read(place);
    Rounded known(value);
    if (checker.report.precision.absolute > 0)
      known.spread += checker.report.precision.amount(place) / checker.report.precision.relative;
    return known;
  }
  Number named(std::string_view, const Number& formula) { return formula; }
  void reads(const Place& place) { checker.read(place); }
  bool trusts(const Place& place) const { return checker.inheritance.of(place) == Inheritance::clean; }
  bool every_digit() const { return checker.report.precision.every_digit; }
  bool equal(double one, double other) const {
    const Precision& precision = checker.report.precision;
    return equal(one, other, precision.whole ? precision.absolute : precision.largest_amount());
  }
  bool equal(double one, double other, double amount) const {
    return checker.within_rounding(Rounded(one), other, amount);
  }

  void gives(Follows<E, double> field, const Number& formula) {
    judges(field.number);
    if (!checker.holds(formula, e.*field.member, field.unit)) wrong(field, e.*field.member, formula.value);
  }
  void near(Follows<E, double> field, const Rounded& number) {
    judges(field.number);
    const double recorded = e.*field.member;
    if (!checker.within_rounding(number, recorded, checker.report.precision.amount(field.unit)))
      wrong(field, recorded, number.value);
  }
  void whole(Follows<E, std::int32_t> field, const Number& formula, std::int32_t within) {
    if (std::isnan(formula.value)) return;  // of no number
    judges(field.number);
    const std::int32_t recorded = e.*field.member;
    if (recorded == within) return;
    // Just beside a pixel's centre digits that are not printed may decide either way.
    const Precision& precision = checker.report.precision;
    const bool beside = recorded == within + 1 || recorded == within - 1;
    if (beside && !precision.every_digit && formula.turns <= precision.relative) return;
    wrong(field, recorded, within);
  }
  template <class Value>
  void is(std::type_identity_t<Follows<E, Value>> field, Value value) {
    judges(field.number);
    const Value recorded = e.*field.member;
    if (recorded == value || (value != value && recorded != recorded)) return;
    if constexpr (std::is_same_v<Value, double>)
      if (equal(recorded, value, checker.report.precision.amount(field.unit))) return;
    wrong(field, static_cast<double>(recorded), static_cast<double>(value));
  }
  void verdict(Follows<E, bool> field, const Number& z, const Number& stored) {
    const Header& header = checker.header;
    const bool tie = z.value == stored.value;
    if (!header.declares(tie ? Convention::ties : Convention::nearer)) return;
    if (!checker.report.precision.every_digit &&
        checker.within_rounding(z, stored.value, checker.report.precision.absolute))
      return;
    const bool wins = header.comparison.wins(z.value, stored.value);
    judges(field.number);
    if (e.*field.member != wins) wrong(field, e.*field.member, wins);
  }
  void within(Follows<E, double> field, const Number& formula, double off) {
    const double recorded = e.*field.member, expected = formula.value;
    const Precision& precision = checker.report.precision;
    const double digits =
        precision.every_digit ? 0 : precision.relative * std::max(std::abs(recorded), std::abs(expected));
    const bool right = std::abs(recorded - expected) <= off + digits + precision.amount(field.unit);
    if (by_scene) {
      if (!right) wrong(field, recorded, expected);
      return;
    }
    judges(field.number);
    ++checker.report.numbers;
    if (recorded == expected) ++checker.report.exact;
    else if (right) checker.round(recorded - expected, std::max(std::abs(recorded), off), field.unit);
    else wrong(field, recorded, expected);
  }
  /// What a field must be by the scene, where it goes with what the run has.
  template <class Judges>
  void judged_by_scene(const Judges& judge) {
    by_scene = true;
    judge();
    by_scene = false;
  }
  /// Nothing is wrong with the step, nor with what it follows from.
  bool is_clean() const { return !checker.any_fault && checker.inherited == Inheritance::clean; }
  bool breaks(Rule rule) const { return checker.broken == rule; }
  void rule(Rule rule, bool holds) { this->rule(rule, holds, Fault()); }
  /// `fault`: with what is known of it besides.
  void rule(Rule rule, bool holds, Fault fault) {
    checker.any_judged = true;
    if (holds) return;
    fault.kind = kind_of<E>, fault.rule = rule;
    checker.held = e, checker.broken = rule;
    const std::int32_t inherited = checker.inherited;
    checker.fault(1, static_cast<std::size_t>(rule), std::move(fault));
    // That the pixel before was not written is noticed here, and nothing of this step follows from it.
    if (is_of_before(rule)) {
      const auto last = checker.wins.last_compared();
      if (last && rule == Rule::win_is_written) checker.written(checker.at->depth_place(last->x, last->y));
      checker.charged = std::exchange(checker.inherited, inherited);
    }
  }

  /// A number stands where one must be, also where no formula says which.
  void has_numbers() {
    for_each_index<E>([&]<std::size_t I>() {
      if constexpr (std::is_same_v<FieldValue<E, I>, double>) {
        const double value = e.*field_at<E, I>.member;
        if (std::isfinite(value) || (checker.fields >> I & 1u) != 0 ||
            may_be(checker.header, kind_of<E>, field_at<E, I>.name, value))
          return;
        checker.any_judged = true;
        wrong(field_at<E, I>.name, I, value, std::numeric_limits<double>::quiet_NaN());
      }
    });
  }

 private:
  void judges(std::size_t field) {
    static_assert(field_count<E> <= KindJudged::most_fields);
    checker.any_judged = true;
    checker.fields |= 1u << field;
  }
  template <class Value>
  void wrong(const Follows<E, Value>& field, double recorded, double expected) {
    wrong(field.name, field.number, recorded, expected);
  }
  void wrong(std::string_view name, std::size_t number, double recorded, double expected) {
    Fault fault;
    fault.kind = kind_of<E>, fault.recorded = recorded, fault.expected = expected;
    fault.field = name, fault.by_scene = by_scene;
    checker.held = e;
    checker.fault(by_scene ? 3 : 0, number, std::move(fault));
  }
};

/// Does a run that never says that an edge leaves move one beyond its end? Then none does leave.
bool moves_ended_edges(const Trace& trace) {
  if (trace.has(kind_of<EdgeRetire>) || !trace.has(kind_of<EdgeStep>) || !trace.has(kind_of<EdgeTableInsert>))
    return false;
  std::vector<std::int32_t> ends;
  std::optional<std::int32_t> line;
  bool found = false;
  trace.each(0, trace.size(), [&](std::int64_t, const RecordedEvent& recorded) {
    if (holds<PolygonBegin>(recorded.event)) line.reset();
    if (const auto* begin = get_if<ScanLineBegin>(&recorded.event)) line = begin->y;
    if (const auto* insert = get_if<EdgeTableInsert>(&recorded.event)) {
      if (insert->edge == 0) ends.clear();
      ends.push_back(insert->end_row);
    }
    if (const auto* moved = get_if<EdgeStep>(&recorded.event); moved && line) {
      const std::size_t edge = moved->edge;
      found = moved->edge >= 0 && edge < ends.size() && ends[edge] < *line;
    }
    return !found;
  });
  return found;
}

CheckReport check_by(const Header& header, const Precision& precision, const Trace& trace, const OnCause& on_cause,
                     const OnChecked& on_checked, CheckMarks* marks = nullptr) {
  const Beginning beginning(trace);
  State state = beginning.state();
  Checker checker{.trace = trace, .header = header, .on_cause = on_cause, .wins = Wins(trace)};
  checker.marks = marks;
  checker.report.precision = precision;
  Situation at = formulas::situation_of(trace, state, header);
  checker.at = &at;
  at.moves_ended = moves_ended_edges(trace);
  hold(at, precision);

  NoLog log;
  Filling filling(trace);
  ScenePixels scene_pixels(trace, header);
  std::vector<bool> has_steps(trace.scene().polygons.size());
  constexpr std::int64_t now_and_then = 1 << 16;
  trace.visit(0, trace.size(), [&]<class E>(std::int64_t position, std::uint8_t line, const E& e) {
    checker.begin(position, line);
    at.look();
    Judge<E> judge{checker, e};
    if constexpr (formulas::Derived<E, Judge<E>>) formulas::derive(e, at, judge);
    checker.wins.look_at(e, position, at, judge);
    filling.look_at(e, at, judge);
    scene_pixels.look_at(e, at, judge);
    if constexpr (requires { e.polygon; })
      if (e.polygon >= 0 && e.polygon < std::ssize(has_steps)) has_steps[e.polygon] = true;
    judge.has_numbers();
    if constexpr (std::is_same_v<E, BuffersClear>)
      for (const Place::In in : {Place::In::depth_buffer, Place::In::frame}) checker.cleared(in);

    checker.report.judged += checker.any_judged;
    KindJudged& kind = checker.report.kinds[kind_of<E>];
    ++kind.steps;
    kind.can_be_judged = formulas::Derived<E, Judge<E>>;
    kind.joins_things = formulas::joins_things<E>;
    kind.judged += checker.any_judged;
    for (std::uint32_t left = checker.fields; left != 0; left &= left - 1) ++kind.fields[std::countr_zero(left)];
    constexpr bool of_active = std::is_same_v<E, EdgeStep> || std::is_same_v<E, EdgeRetire>;
    if constexpr (of_active)
      if (!at.active(e.edge)) checker.read(Place{Place::In::active_edge, e.edge});
    if (!checker.inheritance.empty() || checker.any_fault)
      for_each_place_written(e, at, [&](const Place& place) {
        if (!adds_to_place<E> || checker.inherited != Inheritance::clean) checker.written(place);
      });
    // Later steps follow from an edge that left too early or stands in a wrong place: they are no new causes.
    if (checker.broken == Rule::swap_needed || checker.broken == Rule::edge_sorted)
      checker.written(Place{Place::In::active_list, 0});
    if constexpr (std::is_same_v<E, EdgeRetire>)
      if (checker.any_fault) checker.written(Place{Place::In::active_edge, e.edge});
    if constexpr (std::is_same_v<E, PolygonBegin> || std::is_same_v<E, PieceDraw>)
      checker.cleared(Place::In::active_list);
    try {
      apply_stores(e, state, trace.scene().points.size(), log);
      apply_method_state(e, state.machine, position);
    } catch (const Impossible& why) {
      const bool not_told = why.needs && !trace.has(*why.needs);
      const bool follows = of_active && checker.inherited != Inheritance::clean;
      if (!not_told && !follows) {
        Fault fault;
        fault.kind = kind_of<E>, fault.impossible = why.what();
        checker.held = e;
        checker.fault(2, 0, std::move(fault));
      }
    }
    if (checker.inherited != Inheritance::clean && !checker.any_fault) {
      ++checker.report.inherited;
      ++checker.report.causes[checker.inherited].inherited;
    }
    at.passed(position, e);
    checker.mark_step();
    state.position = position;
    ++checker.report.steps;
    return !(on_checked && position % now_and_then == 0 && on_checked(position));
  });
  at.look();
  filling.end(at);
  if (trace.size() > 0 && checker.report.steps == trace.size()) {
    const bool had_fault = checker.any_fault;
    const RecordedEvent last = trace.event(trace.size());
    visit_event(
        [&]<class E>(const E& e) {
          Judge<E> judge{checker, e};
          scene_pixels.end(at, judge);
        },
        last.event);
    if (!had_fault && checker.any_fault) checker.mark_step();
  }
  checker.report.coverage = (filling.judges_all() || scene_pixels.judges_all()) && checker.wins.all_known();
  if (trace.has(kind_of<PolygonBegin>) || trace.has(kind_of<PieceMake>))
    for (std::size_t facet = 0; facet < trace.scene().facets.size(); ++facet) {
      const std::int32_t polygon = trace.scene().facets[facet].polygon;
      if (has_steps[polygon] || scene_pixels.may_be_left_out(index32(facet), at)) continue;
      has_steps[polygon] = true;
      checker.report.polygons_missing.push_back(polygon);
    }
  return std::move(checker.report);
}

}  // namespace

bool Otherwise::holds(const Header& header, const Raster& raster) const {
  if (is_of_raster) {
    Raster changed = raster;
    change_raster(changed);
    return changed == raster;
  }
  Header changed = header;
  change(changed);
  return changed == header;
}

std::vector<Otherwise> other_conventions() {
  using Nearer = Comparison::Nearer;
  using Ties = Comparison::Ties;
  std::vector<Otherwise> others{
      {"nearer", "smaller", [](Header& h) { h.comparison.nearer = Nearer::smaller; }},
      {"nearer", "greater", [](Header& h) { h.comparison.nearer = Nearer::greater; }},
      {"ties", "first", [](Header& h) { h.comparison.ties = Ties::first; }},
      {"ties", "last", [](Header& h) { h.comparison.ties = Ties::last; }},
  };
  const auto declare = [&]<class Owner, class E>(std::string_view key, Owner Header::*owner, E Owner::*member) {
    for (const E value : values_of<E>)
      others.push_back({key, word_of(value), [=](Header& h) { h.*owner.*member = value; }});
  };
  for_each_convention([&](std::string_view key, auto member) { declare(key, &Header::conventions, member); });
  // Which numbers a program computes in shows in their digits, and is found out from them.
  // And where attributes are recorded, "none" is no answer.
  std::erase_if(others, [](const Otherwise& one) {
    return one.key == "number_format" || one.key == "rounding" || (one.key == "attribute" && one.word == "none");
  });
  others.push_back({"cull", "true", [](Header& h) { h.conventions.cull = true; }});
  others.push_back({"cull", "false", [](Header& h) { h.conventions.cull = false; }});
  const std::size_t of_numbers = others.size();
  declare("pixel_centre", &Header::written, &WrittenAs::centre);
  declare("view_coordinates", &Header::written, &WrittenAs::axes);
  for (std::size_t i = of_numbers; i < others.size(); ++i) others[i].is_of_numbers = true;
  const auto of_raster = [&](std::string_view key, std::string_view word, bool Raster::*member, bool value) {
    others.push_back({key, word, [](Header&) {}, true, false, [=](Raster& raster) { raster.*member = value; }});
  };
  of_raster("y_axis", "down", &Raster::y_up, false), of_raster("y_axis", "up", &Raster::y_up, true);
  of_raster("seen_at", "centres", &Raster::corners, false), of_raster("seen_at", "corners", &Raster::corners, true);
  return others;
}

CheckReport check(const Trace& trace, const OnCause& on_cause, const OnChecked& on_checked, CheckMarks* marks,
                  const HeldTo& held) {
  return check_by(trace.header(), precision_of(trace, held), trace, on_cause, on_checked, marks);
}

std::vector<Fault> faults_of(const Trace& trace, const Precision& precision) {
  CheckMarks marks;
  check_by(trace.header(), precision, trace, nullptr, nullptr, &marks);
  return std::move(marks.faults);
}

bool KindJudged::covers(const KindJudged& other) const {
  return judged >= other.judged &&
         std::equal(fields.begin(), fields.end(), other.fields.begin(), std::greater_equal<std::int64_t>());
}

namespace {

using Others = std::vector<const Otherwise*>;

/// Its sign is taken as zstep has it where a right-handed run is read, whichever it was (traces/file/written.hpp).
bool takes_either_sign(const Header& header, const Event& event) {
  return header.written.axes == WrittenAs::Axes::right_handed &&
         (event.index() == kind_of<ClipCross> || event.index() == kind_of<FacingTest>);
}

/// A run as its file would be read with these in its first line.
Trace read_with(const Trace& trace, const Header& header, const Others& others) {
  Header as_own = header;
  turn(as_own, Turned::as_own);
  Scene scene = trace.scene();
  for (const Otherwise* other : others)
    if (other->is_of_raster) other->change_raster(scene.raster);
  turn(scene, trace.header(), Turned::as_written), turn(scene, header, Turned::as_own);
  TraceRecorder recorder(as_own, scene);
  trace.each(0, trace.size(), [&](std::int64_t, const RecordedEvent& recorded) {
    Event event = recorded.event;
    // A left-handed program writes such a sign as zstep has it.
    const bool has_own_signs = takes_either_sign(trace.header(), event) && !takes_either_sign(header, event);
    if (!has_own_signs) {
      turn(event, trace.header(), trace.scene().camera, trace.scene().raster, Turned::as_written);
      turn(event, header, scene.camera, scene.raster, Turned::as_own);
    }
    record_any(recorder, recorded.step, event);
    return true;
  });
  recorder.finish(trace.whole());
  return Trace::from_bytes(recorder.take_bytes(), trace.name());
}

/// What is wrong of a run under other conventions; nothing where something is not judged then that is judged under its
/// own.
std::optional<std::int64_t> wrong_steps_under(const Others& others, const Trace& trace, const CheckReport& own) {
  Header header = trace.header();
  turn(header, Turned::as_written);
  bool anew = false;
  for (const Otherwise* other : others) other->change(header), anew |= other->is_of_raster || other->is_of_numbers;
  if (anew && !kind_that_cannot_turn(header, trace.scene().camera).empty()) return std::nullopt;
  const CheckReport report = [&] {
    if (anew) {
      const Trace read = read_with(trace, header, others);
      return check_by(read.header(), own.precision, read, nullptr, nullptr);
    }
    turn(header, Turned::as_own);
    return check_by(header, own.precision, trace, nullptr, nullptr);
  }();
  const bool judges_all =
      std::equal(report.kinds.begin(), report.kinds.end(), own.kinds.begin(),
                 [](const KindJudged& one, const KindJudged& as_own) { return one.covers(as_own); });
  return judges_all ? std::optional(report.wrong_steps) : std::nullopt;
}

}  // namespace

std::optional<OtherConvention> convention_it_follows(const Trace& trace, const CheckReport& report) {
  struct Tried {
    Others others;
    std::int64_t wrong = 0;
  };
  const auto fewer = [](const Tried& one, const Tried& other) { return one.wrong < other.wrong; };
  std::vector<Otherwise> all = other_conventions();
  std::erase_if(all, [&](const Otherwise& one) {
    return one.holds(trace.header(), trace.scene().raster) ||
           (one.is_of_raster && (trace.scene().surface || trace.scene().camera.kind == Camera::Kind::screen));
  });
  std::vector<Tried> tried;
  for (const Otherwise& one : all)
    if (const auto wrong = wrong_steps_under({&one}, trace, report)) tried.push_back({{&one}, *wrong});
  std::stable_sort(tried.begin(), tried.end(), fewer);
  std::optional<Tried> best;
  if (!tried.empty() && 10 * tried.front().wrong < report.wrong_steps) best = tried.front();

  // Of two that a run follows together one mends something by itself, or it is of those that hide what is wrong
  // besides: no place on the raster is judged, say, while z_v has the wrong sign.
  constexpr std::size_t most_begun = 4;
  constexpr std::int64_t most_steps = 4'000'000;  // that are gone through for all the pairs
  std::int64_t left = most_steps / std::max<std::int64_t>(1, trace.size());
  Others seconds, begun;
  for (const Otherwise& one : all) seconds.push_back(&one);
  const auto is_elsewhere = [](const Otherwise* one) { return one->is_of_raster || one->is_of_numbers; };
  std::stable_partition(seconds.begin(), seconds.end(), is_elsewhere);
  const std::int64_t to_beat = best ? best->wrong : report.wrong_steps;
  for (std::size_t i = 0; to_beat > 0 && i < tried.size(); ++i) {
    const Otherwise* first = tried[i].others.front();
    if (i >= most_begun && !is_elsewhere(first)) continue;
    begun.push_back(first);
    for (const Otherwise* second : seconds) {
      const bool was_tried = std::find(begun.begin(), begun.end(), second) != begun.end();
      if (second->key == first->key || was_tried || (best && best->wrong == 0) || left-- <= 0) continue;
      const auto wrong = wrong_steps_under({first, second}, trace, report);
      if (wrong && 10 * *wrong < to_beat && (!best || *wrong < best->wrong)) best = Tried{{first, second}, *wrong};
    }
  }
  if (!best) return std::nullopt;
  OtherConvention found{{}, best->wrong};
  for (const Otherwise* one : best->others)
    found.declared.push_back({std::string(one->key), std::string(one->word), one->is_of_raster});
  return found;
}

namespace {

/// A field that has no meaning in some steps: the slope of a span without width.
bool may_say_nothing(std::size_t kind, std::string_view field) {
  return kind == kind_of<SpanBegin> && field == "dz_dx";
}

/// Of what is recorded no formula says what it must be, and rules, if any, only what it may not be.
bool never_judged(As as) { return has(as, As::recorded) && !has(as, As::formula) && !has(as, As::ruled); }

/// Kinds without a field that a formula gives, in which something may be wrong all the same.
bool is_decided(std::size_t kind) { return kind == kind_of<PolygonReject>; }

}  // namespace

std::vector<NotJudged> not_judged(const CheckReport& report) {
  std::vector<NotJudged> left;
  for (std::size_t kind = 0; kind < kind_count; ++kind) {
    const KindJudged& of = report.kinds[kind];
    if (of.steps == 0) continue;
    if (of.can_be_judged ? of.judged == 0 : of.joins_things) {
      left.push_back({static_cast<std::uint8_t>(kind), of.steps, of.steps, {}, !of.can_be_judged});
      continue;
    }
    NotJudged never{static_cast<std::uint8_t>(kind), of.steps, of.steps, {}, true};
    for (const FieldOfKind& field : fields_of_kind(kind))
      if (never_judged(field.as)) never.fields.push_back(field.name);
    if (!never.fields.empty()) left.push_back(std::move(never));
    if (!of.can_be_judged) continue;
    if (is_decided(kind) && of.judged < of.steps)
      left.push_back({static_cast<std::uint8_t>(kind), of.steps - of.judged, of.steps, {}});
    // Fields of which as much is known go together.
    std::size_t first = left.size();
    for (const FieldOfKind& field : fields_of_kind(kind)) {
      if (!has(field.as, As::formula)) continue;
      const std::int64_t open = of.steps - of.fields[&field - fields_of_kind(kind).data()];
      if (open == 0 || (open < of.steps && may_say_nothing(kind, field.name))) continue;
      auto same = first;
      while (same < left.size() && left[same].steps != open) ++same;
      if (same == left.size()) left.push_back({static_cast<std::uint8_t>(kind), open, of.steps, {}});
      left[same].fields.push_back(field.name);
    }
  }
  return left;
}

Verdict verdict_of(const CheckReport& report) {
  if (!report.causes.empty()) return Verdict::wrong;
  if (report.judged == 0) return Verdict::not_judged;
  const bool all = report.coverage && report.polygons_missing.empty() && not_judged(report).empty();
  return all ? Verdict::right : Verdict::right_where_judged;
}

std::vector<std::string_view> never_recorded(const Header& header, const CheckReport& report) {
  std::vector<std::string_view> names;
  for (const StepInfo& step : header.page)
    if (step.kind < kind_count && report.kinds[step.kind].steps == 0) names.push_back(step.name);
  return names;
}

}  // namespace zstep
