#include "algorithms/bsp/build.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <random>

#include "algorithms/pieces/pieces.hpp"
#include "traces/formulas/outlines.hpp"
#include "traces/record/all_recorders.hpp"
#include "traces/scene.hpp"

namespace zstep::bsp {

namespace {

namespace step = bsp_build::step;
using Numbers = std::vector<std::int32_t>;  // of pieces

// A subtree that is still to be built.
struct Open {
  std::int32_t parent = -1;
  bool front = false;
  Numbers pieces;
};

double tolerance_for(const Tree& tree) {
  if (tree.pieces.empty()) return 0;
  glm::dvec3 low(std::numeric_limits<double>::infinity()), high = -low;
  for (const Piece& piece : tree.pieces) {
    for (const std::int32_t vertex : piece.outline) {
      low = glm::min(low, tree.point(vertex));
      high = glm::max(high, tree.point(vertex));
    }
  }
  const glm::dvec3 far = glm::max(glm::abs(low), glm::abs(high));
  return 1e-9 * glm::length(high - low) + 1e-14 * std::fmax(far.x, std::fmax(far.y, far.z));
}

template <Recorder R>
Tree gather(const Scene& scene, std::span<const std::int32_t> facets, R& record) {
  record(step::tables, TablesBegin{size32(scene.polygons)});
  Tree tree;
  tree.points = scene.points;
  for (const std::int32_t number : facets) {
    const Facet& facet = scene.facets[number];
    record(step::polygon, PolygonBegin{facet.polygon, number});

    const auto corners = scene.corners.begin() + facet.first_corner;
    const clipping::Outline outline(corners, corners + facet.corner_count);
    if (clipping::degenerate(scene, outline)) {
      record(step::no_area, PolygonReject{facet.polygon, Reject::degenerate});
      continue;
    }
    std::vector<glm::dvec3> points;
    for (const std::int32_t vertex : outline) {
      record(step::corner, OutlineVertex{vertex});
      points.push_back(tree.point(vertex));
    }
    record(step::make, PieceMake{size32(tree.pieces), facet.polygon, -1});
    const pieces::Plane plane = pieces::plane_of(points);
    tree.pieces.push_back({facet.polygon, number, outline, plane, pieces::bend_of(plane, points)});
  }
  tree.tolerance = tolerance_for(tree);
  return tree;
}

// 001: "Test all the vertices of all the other polygons to determine if they are in front of, behind, or in the same
// plane as T."
template <Recorder R>
Side hold_against(const Tree& tree, std::int32_t piece, std::int32_t root, R& record) {
  const pieces::Plane& plane = tree.piece(root).plane;
  const double near = tree.tolerance + tree.piece(piece).bend;
  double least = std::numeric_limits<double>::infinity(), greatest = -least;
  for (const std::int32_t vertex : tree.piece(piece).outline) {
    const double value = plane.value(tree.point(vertex));
    record(step::vertex_side, VertexSide{vertex, root, value, formulas::side_of(value, value, near)});
    least = std::fmin(least, value);
    greatest = std::fmax(greatest, value);
  }
  const Side side = formulas::side_of(least, greatest, near);
  record(step::side, SideTest{piece, root, least, greatest, side});
  return side;
}

std::int32_t count_splits(const Tree& tree, const Numbers& pieces, std::int32_t root) {
  NullRecorder nothing;
  return static_cast<std::int32_t>(std::count_if(pieces.begin(), pieces.end(), [&](std::int32_t piece) {
    return piece != root && hold_against(tree, piece, root, nothing) == Side::crossing;
  }));
}

// The piece whose plane will divide the others.
template <Recorder R>
std::int32_t choose_root(const Tree& tree, const Numbers& pieces, const BuildOptions& options, std::mt19937_64& random,
                         R& record) {
  if (options.root == Root::random) return pieces[random() % pieces.size()];
  if (options.root == Root::first || pieces.size() == 1) return pieces.front();

  const std::size_t count = std::min(static_cast<std::size_t>(options.candidates), pieces.size());
  std::int32_t best = -1, fewest = std::numeric_limits<std::int32_t>::max();
  for (std::size_t i = 0; i < count && fewest > 0; ++i) {  // nothing is better than none
    const std::int32_t candidate = pieces[i * pieces.size() / count], splits = count_splits(tree, pieces, candidate);
    record(step::candidate, RootCandidate{candidate, splits});
    if (splits < fewest) best = candidate, fewest = splits;
  }
  return best;
}

template <Recorder R>
std::int32_t add_part(Tree& tree, std::int32_t whole, const clipping::Outline& outline, R& record) {
  const auto number = size32(tree.pieces);
  for (const std::int32_t vertex : outline) {
    record(cutting::step::outline, OutlineVertex{vertex});
  }
  Piece part = tree.piece(whole);  // of the same polygon, in the same plane
  part.outline = outline;
  record(cutting::step::part, PieceMake{number, part.polygon, whole});
  tree.pieces.push_back(std::move(part));
  return number;
}

// 001: "If the plane intersects a polygon, divide the polygon at the plane."
template <Recorder R>
void cut(Tree& tree, std::int32_t number, std::int32_t root, Space space, Numbers& front, Numbers& back, R& record) {
  const Piece& whole = tree.piece(number);
  const pieces::Halves halves = pieces::split(
      whole.outline, whole.plane, whole.bend, tree.piece(root).plane, tree.tolerance,
      [&](std::int32_t vertex) { return tree.point(vertex); },
      [&](std::int32_t from, std::int32_t to, double t, glm::dvec3 point) {
        const auto made = size32(tree.points);
        record(cutting::step::cut, SplitVertex{from, to, t, made, space, point.x, point.y, point.z});
        tree.points.push_back(point);
        return made;
      });
  front.push_back(add_part(tree, number, halves.positive, record));
  back.push_back(add_part(tree, number, halves.negative, record));
}

// A node for the root of these pieces; the others go to its two sides.
template <Recorder R>
void divide(Tree& tree, const Open& work, std::int32_t root, Space space, Open& front, Open& back, R& record) {
  const auto number = size32(tree.nodes);
  const pieces::Plane plane = tree.piece(root).plane;
  record(step::node, NodeMake{number, work.parent, work.front, root});
  record(step::plane, PlaneEquation{root, plane.a, plane.b, plane.c, plane.d});
  if (work.parent >= 0) {
    Node& parent = tree.nodes[work.parent];
    (work.front ? parent.front : parent.back) = number;
  }
  Node node{plane, {root}};
  front = {number, true, {}}, back = {number, false, {}};
  for (const std::int32_t piece : work.pieces) {
    if (piece == root) continue;
    switch (hold_against(tree, piece, root, record)) {
      case Side::front:
        front.pieces.push_back(piece);
        break;
      case Side::behind:
        back.pieces.push_back(piece);
        break;
      case Side::on:
        node.pieces.push_back(piece);
        record(step::add, NodeAdd{number, piece});
        break;
      case Side::crossing:
        cut(tree, piece, root, space, front.pieces, back.pieces, record);
    }
  }
  std::sort(node.pieces.begin(), node.pieces.end(),
            [&](std::int32_t one, std::int32_t other) { return tree.piece(one).facet < tree.piece(other).facet; });
  tree.nodes.push_back(std::move(node));
}

// Nodes are numbered from above, so every child stands behind its parent.
void count_nodes(Tree& tree) {
  for (auto node = tree.nodes.rbegin(); node != tree.nodes.rend(); ++node) {
    if (node->front >= 0) node->nodes += tree.node(node->front).nodes;
    if (node->back >= 0) node->nodes += tree.node(node->back).nodes;
  }
}

}  // namespace

template <Recorder R>
Tree build(const Scene& scene, std::span<const std::int32_t> facets, const BuildOptions& how, R& record) {
  const Space space = scene.camera.kind == Camera::Kind::screen ? Space::raster : Space::world;
  std::mt19937_64 random(how.seed);
  Tree tree = gather(scene, facets, record);

  std::vector<Open> stack(1);
  stack[0].pieces.resize(tree.pieces.size());
  std::iota(stack[0].pieces.begin(), stack[0].pieces.end(), 0);
  while (!stack.empty()) {
    const Open work = std::move(stack.back());
    stack.pop_back();
    if (work.pieces.empty()) continue;

    const std::int32_t root = choose_root(tree, work.pieces, how, random, record);
    Open front, back;
    divide(tree, work, root, space, front, back, record);
    stack.push_back(std::move(back));
    stack.push_back(std::move(front));
  }
  count_nodes(tree);
  return tree;
}

template <Recorder R>
Tree build(const Scene& scene, const BuildOptions& how, R& record) {
  std::vector<std::int32_t> facets(scene.facets.size());
  std::iota(facets.begin(), facets.end(), 0);
  return build(scene, facets, how, record);
}

#define INSTANTIATE(R)                                                                          \
  template Tree build<R>(const Scene&, std::span<const std::int32_t>, const BuildOptions&, R&); \
  template Tree build<R>(const Scene&, const BuildOptions&, R&);
ZSTEP_FOR_EACH_RECORDER(INSTANTIATE)
#undef INSTANTIATE

}  // namespace zstep::bsp
