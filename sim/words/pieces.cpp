#include "sim/words/pieces.hpp"

#include <unordered_map>

#include <fmt/format.h>

#include "sim/words/explain.hpp"
#include "traces/scene.hpp"

namespace zstep {

const PlaneEquation* plane_of_node(const MethodState& machine, std::int32_t node) {
  if (node < 0 || node >= std::ssize(machine.tree)) return nullptr;
  const TreeNode& at = machine.tree[node];
  if (at.pieces.empty() || at.pieces[0] < 0 || static_cast<std::size_t>(at.pieces[0]) >= machine.pieces.size())
    return nullptr;
  const auto& plane = machine.pieces[at.pieces[0]].plane;
  return plane ? &*plane : nullptr;
}

std::int32_t node_of_piece(const MethodState& machine, std::int32_t piece) {
  for (std::size_t node = 0; node < machine.tree.size(); ++node)
    for (const std::int32_t one : machine.tree[node].pieces)
      if (one == piece) return index32(node);
  return -1;
}

std::int32_t piece_at_node(const MethodState& machine, std::int32_t node, std::int32_t polygon) {
  if (node >= 0 && node < std::ssize(machine.tree))
    for (const std::int32_t piece : machine.tree[node].pieces)
      if (piece >= 0 && piece < std::ssize(machine.pieces) && machine.pieces[piece].polygon == polygon) return piece;
  return -1;
}

std::int32_t node_at_work(const MethodState& machine, const Event* event) {
  if (event) {
    if (const auto* skip = get_if<NodeSkip>(event)) return skip->node;
    if (const auto* eye = get_if<EyeSide>(event)) return eye->node;
    if (const auto* made = get_if<NodeMake>(event)) return made->node < std::ssize(machine.tree) ? made->node : -1;
    if (holds<BuffersClear>(*event) || holds<ViewTransform>(*event) || holds<Projection>(*event) ||
        holds<ViewportTransform>(*event))
      return -1;
    // A piece that is not drawn: what is beyond its node has been gone through, and nothing on this side.
    if (const auto* reject = get_if<PolygonReject>(event))
      for (std::int32_t node = machine.node; node >= 0; node = machine.tree[node].parent)
        if (piece_at_node(machine, node, reject->polygon) >= 0) return node;
  }
  if (machine.piece >= 0) {
    const std::int32_t node = node_of_piece(machine, machine.piece);
    if (node >= 0) return node;
  }
  return machine.node;
}

namespace {

/// A part was cut from a piece, or is one of several facets: those stand side by side as they are gathered.
bool is_part(const decltype(MethodState::pieces)& pieces, std::size_t at) {
  const auto whole_of_same = [&](std::size_t other) {
    return other < pieces.size() && pieces[other].polygon == pieces[at].polygon && pieces[other].parent < 0;
  };
  return pieces[at].parent >= 0 || whole_of_same(at + 1) || (at > 0 && whole_of_same(at - 1));
}

std::string part_label(const std::string& whole, int number) {
  const bool digit = whole.back() >= '0' && whole.back() <= '9';
  return fmt::format("{}{}{}", whole, digit ? "." : "", number);
}

}  // namespace

std::string piece_label(const Scene& scene, const MethodState& machine, std::int32_t piece) {
  const auto& pieces = machine.pieces;
  const std::size_t at = piece;
  if (piece < 0 || at >= pieces.size()) return fmt::format("piece {}", piece);
  const std::string whole = polygon_label(scene, pieces[at].polygon);
  if (!is_part(pieces, at)) return whole;
  int number = 1;
  for (std::size_t before = 0; before < at; ++before)
    number += pieces[before].polygon == pieces[at].polygon && is_part(pieces, before);
  return part_label(whole, number);
}

std::vector<std::string> piece_labels(const Scene& scene, const MethodState& machine) {
  std::vector<std::string> labels(machine.pieces.size());
  std::unordered_map<std::int32_t, int> parts;  // so far, by polygon
  for (std::size_t at = 0; at < labels.size(); ++at) {
    const std::int32_t polygon = machine.pieces[at].polygon;
    labels[at] = polygon_label(scene, polygon);
    if (is_part(machine.pieces, at)) labels[at] = part_label(labels[at], ++parts[polygon]);
  }
  return labels;
}

}  // namespace zstep
