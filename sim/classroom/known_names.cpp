// The names that mean something at every step: what is at work, the fragment, the span, the camera, the sizes.
#include <array>
#include <optional>

#include <fmt/core.h>

#include "sim/classroom/names.hpp"
#include "traces/error.hpp"

namespace zstep::classroom {
namespace {

[[noreturn]] void lacking(const Moment& moment, std::string_view what, std::string_view from) {
  throw InputError(moment.where, fmt::format("there is no {} at this step", what),
                   fmt::format("attach the stop to a step after {}", from));
}

const SpanBegin& span_at(const Moment& moment) {
  const auto& span = moment.state().machine.span;
  if (!span) lacking(moment, "span", "scan_conversion.span");
  return *span;
}
const Fragment& fragment_at(const Moment& moment) {
  const auto& fragment = moment.state().machine.fragment;
  if (!fragment) lacking(moment, "pixel at work", "interpolate_z");
  return *fragment;
}
/// That of the ray at work, if there is one, else that of the fragment.
glm::ivec2 pixel_at(const Moment& moment) {
  const RayWork& rays = moment.state().machine.rays;
  for (const RayRow& row : rays.tree)
    if (rays.ray == row.entry.ray) return {row.entry.x, row.entry.y};
  return {fragment_at(moment).x, fragment_at(moment).y};
}
const FacingTest& facing_at(const Moment& moment) {
  const auto& facing = moment.state().machine.facing;
  if (!facing) lacking(moment, "facing test", "facing");
  return *facing;
}
const auto& curve_at(const Moment& moment) {
  const auto& curve = moment.state().machine.horizon.curve;
  if (!curve) lacking(moment, "curve at work", "floating_horizon.curve");
  return *curve;
}
const Camera& camera_at(const Moment& moment) { return moment.trace().scene().camera; }

/// Just before interpolate_z, or a paint without one, the state still has the last fragment; the buffers have the
/// stored values of the coming one. This is its pixel.
std::optional<std::size_t> coming_pixel(const Moment& moment) {
  if (!moment.event) return std::nullopt;
  const auto pixel_of = [&](const auto& coming) -> std::optional<std::size_t> {
    const auto& fragment = moment.state().machine.fragment;
    const bool arrived =
        fragment && fragment->x == coming.x && fragment->y == coming.y && fragment->z == coming.z && !fragment->nearer;
    if (arrived) return std::nullopt;
    return moment.state().picture.at(coming.x, coming.y);
  };
  if (const auto* coming = get_if<DepthInterpolate>(&moment.event->event)) return pixel_of(*coming);
  if (const auto* coming = get_if<PixelPaint>(&moment.event->event)) return pixel_of(*coming);
  return std::nullopt;
}
Quantity stored(const Moment& moment) {
  if (const auto pixel = coming_pixel(moment)) return Quantity::of(moment.state().picture.depth[*pixel]);
  return Quantity::of(fragment_at(moment).stored);
}
Quantity stored_polygon(const Moment& moment) {
  if (const auto pixel = coming_pixel(moment)) return Quantity::of_polygon(moment.state().picture.polygon[*pixel]);
  return Quantity::of_polygon(fragment_at(moment).stored_polygon);
}

double count(std::size_t size) { return static_cast<double>(size); }

using Type = Quantity::Type;
#define OF_SPAN(member, meaning)                                                                    \
  KnownName {                                                                                       \
#member, Type::number, [](const Moment& m) { return Quantity::of(span_at(m).member); }, meaning \
  }
#define OF_FACING(member, meaning)                                                                    \
  KnownName {                                                                                         \
#member, Type::number, [](const Moment& m) { return Quantity::of(facing_at(m).member); }, meaning \
  }
#define OF_CAMERA(member, meaning)                                                                    \
  KnownName {                                                                                         \
#member, Type::number, [](const Moment& m) { return Quantity::of(camera_at(m).member); }, meaning \
  }

const KnownName names[] = {
    {"polygon", Type::polygon, [](const Moment& m) { return Quantity::of_polygon(m.state().machine.polygon); },
     "the polygon at work"},
    {"facet", Type::number, [](const Moment& m) { return Quantity::of(m.state().machine.facet); }, "the facet at work"},
    {"scan_line", Type::number,
     [](const Moment& m) {
       const auto& line = m.state().machine.scan_line;
       if (!line) lacking(m, "scan line", "scan_line");
       return Quantity::of(*line);
     },
     "the scan line at work"},
    {"active", Type::number, [](const Moment& m) { return Quantity::of(count(m.state().machine.active.size())); },
     "how many edges are active"},
    {"outline", Type::number, [](const Moment& m) { return Quantity::of(count(m.state().machine.outline.size())); },
     "how many vertices the polygon has as it is drawn"},
    {"stored", Type::number, stored, "the depth buffer's number at the pixel, before this fragment"},
    {"stored_polygon", Type::polygon, stored_polygon, "the polygon seen at the pixel, before this fragment"},
    {"x", Type::number, [](const Moment& m) { return Quantity::of(pixel_at(m).x); }, "column of the pixel at work"},
    {"y", Type::number, [](const Moment& m) { return Quantity::of(pixel_at(m).y); }, "row of the pixel at work"},
    {"z", Type::number, [](const Moment& m) { return Quantity::of(fragment_at(m).z); },
     "the polygon's depth at that pixel"},
    {"nearer", Type::truth,
     [](const Moment& m) {
       const Fragment& fragment = fragment_at(m);
       if (!fragment.nearer) lacking(m, "outcome of a compare", "compare");
       return Quantity::of_truth(*fragment.nearer);
     },
     "whether the pixel at work won its compare"},
    {"curve", Type::number, [](const Moment& m) { return Quantity::of(curve_at(m).curve); }, "the curve at work"},
    {"constant", Type::number, [](const Moment& m) { return Quantity::of(curve_at(m).constant); },
     "the z that is constant on the curve at work"},
    OF_SPAN(left_edge, "the span's edge on the left"),
    OF_SPAN(right_edge, "the span's edge on the right"),
    OF_SPAN(first, "the span's first pixel"),
    OF_SPAN(last, "the span's last pixel"),
    OF_SPAN(x_left, "x where the span begins"),
    OF_SPAN(z_left, "depth where the span begins"),
    OF_SPAN(x_right, "x where the span ends"),
    OF_SPAN(z_right, "depth where the span ends"),
    OF_SPAN(dz_dx, "what depth gains from pixel to pixel of the span"),
    {"facing", Type::word,
     [](const Moment& m) { return Quantity::of_word(words_of<Facing>[static_cast<std::size_t>(facing_at(m).facing)]); },
     "the verdict of the facing test"},
    OF_FACING(determinant, "the facing test's determinant"),
    OF_FACING(plane_at_eye, "the facet's plane equation at the eye"),
    OF_FACING(view_dot_normal, "(p - e) . n of the facet"),
    OF_FACING(projected_normal_z, "z of the facet's normal after projection"),
    OF_CAMERA(rho, "distance of the eye from the origin"),
    OF_CAMERA(theta, "the eye's angle around the z axis, degrees"),
    OF_CAMERA(phi, "the eye's angle from the z axis, degrees"),
    OF_CAMERA(d, "distance of the projection plane"),
    OF_CAMERA(window, "half the height of the window"),
    OF_CAMERA(near, "z_v of the near plane"),
    OF_CAMERA(far, "z_v of the far plane"),
    {"eye_x", Type::number, [](const Moment& m) { return Quantity::of(camera_at(m).eye.x); }, "the eye in the world"},
    {"eye_y", Type::number, [](const Moment& m) { return Quantity::of(camera_at(m).eye.y); }, "the eye in the world"},
    {"eye_z", Type::number, [](const Moment& m) { return Quantity::of(camera_at(m).eye.z); }, "the eye in the world"},
    {"width", Type::number, [](const Moment& m) { return Quantity::of(m.trace().scene().raster.width); }, "columns"},
    {"height", Type::number, [](const Moment& m) { return Quantity::of(m.trace().scene().raster.height); }, "rows"},
    {"polygons", Type::number, [](const Moment& m) { return Quantity::of(count(m.trace().scene().polygons.size())); },
     "how many polygons the scene has"},
    {"vertices", Type::number, [](const Moment& m) { return Quantity::of(count(m.trace().scene().points.size())); },
     "how many vertices the scene has"},
    {"steps", Type::number, [](const Moment& m) { return Quantity::of(static_cast<double>(m.trace().size())); },
     "how many steps the run took"},
};
#undef OF_SPAN
#undef OF_FACING
#undef OF_CAMERA

}  // namespace

std::span<const KnownName> known_names() { return names; }

const KnownName* find_known_name(std::string_view name) {
  for (const KnownName& known : names) {
    if (known.name == name) return &known;
  }
  return nullptr;
}

}  // namespace zstep::classroom
