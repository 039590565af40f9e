#include "sim/words/explain.hpp"

#include <algorithm>

#include "sim/words/explain_parts.hpp"

namespace zstep {

std::string polygon_label(const Scene& scene, std::int32_t polygon) {
  if (polygon < 0) return "background";
  const std::size_t at = polygon;
  if (at < scene.polygons.size() && !scene.polygons[at].name->empty()) return *scene.polygons[at].name;
  return fmt::format("P{}", polygon);
}

std::int32_t polygon_at_work(const MethodState& machine) {
  if (machine.polygon != no_polygon || !machine.span) return machine.polygon;
  const std::size_t edge = machine.span->left_edge;
  return machine.span->left_edge >= 0 && edge < machine.edge_table.size() ? machine.edge_table[edge].polygon
                                                                          : no_polygon;
}

namespace {

/// 0 where the vertex has no letter.
char letter_of(const Scene& scene, std::int32_t vertex) {
  constexpr std::size_t few = 100;  // facets; nobody names more polygons by their corners
  for (std::size_t k = 0; k < std::min(few, scene.facets.size()); ++k) {
    const Facet& facet = scene.facets[k];
    const std::string& name = *scene.polygons[facet.polygon].name;
    if (name.size() != static_cast<std::size_t>(facet.corner_count)) continue;
    for (std::size_t i = 0; i < name.size(); ++i)
      if (scene.corners[static_cast<std::size_t>(facet.first_corner) + i] == vertex && name[i] >= 'A' && name[i] <= 'Z')
        return name[i];
  }
  return 0;
}

}  // namespace

std::string vertex_label(const Scene& scene, std::int32_t vertex) {
  const char letter = letter_of(scene, vertex);
  return letter ? std::string(1, letter) : fmt::format("{}", vertex);
}

std::string edge_label(const Scene& scene, const EdgeTableInsert& edge) {
  const char from = letter_of(scene, edge.vertex_0), to = letter_of(scene, edge.vertex_1);
  return from && to ? std::string{from, to} : fmt::format("e{}", edge.edge);
}

std::string undeclared_text(const Header& header, bool tie) {
  if (tie) return header.declares(Convention::ties) ? "" : "its header does not declare which of equal depths wins";
  return header.declares(Convention::nearer) ? "" : "its header does not declare which depth is nearer";
}

std::string depth_symbol(const Scene& scene, const Conventions& conventions) {
  if (scene.camera.kind == Camera::Kind::screen) return "z";
  constexpr ByEnum<Conventions::Depth, const char*> symbols{"z*", "z_v", "z_v", "1/z_v", "z_r", "z_F", "z_01"};
  return symbols[conventions.depth];
}

std::string_view rounding_word(const Conventions& conventions) {
  if (bits_of(conventions.number_format) == 0) return "";
  return conventions.rounding == Conventions::Rounding::nearest ? "rounded" : "cut off";
}

std::string as_held(double computed, double recorded, const std::string& is, std::string_view word) {
  const std::string ought = number(computed);
  return word.empty() || ought == number(recorded) ? is : fmt::format("{}, {} to {}", ought, word, is);
}

std::string symbol_along(const Scene& scene, const Conventions& conventions) {
  const bool inverse = conventions.depth == Conventions::Depth::corrected;
  return inverse && scene.camera.kind == Camera::Kind::perspective ? "1/z_v" : depth_symbol(scene, conventions);
}

namespace {

/// The polygon whose numbers an event gives; no_polygon where they are also another one's.
std::int32_t polygon_about(const Event& event, const formulas::Situation& at) {
  return visit_event(
      [&]<class E>(const E& e) {
        using In = formulas::Place::In;
        if constexpr (
            requires { e.plane_of; } || requires { e.other; })
          return no_polygon;
        else if constexpr (requires { e.polygon; }) return static_cast<std::int32_t>(e.polygon);
        else if constexpr (requires { e.piece; }) return words::owner_of(at, {In::piece, e.piece}, "");
        else if constexpr (requires { e.edge; }) return words::owner_of(at, {In::edge_table, e.edge}, "");
        else if constexpr (requires { e.vertex; }) return words::owner_of(at, {In::vertex, e.vertex}, "");
        else return polygon_at_work(at.method());
      },
      event);
}

}  // namespace

Explanation explain(const Trace& trace, const State& after, const RecordedEvent event) {
  words::Telling telling(trace, after);
  telling.about = polygon_about(event.event, telling.at);
  visit_event([&](const auto& e) { words::tell(telling, e); }, event.event);
  return std::move(telling.out);
}

}  // namespace zstep
