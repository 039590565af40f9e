// zstep publish: a run inside one page that shows it, in any browser and from disk.
#include "sim/cli/publish.hpp"

#include <cstdlib>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "sim/cli/commands.hpp"
#include "sim/cli/long_work.hpp"
#include "sim/cli/outputs.hpp"
#include "sim/cli/show.hpp"
#include "sim/cli/traces.hpp"
#include "sim/cli/words.hpp"
#include "traces/image/file.hpp"
#include "sim/pages/page.hpp"
#include "traces/error.hpp"
#include "traces/file/container.hpp"
#include "traces/text.hpp"

namespace zstep::cli {
namespace {

namespace fs = std::filesystem;

struct PublishOptions {
  std::string trace, against, out, site;
  bool check = false;
  ShowOptions show;
};

constexpr double megabyte = 1e6;
constexpr double usual_limit = 5 * megabyte;       // of what course pages and mail take
constexpr double longest_page = 500 * megabyte;    // a browser's texts have at most 2^29 letters
constexpr const char* page_name = "publish.html";  // as sim/web/site.cmake calls it

/// A trace's bytes as the page holds them.
PublishedFile file_of(const std::string& path, std::string name, Watch& watch) {
  std::vector<std::uint8_t> bytes = read_file(path);
  if (fs::path(path).extension() == ".ztrace") bytes = without_paths(bytes);
  else {
    const std::string lines = without_paths_of_jsonl({bytes.begin(), bytes.end()});
    bytes.assign(lines.begin(), lines.end());
  }
  const auto on_part = [&](double done) {
    watch.show(fmt::format("packing {}: {} % (Ctrl-C stops)", name, static_cast<int>(100 * done)));
  };
  std::vector<std::uint8_t> packed = gzip(bytes, on_part);
  return {std::move(name), std::move(packed)};
}

/// Its own name, and one that is no option and not `taken`.
std::string name_in_page(const std::string& path, const std::string& taken = "") {
  std::string name = printable(last_part(path));
  if (name.starts_with('-')) name = "run" + name;
  return name == taken ? "b-" + name : name;
}

/// The words of a command line that open the page as the options ask.
std::vector<std::string> words_of_page(const PublishOptions& options, const Trace& trace, const std::string& a,
                                       const std::string& b) {
  const ShowOptions& show = options.show;
  std::vector<std::string> words = {"view", a};
  if (options.check) words = {"check", a, "--view"};
  if (!b.empty()) words = {"diff", a, b, "--view"};
  // A bookmark, or what is searched for, is found here and now.
  if (!show.at.empty() && show.race.empty()) words.push_back(fmt::format("--at={}", step_of(trace, show.at)));
  else if (!show.at.empty()) words.push_back("--at=" + show.at);
  if (!show.pixel.empty()) words.push_back("--pixel=" + show.pixel);
  if (!show.lead.empty()) words.push_back("--lead=" + show.lead);
  if (!show.race.empty()) words.push_back("--race=" + show.race), words.push_back("--race-by=" + show.race_by);
  if (show.dark) words.emplace_back("--dark");
  if (show.light) words.emplace_back("--light");
  if (show.presenter) words.emplace_back("--presenter");
  if (show.embed) words.emplace_back("--embed");
  return words;
}

Trace trace_to_publish(const std::string& path, bool judged) {
  if (!is_trace(path))
    throw InputError(path, "is no trace, and a page shows a run that was recorded",
                     "record it first: zstep record SCENE -o run.ztrace");
  std::string impossible;  // the page tells
  return judged ? open_to_judge(path, impossible, Cost::free) : open_trace(path, Cost::free);
}

std::string in_megabytes(double bytes) { return fmt::format("{:.1f} MB", bytes / megabyte); }

int publish(const PublishOptions& options) {
  std::vector<std::string> inputs = {options.trace};
  if (!options.against.empty()) inputs.push_back(options.against);
  if (!options.show.race.empty() && inputs.size() > 1)
    throw InputError("--race", "does not go with --against", "publish one run, and race methods on its scene");
  if (!options.show.race.empty() && options.check)
    throw InputError("--race", "does not go with --check", "leave out one of them");
  check_outputs({}, inputs, {options.out});
  const fs::path empty_page = page_without_run(options.site);
  const bool judged = options.check || inputs.size() > 1;
  const Trace trace = trace_to_publish(options.trace, judged);
  if (inputs.size() > 1) {
    const Raster one = trace.scene().raster, other = trace_to_publish(options.against, judged).scene().raster;
    if (one.width != other.width || one.height != other.height)
      throw InputError(
          options.against,
          fmt::format("has {}x{} pixels, and the other run {}x{}", other.width, other.height, one.width, one.height),
          "record both with one --size");
  }
  check_opens(trace, options.show);

  Watch watch;
  std::vector<PublishedFile> files;
  files.push_back(file_of(options.trace, name_in_page(options.trace), watch));
  if (inputs.size() > 1) files.push_back(file_of(options.against, name_in_page(options.against, files[0].name), watch));
  const std::vector<std::uint8_t> empty = read_file(empty_page);
  const double own = static_cast<double>(empty.size());
  double expected = own;
  for (const PublishedFile& file : files) expected += static_cast<double>(file.bytes.size()) * 8 / 7;
  if (expected > longest_page)
    throw InputError(options.out,
                     fmt::format("the page would have {}, and no browser reads more than {}", in_megabytes(expected),
                                 in_megabytes(longest_page)),
                     "record the run with a smaller --size");
  const std::string page =
      published({empty.begin(), empty.end()}, empty_page.string(),
                words_of_page(options, trace, files[0].name, inputs.size() > 1 ? files[1].name : ""), files);
  watch.check();
  watch.clear_line();
  write_file(options.out, {reinterpret_cast<const std::uint8_t*>(page.data()), page.size()});
  const double size = static_cast<double>(page.size());
  say_written(options.out, fmt::format("{} of {} on {}, {}", counted(trace.size(), "step", "steps"),
                                       trace.header().title, trace.scene().name, in_megabytes(size)));
  if (size > usual_limit)
    complain(
        fmt::format("{}: {} of its {} are the run, and some mail and course pages take at most {}; a smaller --size "
                    "of the recording makes it smaller",
                    options.out, in_megabytes(size - own), in_megabytes(size), in_megabytes(usual_limit)));
  return exit_code::done;
}

}  // namespace

fs::path page_without_run(const std::string& site) {
  const char* const named = std::getenv("ZSTEP_SITE");
  std::error_code error;
  fs::path page;
  if (!site.empty()) page = fs::path(site) / page_name;
  else if (named != nullptr && *named != '\0') page = fs::path(named) / page_name;
  else if (const fs::path program = fs::read_symlink("/proc/self/exe", error); !error)
    page = program.parent_path().parent_path() / "web" / "site" / page_name;
  if (fs::is_regular_file(page, error)) return page;
  throw InputError(page.empty() ? page_name : page.string(), "there is no page to put a run into",
                   "./zstep web -o site makes one; then add --site site");
}

void add_site_option(CLI::App& command, std::string& site) {
  command.add_option("--site", site, "The folder that './zstep web -o' made (default: of the checkout of this zstep)")
      ->type_name("FOLDER")
      ->group("Output");
}

void add_publish(CLI::App& app, Action& action) {
  const auto options = std::make_shared<PublishOptions>();
  CLI::App* command = app.add_subcommand("publish", "Put a run into one page that shows it in any browser");
  command->add_option("trace", options->trace, "A .ztrace or .jsonl file")->type_name("FILE.ztrace")->required();
  command->add_option("-o,--output", options->out, "The page to write")
      ->type_name("FILE.html")
      ->required()
      ->group("Output");
  add_site_option(*command, options->site);
  CLI::Option* check = command->add_flag("--check", options->check,
                                         "The page judges the run and opens at its first mistake, all marked");
  command->add_option("--against", options->against, "A second run beside it; the page opens where they first part")
      ->type_name("FILE.ztrace")
      ->excludes(check);
  add_place_options(*command, options->show);
  add_race_options(*command, options->show);
  command->footer(
      "The page holds the viewer, the lessons and the run. It opens from disk, without a server or a network, and "
      "names\n"
      "no folder of this computer.\n"
      "\n"
      "Examples:\n"
      "  zstep publish run.ztrace -o page.html\n"
      "  zstep publish run.ztrace --at 300 --lead depth -o page.html\n"
      "  zstep publish homework.jsonl --check -o page.html\n"
      "  zstep publish right.ztrace --against homework.jsonl -o page.html");
  command->callback([options, &action] { action = [options] { return publish(*options); }; });
}

}  // namespace zstep::cli
