#include "algorithms/scene/scene_file/read_view.hpp"

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include "algorithms/scene/mesh.hpp"
#include "algorithms/viewing/camera.hpp"

namespace zstep::scene {

namespace {

void read_eye(Keys& keys, const std::string& file, Camera& camera) {
  const auto eye = keys.point("eye"), target = keys.point("target"), up = keys.point("up");
  if (!eye) {
    for (const std::string_view key : {"target", "up"})
      if (keys.has(key))
        fail_at(*keys.find(key), file, fmt::format("'{}' stands without 'eye'", key), "add eye = [x, y, z]");
    return;
  }
  const glm::dvec3 at = target.value_or(glm::dvec3(0));
  if (!(glm::length(at - *eye) > 1e-12 * (glm::length(at) + glm::length(*eye))))
    fail_at(*keys.find("eye"), file, "the eye stands at its target", "move one of them");
  camera.polar = false;
  camera.view = viewing::look_at_view(*eye, at, up.value_or(glm::dvec3(0, 0, 1)));
  camera.eye = *eye;
}

}  // namespace

void read_raster(Keys& top, const std::string& file, bool screen, Raster& raster) {
  const toml::table* table = top.table("raster");
  if (table == nullptr) return;
  Keys keys(*table, file, "[raster]");
  raster.width = keys.whole("width", 1, largest_side).value_or(raster.width);
  raster.height = keys.whole("height", 1, largest_side).value_or(raster.height);
  if (const auto axis = keys.choice("y_axis", {"down", "up"})) raster.y_up = *axis == 1;
  keys.finish();
  if (std::int64_t{raster.width} * raster.height > most_pixels)
    fail_at(*table, file, fmt::format("the raster has more than {} pixels", most_pixels), "make it smaller");
  if (raster.y_up && !screen)
    fail_at(*table->get("y_axis"), file, "y_axis is for scenes in screen coordinates",
            "remove it, or put coordinates = \"screen\" at the top");
}

void read_camera(Keys& top, const std::string& file, bool screen, Camera& camera) {
  const toml::table* table = top.table("camera");
  camera.rho = 0;  // from the scene's extent
  camera.d = default_d;
  if (screen) {
    if (table != nullptr)
      fail_at(*table, file, "a scene in screen coordinates has no camera", "remove [camera], or use world coordinates");
    camera = Camera{};
    camera.kind = Camera::Kind::screen;
    camera.polar = false;
    return;
  }
  if (table == nullptr) return;
  Keys keys(*table, file, "[camera]");
  if (keys.boolean("orthographic").value_or(false)) camera.kind = Camera::Kind::orthographic;
  for (const std::string_view angle : {"rho", "theta", "phi"})
    keys.not_both(angle, "eye", "say where the eye is in one way: rho, theta, phi or eye, target, up");
  camera.rho = keys.positive("rho").value_or(camera.rho);
  camera.theta = keys.number("theta").value_or(camera.theta);
  camera.phi = keys.number("phi").value_or(camera.phi);
  camera.d = keys.positive("d").value_or(camera.d);
  keys.not_both("window", "field_of_view", "both say how much is seen: keep one");
  camera.window = keys.positive("window").value_or(camera.window);
  if (const auto degrees = keys.positive("field_of_view")) {
    if (!(*degrees < 180)) fail_at(*keys.find("field_of_view"), file, "field_of_view is not below 180", "try 40");
    camera.window = viewing::window_for_field_of_view(*degrees, camera.d);
  }
  read_eye(keys, file, camera);
  if (const auto near = keys.number("near")) camera.near = *near;
  if (const auto far = keys.number("far")) camera.far = *far;
  keys.finish();
  if (keys.has("near") && !(camera.near > 0))
    fail_at(*keys.find("near"), file, "near is not greater than 0", "try 0.1");
  if (keys.has("far") && !(camera.far > camera.near))
    fail_at(*keys.find("far"), file, "far is not greater than near", "give the greater distance to far");
}

void read_options(Keys& top, const std::string& file, bool two_sided, Conventions& conventions) {
  if (two_sided) conventions.cull = false;
  const toml::table* table = top.table("options");
  if (table == nullptr) return;
  Keys keys(*table, file, "[options]");
  for_each_convention([&]<class E>(std::string_view key, E Conventions::*member) {
    const std::vector<std::string_view> words(words_of<E>.begin(), words_of<E>.end());
    if (const auto k = keys.choice(key, words)) conventions.*member = static_cast<E>(*k);
  });
  conventions.cull = keys.boolean("cull").value_or(conventions.cull);
  keys.finish();
}

}  // namespace zstep::scene
