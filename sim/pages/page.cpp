#include "sim/pages/page.hpp"

#include <algorithm>
#include <cstdint>
#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <span>

#include "sim/words/escaped.hpp"
#include "traces/error.hpp"
#include "traces/file/container.hpp"
#include "traces/text.hpp"

namespace zstep {

namespace {

/// RFC 4648, section 4.
std::string base64(std::span<const std::uint8_t> bytes) {
  constexpr std::string_view digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string out;
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    const std::size_t left = bytes.size() - i;
    const unsigned three = static_cast<unsigned>(bytes[i]) << 16 |
                           (left > 1 ? static_cast<unsigned>(bytes[i + 1]) << 8 : 0u) |
                           (left > 2 ? static_cast<unsigned>(bytes[i + 2]) : 0u);
    for (unsigned digit = 0; digit < 4; ++digit) out += digit <= left ? digits[three >> (18 - 6 * digit) & 63] : '=';
  }
  return out;
}

constexpr std::string_view style =
    "body{font:16px/1.5 system-ui,sans-serif;max-width:76rem;margin:2rem auto;padding:0 1rem;color:#111;"
    "background:#fff}code,pre,td.n{font-family:ui-monospace,monospace}pre{white-space:pre-wrap}"
    "table{border-collapse:collapse;margin:0 0 1rem}caption{text-align:left;font-weight:600;padding:.3rem 0}"
    "td,th{border-bottom:1px solid #999;padding:.2rem .7rem;text-align:left;vertical-align:top}"
    "td.n,th.n{text-align:right}tfoot td,tfoot th{border-top:2px solid #111;font-weight:600}"
    "figure{display:inline-block;margin:0 1rem 1rem 0;vertical-align:top;break-inside:avoid}"
    "figcaption{max-width:24rem}img{image-rendering:pixelated;border:1px solid #999;max-width:100%;height:auto}"
    ".wide,code.command{overflow-x:auto}code.command{display:block;white-space:nowrap}@media "
    "print{body{margin:0;max-width:none;font-size:11pt}a{color:inherit}}";

}  // namespace

std::string page_begin(std::string_view title) {
  // The page could fetch and run nothing even if something in it asked for it.
  return fmt::format(
      "<!doctype html>\n<html lang=\"en\"><head><meta charset=\"utf-8\">"
      "<meta http-equiv=\"Content-Security-Policy\" content=\"default-src 'none'; img-src data:; style-src "
      "'unsafe-inline'\"><meta name=\"viewport\" content=\"width=device-width\"><title>{}</title>"
      "<style>{}</style></head><body><main>\n",
      shown(title), style);
}

std::string shown(std::string_view text) { return markup(printable_lines(text)); }

std::string figure(const Image& image, std::string_view caption, std::string_view alternative) {
  if (image.rgb.empty()) return "";
  constexpr int wide = 360;
  const int enlarge = std::max(1, wide / image.width);
  return fmt::format(
      "<figure><img src=\"data:image/png;base64,{}\" width=\"{}\" height=\"{}\" alt=\"{}\">"
      "<figcaption>{}</figcaption></figure>\n",
      base64(png_bytes(image.width, image.height, image.rgb)), image.width * enlarge, image.height * enlarge,
      shown(alternative), shown(caption));
}

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
