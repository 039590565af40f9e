// What every pane is given, how panes draw text, and how Dear ImGui draws what it draws itself.

#include "sim/viewer/panes/ui.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <cstring>
#include <string_view>
#include <utility>

#include "sim/viewer/draw/canvas.hpp"
#include "sim/viewer/panes/pseudo_code.hpp"
#include "sim/words/numbers.hpp"
#include "traces/text.hpp"

namespace zstep::viewer {

ImVec2 text_size(const Ui& ui, const ImFont* font, const std::string& text) {
  const std::string shown = ui.fonts.drawable(text);
  const ImVec2 size = font->CalcTextSizeA(font->FontSize, 1e9f, 0, shown.c_str(), shown.c_str() + shown.size());
  return {std::ceil(size.x), size.y};
}

void draw_text(const Ui& ui, ImVec2 at, const ImFont* font, ImU32 color, const std::string& text) {
  const std::string shown = ui.fonts.drawable(text);
  ImGui::GetWindowDrawList()->AddText(font, font->FontSize, {std::floor(at.x), std::floor(at.y)}, color, shown.c_str(),
                                      shown.c_str() + shown.size());
}

namespace {

/// Goes through a label's parts: what stands on the line, and what stands below it.
template <class Use>
void each_part(const std::string& text, Use&& use) {
  const auto is_letter = [&](std::size_t at) { return std::isalpha(static_cast<unsigned char>(text[at])) != 0; };
  const auto goes_below = [&](std::size_t at) { return std::isalnum(static_cast<unsigned char>(text[at])) != 0; };
  std::size_t done = 0;
  for (std::size_t bar = text.find('_'); bar != std::string::npos; bar = text.find('_', bar + 1)) {
    const bool symbol = bar > 0 && is_letter(bar - 1) && (bar < 2 || !goes_below(bar - 2));
    std::size_t end = bar + 1;
    while (end < text.size() && goes_below(end)) ++end;
    if (!symbol || end == bar + 1 || end > bar + 4) continue;
    use(text.substr(done, bar - done), false);
    use(text.substr(bar + 1, end - bar - 1), true);
    done = end;
  }
  if (done < text.size()) use(text.substr(done), false);
}

}  // namespace

ImVec2 label_size(const Ui& ui, const ImFont* font, const std::string& text) {
  ImVec2 size{0, font->FontSize};
  each_part(text, [&](const std::string& part, bool below) {
    size.x += text_size(ui, below ? ui.fonts.small : font, part).x + (below ? 1 : 0);
  });
  return size;
}

void draw_label(const Ui& ui, ImVec2 at, const ImFont* font, ImU32 color, const std::string& text) {
  each_part(text, [&](const std::string& part, bool below) {
    const ImFont* its = below ? ui.fonts.small : font;
    draw_text(ui, {at.x, at.y + (below ? std::round(0.28f * font->FontSize) : 0)}, its, color, part);
    at.x += text_size(ui, its, part).x + (below ? 1 : 0);
  });
}

namespace {

struct Word {
  std::string text;
  const ImFont* font;
  float width;
  bool space_before, code, breaks_line;
  bool is_below = false;  ///< a subscript
  bool stays = false;     ///< on the line of the one before
};

const ImFont* font_of(const Ui& ui, const TextRun& run, const Flow& how) {
  if (run.code) return ui.fonts.mono;
  if (run.bold) return ui.fonts.bold;
  return how.font ? how.font : ui.fonts.text;
}

/// Bytes of the longest beginning of a word, at least a character, that is no wider than this. What is much too long is
/// not measured whole.
std::size_t fitting(const Ui& ui, const ImFont* font, std::string_view text, float limit) {
  const auto border = [&](std::size_t at) {
    while (at < text.size() && continues_character(text[at])) ++at;
    return std::min(at, text.size());
  };
  const auto fits = [&](std::size_t bytes) {
    return text_size(ui, font, std::string(text.substr(0, bytes))).x <= limit;
  };
  std::size_t low = border(1), high = std::min<std::size_t>(border(64), text.size());
  while (high < text.size() && fits(high)) low = high, high = border(2 * high);
  if (high == text.size() && fits(high)) return high;
  for (std::size_t next = border(low + 1); next < high; next = border(low + 1)) {
    std::size_t middle = border(low + (high - low) / 2);
    if (middle <= low || middle >= high) middle = next;
    (fits(middle) ? low : high) = middle;
  }
  return low;
}

/// Cuts a word that is wider than a whole line into pieces that are not, at character borders.
void push_word(const Ui& ui, std::vector<Word>& words, std::string_view text, const ImFont* font, bool space, bool code,
               float limit) {
  while (!text.empty()) {
    const std::string piece(text.substr(0, fitting(ui, font, text, limit)));
    words.push_back({piece, font, text_size(ui, font, piece).x, space, code, false});
    text.remove_prefix(piece.size());
    space = false;
  }
}

/// Where a symbol's subscript begins in a word, at its "_", and its bytes with that: of one letter, and up to
/// three letters or digits below it, as in z_v and d_out. Names of files, steps and fields have more.
std::optional<std::pair<std::size_t, std::size_t>> subscript_in(std::string_view word) {
  const auto is_part = [&](std::size_t at) {
    return at < word.size() && (is_letter(word[at]) || is_digit(word[at]) || word[at] == '_');
  };
  for (std::size_t at = word.find('_'); at != std::string_view::npos; at = word.find('_', at + 1)) {
    if (at == 0 || word[at - 1] == '_') continue;
    std::size_t letter = at - 1, end = at + 1;
    while (letter > 0 && continues_character(word[letter])) --letter;
    while (is_part(end)) ++end;
    const bool one = (is_letter(word[letter]) || letter + 1 < at) && (letter == 0 || !is_part(letter - 1));
    if (one && end - at >= 2 && end - at <= 4) return std::pair(at, end - at);
  }
  return std::nullopt;
}

/// No line begins or ends with a relation such as "=", nor ends with a sign.
void keep_together(std::vector<Word>& words) {
  constexpr std::array<std::string_view, 8> relations{"=", "<", ">", "\u2264", "\u2265", "\u00b7", "\u00d7", "~"},
      signs{"+", "\u2212"};
  const auto is = [&](std::size_t at, const auto& any) { return std::ranges::find(any, words[at].text) != any.end(); };
  for (std::size_t at = 1; at < words.size(); ++at)
    words[at].stays = is(at, relations) || is(at - 1, relations) || is(at - 1, signs);
}

std::vector<Word> words_in(const Ui& ui, const std::vector<TextRun>& runs, const Flow& how, float limit) {
  std::vector<Word> words;
  bool space = false;
  for (const TextRun& run : runs) {
    const ImFont* font = font_of(ui, run, how);
    std::string word;
    const auto end_word = [&] {
      const std::string whole = std::exchange(word, {});
      std::string_view rest = whole;
      const bool sets = font->FontSize > ui.fonts.small->FontSize;
      for (auto below = sets ? subscript_in(rest) : std::nullopt; below; below = subscript_in(rest)) {
        const auto [at, bytes] = *below;
        push_word(ui, words, rest.substr(0, at), font, std::exchange(space, false), run.code, limit);
        const std::string lower(rest.substr(at + 1, bytes - 1));
        words.push_back({lower, ui.fonts.small, text_size(ui, ui.fonts.small, lower).x, false, run.code, false, true});
        rest.remove_prefix(at + bytes);
      }
      if (!rest.empty()) push_word(ui, words, rest, font, std::exchange(space, false), run.code, limit);
    };
    for (const char c : run.text) {
      if (c == '\n') {
        end_word();
        words.push_back({"", font, 0, false, false, true});
        space = false;
      } else if (c == ' ') {
        end_word();
        space = true;
      } else {
        word += c;
      }
    }
    end_word();
  }
  keep_together(words);
  return words;
}

/// Of a word and of those that follow without a space, or with one that no line breaks at: "A_1 = 2" is one.
float width_with_next(const std::vector<Word>& words, std::size_t at, float space) {
  float width = words[at].width;
  while (++at < words.size() && !words[at].breaks_line && (!words[at].space_before || words[at].stays))
    width += words[at].width + (words[at].space_before ? space : 0);
  return width;
}

void tell_numbers(const Ui& ui, const Word& word, ImVec2 at, const Flow& how) {
  for (const auto& [from, bytes] : numbers_in(word.text)) {
    const float left = at.x + text_size(ui, word.font, word.text.substr(0, from)).x;
    const std::string text = word.text.substr(from, bytes);
    how.on_number(text, {left, at.y},
                  {left + text_size(ui, word.font, text).x, at.y + std::round(word.font->FontSize * 1.15f)});
  }
}

float lay_out(Ui& ui, const std::vector<TextRun>& runs, const Flow& how, bool draw) {
  const ImVec2 origin = ImGui::GetCursorScreenPos();
  const float width = how.width > 0 ? how.width : std::max(ui.em, ImGui::GetContentRegionAvail().x);
  const ImU32 color = how.color ? how.color : ui.colors().text;
  const ImFont* base = how.font ? how.font : ui.fonts.text;
  const float line = std::round(base->FontSize * 1.28f);
  float x = 0, y = 0;
  const std::vector<Word> words = words_in(ui, runs, how, width - how.indent);
  for (std::size_t at_word = 0; at_word < words.size(); ++at_word) {
    const Word& word = words[at_word];
    if (word.breaks_line) {
      x = how.indent;
      y += line;
      continue;
    }
    const float space =
        word.space_before ? std::round(base->FontSize * 0.28f) + (word.font == ui.fonts.mono ? 2.0f : 0.0f) : 0;
    const bool first = x == 0 || (y > 0 && x == how.indent);
    // A bracket or a comma stays with what it stands at.
    const float whole = (word.space_before && !word.stays) || first
                            ? width_with_next(words, at_word, std::round(base->FontSize * 0.28f))
                            : word.width,
                needed = whole <= width - how.indent ? whole : word.width;
    if (!first && x + space + needed > width) {
      x = how.indent;
      y += line;
    } else if (!first) {
      x += space;
    }
    if (draw) {
      const float baseline =
          std::round(base->Ascent - word.font->Ascent + (word.is_below ? 0.18f * base->FontSize : 0.0f));
      const ImVec2 at{origin.x + x, origin.y + y + baseline};
      if (word.code && base != ui.fonts.mono) {
        const float top = origin.y + y + std::round(base->Ascent - ui.fonts.mono->Ascent);
        ImGui::GetWindowDrawList()->AddRectFilled(
            {at.x - 1, top - 1}, {at.x + word.width + 1, top + ui.fonts.mono->FontSize + 1}, ui.colors().head);
      }
      draw_text(ui, at, word.font, color, word.text);
      if (how.on_number) tell_numbers(ui, word, at, how);
    }
    x += word.width;
  }
  return y + line;
}

/// A line of code, each character in its column; a symbol's subscript takes those of its own.
void draw_code(const Ui& ui, ImVec2 at, const ImFont* font, std::string_view text, float column) {
  const ImU32 color = ui.colors().text;
  for (auto below = subscript_in(text); below; below = subscript_in(text)) {
    const auto [bar, bytes] = *below;
    const auto first = text.substr(0, bar);
    draw_text(ui, at, font, color, std::string(first));
    at.x += column * to_float(first.size() - std::ranges::count_if(first, continues_character));
    draw_text(ui, {at.x, at.y + std::round(0.25f * font->FontSize)}, ui.fonts.small, color,
              std::string(text.substr(bar + 1, bytes - 1)));
    at.x += column * to_float(bytes);
    text.remove_prefix(bar + bytes);
  }
  draw_text(ui, at, font, color, std::string(text));
}

/// A block of code in the width at the cursor: in smaller letters where it fits so, else broken.
void flow_code(Ui& ui, const std::string& code) {
  const float width = std::max(ui.em, ImGui::GetContentRegionAvail().x);
  const ImFont* font = ui.fonts.mono;
  float column = 0;
  const auto in = [&](const ImFont* letters) {
    font = letters, column = font->CalcTextSizeA(font->FontSize, 1e9f, 0, "0000000000").x / 10;
    return code_lines(ui.fonts.drawable(code), std::max(1, static_cast<int>(width / column)));
  };
  const std::size_t whole = std::count(code.begin(), code.end(), '\n') + 1;
  std::vector<CodeLine> lines = in(font);
  if (lines.size() > whole) {
    lines = in(ui.fonts.small);
    if (lines.size() > whole) lines = in(ui.fonts.mono);
  }
  const float line = std::round(font->FontSize * 1.28f);
  const ImVec2 at = ImGui::GetCursorScreenPos();
  for (std::size_t k = 0; k < lines.size(); ++k) {
    const float y = at.y + line * to_float(k);
    if (lines[k].continues) draw_text(ui, {at.x, y}, font, ui.colors().muted, "\u21b3");
    draw_code(ui, {at.x + column * to_float(lines[k].indent), y}, font, lines[k].text, column);
  }
  ImGui::Dummy({width, line * to_float(lines.size())});
}

}  // namespace

void flow(Ui& ui, const std::vector<TextRun>& runs, const Flow& how) {
  const float width = how.width > 0 ? how.width : ImGui::GetContentRegionAvail().x;
  ImGui::Dummy({std::max(1.0f, width), lay_out(ui, runs, how, true)});
}

void flow(Ui& ui, const std::string& text, const Flow& how) {
  flow(ui, std::vector<TextRun>{{text, false, false, false}}, how);
}

float flow_height(Ui& ui, const std::string& text, const Flow& how) {
  return lay_out(ui, std::vector<TextRun>{{text, false, false, false}}, how, false);
}

void flow_markdown(Ui& ui, const std::string& markdown) {
  for (const TextBlock& block : parse_markdown(markdown)) {
    const float indent = to_float(block.depth) * ui.em * 1.2f;
    Flow how;
    switch (block.kind) {
      case TextBlock::Kind::heading:
        how.font = ui.fonts.bold;
        break;
      case TextBlock::Kind::code:
      case TextBlock::Kind::quote:
        how.color = ui.colors().muted;
        break;
      case TextBlock::Kind::rule: {
        const ImVec2 at = ImGui::GetCursorScreenPos();
        ImGui::GetWindowDrawList()->AddRectFilled(at, {at.x + ImGui::GetContentRegionAvail().x, at.y + 1},
                                                  ui.colors().rule);
        ImGui::Dummy({1, ui.em * 0.4f});
        continue;
      }
      case TextBlock::Kind::item: {
        const ImVec2 at = ImGui::GetCursorScreenPos();
        draw_text(ui, {at.x + indent - ui.em, at.y}, ui.fonts.text, ui.colors().text,
                  block.number ? std::to_string(block.number) + "." : "\u2022");
        break;
      }
      case TextBlock::Kind::paragraph:
        break;
    }
    if (indent > 0) ImGui::SetCursorPosX(ImGui::GetCursorPosX() + indent);
    if (block.kind == TextBlock::Kind::code) flow_code(ui, block.runs.empty() ? "" : block.runs.front().text);
    else flow(ui, block.runs, how);
    ImGui::Dummy({1, std::round(ui.em * 0.35f)});
  }
}

void say_empty(Ui& ui, const std::string& why) { flow(ui, why, {.color = ui.colors().muted}); }

float scroll_for(float at, float height, float view) {
  const float page = view / 2, foot = view * 0.92f;
  if (page < 1 || at + height < foot) return 0;
  // In steps of half a view: the line begins between a tenth and six tenths of it, and the page rarely moves.
  const float target = std::max(0.0f, std::floor((at - view * 0.1f) / page) * page);
  // A line of many rows is shown to its end, unless its beginning would leave the view.
  return std::round(std::max(target, std::min(at, at + height - foot)));
}

bool begin_wrapped(Ui& ui, const char* id, ImVec2 size, ImGuiWindowFlags flags) {
  bool& overflows = ui.overflows[id];
  const ImVec4 grab =
      overflows ? ImGui::GetStyle().Colors[ImGuiCol_ScrollbarGrab] : ImGui::GetStyle().Colors[ImGuiCol_ScrollbarBg];
  ImGui::PushStyleColor(ImGuiCol_ScrollbarGrab, grab);
  if (!overflows)
    ImGui::PushStyleColor(ImGuiCol_ScrollbarGrabHovered, grab),
        ImGui::PushStyleColor(ImGuiCol_ScrollbarGrabActive, grab);
  const int pushed = overflows ? 1 : 3;
  const bool shown = ImGui::BeginChild(id, size, false, flags | ImGuiWindowFlags_AlwaysVerticalScrollbar);
  ImGui::PopStyleColor(pushed);
  overflows = ImGui::GetScrollMaxY() > 0;
  return shown;
}

void begin_part(Ui& ui, const char* id) {
  begin_wrapped(ui, id, ImGui::GetContentRegionAvail(), ImGuiWindowFlags_HorizontalScrollbar);
  if (ui.scroll_now) ImGui::SetScrollX(0), ImGui::SetScrollY(0);
}

void follow(Ui& ui, float top, float height) {
  if (!ui.scroll_now) return;
  ImGui::SetScrollY(scroll_for(top - ImGui::GetWindowPos().y + ImGui::GetScrollY(), height, ImGui::GetWindowHeight()));
}

void frame_box(const Ui& ui, ImVec2 a, ImVec2 b, ImU32 color, float thickness) {
  ImDrawList* list = ImGui::GetWindowDrawList();
  const float line = std::round(thickness * ui.thin);
  list->AddRectFilled(a, {b.x, a.y + line}, color);
  list->AddRectFilled({a.x, b.y - line}, b, color);
  list->AddRectFilled({a.x, a.y + line}, {a.x + line, b.y - line}, color);
  list->AddRectFilled({b.x - line, a.y + line}, {b.x, b.y - line}, color);
}

bool number_at(Ui& ui, ImVec2 a, ImVec2 b, const answers::Question& question, const std::string& written) {
  if (!ui.asks) return false;
  can_be_hit(ui, a, b);
  // What it lies on, a row of a table, may have taken the press already.
  if (!ImGui::IsWindowHovered(ImGuiHoveredFlags_AllowWhenBlockedByActiveItem) || !ImGui::IsMouseHoveringRect(a, b))
    return false;
  ImGui::GetWindowDrawList()->AddRectFilled({a.x, b.y - 2}, b, ui.colors().selected);
  ui.mouse_help = "Click: where this number comes from.";
  if (ImGui::IsMouseClicked(ImGuiMouseButton_Left)) ui.asked = question, ui.asked_as = written;
  if (ImGui::IsMouseClicked(ImGuiMouseButton_Right)) {
    ui.here = {{.text = "Where this number comes from", .asks = question, .asks_as = written}};
    if (!written.empty()) ui.here.push_back({.text = "Copy " + written, .copies = written});
  }
  return true;
}

std::string with_sign(Findings::Trust trust, const std::string& name) {
  return trust == Findings::Trust::wrong ? "! " + name : trust == Findings::Trust::follows ? "\u2190 " + name : name;
}

Findings::Trust trust_of(const Ui& ui, formulas::Place::In in, std::int64_t number) {
  return ui.findings ? ui.findings->trust({in, number}, ui.session.position()) : Findings::Trust::right;
}

void can_be_hit(Ui& ui, ImVec2 a, ImVec2 b) {
  if (!ui.targets) return;
  const ImVec2 low = ImGui::GetWindowDrawList()->GetClipRectMin(), high = ImGui::GetWindowDrawList()->GetClipRectMax();
  ui.targets->add({std::max(a.x, low.x), std::max(a.y, low.y)}, {std::min(b.x, high.x), std::min(b.y, high.y)});
}

namespace {

ImVec2 button_size(const Ui& ui, const std::string& label) {
  const float text = text_size(ui, ui.fonts.text, label.substr(0, label.find("##"))).x;
  return {text + 2 * std::round(ui.em * 0.55f), ui.em + 2 * std::round(ui.em * 0.25f) + 2};
}

}  // namespace

bool button(Ui& ui, const std::string& label, bool lit, bool enabled) {
  return button_of(ui, label, button_size(ui, label), lit, enabled);
}

bool tall_button(Ui& ui, const std::string& label, bool lit, bool enabled) {
  const ImVec2 size = button_size(ui, label);
  return button_of(ui, label, {std::max(size.x, ui.least_target), std::max(size.y, ui.least_target)}, lit, enabled);
}

bool button_of(Ui& ui, const std::string& label, ImVec2 size, bool lit, bool enabled) {
  const std::string shown = label.substr(0, label.find("##"));
  const ImVec2 at = ImGui::GetCursorScreenPos(), end{at.x + size.x, at.y + size.y};
  const ImVec2 text{at.x + std::floor((size.x - text_size(ui, ui.fonts.text, shown).x) / 2),
                    at.y + std::floor((size.y - ui.em - 2) / 2)};
  can_be_hit(ui, at, end);
  const bool clicked = ImGui::InvisibleButton(label.c_str(), {end.x - at.x, end.y - at.y}) && enabled;
  const bool hovered = ImGui::IsItemHovered() && enabled;
  const Theme& c = ui.colors();
  ImDrawList* list = ImGui::GetWindowDrawList();
  list->AddRectFilled(at, end, lit ? c.now_soft : hovered ? c.button_hovered : c.button);
  frame_box(ui, at, end, lit ? c.now : c.rule);
  draw_text(ui, text, ui.fonts.text, enabled ? c.text : c.muted, shown);
  return clicked;
}

void tooltip(Ui& ui, const std::vector<std::string>& lines, std::optional<ImVec2> at) {
  if (ui.reads) return;
  float width = 0;
  for (const std::string& line : lines) width = std::max(width, text_size(ui, ui.fonts.mono, line).x);
  if (at) ImGui::SetNextWindowPos(*at);
  ImGui::BeginTooltip();
  for (const std::string& line : lines) {
    draw_text(ui, ImGui::GetCursorScreenPos(), ui.fonts.mono, ui.colors().text, line);
    ImGui::Dummy({width, std::round(ui.fonts.mono->FontSize * 1.2f)});
  }
  ImGui::EndTooltip();
}

namespace {

ImVec4 to_vec4(ImU32 c) { return ImGui::ColorConvertU32ToFloat4(c); }

}  // namespace

void apply_style(const Ui& ui) {
  const Theme& c = ui.colors();
  ImGuiStyle& style = ImGui::GetStyle();
  // Straight edges only: the software renderer draws rectangles by blitting, and triangles one pixel at a time.
  style.AntiAliasedLines = style.AntiAliasedLinesUseTex = style.AntiAliasedFill = false;
  style.WindowRounding = style.ChildRounding = style.FrameRounding = style.PopupRounding = style.ScrollbarRounding =
      style.GrabRounding = 0;
  style.WindowBorderSize = style.ChildBorderSize = 0;
  style.PopupBorderSize = 1;
  style.WindowMinSize = {1, 1};
  style.ScrollbarSize = std::round(ui.em * 0.6f);
  style.GrabMinSize = std::round(ui.em * 0.75f);  // which versions of Dear ImGui have otherwise
  style.WindowPadding = {std::round(ui.em * 0.5f), std::round(ui.em * 0.35f)};
  style.ItemSpacing = {std::round(ui.em * 0.4f), 0};
  style.Colors[ImGuiCol_Text] = to_vec4(c.text);
  style.Colors[ImGuiCol_WindowBg] = to_vec4(c.window);
  style.Colors[ImGuiCol_ChildBg] = to_vec4(c.pane);
  style.Colors[ImGuiCol_PopupBg] = to_vec4(c.pane);
  style.Colors[ImGuiCol_Border] = to_vec4(c.rule);
  style.Colors[ImGuiCol_ScrollbarBg] = to_vec4(c.pane);
  style.Colors[ImGuiCol_ScrollbarGrab] = to_vec4(c.rule);
  style.Colors[ImGuiCol_ScrollbarGrabHovered] = style.Colors[ImGuiCol_ScrollbarGrabActive] = to_vec4(c.muted);
}

}  // namespace zstep::viewer
