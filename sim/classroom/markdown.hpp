// Markdown as a flat list of blocks, each a row of runs: what a pane needs to draw a lesson's text, and no more.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace zstep {

/// A piece of text in one style. A hard line break is "\n" inside `text`; soft ones have become spaces.
struct TextRun {
  std::string text;
  bool bold = false, italic = false, code = false;
  bool operator==(const TextRun&) const = default;
};

/// A block, top to bottom. Lists are flat: an item knows how deep it stands and its number.
struct TextBlock {
  enum class Kind : std::uint8_t {
    paragraph,  ///< of a list item too, when it is not the item's first one; then depth > 0
    heading,    ///< level 1 … 6
    item,       ///< begins a list item: draw its bullet or its number
    code,       ///< one run whose text has the lines, each ended by "\n" but the last
    quote,      ///< a paragraph inside a block quote
    rule,       ///< a horizontal line; no runs
  };
  Kind kind = Kind::paragraph;
  std::int32_t level = 0;   ///< of a heading
  std::int32_t depth = 0;   ///< how many lists it stands in
  std::int32_t number = 0;  ///< of an item in an ordered list, else 0
  std::vector<TextRun> runs;
  bool operator==(const TextBlock&) const = default;
};

/// Reads CommonMark. Never fails: what is not Markdown is text. Raw HTML is text too, links and pictures are their
/// text.
std::vector<TextBlock> parse_markdown(std::string_view text);

/// What of the Markdown is read as words: no code, no marks, no targets of links. Views into `text`, in order.
std::vector<std::string_view> prose_of(std::string_view text);

/// The words alone, without any marks: for a terminal, a caption, a test.
std::string plain_text(const std::vector<TextBlock>& blocks);

}  // namespace zstep
