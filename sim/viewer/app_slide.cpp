// What a reader takes along for slides: the window, or what leads with a caption, of pixels and as SVG.

#include <cmath>
#include <fmt/format.h>
#include <utility>

#include "sim/viewer/app.hpp"
#include "sim/viewer/draw/canvas.hpp"
#include "sim/viewer/pictures.hpp"
#include "sim/viewer/svg.hpp"
#include "traces/error.hpp"
#include "traces/scene.hpp"

namespace zstep::viewer {

void App::point_nowhere() {
  ImGui::SetCurrentContext(context_.context);
#if IMGUI_VERSION_NUM >= 18700
  ImGui::GetIO().AddMousePosEvent(-1e6f, -1e6f);
#else
  ImGui::GetIO().MousePos = {-1e6f, -1e6f};
#endif
}

Drawing App::drawn(const Motion::Place& part) {
  point_nowhere();
  settle();
  Drawing drawing;
  drawing.width = static_cast<int>(part.size.x), drawing.height = static_cast<int>(part.size.y);
  const std::vector<std::uint8_t> all = renderer_.rgb();
  for (int y = 0; y < drawing.height; ++y) {
    const std::size_t from = pixel_at(static_cast<int>(part.at.x), static_cast<int>(part.at.y) + y, renderer_.width());
    const auto row = all.begin() + static_cast<std::ptrdiff_t>(from * 3);
    drawing.rgb.insert(drawing.rgb.end(), row, row + std::ptrdiff_t{drawing.width} * 3);
  }
  drawing.svg = svg_of(*ImGui::GetDrawData(), ui_.fonts, part, ui_.colors().window);
  return drawing;
}

Drawing App::of_window() { return drawn({{0, 0}, {to_float(renderer_.width()), to_float(renderer_.height())}}); }

std::string App::caption_title() const {
  const Lesson* lesson = session_.lesson();
  if (lesson && session_.stop() >= 0) return lesson->title + " \u00b7 " + lesson->stops[session_.stop()].heading;
  const Header& header = session_.header();
  return (header.title.empty() ? header.algorithm : header.title) + " \u00b7 " + session_.scene().name;
}

std::string App::caption_sentence() const {
  const Pictures::Caption caption = caption_of(session_);
  return caption.place + ": " + caption.sentence;
}

Drawing App::slide() {
  if (stage_at_.size.x < 8 || stage_at_.size.y < 8 || overlay_ == Overlay::start || race_shown_)
    throw InputError("a slide", "no picture leads here", "save a picture of the window (Ctrl+S)");
  const float pad = std::round(ui_.em * 0.5f);
  const Overlay over = std::exchange(overlay_, Overlay::none);
  slide_ = {{0, 0},
            {std::floor(stage_at_.size.x + 2 * pad),
             std::floor(std::min(stage_at_.size.y + 4 * ui_.line() + 3 * pad, to_float(renderer_.height())))}};
  const Drawing drawing = drawn(*slide_);
  slide_.reset(), overlay_ = over;
  settle();
  return drawing;
}

/// What leads has the room that its caption leaves.
void App::draw_slide() {
  const float pad = std::round(ui_.em * 0.5f), width = slide_->size.x - 2 * pad;
  const std::string title = caption_title(), sentence = caption_sentence();
  const Flow bold{.font = ui_.fonts.bold, .width = width}, plain{.width = width};
  const float words = flow_height(ui_, title, bold) + flow_height(ui_, sentence, plain);
  const float height = slide_->size.y - words - 3 * pad;
  draw_leading(std::vector<Pane>(leading_), {pad, pad}, {width, height});
  ImGui::SetCursorScreenPos({pad, height + 2 * pad});
  flow(ui_, title, bold);
  ImGui::SetCursorScreenPos({pad, ImGui::GetCursorScreenPos().y});
  flow(ui_, sentence, plain);
}

}  // namespace zstep::viewer
