// A TOML table whose keys are all accounted for: what a scene file says that zstep does not know is an error.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <glm/vec3.hpp>
#include <toml++/toml.h>

namespace zstep::scene {

/// Throws InputError at the line of `node`.
[[noreturn]] void fail_at(const toml::node& node, const std::string& file, std::string_view what,
                          std::string_view mend);

/// The line of `node`.
std::int32_t line_of(const toml::node& node);

/// "did you mean 'rho'?", or the list of all candidates if none is close.
std::string suggestion(std::string_view word, const std::vector<std::string_view>& candidates);

/// A finite number (whole or not) of absolute value at most largest_coordinate.
double number_in(const toml::node& node, const std::string& file, std::string_view what);
/// [x, y, z]; with `flat` also [x, y].
glm::dvec3 point_in(const toml::node& node, const std::string& file, std::string_view what, bool flat = false);

/// Reads a table key by key. Each get_… makes its key a known one; finish() refuses the keys that were never asked for.
class Keys {
 public:
  /// `title` is what errors call the table: "[camera]".
  Keys(const toml::table& table, const std::string& file, std::string title);

  bool has(std::string_view key) { return find(key) != nullptr; }
  const toml::node* find(std::string_view key);
  std::optional<double> number(std::string_view key);
  std::optional<double> positive(std::string_view key);
  std::optional<std::int32_t> whole(std::string_view key, std::int32_t least, std::int32_t most);
  std::optional<bool> boolean(std::string_view key);
  std::optional<std::string> text(std::string_view key);
  std::optional<glm::dvec3> point(std::string_view key);
  const toml::table* table(std::string_view key);
  const toml::array* array(std::string_view key);
  /// One of `words`: its index.
  std::optional<std::size_t> choice(std::string_view key, const std::vector<std::string_view>& words);
  /// Throws InputError if both keys stand there.
  void not_both(std::string_view key, std::string_view other, std::string_view why);
  void finish() const;

 private:
  const toml::table& table_;
  const std::string& file_;
  std::string title_;
  std::vector<std::string_view> known_;
};

}  // namespace zstep::scene
