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

#include "traces/check/judge.hpp"
#include "traces/check/pixels.hpp"
#include "traces/check/scene_pixels.hpp"
#include "traces/events/fields.hpp"
#include "traces/file/visit.hpp"
#include "traces/file/written.hpp"
#include "traces/formulas/fill.hpp"
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

using formulas::Place, formulas::Rounded, formulas::Rule, formulas::Situation;
using judging::Checker, judging::Judge, judging::WorthLooking;

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
  WorthLooking worth;
  Filling filling(trace, header);
  ScenePixels scene_pixels(trace, header);
  std::vector<bool> has_steps(trace.scene().polygons.size());
  constexpr std::int64_t now_and_then = 1 << 16;
  trace.visit(0, trace.size(), [&]<class E>(std::int64_t position, std::uint8_t line, const E& e) {
    checker.begin(position, line);
    at.look();
    Judge<E> judge{checker, e};
    if constexpr (formulas::Derived<E, Judge<E>>) {
      const bool look = checker.inheritance.empty() && worth.at(kind_of<E>);
      if (!look || !is_to_the_bit(e, checker, worth)) formulas::derive(e, at, judge);
    }
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
  for (const std::string_view word : {"even-odd", "non-zero"})
    others.push_back({formulas::fill_key, word, [=](Header& h) {
                        h.conventions.options.erase(std::string(formulas::fill_key));
                        if (word == formulas::non_zero_fill) h.conventions.options.emplace(formulas::fill_key, word);
                      }});
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
  anew = anew || depths_change_sign(header) != depths_change_sign(trace.header());
  if (anew && !kind_that_cannot_turn(header).empty()) return std::nullopt;
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
  // With fewer corners no outline goes round a place twice.
  const bool goes_round_twice = std::any_of(trace.scene().facets.begin(), trace.scene().facets.end(),
                                            [](const Facet& facet) { return facet.corner_count >= 5; });
  std::erase_if(all, [&](const Otherwise& one) {
    return (one.key == formulas::fill_key && !goes_round_twice) || one.holds(trace.header(), trace.scene().raster) ||
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
