#include "sim/viewer/panes/code_lines.hpp"

#include <algorithm>
#include <optional>
#include <string_view>

namespace zstep::viewer {
namespace {

constexpr int hanging = 2;  // columns

/// Characters, each a column wide.
using Glyphs = std::vector<std::string>;
Glyphs glyphs_of(std::string_view text) {
  Glyphs glyphs;
  for (const char c : text) {
    if ((static_cast<unsigned char>(c) & 0xc0u) != 0x80u || glyphs.empty()) glyphs.emplace_back();
    glyphs.back() += c;
  }
  return glyphs;
}

int glyph_count(const Glyphs& line) { return static_cast<int>(line.size()); }
bool is_space(const Glyphs& line, int at) {
  return at >= glyph_count(line) || line[static_cast<std::size_t>(at)] == " ";
}

std::string text_between(const Glyphs& line, int from, int to) {
  std::string text;
  for (int at = from; at < std::min(to, glyph_count(line)); ++at) text += line[static_cast<std::size_t>(at)];
  return text.erase(text.find_last_not_of(' ') + 1);
}

int first_of(const Glyphs& line) {
  int at = 0;
  while (at < glyph_count(line) && is_space(line, at)) ++at;
  return at;
}

/// Where each row of a table breaks, from left to right; nothing where the lines are no table, or do not fit so.
class TableBreaks {
 public:
  TableBreaks(const std::vector<Glyphs>& rows, int columns) : rows_(rows), columns_(columns) {
    for (const Glyphs& row : rows) widest_ = std::max(widest_, glyph_count(row));
  }

  std::optional<std::vector<int>> found() {
    std::vector<int> breaks;
    if (rows_.size() < 2 || !from(0, breaks)) return std::nullopt;
    return breaks;
  }

  /// The least indentation that rows have from there on.
  int begins(int at) const {
    int least = widest_;
    for (const Glyphs& row : rows_) {
      int first = at;
      while (first < glyph_count(row) && is_space(row, first)) ++first;
      if (first < glyph_count(row)) least = std::min(least, first);
    }
    return least;
  }

 private:
  /// Between two columns: a cell ends or is missing in every row, and the first column is empty at most in the heading.
  bool is_gutter(int at) const {
    bool wide = false;
    for (const Glyphs& row : rows_) {
      if (!is_space(row, at - 1)) return false;
      const bool named = first_of(row) < at || &row == &rows_.front();
      if (!named) return false;
      wide = wide || (at > 1 && is_space(row, at - 2) && at < glyph_count(row));
    }
    return wide;
  }
  int width_between(int from, int to) const {
    int width = 0;
    for (const Glyphs& row : rows_)
      width = std::max(width, glyph_count(glyphs_of(text_between(row, begins(from), to))));
    return width;
  }
  /// As few parts as there can be, and of these the ones with the most in the last.
  bool from(int at, std::vector<int>& breaks) const {
    const int room = columns_ - (at == 0 ? 0 : hanging);
    if (width_between(at, widest_) <= room) return true;
    std::optional<std::vector<int>> best;
    for (int next = begins(at) + 1; next < widest_ && width_between(at, next) <= room; ++next) {
      if (!is_gutter(next) || begins(next) != next) continue;
      std::vector<int> rest;
      if (from(next, rest) && (!best || rest.size() + 1 < best->size())) {
        best = std::vector<int>{next};
        best->insert(best->end(), rest.begin(), rest.end());
      }
    }
    if (!best) return false;
    breaks.insert(breaks.end(), best->begin(), best->end());
    return true;
  }

  const std::vector<Glyphs>& rows_;
  int columns_, widest_ = 0;
};

bool is_sign(const Glyphs& line, int at) {
  static constexpr std::string_view before[] = {"=", "+", "\u2212", "\u00b7", "/", "<", "\u2264"};
  return at + 1 < glyph_count(line) && is_space(line, at + 1) &&
         std::find(std::begin(before), std::end(before), line[static_cast<std::size_t>(at)]) != std::end(before);
}

/// BreakPlaces where a line may break, the better ones first; of each kind the last that fits.
struct BreakPlaces {
  int behind_comma = 0, before_sign = 0, outside_brackets = 0, before_sign_in_brackets = 0, at_space = 0,
      beside_sign = 0;
};

/// Where a line that begins there and has so much room ends.
int end_of_line(const Glyphs& line, int from, int room) {
  if (glyph_count(line) - from <= room) return glyph_count(line);
  const auto glyph = [&](int at) -> std::string_view { return line[static_cast<std::size_t>(at)]; };
  BreakPlaces found;
  int depth = 0;
  for (int at = from; at <= from + room; ++at) {
    if (at > from && is_space(line, at - 1) && !is_space(line, at)) {
      found.at_space = at;
      if (depth == 0) found.outside_brackets = at;
      if (is_sign(line, at)) (depth == 0 ? found.before_sign : found.before_sign_in_brackets) = at;
      if (depth == 0 && at - 2 > from && glyph(at - 2) == ",") found.behind_comma = at;
    } else if (at > from && is_space(line, at)) {  // what follows the space may be beyond the room
      found.at_space = at;
      if (depth == 0) found.outside_brackets = at;
      if (at == from + room && is_sign(line, at + 1))
        (depth == 0 ? found.before_sign : found.before_sign_in_brackets) = at;
      if (at == from + room && depth == 0 && glyph(at - 1) == ",") found.behind_comma = at;
    } else if (at > from && (glyph(at - 1) == "," || glyph(at) == "+" || glyph(at) == "\u00b7" || glyph(at) == "/")) {
      found.beside_sign = at;
    }
    if (glyph(at) == "(") ++depth;
    if (glyph(at) == ")") --depth;
  }
  const int far_enough = from + room / 4;
  for (const int place : {found.behind_comma, found.before_sign, found.outside_brackets, found.before_sign_in_brackets})
    if (place > far_enough) return place;
  for (const int place : {found.at_space, found.beside_sign})
    if (place > from) return place;
  return from + room;
}

void break_line(std::vector<CodeLine>& lines, const Glyphs& line, int columns) {
  int at = first_of(line), indent = at;
  if (glyph_count(line) > columns) indent = std::min(indent, hanging);
  for (bool continues = false; at < glyph_count(line) || !continues; continues = true) {
    const int end = end_of_line(line, at, std::max(1, columns - indent));
    lines.push_back({text_between(line, at, end), indent, continues});
    at = end, indent = hanging;
    while (at < glyph_count(line) && is_space(line, at)) ++at;
  }
}

}  // namespace

std::vector<CodeLine> code_lines(const std::string& code, int columns) {
  std::vector<Glyphs> rows;
  for (std::size_t at = 0; at <= code.size();) {
    const std::size_t end = std::min(code.find('\n', at), code.size());
    rows.push_back(glyphs_of(std::string_view(code).substr(at, end - at)));
    at = end + 1;
  }
  std::vector<CodeLine> lines;
  TableBreaks table(rows, columns);
  const bool fit =
      std::all_of(rows.begin(), rows.end(), [&](const Glyphs& row) { return glyph_count(row) <= columns; });
  const auto breaks = fit ? std::nullopt : table.found();
  for (const Glyphs& row : rows) {
    if (!breaks) {
      break_line(lines, row, columns);
      continue;
    }
    for (std::size_t part = 0; part <= breaks->size(); ++part) {
      const int from = part == 0 ? table.begins(0) : (*breaks)[part - 1],
                to = part < breaks->size() ? (*breaks)[part] : glyph_count(row);
      std::string text = text_between(row, from, to);
      const std::size_t blank = std::min(text.find_first_not_of(' '), text.size());
      if (blank == text.size()) continue;
      lines.push_back({text.substr(blank), static_cast<int>(blank) + (part == 0 ? 0 : hanging), false});
    }
  }
  return lines;
}

}  // namespace zstep::viewer
