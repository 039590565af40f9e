// What is accepted has its effect: each convention and each option of each method, on scenes of each kind, is refused
// or makes another run.
#include <algorithm>
#include <filesystem>
#include <set>
#include <string>
#include <vector>

#include <doctest/doctest.h>

#include "algorithms/catalog/catalog.hpp"
#include "algorithms/catalog/changes.hpp"
#include "algorithms/scene/load.hpp"
#include "tests/folder.hpp"
#include "tests/golden/golden.hpp"
#include "tests/unit/algorithms/scenes.hpp"
#include "tests/where.hpp"
#include "traces/error.hpp"
#include "traces/formulas/shading.hpp"

using namespace zstep;

namespace {

std::vector<Scene> scenes_of(Camera::Kind kind) {
  std::vector<Scene> all;
  for (const char* name : {"pyramid", "intersecting", "lessons/scenes/six-walls.toml", "lessons/scenes/panes.toml",
                           "lessons/scenes/lamp.toml", "tests/golden/shadow.toml", "tests/golden/textured.toml",
                           "lessons/scenes/slanting.toml", "tests/golden/edges.toml", "tests/golden/scan-line.toml",
                           "y = sin(x)*cos(z)"}) {
    const std::string text = name;
    const bool file = text.ends_with(".toml");
    Scene scene = load_scene(file ? test::in_checkout(text) : text).scene;
    if ((scene.camera.kind == Camera::Kind::screen) != (kind == Camera::Kind::screen)) continue;
    ViewOptions view;
    if (kind == Camera::Kind::orthographic) view.orthographic = true;
    if (kind != Camera::Kind::screen) view.width = 24, view.height = 20;
    all.push_back(look_at_scene(std::move(scene), view));
  }
  // An outline that goes round its middle twice.
  if (kind == Camera::Kind::screen)
    all.push_back(test::screen_scene(24, 24, {{{12, 1, 1}, {19, 22, 1}, {1, 9, 1}, {23, 9, 1}, {5, 22, 1}}}));
  return all;
}

/// All steps of a run, without its header.
std::string steps_of(const Method& method, const Scene& scene, const Conventions& conventions) {
  const std::string all = test::jsonl_of(test::recorded_by(std::string(method.id), scene, conventions));
  return all.substr(all.find('\n'));
}

/// How a method takes something other than usual: on none of the scenes, without an effect on any, or with one.
enum class Takes { refused, without_effect, with_effect };
Takes taken(const Method& method, const std::vector<Scene>& scenes, const Conventions& usual,
            const Conventions& other) {
  Takes found = Takes::refused;
  for (const Scene& scene : scenes) {
    if (!can_draw(method, scene, usual) || !can_draw(method, scene, other)) continue;
    if (steps_of(method, scene, usual) != steps_of(method, scene, other)) return Takes::with_effect;
    found = Takes::without_effect;
  }
  return found;
}

constexpr Camera::Kind kinds[] = {Camera::Kind::perspective, Camera::Kind::orthographic, Camera::Kind::screen};

}  // namespace

TEST_CASE("law: a convention that a method accepts on a kind of scene makes another run, else it is refused") {
  int with = 0, refused = 0;
  for (const Camera::Kind kind : kinds) {
    const std::vector<Scene> scenes = scenes_of(kind), on_screen = scenes_of(Camera::Kind::screen);
    REQUIRE(scenes.size() >= 3);
    CAPTURE(static_cast<int>(kind));
    for (const Method& method : methods()) {
      CAPTURE(method.id);
      for_each_convention([&]<class E>(const char* key, E Conventions::*member) {
        for (std::size_t k = 0; k < words_of<E>.size(); ++k) {
          Conventions usual, other;
          if (std::string_view(key) == "rounding") usual.number_format = other.number_format = NumberFormat::fixed16;
          other.*member = static_cast<E>(k);
          if (other == usual) continue;
          CAPTURE(key);
          CAPTURE(words_of<E>[k]);
          // Which pixels on an edge are drawn matters where an edge goes through pixel centres: on the screen.
          const bool on_edges = std::string_view(key) == "coverage";
          const Takes how = taken(method, on_edges ? on_screen : scenes, usual, other);
          CHECK(how != Takes::without_effect);
          ++(how == Takes::refused ? refused : with);
        }
      });
    }
  }
  CHECK(with > 40);
  CHECK(refused > 300);
}

TEST_CASE("law: cull can be changed where that makes another run, and nowhere else") {
  std::set<std::string> with;
  for (const Camera::Kind kind : kinds) {
    const std::vector<Scene> scenes = scenes_of(kind);
    CAPTURE(static_cast<int>(kind));
    for (const Method& method : methods()) {
      CAPTURE(method.id);
      Conventions culled, drawn;
      drawn.cull = false;
      const Takes how = taken(method, scenes, culled, drawn);
      if (how == Takes::refused) continue;
      for (const Scene& scene : scenes) CHECK(can_change(method, scene, culled, "cull") == can_cull(method, scene));
      CHECK((how == Takes::with_effect) == can_cull(method, scenes.front()));
      if (how == Takes::with_effect) with.insert(std::string(method.id));
    }
  }
  CHECK(with.size() >= 8);
}

TEST_CASE("law: each word of each option of a method makes another run of some scene") {
  std::vector<Scene> scenes;
  for (const Camera::Kind kind : kinds)
    for (Scene& scene : scenes_of(kind)) scenes.push_back(std::move(scene));
  int options = 0;
  for (const Method& method : methods())
    for (const Option& option : method.options) {
      std::string_view words = option.words;
      while (!words.empty()) {
        const std::size_t bar = std::min(words.find('|'), words.size());
        const std::string word(words.substr(0, bar));
        words.remove_prefix(std::min(bar + 1, words.size()));
        if (word == option.standard) continue;
        Conventions usual, other;
        // A shade is of an attribute that is interpolated.
        if (option.name == formulas::shade_key) usual.attribute = other.attribute = Conventions::Attribute::linear;
        other.options[std::string(option.name)] = word;
        CAPTURE(method.id);
        CAPTURE(option.name);
        CAPTURE(word);
        CHECK(taken(method, scenes, usual, other) == Takes::with_effect);
        ++options;
      }
    }
  CHECK(options > 10);
}

TEST_CASE("cull = true in a scene whose points are on the screen is refused, and so is a change to it") {
  const test::Folder folder;
  const std::string file = folder.write(
      "s.toml",
      "coordinates = \"screen\"\npoints = [[0, 0, 1], [4, 0, 1], [0, 4, 1]]\n[raster]\nwidth = 5\nheight = 5\n"
      "[[polygon]]\ncorners = [0, 1, 2]\n[options]\ncull = true\n");
  std::string why;
  try {
    load_scene(file);
  } catch (const InputError& error) {
    why = error.what();
  }
  CHECK(why.find("cull needs an eye") != std::string::npos);
  Scene scene = scenes_of(Camera::Kind::screen).front();
  Conventions conventions;
  CHECK_THROWS_AS(make_change(method("z-buffer"), {"cull", "on"}, scene, conventions), InputError);
}
