#include "tests/fuzz/text_mutator.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <fstream>
#include <set>
#include <sstream>
#include <string_view>

#include "tests/where.hpp"

namespace zstep::fuzz {

namespace {

constexpr std::array<std::string_view, 36> hard_words{"0",
                                                      "-0",
                                                      "1",
                                                      "-1",
                                                      "0.5",
                                                      "1e5",
                                                      "1E+5",
                                                      "1e999",
                                                      "-1e308",
                                                      "1e-320",
                                                      "5.0",
                                                      "00",
                                                      ".5",
                                                      "1.",
                                                      "+1",
                                                      "0x10",
                                                      "1,5",
                                                      "2147483647",
                                                      "2147483648",
                                                      "-2147483648",
                                                      "4294967296",
                                                      "9223372036854775807",
                                                      "9007199254740993",
                                                      "nan",
                                                      "NaN",
                                                      "\"nan\"",
                                                      "inf",
                                                      "\"inf\"",
                                                      "\"-inf\"",
                                                      "null",
                                                      "true",
                                                      "True",
                                                      "[]",
                                                      "{}",
                                                      "\"\"",
                                                      "'a'"};

bool in_word(char c) {
  const auto byte = static_cast<unsigned char>(c);
  return std::isalnum(byte) != 0 || c == '_' || c == '.' || c == '-' || byte >= 0x80;
}

struct Part {
  std::size_t begin = 0, size = 0;
};

/// The word at a place, or the one character there.
Part word_at(const std::string& text, std::size_t at) {
  if (text.empty()) return {};
  if (!in_word(text[at])) return {at, 1};
  std::size_t begin = at, end = at;
  while (begin > 0 && in_word(text[begin - 1])) --begin;
  while (end < text.size() && in_word(text[end])) ++end;
  return {begin, end - begin};
}

Part line_at(const std::string& text, std::size_t at) {
  const std::size_t before = at == 0 ? std::string::npos : text.rfind('\n', at - 1);
  const std::size_t begin = before == std::string::npos ? 0 : before + 1;
  return {begin, std::min(text.find('\n', at), text.size() - 1) + 1 - begin};
}

/// What stands between two commas of a line: a member, with the comma before it.
Part member_at(const std::string& text, std::size_t at) {
  const std::size_t begin = text.rfind(',', at);
  if (begin == std::string::npos) return {at, 0};
  const std::size_t end = text.find_first_of(",}]\n", begin + 1);
  return {begin, std::min(end, text.size()) - begin};
}

/// The head of a text decides how all the rest is read.
std::size_t place_in(const std::string& text, Random& random) {
  const std::size_t head = std::min(text.find('\n'), text.size());
  return pick(random, random() % 3 == 0 ? head : text.size());
}

void cut_words(std::string_view text, std::set<std::string>& words) {
  for (std::size_t at = 0; at < text.size(); ++at) {
    const std::size_t begin = at;
    while (at < text.size() && in_word(text[at])) ++at;
    if (at > begin && at - begin < 40) words.emplace(text.substr(begin, at - begin));
  }
}

}  // namespace

TextMutator::TextMutator(std::initializer_list<const char*> files) {
  std::set<std::string> words(hard_words.begin(), hard_words.end());
  for (const char* file : files) {
    std::ostringstream text;
    text << std::ifstream(test::in_checkout(file)).rdbuf();
    cut_words(text.str(), words);
  }
  words_.assign(words.begin(), words.end());
}

void TextMutator::once(std::string& text, Random& random) const {
  const std::size_t at = place_in(text, random), other = pick(random, text.size());
  const Part word = word_at(text, at);
  const auto with_line = [&](const Part& from, std::size_t to) {
    const std::string line = text.substr(from.begin, from.size);
    text.insert(text.empty() ? 0 : line_at(text, std::min(to, text.size() - 1)).begin, line);
  };
  switch (pick(random, 12)) {
    case 0:
      text.replace(word.begin, word.size, this->word(random));
      break;
    case 1:
      text.replace(word.begin, word.size, hard_words[pick(random, hard_words.size())]);
      break;
    case 2: {
      const Part from = word_at(text, other);
      text.replace(word.begin, word.size, text.substr(from.begin, from.size));
      break;
    }
    case 3:
      text.erase(word.begin, word.size);
      break;
    case 4:
      text.insert(word.begin, this->word(random) + " ");
      break;
    case 5: {
      const Part member = member_at(text, at);
      text.erase(member.begin, member.size);
      break;
    }
    case 6: {
      const Part member = member_at(text, other);
      text.insert(member_at(text, at).begin, text.substr(member.begin, member.size));
      break;
    }
    case 7:
      if (const Part line = line_at(text, at); !text.empty()) text.erase(line.begin, line.size);
      break;
    case 8:
      if (!text.empty()) with_line(line_at(text, at), other);
      break;
    case 9:
      if (const Part line = text.empty() ? Part{} : line_at(text, at); line.size > 0) {
        const std::string moved = text.substr(line.begin, line.size);
        text.erase(line.begin, line.size);
        if (!text.empty()) text.insert(line_at(text, pick(random, text.size())).begin, moved);
      }
      break;
    case 10: {
      std::string bytes = text.substr(at, 1 + pick(random, 40));
      const std::size_t size = bytes.size();
      mutate_bytes(bytes);
      text.replace(at, size, bytes);
      break;
    }
    default:  // torn off, now and then
      if (random() % 4 == 0) text.resize(other);
      else text.replace(word.begin, word.size, std::to_string(static_cast<int>(pick(random, 200)) - 20));
  }
}

std::string TextMutator::operator()(std::string text, Random& random) const {
  for (std::size_t left = 1 + pick(random, 4); left > 0; --left) once(text, random);
  return text;
}

std::size_t TextMutator::operator()(std::uint8_t* data, std::size_t size, std::size_t most, unsigned seed) const {
  Random random(seed + 1);
  return give((*this)({data, data + size}, random), data, most);
}

}  // namespace zstep::fuzz
