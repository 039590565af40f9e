// Flat drawings of pieces beside planes that are seen from their edge: where points lie, and dashed lines.
#pragma once

#include <algorithm>
#include <limits>

#include <glm/geometric.hpp>
#include <glm/vec2.hpp>

#include "sim/viewer/draw/canvas.hpp"
#include "sim/viewer/panes/ui.hpp"
#include "sim/words/pieces.hpp"
#include "traces/math/portable_math.hpp"

namespace zstep::viewer {

/// The step that the picture of a tree is about: the one that is asked for, or the last; none where nothing is at work.
inline const Event* step_of_tree(const Ui& ui) {
  const Session& s = ui.session;
  if (ui.still || s.at_rest()) return nullptr;
  if (s.event_in_question()) return &s.event_in_question()->event;
  return s.event() ? &s.event()->event : nullptr;
}
/// The node of a tree at work; −1 where none is, as where the picture is looked at as a whole.
inline std::int32_t node_now(const Ui& ui) {
  const Event* step = step_of_tree(ui);
  return step ? node_at_work(ui.session.state().machine, step) : -1;
}

/// Across a piece, out of its front, in the space in which pieces are cut; as long as its area is large.
inline glm::dvec3 front_of(const Session& s, const Piece& piece) {
  std::vector<glm::dvec3> corners;
  for (const std::int32_t vertex : piece.outline)
    if (const auto p = cutting_point(s.scene(), s.state(), vertex)) corners.push_back(*p);
  glm::dvec3 normal(0);
  for (std::size_t k = 2; k < corners.size(); ++k)
    normal += glm::cross(corners[k - 1] - corners[0], corners[k] - corners[0]);
  return normal;
}

/// From a flat drawing, y upwards, to a part of the window, with a border left free.
struct PlanFrame {
  glm::dvec2 low{std::numeric_limits<double>::infinity()}, high{-std::numeric_limits<double>::infinity()};
  double scale = 1;
  ImVec2 top, size;

  void take(glm::dvec2 p) { low = glm::min(low, p), high = glm::max(high, p); }
  void fit(ImVec2 top_, ImVec2 size_) {
    top = top_, size = size_;
    const glm::dvec2 extent = glm::max(high - low, glm::dvec2(1e-9));
    scale = std::min(size.x * 0.9 / extent.x, size.y * 0.9 / extent.y);
  }
  glm::dvec2 middle() const { return (low + high) / 2.0; }
  ImVec2 place(glm::dvec2 p) const {
    const glm::dvec2 from_middle = (p - middle()) * scale;
    return moved_by({top.x + size.x / 2, top.y + size.y / 2}, from_middle.x, -from_middle.y);
  }
  double reach() const { return glm::length(glm::dvec2(size.x, size.y)) / scale; }
};

inline void stroke_dashed(ImDrawList* list, ImVec2 a, ImVec2 b, ImU32 color, float width) {
  constexpr float dash = 9, period = 14;
  const float length = portable::length(b.x - a.x, b.y - a.y);
  for (float k = 0; k < length; k += period) {
    const float stop = std::min(k + dash, length);
    stroke_line(list, {a.x + (b.x - a.x) * k / length, a.y + (b.y - a.y) * k / length},
                {a.x + (b.x - a.x) * stop / length, a.y + (b.y - a.y) * stop / length}, color, width);
  }
}

}  // namespace zstep::viewer
