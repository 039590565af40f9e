#include "traces/oracle/errors.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <utility>

#include "traces/check/precision.hpp"
#include "traces/formulas/of_pieces.hpp"
#include "traces/formulas/rounding.hpp"
#include "traces/formulas/walk.hpp"
#include "traces/oracle/exact_depth.hpp"
#include "traces/oracle/exact_geometry.hpp"

namespace zstep::oracle {

namespace {

using formulas::Situation;

/// A depth at a pixel: as the run has it, and what it is exactly.
struct Known {
  std::shared_ptr<const ExactDepth> exact;  ///< null where it is not known
  double z = 0;
  std::int32_t polygon = no_polygon;
  std::int32_t facet = -1;        ///< of rays
  std::int32_t scene_facet = -1;  ///< whose plane in the scene says what it is exactly
};

/// The comparisons that a header leaves open; one where it declares all.
std::vector<Comparison> open_comparisons(const Header& header) {
  std::vector<Comparison> open;
  for (const Comparison::Nearer nearer : {Comparison::Nearer::smaller, Comparison::Nearer::greater})
    for (const Comparison::Ties ties : {Comparison::Ties::first, Comparison::Ties::last})
      if ((!header.declares(Convention::nearer) || nearer == header.comparison.nearer) &&
          (!header.declares(Convention::ties) || ties == header.comparison.ties))
        open.push_back({nearer, ties});
  return open;
}

/// Is a decision that a run made by its own numbers another one with the exact ones, whose difference has this sign?
/// Only what its own numbers decide as it did can have been turned by them: the rest are mistakes.
enum class Turned : std::uint8_t { no, yes, open };
Turned turned(bool decided, double z, double stored, int exactly, const std::vector<Comparison>& open) {
  bool some = false, all = true;
  for (const Comparison& comparison : open) {
    if (comparison.wins(z, stored) != decided) continue;
    const bool other = comparison.wins(exactly, 0) != decided;
    some = some || other, all = all && other;
  }
  return !some ? Turned::no : all ? Turned::yes : Turned::open;
}

/// Two depths in decimals: as many as float64 has, and more where these are the same. What float64 holds is written as
/// short as that can be.
std::pair<std::string, std::string> told_apart(const ExactDepth& a, const ExactDepth& b, std::int32_t x) {
  const auto one = a.exactly(x), other = b.exactly(x);
  constexpr int most = 1024;
  int count = std::numeric_limits<double>::max_digits10;
  const auto alike = [&] { return *one != *other && decimals_of(*one, count) == decimals_of(*other, count); };
  while (count < most && one && other && alike()) count *= 2;
  const auto digits = [&](const std::optional<Rational>& exact) -> std::string {
    if (!exact) return "\u221e";
    std::string text = decimals_of(*exact, count);
    if (const double near = rounded(*exact); !std::isfinite(near) || *exact != Rational(near)) return text;
    if (text.find('e') != std::string::npos || text.find('.') == std::string::npos) return text;
    text.erase(text.find_last_not_of('0') + 1);
    if (text.ends_with('.')) text.pop_back();
    return text;
  };
  return {digits(one), digits(other)};
}

class DepthJudge {
 public:
  DepthJudge(const Trace& trace, Truth truth, const std::function<void(const DepthError&)>& on_depth)
      : trace_(trace),
        on_depth_(on_depth),
        truth_(truth),
        along_(along_of(trace, truth)),
        cuts_(trace.has(kind_of<SplitVertex>) || formulas::run_cuts_in_world(trace.header(), trace.scene())),
        vertices_(formulas::run_cuts_in_world(trace.header(), trace.scene()) ? ExactVertices::From::world
                                                                             : ExactVertices::From::vertices),
        rays_(trace.scene(), stored_depth(trace.header().conventions.depth)),
        open_(open_comparisons(trace.header())) {
    const Precision precision = precision_of(trace);
    Conventions conventions = trace.header().conventions;
    conventions.number_format = precision.format;
    found_.format = precision.format, found_.format_text = precision.text;
    found_.unit = depth_unit(trace.scene(), conventions);
    const Raster& raster = trace.scene().raster;
    const std::size_t pixels = pixel_count(raster.width, raster.height);
    stored_.resize(pixels), fighting_.resize(pixels);
    if (trace.header().declares(Convention::nearer)) nearest_.resize(pixels * open_.size());
    found_.of_pixel.assign(pixels, std::numeric_limits<double>::quiet_NaN());
    found_.depth_error_of_pixel = found_.of_pixel;
    found_.scene_facet_of_pixel.assign(pixels, -1);
  }

  template <class E>
  void step(std::int64_t position, const E& e, const Situation& at) {
    if (at.method().pass == Pass::light) return;
    if constexpr (std::is_same_v<E, EdgeTableInsert>) edge_inserted(position, e.edge);
    if constexpr (std::is_same_v<E, SpanBegin>) {
      spans_.resize(at.place_of_next_span().number);
      spans_.push_back({.began = position});
      // When its pixels come the edges may be another polygon's.
      if (at.ahead.of_all) find_exactly(spans_.back(), at, e);
    }
    if constexpr (std::is_same_v<E, PolygonBegin> || std::is_same_v<E, PlaneSlopes>) rows_.clear();
    if constexpr (std::is_same_v<E, PolygonBegin>) waiting_.clear(), won_.clear();
    if constexpr (std::is_same_v<E, BuffersClear>) clear();
    if constexpr (std::is_same_v<E, RayBegin>)
      if (e.role == RayRole::eye) ray_ = e, ray_kept_ = {}, ray_nearest_ = {};
    if constexpr (std::is_same_v<E, RayHit>) hit(position, e, at);
    if constexpr (std::is_same_v<E, DepthInterpolate> || std::is_same_v<E, PixelPaint>) compute(position, e, at);
    if constexpr (has(at_pixel<E>, AtPixel::verdict)) {
      if (!at.records<DepthInterpolate>() || !find_fragment(e, static_cast<std::size_t>(at.pixel(e.x, e.y))))
        compute(position, e, at);
      compare(position, e, at);
    }
    if constexpr (std::is_same_v<E, DepthWrite> || std::is_same_v<E, PixelPaint>)
      store(position, static_cast<std::size_t>(at.pixel(e.x, e.y)), e.x, e.y, e.z);
    if (cuts_) vertices_.step(e, at);
  }

  Errors finish() {
    for (std::size_t pixel = 0; pixel < stored_.size(); ++pixel) {
      const auto is_wrong = [&](const Nearest& nearest) {
        const std::int32_t seen = nearest.exactly.polygon;
        return nearest.exactly.exact && stored_[pixel].polygon != seen && nearest.by_run.polygon != seen;
      };
      const std::span<const Nearest> nearest = nearest_at(pixel);
      found_.wrong_pixels +=
          stored_[pixel].exact && !nearest.empty() && std::all_of(nearest.begin(), nearest.end(), is_wrong);
    }
    for (const Known& stored : stored_) found_.polygon_of_pixel.push_back(stored.polygon);
    found_.fighting_pixels = std::count(fighting_.begin(), fighting_.end(), true);
    found_.fighting = std::move(fighting_);
    for (const auto& [polygon, errors] : polygons_) found_.polygons.push_back(errors);
    for (auto& [edge, errors] : along_edges_)
      if (errors.size() > found_.along_edge.size()) found_.along_edge = std::move(errors);
    return std::move(found_);
  }

 private:
  /// What is nearest of all that came to a pixel: by the exact depths, and by the run's own numbers.
  struct Nearest {
    Known exactly, by_run;
    void meet(const Known& here, std::int32_t x, const Comparison& comparison) {
      const bool known = here.exact && exactly.exact;
      if (!known || comparison.wins(here.exact->compare(*exactly.exact, x), 0)) exactly = here;
      if (!known || comparison.wins(here.z, by_run.z)) by_run = here;
    }
  };
  /// By open_; empty where it is not declared which depth is nearer.
  std::span<Nearest> nearest_at(std::size_t pixel) {
    const std::size_t count = nearest_.size() / stored_.size();
    return std::span(nearest_).subspan(pixel * count, count);
  }

  void clear() {
    std::fill(stored_.begin(), stored_.end(), Known{});
    std::fill(nearest_.begin(), nearest_.end(), Nearest{});
    waiting_.clear(), won_.clear();
    std::fill(found_.of_pixel.begin(), found_.of_pixel.end(), std::numeric_limits<double>::quiet_NaN());
    found_.depth_error_of_pixel = found_.of_pixel;
  }

  /// A span of those that no pixel came between.
  struct Span {
    std::int64_t began = 0;  ///< its step
    std::shared_ptr<const ExactDepth> exact = nullptr;
    bool tried = false;
  };
  void find_exactly(Span& found, const Situation& at, const SpanBegin& span) const {
    found.tried = true;
    auto exact = truth_ == Truth::formula && at.method().slopes ? on_plane(at, *at.method().slopes, span.y)
                                                                : between_edges(at, span);
    if (exact) found.exact = std::make_shared<const ExactDepth>(std::move(*exact));
  }
  Span* span_at(const Situation::SpanOfPixel& of) {
    const std::size_t number = of.place.number;
    return of && number < spans_.size() ? &spans_[number] : nullptr;
  }
  /// The span of a pixel, exactly; null where the trace does not have what it needs.
  std::shared_ptr<const ExactDepth> exact_span(const Situation& at, std::int32_t y, const Situation::SpanOfPixel& of) {
    Span* span = span_at(of);
    if (!span || of->y != y) return nullptr;
    if (!span->tried) find_exactly(*span, at, *of.span);
    return span->exact;
  }
  /// `corrected` interpolates 1/z_v, and what is stored is z_v.
  static Conventions::Depth stored_depth(Conventions::Depth depth) {
    return depth == Conventions::Depth::corrected ? Conventions::Depth::view : depth;
  }
  static Along along_of(const Trace& trace, Truth truth) {
    const Conventions::Depth depth = trace.header().conventions.depth;
    if (trace.scene().camera.kind != Camera::Kind::perspective) return Along::depth;
    if (depth == Conventions::Depth::corrected) return Along::reciprocal;
    const bool bent = depth == Conventions::Depth::view && truth == Truth::surface;
    return bent ? Along::through_inverses : Along::depth;
  }
  /// A vertex with its depth, which a run that leaves out projection does not record.
  std::optional<OnRaster> vertex(const Situation& at, std::int32_t number) const {
    const bool known = at.on_screen() || at.records<Projection>() || !at.records<ViewportTransform>();
    return known ? at.on_raster(number) : std::nullopt;
  }
  std::optional<ExactDepth> between_edges(const Situation& at, const SpanBegin& span) const {
    if (cuts_) return between_parts(at, span);
    const auto left = edge(at, span.left_edge), right = edge(at, span.right_edge);
    return left && right ? ExactDepth::between(*left, *right, span.y, along_) : std::nullopt;
  }
  std::optional<ExactDepth> between_parts(const Situation& at, const SpanBegin& span) const {
    const EdgeTableInsert *left = at.edge(span.left_edge), *right = at.edge(span.right_edge);
    if (!left || !right) return std::nullopt;
    const auto a = vertices_.on_raster(left->vertex_0, at), b = vertices_.on_raster(left->vertex_1, at),
               c = vertices_.on_raster(right->vertex_0, at), d = vertices_.on_raster(right->vertex_1, at);
    return a && b && c && d ? ExactDepth::between(*a, *b, *c, *d, span.y, along_) : std::nullopt;
  }
  /// Where depths go by the plane of three vertices, that is what they are without rounding: the others need not lie in
  /// it to the last digit.
  std::optional<ExactDepth> on_plane(const Situation& at, const PlaneSlopes& slopes, std::int32_t y) const {
    const auto a = vertex(at, slopes.vertex_0), b = vertex(at, slopes.vertex_1), c = vertex(at, slopes.vertex_2);
    if (!a || !b || !c) return std::nullopt;
    return ExactDepth::on_plane({a->x, a->y, a->z}, {b->x, b->y, b->z}, {c->x, c->y, c->z}, y, along_);
  }
  /// A pixel of which the trace has no span: on the plane of the slopes at work, or of the facet.
  std::shared_ptr<const ExactDepth> exact_polygon(const Situation& at, std::int32_t x, std::int32_t y,
                                                  std::int32_t polygon) {
    const auto& slopes = at.method().slopes;
    const bool by_slopes = truth_ == Truth::formula && slopes && slopes->polygon == polygon;
    const std::int32_t facet = by_slopes ? -1 : facet_of(at, polygon);
    if (!by_slopes && facet < 0) return nullptr;
    ++found_.by_polygon;
    const auto corners = by_slopes ? std::array{slopes->vertex_0, slopes->vertex_1, slopes->vertex_2} : triangle(facet);
    if (by_slopes || (corners[0] >= 0 && !is_bent() && is_on_raster(at, corners))) {
      const auto [row, fresh] = rows_.try_emplace(y);
      const PlaneSlopes through{polygon, corners[0], corners[1], corners[2], 0, 0};
      if (fresh)
        if (auto exact = on_plane(at, through, y)) row->second = std::make_shared<const ExactDepth>(*std::move(exact));
      if (row->second) return row->second;
    } else if (const auto t = rays_.meet(facet, x, y)) {
      scene_facet_ = facet;
      return constant(rays_.depth(*t));
    }
    --found_.by_polygon;
    return nullptr;
  }
  /// The facet at work, if it is the polygon's; else the polygon's only one. -1 where there is none.
  std::int32_t facet_of(const Situation& at, std::int32_t polygon) const {
    const std::vector<Facet>& facets = trace_.scene().facets;
    const std::size_t at_work = at.method().facet;
    if (at.method().facet >= 0 && at_work < facets.size() && facets[at_work].polygon == polygon)
      return at.method().facet;
    const auto of_polygon = [&](const Facet& facet) { return facet.polygon == polygon; };
    const auto first = std::find_if(facets.begin(), facets.end(), of_polygon);
    if (first == facets.end() || std::find_if(first + 1, facets.end(), of_polygon) != facets.end()) return -1;
    return static_cast<std::int32_t>(first - facets.begin());
  }
  std::array<std::int32_t, 3> triangle(std::int32_t facet) const {
    const Scene& scene = trace_.scene();
    const Facet& of = scene.facets[facet];
    if (of.corner_count != 3) return {-1, -1, -1};
    const auto corner = [&](std::int32_t i) { return scene.corners[of.first_corner + i]; };
    return {corner(0), corner(1), corner(2)};
  }
  bool is_on_raster(const Situation& at, const std::array<std::int32_t, 3>& corners) const {
    return std::all_of(corners.begin(), corners.end(), [&](std::int32_t one) { return vertex(at, one).has_value(); });
  }
  /// Is z_v not linear on the picture?
  bool is_bent() const {
    return trace_.scene().camera.kind == Camera::Kind::perspective &&
           trace_.header().conventions.depth == Conventions::Depth::view;
  }
  std::optional<Edge> edge(const Situation& at, std::int32_t number) const {
    const EdgeTableInsert* entry = at.edge(number);
    if (!entry) return std::nullopt;
    const auto from = vertex(at, entry->vertex_0), to = vertex(at, entry->vertex_1);
    if (!from || !to) return std::nullopt;
    return Edge{{from->x, from->y, from->z}, {to->x, to->y, to->z}};
  }

  /// Where planes are compared: that of the piece which is seen on the interval or fills the area at work.
  std::shared_ptr<const ExactDepth> exact_plane(const Situation& at, std::int32_t x, std::int32_t y) const {
    const MethodState& method = at.method();
    std::int32_t piece = method.sweep.winners.empty() ? -1 : method.sweep.winners.back().piece;
    const std::size_t area = method.area;
    if (method.area >= 0 && area < method.areas.size() && method.areas[area].decided)
      piece = method.areas[area].decided->piece;
    const auto plane = vertices_.plane_of(piece, at);
    return plane && plane->c != 0 ? constant(plane->depth(x, y)) : nullptr;
  }

  // --- Rays: what the one from the eye meets first gives the pixel its depth.

  static std::shared_ptr<const ExactDepth> constant(const Rational& value) {
    return std::make_shared<const ExactDepth>(ExactDepth::of(value));
  }
  std::shared_ptr<const ExactDepth> exact_ray(const Situation& at, std::int32_t x, std::int32_t y) {
    const std::vector<RayRow>& tree = at.method().rays.tree;
    if (tree.empty() || !tree[0].end || tree[0].entry.x != x || tree[0].entry.y != y) return nullptr;
    const auto t = rays_.meet(tree[0].end->nearest_facet, x, y);
    return t ? constant(rays_.depth(*t)) : nullptr;
  }
  void hit(std::int64_t position, const RayHit& e, const Situation& at) {
    if (!e.inside || at.method().rays.tree.size() != 1) return;
    const auto t = rays_.meet(e.facet, ray_.x, ray_.y);
    const std::size_t facet = e.facet;
    if (!t || facet >= trace_.scene().facets.size()) return;
    const Known here{constant(*t), e.t, trace_.scene().facets[facet].polygon, e.facet, -1};
    // Of equal t the facet that comes first in the scene is kept.
    const auto sign = [&](const Known& than) { return here.exact->compare(*than.exact, ray_.x); };
    const auto keeps = [&](double near, const Known& than, double other) {
      return !than.exact || near < other || (near == other && here.facet < than.facet);
    };
    if (ray_kept_.exact) {
      std::vector<Comparison> open{{Comparison::Nearer::smaller, Comparison::Ties::first},
                                   {Comparison::Nearer::smaller, Comparison::Ties::last}};
      if (trace_.header().declares(Convention::ties)) open.erase(open.begin() + (here.facet < ray_kept_.facet ? 0 : 1));
      judge(position, ray_.x, ray_.y, e.nearest, here, ray_kept_, open);
    }
    if (e.nearest) ray_kept_ = here;
    Known &exactly = ray_nearest_.exactly, &by_run = ray_nearest_.by_run;
    if (keeps(exactly.exact ? sign(exactly) : 0, exactly, 0)) exactly = here;
    if (keeps(here.z, by_run, by_run.z)) by_run = here;
  }
  /// A decision about a depth and what is stored, held against the exact ones.
  void judge(std::int64_t position, std::int32_t x, std::int32_t y, bool decided, const Known& z, const Known& stored,
             const std::vector<Comparison>& open) {
    ++found_.compares;
    const Turned is_turned = turned(decided, z.z, stored.z, z.exact->compare(*stored.exact, x), open);
    found_.left_open += is_turned == Turned::open;
    if (is_turned == Turned::yes) decided_wrong(position, x, y, z, stored);
  }
  void decided_wrong(std::int64_t position, std::int32_t x, std::int32_t y, const Known& z, const Known& stored) {
    ++found_.all.decided_wrong;
    const std::size_t pixel = pixel_at(x, y, trace_.scene().raster.width);
    fighting_[pixel] = true;
    found_.turned.resize(fighting_.size());
    for (const Known* of : {&z, &stored})
      if (const double off = std::abs(of->exact->error_of(of->z, x)); !(off <= found_.turned[pixel].error))
        found_.turned[pixel] = {off, of->scene_facet};
    ++polygons_.try_emplace(z.polygon, ErrorOf{z.polygon}).first->second.decided_wrong;
    constexpr std::size_t most = 100;
    if (found_.decisions.size() >= most) return;
    const auto [z_digits, stored_digits] = told_apart(*z.exact, *stored.exact, x);
    found_.decisions.push_back(
        {position, x, y, z.polygon, z.z, stored.z, z.exact->at(x), stored.exact->at(x), z_digits, stored_digits});
  }

  template <class E>
  void compute(std::int64_t position, const E& e, const Situation& at) {
    std::shared_ptr<const ExactDepth> exact;
    scene_facet_ = -1;
    leave_fragment();
    const Situation::SpanOfPixel span = at.span_of(e);
    std::int32_t polygon = polygon_of(at, span);
    if constexpr (std::is_same_v<E, PixelPaint>) {
      polygon = e.polygon;
      const bool by_planes = trace_.has(kind_of<SpanWinner>) || trace_.has(kind_of<AreaDecide>);
      exact = trace_.has(kind_of<RayEnd>) ? exact_ray(at, e.x, e.y)
              : by_planes                 ? exact_plane(at, e.x, e.y)
                                          : exact_span(at, e.y, span);
    } else {
      exact = exact_span(at, e.y, span);
    }
    if (!exact && !trace_.has(kind_of<RayEnd>)) exact = exact_polygon(at, e.x, e.y, polygon);
    fragment_ = {exact, e.z, polygon, -1, scene_facet_}, fragment_x_ = e.x, fragment_y_ = e.y;
    came_to_ = std::is_same_v<E, DepthInterpolate> ? CameTo::depth : CameTo::end;
    if (!exact) {
      ++found_.not_judged;
      return;
    }
    const bool finite = std::isfinite(e.z);
    if (!finite && ++found_.not_finite == 1) found_.not_finite_step = position;
    constexpr double infinite = std::numeric_limits<double>::infinity();
    const double off = finite ? exact->error_of(e.z, e.x) : infinite;
    const double unit = finite ? formulas::last_digit(e.z, found_.format, found_.unit) : 1;
    const double off_view =
        finite ? view_depth_error(trace_.scene().camera, trace_.header().conventions, e.z, off) : infinite;
    error_ = off / unit;
    for (ErrorOf* of : {&found_.all, &polygons_.try_emplace(polygon, ErrorOf{polygon}).first->second}) {
      ++of->depths;
      of->sum_of_squares += error_ * error_;
      if (std::abs(error_) > of->largest) {
        of->largest = std::abs(error_);
        if (of == &found_.all) found_.steepest_step = position;
      }
      if (std::abs(off) > of->largest_depth) {
        of->largest_depth = std::abs(off);
        if (of == &found_.all) found_.deepest_step = position;
      }
      of->largest_view = std::max(of->largest_view, std::abs(off_view));
      of->sum_of_squares_view += off_view * off_view;
    }
    note_drift(position, at, e.x, e.y, e.z, span);
  }
  /// Edges are numbered anew in each edge table.
  void edge_inserted(std::int64_t position, std::int32_t number) {
    const std::size_t edge = number;
    if (number < 0 || edge > inserted_.size()) return;
    if (edge == inserted_.size()) inserted_.push_back(position);
    else inserted_[edge] = position;
  }
  void note_drift(std::int64_t position, const Situation& at, std::int32_t x, std::int32_t y, double z,
                  const Situation::SpanOfPixel& span) {
    if (!span || span->y != y) return;
    const auto put = [&](std::vector<double>& errors, std::int32_t from, std::int32_t to, std::int32_t most) {
      if (from < 0 || from > to || to >= most || !std::isfinite(error_)) return;
      const std::size_t n = to - from;
      if (n >= errors.size()) errors.resize(n + 1);
      errors[n] = std::abs(error_);
    };
    const Raster& raster = trace_.scene().raster;
    const EdgeTableInsert* edge = span.is_of_other(at) ? nullptr : at.edge(span->left_edge);
    const std::size_t number = span->left_edge;
    const std::int64_t inserted = edge && number < inserted_.size() ? inserted_[number] : 0;
    if (x == span->first) {
      along_span_.clear();
      if (edge) put(along_edges_[inserted], edge->first_row, y, raster.height);
    }
    if (on_depth_ && edge)
      on_depth_({position, span_at(span) ? span_at(span)->began : 0, inserted, x, y, x - span->first,
                 y - edge->first_row, z, error_});
    put(along_span_, span->first, x, raster.width);
    if (along_span_.size() > found_.along_span.size()) found_.along_span = along_span_;
  }
  std::int32_t polygon_of(const Situation& at, const Situation::SpanOfPixel& span) const {
    if (span.is_of_other(at)) return span.open->polygon;
    if (at.method().polygon != no_polygon && !at.method().keeps_all) return at.method().polygon;
    const EdgeTableInsert* entry = span ? at.edge(span->left_edge) : nullptr;
    return entry ? entry->polygon : at.method().polygon;
  }

  bool is_fragment_at(std::int32_t x, std::int32_t y) const { return fragment_x_ == x && fragment_y_ == y; }
  /// Another pixel's turn has come. A program may print a scan line kind by kind: all interpolations, then all
  /// compares, then all writes.
  void leave_fragment() {
    const std::size_t pixel =
        static_cast<std::size_t>(fragment_y_) * trace_.scene().raster.width + static_cast<std::size_t>(fragment_x_);
    if (came_to_ == CameTo::depth && trace_.has(AtPixel::verdict)) waiting_[pixel].push_back(fragment_);
    if (came_to_ == CameTo::win && trace_.has(kind_of<DepthWrite>)) won_.insert_or_assign(pixel, fragment_);
  }
  /// Goes to what was interpolated for a compare: at its pixel, and of several that with its depth, else the first.
  template <class E>
  bool find_fragment(const E& e, std::size_t pixel) {
    const bool is_here = is_fragment_at(e.x, e.y), is_open = is_here && came_to_ == CameTo::depth;
    const auto waiting = waiting_.find(pixel);
    if (waiting == waiting_.end() || (is_open && fragment_.z == e.z)) return is_here;
    std::vector<Known>& all = waiting->second;
    auto taken = std::find_if(all.begin(), all.end(), [&](const Known& one) { return one.z == e.z; });
    if (taken == all.end()) {
      if (is_open) return true;
      taken = all.begin();
    }
    const Known next = std::move(*taken);
    all.erase(taken);
    if (all.empty()) waiting_.erase(waiting);
    leave_fragment();
    fragment_ = next, fragment_x_ = e.x, fragment_y_ = e.y;
    return true;
  }
  template <class E>
  void compare(std::int64_t position, const E& e, const Situation& at) {
    came_to_ = e.nearer ? CameTo::win : CameTo::end;
    if (!fragment_.exact) return;
    fragment_.z = e.z;
    const std::size_t pixel = at.pixel(e.x, e.y);
    Known stored = stored_[pixel];
    stored.z = at.stored(e.x, e.y);
    if (stored.exact && stored.polygon != fragment_.polygon) note_gap(stored, e.x);
    if (stored.exact) judge(position, e.x, e.y, e.nearer, fragment_, stored, open_);
    const std::span<Nearest> nearest = nearest_at(pixel);
    for (std::size_t i = 0; i < nearest.size(); ++i) nearest[i].meet(fragment_, e.x, open_[i]);
    if (e.nearer && at.method().compares_write) stored_[pixel] = fragment_;
  }
  void note_gap(const Known& stored, std::int32_t x) {
    const auto view = [&](const Known& of) {
      return view_depth(trace_.scene().camera, trace_.header().conventions, of.exact->at(x));
    };
    const double z = view(fragment_), other = view(stored), gap = std::abs(z - other);
    if (gap > 0 && (!found_.least_gap || gap < *found_.least_gap))
      found_.least_gap = gap, found_.gap_at = std::min(z, other);
  }

  void store(std::int64_t position, std::size_t pixel, std::int32_t x, std::int32_t y, double z) {
    const bool finite = std::isfinite(z);
    if (!finite && ++found_.stored_not_finite == 1) found_.stored_not_finite_step = position;
    const auto won = won_.find(pixel);
    const bool is_here = is_fragment_at(x, y);
    if (won != won_.end() && !(is_here && came_to_ == CameTo::win)) stored_[pixel] = won->second;
    else stored_[pixel] = is_here ? fragment_ : Known{};
    if (is_here) came_to_ = CameTo::end;
    const Known& stored = stored_[pixel];
    const std::span<Nearest> nearest = nearest_at(pixel);
    for (std::size_t i = 0; i < nearest.size(); ++i) {
      if (ray_nearest_.exactly.exact) nearest[i] = ray_nearest_;
      else if (!trace_.has(AtPixel::verdict))  // painted over each other; of equal depths the last is seen
        nearest[i].meet(stored, x, {open_[i].nearer, Comparison::Ties::last});
    }
    constexpr double none = std::numeric_limits<double>::quiet_NaN();
    constexpr double infinite = std::numeric_limits<double>::infinity();
    const double off = !stored.exact ? none : finite ? stored.exact->error_of(z, x) : infinite;
    found_.of_pixel[pixel] = finite ? off / formulas::last_digit(z, found_.format, found_.unit) : off;
    found_.depth_error_of_pixel[pixel] = off;
    found_.scene_facet_of_pixel[pixel] = stored.scene_facet;
  }

  const Trace& trace_;
  const std::function<void(const DepthError&)>& on_depth_;
  Truth truth_;
  Along along_;
  bool cuts_;  ///< vertices are not all as the trace has them on the raster
  ExactVertices vertices_;
  ExactRays rays_;
  std::vector<Comparison> open_;  ///< what the header leaves open
  RayBegin ray_{};                ///< the last one from the eye
  Known ray_kept_;                ///< what the run keeps
  Nearest ray_nearest_;
  Errors found_;
  std::map<std::int32_t, ErrorOf> polygons_;
  std::vector<bool> fighting_;
  std::vector<Known> stored_;     ///< by pixel: what the run keeps
  std::vector<Nearest> nearest_;  ///< by pixel, and of each by open_
  Known fragment_;                ///< the pixel at work
  std::int32_t fragment_x_ = -1, fragment_y_ = -1;
  enum class CameTo : std::uint8_t { depth, win, end };
  CameTo came_to_ = CameTo::end;  ///< what of it came last: its depth, a compare that is won, or nothing more is due
  /// By pixel, of the polygon at work: what was interpolated and is to be compared, and what won and is to be written.
  std::map<std::size_t, std::vector<Known>> waiting_;
  std::map<std::size_t, Known> won_;
  std::int32_t scene_facet_ = -1;  ///< of the pixel at work
  double error_ = 0;
  std::vector<Span> spans_;  ///< as Situation::ahead has them
  std::vector<double> along_span_;
  std::map<std::int64_t, std::vector<double>> along_edges_;         ///< by the step that put the edge into its table
  std::vector<std::int64_t> inserted_;                              ///< that step, by the edge's number
  std::map<std::int32_t, std::shared_ptr<const ExactDepth>> rows_;  ///< of the plane at work, where there are no spans
};

}  // namespace

double ErrorOf::root_mean_square() const {
  return depths == 0 ? 0 : std::sqrt(sum_of_squares / static_cast<double>(depths));
}

double ErrorOf::root_mean_square_view() const {
  return depths == 0 ? 0 : std::sqrt(sum_of_squares_view / static_cast<double>(depths));
}

Errors errors_of(const Trace& trace, const std::function<bool(std::int64_t)>& on_way, Truth truth,
                 const std::function<void(const DepthError&)>& on_depth) {
  constexpr std::int64_t now_and_then = 1 << 14;
  DepthJudge judge(trace, truth, on_depth);
  formulas::walk(
      trace,
      [&](std::int64_t position, const auto& e, const Situation& at) {
        judge.step(position, e, at);
        return !(on_way && position % now_and_then == 0 && on_way(position));
      },
      [](std::int64_t, const Impossible&) {});
  return judge.finish();
}

}  // namespace zstep::oracle
