#include "sim/pages/publish.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "traces/error.hpp"
#include "traces/file/chunk.hpp"

namespace zstep {
namespace {

/// JSON as it stands in a script element: nothing in it ends one or begins a comment.
std::string safe_json(const nlohmann::ordered_json& json) {
  std::string safe;
  for (const char c : json.dump(-1, ' ', true))
    if (c == '<') safe += "\\u003c";
    else safe.push_back(c);
  return safe;
}

}  // namespace

std::string published(std::string page, const std::string& path, std::span<const std::string> words,
                      std::span<const PublishedFile> files) {
  const std::string begin = "<!-- zstep publish ", mark = fmt::format("{}{} -->\n", begin, trace_version);
  const std::size_t at = page.find(mark);
  if (at == page.npos || page.find(begin, at + 1) != page.npos)
    throw InputError(path,
                     page.find(begin) == page.npos ? "is no page that a run can be put into"
                                                   : "was made by another zstep, which reads other traces",
                     "./zstep web -o FOLDER makes one");
  nlohmann::ordered_json what{{"words", nlohmann::ordered_json::array()}, {"files", nlohmann::ordered_json::array()}};
  for (const std::string& word : words) what["words"].push_back(word);
  for (const PublishedFile& file : files) what["files"].push_back(file.name);
  std::string put = fmt::format("<script type=\"application/json\" id=\"published\">{}</script>\n", safe_json(what));
  for (const PublishedFile& file : files) put += packed_element(file.name, file.bytes);
  page.replace(at, mark.size(), put);
  return page;
}

}  // namespace zstep
