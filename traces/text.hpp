// Text from outside: its characters; how it may be shown in a terminal, a window, a file's name; and the known word
// that a mistyped one was meant to be.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>

namespace zstep {

// One byte of a text. Letters and digits are those of ASCII, whatever the locale.

constexpr std::uint8_t byte_of(char c) { return static_cast<std::uint8_t>(c); }
constexpr bool is_digit(char c) { return c >= '0' && c <= '9'; }
constexpr bool is_capital(char c) { return c >= 'A' && c <= 'Z'; }
constexpr bool is_letter(char c) { return (c >= 'a' && c <= 'z') || is_capital(c); }
constexpr char lower_case(char c) { return is_capital(c) ? static_cast<char>(c - 'A' + 'a') : c; }
constexpr char upper_case(char c) { return c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c; }
/// Is it part of a character that is none of ASCII?
constexpr bool is_beyond_ascii(char c) { return byte_of(c) >= 0x80; }
/// And not its first byte in UTF-8?
constexpr bool continues_character(char c) { return (byte_of(c) & 0xc0u) == 0x80u; }

std::string lower_case(std::string_view text);
/// With its first letter as a capital.
std::string with_capital(std::string text);

/// The same text with every character escaped that would not show itself but do something: controls (\n, \t, \x1b,
/// \u0085), marks that turn the direction of writing (\u202e), and bytes that are no UTF-8 (\xff). What stays is one
/// line that is what it seems to be.
std::string printable(std::string_view text);
/// The same line by line: line ends, and tabs, stay.
std::string printable_lines(std::string_view text);
/// The same for JSON that was written already: \u007f, \u0085, \u202e, so that it is read back as it was. Such
/// characters can only be in its texts; its line ends stay.
std::string printable_json(std::string_view json);

struct Header;
struct Scene;
/// Every text in them: whatever comes from a file passes here before it is shown, asked for or written to another.
void make_printable(Header& header);
void make_printable(Scene& scene);

// The known word that a mistyped one was meant to be.

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
