// libFuzzer target: meshes. The first byte chooses the reader (o, f, p, s: OBJ, OFF, PLY, STL), the rest is the file.
// What is read goes all the way to a scene that could be drawn, and to its half-edge mesh.
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <string>
#include <string_view>

#include "algorithms/scene/builder.hpp"
#include "algorithms/scene/mesh.hpp"
#include "algorithms/scene/files/read_mesh.hpp"
#include "algorithms/scene/load.hpp"
#include "traces/error.hpp"

using namespace zstep;
using namespace zstep::scene;

namespace {

MeshFormat format_of(std::uint8_t byte) {
  switch (byte) {
    case 'o':
      return MeshFormat::obj;
    case 'f':
      return MeshFormat::off;
    case 'p':
      return MeshFormat::ply;
    case 's':
      return MeshFormat::stl;
    default:
      return static_cast<MeshFormat>(byte % 4);
  }
}

PolygonSoup read(MeshFormat format, std::string_view bytes) {
  if (format != MeshFormat::obj) return read_mesh_bytes(format, bytes, "fuzz");
  // An OBJ may name itself as its own material file.
  return read_obj(bytes, "fuzz", [&](std::string_view name) -> std::optional<MaterialFile> {
    if (name != "m") return std::nullopt;
    return MaterialFile{"m", std::string(bytes)};
  });
}

void check(bool holds) {
  if (!holds) std::abort();
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size < 1) return 0;
  const std::string_view bytes(reinterpret_cast<const char*>(data + 1), size - 1);
  try {
    PolygonSoup soup = read(format_of(data[0]), bytes);
    for (const std::int32_t corner : soup.corners)
      check(corner >= 0 && static_cast<std::size_t>(corner) < soup.points.size());
    check(soup.point_lines.empty() || soup.point_lines.size() == soup.points.size());
    check(soup.colors.empty() || soup.colors.size() == soup.outlines.size());
    check(soup.materials.empty() || soup.materials.size() == soup.outlines.size());
    for (const glm::dvec3& point : soup.points) check(std::isfinite(point.x + point.y + point.z));
    const std::size_t polygons = soup.outlines.size();
    SceneBuilder builder({});
    builder.add(std::move(soup), "fuzz", {{}, SceneBuilder::Bare::shaded, clay, 0});
    const Scene scene = look_at_scene(builder.finish().scene, {});
    check(scene.polygons.size() == polygons);
    check(scene.camera.near < scene.camera.far);
    check(mesh_of(scene).half_edges.n_faces() == scene.facets.size());
  } catch (const InputError&) {
  }
  return 0;
}
