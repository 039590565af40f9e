#include "sim/words/notation.hpp"

#include <algorithm>
#include <array>
#include <optional>
#include <utility>

#include "sim/words/numbers.hpp"
#include "traces/text.hpp"

namespace zstep::words {
namespace {

using Kind = Notation::Kind;

constexpr int deepest = 32, most_bars = 8;
constexpr std::array<std::pair<std::string_view, std::string_view>, 3> brackets{
    {{"(", ")"}, {"\u230a", "\u230b"}, {"\u2308", "\u2309"}}};

/// Greek ones, too.
bool is_any_letter(char c) { return is_letter(c) || is_beyond_ascii(c); }

/// Signs that are no letters, though their bytes are beyond ASCII.
constexpr std::array<std::string_view, 16> signs{"\u2212", "\u00b7", "\u00d7", "\u230a", "\u230b", "\u2308",
                                                 "\u2309", "\u2264", "\u2265", "\u2260", "\u2026", "\u00a0",
                                                 "\u2192", "\u2190", "\u221e", "\u2013"};

class Reader {
 public:
  explicit Reader(std::string_view text)
      : text_(text), numbers_(numbers_in(text)), closed_at_(closings(text)), end_(text.size()) {}

  Notation all() {
    Notation row{Kind::row};
    while (at_ < end_) add(row, next(0));
    return row;
  }

 private:
  static constexpr std::size_t never = std::string_view::npos;

  /// For each byte where a bracket opens that is closed: where it closes.
  static std::vector<std::size_t> closings(std::string_view text) {
    std::vector<std::size_t> closed_at(text.size(), never);
    std::vector<std::pair<std::size_t, std::string_view>> open;  // where, and by what it is closed
    for (std::size_t at = 0; at < text.size(); ++at)
      for (const auto& [opens, closes] : brackets) {
        if (text.substr(at).starts_with(opens)) open.emplace_back(at, closes);
        if (!text.substr(at).starts_with(closes) || open.empty() || open.back().second != closes) continue;
        closed_at[open.back().first] = at;
        open.pop_back();
      }
    return closed_at;
  }

  bool sees(std::string_view sign) const { return text_.substr(at_, end_ - at_).starts_with(sign); }
  bool take(std::string_view sign) {
    if (!sees(sign)) return false;
    at_ += sign.size();
    return true;
  }

  /// Text beside text is one.
  static void add(Notation& row, Notation part) {
    if (part.kind == Kind::text && !row.parts.empty() && row.parts.back().kind == Kind::text)
      row.parts.back().text += part.text;
    else row.parts.push_back(std::move(part));
  }

  Notation next(int depth) {
    if (auto product = this->product(depth)) return *std::move(product);
    // A sign, or a character that belongs to nothing.
    std::size_t end = at_ + 1;
    while (end < end_ && continues_character(text_[end])) ++end;
    const std::size_t from = std::exchange(at_, end);
    return {Kind::text, std::string(text_.substr(from, end - from))};
  }

  /// Operands with signs of multiplication or none between; what stands before a "/" is all above the line.
  std::optional<Notation> product(int depth) {
    const bool signed_number = is_number();
    if (const std::size_t before = at_; !signed_number && depth <= deepest && take("\u2212")) {
      if (auto negated = product(depth + 1))
        return Notation{Kind::row, {}, {}, {Notation{Kind::text, "\u2212"}, *std::move(negated)}};
      at_ = before;
      return std::nullopt;
    }
    std::optional<Notation> first = operand(depth);
    if (!first) return std::nullopt;
    Notation row{Kind::row, {}, {}, {*std::move(first)}};
    for (int bars = 0; at_ < end_;) {
      const std::size_t before = at_;
      const bool divides = !is_word(row.parts.back()) && bars < most_bars && take("/"),
                 times = !divides && (take("\u00b7") || take(" \u00d7 "));
      const std::string sign(text_.substr(before, at_ - before));
      const bool beside = !divides && !times && sees("(") && !is_word(row.parts.back());
      std::optional<Notation> right = divides || times || beside ? operand(depth) : std::nullopt;
      if (!right || (divides && is_word(*right))) {
        at_ = before;
        break;
      }
      bars += divides;
      if (divides) row = Notation{Kind::row, {}, {}, {over(std::move(row), *std::move(right))}};
      else if (times) row.parts.push_back({Kind::text, sign}), row.parts.push_back(*std::move(right));
      else row.parts.push_back(*std::move(right));
    }
    return row.parts.size() == 1 ? std::move(row.parts.front()) : std::move(row);
  }
  /// Letters alone may be a word or a polygon's name: then a bracket behind it is no factor, and what it is parted from
  /// by "/" is no fraction.
  static bool is_word(const Notation& part) {
    return part.kind == Kind::symbol && part.below.empty() && part.text.size() > 2;
  }

  std::vector<std::pair<std::size_t, std::size_t>>::const_iterator next_number() const {
    return std::lower_bound(numbers_.begin(), numbers_.end(), std::pair{at_, std::size_t{0}});
  }
  bool is_number() const {
    const auto next = next_number();
    return next != numbers_.end() && next->first == at_;
  }
  /// "dz/dx" is one operand, whatever stands before it.
  bool is_derivative() const {
    const std::string_view rest = text_.substr(at_, end_ - at_);
    const std::size_t bar = rest.find("/d");
    return rest.starts_with("d") && (bar == 2 || (bar == 3 && rest[2] == '*')) && is_any_letter(rest[1]) &&
           bar + 2 < rest.size() && is_any_letter(rest[bar + 2]) &&
           (bar + 3 == rest.size() || !is_any_letter(rest[bar + 3]));
  }

  std::optional<Notation> operand(int depth) {
    if (depth > deepest) return std::nullopt;
    if (is_number()) {
      const std::size_t from = std::exchange(at_, at_ + next_number()->second);
      return Notation{Kind::number, std::string(text_.substr(from, at_ - from))};
    }
    if (is_derivative()) {
      const std::size_t bar = text_.find('/', at_), from = std::exchange(at_, bar + 3);
      return Notation{Kind::fraction,
                      {},
                      {},
                      {Notation{Kind::symbol, std::string(text_.substr(from, bar - from))},
                       Notation{Kind::symbol, std::string(text_.substr(bar + 1, 2))}}};
    }
    for (const auto& [open, close] : brackets) {
      if (!sees(open)) continue;
      if (closed_at_[at_] == never) return std::nullopt;
      return in_brackets(std::string(open), inside(open, close, depth), std::string(close));
    }
    return symbol();
  }

  /// What stands between brackets; afterwards behind them.
  std::vector<Notation> inside(std::string_view open, std::string_view close, int depth) {
    const std::size_t closing = closed_at_[at_], end = std::exchange(end_, closing);
    at_ += open.size();
    Notation row{Kind::row};
    while (at_ < end_) add(row, next(depth + 1));
    end_ = end;
    at_ = closing + close.size();
    return std::move(row.parts);
  }

  static Notation in_brackets(std::string open, std::vector<Notation> inside, std::string close) {
    // A negative number's brackets belong to it.
    if (inside.size() == 1 && inside.front().kind == Kind::number && open == "(")
      return {Kind::number, open + inside.front().text + close};
    inside.insert(inside.begin(), Notation{Kind::text, std::move(open)});
    inside.push_back(Notation{Kind::text, std::move(close)});
    return {Kind::row, {}, {}, std::move(inside)};
  }

  bool at_sign() const {
    return std::any_of(signs.begin(), signs.end(), [&](std::string_view sign) { return sees(sign); });
  }
  /// "x", "x_L", "z*_L", "V0", "zbuffer[x,y]".
  std::optional<Notation> symbol() {
    const std::size_t begin = at_;
    while (at_ < end_ && (is_any_letter(text_[at_]) || (at_ > begin && is_digit(text_[at_]))) && !at_sign()) ++at_;
    if (at_ == begin) return std::nullopt;
    if (at_ - begin == 1 && text_[begin] == 'z') take("*");
    // Behind a single letter it is a prime, behind a word an apostrophe.
    const bool single = at_ - begin == 1 || text_.substr(begin, at_ - begin) == "z*";
    const bool before_letter = at_ + 1 < end_ && is_any_letter(text_[at_ + 1]);
    if (single && sees("'") && !before_letter) take("'");
    if (!single && before_letter && take("'"))
      while (at_ < end_ && is_any_letter(text_[at_]) && !at_sign()) ++at_;
    Notation found{Kind::symbol, std::string(text_.substr(begin, at_ - begin))};
    if (const std::size_t below = at_; take("_")) {
      while (at_ < end_ && (is_any_letter(text_[at_]) || is_digit(text_[at_]) || text_[at_] == '_') && !at_sign())
        ++at_;
      found.below = text_.substr(below + 1, at_ - below - 1);
      if (found.below.empty()) at_ = below;
    }
    if (sees("[")) {
      const std::size_t end = text_.find(']', at_);
      if (end < end_ && found.below.empty()) {
        const std::size_t from = std::exchange(at_, end + 1);
        found.text += text_.substr(from, end + 1 - from);
      }
    }
    return found;
  }

  /// What is one bracket needs none above and below a line.
  static Notation bare(Notation part) {
    const bool bracketed = part.kind == Kind::row && part.parts.size() > 2 && part.parts.front().text == "(" &&
                           part.parts.back().text == ")";
    if (bracketed) part.parts.erase(part.parts.begin()), part.parts.pop_back();
    return part.parts.size() == 1 ? Notation(part.parts.front()) : part;
  }
  static Notation over(Notation above, Notation below) {
    if (above.parts.size() == 1) above = Notation(above.parts.front());
    return {Kind::fraction, {}, {}, {bare(std::move(above)), bare(std::move(below))}};
  }

  std::string_view text_;
  std::vector<std::pair<std::size_t, std::size_t>> numbers_;
  std::vector<std::size_t> closed_at_;
  std::size_t at_ = 0, end_;
};

}  // namespace

std::vector<Notation> read_notation(std::string_view line) {
  std::vector<Notation> sides;
  constexpr std::string_view equals = " = ";
  for (std::size_t from = 0; from <= line.size();) {
    const std::size_t end = std::min(line.find(equals, from), line.size());
    sides.push_back(Reader(line.substr(from, end - from)).all());
    from = end + equals.size();
  }
  return sides;
}

std::string on_one_line(const Notation& part) {
  std::string text = part.text;
  if (!part.below.empty()) text += "_" + part.below;
  if (part.kind == Kind::fraction) {
    const auto operand = [](const Notation& side, bool below) {
      const std::string line = on_one_line(side);
      const bool single = side.parts.empty() || (!below && line.find(' ') == std::string::npos);
      return single ? line : "(" + line + ")";
    };
    return operand(part.parts[0], false) + "/" + operand(part.parts[1], true);
  }
  for (const Notation& inner : part.parts) text += on_one_line(inner);
  return text;
}

bool alike(const Notation& one, const Notation& other) {
  const auto leaf = [](const Notation& part) { return part.kind == Kind::number || part.kind == Kind::symbol; };
  // What is called dz/dx or 1/m is one number.
  const auto name = [&](const Notation& part) {
    return part.kind == Kind::fraction && leaf(part.parts[0]) && part.parts[1].kind == Kind::symbol;
  };
  if ((name(one) && other.kind == Kind::number) || (name(other) && one.kind == Kind::number)) return true;
  if (leaf(one) && leaf(other)) return true;
  return one.kind == other.kind && one.parts.size() == other.parts.size() &&
         (one.kind != Kind::text || one.text == other.text) &&
         std::equal(one.parts.begin(), one.parts.end(), other.parts.begin(), alike);
}

}  // namespace zstep::words
