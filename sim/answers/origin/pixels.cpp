// The depth of a pixel by its plane or by its ray, colours, and the way from a pixel of the eye's picture to the
// light's.

#include <array>
#include <cmath>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include <glm/matrix.hpp>

#include "algorithms/viewing/camera.hpp"
#include "sim/answers/origin/work.hpp"
#include "traces/formulas/shading.hpp"
#include "traces/formulas/of_colors.hpp"
#include "traces/formulas/of_shadows.hpp"
#include "traces/formulas/viewing.hpp"

namespace zstep::answers {
namespace {

void tell_along_ray(Datum& datum, Work& work, std::int64_t step) {
  const Step end = work.last(step, &RayEnd::ray, work.machine().rays.tree.front().entry.ray);
  const Number t = work.field(end, "t", datum.number());
  if (work.scene.camera.kind == Camera::Kind::screen) return datum.same_as("t", t);
  const viewing::Lens lens(work.scene.camera, work.scene.raster, work.conventions.depth);
  const bool view = lens.scale.depth == Conventions::Depth::view;
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

/// A channel of a polygon's pixel from what was interpolated there, by the steps `found`.
static void tell_shade(Datum& datum, Work& work, const formulas::Shading& shading, std::int32_t polygon, int which,
                       const std::array<Step, 3>& found) {
  using formulas::Shade;
  std::array<double, 3> a = work.machine().components;
  if (shading.components() == 1) a[0] = work.machine().attribute->attribute;  // also of a pixel that is written twice
  const auto given = [&](std::int32_t k) { return work.field(found[k], "attribute", a[k]); };
  const Number color = work.color_of(polygon, which);
  if (shading.shade == Shade::colors) return datum.is("round(255*a)", {{"a", given(which)}});
  if (shading.shade == Shade::gouraud)
    return datum.is("round(min(colour*diffuse + 255*highlight, 255))",
                    {{"colour", color}, {"diffuse", given(0)}, {"highlight", given(1)}});
  for (std::int32_t k = 0; k < shading.components(); ++k)
    if (found[k]) work.later(*found[k], "attribute");
  if (shading.shade == Shade::phong) {
    const formulas::Reflected light = formulas::reflected(shading.lighting, {a[0], a[1], a[2]});
    return datum.is("round(min(colour*diffuse + 255*highlight, 255))",
                    {{"colour", color}, {"diffuse", light.diffuse}, {"highlight", light.highlight}});
  }
  const Texture* const texture = formulas::is_of_texture(shading.shade) && entry(work.scene.polygons, polygon)
                                     ? formulas::texture_of(work.scene, polygon)
                                     : nullptr;
  const std::string image = texture ? std::filesystem::path(texture->source).filename().string() : "";
  if (texture && shading.shade == Shade::nearest) {
    const auto [column, row] = formulas::on_texture(*texture, a[0], a[1]);
    datum.is("texel", {{"texel", channel(formulas::nearest_texel(*texture, a[0], a[1]), which)}});
    return datum.at_source(fmt::format("{}, texel ({}, {})", image, std::floor(column), std::floor(row)));
  }
  if (texture) {
    const formulas::FourTexels four = formulas::four_texels(*texture, a[0], a[1]);
    std::vector<Given> operands;
    for (std::size_t i = 0; i < 4; ++i) {
      operands.push_back({fmt::format("part_{}", i), four.part[i]});
      operands.push_back({fmt::format("texel_{}", i), channel(four.color[i], which)});
    }
    datum.is("round(part_0*texel_0 + part_1*texel_1 + part_2*texel_2 + part_3*texel_3)", std::move(operands));
    return datum.at_source(image);
  }
  if (formulas::is_of_texture(shading.shade)) return datum.is("colour", {{"colour", color}});
  if (shading.shade == Shade::checker)
    return datum.is("round(colour*square)", {{"colour", color}, {"square", formulas::checker_shade(a[0], a[1])}});
  datum.is("round(colour*stripe)", {{"colour", color}, {"stripe", formulas::stripe_shade(a[0])}});
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
    Operands of;
    const Formula color = of("colour", work.color_of(polygon, which)), left = of("in_shadow", formulas::in_shadow);
    if (m.light_share && m.light_share->x == e.x && m.light_share->y == e.y) {
      const Number share = work.field(work.last<LightShare>(step), "share", m.light_share->share);
      return datum.is(round(color * formulas::kept_of_color(left, of("share", share))), of);
    }
    const Step compare = work.last<ShadowCompare>(step);
    if (compare) work.later(*compare, "lit");
    return datum.is(round(color * left), of);
  }
  if (m.attribute && m.attribute->x == e.x && m.attribute->y == e.y) {
    const std::int32_t polygon = work.buffers().picture.polygon[work.buffers().picture.at(e.x, e.y)];
    const formulas::Shading shading = formulas::shading_of(work.scene, work.conventions);
    std::array<Step, 3> found{};  // of the numbers that were interpolated, the last one first
    for (std::int32_t k = shading.components(); k-- > 0;) {
      found[k] = work.last<AttributeInterpolate>(k + 1 < shading.components() ? *found[k + 1] - 1 : step);
      if (!found[k]) break;
    }
    return tell_shade(datum, work, shading, polygon, which, found);
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
  if (lens.scale.depth == Conventions::Depth::view || std::isinf(depth.value)) return datum.same_as(name, depth);
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
  const Trace::Pixel e;
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

/// The last step of a kind before this one, where it is of this pixel.
template <class E>
Step of_pixel(Work& work, std::int64_t step, Trace::Pixel pixel) {
  const Step last = work.last<E>(step);
  const E* event = last ? get_if<E>(&work.trace.event(*last).event) : nullptr;
  return event && event->x == pixel.x && event->y == pixel.y ? last : Step{};
}

/// How far behind the shadow buffer the point of a pixel may lie.
Number bias_of(ThroughSpace& through) {
  Work& work = through.work;
  if (const Step told = of_pixel<ShadowBias>(work, through.step, through.e)) return work.field(*told, "bias");
  const formulas::ShadowOptions options = formulas::shadow_options(work.conventions);
  Operands of;
  const Formula z_v = of("z_v", through.seen(Axis3::z)), thousandths = of("bias_in_1000", options.bias * 1000);
  return work.part(through.step, "bias", z_v * (thousandths / Formula(1000)), of);
}

/// Whether the point of a pixel is lit by what the shadow buffer holds at (column, row). `asked` is what that place
/// comes of.
void tell_lit(Datum& datum, ThroughSpace& through, double column, double row, bool lit,
              const std::vector<Number>& asked) {
  Work& work = through.work;
  const Picture& light = work.buffers().light;
  if (!(column >= 0 && column < light.width && row >= 0 && row < light.height))
    return datum.comes_of("false beside the light's picture", asked);
  const Trace::Pixel pixel{static_cast<std::int32_t>(column), static_cast<std::int32_t>(row)};
  const double stored = light.depth[light.at(pixel.x, pixel.y)];
  const std::string owner = work.label(light.polygon[light.at(pixel.x, pixel.y)]);
  const Number shadow = work.kept(
      through.step, "shadow", fmt::format("shadow[{}, {}], of {}", pixel.x, pixel.y, owner), "shadow", stored, "z",
      [&] { return step_of_depth(work.trace, through.step, pixel, true); }, "the light saw nothing there");
  // It is by how far they are from the light that the two depths are held against each other.
  const Number z_v = through.seen(Axis3::z);
  std::vector<Number> besides = asked;
  if (z_v.value < through.camera.near) {
    besides.insert(besides.begin(), z_v);
    return datum.comes_of("false before the light's near plane", besides);
  }
  const Number behind = through.value("z_shadow", view_depth(through.camera, work.conventions, stored),
                                      [&](Datum& inner) { tell_view_depth(inner, through.light, "shadow", shadow); });
  const Number bias = bias_of(through);
  const bool as_recorded = lit == (z_v.value - bias.value <= behind.value);
  if (!as_recorded && !formulas::shadow_options(work.conventions).declared) {
    besides.insert(besides.begin(), {z_v, behind, shadow});
    return datum.comes_of("by z_v and z_shadow; the trace does not say how large its bias is", besides);
  }
  Operands of;
  const Formula far = of("z_v", z_v), less = of("bias", bias), there = of("z_shadow", behind),
                holds = Formula::compared(far - less, "<=", there, as_recorded);
  datum.holds_if(holds.text(), of.in(holds));
  datum.note("z_v is how far from the light it is, z_shadow what the light sees there");
}

}  // namespace

static void tell(Datum& datum, Work& work, std::int64_t step, const ShadowCompare& e, std::string_view field) {
  if (!work.scene.light || field == "x" || field == "y") return;
  ThroughSpace through{work, step, {e.x, e.y}};
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
    return datum.is(lens.scale.depth == Conventions::Depth::view ? z_v : formulas::pseudodepth(n, a, b, z_v), of,
                    false);
  }
  tell_lit(datum, through, std::round(e.x_light), std::round(e.y_light), e.lit,
           {work.field(step, "z_light"), work.field(step, "x_light"), work.field(step, "y_light")});
}

static void tell(Datum& datum, Work& work, std::int64_t step, const ShadowBias& e, std::string_view field) {
  if (!work.scene.light || field == "x" || field == "y") return;
  ThroughSpace through{work, step, {e.x, e.y}};
  const std::int32_t polygon = work.buffers().picture.polygon[work.buffers().picture.at(e.x, e.y)];
  const Number z_v = through.seen(Axis3::z);
  Operands of;
  if (field == "bias") {
    const formulas::ShadowOptions options = formulas::shadow_options(work.conventions);
    const bool across = std::abs(e.dz_dx_light) >= std::abs(e.dz_dy_light);
    const Number slope = work.field(step, across ? "dz_dx_light" : "dz_dy_light");
    const Formula m = of(across ? "dz_dx" : "dz_dy", slope), z = of("z_v", z_v),
                  c = of("bias_in_1000", options.bias * 1000) / Formula(1000), f = of("factor", options.slope_bias);
    return datum.is(formulas::light_bias(z, c, f, slope.value < 0 ? -m : m), of, false);
  }
  const glm::dvec3 p(through.seen(Axis3::x).value, through.seen(Axis3::y).value, z_v.value);
  const auto world = formulas::normal_of_polygon<double>(work.scene, polygon);
  const glm::dvec3 normal = glm::dmat3(through.camera.view) * glm::dvec3(world.x, world.y, world.z);
  const double pixel = 2 * through.camera.window / work.scene.raster.height, n_p = glm::dot(normal, p);
  const bool x = field == "dz_dx_light";
  const Formula n = of(x ? "N_x" : "N_y", x ? normal.x : normal.y), of_point = of("N_p", n_p), z = of("z_v", z_v),
                d = of("d", through.camera.d),
                step_on_plane = of("pixel", x || work.scene.raster.y_up ? pixel : -pixel);
  const Formula slope = formulas::slope_in_picture(n, of_point, z, d, step_on_plane);
  if (!(std::abs(slope.value()) < z_v.value))
    return datum.comes_of("the light sees the polygon edge-on: no more than z_v", {z_v});
  datum.is(slope, of, false);
  datum.note("N is the polygon's normal as the light sees it, N_p = N \u00b7 P of the point");
}

static void tell(Datum& datum, Work& work, std::int64_t step, const ShadowNeighbour& e, std::string_view field) {
  const Step compare = of_pixel<ShadowCompare>(work, step, {e.x, e.y});
  if (!work.scene.light || !compare || field == "x" || field == "y") return;
  const std::vector<Number> asked{work.field(*compare, "x_light"), work.field(*compare, "y_light")};
  if (field != "lit") return datum.comes_of("a neighbour of where the point is in the light's picture", asked);
  ThroughSpace through{work, step, {e.x, e.y}};
  tell_lit(datum, through, e.x_shadow, e.y_shadow, e.lit, asked);
}

static void tell(Datum& datum, Work& work, std::int64_t step, const LightShare& e, std::string_view field) {
  if (field != "share") return;
  const MethodState& m = work.machine();
  double lit = m.shadow && m.shadow->lit ? 1 : 0;
  for (const ShadowNeighbour& neighbour : m.neighbours) lit += neighbour.lit ? 1 : 0;
  if (const Step compare = of_pixel<ShadowCompare>(work, step, {e.x, e.y})) work.later(*compare, "lit");
  Operands of;
  const Formula count = of("lit", lit), across = of("k", formulas::shadow_options(work.conventions).across);
  datum.is(count / (across * across), of);
  datum.note("lit is how many of its k times k compares say lit; beside the light's picture there is none");
}

TellTheme* const tell_pixels = tell_one_of<PixelPaint, ColorBlend, ColorWrite>;
TellTheme* const tell_light = tell_one_of<ShadowBias, ShadowCompare, ShadowNeighbour, LightShare>;

}  // namespace zstep::answers
