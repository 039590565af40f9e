// The scan-line method: intervals of a line, the depths of planes on them, implied edges, shares of a pixel.
#include "sim/answers/origin/work.hpp"
#include "traces/formulas/of_colors.hpp"
#include "traces/formulas/of_sweep.hpp"

namespace zstep::answers {

static void tell(Datum& datum, Work& work, std::int64_t step, const SpanFlags&, std::string_view field) {
  const MethodState& m = work.machine();
  if (field == "flags") return datum.note("those that are in");
  const bool left = field == "x_left" || field == "first";
  if (field == "first")
    return datum.comes_of("the first whole number from x_L on, within the raster", {work.field(step, "x_left")});
  if (field == "last")
    return datum.comes_of("the last whole number before x_R, within the raster", {work.field(step, "x_right")});
  if (!field.starts_with("x")) return;
  // Between the edge that was crossed last and the next of the active ones.
  const Step flipped = find_last<FlagFlip>(work.trace, step, [](const FlagFlip&) { return true; });
  if (!flipped) return;
  const std::int32_t crossed = get<FlagFlip>(work.trace.event(*flipped).event).edge;
  for (std::size_t i = 0; i < m.active.size(); ++i) {
    if (m.active[i].edge != crossed) continue;
    const std::size_t wanted = left ? i : i + 1;
    if (wanted >= m.active.size()) return;
    const ActiveEdge edge = m.active[wanted];
    const Number x = work.field(step_of_active_edge(work.trace, m, step, edge.edge), "x_edge", edge.x);
    if (x.value == datum.number()) return datum.same_as("x", x);
    if (left) return datum.is("max(x, -0.5)", {{"x", x}});
    return datum.is("min(x, W - 0.5)", {{"x", x}, {"W", work.scene.raster.width}});
  }
}

static void tell(Datum& datum, Work& work, std::int64_t, const PlaneDepth& e, std::string_view field) {
  // An end of the interval of the line that is at work, or a corner or the centre of an area.
  const auto& interval = work.machine().sweep.interval;
  if (!interval || field != "x_at") return;
  const Step flags = find_last<SpanFlags>(work.trace, work.at(), [](const SpanFlags&) { return true; });
  if (e.x_at == interval->x_left) datum.same_as("x_left", work.field(flags, "x_left", interval->x_left));
  else if (e.x_at == interval->x_right) datum.same_as("x_right", work.field(flags, "x_right", interval->x_right));
}

static void tell(Datum& datum, Work& work, std::int64_t, const ImpliedEdge& e, std::string_view) {
  Operands of;
  const auto one = [&](char letter) { return of(fmt::format("{}_1", letter), work.plane(e.piece, letter)); };
  const auto other = [&](char letter) { return of(fmt::format("{}_2", letter), work.plane(e.other, letter)); };
  const Formula a_1 = one('A'), b_1 = one('B'), c_1 = one('C'), d_1 = one('D'), a_2 = other('A'), b_2 = other('B'),
                c_2 = other('C'), d_2 = other('D'), y = of("y", work.machine().scan_line.value_or(0));
  datum.is(formulas::where_planes_meet(a_1, b_1, c_1, d_1, a_2, b_2, c_2, d_2, y), of, false);
}

bool tell_coverage(Datum& datum, Work& work, std::int64_t step, std::int32_t x, std::int32_t y, int which) {
  const auto& covered = work.machine().sweep.covered;
  if (covered.empty() || covered.back().x != x || covered.back().y != y) return false;
  Operands of;
  Formula sum(0);
  int number = 0;
  for (const CoverageAdd& share : std::vector<CoverageAdd>(covered)) {
    const std::string n = std::to_string(++number);
    const Step added = find_last<CoverageAdd>(work.trace, step, [&](const CoverageAdd& other) {
      return other.x == x && other.y == y && other.owner == share.owner;
    });
    const Formula part = of("share_" + n, work.field(added, "coverage", share.coverage));
    sum = formulas::with_share(sum, part, of("colour_" + n, work.color_of(share.owner, which)));
  }
  datum.is(round(sum), of);
  return true;
}

void tell_sweep(Datum& datum, Work& work, std::int64_t step, const Event& event, std::string_view field) {
  tell_one_of<SpanFlags, PlaneDepth, ImpliedEdge>(event, [&](const auto& e) { tell(datum, work, step, e, field); });
}

}  // namespace zstep::answers
