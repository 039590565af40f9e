// [raster], [camera] and [options] of a scene file: how the scene is looked at and drawn.
#include <cmath>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include "algorithms/interpolation/interpolation.hpp"
#include "algorithms/scene/mesh.hpp"
#include "algorithms/scene/scene_file/read_scene.hpp"
#include "algorithms/scene/scene_file/toml_text.hpp"
#include "algorithms/viewing/camera.hpp"
#include "traces/scene.hpp"

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

/// The four rows of a projection matrix. Where w_c is -z_v, view coordinates are right-handed.
void read_projection(Keys& keys, const std::string& file, Camera& camera) {
  const toml::array* rows = keys.array("projection");
  if (rows == nullptr) return;
  for (const std::string_view other : {"d", "window", "field_of_view", "orthographic"})
    keys.not_both("projection", other, "the matrix says what is seen: keep one");
  if (camera.polar) fail_at(*rows, file, "'projection' stands without 'eye'", "add eye = [x, y, z], target and up");
  glm::dmat4 matrix(0);
  if (rows->size() != 4) fail_at(*rows, file, "projection does not have four rows", "write [[1, 0, 0, 0], ...]");
  for (int row = 0; row < 4; ++row) {
    const toml::array* cells = (*rows)[static_cast<std::size_t>(row)].as_array();
    if (cells == nullptr || cells->size() != 4)
      fail_at(*rows, file, fmt::format("row {} of projection does not have four numbers", row + 1),
              "write [[1, 0, 0, 0], ...]");
    for (int column = 0; column < 4; ++column)
      matrix[column][row] = number_in((*cells)[static_cast<std::size_t>(column)], file, "projection");
  }
  glm::dmat4 view = camera.view;
  if (matrix[2][3] < 0)
    for (int column = 0; column < 4; ++column) view[column][2] = -view[column][2];
  camera.matrices = {view, matrix};
}

}  // namespace

void read_raster(Keys& top, const std::string& file, bool screen, Raster& raster) {
  const toml::table* table = top.table("raster");
  if (table == nullptr) return;
  Keys keys(*table, file, "[raster]");
  raster.width = keys.whole("width", 1, largest_side).value_or(raster.width);
  raster.height = keys.whole("height", 1, largest_side).value_or(raster.height);
  if (const auto axis = keys.choice("y_axis", {"down", "up"})) raster.y_up = *axis == 1;
  if (const auto seen = keys.choice("seen_at", {"centres", "corners"})) raster.corners = *seen == 1;
  keys.finish();
  if (std::int64_t{raster.width} * raster.height > most_pixels)
    fail_at(*table, file, fmt::format("the raster has more than {} pixels", most_pixels), "make it smaller");
  if (raster.corners && screen)
    fail_at(*table->get("seen_at"), file, "seen_at is for scenes with a camera",
            "take it out: points on the raster are held against whole numbers");
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
  read_projection(keys, file, camera);
  if (const auto near = keys.number("near")) camera.near = *near;
  if (const toml::node* far = keys.find("far")) {
    const bool infinite = camera.kind == Camera::Kind::perspective && far->value<double>() == HUGE_VAL;
    camera.far = infinite ? HUGE_VAL : number_in(*far, file, "far");
  }
  if (const toml::array* ends = keys.array("depth_range")) {
    if (ends->size() == 2)
      camera.depth_range = {number_in((*ends)[0], file, "depth_range"), number_in((*ends)[1], file, "depth_range")};
    if (ends->size() != 2 || !camera.depth_range.is_right())
      fail_at(*ends, file, "depth_range is not two numbers, the smaller one first", "write as [0, 1]");
  }
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
    if (const auto k = keys.choice(key, words)) conventions.*member = values_of<E>[*k];
  });
  conventions.cull = keys.boolean("cull").value_or(conventions.cull);
  // What is said of depths and outlines besides, as the methods that have it say it.
  const auto read = [&](std::string_view key, const Option& option) {
    const std::size_t bar = option.words.find('|');
    const auto given = keys.choice(key, {option.words.substr(0, bar), option.words.substr(bar + 1)});
    if (given == 1) conventions.options[std::string(option.name)] = option.words.substr(bar + 1);
  };
  read("nearer", interpolation::nearer_option), read("ties", interpolation::ties_option);
  read("initial_depth", interpolation::initial_depth_option), read("fill", interpolation::fill_option);
  keys.finish();
}

}  // namespace zstep::scene
