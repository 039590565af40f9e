
#include "algorithms/floating_horizon/floating_horizon.hpp"

#include <limits>
#include <utility>

#include "algorithms/floating_horizon/horizons.hpp"
#include "traces/formulas/of_curves.hpp"
#include "traces/record/all_recorders.hpp"

namespace zstep::floating_horizon {

namespace {

/// What a curve is drawn with.
struct Drawing {
  viewing::Lens lens;
  bool two;  ///< horizons
  Color above, below;
  Picture picture;
  Horizons horizons;
  viewing::Vertices vertices;
  std::optional<Passage> before;                             ///< the curve at work on the column before
  std::optional<std::pair<std::int32_t, std::int32_t>> dot;  ///< its pixel that was drawn last

  std::optional<Interval> interval(std::int32_t a, std::int32_t b) const {
    return interval_on_raster(lens, vertices[a], vertices[b]);
  }
};

Drawing drawing_of(const Scene& scene, const Conventions& conventions) {
  const Raster& raster = scene.raster;
  const auto ink = [&](Horizon where) { return formulas::detail::ink_of_curve(scene.background, where); };
  Drawing drawing{viewing::Lens(scene.camera, raster, Conventions::Depth::pseudodepth),
                  choice(options, conventions, "horizons") == 0,
                  ink(Horizon::above),
                  ink(Horizon::below),
                  Picture(raster.width, raster.height),
                  Horizons(raster.width),
                  {},
                  {},
                  {}};
  drawing.picture.use_ink();
  return drawing;
}

template <Recorder R>
void clear_horizons(Drawing& drawing, R& record) {
  drawing.horizons = Horizons(drawing.picture.width);
  for (std::int32_t x = 0; x < drawing.picture.width; ++x) {
    const auto [upper, lower] = drawing.horizons.at(x);
    record(step::clear_horizons, HorizonMove{x, true, upper});
    if (drawing.two) record(step::clear_horizons, HorizonMove{x, false, lower});
  }
}

template <Recorder R>
void draw_line(Drawing& drawing, glm::dvec2 from, glm::dvec2 to, Horizon where, R& record) {
  Picture& picture = drawing.picture;
  const Color ink = where == Horizon::above ? drawing.above : drawing.below;
  for_each_pixel(from, to, picture.width, picture.height, [&](std::int32_t x, std::int32_t y) {
    if (drawing.dot == std::pair(x, y)) return;  // the end of the line before is the beginning of this one
    drawing.dot = {x, y};
    picture.ink[picture.at(x, y)] = ink_of(ink);
    record(step::draw, ColorWrite{x, y, ink.red, ink.green, ink.blue});
  });
}

/// What is visible of the curve between two columns: all, nothing, or only up to a crossing, or only from one.
template <Recorder R>
void draw_between(Drawing& drawing, const Passage& from, const Passage& to, R& record) {
  const glm::dvec2 begin(from.x, from.y), end(to.x, to.y);
  if (from.where == to.where) {
    if (to.where != Horizon::hidden) draw_line(drawing, begin, end, to.where, record);
    return;
  }
  if (from.where != Horizon::hidden) {
    const auto at = crossing(from, to, from.where);
    if (at) record(step::cross, HorizonCross{from.where == Horizon::above, at->x, at->y});
    draw_line(drawing, begin, at.value_or(begin), from.where, record);
  }
  if (to.where != Horizon::hidden) {
    const auto at = crossing(from, to, to.where);
    if (at) record(step::cross, HorizonCross{to.where == Horizon::above, at->x, at->y});
    draw_line(drawing, at.value_or(end), end, to.where, record);
  }
}

/// The horizons of a column reach out to y.
template <class Step, Recorder R>
void move_horizons(Drawing& drawing, std::int32_t x, double y, const Step& step, R& record) {
  auto [upper, lower] = drawing.horizons.at(x);
  if (y < upper) {
    upper = y;
    record(step, HorizonMove{x, true, y});
  }
  if (drawing.two && y > lower) {
    lower = y;
    record(step, HorizonMove{x, false, y});
  }
}

template <Recorder R>
void pass_column(Drawing& drawing, std::int32_t x, double y, R& record) {
  const auto [upper, lower] = drawing.horizons.at(x);
  const Passage now{x, y, upper, lower, held_against(y, upper, lower, drawing.two)};
  record(step::test, HorizonTest{x, y, now.where});

  draw_between(drawing, drawing.before.value_or(now), now, record);
  if (now.where != Horizon::hidden) move_horizons(drawing, x, y, step::move, record);
  drawing.before = now;
}

/// A curve is seen edge-on when it meets no column, or one along all its length.
bool is_seen_edge_on(const Drawing& drawing, std::int32_t first, std::int32_t stride, std::int32_t count) {
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (std::int32_t i = 0, a = first; i + 1 < count; ++i, a += stride)
    if (const auto interval = drawing.interval(a, a + stride)) {
      low = std::min({low, interval->from.x, interval->to.x});
      high = std::max({high, interval->from.x, interval->to.x});
    }
  constexpr double point = 1e-9;  // px
  return std::ceil(low) > std::floor(high) || high - low <= point;
}

/// Through vertices first, first + stride, …
template <Recorder R>
void draw_curve(Drawing& drawing, std::int32_t first, std::int32_t stride, std::int32_t count, R& record) {
  const std::int32_t width = drawing.picture.width;
  const auto pass = [&](std::int32_t x, double y) { pass_column(drawing, x, y, record); };
  const bool edge_on = is_seen_edge_on(drawing, first, stride, count);
  drawing.before.reset();
  drawing.dot.reset();
  for (std::int32_t i = 0, a = first; i + 1 < count; ++i, a += stride) {
    record(step::segment, CurveSegment{a, a + stride});
    const auto interval = drawing.interval(a, a + stride);
    if (!interval || !interval->whole) drawing.before.reset();
    if (!interval) continue;
    if (edge_on) for_nearest_column(*interval, width, !drawing.before, pass);
    else for_each_column(*interval, width, !drawing.before, pass);
  }
}

/// Between two curves the surface ends at a side edge; nothing is drawn there, but what lies behind is hidden.
template <Recorder R>
void fill_side(Drawing& drawing, std::int32_t a, std::int32_t b, R& record) {
  record(step::side, CurveSegment{a, b});
  const auto interval = drawing.interval(a, b);
  if (!interval) return;
  for_each_column(*interval, drawing.picture.width, true,
                  [&](std::int32_t x, double y) { move_horizons(drawing, x, y, step::fill, record); });
}

}  // namespace

template <Recorder R>
Picture run(const Scene& scene, const Conventions& conventions, R& record) {
  Drawing drawing = drawing_of(scene, conventions);
  record(step::clear, BuffersClear{no_depth});
  if (!scene.surface) return drawing.picture;

  drawing.vertices = viewing::view_vertices(scene, drawing.lens, record);
  const bool sides = is_on(options, conventions, "sides"), across = is_on(options, conventions, "across");
  const std::int32_t columns = scene.surface->columns;
  const auto world = [&](std::int32_t vertex) { return scene.points[vertex]; };
  std::int32_t curve = 0;
  const Order order = rows_front_to_back(scene), column_order = columns_front_to_back(scene);
  for (const std::vector<std::int32_t>& rows : order) {
    clear_horizons(drawing, record);
    if (order.size() == 2) {  // the eye stands between two rows: what lies between them is nearest
      for (std::int32_t column = 0; column < columns; ++column)
        fill_side(drawing, order[0].front() * columns + column, order[1].front() * columns + column, record);
    }
    for (std::size_t k = 0; k < rows.size(); ++k) {
      const std::int32_t first = rows[k] * columns, before = k > 0 ? rows[k - 1] * columns : first;
      if (across && k > 0) {
        for (const std::vector<std::int32_t>& list : column_order)
          for (const std::int32_t column : list) {
            record(step::across, CurveBegin{curve, column, true, world(column).x});
            ++curve;
            draw_curve(drawing, before + column, first - before, 2, record);
          }
      }

      record(step::curve, CurveBegin{curve, rows[k], false, world(first).y});
      ++curve;
      if (sides && k > 0) {
        fill_side(drawing, before, first, record);
        fill_side(drawing, before + columns - 1, first + columns - 1, record);
      }
      draw_curve(drawing, first, 1, columns, record);
    }
  }
  return drawing.picture;
}

#define INSTANTIATE(R) template Picture run<R>(const Scene&, const Conventions&, R&);
ZSTEP_FOR_EACH_RECORDER(INSTANTIATE)
#undef INSTANTIATE

}  // namespace zstep::floating_horizon
