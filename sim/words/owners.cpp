#include "sim/words/owners.hpp"

#include <algorithm>
#include <functional>

#include "sim/words/explain.hpp"
#include "traces/formulas/of_polygons.hpp"

namespace zstep::words {
namespace {

using Kind = Notation::Kind;
using In = formulas::Place::In;

constexpr std::size_t few_facets = 2000;  // that are searched for a vertex

template <class Numbers>
bool contains(const Numbers& numbers, std::int32_t one) {
  return std::find(numbers.begin(), numbers.end(), one) != numbers.end();
}

std::int32_t polygon_of_facet(const Scene& scene, std::int32_t facet) {
  const std::size_t at = facet;
  return facet >= 0 && at < scene.facets.size() ? scene.facets[at].polygon : no_polygon;
}

/// The one at work where it has this vertex; else the only one that has it.
std::int32_t owner_of_vertex(const formulas::Situation& at, std::int32_t vertex) {
  const MethodState& method = at.method();
  const std::int32_t own = polygon_of_facet(at.scene, method.facet);
  if (own != no_polygon && contains(formulas::detail::corners_of(at, method.facet), vertex)) return own;
  const std::int32_t at_work = polygon_at_work(method);
  std::int32_t found = no_polygon;
  bool several = false, works = false;
  const auto has_it = [&](std::int32_t polygon) {
    several = several || (found != no_polygon && found != polygon);
    works = works || polygon == at_work;
    found = polygon;
  };
  if (at.scene.facets.size() <= few_facets) {
    for (const Facet& facet : at.scene.facets) {
      const auto first = at.scene.corners.begin() + facet.first_corner;
      if (std::find(first, first + facet.corner_count, vertex) != first + facet.corner_count) has_it(facet.polygon);
    }
    if (found == no_polygon)  // made by a cut
      for (const Piece& piece : method.pieces)
        if (contains(piece.outline, vertex)) has_it(piece.polygon);
  }
  if (found == no_polygon && !at.is_point(vertex)) return at_work;  // made by clipping
  if (works) return at_work;
  return several ? no_polygon : found;
}

bool may_own(const Notation& part) { return part.kind == Kind::symbol || part.kind == Kind::fraction; }

void mark_symbols(Notation& part, const std::vector<Owned>& owned) {
  if (may_own(part)) {
    const std::string symbol = on_one_line(part);
    const auto found = std::find_if(owned.begin(), owned.end(), [&](const Owned& one) { return one.symbol == symbol; });
    if (found != owned.end()) {
      part.polygon = found->polygon;
      return;
    }
  }
  for (Notation& inner : part.parts) mark_symbols(inner, owned);
}

/// From symbols to the numbers at the same places.
void carry_over(const Notation& from, Notation& to) {
  if (to.kind == Kind::number) {
    to.polygon = from.polygon;
    return;
  }
  for (std::size_t k = 0; k < std::min(from.parts.size(), to.parts.size()); ++k) carry_over(from.parts[k], to.parts[k]);
}

/// "z < zbuffer[x,y]:  4 < 5  is true".
void carry_behind_colon(Notation& side) {
  std::vector<std::int32_t> symbols;
  std::vector<Notation*> numbers;
  bool behind = false;
  for (Notation& part : side.parts) {
    if (part.kind == Kind::text && part.text.find(':') != std::string::npos) behind = true;
    if (!behind && may_own(part)) symbols.push_back(part.polygon);
    if (behind && part.kind == Kind::number) numbers.push_back(&part);
  }
  if (symbols.size() != numbers.size()) return;
  for (std::size_t k = 0; k < numbers.size(); ++k) numbers[k]->polygon = symbols[k];
}

}  // namespace

std::int32_t owner_of(const formulas::Situation& at, const formulas::Place& place, std::string_view name) {
  const MethodState& method = at.method();
  const auto number = static_cast<std::int32_t>(place.number);
  switch (place.in) {
    case In::vertex:
    case In::point:
      return owner_of_vertex(at, number);
    case In::edge_table:
    case In::active_edge: {
      const EdgeTableInsert* edge = at.edge(number);
      return edge ? edge->polygon : no_polygon;
    }
    case In::piece: {
      const Piece* piece = at.piece(number);
      return piece ? piece->polygon : no_polygon;
    }
    case In::depth_buffer:
    case In::light_buffer: {
      const auto& polygons = at.before.picture_of_pass().polygon;
      const std::size_t pixel = place.number;
      return pixel < polygons.size() ? polygons[pixel] : no_polygon;
    }
    case In::samples: {
      const std::size_t sample = place.number;
      return sample < method.samples.size() ? method.samples[sample].polygon : no_polygon;
    }
    case In::span:
      if (const auto& spans = at.ahead.spans(); at.ahead.of_all && static_cast<std::size_t>(number) < spans.size())
        return spans[number].polygon;
      return polygon_at_work(method);
    case In::event:  // the pixel and the scan line are no polygon's
      return name == "x" || name == "y" || name == "t" ? no_polygon : polygon_at_work(method);
    case In::plane:
    case In::triangle:
    case In::fragment:
    case In::attribute:
      return polygon_at_work(method);
    case In::scene:
    case In::frame:
    case In::ray:
    case In::horizon:
    case In::active_list:
      return no_polygon;
  }
  return no_polygon;
}

void add_owned(std::vector<Owned>& owned, const Owned& one) {
  const auto same = [&](const Owned& other) { return other.symbol == one.symbol; };
  const auto found = std::find_if(owned.begin(), owned.end(), same);
  if (found == owned.end()) owned.push_back(one);
  else if (found->polygon != one.polygon) found->polygon = no_polygon;
}

std::vector<std::int32_t> owners_in(const std::vector<Owned>& owned) {
  std::vector<std::int32_t> polygons;
  for (const Owned& one : owned)
    if (one.polygon != no_polygon && !contains(polygons, one.polygon)) polygons.push_back(one.polygon);
  return polygons;
}

void mark_owned(std::vector<Notation>& sides, const std::vector<Owned>& owned) {
  for (Notation& side : sides) {
    mark_symbols(side, owned);
    carry_behind_colon(side);
  }
  for (std::size_t k = 0; k + 1 < sides.size(); ++k) {
    Notation &side = sides[k], &next = sides[k + 1];
    if (side.parts.empty() || next.parts.empty()) continue;
    if (alike(side, next)) carry_over(side, next);
    else if (next.parts.front().kind == Kind::number && may_own(side.parts.back()))
      next.parts.front().polygon = side.parts.back().polygon;
  }
  if (sides.size() < 2 || sides.front().parts.size() != 1 || sides.back().parts.empty()) return;
  std::vector<Notation>& last = sides.back().parts;
  if (last.size() == 1) carry_over(sides.front(), sides.back());
  // "2.4, rounded to 2": what is recorded stands last.
  else if (last.front().kind == Kind::number && last[1].text.starts_with(", "))
    carry_over(sides.front().parts.front(), last.back());
}

}  // namespace zstep::words
