#include "traces/file/json_text.hpp"

#include <algorithm>
#include <array>
#include <optional>
#include <set>
#include <vector>

#include <fmt/format.h>

#include "traces/text.hpp"

namespace zstep::json_text {

using nlohmann::json;

namespace {

constexpr std::string_view spaces = " \t\r\n";
bool is_space(char c) { return spaces.find(c) != std::string_view::npos; }
bool is_word(char c) { return is_letter(c) || is_digit(c) || c == '_' || c == '.' || c == '+' || c == '-'; }

/// Goes through a text that is JSON.
struct Walk {
  std::string_view text;
  std::size_t at = 0;

  void skip_spaces() {
    while (at < text.size() && is_space(text[at])) ++at;
  }
  char here() const { return at < text.size() ? text[at] : '\0'; }
  /// The string that begins here, with its quotes.
  std::string_view take_string() {
    const std::size_t begin = at++;
    for (; at < text.size() && text[at] != '"'; ++at)
      if (text[at] == '\\') ++at;
    at = std::min(at + 1, text.size());
    return text.substr(begin, at - begin);
  }
  void skip_value() {
    int depth = 0;
    do {
      skip_spaces();
      const char c = here();
      if (c == '"') {
        take_string();
      } else if (c == '{' || c == '[') {
        ++depth, ++at;
      } else if (c == '}' || c == ']') {
        --depth, ++at;
      } else if (c == ',' || c == ':') {
        ++at;
      } else {
        const std::size_t begin = at;
        while (at < text.size() && is_word(text[at])) ++at;
        if (at == begin) ++at;
      }
    } while (depth > 0 && at < text.size());
  }
};

struct Part {
  std::string key;
  std::size_t number = 0;  ///< in a list
};

/// Which way leads from a value to one of those in it.
bool find_way(const json& from, const json* wanted, std::vector<Part>& way) {
  if (&from == wanted) return true;
  if (!from.is_structured()) return false;
  std::size_t number = 0;
  for (const auto& item : from.items()) {
    way.push_back({from.is_object() ? item.key() : std::string(), number++});
    if (find_way(item.value(), wanted, way)) return true;
    way.pop_back();
  }
  return false;
}

/// Goes on from an object to its member's value. Where its key stands; nothing if there is no such member.
std::optional<std::size_t> enter_member(Walk& walk, std::string_view key) {
  const std::size_t object = walk.at;
  for (++walk.at; walk.at < walk.text.size();) {
    walk.skip_spaces();
    if (walk.here() != '"') {
      if (walk.here() == '}') break;
      ++walk.at;
      continue;
    }
    const std::size_t begin = walk.at;
    const json name = json::parse(walk.take_string(), nullptr, false);
    walk.skip_spaces();
    ++walk.at;  // the colon
    walk.skip_spaces();
    if (name.is_string() && name.get_ref<const std::string&>() == key) return begin;
    walk.skip_value();
  }
  walk.at = object;
  return std::nullopt;
}

bool enter_number(Walk& walk, std::size_t number) {
  ++walk.at;
  for (std::size_t k = 0;; ++k) {
    walk.skip_spaces();
    if (walk.at >= walk.text.size()) return false;
    if (k == number) return true;
    walk.skip_value();
    walk.skip_spaces();
    ++walk.at;  // the comma
  }
}

std::size_t members_in(const json& document) {
  if (!document.is_structured()) return 0;
  std::size_t members = document.is_object() ? document.size() : 0;
  for (const json& value : document) members += members_in(value);
  return members;
}
std::size_t members_in(std::string_view text) {
  std::size_t members = 0;
  for (Walk walk{text, 0}; walk.at < text.size();) {
    if (walk.here() == '"') {
      walk.take_string();
      continue;
    }
    if (walk.here() == ':') ++members;
    ++walk.at;
  }
  return members;
}

/// The word around a place, as NaN or -Infinity.
std::string_view word_around(std::string_view text, std::size_t& place) {
  std::size_t end = place;
  while (place > 0 && is_word(text[place - 1])) --place;
  while (end < text.size() && is_word(text[end])) ++end;
  return text.substr(place, end - place);
}

constexpr const char* by_dumps = "print json.dumps(event), and not the event itself";

/// A word that is no JSON; nothing where it might be.
std::optional<Fault> fault_of_word(std::string_view text, std::size_t begin, std::string_view word) {
  const std::string low = lower_case(word);
  const std::string_view bare = std::string_view(low).substr(low.find_first_not_of("+-") == 1 ? 1 : 0);
  const auto fault = [&](std::string what, std::string mend) {
    return Fault{begin, false, std::move(what), std::move(mend)};
  };
  if (bare == "nan") return fault(fmt::format("{} is no number of JSON's", word), "write \"nan\", in quotes");
  if (bare == "inf" || bare == "infinity")
    return fault(fmt::format("{} is no number of JSON's", word),
                 fmt::format("write \"{}\", in quotes", low[0] == '-' ? "-inf" : "inf"));
  if (low == "true" || low == "false")
    return fault(fmt::format("{} is Python's, and JSON has {}", word, low), by_dumps);
  if (low == "none" || low == "undefined" || low == "nil")
    return fault(fmt::format("{} is no value of JSON's", word),
                 "give every field its value; a number that is none is \"nan\"");
  std::size_t after = begin + word.size();
  while (after < text.size() && is_space(text[after])) ++after;
  const bool named = !word.empty() && !is_digit(word[0]) && after < text.size() && text[after] == ':';
  if (named) return fault(fmt::format("the name {} has no quotes", word), fmt::format("write \"{}\"", word));
  const bool number = !bare.empty() && (is_digit(bare[0]) || bare[0] == '.');
  if (number) return fault(fmt::format("{} is no number as JSON writes it", word), "write it as 0.5, -3 or 1e-07");
  return std::nullopt;
}

char before(std::string_view text, std::size_t place) {
  while (place > 0 && is_space(text[place - 1])) --place;
  return place > 0 ? text[place - 1] : '\0';
}

/// Where the string begins that ends at this place; the place itself where none does.
std::size_t begin_of_string(std::string_view text, std::size_t place) {
  for (Walk walk{text, 0}; walk.at <= place;) {
    const std::size_t begin = walk.at;
    if (walk.here() != '"') ++walk.at;
    else if (walk.take_string(); walk.at == place + 1) return begin;
  }
  return place;
}

/// What stands behind a whole object.
Fault fault_behind(std::string_view text, std::size_t place) {
  if (text[place] == '{' || text[place] == '[')
    return {place, false, "a second object begins on the line", "begin a new line after each }"};
  if (text[place] == ',')
    return {place, false, "a comma stands behind the object", "write one object a line, without commas between"};
  return {place, false, fmt::format("\"{}\" stands behind the object", shown(text.substr(place), 24)),
          "write one object a line, and nothing else"};
}

}  // namespace

std::size_t place_of(std::string_view text, const json& document, const json* value, std::string_view key) {
  std::vector<Part> way;
  if (value == nullptr || !find_way(document, value, way)) return 0;
  Walk walk{text, 0};
  walk.skip_spaces();
  for (const Part& part : way) {
    const bool found = walk.here() == '{' ? enter_member(walk, part.key).has_value()
                                          : walk.here() == '[' && enter_number(walk, part.number);
    if (!found) return 0;
  }
  if (!key.empty() && walk.here() == '{') {
    const std::size_t object = walk.at;
    return enter_member(walk, key).value_or(object);
  }
  return walk.at;
}

std::optional<RepeatedKey> repeated_key(std::string_view text, const json& document) {
  if (members_in(text) == members_in(document)) return std::nullopt;  // as nearly always
  std::vector<std::set<std::string>> keys;                            // of the objects and lists around
  for (Walk walk{text, 0}; walk.at < text.size();) {
    const char c = walk.here();
    if (c == '{' || c == '[') keys.emplace_back();
    if (c == '}' || c == ']') keys.pop_back();
    if (c != '"') {
      ++walk.at;
      continue;
    }
    const std::size_t begin = walk.at;
    const std::string_view written = walk.take_string();
    walk.skip_spaces();
    if (walk.here() != ':') continue;  // a value
    const auto [key, is_new] = keys.back().insert(json::parse(written).get<std::string>());
    if (!is_new) return RepeatedKey{begin, *key};
  }
  return std::nullopt;
}

Fault fault_at(std::string_view text, std::size_t place) {
  while (!text.empty() && is_space(text.back())) text.remove_suffix(1);
  Walk whole{text, 0};
  whole.skip_spaces();
  if (whole.here() != '{' && whole.here() != '[')
    return {whole.at, false, fmt::format("\"{}\" is not JSON", shown(text.substr(whole.at), 40)),
            "write one JSON object a line"};
  if (place >= text.size())
    return {text.size(), true, "the line ends within an object", "write each object on one line, to its last }"};
  if (open_brackets(text.substr(0, place)) == 0 && whole.at < place) return fault_behind(text, place);
  if (text[place] == '\'')
    return {place, false, "a text stands in single quotes", fmt::format("JSON has double ones: {}", by_dumps)};
  std::size_t begin = place;
  if (is_word(text[place])) {
    const std::string_view word = word_around(text, begin);
    const bool decimal_comma = before(text, begin) == ',' && begin >= 2 && text[begin - 1] == ',' &&
                               is_digit(text[begin - 2]) && is_digit(word[0]);
    if (decimal_comma) return {begin - 1, false, "a number is written with a comma", "write a point: 0.5"};
    if (auto fault = fault_of_word(text, begin, word)) return *fault;
  }
  if (text[place] == '"') {
    begin = begin_of_string(text, place);
    if (std::string_view("{[,:").find(before(text, begin)) == std::string_view::npos)
      return {begin, false, fmt::format("a comma or a colon is missing before {}", shown(text.substr(begin), 24)),
              "put it there: {\"x\": 1, \"y\": 2}"};
  }
  if ((text[place] == '}' || text[place] == ']') && before(text, place) == ',')
    return {place, false, fmt::format("a comma stands before {}", text[place]), "leave it out"};
  if (text[place] == '/' || text[place] == '#') return {place, false, "JSON has no comments", "leave it out"};
  if (byte_of(text[place]) < 0x20)
    return {place, false, "a text holds a control character", "write it as \\n, \\t or \\u001b"};
  if (is_beyond_ascii(text[place]))
    return {place, false, "a character is not UTF-8, or stands outside quotes", "save the file as UTF-8"};
  return {place, false, fmt::format("is not JSON from \"{}\" on", shown(text.substr(place), 24)),
          "write one JSON object a line"};
}

bool goes_on(std::string_view next_line) {
  return !next_line.empty() && (is_space(next_line.front()) || next_line.front() == '"' || next_line.front() == '}' ||
                                next_line.front() == ']');
}

int open_brackets(std::string_view text) {
  int open = 0;
  for (Walk walk{text, 0}; walk.at < text.size();) {
    const char c = walk.here();
    if (c == '"') {
      walk.take_string();
      continue;
    }
    open += c == '{' || c == '[' ? 1 : c == '}' || c == ']' ? -1 : 0;
    ++walk.at;
  }
  return open;
}

LineColumn line_and_column(std::string_view text, std::size_t place, std::int64_t line) {
  LineColumn found{line, 1};
  for (const char c : text.substr(0, place)) {
    if (c == '\n') ++found.line, found.column = 1;
    else if (!continues_character(c)) ++found.column;
  }
  return found;
}

std::string shown(std::string_view text, std::size_t most) {
  std::size_t end = 0;
  for (std::size_t characters = 0; end < text.size(); ++end)
    if (!continues_character(text[end]) && characters++ == most) break;
  return printable(text.substr(0, end)) + (end < text.size() ? "\u2026" : "");
}

}  // namespace zstep::json_text
