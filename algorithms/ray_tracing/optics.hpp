// How light goes on where it meets a face.
#pragma once

#include <cmath>
#include <optional>

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

namespace zstep::ray_tracing {

/// The mirrored direction R = D - 2 (D·N) N; N of length 1, on either side.
inline glm::dvec3 mirrored(glm::dvec3 along, glm::dvec3 normal) { return along - 2 * glm::dot(along, normal) * normal; }

/// The direction T behind a face, by Snell's law n_1 sin a_1 = n_2 sin a_2; D and N of length 1. Nothing where light
/// cannot leave: sin a_2 would be greater than 1 (total reflection).
inline std::optional<glm::dvec3> refracted(glm::dvec3 along, glm::dvec3 normal, double n_1, double n_2) {
  if (glm::dot(along, normal) > 0) normal = -normal;  // towards where the light comes from
  const double ratio = n_1 / n_2, cosine = -glm::dot(along, normal);
  const double square = 1 - ratio * ratio * (1 - cosine * cosine);  // of the cosine behind the face
  if (square < 0) return std::nullopt;
  return ratio * along + (ratio * cosine - std::sqrt(square)) * normal;
}

}  // namespace zstep::ray_tracing
