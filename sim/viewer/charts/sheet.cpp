#include "sim/viewer/charts/sheet.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

#include "sim/viewer/draw/canvas.hpp"
#include "sim/words/escaped.hpp"
#include "traces/math/portable_math.hpp"
#include "traces/math/whole.hpp"

namespace zstep::viewer {

void Paper::dashed_line(ImVec2 from, ImVec2 to, ImU32 color, float thickness) {
  const float dx = to.x - from.x, dy = to.y - from.y, length = portable::length(dx, dy);
  constexpr float dash = 10, gap = 8;
  for (float at = 0; at < length; at += dash + gap) {
    const float begin = at / length, end = std::min(at + dash, length) / length;
    line({from.x + begin * dx, from.y + begin * dy}, {from.x + end * dx, from.y + end * dy}, color, thickness);
  }
}

void Paper::rule(ImVec2 from, ImVec2 to, ImU32 color) {
  const bool across = std::abs(to.x - from.x) > std::abs(to.y - from.y);
  const ImVec2 end = across ? ImVec2(to.x, from.y + 1) : ImVec2(from.x + 1, to.y);
  rectangle(from, end, color);
}

namespace {

std::string hex(ImU32 color) {
  return fmt::format("#{:02x}{:02x}{:02x}", color >> IM_COL32_R_SHIFT & 255, color >> IM_COL32_G_SHIFT & 255,
                     color >> IM_COL32_B_SHIFT & 255);
}

/// Disc, square, triangle or diamond, as large as Canvas::mark draws them.
std::string shape_of(ImVec2 at, float radius, int shape, ImU32 color) {
  const auto corners = [&](std::initializer_list<ImVec2> of_radius) {
    std::string points;
    for (const ImVec2& one : of_radius)
      points += fmt::format("{:g},{:g} ", at.x + radius * one.x, at.y + radius * one.y);
    return fmt::format("<polygon points=\"{}\" fill=\"{}\"/>\n", points, hex(color));
  };
  switch (shape % 4) {
    case 0:
      return fmt::format("<circle cx=\"{:g}\" cy=\"{:g}\" r=\"{:g}\" fill=\"{}\"/>\n", at.x, at.y, radius, hex(color));
    case 1:
      return corners({{-0.9f, -0.9f}, {0.9f, -0.9f}, {0.9f, 0.9f}, {-0.9f, 0.9f}});
    case 2:
      return corners({{0, -1.35f}, {1.05f, 0.75f}, {-1.05f, 0.75f}});
    default:
      return corners({{0, -1.35f}, {1.35f, 0}, {0, 1.35f}, {-1.35f, 0}});
  }
}

}  // namespace

Sheet::Sheet(int width, int height, float text_pixels)
    : before_(ImGui::GetCurrentContext()), context_(ImGui::CreateContext()), renderer_(width, height) {
  ImGui::SetCurrentContext(context_);
  ImGuiIO& io = ImGui::GetIO();
  io.IniFilename = nullptr;
  io.LogFilename = nullptr;
  io.BackendFlags |= ImGuiBackendFlags_RendererHasVtxOffset;
  io.DisplaySize = ImVec2(to_float(width), to_float(height));
  io.DeltaTime = 1.0f / 60;
  fonts_.load(text_pixels);
  renderer_.take_fonts();
  canvas_.resize(width, height);
  canvas_.fill(to_pixel(theme().pane));
  ImGui::NewFrame();
  ImGui::GetBackgroundDrawList()->AddImage(Renderer::image(canvas_), ImVec2(0, 0), io.DisplaySize);
}

Sheet::~Sheet() {
  ImGui::DestroyContext(context_);
  ImGui::SetCurrentContext(before_);
}

float Sheet::text_width(const std::string& text, bool bold) const {
  const ImFont* font = bold ? fonts_.bold : fonts_.text;
  return font->CalcTextSizeA(font->FontSize, 1e9f, 0, fonts_.drawable(text).c_str()).x;
}

void Sheet::text(float x, float y, const std::string& text, ImU32 color, Side side, bool bold) {
  const ImFont* font = bold ? fonts_.bold : fonts_.text;
  const float wide = side == Side::left ? 0 : text_width(text, bold);
  const float left = side == Side::middle ? x - wide / 2 : x - wide;
  ImGui::GetBackgroundDrawList()->AddText(font, font->FontSize, ImVec2(std::round(left), std::round(y)), color,
                                          fonts_.drawable(text).c_str());
  constexpr ByEnum<Side, const char*, 3> anchors{"start", "middle", "end"};
  svg_ += fmt::format("<text x=\"{:g}\" y=\"{:g}\" fill=\"{}\" text-anchor=\"{}\"{}>{}</text>\n", x, y + font->Ascent,
                      hex(color), anchors[side], bold ? " font-weight=\"bold\"" : "", markup(text));
}

void Sheet::line(ImVec2 from, ImVec2 to, ImU32 color, float thickness) {
  canvas_.line(from.x, from.y, to.x, to.y, thickness, to_pixel(color));
  svg_ += fmt::format("<line x1=\"{:g}\" y1=\"{:g}\" x2=\"{:g}\" y2=\"{:g}\" stroke=\"{}\" stroke-width=\"{:g}\"/>\n",
                      from.x, from.y, to.x, to.y, hex(color), thickness);
}

void Sheet::rectangle(ImVec2 from, ImVec2 to, ImU32 color) {
  canvas_.rectangle(nearest_int(from.x), nearest_int(from.y), nearest_int(to.x), nearest_int(to.y), to_pixel(color));
  svg_ += fmt::format("<rect x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\" fill=\"{}\"/>\n", nearest_int(from.x),
                      nearest_int(from.y), nearest_int(to.x) - nearest_int(from.x),
                      nearest_int(to.y) - nearest_int(from.y), hex(color));
}

void Sheet::image(int x, int y, const Image& image) {
  for (int row = 0; row < image.height && y + row < canvas_.height(); ++row)
    for (int column = 0; column < image.width && x + column < canvas_.width(); ++column) {
      const std::size_t at = pixel_at(column, row, image.width) * 3;
      canvas_.row(y + row)[x + column] = opaque({image.rgb[at], image.rgb[at + 1], image.rgb[at + 2]});
    }
}

void Sheet::mark(ImVec2 at, float radius, int shape, ImU32 color, bool filled) {
  constexpr double rim = 2.5;
  svg_ += shape_of(at, radius, shape, color);
  if (!filled) svg_ += shape_of(at, radius - static_cast<float>(rim), shape, theme().pane);
  const double x = at.x, y = at.y, size = radius;
  canvas_.mark(x, y, size, shape, to_pixel(color));
  if (!filled) canvas_.mark(x, y, size - rim, shape, to_pixel(theme().pane));
}

void Sheet::cross(ImVec2 at, float radius, ImU32 color) {
  line({at.x - radius, at.y - radius}, {at.x + radius, at.y + radius}, color, 3.5f);
  line({at.x - radius, at.y + radius}, {at.x + radius, at.y - radius}, color, 3.5f);
}

Image Sheet::picture() {
  ImGui::Render();
  renderer_.draw(*ImGui::GetDrawData(), to_pixel(theme().pane));
  return {renderer_.width(), renderer_.height(), renderer_.rgb()};
}

std::string Sheet::svg() const {
  return fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" version=\"1.1\" width=\"{0}\" height=\"{1}\" viewBox=\"0 0 {0} {1}\" "
      "font-family=\"DejaVu Sans, sans-serif\" font-size=\"{2:g}\" stroke=\"none\" xml:space=\"preserve\">\n"
      "<rect width=\"{0}\" height=\"{1}\" fill=\"{3}\"/>\n{4}</svg>\n",
      renderer_.width(), renderer_.height(), fonts_.text->FontSize, hex(theme().pane), svg_);
}

LogAxis::LogAxis(double least, double most, float from, float to)
    : first_(floor_int(portable::log10(least) + 1e-9)),
      last_(std::max(first_ + 1, ceil_int(portable::log10(most) - 1e-9))),
      from_(from),
      to_(to) {}

float LogAxis::at(double value) const {
  const double share = (portable::log10(value) - first_) / (last_ - first_);
  return from_ + static_cast<float>(share) * (to_ - from_);
}

std::string decade_text(int n) {
  if (n >= 0 && n <= 2) return fmt::format("{:.0f}", portable::pow(10.0, n));
  if (n < 0 && n >= -3) return fmt::format("{:.{}f}", portable::pow(10.0, n), -n);
  if (n >= 3 && n <= 5) return fmt::format("{:.0f} 000", portable::pow(10.0, n - 3));
  static const char* const digits[] = {"\u2070", "\u00b9", "\u00b2", "\u00b3", "\u2074",
                                       "\u2075", "\u2076", "\u2077", "\u2078", "\u2079"};
  std::string text = n < 0 ? "10\u207b" : "10";
  for (const char c : std::to_string(std::abs(n))) text += digits[c - '0'];
  return text;
}

}  // namespace zstep::viewer
