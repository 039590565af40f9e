#include "traces/diff/seen.hpp"

#include <algorithm>
#include <map>
#include <utility>

#include "traces/file/visit.hpp"

namespace zstep::diff {

namespace {

using Pixel = std::pair<std::int32_t, std::int32_t>;

/// Takes note of what a run does at some pixels.
class Watching {
 public:
  Watching(const Trace& trace, const std::vector<SeenApart>& groups) {
    for (const SeenApart& group : groups) watched_.try_emplace(Pixel{group.x, group.y});
    trace.visit(0, trace.size(), [&]<class E>(std::int64_t step, std::uint8_t, const E& e) { return see(step, e); });
  }
  DrawnAt of(const SeenApart& group, std::int32_t polygon) const {
    const auto& here = watched_.at(Pixel{group.x, group.y});
    const auto found = here.find(polygon);
    return found == here.end() ? DrawnAt{} : found->second;
  }

 private:
  template <class E>
  bool see(std::int64_t step, const E& e) {
    if constexpr (std::is_same_v<E, PassBegin>) light_ = e.pass == Pass::light;
    if constexpr (std::is_same_v<E, PolygonBegin> || std::is_same_v<E, PieceDraw>) polygon_ = e.polygon;
    if constexpr (std::is_same_v<E, EdgeTableInsert>) owner_[e.edge] = e.polygon;
    if constexpr (std::is_same_v<E, SpanBegin>)
      if (const auto owner = owner_.find(e.left_edge); owner != owner_.end()) polygon_ = owner->second;
    if (light_) return true;
    if constexpr (std::is_same_v<E, BuffersClear>)
      for (auto& [pixel, drawn] : watched_) drawn.clear();
    if constexpr (std::is_same_v<E, DepthCompare>) {
      if (const auto here = watched_.find(Pixel{e.x, e.y}); here != watched_.end())
        here->second[polygon_].found = step, here->second[polygon_].z = e.z;
    } else if constexpr (std::is_same_v<E, PixelWrite> || std::is_same_v<E, PixelPaint>) {
      if (const auto here = watched_.find(Pixel{e.x, e.y}); here != watched_.end()) {
        here->second[e.polygon].step = step;
        if constexpr (std::is_same_v<E, PixelPaint>) here->second[e.polygon].z = e.z;
      }
    }
    return true;
  }

  std::map<Pixel, std::map<std::int32_t, DrawnAt>> watched_;
  std::map<std::int32_t, std::int32_t> owner_;  ///< of edges
  std::int32_t polygon_ = no_polygon;
  bool light_ = false;
};

}  // namespace

std::vector<SeenApart> seen_apart(const Trace& a, const Picture& end_a, const Trace& b, const Picture& end_b) {
  std::map<std::pair<std::int32_t, std::int32_t>, SeenApart> by_pair;
  for (std::int32_t y = 0; y < end_a.height; ++y)
    for (std::int32_t x = 0; x < end_a.width; ++x) {
      const std::int32_t one = end_a.polygon[end_a.at(x, y)], other = end_b.polygon[end_b.at(x, y)];
      if (one == other) continue;
      SeenApart& group = by_pair[{one, other}];
      if (++group.pixels == 1) group.polygon_a = one, group.polygon_b = other, group.x = x, group.y = y;
    }
  std::vector<SeenApart> groups;
  for (const auto& [pair, group] : by_pair) groups.push_back(group);
  std::stable_sort(groups.begin(), groups.end(),
                   [](const SeenApart& one, const SeenApart& other) { return one.pixels > other.pixels; });
  constexpr std::size_t most = 10;
  if (groups.size() > most) groups.resize(most);
  if (groups.empty()) return groups;
  const Watching in_a(a, groups), in_b(b, groups);
  for (SeenApart& group : groups) {
    group.a_in_a = in_a.of(group, group.polygon_a), group.b_in_a = in_a.of(group, group.polygon_b);
    group.a_in_b = in_b.of(group, group.polygon_a), group.b_in_b = in_b.of(group, group.polygon_b);
  }
  return groups;
}

}  // namespace zstep::diff
