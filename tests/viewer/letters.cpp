#include "tests/viewer/letters.hpp"

#include <algorithm>
#include <array>
#include <map>
#include <set>
#include <tuple>

#include <fmt/format.h>

#include "tests/viewer/drive.hpp"
#include "tests/viewer/tones.hpp"

namespace zstep::test {
namespace {

using viewer::App;
using viewer::Fonts;

struct Glyph {
  const ImFont* font;
  const ImFontGlyph* shape;
};

/// By their first corner in the atlas.
std::map<std::pair<float, float>, Glyph> glyphs() {
  std::map<std::pair<float, float>, Glyph> found;
  for (const ImFont* font : ImGui::GetIO().Fonts->Fonts)
    for (const ImFontGlyph& glyph : font->Glyphs) found[{glyph.U0, glyph.V0}] = {font, &glyph};
  return found;
}

struct Box {
  float left, top, right, bottom;
};
Box common(const Box& a, const Box& b) {
  return {std::max(a.left, b.left), std::max(a.top, b.top), std::min(a.right, b.right), std::min(a.bottom, b.bottom)};
}
float area(const Box& b) { return b.right > b.left && b.bottom > b.top ? (b.right - b.left) * (b.bottom - b.top) : 0; }
Box box(const Letter& l) { return {l.first.x, l.first.y, l.last.x, l.last.y}; }
Box seen(const Letter& l) { return common(box(l), {l.clip.x, l.clip.y, l.clip.z, l.clip.w}); }

void append(std::string& text, unsigned code) {
  if (code < 0x80) text += static_cast<char>(code);
  else if (code < 0x800) text += {static_cast<char>(0xc0 | code >> 6), static_cast<char>(0x80 | (code & 0x3f))};
  else
    text += {static_cast<char>(0xe0 | code >> 12), static_cast<char>(0x80 | (code >> 6 & 0x3f)),
             static_cast<char>(0x80 | (code & 0x3f))};
}

/// Goes through the rectangles of a frame in the order in which they are drawn.
template <class Use>
void each_rectangle(const ImDrawData& data, Use&& use) {
  for (int n = 0; n < data.CmdListsCount; ++n) {
    ImDrawList& list = *data.CmdLists[n];
    for (const ImDrawCmd& command : list.CmdBuffer) {
      const ImDrawIdx* index = list.IdxBuffer.Data + command.IdxOffset;
      ImDrawVert* vertices = list.VtxBuffer.Data + command.VtxOffset;
      for (unsigned i = 0; i + 5 < command.ElemCount;) {
        const ImDrawIdx* t = index + i;
        ImDrawVert &a = vertices[t[0]], &c = vertices[t[2]];
        const ImDrawVert &b = vertices[t[1]], &d = vertices[t[5]];
        const bool rectangle = t[3] == t[0] && t[4] == t[2] && a.pos.y == b.pos.y && b.pos.x == c.pos.x &&
                               c.pos.y == d.pos.y && d.pos.x == a.pos.x;
        if (rectangle) use(command, std::array<ImDrawVert*, 4>{&a, &vertices[t[1]], &c, &vertices[t[5]]});
        i += rectangle ? 6 : 3;
      }
    }
  }
}

bool is_letter(const ImDrawCmd& command, const std::array<ImDrawVert*, 4>& corners) {
  return command.GetTexID() == ImGui::GetIO().Fonts->TexID && corners[0]->uv.x != corners[2]->uv.x;
}

}  // namespace

Letters letters_of(const Fonts& fonts) {
  const auto known = glyphs();
  Letters out;
  float line = 0, end = 0;  // of the letter before: where it stands, and where the next one would follow it
  each_rectangle(*ImGui::GetDrawData(), [&](const ImDrawCmd& command, const std::array<ImDrawVert*, 4>& corners) {
    const ImDrawVert &a = *corners[0], &c = *corners[2];
    const ImVec4 clip = command.ClipRect;
    if (!is_letter(command, corners)) {
      const bool opaque = command.GetTexID() != ImGui::GetIO().Fonts->TexID || a.col >> 24 == 255;
      const Box shape = common({a.pos.x, a.pos.y, c.pos.x, c.pos.y}, {clip.x, clip.y, clip.z, clip.w});
      if (!opaque || area(shape) == 0) return;
      std::erase_if(out.all, [&](Letter& letter) {
        const Box ink = seen(letter);
        if (area(common(ink, shape)) == 0) return false;
        const bool whole_width = shape.left <= ink.left + 1 && shape.right >= ink.right - 1;
        const bool from_top = whole_width && shape.top <= ink.top + 1,
                   to_bottom = whole_width && shape.bottom >= ink.bottom - 1;
        if (from_top) letter.clip.y = std::max(letter.clip.y, shape.bottom);
        if (to_bottom) letter.clip.w = std::min(letter.clip.w, shape.top);
        if (!from_top && !to_bottom && area(common(ink, shape)) > 0.25f * area(ink)) {
          out.covered.push_back(out.words[letter.word]);
          letter.half_covered = true;
        }
        return area(seen(letter)) == 0;
      });
      return;
    }
    const auto glyph = known.find({a.uv.x, a.uv.y});
    if (glyph == known.end()) return;
    const ImFont& font = *glyph->second.font;
    const ImFontGlyph& shape = *glyph->second.shape;
    const float scale = (c.pos.y - a.pos.y) / (shape.Y1 - shape.Y0);
    Letter letter{a.pos, c.pos, clip, a.col, a.uv, font.FontSize * scale, &font == fonts.bold || &font == fonts.heading,
                  0};
    const float on_line = a.pos.y - shape.Y0 * scale;
    const float begin = a.pos.x - shape.X0 * scale;
    const bool goes_on = !out.all.empty() && out.all.back().color == letter.color && std::abs(on_line - line) < 1.5f &&
                         a.pos.x >= out.all.back().first.x && begin - end < 0.85f * letter.size;
    if (!goes_on) out.words.emplace_back();
    else if (begin - end > letter.size / 8) out.words.back() += ' ';
    line = on_line, end = begin + shape.AdvanceX * scale;
    append(out.words.back(), shape.Codepoint);
    letter.word = out.words.size() - 1;
    for (auto before = out.all.rbegin(); before != out.all.rend() && before - out.all.rbegin() < 400; ++before)
      if (before->glyph.x == letter.glyph.x && before->glyph.y == letter.glyph.y && before->color != letter.color &&
          std::abs(before->first.x - a.pos.x) < 7 && std::abs(before->first.y - a.pos.y) < 7)
        before->rim = true;
    if (area(seen(letter)) > 0) out.all.push_back(letter);
  });
  return out;
}

std::optional<ImVec2> corner_of(ImTextureID image) {
  const ImDrawData& data = *ImGui::GetDrawData();
  for (int n = 0; n < data.CmdListsCount; ++n)
    for (const ImDrawCmd& command : data.CmdLists[n]->CmdBuffer)
      if (command.GetTexID() == image && command.ElemCount >= 3)
        return data.CmdLists[n]->VtxBuffer[data.CmdLists[n]->IdxBuffer[static_cast<int>(command.IdxOffset)]].pos;
  return std::nullopt;
}

std::vector<std::string> cut_at_the_side(const Letters& drawn) {
  std::vector<std::string> found;
  for (const Letter& l : drawn.all)
    if (l.first.x < l.clip.x - 1 || l.last.x > l.clip.z + 1)
      found.push_back(fmt::format("\"{}\" is cut at x = {}", drawn.words[l.word], l.first.x));
  return found;
}

std::vector<std::string> over_each_other(const Letters& drawn) {
  std::vector<std::string> found;
  std::vector<const Letter*> by_top;
  for (const Letter& l : drawn.all) by_top.push_back(&l);
  std::sort(by_top.begin(), by_top.end(), [](const Letter* a, const Letter* b) { return a->first.y < b->first.y; });
  for (std::size_t i = 0; i < by_top.size(); ++i)
    for (std::size_t k = i + 1; k < by_top.size() && by_top[k]->first.y < by_top[i]->last.y; ++k) {
      const Letter &a = *by_top[i], &b = *by_top[k];
      if (a.word == b.word || a.rim || b.rim) continue;
      const Box both = common(seen(a), seen(b));
      if (both.right - both.left < 2 || both.bottom - both.top < 2) continue;
      if (area(both) < 0.15f * std::min(area(box(a)), area(box(b)))) continue;
      found.push_back(
          fmt::format("\"{}\" and \"{}\" at ({}, {})", drawn.words[a.word], drawn.words[b.word], both.left, both.top));
    }
  return found;
}

std::vector<std::string> smaller_than(const Letters& drawn, float pixels) {
  std::vector<std::string> found;
  for (const Letter& l : drawn.all)
    if (l.size < pixels - 0.01f) found.push_back(fmt::format("\"{}\" has {} pixels", drawn.words[l.word], l.size));
  return found;
}

std::vector<std::string> faint(App& app, const Letters& drawn) {
  const ImDrawData& data = *ImGui::GetDrawData();
  std::set<std::tuple<float, float, float, float, ImU32>> rims;
  const auto key = [](ImVec2 at, ImVec2 glyph, ImU32 color) { return std::tuple(at.x, at.y, glyph.x, glyph.y, color); };
  for (const Letter& l : drawn.all)
    if (l.rim) rims.insert(key(l.first, l.glyph, l.color));
  each_rectangle(data, [&](const ImDrawCmd& command, const std::array<ImDrawVert*, 4>& corners) {
    if (!is_letter(command, corners) || rims.count(key(corners[0]->pos, corners[0]->uv, corners[0]->col)) != 0) return;
    for (ImDrawVert* corner : corners) corner->col &= 0x00ffffffu;
  });
  app.renderer().draw(data, viewer::to_pixel(app.ui().colors().window));
  const viewer::Canvas& behind = app.renderer().picture();
  std::vector<std::string> found;
  std::vector<double> ratios;
  std::map<std::pair<viewer::Pixel32, viewer::Pixel32>, double> known;
  for (const Letter& l : drawn.all) {
    const Box b = seen(l);
    if (l.rim || l.half_covered || area(b) < 0.5f * area(box(l))) continue;  // the edge of a pane that scrolls
    ratios.clear();
    const unsigned alpha = l.color >> 24;
    const viewer::Pixel32 ink = viewer::to_pixel(l.color);
    for (int y = std::max(0, static_cast<int>(b.top)); y < std::min(behind.height(), static_cast<int>(b.bottom)); ++y)
      for (int x = std::max(0, static_cast<int>(b.left)); x < std::min(behind.width(), static_cast<int>(b.right));
           ++x) {
        const viewer::Pixel32 back = behind.row(y)[x], front = viewer::mixed(back, ink, alpha);
        double& ratio = known[{front & 0xffffffu, back & 0xffffffu}];
        if (ratio == 0) ratio = contrast(Tone(front), Tone(back));
        ratios.push_back(ratio);
      }
    if (ratios.empty()) continue;
    const auto middle = ratios.begin() + static_cast<std::ptrdiff_t>(ratios.size() / 2);
    std::nth_element(ratios.begin(), middle, ratios.end());
    const bool large = l.size >= 24 || (l.bold && l.size >= 18.66f);
    if (*middle < (large ? 3 : 4.5) - 0.005)
      found.push_back(fmt::format(
          "\"{}\" at ({}, {}): {:.2f} : 1, {:06x} on {:06x}", drawn.words[l.word], l.first.x, l.first.y, *middle,
          ink & 0xffffffu, behind.row(static_cast<int>((b.top + b.bottom) / 2))[static_cast<int>(b.left)] & 0xffffffu));
  }
  return found;
}

int times_written(App& app, const std::string& what) {
  picture(app);
  const auto words = letters_of(app.ui().fonts).words;
  return static_cast<int>(std::count(words.begin(), words.end(), what));
}

}  // namespace zstep::test
