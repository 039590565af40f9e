#include "traces/diff/causes.hpp"

#include <algorithm>
#include <map>
#include <optional>
#include <span>
#include <string_view>
#include <tuple>
#include <utility>

#include "traces/diff/identity.hpp"
#include "traces/diff/parting.hpp"
#include "traces/events/fields.hpp"
#include "traces/events/slots.hpp"
#include "traces/scene.hpp"

namespace zstep::diff {

namespace {

/// The edge of this number at a step, by its polygon and vertices.
using Edge = std::tuple<std::int32_t, std::int32_t, std::int32_t>;
std::optional<Edge> edge_at(const Trace& trace, std::int64_t step, std::int32_t number) {
  const auto made = trace.previous(step, [&](const RecordedEvent& recorded) {
    const auto* insert = get_if<EdgeTableInsert>(&recorded.event);
    return insert && insert->edge == number;
  });
  if (!made) return std::nullopt;
  const auto entry = get<EdgeTableInsert>(trace.event(*made).event);
  const auto [from, to] = std::minmax(entry.vertex_0, entry.vertex_1);
  const auto points = size32(trace.scene().points);
  if (to >= points) return std::nullopt;  // vertices that clipping made have other numbers in another run
  return Edge{entry.polygon, from, to};
}

/// Are both about the same, as far as their own fields say?
template <class E>
bool same_step(const Trace& a, std::int64_t step_a, const E& of_a, const Trace& b, std::int64_t step_b, const E& of_b) {
  bool same = true, any = false;
  for_each_index<E>([&]<std::size_t I>() {
    constexpr const auto& field = field_at<E, I>;
    if constexpr (has(field.as, As::subject) && !std::is_same_v<FieldValue<E, I>, double>) {
      any = true;
      constexpr Thing thing = field.thing;
      const auto one = of_a.*field.member, other = of_b.*field.member;
      if constexpr (thing == Thing::edge) {
        const auto edge = edge_at(a, step_a, one);
        same = same && edge && edge == edge_at(b, step_b, other);
      } else {
        same = same && one == other && (thing == Thing::none || thing == Thing::vertex);
      }
    }
  });
  return any && same;
}

}  // namespace

void join_moved(const Trace& a, const Trace& b, DiffReport& report) {
  std::vector<Cause>& causes = report.causes;
  for (std::size_t i = 0; i < causes.size(); ++i) {
    const Difference first = causes[i].first;
    if (!first.only_a() && !first.only_b()) continue;
    const auto other = std::find_if(causes.begin() + i + 1, causes.end(), [&](const Cause& cause) {
      if (cause.first.kind != first.kind || cause.part != causes[i].part) return false;
      if (first.only_a() ? !cause.first.only_b() : !cause.first.only_a()) return false;
      const std::int64_t step_a = first.only_a() ? first.a : cause.first.a,
                         step_b = first.only_a() ? cause.first.b : first.b;
      const Event of_a = a.event(step_a).event, of_b = b.event(step_b).event;
      return visit_event(
          [&]<class E>(const E& e) {
            const E* its = get_if<E>(&of_b);
            return its && same_step(a, step_a, e, b, step_b, *its);
          },
          of_a);
    });
    if (other == causes.end()) continue;
    causes[i].elsewhere = first.only_a() ? other->first.b : other->first.a;
    causes[i].again += other->again, causes[i].symptoms += other->symptoms, causes[i].pixels += other->pixels;
    causes.erase(other);
  }
}

namespace {

/// Where each difference comes from in the end.
class Roots {
 public:
  Roots(const std::vector<Finding>& in_a, const std::vector<Finding>& in_b) : in_a_(in_a), in_b_(in_b) {
    root_.assign(in_a.size(), no_difference);
  }
  std::int32_t of(std::int32_t difference) {
    std::vector<std::int32_t> way;
    std::int32_t at = difference;
    while (root_[index(at)] == no_difference) {
      root_[index(at)] = on_the_way;
      way.push_back(at);
      const std::int32_t next = from(at);
      if (next == no_difference) break;
      at = next;
    }
    std::int32_t root = root_[index(at)] >= 0 ? root_[index(at)] : at;
    // Where the orders of the two runs part, the way may lead round in a circle: then the first of all is the root.
    if (const auto circle = std::find(way.begin(), way.end(), at); circle != way.end() && from(at) != no_difference)
      root = *std::min_element(circle, way.end());
    for (const std::int32_t one : way) root_[index(one)] = root;
    return root;
  }
  bool wrong_a(std::int32_t d) const { return in_a_[index(d)].wrong; }
  bool wrong_b(std::int32_t d) const { return in_b_[index(d)].wrong; }
  bool by_rounding(std::int32_t d, const Difference& difference) const {
    return !tie(d) && (difference.only_b() || in_a_[index(d)].rounding) &&
           (difference.only_a() || in_b_[index(d)].rounding);
  }
  /// Both runs compare two equal depths, and say otherwise which wins.
  bool tie(std::int32_t d) const { return in_a_[index(d)].tie && in_b_[index(d)].tie; }

 private:
  static constexpr std::int32_t on_the_way = -2;
  static std::size_t index(std::int32_t d) { return d; }
  std::int32_t from(std::int32_t d) const {
    const Finding &a = in_a_[index(d)], &b = in_b_[index(d)];
    if (a.wrong != b.wrong) return no_difference;  // one of the two computes it wrongly
    if (tie(d)) return no_difference;
    return b.comes_from != no_difference ? b.comes_from : a.comes_from;
  }

  const std::vector<Finding>&in_a_, &in_b_;
  std::vector<std::int32_t> root_;
};

/// Steps that right programs do or leave out: to begin a polygon or a scan line where there is nothing to do, to change
/// neighbours on the way to a list in order. They count where something follows.
bool may_be_missing(const Difference& difference) {
  return (difference.only_a() || difference.only_b()) &&
         (difference.kind == kind_of<PolygonBegin> || difference.kind == kind_of<ScanLineBegin> ||
          difference.kind == kind_of<EdgeSwap>);
}

/// Of the fields that part, those by which differences are of one sort: the numbers; the rest of a step follows from
/// them. Where no number parts, all.
std::uint16_t sort_of(const Difference& difference) {
  const std::span<const FieldOfKind> all = fields_of_kind(difference.kind);
  std::uint16_t numbers = 0;
  for (std::size_t field = 0; field < all.size(); ++field)
    if (all[field].type == FieldOfKind::Type::real) numbers = static_cast<std::uint16_t>(numbers | 1u << field);
  const auto parting = static_cast<std::uint16_t>(difference.fields & numbers);
  return parting != 0 ? parting : difference.fields;
}

/// What says nothing in either run is no part of what differs, unless it is all of it.
void leave_out_nothing(std::vector<Difference>& differences, const std::vector<Finding>& in_a,
                       const std::vector<Finding>& in_b) {
  for (std::size_t i = 0; i < differences.size(); ++i) {
    const int rest = differences[i].fields & ~(in_a[i].says_nothing & in_b[i].says_nothing);
    if (rest != 0) differences[i].fields = static_cast<std::uint16_t>(rest);
  }
}

/// z at the edges of a span.
constexpr std::uint16_t ends_of_span = bit_of<SpanBegin>("z_left") | bit_of<SpanBegin>("z_right");

/// Spans that only name the other one of two edges at one x, each of the two once: in one span, or the right one of a
/// span and the left one of the next. And those of which only a slope that says nothing differs.
std::vector<bool> exchanged_edges(const std::vector<Difference>& differences, const std::vector<Finding>& in_a,
                                  const std::vector<Finding>& in_b) {
  constexpr std::uint16_t left = bit_of<SpanBegin>("left_edge"), right = bit_of<SpanBegin>("right_edge");
  std::vector<bool> exchanged(differences.size());
  std::optional<std::size_t> open;  // a span of which only the right edge is another one
  for (std::size_t i = 0; i < differences.size(); ++i) {
    if (differences[i].kind != kind_of<SpanBegin>) continue;
    const bool free = in_a[i].free && in_b[i].free;
    const int nothing = in_a[i].says_nothing & in_b[i].says_nothing, fields = differences[i].fields & ~ends_of_span;
    if (nothing != 0 && differences[i].fields == nothing) exchanged[i] = true;
    if (free && fields == (left | right)) exchanged[i] = true;
    if (free && fields == left && open) exchanged[*open] = exchanged[i] = true;
    open = free && fields == right ? std::optional(i) : std::nullopt;
  }
  return exchanged;
}

bool writes_pixel(std::uint8_t kind) {
  return kind == kind_of<PixelWrite> || kind == kind_of<PixelPaint> || kind == kind_of<ColorWrite> ||
         kind == kind_of<ColorBlend>;
}

}  // namespace

void find_causes(DiffReport& report, const std::vector<Finding>& in_a, const std::vector<Finding>& in_b) {
  leave_out_nothing(report.alignment.differences, in_a, in_b);
  const auto& differences = report.alignment.differences;
  Roots roots(in_a, in_b);
  // By what parts: several of one sort are one cause that comes again.
  using Sort = std::tuple<std::uint8_t, std::uint16_t, bool, bool, bool, bool, bool, Part>;
  std::map<Sort, std::size_t> known;
  std::vector<std::size_t> cause_of(differences.size());
  std::vector<bool> followed(differences.size());
  for (std::size_t i = 0; i < differences.size(); ++i)
    if (const std::int32_t root = roots.of(index32(i)); root != index32(i)) followed[root] = true;
  const std::vector<bool> exchanged = exchanged_edges(differences, in_a, in_b);
  for (const bool symptoms : {false, true}) {
    for (std::size_t i = 0; i < differences.size(); ++i) {
      const auto d = index32(i);
      const Difference& difference = differences[i];
      const std::int32_t root = roots.of(d);
      if ((root != d) != symptoms) continue;
      const bool needed = in_a[i].needed || in_b[i].needed;
      if (!symptoms && !needed && (may_be_missing(difference) || in_a[i].idle || in_b[i].idle) && !followed[i]) {
        report.kinds[difference.kind].idle_a += difference.only_a();
        report.kinds[difference.kind].idle_b += difference.only_b();
        continue;
      }
      if (!symptoms && exchanged[i] && !followed[i]) {
        ++report.kinds[difference.kind].same;
        continue;
      }
      if (!symptoms) {
        const bool only_one_named =
            in_a[i].free && in_b[i].free && (!exchanged[i] || (difference.fields & ends_of_span) != 0);
        const Part part = roots.by_rounding(d, difference) && !only_one_named ? Part::rounding : Part::different;
        const bool wrong_a = roots.wrong_a(d), wrong_b = roots.wrong_b(d), tie = roots.tie(d);
        const Sort sort{difference.kind,
                        sort_of(difference),
                        difference.only_a(),
                        difference.only_b(),
                        wrong_a,
                        wrong_b,
                        tie,
                        part};
        const auto [found, fresh] = known.try_emplace(sort, report.causes.size());
        const bool unexplained = !difference.only_a() && !difference.only_b() && !(in_a[i].told && in_b[i].told);
        if (fresh) {
          Cause& cause = report.causes.emplace_back(Cause{difference, part, wrong_a, wrong_b, tie, unexplained});
          cause.unjudged = in_a[i].unjudged || in_b[i].unjudged;
          cause.operands_differ =
              !difference.only_a() && !difference.only_b() && !wrong_a && !wrong_b && !unexplained && !cause.unjudged;
        } else ++report.causes[found->second].again;
        cause_of[i] = found->second;
      } else {
        cause_of[i] = cause_of[root];
        ++report.causes[cause_of[i]].symptoms;
      }
      Cause& cause = report.causes[cause_of[i]];
      cause.pixels += writes_pixel(difference.kind);
      if (!difference.only_a() && !difference.only_b()) {
        KindDifference& kind = report.kinds[difference.kind];
        ++(cause.part == Part::rounding ? kind.rounding : kind.different);
      }
    }
  }
  std::stable_sort(report.causes.begin(), report.causes.end(),
                   [](const Cause& one, const Cause& other) { return one.part < other.part; });
}

}  // namespace zstep::diff
