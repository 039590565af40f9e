// Words of a command line: numbers, sizes, choices, and the nearest known word to a mistyped one.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace zstep::cli {

/// As near_word() does.
std::string nearest(std::string_view word, std::span<const std::string> known);

/// "did you mean WORD?" when a known word is near, else `otherwise`.
std::string did_you_mean(std::string_view word, std::span<const std::string> known, std::string_view otherwise);

/// A finite number. `where` names the option in the error.
double parse_number(std::string_view where, const std::string& text);
/// A whole number, whose thousands may be set apart as zstep prints them ("742\u00a0697"); nothing for what is none.
std::optional<std::int64_t> read_whole(std::string text);
/// The same, of at least `least`.
std::int64_t parse_whole(std::string_view where, const std::string& text, std::int64_t least);
/// "640x480" -> {640, 480}.
std::array<std::int32_t, 2> parse_size(std::string_view where, const std::string& text);
/// The index of `text` in `choices`.
std::size_t parse_choice(std::string_view where, const std::string& text, std::span<const std::string> choices);

/// "a, b and c" — with another last link word for "a, b or c".
std::string enumerate(std::span<const std::string> words, std::string_view last_link = "or");

/// 12041 -> "12 041".
std::string grouped(std::int64_t number);
/// "1 step", "2 steps".
std::string counted(std::int64_t number, std::string_view singular, std::string_view plural);

}  // namespace zstep::cli
