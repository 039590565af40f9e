// One polygon before it reaches the raster: its vertices' way through viewing, projection and viewport (000,
// "Viewing"), facing (000, 001, 003), outcodes and clipping.

#include <algorithm>

#include <glm/geometric.hpp>

#include "sim/words/explain_parts.hpp"
#include "sim/words/rejects.hpp"
#include "traces/file/header.hpp"
#include "traces/formulas/coverage.hpp"
#include "traces/formulas/viewing.hpp"

namespace zstep::words {

// Clearing the buffers; a vertex on its way through viewing, projection and viewport (000, "Viewing"; 003 for z*).

namespace {

const glm::dvec3* world(const Telling& t, std::int32_t vertex) {
  const std::size_t at = vertex;
  return vertex >= 0 && at < t.scene.points.size() ? &t.scene.points[at] : nullptr;
}

/// A row of T_v times a point, in plain numbers; what is 0 but for rounding is 0.
Shown row_times_point(const glm::dmat4& m, int row, const glm::dvec3& p) {
  const auto entry = [&](int column) { return Shown(std::abs(m[column][row]) < 1e-12 ? 0.0 : m[column][row]); };
  return formulas::matrix_row(entry(0), entry(1), entry(2), entry(3), Shown(p.x), Shown(p.y), Shown(p.z));
}

void tell_depth(Telling& t, const Projection& e) {
  if (t.conventions.depth == Conventions::Depth::view) {
    t.formula(fmt::format("z_v stays: {}", number(e.z)), "z");
    t.hold_derived("z_v", "z", e.z);
    return;
  }
  if (!t.follows(t.along, "z", e.z)) return t.formula(fmt::format("{} = {}", t.along, number(e.z)), "z");
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
      t.gives(names[row], names[row], row_times_point(m, row, *p), out[row]);
    } else {
      t.formula(fmt::format("{} = {}", names[row], number(out[row])), names[row]);
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
    t.formula(fmt::format("x_p = x_v = {}, y_p = y_v = {}", number(e.x_p), number(e.y_p)), "x_p");
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
  t.say(fmt::format("Vertex {} lands on the raster at column {}, row {}; pixel {} are at whole numbers.", e.vertex,
                    number(e.x_s), number(e.y_s), t.scene.raster.corners ? "corners" : "centres"));
  t.derive(e);
  t.follows("x_s", "x_s", e.x_s);
  t.follows("y_s", "y_s", e.y_s);
  t.value("x_s", e.x_s);
  t.value("y_s", e.y_s);
}

namespace {

std::string plane_name(ClipPlane plane) { return std::string(word_of(plane)); }

std::string planes_in(std::int32_t bits) {
  std::string text;
  for (const ClipPlane plane : values_of<ClipPlane>) {
    if (!(bits >> index_of(plane) & 1)) continue;
    if (!text.empty()) text += ", ";
    text += plane_name(plane);
  }
  return text;
}

/// "V_1 × V_2": the product of two neighbours of the fan about V_0.
std::string product_of(std::size_t i) { return fmt::format("V_{} \u00d7 V_{}", i, i + 1); }

/// What the sign says; of a polygon that is seen edge-on, that the run takes what is left for 0.
std::string verdict_of(const FacingTest& e, const char* by_sign) {
  return e.facing == Facing::edge_on ? "counts as 0: edge-on" : by_sign;
}

/// The determinant. Of a triangle it is the triple product of its vertices; of more corners the sum of those over the
/// fan about the first, of which any one alone may have the other sign where the outline turns inwards.
void formulas_of_determinant(Telling& t, const FacingTest& e) {
  constexpr std::size_t few = 6;  // corners whose fan is written out
  const bool edge_on = e.facing == Facing::edge_on;
  const std::string verdict = edge_on ? "   0 but for rounding" : "   negative faces away";
  const auto corners = formulas::detail::corners_of(t.at, t.machine.facet);
  t.derive(e);
  const DerivedField* found = t.derived_of("determinant");
  const bool parallel = t.at.camera && t.at.camera->kind == Camera::Kind::orthographic, fan = corners.size() > 3;
  if (!found || corners.size() < 3) {
    t.formula(fmt::format("{} = {}{}", fan ? "sum over the fan" : "determinant", number(e.determinant), verdict),
              "determinant");
    return;
  }
  const auto view = [&](std::size_t i) { return t.at.viewed(corners[i])->view; };
  // The direction in which all eyes look stands for V_0 where the rays are parallel.
  const auto term = [&](std::size_t i) {
    if (!parallel)
      return Shown(fmt::format("V_0\u00b7({})", product_of(i)), glm::dot(view(0), glm::cross(view(i), view(i + 1))));
    const std::string area = fmt::format("((V_{} \u2212 V_0) \u00d7 (V_{} \u2212 V_0))", i, i + 1);
    return Shown("(0, 0, 1)\u00b7" + area, glm::cross(view(i) - view(0), view(i + 1) - view(0)).z);
  };
  const Shown first = term(1);
  if (!fan) {
    const bool so = t.hold_against("determinant", e.determinant, found->formula.rounded());
    t.formula(so ? fmt::format("{} = {}{}", first.symbols(), number(e.determinant), verdict)
                 : Telling::contradicted(first.symbols(), Shown(first.value()), e.determinant),
              "determinant");
    return;
  }
  t.formula(fmt::format("{} = {}   of three vertices alone", first.symbols(), number(first.value())));
  const bool so = t.hold_against("the sum over the fan", e.determinant, found->formula.rounded());
  Shown sum = first;
  for (std::size_t i = 2; i + 1 < corners.size() && corners.size() <= few; ++i) sum = sum + term(i);
  const std::string name = "sum over the fan",
                    added = corners.size() > few ? "" : fmt::format(" = {} = {}", sum.symbols(), sum.numbers());
  if (so) return t.formula(fmt::format("{}{} = {}{}", name, added, number(e.determinant), verdict), "determinant");
  const auto [is, ought] = tell_apart(e.determinant, found->formula.value());
  t.formula(fmt::format("{}{} = {}, but the trace records {}", name, added, ought, is), "determinant");
}

/// The normal whose length counts in (p − e)·n and in the plane: as long as twice the area.
std::string normal_of(std::size_t corners) {
  const auto term = [](std::size_t i) { return fmt::format("(p_{} \u2212 p_0) \u00d7 (p_{} \u2212 p_0)", i, i + 1); };
  if (corners <= 3) return "n = " + term(1);
  const char* between = corners == 4 ? " + " : " + \u2026 + ";
  return fmt::format("n = {}{}{}, the sum over the fan", term(1), between, term(corners - 2));
}

/// The test in its four formulations.
void formulas_of_facing(Telling& t, const FacingTest& e) {
  const bool parallel = t.at.camera && t.at.camera->kind == Camera::Kind::orthographic;
  const std::size_t corners = formulas::detail::corners_of(t.at, t.machine.facet).size();
  if (corners >= 3) t.formula(normal_of(corners));
  const double along = e.view_dot_normal;
  const char* sign = e.facing == Facing::edge_on || along == 0 ? "" : along < 0 ? " < 0" : " > 0";
  t.formula(fmt::format("{}\u00b7n = {}{}   {}", parallel ? "line of sight" : "(p \u2212 e)", number(along), sign,
                        verdict_of(e, "positive faces away")),
            "view_dot_normal");
  t.formula(fmt::format("{} at the eye = {}   {}", plane_in_symbols(world_names, parallel ? "" : "D"),
                        number(e.plane_at_eye), verdict_of(e, "negative faces away")),
            "plane_at_eye");
  formulas_of_determinant(t, e);
  t.formula(fmt::format("n_z after projection = {}   {}", number(e.projected_normal_z),
                        verdict_of(e, t.scene.raster.y_up ? "negative faces away" : "positive faces away")),
            "projected_normal_z");
}

std::string in_binary(std::int32_t bits) { return fmt::format("{:06b}", static_cast<unsigned>(bits) & 63u); }

}  // namespace

void tell(Telling& t, const PolygonBegin& e) {
  std::int32_t pieces = 0, corners = 0;
  for (const Facet& facet : t.scene.facets)
    if (facet.polygon == e.polygon) ++pieces;
  if (e.facet >= 0 && e.facet < std::ssize(t.scene.facets)) corners = t.scene.facets[e.facet].corner_count;
  std::string text = fmt::format("Work on polygon {} begins", t.label(e.polygon));
  if (corners > 0) text += fmt::format(": {} corners", corners);
  if (pieces > 1) text += fmt::format("; it is not planar and comes in {} pieces, this is facet {}", pieces, e.facet);
  t.say(text + ".");
}

void tell(Telling& t, const FacingTest& e) {
  const FacingVotes votes = votes_of(t.scene, t.machine.facet, e);
  if (votes.disagree()) {
    t.contradict(fmt::format("The trace says that polygon {} {}, but its four numbers do not agree.", t.here(),
                             facing_text(e.facing)));
  } else if (votes.speak_against(e.facing)) {
    t.contradict(fmt::format("The trace says that polygon {} {}, but by its four numbers it {}.", t.here(),
                             facing_text(e.facing), facing_text(votes.front ? Facing::front : Facing::back)));
  } else {
    t.say(fmt::format("Polygon {} {}: four ways to ask, one answer.", t.here(), facing_text(e.facing)));
  }
  formulas_of_facing(t, e);
  t.value("(p - e).n", e.view_dot_normal);
  t.value("plane at eye", e.plane_at_eye);
  t.value("determinant", e.determinant);
  t.value("projected n_z", e.projected_normal_z);
}

void tell(Telling& t, const PolygonReject& e) {
  const char *why = "", *as = "";
  switch (e.reason) {
    case Reject::back_facing:
      why = "it faces away, so something in front of it hides it if the object is closed", as = "facing away";
      break;
    case Reject::edge_on:
      why = "it is seen edge-on and covers no area", as = "seen edge-on";
      break;
    case Reject::outside:
      why = "nothing of it lies in the view volume", as = "outside the view volume";
      break;
    case Reject::degenerate:
      why = "it has no area, or coordinates that no raster can hold", as = "having no area";
      break;
  }
  const bool its_own = t.machine.polygon == e.polygon && t.machine.facet >= 0;
  const FacingTest* test = t.machine.facing ? &*t.machine.facing : nullptr;
  const bool checkable = its_own && (test || t.machine.pass == Pass::eye);
  const RejectCheck check = checkable ? check_reject(t.scene, t.machine.facet, e.reason, test) : RejectCheck{};
  if (!check.holds) {
    t.contradict(fmt::format("The trace drops polygon {} as {}, but {}.", t.label(e.polygon), as, check.text));
  } else if (!check.shown) {
    t.say(fmt::format("The trace drops polygon {} as {}; {}.", t.label(e.polygon), as, check.text));
  } else {
    t.say(fmt::format("Polygon {} is dropped: {}.", t.label(e.polygon), why));
  }
}

void tell(Telling& t, const ClipTest& e) {
  if (e.outside_all)
    t.say(fmt::format("All vertices of {} lie outside the {} plane: nothing of it can be seen.", t.here(),
                      planes_in(e.outside_all)));
  else if (e.outside_some)
    t.say(fmt::format("Some vertices of {} lie outside ({}): it must be clipped there.", t.here(),
                      planes_in(e.outside_some)));
  else t.say(fmt::format("All vertices of {} lie inside all six planes: nothing to clip.", t.here()));
  t.formula(fmt::format("OR of the outcodes = {}, AND = {}", in_binary(e.outside_some), in_binary(e.outside_all)));
  t.formula("bits from the right: near, far, left, right, bottom, top");
}

void tell(Telling& t, const ClipVertex& e) {
  t.say(fmt::format("Vertex {} is {} the {} plane: it is {}.", e.vertex, e.inside ? "inside" : "outside",
                    plane_name(e.plane), e.inside ? "kept" : "cut off"));
  if (e.inside != (e.distance >= 0))
    t.contradict(fmt::format("The trace takes vertex {} for {} the {} plane, but the value there says {}.", e.vertex,
                             e.inside ? "inside" : "outside", plane_name(e.plane), e.inside ? "outside" : "inside"));
  t.derive(e);
  const DerivedField* found = t.derived_of("distance");
  const std::string inside = found ? found->formula.equation() : "how far inside";
  t.formula(fmt::format("{} = {} {} 0", inside, number(e.distance), e.distance >= 0 ? "\u2265" : "<"), "distance");
  t.value("distance", e.distance);
}

void tell(Telling& t, const ClipCross& e) {
  t.say(fmt::format("The edge from vertex {} to vertex {} crosses the {} plane: a new vertex {} is made there.",
                    e.vertex_inside, e.vertex_outside, plane_name(e.plane), e.vertex));
  t.derive(e);
  if (!t.follows("t", "t", e.t))
    t.formula(
        fmt::format("t = {} = {}", formulas::where_zero(Shown("d_in", 0), Shown("d_out", 0)).symbols(), number(e.t)),
        "t");
  t.formula(
      fmt::format("{} = ({}, {}, {})", point_on_way("V_in", "V_out"), number(e.x_v), number(e.y_v), number(e.z_v)));
  t.value("t", e.t);
  t.value("x_v", e.x_v);
  t.value("y_v", e.y_v);
  t.value("z_v", e.z_v);
}

void tell(Telling& t, const OutlineVertex& e) {
  const StepInfo* step = find_step(t.trace.header().page, t.trace.event(t.after.position).step);
  if (step && step->module == "cutting")
    t.say(fmt::format("Vertex {} is corner {} of the part.", e.vertex, t.machine.outline.size()));
  else t.say(fmt::format("Vertex {} is corner {} of {} as it is drawn.", e.vertex, t.machine.outline.size(), t.here()));
  if (const auto p = t.at.on_raster(e.vertex)) {
    t.formula(fmt::format("(x_s, y_s) = ({}, {}), {} = {}", number(p->x), number(p->y), t.z, number(p->z)));
    t.value("x_s", p->x);
    t.value("y_s", p->y);
    t.value(t.z, p->z);
  }
}

}  // namespace zstep::words
