#include "sim/viewer/emblems.hpp"

#include <algorithm>
#include <cmath>
#include <locale>
#include <sstream>
#include <utility>
#include <vector>

#include <glm/vec2.hpp>

#include "algorithms/scene/mesh.hpp"

namespace zstep::viewer {
namespace {

/// On a ground of 24 by 18, marks parted by "/", in the order in which they are painted. A letter, then points: o, s
/// and h fill an outline in orange, sky blue and grey, x what both have; O and S do without its border. l is a line, m
/// one of a grid, n what is at work, d dashed. p is a dot and b a ball, with their radius.
constexpr std::pair<std::string_view, const char*> emblems[] = {
    {"z-buffer",
     "S 9 0 24 0 24 12 9 12 / O 9 3 12 3 12 6 9 6 / O 6 6 15 6 15 9 6 9 / O 3 9 15 9 15 12 3 12 / "
     "O 3 12 18 12 18 15 3 15 / m 3 0 3 18 / m 6 0 6 18 / m 9 0 9 18 / m 12 0 12 18 / m 15 0 15 18 / m 18 0 18 18 / "
     "m 21 0 21 18 / m 0 3 24 3 / m 0 6 24 6 / m 0 9 24 9 / m 0 12 24 12 / m 0 15 24 15"},
    {"scan-line", "s 11 3 22 5 20 15 9 12 / o 2 15 9 2 15 13 / n 0 9 24 9 / p 5.3 9 1.2 / p 13 9 1.2 / p 21 9 1.2"},
    {"painter", "h 2 2 14 2 14 11 2 11 / s 6 5 18 5 18 14 6 14 / o 10 8 22 8 22 17 10 17"},
    {"depth-sort",
     "o 2 2 10 2 10 16 2 16 / s 14 2 22 2 22 16 14 16 / n 6 7 18 7 / n 15.5 4.5 18 7 15.5 9.5 / n 18 12 6 12 / "
     "n 8.5 9.5 6 12 8.5 14.5"},
    {"bsp",
     "l 12 3 6 9 / l 12 3 18 9 / l 6 9 3 15 / l 6 9 9 15 / l 18 9 21 15 / b 12 3 2 / b 6 9 2 / b 18 9 2 / b 3 15 2 / "
     "b 9 15 2 / b 21 15 2"},
    {"warnock",
     "o 3 16 9 5 20 12 / l 1 1 23 1 23 17 1 17 1 1 / l 12 1 12 17 / l 1 9 23 9 / l 6.5 1 6.5 9 / l 1 5 12 5 / "
     "l 17.5 9 17.5 17 / l 12 13 23 13"},
    {"ray-casting", "o 15 3 22 7 15 15 / l 8 2 8 16 / n 2 9 15.5 5.2 / n 2 9 15 9 / n 2 9 15 13.5 / p 2 9 1.4"},
    {"ray-tracing", "s 14 16 17 16 23 3 20 3 / b 6 5 3.5 / n 1.5 15 17 10 / n 17 10 9 6.3 / p 1.5 15 1.4"},
    {"floating-horizon", "l 1 16 6 13 11 15 17 11 23 14 / l 1 12 6 7 11 10 17 5 23 9 / l 1 9 5 4 10 7 16 2 23 5"},
    {"wireframe",
     "l 3 6 14 6 14 17 3 17 3 6 / l 9 1 20 1 20 12 9 12 9 1 / l 3 6 9 1 / l 14 6 20 1 / l 14 17 20 12 / l 3 17 9 12"},
    {"hidden-line",
     "l 3 6 14 6 14 17 3 17 3 6 / l 3 6 9 1 20 1 20 12 14 17 / l 14 6 20 1 / d 9 1 9 12 / d 9 12 20 12 / d 3 17 9 12"},
    {"shadow-buffer", "h 9 14 15 14 23 17 15 17 / o 9 5 15 5 15 14 9 14 / d 3 3 9 5 / d 3 3 9 14 / b 3 3 2"},
    {"transparency", "o 2 2 15 2 15 12 2 12 / s 9 6 22 6 22 16 9 16 / x 9 6 15 6 15 12 9 12"},
};

constexpr double ground_width = 24, ground_height = 18;

const char* marks_of(std::string_view method) {
  for (const auto& [id, marks] : emblems)
    if (id == method) return marks;
  return nullptr;
}

class Painter {
 public:
  Painter(Canvas& canvas, const Theme& theme)
      : canvas_(canvas),
        theme_(theme),
        scale_(std::min(canvas.width() / ground_width, canvas.height() / ground_height)) {
    canvas_.fill(to_pixel(theme_.pane));
  }

  void paint(char what, const std::vector<double>& numbers) {
    if (what == 'p' || what == 'b') return dot(what, numbers);
    std::vector<glm::dvec2> points;
    for (std::size_t k = 0; k + 1 < numbers.size(); k += 2)
      points.push_back(glm::dvec2(numbers[k], numbers[k + 1]) * scale_);
    switch (what) {
      case 'l':
        return lines(points, theme_.text, 1.3);
      case 'm':
        return lines(points, theme_.rule, 1);
      case 'n':
        return lines(points, theme_.now, 1.8);
      case 'd':
        return dashes(points);
      default:
        break;
    }
    fill(points, fill_of(what));
    if (what == 'O' || what == 'S') return;
    points.push_back(points.front());
    lines(points, theme_.text, 1);
  }

 private:
  Pixel32 fill_of(char what) const {
    const Pixel32 orange = opaque(scene::palette[0]), sky = opaque(scene::palette[1]);
    if (what == 'o' || what == 'O') return orange;
    if (what == 's' || what == 'S') return sky;
    return what == 'x' ? mixed(orange, sky, 128) : to_pixel(theme_.rule);
  }

  /// The pixels whose centres it has.
  void fill(const std::vector<glm::dvec2>& outline, Pixel32 color) {
    for (int y = 0; y < canvas_.height(); ++y) {
      std::vector<double> crossings;
      for (std::size_t k = 0; k < outline.size(); ++k) {
        const glm::dvec2 a = outline[k], b = outline[(k + 1) % outline.size()];
        if ((a.y <= y + 0.5) != (b.y <= y + 0.5))
          crossings.push_back(a.x + (y + 0.5 - a.y) / (b.y - a.y) * (b.x - a.x));
      }
      std::sort(crossings.begin(), crossings.end());
      const auto column = [](double x) { return static_cast<int>(std::ceil(x - 0.5)); };
      for (std::size_t k = 0; k + 1 < crossings.size(); k += 2)
        canvas_.rectangle(column(crossings[k]), y, column(crossings[k + 1]), y + 1, color);
    }
  }

  void lines(const std::vector<glm::dvec2>& points, ImU32 color, double thickness) {
    for (std::size_t k = 1; k < points.size(); ++k)
      canvas_.line(points[k - 1].x, points[k - 1].y, points[k].x, points[k].y, thickness, to_pixel(color));
  }

  void dashes(const std::vector<glm::dvec2>& points) {
    constexpr int parts = 7;  // every second is drawn
    const auto at = [&](int k) { return points[0] + (points[1] - points[0]) * (static_cast<double>(k) / parts); };
    for (int k = 0; k < parts; k += 2) lines({at(k), at(k + 1)}, theme_.text, 1);
  }

  void dot(char what, const std::vector<double>& numbers) {
    const double x = numbers[0] * scale_, y = numbers[1] * scale_, radius = numbers[2] * scale_;
    canvas_.mark(x, y, radius, 0, to_pixel(theme_.text));
    if (what == 'b') canvas_.mark(x, y, radius - 1, 0, fill_of('o'));
  }

  Canvas& canvas_;
  const Theme& theme_;
  double scale_;
};

}  // namespace

bool has_emblem(std::string_view method) { return marks_of(method) != nullptr; }

void paint_emblem(Canvas& canvas, const std::string& method, const Theme& theme) {
  Painter painter(canvas, theme);
  const char* const marks = marks_of(method);
  std::istringstream in(marks ? marks : "");
  in.imbue(std::locale::classic());
  for (std::string mark; std::getline(in, mark, '/');) {
    std::istringstream words(mark);
    words.imbue(std::locale::classic());
    char what = 0;
    words >> what;
    std::vector<double> numbers;
    for (double number = 0; words >> number;) numbers.push_back(number);
    painter.paint(what, numbers);
  }
}

}  // namespace zstep::viewer
