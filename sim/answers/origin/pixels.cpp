// The depth of a pixel by its plane or by its ray, colours, and the way from a pixel of the eye's picture to the
// light's.

#include <array>
#include <cmath>
#include <cstdlib>
#include <string>

#include <glm/matrix.hpp>

#include "algorithms/shadow_buffer/shadow_buffer.hpp"
#include "algorithms/viewing/camera.hpp"
#include "sim/answers/origin/work.hpp"
#include "traces/formulas/attributes.hpp"
#include "traces/formulas/of_colors.hpp"
#include "traces/formulas/of_light.hpp"
#include "traces/formulas/viewing.hpp"

namespace zstep::answers {
namespace {

void tell_along_ray(Datum& datum, Work& work, std::int64_t step) {
  const Step end = work.last(step, &RayEnd::ray, work.machine().rays.tree.front().entry.ray);
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
  const Polygon* known = entry(scene.polygons, polygon);
  const double value = channel(known ? known->color : scene.background, which);
  return derived(0, fmt::format("colour of {}", polygon), "colour of " + label(polygon), channel_names[which], value,
                 [&](Datum& datum) { datum.at_source(known ? source_of_polygon(polygon) : source_line(0)); });
}

static void tell(Datum& datum, Work& work, std::int64_t, const ColorBlend& e, std::string_view field) {
  if (field == "opacity") {
    if (entry(work.scene.polygons, e.polygon)) datum.at_source(work.source_of_polygon(e.polygon));
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
  if (!m.rays.tree.empty()) {
    const Step end = work.last(step, &RayEnd::ray, m.rays.tree.front().entry.ray);
    return datum.is("round(255*light)", {{"light", work.field(end, channel_names[which], 0)}});
  }
  if (m.shadow && m.shadow->x == e.x && m.shadow->y == e.y) {
    const std::int32_t polygon = work.buffers().picture.polygon[work.buffers().picture.at(e.x, e.y)];
    const Step compare = work.last<ShadowCompare>(step);
    if (compare) work.later(*compare, "lit");
    return datum.is("round(colour*in_shadow)",
                    {{"colour", work.color_of(polygon, which)}, {"in_shadow", shadow_buffer::in_shadow}});
  }
  if (m.attribute && m.attribute->x == e.x && m.attribute->y == e.y) {
    const std::int32_t polygon = work.buffers().picture.polygon[work.buffers().picture.at(e.x, e.y)];
    const Step found = work.last<AttributeInterpolate>(step);
    if (found) work.later(*found, "attribute");
    return datum.is("round(colour*stripe)", {{"colour", work.color_of(polygon, which)},
                                             {"stripe", formulas::stripe_shade(m.attribute->attribute)}});
  }
  if (tell_coverage(datum, work, step, e.x, e.y, which)) return;
  datum.note("the ink of what is drawn there");
}

// From a pixel of the eye's picture to the light's (shadow buffer): the way of a vertex backwards, then once more
// forwards.

namespace {

/// A row of a matrix times a point, with the entries as plain numbers.
void tell_row(Datum& datum, const glm::dmat4& matrix, const char* letter, Axis3 row, const std::array<Number, 3>& point,
              const char* names) {
  Operands of;
  const auto m = [&](int column) {
    return of(fmt::format("{}_{}{}", letter, +row + 1, column + 1), matrix[column][+row]);
  };
  const auto p = [&](Axis3 axis) { return of(axis_name(axis, names), point[+axis]); };
  const Formula m_1 = m(0), x = p(Axis3::x), m_2 = m(1), y = p(Axis3::y), m_3 = m(2), z = p(Axis3::z), m_4 = m(3);
  datum.is(formulas::matrix_row(m_1, m_2, m_3, m_4, x, y, z), of, false);
}

/// A depth of the buffer, of this name, as far from the eye as it is.
void tell_view_depth(Datum& datum, const viewing::Lens& lens, const std::string& name, const Number& depth) {
  if (lens.depth == Conventions::Depth::view || std::isinf(depth.value)) return datum.same_as(name, depth);
  Operands of;
  const Formula n = of("n", lens.near), f = of("f", lens.far), z = of(name, depth);
  datum.is(
      lens.orthographic ? formulas::depth_of_parallel_pseudodepth(n, f, z) : formulas::depth_of_pseudodepth(n, f, z),
      of);
}

/// The numbers between the two pictures, as values of the step's link.
struct ThroughSpace {
  Work& work;
  std::int64_t step;
  const ShadowCompare& e;
  const viewing::Lens eye{work.scene.camera, work.scene.raster, work.conventions.depth};
  const Camera camera = viewing::camera_of(*work.scene.light);
  const viewing::Lens light{camera, work.scene.raster, work.conventions.depth};

  template <class Tell>
  Number value(const std::string& name, double is, Tell&& tell) {
    return work.derived(step, "", "", name, is, tell);
  }

  Number depth() {
    const double z = work.buffers().picture.depth[work.buffers().picture.at(e.x, e.y)];
    return work.kept(step, "depth", fmt::format("depth of pixel ({}, {})", e.x, e.y), work.depth_name(), z, "z", [&] {
      return step_of_depth(work.trace, step, {e.x, e.y}, false);
    });
  }
  Number z_v() {
    const Number z = depth();
    return value("z_eye", view_depth(work.scene.camera, work.conventions, z.value),
                 [&](Datum& datum) { tell_view_depth(datum, eye, "z", z); });
  }
  Number viewed(bool x) {
    const Number z = z_v();
    Operands of;
    const Formula at = x ? of("x", e.x) : of("y", e.y), size = x ? of("W", eye.width) : of("H", eye.height),
                  window = x ? of("w_x", work.window_width(step, "w_x", eye.window_y)) : of("w_y", eye.window_y),
                  plane = x ? formulas::window_x(at, window, size, eye.raster)
                            : formulas::window_y(at, window, size, eye.raster),
                  far = of("z_eye", z), d = of("d", eye.d), seen = eye.orthographic ? plane : plane * (far / d);
    return work.part(step, x ? "x_eye" : "y_eye", seen, of);
  }
  Number world(Axis3 axis) {
    const std::array<Number, 3> at{viewed(true), viewed(false), z_v()};
    const glm::dmat4 matrix = glm::inverse(work.scene.camera.view);
    const glm::dvec4 point = matrix * glm::dvec4(at[0].value, at[1].value, at[2].value, 1);
    return value(axis_name(axis, "_w"), point[+axis],
                 [&](Datum& datum) { tell_row(datum, matrix, "V", axis, at, "_eye"); });
  }
  Number seen(Axis3 axis) {
    const std::array<Number, 3> at{world(Axis3::x), world(Axis3::y), world(Axis3::z)};
    const glm::dvec4 point = camera.view * glm::dvec4(at[0].value, at[1].value, at[2].value, 1);
    return value(axis_name(axis, "_v"), point[+axis],
                 [&](Datum& datum) { tell_row(datum, camera.view, "L", axis, at, "_w"); });
  }
};

/// How far behind the shadow buffer a point may lie and still be lit, in 1/1000: as the run was told, or the method's
/// own.
double bias_of(const Conventions& conventions) {
  const auto given = conventions.options.find("bias");
  return std::strtod(given != conventions.options.end() ? given->second.c_str()
                                                        : std::string(shadow_buffer::options[0].standard).c_str(),
                     nullptr);
}

}  // namespace

static void tell(Datum& datum, Work& work, std::int64_t step, const ShadowCompare& e, std::string_view field) {
  if (!work.scene.light || field == "x" || field == "y") return;
  ThroughSpace through{work, step, e};
  const viewing::Lens& lens = through.light;
  Operands of;
  if (field == "x_light") {
    const Formula d = of("d", lens.d), x_v = of("x_v", through.seen(Axis3::x)), z_v = of("z_v", through.seen(Axis3::z)),
                  w_x = of("w_light", work.window_width(step, "w_light", lens.window_y)), width = of("W", lens.width);
    return datum.is(formulas::screen_x(formulas::projected(d, x_v, z_v), w_x, width, lens.raster), of, false);
  }
  if (field == "y_light") {
    const Formula w_y = of("w_y", lens.window_y), d = of("d", lens.d), y_v = of("y_v", through.seen(Axis3::y)),
                  z_v = of("z_v", through.seen(Axis3::z)), height = of("H", lens.height);
    return datum.is(formulas::screen_y(formulas::projected(d, y_v, z_v), w_y, height, lens.raster), of, false);
  }
  if (field == "z_light") {
    const Formula n = of("n", lens.near), a = of("a", lens.a), z_v = of("z_v", through.seen(Axis3::z)),
                  b = of("b", lens.b);
    return datum.is(lens.depth == Conventions::Depth::view ? z_v : formulas::pseudodepth(n, a, b, z_v), of, false);
  }
  const double column = std::round(e.x_light), row = std::round(e.y_light);
  const std::vector<Number> asked{work.field(step, "z_light"), work.field(step, "x_light"),
                                  work.field(step, "y_light")};
  const Picture& light = work.buffers().light;
  if (!(column >= 0 && column < light.width && row >= 0 && row < light.height))
    return datum.comes_of("false beside the light's picture", asked);
  const Trace::Pixel pixel{static_cast<std::int32_t>(column), static_cast<std::int32_t>(row)};
  const double stored = light.depth[light.at(pixel.x, pixel.y)];
  const std::string owner = work.label(light.polygon[light.at(pixel.x, pixel.y)]);
  const Number shadow = work.kept(
      step, "shadow", fmt::format("shadow[{}, {}], of {}", pixel.x, pixel.y, owner), "shadow", stored, "z",
      [&] { return step_of_depth(work.trace, step, pixel, true); }, "the light saw nothing there");
  // It is by how far they are from the light that the two depths are held against each other.
  const Number z_v = through.seen(Axis3::z);
  if (z_v.value < through.camera.near)
    return datum.comes_of("false before the light's near plane", {z_v, asked[0], asked[1], asked[2]});
  const Number behind = through.value("z_shadow", view_depth(through.camera, work.conventions, stored),
                                      [&](Datum& inner) { tell_view_depth(inner, lens, "shadow", shadow); });
  const double bias = bias_of(work.conventions);
  const bool as_recorded = e.lit == (z_v.value * (1 - bias / 1000) <= behind.value);
  if (!as_recorded && !work.conventions.options.contains("bias"))
    return datum.comes_of("by z_v and z_shadow; the trace does not say how large its bias is",
                          {z_v, behind, asked[0], shadow, asked[1], asked[2]});
  const Formula depth = of("z_v", z_v), nearer = formulas::nearer_by_bias(depth, of("bias", bias) / Formula(1000)),
                lit = Formula::compared(nearer, "<=", of("z_shadow", behind), as_recorded);
  datum.holds_if(lit.text(), of.in(lit));
  datum.note("z_v is how far from the light it is, z_shadow what the light sees there");
}

TellTheme* const tell_pixels = tell_one_of<PixelPaint, ColorBlend, ColorWrite>;
TellTheme* const tell_light = tell_one_of<ShadowCompare>;

}  // namespace zstep::answers
