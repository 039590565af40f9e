// Ray casting, polygon by polygon for each ray.
//
// g++ -std=c++17 -o raycast raycast.cpp && ./raycast SCENE.txt > SCENE.jsonl
//
// What is marked TODO is yours. handout.md says what each step is; emit.h writes it down.
#include <fstream>
#include <limits>
#include <vector>

#include "emit.h"

struct Triple {
  double x, y, z;
};
static std::istream& operator>>(std::istream& in, Triple& t) { return in >> t.x >> t.y >> t.z; }

struct Scene {
  int width = 0, height = 0;
  std::vector<std::vector<Triple>> polygons;
  Triple background{};
  std::vector<Triple> colors;
  // X_0 and dX of pixel (0, 0), and how each changes by a column and by a row.
  Triple from[3] = {}, along[3] = {};
  double least = 0, most = 0;  // of t
};

static Scene read_scene(const char* path) {
  std::ifstream in(path);
  Scene scene;
  int points = 0, polygons = 0;
  in >> scene.width >> scene.height >> points;
  std::vector<Triple> all(points);
  for (Triple& point : all) in >> point;
  in >> polygons;
  for (int i = 0; i < polygons; ++i) {
    int count = 0, corner = 0;
    scene.polygons.emplace_back();
    for (in >> count; count > 0 && in >> corner; --count) scene.polygons.back().push_back(all.at(corner));
  }
  in >> scene.background;
  scene.colors.resize(polygons);
  for (Triple& color : scene.colors) in >> color;
  for (Triple& triple : scene.from) in >> triple;
  for (Triple& triple : scene.along) in >> triple;
  in >> scene.least >> scene.most;
  return scene;
}

int main(int argc, char** argv) {
  if (argc < 2) return 1;
  const Scene scene = read_scene(argv[1]);
  emit_clear(std::numeric_limits<double>::infinity());
  for (int y = 0; y < scene.height; ++y) {
    for (int x = 0; x < scene.width; ++x) {
      // TODO: the ray through the pixel's centre: emit_ray(…)
      // TODO: for each polygon, where the ray meets its plane: emit_plane(…)
      // TODO: where t is within its limits: emit_hit(…)
      // TODO: the nearest: emit_ray_end(…)
      // TODO: where something was met: emit_paint(…)
    }
  }
}
