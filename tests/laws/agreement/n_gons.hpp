// Random meshes of the n-gons that real files are full of and that textbooks leave out: bent, bent so little that they
// count as planar, concave, thin, through each other, almost in one plane, sharing edges.
#pragma once

#include <string>
#include <vector>

#include "traces/scene.hpp"

namespace zstep::test {

/// A way of making polygons that are hard to put into an order.
struct NGonKind {
  std::string name;
  Scene (*make)(std::uint64_t seed);        ///< as the loader makes it: what is not planar is cut into triangles
  std::string (*file)(std::uint64_t seed);  ///< the same mesh in the OFF format, each number with all its digits
};
const std::vector<NGonKind>& n_gon_kinds();

/// Two views of a mesh, one in perspective and one in parallel projection.
std::vector<Scene> two_views(const Scene& mesh, std::uint64_t seed);

}  // namespace zstep::test
