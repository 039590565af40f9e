#include "algorithms/scene/scene_file/toml_text.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "algorithms/scene/scene_file/toml_depth.hpp"

namespace zstep::scene {

namespace {

bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\r'; }

/// The comments in a piece of TOML, a line each.
std::string comments_in(std::string_view piece) {
  std::string comments;
  for (std::size_t at = 0; at < piece.size();) {
    if (piece[at] == '"' || piece[at] == '\'') {
      int line = 0;
      at = skip_string(piece, at, line);
      continue;
    }
    if (piece[at] == '#') {
      const std::size_t end = std::min(piece.find('\n', at), piece.size());
      comments += std::string(piece.substr(at, end - at)) + '\n';
      at = end;
    } else {
      ++at;
    }
  }
  return comments;
}

}  // namespace

void TomlText::take(std::string text) {
  top_ = toml::parse(text);
  text_ = std::move(text);
  lines_ = {0};
  for (std::size_t at = 0; at < text_.size(); ++at)
    if (text_[at] == '\n') lines_.push_back(at + 1);
}

// Columns count characters, not bytes.
std::size_t TomlText::offset(const toml::source_position& at) const {
  std::size_t place = lines_[std::min<std::size_t>(at.line, lines_.size()) - 1];
  for (toml::source_index column = 1; column < at.column && place < text_.size(); ++column) do
      ++place;
    while (place < text_.size() && (static_cast<unsigned char>(text_[place]) & 0xC0) == 0x80);
  return place;
}

std::size_t TomlText::end_of_line(std::size_t at) const {
  std::size_t end = std::min(text_.find('\n', at), text_.size());
  if (end > at && text_[end - 1] == '\r') --end;
  return end;
}

void TomlText::apply(std::vector<Edit> edits) {
  std::stable_sort(edits.begin(), edits.end(), [](const Edit& a, const Edit& b) { return a.from < b.from; });
  std::string made;
  std::size_t at = 0;
  for (const Edit& edit : edits) {
    made += text_.substr(at, edit.from - at) + edit.text;
    at = edit.to;
  }
  take(made + text_.substr(at));
}

void TomlText::replace(const std::vector<std::pair<const toml::node*, std::string>>& values) {
  std::vector<Edit> edits;
  for (const auto& [node, value] : values) {
    const std::size_t from = offset(node->source().begin), to = offset(node->source().end);
    edits.push_back({from, to, value});
    // A comment behind it stays in its column, where it can.
    std::size_t comment = to;
    while (comment < text_.size() && is_blank(text_[comment])) ++comment;
    if (comment == text_.size() || text_[comment] != '#') continue;
    const std::size_t room = comment - to, was = to - from, is = value.size();
    if (is < was) edits.push_back({to, to, std::string(was - is, ' ')});
    else if (room > 2) edits.push_back({to, to + std::min(is - was, room - 2), ""});
  }
  apply(std::move(edits));
}

/// Before the first header and the comments right above it, unless the file begins with them.
std::size_t TomlText::first_header() const {
  std::size_t first = text_.size();
  for (const auto& [key, node] : top_) {
    const toml::array* list = node.as_array();
    const toml::table* table = list && !list->empty() ? list->front().as_table() : node.as_table();
    if (table == nullptr || table->is_inline()) continue;
    first = std::min(first, offset(table->source().begin));
  }
  while (first > 0 && text_[first - 1] != '\n') --first;
  return first;
}

void TomlText::set(const toml::table& table, std::string_view key, const std::string& value) {
  if (const toml::node* there = table.get(key)) return replace({{there, value}});
  std::size_t last = table.empty() ? end_of_line(offset(table.source().begin)) : 0;
  for (const auto& [other, node] : table)
    if (!node.is_table()) last = std::max(last, end_of_line(offset(node.source().end)));
  if (const toml::node* name = table.get("name"); name && key == "color")
    last = end_of_line(offset(name->source().end));
  apply({{last, last, fmt::format("\n{} = {}", key, value)}});
}

void TomlText::set(std::string_view name, std::string_view key, const std::string& value) {
  const toml::table* there = table(name);
  if (there && !name.empty()) return set(*there, key, value);
  if (!there) {
    std::size_t before = text_.size();
    for (const char* parts : {"polygon", "mesh", "surface"})
      if (const toml::node* node = top_.get(parts)) {
        const toml::node* part = node->is_array() && !node->as_array()->empty() ? &node->as_array()->front() : node;
        before = std::min(before, offset(part->source().begin));
      }
    // What is remarked right above a polygon stays with it.
    while (before > 0) {
      while (before > 0 && text_[before - 1] != '\n') --before;
      const std::size_t above = before < 2 ? std::string::npos : text_.rfind('\n', before - 2);
      const std::size_t line = above == std::string::npos ? 0 : above + 1;
      if (line == 0 || text_[line] != '#') break;
      before = line;
    }
    const bool at_end = before == text_.size();
    const std::string part = fmt::format("[{}]\n{} = {}\n", name, key, value);
    if (at_end) return append(part);
    return apply({{before, before, part + "\n"}});
  }
  if (const toml::node* node = top_.get(key)) return replace({{node, value}});
  std::size_t last = 0;
  for (const auto& [other, node] : top_) {
    const bool tables = node.is_table() || node.is_array_of_tables();
    if (!tables) last = std::max(last, end_of_line(offset(node.source().end)));
  }
  if (last > 0) return apply({{last, last, fmt::format("\n{} = {}", key, value)}});
  const std::size_t header = first_header();
  apply({{header, header, fmt::format("{} = {}\n\n", key, value)}});
}

void TomlText::rename(std::string_view name, std::string_view key, std::string_view other) {
  for (const auto& [there, node] : *table(name))
    if (there.str() == key) {
      const std::size_t from = offset(there.source().begin);
      return apply({{from, from + key.size(), std::string(other)}});
    }
}

/// Removes what is between two places but its comments, and its whole line where nothing else is on it.
TomlText::Edit TomlText::without(std::size_t from, std::size_t to) const {
  std::string comments = comments_in(std::string_view(text_).substr(from, to - from));
  std::size_t begin = from, end = to;
  while (begin > 0 && is_blank(text_[begin - 1])) --begin;
  while (end < text_.size() && is_blank(text_[end])) ++end;
  if (begin > 0 && text_[begin - 1] != '\n') return {from, to, comments.empty() ? "" : "\n" + comments};
  if (end == text_.size()) return {begin, end, comments};
  if (text_[end] == '\n') return {begin, end + 1, comments};
  return {begin, end, comments};  // a comment behind it
}

void TomlText::erase_entries(const toml::table& table, std::vector<Edit>& edits) const {
  for (const auto& [key, node] : table) edits.push_back(without(offset(key.source().begin), offset(node.source().end)));
}

void TomlText::erase(std::string_view name, std::string_view key) {
  const toml::table* there = table(name);
  if (there == nullptr) return;
  for (const auto& [own, node] : *there)
    if (own.str() == key) return apply({without(offset(own.source().begin), offset(node.source().end))});
}

void TomlText::erase_tables(std::string_view name) {
  const toml::node* node = top_.get(name);
  if (node == nullptr) return;
  std::vector<Edit> edits;
  const auto erase_one = [&](const toml::table& table, std::string_view close) {
    const std::size_t from = offset(table.source().begin);
    edits.push_back(without(from, text_.find(close, from) + close.size()));
    erase_entries(table, edits);
  };
  const toml::array* list = node->as_array();
  if (list == nullptr && !node->as_table()->is_inline()) {
    erase_one(*node->as_table(), "]");
  } else if (list == nullptr || list->empty() || !list->front().is_table() || list->front().as_table()->is_inline()) {
    return erase("", name);
  } else {
    for (const toml::node& one : *list) erase_one(*one.as_table(), "]]");
  }
  apply(std::move(edits));
  // Where tables were, one empty line is enough.
  std::string made;
  for (std::size_t at = 0; at < text_.size(); ++at)
    if (text_[at] != '\n' || !made.ends_with("\n\n")) made += text_[at];
  take(std::move(made));
}

void TomlText::append(const std::string& part) {
  std::string made = text_;
  if (!made.empty() && !made.ends_with('\n')) made += '\n';
  if (!made.empty() && !made.ends_with("\n\n")) made += '\n';
  take(made + part);
}

}  // namespace zstep::scene
