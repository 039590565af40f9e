#include "tests/laws/agreement/scenes.hpp"

#include <cmath>
#include <utility>

#include "algorithms/scene/load.hpp"
#include "tests/unit/algorithms/scenes.hpp"

namespace zstep::test {

namespace {

using Kind = Camera::Kind;
using Ring = std::vector<glm::dvec3>;

constexpr double turn = 6.28318530717958647692;

Scene built_in(const std::string& name, std::int32_t width, std::int32_t height, bool orthographic = false) {
  ViewOptions options;
  options.width = width, options.height = height;
  if (orthographic) options.orthographic = true;
  return look_at_scene(load_scene(name).scene, options);
}

// Seen from (rho, theta, phi) with the window at the origin's depth; near and far as they come.
Scene seen(Scene scene, Kind kind, double rho, double theta, double phi, std::int32_t width, std::int32_t height,
           double window = 1.1) {
  ViewOptions options;
  options.rho = rho, options.theta = theta, options.phi = phi;
  options.orthographic = kind == Kind::orthographic;
  options.d = rho, options.window = window;
  options.width = width, options.height = height;
  return look_at_scene(std::move(scene), options);
}

// Corners of a polygon round the z axis at height z; every other one at `inner` of the radius.
Ring ring(glm::dvec3 centre, double radius, double inner, int corners, double z) {
  Ring points;
  for (int i = 0; i < corners; ++i) {
    const double angle = (i + 0.3) * turn / corners, r = i % 2 == 0 ? radius : radius * inner;
    points.push_back(centre + glm::dvec3(r * std::cos(angle), r * std::sin(angle), z));
  }
  return points;
}

// A prism whose base is a ring; outlines counter-clockwise from outside.
void add_prism(Scene& scene, glm::dvec3 centre, double radius, double inner, int corners, double half_height) {
  const Ring below = ring(centre, radius, inner, corners, -half_height),
             above = ring(centre, radius, inner, corners, half_height);
  add_polygon(scene, above);
  add_polygon(scene, Ring(below.rbegin(), below.rend()));
  for (std::size_t i = 0; i < below.size(); ++i) {
    const std::size_t next = (i + 1) % below.size();
    add_polygon(scene, Ring{below[i], below[next], above[next], above[i]});
  }
}

// A ball of quadrilaterals with polygons of `around` corners at its poles; every fifth quadrilateral is left out.
Scene ball(int around, int rows, double radius, bool holes) {
  Scene scene;
  const auto circle = [&](int row) {
    const double angle = row * turn / 2 / (rows + 1);
    const double z = radius * std::cos(angle), r = radius * std::sin(angle);
    Ring points;
    for (int i = 0; i < around; ++i)
      points.push_back({r * std::cos(i * turn / around), r * std::sin(i * turn / around), z});
    return points;
  };
  add_polygon(scene, circle(1));
  const Ring last = circle(rows);
  add_polygon(scene, Ring(last.rbegin(), last.rend()));
  int number = 0;
  for (int row = 1; row < rows; ++row) {
    const Ring above = circle(row), below = circle(row + 1);
    for (std::size_t i = 0; i < above.size(); ++i) {
      const std::size_t next = (i + 1) % above.size();
      if (holes && ++number % 5 == 0) continue;
      add_polygon(scene, Ring{below[i], below[next], above[next], above[i]});
    }
  }
  return scene;
}

// In a room with pillars and a few triangles through each other, near far/1000.
Scene inside_a_room(Kind kind) {
  Scene scene = cube(1);
  add_prism(scene, {0.5, 0.4, 0}, 0.2, 1, 7, 0.9);
  add_prism(scene, {-0.4, 0.6, -0.3}, 0.25, 0.5, 10, 0.4);
  Numbers random(21);
  for (int i = 0; i < 8; ++i) {
    const glm::dvec3 centre = random.in_box(0.8);
    Ring points;
    for (int corner = 0; corner < 3; ++corner) points.push_back(centre + random.in_box(0.6));
    add_polygon(scene, points);
  }
  scene.raster = {90, 67, false};
  look(scene, kind, glm::dvec3(-0.1, -0.35, 0.12), glm::dvec3(0.3, 0.5, -0.05), 0.003, 3);
  return scene;
}

// With this camera x is to the right, y upwards and z towards the eye.
Scene facing(Scene scene, Kind kind = Kind::perspective) { return seen(std::move(scene), kind, 4, -90, 0, 49, 37, 1); }

Scene coplanar() {
  Scene scene;
  add_polygon(scene, Ring{{-0.8, -0.7, 0.2}, {0.5, -0.7, 0.2}, {0.5, 0.6, 0.2}, {-0.8, 0.6, 0.2}});
  add_polygon(scene, Ring{{-0.2, -0.9, 0.2}, {0.9, -0.1, 0.2}, {-0.1, 0.8, 0.2}});
  add_polygon(scene, Ring{{-0.9, 0.1, -0.3}, {0.9, 0.1, -0.3}, {0.9, 0.9, -0.3}});
  return scene;
}

Scene duplicates() {
  Scene scene;
  for (int i = 0; i < 3; ++i) add_polygon(scene, Ring{{-0.8, -0.7, 0.4}, {0.8, -0.6, -0.4}, {0.1, 0.9, 0.1}});
  add_polygon(scene, Ring{{0.1, 0.9, 0.1}, {0.8, -0.6, -0.4}, {-0.8, -0.7, 0.4}});  // the other way round
  add_polygon(scene, Ring{{-0.5, -0.9, 0}, {0.9, 0, 0}, {-0.5, 0.9, 0}});
  return scene;
}

Scene without_area() {
  Scene scene;
  add_polygon(scene, Ring{{-0.8, 0, 0.5}, {0, 0, 0.5}, {0.8, 0, 0.5}});             // on one line
  add_polygon(scene, Ring{{0.3, 0.3, 0.5}, {0.3, 0.3, 0.5}, {0.3, 0.3, 0.5}});      // one point
  add_polygon(scene, Ring{{-0.5, -0.5, 0.5}, {0.5, 0.5, 0.5}, {-0.5, -0.5, 0.5}});  // there and back
  add_polygon(scene, Ring{{-0.7, -0.7, 0}, {0.7, -0.6, 0.1}, {0, 0.8, 0.2}});
  return scene;
}

// The second lies in the plane through the eye; the third almost does.
Scene edge_on() {
  Scene scene;
  add_polygon(scene, Ring{{-0.7, -0.7, 0}, {0.7, -0.6, 0.1}, {0, 0.8, 0.2}});
  add_polygon(scene, Ring{{0, -0.9, 0.9}, {0, 0.9, 0.9}, {0, 0.9, -0.9}, {0, -0.9, -0.9}});
  add_polygon(scene, Ring{{-0.301, -0.9, 0.8}, {-0.3, 0.9, 0.8}, {-0.38, 0.9, -0.9}, {-0.381, -0.9, -0.9}});
  return scene;
}

Scene concave() {
  Scene scene;
  const Ring star = ring({0, 0, 0.3}, 0.9, 0.3, 14, 0);
  add_polygon(scene, star);
  add_polygon(scene, Ring{{-0.9, -0.8, -0.3},
                          {0.9, -0.8, 0.7},
                          {0.9, 0.8, 0.7},
                          {0.6, -0.5, 0.5333333333333333},
                          {-0.6, -0.5, -0.13333333333333333},
                          {-0.9, 0.8, -0.3}});
  return scene;
}

Scene not_planar() {
  // As the loader does: cut into triangles that keep the polygon's index.
  Scene scene;
  add_polygon(scene, Ring{{-0.8, -0.8, 0.5}, {0.8, -0.7, -0.5}, {0.7, 0.8, 0.5}, {-0.8, 0.7, -0.5}});
  scene.corners = {0, 1, 2, 0, 2, 3};
  scene.facets = {{0, 0, 3}, {0, 3, 3}};
  add_polygon(scene, Ring{{-0.6, -0.9, 0}, {0.9, 0.1, 0.1}, {-0.6, 0.9, 0}});
  return scene;
}

Scene single() {
  Scene scene;
  add_polygon(scene, Ring{{-0.7, -0.7, 0.4}, {0.8, -0.6, -0.4}, {0, 0.8, 0.2}});
  return scene;
}

Scene on_screen() {
  // Corners and edges on pixel centres, a shared edge, polygons that leave the raster, depths of all signs.
  return screen_scene(23, 17,
                      {{{2, 2, 1}, {14, 2, 3}, {14, 12, 5}, {2, 12, 3}},
                       {{14, 2, 3}, {20, 7, 2}, {14, 12, 5}},
                       {{-5, 5, -2}, {30, 8, 9}, {4, 30, 2}},
                       {{6, 4, 6}, {18, 4, -1}, {18, 9, -1}, {6, 9, 6}}});
}

std::vector<AgreementScene> make_scenes() {
  std::vector<AgreementScene> scenes;
  const auto add = [&](const std::string& name, Scene scene, bool cull, bool small, bool open = false) {
    scene.name = name;
    scenes.push_back({name, std::move(scene), cull, small, open});
  };
  add("teapot", built_in("teapot:4", 96, 72), true, false);
  add("teapot, back faces drawn, parallel", built_in("teapot:4", 100, 75, true), false, false);
  add("n-gons", seen(n_gon_mesh(), Kind::perspective, 4, 35, 62, 96, 72), true, true);
  add("n-gons, back faces drawn, parallel", seen(n_gon_mesh(), Kind::orthographic, 4, -20, 50, 64, 64), false, false);
  add("intersecting", built_in("intersecting", 61, 47), true, true);
  add("intersecting, parallel", built_in("intersecting", 32, 32, true), false, true);
  add("cyclic", built_in("cyclic", 45, 61), true, true);
  add("cyclic, parallel", built_in("cyclic", 32, 32, true), false, true);
  add("soup of small triangles", seen(triangle_soup(1000, 0.2, 1), Kind::perspective, 3, 40, 60, 96, 72), false, false);
  add("soup of small triangles, parallel", seen(triangle_soup(1000, 0.2, 2), Kind::orthographic, 3, 10, 30, 75, 50),
      true, false);
  add("soup of large triangles", seen(triangle_soup(60, 1.5, 3), Kind::perspective, 3, 110, 75, 80, 60), false, false);
  add("ball with holes", seen(ball(16, 11, 1, true), Kind::perspective, 4, 25, 70, 96, 72), true, false);
  add("ball with holes, back faces drawn", seen(ball(16, 11, 1, true), Kind::perspective, 3, 60, 40, 85, 61), false,
      false);
  add("eye inside", inside_a_room(Kind::perspective), false, true);
  add("eye inside, back faces dropped", inside_a_room(Kind::perspective), true, true);
  add("eye inside, parallel", inside_a_room(Kind::orthographic), false, true);
  add("foley", built_in("foley", 16, 14), false, true, true);
  add("delhi", built_in("delhi", 8, 8), false, true, true);
  add("on the screen", on_screen(), false, true, true);
  add("coplanar", facing(coplanar()), true, true, true);
  add("duplicates", facing(duplicates()), false, true, true);
  add("without area", facing(without_area()), true, true);
  add("edge-on", facing(edge_on()), false, true);
  add("edge-on, parallel", facing(edge_on(), Kind::orthographic), false, true);
  add("concave", facing(concave()), true, true);
  add("not planar", facing(not_planar()), false, true);
  add("a single polygon", facing(single()), true, true);
  add("nothing", facing(Scene{}), true, true);
  return scenes;
}

}  // namespace

Scene triangle_soup(int count, double size, unsigned seed) {
  Scene scene;
  Numbers random(seed);
  for (int i = 0; i < count; ++i) {
    const glm::dvec3 centre = random.in_box(1);
    Ring points;
    for (int corner = 0; corner < 3; ++corner) points.push_back(centre + random.in_box(size));
    add_polygon(scene, points);
  }
  return scene;
}

Scene n_gon_mesh() {
  Scene scene;
  add_prism(scene, {-0.55, -0.3, 0}, 0.45, 1, 24, 0.5);
  add_prism(scene, {0.4, 0.55, 0.1}, 0.5, 0.4, 12, 0.35);
  add_prism(scene, {0.45, -0.5, -0.2}, 0.4, 1, 5, 0.6);
  const Scene solid = load_scene("dodecahedron").scene;
  for (const Facet& facet : solid.facets) {
    Ring points;
    for (std::int32_t i = 0; i < facet.corner_count; ++i) {
      const std::int32_t corner = solid.corners[static_cast<std::size_t>(facet.first_corner + i)];
      points.push_back(glm::dvec3(-0.3, 0.6, 0.3) + 0.25 * solid.points[static_cast<std::size_t>(corner)]);
    }
    add_polygon(scene, points);
  }
  return scene;
}

const std::vector<AgreementScene>& agreement_scenes() {
  static const std::vector<AgreementScene> scenes = make_scenes();
  return scenes;
}

}  // namespace zstep::test
