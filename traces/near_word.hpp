// The known word that a mistyped one was meant to be.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>

namespace zstep {

/// The known word that a typist most likely meant by `word`, or "" when none is close (optimal string alignment
/// distance of at most a third of its length, or one is the beginning of the other). Capitals and leading dashes do not
/// count.
std::string_view near_word(std::string_view word, std::span<const std::string_view> known);

/// How far one word is from another by the same measure; of long words the first 64 letters count.
std::size_t word_distance(std::string_view word, std::string_view other);

/// "did you mean \"nearer\"? It can have depth, nearer, ties": the near word, where there is one, and all of them.
/// `all`: "it can have".
std::string near_word_or_list(std::string_view word, std::span<const std::string_view> known, std::string_view all);

}  // namespace zstep
