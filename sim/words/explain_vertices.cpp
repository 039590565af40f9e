// Clearing the buffers; a vertex on its way through viewing, projection and viewport (000, "Viewing"; 003 for z*).
#include "sim/words/explain_parts.hpp"
#include "traces/file/records.hpp"
#include "traces/formulas/coverage.hpp"
#include "traces/formulas/viewing.hpp"

namespace zstep::words {
namespace {

const glm::dvec3* world(const Telling& t, std::int32_t vertex) {
  const auto at = static_cast<std::size_t>(vertex);
  return vertex >= 0 && at < t.scene.points.size() ? &t.scene.points[at] : nullptr;
}

/// A row of T_v times a point, in plain numbers; what is 0 but for rounding is 0.
Shown row_times_point(const glm::dmat4& m, int row, const glm::dvec3& p) {
  const auto entry = [&](int column) { return Shown(std::abs(m[column][row]) < 1e-12 ? 0.0 : m[column][row]); };
  return formulas::matrix_row(entry(0), entry(1), entry(2), entry(3), Shown(p.x), Shown(p.y), Shown(p.z));
}

void tell_depth(Telling& t, const Projection& e) {
  if (t.conventions.depth == Conventions::Depth::view) {
    t.formula(fmt::format("z_v stays: {}", number(e.z)));
    t.hold_derived("z_v", "z", e.z);
    return;
  }
  if (!t.follows(t.along, "z", e.z)) return t.formula(fmt::format("{} = {}", t.along, number(e.z)));
  if (t.conventions.depth != Conventions::Depth::pseudodepth || t.at.camera->kind == Camera::Kind::orthographic) return;
  const Shown f("f", t.at.camera->near), F("F", t.at.camera->far);
  const Shown a = formulas::pseudodepth_a(f, F), b = formulas::pseudodepth_b(f, F);
  t.formula(fmt::format("a = {} = {}, b = {} = {}; near f = {}, far F = {}", a.symbols(), number(a.value()),
                        b.symbols(), number(b.value()), f.numbers(), F.numbers()));
}

}  // namespace

void tell(Telling& t, const BuffersClear& e) {
  const Raster& r = t.scene.raster;
  const std::string pixels =
      fmt::format("{} \u00d7 {} = {} pixels", r.width, r.height, grouped(std::int64_t{r.width} * r.height));
  const DepthBuffer buffer = depth_buffer(t.trace.header());
  if (buffer != DepthBuffer::picture) {  // the line of a line buffer is cleared for each scan line anew
    t.say("Every pixel becomes background.");
    return t.formula("frame[x,y] = background at " + pixels);
  }
  t.say(e.z == t.trace.header().comparison.farthest()
            ? fmt::format(
                  "Every pixel becomes background and every depth becomes {}, so whatever comes first will be nearer.",
                  number(e.z))
            : fmt::format("Every pixel becomes background and every depth becomes {}.", number(e.z)));
  t.formula(fmt::format("zbuffer[x,y] = {} at {}", number(e.z), pixels));
}

void tell(Telling& t, const ViewTransform& e) {
  t.say(fmt::format(
      "Vertex {} goes from world to view coordinates: seen from the {}, x_v is to the right, y_v up, z_v away.",
      e.vertex, t.machine.pass == Pass::light ? "light" : "eye"));
  const double out[3] = {e.x_v, e.y_v, e.z_v};
  const char* names[3] = {"x_v", "y_v", "z_v"};
  const glm::dvec3* p = world(t, e.vertex);
  if (p) t.formula(fmt::format("T_v \u00b7 ({}, {}, {})", number(p->x), number(p->y), number(p->z)));
  for (int row = 0; row < 3; ++row) {
    const glm::dmat4& m = t.at.camera->view;
    if (p) {
      t.gives(names[row], row_times_point(m, row, *p), out[row]);
    } else {
      t.formula(fmt::format("{} = {}", names[row], number(out[row])));
    }
    t.value(names[row], out[row]);
  }
}

void tell(Telling& t, const Projection& e) {
  const bool perspective = t.at.camera->kind == Camera::Kind::perspective;
  t.say(perspective
            ? fmt::format("Vertex {} is projected: x_v and y_v are divided by its view depth z_v, so what lies deep "
                          "becomes small.",
                          e.vertex)
            : fmt::format(
                  "Vertex {} is projected straight onto the plane: its size does not depend on its view depth z_v.",
                  e.vertex));
  t.derive(e);
  if (!perspective) {
    t.formula(fmt::format("x_p = x_v = {}, y_p = y_v = {}", number(e.x_p), number(e.y_p)));
  } else {
    t.follows("x_p", "x_p", e.x_p);
    t.follows("y_p", "y_p", e.y_p);
  }
  tell_depth(t, e);
  t.value("x_p", e.x_p);
  t.value("y_p", e.y_p);
  t.value(t.along, e.z);
}

void tell(Telling& t, const ViewportTransform& e) {
  t.say(fmt::format("Vertex {} lands on the raster at column {}, row {}; pixel centres are at whole numbers.", e.vertex,
                    number(e.x_s), number(e.y_s)));
  t.derive(e);
  t.follows("x_s", "x_s", e.x_s);
  t.follows("y_s", "y_s", e.y_s);
  t.value("x_s", e.x_s);
  t.value("y_s", e.y_s);
}

}  // namespace zstep::words
