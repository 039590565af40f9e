// docs/writing-a-run.md: the printfs that it shows are those of a Z-buffer that gets all points.
#include <doctest/doctest.h>

#include <regex>
#include <string>

#include "tests/cli/program.hpp"
#include "tests/where.hpp"

using namespace zstep::test;

namespace {

/// A Z-buffer that prints nothing; where a step belongs, it has the step's name between @.
const char* const bare_program = R"(
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
typedef struct { double x, y, z; } point;
typedef struct { int number, end; point a, b; double x, z, dx_dy; } an_edge;
static point points[100];
static double depth[100][100];
static int corners[100];
static void move_to(an_edge* e, int y) {
  e->x = e->a.x + (e->b.x - e->a.x) * (y - e->a.y) / (e->b.y - e->a.y);
  e->z = e->a.z + (e->b.z - e->a.z) * (y - e->a.y) / (e->b.y - e->a.y);
}
static int at_least(double v) { return (int)ceil(v); }
int main(int argc, char** argv) {
  FILE* in = fopen(argv[argc - 1], "r");
  int width, height, count, polygons;
  if (fscanf(in, "%d %d %d", &width, &height, &count) != 3) return 1;
  for (int i = 0; i < count; ++i)
    if (fscanf(in, "%lf %lf %lf", &points[i].x, &points[i].y, &points[i].z) != 3) return 1;
  if (fscanf(in, "%d", &polygons) != 1) return 1;
  @clear@
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) depth[y][x] = INFINITY;
  for (int polygon = 0; polygon < polygons; ++polygon) {
    @polygon@
    an_edge table[100], active[100];
    int firsts[100], edges = 0, actives = 0, top = height, n;
    if (fscanf(in, "%d", &n) != 1) return 1;
    for (int i = 0; i < n; ++i)
      if (fscanf(in, "%d", &corners[i]) != 1) return 1;
    for (int i = 0; i < n; ++i) {
      int upper = corners[i], lower = corners[(i + 1) % n];
      const char* why = "horizontal";
      if (points[upper].y == points[lower].y) {
        @skip_edge@
        continue;
      }
      if (points[upper].y > points[lower].y) { int other = upper; upper = lower; lower = other; }
      int edge = edges, first_row = at_least(points[upper].y), end_row = at_least(points[lower].y);
      if (first_row < 0) first_row = 0;
      if (end_row > height) end_row = height;
      why = "between_rows";
      if (first_row >= end_row) {
        @skip_edge@
        continue;
      }
      an_edge* e = &table[edges];
      e->number = edge; e->end = end_row; e->a = points[upper]; e->b = points[lower];
      move_to(e, first_row);
      double dy = e->b.y - e->a.y, dx_dy = (e->b.x - e->a.x) / dy, dz_dy = (e->b.z - e->a.z) / dy;
      double x_edge = e->x, z_edge = e->z;
      e->dx_dy = dx_dy;
      firsts[edges++] = first_row;
      if (first_row < top) top = first_row;
      @insert_edge@
    }
    for (int y = top; y < height; ++y) {
      int waiting = 0;
      for (int i = 0; i < edges; ++i) waiting += firsts[i] >= y;
      if (!waiting && !actives) break;
      @scan_line@
      for (int i = 0; i < actives; ++i) {
        int edge = active[i].number;
        if (active[i].end != y) continue;
        @retire_edge@
        for (int k = i--; k + 1 < actives; ++k) active[k] = active[k + 1];
        --actives;
      }
      for (int i = 0; i < actives; ++i) {
        move_to(&active[i], y);
        int edge = active[i].number;
        double x_edge = active[i].x, z_edge = active[i].z;
        @step_edge@
      }
      for (int i = 0; i < edges; ++i) {
        if (firsts[i] != y) continue;
        int edge = i, place = 0;
        while (place < actives && (active[place].x < table[i].x ||
                                   (active[place].x == table[i].x && active[place].dx_dy <= table[i].dx_dy))) ++place;
        for (int k = actives++; k > place; --k) active[k] = active[k - 1];
        active[place] = table[i];
        @enter_edge@
      }
      for (int i = 0; i + 1 < actives; i += 2) {
        int left = active[i].number, right = active[i + 1].number;
        double x_left = active[i].x, z_left = active[i].z, x_right = active[i + 1].x, z_right = active[i + 1].z;
        int first = at_least(x_left), last = at_least(x_right) - 1;
        if (first < 0) first = 0;
        if (last > width - 1) last = width - 1;
        double dz_dx = x_right > x_left ? (z_right - z_left) / (x_right - x_left) : 0;
        @span@
        for (int x = first; x <= last; ++x) {
          double z = z_left + (z_right - z_left) * (x - x_left) / (x_right - x_left);
          @interpolate_z@
          int nearer = z < depth[y][x];
          @compare@
          if (!nearer) continue;
          depth[y][x] = z;
          @write_depth@
          @write_pixel@
        }
      }
    }
  }
  return 0;
}
)";

}  // namespace

TEST_CASE("docs/writing-a-run.md: the printfs that it shows get all points") {
  const Folder folder;
  if (shell(folder, "cc --version").code != 0) {
    MESSAGE("not run, as there is no cc");
    return;
  }
  const std::string page = text_of(in_checkout("docs/writing-a-run.md"));
  const std::size_t begin = page.find("```c\n");
  REQUIRE(begin != std::string::npos);
  const std::string block = page.substr(begin + 5, page.find("```\n", begin + 5) - begin - 5);
  std::string program = bare_program;
  const std::regex statement(R"re(printf\("\{\\"step\\":\\"([a-z_]+)\\"[^;]*;)re");
  int count = 0;
  for (std::sregex_iterator one(block.begin(), block.end(), statement), end; one != end; ++one, ++count) {
    const std::string mark = '@' + (*one)[1].str() + '@';
    CAPTURE(mark);
    CHECK(has(program, mark));
    while (has(program, mark)) program.replace(program.find(mark), mark.size(), one->str());
  }
  CHECK(count == 13);
  CHECK_FALSE(has(program, "@"));
  write_text(folder / "zbuffer.c", program);
  const Outcome compiled =
      shell(folder, "cc -std=c99 -Wall -Wextra -Werror -Wno-unused-variable -o zbuffer zbuffer.c -lm");
  CAPTURE(compiled.err);
  REQUIRE(compiled.code == 0);
  REQUIRE(run(folder, "homework new z-buffer hw").code == 0);
  const char* each = "mkdir runs && for s in hw/*/*.txt; do ./zbuffer $s > runs/$(basename $s .txt).jsonl; done";
  REQUIRE(shell(folder, each).code == 0);
  const Outcome graded = run(folder, "grade --homework hw runs");
  CAPTURE(graded.out);
  CHECK(graded.code == 0);
  CHECK(has(graded.out, "65 of 65 points"));
}
