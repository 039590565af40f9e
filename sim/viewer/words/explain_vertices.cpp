// Clearing the buffers; a vertex on its way through viewing, projection and viewport (000, "Viewing"; 003 for z*).
#include "sim/viewer/words/explain_parts.hpp"

namespace zstep::words {
namespace {

const glm::dvec3* world(const Telling& t, std::int32_t vertex) {
  const auto at = static_cast<std::size_t>(vertex);
  return vertex >= 0 && at < t.scene.points.size() ? &t.scene.points[at] : nullptr;
}

const VertexStages* way(const Telling& t, std::int32_t vertex) {
  const auto at = static_cast<std::size_t>(vertex);
  return vertex >= 0 && at < t.after.vertices.size() ? &t.after.vertices[at] : nullptr;
}

/// One row of T_v times a point: sum of products, products with 0 left out.
std::string row_times_point(const glm::dmat4& m, int row, const glm::dvec3& p) {
  std::string text;
  for (int column = 0; column < 4; ++column) {
    const double factor = m[column][row];
    if (std::abs(factor) < 1e-12) continue;
    if (!text.empty()) text += " + ";
    text += column < 3 ? fmt::format("{}\u00b7{}", operand(factor), operand(p[column])) : operand(factor);
  }
  return text.empty() ? "0" : text;
}

void tell_depth(Telling& t, const Projection& e, const glm::dvec3& v) {
  const Camera& c = t.camera;
  if (t.conventions.depth == Conventions::Depth::view) {
    t.formula(fmt::format("z_v stays: {}", number(e.z)));
    t.hold_against("z_v", e.z, v.z);
    return;
  }
  const double f = c.near, F = c.far;
  if (!(f < F)) return t.formula(fmt::format("z* = {}", number(e.z)));
  if (c.kind == Camera::Kind::orthographic) {
    const double z = (2 * v.z - (F + f)) / (F - f);
    t.formula(fmt::format("z* = (2 z_v \u2212 (F + f))/(F \u2212 f) = (2\u00b7{} \u2212 {})/{} = {}", operand(v.z), number(F + f),
                          number(F - f), number(e.z)));
    t.hold_against("z*", e.z, z);
    return;
  }
  const double a = -(f + F) / (f * (f - F)), b = 2 * F / (f - F);
  t.formula(fmt::format("z* = f(a z_v + b)/z_v = {}({}\u00b7{} + {})/{} = {}", number(f), number(a), operand(v.z), operand(b),
                        number(v.z), number(e.z)));
  t.formula(fmt::format("a = \u2212(f + F)/(f(f \u2212 F)) = {}, b = 2F/(f \u2212 F) = {}; near f = {}, far F = {}", number(a),
                        number(b), number(f), number(F)));
  t.hold_against("z*", e.z, f * (a * v.z + b) / v.z);
}

}  // namespace

void tell(Telling& t, const BuffersClear& e) {
  const Raster& r = t.scene.raster;
  t.say(std::isinf(e.z)
            ? "Every pixel becomes background and every depth becomes \u221e, so whatever comes first will be nearer."
            : fmt::format("Every pixel becomes background and every depth becomes {}.", number(e.z)));
  t.formula(fmt::format("zbuffer[x,y] = {} at {} \u00d7 {} = {} pixels", number(e.z), r.width, r.height,
                        grouped(std::int64_t{r.width} * r.height)));
}

void tell(Telling& t, const ViewTransform& e) {
  t.say(fmt::format("Vertex {} goes from world to viewing coordinates: seen from the {}, x_v is to the right, y_v up, z_v away.",
                    e.vertex, t.machine.pass == Pass::light ? "light" : "eye"));
  const double out[3] = {e.x_v, e.y_v, e.z_v};
  const char* names[3] = {"x_v", "y_v", "z_v"};
  const glm::dvec3* p = world(t, e.vertex);
  if (p) t.formula(fmt::format("T_v \u00b7 ({}, {}, {})", number(p->x), number(p->y), number(p->z)));
  for (int row = 0; row < 3; ++row) {
    const glm::dmat4& m = t.camera.view;
    if (p) {
      t.formula(fmt::format("{} = {} = {}", names[row], row_times_point(m, row, *p), number(out[row])));
      t.hold_against(names[row], out[row], m[0][row] * p->x + m[1][row] * p->y + m[2][row] * p->z + m[3][row]);
    } else {
      t.formula(fmt::format("{} = {}", names[row], number(out[row])));
    }
    t.value(names[row], out[row]);
  }
}

void tell(Telling& t, const Projection& e) {
  const Camera& c = t.camera;
  const VertexStages* w = way(t, e.vertex);
  const bool perspective = c.kind == Camera::Kind::perspective;
  t.say(perspective ? fmt::format("Vertex {} is projected: divided by its distance z_v, so what is far becomes small.", e.vertex)
                    : fmt::format("Vertex {} is projected straight onto the plane: its size does not depend on its distance.", e.vertex));
  if (w && perspective) {
    const glm::dvec3& v = w->view;
    t.formula(fmt::format("x_p = d\u00b7x_v/z_v = {}\u00b7{}/{} = {}", number(c.d), operand(v.x), operand(v.z), number(e.x_p)));
    t.formula(fmt::format("y_p = d\u00b7y_v/z_v = {}\u00b7{}/{} = {}", number(c.d), operand(v.y), operand(v.z), number(e.y_p)));
    t.hold_against("x_p", e.x_p, c.d * v.x / v.z);
    t.hold_against("y_p", e.y_p, c.d * v.y / v.z);
  } else {
    t.formula(fmt::format("x_p = x_v = {}, y_p = y_v = {}", number(e.x_p), number(e.y_p)));
  }
  if (w) tell_depth(t, e, w->view);
  t.value("x_p", e.x_p);
  t.value("y_p", e.y_p);
  t.value(t.z, e.z);
}

void tell(Telling& t, const ViewportTransform& e) {
  const Camera& c = t.camera;
  const Raster& r = t.scene.raster;
  t.say(fmt::format("Vertex {} lands on the raster at column {}, row {}; pixel centres are at whole numbers.", e.vertex,
                    number(e.x_s), number(e.y_s)));
  const VertexStages* w = way(t, e.vertex);
  if (w && c.window > 0 && r.height > 0) {
    const double aspect = static_cast<double>(r.width) / r.height, half = c.window * aspect;
    const double x = (w->plane.x / half + 1) * r.width / 2 - 0.5, y = (1 - w->plane.y / c.window) * r.height / 2 - 0.5;
    t.formula(fmt::format("x_s = (x_p/w_x + 1)\u00b7W/2 \u2212 1/2 = ({}/{} + 1)\u00b7{}/2 \u2212 1/2 = {}", number(w->plane.x),
                          number(half), r.width, number(e.x_s)));
    t.formula(fmt::format("y_s = (1 \u2212 y_p/w_y)\u00b7H/2 \u2212 1/2 = (1 \u2212 {}/{})\u00b7{}/2 \u2212 1/2 = {}", operand(w->plane.y),
                          number(c.window), r.height, number(e.y_s)));
    t.hold_against("x_s", e.x_s, x);
    t.hold_against("y_s", e.y_s, y);
  }
  t.value("x_s", e.x_s);
  t.value("y_s", e.y_s);
}

}  // namespace zstep::words
