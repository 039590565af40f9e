#include "sim/viewer/model/lines_near.hpp"

namespace zstep::viewer {

namespace {

/// Marks the lines of the block in which a line stands; how many others there are.
std::size_t show_block(const Page& page, std::size_t line, std::vector<bool>& shown) {
  std::size_t first = line, last = line, others = 0;
  while (first > 0 && page[first - 1].indent >= page[line].indent) --first;
  while (last + 1 < page.size() && page[last + 1].indent >= page[line].indent) ++last;
  for (std::size_t i = first; i <= last; ++i) {
    if (page[i].indent != page[line].indent) continue;
    shown[i] = true;
    others += i != line;
  }
  return others;
}

}  // namespace

std::vector<bool> lines_near(const Page& page, std::size_t now) {
  std::vector<bool> shown(page.size(), false);
  bool alone = show_block(page, now, shown) == 0;
  for (std::size_t i = now + 1; i < page.size() && page[i].indent > page[now].indent; ++i) shown[i] = true;
  std::uint8_t indent = page[now].indent;
  for (std::size_t i = now; i-- > 0;) {
    if (page[i].indent >= indent) continue;
    indent = page[i].indent;
    shown[i] = true;
    if (alone) alone = show_block(page, i, shown) == 0;
  }
  return shown;
}

}  // namespace zstep::viewer
