#include "traces/diff/identity.hpp"

#include <algorithm>

namespace zstep::diff {

bool says_turns(const Trace& trace) {
  constexpr std::array kinds{kind_of<PolygonBegin>, kind_of<PieceDraw>, kind_of<SpanWinner>, kind_of<AreaDecide>};
  return std::any_of(kinds.begin(), kinds.end(), [&](std::uint8_t kind) { return trace.has(kind); });
}

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

}  // namespace

/// Numbers that together say what a step is about. (It has a name outside this file, as templates with names outside
/// have members of this type.)
template <std::size_t most>
struct Parts {
  std::array<Key, most> part;
  std::size_t count = 0;
  void add(Key one) { part[count++] = one; }
  Key key() const {
    Key key = part[0];
    for (std::size_t i = 1; i < count; ++i) key = mix(key, part[i]);
    return key;
  }
};

Identity::Identity(const Trace& trace, const Told& told)
    : points_(trace.scene().points.size()), told_(told), trace_(&trace) {
  if (!told.ahead) return;
  ahead_ = formulas::spans_ahead_of(trace, trace.header().conventions);
  ahead_->of_all = true;
}

Key Identity::name_of(Thing thing, std::int32_t number) const {
  const Key kind = static_cast<Key>(thing) << 56;
  if (number < 0) return kind ^ spread(whole(number));
  // The scene's vertices have one number for all.
  if (thing == Thing::vertex && static_cast<std::size_t>(number) < points_) return kind ^ whole(number);
  const Key name = names_[thing][number];
  return name != 0 ? name : kind ^ spread(whole(number) + (Key{1} << 40));
}

std::optional<std::int32_t> Identity::number_of(Thing thing, Key name) const {
  const Key kind = static_cast<Key>(thing) << 56;
  if (thing == Thing::vertex && (name ^ kind) < points_) return static_cast<std::int32_t>(name ^ kind);
  const auto& numbers = numbers_[thing];
  const auto found = numbers.find(name);
  if (found == numbers.end()) return std::nullopt;
  return found->second;
}

std::int32_t Identity::next_row(std::int32_t edge) const {
  return std::max(edges_[edge].next_row, scan_line_);  // a line for which it was not moved is passed over
}

void Identity::edge_used(std::int32_t edge, std::int32_t row) {
  Edge& known = edges_.edit(edge);
  known.beyond = row + 1;
  known.next_row = std::max(known.next_row, row + 1);
}

/// The line that the span itself names, unless both the line at work and the edge are on another one.
std::int32_t Identity::row_of_span(const SpanBegin& e, std::int32_t edge) const {
  return edges_[edge].next_row - 1 == scan_line_ ? scan_line_ : e.y;
}

void Identity::edge_enters(std::int32_t edge) {
  edges_.edit(edge) = Edge{0, 0, false, edges_[edge].polygon, edges_[edge].end_row, scan_line_};
  edge_used(edge, scan_line_);
}

/// The name of the thing in a field. An edge of which a run tells nothing but its number is known by where it stands:
/// as the left or right one of a span, or as one of the polygon whose flag flips there.
template <class E, std::size_t I>
Key Identity::name_in(const E& e) const {
  constexpr Thing thing = field_at<E, I>.thing;
  if constexpr (thing == Thing::edge && std::is_same_v<E, SpanBegin>) {
    if (!told_.edges) return I;
  } else if constexpr (thing == Thing::edge && std::is_same_v<E, FlagFlip>) {
    if (!told_.edges) return name_of(Thing::piece, e.piece);
  }
  return name_of(thing, e.*field_at<E, I>.member);
}

template <class E>
std::int32_t Identity::polygon_of(const E& e) const {
  if constexpr (requires { e.x, e.y; })
    if (const auto span = ahead_ ? ahead_->span_of(e) : std::nullopt) return ahead_->spans()[*span].polygon;
  return polygon_;
}

/// What a step is about, number by number.
template <class E>
auto Identity::parts(const E& e) {
  constexpr Description it = description_of<E>;
  Parts<1 + 7 + 4 + 1> found;  // kind, what it belongs to, fields, and a scan line
  // Where lines hold several polygons, a span says whose turn it is.
  if constexpr (std::is_same_v<E, SpanBegin>)
    if (const std::int32_t owner = edges_[e.left_edge].polygon; owner != no_polygon) polygon_ = owner;
  found.add(kind_of<E> + 1u + (static_cast<Key>(pass_) << 8));
  if constexpr (has(it.within, Within::polygon)) found.add(whole(polygon_of(e)));
  if constexpr (has(it.within, Within::scan_line)) found.add(whole(scan_line_));
  if constexpr (has(it.within, Within::area)) found.add(area_);
  if constexpr (has(it.within, Within::ray)) found.add(ray_);
  if constexpr (has(it.within, Within::curve)) found.add(curve_);
  if constexpr (has(it.within, Within::node)) found.add(node_);
  if constexpr (has(it.within, Within::triangle)) found.add(triangle_);
  Key ends = 0;
  for_each_index<E>([&]<std::size_t I>() {
    constexpr const auto& field = field_at<E, I>;
    using Value = FieldValue<E, I>;
    if constexpr (has(field.as, As::subject) && !std::is_same_v<Value, double>) {
      Key name = 0;
      if constexpr (std::is_same_v<Value, std::int32_t> && field_at<E, I>.thing != Thing::none) name = name_in<E, I>(e);
      else name = whole(static_cast<std::int64_t>(e.*field.member));
      constexpr bool end = field.name == "vertex_0" || field.name == "vertex_1";
      if constexpr (it.either_way && end) ends += spread(name);
      else found.add(name);
    }
  });
  if constexpr (it.either_way) found.add(ends);
  if constexpr (std::is_same_v<E, ListInsert>) found.add(whole(compares_));
  if constexpr (std::is_same_v<E, PixelPaint>) found.add(drawn_);
  // Spans without pixels may be left out: where a line of the polygon has several spans, each is known by its left
  // edge.
  if constexpr (std::is_same_v<E, SpanBegin>)
    found.add(turns_ && active_ > 2 && e.first > e.last ? name_in<E, 0>(e) : 0);
  // An edge moves once to each of its scan lines, and leaves the list before the first one that it does not meet.
  if constexpr (std::is_same_v<E, EdgeStep>) found.add(whole(next_row(e.edge)));
  if constexpr (std::is_same_v<E, EdgeRetire>) {
    const Edge edge = edges_[e.edge];
    // What moved to this line, or entered on it, and does not end here was used on it, though perhaps by no pixel.
    const bool moved = edge.moved_to == scan_line_ || !trace_->has(kind_of<EdgeStep>);
    const bool used_here = moved && edge.end_row > scan_line_;
    const bool has_time = edge.in_span || (turns_ && edge.end_row > 0);
    found.add(has_time ? whole(std::max(edge.beyond, scan_line_ + used_here)) : ~Key{0} >> 1);
  }
  return found;
}

template <class E>
bool Identity::same_about(const E& e, Identity& other, const E& its) {
  const auto mine = parts(e), theirs = other.parts(its);
  for (std::size_t i = 0; i < mine.count; ++i)
    if (mine.part[i] != theirs.part[i]) return false;
  return true;
}

template <class E>
Identity::Hint Identity::hint(const E& e) {
  constexpr std::uint32_t kind = kind_of<E> * 0x9e3779b1u;
  constexpr bool at_row = [] {
    bool found = false;
    for_each_field<E>([&](const auto& field) { found = found || (field.name == "y" && has(field.as, As::subject)); });
    return found;
  }();
  if constexpr (at_row) return static_cast<Hint>(static_cast<std::uint32_t>(e.y) ^ kind >> 16);
  const auto all = parts(e);
  Key found = 0;
  for (std::size_t i = 0; i < all.count; ++i) found = (found ^ all.part[i]) * 0x9e3779b97f4a7c15u;
  return static_cast<Hint>(found >> 48);
}

template <class E>
Identity::Known Identity::known(const E& e) {
  Known found{parts(e).key(), {}, hint(e)};
  static_assert(things_among_results<E>() <= std::tuple_size_v<decltype(found.results)>);
  std::size_t results = 0;
  for_each_index<E>([&]<std::size_t I>() {
    if constexpr (is_result<E, I> && field_at<E, I>.thing != Thing::none) found.results[results++] = name_in<E, I>(e);
  });
  return found;
}

template <class E>
void Identity::take_note(const E& e, Key key) {
  if constexpr (constexpr std::size_t I = number_made<E>(); I != field_count<E>) {
    constexpr Thing made = field_at<E, I>.thing;
    const std::int32_t number = e.*field_at<E, I>.member;
    const Key name = mix(key, whole(made_[key]++));
    names_[made].edit(number) = name;
    numbers_[made][name] = number;
    if constexpr (made == Thing::edge) edges_.edit(number) = Edge{0, 0, false, e.polygon, e.end_row, -1};
  }
  if constexpr (std::is_same_v<E, PolygonBegin> || std::is_same_v<E, PieceDraw>)
    polygon_ = e.polygon, turns_ = true, active_ = 0;
  if constexpr (std::is_same_v<E, PieceDraw>)
    if (told_.draws) drawn_ = name_of(Thing::piece, e.piece);
  if constexpr (std::is_same_v<E, SpanWinner>) polygon_ = trace_->polygon_of_piece(e.piece);
  if constexpr (std::is_same_v<E, SplitVertex>) polygon_ = no_polygon;  // of which it is, its piece says
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
  if constexpr (std::is_same_v<E, TriangleSetup>) triangle_ = key;
  if constexpr (std::is_same_v<E, NodeMake>) node_ = name_of(Thing::node, e.node);
  if constexpr (std::is_same_v<E, LineBegin>) curve_ = name_of(Thing::line, e.line);
  if constexpr (std::is_same_v<E, AreaDecide>) polygon_ = trace_->polygon_of_piece(e.piece);
  if constexpr (std::is_same_v<E, PairBegin>) compares_ = true;
  if (ahead_) {
    if constexpr (std::is_same_v<E, PolygonBegin> || std::is_same_v<E, PieceDraw>) ahead_->begin(e.polygon);
    if constexpr (std::is_same_v<E, SpanBegin>) ahead_->add(e, polygon_);
    ahead_->pass(e);
  }
  if constexpr (std::is_same_v<E, EdgeEnter>) edge_enters(e.edge), ++active_;
  if constexpr (std::is_same_v<E, EdgeRetire>) --active_;
  if constexpr (std::is_same_v<E, SpanBegin>)
    for (const std::int32_t edge : {e.left_edge, e.right_edge})
      if (e.first <= e.last) edge_used(edge, row_of_span(e, edge)), edges_.edit(edge).in_span = true;
  if constexpr (std::is_same_v<E, FlagFlip>) edge_used(e.edge, scan_line_);
  if constexpr (std::is_same_v<E, EdgeStep>)
    edges_.edit(e.edge).next_row = next_row(e.edge) + 1, edges_.edit(e.edge).moved_to = scan_line_;
}

template <class E>
void Identity::take_note_of(const E& e) {
  constexpr bool by_key = number_made<E>() != field_count<E> || std::is_same_v<E, CurveSegment> ||
                          std::is_same_v<E, SpanBegin> || std::is_same_v<E, TriangleSetup>;
  if constexpr (by_key) take_note(e, parts(e).key());
  else take_note(e, 0);
}
#define ZSTEP_INSTANTIATE(E)                                         \
  template void Identity::take_note_of(const E&);                    \
  template bool Identity::same_about(const E&, Identity&, const E&); \
  template Identity::Hint Identity::hint(const E&);                  \
  template Identity::Known Identity::known(const E&);
ZSTEP_EVERY_KIND(ZSTEP_INSTANTIATE)
#undef ZSTEP_INSTANTIATE

Key Identity::of_any_piece(const PixelPaint& e) { return mix(mix(whole(e.x), whole(e.y)), whole(e.polygon)); }

Identity Identity::of_same_run(const Trace& trace) const {
  Identity copy = *this;
  copy.trace_ = &trace;
  return copy;
}

Identity::Known Identity::of(const Event& event) {
  return visit_event(
      [&]<class E>(const E& e) {
        const Known found = known(e);
        take_note(e, found.about);
        return found;
      },
      event);
}

}  // namespace zstep::diff
