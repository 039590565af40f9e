#include "sim/viewer/panes/half_planes.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include <glm/geometric.hpp>

#include "sim/words/explain.hpp"
#include "traces/formulas/half_space.hpp"
#include "traces/formulas/samples.hpp"

namespace zstep::viewer {
namespace {

constexpr double smallest_cell = 5, smallest_cell_of_samples = 14;

/// The triangle at work, where its parts can be told apart.
const TriangleWork* at_work(const State& state, const RasterMap& map) {
  const TriangleWork& triangle = state.machine.triangle;
  const bool mixes = !state.machine.sweep.covered.empty();  // of samples, when all triangles are drawn
  return triangle.setup && !mixes && map.cell >= smallest_cell ? &triangle : nullptr;
}

struct Line {
  glm::dvec2 from, to;  ///< on the raster
};
/// The part of an edge's line within the box, where its vertices are known.
std::optional<Line> within_box(const TriangleSetup& box, glm::dvec2 from, glm::dvec2 to) {
  const glm::dvec2 way = to - from, low(box.first_column - 0.5, box.first_row - 0.5),
                   high(box.end_column - 0.5, box.end_row - 0.5);
  constexpr double infinity = std::numeric_limits<double>::infinity();
  const auto part = part_within(low, high, from, way, -infinity, infinity);
  if (!part) return std::nullopt;
  return Line{from + part->first * way, from + part->second * way};
}

bool is_inside(const EdgeFunction& edge, std::int32_t x, std::int32_t y) {
  return formulas::is_on_side(edge.edge_a * x + edge.edge_b * y + edge.edge_c, edge.owns);
}

/// A dot's radius in cells: few of them have room for their numbers.
constexpr double dot_of_cell(std::size_t dots) { return dots <= 4 ? 0.16 : 0.055; }

Color color_of_sample(const Scene& scene, std::int32_t polygon) {
  return polygon == no_polygon ? scene.background : scene.polygons[polygon].color;
}

/// The pixel of which samples are at work, or asked about.
std::optional<std::pair<std::int32_t, std::int32_t>> pixel_of_samples(const TriangleWork& triangle, const Moment& now,
                                                                      double cell) {
  if (cell < smallest_cell_of_samples) return std::nullopt;
  const auto& asked = now.event_in_question();
  if (const auto* sample = asked ? get_if<SampleTest>(&asked->event) : nullptr) return std::pair(sample->x, sample->y);
  if (triangle.sample) return std::pair(triangle.sample->x, triangle.sample->y);
  if (triangle.mask) return std::pair(triangle.mask->x, triangle.mask->y);
  return std::nullopt;
}

class Painter {
 public:
  Painter(Canvas& canvas, const RasterMap& map, const Moment& now, const Theme& c, double thin)
      : canvas_(canvas), map_(map), now_(now), c_(c), thin_(thin) {}

  void paint(const TriangleWork& triangle) {
    const TriangleSetup& box = *triangle.setup;
    frame(box.first_column, box.first_row, box.end_column, box.end_row, 1.5, to_pixel(c_.text));
    for (const EdgeFunction& edge : triangle.edges) line(box, edge);
    const auto& asked = now_.event_in_question();
    const TileTest* tile = asked ? get_if<TileTest>(&asked->event) : nullptr;
    if (!tile && triangle.tile) tile = &*triangle.tile;
    if (tile) frame(tile->first_column, tile->first_row, tile->end_column, tile->end_row, 3, to_pixel(c_.now));
    if (const auto place = pixel_of_samples(triangle, now_, map_.cell)) samples(triangle, place->first, place->second);
    else if (triangle.weights && !triangle.sample && now_.event_told()) areas(box, *triangle.weights);
  }

 private:
  void frame(std::int32_t left, std::int32_t first, std::int32_t right, std::int32_t end, double thick, Pixel32 color) {
    const double x_0 = map_.px(left - 0.5), x_1 = map_.px(right - 0.5), y_0 = map_.py(first - 0.5),
                 y_1 = map_.py(end - 0.5);
    for (const auto& [a, b, p, q] : {std::array{x_0, y_0, x_1, y_0}, std::array{x_1, y_0, x_1, y_1},
                                     std::array{x_1, y_1, x_0, y_1}, std::array{x_0, y_1, x_0, y_0}}) {
      canvas_.line(a, b, p, q, (thick + 2) * thin_, to_pixel(c_.pane), 200);
      canvas_.line(a, b, p, q, thick * thin_, color);
    }
  }
  /// The edge's line through the box, with strokes to its positive side.
  void line(const TriangleSetup& box, const EdgeFunction& edge) {
    const auto from = on_raster(now_.scene(), now_.state(), edge.vertex_0),
               to = on_raster(now_.scene(), now_.state(), edge.vertex_1);
    if (!from || !to) return;
    const auto part = within_box(box, {from->x, from->y}, {to->x, to->y});
    if (!part) return;
    const RecordedEvent* event = now_.event();
    const EdgeFunction* set_up = event ? get_if<EdgeFunction>(&event->event) : nullptr;
    const bool is_new = set_up && set_up->edge_function == edge.edge_function;
    const Pixel32 color = to_pixel(is_new ? c_.now : c_.text);
    const glm::dvec2 a(map_.px(part->from.x), map_.py(part->from.y)), b(map_.px(part->to.x), map_.py(part->to.y));
    // Between the vertices there is the outline; beyond them the line goes on, fainter.
    if (is_new) {
      canvas_.line(a.x, a.y, b.x, b.y, 2.5 * thin_, color);
    } else {
      canvas_.line(a.x, a.y, map_.px(from->x), map_.py(from->y), 1.2 * thin_, color, 80);
      canvas_.line(map_.px(to->x), map_.py(to->y), b.x, b.y, 1.2 * thin_, color, 80);
    }
    const glm::dvec2 inward(edge.edge_a, map_.y_up ? -edge.edge_b : edge.edge_b);
    // Strokes at the cells' borders, where no numbers stand.
    const double length = glm::length(b - a), size = glm::length(inward),
                 along = std::max(std::abs(b.x - a.x), std::abs(b.y - a.y));
    if (!(size > 0) || !(along > 0)) return;
    const double apart = std::ceil(12 * thin_ / map_.cell) * map_.cell * length / along;
    const glm::dvec2 stroke = inward / size * std::min(0.45 * map_.cell, 10 * thin_);
    for (double at = apart; at < length; at += apart) {
      const glm::dvec2 foot = a + (b - a) * (at / length), tip = foot + stroke;
      canvas_.line(foot.x, foot.y, tip.x, tip.y, (is_new ? 2.5 : 1.5) * thin_, color);
    }
  }
  /// Dots in the colours of the polygons that the samples show, hollow where they show none; the one at work is larger.
  void samples(const TriangleWork& triangle, std::int32_t x, std::int32_t y) {
    const auto offsets = formulas::samples_of(now_.header().conventions);
    const std::size_t dots = triangle.mask ? formulas::mask_rows * formulas::mask_columns : offsets.size();
    const double size = std::max(1.5 * thin_, dot_of_cell(dots) * map_.cell);
    const auto dot = [&](const formulas::SampleOffset& offset, std::int32_t polygon, bool at_work) {
      const double px = map_.px(x + offset.dx()), py = map_.py(y + offset.dy()), radius = at_work ? 1.3 * size : size;
      canvas_.mark(px, py, radius + 1.5 * thin_, 0, to_pixel(at_work ? c_.now : c_.text));
      canvas_.mark(px, py, radius, 0, opaque(color_of_sample(now_.scene(), polygon)));
    };
    const MethodState& machine = now_.state().machine;
    if (triangle.mask) {
      const std::uint32_t inside = formulas::samples_of(*triangle.mask);
      for (std::int32_t bit = 0; bit < formulas::mask_rows * formulas::mask_columns; ++bit)
        dot(formulas::mask_offset(bit), inside >> bit & 1 ? machine.polygon : no_polygon, false);
      return;
    }
    for (std::int32_t i = 0; i < size32(offsets); ++i)
      dot(offsets[static_cast<std::size_t>(i)], machine.sample(x, y, i).polygon,
          triangle.sample && i == triangle.sample->sample && now_.event_told());
  }
  /// From the pixel's centre to the vertices: the three triangles whose areas are the weights.
  void areas(const TriangleSetup& box, const BarycentricWeights& at) {
    for (const std::int32_t vertex : {box.vertex_0, box.vertex_1, box.vertex_2})
      if (const auto to = on_raster(now_.scene(), now_.state(), vertex)) {
        const double x = map_.px(to->x), y = map_.py(to->y);
        canvas_.line(map_.px(at.x), map_.py(at.y), x, y, 1.2 * thin_, to_pixel(c_.now), 170);
      }
  }

  Canvas& canvas_;
  const RasterMap& map_;
  const Moment& now_;
  const Theme& c_;
  double thin_;
};

/// Has the pixel been tested? Tile after tile, row after row; where an edge is being set up it is shown of every pixel
/// on which side it lies.
bool is_told(const TriangleWork& triangle, const RecordedEvent* event, std::int32_t x, std::int32_t y) {
  if (event && get_if<EdgeFunction>(&event->event)) return true;
  const auto order = [&](std::int32_t column, std::int32_t row) {
    const std::int32_t whole = std::numeric_limits<std::int32_t>::max();
    const std::int32_t side = triangle.tile ? formulas::tile_side : whole;
    return std::array{row / side, column / side, row, column};
  };
  if (triangle.test) return order(x, y) <= order(triangle.test->x, triangle.test->y);
  return triangle.tile && order(x, y) < order(triangle.tile->first_column, triangle.tile->first_row);
}

/// A cross on each pixel of the box that is known to be on the wrong side of an edge, where nothing stands in it.
void cross_out(const Ui& ui, const RasterMap& map, ImVec2 origin, const TriangleWork& triangle, bool stands_in,
               ImU32 color) {
  if (triangle.edges.empty()) return;
  const Picture& picture = ui.session.picture();
  const TriangleSetup& box = *triangle.setup;
  const double reach = std::min(0.16 * map.cell, 6.0 * ui.thin);
  for (std::int32_t y = std::max(0, box.first_row); y < std::min(map.height, box.end_row); ++y)
    for (std::int32_t x = std::max(0, box.first_column); x < std::min(map.width, box.end_column); ++x) {
      const double at_x = map.px(x), at_y = map.py(y);
      const bool is_shown = at_x > 0 && at_y > 0 && at_x < map.box_width && at_y < map.box_height;
      if (!is_shown || !is_told(triangle, ui.session.event(), x, y) ||
          (stands_in && picture.polygon[picture.at(x, y)] != no_polygon))
        continue;
      if (std::all_of(triangle.edges.begin(), triangle.edges.end(),
                      [&](const EdgeFunction& edge) { return is_inside(edge, x, y); }))
        continue;
      for (const double rise : {reach, -reach})
        stroke_line(ImGui::GetWindowDrawList(), moved_by(origin, at_x - reach, at_y + rise),
                    moved_by(origin, at_x + reach, at_y - rise), color, 1.2f * ui.thin);
    }
}

/// The numbers of a pixel's samples in their dots, where these are large enough.
void number_samples(const Ui& ui, const RasterMap& map, ImVec2 origin, const TriangleWork& triangle) {
  const auto place = pixel_of_samples(triangle, ui.moment(), map.cell);
  const auto offsets = formulas::samples_of(ui.session.trace().header().conventions);
  const double size = dot_of_cell(offsets.size()) * map.cell;
  const ImFont* font = ui.fonts.small;
  if (!place || triangle.mask || 2 * size < 0.85 * font->FontSize) return;
  for (std::size_t i = 0; i < offsets.size(); ++i) {
    const std::int32_t polygon =
        ui.session.state().machine.sample(place->first, place->second, static_cast<std::int32_t>(i)).polygon;
    const std::string number = std::to_string(i);
    const ImVec2 middle =
                     moved_by(origin, map.px(place->first + offsets[i].dx()), map.py(place->second + offsets[i].dy())),
                 room = text_size(ui, font, number);
    draw_text(ui, {middle.x - room.x / 2, middle.y - room.y / 2}, font,
              ink_on(to_pixel(opaque(color_of_sample(ui.session.scene(), polygon)))), number);
  }
}

/// The numbers of its vertices around it, and its polygon's name on its box, between pixels.
void name_triangle(Ui& ui, const RasterMap& map, ImVec2 origin, const TriangleSetup& box, WordPlaces& words) {
  const State& state = ui.session.state();
  const Scene& scene = ui.session.scene();
  const ImU32 color = ui.colors().text;
  const glm::dvec2 middle((box.first_column + box.end_column - 1) / 2.0, (box.first_row + box.end_row - 1) / 2.0);
  for (const std::int32_t vertex : {box.vertex_0, box.vertex_1, box.vertex_2})
    if (const auto at = on_raster(scene, state, vertex))
      words.around(vertex_label(scene, vertex), color, ui.fonts.small, moved_by(origin, map.px(at->x), map.py(at->y)),
                   {map.px(at->x) - map.px(middle.x), map.py(at->y) - map.py(middle.y)});
  const std::string name = polygon_label(scene, state.machine.polygon);
  const double beside = text_size(ui, ui.fonts.bold, name).x;
  const auto border = [&](double column, double row, double by) {
    return moved_by(origin, map.px(column - 0.5) + by, map.py(row - 0.5));
  };
  const auto in_pixels = std::exchange(words.allowed, nullptr);
  words.put(name, color, ui.fonts.bold,
            {border(box.first_column, box.first_row, beside), border(box.end_column, box.first_row, -beside),
             border(box.first_column, box.end_row, beside), border(box.end_column, box.end_row, -beside)});
  words.allowed = in_pixels;
}

}  // namespace

void paint_half_planes(Canvas& canvas, const RasterMap& map, const Moment& now, const Theme& c, double thin) {
  if (const TriangleWork* triangle = at_work(now.state(), map)) Painter(canvas, map, now, c, thin).paint(*triangle);
}

void mark_half_planes(Ui& ui, const RasterMap& map, ImVec2 origin, WordPlaces& words, bool stands_in,
                      const Theme& ink) {
  const State& state = ui.session.state();
  const TriangleWork* triangle = at_work(state, map);
  if (!triangle) return;
  constexpr std::array names{"E\u2080", "E\u2081", "E\u2082"};
  cross_out(ui, map, origin, *triangle, stands_in, ink.muted);
  for (const EdgeFunction& edge : triangle->edges) {
    if (edge.edge_function < 0 || edge.edge_function > 2) continue;
    const auto from = on_raster(ui.session.scene(), state, edge.vertex_0),
               to = on_raster(ui.session.scene(), state, edge.vertex_1);
    // Outside the triangle; inside, where that is no place.
    const glm::dvec2 inward(edge.edge_a, map.y_up ? -edge.edge_b : edge.edge_b);
    if (from && to && glm::length(inward) > 0)
      words.beside(names[static_cast<std::size_t>(edge.edge_function)], ui.colors().text, ui.fonts.bold,
                   moved_by(origin, map.px(from->x), map.py(from->y)), moved_by(origin, map.px(to->x), map.py(to->y)),
                   -inward);
  }
  number_samples(ui, map, origin, *triangle);
  name_triangle(ui, map, origin, *triangle->setup, words);
}

}  // namespace zstep::viewer
