// All polygons at once: pieces, their planes and extents, how they are cut and painted (001, 002).
#include "sim/words/explain_parts.hpp"

#include <algorithm>

namespace zstep::words {
namespace {

/// The plane's value at a vertex that was found a few events ago.
std::optional<double> value_found(const Telling& t, std::int32_t vertex) {
  const std::int64_t first = std::max<std::int64_t>(1, t.after.position - 256);
  for (std::int64_t p = t.after.position - 1; p >= first; --p) {
    const Event& event = t.trace.event(p).event;
    if (const auto* found = get_if<VertexSide>(&event); found && found->vertex == vertex) return found->value;
    if (holds<PieceMake>(event)) break;
  }
  return std::nullopt;
}

}  // namespace

void tell(Telling& t, const TablesBegin& e) {
  t.say(fmt::format(
      "This method needs all {} polygons at once: from here on, vertices and pieces of all of them are kept.",
      e.polygons));
}

void tell(Telling& t, const PieceMake& e) {
  const auto at = static_cast<std::size_t>(e.piece);
  const std::size_t corners = at < t.machine.pieces.size() ? t.machine.pieces[at].outline.size() : 0;
  if (e.parent < 0)
    t.say(fmt::format("What is left of polygon {} to be drawn becomes piece {}: {} corners.", t.label(e.polygon),
                      e.piece, corners));
  else
    t.say(fmt::format("One part of {} becomes a piece of its own, {}: {} corners.", t.piece(e.parent), t.piece(e.piece),
                      corners));
}

void tell(Telling& t, const PlaneEquation& e) {
  t.say(fmt::format("The plane of {}: what lies on one side of it has {} > 0, on the other < 0.", t.piece(e.piece),
                    plane_in_symbols(cutting_names(t))));
  for (const char* symbol : {"A", "B", "C", "D"}) t.owns(symbol, t.about);
  t.formula(fmt::format("A = {}, B = {}, C = {}, D = {}", factor(e.plane_a), factor(e.plane_b), factor(e.plane_c),
                        number(e.plane_d)));
  t.value("A", e.plane_a);
  t.value("B", e.plane_b);
  t.value("C", e.plane_c);
  t.value("D", e.plane_d);
}

void tell(Telling& t, const Extent& e) {
  t.say(fmt::format("The extents of {}: the box between its least and greatest coordinates.", t.piece(e.piece)));
  t.formula(fmt::format("x: {} \u2026 {}", number(e.x_min), number(e.x_max)));
  t.formula(fmt::format("y: {} \u2026 {}", number(e.y_min), number(e.y_max)));
  t.formula(fmt::format("{}: {} \u2026 {}", t.z, number(e.z_min), number(e.z_max)));
  for (const auto& [name, value] : {std::pair{"x_min", e.x_min},
                                    {"x_max", e.x_max},
                                    {"y_min", e.y_min},
                                    {"y_max", e.y_max},
                                    {"z_min", e.z_min},
                                    {"z_max", e.z_max}})
    t.value(name, value);
}

void tell(Telling& t, const SplitVertex& e) {
  t.say(fmt::format("The edge from vertex {} to vertex {} crosses the plane: a new vertex {} is made there.",
                    e.vertex_0, e.vertex_1, e.vertex));
  const auto d0 = value_found(t, e.vertex_0), d1 = value_found(t, e.vertex_1);
  if (d0 && d1) {
    t.gives("t", formulas::where_zero(Shown("d_0", *d0), Shown("d_1", *d1)), e.t);
  } else {
    t.formula(fmt::format("t = {} = {}   d: {} at either end",
                          in_symbols([](auto&& name) { return formulas::where_zero(name("d_0"), name("d_1")); }),
                          number(e.t), plane_in_symbols(cutting_names(t))));
  }
  t.formula(
      fmt::format("{} = ({}, {}, {})", point_on_way("V_0", "V_1"), number(e.x_cut), number(e.y_cut), number(e.z_cut)));
  t.value("t", e.t);
  t.value("x", e.x_cut);
  t.value("y", e.y_cut);
  t.value("z", e.z_cut);
  t.derive(e);
  t.hold_derived("x", "x_cut", e.x_cut);
  t.hold_derived("y", "y_cut", e.y_cut);
  t.hold_derived("z", "z_cut", e.z_cut);
}

void tell(Telling& t, const PieceDraw& e) {
  t.say(fmt::format("{} is drawn, over whatever is there.", t.piece(e.piece)));
  t.formula(fmt::format("number {} to be drawn", t.machine.drawn.size()));
}

void tell(Telling& t, const PixelPaint& e) {
  const Fragment* f = t.machine.fragment ? &*t.machine.fragment : nullptr;
  const std::string before =
      f ? fmt::format(" It showed {}; nobody asks which is nearer.", t.label(f->stored_polygon)) : "";
  t.say(fmt::format("Pixel ({}, {}) takes the colour of {}.{}", e.x, e.y, t.label(e.polygon), before));
  t.value(t.z, e.z);
  t.derive(e);
  if (t.derived_of("z") == nullptr) return t.formula(fmt::format("{} = {}", t.z, number(e.z)));
  t.depth_on_span(e.z);
}

}  // namespace zstep::words
