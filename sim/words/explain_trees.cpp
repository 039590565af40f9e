// The BSP tree (001, 002, 003): roots, nodes, the eye's side of each plane, subtrees passed over.
#include "sim/words/explain_parts.hpp"

namespace zstep::words {
namespace {

/// What a node is called: its first piece.
std::string node_name(const Telling& t, std::int32_t node) {
  if (node < 0 || static_cast<std::size_t>(node) >= t.machine.tree.size()) return fmt::format("node {}", node);
  const TreeNode& at = t.machine.tree[static_cast<std::size_t>(node)];
  return at.pieces.empty() ? fmt::format("node {}", node) : t.piece(at.pieces[0]);
}

bool front_to_back(const Telling& t) {
  const auto order = t.conventions.options.find("order");
  return order != t.conventions.options.end() && order->second == "front-to-back";
}

}  // namespace

void tell(Telling& t, const RootCandidate& e) {
  t.say(fmt::format("{} is tried as the root: its plane would cut {} of the other pieces{}.", t.piece(e.piece),
                    e.splits == 0 ? std::string("none") : std::to_string(e.splits),
                    e.splits == 0 ? ", and no root can do better" : ""));
  t.formula(fmt::format("splits = {}", e.splits));
}

void tell(Telling& t, const NodeMake& e) {
  if (e.parent < 0)
    t.say(fmt::format("{} becomes the root of the tree: its plane divides all other pieces.", t.piece(e.piece)));
  else
    t.say(fmt::format("{} becomes the {} child of {}: its plane divides what lies {} the plane of {}.",
                      t.piece(e.piece), e.front ? "front" : "back", node_name(t, e.parent),
                      e.front ? "in front of" : "behind", node_name(t, e.parent)));
}

void tell(Telling& t, const NodeAdd& e) {
  t.say(fmt::format("{} lies in the plane of {} and stays at its node: neither can hide the other.", t.piece(e.piece),
                    node_name(t, e.node)));
}

void tell(Telling& t, const EyeSide& e) {
  const char* far = e.front ? "behind" : "in front of";
  const char* near = e.front ? "in front of" : "behind";
  t.say(fmt::format("The eye is {} the plane of {}, so what lies {} it is drawn first.", near, node_name(t, e.node),
                    front_to_back(t) ? near : far));
  if (e.front != (e.value > 0))
    t.contradict(fmt::format("The trace takes the eye for {} the plane of {}, but its value there, {}, says {}.", near,
                             node_name(t, e.node), number(e.value), far));
  t.value("at the eye", e.value);
  const bool direction = t.scene.camera.kind != Camera::Kind::perspective;
  t.derive(e);
  if (!t.follows("the value", "value", e.value)) return;
  if (!direction) return;
  const PointNames at = cutting_names(t);
  t.formula(fmt::format("w = 0: the eye is infinitely far away, in the direction ({}, {}, {})", at.x, at.y, at.z));
}

void tell(Telling& t, const NodeSkip& e) {
  t.say(fmt::format("All that the eye sees lies {} the plane of {}, so what lies {} it is not drawn.",
                    e.front ? "behind" : "in front of", node_name(t, e.node), e.front ? "in front of" : "behind"));
  if (e.front ? e.value >= 0 : e.value <= 0)
    t.contradict(fmt::format(
        "The trace skips what lies {} the plane of {}, but the view volume reaches there: its {} value is {}.",
        e.front ? "in front of" : "behind", node_name(t, e.node), e.front ? "greatest" : "least", number(e.value)));
  t.formula(fmt::format("{} of {} over the view volume's corners = {}{}", e.front ? "greatest" : "least",
                        plane_in_symbols(cutting_names(t)), number(e.value),
                        e.value > 0   ? " > 0"
                        : e.value < 0 ? " < 0"
                                      : ""));
  t.value("nearest corner", e.value);
}

}  // namespace zstep::words
