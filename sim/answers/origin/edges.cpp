// The edge table, the active edges and the spans between them.
#include "sim/answers/origin/work.hpp"
#include "traces/formulas/coverage.hpp"
#include "traces/formulas/lines.hpp"

namespace zstep::answers {
namespace {

const EdgeTableInsert* row_of(const Work& work, std::int32_t edge) {
  const auto at = static_cast<std::size_t>(edge);
  return edge >= 0 && at < work.machine().edge_table.size() ? &work.machine().edge_table[at] : nullptr;
}

constexpr const char* axis_names[] = {"x", "y", "z"};

/// A whole number, limited to what the raster holds where that changes it.
void tell_whole(Datum& datum, const words::Shown& formula, Given of, std::int32_t least, std::int32_t most,
                const char* most_name) {
  std::string text = formula_of(formula);
  const double value = of.number.value;
  std::vector<Given> operands{std::move(of)};
  if (value < least) text = fmt::format("max({}, {})", least, text);
  if (value > most) {
    text = fmt::format("min({}, {})", most_name, text);
    operands.push_back({std::string(1, most_name[0]), most_name[1] == '\0' ? most : most + 1});
  }
  datum.is(std::move(text), std::move(operands));
}

/// x or z on an edge.
void tell_on_edge(Datum& datum, Work& work, std::int32_t edge, Axis3 axis, double y) {
  const std::string p = axis_names[static_cast<std::size_t>(axis)];
  // Heights first: then the links of a vertex begin on the raster, and its depth comes with its projection.
  const Number y_0 = work.edge_end(edge, false, Axis3::y), y_1 = work.edge_end(edge, true, Axis3::y);
  datum.is(formula_of(formulas::on_line(symbol(p + "_0"), symbol(p + "_1"), symbol("y"), symbol("y_0"), symbol("y_1"))),
           {{p + "_0", work.edge_end(edge, false, axis)},
            {p + "_1", work.edge_end(edge, true, axis)},
            {"y", y},
            {"y_0", y_0},
            {"y_1", y_1}});
}

}  // namespace

Number Work::edge_end(std::int32_t edge, bool upper, Axis3 axis) {
  const EdgeTableInsert* row = row_of(*this, edge);
  if (!row) return 0;
  const std::int32_t vertex = upper ? row->vertex_1 : row->vertex_0;
  const Step step = step_of_edge(trace, machine(), at(), edge);
  if (!step) return on_raster(vertex, axis);
  const EdgeTableInsert entry = *row;
  const std::string name = fmt::format("{}_{}", axis_names[static_cast<std::size_t>(axis)], upper ? 1 : 0);
  return derived(*step, "", what_happens(*this, entry), name, raster_value(vertex, axis), [&](Datum& datum) {
    const Number number = on_raster(vertex, axis);
    datum.same_as(number.name == depth_name() ? "z" : number.name, number);
  });
}

void tell(Datum& datum, Work& work, std::int64_t, const EdgeTableInsert& e, std::string_view field) {
  const bool x = field == "x_edge" || field == "dx_dy";
  const Axis3 axis = x ? Axis3::x : Axis3::z;
  const std::string p = x ? "x" : "z";
  if (field == "x_edge" || field == "z_edge") return tell_on_edge(datum, work, e.edge, axis, e.first_row);
  if (field == "dx_dy" || field == "dz_dy")
    return datum.is(formula_of(formulas::slope(symbol(p + "_0"), symbol(p + "_1"), symbol("y_0"), symbol("y_1"))),
                    {{p + "_1", work.edge_end(e.edge, true, axis)}, {p + "_0", work.edge_end(e.edge, false, axis)},
                     {"y_1", work.edge_end(e.edge, true, Axis3::y)}, {"y_0", work.edge_end(e.edge, false, Axis3::y)}});
  const std::int32_t height = work.scene.raster.height;
  const Number y_0 = work.edge_end(e.edge, false, Axis3::y), y_1 = work.edge_end(e.edge, true, Axis3::y);
  const bool turned = y_0.value > y_1.value;
  if (field == "first_row")
    return tell_whole(datum, formulas::first_row(symbol(turned ? "y_1" : "y_0")),
                      {turned ? "y_1" : "y_0", turned ? y_1 : y_0}, 0, height, "H");
  if (field != "end_row") return;
  const Given below{turned ? "y_0" : "y_1", turned ? y_0 : y_1};
  // As far as scan line y_1 itself where coverage is inclusive and the polygon has its lowest point there.
  const double longer = formulas::end_row(below.number.value, true);
  const bool past_end =
      formulas::may_include_end(work.trace.header()) && formulas::row_from(longer, height) == e.end_row;
  tell_whole(datum, formulas::end_row(symbol(below.symbol), past_end), below, 0, height, "H");
  if (past_end) datum.note("coverage is inclusive, and the edge goes on as far as y_1");
}

void tell(Datum& datum, Work& work, std::int64_t step, const EdgeStep& e, std::string_view field) {
  const Axis3 axis = field == "x_edge" ? Axis3::x : Axis3::z;
  const EdgeTableInsert* row = row_of(work, e.edge);
  if (!row) return;
  const Step entered = step_of_edge(work.trace, work.machine(), step, e.edge);
  const Step line = find_last<ScanLineBegin>(work.trace, step, [](const ScanLineBegin&) { return true; });
  if (!line) return;
  const std::int32_t y = get<ScanLineBegin>(work.trace.event(*line).event).y;
  if (work.conventions.interpolation == Conventions::Interpolation::direct)
    return tell_on_edge(datum, work, e.edge, axis, y);
  // By increments: the last of the many additions is explained, and the entry that they began from.
  const char* slope = axis == Axis3::x ? "dx_dy" : "dz_dy";
  const std::string p = axis == Axis3::x ? "x" : "z", m = slope;
  const double gain = axis == Axis3::x ? row->dx_dy : row->dz_dy, start = axis == Axis3::x ? row->x_edge : row->z_edge;
  const std::int32_t lines = y - row->first_row;
  const auto before = find_last<EdgeStep>(
      work.trace, step - 1, [&](const EdgeStep& other) { return other.edge == e.edge; },
      [&](const Event& event) {
        return holds<EdgeEnter>(event) && get<EdgeEnter>(event).edge == e.edge;
      });
  const Number first = work.field(entered, axis == Axis3::x ? "x_edge" : "z_edge", start),
               per_line = work.field(entered, slope, gain);
  if (!before) return datum.is(p + "_0 + " + m, {{p + "_0", first}, {m, per_line}});
  const EdgeStep last = get<EdgeStep>(work.trace.event(*before).event);
  const double was = axis == Axis3::x ? last.x_edge : last.z_edge;
  const Number one_before =
      work.derived(*before, "line before", "the same edge on the line before", p + "_b", was, [&](Datum& inner) {
        inner.is(fmt::format("{}_f + lines*{}", p, m), {{p + "_f", first}, {"lines", lines - 1}, {m, per_line}}, false);
      });
  datum.is(p + "_b + " + m, {{p + "_b", one_before}, {m, per_line}});
}

void tell(Datum& datum, Work& work, std::int64_t step, const SpanBegin& e, std::string_view field) {
  const bool left = field.ends_with("left"), x = field.starts_with("x");
  if (field == "dz_dx") {
    if (e.x_right == e.x_left) return datum.note("no width: nothing to gain");
    return datum.is(formula_of(formulas::slope(symbol("z_L"), symbol("z_R"), symbol("x_L"), symbol("x_R"))),
                    {{"z_R", work.field(step, "z_right")},
                     {"z_L", work.field(step, "z_left")},
                     {"x_R", work.field(step, "x_right")},
                     {"x_L", work.field(step, "x_left")}});
  }
  const std::int32_t width = work.scene.raster.width;
  const Conventions::Coverage coverage = formulas::coverage_of(work.trace.header(), [&](Conventions::Coverage by) {
    return formulas::limited_column(formulas::last_pixel(e.x_right, by) + 1, width) - 1 == e.last;
  });
  if (field == "first")
    return tell_whole(datum, formulas::first_pixel(symbol("x_L"), coverage), {"x_L", work.field(step, "x_left")}, 0,
                      width, "W");
  if (field == "last") {
    tell_whole(datum, formulas::last_pixel(symbol("x_R"), coverage), {"x_R", work.field(step, "x_right")}, -2,
               width - 1, "W - 1");
    return datum.note(coverage == Conventions::Coverage::top_left ? "a pixel on x_R belongs to what lies to the right"
                      : coverage == Conventions::Coverage::round
                          ? "coverage goes to round(x_R)"
                          : "coverage is inclusive: a pixel on x_R belongs to the span");
  }
  if (!field.ends_with("left") && !field.ends_with("right")) return;
  const Step active = step_of_active_edge(work.trace, work.machine(), step, left ? e.left_edge : e.right_edge);
  const double value = left ? (x ? e.x_left : e.z_left) : (x ? e.x_right : e.z_right);
  datum.same_as(x ? "x" : "z", work.field(active, x ? "x_edge" : "z_edge", value));
}

}  // namespace zstep::answers
