// The BSP tree: polygons divide space, and what is on the far side of each is drawn before it.
//
// g++ -std=c++17 -o bsp bsp.cpp && ./bsp SCENE.txt > SCENE.jsonl
//
// What is marked TODO is yours. handout.md says what each step is; emit.h writes it down.
#include <fstream>
#include <limits>
#include <vector>

#include "emit.h"

struct Point {
  double x, y, z;
};
struct Scene {
  int width = 0, height = 0;
  std::vector<Point> points;
  std::vector<std::vector<int>> polygons;  // the numbers of their vertices
};

static Scene read_scene(const char* path) {
  std::ifstream in(path);
  Scene scene;
  int points = 0, polygons = 0;
  in >> scene.width >> scene.height >> points;
  scene.points.resize(points);
  for (Point& point : scene.points) in >> point.x >> point.y >> point.z;
  in >> polygons;
  for (int i = 0; i < polygons; ++i) {
    int count = 0, corner = 0;
    scene.polygons.emplace_back();
    for (in >> count; count > 0 && in >> corner; --count) scene.polygons.back().push_back(corner);
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
    // TODO: it is a piece: emit_make(…)
  }
  // TODO: build the tree: emit_node(…) for the first piece of the list
  // TODO: its plane: emit_plane(…)
  // TODO: the sides of the others: emit_vertex_side(…), emit_side(…)
  // TODO: where one lies in the plane: emit_add(…)
  // TODO: where one crosses it: emit_cut(…), emit_part(…)
  // TODO: then the same of those in front, and of those behind
  // TODO: go through the tree: first the far side, then the node, then the near side
  // TODO: which side is the far one? emit_eye_side(…); for each piece of the node: emit_draw(…)
  // TODO: for each pixel of the piece: emit_paint(…)
}
