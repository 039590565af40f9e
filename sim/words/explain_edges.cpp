// The edge table, the active edge list and spans: x–y and z–y interpolation (000, "Double interpolation"; 001); flags
// and intervals of the scan-line method (002, "Scan Line Algorithm").

#include <algorithm>

#include "sim/words/explain_parts.hpp"
#include "sim/answers/seen_point.hpp"
#include "traces/formulas/of_edges.hpp"
#include "traces/text.hpp"

namespace zstep::words {

namespace {

std::string named(const Telling& t, std::int32_t edge) {
  const EdgeTableInsert* entry = t.at.edge(edge);
  if (!entry) return fmt::format("edge e{}", edge);
  const std::string label = edge_label(t.scene, *entry);
  return label[0] != 'e' ? "edge " + label
                         : fmt::format("edge {} ({}\u2013{})", label, entry->vertex_0, entry->vertex_1);
}

/// The same without "edge" and without its ends.
std::string brief(const Telling& t, std::int32_t edge) {
  const EdgeTableInsert* entry = t.at.edge(edge);
  return entry ? edge_label(t.scene, *entry) : fmt::format("e{}", edge);
}

/// The scan-line method at work: a line is of all polygons.
bool all_at_once(const Telling& t) { return t.machine.keeps_all && t.machine.piece == -1; }

/// x and depth of the edge before this step: from the last event that set them. Looks back over a scan line or two.
struct Before {
  double x, z;
};
std::optional<Before> before_step(const Telling& t, std::int32_t edge) {
  constexpr std::int64_t far_enough = 65536;
  const std::int64_t first = std::max<std::int64_t>(1, t.after.position - far_enough);
  for (std::int64_t p = t.after.position - 1; p >= first; --p) {
    const Event& event = t.trace.event(p).event;
    if (const auto* step = get_if<EdgeStep>(&event); step && step->edge == edge)
      return Before{step->x_edge, step->z_edge};
    if (const auto* enter = get_if<EdgeEnter>(&event); enter && enter->edge == edge)
      if (const EdgeTableInsert* entry = t.at.edge(edge)) return Before{entry->x_edge, entry->z_edge};
    if (holds<PolygonBegin>(event)) break;
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

/// Every declared coverage but the inclusive one is half-open from scan line to scan line.
bool leaves_out_ends(const Header& header) {
  return header.declares(Convention::coverage) && header.conventions.coverage != Conventions::Coverage::inclusive;
}

}  // namespace

void tell(Telling& t, const EdgeTableInsert& e) {
  const std::string edge = fmt::format("dge {} from vertex {} to vertex {}", edge_label(t.scene, e),
                                       vertex_label(t.scene, e.vertex_0), vertex_label(t.scene, e.vertex_1));
  t.say(fmt::format("E{} first meets scan line {}, so it goes into bucket {}; it leaves at {}.", edge, e.first_row,
                    e.first_row, e.end_row));
  t.derive(e);
  t.follows("1/m", "dx_dy", e.dx_dy);
  t.follows("x", "x_edge", e.x_edge);
  t.follows("dz/dy", "dz_dy", e.dz_dy);
  t.follows(t.along, "z_edge", e.z_edge);
  const bool first_agrees = t.whole("first scan line", "first_row", e.first_row),
             end_agrees = t.whole("leaves at y", "end_row", e.end_row);
  if (!first_agrees || !end_agrees)
    t.say(fmt::format(
        "The trace lets e{} begin at scan line {} and leave at {}; its ends are at y = {} and {}, so it "
        "should begin at {} and leave at {}.",
        edge, e.first_row, e.end_row, number(t.at.on_raster(e.vertex_0)->y), number(t.at.on_raster(e.vertex_1)->y),
        *t.derived_of("first_row")->within, *t.derived_of("end_row")->within));
  t.value("x", e.x_edge);
  t.value("1/m", e.dx_dy);
  t.value(t.along, e.z_edge);
  t.value("dz/dy", e.dz_dy);
}

void tell(Telling& t, const EdgeTableSkip& e) {
  const std::string edge = fmt::format("edge from vertex {} to vertex {}", vertex_label(t.scene, e.vertex_0),
                                       vertex_label(t.scene, e.vertex_1));
  const bool horizontal = e.why == EdgeSkip::horizontal;
  const auto a = t.at.on_raster(e.vertex_0), b = t.at.on_raster(e.vertex_1);
  const double from = a && b ? std::min(a->y, b->y) : 0, to = a && b ? std::max(a->y, b->y) : 0;
  // Half-open: an edge that ends on a scan line does not meet it.
  const double first = std::ceil(from), end = std::ceil(to), height = t.scene.raster.height;
  const double first_within = std::clamp(first, 0.0, height);
  if (!a || !b)
    return t.say(fmt::format("The trace leaves out the {} as {}.", edge,
                             horizontal ? "horizontal" : "lying between two scan lines"));
  const bool beside = !horizontal && first < end && first_within >= std::min(end, height);
  const bool on_line = to == std::floor(to);
  if (beside)
    t.say(fmt::format("The {} lies {} the raster and meets none of its scan lines: it is left out.", edge,
                      to <= 0 ? "above" : "below"));
  else if (horizontal)
    t.say(fmt::format("The {} is horizontal: it meets no scan line in one point and is left out.", edge));
  else if (on_line)
    t.say(fmt::format(
        "The {} ends on scan line {}, where {}it is no longer met, and meets none before it: it is left out.", edge,
        number(to), leaves_out_ends(t.trace.header()) ? "by the half-open rule " : ""));
  else t.say(fmt::format("The {} lies between two scan lines and meets none: it is left out.", edge));
  if (horizontal && from != to)
    t.contradict(fmt::format("The trace leaves out the {} as horizontal, but it is not: {} \u2260 {}.", edge,
                             number(a->y), number(b->y)));
  if (!horizontal && first_within < std::min(end, height))
    t.contradict(fmt::format("The trace leaves out the {} as lying between two scan lines, but it meets scan line {}.",
                             edge, number(first_within)));
  else if (!horizontal && from == to && on_line)
    t.contradict(
        fmt::format("The trace leaves out the {} as lying between two scan lines, but it is horizontal and "
                    "lies on scan line {}.",
                    edge, number(to)));
  t.formula(fmt::format("y_0 = {}, y_1 = {}", number(a->y), number(b->y)));
}

void tell(Telling& t, const ScanLineBegin& e) {
  const auto waiting =
      std::count_if(t.machine.edge_table.begin(), t.machine.edge_table.end(), [&](const EdgeTableInsert& entry) {
        return t.machine.edge_stages[entry.edge] == EdgeStage::waiting && entry.first_row == e.y;
      });
  t.say(fmt::format("Scan line y = {} of {}: {} active from the line before, {} waiting in its bucket.", e.y,
                    all_at_once(t) ? "all polygons" : t.here(),
                    t.machine.active.size() == 1 ? "1 edge" : fmt::format("{} edges", t.machine.active.size()),
                    waiting));
}

void tell(Telling& t, const EdgeEnter& e) {
  t.say(
      with_capital(fmt::format("{} begins at this scan line and enters the active edge list at place {}, sorted by x.",
                               named(t, e.edge), e.place)));
  const std::size_t place = e.place;
  const auto& active = t.machine.active;
  const auto out_of_order = [&](std::size_t left) { return formulas::detail::out_of_order(active, left); };
  if (out_of_order(place) || (place > 0 && out_of_order(place - 1))) {
    const ActiveEdge &one = active[out_of_order(place) ? place : place - 1],
                     &other = active[out_of_order(place) ? place + 1 : place];
    t.contradict(with_capital(fmt::format(
        "{} begins at this scan line and enters the active edge list at place {}, which leaves it unsorted: {} at x = "
        "{} is left of {} at x = {}.",
        named(t, e.edge), e.place, brief(t, one.edge), number(one.x), brief(t, other.edge), number(other.x))));
  }
  if (const EdgeTableInsert* entry = t.at.edge(e.edge)) {
    t.owns("x", t.about), t.owns(t.along, t.about);
    t.formula(fmt::format("x = {}, {} = {}; {} leaves at y = {}", number(entry->x_edge), t.along, number(entry->z_edge),
                          brief(t, e.edge), entry->end_row));
    t.value("x", entry->x_edge);
    t.value(t.along, entry->z_edge);
  }
}

void tell(Telling& t, const EdgeRetire& e) {
  t.say(with_capital(fmt::format("{} ends here and leaves the active edge list.", named(t, e.edge))));
  const EdgeTableInsert* entry = t.at.edge(e.edge);
  if (!entry || !t.machine.scan_line) return;
  const std::int32_t y = *t.machine.scan_line, end = entry->end_row;
  const std::string leaves = fmt::format("{} leaves at y = {}", brief(t, e.edge), end);
  t.formula(y >= end ? fmt::format("{}: y = {}", leaves, y) : fmt::format("{}: y + 1 = {}", leaves, y + 1));
  if (y != end && y + 1 != end)
    return t.contradict(with_capital(fmt::format(
        "{} leaves the active edge list at scan line {}, though it is to leave at {}.", named(t, e.edge), y, end)));
  if (y == end) return;
  const auto goes_on = [&](const ActiveEdge& active) {
    const EdgeTableInsert* other = t.at.edge(active.edge);
    return other && other->end_row > end;
  };
  const bool last_of_all = std::none_of(t.machine.active.begin(), t.machine.active.end(), goes_on);
  t.say(with_capital(last_of_all ? fmt::format("Scan line {} was the last of {}: {} leaves the active edge list.", y,
                                               all_at_once(t) ? "all" : t.here(), named(t, e.edge))
                                 : fmt::format("Scan line {} was the last of {}, which leaves the active edge list.", y,
                                               named(t, e.edge))));
}

void tell(Telling& t, const EdgeStep& e) {
  const std::int32_t y = t.machine.scan_line.value_or(0);
  t.say(with_capital(fmt::format("{} moves to scan line {}.", named(t, e.edge), y)));
  if (!t.at.adds_slopes()) t.derive(e);
  else if (const auto before = before_step(t, e.edge))
    t.derive_from(e, [&](MethodState& machine) {
      for (ActiveEdge& active : machine.active)
        if (active.edge == e.edge) active.x = before->x, active.z = before->z;
    });
  t.follows("x", "x_edge", e.x_edge);
  t.follows(t.along, "z_edge", e.z_edge);
  t.owns("x", t.about), t.owns(t.along, t.about);
  if (t.out.formulas.empty())
    t.formula(fmt::format("x = {}, {} = {}", number(e.x_edge), t.along, number(e.z_edge)), "x_edge");
  t.value("x", e.x_edge);
  t.value(t.along, e.z_edge);
}

void tell(Telling& t, const EdgeSwap& e) {
  t.say(fmt::format("Places {} and {} of the active edge list change: left to right, x must not fall.", e.place,
                    e.place + 1));
  t.formula(list_of_active(t));
  const std::size_t left = e.place;
  if (!formulas::detail::out_of_order(t.machine.active, left)) return;
  const ActiveEdge &one = t.machine.active[left], &other = t.machine.active[left + 1];
  t.contradict(
      fmt::format("Places {} and {} of the active edge list change, though they were in order: now {} at x = {} is "
                  "left of {} at x = {}.",
                  e.place, e.place + 1, brief(t, one.edge), number(one.x), brief(t, other.edge), number(other.x)));
}

void tell(Telling& t, const PlaneSlopes& e) {
  t.say(fmt::format("On the plane of {} depth gains {} from pixel to pixel and {} from line to line.",
                    polygon_label(t.scene, e.polygon), number(e.dz_dx), number(e.dz_dy)));
  t.value("dz/dx", e.dz_dx);
  t.value("dz/dy", e.dz_dy);
  t.derive(e);
  t.follows("-A/C", "dz_dx", e.dz_dx);
  t.follows("-B/C", "dz_dy", e.dz_dy);
}

void tell(Telling& t, const SpanBegin& e) {
  const std::int32_t count = std::max(0, e.last - e.first + 1);
  const std::string left = brief(t, e.left_edge), right = brief(t, e.right_edge);
  t.say(count == 0   ? fmt::format("Between {} and {} no pixel {} lies on scan line {}: nothing to draw.", left, right,
                                   seen_point(t.scene.raster), e.y)
        : count == 1 ? fmt::format("Between {} and {} lies 1 pixel of scan line {}: x = {}.", left, right, e.y, e.first)
                     : fmt::format("Between {} and {} lie {} pixels of scan line {}: x = {} to {}.", left, right, count,
                                   e.y, e.first, e.last));
  const auto [z_l, z_r] = tell_apart(e.z_left, e.z_right);
  for (const std::string& symbol : {std::string("x_L"), std::string("x_R"), t.along + "_L", t.along + "_R"})
    t.owns(symbol, polygon_at_work(t.machine));
  t.formula(fmt::format("x_L = {}, x_R = {}; {}_L = {}, {}_R = {}", number(e.x_left), number(e.x_right), t.along, z_l,
                        t.along, z_r));
  t.derive(e);
  const bool first_agrees = t.whole("first", "first", e.first), last_agrees = t.whole("last", "last", e.last);
  if (!first_agrees || !last_agrees) {
    const std::int32_t ought_first = *t.derived_of("first")->within, ought_last = *t.derived_of("last")->within;
    t.say(fmt::format(
        "The trace fills x = {} to {} of scan line {} between {} and {}; by x_L = {} and x_R = {} it should fill {}.",
        e.first, e.last, e.y, left, right, number(e.x_left), number(e.x_right),
        ought_last < ought_first ? "nothing" : fmt::format("{} to {}", ought_first, ought_last)));
  }
  t.follows("dz/dx", "dz_dx", e.dz_dx);
  t.value("x_L", e.x_left);
  t.value("x_R", e.x_right);
  t.value("z_L", e.z_left);
  t.value("z_R", e.z_right);
  t.value("dz/dx", e.dz_dx);
}

// The scan-line method: flags, intervals of the line, implied edges, coverage (002, "Scan Line Algorithm").

namespace {

std::string edge(const Telling& t, std::int32_t number) {
  const EdgeTableInsert* entry = t.at.edge(number);
  return entry ? edge_label(t.scene, *entry) : fmt::format("e{}", number);
}

std::string names_inside(const Telling& t) {
  std::string names;
  for (const std::int32_t piece : t.machine.sweep.inside) names += (names.empty() ? "" : ", ") + t.piece(piece);
  return names;
}

/// The depth of a piece's plane, held against what was recorded.
void depth_formula(Telling& t, std::int32_t piece, double x, double y, double z) {
  t.derive(PlaneDepth{piece, x, y, z});
  t.follows(fmt::format("{} of {}", t.z, t.piece(piece)), "z", z);
}

}  // namespace

void tell(Telling& t, const FlagFlip& e) {
  t.say(
      e.inside
          ? fmt::format("The sweep crosses edge {}: the flag of {} turns to in.", edge(t, e.edge), t.piece(e.piece))
          : fmt::format("The sweep crosses edge {}: the flag of {} turns to out.", edge(t, e.edge), t.piece(e.piece)));
  const std::string names = names_inside(t);
  t.formula(names.empty() ? "in: none" : "in: " + names);
}

void tell(Telling& t, const SpanFlags& e) {
  const std::string pixels = e.last < e.first    ? "no pixel"
                             : e.first == e.last ? fmt::format("pixel {}", e.first)
                                                 : fmt::format("pixels {} to {}", e.first, e.last);
  const std::string what =
      e.last < e.first ? fmt::format("it holds no pixel's {}, so nothing is to be done", seen_point(t.scene.raster))
      : e.flags == 0   ? "no flag is true, so nothing is drawn"
      : e.flags == 1   ? fmt::format("only {} is in, so {} is seen", names_inside(t), names_inside(t))
                       : fmt::format("{} are in, so the frontmost must be found", names_inside(t));
  t.say(fmt::format("From here to the next edge: {}.", what));
  t.formula(fmt::format("x = {} to {}: {}, {} flag{} true", number(e.x_left), number(e.x_right), pixels, e.flags,
                        e.flags == 1 ? "" : "s"));
  t.value("x_L", e.x_left);
  t.value("x_R", e.x_right);
}

void tell(Telling& t, const PlaneDepth& e) {
  t.say(fmt::format("The plane of {} has the depth {} at x = {}, y = {}.", t.piece(e.piece), number(e.z),
                    number(e.x_at), number(e.y_at)));
  depth_formula(t, e.piece, e.x_at, e.y_at, e.z);
  t.value("x", e.x_at);
  t.value("y", e.y_at);
  t.value(t.z, e.z);
}

void tell(Telling& t, const ImpliedEdge& e) {
  t.say(fmt::format("Up to x = {} {} is in front, from there on {}: the two penetrate each other in an implied edge.",
                    number(e.x_at), t.piece(e.piece), t.piece(e.other)));
  if (t.machine.scan_line) {
    const double y = *t.machine.scan_line;
    depth_formula(t, e.piece, e.x_at, y, e.z);
    depth_formula(t, e.other, e.x_at, y, e.z);
  }
  t.value("x", e.x_at);
  t.value(t.z, e.z);
}

void tell(Telling& t, const SpanWinner& e) {
  t.say(e.last < e.first ? fmt::format("{} is seen, but between two pixels' {}s: no pixel shows it.", t.piece(e.piece),
                                       seen_point(t.scene.raster))
        : e.first == e.last ? fmt::format("{} is seen at pixel {}.", t.piece(e.piece), e.first)
                            : fmt::format("{} is seen from pixel {} to pixel {}.", t.piece(e.piece), e.first, e.last));
}

void tell(Telling& t, const CoverageAdd& e) {
  const std::string who = e.owner == no_polygon ? "Nothing but background" : t.label(e.owner);
  t.say(fmt::format("{} is seen on {} % of the area of pixel ({}, {}).", who, number(100 * e.coverage, 1, true), e.x,
                    e.y));
  t.formula(fmt::format("share = {}", number(e.coverage)), "coverage");
  t.value("share", e.coverage);
}

}  // namespace zstep::words
