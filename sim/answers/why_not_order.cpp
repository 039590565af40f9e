// Why one piece was drawn before another: the plane of the tree that parts them, or their depths in the list.
#include "sim/answers/why_not_parts.hpp"

namespace zstep::answers {
namespace {

std::int32_t node_of(const MethodState& machine, std::int32_t piece) {
  for (std::size_t node = 0; node < machine.tree.size(); ++node)
    for (const std::int32_t held : machine.tree[node].pieces)
      if (held == piece) return static_cast<std::int32_t>(node);
  return -1;
}

/// The node whose subtree holds both, nearest to them; -1 if there is none.
std::int32_t node_over_both(const MethodState& machine, std::int32_t one, std::int32_t other) {
  std::vector<std::int32_t> above;
  for (std::int32_t node = one; node >= 0; node = machine.tree[static_cast<std::size_t>(node)].parent)
    above.push_back(node);
  for (std::int32_t node = other; node >= 0; node = machine.tree[static_cast<std::size_t>(node)].parent)
    for (const std::int32_t known : above)
      if (known == node) return node;
  return -1;
}

void add_tree(Asked& q, const MethodState& machine, Verdict& verdict, std::int32_t piece, std::int32_t later,
              std::int64_t drawn) {
  const std::int32_t mine = node_of(machine, piece), other = node_of(machine, later);
  const std::int32_t node = node_over_both(machine, mine, other);
  if (node < 0) return;
  const TreeNode& parting = machine.tree[static_cast<std::size_t>(node)];
  const std::string wall = piece_label(q.scene, machine, parting.pieces.front());
  if (mine == other) {
    verdict.sentence += keeps_first(q.trace.header())
                            ? " Both lie in one plane of the tree, and there the first in the file is drawn last."
                            : " Both lie in one plane of the tree.";
    return;
  }
  verdict.sentence +=
      other == node ? fmt::format(" In the tree it lies behind {} as the eye sees it, so it was drawn first.", wall)
      : mine == node
          ? fmt::format(" In the tree {} lies in front of its plane as the eye sees it, so it was drawn first.",
                        q.label(verdict.other))
          : fmt::format(
                " In the tree the plane of {} parts the two, and it lies on the side away from the eye, so "
                "it was drawn first.",
                wall);
  if (parting.eye)
    verdict.formulas.push_back(fmt::format("plane of {} at the eye: A x + B y + C z + D w = {}, the eye is {}", wall,
                                           number(parting.eye->value), parting.eye->front ? "in front" : "behind"));
  const auto side = previous_within(q.trace, drawn, last_mark(q.trace), [node](const RecordedEvent& recorded) {
    const auto* eye = get_if<EyeSide>(&recorded.event);
    return eye && eye->node == node;
  });
  if (side) verdict.chain.push_back({*side, no_polygon, fmt::format("the eye is held against the plane of {}", wall)});
}

}  // namespace

void add_order(Asked& q, Verdict& verdict, std::int64_t earlier, std::int64_t later) {
  if (!records<PieceDraw>(q.trace)) return;
  const auto first = previous_of<PieceDraw>(q.trace, earlier), second = previous_of<PieceDraw>(q.trace, later);
  if (!first || !second || *first == *second) return;
  const std::int32_t piece = event_at<PieceDraw>(q.trace, *first)->piece,
                     other = event_at<PieceDraw>(q.trace, *second)->piece;
  const MethodState& machine = q.state_at(*second).machine;
  const auto label = [&](std::int32_t number) { return piece_label(q.scene, machine, number); };
  verdict.chain.push_back({*first, q.polygon, fmt::format("{} is drawn", label(piece))});
  verdict.chain.push_back({*second, verdict.other, fmt::format("{} is drawn", label(other))});
  if (records<EyeSide>(q.trace)) return add_tree(q, machine, verdict, piece, other, *first);
  const Piece &mine = machine.pieces[static_cast<std::size_t>(piece)],
              &its = machine.pieces[static_cast<std::size_t>(other)];
  const std::vector<std::int32_t> places = draw_places(machine);
  if (mine.extent && its.extent)
    verdict.formulas.push_back(fmt::format("farthest {} of {} = {}, of {} = {}; drawn as number {} and {}", q.z,
                                           label(piece), told(mine.extent->z_max), label(other),
                                           told(its.extent->z_max), places[static_cast<std::size_t>(piece)] + 1,
                                           places[static_cast<std::size_t>(other)] + 1));
}

}  // namespace zstep::answers
