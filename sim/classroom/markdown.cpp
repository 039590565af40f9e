#include "sim/classroom/markdown.hpp"

#include <array>
#include <cstdlib>
#include <utility>

#include <md4c.h>

#include "traces/scene.hpp"
#include "traces/text.hpp"

namespace zstep {
namespace {

struct OpenList {
  bool ordered = false;
  std::int32_t next_number = 0;
};

/// Collects md4c's callbacks. A block is begun when its first text may come, and ended by whatever comes next.
struct Builder {
  std::vector<TextBlock> blocks;
  std::vector<OpenList> lists;
  std::int32_t quotes = 0;
  bool item_is_fresh = false;  // the next paragraph is the item's own
  std::int32_t bold = 0, italic = 0, code = 0;

  TextBlock& begin(TextBlock::Kind kind) {
    blocks.emplace_back();
    blocks.back().kind = kind;
    blocks.back().depth = size32(lists);
    return blocks.back();
  }

  void enter_block(MD_BLOCKTYPE type, void* detail) {
    switch (type) {
      case MD_BLOCK_UL:
        lists.push_back({});
        break;
      case MD_BLOCK_OL:
        lists.push_back({true, static_cast<std::int32_t>(static_cast<MD_BLOCK_OL_DETAIL*>(detail)->start)});
        break;
      case MD_BLOCK_LI:
        begin(TextBlock::Kind::item);
        if (lists.back().ordered) blocks.back().number = lists.back().next_number++;
        item_is_fresh = true;
        break;
      case MD_BLOCK_H:
        begin(TextBlock::Kind::heading).level =
            static_cast<std::int32_t>(static_cast<MD_BLOCK_H_DETAIL*>(detail)->level);
        break;
      case MD_BLOCK_P:
        if (!item_is_fresh) begin(quotes > 0 ? TextBlock::Kind::quote : TextBlock::Kind::paragraph);
        item_is_fresh = false;
        break;
      case MD_BLOCK_CODE:
        begin(TextBlock::Kind::code);
        item_is_fresh = false;
        break;
      case MD_BLOCK_HR:
        begin(TextBlock::Kind::rule);
        break;
      case MD_BLOCK_QUOTE:
        ++quotes;
        break;
      default:
        break;
    }
  }

  void leave_block(MD_BLOCKTYPE type) {
    switch (type) {
      case MD_BLOCK_UL:
      case MD_BLOCK_OL:
        lists.pop_back();
        break;
      case MD_BLOCK_LI:
        item_is_fresh = false;
        break;
      case MD_BLOCK_QUOTE:
        --quotes;
        break;
      case MD_BLOCK_CODE:
        if (!blocks.back().runs.empty() && !blocks.back().runs.front().text.empty()) {
          blocks.back().runs.front().text.pop_back();  // md4c ends the last line too
        }
        break;
      default:
        break;
    }
  }

  void span(MD_SPANTYPE type, std::int32_t change) {
    if (type == MD_SPAN_STRONG) bold += change;
    if (type == MD_SPAN_EM) italic += change;
    if (type == MD_SPAN_CODE) code += change;
  }

  void add(std::string_view text) {
    if (blocks.empty()) begin(TextBlock::Kind::paragraph);
    TextBlock& block = blocks.back();
    const bool as_code = code > 0 || block.kind == TextBlock::Kind::code;
    const TextRun style{{}, bold > 0, italic > 0, as_code};
    if (!block.runs.empty()) {
      const TextRun& last = block.runs.back();
      if (last.bold == style.bold && last.italic == style.italic && last.code == style.code) {
        block.runs.back().text += text;
        return;
      }
    }
    block.runs.push_back(style);
    block.runs.back().text = text;
  }
};

void append_utf8(std::string& out, unsigned long code) {
  if (code == 0 || code > 0x10FFFF || (code >= 0xD800 && code < 0xE000)) code = 0xFFFD;
  const auto byte = [&](unsigned long value) { out += static_cast<char>(value); };
  if (code < 0x80) {
    byte(code);
  } else if (code < 0x800) {
    byte(0xC0 | (code >> 6));
    byte(0x80 | (code & 0x3F));
  } else if (code < 0x10000) {
    byte(0xE0 | (code >> 12));
    byte(0x80 | ((code >> 6) & 0x3F));
    byte(0x80 | (code & 0x3F));
  } else {
    byte(0xF0 | (code >> 18));
    byte(0x80 | ((code >> 12) & 0x3F));
    byte(0x80 | ((code >> 6) & 0x3F));
    byte(0x80 | (code & 0x3F));
  }
}

/// "&lt;" as "<", "&#955;" as "λ". md4c hands entities on verbatim; the few names that lesson writers use are known
/// here. Other names stay as written, and so do numbers of characters that would do something, as "&#27;".
std::string entity(std::string_view written) {
  static constexpr std::array<std::pair<std::string_view, std::string_view>, 6> known{
      {{"&lt;", "<"}, {"&gt;", ">"}, {"&amp;", "&"}, {"&quot;", "\""}, {"&apos;", "'"}, {"&nbsp;", "\u00A0"}}};
  for (const auto& [name, text] : known) {
    if (written == name) return std::string(text);
  }
  if (written.size() > 3 && written[1] == '#') {
    const bool hexadecimal = written[2] == 'x' || written[2] == 'X';
    const std::string digits(written.substr(hexadecimal ? 3 : 2));  // md4c has checked them
    std::string text;
    append_utf8(text, std::strtoul(digits.c_str(), nullptr, hexadecimal ? 16 : 10));
    if (printable(text) == text) return text;
  }
  return std::string(written);
}

Builder& builder(void* user) { return *static_cast<Builder*>(user); }

int on_enter_block(MD_BLOCKTYPE type, void* detail, void* user) {
  builder(user).enter_block(type, detail);
  return 0;
}
int on_leave_block(MD_BLOCKTYPE type, void*, void* user) {
  builder(user).leave_block(type);
  return 0;
}
int on_enter_span(MD_SPANTYPE type, void*, void* user) {
  builder(user).span(type, 1);
  return 0;
}
int on_leave_span(MD_SPANTYPE type, void*, void* user) {
  builder(user).span(type, -1);
  return 0;
}
int on_text(MD_TEXTTYPE type, const MD_CHAR* text, MD_SIZE size, void* user) {
  const std::string_view written(text, size);
  switch (type) {
    case MD_TEXT_SOFTBR:
      builder(user).add(" ");
      break;
    case MD_TEXT_BR:
      builder(user).add("\n");
      break;
    case MD_TEXT_NULLCHAR:
      builder(user).add("\uFFFD");
      break;
    case MD_TEXT_ENTITY:
      builder(user).add(entity(written));
      break;
    default:
      builder(user).add(written);
      break;
  }
  return 0;
}

constexpr unsigned dialect = MD_FLAG_NOHTML | MD_FLAG_NOINDENTEDCODEBLOCKS;

}  // namespace

std::vector<TextBlock> parse_markdown(std::string_view text) {
  MD_PARSER parser{};
  parser.flags = dialect;
  parser.enter_block = on_enter_block;
  parser.leave_block = on_leave_block;
  parser.enter_span = on_enter_span;
  parser.leave_span = on_leave_span;
  parser.text = on_text;
  Builder build;
  md_parse(text.data(), static_cast<MD_SIZE>(text.size()), &parser, &build);
  return std::move(build.blocks);
}

std::vector<std::string_view> prose_of(std::string_view text) {
  MD_PARSER parser{};
  parser.flags = dialect;
  parser.enter_block = parser.leave_block = [](MD_BLOCKTYPE, void*, void*) { return 0; };
  parser.enter_span = parser.leave_span = [](MD_SPANTYPE, void*, void*) { return 0; };
  parser.text = [](MD_TEXTTYPE type, const MD_CHAR* piece, MD_SIZE size, void* user) {
    if (type == MD_TEXT_NORMAL) static_cast<std::vector<std::string_view>*>(user)->emplace_back(piece, size);
    return 0;
  };
  std::vector<std::string_view> prose;
  md_parse(text.data(), static_cast<MD_SIZE>(text.size()), &parser, &prose);
  return prose;
}

std::string plain_text(const std::vector<TextBlock>& blocks) {
  std::string plain;
  for (const TextBlock& block : blocks) {
    if (!plain.empty()) plain += '\n';
    for (const TextRun& run : block.runs) plain += run.text;
  }
  return plain;
}

}  // namespace zstep
