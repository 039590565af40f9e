// The scenes on which all exact methods must agree.
#pragma once

#include <string>
#include <vector>

#include "traces/scene.hpp"

namespace zstep::test {

struct AgreementScene {
  std::string name;
  Scene scene;
  bool cull = true;
  bool small = false;  ///< few polygons: every option's values are tried on it, too
  bool open = false;   ///< coplanar polygons or edges along pixel centres: at many pixels more than one answer is right
};

/// Teapot, n-gon meshes, intersecting triangles, cyclic triangles, soups of 1,000 triangles, a mesh with holes, the eye
/// inside a mesh, scenes in screen coordinates, and degenerate polygons; perspective and orthographic, back faces drawn
/// and not, rasters whose sides are no powers of two.
const std::vector<AgreementScene>& agreement_scenes();

/// A soup of `count` triangles with corners within `size` of centres in a box of half a side 1; the same for a seed.
Scene triangle_soup(int count, double size, unsigned seed);
/// Two drums, a star-shaped prism and a dodecahedron: polygons of 4 to 24 corners, concave ones among them.
Scene n_gon_mesh();

}  // namespace zstep::test
