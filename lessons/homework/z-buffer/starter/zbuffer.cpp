// The Z-buffer with edge table and active edge list.
//
// g++ -std=c++17 -o zbuffer zbuffer.cpp && ./zbuffer SCENE.txt > SCENE.jsonl
//
// What is marked TODO is yours. handout.md says what each step is; emit.h writes it down.
#include <fstream>
#include <limits>
#include <vector>

#include "emit.h"

struct Vertex {
  int number;
  double x, y, z;
};
struct Scene {
  int width = 0, height = 0;
  std::vector<std::vector<Vertex>> polygons;
};

static Scene read_scene(const char* path) {
  std::ifstream in(path);
  Scene scene;
  int points = 0, polygons = 0;
  in >> scene.width >> scene.height >> points;
  std::vector<Vertex> all(points);
  for (int i = 0; i < points; ++i) {
    all[i].number = i;
    in >> all[i].x >> all[i].y >> all[i].z;
  }
  in >> polygons;
  for (int i = 0; i < polygons; ++i) {
    int count = 0, corner = 0;
    scene.polygons.emplace_back();
    for (in >> count; count > 0 && in >> corner; --count) scene.polygons.back().push_back(all.at(corner));
  }
  return scene;
}

int main(int argc, char** argv) {
  if (argc < 2) return 1;
  const Scene scene = read_scene(argv[1]);
  const double farthest = std::numeric_limits<double>::infinity();
  std::vector<double> depth(scene.width * scene.height, farthest);
  emit_clear(farthest);
  for (int polygon = 0; polygon < (int)scene.polygons.size(); ++polygon) {
    emit_polygon(polygon, polygon);
    // TODO: the edge table: emit_insert_edge(…) for each edge of the polygon that meets a scan line
    // TODO: for each other edge: emit_skip_edge(…)
    // TODO: for each scan line: emit_scan_line(y)
    // TODO: its active edges: emit_retire_edge(…), emit_step_edge(…), emit_enter_edge(…)
    // TODO: for each pair of them: emit_span(…), and for each of its pixels emit_interpolate_z(…)
    // TODO: for each pixel: emit_compare(…)
    // TODO: where it is nearer: emit_write_depth(…), emit_write_pixel(…)
  }
}
