#include "traces/codec/runs.hpp"

namespace zstep::codec {

namespace {

/// The step of this kind, if there is one alone.
std::uint8_t only_step(const Page& page, std::uint8_t kind) {
  std::uint8_t found = unknown_step;
  for (const StepInfo& step : page) {
    if (step.kind != kind) continue;
    if (found != unknown_step) return unknown_step;
    found = step.id;
  }
  return found;
}

}  // namespace

RowSteps::RowSteps(const Page& page)
    : line(only_step(page, kind_of<ScanLineBegin>)),
      edge(only_step(page, kind_of<EdgeStep>)),
      span(only_step(page, kind_of<SpanBegin>)) {}

}  // namespace zstep::codec
