// The scan-line method: one edge table for all polygons, and an in/out flag for each polygon.
//
// g++ -std=c++17 -o scanline scanline.cpp && ./scanline SCENE.txt > SCENE.jsonl
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
  emit_clear(std::numeric_limits<double>::infinity());
  emit_tables((int)scene.polygons.size());
  for (int polygon = 0; polygon < (int)scene.polygons.size(); ++polygon) {
    emit_polygon(polygon, polygon);
    emit_make(polygon, polygon, -1);
    // TODO: the polygon's plane: emit_plane(…)
  }
  // TODO: the edge table of all polygons: emit_insert_edge(…) or emit_skip_edge(…) for each edge
  // TODO: for each scan line: emit_scan_line(y)
  // TODO: its active edges: emit_retire_edge(…), emit_step_edge(…), emit_swap_edges(…), emit_enter_edge(…)
  // TODO: for each active edge: emit_flip(…), and up to the next one emit_flags(…)
  // TODO: where several flags are in: emit_depth(…), emit_implied_edge(…)
  // TODO: what is seen: emit_winner(…)
  // TODO: for each of its pixels: emit_paint(…)
}
