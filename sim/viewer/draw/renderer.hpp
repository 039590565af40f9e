// Puts Dear ImGui's draw lists on a picture in memory.
//
// The picture is the viewer's own: a window only shows a copy of it. So a picture drawn without any display is the
// same, byte for byte, as what the window shows. What a frame is made of (opaque rectangles, letters, canvases) is
// drawn by plain loops; SDL's software renderer blends what is opaque too and took 8.4 ms for a
// frame of 1600x900 that takes 0.8 ms here.
#pragma once

#include <cstdint>
#include <vector>

#include <imgui.h>

#include "sim/viewer/draw/canvas.hpp"

namespace zstep::viewer {

class Renderer {
 public:
  Renderer(int width, int height) { resize(width, height); }
  Renderer(const Renderer&) = delete;
  Renderer& operator=(const Renderer&) = delete;

  void resize(int width, int height);
  int width() const { return picture_.width(); }
  int height() const { return picture_.height(); }

  /// Takes ImGui's font atlas as it is now; again whenever the fonts change.
  void take_fonts();
  /// For ImDrawList::AddImage, at the canvas's own size. The canvas must stay as it is until draw().
  static ImTextureID image(const Canvas& canvas) { return (ImTextureID)&canvas; }

  void draw(const ImDrawData& data, Pixel32 clear);

  const Canvas& picture() const { return picture_; }
  std::uint64_t fingerprint() const;      ///< of the picture
  std::vector<std::uint8_t> rgb() const;  ///< [height*width*3], row 0 on top

 private:
  struct Box {
    int left, top, right, bottom;
  };
  struct Atlas {
    const unsigned char* alpha = nullptr;
    int width = 0, height = 0;
  };
  void draw_quad(const ImDrawVert& first, const ImDrawVert& opposite, const void* texture, Box clip);
  void draw_triangle(const ImDrawVert& a, const ImDrawVert& b, const ImDrawVert& c, Box clip);
  void fill(Box box, ImU32 color);
  void draw_letter(const ImDrawVert& first, const ImDrawVert& opposite, Box box, Box clip);
  static void draw_canvas(Canvas& out, const Canvas& canvas, Box box, Box clip);

  Canvas picture_;
  Atlas font_;
};

}  // namespace zstep::viewer
