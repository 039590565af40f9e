#include "algorithms/interpolation/interpolation.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <string>
#include <string_view>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "algorithms/scan_conversion/spans.hpp"
#include "algorithms/viewing/clip.hpp"
#include "algorithms/z_buffer/z_buffer.hpp"
#include "traces/error.hpp"
#include "traces/formulas/attributes.hpp"
#include "traces/formulas/outlines.hpp"
#include "traces/formulas/rounding.hpp"
#include "traces/math/whole.hpp"
#include "traces/record/all_recorders.hpp"

namespace zstep::interpolation {

namespace {

using scan_conversion::ActiveEdges;
using scan_conversion::EdgeOf;
using scan_conversion::EdgeTableOf;
using scan_conversion::NumbersOf;
using scan_conversion::Span;

/// What is to be known of the conventions at each pixel.
struct Ways {
  bool adds, by_plane, corrected, shades;
  Comparison comparison;

  explicit Ways(const Conventions& c)
      : adds(adds_slopes(c)),
        by_plane(c.interpolation == Conventions::Interpolation::plane ||
                 c.interpolation == Conventions::Interpolation::plane_increments),
        corrected(c.depth == Conventions::Depth::corrected),
        shades(c.attribute != Conventions::Attribute::none),
        comparison(comparison_of(c)) {}
};

/// The plane of a polygon, as the depth of one of its vertices and two slopes.
template <class T>
struct Plane {
  T x_0{0}, y_0{0}, z_0{0}, dz_dx{0}, dz_dy{0};
  T at(std::int32_t x, std::int32_t y) const { return formulas::along_plane(z_0, dz_dx, T(x), x_0, dz_dy, T(y), y_0); }
};

/// The attribute of the polygons' vertices, along edges, along spans, at a pixel.
template <class T>
class Attributes {
 public:
  using OverDepth = formulas::OverDepth<T>;

  Attributes(const Scene& scene, const Conventions& conventions, const viewing::Vertices& vertices,
             const NumbersOf<T>& numbers)
      : scene_(scene),
        divides_(formulas::attribute_over_depth(scene, conventions)),
        shading_(formulas::shading_of(scene, conventions)),
        vertices_(vertices),
        numbers_(numbers) {}

  const formulas::Shading& shading() const { return shading_; }
  void begin_facet(std::int32_t facet) { facet_ = facet; }
  void begin(const EdgeOf<T>& left, const EdgeOf<T>& right, std::int32_t y) {
    for (std::int32_t k = 0; k < shading_.components(); ++k)
      left_[k] = on_edge(left, k, y), right_[k] = on_edge(right, k, y);
    x_left_ = left.x, x_right_ = right.x;
  }
  OverDepth at(std::int32_t component, std::int32_t x) const {
    if (static_cast<double>(x_left_) == static_cast<double>(x_right_)) return left_[component];
    return formulas::on_line(left_[component], right_[component], T(x), x_left_, x_right_);
  }
  T value(const OverDepth& here) const { return divides_ ? here.over_z / here.one_over_z : here.over_z; }

 private:
  OverDepth of_vertex(std::int32_t number, std::int32_t component) const {
    const glm::dvec3& view = vertices_[number].view;
    const T a = numbers_.depth(formulas::attribute_of(scene_, shading_, component, facet_, number, view,
                                                      [&](std::int32_t point) { return vertices_[point].view; }));
    return divides_ ? formulas::over_depth(a, numbers_.depth(view.z)) : OverDepth{a, T(1)};
  }
  OverDepth on_edge(const EdgeOf<T>& edge, std::int32_t component, std::int32_t y) const {
    return formulas::on_line(of_vertex(edge.vertex_0, component), of_vertex(edge.vertex_1, component), T(y), edge.y_0,
                             edge.y_1);
  }

  const Scene& scene_;
  bool divides_;
  formulas::Shading shading_;
  const viewing::Vertices& vertices_;
  const NumbersOf<T>& numbers_;
  std::int32_t facet_ = 0;
  std::array<OverDepth, 3> left_{}, right_{};
  T x_left_{0}, x_right_{0};
};

/// Two vertices that make with the first one the largest triangle on the raster: what the slopes are divided by.
std::array<std::int32_t, 2> far_from_first(const clipping::Outline& outline, const viewing::Vertices& vertices) {
  const auto at = [&](std::size_t i) { return vertices[outline[i]].raster; };
  std::array<std::int32_t, 2> best{outline[0], outline[0]};
  double largest = -1;
  for (std::size_t i = 1; i + 1 < outline.size(); ++i) {
    const glm::dvec3 p = at(i) - at(0), q = at(i + 1) - at(0);
    const double area = std::abs(p.x * q.y - p.y * q.x);
    if (area > largest) largest = area, best = {outline[i], outline[i + 1]};
  }
  return best;
}

template <class T, Recorder R>
Plane<T> find_plane(std::int32_t polygon, const clipping::Outline& outline, const viewing::Vertices& vertices,
                    const NumbersOf<T>& numbers, R& record) {
  const auto [second, third] = far_from_first(outline, vertices);
  const auto raster = [&](std::int32_t vertex) { return vertices[vertex].raster; };
  const glm::dvec3 p = raster(outline[0]), q = raster(second), r = raster(third);
  Plane<T> plane{numbers.position(p.x), numbers.position(p.y), numbers.depth(p.z), T(0), T(0)};
  const T x_1 = numbers.position(q.x) - plane.x_0, y_1 = numbers.position(q.y) - plane.y_0,
          z_1 = numbers.depth(q.z) - plane.z_0;
  const T x_2 = numbers.position(r.x) - plane.x_0, y_2 = numbers.position(r.y) - plane.y_0,
          z_2 = numbers.depth(r.z) - plane.z_0;
  // Vertices in a line on the raster, as an edge-on polygon has them, span no plane there: its depth is its vertex's.
  const bool seen = static_cast<double>(x_1 * y_2 - x_2 * y_1) != 0;
  if (seen) plane.dz_dx = formulas::plane_slope(y_1, z_1, y_2, z_2, x_1, x_2);
  if (seen) plane.dz_dy = formulas::plane_slope(x_1, z_1, x_2, z_2, y_1, y_2);
  record(step::slopes, PlaneSlopes{polygon, outline[0], second, third, plane.dz_dx, plane.dz_dy});
  return plane;
}

/// Draws one polygon's spans. Calls each.computed(pixel, z) for each depth, each.depth(pixel, z) for each that is
/// written, each.attribute(pixel, a) for each attribute.
template <class T, Recorder R, class Each>
class Drawing {
 public:
  Drawing(const Ways& ways, const NumbersOf<T>& numbers, const Scene& scene, Attributes<T>& attributes,
          Picture& picture, R& record, Each& each)
      : ways_(ways),
        numbers_(numbers),
        scene_(scene),
        attributes_(attributes),
        picture_(picture),
        record_(record),
        each_(each) {}

  void begin(std::int32_t polygon, const Plane<T>& plane) { polygon_ = polygon, plane_ = plane, started_ = false; }

  void fill(const Span& span, const EdgeOf<T>& left, const EdgeOf<T>& right) {
    if (ways_.shades) attributes_.begin(left, right, span.y);
    T along{0};  // what is interpolated
    const T slope = ways_.by_plane                   ? plane_.dz_dx
                    : !ways_.adds || span.dz_dx == 0 ? T(0)
                                                     : formulas::slope(left.z, right.z, left.x, right.x);
    for (std::int32_t x = span.first; x <= span.last; ++x) {
      if (ways_.adds && x != span.first) along = along + slope;  // 000, "Speeding up the Algorithm"
      else if (ways_.by_plane) along = ways_.adds ? line_start(x, span.y) : plane_.at(x, span.y);
      else along = depth_on(left.x, left.z, right.x, right.z, x);
      draw(x, span.y, ways_.corrected ? numbers_.reciprocal(along) : along);
    }
  }

 private:
  /// The plane's depth where a span begins: from line to line the slope along y is added, and from where the line
  /// before began the slope along x times so many pixels.
  T line_start(std::int32_t x, std::int32_t y) {
    if (!started_) started_ = true, x_ = x, y_ = y, along_ = plane_.at(x, y);
    for (; y_ < y; ++y_) along_ = along_ + plane_.dz_dy;
    along_ = along_ + plane_.dz_dx * T(x - x_);
    x_ = x;
    return along_;
  }

  void draw(std::int32_t x, std::int32_t y, const T& depth) {
    const double z = depth;
    record_(z_buffer::step::interpolate_z, {x, y, z});

    const std::size_t pixel = picture_.at(x, y);
    each_.computed(pixel, depth);
    const bool nearer = ways_.comparison.wins(z, picture_.depth[pixel]);
    record_(z_buffer::step::compare, {x, y, z, nearer});
    if (!nearer) return;

    picture_.depth[pixel] = z;
    record_(z_buffer::step::write_depth, {x, y, z});

    picture_.polygon[pixel] = polygon_;
    record_(z_buffer::step::write_pixel, {x, y, polygon_});
    each_.depth(pixel, depth);
    if (ways_.shades) shade(x, y, pixel);
  }

  /// Blinn's hyperbolic interpolation, or linear for comparison: which of the two, `attributes_` knows.
  void shade(std::int32_t x, std::int32_t y, std::size_t pixel) {
    const formulas::Shading& shading = attributes_.shading();
    std::array<double, 3> values{};
    for (std::int32_t k = 0; k < shading.components(); ++k) {
      const formulas::OverDepth<T> here = attributes_.at(k, x);
      const T a = attributes_.value(here);
      record_(step::attribute, AttributeInterpolate{x, y, here.over_z, here.one_over_z, a});
      values[k] = a;
      each_.attribute(pixel, a);
    }

    const Color ink = shaded(scene_, shading, polygon_, values);
    picture_.ink[pixel] = ink_of(ink);
    record_(step::shade, ColorWrite{x, y, ink.red, ink.green, ink.blue});
  }

  const Ways& ways_;
  const NumbersOf<T>& numbers_;
  const Scene& scene_;
  Attributes<T>& attributes_;
  Picture& picture_;
  R& record_;
  Each& each_;
  std::int32_t polygon_ = no_polygon;
  Plane<T> plane_;
  bool started_ = false;
  std::int32_t x_ = 0, y_ = 0;
  T along_{0};
};

template <class T, Recorder R, class Each>
Picture draw(const Scene& scene, const Conventions& conventions, const NumbersOf<T>& numbers, R& record, Each&& each) {
  const Raster& raster = scene.raster;
  const Ways ways(conventions);

  Picture picture(raster.width, raster.height);
  const bool non_zero = formulas::fills_non_zero(conventions);
  const double initial = initial_depth(scene, conventions);
  for (double& depth : picture.depth) depth = initial;
  if (ways.shades) picture.use_ink();
  record(z_buffer::step::clear, BuffersClear{initial});

  viewing::Lens lens(scene.camera, raster, conventions.depth);
  lens.positions = conventions.positions;
  viewing::Vertices vertices = viewing::view_vertices(scene, lens, record);

  clipping::Outline outline;
  EdgeTableOf<T> edges;
  edges.numbers = numbers;
  ActiveEdges active;
  Attributes<T> attributes(scene, conventions, vertices, numbers);
  Drawing<T, R, std::remove_reference_t<Each>> drawing(ways, numbers, scene, attributes, picture, record, each);
  std::int32_t number = 0;
  for (const Facet& facet : scene.facets) {
    record(z_buffer::step::polygon, PolygonBegin{facet.polygon, number});
    ++number;

    vertices.resize(scene.points.size());  // without those that clipping made for the facet before
    if (!clipping::find_outline(scene, facet, conventions.cull, lens, vertices, outline, record)) continue;

    Plane<T> plane;
    if (ways.by_plane) plane = find_plane(facet.polygon, outline, vertices, numbers, record);
    drawing.begin(facet.polygon, plane);
    attributes.begin_facet(number - 1);
    build_edge_table(edges, facet.polygon, outline, vertices, raster, conventions.coverage, record);
    for (std::int32_t y = edges.first_row; y < edges.end_row; ++y) {
      begin_scan_line(active, edges, y, !ways.adds, record);

      const auto way = [&](std::size_t i) { return edges.edges[active.edges[i]].way; };
      formulas::each_span_inside(active.edges.size(), non_zero, way, [&](std::size_t i, std::size_t j) {
        const std::int32_t left = active.edges[i], right = active.edges[j];
        const Span span = begin_span(edges, left, right, y, raster, conventions.coverage, record);
        drawing.fill(span, edges.edges[left], edges.edges[right]);
      });
    }
    end_polygon(active, record);
  }
  return picture;
}

/// Keeps nothing of what is drawn besides the picture.
struct Forget {
  template <class T>
  void computed(std::size_t, const T&) const {}
  template <class T>
  void depth(std::size_t, const T&) const {}
  template <class T>
  void attribute(std::size_t, const T&) const {}
};

/// Keeps how far each number can be off.
struct Keep {
  Bounds& bounds;
  template <class T>
  void computed(std::size_t pixel, const Bounded<T>& z) const {
    bounds.of_any[pixel] = std::max(bounds.of_any[pixel], z.error);
  }
  template <class T>
  void depth(std::size_t pixel, const Bounded<T>& z) const {
    bounds.of_pixel[pixel] = z.error;
  }
  template <class T>
  void attribute(std::size_t pixel, const Bounded<T>& a) const {
    bounds.of_attribute[pixel] = a.error, bounds.attribute[pixel] = a;
  }
};

/// Calls use(numbers) with what makes the run's numbers.
template <class Use>
auto in_numbers(const Scene& scene, const Conventions& conventions, Use&& use) {
  if (conventions.number_format == NumberFormat::float64) return use(NumbersOf<double>{});
  if (conventions.number_format == NumberFormat::float32) return use(NumbersOf<float>{});
  Conventions interpolated = conventions;  // of `corrected`: 1/z_v
  if (conventions.depth == Conventions::Depth::corrected) interpolated.depth = Conventions::Depth::reciprocal;
  const auto fixed = [&]<class T>(T) {
    return NumbersOf<T>{depth_unit(scene, interpolated), depth_unit(scene, conventions),
                        formulas::least_depth(scene, interpolated.depth),
                        formulas::least_depth(scene, conventions.depth)};
  };
  if (conventions.rounding == Conventions::Rounding::nearest) return use(fixed(FixedNearest{}));
  return use(fixed(FixedDown{}));
}

bool is_given(const Conventions& conventions, const Option& option, std::string_view value) {
  const auto given = conventions.options.find(std::string(option.name));
  return given != conventions.options.end() && given->second == value;
}

}  // namespace

Comparison comparison_of(const Conventions& conventions) {
  Comparison comparison;
  if (greater_is_nearer(conventions.depth) != is_given(conventions, nearer_option, "turned"))
    comparison.nearer = Comparison::Nearer::greater;
  if (is_given(conventions, ties_option, "last")) comparison.ties = Comparison::Ties::last;
  return comparison;
}

double initial_depth(const Scene& scene, const Conventions& conventions) {
  const Comparison comparison = comparison_of(conventions);
  if (!is_given(conventions, initial_depth_option, "far")) return comparison.farthest();
  const auto [least, greatest] = ends_of_depths(scene, conventions.depth);
  return comparison.nearer == Comparison::Nearer::smaller ? greatest : least;
}

bool is_taught(const Conventions& c) {
  using enum Conventions::Depth;
  using enum Conventions::Interpolation;
  return (c.depth == pseudodepth || c.depth == view) && (c.interpolation == direct || c.interpolation == increments) &&
         c.number_format == NumberFormat::float64 && c.positions == Conventions::Positions::exact &&
         c.attribute == Conventions::Attribute::none && comparison_of(c) == Comparison{} &&
         !is_given(c, initial_depth_option, "far") && !formulas::fills_non_zero(c);
}

template <Recorder R>
Picture run(const Scene& scene, const Conventions& conventions, R& record) {
  if (is_taught(conventions)) return z_buffer::run(scene, conventions, record);
  return in_numbers(scene, conventions, [&]<class T>(const NumbersOf<T>& numbers) {
    return draw<T>(scene, conventions, numbers, record, Forget{});
  });
}

Bounds bounds_of(const Scene& scene, const Conventions& conventions) {
  return in_numbers(scene, conventions, [&]<class T>(const NumbersOf<T>& numbers) {
    Bounds bounds;
    bounds.of_pixel.assign(Picture(scene.raster.width, scene.raster.height).depth.size(), 0);
    bounds.of_any = bounds.of_pixel;
    if (conventions.attribute != Conventions::Attribute::none) bounds.of_attribute = bounds.attribute = bounds.of_pixel;
    NullRecorder nothing;
    bounds.picture = draw<Bounded<T>>(scene, conventions, NumbersOf<Bounded<T>>{numbers}, nothing, Keep{bounds});
    return bounds;
  });
}

Color shaded(const Scene& scene, const formulas::Shading& shading, std::int32_t polygon,
             const std::array<double, 3>& a) {
  const auto [red, green, blue] = formulas::shaded(scene, shading, polygon, a);
  return {nearest_byte(red), nearest_byte(green), nearest_byte(blue)};
}

Page page_for(const Conventions& conventions) {
  return page_with(Ways(conventions).by_plane ? interpolation::page() : z_buffer::page(), conventions);
}

namespace {

constexpr ByEnum<formulas::Shade, const char*> shade_texts{
    "frame[x,y] = colour of P, darker in every other stripe of a",
    "frame[x,y] = colour of P, darker in every other stripe of a",
    "frame[x,y] = (red, green, blue)",
    "frame[x,y] = diffuse * colour of P + highlight",
    "frame[x,y] = colour of P in the light on n",
    "frame[x,y] = colour of P, darker in every other square",
    "frame[x,y] = the texel at u, v",
    "frame[x,y] = the four texels round u, v, mixed"};

std::string attribute_text(formulas::Shade shade, Conventions::Attribute attribute) {
  const formulas::Ingredients& of = formulas::ingredients[shade];
  const std::span names(of.names.data(), static_cast<std::size_t>(of.count));
  const std::string all = fmt::format("{}", fmt::join(names, ", "));
  if (attribute == Conventions::Attribute::linear) return all + ", interpolated as z is";
  return of.count == 1 ? "a = (a/z_v)/(1/z_v), each interpolated as z is"
                       : fmt::format("a = (a/z_v)/(1/z_v) for a = {}, each interpolated as z is", all);
}

}  // namespace

Page page_with(Page page, const Conventions& conventions) {
  const Ways ways(conventions);
  const auto shades = [](const StepInfo& line) { return line.id == step::attribute.id || line.id == step::shade.id; };
  std::erase_if(page, shades);
  if (ways.shades)
    for (const StepInfo& line : interpolation::page())
      if (shades(line)) page.push_back(line);
  const formulas::Shade shade = formulas::shade_of(conventions);
  for (StepInfo& line : page) {
    if (line.id == step::attribute.id) line.text = attribute_text(shade, conventions.attribute);
    if (line.id == step::shade.id) line.text = shade_texts[shade];
    if (line.id == z_buffer::step::clear.id && ways.comparison.nearer == Comparison::Nearer::greater)
      line.text = "frame[x,y] = background, zbuffer[x,y] = \u2212\u221e for all x, y";
    if (line.id == z_buffer::step::clear.id && is_given(conventions, initial_depth_option, "far"))
      line.text = "frame[x,y] = background, zbuffer[x,y] = the farthest depth in view for all x, y";
    if (line.id == scan_conversion::step::span.id && formulas::fills_non_zero(conventions))
      line.text = "for each pair (left, right) of active edges between which the winding number is not 0";
    if (line.id == z_buffer::step::compare.id && ways.comparison != Comparison{})
      line.text = fmt::format("if z {} zbuffer[x,y]", ways.comparison.sign());
  }
  return page;
}

void check(const Scene& scene, const Conventions& c) {
  using enum Conventions::Depth;
  const Camera::Kind kind = scene.camera.kind;
  const std::string depth = "--depth " + std::string(word_of(c.depth));
  if (scene.raster.corners && c.number_format != NumberFormat::float64)
    throw InputError(
        "--number-format " + std::string(word_of(c.number_format)),
        "is not run where pixels are seen at their corners: a vertex on a border would round to either side",
        "give --seen-at centres, or --number-format float64");
  if ((c.depth == corrected || c.depth == reciprocal) && kind == Camera::Kind::orthographic)
    throw InputError(depth, "divides by z_v, which parallel projection does not do", "leave out --ortho");
  if (c.depth != pseudodepth && kind == Camera::Kind::screen)
    throw InputError(depth, "needs a camera, and this scene's points are on the screen already",
                     "take a scene with a camera; 'zstep list scenes' says which have one");
  if (c.positions != Conventions::Positions::exact && kind == Camera::Kind::screen)
    throw InputError("--positions " + std::string(word_of(c.positions)),
                     "needs a camera, and this scene's points are on the screen already",
                     "take a scene with a camera; 'zstep list scenes' says which have one");
  if (c.attribute == Conventions::Attribute::perspective && kind != Camera::Kind::perspective)
    throw InputError("--attribute perspective",
                     kind == Camera::Kind::screen ? "divides by z_v, and this scene's points are on the screen already"
                                                  : "divides by z_v, which parallel projection does not do",
                     "give --attribute linear");
  if (c.attribute != Conventions::Attribute::none && bits_of(c.number_format) > 0)
    throw InputError("--attribute " + std::string(word_of(c.attribute)),
                     "is computed in floating point, and fixed-point numbers are of depths and positions",
                     "give --number-format float64 or float32");
  const formulas::Shading shading = formulas::shading_of(scene, c);
  const std::string shade = fmt::format("--option shade={}", word_of(shading.shade));
  if (shading.shade != formulas::Shade::stripes && c.attribute == Conventions::Attribute::none)
    throw InputError(shade, "is of an attribute, and none is interpolated", "give --attribute perspective, or linear");
  if (!shading.is_known())
    throw InputError(
        shade,
        fmt::format("needs {} at the vertices, and this scene has none", formulas::ingredients[shading.shade].called),
        "take a mesh with such, or give --option shade=stripes");
  if (c.rounding == Conventions::Rounding::down && bits_of(c.number_format) == 0)
    throw InputError("--rounding down", "is of fixed-point numbers", "give --number-format fixed16, or fixed32");
}

#define INSTANTIATE(R) template Picture run<R>(const Scene&, const Conventions&, R&);
ZSTEP_FOR_EACH_RECORDER(INSTANTIATE)
#undef INSTANTIATE

}  // namespace zstep::interpolation
