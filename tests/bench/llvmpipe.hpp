// A scene drawn by llvmpipe, Mesa's rasteriser for processors, kept ready to draw frame after frame.
#pragma once

#include <memory>
#include <string>

#include "traces/scene.hpp"

namespace zstep::bench {

class Llvmpipe {
 public:
  /// Hands the scene's facets, cut into triangles, to the driver's own memory. Throws std::runtime_error if there is no
  /// llvmpipe, so that no other driver is measured in its place.
  Llvmpipe(const Scene& scene, bool cull);
  ~Llvmpipe();

  void draw_frame();         ///< clears, draws everything in one call, and waits until the pixels are there
  int pixels_drawn() const;  ///< of the last frame, those that are not background
  std::string name() const;

 private:
  struct Context;
  std::unique_ptr<Context> context_;
};

}  // namespace zstep::bench
