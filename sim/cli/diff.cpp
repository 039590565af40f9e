// zstep diff: where do two runs part?

#include "sim/cli/diff.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <fmt/format.h>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "sim/cli/commands.hpp"
#include "sim/cli/editor.hpp"
#include "sim/cli/long_work.hpp"
#include "sim/cli/messages.hpp"
#include "sim/cli/outputs.hpp"
#include "sim/cli/traces.hpp"
#include "sim/cli/words.hpp"
#include "sim/cost/bounds.hpp"
#include "traces/image/file.hpp"
#include "sim/pages/page.hpp"
#include "sim/pages/pictures.hpp"
#include "sim/words/escaped.hpp"
#include "sim/words/judged.hpp"
#include "sim/words/numbers.hpp"
#include "traces/error.hpp"
#include "traces/events/fields.hpp"
#include "traces/formulas/walk.hpp"
#include "traces/replay/replay.hpp"
#include "traces/text.hpp"

namespace zstep::cli {
namespace {

/// Two runs of one size, compared with progress on the terminal.
struct BothRuns {
  std::string impossible_a, impossible_b;  ///< as open_to_judge() tells
  Trace a, b;
  diff::DiffReport report;

  BothRuns(const std::string& path_a, const std::string& path_b, Cost cost)
      : a(open_to_judge(path_a, impossible_a, cost)), b(open_to_judge(path_b, impossible_b, cost)) {
    const Raster &one = a.scene().raster, &other = b.scene().raster;
    check_sizes(one.width, one.height, other.width, other.height, path_b);
    Watch watch;
    report = diff::compare(
        a, b,
        [&](double share) {
          watch.show(fmt::format("comparing: {} % (Ctrl-C stops)", static_cast<int>(100 * share)));
          return false;
        },
        diff::Way::fast, compare::held_to_bounds(a, b));
    watch.clear_line();
    leave_out_unread();
  }

 private:
  /// Of a run that is read up to a step that cannot be nobody knows what it does later: it lacks nothing there.
  void leave_out_unread() {
    const std::vector<diff::Match>&by_a = report.alignment.by_a, &by_b = report.alignment.by_b;
    std::erase_if(report.causes, [&](const diff::Cause& cause) {
      const bool beyond_b = by_a.empty() || cause.first.a >= by_a.back().a + by_a.back().count;
      const bool beyond_a = by_b.empty() || cause.first.b >= by_b.back().b + by_b.back().count;
      return (cause.first.only_a() && !impossible_b.empty() && beyond_b) ||
             (cause.first.only_b() && !impossible_a.empty() && beyond_a);
    });
  }
};

std::string not_followed_text(const diff::DiffReport& report) {
  return fmt::format("the runs differ in many steps: causes were looked for among the first {}, {} more were counted",
                     grouped(std::ssize(report.alignment.differences)), grouped(report.alignment.not_kept));
}

/// Opens the viewer with them, which may outlive this call.
int show_both(const std::shared_ptr<const BothRuns>& both, const ShowOptions& options, bool at_first_cause) {
  struct Shown {
    std::shared_ptr<const BothRuns> both;
    AgainstRun with;
  };
  const auto shown = std::make_shared<const Shown>(Shown{both, {&both->b, &both->report, at_first_cause}});
  return show(both->a, options, {.against = &shown->with, .kept = shown});
}

int runs(const DiffOptions& options) {
  const auto both = std::make_shared<const BothRuns>(options.a, options.b, cost_of(options.view, options.show));
  const Trace &a = both->a, &b = both->b;
  const diff::DiffReport& report = both->report;
  const std::string &impossible_a = both->impossible_a, &impossible_b = both->impossible_b;
  const Raster& one = a.scene().raster;
  const bool may_differ = !report.alignment.identical || !options.page.empty();
  const auto end_of = [&](const Trace& run) { return may_differ ? formulas::end_of(run) : Replay(run).state(); };
  const State end_a = end_of(a), end_b = end_of(b);
  const Picture &picture_a = end_a.picture, &picture_b = end_b.picture;
  const PicturePair pictures{
      diff::compare_pictures(diff::buffers_of(a, picture_a), diff::buffers_of(b, picture_b), report.precision),
      {},
      {},
      {}};
  DiffText text = diff_text(a, b, options, report, pictures.difference);
  // Of two methods few steps are the same; and what no cause explains is to be told all the same.
  const bool no_cause = std::none_of(report.causes.begin(), report.causes.end(),
                                     [](const diff::Cause& cause) { return cause.part == diff::Part::different; });
  if (pictures.difference.colors > 0 && (no_cause || a.header().algorithm != b.header().algorithm))
    text.seen = seen_text(a, picture_a, b, picture_b);
  if (!no_cause) text.likely = likely_in_words(mistakes::diagnosis_of(b, check(b)));
  for (const std::string& impossible : {impossible_a, impossible_b})
    if (!impossible.empty()) text.notes.push_back("compared up to a step that is impossible: " + impossible);
  if (report.alignment.not_kept > 0) text.notes.push_back(not_followed_text(report));
  if (!options.page.empty()) {
    PicturePair drawn = pictures;
    drawn.a = image_of(picture_a, a.scene(), 1);
    drawn.b = image_of(picture_b, b.scene(), 1);
    drawn.map = map_of(drawn.difference.apart, one.width, one.height, one.y_up);
    write_diff_page(options, text, report, drawn);
  }
  if (options.json) print_diff_json(text, report, pictures.difference);
  else print_diff(text, report, pictures.difference, options.all);
  if (options.view) {
    if (options.show.screenshot.empty() && !text.causes.empty()) {
      const CauseText& first = text.causes.front();
      open_in_editor(first.b.at.empty() ? first.a.at : first.b.at);
    }
    if (const int code = show_both(both, options.show, options.show.at.empty()); code != exit_code::done) return code;
  }
  if (!report.alignment.complete) {
    complain_incomplete("the runs do too much in another order: only their beginnings were compared");
    return exit_code::incomplete;
  }
  if (report.alignment.not_kept > 0) {
    complain_incomplete(not_followed_text(report));
    return exit_code::incomplete;
  }
  const bool same = impossible_a.empty() && impossible_b.empty() && report.differences() == 0 &&
                    pictures.difference.colors == 0 && pictures.difference.depths == 0;
  return same ? exit_code::done : exit_code::finding;
}

int run(const DiffOptions& options) {
  check_reads_once(options.a, options.b);
  check_outputs({}, {options.a, options.b},
                options.page.empty() ? std::vector<std::string>{} : std::vector<std::string>{options.page});
  if (is_picture(options.a)) {
    if (options.view || !options.page.empty())
      throw InputError(options.view ? "--view" : "--html", "shows a run, but this is a picture", "leave it out");
    return diff_of_picture(options);
  }
  if (const std::string given = options.run.given(); !given.empty())
    throw InputError(given, "is for the scene of a picture, but this is a run, which has its own conventions",
                     "leave it out");
  const bool picture = is_picture(options.b);
  if (picture && options.view)
    throw InputError("--view", "shows two runs, but this is a run and a picture",
                     "leave it out; --html FILE.html shows pictures");
  check_view(options.view, options.show, {options.a, options.b});
  return picture ? diff_with_picture(options) : runs(options);
}

}  // namespace

int view_against(const std::string& a, const std::string& b, const ShowOptions& show_options) {
  return show_both(std::make_shared<const BothRuns>(a, b, cost_of(true, show_options)), show_options, false);
}

void add_diff(CLI::App& app, Action& action) {
  const auto options = std::make_shared<DiffOptions>();
  CLI::App* command = app.add_subcommand("diff", "Where do two runs part, and what follows from it?");
  command
      ->add_option("a", options->a,
                   "A .ztrace or .jsonl file, or - for standard input; or a picture (.png), depths (.npy, .pfm) or "
                   "numbers of polygons (.npy) of any program, beside its scene")
      ->type_name("A")
      ->required();
  command
      ->add_option("b", options->b,
                   "Another; or a picture, or depths, of any program; beside a picture its scene or mesh, or a trace")
      ->type_name("B")
      ->required();
  command->add_flag("--all", options->all, "Print all causes, not ten");
  CLI::Option* json = command->add_flag("--json", options->json, "Print JSON");
  command->add_flag("--view", options->view, "Then open the viewer with both runs, where they first part")
      ->excludes(json);
  add_show_options(*command, options->show);
  add_run_options(*command, options->run, false);
  command->add_option("--html", options->page, "Write one page with the pictures")->type_name("FILE.html");
  command->footer(
      "Steps are matched by what they are about (the same edge, pixel, polygon, ray), not by their order or number.\n"
      "A step that differs though its operands do not is a cause; other differences follow from a cause. Exit code 0:\n"
      "the runs are the same, but for rounding; 1: they are not.\n"
      "\n"
      "Examples:\n"
      "  zstep diff right.ztrace run.jsonl\n"
      "  zstep diff right.ztrace run.jsonl --view\n"
      "  zstep diff right.ztrace - < run.jsonl\n"
      "  zstep diff run.ztrace depths.npy --html page.html\n"
      "  zstep diff picture.png pyramid-behind\n"
      "  zstep diff depths.npy pyramid-behind --depth pseudodepth");
  command->callback([options, &action] { action = [options] { return run(*options); }; });
}

// The page of zstep diff: one file that opens from disk, with the pictures in it.

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
  for (const std::string& line : text.likely) page += fmt::format("<p>{}</p>\n", markup(line));
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
      if (!of->command.empty()) page += fmt::format("<p><code>{}</code></p>\n", markup(of->command));
  }
  if (text.causes.size() < report.causes.size())
    page += fmt::format("<p>… and {} more.</p>\n", grouped(report.causes.size() - text.causes.size()));
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

void check_sizes(std::int32_t width_a, std::int32_t height_a, std::int32_t width_b, std::int32_t height_b,
                 const std::string& b) {
  if (width_a == width_b && height_a == height_b) return;
  throw InputError(b, fmt::format("is {}x{} pixels, but A is {}x{}", width_b, height_b, width_a, height_a),
                   "compare runs and pictures of the same size");
}

void write_diff_page(const DiffOptions& options, const DiffText& text, const diff::DiffReport& report,
                     const PicturePair& pictures) {
  if (options.page.empty()) return;
  const std::string page = diff_page(text, report, pictures);
  write_file(options.page, std::span(reinterpret_cast<const std::uint8_t*>(page.data()), page.size()));
  if (!options.json) say_written(options.page, "one page");
}

}  // namespace zstep::cli
