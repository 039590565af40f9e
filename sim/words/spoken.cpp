#include "sim/words/spoken.hpp"

#include <array>
#include <utility>

#include "sim/words/notation.hpp"
#include "traces/text.hpp"

namespace zstep::words {
namespace {

using Kind = Notation::Kind;

struct Said {
  std::string_view sign, words;
};
constexpr std::array signs{
    Said{"\u2212", " minus "},
    Said{"+", " plus "},
    Said{"\u00b7", " times "},
    Said{"\u00d7", " times "},
    Said{"=", " equals "},
    Said{"<", " less than "},
    Said{">", " greater than "},
    Said{"\u2264", " at most "},
    Said{"\u2265", " at least "},
    Said{"\u2260", " not equal to "},
    Said{"\u221e", "infinity"},
    Said{"\u230a", " the floor of "},
    Said{"\u230b", ", "},
    Said{"\u2308", " the ceiling of "},
    Said{"\u2309", ", "},
    Said{"\u221a", " the root of "},
    Said{"\u00b2", " squared"},
    Said{"\u00b0", " degrees"},
    Said{"\u2013", " to "},
    Said{"\u2014", ", "},
    Said{"\u2192", " to "},
    Said{"\u2190", " becomes "},
    Said{"\u2191", " up "},
    Said{"\u2193", " "},
    Said{"\u2195", " "},
    Said{"\u2717", " "},
    Said{"\u2713", " "},
    Said{"\u25b6", " "},
    Said{"\u2026", "..."},
    Said{"\u2032", " prime"},
    Said{"\u2019", "'"},
    Said{"\u2206", "delta "},
    Said{"\u2248", " about "},
    Said{"\u00b1", " plus or minus "},
    Said{"\u2211", " the sum of "},
    Said{"\u22c5", " times "},
    Said{"\u00bd", " one half "},
    Said{"\u00bc", " one quarter "},
    Said{"\u00be", " three quarters "},
    Said{"\u00b3", " cubed"},
    Said{"\u00b5s", " microseconds"},
    Said{"\u00b5", "micro"},
    Said{"\u2022", " "},
    Said{"\u21b3", " "},
    Said{"%", " percent"},
    Said{"&", " and "},
};

/// U+03B1 to U+03C9; the capitals stand 32 before.
constexpr std::array<std::string_view, 25> greek{
    "alpha", "beta",    "gamma", "delta", "epsilon", "zeta",  "eta", "theta",   "iota", "kappa", "lambda", "mu",   "nu",
    "xi",    "omicron", "pi",    "rho",   "sigma",   "sigma", "tau", "upsilon", "phi",  "chi",   "psi",    "omega"};

bool is_word(char c) { return is_letter(c) || is_digit(c) || is_beyond_ascii(c); }

/// The code point of two or three bytes at `at`, 0 for any other, and how many bytes it takes.
std::pair<unsigned, std::size_t> code_at(std::string_view text, std::size_t at) {
  const auto byte = [&](std::size_t k) { return at + k < text.size() ? byte_of(text[at + k]) : 0u; };
  if ((byte(0) & 0xe0u) == 0xc0u) return {(byte(0) & 0x1fu) << 6 | (byte(1) & 0x3fu), 2};
  if ((byte(0) & 0xf0u) == 0xe0u) return {(byte(0) & 0x0fu) << 12 | (byte(1) & 0x3fu) << 6 | (byte(2) & 0x3fu), 3};
  return {0, 1};
}
/// "beta", "sub 2", "to the power 4": letters and digits that are no ASCII; empty for others.
std::string letter_or_digit(unsigned code) {
  constexpr unsigned alpha = 0x3b1, capital_alpha = 0x391;
  if (code >= alpha && code < alpha + greek.size()) return std::string(greek[code - alpha]);
  if (code == 0x394) return "delta";
  if (code >= capital_alpha && code < capital_alpha + greek.size())
    return "capital " + std::string(greek[code - capital_alpha]);
  if (code >= 0x2080 && code <= 0x2089) return "sub " + std::to_string(code - 0x2080);
  if (code == 0x2070 || (code >= 0x2074 && code <= 0x2079)) return "to the power " + std::to_string(code - 0x2070);
  return {};
}

bool is_ascii_letter(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); }
/// The letters that end just before `at`, and those that begin there.
std::string_view letters_before(std::string_view text, std::size_t at) {
  std::size_t from = at;
  while (from > 0 && is_ascii_letter(text[from - 1])) --from;
  return text.substr(from, at - from);
}
std::string_view letters_from(std::string_view text, std::size_t at) {
  std::size_t end = at;
  while (end < text.size() && is_ascii_letter(text[end])) ++end;
  return text.substr(at, end - at);
}
/// "in/out", and neither "a/z" nor "dz/dx".
bool parts_words(std::string_view text, std::size_t bar) {
  const std::string_view one = letters_before(text, bar), other = letters_from(text, bar + 1);
  const bool derivative = one.starts_with('d') && other.starts_with('d') && one.size() == 2 && other.size() == 2;
  return one.size() >= 2 && other.size() >= 2 && !derivative;
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
    } else if (here == '_') {  // of a symbol; in the name of a field it sets words apart
      said += letters_before(text, at).size() > 2 ? " " : " sub ", ++at;
    } else if (here == '\'' && letters_before(text, at).size() == 1 && !is_word(after)) {
      said += " prime ", ++at;
    } else if (here == '/') {
      said += parts_words(text, at) ? " or " : " over ", ++at;
    } else if (here == '[' || here == ']') {
      said += here == '[' ? " at " : " ", ++at;
    } else if (at == 0 && (sees("\u2192") || sees("\u2190"))) {  // an arrow at a mark, not between two things
      at += 3;
    } else {
      const auto [code, bytes] = code_at(text, at);
      const std::string name = letter_or_digit(code);
      bool found = !name.empty();
      if (found) {
        const bool joined = at + bytes < text.size() && is_ascii_letter(text[at + bytes]);
        said += (is_word(before) ? " " : "") + name + (joined ? " " : ""), at += bytes;
      }
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
