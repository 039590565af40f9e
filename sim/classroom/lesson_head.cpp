#include "sim/classroom/lesson_head.hpp"

#include <array>
#include <cmath>
#include <utility>

#include <fmt/core.h>
#include <toml++/toml.h>

#include "algorithms/scene/scene_file/toml_text.hpp"
#include "sim/classroom/evaluate.hpp"
#include "traces/error.hpp"

namespace zstep::classroom {
namespace {

struct Head {
  const std::string& file;
  std::int32_t first_line;

  std::string at(const toml::source_region& source) const {
    return fmt::format("{}:{}", file, static_cast<std::int64_t>(source.begin.line) + first_line - 1);
  }

  void known_keys(const toml::table& table, std::string_view what, const std::vector<std::string_view>& keys) const {
    for (const auto& [key, value] : table) {
      const std::string_view name = key.str();
      bool known = false;
      std::string list;
      for (const std::string_view candidate : keys) {
        known = known || name == candidate;
        list += (list.empty() ? "" : ", ") + std::string(candidate);
      }
      if (!known) {
        throw InputError(at(key.source()), fmt::format("{} has no `{}`{}", what, name, did_you_mean(name, keys)),
                         "it may have " + list);
      }
    }
  }

  void text(const toml::table& table, std::string_view key, std::string& into) const {
    const toml::node* node = table.get(key);
    if (!node || !node->is_string() || node->as_string()->get().empty()) {
      throw InputError(node ? at(node->source()) : fmt::format("{}:{}", file, first_line),
                       fmt::format("the head needs a text for `{}`", key), fmt::format("write {} = \"…\"", key));
    }
    into = node->as_string()->get();
  }
  void number(const toml::table& table, std::string_view key, std::optional<double>& into) const {
    const toml::node* node = table.get(key);
    if (!node) return;
    const auto value = node->value<double>();
    if (!value || node->is_boolean() || !std::isfinite(*value)) {
      throw InputError(at(node->source()), fmt::format("`{}` is no number", key), fmt::format("write {} = 4", key));
    }
    into = *value;
  }
  void size(const toml::table& table, std::string_view key, std::optional<std::int32_t>& into) const {
    const toml::node* node = table.get(key);
    if (!node) return;
    const auto value = node->is_integer() ? node->value<std::int64_t>() : std::nullopt;
    if (!value || *value < 1 || *value > 4096) {
      throw InputError(at(node->source()), fmt::format("`{}` is no number of pixels", key),
                       fmt::format("write {} = 16; at most 4096", key));
    }
    into = static_cast<std::int32_t>(*value);
  }
  std::optional<bool> truth(const toml::table& table, std::string_view key) const {
    const toml::node* node = table.get(key);
    if (!node) return std::nullopt;
    if (!node->is_boolean())
      throw InputError(at(node->source()), fmt::format("`{}` is no truth", key),
                       fmt::format("write {} = true or false", key));
    return node->as_boolean()->get();
  }
  template <std::size_t N>
  void word(const toml::table& table, std::string_view key, const std::array<std::string_view, N>& words,
            ConventionChoices& into) const {
    const toml::node* node = table.get(key);
    if (!node) return;
    std::string list;
    for (const std::string_view word : words) {
      if (node->is_string() && node->as_string()->get() == word) into.words[std::string(key)] = word;
      list += fmt::format("{}\"{}\"", list.empty() ? "" : " or ", word);
    }
    if (!into.words.contains(key))
      throw InputError(at(node->source()), fmt::format("`{}` has a value it does not know", key),
                       fmt::format("write {} = {}", key, list));
  }
  const toml::table& table(const toml::table& all, std::string_view key) const {
    static const toml::table none;
    const toml::node* node = all.get(key);
    if (!node) return none;
    if (!node->is_table())
      throw InputError(at(node->source()), fmt::format("`{}` is no table", key),
                       fmt::format("write [{}] on a line of its own", key));
    return *node->as_table();
  }
};

}  // namespace

void read_lesson_head(Lesson& lesson, const std::string& file, std::string_view head, std::int32_t line) {
  const Head read{file, line};
  scene::check_toml_depth(head, file, line);
  toml::table all;
  try {
    all = toml::parse(head);
  } catch (const toml::parse_error& error) {
    throw InputError(read.at(error.source()), fmt::format("the head is no TOML: {}", error.description()),
                     "write key = value lines");
  }
  read.known_keys(all, "a lesson's head",
                  {"title", "summary", "theme", "scene", "method", "camera", "raster", "conventions", "options"});
  read.text(all, "title", lesson.title);
  read.text(all, "summary", lesson.summary);
  if (all.contains("theme")) read.text(all, "theme", lesson.theme);
  read.text(all, "scene", lesson.scene);
  read.text(all, "method", lesson.method);

  const toml::table& camera = read.table(all, "camera");
  read.known_keys(camera, "[camera]", {"rho", "theta", "phi", "d", "window", "near", "far", "orthographic", "fit"});
  ViewOptions& view = lesson.view;
  read.number(camera, "rho", view.rho);
  read.number(camera, "theta", view.theta);
  read.number(camera, "phi", view.phi);
  read.number(camera, "d", view.d);
  read.number(camera, "window", view.window);
  read.number(camera, "near", view.near);
  read.number(camera, "far", view.far);
  view.orthographic = read.truth(camera, "orthographic");
  view.fit = read.truth(camera, "fit").value_or(false);

  const toml::table& raster = read.table(all, "raster");
  read.known_keys(raster, "[raster]", {"width", "height"});
  read.size(raster, "width", view.width);
  read.size(raster, "height", view.height);

  const toml::table& conventions = read.table(all, "conventions");
  read.known_keys(
      conventions, "[conventions]",
      {"depth", "interpolation", "coverage", "number_format", "rounding", "positions", "attribute", "cull"});
  for_each_convention([&]<class E>(std::string_view key, E Conventions::*) {
    read.word(conventions, key, words_of<E>, lesson.conventions.choices);
  });
  lesson.conventions.cull = read.truth(conventions, "cull");

  for (const auto& [name, value] : read.table(all, "options")) {
    if (!value.is_string())
      throw InputError(read.at(value.source()), fmt::format("the option `{}` is no text", name.str()),
                       fmt::format("write {} = \"…\", with a value as 'zstep list options' names them", name.str()));
    lesson.conventions.options[std::string(name.str())] = value.as_string()->get();
  }
}

}  // namespace zstep::classroom
