// How light goes on where it meets a face: the formulas (traces/formulas/light.hpp) on the engine's vectors.
#pragma once

#include <optional>

#include <glm/vec3.hpp>

#include "traces/formulas/light.hpp"

namespace zstep::ray_tracing {

inline glm::dvec3 mirrored(glm::dvec3 along, glm::dvec3 normal) {
  const auto way = formulas::mirrored<double>({along.x, along.y, along.z}, {normal.x, normal.y, normal.z});
  return {way.x, way.y, way.z};
}

inline std::optional<glm::dvec3> refracted(glm::dvec3 along, glm::dvec3 normal, double n_1, double n_2) {
  const auto way = formulas::refracted<double>({along.x, along.y, along.z}, {normal.x, normal.y, normal.z}, n_1, n_2);
  return way ? std::optional(glm::dvec3(way->x, way->y, way->z)) : std::nullopt;
}

}  // namespace zstep::ray_tracing
