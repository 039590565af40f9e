// The one table of all methods.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>

#include "traces/record/recorder.hpp"
#include "traces/record/trace_recorder.hpp"
#include "traces/scene.hpp"

namespace zstep {

// The options of a method: what of it can be switched. Given as text on the command line and in lessons, checked
// against the catalog, and written into the trace's conventions.

struct Option {
  std::string_view name;             ///< "root"
  std::string_view words;            ///< "first|fewest-splits|random"; empty for a whole number
  std::string_view standard;         ///< the value where none is given: "fewest-splits", "1"
  std::string_view meaning;          ///< one phrase for the command line's help
  bool same_picture = true;          ///< whatever its value, the picture stays the same
  std::int64_t least = 0, most = 0;  ///< of a whole number
};

/// The place of the option's value among its words, from 0. For an option that has words and is in the table.
std::size_t choice(std::span<const Option> table, const Conventions& conventions, std::string_view name);
/// The value of a whole number. For an option that has no words and is in the table.
std::int64_t whole_number(std::span<const Option> table, const Conventions& conventions, std::string_view name);

/// One of an enumeration whose values stand in the order of the option's words.
template <class Enumeration>
Enumeration choice_of(std::span<const Option> table, const Conventions& conventions, std::string_view name) {
  return static_cast<Enumeration>(choice(table, conventions, name));
}
/// Is an option with the words "off|on" on?
inline bool is_on(std::span<const Option> table, const Conventions& conventions, std::string_view name) {
  return choice(table, conventions, name) == 1;
}

/// Throws InputError where an option is not in the table or its value is none that it can have. `who` begins the line:
/// "--option", or a lesson's file and line.
void check_options(std::span<const Option> table, std::string_view method, const Conventions& conventions,
                   const std::string& who);

/// For methods that work with planes, whose depths are pseudodepths, directly computed at pixel centres: what must be
/// given on the command line in place of conventions that mean something else, "--coverage top-left"; empty if there
/// are none.
std::string options_for_planes(const Conventions& conventions);

/// What there is at a pixel when the method is done.
enum class Gives : std::uint8_t {
  surfaces,  ///< a polygon and its depth
  colors,    ///< a colour of its own (shadow, mirror image), and the polygon and depth that the eye sees first
  mixtures,  ///< the colour of several polygons, and the nearest that is opaque with its depth
  lines,     ///< lines; no polygon
};

/// What a scene must have for the method to run.
enum class Needs : std::uint8_t { polygons, surface, light };

struct Method {
  std::string_view id;     ///< "z-buffer"
  std::string_view title;  ///< "Z-buffer"
  std::string_view paper;  ///< who, where, when
  Gives gives = Gives::surfaces;
  Needs needs = Needs::polygons;
  /// At every pixel the nearest polygon is seen, but for ties and rounding. False for those known to fail.
  bool exact = true;
  /// It interpolates along edges and spans, so that --depth view, --interpolation increments and --coverage inclusive
  /// mean something. The others work with planes, which only pseudodepth leaves plane.
  bool interpolates = false;
  /// And it interpolates in any way that Conventions have, as far as `check` lets it: what, how, in which numbers.
  bool in_any_way = false;
  /// It drops back faces where the conventions say so. False where it has none, or an option of its own decides.
  bool culls = true;
  std::span<const Option> options = {};
  /// Throws InputError where conventions and options, each possible by itself, do not go together.
  void (*check)(const Conventions&, const std::string& who) = nullptr;
  /// Its pseudo-code under any conventions, where it has other lines under some.
  Page (*page_for)(const Conventions&) = nullptr;
  Page (*page)() = nullptr;  ///< its pseudo-code
  /// The page's own loops without a recording, which is what comparisons measure.
  Picture (*taught)(const Scene&, const Conventions&, NullRecorder&) = nullptr;
  /// The same picture, as fast as it can be had: to the bit, but for ray casting, where a centre within 1e-9 px of an
  /// edge may fall to either side.
  Picture (*render)(const Scene&, const Conventions&, NullRecorder&) = nullptr;
  Picture (*count)(const Scene&, const Conventions&, CountRecorder&) = nullptr;
  Picture (*collect)(const Scene&, const Conventions&, CollectRecorder&) = nullptr;
  Picture (*record)(const Scene&, const Conventions&, TraceRecorder&) = nullptr;
};

std::span<const Method> methods();
/// The method with this id; throws InputError listing the ids if there is none.
const Method& method(std::string_view id);

/// Throws InputError where the method cannot draw this scene under these conventions: an unknown option, a convention
/// that it does not have, a light or a surface that is missing. To be called before a run. `who`: what its options were
/// given by.
void check_run(const Method& method, const Scene& scene, const Conventions& conventions,
               const std::string& who = "--option");

/// Whether it can.
bool can_draw(const Method& method, const Scene& scene, const Conventions& conventions);

/// Whether --no-cull, or cull, means something for it: there is an eye, and the method asks which side it sees.
bool can_cull(const Method& method, const Scene& scene);

/// What stays of a run's conventions for another method: its options are not the other's.
Conventions conventions_for(const Method& other, Conventions conventions);

/// The header of a trace of this method under these conventions; its pseudo-code is that of such a camera.
Header header_for(const Method& method, const Conventions& conventions,
                  Camera::Kind camera = Camera::Kind::perspective);

}  // namespace zstep
