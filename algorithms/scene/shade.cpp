// What a shade needs of a scene and its file may lack: colours without light, and normals.
#include <cmath>
#include <span>

#include <glm/vec3.hpp>

#include "algorithms/scene/builder.hpp"
#include "algorithms/scene/load.hpp"
#include "traces/formulas/shading.hpp"

namespace zstep {

namespace {

/// By vertex: the sum of the normals of the facets round it, each as long as twice its area. H. Gouraud, 1971, takes
/// their mean.
std::vector<glm::dvec3> normals_of(const Scene& scene) {
  std::vector<glm::dvec3> normals(scene.points.size(), glm::dvec3(0));
  for (const Facet& facet : scene.facets) {
    const std::span corners(scene.corners.data() + facet.first_corner, static_cast<std::size_t>(facet.corner_count));
    glm::dvec3 normal = scene::newell_normal(scene.points, corners);
    if (scene.camera.kind == Camera::Kind::screen && normal.z > 0) normal = -normal;  // textbooks go either way round
    for (const std::int32_t corner : corners) normals[static_cast<std::size_t>(corner)] += normal;
  }
  return normals;
}

/// The attribute "normal", with a value for each vertex that has none.
void complete_normals(Scene& scene) {
  const auto named = [&] { return attribute_named(scene, normal_attribute); };
  if (named() == nullptr) {
    if (std::ssize(scene.attributes) == most_attributes) scene.attributes.pop_back();
    scene.attributes.push_back({normal_attribute, 3, {}, {}, {}, {}});
  }
  VertexAttribute& attribute = scene.attributes[static_cast<std::size_t>(named() - scene.attributes.data())];
  if (attribute.components != 3) return;
  attribute.of_point.resize(scene.points.size(), no_value);
  const std::vector<glm::dvec3> normals = normals_of(scene);
  const bool has_lines = !attribute.lines.empty();
  for (std::size_t point = 0; point < normals.size(); ++point) {
    if (attribute.of_point[point] != no_value) continue;
    attribute.of_point[point] = static_cast<std::int32_t>(std::ssize(attribute.values) / 3);
    const glm::dvec3 unit = formulas::unit(normals[point]);
    attribute.values.insert(attribute.values.end(), {unit.x, unit.y, unit.z});
    if (has_lines) attribute.lines.push_back(0);
  }
}

}  // namespace

void give_normals(Scene& scene, const Conventions& conventions) {
  if (formulas::is_of_light(formulas::shading_of(scene, conventions).shade)) complete_normals(scene);
}

void prepare_for_shade(SceneFile& file, const Conventions& conventions) {
  if (!formulas::is_of_light(formulas::shading_of(file.scene, conventions).shade)) return;
  for (std::size_t k = 0; k < file.unlit_colors.size() && k < file.scene.polygons.size(); ++k)
    file.scene.polygons[k].color = file.unlit_colors[k];
  complete_normals(file.scene);
}

}  // namespace zstep
