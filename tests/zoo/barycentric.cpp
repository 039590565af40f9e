// Rasterisers as most people write them today: a box, three edge functions, depth by barycentric weights. They print
// polygons, compares and writes, and nothing of how they got there. Style: a number type and a way of finding the
// weights, as "float32 increments": products (each time anew), increments (stepped in x and y), last (the third weight
// is what is left of 1), lines (A x + B y + C), slopes (the plane's), rows (from the bottom up), tiles (of 4 by 4).
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "tests/zoo/tools.hpp"

namespace zoo {

namespace {

template <class T>
struct Corner {
  T x, y, z;
};

template <class T>
class Rasteriser {
 public:
  explicit Rasteriser(const Task& task)
      : task_(task), depth_(static_cast<std::size_t>(task.width * task.height), std::numeric_limits<T>::infinity()) {}

  std::string run() {
    out_.print("clear", "z", INFINITY);
    for (const Polygon& polygon : task_.polygons) {
      if (is("polygon_left_out") && polygon.number == 1) continue;
      std::array<Corner<T>, 3> p;
      for (std::size_t i = 0; i < 3; ++i) p[i] = seen(task_.points[static_cast<std::size_t>(polygon.corners[i])]);
      draw(polygon.number, p);
    }
    return std::move(out_.text);
  }

 private:
  bool is(const char* mistake) const { return task_.mistake == mistake; }
  bool style(const char* word) const { return task_.style.find(word) != std::string::npos; }

  Corner<T> seen(Point p) const {
    Corner<T> s{static_cast<T>(p.x), static_cast<T>(p.y), static_cast<T>(p.z)};
    const Camera& c = task_.camera;
    if (c.there) {
      const auto row = [&](Point axis, double origin) {
        return static_cast<T>(axis.x) * s.x + static_cast<T>(axis.y) * s.y + static_cast<T>(axis.z) * s.z +
               static_cast<T>(origin);
      };
      const T x = row(c.right, c.origin.x), y = row(c.up, c.origin.y), z = row(c.away, c.origin.z);
      const T window = static_cast<T>(c.window), width = static_cast<T>(task_.width),
              height = static_cast<T>(task_.height), d = static_cast<T>(c.d), near = static_cast<T>(c.near),
              far = static_cast<T>(c.far);
      const T wide = is("window_taken_for_square") ? window : window * width / height;
      s.x = (d * x / z + wide) / (2 * wide) * width - T(0.5);
      s.y = (window - d * y / z) / (2 * window) * height - T(0.5);
      s.z = is("z_v_for_depth") ? z : (far + near) / (far - near) - 2 * far * near / ((far - near) * z);
    }
    if (is("centres_half_off")) s.x += T(0.5), s.y += T(0.5);
    if (is("vertices_rounded")) s.x = std::round(s.x), s.y = std::round(s.y);
    if (is("vertices_truncated")) s.x = std::trunc(s.x), s.y = std::trunc(s.y);
    if (is("picture_mirrored")) s.x = T(task_.width - 1) - s.x;
    if (is("y_upside_down")) s.y = T(task_.height - 1) - s.y;
    if (is("one_pixel_off")) s.x += 1;
    if (is("one_line_up")) s.y -= 1;
    if (is("centres_left_of_pixels")) s.x -= T(0.5);
    if (is("x_y_exchanged")) std::swap(s.x, s.y);
    return s;
  }

  /// Positive where (x, y) lies on the inner side of the edge from a to b.
  T edge(const Corner<T>& a, const Corner<T>& b, T x, T y) const {
    if (style("lines")) return (a.y - b.y) * x + (b.x - a.x) * y + (a.x * b.y - b.x * a.y);
    return (b.x - a.x) * (y - a.y) - (b.y - a.y) * (x - a.x);
  }

  void draw(int number, std::array<Corner<T>, 3> p) {
    const T twice_area = edge(p[0], p[1], p[2].x, p[2].y);
    if (twice_area == 0) return;
    if (twice_area < 0) {
      if (is("one_winding_only")) return;
      std::swap(p[1], p[2]);
    }
    if (is("vertex_depth_twice")) p[2].z = p[0].z;
    if (is("nearest_of_three")) p[0].z = p[1].z = p[2].z = std::min({p[0].z, p[1].z, p[2].z});
    out_.print("polygon", "polygon", number, "facet", number);
    const auto [least_x, most_x] = std::minmax({p[0].x, p[1].x, p[2].x});
    const auto [least_y, most_y] = std::minmax({p[0].y, p[1].y, p[2].y});
    const int first_x = std::max(0, static_cast<int>(std::floor(least_x))),
              first_y = std::max(0, static_cast<int>(std::floor(least_y)));
    int last_x = std::min(task_.width - 1, static_cast<int>(std::ceil(most_x))),
        last_y = std::min(task_.height - 1, static_cast<int>(std::ceil(most_y)));
    if (is("box_too_small")) last_x = static_cast<int>(std::floor(most_x)) - 1;
    if (is("box_without_last_row")) last_y = static_cast<int>(std::floor(most_y)) - 1;
    const T area = std::abs(twice_area);
    std::array<T, 3> at_row{};
    for (std::size_t i = 0; i < 3; ++i) at_row[i] = edge(p[(i + 1) % 3], p[(i + 2) % 3], T(first_x), T(first_y));
    const auto row = [&](int y, int from, int end) {
      std::array<T, 3> stepped = at_row;
      for (int x = from; x <= end; ++x) {
        std::array<T, 3> w{};
        bool inside = true;
        for (std::size_t i = 0; i < 3; ++i) {
          const Corner<T>&a = p[(i + 1) % 3], &b = p[(i + 2) % 3];
          w[i] = style("increments") ? stepped[i] : edge(a, b, T(x), T(y));
          stepped[i] -= b.y - a.y;
          const bool top = a.y == b.y && b.x > a.x, left = b.y < a.y;
          const bool owned = is("border_for_nobody")       ? w[i] > 0
                             : is("border_for_both")       ? w[i] >= 0
                             : is("border_for_other_side") ? w[i] > 0 || (w[i] == 0 && !(top || left))
                             : is("inside_margin")         ? w[i] > -area / 16
                                                           : w[i] > 0 || (w[i] == 0 && (top || left));
          inside = inside && (owned || (is("edge_not_asked") && i == 2));
        }
        if (inside) pixel(number, p, w, area, x, y);
      }
    };
    if (style("tiles")) {
      for (int y = first_y; y <= last_y; y += 4)
        for (int x = first_x; x <= last_x; x += 4)
          for (int line = y; line <= std::min(last_y, y + 3); ++line) row(line, x, std::min(last_x, x + 3));
    } else if (style("rows")) {
      for (int y = last_y; y >= first_y; --y) row(y, first_x, last_x);
    } else {
      for (int y = first_y; y <= last_y; ++y) {
        row(y, first_x, last_x);
        for (std::size_t i = 0; i < 3; ++i) at_row[i] += p[(i + 2) % 3].x - p[(i + 1) % 3].x;
      }
    }
  }

  T depth_at(const std::array<Corner<T>, 3>& p, std::array<T, 3> w, T area, int x, int y) const {
    if (style("slopes")) {
      const T x_1 = p[1].x - p[0].x, y_1 = p[1].y - p[0].y, z_1 = p[1].z - p[0].z;
      const T x_2 = p[2].x - p[0].x, y_2 = p[2].y - p[0].y, z_2 = p[2].z - p[0].z;
      const T below = x_1 * y_2 - x_2 * y_1;
      return p[0].z + (z_1 * y_2 - z_2 * y_1) / below * (T(x) - p[0].x) +
             (x_1 * z_2 - x_2 * z_1) / below * (T(y) - p[0].y);
    }
    if (is("area_not_divided_by")) return w[0] * p[0].z + w[1] * p[1].z + w[2] * p[2].z;
    for (T& one : w) one /= is("area_not_doubled") ? area / 2 : area;
    if (style("last")) w[2] = 1 - w[0] - w[1];
    if (is("weights_exchanged")) std::swap(w[0], w[1]);
    if (is("weights_turned")) w = {w[1], w[2], w[0]};
    if (is("weight_negative")) w[0] = -w[0];
    if (is("weight_left_out")) return w[0] * p[0].z + w[1] * p[1].z;
    if (is("not_normalised")) return w[0] * p[0].z + w[1] * p[1].z + w[2] * p[2].z * T(1.01);
    if (is("depth_is_mean")) return (p[0].z + p[1].z + p[2].z) / 3;
    if (is("depth_of_one_vertex")) return p[0].z;
    if (is("depth_truncated")) return std::trunc(w[0] * p[0].z + w[1] * p[1].z + w[2] * p[2].z);
    if (is("depth_by_reciprocals")) return 1 / (w[0] / p[0].z + w[1] / p[1].z + w[2] / p[2].z);
    return w[0] * p[0].z + w[1] * p[1].z + w[2] * p[2].z;
  }

  void pixel(int number, const std::array<Corner<T>, 3>& p, const std::array<T, 3>& w, T area, int x, int y) {
    const T z = depth_at(p, w, area, x, y);
    const int stride = is("stride_is_height") ? task_.height : task_.width;
    T& stored = depth_[static_cast<std::size_t>(y * stride + x) % depth_.size()];
    const bool nearer = is("compare_reversed") ? z > stored : is("equal_wins") ? z <= stored : z < stored;
    out_.print("compare", "x", x, "y", y, "z", static_cast<double>(z), "nearer", nearer);
    if (is("depth_always") && !nearer) stored = z;
    if (!nearer) return;
    if (!is("depth_not_kept")) stored = z;
    // With a camera its steps have the names of the method's own page.
    out_.print(task_.camera.there ? "write_depth" : "wz", "x", x, "y", y, "z",
               static_cast<double>(is("depth_squared") ? z * z : z));
    out_.print(task_.camera.there ? "write_pixel" : "wp", "x", is("colour_beside") && x > 0 ? x - 1 : x, "y", y,
               "polygon", is("colour_of_next") ? (number + 1) % static_cast<int>(task_.polygons.size()) : number);
  }

  const Task& task_;
  Output out_{};
  std::vector<T> depth_;
};

}  // namespace

std::string barycentric(const Task& task) {
  return task.style.starts_with("float32") ? Rasteriser<float>(task).run() : Rasteriser<double>(task).run();
}

}  // namespace zoo
