#include "sim/viewer/panes/pane.hpp"

#include <fmt/format.h>

#include "sim/words/numbers.hpp"

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

}  // namespace zstep::viewer
