#include "sim/viewer/panes/raster_words.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "sim/viewer/draw/canvas.hpp"
#include "sim/words/explain.hpp"
#include "traces/math/portable_math.hpp"
#include "traces/math/whole.hpp"

namespace zstep::viewer {

bool WordPlaces::put(const std::string& text, ImU32 color, const ImFont* font, const std::vector<ImVec2>& middles) {
  const ImVec2 size = label_size(ui_, font, text);
  const float rim = std::round(2 * ui_.thin);
  for (const ImVec2 middle : middles) {
    const ImVec2 at{std::round(middle.x - size.x / 2), std::round(middle.y - size.y / 2)};
    const ImVec2 low{at.x - rim, at.y}, high{at.x + size.x + rim, at.y + size.y};
    if (low.x < low_.x || low.y < low_.y || high.x > high_.x || high.y > high_.y ||
        !taken.free(low, {high.x - low.x, size.y}) || (allowed && !allowed(low, high)))
      continue;
    taken.take(low, {high.x - low.x, size.y});
    if (on_paper) ImGui::GetWindowDrawList()->AddRectFilled(low, high, ui_.colors().pane);
    draw_label(ui_, at, font, color, text);
    return true;
  }
  return false;
}

namespace {

/// The distance, in this direction, from a thing to the middle of the text beside it; `size` is the text's.
double text_away(ImVec2 size, glm::dvec2 direction, double gap) {
  return std::abs(direction.x) * size.x / 2 + std::abs(direction.y) * size.y / 2 + gap;
}

}  // namespace

bool WordPlaces::beside(const std::string& text, ImU32 color, const ImFont* font, ImVec2 from, ImVec2 to,
                        glm::dvec2 out) {
  const double length = portable::length(out.x, out.y);
  out = length > 0 ? out / length : glm::dvec2(0, -1);
  const double away = text_away(label_size(ui_, font, text), out, 4.0 * ui_.thin);
  std::vector<ImVec2> middles;
  for (const double side : {away, -away})
    for (const float share : {0.5f, 0.35f, 0.65f, 0.2f, 0.8f})
      middles.push_back(
          moved_by({from.x + share * (to.x - from.x), from.y + share * (to.y - from.y)}, side * out.x, side * out.y));
  return put(text, color, font, middles);
}

bool WordPlaces::around(const std::string& text, ImU32 color, const ImFont* font, ImVec2 dot, glm::dvec2 out) {
  const double length = portable::length(out.x, out.y);
  out = length > 0 ? out / length : glm::dvec2(0, -1);
  const ImVec2 size = label_size(ui_, font, text);
  std::vector<ImVec2> middles;
  constexpr double diagonal = 0.7071;
  for (const double gap : {0.35 * ui_.em, 1.3 * ui_.em})
    for (const glm::dvec2 turn :
         {glm::dvec2(1, 0), {diagonal, diagonal}, {diagonal, -diagonal}, {0, 1}, {0, -1}, {-1, 0}}) {
      const glm::dvec2 way(out.x * turn.x - out.y * turn.y, out.x * turn.y + out.y * turn.x);
      const double away = text_away(size, way, gap);
      middles.push_back(moved_by(dot, away * way.x, away * way.y));
    }
  return put(text, color, font, middles);
}

std::optional<std::pair<double, double>> part_within(glm::dvec2 low, glm::dvec2 high, glm::dvec2 from, glm::dvec2 way,
                                                     double least, double most) {
  for (int axis = 0; axis < 2; ++axis) {
    if (way[axis] == 0) {
      if (from[axis] < low[axis] || from[axis] > high[axis]) return std::nullopt;
      continue;
    }
    const double one = (low[axis] - from[axis]) / way[axis], other = (high[axis] - from[axis]) / way[axis];
    least = std::max(least, std::min(one, other)), most = std::min(most, std::max(one, other));
  }
  if (!(least < most)) return std::nullopt;
  return std::pair(least, most);
}

void WordPlaces::keep_line_free(ImVec2 from, ImVec2 to) {
  constexpr double every = 6;
  constexpr float half = 2;
  const glm::dvec2 first(from.x, from.y), way = glm::dvec2(to.x, to.y) - first;
  const auto part = part_within({low_.x, low_.y}, {high_.x, high_.y}, first, way, 0, 1);  // it may reach far beyond
  if (!part) return;
  const double length = std::max(1.0, portable::length(way.x, way.y));
  for (double along = part->first * length; along < part->second * length; along += every) {
    const glm::dvec2 at = first + along / length * way;
    taken.take({static_cast<float>(at.x) - half, static_cast<float>(at.y) - half}, {2 * half, 2 * half});
  }
}

namespace {

Pixel32 hatch_at(int x, int y, const RasterInk& ink) { return (x + y) % 6 == 0 ? ink.hatch_line : ink.hatch; }

/// Cells at least a pixel wide: every canvas pixel shows the cell it lies in.
void paint_large(Canvas& canvas, const RasterMap& map, const std::vector<Pixel32>& cells, const RasterInk& ink) {
  const int left = std::max(0, map.column_begin(0)), right = std::min(canvas.width(), map.column_begin(map.width));
  const int top = std::max(0, nearest_int(map.top));
  const int bottom = std::min(canvas.height(), nearest_int(map.top + map.height * map.cell));
  if (left >= right) return;
  std::vector<int> column(right);
  std::vector<bool> line(right);
  const bool grid = map.cell >= grid_from;
  for (int x = 0; x < map.width; ++x)
    for (int px = std::max(left, map.column_begin(x)); px < std::min(right, map.column_begin(x + 1)); ++px) {
      column[px] = x;
      line[px] = grid && px + 1 == map.column_begin(x + 1);
    }
  for (int y = 0; y < map.height; ++y) {
    const Pixel32* source = cells.data() + pixel_at(0, y, map.width);
    for (int py = std::max(top, map.row_begin(y)); py < std::min(bottom, map.row_end(y)); ++py) {
      Pixel32* out = canvas.row(py);
      const bool grid_row = grid && py + 1 == map.row_end(y);
      for (int px = left; px < right; ++px) {
        const Pixel32 cell = source[column[px]];
        out[px] = grid_row || line[px] ? ink.grid : cell == hatched_cell ? hatch_at(px, py, ink) : cell;
      }
    }
  }
}

/// Rows and columns under a pixel, the last ones exclusive.
struct Under {
  int left = 0, right = 0, top = 0, bottom = 0;
};

/// The mean of the cells that a pixel covers, so that thin things grow faint instead of vanishing.
struct Mean {
  const RasterMap& map;
  const std::vector<Pixel32>& cells;
  const RasterInk& ink;

  Pixel32 operator()(const Under& under) const {
    unsigned red = 0, green = 0, blue = 0, count = 0;
    for (int row = under.top; row < under.bottom; ++row) {
      const int y = map.y_up ? map.height - 1 - row : row;
      const Pixel32* source = cells.data() + pixel_at(0, y, map.width);
      for (int x = under.left; x < under.right; ++x) {
        const Pixel32 cell = source[x] == hatched_cell ? ink.hatch : source[x];
        red += cell >> 16 & 255u;
        green += cell >> 8 & 255u;
        blue += cell & 255u;
        ++count;
      }
    }
    return 0xff000000u | red / count << 16 | green / count << 8 | blue / count;
  }
};

/// The cell with the greatest count of those that a pixel covers.
struct Greatest {
  const RasterMap& map;
  const std::vector<Pixel32>& cells;
  const RasterInk& ink;
  const std::vector<double>& counts;

  Pixel32 operator()(const Under& under) const {
    Pixel32 found = hatched_cell;
    double most = -std::numeric_limits<double>::infinity();
    for (int row = under.top; row < under.bottom; ++row) {
      const int y = map.y_up ? map.height - 1 - row : row;
      const std::size_t first = pixel_at(0, y, map.width);
      for (int x = under.left; x < under.right; ++x)
        if (const std::size_t at = first + static_cast<std::size_t>(x); counts[at] >= most)
          most = counts[at], found = cells[at];
    }
    return found == hatched_cell ? ink.hatch : found;
  }
};

/// Cells smaller than a pixel: each pixel has the colour that `color` makes of those under it.
template <class ColorOf>
void paint_small(Canvas& canvas, const RasterMap& map, const ColorOf& color) {
  const double step = 1 / map.cell;
  // Each pixel begins where the one before it ends, so no cell is left out, and rounding does not lose the last one.
  const auto cell_at = [step](int pixel, double begin) { return floor_int((pixel - begin) * step + 1e-9); };
  for (int py = 0; py < canvas.height(); ++py) {
    Under under;
    under.top = std::max(0, cell_at(py, map.top)), under.bottom = std::min(map.height, cell_at(py + 1, map.top));
    if (under.top >= under.bottom) continue;
    Pixel32* out = canvas.row(py);
    for (int px = 0; px < canvas.width(); ++px) {
      under.left = std::max(0, cell_at(px, map.left)), under.right = std::min(map.width, cell_at(px + 1, map.left));
      if (under.left < under.right) out[px] = color(under);
    }
  }
}

}  // namespace

void paint_raster(Canvas& canvas, const RasterMap& map, const std::vector<Pixel32>& cells, const RasterInk& ink,
                  const std::vector<double>* counts) {
  canvas.fill(ink.outside);
  if (cells.size() < pixel_count(map.width, map.height)) return;
  if (map.cell >= 1) paint_large(canvas, map, cells, ink);
  else if (counts && counts->size() == cells.size()) paint_small(canvas, map, Greatest{map, cells, ink, *counts});
  else paint_small(canvas, map, Mean{map, cells, ink});
}

namespace {

int label_step(double cell, double needed) {
  for (int step = 1;; step *= 10)
    for (const int factor : {1, 2, 5})
      if (step * factor * cell >= needed) return step * factor;
}

}  // namespace

Rulers room_for_rulers(const Ui& ui, const Raster& raster) {
  const float digits = text_size(ui, ui.fonts.small, std::to_string(std::max(raster.width, raster.height) - 1)).x;
  return {std::round(digits + ui.em * 0.9f), std::round(ui.fonts.small->FontSize * 1.25f)};
}

void draw_rulers(Ui& ui, const RasterMap& map, ImVec2 origin, const Rulers& rulers) {
  const Theme& c = ui.colors();
  const ImFont* font = ui.fonts.small;
  const double widest = text_size(ui, font, std::to_string(map.width - 1)).x + 6.0;
  for (int x = 0, step = label_step(map.cell, widest); x < map.width; x += step) {
    const std::string text = std::to_string(x);
    const float at = static_cast<float>(map.px(x)) - text_size(ui, font, text).x / 2;
    if (map.px(x) < 0 || map.px(x) > map.box_width) continue;
    const float y =
        origin.y + static_cast<float>(std::min<double>(map.box_height, map.top + map.height * map.cell)) + 1.0f;
    draw_text(ui, {std::max(origin.x - rulers.left, origin.x + at), y}, font, c.muted, text);
  }
  const auto& at_work = ui.session.state().machine.scan_line;
  const std::int32_t* const line = at_work && !ui.still ? &*at_work : nullptr;
  const float edge = origin.x + static_cast<float>(std::max(0.0, map.left));
  for (int y = 0, step = label_step(map.cell, font->FontSize + 2.0); y < map.height; y += step) {
    // A number that would stick out by a little is moved in.
    const float middle = static_cast<float>(map.py(y)), half = font->FontSize / 2;
    const float place = std::clamp(middle, half, std::max(half, to_float(map.box_height) - half));
    if (std::abs(place - middle) > half * 0.6f) continue;
    if (line && std::abs(map.py(y) - map.py(*line)) < font->FontSize) continue;  // the one at work is drawn last
    const std::string text = std::to_string(y);
    draw_text(ui, {edge - 4 - text_size(ui, font, text).x, origin.y + place - half}, font, c.muted, text);
  }
  if (line && map.py(*line) >= 0 && map.py(*line) <= map.box_height) {
    // The scan line at work: its number and an arrow, wherever it stands.
    const std::string text = std::to_string(*line);
    const float y = std::clamp(origin.y + static_cast<float>(map.py(*line)) - font->FontSize / 2, origin.y,
                               origin.y + to_float(map.box_height) - font->FontSize);
    const float width = text_size(ui, font, text).x;
    draw_text(ui, {edge - 4 - width, y}, font, c.now, text);
    const float tip = edge - 6 - width, middle = y + font->FontSize / 2, size = font->FontSize * 0.3f;
    ImGui::GetWindowDrawList()->AddTriangleFilled({tip - size * 1.4f, middle - size}, {tip, middle},
                                                  {tip - size * 1.4f, middle + size}, c.now);
  }
}

std::optional<int> decimals_that_fit(int most, double room, const std::function<double(int)>& widest) {
  for (int decimals = most; decimals >= std::min(2, most); --decimals)
    if (widest(decimals) <= room) return decimals;
  return std::nullopt;
}

bool draw_numbers(Ui& ui, const RasterMap& map, ImVec2 origin, const Cells& cells,
                  const std::function<std::string(std::size_t, int)>& cell_text) {
  if (map.cell < numbers_from) return false;
  const int x0 = std::max(0, static_cast<int>(-map.left / map.cell)),
            x1 = std::min(map.width - 1, static_cast<int>((map.box_width - map.left) / map.cell));
  const int r0 = std::max(0, static_cast<int>(-map.top / map.cell)),
            r1 = std::min(map.height - 1, static_cast<int>((map.box_height - map.top) / map.cell));
  const auto widest_with = [&](const ImFont* font, int decimals) {
    double widest = 0;
    for (int r = r0; r <= r1; ++r)
      for (int x = x0; x <= x1; ++x) {
        const int y = map.y_up ? map.height - 1 - r : r;
        widest = std::max<double>(widest, text_size(ui, font, cell_text(pixel_at(x, y, map.width), decimals)).x);
      }
    return widest;
  };
  for (const ImFont* font : {ui.fonts.mono, ui.fonts.small}) {
    if (font->FontSize > map.cell - 3) continue;
    // Smaller type is better than fewer decimals; fewer decimals are better than nothing.
    const auto decimals =
        font == ui.fonts.mono
            ? widest_with(font, cells.decimals) <= map.cell - 6 ? std::optional(cells.decimals) : std::nullopt
            : decimals_that_fit(cells.decimals, map.cell - 6, [&](int fewer) { return widest_with(font, fewer); });
    if (!decimals) continue;
    for (int r = r0; r <= r1; ++r)
      for (int x = x0; x <= x1; ++x) {
        const int y = map.y_up ? map.height - 1 - r : r;
        const std::size_t at = pixel_at(x, y, map.width);
        const std::string text = cell_text(at, *decimals);
        if (text.empty()) continue;
        const ImVec2 size = text_size(ui, font, text);
        // Cells that the pane's border cuts go without.
        if (map.px(x) - size.x / 2 < 0 || map.px(x) + size.x / 2 > map.box_width || map.py(y) - size.y / 2 < 0 ||
            map.py(y) + size.y / 2 > map.box_height)
          continue;
        const Pixel32 back = cells.colors[at] == hatched_cell ? to_pixel(ui.colors().empty) : cells.colors[at];
        const ImVec2 middle = moved_by(origin, map.px(x), map.py(y)), half{size.x / 2 + 1, size.y / 2 - 1};
        // Lines over the cells go on behind it.
        ImGui::GetWindowDrawList()->AddRectFilled({middle.x - half.x, middle.y - half.y},
                                                  {middle.x + half.x, middle.y + half.y}, to_im(back));
        draw_text(ui, {middle.x - size.x / 2, middle.y - size.y / 2}, font, ink_on(back), text);
      }
    return true;
  }
  return false;
}

void draw_labels(Ui& ui, const RasterMap& map, ImVec2 origin, TakenPlaces taken) {
  const auto find = static_cast<void (*)(std::vector<LabelSpot>&, const RasterMap&, const Moment&)>(find_label_spots);
  const ImFont* font = ui.fonts.bold;
  const float rim = std::round(2 * ui.thin);
  if (const auto cell = ui.session.cell_looked_at(ui.still)) {  // its frame is drawn over the letters
    const float around = rim + std::round(3 * ui.thin), side = static_cast<float>(map.cell);
    taken.take({origin.x + static_cast<float>(map.px(cell->x)) - side / 2 - around,
                origin.y + static_cast<float>(map.py(cell->y)) - side / 2 - around},
               {side + 2 * around, side + 2 * around});
  }
  for (const LabelSpot& spot : keep(ui.spots, "frame", find, map, ui.moment())->made) {
    const std::string label = polygon_label(ui.session.scene(), spot.polygon);
    const ImVec2 size = text_size(ui, font, label);
    // What is seen of it must be as large as its letter.
    if (static_cast<double>(spot.pixels) * map.cell * map.cell < size.x * font->FontSize) continue;
    const auto within = [&](float x, float y) {  // the part of the window that shows the raster
      return ImVec2{
          std::round(origin.x + std::clamp(x - origin.x, rim, std::max(rim, to_float(map.box_width) - size.x - rim))),
          std::round(origin.y + std::clamp(y - origin.y, rim, std::max(rim, to_float(map.box_height) - size.y - rim)))};
    };
    const ImVec2 middle = moved_by(origin, map.px(spot.cell.x), map.py(spot.cell.y)),
                 best = within(middle.x - size.x / 2, middle.y - size.y / 2);
    // Where that place is taken, one near it where the same polygon is seen.
    std::optional<ImVec2> free;
    for (int k = 0; k < 25 && !free; ++k) {
      constexpr int order[] = {0, 1, -1, 2, -2};
      const ImVec2 at = within(best.x + std::round(size.x * to_float(order[k % 5])),
                               best.y + std::round(size.y * to_float(order[k / 5])));
      const auto cell = map.cell_at(at.x + size.x / 2 - origin.x, at.y + size.y / 2 - origin.y);
      const Picture& shown = ui.session.picture();
      if (k > 0 && (!cell || shown.polygon[shown.at(cell->x, cell->y)] != spot.polygon)) continue;
      if (taken.free({at.x - rim, at.y}, {size.x + 2 * rim, size.y})) free = at;
    }
    if (!free) continue;
    const ImVec2 at = *free;
    taken.take({at.x - rim, at.y}, {size.x + 2 * rim, size.y});
    for (const float x : {-rim, 0.0f, rim})
      for (const float y : {-rim, 0.0f, rim}) draw_text(ui, {at.x + x, at.y + y}, font, ui.colors().pane, label);
    draw_text(ui, at, font, ui.colors().text, label);
  }
}

}  // namespace zstep::viewer
