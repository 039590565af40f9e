// The panes of a trace: which there are, which lead on the stage, and which stand small below it. A method needs no
// entry here: its panes say how much they matter (Pane::leads).
#pragma once

#include <string>
#include <vector>

#include "sim/viewer/panes/pane.hpp"

namespace zstep::viewer {

/// Every picture and table of the stage, in the order in which they stand.
std::vector<Pane> stage_panes(const Header& header);

struct Workspace {
  std::vector<Pane> leading;  ///< one or two side by side; of three the last two below each other
  std::vector<Pane> small;
};

/// Two panes lead that matter most to the method, or what is asked to, with what leads together with it: alone where it
/// leads anyway or is wide, else beside the first of the two. `lead`: a pane's id; empty or unknown: as the method has
/// it.
Workspace workspace(const Header& header, const std::string& lead);

/// The same in a lesson's layout, where nothing else stands: a picture that is asked for has the stage alone, a table
/// or a slice stands beside the frame.
std::vector<Pane> lesson_pictures(const Header& header, const std::string& lead);

/// This pane leads because that one is asked to.
bool lead_together(const Pane& pane, const std::string& lead);

/// Throws InputError with FILE:LINE where a stop's focus is no pane of this run.
void check_focus(const Lesson& lesson, const Header& header);

/// What can be asked to lead, the method's own choice (empty) first.
std::vector<std::string> leads_to_choose(const Header& header);

}  // namespace zstep::viewer
