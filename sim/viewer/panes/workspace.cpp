#include "sim/viewer/panes/workspace.hpp"

#include <algorithm>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "sim/viewer/panes/lesson_chart.hpp"
#include "sim/viewer/panes/pane.hpp"
#include "sim/words/numbers.hpp"
#include "traces/error.hpp"

namespace zstep::viewer {

std::vector<Pane> structure_panes(const Header& header) {
  std::vector<Pane> shown;
  for (const Pane* pane : {
           &edge_table_pane,
           &sweep_pane,
           &active_edges_pane,
           &drawing_list_pane,
           &tree_pane,
           &plan_pane,
           &areas_pane,
           &horizons_pane,
           &ray_plan_pane,
           &ray_tests_pane,
           &ray_tree_pane,
           &lines_pane,
           &shadow_buffer_pane,
           &scene_pane,
       })
    if (!pane->serves || pane->serves(header)) shown.push_back(*pane);
  return shown;
}

std::vector<std::string> exact_lines(const std::vector<std::pair<std::string, double>>& values) {
  std::vector<std::string> lines;
  for (const auto& [name, value] : values) lines.push_back(fmt::format("{} = {}", name, exact(value)));
  return lines;
}

namespace {

/// Charts look through all of a run, and a section has a plane at few steps, so they are there only while they lead.
bool only_leads(const Pane& pane) {
  return pane.id == depth_error_pane.id || pane.id == depth_units_pane.id || pane.id == depth_curve_pane.id ||
         pane.id == slice_view_pane.id || pane.id == section_pane.id || pane.id == canonical_pane.id;
}

std::vector<Pane> usual_leads(const std::vector<Pane>& panes, const Header& header) {
  const auto rank = [&](const Pane& pane) { return pane.leads ? pane.leads(header) : 0; };
  std::vector<int> ranks;
  for (const Pane& pane : panes) ranks.push_back(rank(pane));
  std::sort(ranks.rbegin(), ranks.rend());
  const int least = std::max(1, ranks.size() > 1 ? ranks[1] : 1);
  std::vector<Pane> leads;
  for (const Pane& pane : panes)
    if (rank(pane) >= least && leads.size() < 2) leads.push_back(pane);
  return leads;
}

const Pane* find(const std::vector<Pane>& panes, const std::string& id) {
  const auto found = std::find_if(panes.begin(), panes.end(), [&](const Pane& pane) { return pane.id == id; });
  return found == panes.end() ? nullptr : &*found;
}

}  // namespace

std::vector<Pane> stage_panes(const Header& header) {
  std::vector<Pane> panes{frame_pane};
  if (const Pane* depths = depth_pane_of(header)) panes.push_back(*depths);
  for (const Pane& pane : structure_panes(header)) panes.push_back(pane);
  for (const Pane* pane : {&canonical_pane, &slice_pane, &slice_view_pane, &section_pane, &depth_error_pane,
                           &depth_units_pane, &depth_curve_pane})
    if (!pane->serves || pane->serves(header)) panes.push_back(*pane);
  return panes;
}

Workspace workspace(const Header& header, const std::string& lead) {
  std::vector<Pane> panes = stage_panes(header);
  if (lead == chart_pane.id) panes.push_back(chart_pane);  // a lesson's, and of no run
  Workspace stage{usual_leads(panes, header), {}};
  if (const Pane* asked = find(panes, lead)) {
    const bool alone = asked->wide || find(stage.leading, lead);
    stage.leading.resize(alone ? 0 : 1, frame_pane);
    for (const Pane& pane : panes)
      if (pane.id == lead || lead_together(pane, lead)) stage.leading.push_back(pane);
  }
  for (const Pane& pane : panes)
    if (!only_leads(pane) && !find(stage.leading, pane.id)) stage.small.push_back(pane);
  return stage;
}

std::vector<Pane> lesson_pictures(const Header& header, const std::string& lead) {
  std::vector<Pane> leading = workspace(header, lead).leading;
  const Pane* asked = lead.empty() ? nullptr : find(leading, lead);
  if (!asked || asked->scrolls) return leading;
  if (asked->id == slice_pane.id) return {frame_pane, *asked};
  std::erase_if(leading, [&](const Pane& pane) { return pane.id != lead && !lead_together(pane, lead); });
  return leading;
}

bool lead_together(const Pane& pane, const std::string& lead) { return pane.with && pane.with->id == lead; }

std::vector<std::string> leads_to_choose(const Header& header) {
  std::vector<std::string> all{""};
  for (const Pane& pane : stage_panes(header))
    if (!pane.with || std::find(all.begin(), all.end(), pane.with->id) == all.end()) all.emplace_back(pane.id);
  return all;
}

void check_focus(const Lesson& lesson, const Header& header) {
  std::vector<Pane> panes = stage_panes(header);
  panes.push_back(chart_pane);
  for (const Stop& stop : lesson.stops) {
    if (stop.focus.empty() || find(panes, stop.focus)) continue;
    std::vector<std::string> names;
    for (const Pane& pane : panes) names.emplace_back(pane.id);
    throw InputError(fmt::format("{}:{}", lesson.path.string(), stop.line),
                     fmt::format("this run has no pane `{}`", stop.focus),
                     fmt::format("focus on one of {}", fmt::join(names, ", ")));
  }
}

}  // namespace zstep::viewer
