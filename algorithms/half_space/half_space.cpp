#include "algorithms/half_space/half_space.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "algorithms/half_space/triangles.hpp"
#include "algorithms/viewing/clip.hpp"
#include "traces/error.hpp"
#include "traces/formulas/attributes.hpp"
#include "traces/formulas/edge_functions.hpp"
#include "traces/formulas/fill.hpp"
#include "traces/formulas/samples.hpp"
#include "traces/math/whole.hpp"
#include "traces/record/all_recorders.hpp"

namespace zstep::half_space {

namespace {

using formulas::tile_side;
using formulas::tile_start;
using scan_conversion::NumbersOf;

/// Pixels, the ends just beyond.
struct Box {
  std::int32_t first_column = 0, first_row = 0, end_column = 0, end_row = 0;
};

template <class T>
struct Edge {
  T a, b, x, y;  ///< (x, y): its end with the smaller y
  bool owns;

  T at(std::int32_t column, std::int32_t row) const { return formulas::edge_value(a, b, T(column), x, T(row), y); }
  T stepped(std::int32_t column, std::int32_t row) const {
    return formulas::edge_value_stepped(a, b, column, x, row, y);
  }
  T beside(const T& value, double dx, double dy) const {
    return formulas::edge_value_beside(value, a, static_cast<T>(dx), b, static_cast<T>(dy));
  }
  bool covers(const T& value) const { return formulas::is_on_side(value, owns); }
};

/// The values of the three edge functions at a pixel's centre.
template <class T>
using Values = std::array<T, 3>;

template <class T>
struct Triangle {
  Corners corners;
  T twice_area;
  Box box;
  std::array<Edge<T>, 3> edges;
  std::array<T, 3> z;  ///< what is interpolated to depths

  bool covers(const Values<T>& e) const {
    return edges[0].covers(e[0]) && edges[1].covers(e[1]) && edges[2].covers(e[2]);
  }
  Values<T> beside(const Values<T>& e, double dx, double dy) const {
    return {edges[0].beside(e[0], dx, dy), edges[1].beside(e[1], dx, dy), edges[2].beside(e[2], dx, dy)};
  }
  T by_weights(const Values<T>& w, const Values<T>& p) const {
    return formulas::by_weights(p[0], w[1], p[1], w[2], p[2]);
  }
};

/// Goes through pixels from left to right, line by line, with the values of a triangle's edge functions.
template <class T>
class EdgeWalk {
 public:
  EdgeWalk(const Triangle<T>& triangle, Stepping stepping) : triangle_(triangle), stepping_(stepping) {}

  Values<T> at(std::int32_t x, std::int32_t y) const {
    Values<T> e;
    for (std::size_t i = 0; i < 3; ++i)
      e[i] = stepping_ == Stepping::products ? triangle_.edges[i].at(x, y) : triangle_.edges[i].stepped(x, y);
    return e;
  }
  /// The same of the pixel right of the last one that was asked for on its line, or of the first one.
  const Values<T>& next(std::int32_t x, std::int32_t y, bool first) {
    if (stepping_ == Stepping::products || first || x == tile_start(x)) return e_ = at(x, y);
    for (std::size_t i = 0; i < 3; ++i) e_[i] = e_[i] + triangle_.edges[i].a;
    return e_;
  }

 private:
  const Triangle<T>& triangle_;
  Stepping stepping_;
  Values<T> e_{};
};

template <class T, Recorder R>
class Drawing {
 public:
  Drawing(const Scene& scene, const Conventions& conventions, const viewing::Vertices& vertices, Picture& picture,
          R& record)
      : scene_(scene),
        vertices_(vertices),
        picture_(picture),
        record_(record),
        stepping_(choice_of<Stepping>(options, conventions, "stepping")),
        tiles_(is_on(options, conventions, "tiles")),
        hierarchical_(is_on(options, conventions, "hierarchical-z")),
        corrected_(conventions.depth == Conventions::Depth::corrected),
        shades_(conventions.attribute != Conventions::Attribute::none),
        divides_(formulas::attribute_over_depth(scene, conventions)),
        shading_(formulas::shading_of(scene, conventions)),
        comparison_(interpolation::comparison_of(conventions)),
        non_zero_(formulas::fills_non_zero(conventions)),
        offsets_(formulas::samples_of(conventions)),
        masks_(formulas::keeps_masks(conventions)),
        reach_(formulas::reach_of(conventions)) {
    samples_.resize(picture.depth.size() * offsets_.size(),
                    {no_polygon, interpolation::initial_depth(scene, conventions)});
    if (masks_) lists_.resize(picture.depth.size());
  }

  void draw(const Facet& facet, std::int32_t number, const clipping::Outline& outline) {
    polygon_ = facet.polygon, facet_ = number;
    const std::vector<Corners>& triangles = triangulation_.cut(outline, vertices_);
    if (triangulation_.may_overlap()) count_covers(triangles);
    for (const Corners& corners : triangles) {
      const Triangle<T> triangle = set_up(corners);
      const auto [first_column, first_row, end_column, end_row] = triangle.box;
      const auto [v_0, v_1, v_2] = triangle.corners;
      record_(step::triangle,
              TriangleSetup{v_0, v_1, v_2, triangle.twice_area, first_column, first_row, end_column, end_row});
      if (triangle.twice_area == 0) continue;

      record_edges(triangle);
      if (tiles_ || hierarchical_) draw_tiles(triangle);
      else draw_box(triangle, triangle.box, true);
    }
  }

  /// The colour of each pixel of which not all samples show what its centre does.
  void mix_samples() {
    for (std::int32_t y = 0; y < picture_.height; ++y)
      for (std::int32_t x = 0; x < picture_.width; ++x) {
        const std::size_t pixel = picture_.at(x, y);
        const std::vector<formulas::PixelShare> shares = shares_at(pixel);
        if (shares.size() == 1 && shares[0].polygon == picture_.polygon[pixel]) continue;
        for (const formulas::PixelShare& share : shares)
          record_(step::share, CoverageAdd{x, y, share.polygon, share.share});
        const Color color = formulas::mixed(scene_, shares);
        picture_.ink[pixel] = ink_of(color);
        record_(step::mix, ColorWrite{x, y, color.red, color.green, color.blue});
      }
  }

 private:
  using SampleOffset = formulas::SampleOffset;

  glm::dvec3 raster(std::int32_t vertex) const { return vertices_[vertex].raster; }
  T position(double x) const { return NumbersOf<T>{}.position(x); }
  bool nearer(double z, double other) const { return comparison_.wins(z, other); }
  bool greater() const { return comparison_.nearer == Comparison::Nearer::greater; }
  T depth_of(const T& along) const { return corrected_ ? T(1) / along : along; }

  Triangle<T> set_up(Corners corners) const {
    const auto area = [&] {
      const glm::dvec3 p = raster(corners[0]), q = raster(corners[1]), r = raster(corners[2]);
      return formulas::twice_area(position(p.x), position(p.y), position(q.x), position(q.y), position(r.x),
                                  position(r.y));
    };
    if (area() < 0) std::swap(corners[1], corners[2]);
    Triangle<T> triangle{corners, area(), {}, {}, {}};
    double left = 1e300, right = -1e300, top = 1e300, bottom = -1e300;
    for (std::size_t i = 0; i < 3; ++i) {
      const glm::dvec3 own = raster(corners[i]), from = raster(corners[(i + 1) % 3]), to = raster(corners[(i + 2) % 3]);
      const T x_0 = position(from.x), y_0 = position(from.y), x_1 = position(to.x), y_1 = position(to.y);
      const bool first = formulas::is_first_end(x_0, y_0, x_1, y_1);
      triangle.edges[i] = {y_0 - y_1, x_1 - x_0, first ? x_0 : x_1, first ? y_0 : y_1, false};
      triangle.edges[i].owns = formulas::owns_line(triangle.edges[i].a, triangle.edges[i].b);
      triangle.z[i] = NumbersOf<T>{}.depth(own.z);
      left = std::min<double>(left, position(own.x)), right = std::max<double>(right, position(own.x));
      top = std::min<double>(top, position(own.y)), bottom = std::max<double>(bottom, position(own.y));
    }
    const std::int32_t width = scene_.raster.width, height = scene_.raster.height;
    triangle.box = {formulas::box_first(left - reach_, width), formulas::box_first(top - reach_, height),
                    formulas::box_end(right + reach_, width), formulas::box_end(bottom + reach_, height)};
    return triangle;
  }

  void record_edges(const Triangle<T>& triangle) {
    for (std::size_t i = 0; i < 3; ++i) {
      const Edge<T>& edge = triangle.edges[i];
      const std::int32_t from = triangle.corners[(i + 1) % 3], to = triangle.corners[(i + 2) % 3];
      const T c = formulas::edge_constant(edge.a, edge.b, edge.x, edge.y);
      record_(step::edge, EdgeFunction{index32(i), from, to, edge.a, edge.b, c, edge.owns});
    }
  }

  /// How often the triangles that cover each pixel's centre go round it, and after that each of its samples.
  void count_covers(const std::vector<Corners>& triangles) {
    covers_.assign(picture_.depth.size() * (1 + offsets_.size()), 0);
    for (const Corners& corners : triangles) {
      const Triangle<T> triangle = set_up(corners);
      if (triangle.twice_area == 0) continue;
      const std::int32_t way = triangle.corners == corners ? 1 : -1;  // else it was turned round
      EdgeWalk<T> walk(triangle, stepping_);
      for (std::int32_t y = triangle.box.first_row; y < triangle.box.end_row; ++y)
        for (std::int32_t x = triangle.box.first_column; x < triangle.box.end_column; ++x) {
          const Values<T>& e = walk.next(x, y, x == triangle.box.first_column);
          std::int32_t* covers = &covers_[picture_.at(x, y) * (1 + offsets_.size())];
          if (triangle.covers(e)) *covers += way;
          ++covers;
          for (const SampleOffset& at : offsets_) {
            if (triangle.covers(triangle.beside(e, at.dx(), at.dy()))) *covers += way;
            ++covers;
          }
        }
    }
  }
  /// The first of the triangles that cover a pixel's centre, number 0, or a sample, draws it, where it is inside.
  bool is_drawn(std::size_t pixel, std::size_t number) {
    return !triangulation_.may_overlap() ||
           formulas::is_inside(non_zero_, std::exchange(covers_[pixel * (1 + offsets_.size()) + number], 0));
  }

  // Early accept and early reject.

  TileCover cover(const Triangle<T>& triangle, const Box& tile) const {
    bool inside = true;
    for (std::size_t i = 0; i < 3; ++i) {
      const Edge<T>& edge = triangle.edges[i];
      const std::int32_t left = tile.first_column, right = tile.end_column - 1, top = tile.first_row,
                         bottom = tile.end_row - 1;
      const auto value = [&](bool to_the_right, bool down) {
        const std::int32_t x = to_the_right ? right : left, y = down ? bottom : top;
        return stepping_ == Stepping::products ? edge.at(x, y) : edge.stepped(x, y);
      };
      if (!edge.covers(value(edge.a > 0, edge.b > 0))) return TileCover::outside;
      inside = inside && edge.covers(value(!(edge.a > 0), !(edge.b > 0)));
    }
    return inside ? TileCover::inside : TileCover::partly;
  }

  /// The nearest depth that the triangle can have in a tile.
  T nearest_in(const Triangle<T>& triangle, const Box& tile) const {
    const EdgeWalk<T> walk(triangle, stepping_);
    const bool greatest = greater() != corrected_;
    const auto nearest = [&](const T& one, const T& other) {
      return greatest ? std::max(one, other) : std::min(one, other);
    };
    std::optional<T> at_corners;
    for (const std::int32_t y : {tile.first_row, tile.end_row - 1})
      for (const std::int32_t x : {tile.first_column, tile.end_column - 1}) {
        const T along = triangle.by_weights(weights(triangle, walk.at(x, y)), triangle.z);
        at_corners = at_corners ? nearest(*at_corners, along) : along;
      }
    const T at_vertices = nearest(nearest(triangle.z[0], triangle.z[1]), triangle.z[2]);
    return depth_of(greatest ? std::min(*at_corners, at_vertices) : std::max(*at_corners, at_vertices));
  }
  /// The farthest depth that is stored in the whole tile.
  double farthest_in(const Box& tile) const {
    const std::int32_t left = tile_start(tile.first_column), top = tile_start(tile.first_row);
    double farthest = picture_.depth[picture_.at(left, top)];
    for (std::int32_t y = top; y < std::min(picture_.height, top + tile_side); ++y)
      for (std::int32_t x = left; x < std::min(picture_.width, left + tile_side); ++x)
        if (const double stored = picture_.depth[picture_.at(x, y)]; comparison_.behind(farthest, stored) < 0)
          farthest = stored;
    return farthest;
  }

  void draw_tiles(const Triangle<T>& triangle) {
    const Box& box = triangle.box;
    for (std::int32_t top = tile_start(box.first_row); top < box.end_row; top += tile_side)
      for (std::int32_t left = tile_start(box.first_column); left < box.end_column; left += tile_side)
        draw_tile(triangle, {std::max(left, box.first_column), std::max(top, box.first_row),
                             std::min(left + tile_side, box.end_column), std::min(top + tile_side, box.end_row)});
  }

  void draw_tile(const Triangle<T>& triangle, const Box& tile) {
    const auto [first_column, first_row, end_column, end_row] = tile;
    TileCover found = TileCover::partly;
    if (tiles_) {
      found = cover(triangle, tile);
      record_(step::tile, TileTest{first_column, first_row, end_column, end_row, found});
      if (found == TileCover::outside) return;
    }
    if (hierarchical_) {
      const double nearest = nearest_in(triangle, tile), farthest = farthest_in(tile);
      const bool may_be_seen = nearer(nearest, farthest);
      record_(step::tile_depth,
              TileDepthTest{first_column, first_row, end_column, end_row, nearest, farthest, may_be_seen});
      if (!may_be_seen) return;
    }
    draw_box(triangle, tile, found == TileCover::partly);
  }

  void draw_box(const Triangle<T>& triangle, const Box& box, bool tests) {
    EdgeWalk<T> walk(triangle, stepping_);
    for (std::int32_t y = box.first_row; y < box.end_row; ++y) {
      for (std::int32_t x = box.first_column; x < box.end_column; ++x) {
        const Values<T>& e = walk.next(x, y, x == box.first_column);
        const bool inside = !tests || triangle.covers(e);
        if (tests) record_(step::test, InsideTest{x, y, e[0], e[1], e[2], inside});
        if (inside && is_drawn(picture_.at(x, y), 0)) draw_pixel(triangle, x, y, weights(triangle, e));
        if (!offsets_.empty()) draw_samples(triangle, x, y, e);
        if (masks_) keep_mask(triangle, x, y, e);
      }
    }
  }

  // Several samples a pixel.

  void draw_samples(const Triangle<T>& triangle, std::int32_t x, std::int32_t y, const Values<T>& centre) {
    const std::size_t pixel = picture_.at(x, y);
    for (std::size_t i = 0; i < offsets_.size(); ++i) {
      const std::int32_t number = index32(i);
      const Values<T> e = triangle.beside(centre, offsets_[i].dx(), offsets_[i].dy());
      const bool inside = triangle.covers(e);
      record_(step::sample, SampleTest{x, y, number, e[0], e[1], e[2], inside});
      if (!inside || !is_drawn(pixel, 1 + i)) continue;

      formulas::SampleRow& stored = samples_[pixel * offsets_.size() + i];
      const double z = depth_of(triangle.by_weights(weights(triangle, e), triangle.z));
      const bool wins = nearer(z, stored.z);
      record_(step::sample_depth, SampleDepth{x, y, number, z, wins});
      if (wins) stored = {polygon_, z};
    }
  }

  void keep_mask(const Triangle<T>& triangle, std::int32_t x, std::int32_t y, const Values<T>& centre) {
    std::uint32_t samples = 0;
    for (std::int32_t bit = 0; bit < formulas::mask_rows * formulas::mask_columns; ++bit) {
      const SampleOffset offset = formulas::mask_offset(bit);
      if (triangle.covers(triangle.beside(centre, offset.dx(), offset.dy()))) samples |= std::uint32_t{1} << bit;
    }
    if (samples == 0) return;
    const auto [dx, dy] = formulas::middle_of(samples);
    const double z = depth_of(triangle.by_weights(weights(triangle, triangle.beside(centre, dx, dy)), triangle.z));
    record_(step::mask, SampleMask{x, y, formulas::row_of(samples, 0), formulas::row_of(samples, 1),
                                   formulas::row_of(samples, 2), formulas::row_of(samples, 3), z});
    formulas::add_mask(lists_[picture_.at(x, y)], {polygon_, facet_, samples, z});
  }

  static Values<T> weights(const Triangle<T>& triangle, const Values<T>& e) {
    return {e[0] / triangle.twice_area, e[1] / triangle.twice_area, e[2] / triangle.twice_area};
  }

  void draw_pixel(const Triangle<T>& triangle, std::int32_t x, std::int32_t y, const Values<T>& w) {
    record_(step::weights, BarycentricWeights{x, y, w[0], w[1], w[2]});

    const double z = depth_of(triangle.by_weights(w, triangle.z));
    record_(z_buffer::step::interpolate_z, {x, y, z});

    const std::size_t pixel = picture_.at(x, y);
    const bool wins = nearer(z, picture_.depth[pixel]);
    record_(z_buffer::step::compare, {x, y, z, wins});
    if (!wins) return;

    picture_.depth[pixel] = z;
    record_(z_buffer::step::write_depth, {x, y, z});

    picture_.polygon[pixel] = polygon_;
    record_(z_buffer::step::write_pixel, {x, y, polygon_});
    if (shades_) shade(triangle, x, y, w);
  }

  /// The numbers of the attribute by the same weights: a/z_v and 1/z_v, or a itself, one after the other.
  void shade(const Triangle<T>& triangle, std::int32_t x, std::int32_t y, const Values<T>& w) {
    std::array<double, 3> values{};
    for (std::int32_t k = 0; k < shading_.components(); ++k) {
      Values<T> over_z, one_over_z;
      for (std::size_t i = 0; i < 3; ++i) {
        const glm::dvec3& view = vertices_[triangle.corners[i]].view;
        const T a = static_cast<T>(formulas::attribute_of(scene_, shading_, k, facet_, triangle.corners[i], view,
                                                          [&](std::int32_t point) { return vertices_[point].view; }));
        const auto over = divides_ ? formulas::over_depth(a, static_cast<T>(view.z)) : formulas::OverDepth<T>{a, T(1)};
        over_z[i] = over.over_z, one_over_z[i] = over.one_over_z;
      }
      const T above = triangle.by_weights(w, over_z), below = divides_ ? triangle.by_weights(w, one_over_z) : T(1);
      const T a = divides_ ? above / below : above;
      record_(interpolation::step::attribute, AttributeInterpolate{x, y, above, below, a});
      values[k] = a;
    }

    const Color ink = interpolation::shaded(scene_, shading_, polygon_, values);
    picture_.ink[picture_.at(x, y)] = ink_of(ink);
    record_(interpolation::step::shade, ColorWrite{x, y, ink.red, ink.green, ink.blue});
  }

  std::vector<formulas::PixelShare> shares_at(std::size_t pixel) const {
    if (masks_)
      return formulas::shares_of_masks(lists_[pixel], [&](double z, double other) { return nearer(z, other); });
    return formulas::shares_of_samples(offsets_.size(),
                                       [&](std::size_t i) { return samples_[pixel * offsets_.size() + i].polygon; });
  }

  const Scene& scene_;
  const viewing::Vertices& vertices_;
  Picture& picture_;
  R& record_;
  Stepping stepping_;
  bool tiles_, hierarchical_, corrected_, shades_, divides_;
  formulas::Shading shading_;
  Comparison comparison_;
  bool non_zero_;
  std::span<const SampleOffset> offsets_;
  bool masks_;
  double reach_;
  std::int32_t polygon_ = no_polygon, facet_ = -1;
  Triangulation triangulation_;
  std::vector<std::int32_t> covers_;                     ///< by pixel and in it by sample, where triangles may overlap
  std::vector<formulas::SampleRow> samples_;             ///< likewise
  std::vector<std::vector<formulas::PixelMask>> lists_;  ///< of the A-buffer, by pixel
};

template <class T, Recorder R>
Picture draw(const Scene& scene, const Conventions& conventions, R& record) {
  const Raster& raster = scene.raster;
  const double initial = interpolation::initial_depth(scene, conventions);

  Picture picture(raster.width, raster.height);
  for (double& depth : picture.depth) depth = initial;
  if (conventions.attribute != Conventions::Attribute::none || formulas::reach_of(conventions) > 0) picture.use_ink();
  record(z_buffer::step::clear, BuffersClear{initial});

  viewing::Lens lens(scene.camera, raster, conventions.depth);
  lens.positions = conventions.positions;
  viewing::Vertices vertices = viewing::view_vertices(scene, lens, record);

  clipping::Outline outline;
  Drawing<T, R> drawing(scene, conventions, vertices, picture, record);
  std::int32_t number = 0;
  for (const Facet& facet : scene.facets) {
    record(z_buffer::step::polygon, PolygonBegin{facet.polygon, number});
    ++number;

    vertices.resize(scene.points.size());  // without those that clipping made for the facet before
    const bool visible = clipping::find_outline(scene, facet, conventions.cull, lens, vertices, outline, record);
    if (visible) drawing.draw(facet, number - 1, outline);
  }
  if (formulas::reach_of(conventions) > 0) drawing.mix_samples();
  return picture;
}

}  // namespace

template <Recorder R>
Picture run(const Scene& scene, const Conventions& conventions, R& record) {
  if (conventions.number_format == NumberFormat::float32) return draw<float>(scene, conventions, record);
  return draw<double>(scene, conventions, record);
}

Page page_for(const Conventions& conventions) {
  Page lines = page();
  const bool samples = !formulas::samples_of(conventions).empty(), masks = formulas::keeps_masks(conventions);
  std::erase_if(lines, [&](const StepInfo& line) {
    if (line.id == step::sample.id || line.id == step::sample_depth.id) return !samples;
    if (line.id == step::mask.id) return !masks;
    return (line.id == step::share.id || line.id == step::mix.id) && !samples && !masks;
  });
  return interpolation::page_with(lines, conventions);
}

void check(const Conventions& c, const std::string&) {
  const auto refuse = [](const std::string& what, const char* why, const char* instead) {
    throw InputError(what, why, instead);
  };
  if (c.coverage != Conventions::Coverage::top_left)
    refuse("--coverage " + std::string(word_of(c.coverage)),
           "half-space covers by edge functions and the top-left rule", "give --coverage top-left, or use z-buffer");
  if (c.interpolation != Conventions::Interpolation::direct)
    refuse("--interpolation " + std::string(word_of(c.interpolation)),
           "half-space has no edges and spans to step along", "give --option stepping=increments, or use z-buffer");
  if (bits_of(c.number_format) > 0)
    refuse("--number-format " + std::string(word_of(c.number_format)), "half-space computes in floating point",
           "give --number-format float64 or float32, or use z-buffer");
  if (formulas::reach_of(c) == 0) return;
  const std::string samples = "--option samples=" + c.options.at("samples");
  for (const char* tiles : {"tiles", "hierarchical-z"})
    if (is_on(options, c, tiles))
      refuse(samples + " with " + tiles, "tiles are tested by the centres of their pixels",
             "give one of the two options");
  if (c.attribute != Conventions::Attribute::none)
    refuse(samples + " with --attribute " + std::string(word_of(c.attribute)),
           "samples take their polygon's one colour", "give one of the two");
}

void check(const Scene& scene, const Conventions& conventions) {
  const auto in_pixel = formulas::keeps_masks(conventions) ? std::int64_t{formulas::mask_rows} * formulas::mask_columns
                                                           : std::ssize(formulas::samples_of(conventions));
  const Raster& raster = scene.raster;
  if (in_pixel * raster.width * raster.height > most_pixels)
    throw InputError("--option samples=" + conventions.options.at("samples"),
                     fmt::format("{}x{} pixels with {} samples each are more than the {} that can be kept",
                                 raster.width, raster.height, in_pixel, most_pixels),
                     "give a smaller --size, or fewer samples");
}

#define INSTANTIATE(R) template Picture run<R>(const Scene&, const Conventions&, R&);
ZSTEP_FOR_EACH_RECORDER(INSTANTIATE)
#undef INSTANTIATE

}  // namespace zstep::half_space
