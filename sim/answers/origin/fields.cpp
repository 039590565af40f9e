// What the link of a step is called.

#include "sim/answers/origin/work.hpp"

#include <algorithm>
#include <array>

#include "sim/answers/origin/chain.hpp"
#include "sim/words/explain.hpp"
#include "traces/events/fields.hpp"
#include "traces/formulas/half_space.hpp"
#include "traces/formulas/walk.hpp"
#include "traces/replay/same.hpp"

namespace zstep::answers {
namespace {

/// A number that names something: what that is, and where it comes from.
void tell_name(Datum& datum, Work& work, std::string_view field, std::int32_t number, std::string_view meaning) {
  const bool vertex = field.starts_with("vertex");
  if (number < 0) return datum.note("none");
  if (field == "polygon" || field == "owner")
    return datum.at_source(work.source_of_polygon(number)), datum.note(work.label(number));
  if (field.find("facet") != std::string_view::npos) {
    const std::int32_t polygon = polygon_of_facet(work.scene, number);
    if (!entry(work.scene.facets, number)) return;
    datum.at_source(work.source_of_polygon(polygon));
    return datum.note("of " + work.label(polygon));
  }
  if (vertex && entry(work.scene.points, number))
    return datum.comes_of("vertex " + work.vertex_name(number),
                          {work.world(number, Axis3::x), work.world(number, Axis3::y), work.world(number, Axis3::z)});
  if (vertex) {
    const Step made = work.steps_of(number).made;
    return datum.comes_of("a vertex that cutting made", {work.field(made, "t", 0)});
  }
  if (field.find("edge") != std::string_view::npos) {
    const Step row = work.step_of_edge(number);
    if (row) return datum.comes_of("a row of the edge table", {work.field(row, "x_edge", 0)});
  }
  if (field == "piece" || field == "other" || field == "plane_of")
    if (const Piece* piece = entry(work.machine().pieces, number)) {
      datum.at_source(work.source_of_polygon(piece->polygon));
      return datum.note(work.piece(number));
    }
  datum.note(std::string(meaning));
}

}  // namespace

std::optional<double> field_number(const Event& event, std::string_view name) {
  const FieldOfKind* const field = field_of_kind(event.index(), name);
  return field ? std::optional(field->read(event)) : std::nullopt;
}

std::string field_word(const Event& event, std::string_view name) {
  const FieldOfKind* const field = field_of_kind(event.index(), name);
  return field && field->type == FieldOfKind::Type::word ? std::string(field->word_in(event)) : "";
}

std::string shown_name(const Event& event, std::string_view name, const std::string& depth) {
  static constexpr std::array<std::pair<std::string_view, std::string_view>, 34> names{
      {{"x_left", "x_L"},  {"x_right", "x_R"}, {"z_left", "z_L"}, {"z_right", "z_R"},     {"dx_dy", "1/m"},
       {"dz_dy", "dz/dy"}, {"dz_dx", "dz/dx"}, {"x_edge", "x"},   {"plane_a", "A"},       {"plane_b", "B"},
       {"plane_c", "C"},   {"plane_d", "D"},   {"y_curve", "y"},  {"x_at", "x"},          {"y_at", "y"},
       {"x_cut", "x"},     {"y_cut", "y"},     {"z_cut", "z"},    {"dir_x", "dX_x"},      {"dir_y", "dX_y"},
       {"dir_z", "dX_z"},  {"r8", "red"},      {"g8", "green"},   {"b8", "blue"},         {"edge_a", "A"},
       {"edge_b", "B"},    {"edge_c", "C"},    {"e_0", "E_0"},    {"e_1", "E_1"},         {"e_2", "E_2"},
       {"s_0", "S_0"},     {"s_1", "S_1"},     {"s_2", "S_2"},    {"twice_area", "area2"}}};
  if (name == "z" || name == "z_edge") return depth;
  if (name == "z_cut" && holds<SplitVertex>(event) && get<SplitVertex>(event).space == Space::raster) return depth;
  for (const auto& [field, shown] : names)
    if (field == name) return std::string(shown);
  return std::string(name);
}

void tell_field(Datum& datum, Work& work, std::int64_t step, const Event& event, std::string_view name) {
  using Type = FieldOfKind::Type;
  const FieldOfKind* const field = field_of_kind(event.index(), name);
  if (!field) return;
  if (field->type == Type::truth) datum.holds_if("", {});
  if (field->type == Type::word) datum.word(std::string(field->word_in(event)));
  if (field->type == Type::whole && field->unit == "index")
    return tell_name(datum, work, name, field->whole_in(event), field->meaning);
  if (work.tell_derived(datum, step, event, name)) return;
  for (TellTheme* tell : {tell_boxes, tell_curves, tell_light, tell_lines, tell_orders, tell_pixels, tell_polygons,
                          tell_rays, tell_sweep, tell_vertices})
    tell(datum, work, step, event, name);
  if (!datum.told()) datum.note(std::string(field->meaning));
}

std::vector<std::string> fields_in(const Event& event) {
  std::vector<std::string> names;
  for (const FieldOfKind& field : fields_of_kind(event.index())) names.emplace_back(field.name);
  return names;
}

std::vector<std::string> real_fields_in(const Event& event) {
  std::vector<std::string> names;
  for (const FieldOfKind& field : fields_of_kind(event.index()))
    if (field.type == FieldOfKind::Type::real) names.emplace_back(field.name);
  return names;
}

std::string main_field(const Event& event) {
  const std::span<const FieldOfKind> fields = fields_of_kind(event.index());
  for (const char* wanted : {"attribute", "z", "t", "y_curve", "value", "x_edge", "z_left", "distance", "z_light",
                             "view_dot_normal", "t_enter", "nearer"})
    for (const FieldOfKind& field : fields)
      if (field.name == wanted) return wanted;
  for (const FieldOfKind& field : fields)
    if (field.type == FieldOfKind::Type::real) return std::string(field.name);
  return fields.empty() ? "" : std::string(fields.front().name);
}

namespace {

std::string named(const Work& work, const Event& event, std::string_view field) {
  if (field == "scan_line") return fmt::format("{}", work.machine().scan_line.value_or(0));
  const auto number = static_cast<std::int32_t>(field_number(event, field).value_or(0));
  if (const FieldOfKind* described = field_of_kind(event.index(), field)) {
    if (described->thing == Thing::vertex) return work.vertex_name(number);
    if (described->thing == Thing::edge) return fmt::format("e{}", number);
    if (described->thing == Thing::piece) return work.piece(number);
  }
  if (field == "polygon") return work.label(number);
  if (field == "upper") return number != 0 ? "upper" : "lower";
  if (field == "facet")
    return entry(work.scene.facets, number) ? work.label(polygon_of_facet(work.scene, number))
                                            : fmt::format("facet {}", number);
  const std::string word = field_word(event, field);
  return word.empty() ? fmt::format("{}", number) : word;
}

}  // namespace

std::string what_happens(Work& work, std::int64_t step, const Event& event) {
  const Description& description = description_of_kind(event.index());
  std::string_view pattern = description.called.empty() ? description.meaning : description.called;
  if (holds<DepthInterpolate>(event) && !work.span_of(step, event)) pattern = "depth at pixel ({x}, {y})";
  std::string text;
  std::size_t from = 0;
  for (std::size_t open = pattern.find('{'); open != pattern.npos; open = pattern.find('{', from)) {
    const std::size_t close = pattern.find('}', open);
    text.append(pattern.substr(from, open - from));
    text += named(work, event, pattern.substr(open + 1, close - open - 1));
    from = close + 1;
  }
  return text.append(pattern.substr(from));
}

// Where the operands of a formula come from: the step that last wrote each place.

namespace {

using formulas::Place;

const EdgeTableInsert* row_of(const Work& work, std::int32_t edge) { return entry(work.machine().edge_table, edge); }

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
      return std::pair{work.field(work.step_of_edge(edge), asked, operand.value),
                       work.field(work.step_of_edge(edge), asked == "x_edge" ? "dx_dy" : "dz_dy", 0)};
    });
  }

  Number of_fragment() const {
    const bool interpolates = holds<DepthInterpolate>(event);
    const Step from = work.trace.previous(step, [&](const RecordedEvent& recorded) {
      const AtPixel does = at_pixel_of(recorded.event);
      return is_of_fragment(does) && !(interpolates && has(does, AtPixel::verdict));
    });
    const std::optional<Work::SpanOfStep> own = work.span_of(step, event);
    const auto* before = from && interpolates ? get_if<DepthInterpolate>(&work.trace.event(*from).event) : nullptr;
    if (!before || !own || before->x == own->span.first) return written_by(from);
    const DepthInterpolate last = *before;
    const std::int32_t first = own->span.first;
    return after_many(*from, fmt::format("depth at x = {}, one pixel before", last.x), "pixels", last.x - first, [&] {
      const auto is_first = [&](const DepthInterpolate& e) { return e.y == last.y && e.x == first; };
      Step at_first = find_last<DepthInterpolate>(work.trace, step - 1, is_first);
      for (; at_first && !is_of(*at_first, *own);)  // spans of several polygons may begin there
        at_first = find_last<DepthInterpolate>(work.trace, *at_first - 1, is_first);
      const bool on_plane = work.conventions.interpolation == Conventions::Interpolation::plane_increments;
      return std::pair{work.field(at_first, "z", 0),
                       work.field(on_plane ? work.last<PlaneSlopes>(step) : own->step, "dz_dx", 0)};
    });
  }

  bool is_of(std::int64_t pixel, const Work::SpanOfStep& span) const {
    const auto its = work.span_of(pixel, work.trace.event(pixel).event);
    return its && its->step == span.step;
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

  Step own_span() const {
    const auto own = work.span_of(step, event);
    return own ? own->step : work.last<SpanBegin>(step);
  }

  Step of_triangle(std::int64_t number) const {
    if (number == formulas::detail::setup_place) return work.last<TriangleSetup>(step);
    if (number == formulas::detail::test_place) return work.last<InsideTest>(step);
    if (number == formulas::detail::weights_place) return work.last<BarycentricWeights>(step);
    if (number == formulas::detail::sample_place) return work.last<SampleTest>(step);
    return find_last<EdgeFunction>(work.trace, step, [&](const EdgeFunction& e) { return e.edge_function == number; });
  }

  /// A depth from elsewhere in the run: its own links follow after these.
  Number of_buffer() const {
    const std::int64_t width = work.scene.raster.width;
    const Trace::Pixel pixel{static_cast<std::int32_t>(operand.place.number % width),
                             static_cast<std::int32_t>(operand.place.number / width)};
    const auto& fragment = work.machine().fragment;
    const bool known = fragment && fragment->x == pixel.x && fragment->y == pixel.y;
    const std::int32_t of = known ? fragment->stored_polygon : no_polygon;
    const std::string what = fmt::format("stored depth at pixel ({}, {})", pixel.x, pixel.y);
    const bool light = operand.place.in == Place::In::light_buffer;
    return work.kept(
        step, "stored", known ? what + ", of " + work.label(of) : what, "stored", operand.value, "z",
        [&] { return step_of_depth(work.trace, step - 1, pixel, light); },
        of == no_polygon ? "nothing was drawn there yet" : "its depth was never written there");
  }

  /// The depth that a sample has, from the last compare there that was won.
  Number of_sample() const {
    const std::int64_t in_pixel = work.machine().samples_a_pixel, width = work.scene.raster.width,
                       pixel = operand.place.number / in_pixel;
    const auto x = static_cast<std::int32_t>(pixel % width), y = static_cast<std::int32_t>(pixel / width),
               sample = static_cast<std::int32_t>(operand.place.number % in_pixel);
    const std::int32_t of = work.machine().sample(x, y, sample).polygon;
    const std::string what = fmt::format("stored depth of sample {} of pixel ({}, {})", sample, x, y);
    return work.kept(
        step, "stored", of == no_polygon ? what : what + ", of " + work.label(of), "stored", operand.value, "z",
        [&] {
          return find_last<SampleDepth>(work.trace, step - 1, [&](const SampleDepth& e) {
            return e.nearer && e.x == x && e.y == y && e.sample == sample;
          });
        },
        of == no_polygon ? "nothing was drawn there yet" : "its depth was never written there");
  }

  Number number() const {
    const auto number = static_cast<std::int32_t>(operand.place.number);
    const std::string_view field = operand.place.field;
    using In = Place::In;
    const In in = operand.place.in;
    if (in == In::event) return own();
    if (in == In::point && holds<AttributeInterpolate>(event) && field != "x_w") return work.attribute(number, field);
    if (in == In::point) return work.world(number, axis_of(field));
    if (in == In::vertex) return of_vertex();
    if (in == In::edge_table) return written_by(work.step_of_edge(number));
    if (in == In::active_edge) return of_active_edge();
    if (in == In::plane) return written_by(work.last<PlaneSlopes>(step));
    if (in == In::triangle) return written_by(of_triangle(operand.place.number));
    if (in == In::span) return written_by(own_span());
    if (in == In::fragment) return of_fragment();
    if (in == In::attribute) return written_by(work.last<AttributeInterpolate>(step));
    if (in == In::depth_buffer || in == In::light_buffer) return of_buffer();
    if (in == In::samples) return of_sample();
    if (in == In::piece) return written_by(step_of_plane(work.machine(), number));
    if (in == In::ray) return written_by(field == "t" ? work.last<RayPlane>(step) : work.last<RayBegin>(step));
    return operand.value;
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
  const Step step = step_of_edge(edge);
  if (!step) return on_raster(vertex, axis);
  const EdgeTableInsert entry = *row;
  const std::string name = axis_name(axis, lower ? "_1" : "_0");
  return derived(*step, "", what_happens(*this, *step, entry), name, raster_value(vertex, axis), [&](Datum& datum) {
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
  // So is all that is kept of all polygons.
  const bool one_table = step <= now_.at && has_one_table();
  if (one_table && (holds<EdgeTableInsert>(event) || holds<ClipCross>(event))) return state();
  // Where an edge comes to on a scan line follows from its ends alone, as long as nothing is added to where it was.
  if (const auto* moved = get_if<EdgeStep>(&event);
      moved && one_table && !adds_slopes(conventions) && !next_of<ScanLineBegin>(trace, step, now_.at + 1)) {
    const std::vector<ActiveEdge>& active = machine().active;
    if (std::any_of(active.begin(), active.end(), [&](const ActiveEdge& one) { return one.edge == moved->edge; }))
      return state();
  }
  replay_.go_to(step - 1);
  return replay_.state();
}

const Work::Derived& Work::derivations(std::int64_t step, const Event& event) {
  const auto [known, is_new] = derivations_.try_emplace(step);
  Derived& derived = known->second;
  // Of a piece's plane and extent no formula is kept: orders.cpp explains them, and needs no state before.
  if (!is_new || holds<PlaneEquation>(event) || holds<Extent>(event)) return derived;
  const formulas::Situation at = formulas::situation_of(trace, operands_of(step, event));
  derived.fields = derivations_of(event, at);
  visit_event(
      [&]<class E>(const E& e) {
        if constexpr (requires { e.x, e.y; })
          if (const auto own = at.span_of(e))
            derived.span = SpanOfStep{*own.span, own.step > 0 ? Step(own.step) : std::nullopt};
      },
      event);
  return derived;
}

std::optional<Work::SpanOfStep> Work::span_of(std::int64_t step, const Event& event) {
  std::optional<SpanOfStep> own = derivations(step, event).span;
  if (own && !own->step)
    own->step = find_last<SpanBegin>(trace, step, [&](const SpanBegin& span) { return same(span, own->span); });
  return own;
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
  const std::vector<Derivation>& all = derivations(step, event).fields;
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
