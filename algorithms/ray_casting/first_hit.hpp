// The facet that a ray meets first.
#pragma once

#include "algorithms/ray_casting/space.hpp"

namespace zstep::ray_casting {

struct Nearest {
  std::int32_t facet = -1;  ///< none
  double t = 0;
  std::int32_t tests = 0;  ///< facets whose planes were met
};

/// What a ray may meet.
struct Meets {
  bool cull = false;            ///< no facet whose back it would see
  std::int32_t not_facet = -1;  ///< not the facet on which it begins
  double here = 0;              ///< t up to which a point counts as the one where it begins: on the same plane
  bool layers = false;  ///< of the facets there, those that come later in the file lie behind; else there are none
};

/// Of equal t the facet that is drawn first is the nearest, in whatever order they are tested: so the result is the
/// same for every kind of boxes.
template <Recorder R>
Nearest first_hit(Space& space, const Ray& ray, Meets meets, R& record);

}  // namespace zstep::ray_casting
