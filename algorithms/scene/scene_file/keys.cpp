#include "algorithms/scene/scene_file/keys.hpp"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "algorithms/scene/files/number.hpp"
#include "algorithms/scene/files/tokens.hpp"
#include "traces/error.hpp"
#include "traces/near_word.hpp"

namespace zstep::scene {

namespace {

std::string_view kind_of(const toml::node& node) {
  switch (node.type()) {
    case toml::node_type::table:
      return "a table";
    case toml::node_type::array:
      return "a list";
    case toml::node_type::string:
      return "a text";
    case toml::node_type::integer:
      return "a whole number";
    case toml::node_type::floating_point:
      return "a number";
    case toml::node_type::boolean:
      return "true or false";
    default:
      return "a date or time";
  }
}

}  // namespace

std::int32_t line_of(const toml::node& node) { return static_cast<std::int32_t>(node.source().begin.line); }

void fail_at(const toml::node& node, const std::string& file, std::string_view what, std::string_view mend) {
  throw InputError(fmt::format("{}:{}", file, line_of(node)), what, mend);
}

std::string suggestion(std::string_view word, const std::vector<std::string_view>& candidates) {
  if (const std::string_view best = near_word(word, candidates); !best.empty())
    return fmt::format("did you mean '{}'?", best);
  return fmt::format("known are: {}", fmt::join(candidates, ", "));
}

double number_in(const toml::node& node, const std::string& file, std::string_view what) {
  const auto value = node.is_number() ? node.value<double>() : std::nullopt;
  if (!value) fail_at(node, file, fmt::format("{} is {}", what, kind_of(node)), "write a number");
  if (!(std::abs(*value) <= largest_coordinate))
    fail_at(node, file, fmt::format("{} is {}", what, *value),
            fmt::format("write a number up to {}", largest_coordinate));
  return *value;
}

glm::dvec3 point_in(const toml::node& node, const std::string& file, std::string_view what, bool flat) {
  const toml::array* list = node.as_array();
  if (list == nullptr || !(list->size() == 3 || (flat && list->size() == 2)))
    fail_at(node, file, fmt::format("{} is not a point", what), flat ? "write [x, y, z] or [x, y]" : "write [x, y, z]");
  glm::dvec3 point(0);
  for (std::size_t i = 0; i < list->size(); ++i)
    point[static_cast<int>(i)] = number_in((*list)[i], file, fmt::format("{} of {}", "xyz"[i], what));
  return point;
}

Keys::Keys(const toml::table& table, const std::string& file, std::string title)
    : table_(table), file_(file), title_(std::move(title)) {}

const toml::node* Keys::find(std::string_view key) {
  known_.push_back(key);
  return table_.get(key);
}

std::optional<double> Keys::number(std::string_view key) {
  const toml::node* node = find(key);
  if (node == nullptr) return std::nullopt;
  return number_in(*node, file_, key);
}

std::optional<double> Keys::positive(std::string_view key) {
  const auto value = number(key);
  if (value && !(*value > 0))
    fail_at(*table_.get(key), file_, fmt::format("{} is {}", key, *value), "it must be greater than 0");
  return value;
}

std::optional<std::int32_t> Keys::whole(std::string_view key, std::int32_t least, std::int32_t most) {
  const toml::node* node = find(key);
  if (node == nullptr) return std::nullopt;
  const auto value = node->is_integer() ? node->value<std::int64_t>() : std::nullopt;
  if (!value || *value < least || *value > most)
    fail_at(*node, file_, fmt::format("{} is not a whole number from {} to {}", key, least, most), "correct it");
  return static_cast<std::int32_t>(*value);
}

std::optional<bool> Keys::boolean(std::string_view key) {
  const toml::node* node = find(key);
  if (node == nullptr) return std::nullopt;
  if (!node->is_boolean()) fail_at(*node, file_, fmt::format("{} is {}", key, kind_of(*node)), "write true or false");
  return node->value<bool>();
}

std::optional<std::string> Keys::text(std::string_view key) {
  const toml::node* node = find(key);
  if (node == nullptr) return std::nullopt;
  if (!node->is_string())
    fail_at(*node, file_, fmt::format("{} is {}", key, kind_of(*node)), "write a text in \"quotes\"");
  return node->value<std::string>();
}

std::optional<glm::dvec3> Keys::point(std::string_view key) {
  const toml::node* node = find(key);
  if (node == nullptr) return std::nullopt;
  return point_in(*node, file_, key);
}

const toml::table* Keys::table(std::string_view key) {
  const toml::node* node = find(key);
  if (node == nullptr) return nullptr;
  if (!node->is_table())
    fail_at(*node, file_, fmt::format("{} is {}", key, kind_of(*node)), fmt::format("write it as a table: [{}]", key));
  return node->as_table();
}

const toml::array* Keys::array(std::string_view key) {
  const toml::node* node = find(key);
  if (node == nullptr) return nullptr;
  if (!node->is_array()) fail_at(*node, file_, fmt::format("{} is {}", key, kind_of(*node)), "write a list: [ …, … ]");
  return node->as_array();
}

std::optional<std::size_t> Keys::choice(std::string_view key, const std::vector<std::string_view>& words) {
  const auto word = text(key);
  if (!word) return std::nullopt;
  const auto found = std::find(words.begin(), words.end(), *word);
  if (found == words.end())
    fail_at(*table_.get(key), file_, fmt::format("{} is {}", key, in_quotes(*word)), suggestion(*word, words));
  return static_cast<std::size_t>(found - words.begin());
}

void Keys::not_both(std::string_view key, std::string_view other, std::string_view why) {
  if (has(key) && has(other))
    fail_at(*table_.get(other), file_, fmt::format("{} has both '{}' and '{}'", title_, key, other), why);
}

void Keys::finish() const {
  for (const auto& [key, node] : table_) {
    if (std::find(known_.begin(), known_.end(), key.str()) != known_.end()) continue;
    std::vector<std::string_view> candidates;
    for (const std::string_view k : known_)
      if (std::find(candidates.begin(), candidates.end(), k) == candidates.end()) candidates.push_back(k);
    throw InputError(fmt::format("{}:{}", file_, key.source().begin.line),
                     fmt::format("unknown key {} in {}", in_quotes(key.str()), title_),
                     suggestion(key.str(), candidates));
  }
}

}  // namespace zstep::scene
