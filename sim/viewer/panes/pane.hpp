// Panes: small functions that draw a part of the window from a Ui. Each lives in a file of its own.
//
// A method that lives by another structure (a tree, a list, areas, rays) adds its pane to structure_panes() and says
// with `serves` for which traces it is shown, and with `leads` how much it matters there; nothing else needs to change.
#pragma once

#include <string>
#include <vector>

#include "sim/viewer/panes/ui.hpp"

namespace zstep::viewer {

struct Pane {
  const char* id;                 ///< for the layout file
  const char* title;              ///< "FRAMEBUFFER"
  void (*draw)(Ui&);              ///< inside its own child window; the cursor is at the top left
  std::string (*note)(Ui&);       ///< right of the title, in muted text; may be nullptr
  bool (*serves)(const Header&);  ///< shown for this trace; nullptr: always
  float share;                    ///< of its row's width, to begin with
  bool scrolls;                   ///< its content may be larger than it is
  int (*leads)(const Header&) =
      nullptr;                   ///< the two greatest of a trace lead on the stage; nullptr: only when asked to
  bool wide = false;             ///< has the stage alone when it leads
  bool (*waits)(Ui&) = nullptr;  ///< the run has not come to it yet: it is folded to its title
  const Pane* with = nullptr;    ///< leads together with it
};

/// A pane that leads with this rank wherever it is shown.
template <int rank>
int always(const Header&) {
  return rank;
}

extern const Pane pseudo_code_pane, happened_pane, frame_pane, slice_pane, section_pane, lesson_pane, depth_error_pane,
    depth_units_pane, depth_curve_pane, slice_view_pane, canonical_pane;
/// Of the depths: the method's depth buffer, or what the trace has of them where the method keeps none; nullptr where
/// there are no depths.
const Pane* depth_pane_of(const Header& header);

/// The structures that this trace's method lives by, left to right.
std::vector<Pane> structure_panes(const Header& header);
extern const Pane edge_table_pane;
extern const Pane sweep_pane;
extern const Pane active_edges_pane;
extern const Pane drawing_list_pane;
extern const Pane tree_pane;
extern const Pane plan_pane;
extern const Pane areas_pane;
extern const Pane horizons_pane;
extern const Pane ray_plan_pane;
extern const Pane ray_tests_pane;
extern const Pane ray_tree_pane;
extern const Pane lines_pane;
extern const Pane shadow_buffer_pane;
extern const Pane scene_pane;

/// Across the window, below the panes.
void draw_timeline(Ui& ui, ImVec2 size);
float timeline_height(const Ui& ui);
/// The same where there is little room: rows so high, buttons below the strip, or beside it where that is all.
void draw_small_timeline(Ui& ui, ImVec2 size, float row);
/// Its buttons, which share this room.
void draw_small_transport(Ui& ui, bool playing, ImVec2 size);
/// Buttons that move and play, each a command's, and the speed, in a place as wide as the widest, where so much room
/// has one for it.
void draw_transport(Ui& ui, bool playing, const std::string& speed, float widest, float room);

/// No step that records one of these events has run yet. Unknown, and so false, far into a long run.
template <class... E>
bool none_yet(Ui& ui) {
  for (const StepInfo& step : ui.session.header().page)
    if (((step.kind == kind_of<E>) || ...) && ui.hits.of(step.id).value_or(1) > 0) return false;
  return true;
}

/// The same of steps that do any of this at a pixel.
inline bool none_yet(Ui& ui, AtPixel any) {
  for (const StepInfo& step : ui.session.header().page)
    if (has(at_pixel_of(step.kind), any) && ui.hits.of(step.id).value_or(1) > 0) return false;
  return true;
}

/// A tree and its plan lead, but where what is blended is what matters.
inline int leads_of_trees(const Header& header) { return records<ColorBlend>(header) ? 0 : 30; }

/// The exact values of numbers as lines for a tooltip.
std::vector<std::string> exact_lines(const std::vector<std::pair<std::string, double>>& values);

}  // namespace zstep::viewer
