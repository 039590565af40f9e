#include "traces/grade/grade.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <span>
#include <vector>

#include <fmt/format.h>

#include "traces/diff/parting.hpp"
#include "traces/events/fields.hpp"
#include "traces/events/vocabulary.hpp"
#include "traces/formulas/of_events.hpp"
#include "traces/formulas/situation.hpp"
#include "traces/formulas/walk.hpp"
#include "traces/mistakes/name.hpp"

namespace zstep::grade {

namespace {

/// The length of the longest run of ascending numbers that others may stand between.
std::int64_t longest_ascending(const std::vector<std::int64_t>& numbers) {
  std::vector<std::int64_t> ends;  // the least last number of a run of each length
  for (const std::int64_t number : numbers) {
    const auto place = std::lower_bound(ends.begin(), ends.end(), number);
    if (place == ends.end()) ends.push_back(number);
    else *place = number;
  }
  return std::ssize(ends);
}

std::array<std::int64_t, kind_count> steps_by_kind(const Trace& trace) {
  std::array<std::int64_t, kind_count> counts{};
  trace.each(0, trace.size(), [&](std::int64_t, const RecordedEvent& recorded) {
    ++counts[recorded.event.index()];
    return true;
  });
  return counts;
}

void lose(PartCount& count, Loss::Why why, std::uint8_t kind, std::int64_t steps) {
  if (steps > 0) count.lost.push_back({why, kind, steps});
}

}  // namespace

std::vector<bool> drawn(const Picture& picture) {
  std::vector<bool> pixels(picture.polygon.size());
  for (std::size_t i = 0; i < pixels.size(); ++i)
    pixels[i] = picture.polygon[i] != no_polygon || (!picture.ink.empty() && picture.ink[i] != no_ink);
  return pixels;
}

bool has_depths(const Picture& picture) {
  return std::any_of(picture.depth.begin(), picture.depth.end(), [](double z) { return std::isfinite(z); });
}

PartCount count_pixels(const Part& part, const std::vector<bool>& reference, const std::vector<bool>& other,
                       const PixelsApart& apart, bool keeps_depths) {
  PartCount count;
  PartCount::Halves right;
  for (std::size_t i = 0; i < reference.size(); ++i) {
    const bool color = !apart.color.empty() && apart.color[i] == 0, depth = !apart.depth.empty() && apart.depth[i] == 0;
    count.expected += reference[i];
    count.additional += other[i] && !reference[i];
    right.colors += reference[i] && color;
    right.depths += reference[i] && depth;
    count.same += reference[i] && color && (depth || !keeps_depths);
  }
  count.computed = count.same;
  if (keeps_depths) count.halves = right;
  if (part.value <= 0) return count;
  using enum Loss::Why;
  lose(count, apart.color.empty() ? no_colors : colors, 0, count.expected - right.colors);
  if (keeps_depths) lose(count, apart.depth.empty() ? no_depths : depths, 0, count.expected - right.depths);
  lose(count, beyond, 0, count.additional);
  return count;
}

Counter::Counter(const Trace& reference, const Trace& run, const diff::DiffReport& difference,
                 const std::vector<bool>& not_computed, const std::set<std::uint8_t>& aside)
    : run_(run), difference_(difference), aside_(aside), expected_(steps_by_kind(reference)) {
  run.each(0, run.size(), [&](std::int64_t position, const RecordedEvent& recorded) {
    if (not_computed[position] && difference.alignment.in_a(position) != 0) ++not_computed_[recorded.event.index()];
    return true;
  });
}

PartCount Counter::steps(const Part& part) const {
  PartCount count;
  using enum Loss::Why;
  for (const std::uint8_t kind : part.kinds) {
    const diff::KindDifference& of = difference_.kinds[kind];
    const std::int64_t expected = expected_[kind] - of.idle_a, more = of.only_b - of.idle_b;
    count.expected += expected;
    if (aside_.contains(kind)) {
      lose(count, unknown_edges, kind, expected);
      continue;
    }
    const std::int64_t right = of.same + of.rounding, there = right + of.different;
    // Beyond as many as causes are looked for, steps that differ earn nothing.
    const std::int64_t unlike = of.different + of.not_followed, uncomputed = not_computed_[kind] + of.not_followed;
    count.additional += more;
    count.same += right;
    count.computed += there - not_computed_[kind];
    lose(count, run_.has(kind) ? missing : never, kind, expected - there - of.not_followed);
    lose(count, additional, kind, more);
    if (part.value > 0) lose(count, numbers, kind, unlike);
    if (part.computation > 0) lose(count, computation, kind, uncomputed);
  }
  if (part.level == Level::ordered) {
    const std::int64_t moved = out_of_order(part);
    count.same = std::max<std::int64_t>(0, count.same - moved);
    count.computed = std::max<std::int64_t>(0, count.computed - moved);
    lose(count, order, 0, moved);
  }
  if (part.points() <= 0) count.lost.clear();
  return count;
}

/// How many of a part's steps would have to be moved for the rest to be in the reference's order.
std::int64_t Counter::out_of_order(const Part& part) const {
  const std::set<std::uint8_t> kinds(part.kinds.begin(), part.kinds.end());
  std::vector<std::int64_t> matched;
  run_.each(0, run_.size(), [&](std::int64_t position, const RecordedEvent& recorded) {
    if (!kinds.contains(static_cast<std::uint8_t>(recorded.event.index()))) return true;
    if (const std::int64_t a = difference_.alignment.in_a(position); a != 0) matched.push_back(a);
    return true;
  });
  return std::ssize(matched) - longest_ascending(matched);
}

namespace {

/// The vertices of each polygon of a scene, in their order.
class Outlines {
 public:
  explicit Outlines(const Scene& scene) : scene_(scene), facets_(scene.polygons.size(), nullptr) {
    for (const Facet& facet : scene.facets) {
      const Facet*& first = facets_[facet.polygon];
      if (!first) first = &facet;
    }
  }
  /// None where there is no such polygon.
  std::span<const std::int32_t> of(std::int32_t polygon) const {
    if (polygon < 0 || polygon >= std::ssize(facets_)) return {};
    const Facet* facet = facets_[polygon];
    if (!facet) return {};
    return std::span(scene_.corners).subspan(facet->first_corner, facet->corner_count);
  }

 private:
  const Scene& scene_;
  std::vector<const Facet*> facets_;  ///< the first of each polygon
};

bool joins(std::span<const std::int32_t> outline, std::int32_t a, std::int32_t b) {
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const std::int32_t from = outline[i], to = outline[(i + 1) % outline.size()];
    if ((from == a && to == b) || (from == b && to == a)) return true;
  }
  return false;
}

/// The ways in which the numbers of an edge may be meant.
struct Meanings {
  bool as_scene = true, polygons_from_1 = true, vertices_from_1 = true, vertices_of_polygon = true;
  bool any = false;  ///< an edge was named

  void look_at(const Outlines& outlines, std::int32_t polygon, std::int32_t a, std::int32_t b) {
    any = true;
    const auto outline = outlines.of(polygon);
    const auto place = [&](std::int32_t vertex) {
      return vertex >= 0 && vertex < std::ssize(outline) ? outline[vertex] : -1;
    };
    as_scene = as_scene && joins(outline, a, b);
    polygons_from_1 = polygons_from_1 && joins(outlines.of(polygon - 1), a, b);
    vertices_from_1 = vertices_from_1 && joins(outline, a - 1, b - 1);
    vertices_of_polygon = vertices_of_polygon && joins(outline, place(a), place(b));
  }
};

}  // namespace

Numbering numbering_of(const Trace& run) {
  const Outlines outlines(run.scene());
  Meanings meanings;
  std::int32_t polygon = no_polygon, least = no_polygon;
  run.each(0, run.size(), [&](std::int64_t, const RecordedEvent& recorded) {
    if (const auto* begin = get_if<PolygonBegin>(&recorded.event)) {
      polygon = begin->polygon;
      least = least == no_polygon ? polygon : std::min(least, polygon);
    }
    if (const auto* edge = get_if<EdgeTableInsert>(&recorded.event))
      meanings.look_at(outlines, edge->polygon, edge->vertex_0, edge->vertex_1);
    if (const auto* edge = get_if<EdgeTableSkip>(&recorded.event); edge && polygon != no_polygon)
      meanings.look_at(outlines, polygon, edge->vertex_0, edge->vertex_1);
    return true;
  });
  if (!meanings.any) return least == 1 ? Numbering::polygons_from_1 : Numbering::as_scene;
  if (meanings.as_scene) return Numbering::as_scene;
  if (meanings.polygons_from_1) return Numbering::polygons_from_1;
  if (meanings.vertices_from_1) return Numbering::vertices_from_1;
  return meanings.vertices_of_polygon ? Numbering::vertices_of_polygon : Numbering::as_scene;
}

Scene numbered_from_1(Scene scene, Numbering numbering) {
  if (numbering == Numbering::polygons_from_1 && !scene.facets.empty()) {
    scene.polygons.insert(scene.polygons.begin(), Polygon{});
    for (Facet& facet : scene.facets) ++facet.polygon;
    Facet none = scene.facets.front();
    none.polygon = 0;
    scene.facets.insert(scene.facets.begin(), none);
    for (VertexAttribute& attribute : scene.attributes)
      for (VertexAttribute::Own& own : attribute.own) ++own.polygon;
  }
  if (numbering == Numbering::vertices_from_1 && !scene.points.empty()) {
    scene.points.insert(scene.points.begin(), scene.points.front());
    if (!scene.point_lines.empty()) scene.point_lines.insert(scene.point_lines.begin(), 0);
    if (!scene.file_points.empty()) scene.file_points.insert(scene.file_points.begin(), scene.file_points.front());
    for (std::int32_t& corner : scene.corners) ++corner;
    for (VertexAttribute& attribute : scene.attributes) {
      attribute.of_point.insert(attribute.of_point.begin(), no_value);
      for (VertexAttribute::Own& own : attribute.own) ++own.point;
    }
  }
  return scene;
}

namespace {

using formulas::Follows, formulas::Place, formulas::Situation;

/// Takes note of the fields of a step that a formula gives.
template <class E>
struct Given {
  using Number = double;
  const E& e;
  std::uint32_t fields = 0;

  double number(const auto&, double value, const Place&) { return value; }
  double named(std::string_view, double formula) { return formula; }
  void reads(const Place&) {}
  bool trusts(const Place&) const { return false; }
  bool equal(double one, double other) const { return one == other; }
  void rule(formulas::Rule, bool) {}
  void gives(Follows<E, double> field, double) { fields |= 1u << field.number; }
  void within(Follows<E, double> field, double, double) { fields |= 1u << field.number; }
  void near(Follows<E, double> field, const formulas::Rounded&) { fields |= 1u << field.number; }
  void whole(Follows<E, std::int32_t> field, double, std::int32_t) { fields |= 1u << field.number; }
  template <class Value>
  void is(std::type_identity_t<Follows<E, Value>> field, Value) {
    fields |= 1u << field.number;
  }
  void verdict(Follows<E, bool> field, double, double) { fields |= 1u << field.number; }
};

/// Is one of the differing fields a number that should follow from something, and does from nothing, or is it none?
/// What the number format alone lets it be off is no difference.
template <class E>
bool from_nothing(const E& e, const Situation& at, const diff::Difference& differing, const Precision& precision) {
  Given<E> given{e};
  if constexpr (formulas::Derived<E, Given<E>>) formulas::derive(e, at, given);
  bool found = false;
  for_each_index<E>([&]<std::size_t I>() {
    if constexpr (std::is_same_v<FieldValue<E, I>, double>) {
      const double value = e.*field_at<E, I>.member;
      if ((differing.fields >> I & 1u) == 0 ||
          differing.off <= precision.relative + 2 * precision.amount(field_at<E, I>.unit) / std::abs(value))
        return;
      // What is as long as a plane's normal may have any length.
      const bool should_follow = has(field_at<E, I>.as, As::formula) && !diff::as_long_as_normal(field_at<E, I>.name);
      found = found || !std::isfinite(value) || (should_follow && (given.fields >> I & 1u) == 0);
    }
  });
  return found;
}

/// Of a kind, the fields that are numbers.
std::uint32_t number_fields(std::uint8_t kind) {
  std::uint32_t fields = 0;
  const auto all = fields_of_kind(kind);
  for (std::size_t i = 0; i < all.size(); ++i)
    if (all[i].type == FieldOfKind::Type::real) fields |= 1u << i;
  return fields;
}

/// By step of the run, from 1: whether it does not follow from the run's own operands. A step that has the reference's
/// numbers does unless one of `faults` is its; of a number that is not the reference's a formula must say what it
/// follows from, and it must be finite: NaN follows from NaN, and anything from nothing.
std::vector<bool> not_computed(const Trace& run, const diff::DiffReport& difference, const std::vector<Fault>& faults) {
  std::vector<bool> found(static_cast<std::size_t>(run.size()) + 1);
  for (const Fault& fault : faults) found[fault.step] = true;
  // By the steps of the run, as the walk goes.
  std::vector<const diff::Difference*> differing;
  for (const diff::Difference& one : difference.alignment.differences)
    if (one.a != 0 && one.b != 0 && (one.fields & number_fields(one.kind)) != 0) differing.push_back(&one);
  if (differing.empty()) return found;
  std::sort(differing.begin(), differing.end(), [](const auto* one, const auto* other) { return one->b < other->b; });
  auto next = differing.begin();
  formulas::walk(
      run,
      [&](std::int64_t step, const auto& e, const Situation& at) {
        if (step < (*next)->b) return true;
        if (from_nothing(e, at, **next, difference.precision)) found[step] = true;
        return ++next != differing.end();
      },
      [](std::int64_t, const Impossible&) {});
  return found;
}

/// What is in the buffers at the end. A step that cannot be does nothing.
Picture picture_of(const Trace& trace) {
  return formulas::walk(
             trace, [](std::int64_t, const auto&, const formulas::Situation&) { return true; },
             [](std::int64_t, const Impossible&) {})
      .picture;
}

/// How far the two are apart at the end. A run that wrote no depth anywhere has none.
PixelsApart pixels_apart(const Ends& ends, const Trace& reference, const Trace& run, const Precision& precision) {
  PixelsApart apart;
  for (std::size_t i = 0; i < ends.reference.polygon.size(); ++i)
    apart.color.push_back(color_at(ends.reference, reference.scene(), i) == color_at(ends.run, run.scene(), i) ? 0 : 1);
  const std::vector<double>& written = ends.run.depth;
  if (std::any_of(written.begin(), written.end(), [](double z) { return z != no_depth; }))  // NaN is one, and wrong
    apart.depth = diff::compare_depths(ends.reference.depth, ends.run.depth, precision,
                                       diff::buffers_of(reference, ends.reference).empty)
                      .apart;
  return apart;
}

/// Where a cause of a difference shows in the run: at its step, or before the one where something is missing.
std::int64_t shows_at(const Judgement& found, const diff::Cause& cause) {
  return cause.first.only_a() ? found.difference.alignment.before_in_b(cause.first.a) + 1 : cause.first.b;
}

/// What parts where a step is at fault, too: what is said of the fault is said of that step. Where another step is
/// missing before it, the run's own one is what to look at if it is not what the reference goes on with; if it is, it
/// is wrong for what is missing.
void put_together(const Judgement& found, Divergence& first, const Fault& fault) {
  if (first.parts && first.parts->only_a()) {
    const diff::Alignment& alignment = found.difference.alignment;
    const auto own = std::find_if(alignment.differences.begin(), alignment.differences.end(),
                                  [&](const diff::Difference& one) { return one.b == fault.step; });
    const std::int64_t partner = alignment.in_a(fault.step);
    bool goes_on = own == alignment.differences.end() && partner > first.parts->a;
    for (std::int64_t step = first.parts->a + 1; step < partner && goes_on; ++step)
      goes_on = alignment.in_b(step) <= fault.step;
    if (goes_on) return;
    first.parts =
        own != alignment.differences.end() ? *own : diff::Difference{partner, fault.step, 0, fault.kind, fault.line, 0};
  }
  first.fault = fault;
}

/// The first of what parts and what is computed wrongly, in the order of the run.
std::optional<Divergence> first_divergence(const Judgement& found, const std::set<std::uint8_t>& aside) {
  std::optional<Divergence> first;
  for (const diff::Cause& cause : found.difference.causes) {
    if (cause.part != diff::Part::different || aside.contains(cause.first.kind)) continue;
    const std::int64_t step = shows_at(found, cause);
    if (!first || step < first->step) first = Divergence{cause.first, std::nullopt, cause.too_early, step};
  }
  const auto cause = std::find_if(found.checked.causes.begin(), found.checked.causes.end(),
                                  [&](const Cause& one) { return !aside.contains(one.first.kind); });
  if (cause != found.checked.causes.end()) {
    const Fault& fault = cause->first;
    if (!first || fault.step < first->step) first = Divergence{std::nullopt, fault, std::nullopt, fault.step};
    else if (fault.step == first->step) put_together(found, *first, fault);
  }
  return first;
}

/// Does a run first part from the reference in the depth of a pixel, by far more than rounding?
bool depth_is_wrong(const Divergence& first) {
  constexpr float far_more = 1e-4f;
  if (!first.parts || first.parts->only_a() || first.parts->only_b() || !(first.parts->off > far_more)) return false;
  bool found = false;
  for_each_kind([&]<class E>() {
    if (kind_of<E> != first.parts->kind || !is_of_fragment(at_pixel<E>)) return;
    for_each_index<E>([&]<std::size_t I>() {
      found = found || (field_at<E, I>.name == "z" && (first.parts->fields >> I & 1u) != 0);
    });
  });
  return found;
}

}  // namespace

std::set<std::uint8_t> kinds_of_unknown_edges(const Trace& run) {
  std::set<std::uint8_t> kinds;
  if (!run.has(kind_of<EdgeTableInsert>))
    for (const std::uint8_t kind : {kind_of<EdgeEnter>, kind_of<EdgeStep>, kind_of<EdgeSwap>, kind_of<EdgeRetire>})
      if (run.has(kind)) kinds.insert(kind);
  return kinds;
}

Judgement judge(const Trace& reference, const Trace& run, const std::vector<Part>& parts, const HeldTo& held) {
  Judgement found;
  const std::set<std::uint8_t> aside = kinds_of_unknown_edges(run);
  CheckMarks marks;
  found.checked = check(run, nullptr, nullptr, &marks, held);
  found.difference = diff::compare(reference, run, nullptr, diff::Way::fast, held, diff::most_differences,
                                   diff::Unrecorded::missing_of_pixels);
  Ends& ends = found.ends = {picture_of(reference), picture_of(run), {}};
  ends.apart = diff::compare_pictures(diff::buffers_of(reference, ends.reference), diff::buffers_of(run, ends.run),
                                      found.difference.precision);
  const Counter counter(reference, run, found.difference, not_computed(run, found.difference, marks.faults), aside);
  for (const Part& part : parts)
    found.parts.push_back(part.level == Level::buffers
                              ? count_pixels(part, drawn(ends.reference), drawn(ends.run),
                                             pixels_apart(ends, reference, run, found.difference.precision),
                                             has_depths(ends.reference))
                              : counter.steps(part));
  found.first = first_divergence(found, aside);
  return found;
}

std::optional<Likely> mistake_in(const Trace& reference, const Trace& run, const Judgement& found,
                                 std::vector<mistakes::Mistake>* either) {
  if (!found.first) return std::nullopt;
  std::int64_t next = 0;
  const auto look_at = [&](std::int64_t step) {
    if (step > found.first->step && (next == 0 || step < next)) next = step;
  };
  for (const diff::Cause& cause : found.difference.causes)
    if (cause.part == diff::Part::different) look_at(shows_at(found, cause));
  for (const Cause& cause : found.checked.causes) look_at(cause.first.step);
  const Precision& precision = found.checked.precision;
  std::optional<Likely> likely;
  const std::int64_t first = found.first->step;
  const std::vector<mistakes::Mistake> some =
      mistakes::mistakes_of(run, first, next, depth_is_wrong(*found.first), precision);
  if (some.size() == 1) {
    likely.emplace().mistake = some.front();
  } else if (!some.empty()) {
    if (either) *either = some;
  } else if (const auto turned = mistakes::turned_of(reference, run, precision)) {
    likely.emplace().mistake = *turned;
  } else if (const mistakes::Diagnosis drawn = mistakes::diagnosis_of_pixels(run, precision); !drawn.either.empty()) {
    if (drawn.either.size() > 1) {
      if (either) *either = drawn.either;
    } else {
      likely.emplace().mistake = drawn.either.front();
      likely->also = drawn.also;
    }
  } else if (const auto two = mistakes::pair_of(run, first, precision)) {
    likely.emplace().mistake = two->first;
    likely->also = two->second;
  }
  return likely;
}

HeldTo held_to(int digits, const std::vector<std::string>& free) {
  std::uint32_t fixed = 0;
  for (std::size_t k = 0; k < words_of<NumberFormat>.size(); ++k)
    if (std::find(free.begin(), free.end(), fmt::format("number_format {}", words_of<NumberFormat>[k])) != free.end())
      fixed |= 1u << k;
  return {digits, fixed};
}

GivenRun given_run(const Header& reference, const Scene& scene, std::vector<std::string> free) {
  return {&reference, &scene, [&reference, free = std::move(free)](const Header& declared) {
            Header header = reference;
            const auto is_free = [&](std::string_view what) {
              return std::find(free.begin(), free.end(), what) != free.end();
            };
            // Fixed point is allowed larger errors, so a run may declare it only where the homework names it.
            const NumberFormat format = declared.conventions.number_format;
            const bool accepted = bits_of(format) == 0 || is_free(fmt::format("number_format {}", word_of(format)));
            if (is_free("number_format") && !(accepted && declared.declares(Convention::number_format)))
              header.undeclared |= bit_of(Convention::number_format);
            header.page = declared.page;
            header.writer = declared.writer;
            for_each_convention([&]<class E>(std::string_view key, E Conventions::*member) {
              if (is_free(key) && (accepted || key != "number_format"))
                header.conventions.*member = declared.conventions.*member;
            });
            return header;
          }};
}

}  // namespace zstep::grade
