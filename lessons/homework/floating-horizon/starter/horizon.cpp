// The floating horizon: the curves of a surface y = f(x, z), from the nearest to the farthest.
//
// g++ -std=c++17 -o horizon horizon.cpp && ./horizon SCENE.txt > SCENE.jsonl
//
// What is marked TODO is yours. handout.md says what each step is; emit.h writes it down.
#include <fstream>
#include <limits>
#include <vector>

#include "emit.h"

struct Sample {
  double x, y, z;  // x_w, y_w, z_w
};

struct Scene {
  int width = 0, height = 0;
  std::vector<std::vector<Sample>> rows;
  double view[3][4] = {};  // the three rows of T_v
  double d = 0, window = 0, near = 0, far = 0;
};

static Scene read_scene(const char* path) {
  std::ifstream in(path);
  Scene scene;
  int rows = 0, columns = 0;
  in >> scene.width >> scene.height >> rows >> columns;
  scene.rows.assign(rows, std::vector<Sample>(columns));
  for (auto& row : scene.rows)
    for (Sample& p : row) in >> p.x >> p.y >> p.z;
  for (auto& row : scene.view)
    for (double& t : row) in >> t;
  in >> scene.d >> scene.window >> scene.near >> scene.far;
  return scene;
}

int main(int argc, char** argv) {
  if (argc < 2) return 1;
  const Scene scene = read_scene(argv[1]);
  const double infinity = std::numeric_limits<double>::infinity();
  emit_clear(infinity);
  // TODO: each sample: emit_view_vertex(…), emit_project(…), emit_to_viewport(…)
  std::vector<double> upper(scene.width, infinity), lower(scene.width, -infinity);
  // TODO: the horizons of each column: emit_clear_horizons(…) twice
  // TODO: each curve, from the nearest to the farthest: emit_curve(…)
  // TODO: from sample to sample: emit_segment(…)
  // TODO: at each column in between: emit_test(…)
  // TODO: what is visible since the column before, from or up to where it crosses a horizon: emit_cross(…)
  // TODO: for each pixel that is drawn: emit_draw(…)
  // TODO: where the curve is visible here, the horizons move: emit_move(…)
}
