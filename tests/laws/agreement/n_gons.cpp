#include "tests/laws/agreement/n_gons.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "algorithms/scene/builder.hpp"
#include "tests/unit/algorithms/scenes.hpp"

namespace zstep::test {

namespace {

using Ring = std::vector<glm::dvec3>;

/// Polygons that may share vertices.
struct Mesh {
  scene::PolygonSoup soup;

  std::int32_t point(glm::dvec3 at) {
    soup.points.push_back(at);
    return static_cast<std::int32_t>(soup.points.size()) - 1;
  }
  void polygon(const std::vector<std::int32_t>& corners) {
    soup.corners.insert(soup.corners.end(), corners.begin(), corners.end());
    soup.close_outline(0, std::nullopt, [] { return std::string("n-gons"); });
  }
  void polygon(const Ring& ring) {
    std::vector<std::int32_t> corners;
    for (const glm::dvec3& at : ring) corners.push_back(point(at));
    polygon(corners);
  }
  /// As a file would hold it that was written with so many digits: few make planar polygons nearly planar.
  void round_to(double digits) {
    const double unit = std::pow(10, -digits);
    for (glm::dvec3& at : soup.points) at = glm::round(at / unit) * unit;
  }
  std::string file() const {
    std::string text = fmt::format("OFF\n{} {} 0\n", soup.points.size(), soup.outlines.size());
    for (const glm::dvec3& at : soup.points) text += fmt::format("{} {} {}\n", at.x, at.y, at.z);
    for (const Facet& outline : soup.outlines) {
      text += std::to_string(outline.corner_count);
      for (std::int32_t k = 0; k < outline.corner_count; ++k)
        text += fmt::format(" {}", soup.corners[static_cast<std::size_t>(outline.first_corner + k)]);
      text += '\n';
    }
    return text;
  }
  Scene scene() && {
    scene::SceneBuilder builder({});
    builder.add(std::move(soup), "n-gons", {});
    return builder.finish().scene;
  }
};

int whole(Numbers& random, int least, int most) {
  return least + static_cast<int>(random.engine() % static_cast<std::uint64_t>(most - least + 1));
}
/// 10 to the power of a number between two.
double power(Numbers& random, double least, double most) { return std::pow(10, random.between(least, most)); }

glm::dvec3 normal_of(const Ring& ring) {
  glm::dvec3 sum(0);
  for (std::size_t i = 1; i + 1 < ring.size(); ++i) sum += glm::cross(ring[i] - ring[0], ring[i + 1] - ring[0]);
  return glm::normalize(sum);
}

/// Moves each corner along the normal by up to `most`.
Ring bent(Numbers& random, Ring ring, double most) {
  const glm::dvec3 normal = normal_of(ring);
  for (glm::dvec3& corner : ring) corner += random.between(-most, most) * normal;
  return ring;
}

Ring star_near(Numbers& random, double spread, double radius) {
  const glm::dvec3 centre = random.in_box(spread);
  return random_star(random, centre, radius, whole(random, 3, 9));
}

Mesh not_planar(std::uint64_t seed) {
  Numbers random(seed);
  Mesh mesh;
  for (int i = whole(random, 2, 6); i > 0; --i) {
    Ring ring = star_near(random, 0.5, 0.9);
    mesh.polygon(bent(random, std::move(ring), 0.3));
  }
  return mesh;
}

/// On both sides of the bound at which a polygon counts as planar.
Mesh nearly_planar(std::uint64_t seed) {
  Numbers random(seed);
  Mesh mesh;
  for (int i = whole(random, 2, 6); i > 0; --i) {
    Ring ring = star_near(random, 0.4, 1);
    mesh.polygon(bent(random, std::move(ring), power(random, -8, -4)));
  }
  return mesh;
}

Mesh concave(std::uint64_t seed) {
  Numbers random(seed);
  Mesh mesh;
  for (int i = whole(random, 2, 8); i > 0; --i) mesh.polygon(star_near(random, 0.6, 0.9));
  mesh.round_to(random.between(4, 9));
  return mesh;
}

Mesh thin(std::uint64_t seed) {
  Numbers random(seed);
  Mesh mesh;
  for (int i = whole(random, 4, 12); i > 0; --i) {
    const glm::dvec3 centre = random.in_box(0.4), across = glm::normalize(random.in_box(1) + glm::dvec3(1e-6));
    const double squeeze = 1 - power(random, -3, -1);
    Ring ring = random_star(random, {0, 0, 0}, 1.2, whole(random, 3, 7));
    for (glm::dvec3& corner : ring) corner = centre + corner - squeeze * glm::dot(corner, across) * across;
    mesh.polygon(ring);
  }
  mesh.round_to(random.between(5, 12));
  return mesh;
}

/// All about one point, some through it.
Mesh through_each_other(std::uint64_t seed) {
  Numbers random(seed);
  Mesh mesh;
  const glm::dvec3 middle = random.in_box(0.2);
  for (int i = whole(random, 3, 7); i > 0; --i) {
    Ring ring = random_star(random, middle, 1, whole(random, 3, 8));
    if (i % 3 == 0) ring[0] = middle;
    mesh.polygon(ring);
  }
  mesh.round_to(random.between(6, 14));
  return mesh;
}

/// Each a little off one plane, and tilted a little.
Mesh nearly_coplanar(std::uint64_t seed) {
  Numbers random(seed);
  Mesh mesh;
  const glm::dvec3 normal = glm::normalize(random.in_box(1) + glm::dvec3(1e-6));
  const glm::dvec3 u = glm::normalize(glm::cross(normal, glm::dvec3(0.3, 0.5, 0.8))), v = glm::cross(normal, u);
  for (int i = whole(random, 2, 6); i > 0; --i) {
    const double off = power(random, -11, -2), tilt = power(random, -9, -1), turn = random.between(0, 6.28);
    const glm::dvec2 middle(random.in_box(0.4));
    Ring ring;
    const int corners = whole(random, 3, 9);
    for (int k = 0; k < corners; ++k) {
      const double angle = (k + random.between(0.1, 0.9)) * 6.28318530717958647692 / corners;
      const double length = random.between(0.3, 1);
      const glm::dvec2 at = middle + length * glm::dvec2(std::cos(angle), std::sin(angle));
      const double height = off + tilt * (at.x * std::cos(turn) + at.y * std::sin(turn));
      ring.push_back(at.x * u + at.y * v + height * normal);
    }
    mesh.polygon(ring);
  }
  return mesh;
}

/// Pages of a book: planar but for the rounding of their corners, and all share the edge at which they are bound, some
/// of them with corners of their own on it.
Mesh pages(std::uint64_t seed) {
  Numbers random(seed);
  Mesh mesh;
  const glm::dvec3 axis = glm::normalize(random.in_box(1) + glm::dvec3(1e-6));
  const glm::dvec3 u = glm::normalize(glm::cross(axis, glm::dvec3(0.3, 0.5, 0.8))), v = glm::cross(axis, u);
  const std::int32_t top = mesh.point(random.between(0.2, 0.8) * axis);
  const std::int32_t bottom = mesh.point(random.between(-0.8, -0.2) * axis);
  for (int i = whole(random, 2, 5); i > 0; --i) {
    const double angle = random.between(0, 6.28);
    const glm::dvec3 out = std::cos(angle) * u + std::sin(angle) * v;
    std::vector<std::int32_t> corners{top, bottom};
    const int more = whole(random, 2, 7);
    for (int k = 0; k < more; ++k) {
      const double along = -1 + 2 * (k + random.between(0.1, 0.9)) / more, length = random.between(0.1, 1.1);
      corners.push_back(mesh.point(along * axis + length * out));
    }
    if (i % 2 == 0) std::swap(corners[0], corners[1]), std::reverse(corners.begin() + 2, corners.end());
    mesh.polygon(corners);
  }
  mesh.round_to(random.between(4, 7));
  return mesh;
}

/// Squares joined to n-gons that share all edges: bent to a bow, waved, and rough.
Mesh sheet(Numbers& random, double fold, double wave, double rough) {
  Mesh mesh;
  constexpr int side = 6;
  const glm::dvec3 lean = random.in_box(0.5);
  std::vector<std::int32_t> points;
  for (int y = 0; y <= side; ++y) {
    for (int x = 0; x <= side; ++x) {
      const double s = 2.0 * x / side - 1, t = 2.0 * y / side - 1;
      const double bow = fold * s;
      const glm::dvec3 at(fold > 0.1 ? std::sin(bow) / fold : s, t, fold > 0.1 ? (1 - std::cos(bow)) / fold : 0);
      const glm::dvec3 off = rough * random.in_box(1);
      points.push_back(mesh.point(at + off + lean * (wave * std::sin(4 * t))));
    }
  }
  const auto at = [&](int x, int y) { return points[static_cast<std::size_t>(y * (side + 1) + x)]; };
  for (int y = 0; y < side; y += 2) {
    for (int x = 0; x < side; x += 2) {
      // An L of three squares and the fourth one; or all four as one with eight corners.
      const std::vector<std::int32_t> whole_square{at(x, y),         at(x + 1, y),     at(x + 2, y), at(x + 2, y + 1),
                                                   at(x + 2, y + 2), at(x + 1, y + 2), at(x, y + 2), at(x, y + 1)};
      if (random.engine() % 3 == 0) {
        mesh.polygon(whole_square);
        continue;
      }
      const auto notch = static_cast<std::size_t>(2 * (random.engine() % 4));  // the corner that is cut out
      std::vector<std::int32_t> rest = whole_square;
      rest[notch] = at(x + 1, y + 1);
      mesh.polygon(rest);
      mesh.polygon(std::vector<std::int32_t>{whole_square[(notch + 7) % 8], whole_square[notch],
                                             whole_square[(notch + 1) % 8], at(x + 1, y + 1)});
    }
  }
  mesh.round_to(random.between(5, 9));
  return mesh;
}

/// Folded over, so that its polygons hide each other.
Mesh folded_sheet(std::uint64_t seed) {
  Numbers random(seed);
  const double wave = power(random, -7, 0), fold = random.between(0, 3);
  return sheet(random, fold, wave, power(random, -8, -1));
}

/// So flat that every polygon almost lies in the plane of every other.
Mesh flat_sheet(std::uint64_t seed) {
  Numbers random(seed);
  const double wave = power(random, -7, -4);
  return sheet(random, 0, wave, power(random, -8, -5));
}

template <Mesh (*mesh)(std::uint64_t)>
NGonKind kind_of(std::string name) {
  return {std::move(name), [](std::uint64_t seed) { return mesh(seed).scene(); },
          [](std::uint64_t seed) { return mesh(seed).file(); }};
}

}  // namespace

const std::vector<NGonKind>& n_gon_kinds() {
  static const std::vector<NGonKind> kinds{kind_of<not_planar>("not planar"),
                                           kind_of<nearly_planar>("nearly planar"),
                                           kind_of<concave>("concave"),
                                           kind_of<thin>("thin"),
                                           kind_of<through_each_other>("through each other"),
                                           kind_of<nearly_coplanar>("nearly coplanar"),
                                           kind_of<pages>("pages of a book"),
                                           kind_of<folded_sheet>("a sheet"),
                                           kind_of<flat_sheet>("an almost flat sheet")};
  return kinds;
}

std::vector<Scene> two_views(const Scene& mesh, std::uint64_t seed) {
  Numbers random(seed);
  std::vector<Scene> views;
  for (const bool orthographic : {false, true}) {
    ViewOptions options;
    options.rho = random.between(2, 5);
    options.theta = random.between(-180, 180);
    options.phi = random.between(5, 175);
    options.d = *options.rho, options.window = 1.2;
    options.orthographic = orthographic;
    options.width = 40, options.height = 30;
    views.push_back(look_at_scene(mesh, options));
  }
  return views;
}

}  // namespace zstep::test
