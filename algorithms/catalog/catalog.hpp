// The one table of all methods.
#pragma once

#include <span>
#include <string_view>

#include "traces/record/recorder.hpp"
#include "traces/record/trace_recorder.hpp"
#include "traces/scene.hpp"

namespace zstep {

struct Method {
  std::string_view id;     ///< "z-buffer"
  std::string_view title;  ///< "Z-buffer"
  std::string_view paper;  ///< who, where, when
  Page (*page)();          ///< its pseudo-code
  Picture (*render)(const Scene&, const Conventions&, NullRecorder&);
  Picture (*count)(const Scene&, const Conventions&, CountRecorder&);
  Picture (*record)(const Scene&, const Conventions&, TraceRecorder&);
};

std::span<const Method> methods();
/// The method with this id; throws InputError listing the ids if there is none.
const Method& method(std::string_view id);

/// The header of a trace of this method under these conventions.
Header header_for(const Method& method, const Conventions& conventions);

}  // namespace zstep
