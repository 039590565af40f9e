#include "sim/viewer/panes/typeset_boxes.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "sim/viewer/panes/owner_key.hpp"

namespace zstep::viewer {

std::string below_symbol(const words::Notation& symbol) {
  std::string text = symbol.below;
  std::replace(text.begin(), text.end(), '_', ',');
  return text;
}

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
  const ImFont *text = ui.fonts.text, *small = ui.fonts.small;
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

void match_boxes(const Ui& ui, FormulaBox& one, FormulaBox& other) {
  if (one.parts.size() != other.parts.size() || one.parts.empty()) {
    one.width = other.width = std::max(one.width, other.width);
    return;
  }
  for (std::size_t at = 0; at < one.parts.size(); ++at) match_boxes(ui, one.parts[at], other.parts[at]);
  enclose_parts(ui, one), enclose_parts(ui, other);
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

}  // namespace zstep::viewer
