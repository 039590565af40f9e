// Surfaces whose curves stand on the raster where a test can read them.
#pragma once

#include <string>
#include <vector>

#include "algorithms/floating_horizon/floating_horizon.hpp"
#include "algorithms/scene/load.hpp"
#include "traces/record/recorder.hpp"
#include "traces/scene.hpp"

namespace zstep::test {

/// One curve: the column of its first sample, how many columns lie between samples, the raster's row of each sample.
struct Curve {
  double first = 0, step = 1;
  std::vector<double> rows;
};

/// A surface seen level and in parallel, so that sample k of a curve stands at (first + k step, rows[k]) on a raster of
/// 8 x 8. Curve 0 is the nearest.
inline Scene surface_of(const std::vector<Curve>& curves) {
  Scene scene;
  scene.raster = {8, 8, false};
  Camera& camera = scene.camera;
  camera.kind = Camera::Kind::orthographic;
  camera.polar = false;
  camera.window = 4;
  camera.near = -1;
  camera.far = 100;
  camera.view = glm::dmat4(0);  // x_v = x_w, y_v = z_w, z_v = y_w
  camera.view[0][0] = camera.view[2][1] = camera.view[1][2] = camera.view[3][3] = 1;
  camera.eye = {0, -1, 0};
  for (std::size_t row = 0; row < curves.size(); ++row)
    for (std::size_t k = 0; k < curves[row].rows.size(); ++k)
      scene.points.push_back({curves[row].first + curves[row].step * static_cast<double>(k) - 3.5,
                              static_cast<double>(row), 3.5 - curves[row].rows[k]});
  scene.surface = Surface{"by hand",
                          0,
                          1,
                          0,
                          1,
                          static_cast<std::int32_t>(curves.front().rows.size()),
                          static_cast<std::int32_t>(curves.size())};
  return scene;
}

struct HorizonRun {
  Picture picture;
  CollectRecorder record;
};

inline HorizonRun run_horizon(const Scene& scene, const std::map<std::string, std::string>& options = {}) {
  Conventions conventions;
  conventions.options = options;
  HorizonRun run;
  run.picture = floating_horizon::run(scene, conventions, run.record);
  return run;
}

/// The raster as letters: # ink from above, o ink from below, . none.
inline std::vector<std::string> drawn(const Picture& picture) {
  std::vector<std::string> rows;
  for (std::int32_t y = 0; y < picture.height; ++y) {
    std::string row;
    for (std::int32_t x = 0; x < picture.width; ++x) {
      const std::uint32_t ink = picture.ink[picture.at(x, y)];
      row += ink == no_ink ? '.' : ink == ink_of({0, 0, 0}) ? '#' : 'o';
    }
    rows.push_back(row);
  }
  return rows;
}

/// A formula's scene, looked at.
inline Scene looked_at(const std::string& formula, double theta, double phi, std::int32_t width, std::int32_t height,
                       bool orthographic = false) {
  ViewOptions view;
  view.theta = theta;
  view.phi = phi;
  view.width = width;
  view.height = height;
  if (orthographic) view.orthographic = true;
  SceneFile file = load_scene("y = " + formula);
  if (orthographic) {
    view.window = 5;
    view.rho = 20;
  }
  return look_at_scene(std::move(file.scene), view);
}

}  // namespace zstep::test
