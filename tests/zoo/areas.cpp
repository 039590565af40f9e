// Warnock: what is simple in an area is drawn, and what is not is left to the area's four quarters.
#include "tests/zoo/pieces.hpp"

namespace zoo {
namespace {

struct Quad {
  int x_0, y_0, x_1, y_1;  // without x_1 and y_1
};

struct Quartering {
  const Task& task;
  Output out{};
  PieceTable table{task, out};
  int areas = 0;

  bool is(const char* mistake) const { return task.mistake == mistake; }

  /// Does an edge meet the rectangle? Liang and Barsky: is anything of it left between the four sides?
  static bool meets(Point a, Point b, Point low, Point high) {
    double from = 0, to = 1;
    const auto keep = [&](double start, double along, double least, double most) {
      if (along == 0) return least <= start && start <= most;
      const double t_0 = (least - start) / along, t_1 = (most - start) / along;
      from = std::max(from, std::min(t_0, t_1)), to = std::min(to, std::max(t_0, t_1));
      return from <= to;
    };
    return keep(a.x, b.x - a.x, low.x, high.x) && keep(a.y, b.y - a.y, low.y, high.y);
  }

  const char* bin_of(int number, Quad area) {
    const FlatPiece& piece = table[number];
    const Point low{area.x_0 - 0.5, area.y_0 - 0.5, 0}, high{area.x_1 - 0.5, area.y_1 - 0.5, 0};
    int met = 0, corners = 0;
    bool all_inside = true;
    for (std::size_t i = 0; i < piece.corners.size(); ++i) {
      const Point p = table.corner(piece, i);
      met += meets(p, table.corner(piece, i + 1), low, high);
      all_inside = all_inside && low.x <= p.x && p.x <= high.x && low.y <= p.y && p.y <= high.y;
    }
    for (const double x : {low.x, high.x})
      for (const double y : {low.y, high.y}) corners += table.covers(piece, x, y);
    const char* bin = met == 0 ? (corners > 0 ? "surrounding" : "disjoint") : all_inside ? "contained" : "intersecting";
    if (met == 0) corners = corners > 0 ? 4 : 0;
    out.print(bin, "piece", number, "crossings", met, "corners_inside", corners, "bin", bin, "by_box", false);
    return bin;
  }

  void decide(const char* what, int area, int piece) { out.print(what, "area", area, "what", what, "piece", piece); }
  void fill(Quad area, int piece) {
    for (int y = area.y_0; y < area.y_1; ++y)
      for (int x = area.x_0; x < area.x_1; ++x) table.paint(table[piece], x, y);
  }

  int nearest_at(int x, int y, const std::vector<int>& candidates) {
    int best = -1;
    for (const int piece : candidates) {
      if (!table.covers(table[piece], x, y)) continue;
      const double z = table[piece].depth(x, y);
      out.print("center_depth", "piece", piece, "x_at", static_cast<double>(x), "y_at", static_cast<double>(y), "z", z);
      if (best < 0 || in_front(z, piece, table[best].depth(x, y), best)) best = piece;
    }
    return best;
  }
  static bool in_front(double z, int piece, double other, int other_piece) {
    return std::abs(z - other) > 1e-12 ? z < other : piece < other_piece;
  }

  /// The surrounding polygon that is in front of all others at the area's four corners; -1 for none.
  int front_of(Quad area, const std::vector<int>& around, const std::vector<int>& partly) {
    if (around.empty()) return -1;
    const double left = area.x_0 - 0.5, right = area.x_1 - 0.5, top = area.y_0 - 0.5, bottom = area.y_1 - 0.5;
    const Point corners[] = {{left, top, 0}, {right, top, 0}, {left, bottom, 0}, {right, bottom, 0}};
    const auto print = [&](int piece) {
      for (const Point& at : corners)
        out.print("corner_depth", "piece", piece, "x_at", at.x, "y_at", at.y, "z", table[piece].depth(at.x, at.y));
    };
    const auto hides = [&](int front, int piece) {
      return std::all_of(std::begin(corners), std::end(corners), [&](Point at) {
        return in_front(table[front].depth(at.x, at.y), front, table[piece].depth(at.x, at.y), piece);
      });
    };
    int front = around[0];
    for (const int piece : around) {
      print(piece);
      if (in_front(table[piece].depth(left, top), piece, table[front].depth(left, top), front)) front = piece;
    }
    for (const int piece : around)
      if (piece != front && !hides(front, piece)) return -1;
    for (const int piece : partly) {
      print(piece);
      if (!hides(front, piece)) return -1;
    }
    return front;
  }

  void settle(Quad area, int parent, const std::vector<int>& open, std::vector<int> around) {
    const int number = areas++;
    out.print("area", "area", number, "parent", parent, "first_column", area.x_0, "first_row", area.y_0, "end_column",
              area.x_1, "end_row", area.y_1);
    for (const int piece : around)
      out.print("still_surrounding", "piece", piece, "crossings", 0, "corners_inside", 4, "bin", "surrounding",
                "by_box", false);
    std::vector<int> partly;
    for (const int piece : open) {
      const std::string bin = bin_of(piece, area);
      if (bin == "surrounding") around.push_back(piece);
      else if (bin != "disjoint") partly.push_back(piece);
    }
    const int columns = area.x_1 - area.x_0, rows = area.y_1 - area.y_0;
    const int last = is("stops_one_early") ? 2 : 1;  // an area of 2 x 2 pixels is taken for one
    if (around.empty() && partly.empty()) return decide("background", number, -1);
    if (around.empty() && partly.size() == 1) {
      decide("one_polygon", number, partly[0]);
      return table.paint(table[partly[0]], area.x_0, area.y_0, area.x_1, area.y_1);
    }
    if (around.size() == 1 && partly.empty()) return decide("surrounded", number, around[0]), fill(area, around[0]);
    if (is("surrounding_unchecked") && !around.empty())  // it is drawn, whatever lies before it
      return decide("front_surrounder", number, around[0]), fill(area, around[0]);
    if (columns <= last && rows <= last) {
      std::vector<int> all = around;
      all.insert(all.end(), partly.begin(), partly.end());
      const int best = nearest_at(area.x_0, area.y_0, all);
      decide("pixel", number, best);
      if (best >= 0) fill(area, best);
      return;
    }
    if (const int front = front_of(area, around, partly); front >= 0)
      return decide("front_surrounder", number, front), fill(area, front);
    decide("subdivide", number, -1);
    const int x = area.x_0 + columns / 2, y = area.y_0 + rows / 2;
    const int over = is("quarters_overlap") && columns > 2 && rows > 2;  // the first halves reach into the second ones
    for (const Quad quarter : {Quad{area.x_0, area.y_0, x + over, y + over}, Quad{x, area.y_0, area.x_1, y + over},
                               Quad{area.x_0, y, x + over, area.y_1}, Quad{x, y, area.x_1, area.y_1}})
      if (quarter.x_0 < quarter.x_1 && quarter.y_0 < quarter.y_1) settle(quarter, number, partly, around);
  }
};

}  // namespace

std::string areas(const Task& task) {
  Quartering work{task};
  work.out.print("clear", "z", INFINITY);
  work.table.gather("outline");
  std::vector<int> all;
  for (std::size_t i = 0; i < work.table.pieces.size(); ++i) all.push_back(static_cast<int>(i));
  work.settle({0, 0, task.width, task.height}, -1, all, {});
  return work.out.text;
}

}  // namespace zoo
