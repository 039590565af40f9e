// Traces of real runs for the viewer's tests.
#pragma once

#include <string>

#include "algorithms/catalog/catalog.hpp"
#include "algorithms/scene/load.hpp"
#include "traces/file/trace.hpp"
#include "traces/record/trace_recorder.hpp"

namespace zstep::test {

inline Trace record_run(const std::string& scene_name, const ViewOptions& view = {},
                        Conventions::Interpolation interpolation = Conventions::Interpolation::direct) {
  SceneFile file = load_scene(scene_name);
  const Scene scene = look_at_scene(file.scene, view);
  file.conventions.interpolation = interpolation;
  const Method& z_buffer = method("z-buffer");
  TraceRecorder record(header_for(z_buffer, file.conventions), scene);
  z_buffer.record(scene, file.conventions, record);
  record.finish();
  return Trace::from_bytes(record.take_bytes(), scene_name);
}

/// The same by any method, with its standard conventions.
inline Trace record_run_by(const std::string& method_id, const std::string& scene_name, const ViewOptions& view = {}) {
  const SceneFile file = load_scene(scene_name);
  const Scene scene = look_at_scene(file.scene, view);
  const Method& by = method(method_id);
  const Conventions conventions;
  TraceRecorder record(header_for(by, conventions), scene);
  by.record(scene, conventions, record);
  record.finish();
  return Trace::from_bytes(record.take_bytes(), scene_name);
}

inline ViewOptions of_size(std::int32_t width, std::int32_t height) {
  ViewOptions view;
  view.width = width;
  view.height = height;
  return view;
}

}  // namespace zstep::test
