// Where the operands of a formula come from: the step that last wrote each place.
#include <algorithm>

#include "sim/answers/origin/chain.hpp"
#include "sim/answers/origin/fields.hpp"
#include "sim/answers/origin/work.hpp"
#include "sim/words/explain.hpp"
#include "traces/formulas/situation_of.hpp"
#include "traces/replay/same.hpp"

namespace zstep::answers {
namespace {

using formulas::Place;

const EdgeTableInsert* row_of(const Work& work, std::int32_t edge) {
  const auto at = static_cast<std::size_t>(edge);
  return edge >= 0 && at < work.machine().edge_table.size() ? &work.machine().edge_table[at] : nullptr;
}

std::int32_t edge_of(const Event& event) {
  if (const auto* insert = get_if<EdgeTableInsert>(&event)) return insert->edge;
  const auto* moved = get_if<EdgeStep>(&event);
  return moved ? moved->edge : -1;
}

/// One operand of a step's field.
struct Source {
  Work& work;
  std::int64_t step;
  const Event& event;
  std::string_view asked;  ///< the field
  const Formula::Operand& operand;

  Number written_by(const Step& from) const { return work.field(from, operand.place.field, operand.value); }

  /// Another field of the same event, or a plain number.
  Number own() const {
    if (operand.inner)
      return work.derived(step, "", "", operand.symbol, operand.value,
                          [&](Datum& datum) { work.tell_formula(datum, step, event, asked, *operand.inner); });
    for (const std::string& field : real_fields_in(event))
      if (field != asked && (field == operand.symbol || shown_name(event, field, "z") == operand.symbol) &&
          field_number(event, field) == operand.value)
        return work.field(step, field);
    return operand.value;
  }

  Number of_vertex() const {
    const auto vertex = static_cast<std::int32_t>(operand.place.number);
    const std::string_view field = operand.place.field;
    if (field.ends_with("_w")) return work.world(vertex, axis_of(field));
    if (field.ends_with("_v")) return work.viewed(vertex, axis_of(field));
    if (field.ends_with("_p")) return work.projected(vertex, field);
    // The ends of an edge are those of its entry in the edge table.
    if (const EdgeTableInsert* row = row_of(work, edge_of(event)); row != nullptr)
      return work.edge_end(edge_of(event), vertex == row->vertex_1, axis_of(field));
    return work.on_raster(vertex, axis_of(field));
  }

  Number of_active_edge() const {
    const auto edge = static_cast<std::int32_t>(operand.place.number);
    const Step from = step_of_active_edge(work.trace, work.machine(), step - 1, edge);
    const EdgeTableInsert* row = row_of(work, edge);
    const auto* before = from ? get_if<EdgeStep>(&work.trace.event(*from).event) : nullptr;
    if (!before || !row || !holds<EdgeStep>(event) || !work.machine().scan_line) return written_by(from);
    const std::int32_t lines = *work.machine().scan_line - 1 - row->first_row;
    return after_many(*from, "the same edge on the line before", "lines", lines, [&] {
      return std::pair{
          work.field(step_of_edge(work.trace, work.machine(), step, edge), asked, operand.value),
          work.field(step_of_edge(work.trace, work.machine(), step, edge), asked == "x_edge" ? "dx_dy" : "dz_dy", 0)};
    });
  }

  Number of_fragment() const {
    const bool interpolates = holds<DepthInterpolate>(event);
    const Step from = work.trace.previous(step, [&](const RecordedEvent& recorded) {
      return holds<DepthInterpolate>(recorded.event) || (!interpolates && holds<DepthCompare>(recorded.event));
    });
    const std::optional<SpanBegin> span = own_span();
    const auto* before = from && interpolates ? get_if<DepthInterpolate>(&work.trace.event(*from).event) : nullptr;
    if (!before || !span || before->x == span->first) return written_by(from);
    const DepthInterpolate last = *before;
    const std::int32_t first = span->first;
    return after_many(*from, fmt::format("depth at x = {}, one pixel before", last.x), "pixels", last.x - first, [&] {
      const Step at_first = find_last<DepthInterpolate>(
          work.trace, step - 1, [&](const DepthInterpolate& e) { return e.y == last.y && e.x == first; });
      const bool on_plane = work.conventions.interpolation == Conventions::Interpolation::plane_increments;
      return std::pair{work.field(at_first, "z", 0), work.field(on_plane ? last_slopes() : last_span(), "dz_dx", 0)};
    });
  }

  /// What was found by adding the same again and again, to the first of them: the many are one link.
  template <class FirstAndGain>
  Number after_many(std::int64_t from, const std::string& what, const char* count, std::int32_t times,
                    FirstAndGain&& first_and_gain) const {
    return work.derived(from, what, what, operand.symbol, operand.value, [&](Datum& datum) {
      const auto [first, gain] = first_and_gain();
      // Of a corrected depth it is the reciprocal that is added to.
      const bool corrected = holds<DepthInterpolate>(event) && work.conventions.depth == Conventions::Depth::corrected;
      const std::string sum = fmt::format("first + {}*gain", count);
      datum.is(corrected ? "1/(1/" + sum + ")" : sum, {{"first", first}, {count, times}, {"gain", gain}}, false);
    });
  }

  template <class E>
  Step last() const {
    return find_last<E>(work.trace, step, [](const E&) { return true; });
  }
  /// The span that the pixel belongs to.
  std::optional<SpanBegin> own_span() const {
    const formulas::Situation at = formulas::situation_of(work.trace, work.operands_of(step, event));
    return visit_event(
        [&]<class E>(const E& e) -> std::optional<SpanBegin> {
          if constexpr (requires {
                          e.x;
                          e.y;
                        })
            if (const auto own = at.span_of(e)) return *own.span;
          return at.method().span;
        },
        event);
  }
  Step last_span() const {
    const std::optional<SpanBegin> own = own_span();
    return find_last<SpanBegin>(work.trace, step, [&](const SpanBegin& e) { return !own || same(e, *own); });
  }

  Step last_slopes() const { return last<PlaneSlopes>(); }

  /// A depth from elsewhere in the run: its own links follow after these.
  Number of_buffer() const {
    const auto width = static_cast<std::int64_t>(work.scene.raster.width);
    const Trace::Pixel pixel{static_cast<std::int32_t>(operand.place.number % width),
                             static_cast<std::int32_t>(operand.place.number / width)};
    const auto& fragment = work.machine().fragment;
    const bool known = fragment && fragment->x == pixel.x && fragment->y == pixel.y;
    const std::int32_t of = known ? fragment->stored_polygon : no_polygon;
    const std::string what = fmt::format("stored depth at pixel ({}, {})", pixel.x, pixel.y);
    const double stored = operand.value;
    return work.derived(
        step, "stored", known ? what + ", of " + work.label(of) : what, "stored", stored, [&](Datum& datum) {
          const Step wrote = step_of_depth(work.trace, step - 1, pixel, operand.place.in == Place::In::light_buffer);
          if (!wrote)
            return datum.note(of == no_polygon ? "nothing was drawn there yet" : "its depth was never written there");
          datum.is("z", {{"z", stored}});
          work.later(*wrote, "z", "z");
        });
  }

  Number number() const {
    const auto number = static_cast<std::int32_t>(operand.place.number);
    switch (operand.place.in) {
      case Place::In::event:
        return own();
      case Place::In::point:
        return work.world(number, axis_of(operand.place.field));
      case Place::In::vertex:
        return of_vertex();
      case Place::In::edge_table:
        return written_by(step_of_edge(work.trace, work.machine(), step, number));
      case Place::In::active_edge:
        return of_active_edge();
      case Place::In::plane:
        return written_by(last_slopes());
      case Place::In::span:
        return written_by(last_span());
      case Place::In::fragment:
        return of_fragment();
      case Place::In::attribute:
        return written_by(last<AttributeInterpolate>());
      case Place::In::depth_buffer:
      case Place::In::light_buffer:
        return of_buffer();
      case Place::In::piece:
        return written_by(step_of_plane(work.machine(), number));
      case Place::In::ray:
        return written_by(operand.place.field == "t" ? last_plane_test(work, step) : last_ray(work, step));
      default:
        return operand.value;
    }
  }
};

/// What a whole number's formula says of a pixel or a scan line that an edge meets at its very centre; what stands for
/// the eye.
std::string_view note_on(const Scene& scene, const Event& event, std::string_view field, const std::string& formula) {
  const bool down = formula.find("\u230a") != std::string::npos, rounds = formula.find("0.5") != std::string::npos;
  if (holds<SpanBegin>(event) && field == "last")
    return !down    ? "a pixel on x_R belongs to what lies to the right"
           : rounds ? "coverage goes to round(x_R)"
                    : "coverage is inclusive: a pixel on x_R belongs to the span";
  if (holds<EyeSide>(event))
    return scene.camera.kind == Camera::Kind::perspective ? "(x, y, z) is the eye, w = 1"
                                                          : "(x, y, z) is the direction of the eye, w = 0";
  const bool goes_on = down && holds<EdgeTableInsert>(event) && field == "end_row";
  return goes_on ? "coverage is inclusive, and the edge goes on as far as y_1" : "";
}

}  // namespace

Number Work::edge_end(std::int32_t edge, bool lower, Axis3 axis) {
  const EdgeTableInsert* row = row_of(*this, edge);
  if (!row) return 0;
  const std::int32_t vertex = lower ? row->vertex_1 : row->vertex_0;
  const Step step = step_of_edge(trace, machine(), at(), edge);
  if (!step) return on_raster(vertex, axis);
  const EdgeTableInsert entry = *row;
  const std::string name = fmt::format("{}_{}", "xyz"[static_cast<std::size_t>(axis)], lower ? 1 : 0);
  return derived(*step, "", what_happens(*this, entry), name, raster_value(vertex, axis), [&](Datum& datum) {
    const Number number = on_raster(vertex, axis);
    datum.same_as(number.name == depth_name() ? "z" : number.name, number);
  });
}

const State& Work::operands_of(std::int64_t step, const Event& event) {
  // A vertex has its coordinates until it is viewed anew: what its last transformations read is still there.
  const auto is_last = [&](std::int32_t vertex, Step VertexSteps::*made) { return steps_of(vertex).*made == step; };
  const auto* view = get_if<ViewTransform>(&event);
  const auto* projection = get_if<Projection>(&event);
  const auto* viewport = get_if<ViewportTransform>(&event);
  if ((view && is_last(view->vertex, &VertexSteps::viewed)) ||
      (projection && is_last(projection->vertex, &VertexSteps::projected)) ||
      (viewport && is_last(viewport->vertex, &VertexSteps::on_raster)))
    return state();
  replay_.go_to(step - 1);
  return replay_.state();
}

const std::vector<Derivation>& Work::derivations(std::int64_t step, const Event& event) {
  const auto [known, is_new] = derivations_.try_emplace(step);
  // Of a piece's plane and extent no formula is kept: planes.cpp and orders.cpp explain them, and need no state before.
  if (!is_new || holds<PlaneEquation>(event) || holds<Extent>(event)) return known->second;
  return known->second = derivations_of(event, formulas::situation_of(trace, operands_of(step, event)));
}

void Work::tell_formula(Datum& datum, std::int64_t step, const Event& event, std::string_view field,
                        const Formula& formula) {
  std::vector<Formula::Operand> operands = formula.operands();
  // Heights first: then the links of a vertex begin on the raster, and its depth comes with its projection.
  std::stable_partition(operands.begin(), operands.end(),
                        [](const Formula::Operand& operand) { return operand.place.field == "y_s"; });
  std::vector<Given> given;
  std::vector<Number> numbers;
  for (const Formula::Operand& operand : operands) {
    given.push_back({operand.symbol, Source{*this, step, event, field, operand}.number()});
    numbers.push_back(given.back().number);
  }
  if (formula.text().empty())
    return datum.comes_of(fmt::format("of many numbers, of which {} are shown", numbers.size()), numbers);
  datum.is(formula.text(), std::move(given));
}

bool Work::tell_derived(Datum& datum, std::int64_t step, const Event& event, std::string_view field) {
  const std::vector<Derivation>& all = derivations(step, event);
  const auto found =
      std::find_if(all.begin(), all.end(), [&](const Derivation& derivation) { return derivation.field == field; });
  if (found == all.end()) return false;
  const Formula formula = found->formula;
  tell_formula(datum, step, event, field, formula);
  if (const std::string_view note = note_on(scene, event, field, formula.text()); !note.empty())
    datum.note(std::string(note));
  return true;
}

}  // namespace zstep::answers
