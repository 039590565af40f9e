// What a trace says about itself, besides its scene and its events.
#pragma once

#include <cstdint>
#include <string>

#include "traces/record/step.hpp"
#include "traces/scene.hpp"

namespace zstep {

struct Header {
  std::string writer;     ///< who wrote it: "zstep 0.1.0", or a student's program
  std::string algorithm;  ///< the method's id: "z-buffer"
  std::string title;      ///< the method's title: "Z-buffer"
  Conventions conventions;
  Page page;  ///< the step table, in the order in which the pseudo-code is read
  bool operator==(const Header&) const = default;
};

/// The step with this id, or nullptr.
const StepInfo* find_step(const Page& page, std::uint8_t id);
/// The step with this name ("compare", or "z_buffer.compare" where two modules share a name), or nullptr.
const StepInfo* find_step(const Page& page, std::string_view name);

}  // namespace zstep
