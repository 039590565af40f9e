// How degenerate input is drawn, and what is held against what.
#pragma once

#include <doctest/doctest.h>

#include <cmath>
#include <cstdlib>
#include <string>

#include "algorithms/catalog/catalog.hpp"
#include "algorithms/shadow_buffer/shadow_buffer.hpp"
#include "algorithms/transparency/transparency.hpp"
#include "tests/laws/degenerate_scenes.hpp"
#include "traces/file/trace.hpp"
#include "traces/record/trace_recorder.hpp"
#include "traces/replay/replay.hpp"

namespace zstep::test {

inline constexpr auto parallel = Camera::Kind::orthographic, perspective = Camera::Kind::perspective;

/// At the eye of a scene in perspective, with the same pixels: what it does not reach is not seen.
inline const Light at_the_eye{{0, -1000, 0}, {0, 0, 0}, 0.0065, 900, 1100};

/// Rays go through all layers, and the shadow buffer's bias is small against the distance of 1000.
inline Conventions conventions_for(const Method& m) {
  Conventions conventions;
  conventions.cull = false;
  if (m.id == "ray-tracing") conventions.options["depth"] = "8";
  if (m.id == "shadow-buffer") conventions.options["bias"] = "1";
  return conventions;
}

inline Picture drawn(const Method& m, Scene scene) {
  if (m.needs == Needs::light && !scene.light) scene.light = at_the_eye;
  const Conventions conventions = conventions_for(m);
  check_run(m, scene, conventions);
  NullRecorder nothing;
  return m.render(scene, conventions, nothing);
}

inline Color color_of_letter(const Scene& scene, char letter) {
  return letter == '.' ? scene.background : scene.polygons[static_cast<std::size_t>(letter - 'A')].color;
}

inline char letter_of_color(const Scene& scene, Color color) {
  for (std::size_t i = 0; i < scene.polygons.size(); ++i)
    if (scene.polygons[i].color == color) return static_cast<char>('A' + i);
  return color == scene.background ? '.' : '?';
}

inline Color shaded(Color color) {
  const auto part = [](std::uint8_t value) {
    return static_cast<std::uint8_t>(std::lround(value * shadow_buffer::in_shadow));
  };
  return {part(color.red), part(color.green), part(color.blue)};
}

/// To a step of each of the three: mixtures are rounded once or once a layer.
inline bool alike(Color a, Color b) {
  return std::abs(a.red - b.red) <= 1 && std::abs(a.green - b.green) <= 1 && std::abs(a.blue - b.blue) <= 1;
}

/// How many pixels have another colour than `expected(pixel)`.
template <class Expected>
int pixels_apart(const Picture& picture, const Scene& scene, Expected&& expected) {
  int apart = 0;
  for (std::size_t pixel = 0; pixel < picture.polygon.size(); ++pixel)
    apart += !alike(color_at(picture, scene, pixel), expected(pixel));
  return apart;
}

/// Where the second layer is seen, it is expected.
inline void allow_second(const Degenerate& input, const std::string& seen, std::string& expected) {
  const std::string second = letters_of(input.layers[1]);
  for (std::size_t pixel = 0; pixel < seen.size(); ++pixel)
    if (second[pixel] != '.' && seen[pixel] == second[pixel]) expected[pixel] = seen[pixel];
}

inline Scene glass(const Degenerate& input, Camera::Kind kind) {
  Scene scene = degenerate_scene(input.polygons, kind);
  for (Polygon& polygon : scene.polygons) polygon.material = Material{0.5};
  return scene;
}

/// All layers of glass are seen, in their order.
inline int wrong_glass(const char* id, const Degenerate& input, Camera::Kind kind) {
  const Scene scene = glass(input, kind);
  const Picture picture = drawn(method(id), scene);
  return pixels_apart(picture, scene, [&](std::size_t pixel) {
    Color mixed = scene.background;
    for (auto layer = input.layers.rbegin(); layer != input.layers.rend(); ++layer) {
      const char letter = letters_of(*layer)[pixel];
      if (letter != '.') mixed = transparency::blended(color_of_letter(scene, letter), 0.5, mixed);
    }
    return mixed;
  });
}

/// A light at the eye leaves nothing dark that the eye sees.
inline int wrongly_dark(const char* id, const Degenerate& input) {
  Scene scene = degenerate_scene(input.polygons, perspective);
  scene.light = at_the_eye;
  const Picture picture = drawn(method(id), scene);
  return pixels_apart(picture, scene,
                      [&](std::size_t pixel) { return color_of_letter(scene, letters_of(picture)[pixel]); });
}

/// Every recorder leaves the same picture, and the end of the trace holds it.
inline void check_recording(const Method& m, const Scene& scene) {
  const Conventions conventions = conventions_for(m);
  NullRecorder nothing;
  CountRecorder counts;
  TraceRecorder recorder(header_for(m, conventions), scene);
  const Picture plain = m.render(scene, conventions, nothing);
  CHECK(m.taught(scene, conventions, nothing) == plain);
  CHECK(m.count(scene, conventions, counts) == plain);
  CHECK(m.record(scene, conventions, recorder) == plain);
  recorder.finish();
  const Trace trace = Trace::from_bytes(recorder.take_bytes(), "degenerate");
  Replay replay(trace);
  replay.go_to(trace.size());
  Picture rebuilt = replay.state().picture, inked = plain;
  for (Picture* picture : {&rebuilt, &inked})
    if (picture->ink.empty()) picture->use_ink();  // no ink at all is ink on no pixel
  CHECK(rebuilt == inked);
}

}  // namespace zstep::test
