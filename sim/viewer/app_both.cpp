// Two runs in one window: where the panes of either are.
#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "sim/viewer/app.hpp"
#include "sim/viewer/panes/workspace.hpp"

namespace zstep::viewer {

/// A pane of another run. What a reader does in it, zooming and selecting, this run takes; then it is true.
bool App::draw_beside(Ui& b, const Pane& pane, const std::string& title, ImVec2 at, ImVec2 size) {
  const std::optional<Cell> selected = b.session.selected;
  b.mouse_help.clear();
  b.pointed_next.reset();
  const RasterView view = b.view = ui_.view;
  ImGui::PushID(&b);
  draw_pane(b, pane, title, at, size);
  ImGui::PopID();
  if (!b.mouse_help.empty()) ui_.mouse_help = b.mouse_help;
  if (b.pointed_next) ui_.pointed_next = b.pointed_next;
  if (b.session.selected == selected && b.view == view) return false;
  ui_.view = b.view;
  if (b.session.selected != session_.selected) session_.select(b.session.selected);
  return true;
}

/// A pane of either run.
void App::draw_of(bool first, const Pane& pane, ImVec2 at, ImVec2 size) {
  const std::string title = fmt::format("{}: {}", first ? "A" : "B", pane.title);
  if (first) draw_pane(ui_, pane, title, at, size);
  else draw_beside(*other_ui_, pane, title, at, size);
}

/// The frames of both side by side, and their depth buffers, in one row or two, whichever shows larger pixels; below
/// them what the method lives by, with what both have of it.
void App::draw_panes_of_both(ImVec2 at, ImVec2 size) {
  Layout& l = settings_.layout;
  const float gap = std::round(ui_.em * 0.35f);
  const Header &header = session_.header(), &other = against_->session().header();
  const Pane *depths = depth_pane_of(header), *other_depths = depth_pane_of(other);
  const Docked dock = docked(size, {0, 0}, size, 2);  // always below: the frames want all of the width
  if (dock.side != Docked::Side::nowhere) {
    drawer_at_ = {{at.x, at.y + size.y - dock.room}, {size.x, dock.room}};
    pull_drawer(dock, size);
    size.y -= dock.room + gap;
  }
  const bool narrow = size.x < ui_.em * 44 || size.y < ui_.em * 21;
  const Workspace stage = workspace(header, lead());
  const float left = narrow ? 0 : std::round(size.x * l.left);
  if (!narrow) {
    // A class needs no code beside two runs.
    const float code = ui_.presenter ? 0 : std::round(size.y * 0.34f),
                said = std::round((size.y - code - (ui_.presenter ? gap : 2 * gap)) / 2);
    float y = at.y;
    if (!ui_.presenter) {
      draw_pane(pseudo_code_pane, {at.x, y}, {left, code});
      y += code + gap;
    }
    draw_of(true, happened_pane, {at.x, y}, {left, said});
    draw_of(false, happened_pane, {at.x, y + said + gap}, {left, at.y + size.y - y - said - gap});
    splitter("left", {at.x + left, at.y}, {gap, size.y}, true, l.left, size.x);
    l.left = std::clamp(l.left, 0.1f, 0.55f);
  }
  const float x = narrow ? at.x : at.x + left + gap, middle = at.x + size.x - x;
  const float upper = narrow ? size.y : std::round((size.y - gap) * l.both);
  std::vector<std::pair<bool, const Pane*>> panes{{true, &frame_pane}, {false, &frame_pane}};
  if (depths && other_depths && !narrow) panes.insert(panes.end(), {{true, depths}, {false, other_depths}});
  const Raster& raster = session_.scene().raster;
  const auto pixel = [&](int columns, int rows) {
    return std::min((middle / static_cast<float>(columns) - 3 * ui_.em) / static_cast<float>(raster.width),
                    (upper / static_cast<float>(rows) - 4 * ui_.em) / static_cast<float>(raster.height));
  };
  const int count = static_cast<int>(panes.size());
  const int rows = count > 2 && pixel(2, 2) > pixel(4, 1) ? 2 : 1, columns = count / rows;
  for (int i = 0; i < count; ++i) {
    const auto part = [gap](float from, float room, int place, int parts) {
      const float each = (room - gap * static_cast<float>(parts - 1)) / static_cast<float>(parts);
      return std::make_pair(std::round(from + static_cast<float>(place) * (each + gap)), std::floor(each));
    };
    const auto [px, width] = part(x, middle, i % columns, columns);
    const auto [py, height] = part(at.y, upper, i / columns, rows);
    const auto& [first, pane] = panes[static_cast<std::size_t>(i)];
    draw_of(first, *pane, {px, py}, {width, height});
  }
  if (narrow) return;
  // What leads is here the slice, or what the method lives by; the frames have the stage.
  std::vector<Pane> below;
  for (const std::vector<Pane>* some : {&stage.leading, &stage.small})
    for (const Pane& pane : *some)
      if (pane.id != frame_pane.id && !(depths && pane.id == depths->id)) below.push_back(pane);
  std::stable_partition(below.begin(), below.end(), [&](const Pane& pane) { return pane.id == lead(); });
  draw_small(below, {x, at.y + upper + gap}, {middle, size.y - upper - gap});
  splitter("both", {x, at.y + upper}, {middle, gap}, false, l.both, size.y - gap);
}

}  // namespace zstep::viewer
