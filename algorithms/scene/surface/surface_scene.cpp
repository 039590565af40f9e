#include "algorithms/scene/surface/surface_scene.hpp"

#include <utility>

#include "algorithms/scene/colors.hpp"
#include "algorithms/scene/files/number.hpp"
#include "algorithms/scene/surface/sample.hpp"

namespace zstep::scene {

SceneFile surface_scene(Surface surface, const std::string& where, SceneFile file, const SceneBuilder::Style& style) {
  Formula formula(surface.formula, where);
  surface.formula = formula.text();
  SceneBuilder builder(std::move(file));
  PolygonSoup samples = sample(surface, formula, where);
  if (style.line > 0) samples.point_lines.assign(samples.points.size(), style.line);
  builder.add(std::move(samples), where, style);
  SceneFile result = builder.finish();
  result.scene.surface = std::move(surface);
  return result;
}

SceneFile formula_scene(const std::string& formula) {
  SceneFile file;
  Camera& camera = file.scene.camera;
  camera.rho = 0;  // from the extent
  camera.theta = -70;
  camera.phi = 60;
  camera.d = 4;
  file.scene.raster = {640, 480, false};
  file.conventions.cull = false;
  Surface surface = default_surface();
  surface.formula = formula;
  SceneFile result = surface_scene(std::move(surface), in_quotes(formula), std::move(file),
                                   {{}, SceneBuilder::Bare::shaded, clay, 0, {}, true});
  result.scene.name = "y = " + result.scene.surface->formula;
  result.scene.source = "a formula";
  return result;
}

}  // namespace zstep::scene
