// The page of zstep diff: one file that opens from disk, with the pictures in it.
#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>

#include <fmt/format.h>

#include "sim/cli/diff.hpp"
#include "sim/words/markup.hpp"
#include "sim/words/numbers.hpp"

namespace zstep::cli {
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

std::string picture(const Image& image, std::string_view title, std::string_view alternative) {
  if (image.rgb.empty()) return "";
  // Small pictures are shown with large pixels.
  constexpr int wide = 360;
  const int enlarge = image.width < wide ? wide / image.width : 1;
  return fmt::format(
      "<figure><img src=\"data:image/png;base64,{}\" width=\"{}\" height=\"{}\" alt=\"{}\">"
      "<figcaption>{}</figcaption></figure>\n",
      base64(png_bytes(image.width, image.height, image.rgb)), image.width * enlarge, image.height * enlarge,
      markup(alternative), markup(title));
}

std::string side(std::string_view name, const CauseSide& of) {
  if (of.step == 0) return fmt::format("<tr><th>{}</th><td>no such step</td></tr>\n", name);
  std::string fields;
  for (const std::string& field : of.fields) fields += fmt::format("<br><code>{}</code>", markup(field));
  return fmt::format("<tr><th>{}</th><td>{}{}</td></tr>\n", name, markup(of.where), fields);
}

constexpr std::string_view style =
    "body{font:16px/1.5 system-ui,sans-serif;max-width:76rem;margin:2rem auto;padding:0 "
    "1rem;color:#111;background:#fff}"
    "code,td.n{font-family:ui-monospace,monospace}table{border-collapse:collapse}"
    "td,th{border-bottom:1px solid #999;padding:.2rem .7rem;text-align:left;vertical-align:top}td.n{text-align:right}"
    "figure{display:inline-block;margin:0 1rem 1rem 0}img{image-rendering:pixelated;border:1px solid #999}";

}  // namespace

std::string diff_page(const DiffText& text, const diff::DiffReport& report, const PicturePair& pictures) {
  std::string page = fmt::format(
      "<!doctype html>\n<html lang=\"en\"><head><meta charset=\"utf-8\">"
      "<meta name=\"viewport\" content=\"width=device-width\"><title>{0} and "
      "{1}</title><style>{2}</style></head><body>\n"
      "<h1>Where two runs part</h1>\n<p>A: <code>{0}</code><br>B: <code>{1}</code></p>\n",
      markup(text.name_a), markup(text.name_b), style);
  for (const std::string& note : text.notes) page += fmt::format("<p>{}</p>\n", markup(note));
  page += fmt::format("<p>{}</p>\n", markup(text.pictures));
  page += picture(pictures.a, "A", "the picture of A");
  page += picture(pictures.b, "B", "the picture of B");
  page += picture(pictures.map, "Where they differ: the darker, the more", "the pixels that differ, dark on white");
  for (std::size_t i = 0; i < text.causes.size(); ++i) {
    const CauseText& cause = text.causes[i];
    page += fmt::format("<h2>{}. {}{}</h2>\n<p>{}.{}{}</p>\n<table>\n{}{}</table>\n", i + 1, markup(cause.step),
                        cause.subject.empty() ? "" : ", " + markup(cause.subject), markup(cause.what),
                        cause.follows.empty() ? "" : " " + markup(cause.follows), cause.follows.empty() ? "" : ".",
                        side("A", cause.a), side("B", cause.b));
    for (const CauseSide* of : {&cause.a, &cause.b})
      if (of->step != 0) page += fmt::format("<p><code>{}</code></p>\n", markup(of->command));
  }
  if (text.causes.size() < report.causes.size())
    page += fmt::format("<p>… and {} more.</p>\n",
                        grouped(static_cast<std::int64_t>(report.causes.size() - text.causes.size())));
  std::string rows;
  std::size_t kind = 0;
  for_each_kind([&]<class E>() {
    const diff::KindDifference& row = report.kinds[kind++];
    if (row.same + row.rounding + row.different + row.only_a + row.only_b == 0) return;
    rows += fmt::format("<tr><td>{}</td>", kind_text<E>.name);
    for (const std::int64_t count : {row.same, row.rounding, row.different, row.only_a, row.only_b})
      rows += fmt::format("<td class=\"n\">{}</td>", count);
    rows += "</tr>\n";
  });
  if (!rows.empty())
    page +=
        "<h2>By kind of step</h2>\n<table>\n<tr><th>steps</th><th>same</th><th>rounding</th><th>different</th>"
        "<th>only A</th><th>only B</th></tr>\n" +
        rows + "</table>\n";
  return page + "</body></html>\n";
}

}  // namespace zstep::cli
