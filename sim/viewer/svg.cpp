#include "sim/viewer/svg.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <span>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <imgui_internal.h>

#include "traces/image/png.hpp"
#include "sim/viewer/draw/canvas.hpp"
#include "sim/viewer/draw/renderer.hpp"
#include "sim/words/escaped.hpp"
#include "traces/math/whole.hpp"

namespace zstep::viewer {
namespace {

/// Of a font's line, in its em: Dear ImGui gives a font's size by the height of its line, SVG by its em.
constexpr float line_of_em = 1.164f, line_of_variables = 0.94f;

std::string fill_of(ImU32 color) {
  const std::uint32_t red = color >> IM_COL32_R_SHIFT & 255u, green = color >> IM_COL32_G_SHIFT & 255u,
                      blue = color >> IM_COL32_B_SHIFT & 255u, alpha = color >> IM_COL32_A_SHIFT & 255u;
  return fmt::format("fill=\"#{:02x}{:02x}{:02x}\"{}", red, green, blue,
                     alpha == 255 ? "" : fmt::format(" fill-opacity=\"{:.3g}\"", alpha / 255.0));
}

std::string base64(std::span<const std::uint8_t> bytes) {
  constexpr const char* signs = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    std::uint32_t three = 0;
    for (std::size_t k = 0; k < 3; ++k) three = three << 8 | (i + k < bytes.size() ? bytes[i + k] : 0u);
    for (std::size_t k = 0; k < 4; ++k) text += i + k <= bytes.size() ? signs[three >> (18 - 6 * k) & 63u] : '=';
  }
  return text;
}

std::string picture_of(const Canvas& canvas, ImVec2 at) {
  std::vector<std::uint8_t> rgb;
  for (int y = 0; y < canvas.height(); ++y)
    for (int x = 0; x < canvas.width(); ++x)
      for (const int shift : {16, 8, 0}) rgb.push_back(static_cast<std::uint8_t>(canvas.row(y)[x] >> shift & 255u));
  return fmt::format("<image x=\"{:g}\" y=\"{:g}\" width=\"{}\" height=\"{}\" href=\"data:image/png;base64,{}\"/>\n",
                     at.x, at.y, canvas.width(), canvas.height(),
                     base64(png_bytes(canvas.width(), canvas.height(), rgb)));
}

class Writer {
 public:
  explicit Writer(const Fonts& fonts) : fonts_(fonts) {
    const ImFontAtlas& atlas = *ImGui::GetIO().Fonts;
    wide_ = to_float(atlas.TexWidth), high_ = to_float(atlas.TexHeight);
    for (const ImFont* font : atlas.Fonts)
      for (const ImFontGlyph& glyph : font->Glyphs) letters_.try_emplace(in_atlas({glyph.U0, glyph.V0}), font, &glyph);
  }

  void list(const ImDrawList& list) {
    for (const ImDrawCmd& command : list.CmdBuffer)
      if (!command.UserCallback && command.ElemCount > 0) this->command(list, command);
  }
  std::string ended() {
    end_clip();
    return std::move(out_);
  }

 private:
  using InAtlas = std::pair<int, int>;
  InAtlas in_atlas(ImVec2 uv) const { return {nearest_int(uv.x * wide_), nearest_int(uv.y * high_)}; }

  void command(const ImDrawList& list, const ImDrawCmd& command) {
    begin_clip(command.ClipRect);
    const bool letters = command.GetTexID() == ImGui::GetIO().Fonts->TexID;
    const ImDrawIdx* index = list.IdxBuffer.Data + command.IdxOffset;
    const ImDrawVert* vertices = list.VtxBuffer.Data + command.VtxOffset;
    for (unsigned i = 0; i + 2 < command.ElemCount;) {
      // A fan of triangles is one polygon.
      std::vector<const ImDrawVert*> corners{vertices + index[i], vertices + index[i + 1], vertices + index[i + 2]};
      for (i += 3; i + 2 < command.ElemCount && vertices + index[i] == corners.front() &&
                   vertices + index[i + 1] == corners.back();
           i += 3)
        corners.push_back(vertices + index[i + 2]);
      if (!letters) flush(), out_ += picture_of(*(const Canvas*)command.GetTexID(), corners[0]->pos);
      else if (corners[0]->uv.x == corners[2]->uv.x) polygon(corners);
      else letter(*corners[0]);
    }
    flush();
  }

  void polygon(const std::vector<const ImDrawVert*>& corners) {
    flush();
    if ((corners[0]->col & IM_COL32_A_MASK) == 0) return;
    std::string points;
    for (const ImDrawVert* corner : corners)
      points += fmt::format("{}{:.6g} {:.6g}", points.empty() ? "M" : "L", corner->pos.x, corner->pos.y);
    out_ += fmt::format("<path d=\"{}Z\" {}/>\n", points, fill_of(corners[0]->col));
  }

  /// Continues the line of text, with the spaces in between, or begins a new line.
  void letter(const ImDrawVert& corner) {
    const auto found = letters_.find(in_atlas(corner.uv));
    if (found == letters_.end()) return;
    const auto [font, glyph] = found->second;
    const float x = corner.pos.x - glyph->X0, baseline = font->Ascent + font->ConfigData->GlyphOffset.y,
                y = corner.pos.y - glyph->Y0 + baseline;
    const float space = font->GetCharAdvance(' '), gap = (x - line_.end) / space;
    const bool goes_on = !line_.text.empty() && font == line_.font && corner.col == line_.color &&
                         std::abs(y - line_.y) < 0.6f && gap > -0.2f && gap < 2.2f &&
                         std::abs(gap - std::round(gap)) < 0.2f;
    if (!goes_on) flush(), line_ = {font, corner.col, x, y, x, ""};
    else line_.text.append(static_cast<std::size_t>(std::round(gap)), ' ');
    char utf8[5]{};
    ImTextCharToUtf8(utf8, glyph->Codepoint);
    line_.text += utf8, line_.end = x + glyph->AdvanceX, ++line_.letters;
  }

  void flush() {
    if (line_.text.empty()) return;
    const bool mono = line_.font == fonts_.mono || line_.font == fonts_.small,
               leans = line_.font == fonts_.variable && fonts_.variable != fonts_.text,
               thick = (line_.font == fonts_.bold || line_.font == fonts_.heading) && line_.font != fonts_.text;
    out_ += fmt::format(
        "<text x=\"{:.6g}\" y=\"{:.6g}\" font-family=\"{}\" font-size=\"{:.4g}\" {}{}{}>{}</text>\n", line_.x, line_.y,
        mono    ? "DejaVu Sans Mono, monospace"
        : leans ? "STIXGeneral, STIX Two Text, serif"
                : "Inter, DejaVu Sans, sans-serif",
        line_.font->FontSize / (leans ? line_of_variables : line_of_em), fill_of(line_.color),
        thick   ? " font-weight=\"600\""
        : leans ? " font-style=\"italic\""
                : "",
        line_.letters > 1 ? fmt::format(" textLength=\"{:.6g}\"", line_.end - line_.x) : "", markup(line_.text));
    line_ = {};
  }

  void begin_clip(const ImVec4& to) {
    if (clips_ > 0 && to.x == clip_.x && to.y == clip_.y && to.z == clip_.z && to.w == clip_.w) return;
    end_clip();
    clip_ = to;
    out_ += fmt::format(
        "<clipPath id=\"c{0}\"><path d=\"M{1:g} {2:g}H{3:g}V{4:g}H{1:g}Z\"/></clipPath>\n"
        "<g clip-path=\"url(#c{0})\">\n",
        ++clips_, to.x, to.y, to.z, to.w);
  }
  void end_clip() {
    if (clips_ > 0) out_ += "</g>\n";
  }

  struct Line {
    const ImFont* font = nullptr;
    ImU32 color = 0;
    float x = 0, y = 0, end = 0;
    std::string text{};
    int letters = 0;
  };
  const Fonts& fonts_;
  float wide_ = 0, high_ = 0;
  std::map<InAtlas, std::pair<const ImFont*, const ImFontGlyph*>> letters_;
  Line line_;
  ImVec4 clip_{0, 0, 0, 0};
  int clips_ = 0;
  std::string out_;
};

}  // namespace

std::string svg_of(const ImDrawData& data, const Fonts& fonts, const Motion::Place& part, ImU32 ground) {
  Writer writer(fonts);
  for (int n = 0; n < data.CmdListsCount; ++n) writer.list(*data.CmdLists[n]);
  return fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{2:g}\" height=\"{3:g}\" viewBox=\"{0:g} {1:g} {2:g} {3:g}\" "
      "xml:space=\"preserve\">\n<rect x=\"{0:g}\" y=\"{1:g}\" width=\"{2:g}\" height=\"{3:g}\" {4}/>\n{5}</svg>\n",
      part.at.x, part.at.y, part.size.x, part.size.y, fill_of(ground), writer.ended());
}

}  // namespace zstep::viewer
