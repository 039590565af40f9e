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
std::int32_t piece_now(const Ui& ui) {
  const Session& s = ui.session;
  const Event* step = step_of_tree(ui);
  if (!step) return -1;
  const Event& e = *step;
  if (holds<EyeSide>(e) || holds<NodeSkip>(e) || holds<NodeMake>(e)) return -1;
  if (const auto* reject = get_if<PolygonReject>(&e))
    return piece_at_node(s.state().machine, node_now(ui), reject->polygon);
  if (const auto* side = get_if<SideTest>(&e)) return side->piece;
  if (const auto* add = get_if<NodeAdd>(&e)) return add->piece;
  if (const auto* candidate = get_if<RootCandidate>(&e)) return candidate->piece;
  if (const auto* made = get_if<PieceMake>(&e)) return made->piece;
  return s.state().machine.piece;
}

/// Towards the front of a piece that is seen from its edge; none of any other.
std::optional<glm::dvec2> front_beside(const View& v, const Piece& piece) {
  const glm::dvec3 front = front_of(v.s, piece);
  if (!(glm::length(front) > 0) || std::abs(glm::dot(glm::normalize(front), v.section.along)) > 1e-6)
    return std::nullopt;
  return glm::normalize(v.section.flat(front));
}

/// Middles for a name beside its piece: on its front's side or, where it is not seen from its edge, on the side of its
/// longest line that is away from the middle of the plan; at its middle, or nearer to an end.
std::vector<ImVec2> label_places(const View& v, const Piece& piece, const std::vector<glm::dvec2>& points,
                                 ImVec2 size) {
  glm::dvec2 low = points[0], high = points[0], way(1, 0);
  double longest = 0;
  for (const glm::dvec2 p : points) {
    low = glm::min(low, p), high = glm::max(high, p);
    if (glm::length(p - points[0]) > longest) longest = glm::length(p - points[0]), way = (p - points[0]) / longest;
  }
  const glm::dvec2 middle = (low + high) / 2.0, outwards = middle - v.frame.middle();
  glm::dvec2 normal(-way.y, way.x);
  if (glm::dot(normal, outwards) < -1e-9) normal = -normal;
  normal = front_beside(v, piece).value_or(normal);
  const double off = std::abs(normal.x) * size.x / 2 + std::abs(normal.y) * size.y / 2 + 5;
  std::vector<ImVec2> places;
  for (const double side : {1.0, -1.0})
    for (const double along : {0.0, 0.2, -0.2, 0.4, -0.4})
      places.push_back(
          moved_by(v.frame.place(middle + along * longest * way), side * normal.x * off, -side * normal.y * off));
  return places;
}

/// A piece's name beside it, where no other stands.
void name_piece(const View& v, std::int32_t number, const std::vector<glm::dvec2>& points, ImU32 color) {
  const std::string name = piece_label(v.s.scene(), v.m, number);
  v.words->put(name, color, v.ui.fonts.bold,
               label_places(v, v.m.pieces[at(number)], points, text_size(v.ui, v.ui.fonts.bold, name)));
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

/// The longer ones first, so that each is seen; one that is seen from its edge lies on its front's side of its line.
void draw_pieces(const View& v) {
  const std::int32_t now = piece_now(v.ui);
  const std::vector<std::int32_t> draw_places = zstep::draw_places(v.m);
  struct Drawn {
    std::int32_t number;
    std::vector<glm::dvec2> points;
    double length;
  };
  std::vector<Drawn> pieces;
  for (std::size_t k = 0; k < v.m.pieces.size() && pieces.size() < most_pieces; ++k) {
    if (v.m.pieces[k].cut) continue;
    Drawn one{index32(k), v.outline(v.m.pieces[k]), 0};
    for (const glm::dvec2 p : one.points) one.length = std::max(one.length, glm::length(p - one.points[0]));
    if (one.points.size() >= 2) pieces.push_back(std::move(one));
  }
  const bool few = pieces.size() <= most_names;
  if (few)
    std::stable_sort(pieces.begin(), pieces.end(),
                     [](const Drawn& a, const Drawn& b) { return a.length > b.length + 1e-9; });
  for (const bool halo : {true, false})
    for (const Drawn& one : pieces) {
      if (halo && one.number != now) continue;
      const Piece& piece = v.m.pieces[at(one.number)];
      const auto polygon = at(piece.polygon);
      const Pixel32 own =
          polygon < v.s.scene().polygons.size() ? opaque(v.s.scene().polygons[polygon].color) : to_pixel(v.c.text);
      const glm::dvec2 off = few ? 2.0 * v.ui.thin * front_beside(v, piece).value_or(glm::dvec2(0)) : glm::dvec2(0);
      const float width = halo ? 9.0f : draw_places[at(one.number)] >= 0 || few ? 4.0f : 1.5f;
      const auto place = [&](std::size_t k) {
        return moved_by(v.frame.place(one.points[k % one.points.size()]), off.x, -off.y);
      };
      for (std::size_t k = 0; k < one.points.size(); ++k)
        stroke_line(v.list, place(k), place(k + 1), halo ? v.c.now : to_im(own), width * v.ui.thin);
    }
  for (const bool lit : {true, false})
    for (const Drawn& one : pieces)
      if (lit == (one.number == now) && (lit || few)) name_piece(v, one.number, one.points, lit ? v.c.now : v.c.text);
}

void draw_planes(const View& v) {
  if (v.m.tree.size() <= most_planes)
    for (std::size_t node = 0; node < v.m.tree.size(); ++node)
      if (const auto ends = reach_of_line(v.m, index32(node), v.section, v.frame))
        stroke_line(v.list, v.frame.place((*ends)[0]), v.frame.place((*ends)[1]), v.c.muted, v.ui.thin);
  const auto ends = v.node >= 0 ? reach_of_line(v.m, v.node, v.section, v.frame) : std::nullopt;
  const auto line = line_of(plane_of_node(v.m, v.node), v.section);
  if (!ends || !line) return;
  ImVec2 a = v.frame.place((*ends)[0]), b = v.frame.place((*ends)[1]);
  const auto* made = v.s.event() ? get_if<PlaneEquation>(&v.s.event()->event) : nullptr;
  if (made && made->piece == v.m.tree[at(v.node)].pieces.front() && v.ui.arrived < 1)  // it grows out of its piece
    if (const std::vector<glm::dvec2> own = v.outline(v.m.pieces[at(made->piece)]); !own.empty()) {
      const ImVec2 from = v.frame.place(own.front());
      const double share = v.ui.on_way();
      a = moved_by(from, share * (a.x - from.x), share * (a.y - from.y));
      b = moved_by(from, share * (b.x - from.x), share * (b.y - from.y));
    }
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
    // Not close to a name, with which they would be read as one.
    const auto free = [&](ImVec2 at) {
      return v.words->taken.free({at.x - v.ui.em / 2, at.y}, {size.x + v.ui.em, size.y});
    };
    if (!free(corner(1)) || !free(corner(-1))) continue;
    for (const double sign : {1.0, -1.0}) {
      const ImVec2 at = corner(sign);
      v.list->AddRectFilled(at, {at.x + size.x, at.y + size.y}, v.c.pane);
      draw_text(v.ui, at, v.ui.fonts.bold, v.c.now, sign > 0 ? "+" : "\u2212");
    }
    return;
  }
}

/// Where an eye stands in the plan; in parallel projection far outside it, and none where the plan is along its view.
std::optional<glm::dvec2> eye_in_plan(const View& v, const Camera& camera) {
  const bool screen = camera.kind == Camera::Kind::screen, far = screen || camera.kind == Camera::Kind::orthographic;
  const glm::dvec2 towards = v.section.flat(screen ? glm::dvec3(0, 0, -1) : camera.eye);
  if (screen && glm::length(towards) < 1e-6) return std::nullopt;
  return far ? v.frame.middle() + towards * v.frame.reach() : towards;
}

struct EyeMark {
  ImVec2 place;
  std::vector<std::string> names;  ///< the first that has room
  bool its_own;
};

/// An eye as a ring, that of the run with a dot in it; where it stands outside, at the border, beside or below its
/// place.
EyeMark draw_an_eye(const View& v, const Camera& camera, glm::dvec2 eye, const std::string& name, bool its_own) {
  ImVec2 place = v.frame.place(eye);
  const float margin = v.ui.em * 0.8f;
  const ImVec2 centre{v.frame.top.x + v.frame.size.x / 2, v.frame.top.y + v.frame.size.y / 2};
  const float wide = v.frame.size.x / 2 - margin, high = v.frame.size.y / 2 - margin;
  const ImVec2 seen{std::clamp(place.x, centre.x - wide, centre.x + wide),
                    std::clamp(place.y, centre.y - high, centre.y + high)};
  std::vector<std::string> names{name};
  if (seen.x != place.x || seen.y != place.y) {
    names = {name + ", further out"};
    if (camera.kind == Camera::Kind::perspective && v.section.from_above())
      names.insert(names.begin(),
                   fmt::format("{} at ({}, {}), further out", name, number(camera.eye.x), number(camera.eye.y)));
  }
  place = seen;
  const ImU32 color = its_own ? v.c.text : v.c.muted;
  fill_circle(v.list, place, margin * 0.7f, v.c.pane);
  stroke_circle(v.list, place, margin * 0.7f, color, 2 * v.ui.thin);
  if (its_own) fill_circle(v.list, place, margin * 0.3f, color);
  v.words->taken.take({place.x - margin, place.y - margin}, {2 * margin, 2 * margin});
  return {place, std::move(names), its_own};
}

std::vector<EyeMark> draw_eyes(const View& v) {
  std::vector<EyeMark> marks;
  const std::vector<const Camera*> others = v.ui.moment().other_eyes();
  if (const auto eye = eye_in_plan(v, v.s.scene().camera))
    marks.push_back(draw_an_eye(v, v.s.scene().camera, *eye, others.empty() ? "eye" : "eye 1", true));
  for (std::size_t k = 0; k < others.size(); ++k)
    if (const auto other = eye_in_plan(v, *others[k]))
      marks.push_back(draw_an_eye(v, *others[k], *other, fmt::format("eye {}", k + 2), false));
  return marks;
}

/// On none of the lines.
void name_eyes(const View& v, const std::vector<EyeMark>& marks) {
  if (v.m.pieces.size() <= most_names)
    for (const Piece& piece : v.m.pieces) {
      const std::vector<glm::dvec2> points = v.outline(piece);
      for (std::size_t k = 0; k < points.size() && !piece.cut; ++k)
        v.words->keep_line_free(v.frame.place(points[k]), v.frame.place(points[(k + 1) % points.size()]));
    }
  for (const EyeMark& mark : marks)
    for (const std::string& name : mark.names)
      if (v.words->around(name, mark.its_own ? v.c.text : v.c.muted, v.ui.fonts.small, mark.place, {1, 0})) break;
}

/// Where a side of a plane is not reached: all that the eye can see, and how near its corners come to the plane.
void draw_what_is_seen(const View& v) {
  const Event* step = step_of_tree(v.ui);
  const auto* skip = step ? get_if<NodeSkip>(step) : nullptr;
  const PlaneEquation* plane = skip ? plane_of_node(v.m, skip->node) : nullptr;
  if (!plane || v.s.scene().camera.kind != Camera::Kind::perspective) return;
  const Room room(v.s.scene(), false);
  const auto near = room.window(room.near()), end = room.window(room.end());
  const auto place = [&](glm::dvec3 p) { return v.frame.place(v.section.flat(p)); };
  for (std::size_t k = 0; k < 4; ++k) {
    stroke_line(v.list, place(near[k]), place(end[k]), v.c.muted, 1.5f * v.ui.thin);
    stroke_line(v.list, place(near[k]), place(near[(k + 1) % 4]), v.c.muted, 1.5f * v.ui.thin);
  }
  for (const glm::dvec3 corner : near) {
    const double value = glm::dot(normal_of(*plane), corner) + plane->plane_d;
    if (std::abs(value - skip->value) > 1e-9) continue;
    const ImVec2 from = place(corner), to = place(corner - value * normal_of(*plane));
    stroke_line(v.list, from, to, v.c.changed, 2.5f * v.ui.thin);
    v.words->around(number(value), v.c.changed, v.ui.fonts.bold, to, {-1, 0.3});
    break;
  }
  v.words->beside("view volume", v.c.muted, v.ui.fonts.small, place(near[0]), place(near[0] + 0.3 * (end[0] - near[0])),
                  {-1, 0});
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
  for (const Camera* other : ui.moment().other_eyes()) v.frame.take(v.section.flat(other->eye));
  if (room.x < ui.em * 3 || room.y < ui.em * 3)
    return say_empty(ui, "Too small to draw; drag a border or enlarge the window.");
  v.frame.fit(top, room);
  v.list->PushClipRect(top, {top.x + room.x, top.y + room.y}, true);
  draw_planes(v);
  const std::vector<EyeMark> eyes = draw_eyes(v);
  draw_pieces(v);
  draw_new_vertex(v);
  name_values(v);
  name_eyes(v, eyes);
  draw_what_is_seen(v);
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
