// Matrices and columns of numbers in square brackets.

#include "sim/viewer/panes/typeset.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <string_view>
#include <utility>
#include <vector>

#include "sim/viewer/draw/canvas.hpp"
#include "sim/viewer/panes/happened.hpp"
#include "sim/words/owners.hpp"
#include "traces/text.hpp"

namespace zstep::viewer {

std::string below_symbol(const words::Notation& symbol) {
  std::string text = symbol.below;
  std::replace(text.begin(), text.end(), '_', ',');
  return text;
}

namespace {

/// A variable of one letter leans, as z* does; names stand, as words and numbers do, and the capitals of planes and
/// polygons.
const ImFont* letters_of(const Ui& ui, const words::Notation& what) {
  const auto stars = std::count(what.text.begin(), what.text.end(), '*');
  const auto signs = std::count_if(what.text.begin(), what.text.end(), [](char c) { return !continues_character(c); });
  const bool capital = !what.text.empty() && what.text[0] >= 'A' && what.text[0] <= 'Z';
  return what.kind == words::Notation::Kind::symbol && signs - stars == 1 && !capital ? ui.fonts.variable
                                                                                      : ui.fonts.text;
}

}  // namespace

float gap_at_bar(const Ui& ui) { return std::round(ui.em * 0.12f) + 1; }

bool opens_bracket(const words::Notation& part) {
  return part.kind == words::Notation::Kind::text &&
         (part.text == "(" || part.text == "\u230a" || part.text == "\u2308");
}
bool closes_bracket(const words::Notation& part) {
  return part.kind == words::Notation::Kind::text &&
         (part.text == ")" || part.text == "\u230b" || part.text == "\u2309");
}

namespace {

/// Room for its parts, once their own is known.
void enclose_parts(const Ui& ui, FormulaBox& box) {
  const float underlined = box.what.polygon != no_polygon ? underline_height(ui) : 0;
  if (box.what.kind == words::Notation::Kind::fraction) {
    const FormulaBox &over = box.parts[0], &under = box.parts[1];
    box.width = std::max(over.width, under.width) + 2 * gap_at_bar(ui);
    box.above = over.above + over.below + gap_at_bar(ui);
    box.below = under.above + under.below + gap_at_bar(ui) + underlined;
    return;
  }
  if (box.stacked) {
    box.width = 0, box.above = box.parts.front().above, box.below = -box.above;
    for (const FormulaBox& line : box.parts)
      box.width = std::max(box.width, line.width), box.below += line.above + line.below;
    return;
  }
  box.width = 0;
  for (const FormulaBox& part : box.parts) {
    box.width += part.width;
    box.above = std::max(box.above, part.above), box.below = std::max(box.below, part.below);
  }
  // Brackets are as tall as what they are around.
  if (box.above + box.below > 1.5f * ui.fonts.text->FontSize)
    for (FormulaBox& part : box.parts)
      if (opens_bracket(part.what) || closes_bracket(part.what)) part.above = box.above, part.below = box.below;
  box.below += underlined;
}

/// The parts of a sum; what is wider than the room is taken apart into its factors.
void add_terms(std::vector<FormulaBox>& terms, const FormulaBox& part, float room) {
  if (part.what.kind != words::Notation::Kind::row || part.stacked || part.width <= room) return terms.push_back(part);
  for (const FormulaBox& inner : part.parts) add_terms(terms, inner, room);
}

/// A sum above or below a fraction's bar that is wider than the room goes on in a line below, the sign in front.
void stack_sum(const Ui& ui, FormulaBox& sum, float room) {
  if (sum.width <= room || sum.what.kind != words::Notation::Kind::row || sum.stacked) return;
  std::vector<FormulaBox> terms, lines;
  const float beside_sign = room - text_size(ui, ui.fonts.text, "\u2212 ").x;
  for (const FormulaBox& part : sum.parts) add_terms(terms, part, beside_sign);
  const auto is_sign = [](const FormulaBox& term) { return term.what.text == " \u2212 " || term.what.text == " + "; };
  for (std::size_t k = 0; k < terms.size();) {
    // With the sign in front, and with what closes a bracket behind.
    std::size_t end = k + 1;
    while (end < terms.size() && !is_sign(terms[end]) &&
           (is_sign(terms[end - 1]) || opens_bracket(terms[end - 1].what) || closes_bracket(terms[end].what)))
      ++end;
    float taken = 0;
    for (std::size_t at = k; at < end; ++at) taken += terms[at].width;
    if (lines.empty() || lines.back().width + taken > room) {
      lines.push_back(FormulaBox{words::Notation{words::Notation::Kind::row}});
      if (is_sign(terms[k]))
        terms[k] = box_of(ui, words::Notation{words::Notation::Kind::text, terms[k].what.text.substr(1)});
    }
    for (; k < end; ++k) lines.back().parts.push_back(std::move(terms[k]));
    enclose_parts(ui, lines.back());
  }
  sum.parts = std::move(lines), sum.stacked = true;
  enclose_parts(ui, sum);
}

}  // namespace

FormulaBox box_of(const Ui& ui, words::Notation what) {
  const ImFont *text = letters_of(ui, what), *small = ui.fonts.small;
  FormulaBox box;
  const float line = text->FontSize;
  if (what.kind == words::Notation::Kind::row || what.kind == words::Notation::Kind::fraction) {
    for (words::Notation& part : what.parts) box.parts.push_back(box_of(ui, std::move(part)));
    what.parts.clear();
    box.what = std::move(what);
    enclose_parts(ui, box);
    return box;
  }
  box.width = text_size(ui, text, what.text).x;
  box.above = std::round(line * 0.55f), box.below = line - box.above;
  if (!what.below.empty()) {
    box.width += text_size(ui, small, below_symbol(what)).x + 1;
    box.below += std::round(line * 0.2f);
  } else if (what.polygon != no_polygon) {
    box.below += std::round(ui.thin);
  }
  box.what = std::move(what);
  return box;
}

void narrow_box(const Ui& ui, FormulaBox& box, float room) {
  if (box.width <= room) return;
  const bool fraction = box.what.kind == words::Notation::Kind::fraction;
  for (FormulaBox& part : box.parts) {
    if (fraction) stack_sum(ui, part, room - 2 * gap_at_bar(ui));
    else narrow_box(ui, part, room - (box.width - part.width));
  }
  if (!box.parts.empty()) enclose_parts(ui, box);
}

namespace {

using words::Notation;
using Kind = Notation::Kind;

struct Pen {
  Ui& ui;
  const Flow& how;
  ImU32 color;
  const std::vector<std::int32_t>& owners;  ///< whose numbers are underlined
};

void underline(const Pen& pen, std::int32_t polygon, ImVec2 from, float width) {
  const auto found = std::find(pen.owners.begin(), pen.owners.end(), polygon);
  if (found != pen.owners.end()) underline_of_polygon(pen.ui, polygon, found - pen.owners.begin(), from, width);
}

void draw_tall_bracket(const Pen& pen, const FormulaBox& box, ImVec2 at, float axis) {
  ImDrawList* list = ImGui::GetWindowDrawList();
  const float top = axis - box.above + 1, bottom = axis + box.below - 1, thick = 1.3f * pen.ui.thin;
  const bool left = opens_bracket(box.what), round = box.what.text == "(" || box.what.text == ")";
  const float outer = left ? at.x + 1 : at.x + box.width - 1, inner = left ? at.x + box.width - 1 : at.x + 1;
  if (round) {
    const float bend = (bottom - top) * 0.25f;
    list->AddBezierCubic({inner, top}, {outer, top + bend}, {outer, bottom - bend}, {inner, bottom}, pen.color, thick,
                         16);
    return;
  }
  stroke_line(list, {outer, top}, {outer, bottom}, pen.color, thick);
  const float foot = box.what.text == "\u230a" || box.what.text == "\u230b" ? bottom : top;
  stroke_line(list, {outer, foot}, {inner, foot}, pen.color, thick);
}

/// With the left end of the box at `at.x`, and the bars of its fractions on `axis`.
void draw(const Pen& pen, const FormulaBox& box, ImVec2 at, float axis) {
  Ui& ui = pen.ui;
  if (box.what.kind == Kind::fraction) {
    const FormulaBox &over = box.parts[0], &under = box.parts[1];
    draw(pen, over, {at.x + std::floor((box.width - over.width) / 2), 0}, axis - gap_at_bar(ui) - over.below);
    draw(pen, under, {at.x + std::floor((box.width - under.width) / 2), 0}, axis + gap_at_bar(ui) + under.above);
    underline(pen, box.what.polygon, {at.x + 1, axis + box.below - underline_height(ui)}, box.width - 2);
    const float bar = std::floor(axis);
    ImGui::GetWindowDrawList()->AddRectFilled({at.x + 1, bar}, {at.x + box.width - 1, bar + std::round(ui.thin)},
                                              pen.color);
    return;
  }
  if (box.stacked) {
    float top = axis - box.above;
    for (const FormulaBox& part : box.parts) {
      draw(pen, part, at, top + part.above);
      top += part.above + part.below;
    }
    return;
  }
  if (box.what.kind == Kind::row) {
    for (const FormulaBox& part : box.parts) {
      draw(pen, part, at, axis);
      at.x += part.width;
    }
    return;
  }
  const ImFont* text = letters_of(ui, box.what);
  const float line = text->FontSize;
  if ((opens_bracket(box.what) || closes_bracket(box.what)) && box.above + box.below > 1.5f * line)
    return draw_tall_bracket(pen, box, at, axis);
  const ImFont* small = ui.fonts.small;
  const float own = text_size(ui, text, box.what.text).x,
              lower = box.what.below.empty() ? 0 : text_size(ui, small, below_symbol(box.what)).x + 1;
  // In the middle of more room than it needs, so that numbers stand under their symbols.
  const float x = at.x + std::floor((box.width - own - lower) / 2), top = axis - std::round(line * 0.55f);
  draw_text(ui, {x, top}, text, pen.color, box.what.text);
  underline(pen, box.what.polygon, {x, top + line - underline_height(ui) + std::round(ui.thin)}, own);
  if (lower > 0)
    draw_text(ui, {x + own + 1, top + line * 1.12f - small->FontSize * 0.92f}, small, pen.color,
              below_symbol(box.what));
  if (box.what.kind == Kind::number && pen.how.on_number) {
    std::string number = box.what.text;
    if (number.starts_with("(")) number = number.substr(1, number.size() - 2);
    pen.how.on_number(number, {x, top}, {x + own, top + line});
  }
}

/// What is placed on a line of the pane: a side of the formula, a sign between two, or a piece of a side too long for
/// one line.
struct Placed {
  FormulaBox box;
  float x = 0;
  bool result = false;
};
struct Row {
  std::vector<Placed> placed;
  float above = 0, below = 0;

  void put(FormulaBox box, float x, bool result = false) {
    above = std::max(above, box.above), below = std::max(below, box.below);
    placed.push_back({std::move(box), x, result});
  }
};

/// A piece of a side, and whether a line may begin with it.
struct Unbroken {
  FormulaBox box;
  bool may_begin = false;
};

/// `within`: of brackets and products, too.
bool ends_in_operator(std::string_view text, bool within) {
  if (text.ends_with(' ')) text.remove_suffix(1);
  const auto ends = [&](std::string_view sign) { return text.ends_with(sign); };
  constexpr std::array<std::string_view, 7> operators{"+", "\u2212", "=", "<", ">", "\u2264", "\u2265"};
  constexpr std::array<std::string_view, 4> inner{"\u00b7", "\u00d7", "/", "("};
  return std::ranges::any_of(operators, ends) || (within && std::ranges::any_of(inner, ends));
}

/// Where a line of text may break after `from`: at a space, and where brackets are to be broken behind a sign that is
/// not set apart, too.
std::size_t next_break(const std::string& text, std::size_t from, bool anywhere) {
  std::size_t end = std::min(text.find(' ', from + 1), text.size());
  if (!anywhere) return end;
  for (const std::string_view sign : {"/", "\u00b7", ")("})
    if (const std::size_t at = text.find(sign, from + 1); at < end) end = at + (sign == ")(" ? 1 : sign.size());
  return end;
}

constexpr int no_depth = 8;  ///< of brackets: from here on a line breaks wherever it can

/// The parts of a side between which a line may break: at words, and before an operator or a relation that stands in
/// no more than `depth` brackets.
std::vector<FormulaBox> pieces_of(const Ui& ui, const FormulaBox& side, int depth = 0) {
  if (side.what.kind != Kind::row) return {side};
  std::vector<Unbroken> pieces;
  bool open = true, spaced = false;  // behind an operator no line begins, and none where there is no space
  int inside = 0;
  const auto add = [&](FormulaBox box, bool is_spaced) {
    pieces.push_back({std::move(box), !open && (depth == no_depth || (is_spaced && inside <= depth))});
  };
  for (const FormulaBox& part : side.parts) {
    if (part.what.kind != Kind::text) {
      add(part, spaced);
      open = spaced = false;
      continue;
    }
    const std::string& text = part.what.text;
    for (std::size_t from = 0; from < text.size();) {
      const std::size_t end = next_break(text, from, depth == no_depth);
      const std::string word = text.substr(from, end - from);
      const bool blank = word == " ";
      add(box_of(ui, Notation{Kind::text, word}), !blank && (spaced || word.starts_with(' ')));
      for (const char c : word) inside += (c == '(') - (c == ')');
      if (!blank) open = ends_in_operator(word, depth < no_depth);
      spaced = blank;
      from = end;
    }
  }
  std::vector<FormulaBox> joined;
  for (Unbroken& piece : pieces) {
    if (joined.empty() || piece.may_begin) joined.push_back(FormulaBox{Notation{Kind::row}});
    joined.back().parts.push_back(std::move(piece.box));
  }
  for (FormulaBox& box : joined) {
    if (box.parts.size() == 1) box = FormulaBox(box.parts.front());
    else enclose_parts(ui, box);
  }
  return joined;
}

float widest_of(const std::vector<FormulaBox>& pieces) {
  float widest = 0;
  for (const FormulaBox& piece : pieces) widest = std::max(widest, piece.width);
  return widest;
}

/// Whether a fraction's sums are stacked so high that nobody reads them as one.
bool is_too_tall(const Ui& ui, const FormulaBox& box) {
  constexpr float most_lines = 5.5f;
  return box.above + box.below > most_lines * ui.fonts.text->FontSize;
}

/// "2", and "2.4, rounded to 2".
bool ends_in_number(const FormulaBox& side) {
  const auto is_number = [](const FormulaBox& part) { return part.what.kind == Kind::number; };
  if (side.parts.size() == 1) return is_number(side.parts.front());
  return side.parts.size() > 2 && is_number(side.parts.front()) && is_number(side.parts.back()) &&
         side.parts[1].what.text.starts_with(", ");
}

FormulaBox word(const Ui& ui, const char* text) { return box_of(ui, Notation{Kind::text, text}); }

/// "A = 2", ", ", "B = 0": the equations of a line, and between them what parts them.
std::vector<std::string_view> equations_of(std::string_view line) {
  std::vector<std::string_view> found;
  std::size_t from = 0;
  int inside = 0;
  for (std::size_t at = 0; at < line.size(); ++at) {
    inside += (line[at] == '(' || line[at] == '[') - (line[at] == ')' || line[at] == ']');
    if (inside != 0 || (line[at] != ',' && line[at] != ';')) continue;
    const std::size_t next = std::min(line.find_first_not_of(' ', at + 1), line.size()),
                      end = std::min(line.find_first_of(",;", next), line.size());
    const bool parts = next > at + 1 && line.substr(from, at - from).find(" = ") != std::string_view::npos &&
                       (line[at] == ';' || line.substr(next, end - next).find(" = ") != std::string_view::npos);
    if (!parts) continue;
    found.push_back(line.substr(from, at - from)), found.push_back(line.substr(at, next - at));
    from = next;
  }
  found.push_back(line.substr(from));
  return found;
}

std::vector<Row> rows_of_equation(const Ui& ui, std::string_view line, float width,
                                  const std::vector<words::Owned>& owned) {
  std::vector<Notation> notation = words::read_notation(line);
  words::mark_owned(notation, owned);
  const auto alike = [&](std::size_t side) {  // to the one before
    return side < notation.size() && words::alike(notation[side - 1], notation[side]);
  };
  std::vector<FormulaBox> sides;
  for (const Notation& side : notation) sides.push_back(box_of(ui, side));
  const float equals = text_size(ui, ui.fonts.text, " = ").x;
  float whole = -equals;
  for (const FormulaBox& side : sides) whole += equals + side.width;
  // A long name does not push what it is equal to out of the pane.
  const float hang = std::min(sides.front().width, width * 0.3f);
  std::vector<Row> rows(1);
  float x = 0;
  const auto put_broken = [&](std::size_t side, float left, bool result) {
    std::vector<FormulaBox> pieces = pieces_of(ui, sides[side]);
    if (left + widest_of(pieces) > width) left = std::min(left, ui.em);
    if (left + widest_of(pieces) > width) pieces = pieces_of(ui, sides[side], no_depth);
    for (FormulaBox& piece : pieces) narrow_box(ui, piece, width - left);
    // A fraction of fractions has its own bar in the line, so that no more than two numbers stand over each other.
    const Notation& whole_side =
        notation[side].parts.size() == 1 && notation[side].kind == Kind::row ? notation[side].parts[0] : notation[side];
    if (whole_side.kind == Kind::fraction && whole_side.parts[0].kind == Kind::fraction &&
        whole_side.parts[1].kind == Kind::fraction && is_too_tall(ui, sides[side]))
      pieces = pieces_of(
          ui, box_of(ui, {Kind::row, {}, {}, {whole_side.parts[0], {Kind::text, " / "}, whole_side.parts[1]}}));
    const bool tall =
        std::any_of(pieces.begin(), pieces.end(), [&](const FormulaBox& box) { return is_too_tall(ui, box); });
    if (tall || left + widest_of(pieces) > width) {
      const Notation plain{Kind::row, {}, {}, {Notation{Kind::text, words::on_one_line(notation[side])}}};
      for (int depth = 0; depth <= no_depth; ++depth) {
        pieces = pieces_of(ui, box_of(ui, plain), depth);
        if (left + widest_of(pieces) <= width) break;
      }
    }
    for (FormulaBox& piece : pieces) {
      if (x > left && x + piece.width > width) {
        rows.emplace_back();
        x = left;
      }
      const float taken = piece.width;
      rows.back().put(std::move(piece), x, result && &piece == &pieces.back());
      x += taken;
    }
  };
  put_broken(0, ui.em, false);
  for (std::size_t at = 1; at < sides.size(); ++at) {
    FormulaBox& side = sides[at];
    const bool result = at + 1 == sides.size() && sides.size() > 2 && ends_in_number(side);
    FormulaBox sign = word(ui, "= ");
    const float behind_name = width - hang - equals, behind_sign = width - sign.width;
    bool narrowed = false;
    if (widest_of(pieces_of(ui, side, no_depth)) > behind_sign) {
      FormulaBox broken = side, wider = side;
      narrow_box(ui, broken, behind_name), narrow_box(ui, wider, behind_sign);
      narrowed = !is_too_tall(ui, broken) && widest_of(pieces_of(ui, broken, no_depth)) <= behind_name &&
                 broken.above + broken.below <= wider.above + wider.below;
      if (narrowed) side = std::move(broken);
    }
    const bool under = whole > width && at > 1 && alike(at) && !side.parts.empty();
    if (under || x + equals + side.width > width) {
      // Not alone on its line, what fits behind the name.
      if (x > hang || under) rows.emplace_back(), x = hang;
    }
    if (widest_of(pieces_of(ui, side)) > behind_name) {
      // There is more room behind a sign that begins a line.
      if (!rows.back().placed.empty()) rows.emplace_back();
      x = sign.width;
      rows.back().put(std::move(sign), 0);
      put_broken(at, x, result);
      continue;
    }
    rows.back().put(word(ui, " = "), x);
    x += equals;
    put_broken(at, x + side.width > width ? hang + equals : x, result);
  }
  return rows;
}

std::vector<Row> rows_of(const Ui& ui, const std::string& line, float width, const std::vector<words::Owned>& owned) {
  const auto end_of = [](const Row& row) {
    return row.placed.empty() ? 0.0f : row.placed.back().x + row.placed.back().box.width;
  };
  const std::vector<std::string_view> equations = equations_of(line);
  std::vector<Row> rows = rows_of_equation(ui, equations.front(), width, owned);
  for (std::size_t k = 1; k + 1 < equations.size(); k += 2) {
    rows.back().put(word(ui, std::string(equations[k]).c_str()), end_of(rows.back()));
    std::vector<Row> next = rows_of_equation(ui, equations[k + 1], width, owned);
    const float end = end_of(rows.back());
    const bool fits = next.size() == 1 && end + end_of(next.front()) <= width;
    if (fits)
      for (Placed& placed : next.front().placed) rows.back().put(std::move(placed.box), placed.x + end, placed.result);
    rows.insert(rows.end(), next.begin() + (fits ? 1 : 0), next.end());
  }
  return rows;
}

float leading(const Ui& ui) { return std::round(ui.em * 0.25f); }

float height_of(const Ui& ui, const std::vector<Row>& rows) {
  float height = 0;
  for (const Row& row : rows) height += row.above + row.below + leading(ui);
  return height;
}

float width_for(const Ui& ui, const Flow& how) {
  return how.width > 0 ? how.width : std::max(ui.em, ImGui::GetContentRegionAvail().x);
}

}  // namespace

void set_formula(Ui& ui, const std::string& line, const Flow& how, const std::vector<words::Owned>& owned) {
  const ImVec2 origin = ImGui::GetCursorScreenPos();
  const float width = width_for(ui, how);
  const ImU32 color = how.color ? how.color : ui.colors().text;
  const std::vector<Row> rows = rows_of(ui, line, width, owned);
  const std::vector<std::int32_t> owners = words::owners_in(owned);
  float y = origin.y;
  for (const Row& row : rows) {
    for (const Placed& placed : row.placed) {
      const Pen pen{ui, how, placed.result && how.color == 0 ? ui.colors().now : color, owners};
      draw(pen, placed.box, {std::floor(origin.x + placed.x), 0}, y + row.above);
    }
    y += row.above + row.below + leading(ui);
  }
  ImGui::Dummy({std::max(1.0f, width), y - origin.y});
}

float formula_height(Ui& ui, const std::string& line, const Flow& how) {
  return height_of(ui, rows_of(ui, line, width_for(ui, how), {}));
}

namespace {

const ImFont* face_of(const Ui& ui, bool small) { return small ? ui.fonts.small : ui.fonts.text; }
float row_height(const Ui& ui, bool small) { return std::round(face_of(ui, small)->FontSize * 1.3f); }
float foot(const Ui& ui) { return std::round(ui.em * 0.3f); }  ///< of a bracket, and the room beside it

/// An entry, with what stands behind its "_" below the line; its width. Draws nothing without a place.
float set_entry(const Ui& ui, const std::string& entry, bool small, std::optional<ImVec2> at) {
  const std::size_t bar = std::min(entry.find('_'), entry.size());
  const ImFont* face = face_of(ui, small);
  const std::string letter = entry.substr(0, bar), lower = entry.substr(std::min(bar + 1, entry.size()));
  const float own = text_size(ui, face, letter).x;
  if (at) draw_text(ui, *at, face, ui.colors().text, letter);
  if (lower.empty()) return own;
  if (at)
    draw_text(ui, {at->x + own + 1, at->y + std::round(face->FontSize * 0.22f)}, ui.fonts.small, ui.colors().text,
              lower);
  return own + 1 + text_size(ui, ui.fonts.small, lower).x;
}

std::vector<float> widths_of(const Ui& ui, const Entries& rows, bool small) {
  std::vector<float> widths;
  for (const std::vector<std::string>& row : rows) {
    widths.resize(std::max(widths.size(), row.size()));
    for (std::size_t k = 0; k < row.size(); ++k) widths[k] = std::max(widths[k], set_entry(ui, row[k], small, {}));
  }
  return widths;
}

}  // namespace

ImVec2 matrix_size(const Ui& ui, const Entries& rows, bool small) {
  float width = 2 * foot(ui);
  const std::vector<float> widths = widths_of(ui, rows, small);
  for (const float column : widths) width += column;
  width += std::round(ui.em * 0.8f) * to_float(std::max<std::size_t>(widths.size(), 1) - 1);
  return {width, row_height(ui, small) * to_float(rows.size())};
}

void set_matrix(Ui& ui, ImVec2 at, const Entries& rows, bool small) {
  const std::vector<float> widths = widths_of(ui, rows, small);
  const ImVec2 size = matrix_size(ui, rows, small);
  const ImU32 color = ui.colors().text;
  ImDrawList* list = ImGui::GetWindowDrawList();
  const float thick = std::round(1.2f * ui.thin), arm = foot(ui) - 1;
  for (const bool left : {true, false}) {
    const float outer = left ? at.x : at.x + size.x - thick, inner = left ? at.x : at.x + size.x - arm;
    list->AddRectFilled({outer, at.y}, {outer + thick, at.y + size.y}, color);
    for (const float y : {at.y, at.y + size.y - thick})
      list->AddRectFilled({inner, y}, {inner + arm, y + thick}, color);
  }
  const float top = std::round((row_height(ui, small) - face_of(ui, small)->FontSize) / 2) - 1;
  for (std::size_t r = 0; r < rows.size(); ++r) {
    float right = at.x + foot(ui);
    for (std::size_t k = 0; k < rows[r].size(); ++k) {
      right += widths[k];
      const float y = at.y + row_height(ui, small) * to_float(r) + top;
      set_entry(ui, rows[r][k], small, ImVec2{right - set_entry(ui, rows[r][k], small, {}), y});
      right += std::round(ui.em * 0.8f);
    }
  }
}

}  // namespace zstep::viewer
