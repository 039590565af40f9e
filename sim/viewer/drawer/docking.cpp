// Where the drawer stands: beside the stage or below it, whichever leaves what leads the larger picture.
#include <algorithm>
#include <cmath>

#include "sim/viewer/drawer/drawer.hpp"

namespace zstep::viewer {

/// How large a pixel of the raster is on a stage of this size, where so many panes lead.
float App::pixel_on(ImVec2 stage, std::size_t leading) const {
  const Raster& raster = session_.scene().raster;
  const float panes = leading > 1 ? 2 : 1;
  return std::min(stage.x / panes / static_cast<float>(raster.width),
                  (stage.y - 1.5f * ui_.em) / static_cast<float>(raster.height));
}

App::Docked App::docked(ImVec2 size, ImVec2 beside, ImVec2 below, std::size_t leading) const {
  const DrawerPage* const page = page_of(drawer_);
  if (!page) return {};
  const Layout &now = settings_.layout, usual;
  const float gap = std::round(ui_.em * 0.35f);
  const auto room = [&](float share, float whole, float least) {
    const float most = std::max(1.0f, std::round(whole * 0.6f));
    return std::clamp(std::round(whole * share), std::min(least * ui_.em, most), most);
  };
  // As wide and high as it usually is, so that it stays where it is while its border is pulled.
  beside.x -= room(usual.drawer_width, size.x, page->least.x) + gap;
  below.y -= room(usual.drawer_height, size.y, page->least.y) + gap;
  beside.y *= now.stage;
  if (page->keeps_small || pixel_on(beside, leading) >= pixel_on(below, leading))
    return {Docked::Side::beside, room(now.drawer_width, size.x, page->least.x)};
  return {Docked::Side::below, room(now.drawer_height, size.y, page->least.y)};
}

void App::pull_drawer(const Docked& docked, ImVec2 size) {
  const float gap = std::round(ui_.em * 0.35f);
  const bool beside = docked.side == Docked::Side::beside;
  const ImVec2 at = drawer_at_.at, its = drawer_at_.size;
  const float whole = beside ? size.x : size.y;
  float others = 1 - docked.room / whole;
  const bool pulled = beside ? splitter("drawer", {at.x - gap, at.y}, {gap, its.y}, true, others, whole)
                             : splitter("drawer", {at.x, at.y - gap}, {its.x, gap}, false, others, whole);
  if (pulled) (beside ? settings_.layout.drawer_width : settings_.layout.drawer_height) = 1 - others;
}

}  // namespace zstep::viewer
