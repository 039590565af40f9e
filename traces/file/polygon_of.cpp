// Whose polygon an event is about: that which it names, or else the one at work.
#include <algorithm>
#include <bitset>

#include "traces/events/fields.hpp"
#include "traces/file/trace_impl.hpp"

namespace zstep {

namespace {

using Kinds = std::bitset<kind_count>;

/// Those that occur.
Kinds kinds_in(const Trace& trace) {
  Kinds kinds;
  for (std::size_t kind = 0; kind < kind_count; ++kind) kinds[kind] = trace.has(static_cast<std::uint8_t>(kind));
  return kinds;
}

/// What is about all polygons at once, after the work on each of them.
Kinds about_all(const Kinds& recorded) {
  Kinds kinds;
  for (std::size_t kind = 0; kind < kind_count; ++kind) kinds[kind] = description_of_kind(kind).after_polygons;
  if (recorded[kind_of<TablesBegin>]) kinds.set(kind_of<ScanLineBegin>);
  return kinds & recorded;
}

}  // namespace

const Trace::Impl::Turns& Trace::Impl::turns(const Trace& trace) const {
  if (known_turns) return *known_turns;
  Turns& turns = known_turns.emplace(Turns{0, size + 1});
  const Kinds recorded = kinds_in(trace), ends = about_all(recorded);
  if (polygons.empty() || ends.none()) return turns;
  auto after_last = polygons.end();
  if (recorded[kind_of<PieceDraw>])
    after_last = std::partition_point(polygons.begin(), polygons.end(), [&](const PolygonMark& mark) {
      return holds<PolygonBegin>(trace.event(mark.position).event);
    });
  if (after_last == polygons.begin()) return turns;
  turns.last = static_cast<std::size_t>(after_last - polygons.begin()) - 1;
  const std::int64_t drawn =
      after_last == polygons.end() ? size + 1 : after_last->position;  // from there on pieces take turns
  const auto end = trace.next(
      polygons[turns.last].position,
      [&](const RecordedEvent& recorded_event) { return ends[recorded_event.event.index()]; },
      Trace::Among({}, {}, drawn - 1));
  turns.end = end.value_or(size + 1);
  return turns;
}

std::int64_t Trace::end_of_turns() const { return impl_->turns(*this).end; }

std::int32_t Trace::polygon_at_work(std::int64_t position) const {
  const auto marks = polygons();
  const auto after = std::upper_bound(marks.begin(), marks.end(), position,
                                      [](std::int64_t p, const PolygonMark& mark) { return p < mark.position; });
  if (after == marks.begin()) return no_polygon;
  const Impl::Turns& turns = impl_->turns(*this);
  const bool is_last = static_cast<std::size_t>(after - marks.begin()) - 1 == turns.last;
  return is_last && position >= turns.end ? no_polygon : (after - 1)->polygon;
}

std::int32_t Trace::polygon_of_piece(std::int32_t piece) const {
  if (!impl_->polygon_by_piece) {
    std::vector<std::int32_t>& made = impl_->polygon_by_piece.emplace();
    scan(Among({}, kind_of<PieceMake>), [&](std::int64_t, const RecordedEvent& recorded) {
      const auto& event = get<PieceMake>(recorded.event);
      if (static_cast<std::size_t>(event.piece) == made.size()) made.push_back(event.polygon);
      return true;
    });
  }
  const std::vector<std::int32_t>& made = *impl_->polygon_by_piece;
  return piece >= 0 && static_cast<std::size_t>(piece) < made.size() ? made[static_cast<std::size_t>(piece)]
                                                                     : no_polygon;
}

std::optional<std::int32_t> Trace::polygon_named(const Event& event) const {
  return visit_event(
      [&]<class E>(const E& known) -> std::optional<std::int32_t> {
        if constexpr (names_polygon<E> == Names::polygon) return known.polygon;
        else if constexpr (names_polygon<E> == Names::facet) {
          const std::vector<Facet>& facets = scene().facets;
          return known.facet >= 0 && static_cast<std::size_t>(known.facet) < facets.size()
                     ? facets[static_cast<std::size_t>(known.facet)].polygon
                     : no_polygon;
        } else if constexpr (names_polygon<E> == Names::piece) return polygon_of_piece(known.piece);
        else return std::nullopt;
      },
      event);
}

}  // namespace zstep
