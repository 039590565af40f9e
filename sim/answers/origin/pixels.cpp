// The depth of a pixel: along its span, by its plane or by its ray; what it was held against; and colours.
#include "algorithms/shadow_buffer/shadow_buffer.hpp"
#include "algorithms/viewing/camera.hpp"
#include "sim/answers/origin/work.hpp"
#include "traces/formulas/lines.hpp"
#include "traces/formulas/planes.hpp"

namespace zstep::answers {
namespace {

/// z on the span at work, directly.
void tell_on_span(Datum& datum, Work& work, std::int64_t step, const SpanBegin& s, double x) {
  const Step span = find_last<SpanBegin>(work.trace, step, [&](const SpanBegin& e) {
    return e.y == s.y && e.left_edge == s.left_edge && e.x_left == s.x_left;
  });
  const Number z_left = work.field(span, "z_left", s.z_left);
  if (s.x_right == s.x_left) return datum.same_as("z_L", z_left);
  datum.is(formula_of(formulas::on_line(symbol("z_L"), symbol("z_R"), symbol("x"), symbol("x_L"), symbol("x_R"))),
           {{"z_L", z_left},
            {"z_R", work.field(span, "z_right", s.z_right)},
            {"x", x},
            {"x_L", work.field(span, "x_left", s.x_left)},
            {"x_R", work.field(span, "x_right", s.x_right)}});
}

void tell_by_increments(Datum& datum, Work& work, std::int64_t step, const SpanBegin& s, const DepthInterpolate& e) {
  const Step span = find_last<SpanBegin>(
      work.trace, step, [&](const SpanBegin& other) { return other.y == s.y && other.left_edge == s.left_edge; });
  const Step before = find_last<DepthInterpolate>(
      work.trace, step - 1, [&](const DepthInterpolate& other) { return other.y == e.y && other.x == e.x - 1; });
  const Step first = find_last<DepthInterpolate>(
      work.trace, step - 1, [&](const DepthInterpolate& other) { return other.y == e.y && other.x == s.first; });
  if (!before || !first) return tell_on_span(datum, work, step, s, e.x);
  const Number gain = work.field(span, "dz_dx", s.dz_dx);
  if (before == first) return datum.is("z_0 + dz_dx", {{"z_0", work.field(*first, "z")}, {"dz_dx", gain}});
  const double z = get<DepthInterpolate>(work.trace.event(*before).event).z;
  const Number last = work.derived(
      *before, "pixel before", fmt::format("depth at x = {}, one pixel before", e.x - 1), "z_b", z, [&](Datum& inner) {
        inner.is("z_f + pixels*dz_dx",
                 {{"z_f", work.field(*first, "z")}, {"pixels", e.x - 1 - s.first}, {"dz_dx", gain}}, false);
      });
  datum.is("z_b + dz_dx", {{"z_b", last}, {"dz_dx", gain}});
}

/// The piece that a pixel is painted with where depths come from planes; -1 where they come from spans.
std::int32_t piece_of_plane(const Work& work) {
  const MethodState& m = work.machine();
  const auto area = static_cast<std::size_t>(m.area);
  if (m.area >= 0 && area < m.areas.size()) return m.areas[area].decided ? m.areas[area].decided->piece : -1;
  return m.piece == -1 && !m.sweep.winners.empty() ? m.sweep.winners.back().piece : -1;
}

void tell_along_ray(Datum& datum, Work& work, std::int64_t step) {
  const Step end = find_last<RayEnd>(
      work.trace, step, [&](const RayEnd& e) { return e.ray == work.machine().rays.tree.front().entry.ray; });
  const Number t = work.field(end, "t", datum.number());
  if (work.scene.camera.kind == Camera::Kind::screen) return datum.same_as("t", t);
  const viewing::Lens lens(work.scene.camera, work.scene.raster, work.conventions.depth);
  const bool view = lens.depth == Conventions::Depth::view;
  if (lens.orthographic && view) return datum.same_as("t", t);
  if (lens.orthographic) return datum.is("2*(t - n)/(f - n) - 1", {{"t", t}, {"n", lens.near}, {"f", lens.far}});
  if (view) return datum.is("t*d", {{"t", t}, {"d", lens.d}});
  datum.is("n*(a*(t*d) + b)/(t*d)", {{"n", lens.near}, {"a", lens.a}, {"t", t}, {"d", lens.d}, {"b", lens.b}});
}

}  // namespace

void tell(Datum& datum, Work& work, std::int64_t step, const DepthInterpolate& e, std::string_view field) {
  if (field != "z" || !work.machine().span) return;
  const SpanBegin span = *work.machine().span;
  if (work.conventions.interpolation == Conventions::Interpolation::increments && e.x > span.first)
    return tell_by_increments(datum, work, step, span, e);
  tell_on_span(datum, work, step, span, e.x);
}

void tell(Datum& datum, Work& work, std::int64_t step, const DepthCompare& e, std::string_view field) {
  const auto here = [&](const DepthInterpolate& other) { return other.x == e.x && other.y == e.y; };
  if (field == "z") {
    const Step made = find_last<DepthInterpolate>(
        work.trace, step, here, [](const Event& event) { return holds<SpanBegin>(event); });
    if (made) datum.same_as("z", work.field(*made, "z"));
    return;
  }
  if (field != "nearer") return;
  const auto fragment = work.machine().fragment;
  const Comparison& comparison = work.trace.header().comparison;
  const bool smaller = comparison.nearer == Comparison::Nearer::smaller,
             first = comparison.ties == Comparison::Ties::first;
  const std::string sign = fmt::format("{}{}", smaller ? '<' : '>', first ? "" : "=");
  if (!fragment) return datum.comes_of(fmt::format("z {} the stored depth", sign), {work.field(step, "z")});
  // The stored depth comes from elsewhere in the run: its own links follow after these.
  const Number stored = work.derived(
      step, "stored",
      fmt::format("stored depth at pixel ({}, {}), of {}", e.x, e.y, work.label(fragment->stored_polygon)), "stored",
      fragment->stored, [&](Datum& inner) {
        const Step wrote = step_of_depth(work.trace, step - 1, {e.x, e.y}, work.machine().pass == Pass::light);
        if (!wrote)
          return inner.note(fragment->stored_polygon == no_polygon ? "nothing was drawn there yet"
                                                                   : "its depth was never written there");
        inner.is("z", {{"z", fragment->stored}});
        work.later(*wrote, "z", "z");
      });
  datum.holds_if(fmt::format("z {} stored", sign), {{"z", work.field(step, "z")}, {"stored", stored}});
}

void tell(Datum& datum, Work& work, std::int64_t step, const DepthWrite& e, std::string_view field) {
  if (field != "z") return;
  const Step compare = find_last<DepthCompare>(
      work.trace, step, [&](const DepthCompare& other) { return other.x == e.x && other.y == e.y; });
  if (compare) datum.same_as("z", work.field(*compare, "z"));
}

void tell(Datum& datum, Work& work, std::int64_t step, const PixelPaint& e, std::string_view field) {
  if (field != "z") return;
  const MethodState& m = work.machine();
  if (!m.rays.tree.empty()) return tell_along_ray(datum, work, step);
  if (const std::int32_t piece = piece_of_plane(work); piece >= 0) {
    const auto plane = [&](char letter) { return work.plane(piece, letter); };
    return datum.is(
        formula_of(formulas::plane_depth(symbol("A"), symbol("B"), symbol("C"), symbol("D"), symbol("x"), symbol("y"))),
        {{"A", plane('A')}, {"x", e.x}, {"B", plane('B')}, {"y", e.y}, {"D", plane('D')}, {"C", plane('C')}});
  }
  if (m.span && m.span->y == e.y) tell_on_span(datum, work, step, SpanBegin(*m.span), e.x);
}

namespace {

int channel_of(std::string_view field) {
  return field == "r8" || field == "red" ? 0 : field == "g8" || field == "green" ? 1 : 2;
}
bool names_channel(std::string_view field) { return field == "r8" || field == "g8" || field == "b8"; }

Number color_of_polygon(Work& work, std::int32_t polygon, int which) {
  static constexpr const char* names[] = {"red", "green", "blue"};
  const auto at = static_cast<std::size_t>(polygon);
  const bool known = polygon >= 0 && at < work.scene.polygons.size();
  const double value = channel(known ? work.scene.polygons[at].color : work.scene.background, which);
  return work.derived(
      0, fmt::format("colour of {}", polygon), "colour of " + work.label(polygon), names[which], value,
      [&](Datum& datum) { datum.at_source(known ? work.source_of_polygon(polygon) : work.source_line(0)); });
}

}  // namespace

void tell(Datum& datum, Work& work, std::int64_t, const ColorBlend& e, std::string_view field) {
  const auto at = static_cast<std::size_t>(e.polygon);
  if (field == "opacity") {
    if (e.polygon >= 0 && at < work.scene.polygons.size()) datum.at_source(work.source_of_polygon(e.polygon));
    return datum.note("the material's");
  }
  if (!names_channel(field)) return;
  const int which = channel_of(field);
  const auto fragment = work.machine().fragment;
  const Number top = color_of_polygon(work, e.polygon, which);
  if (!fragment || fragment->x != e.x || fragment->y != e.y) return datum.comes_of("mixed with what was there", {top});
  const Number bottom = fragment->stored_ink != no_ink ? Number(channel(zstep::color_of(fragment->stored_ink), which))
                                                       : color_of_polygon(work, fragment->stored_polygon, which);
  datum.is("round(alpha*over + (1 - alpha)*under)", {{"alpha", e.opacity}, {"over", top}, {"under", bottom}});
}

void tell(Datum& datum, Work& work, std::int64_t step, const ColorWrite& e, std::string_view field) {
  if (!names_channel(field)) return;
  const int which = channel_of(field);
  const MethodState& m = work.machine();
  static constexpr const char* names[] = {"red", "green", "blue"};
  if (!m.rays.tree.empty()) {
    const Step end = find_last<RayEnd>(work.trace, step,
                                       [&](const RayEnd& other) { return other.ray == m.rays.tree.front().entry.ray; });
    return datum.is("round(255*light)", {{"light", work.field(end, names[which], 0)}});
  }
  if (m.shadow && m.shadow->x == e.x && m.shadow->y == e.y) {
    const std::int32_t polygon = work.state().picture.polygon[work.state().picture.at(e.x, e.y)];
    const Step compare = find_last<ShadowCompare>(work.trace, step, [](const ShadowCompare&) { return true; });
    if (compare) work.later(*compare, "lit");
    return datum.is("round(colour*in_shadow)",
                    {{"colour", color_of_polygon(work, polygon, which)}, {"in_shadow", shadow_buffer::in_shadow}});
  }
  if (!m.sweep.covered.empty() && m.sweep.covered.back().x == e.x && m.sweep.covered.back().y == e.y) {
    std::vector<Given> given;
    std::string text;
    for (const CoverageAdd& share : m.sweep.covered) {
      const std::string n = std::to_string(given.size() / 2 + 1);
      const Step added = find_last<CoverageAdd>(work.trace, step, [&](const CoverageAdd& other) {
        return other.x == e.x && other.y == e.y && other.owner == share.owner;
      });
      text += (text.empty() ? "" : " + ") + ("share_" + n) + "*colour_" + n;
      given.push_back({"share_" + n, work.field(added, "coverage", share.coverage)});
      given.push_back({"colour_" + n, color_of_polygon(work, share.owner, which)});
    }
    return datum.is("round(" + text + ")", std::move(given));
  }
  datum.note("the ink of what is drawn there");
}

}  // namespace zstep::answers
