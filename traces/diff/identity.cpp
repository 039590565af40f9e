#include "traces/diff/identity.hpp"

#include <algorithm>

namespace zstep::diff {

namespace {

using Key = Identity::Key;

/// Well spread (the finalizer of SplitMix64: Steele, Lea, Flood 2014).
Key spread(Key key) {
  key += 0x9e3779b97f4a7c15u;
  key = (key ^ key >> 30) * 0xbf58476d1ce4e5b9u;
  key = (key ^ key >> 27) * 0x94d049bb133111ebu;
  return key ^ key >> 31;
}
Key mix(Key key, Key more) { return spread(key ^ spread(more)); }
Key whole(std::int64_t number) { return static_cast<Key>(number); }

template <class E>
constexpr std::size_t things_among_results() {
  std::size_t count = 0;
  for_each_index<E>([&]<std::size_t I>() { count += is_result<E, I>() && thing_at<E, I>() != Thing::none; });
  return count;
}

}  // namespace

Identity::Identity(const Trace& trace) : points_(trace.scene().points.size()), trace_(&trace) {}

Key Identity::name_of(Thing thing, std::int32_t number) const {
  const Key kind = static_cast<Key>(thing) << 56;
  if (number < 0) return kind ^ spread(whole(number));
  // The scene's vertices have one number for all.
  if (thing == Thing::vertex && static_cast<std::size_t>(number) < points_) return kind ^ whole(number);
  const auto& names = names_[static_cast<std::size_t>(thing)];
  const auto found = names.find(number);
  return found == names.end() ? kind ^ spread(whole(number) + (Key{1} << 40)) : found->second;
}

std::optional<std::int32_t> Identity::number_of(Thing thing, Key name) const {
  const Key kind = static_cast<Key>(thing) << 56;
  if (thing == Thing::vertex && (name ^ kind) < points_) return static_cast<std::int32_t>(name ^ kind);
  const auto& numbers = numbers_[static_cast<std::size_t>(thing)];
  const auto found = numbers.find(name);
  if (found == numbers.end()) return std::nullopt;
  return found->second;
}

std::int32_t Identity::next_row(std::int32_t edge) const {
  const auto found = edges_.find(edge);
  return found == edges_.end() ? 0 : found->second.next_row;
}

void Identity::edge_used(std::int32_t edge, std::int32_t row) {
  Edge& known = edges_[edge];
  known.beyond = row + 1;
  known.next_row = std::max(known.next_row, row + 1);
}

void Identity::edge_enters(std::int32_t edge) {
  edges_[edge] = Edge{0, 0, false, edges_[edge].polygon};
  edge_used(edge, scan_line_);
}

template <class E>
Key Identity::key(const E& e) {
  constexpr About it = about<E>;
  // Where lines hold several polygons, a span says whose turn it is.
  if constexpr (std::is_same_v<E, SpanBegin>)
    if (const std::int32_t owner = edges_[e.left_edge].polygon; owner != no_polygon) polygon_ = owner;
  Key key = kind_of<E> + 1u + (static_cast<Key>(pass_) << 8);
  if constexpr (it.within & polygon) key = mix(key, whole(polygon_));
  if constexpr (it.within & scan_line) key = mix(key, whole(scan_line_));
  if constexpr (it.within & area) key = mix(key, area_);
  if constexpr (it.within & ray) key = mix(key, ray_);
  if constexpr (it.within & curve) key = mix(key, curve_);
  if constexpr (it.within & node) key = mix(key, node_);
  Key ends = 0;
  for_each_index<E>([&]<std::size_t I>() {
    constexpr const auto& field = field_at<E, I>;
    using Value = FieldValue<E, I>;
    if constexpr (it.names(field.name) && !std::is_same_v<Value, double>) {
      Key name = 0;
      if constexpr (std::is_same_v<Value, std::int32_t> && thing_at<E, I>() != Thing::none)
        name = name_of(thing_at<E, I>(), e.*field.member);
      else name = whole(static_cast<std::int64_t>(e.*field.member));
      constexpr bool end = field.name == "vertex_0" || field.name == "vertex_1";
      if constexpr (it.either_way && end) ends += spread(name);
      else key = mix(key, name);
    }
  });
  if constexpr (it.either_way) key = mix(key, ends);
  // An edge moves once to each of its scan lines, and leaves the list before the first one that it does not meet.
  if constexpr (std::is_same_v<E, EdgeStep>) key = mix(key, whole(edges_[e.edge].next_row));
  if constexpr (std::is_same_v<E, EdgeRetire>)
    if (const Edge& edge = edges_[e.edge]; edge.in_span) key = mix(key, whole(std::max(edge.beyond, scan_line_)));
  return key;
}

template <class E>
void Identity::take_note(const E& e, Key key) {
  constexpr Thing made = made_by<E>();
  if constexpr (made != Thing::none) {
    std::int32_t number = 0;
    if constexpr (made == Thing::vertex) number = e.vertex;
    else if constexpr (made == Thing::edge) number = e.edge;
    else if constexpr (made == Thing::piece) number = e.piece;
    else if constexpr (made == Thing::node) number = e.node;
    else if constexpr (made == Thing::area) number = e.area;
    else if constexpr (made == Thing::box) number = e.box;
    else if constexpr (made == Thing::ray) number = e.ray;
    else if constexpr (made == Thing::curve) number = e.curve;
    else number = e.line;
    const Key name = mix(key, whole(made_[key]++));
    names_[static_cast<std::size_t>(made)][number] = name;
    numbers_[static_cast<std::size_t>(made)][name] = number;
    if constexpr (made == Thing::edge) edges_[number] = Edge{0, 0, false, e.polygon};
  }
  if constexpr (std::is_same_v<E, PolygonBegin> || std::is_same_v<E, PieceDraw>) polygon_ = e.polygon, turns_ = true;
  if constexpr (std::is_same_v<E, SpanWinner>) polygon_ = trace_->polygon_of_piece(e.piece);
  if constexpr (std::is_same_v<E, TablesBegin> || std::is_same_v<E, AreaBegin>) polygon_ = no_polygon, turns_ = false;
  if constexpr (std::is_same_v<E, PassBegin>) pass_ = e.pass, polygon_ = no_polygon;
  if constexpr (std::is_same_v<E, ScanLineBegin>) {
    scan_line_ = e.y;
    if (!turns_) polygon_ = no_polygon;
  }
  if constexpr (std::is_same_v<E, AreaBegin>) area_ = name_of(Thing::area, e.area);
  if constexpr (std::is_same_v<E, RayBegin>) ray_ = name_of(Thing::ray, e.ray);
  if constexpr (std::is_same_v<E, CurveBegin>) curve_ = name_of(Thing::curve, e.curve);
  if constexpr (std::is_same_v<E, CurveSegment>) curve_ = key;
  if constexpr (std::is_same_v<E, NodeMake>) node_ = name_of(Thing::node, e.node);
  if constexpr (std::is_same_v<E, LineBegin>) curve_ = name_of(Thing::line, e.line);
  if constexpr (std::is_same_v<E, AreaDecide>) polygon_ = trace_->polygon_of_piece(e.piece);
  if constexpr (std::is_same_v<E, EdgeEnter>) edge_enters(e.edge);
  if constexpr (std::is_same_v<E, SpanBegin>) edge_used(e.left_edge, e.y), edge_used(e.right_edge, e.y),
      edges_[e.left_edge].in_span = edges_[e.right_edge].in_span = true;
  if constexpr (std::is_same_v<E, FlagFlip>) edge_used(e.edge, scan_line_);
  if constexpr (std::is_same_v<E, EdgeStep>) ++edges_[e.edge].next_row;
}

template <class E>
void Identity::take_note_of(const E& e) {
  constexpr bool by_key =
      made_by<E>() != Thing::none || std::is_same_v<E, CurveSegment> || std::is_same_v<E, SpanBegin>;
  if constexpr (by_key) take_note(e, key(e));
  else take_note(e, 0);
}
#define ZSTEP_INSTANTIATE(E) template void Identity::take_note_of(const E&);
ZSTEP_EVERY_KIND(ZSTEP_INSTANTIATE)
#undef ZSTEP_INSTANTIATE

Identity Identity::of_same_run(const Trace& trace) const {
  Identity copy = *this;
  copy.trace_ = &trace;
  return copy;
}

Identity::Known Identity::of(const Event& event) {
  return visit_event(
      [&]<class E>(const E& e) {
        Known known{key(e), {}};
        static_assert(things_among_results<E>() <= std::tuple_size_v<decltype(known.results)>);
        std::size_t results = 0;
        for_each_index<E>([&]<std::size_t I>() {
          if constexpr (is_result<E, I>() && thing_at<E, I>() != Thing::none)
            known.results[results++] = name_of(thing_at<E, I>(), e.*field_at<E, I>.member);
        });
        take_note(e, known.about);
        return known;
      },
      event);
}

}  // namespace zstep::diff
