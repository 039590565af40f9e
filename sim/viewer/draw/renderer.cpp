#include "sim/viewer/draw/renderer.hpp"

#include <algorithm>
#include <cmath>

#include <xxhash.h>

#include "sim/viewer/draw/canvas.hpp"
#include "sim/viewer/draw/theme.hpp"
#include "traces/math/whole.hpp"

namespace zstep::viewer {
namespace {

int whole(float x) { return nearest_int(std::clamp(x, -1e6f, 1e6f)); }
unsigned alpha_of(ImU32 color) { return color >> 24; }

/// Corners a, b, c, d in the order ImDrawList gives a rectangle: clockwise from the top left.
bool is_rectangle(const ImDrawVert& a, const ImDrawVert& b, const ImDrawVert& c, const ImDrawVert& d) {
  return a.pos.y == b.pos.y && b.pos.x == c.pos.x && c.pos.y == d.pos.y && d.pos.x == a.pos.x && a.pos.x <= c.pos.x &&
         a.pos.y <= c.pos.y;
}

}  // namespace

void Renderer::resize(int width, int height) {
  if (picture_.width() != width || picture_.height() != height)
    picture_.resize(std::max(width, 1), std::max(height, 1));
}

std::uint64_t Renderer::fingerprint() const {
  const std::size_t pixels = pixel_count(picture_.width(), picture_.height());
  return XXH3_64bits(picture_.row(0), pixels * sizeof(Pixel32));
}

void Renderer::take_fonts() {
  unsigned char* alpha = nullptr;
  ImFontAtlas* atlas = ImGui::GetIO().Fonts;
  atlas->GetTexDataAsAlpha8(&alpha, &font_.width, &font_.height);
  font_.alpha = alpha;
  atlas->SetTexID((ImTextureID)&font_);
}

void Renderer::fill(Box box, ImU32 color) {
  const Pixel32 pixel = to_pixel(color);
  const unsigned alpha = alpha_of(color);
  if (box.left >= box.right || alpha == 0) return;
  for (int y = box.top; y < box.bottom; ++y) {
    Pixel32* row = picture_.row(y);
    if (alpha == 255) std::fill(row + box.left, row + box.right, pixel);
    else
      for (int x = box.left; x < box.right; ++x) row[x] = mixed(row[x], pixel, alpha);
  }
}

void Renderer::draw_letter(const ImDrawVert& first, const ImDrawVert& opposite, Box box, Box clip) {
  const int u0 = whole(first.uv.x * to_float(font_.width)), v0 = whole(first.uv.y * to_float(font_.height));
  const int u1 = whole(opposite.uv.x * to_float(font_.width)), v1 = whole(opposite.uv.y * to_float(font_.height));
  const int wide = std::max(1, box.right - box.left), high = std::max(1, box.bottom - box.top);
  const bool same_size = u1 - u0 == wide && v1 - v0 == high;
  const Pixel32 ink = to_pixel(first.col);
  const unsigned alpha = alpha_of(first.col);
  for (int y = std::max(box.top, clip.top); y < std::min(box.bottom, clip.bottom); ++y) {
    const int v = same_size ? v0 + y - box.top : v0 + (y - box.top) * (v1 - v0) / high;
    if (v < 0 || v >= font_.height) continue;
    Pixel32* row = picture_.row(y);
    const unsigned char* source = font_.alpha + static_cast<std::ptrdiff_t>(v) * font_.width;
    for (int x = std::max(box.left, clip.left); x < std::min(box.right, clip.right); ++x) {
      const int u = same_size ? u0 + x - box.left : u0 + (x - box.left) * (u1 - u0) / wide;
      if (u < 0 || u >= font_.width || source[u] == 0) continue;
      row[x] = mixed(row[x], ink, alpha == 255 ? source[u] : source[u] * alpha / 255);
    }
  }
}

void Renderer::draw_canvas(Canvas& out, const Canvas& canvas, Box box, Box clip) {
  const int left = std::max(box.left, clip.left), right = std::min({box.right, clip.right, box.left + canvas.width()});
  const int bottom = std::min({box.bottom, clip.bottom, box.top + canvas.height()});
  if (left >= right) return;
  for (int y = std::max(box.top, clip.top); y < bottom; ++y) {
    const Pixel32* source = canvas.row(y - box.top);
    std::copy(source + (left - box.left), source + (right - box.left), out.row(y) + left);
  }
}

void Renderer::draw_quad(const ImDrawVert& first, const ImDrawVert& opposite, const void* texture, Box clip) {
  const Box box{whole(first.pos.x), whole(first.pos.y), whole(opposite.pos.x), whole(opposite.pos.y)};
  if (texture != &font_) return draw_canvas(picture_, *static_cast<const Canvas*>(texture), box, clip);
  if (first.uv.x != opposite.uv.x) return draw_letter(first, opposite, box, clip);
  fill({std::max(box.left, clip.left), std::max(box.top, clip.top), std::min(box.right, clip.right),
        std::min(box.bottom, clip.bottom)},
       first.col);
}

/// In one colour; a pixel belongs to it when its centre does.
void Renderer::draw_triangle(const ImDrawVert& a, const ImDrawVert& b, const ImDrawVert& c, Box clip) {
  const ImVec2 p[3] = {a.pos, b.pos, c.pos};
  const int top = std::max(clip.top, whole(std::floor(std::min({p[0].y, p[1].y, p[2].y}))));
  const int bottom = std::min(clip.bottom, whole(std::ceil(std::max({p[0].y, p[1].y, p[2].y}))));
  for (int y = top; y < bottom; ++y) {
    const float middle = to_float(y) + 0.5f;
    float low = 1e6f, high = -1e6f;
    for (int k = 0; k < 3; ++k) {
      const ImVec2 from = p[k], to = p[(k + 1) % 3];
      if ((from.y <= middle) == (to.y <= middle)) continue;
      const float x = from.x + (to.x - from.x) * (middle - from.y) / (to.y - from.y);
      low = std::min(low, x);
      high = std::max(high, x);
    }
    if (low > high) continue;
    fill({std::max(clip.left, whole(std::ceil(low - 0.5f))), y, std::min(clip.right, whole(std::ceil(high - 0.5f))),
          y + 1},
         a.col);
  }
}

void Renderer::draw(const ImDrawData& data, Pixel32 clear) {
  picture_.fill(clear);
  for (int n = 0; n < data.CmdListsCount; ++n) {
    const ImDrawList& list = *data.CmdLists[n];
    for (const ImDrawCmd& command : list.CmdBuffer) {
      if (command.UserCallback || command.ElemCount == 0) continue;
      const Box clip{std::max(0, whole(command.ClipRect.x)), std::max(0, whole(command.ClipRect.y)),
                     std::min(width(), whole(command.ClipRect.z)), std::min(height(), whole(command.ClipRect.w))};
      if (clip.left >= clip.right || clip.top >= clip.bottom) continue;
      const void* texture = (const void*)command.GetTexID();
      const ImDrawIdx* index = list.IdxBuffer.Data + command.IdxOffset;
      const ImDrawVert* vertices = list.VtxBuffer.Data + command.VtxOffset;
      for (unsigned i = 0; i + 2 < command.ElemCount;) {
        const ImDrawIdx* t = index + i;
        if (i + 5 < command.ElemCount && t[3] == t[0] && t[4] == t[2] &&
            is_rectangle(vertices[t[0]], vertices[t[1]], vertices[t[2]], vertices[t[5]])) {
          draw_quad(vertices[t[0]], vertices[t[2]], texture, clip);
          i += 6;
          continue;
        }
        if (texture == &font_) draw_triangle(vertices[t[0]], vertices[t[1]], vertices[t[2]], clip);
        i += 3;
      }
    }
  }
}

std::vector<std::uint8_t> Renderer::rgb() const {
  std::vector<std::uint8_t> out;
  out.reserve(pixel_count(width(), height()) * 3);
  for (int y = 0; y < height(); ++y)
    for (int x = 0; x < width(); ++x)
      for (const int shift : {16, 8, 0}) out.push_back(static_cast<std::uint8_t>(picture_.row(y)[x] >> shift));
  return out;
}

}  // namespace zstep::viewer
