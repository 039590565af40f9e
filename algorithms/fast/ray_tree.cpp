#include "algorithms/fast/ray_tree.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "algorithms/fast/ray_shapes.hpp"

namespace zstep::ray_casting {

namespace {

constexpr std::size_t most_in_leaf = 4, bins = 16;

struct Box {
  glm::dvec3 low{std::numeric_limits<double>::infinity()}, high{-std::numeric_limits<double>::infinity()};

  void include(const Box& other) { low = glm::min(low, other.low), high = glm::max(high, other.high); }
  double half_area() const {
    const glm::dvec3 size = glm::max(high - low, glm::dvec3(0));
    return size.x * size.y + size.y * size.z + size.z * size.x;
  }
};

// Shapes order[first .. end) and their box.
struct Range {
  std::size_t first, end;
  Box box;

  std::size_t size() const { return end - first; }
};

class Builder {
 public:
  Builder(const std::vector<Shape>& shapes, double scale, Tree& tree)
      : shapes_(shapes), tree_(tree), order_(shapes.size()) {
    std::iota(order_.begin(), order_.end(), 0);
    for (const Shape& shape : shapes) {
      boxes_.push_back({shape.low, shape.high});
      centres_.push_back(0.5 * (shape.low + shape.high));
      for (int axis = 0; axis < 3; ++axis) {
        scale = std::max({scale, std::abs(shape.low[axis]), std::abs(shape.high[axis])});
      }
    }
    pad_ = 2e-6 * scale;
  }

  void build() { make_node(range(0, order_.size())); }

 private:
  Range range(std::size_t first, std::size_t end) const {
    Range result{first, end, {}};
    for (std::size_t i = first; i < end; ++i) result.box.include(boxes_[order_[i]]);
    return result;
  }

  // Where to part a range so that a ray is expected to cost least: the side's area says how probably it is met, its
  // packets what that costs. Sixteen bins an axis.
  std::array<Range, 2> part(const Range& whole) {
    Box centres;
    for (std::size_t i = whole.first; i < whole.end; ++i) centres.include({centres_[order_[i]], centres_[order_[i]]});
    double least = std::numeric_limits<double>::infinity();
    int best_axis = -1;
    std::size_t best_bin = 0;
    const auto bin_of = [&](std::size_t shape, int axis) {
      const double size = centres.high[axis] - centres.low[axis];
      const double place = (centres_[shape][axis] - centres.low[axis]) / size * bins;
      return std::min(bins - 1, static_cast<std::size_t>(place));
    };
    for (int axis = 0; axis < 3; ++axis) {
      if (!(centres.high[axis] > centres.low[axis])) continue;
      std::array<Box, bins> box;
      std::array<std::size_t, bins> count{};
      for (std::size_t i = whole.first; i < whole.end; ++i) {
        const std::size_t bin = bin_of(order_[i], axis);
        box[bin].include(boxes_[order_[i]]), ++count[bin];
      }
      std::array<double, bins> cost{};  // of all bins before this one
      Box before, behind;
      std::size_t shapes = 0;
      for (std::size_t bin = 1; bin < bins; ++bin) {
        before.include(box[bin - 1]), shapes += count[bin - 1];
        cost[bin] = shapes == 0 ? 0 : before.half_area() * packets(shapes);
      }
      shapes = 0;
      for (std::size_t bin = bins - 1; bin > 0; --bin) {
        behind.include(box[bin]), shapes += count[bin];
        if (shapes == 0 || shapes == whole.size()) continue;
        const double sum = cost[bin] + behind.half_area() * packets(shapes);
        if (sum < least) least = sum, best_axis = axis, best_bin = bin;
      }
    }
    const auto begin = order_.begin() + static_cast<std::ptrdiff_t>(whole.first);
    const auto end = order_.begin() + static_cast<std::ptrdiff_t>(whole.end);
    auto middle = begin + (end - begin) / 2;  // all centres in one place
    if (best_axis >= 0) {
      middle = std::partition(begin, end, [&](std::size_t shape) { return bin_of(shape, best_axis) < best_bin; });
    }
    const auto at = static_cast<std::size_t>(middle - order_.begin());
    return {range(whole.first, at), range(at, whole.end)};
  }

  static double packets(std::size_t shapes) { return static_cast<double>((shapes + most_in_leaf - 1) / most_in_leaf); }

  // Parts the largest until there are eight, then goes down into each.
  std::int32_t make_node(const Range& whole) {
    std::vector<Range> parts{whole};
    while (parts.size() < children) {
      std::size_t largest = children;
      for (std::size_t i = 0; i < parts.size(); ++i) {
        if (parts[i].size() <= most_in_leaf) continue;
        if (largest == children || parts[i].box.half_area() > parts[largest].box.half_area()) largest = i;
      }
      if (largest == children) break;
      const auto [one, other] = part(parts[largest]);
      parts[largest] = one;
      parts.push_back(other);
    }

    const auto made = static_cast<std::int32_t>(tree_.nodes.size());
    tree_.nodes.emplace_back();
    constexpr float infinity = std::numeric_limits<float>::infinity();
    for (std::size_t i = 0; i < children; ++i) {
      const bool some = i < parts.size() && parts[i].size() > 0;
      std::int32_t child = 0;
      if (some) child = parts[i].size() <= most_in_leaf ? ~make_packet(parts[i]) : make_node(parts[i]);
      Node& node = tree_.nodes[static_cast<std::size_t>(made)];
      node.child[i] = child;
      for (int axis = 0; axis < 3; ++axis) {
        // Wider by more than single precision loses on the way to t.
        node.low[axis][i] = some ? static_cast<float>(parts[i].box.low[axis] - pad_) : infinity;
        node.high[axis][i] = some ? static_cast<float>(parts[i].box.high[axis] + pad_) : -infinity;
      }
    }
    return made;
  }

  std::int32_t make_packet(const Range& range) {
    Packet packet{};  // n = 0 where there is no triangle: t is not a number, and nothing is hit
    for (std::size_t lane = 0; lane < most_in_leaf; ++lane) {
      packet.facet[lane] = -1;
      if (lane >= range.size()) continue;
      const Shape& shape = shapes_[order_[range.first + lane]];
      for (int axis = 0; axis < 3; ++axis) {
        packet.n[axis][lane] = shape.n[axis], packet.u[axis][lane] = shape.u[axis],
        packet.v[axis][lane] = shape.v[axis];
      }
      packet.n_0[lane] = shape.n_0, packet.u_0[lane] = shape.u_0, packet.v_0[lane] = shape.v_0;
      packet.facet[lane] = shape.facet;
    }
    tree_.packets.push_back(packet);
    return static_cast<std::int32_t>(tree_.packets.size()) - 1;
  }

  const std::vector<Shape>& shapes_;
  Tree& tree_;
  std::vector<std::size_t> order_;
  std::vector<Box> boxes_;
  std::vector<glm::dvec3> centres_;
  double pad_ = 0;
};

}  // namespace

Tree build_tree(const Scene& scene) {
  Tree tree;
  const glm::dvec3 eye = glm::abs(scene.camera.eye);
  Builder(shapes_of(scene), std::max({eye.x, eye.y, eye.z}), tree).build();
  for (const Facet& facet : scene.facets) {
    tree.first_corner.push_back(static_cast<std::int32_t>(tree.corners.size()));
    for (std::int32_t i = 0; i < facet.corner_count; ++i) {
      const std::int32_t corner = scene.corners[static_cast<std::size_t>(facet.first_corner + i)];
      tree.corners.push_back(scene.points[static_cast<std::size_t>(corner)]);
    }
  }
  tree.first_corner.push_back(static_cast<std::int32_t>(tree.corners.size()));
  return tree;
}

}  // namespace zstep::ray_casting
