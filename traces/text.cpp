#include "traces/text.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <map>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "traces/file/header.hpp"
#include "traces/scene.hpp"

namespace zstep {

namespace {

struct Letter {
  std::uint32_t code = 0;
  std::size_t bytes = 0;  ///< 0: they are no UTF-8
};

Letter letter_at(std::string_view text) {
  const auto byte = [&](std::size_t k) { return std::uint32_t{byte_of(text[k])}; };
  const std::uint32_t first = byte(0);
  if (first < 0x80) return {first, 1};
  const std::size_t bytes = first < 0xc2 ? 0 : first < 0xe0 ? 2 : first < 0xf0 ? 3 : first < 0xf5 ? 4 : 0;
  if (bytes == 0 || bytes > text.size()) return {};
  std::uint32_t code = first & (0xffu >> (bytes + 1));
  for (std::size_t k = 1; k < bytes; ++k) {
    if ((byte(k) & 0xc0u) != 0x80u) return {};
    code = code << 6 | (byte(k) & 0x3fu);
  }
  const bool shortest = bytes < 3 || code >= (bytes == 3 ? 0x800u : 0x10000u);
  const bool exists = code < 0xd800 || (code > 0xdfff && code <= 0x10ffff);
  return shortest && exists ? Letter{code, bytes} : Letter{};
}

bool acts(std::uint32_t code) {
  const auto within = [code](std::uint32_t first, std::uint32_t last) { return code >= first && code <= last; };
  return code < 0x20 || within(0x7f, 0x9f) || code == 0x061c || within(0x200e, 0x200f) || within(0x2028, 0x202e) ||
         within(0x2066, 0x2069) || code == 0xfeff;
}

bool is_plain(char c) { return c >= ' ' && c < 0x7f; }

enum class Form { one_line, lines, json };

std::string escaped(std::string_view text, Form form) {
  const auto first = std::find_if_not(text.begin(), text.end(), is_plain);
  std::string out(text.begin(), first);
  text.remove_prefix(out.size());
  while (!text.empty()) {
    const Letter letter = letter_at(text);
    if (letter.bytes == 0) out += fmt::format("\\x{:02x}", byte_of(text[0]));
    else if (!acts(letter.code) || (form != Form::one_line && (letter.code == '\n' || letter.code == '\t')))
      out += text.substr(0, letter.bytes);
    else if (form == Form::json) out += fmt::format("\\u{:04x}", letter.code);
    else if (letter.code == '\n') out += "\\n";
    else if (letter.code == '\t') out += "\\t";
    else if (letter.code == '\r') out += "\\r";
    else if (letter.code < 0x80) out += fmt::format("\\x{:02x}", letter.code);
    else out += fmt::format("\\u{:04x}", letter.code);
    text.remove_prefix(letter.bytes == 0 ? 1 : letter.bytes);
  }
  return out;
}

}  // namespace

std::string printable(std::string_view text) { return escaped(text, Form::one_line); }
std::string printable_lines(std::string_view text) { return escaped(text, Form::lines); }
std::string printable_json(std::string_view json) { return escaped(json, Form::json); }

namespace {

void mend(std::string& text) {
  if (!std::all_of(text.begin(), text.end(), is_plain)) text = printable(text);
}

}  // namespace

void make_printable(Header& header) {
  for (std::string* text : {&header.writer, &header.algorithm, &header.title}) mend(*text);
  for (StepInfo& step : header.page)
    for (std::string* text : {&step.module, &step.name, &step.text}) mend(*text);
  std::map<std::string, std::string> options;
  for (const auto& [name, value] : header.conventions.options) options.emplace(printable(name), printable(value));
  header.conventions.options = std::move(options);
}

void make_printable(Scene& scene) {
  mend(scene.name);
  mend(scene.source);
  for (Polygon& polygon : scene.polygons)
    if (!polygon.name.is_usual()) polygon.name = printable(*polygon.name);
  for (auto& placement : scene.placements) mend(placement.source);
  if (scene.surface) mend(scene.surface->formula);
  for (VertexAttribute& attribute : scene.attributes) mend(attribute.name);
  for (Texture& texture : scene.textures) mend(texture.source);
}

namespace {

constexpr std::size_t longest_word = 64;  // nobody mistypes a word of a kilobyte

/// Insertions, deletions, substitutions and swaps of neighbours that lead from one word to the other.
std::size_t distance(std::string_view a, std::string_view b) {
  const std::size_t columns = b.size() + 1;
  std::vector<std::size_t> table((a.size() + 1) * columns);
  const auto at = [&](std::size_t i, std::size_t j) -> std::size_t& { return table[i * columns + j]; };
  for (std::size_t i = 0; i <= a.size(); ++i) at(i, 0) = i;
  for (std::size_t j = 0; j <= b.size(); ++j) at(0, j) = j;
  for (std::size_t i = 1; i <= a.size(); ++i) {
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t other = a[i - 1] == b[j - 1] ? 0 : 1;
      at(i, j) = std::min({at(i - 1, j) + 1, at(i, j - 1) + 1, at(i - 1, j - 1) + other});
      if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1])
        at(i, j) = std::min(at(i, j), at(i - 2, j - 2) + 1);
    }
  }
  return table.back();
}

std::string bare(std::string_view word) {
  while (!word.empty() && word.front() == '-') word.remove_prefix(1);
  return lower_case(word);
}

}  // namespace

std::string lower_case(std::string_view text) {
  std::string result(text);
  for (char& c : result) c = lower_case(c);
  return result;
}

std::string with_capital(std::string text) {
  if (!text.empty()) text[0] = upper_case(text[0]);
  return text;
}

std::size_t word_distance(std::string_view word, std::string_view other) {
  return distance(bare(word.substr(0, longest_word)), bare(other.substr(0, longest_word)));
}

std::string_view near_word(std::string_view word, std::span<const std::string_view> known) {
  if (word.size() > longest_word) return {};
  const std::string typed = bare(word);
  if (typed.empty()) return {};
  std::string_view best;
  constexpr std::size_t none = std::numeric_limits<std::size_t>::max();
  std::pair least{none, none};
  for (const std::string_view candidate : known) {
    const std::string name = bare(candidate);
    const std::size_t d = distance(typed, name);
    const std::size_t longer = std::max(typed.size(), name.size());
    const std::size_t limit = longer == 1 ? 0 : std::max<std::size_t>(1, longer / 3);  // any letter is near any other
    const bool beginning =
        typed.size() >= 2 && name.size() >= 2 && (name.starts_with(typed) || typed.starts_with(name));
    if (d > limit && !beginning) continue;
    // A beginning is as near as two letters, but of two that are that near the one with fewer letters in between.
    const std::pair near{beginning ? std::min<std::size_t>(d, 2) : d, d};
    if (near < least) least = near, best = candidate;
  }
  return best;
}

std::string near_word_or_list(std::string_view word, std::span<const std::string_view> known, std::string_view all) {
  const std::string_view near = near_word(word, known);
  const std::string list = fmt::format("{} {}", all, fmt::join(known, ", "));
  return near.empty() ? list : fmt::format("did you mean \"{}\"? {}", near, with_capital(list));
}

}  // namespace zstep
