// Depth sort's tests against a plane (002, tests 3 and 4, and the split): the plane seen from its edge, so that it is a
// line, and the pieces of the pair on their sides of it. Depths grow upwards.
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include "sim/viewer/draw/canvas.hpp"
#include "sim/viewer/panes/drawing_list.hpp"
#include "sim/viewer/panes/pane.hpp"
#include "sim/viewer/panes/plan_frame.hpp"
#include "sim/viewer/panes/raster_words.hpp"
#include "sim/words/explain.hpp"
#include "sim/words/numbers.hpp"
#include "sim/words/pieces.hpp"
#include "traces/formulas/outlines.hpp"
#include "traces/scene.hpp"

namespace zstep::viewer {
namespace {

/// Whose plane is at work, and which piece is tested against it or cut by it.
struct Tested {
  std::int32_t piece = -1, plane_of = -1;
};
std::optional<Tested> tested_now(const Session& s) {
  const auto made = since_pair(s);
  if (!made || !s.state().machine.pair) return std::nullopt;
  std::optional<Tested> tested;
  for (const RecordedEvent& one : *made) {
    if (const auto* sides = get_if<SideTest>(&one.event)) tested = {sides->piece, sides->plane_of};
    if (const auto* side = get_if<VertexSide>(&one.event)) {
      const PairBegin& pair = *s.state().machine.pair;
      tested = {side->plane_of == pair.piece ? pair.other : pair.piece, side->plane_of};
    }
  }
  return tested;
}

/// A view along the plane, as near as it can be to straight down the picture. Depths are stretched to the picture's
/// width, which leaves planes planes and sides sides.
struct EdgeOn {
  glm::dvec3 right, up;
  double stretch;
  glm::dvec2 flat(const glm::dvec3& p) const {
    const glm::dvec3 q(p.x, p.y, p.z * stretch);
    return {glm::dot(q, right), glm::dot(q, up)};
  }
};
EdgeOn edge_on(const PlaneEquation& plane, const glm::dvec3& low, const glm::dvec3& high) {
  const double depth = high.z - low.z, width = std::max(high.x - low.x, high.y - low.y);
  EdgeOn view;
  view.stretch = depth > 0 && width > 0 ? width / depth : 1;
  const glm::dvec3 normal = glm::normalize(glm::dvec3(plane.plane_a, plane.plane_b, plane.plane_c / view.stretch));
  const auto in_plane = [&](const glm::dvec3& axis) { return axis - glm::dot(axis, normal) * normal; };
  glm::dvec3 along = in_plane({0, 1, 0});
  if (glm::length(along) < 0.2) along = in_plane({1, 0, 0});
  along = glm::normalize(along);
  const glm::dvec3 farther = glm::dvec3(0, 0, 1) - along.z * along;
  view.up = glm::length(farther) > 1e-6 ? glm::normalize(farther) : normal;
  view.right = glm::cross(along, view.up);
  if (view.right.x + view.right.y < 0) view.right = -view.right;
  return view;
}

struct Corner {
  glm::dvec2 at;
  double value;  ///< in the plane's equation, as the step has it
};

struct View {
  Ui& ui;
  const Session& s;
  const Theme& c;
  PlanFrame frame;
  ImDrawList* list;
  WordPlaces words;

  /// No more text on the sides of this outline.
  void keep_lines_free(const std::vector<Corner>& corners) {
    for (std::size_t k = 0; k < corners.size(); ++k)
      words.keep_line_free(frame.place(corners[k].at), frame.place(corners[(k + 1) % corners.size()].at));
  }
};

std::vector<Corner> corners_of(const Session& s, const Piece& piece, const PlaneEquation& plane, const EdgeOn& view) {
  std::vector<Corner> corners;
  for (const std::int32_t vertex : piece.outline)
    if (const auto p = cutting_point(s.scene(), s.state(), vertex))
      corners.push_back({view.flat(*p), formulas::plane_value(plane.plane_a, plane.plane_b, plane.plane_c,
                                                              plane.plane_d, p->x, p->y, p->z)});
  return corners;
}

void draw_piece(View& v, std::int32_t which, const std::vector<Corner>& corners, bool tested) {
  const Piece& piece = v.s.state().machine.pieces[static_cast<std::size_t>(which)];
  const Pixel32 own = opaque(v.s.scene().polygons[static_cast<std::size_t>(piece.polygon)].color);
  for (std::size_t k = 0; k < corners.size(); ++k)
    stroke_line(v.list, v.frame.place(corners[k].at), v.frame.place(corners[(k + 1) % corners.size()].at), to_im(own),
                4 * v.ui.thin);
  const glm::dvec2 outwards = v.frame.middle();
  glm::dvec2 middle(0);
  for (const Corner& corner : corners) middle += corner.at / static_cast<double>(corners.size());
  const float em = v.ui.em;
  for (const Corner& corner : corners) {
    if (!tested) continue;
    const ImVec2 at = v.frame.place(corner.at);
    fill_circle(v.list, at, 0.3f * em, v.c.pane);
    stroke_circle(v.list, at, 0.3f * em, v.c.text, 1.5f * v.ui.thin);
    v.words.taken.take({at.x - 0.3f * em, at.y - 0.3f * em}, {0.6f * em, 0.6f * em});
  }
  std::vector<glm::dvec2> numbered;  // several corners may lie behind each other
  for (const Corner& corner : corners) {
    const auto same = [&](glm::dvec2 p) { return glm::length(p - corner.at) * v.frame.scale < 1; };
    if (!tested || std::any_of(numbered.begin(), numbered.end(), same)) continue;
    numbered.push_back(corner.at);
    const ImVec2 at = v.frame.place(corner.at);
    const float side = corner.at.x < middle.x ? -1.0f : 1.0f;
    const std::string value = number(corner.value);
    const float off = side * (0.7f * em + text_size(v.ui, v.ui.fonts.mono, value).x / 2);
    v.words.put(value, v.c.text, v.ui.fonts.mono,
                {{at.x + off, at.y}, {at.x, at.y - 1.1f * em}, {at.x, at.y + 1.1f * em}, {at.x - off, at.y}});
  }
  const StepInfo* step = v.s.event() ? find_step(v.s.header().page, v.s.event()->step) : nullptr;
  const bool splits = step && (!holds<SideTest>(v.s.event()->event) || step->name == "split");
  numbered.clear();
  for (std::size_t k = 0; k < corners.size() && tested && splits; ++k) {  // where it is cut
    const Corner &a = corners[k], &b = corners[(k + 1) % corners.size()];
    if (!(a.value * b.value < 0)) continue;
    const glm::dvec2 crossing = a.at + a.value / (a.value - b.value) * (b.at - a.at);
    const auto same = [&](glm::dvec2 p) { return glm::length(p - crossing) * v.frame.scale < 1; };
    if (std::any_of(numbered.begin(), numbered.end(), same)) continue;
    numbered.push_back(crossing);
    const ImVec2 zero = v.frame.place(crossing);
    fill_circle(v.list, zero, 0.3f * em, v.c.pane);
    stroke_circle(v.list, zero, 0.3f * em, v.c.now, 2 * v.ui.thin);
    v.words.put("0", v.c.now, v.ui.fonts.mono, {{zero.x + 1.2f * em, zero.y}, {zero.x - 1.2f * em, zero.y}});
  }
  const ImVec2 centre = v.frame.place(middle);
  const float down = middle.y < outwards.y ? 1.0f : -1.0f;
  v.words.put(piece_label(v.s.scene(), v.s.state().machine, which), tested ? v.c.now : v.c.text, v.ui.fonts.bold,
              {{centre.x, centre.y + 1.2f * down * em},
               {centre.x, centre.y - 1.2f * down * em},
               {centre.x + 2 * em, centre.y},
               {centre.x - 2 * em, centre.y}});
}

void draw_section(Ui& ui) {
  const Session& s = ui.session;
  const MethodState& m = s.state().machine;
  const std::optional<Tested> tested = tested_now(s);
  const auto piece_at = [&](std::int32_t which) -> const Piece* {
    return which >= 0 && which < std::ssize(m.pieces) ? &m.pieces[static_cast<std::size_t>(which)] : nullptr;
  };
  const Piece *piece = tested ? piece_at(tested->piece) : nullptr,
              *other = tested ? piece_at(tested->plane_of) : nullptr;
  if (!piece || !other || !other->plane)
    return say_empty(ui, "No plane is at work: tests 3 and 4 and a split have one.");
  const PlaneEquation& plane = *other->plane;
  glm::dvec3 low(std::numeric_limits<double>::infinity()), high(-low);
  for (const Piece* one : {piece, other})
    for (const std::int32_t vertex : one->outline)
      if (const auto p = cutting_point(s.scene(), s.state(), vertex))
        low = glm::min(low, *p), high = glm::max(high, *p);
  const EdgeOn view = edge_on(plane, low, high);
  const std::vector<Corner> tested_corners = corners_of(s, *piece, plane, view),
                            own_corners = corners_of(s, *other, plane, view);
  if (tested_corners.empty() || own_corners.empty()) return say_empty(ui, "The pieces are not on the raster yet.");
  const ImVec2 top = ImGui::GetCursorScreenPos(), room = ImGui::GetContentRegionAvail();
  if (room.x < ui.em * 8 || room.y < ui.em * 6)
    return say_empty(ui, "Too small to draw; drag a border or enlarge the window.");
  View v{ui, s, ui.colors(), {}, ImGui::GetWindowDrawList(), {ui, top, {top.x + room.x, top.y + room.y}}};
  for (const auto* corners : {&tested_corners, &own_corners})
    for (const Corner& corner : *corners) v.frame.take(corner.at);
  v.frame.fit(top, room);
  v.list->PushClipRect(top, {top.x + room.x, top.y + room.y}, true);

  // The plane goes through the corners of its own piece.
  const glm::dvec2 first = own_corners.front().at;
  const auto farthest = std::max_element(own_corners.begin(), own_corners.end(), [&](const Corner& a, const Corner& b) {
    return glm::length(a.at - first) < glm::length(b.at - first);
  });
  const double length = glm::length(farthest->at - first);
  if (length > 0) {
    const glm::dvec2 way = (farthest->at - first) / length;
    // It grows out of its piece.
    const bool begins = s.event() && holds<SideTest>(s.event()->event);
    const double reach = (begins && ui.arrived < 1 ? ui.on_way() : 1) * v.frame.reach();
    const ImVec2 a = v.frame.place(first - way * reach), b = v.frame.place(farthest->at + way * reach);
    stroke_dashed(v.list, a, b, v.c.now, 2.5f * ui.thin);
    draw_piece(v, tested->plane_of, own_corners, false);
    draw_piece(v, tested->piece, tested_corners, true);
    v.keep_lines_free(own_corners), v.keep_lines_free(tested_corners);
    // Its two sides, named along it; depths are greater on the far one.
    glm::dvec2 far(-way.y, way.x);
    if (far.y < 0) far = -far;
    const auto name_side = [&](const std::string& text, double sign) {
      const ImVec2 size = text_size(ui, ui.fonts.text, text);
      const double off = sign * (std::abs(far.x) * size.x / 2 + std::abs(far.y) * size.y / 2 + 0.4 * ui.em);
      std::vector<ImVec2> middles;
      for (const double along : {0.3, -0.3, 0.22, -0.22, 0.14, -0.14, 0.38, -0.38}) {
        const double part = glm::dot(v.frame.middle() - first, way) + along * v.frame.reach();
        middles.push_back(moved_by(v.frame.place(first + way * part), far.x * off, -far.y * off));
      }
      v.words.put(text, v.c.text, ui.fonts.text, middles);
    };
    const std::string whose = piece_label(s.scene(), m, tested->plane_of);
    name_side(fmt::format("far side of {}'s plane", whose), 1);
    name_side("the eye's side", -1);
  }
  const std::string eye = "\u2193 towards the eye";
  const ImVec2 size = text_size(ui, ui.fonts.small, eye);
  v.words.put(eye, v.c.muted, ui.fonts.small, {{top.x + size.x / 2 + 2, top.y + room.y - size.y / 2 - 2}});
  v.list->PopClipRect();
}

std::string note_of_section(Ui& ui) {
  const std::optional<Tested> tested = tested_now(ui.session);
  if (!tested) return "";
  const MethodState& m = ui.session.state().machine;
  return fmt::format("{}'s plane from its edge", piece_label(ui.session.scene(), m, tested->plane_of));
}

bool serves_section(const Header& header) { return records<PairBegin>(header) && records<SideTest>(header); }

}  // namespace

const Pane section_pane{"section", "SECTION", draw_section, note_of_section, serves_section, 0.35f, false};

}  // namespace zstep::viewer
