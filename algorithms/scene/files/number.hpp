// Numbers as files write them, read the same under every locale and library.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace zstep::scene {

/// A decimal number ("-1.5", "2e3", ".5"), correctly rounded. "nan" and "inf" in any spelling give themselves; the
/// caller decides whether it wants them. Nothing if the token is anything else.
std::optional<double> parse_number(std::string_view token);

/// A decimal integer with an optional sign; nothing if it is anything else or does not fit.
std::optional<std::int64_t> parse_integer(std::string_view token);

/// A token as an error message shows it: in quotes, shortened, with unprintable bytes replaced.
std::string in_quotes(std::string_view token);

}  // namespace zstep::scene
