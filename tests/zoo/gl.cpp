// A renderer as its author would write it after OpenGL, Vulkan or Direct3D: a projection matrix, division by w, a
// viewport, and pixels whose centres are at halves. Or after tinyrenderer (D. V. Sokolov, "Tiny Renderer", lessons 1 to
// 7): z from the middle of the scene, w = 1 - z/d, borders that belong to both, pixels seen at their corners, greater
// depths nearer. Style: which of the four ("opengl", "vulkan", "direct3d", "tinyrenderer"), and "float32" or "float64";
// "quiet" prints no vertices. Triangles in front of the near plane.
#include <algorithm>
#include <array>
#include <cmath>

#include "tests/zoo/tools.hpp"

namespace zoo {

namespace {

template <class T>
struct Four {
  T x, y, z, w;
};

template <class T>
class Renderer {
 public:
  explicit Renderer(const Task& task)
      : task_(task),
        depth_(static_cast<std::size_t>(task.width * task.height), is("cleared_to_0") ? T(0)
                                                                   : tiny()           ? T(-1e30)
                                                                                      : T(1)) {}

  std::string run() {
    out_.print("clear", "z", static_cast<double>(depth_[0]));
    std::vector<Four<T>> window;
    for (std::size_t i = 0; i < task_.points.size(); ++i) window.push_back(to_window(static_cast<int>(i)));
    for (const Polygon& polygon : task_.polygons) {
      std::array<Four<T>, 3> p;
      for (std::size_t i = 0; i < 3; ++i) p[i] = window[static_cast<std::size_t>(polygon.corners[i])];
      draw(polygon.number, p);
    }
    return std::move(out_.text);
  }

 private:
  bool is(const char* mistake) const { return task_.mistake == mistake; }
  bool style(const char* word) const { return task_.style.find(word) != std::string::npos; }
  /// Does the eye look along -z?
  bool right_handed() const { return !style("direct3d"); }
  bool tiny() const { return style("tinyrenderer"); }

  Four<T> to_window(int vertex) {
    const Camera& c = task_.camera;
    const Point at = task_.points[static_cast<std::size_t>(vertex)];
    const auto row = [&](Point axis, double origin) {
      return static_cast<T>(axis.x) * static_cast<T>(at.x) + static_cast<T>(axis.y) * static_cast<T>(at.y) +
             static_cast<T>(axis.z) * static_cast<T>(at.z) + static_cast<T>(origin);
    };
    const T sign = right_handed() ? T(-1) : T(1);
    Four<T> v{row(c.right, c.origin.x), row(c.up, c.origin.y), sign * row(c.away, c.origin.z), 1};
    if (!style("quiet"))
      out_.print("view_vertex", "vertex", vertex, "x_v", static_cast<double>(v.x), "y_v", static_cast<double>(v.y),
                 "z_v", static_cast<double>(is("handedness_changes") ? -v.z : v.z));
    // The projection matrix of the library's books.
    const T near = static_cast<T>(c.near), far = static_cast<T>(c.far), window = static_cast<T>(c.window);
    const T up = static_cast<T>(c.d) / window;
    T across = up * T(task_.height) / T(task_.width);
    if (is("aspect_upside_down")) across = up * T(task_.width) / T(task_.height);
    if (is("aspect_left_out")) across = up;
    Four<T> clip{across * v.x, up * v.y, 0, sign * v.z};
    const T distance = clip.w;
    if (style("opengl")) clip.z = (far + near) / (far - near) * distance - 2 * far * near / (far - near);
    else clip.z = far / (far - near) * distance - far * near / (far - near);
    if (is("near_left_out")) clip.z = distance - far * near / (far - near);
    const T w = is("depth_not_divided") ? T(1) : clip.w;
    Four<T> n{clip.x / clip.w, clip.y / clip.w, clip.z / w, 1 / clip.w};
    if (style("vulkan") || style("direct3d")) n.y = -n.y;
    if (is("y_upside_down")) n.y = -n.y;
    if (is("picture_mirrored")) n.x = -n.x;
    const T width = T(is("viewport_less_one") ? task_.width - 1 : task_.width), height = T(task_.height);
    Four<T> s{(n.x + 1) / 2 * width, (n.y + 1) / 2 * height, n.z, n.w};
    if (tiny()) s.z = depth_from_middle(distance);
    if (style("opengl") && !is("depth_range_left_out")) s.z = (n.z + 1) / 2;
    if (style("vulkan") && is("depth_range_twice")) s.z = (n.z + 1) / 2;
    if (is("z_v_for_depth")) s.z = distance;
    if (!style("quiet"))
      out_.print("to_viewport", "vertex", vertex, "x_s", static_cast<double>(s.x), "y_s", static_cast<double>(s.y));
    return s;
  }

  /// z/w with z = d - distance and w = 1 - z/d.
  T depth_from_middle(T distance) const {
    const T d = static_cast<T>(task_.camera.d), z = d - distance;
    return is("depth_not_divided") ? z : is("w_of_wrong_sign") ? z / (1 + z / d) : z / (1 - z / d);
  }

  static T edge(const Four<T>& a, const Four<T>& b, T x, T y) {
    return (b.x - a.x) * (y - a.y) - (b.y - a.y) * (x - a.x);
  }

  void draw(int number, std::array<Four<T>, 3> p) {
    T area = edge(p[0], p[1], p[2].x, p[2].y);
    if (area == 0) return;
    if (area < 0) std::swap(p[1], p[2]), area = -area;
    out_.print("polygon", "polygon", number, "facet", number);
    const auto clamp = [](T value, int most) { return static_cast<int>(std::clamp(value, T(0), T(most))); };
    const auto [least_x, most_x] = std::minmax({p[0].x, p[1].x, p[2].x});
    const auto [least_y, most_y] = std::minmax({p[0].y, p[1].y, p[2].y});
    // Pixels on the last border count where borders belong to both.
    const int end_x = clamp(tiny() ? std::floor(most_x) + 1 : std::ceil(most_x), task_.width),
              end_y = clamp(tiny() ? std::floor(most_y) + 1 : std::ceil(most_y), task_.height);
    const T half = tiny() == is("centres_at_corners") ? T(0.5) : T(0);
    for (int y = clamp(std::floor(least_y), task_.height); y < end_y; ++y)
      for (int x = clamp(std::floor(least_x), task_.width); x < end_x; ++x) {
        std::array<T, 3> w{};
        bool inside = true;
        for (std::size_t i = 0; i < 3; ++i) {
          const Four<T>&a = p[(i + 1) % 3], &b = p[(i + 2) % 3];
          w[i] = edge(a, b, T(x) + half, T(y) + half) / area;
          const bool owns = b.y < a.y || (b.y == a.y && b.x > a.x);
          inside = inside && (w[i] > 0 || (w[i] == 0 && (owns || tiny() || is("border_for_both"))));
        }
        if (inside) pixel(number, p, w, x, y);
      }
  }

  void pixel(int number, const std::array<Four<T>, 3>& p, std::array<T, 3> w, int x, int y) {
    if (is("weights_exchanged")) std::swap(w[0], w[1]);
    if (is("depth_corrected_twice"))
      for (std::size_t i = 0; i < 3; ++i) w[i] *= p[i].w;
    if (is("depth_corrected_twice")) {
      const T sum = w[0] + w[1] + w[2];
      for (T& one : w) one /= sum;
    }
    const T z = w[0] * p[0].z + w[1] * p[1].z + w[2] * p[2].z;
    T& stored = depth_[static_cast<std::size_t>(y * task_.width + x)];
    const bool nearer = is("compare_reversed") != tiny() ? z > stored : z < stored;
    out_.print("compare", "x", x, "y", y, "z", static_cast<double>(z), "nearer", nearer);
    if (!nearer) return;
    stored = z;
    out_.print("write_depth", "x", x, "y", y, "z", static_cast<double>(z));
    out_.print("write_pixel", "x", x, "y", y, "polygon", number);
  }

  const Task& task_;
  Output out_{};
  std::vector<T> depth_;
};

}  // namespace

std::string gl(const Task& task) {
  return task.style.find("float32") != std::string::npos ? Renderer<float>(task).run() : Renderer<double>(task).run();
}

}  // namespace zoo
