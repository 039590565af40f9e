// Going through a BSP tree from any eye, without building it again.
//
// 003: "If eye and T2 on the same side of T1 then draw T1 first then T2": what lies on the far side of a plane cannot
// hide what lies in it, and that cannot hide what lies on the near side.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include <glm/vec4.hpp>

#include "algorithms/bsp/steps.hpp"
#include "algorithms/bsp/tree.hpp"
#include "traces/record/recorder.hpp"
#include "traces/scene.hpp"

namespace zstep::bsp {

enum class Order : std::uint8_t { back_to_front, front_to_back };

struct Eye {
  glm::dvec4 at{0};                ///< (x, y, z, w): w = 0 where it is the direction towards the eye
  std::vector<glm::dvec3> volume;  ///< the corners of what it sees, in the world; without them nothing is passed over
};

/// The eye of a camera. On the raster of a screen scene it looks along the z axis from z = -infinity. With `discard` it
/// comes with the corners of the view volume (a screen scene has none).
Eye eye_of(const Camera& camera, const Raster& raster, bool discard);

/// A X + B Y + C Z + D W: its sign tells the eye's side of a plane.
inline double value_at(const pieces::Plane& plane, glm::dvec4 eye) {
  return plane.a * eye.x + plane.b * eye.y + plane.c * eye.z + plane.d * eye.w;
}

/// The least and the greatest value of a plane over the view volume; both 0 where the eye has none.
struct Reach {
  double least = 0, greatest = 0;
};
Reach reach_of(const Eye& eye, const pieces::Plane& plane);

/// Calls visit(node, value) for each node of which anything may be seen, in the order in which their pieces are to be
/// drawn; `value` is the node's plane at the eye. It keeps a stack of its own, so the tree may have any depth.
template <class Visit, Recorder R>
void traverse(const Tree& tree, const Eye& eye, Order order, Visit&& visit, R& record) {
  struct Entry {
    std::int32_t node;
    bool entered;  // the subtree to be drawn before its pieces is drawn
    double value;
  };
  std::vector<Entry> stack;
  const auto push = [&](std::int32_t node) {
    if (node >= 0) stack.push_back({node, false, 0});
  };
  const auto skip = [&](std::int32_t node, bool front, double reach) {
    const std::int32_t child = front ? tree.node(node).front : tree.node(node).back;
    if (child < 0) return;
    record(bsp_traverse::step::skip, NodeSkip{node, front, reach});
    record(bsp_traverse::step::skipped, Saved{Coherence::object, tree.node(child).nodes});
  };

  if (!tree.nodes.empty()) push(0);
  while (!stack.empty()) {
    const auto [number, entered, known] = stack.back();
    stack.pop_back();
    if (entered) {
      visit(number, known);
      continue;
    }
    const Node& node = tree.node(number);
    const double value = value_at(node.plane, eye.at);
    const bool front = value > 0;
    record(bsp_traverse::step::eye_side, EyeSide{number, value, front});

    const Reach reach = reach_of(eye, node.plane);
    const bool all_front = reach.least > 2 * tree.tolerance, all_behind = reach.greatest < -2 * tree.tolerance;
    if (all_front) skip(number, false, reach.least);
    if (all_behind) skip(number, true, reach.greatest);

    // What comes last is pushed first.
    const bool front_last = front == (order == Order::back_to_front);
    const std::int32_t front_child = all_behind ? -1 : node.front, back_child = all_front ? -1 : node.back;
    push(front_last ? front_child : back_child);
    if (!all_front && !all_behind) stack.push_back({number, true, value});
    push(front_last ? back_child : front_child);
  }
}

/// Why a piece is not drawn: its facing, by the value of its node's plane at the eye. That test orders the drawing, and
/// it is the back-face test of 001 as well.
std::optional<Reject> turned_away(const Tree& tree, const Node& node, const Piece& piece, double value, glm::dvec4 eye,
                                  bool cull);

/// Calls visit(piece) for each piece that is to be drawn, in order. Of pieces in one plane the first in the file is to
/// be seen where they overlap: from back to front it comes last.
template <class Visit, Recorder R>
void visit_pieces(const Tree& tree, const Eye& eye, Order order, bool cull, Visit&& visit, R& record) {
  const auto visit_node = [&](std::int32_t number, double value) {
    const Node& node = tree.node(number);
    for (std::size_t i = 0; i < node.pieces.size(); ++i) {
      const std::int32_t piece = node.pieces[order == Order::front_to_back ? i : node.pieces.size() - 1 - i];
      if (const auto why = turned_away(tree, node, tree.piece(piece), value, eye.at, cull)) {
        record(bsp_traverse::step::back_face, PolygonReject{tree.piece(piece).polygon, *why});
      } else {
        visit(piece);
      }
    }
  };
  traverse(tree, eye, order, visit_node, record);
}

}  // namespace zstep::bsp
