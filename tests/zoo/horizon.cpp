// The floating horizon: curves from the nearest to the farthest, and for each column how far up and how far down
// something was drawn.
#include <algorithm>

#include "tests/zoo/tools.hpp"

namespace zoo {
namespace {

struct CurveAt {
  double x, y, upper, lower;
  std::string verdict;
};

struct HorizonPlotter {
  const Task& task;
  Output out{};
  std::vector<Point> screen{};
  std::vector<double> upper{}, lower{};
  int dot_x = -1, dot_y = -1;  // the pixel of this curve that was drawn last

  bool is(const char* mistake) const { return task.mistake == mistake; }

  void clear_horizons() {
    upper.assign(static_cast<std::size_t>(task.width), INFINITY);
    lower.assign(static_cast<std::size_t>(task.width), -INFINITY);
    for (int x = 0; x < task.width; ++x) {
      out.print("clear_horizons", "x", x, "upper", true, "y_curve", INFINITY);
      out.print("clear_horizons", "x", x, "upper", false, "y_curve", -INFINITY);
    }
  }

  /// Where the curve goes through a horizon between two columns.
  Point cross(const CurveAt& from, const CurveAt& to, const std::string& which, Point without) {
    const bool up = which == "above";
    const double d_0 = from.y - (up ? from.upper : from.lower), d_1 = to.y - (up ? to.upper : to.lower);
    double t = d_0 / (d_0 - d_1);
    if (!std::isfinite(d_0) || !std::isfinite(d_1) || !(t >= 0 && t <= 1)) return without;
    if (is("crossing_from_end")) t = d_1 / (d_1 - d_0);
    const Point at{from.x + t * (to.x - from.x), from.y + t * (to.y - from.y), 0};
    out.print("cross", "upper", up, "x_at", at.x, "y_at", at.y);
    return at;
  }

  /// A pixel a column or a row, whichever are more.
  void draw(Point from, Point to, const std::string& which) {
    const double x = to.x - from.x, y = to.y - from.y;
    const int steps = static_cast<int>(std::ceil(std::max(std::abs(x), std::abs(y))));
    for (int i = 0; i <= steps; ++i) {
      const double t = steps > 0 ? static_cast<double>(i) / steps : 0;
      const int column = static_cast<int>(std::floor(from.x + x * t + 0.5)),
                row = static_cast<int>(std::floor(from.y + y * t + 0.5));
      if (column == dot_x && row == dot_y) continue;
      dot_x = column, dot_y = row;
      if (column < 0 || column >= task.width || row < 0 || row >= task.height) continue;
      const bool black = which == "above" || is("one_ink");
      out.print("draw", "x", column, "y", row, "r8", black ? 0 : 213, "g8", black ? 0 : 94, "b8", 0);
    }
  }
  /// What is visible between two columns: of a part that begins or ends there, up to where it crosses the horizon.
  void draw_between(const CurveAt& from, const CurveAt& to) {
    const Point begin{from.x, from.y, 0}, end{to.x, to.y, 0};
    if (from.verdict == to.verdict) {
      if (to.verdict != "hidden" || is("hidden_drawn")) draw(begin, end, to.verdict);
      return;
    }
    if (from.verdict != "hidden") draw(begin, cross(from, to, from.verdict, begin), from.verdict);
    if (to.verdict != "hidden") draw(cross(from, to, to.verdict, end), end, to.verdict);
  }

  void pass(int x, double y, std::vector<CurveAt>& passed) {
    double &up = upper[static_cast<std::size_t>(x)], &down = lower[static_cast<std::size_t>(x)];
    const bool below = y >= down && !is("only_upper");  // what comes out below is never looked for
    CurveAt here{static_cast<double>(x), y, up, down, y <= up ? "above" : below ? "below" : "hidden"};
    out.print("test", "x", x, "y_curve", y, "verdict", here.verdict.c_str());
    draw_between(passed.empty() ? here : passed.back(), here);
    passed.push_back(here);
    if (here.verdict == "hidden") return;
    if (y < up) {
      up = y;
      out.print("move", "x", x, "upper", true, "y_curve", y);
    }
    if (y > down && !is("only_upper") && !is("lower_never_moves")) {
      down = y;
      out.print("move", "x", x, "upper", false, "y_curve", y);
    }
  }

  void draw_curve(int first) {
    std::vector<CurveAt> passed;
    dot_x = dot_y = -1;
    for (int i = first; i + 1 < first + task.columns; ++i) {
      out.print("segment", "vertex_0", i, "vertex_1", i + 1);
      const Point a = screen[static_cast<std::size_t>(i)], b = screen[static_cast<std::size_t>(i) + 1];
      const int step = b.x >= a.x ? 1 : -1;
      int x = static_cast<int>(step > 0 ? std::ceil(a.x) : std::floor(a.x));
      if (x == a.x && !passed.empty()) x += step;  // that was the end of the segment before
      for (; (b.x - x) * step >= 0; x += step) {
        if (x < 0 || x >= task.width) continue;
        double y = a.y + (b.y - a.y) * (x - a.x) / (b.x - a.x);
        if (is("not_interpolated")) y = a.y;  // as high as the sample before
        pass(x, y, passed);
      }
    }
  }
};

}  // namespace

std::string horizon(const Task& task) {
  HorizonPlotter plotter{task};
  plotter.out.print("clear", "z", INFINITY);
  for (const Point& p : task.points)
    plotter.screen.push_back(see(task, plotter.out, static_cast<int>(plotter.screen.size()), p));
  plotter.clear_horizons();
  std::vector<int> rows;  // by their first point
  for (int first = 0; first < static_cast<int>(task.points.size()); first += task.columns) rows.push_back(first);
  const auto place = [&](int first) { return task.points[static_cast<std::size_t>(first)].y; };
  std::sort(rows.begin(), rows.end(), [&](int a, int b) {
    return std::abs(place(a) - task.camera.eye.y) < std::abs(place(b) - task.camera.eye.y);
  });
  if (plotter.is("farthest_first")) std::reverse(rows.begin(), rows.end());
  int curve = 0;
  for (const int first : rows) {
    plotter.out.print("curve", "curve", curve++, "row", first / task.columns, "across", false, "constant",
                      place(first));
    plotter.draw_curve(first);
  }
  return plotter.out.text;
}

}  // namespace zoo
