// The text of a TOML file, changed at the places where its values stand, so that comments, order and spacing stay.
#pragma once

#include <glm/vec3.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <toml++/toml.h>
#include <utility>
#include <vector>

namespace zstep::scene {

class TomlText {
 public:
  /// Throws toml::parse_error.
  explicit TomlText(std::string text) { take(std::move(text)); }

  const std::string& text() const { return text_; }
  const toml::table& top() const { return top_; }  ///< of the text as it is now: each change reads it anew
  const toml::table* table(std::string_view name) const { return name.empty() ? &top_ : top_[name].as_table(); }

  /// Replaces values of the table, each by a text as TOML writes it; all of them at once, as the text moves.
  void replace(const std::vector<std::pair<const toml::node*, std::string>>& values);
  /// Sets key = value in [table], or at the top of the file where `table` is ""; adds the table and the key if missing.
  void set(std::string_view table, std::string_view key, const std::string& value);
  /// The same in this table, which has a header of its own.
  void set(const toml::table& table, std::string_view key, const std::string& value);
  void rename(std::string_view table, std::string_view key, std::string_view name);
  /// Removes a key and its value; comments in it stay.
  void erase(std::string_view table, std::string_view key);
  /// Removes a [table], or all [[tables]] of this name; their comments stay.
  void erase_tables(std::string_view name);
  /// Adds a part at the end, after an empty line.
  void append(const std::string& part);

 private:
  struct Edit {
    std::size_t from, to;
    std::string text;
  };
  void take(std::string text);
  void apply(std::vector<Edit> edits);
  std::size_t offset(const toml::source_position& at) const;
  Edit without(std::size_t from, std::size_t to) const;
  void erase_entries(const toml::table& table, std::vector<Edit>& edits) const;
  std::size_t end_of_line(std::size_t at) const;
  std::size_t first_header() const;

  std::string text_;
  toml::table top_;
  std::vector<std::size_t> lines_;  ///< where each begins
};

// A TOML table whose keys are all accounted for: what a scene file says that zstep does not know is an error.

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

// A guard in front of toml++, and the scan that it shares with those who look into a file's text.

/// toml++ nests a table for every part of a dotted key (a.b.c) and follows them by recursion, so a long enough key
/// overflows the stack (toml++ 3.3: a hundred thousand parts; arrays and inline tables it limits itself). Throws
/// InputError at FILE:LINE when a key has more than 32 parts; `first_line` numbers the first line of `text`.
void check_toml_depth(std::string_view text, const std::string& name, int first_line = 1);

/// The end of the string that opens at `at`; strings of one line end with their line at the latest. Counts the lines
/// that it passes.
std::size_t skip_string(std::string_view text, std::size_t at, int& line);

}  // namespace zstep::scene
