// A run inside a page that shows it: the page of sim/web/one_page.py, with a run and the words that open it at its
// mark.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "sim/pages/packed.hpp"

namespace zstep {

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
