
#include "algorithms/warnock/warnock.hpp"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>

#include "algorithms/pieces/pieces.hpp"
#include "traces/record/all_recorders.hpp"
#include "traces/scene.hpp"

namespace zstep::warnock {

std::vector<Area> quarters(const Area& area) {
  const std::int32_t column = area.first_column + (area.end_column - area.first_column) / 2;
  const std::int32_t row = area.first_row + (area.end_row - area.first_row) / 2;
  std::vector<Area> parts{{area.first_column, area.first_row, column, row},
                          {column, area.first_row, area.end_column, row},
                          {area.first_column, row, column, area.end_row},
                          {column, row, area.end_column, area.end_row}};
  std::erase_if(parts, [](const Area& a) { return a.first_column == a.end_column || a.first_row == a.end_row; });
  return parts;
}

Shape::Shape(const std::vector<glm::dvec3>& corners) : low_(corners[0]), high_(corners[0]) {
  for (std::size_t i = 0; i < corners.size(); ++i) {
    edges_.push_back(formulas::Segment::between(corners[i], corners[i + 1 < corners.size() ? i + 1 : 0]));
    low_ = glm::min(low_, glm::dvec2(corners[i]));
    high_ = glm::max(high_, glm::dvec2(corners[i]));
  }
}

Shape::Judgement Shape::judge(const Area& area, bool boxes) const {
  const formulas::Rectangle rectangle = formulas::rectangle_of(area);
  if (boxes && rectangle.is_apart(low_, high_)) return {{Bin::disjoint, -1, -1}, true};
  if (boxes && rectangle.holds(low_) && rectangle.holds(high_)) return {{Bin::contained, -1, -1}, true};
  return {formulas::crossed_by(rectangle, edges_)};
}

void Shape::find_crossings(std::int32_t y, std::vector<double>& crossings) const {
  crossings.clear();
  for (const formulas::Segment& edge : edges_) {
    if (edge.meets_row(y)) crossings.push_back(edge.x_at(y));
  }
  std::sort(crossings.begin(), crossings.end());
}

namespace {

using Numbers = std::vector<std::int32_t>;  // of pieces, ascending

constexpr ByEnum<Bin, Step<AreaBin>> bin_steps{step::disjoint, step::intersecting, step::surrounding, step::contained};

// Is a depth of one piece in front of a depth of another? What is equal to twelve digits is decided by their order.
bool in_front(double z, std::int32_t piece, double z_other, std::int32_t other) {
  const bool equal = std::abs(z - z_other) <= 1e-12 * std::max({1.0, std::abs(z), std::abs(z_other)});
  return equal ? piece < other : z < z_other;
}

template <Recorder R>
class Subdivision {
 public:
  Subdivision(pieces::Pieces all, bool boxes, Picture& picture, R& record)
      : all_(std::move(all)), boxes_(boxes), picture_(picture), record_(record) {
    for (const pieces::Piece& piece : all_.pieces) shapes_.emplace_back(all_.corners(piece.outline));
  }

  // `open`: what may lie in the area any way; `surrounding`: what is known to surround it.
  void settle(const Area& area, std::int32_t parent, const Numbers& open, Numbers surrounding) {
    const std::int32_t number = areas_++;
    record_(step::area, AreaBegin{number, parent, area.first_column, area.first_row, area.end_column, area.end_row});
    const auto known = static_cast<std::int32_t>(shapes_.size() - open.size());
    if (known > 0) {
      record_(step::known, Saved{Coherence::area, known});
    }
    for (const std::int32_t piece : surrounding) {
      record_(step::still_surrounding, AreaBin{piece, 0, 4, Bin::surrounding, false});
    }
    Numbers partly;  // those that intersect the area or are contained in it
    for (const std::int32_t piece : open) {
      const Bin bin = find_bin(piece, area);
      if (bin == Bin::surrounding) surrounding.push_back(piece);
      if (bin == Bin::intersecting || bin == Bin::contained) partly.push_back(piece);
    }

    if (surrounding.empty() && partly.empty()) {
      record_(step::background, AreaDecide{number, AreaCase::background, -1});
    } else if (surrounding.empty() && partly.size() == 1) {
      record_(step::one_polygon, AreaDecide{number, AreaCase::one_polygon, partly[0]});
      fill_part(area, partly[0]);
    } else if (surrounding.size() == 1 && partly.empty()) {
      record_(step::surrounded, AreaDecide{number, AreaCase::surrounded, surrounding[0]});
      fill(area, surrounding[0]);
    } else if (area.is_pixel()) {
      const std::int32_t piece = nearest_at_center(area, surrounding, partly);
      record_(step::pixel, AreaDecide{number, AreaCase::pixel, piece});
      if (piece != -1) paint(area.first_column, area.first_row, piece);
    } else if (const std::int32_t piece = front_surrounder(area, surrounding, partly); piece != -1) {
      record_(step::front_surrounder, AreaDecide{number, AreaCase::front_surrounder, piece});
      fill(area, piece);
    } else {
      record_(step::subdivide, AreaDecide{number, AreaCase::subdivide, -1});
      for (const Area& quarter : quarters(area)) settle(quarter, number, partly, surrounding);
    }
  }

 private:
  Bin find_bin(std::int32_t piece, const Area& area) {
    const Shape& shape = shape_of(piece);
    const Shape::Judgement judged = shape.judge(area, boxes_);
    if (judged.by_box) {
      record_(step::boxed, Saved{Coherence::extent, shape.edge_count()});
    }
    const Step<AreaBin> bin_step = bin_steps[judged.bin];
    record_(bin_step, AreaBin{piece, judged.crossings, judged.corners_inside, judged.bin, judged.by_box});
    return judged.bin;
  }

  // Departure from 002: at the pixel's centre, not the polygon's. What does not cover the centre is not there.
  std::int32_t nearest_at_center(const Area& pixel, const Numbers& surrounding, const Numbers& partly) {
    const std::int32_t x = pixel.first_column, y = pixel.first_row;
    std::int32_t nearest = -1;
    double z_nearest = no_depth;
    for (const Numbers* list : {&surrounding, &partly}) {
      for (const std::int32_t piece : *list) {
        if (!shape_of(piece).covers(x, y)) continue;
        const double z = all_[piece].plane.depth(x, y);
        record_(step::center_depth, PlaneDepth{piece, static_cast<double>(x), static_cast<double>(y), z});
        if (nearest != -1 && !in_front(z, piece, z_nearest, nearest)) continue;
        nearest = piece;
        z_nearest = z;
      }
    }
    return nearest;
  }

  using Depths = std::array<double, 4>;
  Depths corner_depths(const Area& area, std::int32_t piece) {
    const auto [low, high] = formulas::rectangle_of(area);
    const glm::dvec2 corners[] = {low, {high.x, low.y}, {low.x, high.y}, high};
    Depths depths{};
    for (std::size_t i = 0; i < 4; ++i) {
      depths[i] = all_[piece].plane.depth(corners[i].x, corners[i].y);
      record_(step::corner_depth, PlaneDepth{piece, corners[i].x, corners[i].y, depths[i]});
    }
    return depths;
  }

  // The surrounding piece that is in front of all others at all four corners, -1 if none is. Planes are compared, so
  // what only intersects the area is taken to reach its corners: that is sufficient, not necessary.
  std::int32_t front_surrounder(const Area& area, const Numbers& surrounding, const Numbers& partly) {
    std::int32_t front = -1;
    Depths z{};
    const auto hides = [&](std::int32_t other, const Depths& z_other) {
      for (std::size_t i = 0; i < 4; ++i) {
        if (!in_front(z[i], front, z_other[i], other)) return false;
      }
      return true;
    };
    std::vector<Depths> depths;
    for (const std::int32_t piece : surrounding) {
      depths.push_back(corner_depths(area, piece));
      if (front == -1 || in_front(depths.back()[0], piece, z[0], front)) front = piece, z = depths.back();
    }
    for (std::size_t i = 0; i < surrounding.size(); ++i) {
      if (surrounding[i] != front && !hides(surrounding[i], depths[i])) return -1;
    }
    if (front == -1) return -1;
    for (const std::int32_t piece : partly) {
      if (!hides(piece, corner_depths(area, piece))) return -1;
    }
    return front;
  }

  void paint(std::int32_t x, std::int32_t y, std::int32_t piece) {
    const std::int32_t polygon = all_[piece].polygon;
    const double z = all_[piece].plane.depth(x, y);
    picture_.polygon[picture_.at(x, y)] = polygon;
    picture_.depth[picture_.at(x, y)] = z;
    record_(step::paint, PixelPaint{x, y, z, polygon});
  }

  void fill(const Area& area, std::int32_t piece) {
    for (std::int32_t y = area.first_row; y < area.end_row; ++y) {
      for (std::int32_t x = area.first_column; x < area.end_column; ++x) paint(x, y, piece);
    }
  }

  void fill_part(const Area& area, std::int32_t piece) {
    std::vector<double> crossings;
    for (std::int32_t y = area.first_row; y < area.end_row; ++y) {
      shape_of(piece).find_crossings(y, crossings);
      std::size_t passed = 0;
      for (std::int32_t x = area.first_column; x < area.end_column; ++x) {
        while (passed < crossings.size() && crossings[passed] <= x) ++passed;
        if (passed % 2 == 1) paint(x, y, piece);
      }
    }
  }

  const Shape& shape_of(std::int32_t piece) const { return shapes_[piece]; }

  pieces::Pieces all_;
  std::vector<Shape> shapes_;
  bool boxes_;
  Picture& picture_;
  R& record_;
  std::int32_t areas_ = 0;
};

}  // namespace

template <Recorder R>
Picture run(const Scene& scene, const Conventions& conventions, R& record) {
  Picture picture(scene.raster.width, scene.raster.height);
  record(step::clear, BuffersClear{no_depth});

  pieces::Pieces all = pieces::gather(scene, conventions, record);
  Numbers open(all.pieces.size());
  for (std::size_t i = 0; i < open.size(); ++i) open[i] = index32(i);

  Subdivision work(std::move(all), is_on(options, conventions, "boxes"), picture, record);
  work.settle({0, 0, scene.raster.width, scene.raster.height}, -1, open, {});
  return picture;
}

#define INSTANTIATE(R) template Picture run<R>(const Scene&, const Conventions&, R&);
ZSTEP_FOR_EACH_RECORDER(INSTANTIATE)
#undef INSTANTIATE

}  // namespace zstep::warnock
