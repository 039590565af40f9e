#include "sim/viewer/panes/relief.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "sim/viewer/panes/scene_in_space.hpp"
#include "sim/viewer/panes/scene_outside.hpp"
#include "traces/scene.hpp"

namespace zstep::viewer {
namespace {

/// How the columns stand: x to the right, rows from the back to the front as they are on the raster, heights upwards.
struct Columns {
  explicit Columns(const Raster& raster)
      : block(relief_block(raster)),
        across((raster.width + block - 1) / block),
        along((raster.height + block - 1) / block),
        y_up(raster.y_up),
        highest(0.35 * std::max(across, along)) {}
  std::int32_t block, across, along;
  bool y_up;
  double highest;

  double x(std::int32_t column) const { return column - across / 2.0; }
  double y(std::int32_t row) const { return y_up ? row - along / 2.0 : along / 2.0 - row; }
  /// The farthest finite depth still stands above the floor, which is for ∞.
  double height(double depth, const DepthRange& range) const {
    return std::isfinite(depth) ? highest * (1 - 0.92 * std::clamp(range.share(depth), 0.0, 1.0)) : 0;
  }
  std::array<glm::dvec3, 4> top(std::int32_t column, std::int32_t row, double z) const {
    const double left = x(column), right = x(column + 1), back = y(row), front = y(row + 1);
    return {{{left, back, z}, {left, front, z}, {right, front, z}, {right, back, z}}};
  }
  std::int32_t count() const { return across * along; }
  std::int32_t at(Cell pixel) const { return pixel.y / block * across + pixel.x / block; }
};

/// The pixel of a block that the column shows: the nearest, or of a block without depths its first.
Cell nearest_of(const Picture& picture, const DepthRange& range, const Columns& columns, std::int32_t k) {
  const Cell first{k % columns.across * columns.block, k / columns.across * columns.block};
  Cell nearest = first;
  double least = std::numeric_limits<double>::infinity();
  for (std::int32_t y = first.y; y < std::min(first.y + columns.block, picture.height); ++y)
    for (std::int32_t x = first.x; x < std::min(first.x + columns.block, picture.width); ++x) {
      const double depth = picture.depth[picture.at(x, y)];
      if (std::isfinite(depth) && range.share(depth) < least) least = range.share(depth), nearest = {x, y};
    }
  return nearest;
}

double height_of(const Picture& picture, const DepthRange& range, const Columns& columns, std::int32_t k) {
  const Cell pixel = nearest_of(picture, range, columns, k);
  return columns.height(picture.depth[picture.at(pixel.x, pixel.y)], range);
}

void make_relief(Room& room, const Moment& now, const DepthRange& range, const DepthScale& scale, const ImU32& floor) {
  const Pixel32 plain = to_pixel(floor);
  const auto part = [&](int shift) { return static_cast<std::uint8_t>(plain >> shift & 255u); };
  room = relief_of(now.picture(), now.scene().raster, range, scale, {part(16), part(8), part(0)});
}

void see_relief(OutsideSeen& seen, const Kept<Room>& room, const Look& look, const glm::dvec2& size) {
  const Outside outside(room.made, look, static_cast<int>(size.x), static_cast<int>(size.y));
  see_polygons(outside, room.made.polygons(), seen.polygons);
}

void paint_relief(ChartPicture& picture, const Kept<OutsideSeen>& kept, const Kept<Room>& kept_room, const Look& look,
                  const Moment& now, const DepthRange& range, const std::optional<Cell>& cell,
                  const std::optional<Cell>& selected, const Theme& c, const float& thin) {
  const Room& room = kept_room.made;
  const Picture& seen = kept.made.polygons;
  const Columns columns(now.scene().raster);
  const Outside outside(room, look, seen.width, seen.height);
  picture.words.clear();
  std::vector<Pixel32> colors;
  for (const Polygon& polygon : room.polygons().polygons) colors.push_back(opaque(polygon.color));
  paint_polygons(picture.canvas, seen, colors, to_pixel(c.pane));
  RoomPen pen(picture, seen, room, outside, c, thin);
  const double left = columns.x(0), right = columns.x(columns.across), back = columns.y(0),
               front = columns.y(columns.along), top = columns.highest, far = columns.height(range.far, range);
  pen.around(std::array<glm::dvec3, 4>{{{left, back, 0}, {left, front, 0}, {right, front, 0}, {right, back, 0}}},
             c.text);
  const double lower = std::min(back, front);  // where a reader stands
  pen.line({left, lower, 0}, {left, lower, top}, c.text);
  pen.word({left, lower, top}, "near", c.text);
  pen.word({left, lower, far}, "far", c.text);
  pen.word({right, lower, 0}, "\u221e", c.text);
  pen.word({left, back, 0}, "(0, 0)", c.text);
  pen.word({0, lower, 0}, "x", c.text);
  pen.word({right, 0, 0}, "y", c.text);
  const auto mark = [&](const Cell& pixel, ImU32 color, double thickness) {
    const std::int32_t k = columns.at(pixel);
    if (pixel.x < 0 || pixel.y < 0 || pixel.x >= now.scene().raster.width || k >= columns.count()) return;
    const double z = height_of(now.picture(), range, columns, k);
    const auto corners = columns.top(k % columns.across, k / columns.across, z);
    const glm::dvec3 middle = (corners[0] + corners[2]) / 2.0;
    pen.around(corners, color, thickness);
    pen.line(middle, {middle.x, middle.y, 1.12 * top}, color, thickness);
    pen.dot({middle.x, middle.y, 1.12 * top}, 4, 0, color);
  };
  if (selected) mark(*selected, c.selected, 2);
  if (cell) mark(*cell, c.now, 2.6);
}

}  // namespace

std::int32_t relief_block(const Raster& raster) {
  return std::max(1, (std::max(raster.width, raster.height) + most_columns - 1) / most_columns);
}

Room relief_of(const Picture& picture, const Raster& raster, const DepthRange& range, const DepthScale& scale,
               Color floor) {
  const Columns columns(raster);
  Scene scene;
  scene.camera.kind = Camera::Kind::orthographic;
  scene.camera.polar = false;
  scene.camera.eye = {0, -1, 0};  // from where the picture's lower side is
  scene.camera.window = 1e-6;
  scene.raster = {1, 1, false};
  scene.polygons.resize(3 * columns.count());
  std::vector<double> heights;
  for (std::int32_t k = 0; k < columns.count(); ++k) {
    const Cell pixel = nearest_of(picture, range, columns, k);
    const double depth = picture.depth[picture.at(pixel.x, pixel.y)];
    heights.push_back(columns.height(depth, range));
    const Pixel32 color = std::isfinite(depth) ? scale.at(range.share(depth)) : 0;
    const auto part = [&](int shift) { return static_cast<std::uint8_t>(color >> shift & 255u); };
    for (std::int32_t side = 0; side < 3; ++side)
      scene.polygons[3 * k + side].color = std::isfinite(depth) ? Color{part(16), part(8), part(0)} : floor;
  }
  const auto add = [&](std::int32_t polygon, const std::array<glm::dvec3, 4>& corners) {
    scene.facets.push_back({polygon, size32(scene.corners), 4});
    for (const glm::dvec3& corner : corners) {
      scene.corners.push_back(size32(scene.points));
      scene.points.push_back(corner);
    }
  };
  const auto height = [&](std::int32_t column, std::int32_t row) {
    const bool inside = column >= 0 && row >= 0 && column < columns.across && row < columns.along;
    return inside ? heights[row * columns.across + column] : 0;
  };
  // Walls stand between a column and the one before it, and belong to the higher of both.
  const auto wall = [&](std::int32_t column, std::int32_t row, bool across) {
    const double own = height(column, row), other = across ? height(column - 1, row) : height(column, row - 1);
    if (own == other) return;
    const std::int32_t owner = own > other ? row * columns.across + column
                               : across    ? row * columns.across + column - 1
                                           : (row - 1) * columns.across + column;
    const double x = columns.x(column), y = columns.y(row), x_2 = across ? x : columns.x(column + 1),
                 y_2 = across ? columns.y(row + 1) : y;
    add(3 * owner + (across ? 1 : 2), {{{x, y, own}, {x_2, y_2, own}, {x_2, y_2, other}, {x, y, other}}});
  };
  for (std::int32_t row = 0; row <= columns.along; ++row)
    for (std::int32_t column = 0; column <= columns.across; ++column) {
      if (row < columns.along) wall(column, row, true);
      if (column < columns.across) wall(column, row, false);
      if (row < columns.along && column < columns.across)
        add(3 * (row * columns.across + column), columns.top(column, row, height(column, row)));
    }
  // A point above all columns: so the view keeps its distance while they grow.
  scene.points.emplace_back(columns.x(0), columns.y(0), 1.15 * columns.highest);
  return Room(scene);
}

void draw_relief(Ui& ui, ImVec2 size, const DepthRange& range,
                 const std::function<std::vector<std::string>(Cell)>& tip) {
  Session& s = ui.session;
  const glm::dvec2 whole{std::floor(size.x), std::floor(size.y)};
  if (whole.x < 8 || whole.y < 8) return say_empty(ui, "Too small to draw; drag a border or enlarge the window.");
  const Kept<Room>& room =
      *keep<Room>(ui.rooms, "relief", make_relief, ui.moment(), range, ui.depth_scale, ui.colors().head);
  Look look = ui.relief_look;
  look.tilt += 20, look.zoom *= 0.8;  // from higher up than a scene, for columns hide what is behind them
  const Kept<OutsideSeen>& seen = *keep<OutsideSeen>(ui.seen_from_outside, "relief", see_relief, room, look, whole);
  const ChartPicture& picture = keep<ChartPicture>(ui.charts, "relief", paint_relief, seen, room, look, ui.moment(),
                                                   range, s.current_cell(), s.selected, ui.colors(), ui.thin)
                                    ->made;
  const ImVec2 at = ImGui::GetCursorScreenPos();
  ImGui::InvisibleButton("relief", size);
  ImGui::GetWindowDrawList()->AddImage(Renderer::image(picture.canvas), at, moved_by(at, whole.x, whole.y));
  write_words(ui, seen.made, picture, at);
  const Columns columns(s.scene().raster);
  const std::string thinned =
      columns.block > 1 ? fmt::format("A column for {0} \u00d7 {0} pixels: the nearest.", columns.block) : "";
  if (text_size(ui, ui.fonts.small, thinned).x < size.x) draw_text(ui, at, ui.fonts.small, ui.colors().muted, thinned);
  walk_round(ui, ui.relief_look, size,
             "Drag: turn. Shift+drag: move. Wheel: nearer. Double click: back. Shift+D: flat.");
  if (!ImGui::IsItemHovered()) return;
  const ImVec2 mouse = ImGui::GetIO().MousePos;
  const int x = static_cast<int>(mouse.x - at.x), y = static_cast<int>(mouse.y - at.y);
  const Picture& shown = seen.made.polygons;
  if (x < 0 || y < 0 || x >= shown.width || y >= shown.height) return;
  const std::int32_t polygon = shown.polygon[shown.at(x, y)];
  if (polygon == no_polygon) return;
  const Cell pixel = nearest_of(s.picture(), range, columns, polygon / 3);
  const ImVec2 moved = ImGui::GetMouseDragDelta(ImGuiMouseButton_Left, 4);
  if (ImGui::IsMouseReleased(ImGuiMouseButton_Left) && moved.x == 0 && moved.y == 0)
    s.select(s.selected == pixel ? std::nullopt : std::optional(pixel));
  if (ImGui::IsItemActive()) return;
  ui.pointed_next = pixel;
  tooltip(ui, tip(pixel));
}

}  // namespace zstep::viewer
