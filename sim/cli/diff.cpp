// zstep diff: where do two runs part?
#include "sim/cli/diff.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <memory>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "sim/cli/budget.hpp"
#include "sim/cli/commands.hpp"
#include "sim/cli/file_lines.hpp"
#include "sim/cli/messages.hpp"
#include "sim/cli/outputs.hpp"
#include "sim/cli/rows.hpp"
#include "sim/cli/traces.hpp"
#include "sim/cli/watch.hpp"
#include "sim/cli/words.hpp"
#include "sim/image/file.hpp"
#include "sim/image/npy.hpp"
#include "sim/image/pfm.hpp"
#include "sim/words/derived.hpp"
#include "sim/words/judged.hpp"
#include "sim/words/numbers.hpp"
#include "sim/words/shell_word.hpp"
#include "traces/error.hpp"
#include "traces/events/slots.hpp"
#include "traces/formulas/rounding.hpp"
#include "traces/formulas/situation_of.hpp"
#include "traces/replay/replay.hpp"
#include "traces/text.hpp"

namespace zstep::cli {
namespace {

using Json = nlohmann::ordered_json;
using diff::Cause, diff::DiffReport, diff::Part;

struct DiffOptions {
  std::string a, b, page;
  bool all = false, json = false, view = false;
  ShowOptions show;
};

constexpr std::size_t most_causes = 10;

// ---- One cause ---------------------------------------------------------------------------------------------------

/// One side of a cause: the state before the step is what its formulas are of.
CauseSide side_of(const Trace& trace, const std::string& path, Replay& replay, FileLines& lines, std::int64_t step,
                  std::uint16_t fields, std::string& subject) {
  CauseSide side;
  side.step = step;
  if (step == 0) return side;
  side.where = place_of_step(path, lines, step);
  side.command = fmt::format("zstep view {} --at {}", shell_word(path), step);
  replay.go_to(step - 1);
  const formulas::Situation at = formulas::situation_of(trace, replay.state());
  const Event event = trace.event(step).event;
  subject = subject_of(event, at);
  side.fields = field_texts(event, at, fields);
  return side;
}

// ---- The whole ---------------------------------------------------------------------------------------------------

std::string kind_name(std::size_t kind) {
  std::string name;
  std::size_t number = 0;
  for_each_kind([&]<class E>() {
    if (number++ == kind) name = kind_text<E>.name;
  });
  return name;
}

std::vector<std::string> notes_of(const Trace& a, const Trace& b) {
  std::vector<std::string> notes;
  const auto only = [&](const Trace& has, const Trace& has_not, const char* name) {
    std::string kinds;
    for (std::size_t kind = 0; kind < kind_count; ++kind)
      if (has.has(static_cast<std::uint8_t>(kind)) && !has_not.has(static_cast<std::uint8_t>(kind)))
        kinds += (kinds.empty() ? "" : ", ") + kind_name(kind);
    if (!kinds.empty()) notes.push_back(fmt::format("{} never records {}: not compared", name, kinds));
  };
  only(a, b, "B");
  only(b, a, "A");
  const Scene &one = a.scene(), &other = b.scene();
  if (one.points != other.points) notes.push_back("the vertices of the two scenes differ");
  else if (!(one.camera == other.camera)) notes.push_back("the cameras of the two scenes differ");
  const Header &h = a.header(), &k = b.header();
  const auto parts = [&](Convention which, bool differ, const char* what) {
    if (h.declares(which) && k.declares(which) && differ) notes.push_back(fmt::format("the headers differ: {}", what));
  };
  parts(Convention::depth, h.conventions.depth != k.conventions.depth, "which z is interpolated");
  parts(Convention::interpolation, h.conventions.interpolation != k.conventions.interpolation,
        "directly, or by increments");
  parts(Convention::coverage, h.conventions.coverage != k.conventions.coverage, "which pixels a span covers");
  parts(Convention::cull, h.conventions.cull != k.conventions.cull, "back faces are culled, or not");
  parts(Convention::number_format, h.conventions.number_format != k.conventions.number_format, "the number format");
  parts(Convention::nearer, h.comparison != k.comparison, "which depth is nearer, or what wins a tie");
  return notes;
}

std::string pictures_text(const diff::BufferDifference& found) {
  if (found.colors == 0 && found.depths == 0)
    return found.depths_rounded == 0
               ? fmt::format("The pictures are the same, all {} pixels.", grouped(found.pixels))
               : fmt::format("The pictures are the same; {} of {} depths differ by rounding.",
                             grouped(found.depths_rounded), grouped(found.pixels));
  return fmt::format("The pictures: of {} pixels {} have another colour, {} another depth (by at most {}).",
                     grouped(found.pixels), grouped(found.colors), grouped(found.depths), number(found.farthest));
}

DiffText text_of(const Trace& a, const Trace& b, const DiffOptions& options, const DiffReport& report,
                 const diff::BufferDifference& pictures) {
  DiffText text{printable(a.name()), printable(b.name()), notes_of(a, b), {}, pictures_text(pictures)};
  Replay replay_a(a), replay_b(b);
  FileLines lines_a(options.a), lines_b(options.b);
  const std::size_t shown = options.all ? report.causes.size() : std::min(most_causes, report.causes.size());
  // Lines of a file are counted from its beginning: in the order of the steps.
  std::vector<std::size_t> order(shown);
  for (std::size_t i = 0; i < shown; ++i) order[i] = i;
  text.causes.resize(shown);
  const auto by = [&](auto step) {
    std::sort(order.begin(), order.end(),
              [&](std::size_t one, std::size_t other) { return step(one) < step(other); });
  };
  by([&](std::size_t i) { return report.causes[i].first.a; });
  for (const std::size_t i : order)
    text.causes[i].a = side_of(a, options.a, replay_a, lines_a, report.causes[i].first.a, report.causes[i].first.fields,
                               text.causes[i].subject);
  by([&](std::size_t i) { return report.causes[i].first.b; });
  for (const std::size_t i : order)
    text.causes[i].b = side_of(b, options.b, replay_b, lines_b, report.causes[i].first.b, report.causes[i].first.fields,
                               text.causes[i].subject);
  for (std::size_t i = 0; i < shown; ++i) {
    const Cause& cause = report.causes[i];
    const Trace& of = cause.first.only_a() ? a : b;
    const StepInfo* step = find_step(of.header().page, cause.first.line);
    text.causes[i].step = step ? step->name : kind_name(cause.first.kind);
    text.causes[i].what = why_cause(cause);
    text.causes[i].follows = what_follows(cause);
  }
  return text;
}

void print_side(const char* name, const CauseSide& side) {
  if (side.step == 0) return fmt::print("   {}  –\n", name);
  fmt::print("   {}  {}\n", name, side.where);
  for (const std::string& field : side.fields) fmt::print("        {}\n", field);
}

void print_table(const DiffReport& report) {
  fmt::print("{:<20} {:>11} {:>9} {:>9} {:>9} {:>9}\n", "steps", "same", "rounding", "different", "only A", "only B");
  for (std::size_t kind = 0; kind < kind_count; ++kind) {
    const diff::KindDifference& row = report.kinds[kind];
    if (row.same + row.rounding + row.different + row.only_a + row.only_b == 0) continue;
    fmt::print("{:<20} {:>11} {:>9} {:>9} {:>9} {:>9}\n", kind_name(kind), row.same, row.rounding, row.different,
               row.only_a, row.only_b);
  }
}

void print_text(const DiffText& text, const DiffReport& report, bool all) {
  fmt::print("A: {}\nB: {}\n", text.name_a, text.name_b);
  for (const std::string& note : text.notes) fmt::print("{}\n", note);
  fmt::print("\n");
  const auto different = static_cast<std::int64_t>(
      std::count_if(report.causes.begin(), report.causes.end(),
                    [](const Cause& cause) { return cause.part == Part::different; }));
  if (report.causes.empty()) fmt::print("All steps that both have are the same, to the last bit.\n");
  else if (different == 0) fmt::print("The runs part by rounding alone ({}).\n", report.precision.text);
  else
    fmt::print("{}, {} in all\n", counted(different, "cause", "causes"),
               counted(report.differences(), "difference", "differences"));
  fmt::print("{}\n\n", text.pictures);
  for (std::size_t i = 0; i < text.causes.size(); ++i) {
    const CauseText& cause = text.causes[i];
    fmt::print("{}. {}{}: {}\n", i + 1, cause.step, cause.subject.empty() ? "" : ", " + cause.subject, cause.what);
    print_side("A", cause.a);
    print_side("B", cause.b);
    if (!cause.follows.empty()) fmt::print("   {}\n", cause.follows);
    fmt::print("   {}\n", cause.b.step != 0 ? cause.b.command : cause.a.command);
  }
  if (text.causes.size() < report.causes.size() && !all)
    fmt::print("… and {} more: --all prints them\n",
               grouped(static_cast<std::int64_t>(report.causes.size() - text.causes.size())));
  if (!text.causes.empty()) fmt::print("\n");
  print_table(report);
}

void print_json(const DiffText& text, const DiffReport& report, const diff::BufferDifference& pictures) {
  const auto side = [](const CauseSide& of) -> Json {
    if (of.step == 0) return nullptr;
    return Json{{"step", of.step}, {"where", of.where}, {"fields", of.fields}};
  };
  Json causes = Json::array(), kinds = Json::object();
  for (std::size_t i = 0; i < text.causes.size(); ++i) {
    const Cause& cause = report.causes[i];
    causes.push_back(Json{{"kind", kind_name(cause.first.kind)},
                          {"name", text.causes[i].step},
                          {"subject", text.causes[i].subject},
                          {"part", cause.part == Part::rounding ? "rounding" : "different"},
                          {"what", text.causes[i].what},
                          {"a", side(text.causes[i].a)},
                          {"b", side(text.causes[i].b)},
                          {"again", cause.again},
                          {"symptoms", cause.symptoms}});
  }
  for (std::size_t kind = 0; kind < kind_count; ++kind) {
    const diff::KindDifference& row = report.kinds[kind];
    if (row.same + row.rounding + row.different + row.only_a + row.only_b == 0) continue;
    kinds[kind_name(kind)] = Json{{"same", row.same},
                                  {"rounding", row.rounding},
                                  {"different", row.different},
                                  {"only_a", row.only_a},
                                  {"only_b", row.only_b}};
  }
  const Json all{{"a", text.name_a},
                 {"b", text.name_b},
                 {"notes", text.notes},
                 {"format", report.precision.text},
                 {"complete", report.alignment.complete},
                 {"differences", report.differences()},
                 {"causes_in_all", report.causes.size()},
                 {"causes", causes},
                 {"kinds", kinds},
                 {"pixels", pictures.pixels},
                 {"colors_differ", pictures.colors},
                 {"depths_differ", pictures.depths},
                 {"depth_farthest", pictures.farthest}};
  fmt::print("{}\n", all.dump(2));
}

void check_sizes(std::int32_t width_a, std::int32_t height_a, std::int32_t width_b, std::int32_t height_b,
                 const std::string& b) {
  if (width_a == width_b && height_a == height_b) return;
  throw InputError(b, fmt::format("is {}x{} pixels, but A is {}x{}", width_b, height_b, width_a, height_a),
                   "compare pictures of one size");
}

void write_page(const DiffOptions& options, const DiffText& text, const DiffReport& report,
                const PicturePair& pictures) {
  if (options.page.empty()) return;
  const std::string page = diff_page(text, report, pictures);
  write_file(options.page, std::span(reinterpret_cast<const std::uint8_t*>(page.data()), page.size()));
  if (!options.json) say_written(options.page, "one page");
}

/// Two runs of one size, compared with progress on the terminal.
struct BothRuns {
  std::string impossible_a, impossible_b;  ///< as open_to_judge() tells
  Trace a, b;
  DiffReport report;

  BothRuns(const std::string& path_a, const std::string& path_b, Cost cost)
      : a(open_to_judge(path_a, impossible_a, cost)), b(open_to_judge(path_b, impossible_b, cost)) {
    const Raster &one = a.scene().raster, &other = b.scene().raster;
    check_sizes(one.width, one.height, other.width, other.height, path_b);
    Watch watch;
    report = diff::compare(a, b, [&](double share) {
      watch.show(fmt::format("comparing: {} % (Ctrl-C stops)", static_cast<int>(100 * share)));
      return false;
    });
    watch.clear_line();
  }
};

int runs(const DiffOptions& options) {
  const BothRuns both(options.a, options.b, cost_of(options.view, options.show));
  const Trace &a = both.a, &b = both.b;
  const DiffReport& report = both.report;
  const std::string &impossible_a = both.impossible_a, &impossible_b = both.impossible_b;
  const Raster& one = a.scene().raster;
  Replay end_a(a), end_b(b);
  if (!report.alignment.identical || !options.page.empty()) {
    end_a.go_to(a.size());
    end_b.go_to(b.size());
  }
  const Picture &picture_a = end_a.state().picture, &picture_b = end_b.state().picture;
  const PicturePair pictures{
      diff::compare_pictures(picture_a, a.scene(), picture_b, b.scene(), report.precision), {}, {}, {}};
  DiffText text = text_of(a, b, options, report, pictures.difference);
  for (const std::string& impossible : {impossible_a, impossible_b})
    if (!impossible.empty()) text.notes.push_back("compared up to a step that cannot be: " + impossible);
  if (!options.page.empty()) {
    PicturePair drawn = pictures;
    drawn.a = image_of(picture_a, a.scene(), 1);
    drawn.b = image_of(picture_b, b.scene(), 1);
    drawn.map = map_of(drawn.difference, one.width, one.height, one.y_up);
    write_page(options, text, report, drawn);
  }
  if (options.json) print_json(text, report, pictures.difference);
  else print_text(text, report, options.all);
  if (options.view) {
    const AgainstRun with{&b, &report, options.show.at.empty()};
    if (const int code = show(a, options.show, {.against = &with}); code != exit_code::done) return code;
  }
  if (!report.alignment.complete) {
    complain_incomplete("the runs part too often, or their orders do: what is said is of their beginnings");
    return exit_code::incomplete;
  }
  const bool same = impossible_a.empty() && impossible_b.empty() && report.differences() == 0 &&
                    pictures.difference.colors == 0 && pictures.difference.depths == 0;
  return same ? exit_code::done : exit_code::finding;
}

// ---- Against a picture of another program ------------------------------------------------------------------------

int against_picture(const DiffOptions& options) {
  const Trace a = open_trace(options.a);
  Replay end(a);
  end.go_to(a.size());
  const Picture& picture = end.state().picture;
  const Raster& raster = a.scene().raster;
  const std::string extension = std::filesystem::path(options.b).extension().string();
  PicturePair pictures;
  pictures.a = image_of(picture, a.scene(), 1);
  Precision precision = precision_of(a);
  bool float32 = extension == ".pfm";
  if (extension == ".png") {
    pictures.b = read_png(options.b);
    check_sizes(raster.width, raster.height, pictures.b.width, pictures.b.height, options.b);
    pictures.difference = diff::compare_colors(pictures.a.rgb, pictures.b.rgb);
  } else {
    std::vector<double> depths;
    std::int32_t width = 0, height = 0;
    if (extension == ".pfm") {
      const Pfm table = read_pfm(options.b);
      depths.assign(table.values.begin(), table.values.end());
      width = table.width, height = table.height;
    } else {
      const Npy table = read_npy(options.b);
      std::visit([&](const auto& values) { depths.assign(values.begin(), values.end()); }, table.values);
      width = table.width, height = table.height;
      float32 = std::holds_alternative<std::vector<float>>(table.values);
      if (std::holds_alternative<std::vector<std::int32_t>>(table.values))
        throw InputError(options.b, "has whole numbers", "give depths as float32 or float64");
    }
    if (float32) precision.relative = std::max(precision.relative, formulas::rounding_of_float32);
    check_sizes(raster.width, raster.height, width, height, options.b);
    const auto same = [](double z) { return z; };
    pictures.difference = diff::compare_depths(
        top_row_first<double>(picture.depth, raster.width, raster.height, raster.y_up, same), depths, precision);
  }
  pictures.map = map_of(pictures.difference, raster.width, raster.height, false);
  DiffReport report;
  report.precision = precision;
  const DiffText text{printable(a.name()), printable(options.b), {}, {}, pictures_text(pictures.difference)};
  write_page(options, text, report, pictures);
  const diff::BufferDifference& found = pictures.difference;
  if (options.json) {
    print_json(text, report, found);
  } else {
    fmt::print("A: {}\nB: {}\n{}\n", text.name_a, text.name_b, text.pictures);
    if (found.first) {
      const auto x = *found.first % raster.width, row = *found.first / raster.width;
      const auto y = raster.y_up ? raster.height - 1 - row : row;
      fmt::print("The first from the top is ({}, {}):\n  zstep explain {} {} {}\n", x, y, shell_word(options.a), x, y);
    }
  }
  return found.colors + found.depths == 0 ? exit_code::done : exit_code::finding;
}

int run(const DiffOptions& options) {
  check_outputs({}, {options.a, options.b}, options.page.empty() ? std::vector<std::string>{}
                                                                 : std::vector<std::string>{options.page});
  const std::string extension = std::filesystem::path(options.b).extension().string();
  const bool picture = extension == ".png" || extension == ".npy" || extension == ".pfm";
  if (picture && options.view)
    throw InputError("--view", "shows two runs, and a picture is none",
                     "leave it out; --html FILE.html shows pictures");
  check_view(options.view, options.show, {options.a, options.b});
  return picture ? against_picture(options) : runs(options);
}

}  // namespace

int view_against(const std::string& a, const std::string& b, const ShowOptions& show_options) {
  const BothRuns both(a, b, cost_of(true, show_options));
  const AgainstRun with{&both.b, &both.report, false};
  return show(both.a, show_options, {.against = &with});
}

Image map_of(const diff::BufferDifference& difference, std::int32_t width, std::int32_t height, bool y_up) {
  Image image{width, height, {}};
  image.rgb.reserve(difference.apart.size() * 3);
  const auto same = [](float value) { return value; };
  for (const float apart : top_row_first<float>(difference.apart, width, height, y_up, same)) {
    const auto light = static_cast<std::uint8_t>(std::lround(255 * (1 - std::clamp(apart, 0.0f, 1.0f))));
    image.rgb.insert(image.rgb.end(), {light, light, light});
  }
  return image;
}

void add_diff(CLI::App& app, Action& action) {
  const auto options = std::make_shared<DiffOptions>();
  CLI::App* command = app.add_subcommand("diff", "Where do two runs part, and what follows from it?");
  command->add_option("a", options->a, "A .ztrace or .jsonl file")->type_name("A.ztrace")->required();
  command->add_option("b", options->b, "Another; or a picture (.png), or depths (.npy, .pfm), of any program")
      ->type_name("B")
      ->required();
  command->add_flag("--all", options->all, "Print all causes, not ten");
  CLI::Option* json = command->add_flag("--json", options->json, "Print JSON");
  command->add_flag("--view", options->view, "Then open the viewer where the runs first part, with both in it")
      ->excludes(json);
  add_show_options(*command, options->show);
  command->add_option("--html", options->page, "Write one page with the pictures")->type_name("FILE.html");
  command->footer(
      "Steps are matched by what they are about (the same edge, pixel, polygon, ray), not by their order or number.\n"
      "Where numbers part, it is a cause if their operands did not part before; the rest follows from a cause. Exit\n"
      "code 0: the same, but for rounding; 1: not.\n"
      "\n"
      "Examples:\n"
      "  zstep diff right.ztrace run.jsonl\n"
      "  zstep diff right.ztrace run.jsonl --view\n"
      "  zstep diff run.ztrace depths.npy --html page.html");
  command->callback([options, &action] { action = [options] { return run(*options); }; });
}

}  // namespace zstep::cli
