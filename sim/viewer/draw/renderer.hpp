// Puts Dear ImGui's draw lists on a surface with SDL's software renderer.
//
// The surface is the viewer's own: a window only shows a copy of it. So a picture drawn without any display is the same,
// byte for byte, as what the window shows.
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include <SDL.h>
#include <imgui.h>

#include "sim/viewer/draw/canvas.hpp"

namespace zstep::viewer {

struct SdlDeleter {
  void operator()(SDL_Surface* p) const { SDL_FreeSurface(p); }
  void operator()(SDL_Renderer* p) const { SDL_DestroyRenderer(p); }
  void operator()(SDL_Texture* p) const { SDL_DestroyTexture(p); }
  void operator()(SDL_Window* p) const { SDL_DestroyWindow(p); }
};

class Renderer {
 public:
  Renderer(int width, int height);
  Renderer(const Renderer&) = delete;
  Renderer& operator=(const Renderer&) = delete;

  void resize(int width, int height);
  int width() const { return surface_->w; }
  int height() const { return surface_->h; }

  /// Builds the texture of ImGui's font atlas; again whenever the fonts change.
  void upload_fonts();
  /// The texture called `slot`, with the canvas's pixels; uploaded only when `version` is new.
  ImTextureID image(const std::string& slot, const Canvas& canvas, std::uint64_t version);

  void draw(const ImDrawData& data, Pixel32 clear);

  SDL_Surface* surface() const { return surface_.get(); }
  std::vector<std::uint8_t> rgb() const;  ///< [height*width*3], row 0 on top

 private:
  struct Image {
    std::unique_ptr<SDL_Texture, SdlDeleter> texture;
    int width = 0, height = 0;
    std::uint64_t version = 0;
  };
  std::unique_ptr<SDL_Surface, SdlDeleter> surface_;
  std::unique_ptr<SDL_Renderer, SdlDeleter> renderer_;
  std::unique_ptr<SDL_Texture, SdlDeleter> font_;
  std::map<std::string, Image> images_;
};

}  // namespace zstep::viewer
