#include "sim/words/spoken.hpp"

#include <array>
#include <cctype>
#include <utility>

#include "sim/words/notation.hpp"

namespace zstep::words {
namespace {

using Kind = Notation::Kind;

struct Said {
  std::string_view sign, words;
};
constexpr std::array signs{
    Said{"\u2212", " minus "},    Said{"+", " plus "},
    Said{"\u00b7", " times "},    Said{"\u00d7", " times "},
    Said{"=", " equals "},        Said{"<", " less than "},
    Said{">", " greater than "},  Said{"\u2264", " at most "},
    Said{"\u2265", " at least "}, Said{"\u2260", " not equal to "},
    Said{"\u221e", "infinity"},   Said{"\u230a", " the floor of "},
    Said{"\u230b", ", "},         Said{"\u2308", " the ceiling of "},
    Said{"\u2309", ", "},         Said{"\u221a", " the root of "},
    Said{"\u00b2", " squared"},   Said{"\u00b0", " degrees"},
    Said{"\u2013", " to "},       Said{"\u2014", ", "},
    Said{"\u2192", " to "},       Said{"\u2190", " becomes "},
    Said{"\u2191", " up "},       Said{"\u2193", " "},
    Said{"\u2195", " "},          Said{"\u2717", " "},
    Said{"\u2713", " "},          Said{"\u25b6", " "},
    Said{"\u2026", "..."},        Said{"\u2032", " prime"},
    Said{"\u2019", "'"},          Said{"\u03b1", "alpha"},
    Said{"\u03b8", "theta"},      Said{"\u03c1", "rho"},
    Said{"\u03c6", "phi"},        Said{"\u0394", "delta "},
    Said{"%", " percent"},        Said{"&", " and "},
};

bool is_digit(char c) { return c >= '0' && c <= '9'; }
bool is_word(char c) {
  return std::isalnum(static_cast<unsigned char>(c)) != 0 || (static_cast<unsigned char>(c) & 0x80u) != 0;
}

/// A line, a bullet or another mark of a table, U+2500 to U+27BF, which the words beside it do without.
bool is_mark(std::string_view text) {
  return text.size() >= 3 && text[0] == '\xe2' && text[1] >= '\x94' && text[1] <= '\x9e';
}

/// One blank between words, none before a comma, a full stop or a closing bracket.
std::string tidied(const std::string& text) {
  std::string tidy;
  for (const char c : text) {
    const bool clings = c == ',' || c == '.' || c == ';' || c == ':' || c == '?' || c == ')';
    if (clings && !tidy.empty() && tidy.back() == ' ') tidy.pop_back();
    if (c == ',' && (tidy.empty() || tidy.back() == ',')) continue;
    if (c == ' ' && (tidy.empty() || tidy.back() == ' ' || tidy.back() == '(')) continue;
    tidy += c;
  }
  while (!tidy.empty() && (tidy.back() == ' ' || tidy.back() == ',')) tidy.pop_back();
  return tidy;
}

std::string with_words(std::string_view text) {
  std::string said;
  for (std::size_t at = 0; at < text.size();) {
    const char before = at > 0 ? text[at - 1] : ' ', here = text[at], after = at + 1 < text.size() ? text[at + 1] : ' ';
    const auto sees = [&](std::string_view sign) { return text.substr(at).starts_with(sign); };
    if (sees("\u00a0")) {  // it sets thousands apart
      const bool in_number = is_digit(before) && at + 2 < text.size() && is_digit(text[at + 2]);
      said += in_number ? "" : " ", at += 2;
    } else if (here == 'e' && is_digit(before) && (is_digit(after) || text.substr(at + 1).starts_with("\u2212"))) {
      said += " times 10 to the power ", ++at;
    } else if (here == '*') {
      said += " star ", ++at;
    } else if (here == '_') {
      said += " sub ", ++at;
    } else if (here == '\'' && is_word(before) && !is_word(after)) {
      said += " prime ", ++at;
    } else if (here == '/') {
      said += " over ", ++at;
    } else if (here == '[' || here == ']') {
      said += here == '[' ? " at " : " ", ++at;
    } else if (at == 0 && (sees("\u2192") || sees("\u2190"))) {  // an arrow at a mark, not between two things
      at += 3;
    } else {
      bool found = false;
      for (const Said& one : signs)
        if (!found && sees(one.sign)) said += one.words, at += one.sign.size(), found = true;
      if (!found && is_mark(text.substr(at))) said += ' ', at += 3;
      else if (!found) said += here, ++at;
    }
  }
  return said;
}

bool is_operand(const Notation& part) { return part.kind != Kind::text; }

std::string said_of(const Notation& part);

/// Long operands are set apart by commas, so that a listener hears where they end.
std::string side_of(const Notation& part) {
  const std::string said = said_of(part);
  return part.kind == Kind::row ? ", " + said + ", " : said;
}

std::string said_of(const Notation& part) {
  switch (part.kind) {
    case Kind::text:
      return part.text;
    case Kind::number:  // a negative one may stand in brackets
      return part.text.starts_with('(') ? part.text.substr(1, part.text.size() - 2) : part.text;
    case Kind::symbol:
      return part.text + (part.below.empty() ? "" : "_" + part.below);
    case Kind::fraction:
      return side_of(part.parts[0]) + " / " + side_of(part.parts[1]);
    case Kind::row:
      break;
  }
  std::string said;
  for (std::size_t i = 0; i < part.parts.size(); ++i) {
    const Notation& inner = part.parts[i];
    const bool product = i > 0 && is_operand(inner) && is_operand(part.parts[i - 1]);
    if (product) said += " \u00b7 ";
    const bool bracketed = inner.kind == Kind::text && (inner.text == "(" || inner.text == ")");
    said += bracketed ? ", " : said_of(inner);
  }
  return said;
}

}  // namespace

std::string spoken(std::string_view text) { return tidied(with_words(text)); }

std::string spoken_formula(std::string_view line) {
  std::string said;
  for (const Notation& side : read_notation(line)) said += (said.empty() ? "" : " = ") + said_of(side);
  return spoken(said);
}

}  // namespace zstep::words
