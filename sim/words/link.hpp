// A link that opens the viewer at a place: in a browser as the end of an address, natively as an argument.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace zstep {

/// Bytes. Whatever is longer is no link.
inline constexpr std::size_t longest_link = 4096;

/// Whether a word of a command line is meant as a link: "#lesson=z-buffer&step=867", or an address that ends so.
bool is_link(std::string_view word);

/// The words of a command line that a link stands for: {"lesson", "z-buffer", "--at=867"}. Links come from anywhere:
/// one names lessons and scenes by what zstep calls them, never a file, asks for at most `largest_raster` pixels, and
/// for nothing that is written. Throws InputError, which names what it does not take.
std::vector<std::string> words_of_link(std::string_view text);
inline constexpr std::int64_t largest_raster = 1 << 21;  ///< pixels

/// The link that stands for such words, which begin with `lesson` or `view`; nothing where they name a file, or
/// something that no link has, or more than `longest_link`.
std::optional<std::string> link_of(std::span<const std::string> words);

}  // namespace zstep
