// Pages of HTML that hold all they need: they open from disk, and nothing is fetched from anywhere.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "traces/image/png.hpp"
#include "sim/pages/packed.hpp"

namespace zstep {

// Tables of a picture's values in the order in which files have them.

/// The values [height*width] from the top row to the bottom one; `y_up`: the picture's row 0 is the bottom one.
template <class Out, class In, class Function>
std::vector<Out> top_row_first(const std::vector<In>& values, std::int32_t width, std::int32_t height, bool y_up,
                               Function&& convert) {
  std::vector<Out> result;
  result.reserve(values.size());
  for (std::int32_t row = 0; row < height; ++row) {
    const auto begin = static_cast<std::size_t>(y_up ? height - 1 - row : row) * width;
    for (std::size_t x = 0; x < static_cast<std::size_t>(width); ++x) result.push_back(convert(values[begin + x]));
  }
  return result;
}

/// Everything up to the page's first heading. `title` is any text.
std::string page_begin(std::string_view title);
inline constexpr std::string_view page_end = "</main></body></html>\n";

/// A text from outside as it stands in a page: nothing in it acts, neither as markup nor as a control character.
std::string shown(std::string_view text);

/// A picture with its caption; small ones are shown with large pixels. `alternative` says the same in words.
std::string figure(const Image& image, std::string_view caption, std::string_view alternative);

// A run inside a page that shows it: the page of sim/web/one_page.py, with a run and the words that open it at its
// mark.

/// What the page opens: a file that it holds.
struct PublishedFile {
  std::string name;                 ///< in the page; of no folder
  std::vector<std::uint8_t> bytes;  ///< gzip()
};

/// `page` with the files, and words of a command line that name them. Throws InputError, of `path`, where the page is
/// none of zstep's, or was made for traces of another version.
std::string published(std::string page, const std::string& path, std::span<const std::string> words,
                      std::span<const PublishedFile> files);

}  // namespace zstep
