// The methods that the law of agreement is about, and their pictures.
#pragma once

#include <doctest/doctest.h>

#include <utility>
#include <vector>

#include "algorithms/catalog/catalog.hpp"

namespace zstep::test {

/// Those that show at each pixel a polygon, and the nearest one.
inline std::vector<const Method*> exact_methods() {
  std::vector<const Method*> exact;
  for (const Method& m : methods()) {
    if (m.exact && m.gives != Gives::lines && m.needs != Needs::surface) exact.push_back(&m);
  }
  return exact;
}

/// With a light, for methods that need one; the others do not see it.
inline Scene lit_for(const Method& method, Scene scene) {
  if (method.needs == Needs::light) scene.light = Light{{3, -2, 5}, {0, 0, 0}, 0.5, 0.1, 30};
  return scene;
}
inline Picture drawn(const Method& method, const Scene& unlit, const Conventions& conventions) {
  const Scene scene = lit_for(method, unlit);
  check_run(method, scene, conventions);
  NullRecorder nothing;
  const Picture picture = method.render(scene, conventions, nothing);
  if (method.render != method.taught) CHECK(picture == method.taught(scene, conventions, nothing));
  return picture;
}

}  // namespace zstep::test
