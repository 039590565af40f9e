#include "traces/near_word.hpp"

#include <algorithm>
#include <limits>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace zstep {
namespace {

constexpr std::size_t longest_word = 64;  // nobody mistypes a word of a kilobyte

/// Insertions, deletions, substitutions and swaps of neighbours that lead from one word to the other.
std::size_t distance(std::string_view a, std::string_view b) {
  const std::size_t columns = b.size() + 1;
  std::vector<std::size_t> table((a.size() + 1) * columns);
  const auto at = [&](std::size_t i, std::size_t j) -> std::size_t& { return table[i * columns + j]; };
  for (std::size_t i = 0; i <= a.size(); ++i) at(i, 0) = i;
  for (std::size_t j = 0; j <= b.size(); ++j) at(0, j) = j;
  for (std::size_t i = 1; i <= a.size(); ++i) {
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t other = a[i - 1] == b[j - 1] ? 0 : 1;
      at(i, j) = std::min({at(i - 1, j) + 1, at(i, j - 1) + 1, at(i - 1, j - 1) + other});
      if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1])
        at(i, j) = std::min(at(i, j), at(i - 2, j - 2) + 1);
    }
  }
  return table.back();
}

std::string bare(std::string_view word) {
  while (!word.empty() && word.front() == '-') word.remove_prefix(1);
  std::string result(word);
  for (char& c : result)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  return result;
}

}  // namespace

std::size_t word_distance(std::string_view word, std::string_view other) {
  return distance(bare(word.substr(0, longest_word)), bare(other.substr(0, longest_word)));
}

std::string_view near_word(std::string_view word, std::span<const std::string_view> known) {
  if (word.size() > longest_word) return {};
  const std::string typed = bare(word);
  if (typed.empty()) return {};
  std::string_view best;
  std::size_t least = std::numeric_limits<std::size_t>::max();
  for (const std::string_view candidate : known) {
    const std::string name = bare(candidate);
    std::size_t d = distance(typed, name);
    const std::size_t longer = std::max(typed.size(), name.size());
    const std::size_t limit = longer == 1 ? 0 : std::max<std::size_t>(1, longer / 3);  // any letter is near any other
    const bool beginning =
        typed.size() >= 2 && name.size() >= 2 && (name.starts_with(typed) || typed.starts_with(name));
    if (d > limit && !beginning) continue;
    if (beginning) d = std::min<std::size_t>(d, 2);
    if (d < least) {
      least = d;
      best = candidate;
    }
  }
  return best;
}

std::string near_word_or_list(std::string_view word, std::span<const std::string_view> known, std::string_view all) {
  const std::string_view near = near_word(word, known);
  std::string list = fmt::format("{} {}", all, fmt::join(known, ", "));
  if (near.empty()) return list;
  list[0] = static_cast<char>(list[0] - 'a' + 'A');
  return fmt::format("did you mean \"{}\"? {}", near, list);
}

}  // namespace zstep
