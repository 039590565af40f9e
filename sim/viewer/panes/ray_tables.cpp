// Tables of the rays of the pixel at work: what the one at work is tested against, and the tree of all of them.

#include <algorithm>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "sim/viewer/panes/number_table.hpp"
#include "sim/viewer/panes/pane.hpp"
#include "sim/viewer/panes/ray_plan.hpp"
#include "sim/words/explain.hpp"
#include "sim/words/numbers.hpp"

namespace zstep::viewer {
namespace {

std::string facet_label(const Scene& scene, std::int32_t facet) {
  if (facet < 0 || facet >= std::ssize(scene.facets)) return "\u2013";
  return polygon_label(scene, scene.facets[facet].polygon);
}

template <class E>
bool just(const Session& s) {
  return s.event() && holds<E>(s.event()->event);
}

/// What the ray at work is about: where it was cast, and what for.
std::string ray_at_work(const RayWork& rays) {
  const RayBegin* const ray = ray_in(rays);
  return ray ? fmt::format("{},{} {} ", ray->x, ray->y, word_of(ray->role)) : "";
}

}  // namespace

std::vector<TableRow> ray_test_rows(Ui& ui) {
  const Session& s = ui.session;
  const RayWork& rays = s.state().machine.rays;
  const std::string ray = ray_at_work(rays);
  std::vector<TableRow> rows;
  for (const CellVisit& visit : rays.cells) {
    TableRow row;
    const auto asks = [&](const char* field) {
      return answers::made_by<CellVisit>(
          s.position(), field, {{"cell_x", visit.cell_x}, {"cell_y", visit.cell_y}, {"cell_z", visit.cell_z}});
    };
    row.cells = {fmt::format("cell {},{},{}", visit.cell_x, visit.cell_y, visit.cell_z),
                 TableCell(visit.t_enter, asks("t_enter")), TableCell(visit.t_leave, asks("t_leave")),
                 std::string("entered")};
    row.about = ray + row.cells[0].text;
    if (just<CellVisit>(s) && &visit == &rays.cells.back()) row.look = TableRow::Look::now;
    rows.push_back(std::move(row));
  }
  for (const BoxTest& test : rays.boxes) {
    TableRow row;
    const bool meets = test.t_enter <= test.t_leave;
    const auto asks = [&](const char* field) {
      return answers::made_by<BoxTest>(s.position(), field, {{"box", test.box}});
    };
    row.cells = {fmt::format("box {}", test.box), TableCell(test.t_enter, asks("t_enter")),
                 TableCell(test.t_leave, asks("t_leave")),
                 TableCell::result_of(test.hit ? "met"
                                      : meets  ? "too far"
                                               : "missed")};
    row.about = ray + row.cells[0].text;
    if (!test.hit) row.look = TableRow::Look::gone;
    if (just<BoxTest>(s) && &test == &rays.boxes.back()) row.look = TableRow::Look::now;
    rows.push_back(std::move(row));
  }
  double kept = std::numeric_limits<double>::quiet_NaN();  // the smallest t so far
  for (const RayHit& hit : rays.hits) {
    TableRow row;
    row.cells = {facet_label(s.scene(), hit.facet),
                 TableCell(hit.t, answers::made_by<RayHit>(s.position(), "t", {{"facet", hit.facet}})), std::string(),
                 TableCell::result_of(hit.nearest     ? "nearest so far"
                                      : !hit.inside   ? "outside"
                                      : hit.t == kept ? "inside, as near"
                                                      : "inside, farther",
                                      hit.nearest     ? "nearest"
                                      : !hit.inside   ? "outside"
                                      : hit.t == kept ? "as near"
                                                      : "farther")};
    row.about = ray + row.cells[0].text;
    if (hit.nearest) kept = hit.t;
    if (!hit.nearest) row.look = TableRow::Look::gone;
    if (just<RayHit>(s) && &hit == &rays.hits.back()) row.look = TableRow::Look::now;
    rows.push_back(std::move(row));
  }
  return rows;
}

namespace {

void draw_tests(Ui& ui) {
  if (ui.session.state().machine.rays.tree.empty()) return say_empty(ui, "Empty: no ray was cast yet.");
  const std::vector<TableRow> rows = rows_of_both(ui, ray_test_rows);
  if (rows.empty()) return say_empty(ui, "Empty: the ray met nothing yet between the near and the far plane.");
  number_table(ui, "ray_tests", {"", "t", "t_leave", ""}, rows);
}

std::string note_tests(Ui& ui) {
  const std::int64_t tested = ui.session.state().machine.rays.planes_tested;
  return tested == 1 ? "1 plane met" : fmt::format("{} planes met", tested);
}

bool serves_tests(const Header& header) { return records<RayBegin>(header) && !records<ColorWrite>(header); }

int depth_in(const RayWork& rays, const RayRow& row) {
  int depth = 0;
  std::int32_t parent = row.entry.parent;
  for (std::size_t i = rays.tree.size(); i-- > 0 && parent >= 0;) {
    if (rays.tree[i].entry.ray == parent) ++depth, parent = rays.tree[i].entry.parent;
  }
  return depth;
}

}  // namespace

std::vector<TableRow> ray_tree_rows(Ui& ui) {
  const Session& s = ui.session;
  const RayWork& rays = s.state().machine.rays;
  constexpr ByEnum<RayRole, const char*> roles{"eye", "mirrored", "transmitted", "to the light"};
  constexpr ByEnum<RayRole, const char*> brief_roles{"eye", "mirror", "transm.", "light"};
  std::vector<TableRow> rows;
  for (const RayRow& ray : rays.tree) {
    TableRow row;
    std::string branch;
    for (int i = depth_in(rays, ray); i > 0; --i) branch += i == 1 ? "\u2514 " : "  ";
    const RayRole role = ray.entry.role;
    row.cells = {branch + roles[role]};
    row.cells.back().brief = branch + brief_roles[role];
    row.about = fmt::format("{},{} {}", ray.entry.x, ray.entry.y, row.cells[0].text);
    if (ray.end) {
      row.cells.push_back(TableCell::result_of(facet_label(s.scene(), ray.end->nearest_facet)));
      if (ray.end->nearest_facet >= 0)
        row.cells.emplace_back(ray.end->t, answers::made_by<RayEnd>(s.position(), "t", {{"ray", ray.entry.ray}}));
      else row.cells.emplace_back(std::string());
      if (ray.entry.role == RayRole::shadow) {
        row.cells.push_back(TableCell::result_of(ray.end->nearest_facet >= 0 ? "dark" : "lit"));
      } else {
        const auto part = [](double v) { return nearest_byte(255 * std::clamp(v, 0.0, 1.0)); };
        const Color color{part(ray.end->red), part(ray.end->green), part(ray.end->blue)};
        row.cells.emplace_back(fmt::format("{} {} {}", color.red, color.green, color.blue), to_im(opaque(color)));
        row.cells.back().result = true;
        row.cells.back().brief = fmt::format("{:02x}{:02x}{:02x}", color.red, color.green, color.blue);
      }
    } else {
      row.cells.insert(row.cells.end(), {std::string("\u2026"), std::string(), std::string()});
    }
    if (ray_now(s) == ray.entry.ray) row.look = TableRow::Look::now;
    rows.push_back(std::move(row));
  }
  return rows;
}

namespace {

void draw_tree(Ui& ui) {
  if (ui.session.state().machine.rays.tree.empty()) return say_empty(ui, "Empty: no ray was cast yet.");
  number_table(ui, "ray_tree", {"ray", "meets", "t", "colour"}, rows_of_both(ui, ray_tree_rows));
}

std::string note_tree(Ui& ui) {
  const std::size_t rays = ui.session.state().machine.rays.tree.size();
  return rays == 1 ? "1 ray" : fmt::format("{} rays", rays);
}

bool serves_tree(const Header& header) { return records<RayBegin>(header) && records<ColorWrite>(header); }

}  // namespace

const Pane ray_tests_pane{"ray_tests", "THIS RAY", draw_tests, note_tests, serves_tests,
                          0.3f,        true,       nullptr,    false,      none_yet<RayBegin>};
const Pane ray_tree_pane{"ray_tree", "RAY TREE", draw_tree, note_tree, serves_tree,
                         0.34f,      true,       nullptr,   false,     none_yet<RayBegin>};

}  // namespace zstep::viewer
