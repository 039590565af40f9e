// Vertices and edges of a scene as a reader picks them: the same at every step, whatever polygon is at work.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "traces/events/vocabulary.hpp"
#include "traces/scene.hpp"

namespace zstep::viewer {

/// Up to so many corners of its polygons, a scene's edges are drawn and can be picked.
inline constexpr std::size_t most_corners_picked = 2000;

/// An edge by its vertices, the smaller number first.
using EdgeEnds = std::pair<std::int32_t, std::int32_t>;

/// Each edge of the scene's polygons once, in order; none of a scene with too many.
std::vector<EdgeEnds> edges_of(const Scene& scene);

/// A vertex or an edge.
struct ScenePart {
  std::optional<std::int32_t> vertex;
  std::optional<EdgeEnds> edge;
  bool operator==(const ScenePart&) const = default;
  bool any() const { return vertex || edge; }
};

/// The polygons that have it, by their numbers.
std::vector<std::int32_t> polygons_with(const Scene& scene, const ScenePart& part);
/// "vertex B", "edge AB", "edge 3–7".
std::string name_of(const Scene& scene, const ScenePart& part);
/// "solids.off:12": where the file has it, an edge's first vertex; empty where it has no line.
std::string place_in_file(const Scene& scene, const ScenePart& part);
/// What it is, in a sentence.
std::string told_of(const Scene& scene, const ScenePart& part);
/// Is the step about it?
bool is_about(const Event& event, const ScenePart& part);

}  // namespace zstep::viewer
