// A text file as lines of tokens, and tokens as numbers. Lines end with LF, CR LF or CR alone, even mixed within one
// file.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace zstep::scene {

// Numbers as files write them, read the same under every locale and library.

/// A decimal number ("-1.5", "2e3", ".5"), correctly rounded. "nan" and "inf" in any spelling give themselves, also as
/// Microsoft's library writes them ("-1.#IND", "1.#QNAN", "-nan(ind)"); the caller decides whether it wants them.
/// Nothing if the token is anything else.
std::optional<double> parse_number(std::string_view token);

/// A decimal integer with an optional sign; nothing if it is anything else or does not fit.
std::optional<std::int64_t> parse_integer(std::string_view token);

/// Whether the token is this word, which is in small letters, in small letters or capitals.
bool same_word(std::string_view token, std::string_view word);

/// A token as an error message shows it: in quotes, shortened, with unprintable bytes replaced.
std::string in_quotes(std::string_view token);

/// The largest coordinate that is accepted: its cube, which a normal's length may reach, is still far from overflowing.
inline constexpr double largest_coordinate = 1e30;

class Tokens {
 public:
  enum class Comments : std::uint8_t { none, hash };  ///< hash: from # to the end of the line, but not that of 1.#IND
  enum class Joining : std::uint8_t {
    none,
    backslash
  };  ///< backslash: at the end of a line it joins the next one to it

  /// `name` is what errors call the file. `text` must outlive this. `first_line` numbers the first line.
  Tokens(std::string_view text, std::string name, Comments comments, Joining joining = Joining::none,
         std::int32_t first_line = 1);

  /// The next token of this line; empty at its end.
  std::string_view next_in_line();
  /// The next token of the file, on whatever line; empty at its end.
  std::string_view next();
  /// The rest of this line without comment and surrounding blanks. The line is then used up.
  std::string_view rest_of_line();
  /// Goes on to the next line, past what is left of this one. False at the end of the file.
  bool next_line();

  /// Line of the last token given.
  std::int32_t line() const { return token_line_; }
  const std::string& name() const { return name_; }
  std::string where() const;
  /// Bytes not read yet: what a declared count is held against.
  std::size_t bytes_left() const { return text_.size() - at_; }

  /// A number from a token of next_in_line() or next(), finite or not. `what` names it in the error.
  double number(std::string_view token, std::string_view what) const;
  /// A finite one that a coordinate may be.
  double coordinate(std::string_view token, std::string_view what) const;
  /// The same, but what is not finite is nan: finish_soup leaves out what uses it.
  double coordinate_or_nan(std::string_view token, std::string_view what) const;
  /// A whole number in 0 … `most`.
  std::int64_t count(std::string_view token, std::string_view what, std::int64_t most) const;
  [[noreturn]] void fail(std::string_view what, std::string_view mend) const;

 private:
  bool at_line_end() const;
  bool at_comment() const;
  void skip_blanks();

  std::string_view text_;
  std::string name_;
  Comments comments_;
  Joining joining_;
  std::size_t at_ = 0;
  std::int32_t line_;
  std::int32_t token_line_;
};

/// The number as a finite coordinate; throws InputError at `where`.
double checked_coordinate(double value, std::string_view where, std::string_view what);

}  // namespace zstep::scene
