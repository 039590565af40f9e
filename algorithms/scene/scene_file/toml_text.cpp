#include "algorithms/scene/scene_file/toml_text.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <sstream>
#include <utility>

#include "algorithms/scene/files/tokens.hpp"
#include "traces/error.hpp"
#include "traces/scene.hpp"
#include "traces/text.hpp"

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
    while (place < text_.size() && continues_character(text_[place]));
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
    point[index32(i)] = number_in((*list)[i], file, fmt::format("{} of {}", "xyz"[i], what));
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
  return found - words.begin();
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

std::size_t skip_string(std::string_view text, std::size_t at, int& line) {
  const char quote = text[at];
  const bool escapes = quote == '"';
  const std::string triple(3, quote);
  if (text.substr(at, 3) == triple) {
    for (at += 3; at < text.size() && text.substr(at, 3) != triple; ++at) {
      if (text[at] == '\n') ++line;
      if (escapes && text[at] == '\\' && at + 1 < text.size() && text[at + 1] != '\n') ++at;
    }
    at += 3;
    // Up to two more quotes belong to the string itself ("""a""""").
    for (int extra = 0; extra < 2 && at < text.size() && text[at] == quote; ++extra) ++at;
    return at;
  }
  for (++at; at < text.size() && text[at] != quote && text[at] != '\n'; ++at)
    if (escapes && text[at] == '\\' && at + 1 < text.size() && text[at + 1] != '\n') ++at;
  return at < text.size() && text[at] == quote ? at + 1 : at;
}

void check_toml_depth(std::string_view text, const std::string& name, int first_line) {
  constexpr int most_parts = 32;
  int line = first_line, dots = 0;
  for (std::size_t at = 0; at < text.size();) {
    switch (text[at]) {
      case '"':
      case '\'':
        at = skip_string(text, at, line);
        continue;
      case '#':
        while (at < text.size() && text[at] != '\n') ++at;
        continue;
      case '\n':
        ++line;
        dots = 0;
        break;
      case '=':
      case ',':
      case '{':
      case '}':
      case '[':
      case ']':
        dots = 0;
        break;
      case '.':
        if (++dots >= most_parts)
          throw InputError(fmt::format("{}:{}", name, line), fmt::format("a key has more than {} parts", most_parts),
                           "a key of a scene has one part, as in: rho = 4");
        break;
      default:
        break;
    }
    ++at;
  }
}

}  // namespace zstep::scene
