// The depth of a pixel by its plane or by its ray, and colours.
#include "algorithms/shadow_buffer/shadow_buffer.hpp"
#include "algorithms/viewing/camera.hpp"
#include "sim/answers/origin/work.hpp"
#include "traces/formulas/attributes.hpp"
#include "traces/formulas/light.hpp"
#include "traces/formulas/viewing.hpp"

namespace zstep::answers {
namespace {

void tell_along_ray(Datum& datum, Work& work, std::int64_t step) {
  const Step end = find_last<RayEnd>(
      work.trace, step, [&](const RayEnd& e) { return e.ray == work.machine().rays.tree.front().entry.ray; });
  const Number t = work.field(end, "t", datum.number());
  if (work.scene.camera.kind == Camera::Kind::screen) return datum.same_as("t", t);
  const viewing::Lens lens(work.scene.camera, work.scene.raster, work.conventions.depth);
  const bool view = lens.depth == Conventions::Depth::view;
  if (lens.orthographic && view) return datum.same_as("t", t);
  Operands of;
  const Formula along = of("t", t), d = of("d", lens.d), n = of("n", lens.near), f = of("f", lens.far);
  if (lens.orthographic) return datum.is(formulas::parallel_pseudodepth(n, f, along), of);
  const Formula z_v = along * d;
  if (view) return datum.is(z_v, of);
  const auto part = [&](const char* name, double value, const Formula& formula) {
    return of(name, work.derived(step, "", "", name, value, [&](Datum& inner) { inner.is(formula, of); }));
  };
  const Formula a = part("a", lens.a, formulas::pseudodepth_a(n, f)),
                b = part("b", lens.b, formulas::pseudodepth_b(n, f));
  datum.is(formulas::pseudodepth(n, a, b, z_v), of);
}

}  // namespace

static void tell(Datum& datum, Work& work, std::int64_t step, const PixelPaint&, std::string_view field) {
  if (field == "z" && !work.machine().rays.tree.empty()) tell_along_ray(datum, work, step);
}

namespace {

int channel_of(std::string_view field) {
  return field == "r8" || field == "red" ? 0 : field == "g8" || field == "green" ? 1 : 2;
}
bool names_channel(std::string_view field) { return field == "r8" || field == "g8" || field == "b8"; }

}  // namespace

Number Work::color_of(std::int32_t polygon, int which) {
  static constexpr const char* names[] = {"red", "green", "blue"};
  const auto at = static_cast<std::size_t>(polygon);
  const bool known = polygon >= 0 && at < scene.polygons.size();
  const double value = channel(known ? scene.polygons[at].color : scene.background, which);
  return derived(0, fmt::format("colour of {}", polygon), "colour of " + label(polygon), names[which], value,
                 [&](Datum& datum) { datum.at_source(known ? source_of_polygon(polygon) : source_line(0)); });
}

static void tell(Datum& datum, Work& work, std::int64_t, const ColorBlend& e, std::string_view field) {
  const auto at = static_cast<std::size_t>(e.polygon);
  if (field == "opacity") {
    if (e.polygon >= 0 && at < work.scene.polygons.size()) datum.at_source(work.source_of_polygon(e.polygon));
    return datum.note("the material's");
  }
  if (!names_channel(field)) return;
  const int which = channel_of(field);
  const auto fragment = work.machine().fragment;
  const Number top = work.color_of(e.polygon, which);
  if (!fragment || fragment->x != e.x || fragment->y != e.y) return datum.comes_of("mixed with what was there", {top});
  const Number bottom = fragment->stored_ink != no_ink ? Number(channel(zstep::color_of(fragment->stored_ink), which))
                                                       : work.color_of(fragment->stored_polygon, which);
  Operands of;
  const Formula alpha = of("alpha", e.opacity), over = of("over", top), under = of("under", bottom);
  datum.is(round(formulas::laid_over(alpha, over, under)), of);
}

static void tell(Datum& datum, Work& work, std::int64_t step, const ColorWrite& e, std::string_view field) {
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
    const std::int32_t polygon = work.buffers().picture.polygon[work.buffers().picture.at(e.x, e.y)];
    const Step compare = find_last<ShadowCompare>(work.trace, step, [](const ShadowCompare&) { return true; });
    if (compare) work.later(*compare, "lit");
    return datum.is("round(colour*in_shadow)",
                    {{"colour", work.color_of(polygon, which)}, {"in_shadow", shadow_buffer::in_shadow}});
  }
  if (m.attribute && m.attribute->x == e.x && m.attribute->y == e.y) {
    const std::int32_t polygon = work.buffers().picture.polygon[work.buffers().picture.at(e.x, e.y)];
    const Step found =
        find_last<AttributeInterpolate>(work.trace, step, [](const AttributeInterpolate&) { return true; });
    if (found) work.later(*found, "attribute");
    return datum.is("round(colour*stripe)", {{"colour", work.color_of(polygon, which)},
                                             {"stripe", formulas::stripe_shade(m.attribute->attribute)}});
  }
  if (tell_coverage(datum, work, step, e.x, e.y, which)) return;
  datum.note("the ink of what is drawn there");
}

void tell_pixels(Datum& datum, Work& work, std::int64_t step, const Event& event, std::string_view field) {
  tell_one_of<PixelPaint, ColorBlend, ColorWrite>(event, [&](const auto& e) { tell(datum, work, step, e, field); });
}

}  // namespace zstep::answers
