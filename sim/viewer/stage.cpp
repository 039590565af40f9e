#include "sim/viewer/stage.hpp"

#include <utility>

#include <fmt/format.h>

#include "sim/viewer/words/numbers.hpp"
#include "traces/error.hpp"

namespace zstep::viewer {

Stage::Stage(const Trace& trace, const ViewerOptions& options, const Settings& settings, int width, int height, float dpi_scale)
    : first_(trace), options_(options), dpi_scale_(dpi_scale),
      app_(std::make_unique<App>(trace, options.lesson, settings, width, height, dpi_scale)) {
  app_->opened_by = options.opened_by;
}

std::int64_t last_write(const Trace& trace, Cell cell) {
  const auto writes = [&](const RecordedEvent& recorded) {
    const Event& event = recorded.event;
    const std::optional<Trace::Pixel> at = pixel_of(event);
    if (!at || at->x != cell.x || at->y != cell.y) return false;
    return std::holds_alternative<PixelWrite>(event) || std::holds_alternative<PixelPaint>(event) ||
           std::holds_alternative<ColorWrite>(event) || std::holds_alternative<ColorBlend>(event);
  };
  return trace.previous(trace.size() + 1, writes, Trace::Pixel{cell.x, cell.y}).value_or(trace.size());
}

void Stage::switch_method(int direction) {
  if (!options_.other_method) return app_->say("No other method can be run from here.");
  const std::optional<Cell> selected = app_->session().selected;
  std::optional<OtherRun> other;
  try {
    other = options_.other_method(trace(), direction);
  } catch (const InputError& error) {
    return app_->say(error.what());
  }
  if (!other) return app_->say("No other method can draw this scene.");
  const bool back = other->trace.header().algorithm == first_.header().algorithm;
  app_->settings().speed = app_->session().speed;
  const Settings settings = app_->settings();
  const int width = app_->renderer().width(), height = app_->renderer().height();
  app_.reset();  // it looks at the trace that goes
  other_ = std::move(other);
  if (back) other_.reset();
  app_ = std::make_unique<App>(trace(), back ? options_.lesson : nullptr, settings, width, height, dpi_scale_);
  if (back) app_->opened_by = options_.opened_by;

  Session& s = app_->session();
  s.select(selected);
  s.go_to(selected ? last_write(trace(), *selected) : s.size());
  std::string place = selected ? fmt::format(": pixel ({}, {})", selected->x, selected->y) : ": select a pixel to follow it from method to method";
  if (other_ && !other_->whole) place += fmt::format("; cut off after {} steps, so the picture is not done", grouped(trace().size()));
  app_->say(trace().header().title + place);
}

}  // namespace zstep::viewer
