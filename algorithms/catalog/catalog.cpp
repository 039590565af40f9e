
#include "algorithms/catalog/catalog.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <fmt/format.h>
#include <optional>
#include <stdexcept>
#include <string>

#include "traces/error.hpp"
#include "algorithms/bsp/bsp.hpp"
#include "algorithms/depth_sort/depth_sort.hpp"
#include "algorithms/depth_sort/painter.hpp"
#include "algorithms/floating_horizon/floating_horizon.hpp"
#include "algorithms/half_space/half_space.hpp"
#include "algorithms/hidden_line/hidden_line.hpp"
#include "algorithms/hidden_line/wireframe.hpp"
#include "algorithms/interpolation/interpolation.hpp"
#include "algorithms/fast/half_space.hpp"
#include "algorithms/fast/ray_casting.hpp"
#include "algorithms/ray_casting/ray_casting.hpp"
#include "algorithms/ray_tracing/ray_tracing.hpp"
#include "algorithms/scan_line/scan_line.hpp"
#include "algorithms/shadow_buffer/shadow_buffer.hpp"
#include "algorithms/transparency/transparency.hpp"
#include "algorithms/viewing/clip.hpp"
#include "algorithms/viewing/vertices.hpp"
#include "algorithms/warnock/warnock.hpp"
#include "algorithms/fast/z_buffer.hpp"
#include "algorithms/z_buffer/z_buffer.hpp"

namespace zstep {

namespace {

const Option* find(std::span<const Option> table, std::string_view name) {
  for (const Option& option : table) {
    if (option.name == name) return &option;
  }
  return nullptr;
}

const Option& known(std::span<const Option> table, std::string_view name) {
  const Option* option = find(table, name);
  if (option == nullptr) throw std::logic_error(fmt::format("the method has no option {}", name));
  return *option;
}

std::string_view value_of(const Option& option, const Conventions& conventions) {
  const auto given = conventions.options.find(std::string(option.name));
  return given == conventions.options.end() ? option.standard : std::string_view(given->second);
}

std::optional<std::size_t> place_among(std::string_view words, std::string_view value) {
  for (std::size_t place = 0;; ++place) {
    const std::size_t bar = words.find('|');
    if (words.substr(0, bar) == value) return place;
    if (bar == words.npos) return std::nullopt;
    words.remove_prefix(bar + 1);
  }
}

std::optional<std::int64_t> number_in(const Option& option, std::string_view value) {
  std::int64_t number = 0;
  const auto [end, error] = std::from_chars(value.data(), value.data() + value.size(), number);
  if (error != std::errc{} || end != value.data() + value.size() || number < option.least || number > option.most)
    return std::nullopt;
  return number;
}

std::string values_text(const Option& option) {
  if (option.words.empty()) return fmt::format("a whole number from {} to {}", option.least, option.most);
  std::string text(option.words);
  for (std::size_t bar = text.find('|'); bar != text.npos; bar = text.find('|', bar)) text.replace(bar, 1, ", ");
  return "one of " + text;
}

}  // namespace

std::size_t choice(std::span<const Option> table, const Conventions& conventions, std::string_view name) {
  const Option& option = known(table, name);
  return place_among(option.words, value_of(option, conventions)).value();
}

std::int64_t whole_number(std::span<const Option> table, const Conventions& conventions, std::string_view name) {
  const Option& option = known(table, name);
  return number_in(option, value_of(option, conventions)).value();
}

void check_options(std::span<const Option> table, std::string_view method, const Conventions& conventions,
                   const std::string& who) {
  for (const auto& [name, value] : conventions.options) {
    const Option* option = find(table, name);
    if (option == nullptr) {
      std::string names;
      for (const Option& one : table) names += (names.empty() ? "" : ", ") + std::string(one.name);
      throw InputError(who, fmt::format("{} has no option '{}'", method, name),
                       names.empty() ? "it has none; leave it out" : "its options are: " + names);
    }
    const bool good =
        option->words.empty() ? number_in(*option, value).has_value() : place_among(option->words, value).has_value();
    if (!good)
      throw InputError(who, fmt::format("{} cannot be '{}'", name, value),
                       fmt::format("give {}", values_text(*option)));
  }
}

std::string options_for_planes(const Conventions& conventions) {
  const Conventions standard;
  std::string options;
  const auto want = [&](bool other, const char* option) {
    if (other) options += (options.empty() ? "" : " ") + std::string(option);
  };
  want(conventions.depth != standard.depth, "--depth pseudodepth");
  want(conventions.interpolation != standard.interpolation, "--interpolation direct");
  want(conventions.coverage != standard.coverage, "--coverage top-left");
  want(conventions.number_format != standard.number_format, "--number-format float64");
  want(conventions.positions != standard.positions, "--positions exact");
  want(conventions.attribute != standard.attribute, "--attribute none");
  return options;
}

namespace {

// A method is a folder with a page of steps and a function `run`; here it gets its names and its paper.
// Where the picture alone can be had faster, METHOD_DRAWN_BY says how.
#define METHOD_DRAWN_BY(render_, module, ...)                                                  \
  Method {                                                                                     \
    __VA_ARGS__, .page = module::page, .taught = module::run<NullRecorder>, .render = render_, \
                 .count = module::run<CountRecorder>, .collect = module::run<CollectRecorder>, \
                 .record = module::run<TraceRecorder>                                          \
  }
#define METHOD(module, ...) METHOD_DRAWN_BY(module::run<NullRecorder>, module, __VA_ARGS__)

// The Z-buffer draws under any conventions: as it is taught, or in the laboratory.
namespace z_buffer_of_any_kind {
using z_buffer::page;
template <Recorder R>
Picture run(const Scene& scene, const Conventions& conventions, R& record) {
  return interpolation::run(scene, conventions, record);
}
}  // namespace z_buffer_of_any_kind

Picture draw_z_buffer(const Scene& scene, const Conventions& conventions, NullRecorder& nothing) {
  using enum Conventions::Coverage;
  const bool fast =
      interpolation::is_taught(conventions) && (conventions.coverage == top_left || conventions.coverage == inclusive);
  return fast ? z_buffer::run_fast(scene, conventions) : interpolation::run(scene, conventions, nothing);
}

Picture draw_half_space(const Scene& scene, const Conventions& conventions, NullRecorder& nothing) {
  Picture picture;
  return half_space::run_fast(scene, conventions, picture) ? picture : half_space::run(scene, conventions, nothing);
}

Picture draw_ray_casting(const Scene& scene, const Conventions& conventions, NullRecorder&) {
  return ray_casting::cast_fast(scene, conventions);
}

constexpr std::array catalog{
    METHOD_DRAWN_BY(
        draw_z_buffer, z_buffer_of_any_kind, .id = "z-buffer", .title = "Z-buffer",
        .paper = "E. Catmull, A Subdivision Algorithm for Computer Display of Curved Surfaces, PhD thesis, University "
                 "of Utah, 1974",
        .interpolates = true, .in_any_way = true, .options = interpolation::options,
        .page_for = interpolation::page_for),
    METHOD(scan_line, .id = "scan-line", .title = "Scan line",
           .paper = "W. J. Bouknight, A Procedure for Generation of Three-Dimensional Half-Toned Computer Graphics "
                    "Presentations, Communications of the ACM 13(9), 1970",
           .interpolates = true, .options = scan_line::options, .check = scan_line::check),
    METHOD(painter, .id = "painter", .title = "Painter's algorithm",
           .paper =
               "the first step, alone, of M. E. Newell, R. G. Newell, T. L. Sancha, A Solution to the Hidden Surface "
               "Problem, ACM National Conference, 1972",
           .exact = false),
    METHOD(depth_sort, .id = "depth-sort", .title = "Depth sort",
           .paper = "M. E. Newell, R. G. Newell, T. L. Sancha, A Solution to the Hidden Surface Problem, ACM National "
                    "Conference, 1972"),
    METHOD(bsp, .id = "bsp", .title = "BSP tree",
           .paper =
               "H. Fuchs, Z. M. Kedem and B. F. Naylor, On Visible Surface Generation by A Priori Tree Structures, "
               "SIGGRAPH 1980",
           .options = bsp::options),
    METHOD(warnock, .id = "warnock", .title = "Warnock",
           .paper = "J. E. Warnock, A Hidden Surface Algorithm for Computer Generated Halftone Pictures, TR 4-15, "
                    "University of Utah, 1969",
           .options = warnock::options),
    METHOD_DRAWN_BY(
        draw_ray_casting, ray_casting, .id = "ray-casting", .title = "Ray casting",
        .paper = "A. Appel, Some Techniques for Shading Machine Renderings of Solids, AFIPS Spring Joint Computer "
                 "Conference 32, 1968",
        .options = ray_casting::options),
    METHOD(
        ray_tracing, .id = "ray-tracing", .title = "Ray tracing",
        .paper = "T. Whitted, An Improved Illumination Model for Shaded Display, Communications of the ACM 23(6), 1980",
        .gives = Gives::colors, .options = ray_tracing::options),
    METHOD(floating_horizon, .id = "floating-horizon", .title = "Floating horizon",
           .paper =
               "T. J. Wright, A Two-Space Solution to the Hidden Line Problem for Plotting Functions of Two Variables, "
               "IEEE Transactions on Computers C-22(1), 1973",
           .gives = Gives::lines, .needs = Needs::surface, .exact = false, .culls = false,
           .options = floating_horizon::options),
    METHOD(
        wireframe, .id = "wireframe", .title = "Wireframe",
        .paper = "as every line drawing; J. D. Foley, A. van Dam, S. K. Feiner, J. F. Hughes, Computer Graphics, 1990",
        .gives = Gives::lines, .culls = false, .options = wireframe::options),
    METHOD(
        hidden_line, .id = "hidden-line", .title = "Hidden lines",
        .paper = "L. G. Roberts, Machine Perception of Three-Dimensional Solids, MIT Lincoln Laboratory TR 315, 1963",
        .gives = Gives::lines, .options = hidden_line::options),
    METHOD(shadow_buffer, .id = "shadow-buffer", .title = "Shadow buffer",
           .paper = "L. Williams, Casting Curved Shadows on Curved Surfaces, SIGGRAPH 1978", .gives = Gives::colors,
           .needs = Needs::light, .interpolates = true, .options = shadow_buffer::options),
    METHOD(transparency, .id = "transparency", .title = "Transparency",
           .paper = "T. Porter and T. Duff, Compositing Digital Images, SIGGRAPH 1984", .gives = Gives::mixtures,
           .options = transparency::options),
    METHOD_DRAWN_BY(draw_half_space, half_space, .id = "half-space", .title = "Half-space",
                    .paper = "J. Pineda, A Parallel Algorithm for Polygon Rasterization, SIGGRAPH 1988",
                    .interpolates = true, .in_any_way = true, .options = half_space::options,
                    .check = half_space::check, .page_for = half_space::page_for),
};

#undef METHOD
#undef METHOD_DRAWN_BY

}  // namespace

std::span<const Method> methods() { return catalog; }

const Method& method(std::string_view id) {
  std::string known;
  for (const Method& candidate : catalog) {
    if (candidate.id == id) return candidate;
    known += (known.empty() ? "" : ", ") + std::string(candidate.id);
  }
  throw InputError("--algorithm " + std::string(id), "there is no such method", "the methods are: " + known);
}

void check_run(const Method& method, const Scene& scene, const Conventions& conventions, const std::string& who) {
  const std::string id(method.id);
  // First what no option mends.
  const std::string name = scene.source.empty() || scene.source == "built-in" ? scene.name : scene.source;
  if (method.needs == Needs::surface && !scene.surface)
    throw InputError(name, id + " draws a surface y = f(x, z), and this scene has none",
                     "give a formula in its place: \"y = sin(x)*cos(z)\"");
  if (method.needs == Needs::light && !scene.light)
    throw InputError(name, id + " needs a light, and this scene has none", "add a [light] to the scene's file");
  check_options(method.options, method.id, conventions, who);
  if (method.check) method.check(conventions, who);
  if (method.id == "half-space") half_space::check(scene, conventions);
  const std::string wanted = method.interpolates ? "" : options_for_planes(conventions);
  if (!wanted.empty() && method.gives == Gives::lines)
    throw InputError("--algorithm " + id, "draws lines: nothing is interpolated, and no pixel is covered",
                     "give " + wanted);
  if (!wanted.empty())
    throw InputError("--algorithm " + id,
                     "works with planes: its depths are pseudodepths, directly computed at pixel centres",
                     "give " + wanted + ", or use z-buffer or scan-line");
  if (method.interpolates && !method.in_any_way && !interpolation::is_taught(conventions))
    throw InputError("--algorithm " + id, "interpolates z_v or pseudodepth, directly or by increments, in float64",
                     "leave out the other conventions, or use z-buffer");
  interpolation::check(scene, conventions);
}

bool can_draw(const Method& method, const Scene& scene, const Conventions& conventions) {
  try {
    check_run(method, scene, conventions);
    return true;
  } catch (const InputError&) {
    return false;
  }
}

bool can_cull(const Method& method, const Scene& scene) {
  return method.culls && scene.camera.kind != Camera::Kind::screen;
}

Conventions conventions_for(const Method& other, Conventions conventions) {
  conventions.options.clear();
  bool possible = other.in_any_way || (other.interpolates && interpolation::is_taught(conventions));
  if (possible && other.in_any_way && other.check) {
    try {
      other.check(conventions, "");
    } catch (const InputError&) {
      possible = false;
    }
  }
  if (possible) return conventions;
  Conventions plain;
  plain.cull = conventions.cull;
  return plain;
}

namespace {

/// The lines that speak of an eye, said of parallel lines of sight.
void say_in_parallel(Page& page) {
  for (StepInfo& line : page) {
    if (line.id == viewing::step::project.id) line.text = "project: x_p = x_v, y_p = y_v, and its depth";
    if (line.id == clipping::step::facing.id) line.text = "does P face the eye? sign of (line of sight)\u00b7n";
  }
}

}  // namespace

Header header_for(const Method& method, const Conventions& conventions, Camera::Kind camera) {
  Header header;
  header.writer = "zstep " ZSTEP_VERSION;
  header.algorithm = method.id;
  header.title = method.title;
  header.conventions = conventions;
  header.page = method.page_for ? method.page_for(conventions) : method.page();
  if (camera == Camera::Kind::orthographic) say_in_parallel(header.page);
  header.comparison = interpolation::comparison_of(conventions);
  return header;
}

}  // namespace zstep
