// The page of zstep diff: one file that opens from disk, with the pictures in it.
#include <cstdint>
#include <string>
#include <string_view>

#include <fmt/format.h>

#include "sim/cli/diff.hpp"
#include "sim/pages/page.hpp"
#include "sim/words/markup.hpp"
#include "sim/words/numbers.hpp"
#include "traces/events/fields.hpp"

namespace zstep::cli {
namespace {

std::string side(std::string_view name, const CauseSide& of) {
  if (of.step == 0) return fmt::format("<tr><th>{}</th><td>no such step</td></tr>\n", name);
  std::string fields;
  for (const std::string& field : of.fields) fields += fmt::format("<br><code>{}</code>", markup(field));
  return fmt::format("<tr><th>{}</th><td>{}{}</td></tr>\n", name, markup(of.where), fields);
}

}  // namespace

std::string diff_page(const DiffText& text, const diff::DiffReport& report, const PicturePair& pictures) {
  std::string page = page_begin(text.name_a + " and " + text.name_b);
  page += fmt::format("<h1>Where two runs part</h1>\n<p>A: <code>{}</code><br>B: <code>{}</code></p>\n",
                      markup(text.name_a), markup(text.name_b));
  for (const std::string& note : text.notes) page += fmt::format("<p>{}</p>\n", markup(note));
  page += fmt::format("<p>{}</p>\n", markup(text.pictures));
  for (const std::string& sentence : text.seen) page += fmt::format("<p>{}</p>\n", markup(sentence));
  page += figure(pictures.a, "A", "the picture of A");
  page += figure(pictures.b, "B", "the picture of B");
  page += figure(pictures.map, "Where they differ: the darker, the more", "the pixels that differ, dark on white");
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
  for (std::size_t kind = 0; kind < kind_count; ++kind) {
    const diff::KindDifference& row = report.kinds[kind];
    if (row.same + row.rounding + row.different + row.only_a + row.only_b == 0) continue;
    rows += fmt::format("<tr><td>{}</td>", kind_names()[kind]);
    for (const std::int64_t count : {row.same, row.rounding, row.different, row.only_a, row.only_b})
      rows += fmt::format("<td class=\"n\">{}</td>", count);
    rows += "</tr>\n";
  }
  if (!rows.empty())
    page +=
        "<h2>By kind of step</h2>\n<table>\n<tr><th>steps</th><th>same</th><th>rounding</th><th>different</th>"
        "<th>only A</th><th>only B</th></tr>\n" +
        rows + "</table>\n";
  return page.append(page_end);
}

}  // namespace zstep::cli
