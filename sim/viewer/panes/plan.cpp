// The plane at work cutting the scene, seen along the plane: from above where it is upright. Pieces as lines or
// outlines, the planes of the tree as far as each reaches, the eye.
#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include "sim/viewer/draw/canvas.hpp"
#include "sim/viewer/panes/pane.hpp"
#include "sim/viewer/panes/plan_frame.hpp"
#include "sim/viewer/panes/raster_words.hpp"
#include "sim/words/explain.hpp"
#include "sim/words/numbers.hpp"
#include "sim/words/pieces.hpp"
#include "traces/scene.hpp"

namespace zstep::viewer {
namespace {

constexpr std::size_t most_planes = 64;    // drawn besides the one at work
constexpr std::size_t most_names = 40;     // pieces with their names
constexpr std::size_t most_pieces = 4000;  // drawn at all

std::size_t at(std::int32_t number) { return number; }
glm::dvec3 normal_of(const PlaneEquation& plane) { return {plane.plane_a, plane.plane_b, plane.plane_c}; }

/// A view along a plane: two directions of the world as right and up.
struct Section {
  glm::dvec3 right{1, 0, 0}, up{0, 1, 0}, along{0, 0, -1};
  bool from_above() const { return std::abs(along.z) > 1 - 1e-9; }
  glm::dvec2 flat(glm::dvec3 p) const { return {glm::dot(p, right), glm::dot(p, up)}; }
};

/// Along the plane, as near to straight down as it can be.
Section section_of(const PlaneEquation* plane, Camera::Kind kind) {
  Section section;
  if (plane == nullptr) return section;
  const glm::dvec3 normal = normal_of(*plane);
  glm::dvec3 axis = kind == Camera::Kind::screen ? glm::dvec3(0, 1, 0) : glm::dvec3(0, 0, -1);
  glm::dvec3 along = axis - glm::dot(axis, normal) * normal;
  if (glm::length(along) < 0.2) axis = {0, 1, 0}, along = axis - glm::dot(axis, normal) * normal;
  along = glm::normalize(along);
  section.along = along;
  if (section.from_above()) return section;
  const glm::dvec3 up = std::abs(along.z) < 0.9 ? glm::dvec3(0, 0, 1) : glm::dvec3(0, 1, 0);
  section.right = glm::normalize(glm::cross(along, up));
  section.up = glm::cross(section.right, along);
  return section;
}

/// A plane that is seen from its edge, as a x + b y + c = 0 in the section.
std::optional<glm::dvec3> line_of(const PlaneEquation* plane, const Section& section) {
  if (plane == nullptr) return std::nullopt;
  const glm::dvec3 normal = normal_of(*plane);
  if (std::abs(glm::dot(normal, section.along)) > 1e-6) return std::nullopt;
  const glm::dvec2 flat = section.flat(normal);
  return glm::dvec3(flat, plane->plane_d);
}

/// The part of a node's line that lies in the node's own part of space.
std::optional<std::array<glm::dvec2, 2>> reach_of_line(const MethodState& m, std::int32_t node, const Section& section,
                                                       const PlanFrame& frame) {
  const auto line = line_of(plane_of_node(m, node), section);
  if (!line) return std::nullopt;
  const glm::dvec2 normal(*line), middle = frame.middle();
  const double length = glm::length(normal);
  const glm::dvec2 foot = middle - normal * ((glm::dot(normal, middle) + line->z) / (length * length));
  const glm::dvec2 way = glm::dvec2(-normal.y, normal.x) / length;
  double first = -frame.reach(), last = frame.reach();
  for (std::int32_t child = node; m.tree[at(child)].parent >= 0; child = m.tree[at(child)].parent) {
    const std::int32_t parent = m.tree[at(child)].parent;
    const auto limit = line_of(plane_of_node(m, parent), section);
    if (!limit) continue;
    const double sign = m.tree[at(parent)].front_child == child ? 1 : -1;
    const double value = sign * (glm::dot(glm::dvec2(*limit), foot) + limit->z),
                 slope = sign * glm::dot(glm::dvec2(*limit), way);
    if (slope > 1e-12) first = std::max(first, -value / slope);
    else if (slope < -1e-12) last = std::min(last, -value / slope);
    else if (value < 0) return std::nullopt;
  }
  if (first >= last) return std::nullopt;
  return std::array{foot + first * way, foot + last * way};
}

struct View {
  Ui& ui;
  const Session& s;
  const MethodState& m;
  const Theme& c;
  Section section;
  PlanFrame frame;
  std::int32_t node;
  ImDrawList* list;
  WordPlaces* words;

  std::vector<glm::dvec2> outline(const Piece& piece) const {
    std::vector<glm::dvec2> points;
    for (const std::int32_t vertex : piece.outline)
      if (const auto p = cutting_point(s.scene(), s.state(), vertex)) points.push_back(section.flat(*p));
    return points;
  }
};

/// The piece that the step holds against the plane, or draws; -1 if none.
std::int32_t piece_now(const Session& s) {
  if (!s.event() || s.at_rest()) return -1;
  const Event& e = s.event()->event;
  if (const auto* side = get_if<SideTest>(&e)) return side->piece;
  if (const auto* add = get_if<NodeAdd>(&e)) return add->piece;
  if (const auto* candidate = get_if<RootCandidate>(&e)) return candidate->piece;
  if (const auto* made = get_if<PieceMake>(&e)) return made->piece;
  return s.state().machine.piece;
}

/// The middle of a name beside its piece: on the side of its longest line that is away from the middle of the plan.
ImVec2 label_place(const View& v, const std::vector<glm::dvec2>& points, ImVec2 size) {
  glm::dvec2 low = points[0], high = points[0], way(1, 0);
  double longest = 0;
  for (const glm::dvec2 p : points) {
    low = glm::min(low, p), high = glm::max(high, p);
    if (glm::length(p - points[0]) > longest) longest = glm::length(p - points[0]), way = (p - points[0]) / longest;
  }
  const glm::dvec2 middle = (low + high) / 2.0, outwards = middle - v.frame.middle();
  glm::dvec2 normal(-way.y, way.x);
  if (glm::dot(normal, outwards) < -1e-9) normal = -normal;
  const ImVec2 at_piece = v.frame.place(middle);
  const double off = std::abs(normal.x) * size.x / 2 + std::abs(normal.y) * size.y / 2 + 5;
  return moved_by(at_piece, normal.x * off, -normal.y * off);
}

/// A piece's name beside it, where no other stands.
void name_piece(const View& v, std::int32_t number, const std::vector<glm::dvec2>& points, ImU32 color) {
  const std::string name = piece_label(v.s.scene(), v.m, number);
  v.words->put(name, color, v.ui.fonts.bold, {label_place(v, points, text_size(v.ui, v.ui.fonts.bold, name))});
}

/// The vertex that a cut has just made.
void draw_new_vertex(const View& v) {
  const auto* made = v.s.event() ? get_if<SplitVertex>(&v.s.event()->event) : nullptr;
  const auto point = made ? cutting_point(v.s.scene(), v.s.state(), made->vertex) : std::nullopt;
  if (!point) return;
  const ImVec2 at = v.frame.place(v.section.flat(*point));
  const float radius = std::round(0.3f * v.ui.em);
  fill_circle(v.list, at, radius, v.c.pane);
  stroke_circle(v.list, at, radius, v.c.now, 2 * v.ui.thin);
  v.words->taken.take({at.x - radius, at.y - radius}, {2 * radius, 2 * radius});
  v.words->around(vertex_label(v.s.scene(), made->vertex), v.c.now, v.ui.fonts.bold, at, {1, -1});
}

void draw_pieces(const View& v) {
  const std::int32_t now = piece_now(v.s);
  const std::vector<std::int32_t> draw_places = zstep::draw_places(v.m);
  std::size_t shown = 0;
  for (const Piece& piece : v.m.pieces) shown += piece.cut ? 0 : 1;
  std::int32_t number = -1;
  std::size_t drawn = 0;
  std::vector<std::pair<std::int32_t, std::vector<glm::dvec2>>> others;  // that are named after the one at work
  for (const Piece& piece : v.m.pieces) {
    ++number;
    if (piece.cut || ++drawn > most_pieces) continue;
    const std::vector<glm::dvec2> points = v.outline(piece);
    if (points.size() < 2) continue;
    const bool lit = number == now;
    const auto polygon = at(piece.polygon);
    const Pixel32 own =
        polygon < v.s.scene().polygons.size() ? opaque(v.s.scene().polygons[polygon].color) : to_pixel(v.c.text);
    const bool painted = draw_places[at(number)] >= 0;
    if (lit)
      for (std::size_t k = 0; k < points.size(); ++k)
        stroke_line(v.list, v.frame.place(points[k]), v.frame.place(points[(k + 1) % points.size()]), v.c.now,
                    9 * v.ui.thin);
    for (std::size_t k = 0; k < points.size(); ++k)
      stroke_line(v.list, v.frame.place(points[k]), v.frame.place(points[(k + 1) % points.size()]), to_im(own),
                  (painted || shown < most_names ? 4.0f : 1.5f) * v.ui.thin);
    if (lit) name_piece(v, number, points, v.c.now);
    else if (shown <= most_names) others.emplace_back(number, points);
  }
  for (const auto& [other, points] : others) name_piece(v, other, points, v.c.text);
}

void draw_planes(const View& v) {
  if (v.m.tree.size() <= most_planes)
    for (std::size_t node = 0; node < v.m.tree.size(); ++node)
      if (const auto ends = reach_of_line(v.m, index32(node), v.section, v.frame))
        stroke_line(v.list, v.frame.place((*ends)[0]), v.frame.place((*ends)[1]), v.c.muted, v.ui.thin);
  const auto ends = v.node >= 0 ? reach_of_line(v.m, v.node, v.section, v.frame) : std::nullopt;
  const auto line = line_of(plane_of_node(v.m, v.node), v.section);
  if (!ends || !line) return;
  const ImVec2 a = v.frame.place((*ends)[0]), b = v.frame.place((*ends)[1]);
  stroke_dashed(v.list, a, b, v.c.now, 2.5f * v.ui.thin);
}

/// Which side of a plane that is found is the far one.
void name_far_side(const View& v) {
  const auto line = line_of(plane_of_node(v.m, v.node), v.section);
  const bool speaks = v.s.event() && holds<PlaneEquation>(v.s.event()->event);
  const Camera& camera = v.s.scene().camera;
  if (!line || !speaks || v.s.at_rest() || camera.kind != Camera::Kind::perspective) return;
  const auto ends = reach_of_line(v.m, v.node, v.section, v.frame);
  if (!ends) return;
  const glm::dvec2 normal(*line), way = (*ends)[1] - (*ends)[0];
  const double eye = glm::dot(normal, v.section.flat(camera.eye)) + line->z;
  if (eye == 0 || !(glm::length(way) > 0)) return;
  for (const double sign : {1.0, -1.0}) {
    const std::string name = sign > 0 ? "near side" : "far side";
    const glm::dvec2 out = glm::normalize(normal) * (eye > 0 ? sign : -sign);
    const ImVec2 size = text_size(v.ui, v.ui.fonts.text, name);
    const double off = std::abs(out.x) * size.x / 2 + std::abs(out.y) * size.y / 2 + 0.5 * v.ui.em;
    std::vector<ImVec2> middles;
    const double length = glm::length(way), middle = glm::dot(v.frame.middle() - (*ends)[0], way) / length;
    for (const double along : {-0.3, 0.3, -0.22, 0.22, -0.38, 0.38, 0.14, -0.14}) {
      const double part = std::clamp(middle + along * v.frame.reach(), 0.0, length) / length;
      middles.push_back(moved_by(v.frame.place((*ends)[0] + part * way), out.x * off, -out.y * off));
    }
    v.words->put(name, v.c.now, v.ui.fonts.text, middles);
  }
}

/// + and − beside the first piece of the node at work.
void draw_sides(const View& v) {
  const auto line = line_of(plane_of_node(v.m, v.node), v.section);
  if (!line || v.m.tree[at(v.node)].pieces.empty()) return;
  const auto first = at(v.m.tree[at(v.node)].pieces[0]);
  const std::vector<glm::dvec2> points = v.outline(v.m.pieces[first]);
  if (points.empty()) return;
  glm::dvec2 low = points[0], high = points[0];
  for (const glm::dvec2 p : points) low = glm::min(low, p), high = glm::max(high, p);
  const glm::dvec2 normal = glm::normalize(glm::dvec2(*line));
  const glm::dvec2 way(-normal.y, normal.x);
  const ImVec2 size = text_size(v.ui, v.ui.fonts.bold, "+");
  for (const double along : {0.32, -0.32, 0.48, -0.48, 0.16, -0.16, 0.64, -0.64, 0.8, -0.8}) {
    const glm::dvec2 end = (low + high) / 2.0 + way * (glm::length(high - low) * along);
    const auto corner = [&](double sign) {
      const ImVec2 place = v.frame.place(end + normal * (sign * v.ui.em * 0.8 / v.frame.scale));
      return ImVec2{std::round(place.x - size.x / 2), std::round(place.y - size.y / 2)};
    };
    if (!v.words->taken.free(corner(1), size) || !v.words->taken.free(corner(-1), size)) continue;
    for (const double sign : {1.0, -1.0}) {
      const ImVec2 at = corner(sign);
      v.list->AddRectFilled(at, {at.x + size.x, at.y + size.y}, v.c.pane);
      draw_text(v.ui, at, v.ui.fonts.bold, v.c.now, sign > 0 ? "+" : "\u2212");
    }
    return;
  }
}

/// The eye as a ring and a dot; where it stands outside, at the border, beside or below its place.
void draw_the_eye(const View& v) {
  const Camera& camera = v.s.scene().camera;
  const bool screen = camera.kind == Camera::Kind::screen, far = screen || camera.kind == Camera::Kind::orthographic;
  const glm::dvec2 towards = v.section.flat(screen ? glm::dvec3(0, 0, -1) : camera.eye);
  if (screen && glm::length(towards) < 1e-6) return;
  const glm::dvec2 eye = far ? v.frame.middle() + towards * v.frame.reach() : towards;
  ImVec2 place = v.frame.place(eye);
  const float margin = v.ui.em * 0.8f;
  const ImVec2 centre{v.frame.top.x + v.frame.size.x / 2, v.frame.top.y + v.frame.size.y / 2};
  const float wide = v.frame.size.x / 2 - margin, high = v.frame.size.y / 2 - margin;
  const ImVec2 seen{std::clamp(place.x, centre.x - wide, centre.x + wide),
                    std::clamp(place.y, centre.y - high, centre.y + high)};
  const bool outside = seen.x != place.x || seen.y != place.y;
  place = seen;
  fill_circle(v.list, place, margin * 0.7f, v.c.pane);
  stroke_circle(v.list, place, margin * 0.7f, v.c.text, 2 * v.ui.thin);
  fill_circle(v.list, place, margin * 0.3f, v.c.text);
  const std::string text = outside ? "eye, further out" : "eye";
  v.words->taken.take({place.x - margin, place.y - margin}, {2 * margin, 2 * margin});
  if (v.m.pieces.size() <= most_names)  // on none of the lines
    for (const Piece& piece : v.m.pieces) {
      const std::vector<glm::dvec2> points = v.outline(piece);
      for (std::size_t k = 0; k < points.size() && !piece.cut; ++k)
        v.words->keep_line_free(v.frame.place(points[k]), v.frame.place(points[(k + 1) % points.size()]));
    }
  const bool has_place = outside && !far && v.section.from_above();
  if (!has_place ||
      !v.words->around(fmt::format("eye at ({}, {}), further out", number(camera.eye.x), number(camera.eye.y)),
                       v.c.text, v.ui.fonts.small, place, {1, 0}))
    v.words->around(text, v.c.text, v.ui.fonts.small, place, {1, 0});
}

/// What the plane's equation gives at the vertex that is put into it, or at those of the piece that is held against it.
void name_values(const View& v) {
  if (!v.s.event() || v.s.at_rest()) return;
  const Event& event = v.s.event_in_question() ? v.s.event_in_question()->event : v.s.event()->event;
  const auto tell = [&](std::int32_t vertex, std::int32_t plane_of, bool by_name) {
    const auto point = cutting_point(v.s.scene(), v.s.state(), vertex);
    if (!point || plane_of < 0 || plane_of >= std::ssize(v.m.pieces) || !v.m.pieces[at(plane_of)].plane) return;
    const PlaneEquation& plane = *v.m.pieces[at(plane_of)].plane;
    const std::string value = number(glm::dot(normal_of(plane), *point) + plane.plane_d);
    const ImVec2 dot = v.frame.place(v.section.flat(*point));
    fill_circle(v.list, dot, std::round(0.25f * v.ui.em), v.c.now);
    v.words->around(by_name ? fmt::format("vertex {}: {}", vertex_label(v.s.scene(), vertex), value) : value, v.c.now,
                    v.ui.fonts.bold, dot, {1, 0});
  };
  if (const auto* one = get_if<VertexSide>(&event)) return tell(one->vertex, one->plane_of, true);
  const auto* side = get_if<SideTest>(&event);
  if (!side || side->piece < 0 || side->piece >= std::ssize(v.m.pieces)) return;
  std::vector<glm::dvec2> told;  // upright walls have two vertices at one place
  for (const std::int32_t vertex : v.m.pieces[at(side->piece)].outline) {
    const auto point = cutting_point(v.s.scene(), v.s.state(), vertex);
    const glm::dvec2 flat = point ? v.section.flat(*point) : glm::dvec2(0);
    if (!point || std::find(told.begin(), told.end(), flat) != told.end()) continue;
    told.push_back(flat);
    tell(vertex, side->plane_of, false);
  }
}

void draw_plan(Ui& ui) {
  const Session& s = ui.session;
  const MethodState& m = s.state().machine;
  if (m.pieces.empty()) return say_empty(ui, "Empty: nothing is gathered yet.");
  const std::int32_t node = node_now(ui);
  const ImVec2 top = ImGui::GetCursorScreenPos(), room = ImGui::GetContentRegionAvail();
  WordPlaces words(ui, top, {top.x + room.x, top.y + room.y});
  View v{ui,
         s,
         m,
         ui.colors(),
         section_of(plane_of_node(m, node), s.scene().camera.kind),
         {},
         node,
         ImGui::GetWindowDrawList(),
         &words};
  for (const Piece& piece : m.pieces)
    for (const glm::dvec2 p : v.outline(piece)) v.frame.take(p);
  if (room.x < ui.em * 3 || room.y < ui.em * 3)
    return say_empty(ui, "Too small to draw; drag a border or enlarge the window.");
  v.frame.fit(top, room);
  v.list->PushClipRect(top, {top.x + room.x, top.y + room.y}, true);
  draw_planes(v);
  draw_pieces(v);
  draw_new_vertex(v);
  draw_the_eye(v);
  name_values(v);
  draw_sides(v);
  name_far_side(v);
  v.list->PopClipRect();
}

std::string note_of_plan(Ui& ui) {
  const Session& s = ui.session;
  const MethodState& m = s.state().machine;
  const PlaneEquation* plane = plane_of_node(m, node_now(ui));
  if (s.scene().camera.kind == Camera::Kind::screen) return plane ? "seen along the plane" : "";
  return section_of(plane, s.scene().camera.kind).from_above() ? "from above" : "seen along the plane";
}

bool serves_plan(const Header& header) { return records<NodeMake>(header); }

}  // namespace

const Pane plan_pane{"plan", "PLAN", draw_plan, note_of_plan, serves_plan, 0.35f, false, leads_of_trees};

}  // namespace zstep::viewer
