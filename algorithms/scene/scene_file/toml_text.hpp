// The text of a TOML file, changed at the places where its values stand, so that comments, order and spacing stay.
#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <toml++/toml.h>

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

}  // namespace zstep::scene
