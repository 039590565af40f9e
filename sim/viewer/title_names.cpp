#include "sim/viewer/title_names.hpp"

#include <algorithm>

namespace zstep::viewer {
namespace {

bool tells_less(const TitleName& one, const TitleName& other) { return one.tells < other.tells; }

}  // namespace

std::string joined_names(const std::vector<TitleName>& names) {
  std::string text;
  for (const TitleName& name : names) text += (&name == &names.front() ? "" : " \u00b7 ") + name.text + name.sign();
  return text;
}

std::vector<TitleName> most_telling(std::vector<TitleName> names) {
  if (names.empty()) return names;
  const int most = std::max_element(names.begin(), names.end(), tells_less)->tells;
  std::erase_if(names, [&](const TitleName& name) { return name.tells < most; });
  return names;
}

std::vector<TitleName> names_that_fit(std::vector<TitleName> names, float room, const TitleMeasures& measures) {
  const auto too_wide = [&] { return measures.width(joined_names(names)) > room; };
  const std::size_t kept = most_telling(names).size();
  while (names.size() > kept && too_wide()) names.erase(std::min_element(names.begin(), names.end(), tells_less));
  if (!too_wide()) return names;
  // The room that signs leave, shared: a short name leaves what it does not need to the others.
  std::vector<TitleName> signs = names;
  for (TitleName& name : signs) name.text.clear();
  float left = room - measures.width(joined_names(signs));
  std::vector<TitleName*> shortest_first;
  for (TitleName& name : names) shortest_first.push_back(&name);
  std::sort(shortest_first.begin(), shortest_first.end(), [&](const TitleName* one, const TitleName* other) {
    return measures.width(one->text) < measures.width(other->text);
  });
  for (std::size_t k = 0; k < shortest_first.size(); ++k) {
    const float share = left / static_cast<float>(shortest_first.size() - k);
    if (share < measures.least) return {};
    TitleName& name = *shortest_first[k];
    if (measures.width(name.text) > share) name.text = measures.cut(name.text, share);
    left -= measures.width(name.text);
  }
  return names;
}

}  // namespace zstep::viewer
