#include "sim/viewer/draw/renderer.hpp"

#include <stdexcept>

#include <fmt/format.h>

namespace zstep::viewer {
namespace {

[[noreturn]] void fail(const char* what) { throw std::runtime_error(fmt::format("viewer: {}: {}", what, SDL_GetError())); }

/// Dear ImGui's RGBA bytes as the surface's own ARGB, so that blits need no conversion.
std::vector<std::uint32_t> to_argb(const unsigned char* rgba, int count) {
  std::vector<std::uint32_t> out(static_cast<std::size_t>(count));
  for (std::size_t i = 0; i < out.size(); ++i, rgba += 4)
    out[i] = static_cast<std::uint32_t>(rgba[3]) << 24 | static_cast<std::uint32_t>(rgba[0]) << 16 |
             static_cast<std::uint32_t>(rgba[1]) << 8 | static_cast<std::uint32_t>(rgba[2]);
  return out;
}

}  // namespace

Renderer::Renderer(int width, int height) { resize(width, height); }

void Renderer::resize(int width, int height) {
  if (surface_ && surface_->w == width && surface_->h == height) return;
  // Textures belong to the renderer and go with it; whoever draws uploads them again.
  images_.clear();
  font_.reset();
  renderer_.reset();
  surface_.reset(SDL_CreateRGBSurfaceWithFormat(0, std::max(width, 1), std::max(height, 1), 32, SDL_PIXELFORMAT_ARGB8888));
  if (!surface_) fail("cannot make a picture of this size");
  renderer_.reset(SDL_CreateSoftwareRenderer(surface_.get()));
  if (!renderer_) fail("no software renderer");
  if (ImGui::GetCurrentContext() && ImGui::GetIO().Fonts->IsBuilt()) upload_fonts();
}

void Renderer::upload_fonts() {
  unsigned char* rgba = nullptr;
  int width = 0, height = 0;
  ImFontAtlas* atlas = ImGui::GetIO().Fonts;
  atlas->GetTexDataAsRGBA32(&rgba, &width, &height);
  font_.reset(SDL_CreateTexture(renderer_.get(), SDL_PIXELFORMAT_ARGB8888, SDL_TEXTUREACCESS_STATIC, width, height));
  if (!font_) fail("no texture for the fonts");
  const std::vector<std::uint32_t> argb = to_argb(rgba, width * height);
  SDL_UpdateTexture(font_.get(), nullptr, argb.data(), width * 4);
  SDL_SetTextureBlendMode(font_.get(), SDL_BLENDMODE_BLEND);
  SDL_SetTextureScaleMode(font_.get(), SDL_ScaleModeNearest);
  atlas->SetTexID((ImTextureID)font_.get());
}

ImTextureID Renderer::image(const std::string& slot, const Canvas& canvas, std::uint64_t version) {
  Image& image = images_[slot];
  const bool fits = image.texture && image.width == canvas.width() && image.height == canvas.height();
  if (fits && image.version == version) return (ImTextureID)image.texture.get();
  if (!fits) {
    image.texture.reset(SDL_CreateTexture(renderer_.get(), SDL_PIXELFORMAT_ARGB8888, SDL_TEXTUREACCESS_STREAMING,
                                          canvas.width(), canvas.height()));
    if (!image.texture) fail("no texture for a pane");
    SDL_SetTextureBlendMode(image.texture.get(), SDL_BLENDMODE_NONE);
    image.width = canvas.width();
    image.height = canvas.height();
  }
  SDL_UpdateTexture(image.texture.get(), nullptr, canvas.row(0), canvas.width() * 4);
  image.version = version;
  return (ImTextureID)image.texture.get();
}

void Renderer::draw(const ImDrawData& data, Pixel32 clear) {
  SDL_Renderer* renderer = renderer_.get();
  SDL_RenderSetClipRect(renderer, nullptr);
  SDL_SetRenderDrawBlendMode(renderer, SDL_BLENDMODE_NONE);
  SDL_SetRenderDrawColor(renderer, static_cast<Uint8>(clear >> 16), static_cast<Uint8>(clear >> 8), static_cast<Uint8>(clear), 255);
  SDL_RenderClear(renderer);
  SDL_SetRenderDrawBlendMode(renderer, SDL_BLENDMODE_BLEND);
  for (int n = 0; n < data.CmdListsCount; ++n) {
    const ImDrawList& list = *data.CmdLists[n];
    for (const ImDrawCmd& command : list.CmdBuffer) {
      if (command.UserCallback || command.ElemCount == 0) continue;
      const int left = std::max(0, static_cast<int>(command.ClipRect.x)), top = std::max(0, static_cast<int>(command.ClipRect.y));
      const int right = std::min(width(), static_cast<int>(command.ClipRect.z));
      const int bottom = std::min(height(), static_cast<int>(command.ClipRect.w));
      if (left >= right || top >= bottom) continue;
      const SDL_Rect clip{left, top, right - left, bottom - top};
      SDL_RenderSetClipRect(renderer, &clip);
      const ImDrawVert* vertices = list.VtxBuffer.Data + command.VtxOffset;
      static_assert(sizeof(ImU32) == sizeof(SDL_Color));  // both are R, G, B, A bytes
      SDL_RenderGeometryRaw(renderer, (SDL_Texture*)command.GetTexID(), &vertices->pos.x, sizeof(ImDrawVert),
                            reinterpret_cast<const SDL_Color*>(&vertices->col), sizeof(ImDrawVert), &vertices->uv.x,
                            sizeof(ImDrawVert), list.VtxBuffer.Size - static_cast<int>(command.VtxOffset),
                            list.IdxBuffer.Data + command.IdxOffset, static_cast<int>(command.ElemCount), sizeof(ImDrawIdx));
    }
  }
  SDL_RenderSetClipRect(renderer, nullptr);
  SDL_RenderPresent(renderer);
}

std::vector<std::uint8_t> Renderer::rgb() const {
  std::vector<std::uint8_t> out;
  out.reserve(static_cast<std::size_t>(surface_->w) * static_cast<std::size_t>(surface_->h) * 3);
  for (int y = 0; y < surface_->h; ++y) {
    const auto* row = reinterpret_cast<const std::uint32_t*>(static_cast<const std::uint8_t*>(surface_->pixels) + y * surface_->pitch);
    for (int x = 0; x < surface_->w; ++x)
      for (const int shift : {16, 8, 0}) out.push_back(static_cast<std::uint8_t>(row[x] >> shift));
  }
  return out;
}

}  // namespace zstep::viewer
