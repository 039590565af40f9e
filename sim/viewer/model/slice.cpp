#include "sim/viewer/model/slice.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <type_traits>

#include <fmt/format.h>

#include "sim/viewer/model/summary.hpp"
#include "sim/words/explain.hpp"
#include "sim/words/numbers.hpp"
#include "traces/file/visit.hpp"
#include "traces/formulas/attributes.hpp"
#include "traces/formulas/outlines.hpp"
#include "traces/formulas/rounding.hpp"
#include "traces/formulas/shading.hpp"

namespace zstep::viewer {
namespace {

constexpr std::size_t most_entries = 6'000'000;  // spans and samples that are kept

std::int64_t key_of(const SliceAt& at) {
  return static_cast<std::int64_t>(at.y) * 2 + (at.pass == Pass::light ? 1 : 0);
}

/// Depths of a plane between two columns of a scan line.
SliceSpan along_plane(const PlaneEquation& plane, double y, double x_left, double x_right) {
  const auto depth = [&](double x) { return formulas::plane_depth(plane, x, y); };
  return {0, no_polygon, x_left, depth(x_left), x_right, depth(x_right)};
}

/// What is at work while a trace is read from its beginning.
struct Reading {
  Pass pass = Pass::eye;
  std::int32_t polygon = no_polygon, line = -1;
  std::optional<SliceSpan> span;
  std::int32_t span_y = 0;
  std::unordered_map<std::int32_t, std::int32_t> of_edge, of_piece;
  std::unordered_map<std::int32_t, PlaneEquation> planes;
  std::vector<std::int32_t> inside;

  std::int32_t owner(std::int32_t y) const {
    return span && span_y == y && span->polygon != no_polygon ? span->polygon : polygon;
  }
  std::int32_t polygon_of(std::int32_t piece) const {
    const auto found = of_piece.find(piece);
    return found == of_piece.end() ? no_polygon : found->second;
  }
};

}  // namespace

void SliceLines::find(const Trace& trace) {
  if (found_) return;
  found_ = true;
  complete_ = trace.size() <= quick;
  if (!complete_) return;
  Reading now;
  std::size_t entries = 0;
  const auto line = [&](std::int32_t y) -> Line& { return ++entries, lines_[key_of({now.pass, y})]; };
  const auto sample = [&](std::int64_t step, std::int32_t polygon, std::int32_t y, double x, double z) {
    Line& to = line(y);
    // A compare mostly follows the interpolation that found its depth.
    if (!to.samples.empty() && to.samples.back().x == x && to.samples.back().z == z &&
        to.samples.back().polygon == polygon)
      return;
    to.samples.push_back({step, polygon, x, z});
  };
  trace.visit(0, trace.size(), [&]<class E>(std::int64_t step, std::uint8_t, const E& e) {
    if constexpr (std::is_same_v<E, PassBegin>) now.pass = e.pass, begins_.emplace_back(step, e.pass);
    if constexpr (std::is_same_v<E, BuffersClear>) begins_.emplace_back(step, now.pass);
    if constexpr (std::is_same_v<E, PolygonBegin>) now.polygon = e.polygon, now.span.reset();
    if constexpr (std::is_same_v<E, PieceDraw>) now.polygon = e.polygon, now.span.reset();
    if constexpr (std::is_same_v<E, EdgeTableInsert>) now.of_edge[e.edge] = e.polygon;
    if constexpr (std::is_same_v<E, PieceMake>) now.of_piece[e.piece] = e.polygon;
    if constexpr (std::is_same_v<E, PlaneEquation>) now.planes[e.piece] = e;
    if constexpr (std::is_same_v<E, ScanLineBegin>) now.line = e.y, now.inside.clear(), now.span.reset();
    if constexpr (std::is_same_v<E, FlagFlip>) {
      std::erase(now.inside, e.piece);
      if (e.inside) now.inside.push_back(e.piece);
    }
    if constexpr (std::is_same_v<E, SpanBegin>) {
      const auto found = now.of_edge.find(e.left_edge);
      now.span = {step,     found == now.of_edge.end() ? now.polygon : found->second, e.x_left, e.z_left, e.x_right,
                  e.z_right};
      now.span_y = e.y;
      line(e.y).spans.push_back(*now.span);
    }
    if constexpr (std::is_same_v<E, SpanFlags>)
      for (const std::int32_t piece : now.inside)
        if (const auto plane = now.planes.find(piece); plane != now.planes.end()) {
          SliceSpan span = along_plane(plane->second, e.y, e.x_left, e.x_right);
          span.step = step, span.polygon = now.polygon_of(piece);
          line(e.y).spans.push_back(span);
        }
    if constexpr (std::is_same_v<E, PlaneDepth>)
      if (e.y_at == now.line) sample(step, now.polygon_of(e.piece), now.line, e.x_at, e.z);
    if constexpr (is_of_fragment(at_pixel<E>)) sample(step, now.owner(e.y), e.y, e.x, e.z);
    if constexpr (std::is_same_v<E, PixelPaint>) sample(step, e.polygon, e.y, e.x, e.z);
    return entries <= most_entries;
  });
  if (entries > most_entries) complete_ = false, lines_.clear();
}

const SliceLines::Line& SliceLines::of(const Trace& trace, const SliceAt& at) {
  static const Line none;
  find(trace);
  const auto found = lines_.find(key_of(at));
  return found == lines_.end() ? none : found->second;
}

bool SliceLines::complete(const Trace& trace) {
  find(trace);
  return complete_;
}

std::int64_t SliceLines::begun(Pass pass, std::int64_t position) const {
  std::int64_t last = 0;
  for (auto it = std::upper_bound(begins_.begin(), begins_.end(), position,
                                  [](std::int64_t p, const auto&begin) { return p < begin.first; });
       it != begins_.begin();)
    if ((--it)->second == pass) {
      last = it->first;
      break;
    }
  return last;
}

std::optional<SliceAt> slice_line(const Moment& now, std::optional<Cell> chosen) {
  const MethodState& machine = now.state().machine;
  if (chosen) return SliceAt{machine.pass, chosen->y};
  if (!now.event()) return std::nullopt;
  if (const auto* neighbour = get_if<ShadowNeighbour>(&now.event()->event))
    return SliceAt{Pass::light, neighbour->y_shadow};
  if (const auto* shadow = get_if<ShadowCompare>(&now.event()->event)) {
    const double row = std::round(shadow->y_light);
    if (row >= 0 && row < now.state().light.height) return SliceAt{Pass::light, static_cast<std::int32_t>(row)};
  }
  if (const auto pixel = pixel_of(now.event()->event)) return SliceAt{machine.pass, pixel->y};
  if (machine.scan_line) return SliceAt{machine.pass, *machine.scan_line};
  return std::nullopt;
}

namespace {

/// What the step at work holds against the buffer, where that is on this line.
std::optional<Slice::Compare> compare_at(const Moment& now, const SliceAt& at, const Picture& picture) {
  if (!now.event() || now.picture_position() != now.position()) return std::nullopt;
  const MethodState& machine = now.state().machine;
  const Event& event = now.event()->event;
  if (const auto* shadow = get_if<ShadowCompare>(&event)) {
    const double column = std::round(shadow->x_light);
    if (at.pass != Pass::light || !(column >= 0 && column < picture.width)) return std::nullopt;
    const std::size_t pixel = picture.at(static_cast<std::int32_t>(column), at.y);
    return Slice::Compare{
        no_polygon, shadow->x_light, shadow->z_light, picture.depth[pixel], picture.polygon[pixel], shadow->lit, false};
  }
  if (const auto* neighbour = get_if<ShadowNeighbour>(&event); neighbour && machine.shadow) {
    if (at.pass != Pass::light) return std::nullopt;
    const std::size_t pixel = picture.at(neighbour->x_shadow, at.y);
    return Slice::Compare{no_polygon,
                          static_cast<double>(neighbour->x_shadow),
                          machine.shadow->z_light,
                          picture.depth[pixel],
                          picture.polygon[pixel],
                          neighbour->lit,
                          false};
  }
  const auto pixel = pixel_of(event);
  if (!pixel || pixel->y != at.y || at.pass != machine.pass || !machine.fragment) return std::nullopt;
  const Fragment& f = *machine.fragment;
  if (f.x != pixel->x || f.y != pixel->y) return std::nullopt;
  const bool compares = is_of_fragment(at_pixel_of(event));
  const auto* paint = get_if<PixelPaint>(&event);
  const std::int32_t polygon = paint ? paint->polygon : polygon_at_work(machine);
  return Slice::Compare{polygon, static_cast<double>(f.x), f.z, f.stored, f.stored_polygon, f.nearer, !compares};
}

void widen(Slice& slice, double x, double z) {
  if (std::isfinite(x)) slice.x_first = std::min(slice.x_first, x), slice.x_last = std::max(slice.x_last, x);
  if (std::isfinite(z)) slice.low = std::min(slice.low, z), slice.high = std::max(slice.high, z);
}

/// Of all that is drawn on the line; of the whole picture where nothing is.
void find_axes(Slice& slice, const SliceLines::Line& line, const Picture& picture) {
  constexpr double none = std::numeric_limits<double>::infinity();
  slice.low = slice.x_first = none, slice.high = slice.x_last = -none;
  for (const SliceSpan& span : line.spans)
    widen(slice, span.x_left, span.z_left), widen(slice, span.x_right, span.z_right);
  for (const SliceSpan& span : slice.spans)
    widen(slice, span.x_left, span.z_left), widen(slice, span.x_right, span.z_right);
  for (const SliceSample& sample : line.samples) widen(slice, sample.x, sample.z);
  if (slice.compare) widen(slice, slice.compare->x, slice.compare->z);
  for (std::size_t x = 0; x < slice.stored.size(); ++x)
    if (slice.stored[x] != slice.empty) widen(slice, static_cast<double>(x), slice.stored[x]);
  const double right = picture.width - 0.5;
  slice.x_first = slice.x_first <= slice.x_last ? std::max(-0.5, slice.x_first - 1) : -0.5;
  slice.x_last = std::isfinite(slice.x_last) ? std::min(right, slice.x_last + 1) : right;
  if (!(slice.x_first < slice.x_last)) slice.x_first = -0.5, slice.x_last = right;
  if (!(slice.low <= slice.high)) slice.low = 0, slice.high = 1;
  const double size = std::max(std::abs(slice.low), std::abs(slice.high));
  if (slice.high - slice.low <= 1e-12 * size) {  // one depth, but for rounding: no number fits between
    const double room = size == 0 ? 1 : size * 0.1;
    slice.low -= room, slice.high += room;
  }
}

}  // namespace

namespace {

/// Of an interval of the scan-line method: the depths found at one place so far, and where it is decided, those in the
/// middle of the pixels that the nearest wins.
void find_rivals(const Moment& now, Slice& slice) {
  if (!now.event()) return;
  const MethodState& machine = now.state().machine;
  if (const auto* depth = get_if<PlaneDepth>(&now.event()->event))
    for (const SliceSample& sample : slice.samples)
      if (sample.step > slice.work_from && sample.x == depth->x_at) slice.rivals.push_back(sample);
  const auto* winner = get_if<SpanWinner>(&now.event()->event);
  if (!winner || winner->piece < 0 || winner->piece >= std::ssize(machine.pieces)) return;
  if (winner->last < winner->first) return;  // between two pixels
  slice.winner = machine.pieces[winner->piece].polygon;
  const double x = (static_cast<double>(winner->first) + winner->last) / 2;
  for (const SliceSpan& span : slice.spans) {
    if (span.step != slice.work_from || !(span.x_left < span.x_right)) continue;
    const double share = (x - span.x_left) / (span.x_right - span.x_left);
    slice.rivals.push_back({span.step, span.polygon, x, span.z_left + share * (span.z_right - span.z_left)});
  }
}

}  // namespace

Slice slice_of(const Moment& now, SliceLines& lines, const SliceAt& at) {
  const SliceLines::Line& line = lines.of(now.trace(), at);
  const MethodState& machine = now.state().machine;
  const bool lights = at.pass == Pass::light && machine.pass != Pass::light;
  const Picture& picture = lights ? now.state().light : now.picture();
  Slice slice;
  slice.at = at;
  slice.complete = lines.complete(now.trace());
  slice.empty = now.header().empty_depth();
  const std::int64_t until = now.picture_position(), begun = lines.begun(at.pass, until);
  const auto shown = [&](const auto& all, auto& out) {
    for (const auto& one : all)
      if (one.step > begun && one.step <= until) out.push_back(one);
  };
  shown(line.spans, slice.spans);
  shown(line.samples, slice.samples);
  if (!slice.complete && machine.span && machine.span->y == at.y && machine.pass == at.pass) {
    const SpanBegin& span = *machine.span;
    slice.spans.push_back({until, polygon_at_work(machine), span.x_left, span.z_left, span.x_right, span.z_right});
  }
  if (at.y >= 0 && at.y < picture.height && !picture.depth.empty())
    for (std::int32_t x = 0; x < picture.width; ++x) slice.stored.push_back(picture.depth[picture.at(x, at.y)]);
  const bool here = machine.pass == at.pass && until == now.position();
  if (here && machine.span && machine.span->y == at.y && !slice.spans.empty())
    slice.work_from = slice.spans.back().step;
  slice.compare = compare_at(now, at, picture);
  if (here && machine.sweep.interval && machine.sweep.interval->y == at.y && !slice.spans.empty()) {
    slice.work_from = slice.spans.back().step;
    find_rivals(now, slice);
  }
  find_axes(slice, line, picture);
  return slice;
}

std::optional<Slice> attribute_slice(const Moment& now) {
  const auto* step = now.event() ? get_if<AttributeInterpolate>(&now.event()->event) : nullptr;
  const Scene& scene = now.scene();
  const State& state = now.state();
  const MethodState& machine = state.machine;
  if (!step || now.picture_position() != now.position() || scene.camera.kind == Camera::Kind::screen)
    return std::nullopt;
  const formulas::Shading shading = formulas::shading_of(scene, now.header().conventions);
  if (!shading.is_known()) return std::nullopt;
  const auto stages = [&](std::int32_t vertex) {
    const auto at = static_cast<std::size_t>(vertex);
    return vertex >= 0 && at < state.vertices.size() ? state.vertices[at] : VertexStages();
  };
  struct Corner {
    double place, a;
    formulas::OverDepth<double> over;
  };
  for (const bool upright : {false, true}) {
    // Where the outline meets the line, and what the attribute is there.
    std::vector<Corner> ends;
    const auto corner = [&](std::int32_t vertex) {
      const VertexStages& at = stages(vertex);
      const double a = formulas::attribute_of(scene, shading, machine.component, machine.facet, vertex, at.view,
                                              [&](std::int32_t point) { return stages(point).view; });
      const bool divided = scene.camera.kind == Camera::Kind::perspective;
      return Corner{upright ? at.raster.y : at.raster.x, a, formulas::over_depth(a, divided ? at.view.z : 1.0)};
    };
    const std::vector<std::int32_t>& outline = machine.outline;
    for (std::size_t k = 0; k < outline.size(); ++k) {
      const std::int32_t one = outline[k], other = outline[(k + 1) % outline.size()];
      if (!on_raster(scene, state, one) || !on_raster(scene, state, other)) return std::nullopt;
      const auto across = [&](std::int32_t vertex) {
        return upright ? stages(vertex).raster.x - step->x : stages(vertex).raster.y - step->y;
      };
      const double from = across(one), to = across(other);
      if (from == to || from * to > 0) continue;
      const Corner p = corner(one), q = corner(other);
      ends.push_back({formulas::on_line(p.place, q.place, 0.0, from, to), formulas::on_line(p.a, q.a, 0.0, from, to),
                      formulas::on_line(p.over, q.over, 0.0, from, to)});
    }
    if (ends.size() < 2) continue;
    std::stable_sort(ends.begin(), ends.end(), [](const Corner& p, const Corner& q) { return p.place < q.place; });
    const Corner &first = ends.front(), &last = ends.back();
    if (!(first.place < last.place) || std::abs(first.a - last.a) <= 1e-9 * std::max(1.0, std::abs(first.a))) continue;
    Slice slice;
    slice.at = {machine.pass, upright ? step->x : step->y};
    slice.upright = upright, slice.attribute = shading.attribute ? std::string(shading.name(machine.component)) : "a";
    slice.work_from = now.position();
    slice.spans.push_back({now.position(), machine.polygon, first.place, first.a, last.place, last.a});
    for (double at = std::ceil(first.place); at <= last.place; ++at) {
      const auto over = formulas::on_line(first.over, last.over, at, first.place, last.place);
      slice.correct.push_back({now.position(), machine.polygon, at, over.over_z / over.one_over_z});
    }
    const double at = upright ? step->y : step->x;
    const double linear = formulas::on_line(first.a, last.a, at, first.place, last.place);
    slice.compare = {machine.polygon, at, step->attribute, linear, no_polygon, std::nullopt, false};
    slice.low = std::min(first.a, last.a), slice.high = std::max(first.a, last.a);
    slice.x_first = first.place - 1, slice.x_last = last.place + 1;
    return slice;
  }
  return std::nullopt;
}

std::string slice_sentence(const Moment& now, const Slice& slice) {
  const auto name = [&](std::int32_t polygon) { return polygon_label(now.scene(), polygon); };
  if (slice.winner && slice.rivals.size() > 1) {
    std::string depths;
    for (const SliceSample& rival : slice.rivals)
      depths += fmt::format("{}{} {}", depths.empty() ? "" : ", ", name(rival.polygon), number(rival.z));
    return fmt::format("At x = {}: {}. {} is nearest.", number(slice.rivals.front().x), depths, name(*slice.winner));
  }
  if (!slice.compare || !slice.compare->nearer || slice.compare->written) return "";
  const Slice::Compare& c = *slice.compare;
  const Comparison& comparison = now.header().comparison;
  const double unit = depth_unit(now.scene(), now.header().conventions);
  const double least = unit > 0 ? formulas::least_depth(now.scene(), now.header().conventions.depth) : 0;
  const auto shown = [&](double depth) { return unit > 0 ? std::round((depth - least) / unit * 1e6) / 1e6 : depth; };
  const auto [z, stored] = tell_apart(shown(c.z), shown(c.stored));
  const bool shadow =
      now.event() && (holds<ShadowCompare>(now.event()->event) || holds<ShadowNeighbour>(now.event()->event));
  const std::string who = shadow                    ? "the point"
                          : c.polygon == no_polygon ? "the new depth"
                                                    : name(c.polygon),
                    against = c.stored_polygon == no_polygon ? "" : " than " + name(c.stored_polygon);
  const std::string verdict =
      shadow ? (*c.nearer ? "lit" : "in shadow") : (*c.nearer ? "nearer" : "not nearer") + against;
  const std::string x = number(c.x);
  if (shadow)
    return fmt::format("At x = {}, the point's depth is {}, the stored one {}: it is {}.", x, z, stored, verdict);
  if (!now.header().declares(Convention::nearer))
    return fmt::format("At x = {}, {} is at {}, stored is {}: the trace says {}.", x, who, z, stored,
                       *c.nearer ? "nearer" : "not nearer");
  const bool wins = comparison.wins(c.z, c.stored);
  const std::string compared = fmt::format("{} {} {}{}", z, comparison.sign(), stored, wins ? "" : " is false");
  if (wins != *c.nearer)
    return fmt::format("At x = {}, {}, but the trace says {}.", x, wins ? compared + " is true" : compared,
                       *c.nearer ? "nearer" : "not nearer");
  return fmt::format("At x = {}, {}: {} is {}.", x, compared, who, verdict);
}

}  // namespace zstep::viewer
