#include "sim/viewer/panes/chart_picture.hpp"

#include <cmath>

#include "sim/viewer/charts/sheet.hpp"
#include "sim/viewer/draw/canvas.hpp"
#include "traces/math/whole.hpp"

namespace zstep::viewer {
namespace {

/// Lines and marks go to a canvas; words are kept, for the window writes them itself.
class PanePaper : public Paper {
 public:
  PanePaper(ChartPicture& picture, const Fonts& fonts, const Theme& theme)
      : picture_(picture), fonts_(fonts), theme_(theme) {}

  const Theme& theme() const override { return theme_; }
  float text_height() const override { return fonts_.small->FontSize; }
  float text_width(const std::string& text, bool) const override {
    return fonts_.small->CalcTextSizeA(fonts_.small->FontSize, 1e9f, 0, fonts_.drawable(text).c_str()).x;
  }
  void text(float x, float y, const std::string& text, ImU32 color, Side side, bool) override {
    const float wide = side == Side::left ? 0 : text_width(text, false);
    const float left = side == Side::middle ? x - wide / 2 : x - wide;
    picture_.words.push_back({{std::round(left), std::round(y)}, color, text});
  }
  void line(ImVec2 from, ImVec2 to, ImU32 color, float thickness) override {
    picture_.canvas.line(from.x, from.y, to.x, to.y, thickness, to_pixel(color));
  }
  void rectangle(ImVec2 from, ImVec2 to, ImU32 color) override {
    picture_.canvas.rectangle(nearest_int(from.x), nearest_int(from.y), nearest_int(to.x), nearest_int(to.y),
                              to_pixel(color));
  }
  void mark(ImVec2 at, float radius, int shape, ImU32 color, bool filled) override {
    const double size = radius;
    picture_.canvas.mark(at.x, at.y, size, shape, to_pixel(color));
    if (!filled) picture_.canvas.mark(at.x, at.y, size * 0.6, shape, to_pixel(theme_.pane));
  }

 private:
  ChartPicture& picture_;
  const Fonts& fonts_;
  const Theme& theme_;
};

void paint(ChartPicture& picture, const LineChart& chart, const glm::dvec2& size, const Fonts& fonts,
           const Theme& theme, const float& thin) {
  picture.words.clear();
  picture.canvas.resize(static_cast<int>(size.x), static_cast<int>(size.y));
  picture.canvas.fill(to_pixel(theme.pane));
  PanePaper paper(picture, fonts, theme);
  draw_lines(paper, chart, {0, 0, static_cast<float>(size.x), static_cast<float>(size.y), 0, 0.6f * thin});
}

}  // namespace

void draw_line_chart(Ui& ui, const char* name, const LineChart& chart) {
  const ImVec2 room = ImGui::GetContentRegionAvail(), at = ImGui::GetCursorScreenPos();
  const glm::dvec2 size{std::floor(room.x), std::floor(room.y)};
  if (size.x < 12 * ui.em || size.y < 6 * ui.em)
    return say_empty(ui, "Too small to draw; drag a border or enlarge the window.");
  const Kept<ChartPicture>& kept =
      *keep<ChartPicture>(ui.charts, name, paint, chart, size, ui.fonts, ui.colors(), ui.thin);
  const Canvas& canvas = kept.made.canvas;
  ImGui::GetWindowDrawList()->AddImage(Renderer::image(canvas), at,
                                       {at.x + to_float(canvas.width()), at.y + to_float(canvas.height())});
  for (const ChartPicture::Word& word : kept.made.words)
    draw_label(ui, {at.x + word.at.x, at.y + word.at.y}, ui.fonts.small, word.color, word.text);
}

}  // namespace zstep::viewer
