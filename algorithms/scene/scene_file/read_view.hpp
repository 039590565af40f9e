// [raster], [camera] and [options] of a scene file.
#pragma once

#include "algorithms/scene/scene_file/toml_text.hpp"
#include "traces/scene.hpp"

namespace zstep::scene {

// `top` is the whole scene's table, `screen` whether it is in screen coordinates. All throw InputError.

void read_raster(Keys& top, const std::string& file, bool screen, Raster& raster);
/// Leaves rho, near and far at 0 where they are to come from the extent.
void read_camera(Keys& top, const std::string& file, bool screen, Camera& camera);
/// `two_sided`: back faces are drawn unless it says otherwise.
void read_options(Keys& top, const std::string& file, bool two_sided, Conventions& conventions);

}  // namespace zstep::scene
