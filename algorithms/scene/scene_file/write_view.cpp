#include <array>
#include <string>

#include <fmt/format.h>

#include "algorithms/scene/load.hpp"
#include "algorithms/scene/scene_file/write_scene.hpp"

namespace zstep::scene {

namespace {

struct CameraKey {
  const char* name;
  double Camera::*number;
};
constexpr std::array<CameraKey, 3> eye_keys{{{"rho", &Camera::rho}, {"theta", &Camera::theta}, {"phi", &Camera::phi}}};
constexpr std::array<CameraKey, 2> plane_keys{{{"near", &Camera::near}, {"far", &Camera::far}}};

std::string in_toml(double number) { return fmt::format("{}", number); }
std::string in_toml(bool yes) { return yes ? "true" : "false"; }
std::string in_toml(const glm::dvec3& point) { return fmt::format("[{}, {}, {}]", point.x, point.y, point.z); }

bool edit_raster(TomlText& text, const Raster& was, const Raster& is) {
  if (was.width != is.width) text.set("raster", "width", fmt::format("{}", is.width));
  if (was.height != is.height) text.set("raster", "height", fmt::format("{}", is.height));
  if (was.y_up != is.y_up) text.set("raster", "y_axis", is.y_up ? "\"up\"" : "\"down\"");
  return was != is;
}

bool edit_options(TomlText& text, const Conventions& was, const Conventions& is) {
  bool edited = false;
  for_each_convention([&]<class E>(std::string_view key, E Conventions::*member) {
    if (was.*member == is.*member) return;
    text.set("options", key, fmt::format("\"{}\"", word_of(is.*member)));
    edited = true;
  });
  if (was.cull != is.cull) text.set("options", "cull", in_toml(is.cull)), edited = true;
  return edited;
}

template <std::size_t Count>
bool edit_numbers(TomlText& text, const std::array<CameraKey, Count>& keys, const Camera& was, const Camera& is) {
  bool edited = false;
  for (const auto& [name, number] : keys)
    if (was.*number != is.*number) text.set("camera", name, in_toml(is.*number)), edited = true;
  return edited;
}

bool edit_eye(TomlText& text, const Camera& was, const Camera& is) {
  bool edited = was.kind != is.kind;
  if (edited) text.set("camera", "orthographic", in_toml(is.kind == Camera::Kind::orthographic));
  if (was.d != is.d) text.set("camera", "d", in_toml(is.d)), edited = true;
  if (!is.polar) return edited;
  if (!was.polar)
    for (const char* key : {"eye", "target", "up"}) text.erase("camera", key);
  return edit_numbers(text, eye_keys, was, is) || edited || !was.polar;
}

bool edit_window(TomlText& text, const Camera& was, const Camera& is) {
  if (was.window == is.window) return false;
  const toml::table* camera = text.table("camera");
  if (camera && camera->contains("field_of_view")) text.rename("camera", "field_of_view", "window");
  text.set("camera", "window", in_toml(is.window));
  return true;
}

bool edit_light(TomlText& text, const std::optional<Light>& was, const std::optional<Light>& is) {
  if (was == is || !is) return false;
  const bool moved = !was || was->position != is->position || was->target != is->target;
  if (!was || was->position != is->position) text.set("light", "position", in_toml(is->position));
  if (!was || was->target != is->target) text.set("light", "target", in_toml(is->target));
  if (moved) return true;
  for (const auto& [name, number] : {std::pair{"window", &Light::window}, {"near", &Light::near}, {"far", &Light::far}})
    if ((*was).*number != (*is).*number) text.set("light", name, in_toml((*is).*number));
  return true;
}

}  // namespace

bool edit_view(TomlText& text, const Wanted& wanted) {
  const SceneFile file = read_scene_text(text.text(), wanted.path);
  const Scene was = look_at_scene(file.scene, {});
  const Scene& is = wanted.scene;
  if (was.background != is.background) {
    const Color& c = is.background;
    return text.set("", "background", fmt::format("\"#{:02x}{:02x}{:02x}\"", c.red, c.green, c.blue)), true;
  }
  if (edit_raster(text, was.raster, is.raster) || edit_options(text, file.conventions, wanted.conventions)) return true;
  if (is.camera.kind == Camera::Kind::screen) return false;
  return edit_eye(text, was.camera, is.camera) || edit_window(text, was.camera, is.camera) ||
         edit_numbers(text, plane_keys, was.camera, is.camera) || edit_light(text, was.light, is.light);
}

}  // namespace zstep::scene
