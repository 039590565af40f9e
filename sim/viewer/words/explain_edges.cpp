// The edge table, the active edge list and spans: x–y and z–y interpolation (000, "Double interpolation"; 001).
#include "sim/viewer/words/explain_parts.hpp"

#include <algorithm>

namespace zstep::words {
namespace {

const EdgeTableInsert* entry_of(const Telling& t, std::int32_t edge) {
  const auto at = static_cast<std::size_t>(edge);
  return edge >= 0 && at < t.machine.edge_table.size() ? &t.machine.edge_table[at] : nullptr;
}

std::string named(const Telling& t, std::int32_t edge) {
  const EdgeTableInsert* entry = entry_of(t, edge);
  if (!entry) return fmt::format("edge e{}", edge);
  const std::string label = edge_label(t.scene, *entry);
  return label[0] != 'e' ? "edge " + label : fmt::format("edge {} ({}\u2013{})", label, entry->vertex_0, entry->vertex_1);
}

/// The same without "edge" and without its ends.
std::string brief(const Telling& t, std::int32_t edge) {
  const EdgeTableInsert* entry = entry_of(t, edge);
  return entry ? edge_label(t.scene, *entry) : fmt::format("e{}", edge);
}

/// The scan-line method at work: a line is of all polygons.
bool all_at_once(const Telling& t) { return t.machine.keeps_all && t.machine.piece == -1; }

std::string with_capital(std::string text) {
  if (!text.empty() && text[0] >= 'a' && text[0] <= 'z') text[0] = static_cast<char>(text[0] - 'a' + 'A');
  return text;
}

/// x and depth of the edge before this step: from the last event that set them. Looks back over a scan line or two.
struct Before { double x, z; };
std::optional<Before> before_step(const Telling& t, std::int32_t edge) {
  constexpr std::int64_t far_enough = 65536;
  const std::int64_t first = std::max<std::int64_t>(1, t.after.position - far_enough);
  for (std::int64_t p = t.after.position - 1; p >= first; --p) {
    const Event& event = t.trace.event(p).event;
    if (const auto* step = std::get_if<EdgeStep>(&event); step && step->edge == edge) return Before{step->x_edge, step->z_edge};
    if (const auto* enter = std::get_if<EdgeEnter>(&event); enter && enter->edge == edge)
      if (const EdgeTableInsert* entry = entry_of(t, edge)) return Before{entry->x_edge, entry->z_edge};
    if (std::holds_alternative<PolygonBegin>(event)) break;
  }
  return std::nullopt;
}

std::string list_of_active(const Telling& t) {
  std::string text;
  for (const ActiveEdge& active : t.machine.active) {
    if (!text.empty()) text += ", ";
    text += fmt::format("{} at x = {}", brief(t, active.edge), number(active.x));
  }
  return text.empty() ? "none" : text;
}

}  // namespace

void tell(Telling& t, const EdgeTableInsert& e) {
  t.say(fmt::format("Edge {} from vertex {} to vertex {} first meets scan line {}, so it goes into bucket {}; it leaves at {}.",
                    edge_label(t.scene, e), vertex_label(t.scene, e.vertex_0), vertex_label(t.scene, e.vertex_1), e.first_row, e.first_row,
                    e.end_row));
  const auto a = on_raster(t.scene, t.after, e.vertex_0), b = on_raster(t.scene, t.after, e.vertex_1);
  if (a && b) {
    const double dx = (b->x - a->x) / (b->y - a->y), dz = (b->z - a->z) / (b->y - a->y);
    t.formula(fmt::format("1/m = (x_1 \u2212 x_0)/(y_1 \u2212 y_0) = ({} \u2212 {})/({} \u2212 {}) = {}", number(b->x), operand(a->x),
                          number(b->y), operand(a->y), number(e.dx_dy)));
    t.formula(fmt::format("x = x_0 + (x_1 \u2212 x_0)(y \u2212 y_0)/(y_1 \u2212 y_0) = {} = {}",
                          line_through(a->x, b->x, e.first_row, a->y, b->y), number(e.x_edge)));
    t.formula(fmt::format("dz/dy = ({} \u2212 {})/({} \u2212 {}) = {}", number(b->z), operand(a->z), number(b->y), operand(a->y),
                          number(e.dz_dy)));
    t.formula(fmt::format("{} = {} = {}", t.z, line_through(a->z, b->z, e.first_row, a->y, b->y), number(e.z_edge)));
    t.hold_against("1/m", e.dx_dy, dx);
    t.hold_against("dz/dy", e.dz_dy, dz);
    t.hold_against("x", e.x_edge, on_line(a->x, b->x, e.first_row, a->y, b->y));
    t.hold_against(t.z, e.z_edge, on_line(a->z, b->z, e.first_row, a->y, b->y));
  }
  t.value("x", e.x_edge);
  t.value("1/m", e.dx_dy);
  t.value(t.z, e.z_edge);
  t.value("dz/dy", e.dz_dy);
}

void tell(Telling& t, const EdgeTableSkip& e) {
  t.say(e.why == EdgeSkip::horizontal
            ? fmt::format("The edge from vertex {} to vertex {} is horizontal: it meets no scan line in one point and is left out.",
                          vertex_label(t.scene, e.vertex_0), vertex_label(t.scene, e.vertex_1))
            : fmt::format("The edge from vertex {} to vertex {} lies between two scan lines and meets none: it is left out.",
                          vertex_label(t.scene, e.vertex_0), vertex_label(t.scene, e.vertex_1)));
  const auto a = on_raster(t.scene, t.after, e.vertex_0), b = on_raster(t.scene, t.after, e.vertex_1);
  if (a && b) t.formula(fmt::format("y_0 = {}, y_1 = {}", number(a->y), number(b->y)));
}

void tell(Telling& t, const ScanLineBegin& e) {
  const auto waiting = std::count_if(t.machine.edge_table.begin(), t.machine.edge_table.end(), [&](const EdgeTableInsert& entry) {
    return t.machine.edge_stages[static_cast<std::size_t>(entry.edge)] == EdgeStage::waiting && entry.first_row == e.y;
  });
  t.say(fmt::format("Scan line y = {} of {}: {} active from the line before, {} waiting in its bucket.", e.y, all_at_once(t) ? "all polygons" : t.here(),
                    t.machine.active.size() == 1 ? "1 edge" : fmt::format("{} edges", t.machine.active.size()), waiting));
}

void tell(Telling& t, const EdgeEnter& e) {
  t.say(with_capital(fmt::format("{} begins at this scan line and enters the active edge list at place {}, sorted by x.",
                                 named(t, e.edge), e.place)));
  if (const EdgeTableInsert* entry = entry_of(t, e.edge)) {
    t.formula(fmt::format("x = {}, {} = {}, until y = {}", number(entry->x_edge), t.z, number(entry->z_edge), entry->end_row));
    t.value("x", entry->x_edge);
    t.value(t.z, entry->z_edge);
  }
}

void tell(Telling& t, const EdgeRetire& e) {
  t.say(with_capital(fmt::format("{} ends here and leaves the active edge list.", named(t, e.edge))));
  const EdgeTableInsert* entry = entry_of(t, e.edge);
  if (!entry || !t.machine.scan_line) return;
  const std::int32_t y = *t.machine.scan_line;
  if (y >= entry->end_row) return t.formula(fmt::format("y = {}, y_max = {}", y, entry->end_row));
  t.say(with_capital(fmt::format("Scan line {} was the last of {}: {} leaves the active edge list.", y, all_at_once(t) ? "all" : t.here(),
                                 named(t, e.edge))));
  t.formula(fmt::format("y + 1 = {}, y_max = {}", y + 1, entry->end_row));
}

void tell(Telling& t, const EdgeStep& e) {
  const std::int32_t y = t.machine.scan_line.value_or(0);
  t.say(with_capital(fmt::format("{} moves to scan line {}.", named(t, e.edge), y)));
  const EdgeTableInsert* entry = entry_of(t, e.edge);
  if (entry && t.conventions.interpolation == Conventions::Interpolation::increments) {
    if (const auto before = before_step(t, e.edge)) {
      t.formula(fmt::format("x = x + 1/m = {} + {} = {}", number(before->x), operand(entry->dx_dy), number(e.x_edge)));
      t.formula(fmt::format("{0} = {0} + d{1}/dy = {2} + {3} = {4}", t.z, "z", number(before->z), operand(entry->dz_dy),
                            number(e.z_edge)));
      t.hold_against("x", e.x_edge, before->x + entry->dx_dy);
      t.hold_against(t.z, e.z_edge, before->z + entry->dz_dy);
    }
  } else if (entry) {
    const auto a = on_raster(t.scene, t.after, entry->vertex_0), b = on_raster(t.scene, t.after, entry->vertex_1);
    if (a && b) {
      t.formula(fmt::format("x = x_0 + (x_1 \u2212 x_0)(y \u2212 y_0)/(y_1 \u2212 y_0) = {} = {}", line_through(a->x, b->x, y, a->y, b->y),
                            number(e.x_edge)));
      t.formula(fmt::format("{0} = z_0 + (z_1 \u2212 z_0)(y \u2212 y_0)/(y_1 \u2212 y_0) = {1} = {2}", t.z,
                            line_through(a->z, b->z, y, a->y, b->y), number(e.z_edge)));
      t.hold_against("x", e.x_edge, on_line(a->x, b->x, y, a->y, b->y));
      t.hold_against(t.z, e.z_edge, on_line(a->z, b->z, y, a->y, b->y));
    }
  }
  if (t.out.formulas.empty()) t.formula(fmt::format("x = {}, {} = {}", number(e.x_edge), t.z, number(e.z_edge)));
  t.value("x", e.x_edge);
  t.value(t.z, e.z_edge);
}

void tell(Telling& t, const EdgeSwap& e) {
  t.say(fmt::format("Places {} and {} of the active edge list change: left to right, x must not fall.", e.place, e.place + 1));
  t.formula(list_of_active(t));
}

void tell(Telling& t, const SpanBegin& e) {
  const std::int32_t count = std::max(0, e.last - e.first + 1);
  const std::string left = brief(t, e.left_edge), right = brief(t, e.right_edge);
  t.say(count == 0 ? fmt::format("Between {} and {} no pixel centre lies on scan line {}: nothing to draw.", left, right, e.y)
                   : fmt::format("Between {} and {} lie {} pixel{} of scan line {}: x = {} to {}.", left, right, count, count == 1 ? "" : "s", e.y,
                                 e.first, e.last));
  const bool inclusive = t.conventions.coverage == Conventions::Coverage::inclusive;
  t.formula(fmt::format("x_L = {}, x_R = {}; {}_L = {}, {}_R = {}", number(e.x_left), number(e.x_right), t.z, number(e.z_left), t.z,
                        number(e.z_right)));
  t.formula(inclusive ? fmt::format("drawn: {} to {}, both ends included", e.first, e.last)
                      : fmt::format("drawn: the x with {} \u2264 x < {}", number(e.x_left), number(e.x_right)));
  if (e.x_right != e.x_left) {
    const auto [z_left, z_right] = tell_apart(e.z_left, e.z_right);
    t.formula(fmt::format("dz/dx = (z_R \u2212 z_L)/(x_R \u2212 x_L) = ({} \u2212 {})/({} \u2212 {}) = {}", z_right, operand(e.z_left, z_left),
                          number(e.x_right), operand(e.x_left), number(e.dz_dx)));
    t.hold_against("dz/dx", e.dz_dx, (e.z_right - e.z_left) / (e.x_right - e.x_left));
  }
  t.value("x_L", e.x_left);
  t.value("x_R", e.x_right);
  t.value("z_L", e.z_left);
  t.value("z_R", e.z_right);
  t.value("dz/dx", e.dz_dx);
}

}  // namespace zstep::words
