// What programs of the zoo share, as students share a small library: printing a step as JSON, and vectors.
#pragma once

#include <algorithm>
#include <cmath>
#include <concepts>
#include <cstdio>
#include <string>
#include <utility>
#include <vector>

#include "tests/zoo/programs.hpp"

namespace zoo {

inline Point operator+(Point a, Point b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
inline Point operator-(Point a, Point b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
inline Point operator*(double k, Point a) { return {k * a.x, k * a.y, k * a.z}; }
inline double dot(Point a, Point b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
inline Point cross(Point a, Point b) { return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x}; }

/// What a program prints: print("ray_end", "ray", 3, "t", 0.5) is {"step":"ray_end","ray":3,"t":0.5}.
class Output {
 public:
  std::string text;

  template <class... Fields>
  void print(const char* step, Fields... fields) {
    text += "{\"step\":";
    add(step);
    add_fields(fields...);
    text += "}\n";
  }

 private:
  void add(const char* word) { text += '"' + std::string(word) + '"'; }
  void add(bool yes) { text += yes ? "true" : "false"; }
  void add(std::integral auto whole) { text += std::to_string(whole); }
  void add(double number) {
    if (std::isnan(number)) return add("nan");
    if (std::isinf(number)) return add(number < 0 ? "-inf" : "inf");
    char digits[40];
    std::snprintf(digits, sizeof digits, "%.17g", number);
    text += digits;
  }
  void add_fields() {}
  template <class Value, class... Rest>
  void add_fields(const char* key, Value value, Rest... rest) {
    text += ',';
    add(key);
    text += ':';
    add(value);
    add_fields(rest...);
  }
};

/// A point of the world on the raster, with its depth, through all steps of viewing; on the raster already without a
/// camera.
inline Point see(const Task& task, Output& out, int vertex, Point p) {
  const Camera& camera = task.camera;
  if (!camera.there) return p;
  const double window_x = camera.window * task.width / task.height, range = camera.far - camera.near;
  const Point origin = task.mistake == "translation_left_out" ? Point{} : camera.origin;
  const Point v = origin + Point{dot(camera.right, p), dot(camera.up, p), dot(camera.away, p)};
  out.print("view_vertex", "vertex", vertex, "x_v", v.x, "y_v", v.y, "z_v", v.z);
  const double x_p = camera.d * v.x / v.z, y_p = camera.d * v.y / v.z,
               z = (camera.far + camera.near) / range - 2 * camera.far * camera.near / (range * v.z);
  out.print("project", "vertex", vertex, "x_p", x_p, "y_p", y_p, "z", z);
  const Point s{(x_p + window_x) / (2 * window_x) * task.width - 0.5,
                (camera.window - y_p) / (2 * camera.window) * task.height - 0.5, z};
  out.print("to_viewport", "vertex", vertex, "x_s", s.x, "y_s", s.y);
  return s;
}

/// Calls pixel(x, y, z) for the pixels of an outline on the raster, with the depth between the two crossings.
template <class Pixel>
void fill(const Task& task, const std::vector<Point>& outline, Pixel&& pixel) {
  for (int y = 0; y < task.height; ++y) {
    std::vector<std::pair<double, double>> crossings;  // x and depth
    for (std::size_t i = 0; i < outline.size(); ++i) {
      const Point p = outline[i], q = outline[(i + 1) % outline.size()];
      if ((p.y <= y) == (q.y <= y)) continue;
      const double t = (y - p.y) / (q.y - p.y);
      crossings.emplace_back(p.x + t * (q.x - p.x), p.z + t * (q.z - p.z));
    }
    std::sort(crossings.begin(), crossings.end());
    for (std::size_t i = 0; i + 1 < crossings.size(); i += 2) {
      const auto [x_left, z_left] = crossings[i];
      const auto [x_right, z_right] = crossings[i + 1];
      const double first = std::max(0.0, std::ceil(x_left)), end = std::min<double>(task.width, std::ceil(x_right));
      for (int x = static_cast<int>(std::min(first, end)); x < end; ++x)
        pixel(x, y, z_left + (z_right - z_left) * (x - x_left) / (x_right - x_left));
    }
  }
}

}  // namespace zoo
