#include "algorithms/scene/scene_file/read_parts.hpp"

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include "algorithms/scene/surface/sample.hpp"

namespace zstep::scene {

namespace {

/// A number from `least` to `most`.
std::optional<double> number_between(Keys& keys, const std::string& file, std::string_view key, double least,
                                     double most) {
  const auto value = keys.number(key);
  if (value && !(*value >= least && *value <= most))
    fail_at(*keys.find(key), file, fmt::format("{} is {}", key, *value),
            fmt::format("it goes from {} to {}", least, most));
  return value;
}

/// key = [low, high]
void read_range(Keys& keys, const std::string& file, std::string_view key, double& low, double& high) {
  const toml::array* list = keys.array(key);
  if (list == nullptr) return;
  if (list->size() != 2) fail_at(*list, file, fmt::format("{} is no range", key), "write [-3, 3]");
  low = number_in((*list)[0], file, key);
  high = number_in((*list)[1], file, key);
  if (!(low < high))
    fail_at(*list, file, fmt::format("{} goes from {} to {}", key, low, high), "write the smaller number first");
}

}  // namespace

MaterialKeys read_material(Keys& keys, const std::string& file) {
  return {number_between(keys, file, "opacity", 0, 1), number_between(keys, file, "reflectance", 0, 1),
          number_between(keys, file, "refraction", least_refraction, most_refraction)};
}

std::optional<Light> read_light(Keys& top, const std::string& file, bool screen) {
  const toml::table* table = top.table("light");
  if (table == nullptr) return std::nullopt;
  if (screen) fail_at(*table, file, "a light cannot stand in a scene in screen coordinates", "use world coordinates");
  Keys keys(*table, file, "[light]");
  Light light;
  const auto position = keys.point("position");
  light.target = keys.point("target").value_or(light.target);
  light.window = keys.positive("window").value_or(0);
  light.near = keys.positive("near").value_or(0);
  light.far = keys.positive("far").value_or(0);
  keys.finish();
  if (!position) fail_at(*table, file, "the light has no position", "add position = [x, y, z]");
  light.position = *position;
  if (!(glm::length(light.target - light.position) > 1e-12 * (glm::length(light.target) + glm::length(light.position))))
    fail_at(*keys.find("position"), file, "the light stands at its target", "move one of them");
  if (light.far > 0 && !(light.far > light.near))
    fail_at(*keys.find("far"), file, "far is not greater than near", "give the greater distance to far");
  return light;
}

Surface read_surface(Keys& keys, const std::string& file) {
  Surface surface = default_surface();
  surface.formula = keys.text("formula").value_or("");
  read_range(keys, file, "x", surface.x_min, surface.x_max);
  read_range(keys, file, "z", surface.z_min, surface.z_max);
  const auto most = static_cast<std::int32_t>(most_surface_samples);
  surface.columns = keys.whole("columns", 1, most).value_or(surface.columns);
  surface.rows = keys.whole("rows", 1, most).value_or(surface.rows);
  return surface;
}

}  // namespace zstep::scene
