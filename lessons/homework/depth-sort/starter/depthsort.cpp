// Depth sort: of a list of polygons, the farthest first, each is painted once no other one must come before it.
//
// g++ -std=c++17 -o depthsort depthsort.cpp && ./depthsort SCENE.txt > SCENE.jsonl
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
    // TODO: it is a piece: emit_outline(…) for each vertex, and emit_make(…)
    // TODO: its plane and extent: emit_plane(…), emit_extent(…)
  }
  // TODO: put each piece into the list: emit_insert(…)
  // TODO: until the list is empty: hold the first piece P against each other piece Q: emit_pair(…)
  // TODO: the tests, up to the first that says yes: emit_z_extents(…), or emit_test_1(…) to emit_test_5(…)
  // TODO: where none does: emit_test_3_swapped(…), emit_test_4_swapped(…)
  // TODO: if one of these says yes, Q is the new P: emit_take_out(…), emit_move(…), emit_mark(…)
  // TODO: if not, which one is cut? emit_split(…)
  // TODO: the cut: emit_cut(…), and for each part emit_outline(…) for each vertex, and emit_part(…)
  // TODO: the plane and extent of each part: emit_plane(…), emit_extent(…)
  // TODO: the list after it: emit_remove(…), emit_insert_part(…); and its first piece is P
  // TODO: where no Q is in the way: emit_draw(…)
  // TODO: for each pixel of it: emit_paint(…)
  // TODO: it leaves the list: emit_drawn(…)
}
