// The Z-buffer with any way of interpolating: what is interpolated, how, in which numbers, and which pixels it covers
// (Conventions; docs/interpolation.md). Where z_buffer.cpp is the page as it is taught, this is the laboratory in which
// its choices are held against each other.
//
// Plane slopes: 004, "z at the next pixel is z - A/C". The bounds are running error bounds (numbers.hpp).
#pragma once

#include <array>
#include <string>
#include <vector>

#include "algorithms/catalog/catalog.hpp"
#include "algorithms/z_buffer/z_buffer.hpp"
#include "algorithms/scan_conversion/numbers.hpp"
#include "traces/formulas/attributes.hpp"
#include "traces/formulas/fill.hpp"
#include "traces/formulas/shading.hpp"
#include "traces/record/recorder.hpp"
#include "traces/scene.hpp"

// The steps of the Z-buffer that goes by planes: one more than the others.

#define ZSTEP_MODULE interpolation
#define ZSTEP_FIRST_STEP 72
#define ZSTEP_STEPS "algorithms/interpolation/steps.def"
#include "traces/record/declare_steps.hpp"

namespace zstep::interpolation {

/// Which of two depths wins a pixel; as the depth says, the first of equals, where nothing else is asked for.
inline constexpr Option nearer_option{"nearer", "by-depth|turned", "by-depth",
                                      "which depth wins a pixel: the nearer one, or turned round the farther one",
                                      false};
inline constexpr Option ties_option{"ties", "first|last", "first",
                                    "which of two equal depths stays: the one drawn first, or the one drawn last",
                                    false};
inline constexpr Option initial_depth_option{
    "initial-depth", "infinity|far", "infinity",
    "what the depth buffer is cleared to: behind all depths, or the farthest depth in view, which leaves out what lies "
    "on the far plane",
    false};
inline constexpr Option fill_option{formulas::fill_key, "even-odd|non-zero", "even-odd",
                                    "which parts of an outline that crosses itself are inside: those that it goes "
                                    "round an odd number of times, or at all",
                                    false};
inline constexpr Option shade_option{
    formulas::shade_key, "stripes|scalar|colors|gouraud|phong|checker|nearest|bilinear", "stripes",
    "what --attribute interpolates: x_w or another number as stripes, colours of the vertices, light at them "
    "(gouraud), "
    "their normals (phong), or texture coordinates, for a checker or the texels of an image",
    false};
inline constexpr std::array<Option, 5> options{nearer_option, ties_option, initial_depth_option, fill_option,
                                               shade_option};
Comparison comparison_of(const Conventions& conventions);
/// What the depth buffer is cleared to: an infinity, or of all depths that the scene can have the farthest.
double initial_depth(const Scene& scene, const Conventions& conventions);

/// Does the page as it is taught draw under these conventions?
bool is_taught(const Conventions& conventions);

/// Draws the scene's facets in their order; where the page as it is taught can, by that. The depths of the picture and
/// of the trace are the run's numbers, exactly.
template <Recorder R>
Picture run(const Scene& scene, const Conventions& conventions, R& record);

/// How far each depth of a run's picture can be from what exact arithmetic gives from the same vertices, by the same
/// formulas.
struct Bounds {
  Picture picture;               ///< that of run()
  std::vector<double> of_pixel;  ///< [height*width], Picture::at, in units of depth; 0 where nothing was drawn
  std::vector<double> of_any;    ///< the same of any depth that is computed there, whether it is nearer or not
  /// The attribute that shades each pixel, and how far it can be off; empty where none is interpolated.
  std::vector<double> attribute, of_attribute;
};
Bounds bounds_of(const Scene& scene, const Conventions& conventions);

/// The depth at column x between the two ends of a span.
template <class T>
T depth_on(const T& x_left, const T& z_left, const T& x_right, const T& z_right, std::int32_t x) {
  if (static_cast<double>(x_left) == static_cast<double>(x_right)) return z_left;
  return formulas::on_line(z_left, z_right, T(x), x_left, x_right);
}

/// The page of steps that a run under these conventions has.
Page page_for(const Conventions& conventions);
/// Another method's page in its place, which has the Z-buffer's steps: with those of an attribute, and the compare as
/// the conventions have it.
Page page_with(Page page, const Conventions& conventions);

/// What becomes of a polygon's colour where what is interpolated is `a`.
Color shaded(const Scene& scene, const formulas::Shading& shading, std::int32_t polygon,
             const std::array<double, 3>& a);

/// Throws InputError where these conventions do not go together, or not with the scene's camera.
void check(const Scene& scene, const Conventions& conventions);

}  // namespace zstep::interpolation
