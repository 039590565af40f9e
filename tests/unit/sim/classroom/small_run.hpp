// A run small enough to count by hand: two polygons on four pixels of one row.
//
//     1 clear · 2 polygon A · 3–6 pixel 0: 5 < ∞, written · 7–10 pixel 1: 5 < ∞, written
//     11 polygon B · 12–13 pixel 1: 5 against 5, a tie · 14–17 pixel 2: 7 < ∞, written · 18–19 pixel 0: 6 against 5,
//     loses
#pragma once

#include <string>

#include <doctest/doctest.h>

#include "algorithms/z_buffer/z_buffer.hpp"
#include "traces/error.hpp"
#include "traces/record/trace_recorder.hpp"
#include "traces/replay/replay.hpp"

namespace zstep::classroom {

inline Trace small_run() {
  Scene scene;
  scene.name = "small";
  scene.points = {{0, 0, 5}, {1, 0, 5}, {2, 0, 7}};
  scene.polygons = {{"A", {}, 0}, {"B", {}, 0}};
  scene.facets = {{0, 0, 3}, {1, 3, 3}};
  scene.corners = {0, 1, 2, 2, 1, 0};
  scene.camera.kind = Camera::Kind::screen;
  scene.raster = {4, 1, false};
  Header header;
  header.algorithm = "z-buffer";
  header.page = z_buffer::page();

  TraceRecorder record(header, scene);
  namespace step = z_buffer::step;
  const auto fragment = [&](std::int32_t x, double z, bool nearer, std::int32_t polygon) {
    record(step::interpolate_z, DepthInterpolate{x, 0, z});
    record(step::compare, DepthCompare{x, 0, z, nearer});
    if (!nearer) return;
    record(step::write_depth, DepthWrite{x, 0, z});
    record(step::write_pixel, PixelWrite{x, 0, polygon});
  };
  record(step::clear, BuffersClear{no_depth});
  record(step::polygon, PolygonBegin{0, 0});
  fragment(0, 5, true, 0);
  fragment(1, 5, true, 0);
  record(step::polygon, PolygonBegin{1, 1});
  fragment(1, 5, false, 1);
  fragment(2, 7, true, 1);
  fragment(0, 6, false, 1);
  record.finish();
  return Trace::from_bytes(record.take_bytes(), "small run");
}

/// The one line that an InputError says; empty when nothing is thrown.
template <class Function>
std::string complaint(Function&& function) {
  try {
    function();
  } catch (const InputError& error) {
    return error.what();
  }
  return {};
}

inline bool contains(const std::string& text, std::string_view part) { return text.find(part) != std::string::npos; }

}  // namespace zstep::classroom
