// Warnock's algorithm: an area that is simple is drawn; any other is divided into its four quarters.
//
// g++ -std=c++17 -o warnock warnock.cpp && ./warnock SCENE.txt > SCENE.jsonl
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
  std::vector<std::vector<Point>> polygons;
};
struct Area {
  int left, top, right, bottom;  // without the column right and the row bottom
};

static Scene read_scene(const char* path) {
  std::ifstream in(path);
  Scene scene;
  int points = 0, polygons = 0;
  in >> scene.width >> scene.height >> points;
  std::vector<Point> all(points);
  for (Point& point : all) in >> point.x >> point.y >> point.z;
  in >> polygons;
  for (int i = 0; i < polygons; ++i) {
    int count = 0, corner = 0;
    scene.polygons.emplace_back();
    for (in >> count; count > 0 && in >> corner; --count) scene.polygons.back().push_back(all.at(corner));
  }
  return scene;
}

static void settle(const Scene&, const Area&) {
  // TODO: emit_area(…)
  // TODO: for each polygon that may be in the area: emit_disjoint(…), emit_contained(…) and so on
  // TODO: the depths by which it is decided: emit_corner_depth(…), emit_center_depth(…)
  // TODO: which case is it? emit_background(…), emit_one_polygon(…), emit_surrounded(…), emit_pixel(…),
  //       emit_front_surrounder(…) or emit_subdivide(…)
  // TODO: for each pixel that is drawn: emit_paint(…)
  // TODO: where the area is divided: settle(…) for each quarter
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
  settle(scene, {0, 0, scene.width, scene.height});
}
