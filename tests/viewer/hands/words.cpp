#include "tests/viewer/hands/words.hpp"

#include <algorithm>

#include "tests/viewer/letters.hpp"

namespace zstep::test {
namespace {

/// Of UTF-8, but for spaces: where two letters stand close they cannot be told from none.
std::vector<std::string> characters(const std::string& text) {
  std::vector<std::string> all;
  for (const char c : text)
    if (c == ' ') continue;
    else if ((static_cast<unsigned char>(c) & 0xc0u) == 0x80u && !all.empty()) all.back() += c;
    else all.emplace_back(1, c);
  return all;
}

/// A word all of which is seen, with the letters of it.
struct Whole {
  std::vector<std::string> characters;
  std::vector<const Letter*> letters;
};

std::vector<Whole> whole_words(const Letters& drawn) {
  std::vector<Whole> all(drawn.words.size());
  std::vector<std::vector<const Letter*>> of(drawn.words.size());
  for (const Letter& letter : drawn.all)
    if (!letter.rim) of[letter.word].push_back(&letter);
  for (std::size_t k = 0; k < all.size(); ++k) {
    all[k].characters = characters(drawn.words[k]);
    if (of[k].size() == all[k].characters.size()) all[k].letters = of[k];
    else all[k] = {};  // a part of it is hidden
  }
  return all;
}

}  // namespace

std::vector<SeenWords> find_words(viewer::App& app, const std::string& text) {
  const Letters drawn = letters_of(app.ui().fonts);
  const std::vector<std::string> wanted = characters(text);
  std::vector<SeenWords> parts, wholes;
  for (const Whole& word : whole_words(drawn)) {
    auto from = word.characters.begin();
    while ((from = std::search(from, word.characters.end(), wanted.begin(), wanted.end())) != word.characters.end()) {
      const std::size_t at = static_cast<std::size_t>(from - word.characters.begin());
      const Letter& first = *word.letters[at];
      const Letter& last = *word.letters[at + wanted.size() - 1];
      const bool all = wanted.size() == word.characters.size();
      (all ? wholes : parts)
          .push_back({(first.first.x + last.last.x) / 2, (first.first.y + first.last.y) / 2,
                      (last.first.x + last.last.x) / 2});
      ++from;
    }
  }
  return wholes.empty() ? parts : wholes;
}

}  // namespace zstep::test
