#include "sim/viewer/panes/typeset.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string_view>
#include <utility>
#include <vector>

#include "sim/viewer/draw/strokes.hpp"
#include "sim/viewer/panes/owner_key.hpp"
#include "sim/words/owners.hpp"

namespace zstep::viewer {
namespace {

using words::Notation;
using Kind = Notation::Kind;

/// A part of a formula with the room that it takes: to the right, and above and below the line on which fractions'
/// bars lie.
struct Box {
  Notation what;
  float width = 0, above = 0, below = 0;
  std::vector<Box> parts{};
};

/// What stands below a letter, as it is written: "v,L" of z_v_L.
std::string below(const Notation& symbol) {
  std::string text = symbol.below;
  std::replace(text.begin(), text.end(), '_', ',');
  return text;
}

struct Faces {
  const ImFont *text, *small;
};
Faces faces_of(const Ui& ui) { return {ui.fonts.text, ui.fonts.small}; }

float gap(const Ui& ui) { return std::round(ui.em * 0.12f) + 1; }

bool opens(const Notation& part) {
  return part.kind == Kind::text && (part.text == "(" || part.text == "\u230a" || part.text == "\u2308");
}
bool closes(const Notation& part) {
  return part.kind == Kind::text && (part.text == ")" || part.text == "\u230b" || part.text == "\u2309");
}

/// Room for its parts, once their own is known.
void enclose(const Ui& ui, Box& box) {
  if (box.what.kind == Kind::fraction) {
    const Box &over = box.parts[0], &under = box.parts[1];
    box.width = std::max(over.width, under.width) + 2 * gap(ui);
    box.above = over.above + over.below + gap(ui);
    box.below = under.above + under.below + gap(ui);
    return;
  }
  box.width = 0;
  for (const Box& part : box.parts) {
    box.width += part.width;
    box.above = std::max(box.above, part.above), box.below = std::max(box.below, part.below);
  }
}

Box measured(const Ui& ui, Notation what) {
  const auto [text, small] = faces_of(ui);
  Box box;
  const float line = text->FontSize;
  if (what.kind == Kind::row || what.kind == Kind::fraction) {
    for (Notation& part : what.parts) box.parts.push_back(measured(ui, std::move(part)));
    what.parts.clear();
    box.what = std::move(what);
    enclose(ui, box);
    if (box.what.polygon != no_polygon) box.below += underline_height(ui);
    // Brackets are as tall as what they are around.
    if (box.what.kind == Kind::row && box.above + box.below > 1.5f * line)
      for (Box& part : box.parts)
        if (opens(part.what) || closes(part.what)) part.above = box.above, part.below = box.below;
    return box;
  }
  box.width = text_size(ui, text, what.text).x;
  box.above = std::round(line * 0.55f), box.below = line - box.above;
  if (!what.below.empty()) {
    box.width += text_size(ui, small, below(what)).x + 1;
    box.below += std::round(line * 0.2f);
  } else if (what.polygon != no_polygon) {
    box.below += std::round(ui.thin);
  }
  box.what = std::move(what);
  return box;
}

/// Makes room alike for what stands at the same place of both.
void match(const Ui& ui, Box& one, Box& other) {
  if (one.parts.size() != other.parts.size() || one.parts.empty()) {
    one.width = other.width = std::max(one.width, other.width);
    return;
  }
  for (std::size_t at = 0; at < one.parts.size(); ++at) match(ui, one.parts[at], other.parts[at]);
  enclose(ui, one), enclose(ui, other);
}

struct Pen {
  Ui& ui;
  const Flow& how;
  ImU32 color;
  const ImFont* face;
  const std::vector<std::int32_t>& owners;  ///< whose numbers are underlined
};

void underline(const Pen& pen, std::int32_t polygon, ImVec2 from, float width) {
  const auto found = std::find(pen.owners.begin(), pen.owners.end(), polygon);
  if (found != pen.owners.end()) underline_of_polygon(pen.ui, polygon, found - pen.owners.begin(), from, width);
}

void draw_tall_bracket(const Pen& pen, const Box& box, ImVec2 at, float axis) {
  ImDrawList* list = ImGui::GetWindowDrawList();
  const float top = axis - box.above + 1, bottom = axis + box.below - 1, thick = 1.3f * pen.ui.thin;
  const bool left = opens(box.what), round = box.what.text == "(" || box.what.text == ")";
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
void draw(const Pen& pen, const Box& box, ImVec2 at, float axis) {
  Ui& ui = pen.ui;
  if (box.what.kind == Kind::fraction) {
    const Box &over = box.parts[0], &under = box.parts[1];
    draw(pen, over, {at.x + std::floor((box.width - over.width) / 2), 0}, axis - gap(ui) - over.below);
    draw(pen, under, {at.x + std::floor((box.width - under.width) / 2), 0}, axis + gap(ui) + under.above);
    underline(pen, box.what.polygon, {at.x + 1, axis + box.below - underline_height(ui)}, box.width - 2);
    const float bar = std::floor(axis);
    ImGui::GetWindowDrawList()->AddRectFilled({at.x + 1, bar}, {at.x + box.width - 1, bar + std::round(ui.thin)},
                                              pen.color);
    return;
  }
  if (box.what.kind == Kind::row) {
    for (const Box& part : box.parts) {
      draw(pen, part, at, axis);
      at.x += part.width;
    }
    return;
  }
  const ImFont* text = pen.face;
  const float line = text->FontSize;
  if ((opens(box.what) || closes(box.what)) && box.above + box.below > 1.5f * line)
    return draw_tall_bracket(pen, box, at, axis);
  const ImFont* small = ui.fonts.small;
  const float own = text_size(ui, text, box.what.text).x,
              lower = box.what.below.empty() ? 0 : text_size(ui, small, below(box.what)).x + 1;
  // In the middle of more room than it needs, so that numbers stand under their symbols.
  const float x = at.x + std::floor((box.width - own - lower) / 2), top = axis - std::round(line * 0.55f);
  draw_text(ui, {x, top}, text, pen.color, box.what.text);
  underline(pen, box.what.polygon, {x, top + line - underline_height(ui) + std::round(ui.thin)}, own);
  if (lower > 0)
    draw_text(ui, {x + own + 1, top + line * 1.12f - small->FontSize * 0.92f}, small, pen.color, below(box.what));
  if (box.what.kind == Kind::number && pen.how.on_number) {
    std::string number = box.what.text;
    if (number.starts_with("(")) number = number.substr(1, number.size() - 2);
    pen.how.on_number(number, {x, top}, {x + own, top + line});
  }
}

/// What is placed on a line of the pane: a side of the formula, a sign between two, or a piece of a side too long for
/// one line.
struct Placed {
  Box box;
  float x = 0;
  bool result = false;
};
struct Row {
  std::vector<Placed> placed;
  float above = 0, below = 0;

  void put(Box box, float x, bool result = false) {
    above = std::max(above, box.above), below = std::max(below, box.below);
    placed.push_back({std::move(box), x, result});
  }
};

/// Where a line of text may break after `from`: at a space, and in a formula behind a sign that is not set apart.
std::size_t next_break(const std::string& text, std::size_t from) {
  std::size_t end = std::min(text.find(' ', from + 1), text.size());
  for (const std::string_view sign : {"/", "\u00b7", ")("})
    if (const std::size_t at = text.find(sign, from + 1); at < end) end = at + (sign == ")(" ? 1 : sign.size());
  return end;
}

/// The parts of a side between which a line may break; words one by one.
std::vector<Box> pieces_of(const Ui& ui, const Box& side) {
  if (side.what.kind != Kind::row) return {side};
  std::vector<Box> pieces;
  for (const Box& part : side.parts) {
    if (part.what.kind != Kind::text) {
      pieces.push_back(part);
      continue;
    }
    const std::string& text = part.what.text;
    for (std::size_t from = 0; from < text.size();) {
      const std::size_t end = next_break(text, from);
      pieces.push_back(measured(ui, Notation{Kind::text, text.substr(from, end - from)}));
      from = end;
    }
  }
  return pieces;
}

Box word(const Ui& ui, const char* text) { return measured(ui, Notation{Kind::text, text}); }

std::vector<Row> rows_of(const Ui& ui, const std::string& line, float width, const std::vector<words::Owned>& owned) {
  std::vector<Notation> notation = words::read_notation(line);
  words::mark_owned(notation, owned);
  const auto alike = [&](std::size_t side) {  // to the one before
    return side < notation.size() && words::alike(notation[side - 1], notation[side]);
  };
  std::vector<Box> sides;
  for (const Notation& side : notation) sides.push_back(measured(ui, side));
  const float equals = text_size(ui, faces_of(ui).text, " = ").x;
  float whole = -equals;
  for (const Box& side : sides) whole += equals + side.width;
  // A long name does not push what it is equal to out of the pane.
  const float hang = std::min(sides.front().width, width * 0.3f);
  std::vector<Row> rows(1);
  float x = 0;
  const auto put_broken = [&](std::size_t side, float left, bool result) {
    std::vector<Box> pieces = pieces_of(ui, sides[side]);
    float widest = 0;
    for (const Box& piece : pieces) widest = std::max(widest, piece.width);
    if (left + widest > width) left = ui.em;
    if (left + widest > width) {
      const Notation plain{Kind::row, {}, {}, {Notation{Kind::text, words::on_one_line(notation[side])}}};
      pieces = pieces_of(ui, measured(ui, plain));
    }
    for (Box& piece : pieces) {
      if (x > left && x + piece.width > width) {
        rows.emplace_back();
        x = left;
      }
      const float taken = piece.width;
      rows.back().put(std::move(piece), x, result);
      x += taken;
    }
  };
  put_broken(0, ui.em, false);
  for (std::size_t at = 1; at < sides.size(); ++at) {
    Box& side = sides[at];
    const bool result = at + 1 == sides.size() && sides.size() > 2 && side.parts.size() == 1 &&
                        side.parts.front().what.kind == Kind::number;
    const bool under = whole > width && at > 1 && alike(at) && !side.parts.empty();
    if (under || x + equals + side.width > width) {
      // Not alone on its line, what fits behind the name.
      if (x > hang || under) rows.emplace_back(), x = hang;
    }
    if (whole > width && alike(at + 1)) {
      Box wider = side, next = sides[at + 1];
      match(ui, wider, next);
      if (hang + equals + wider.width <= width) {
        if (x + equals + wider.width > width && x > hang) rows.emplace_back(), x = hang;
        side = std::move(wider), sides[at + 1] = std::move(next);
      }
    }
    rows.back().put(word(ui, " = "), x);
    x += equals;
    put_broken(at, x + side.width > width ? hang + equals : x, result);
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
      const Pen pen{ui, how, placed.result && how.color == 0 ? ui.colors().now : color, ui.fonts.text, owners};
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
  width += std::round(ui.em * 0.8f) * static_cast<float>(std::max<std::size_t>(widths.size(), 1) - 1);
  return {width, row_height(ui, small) * static_cast<float>(rows.size())};
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
      const float y = at.y + row_height(ui, small) * static_cast<float>(r) + top;
      set_entry(ui, rows[r][k], small, ImVec2{right - set_entry(ui, rows[r][k], small, {}), y});
      right += std::round(ui.em * 0.8f);
    }
  }
}

}  // namespace zstep::viewer
