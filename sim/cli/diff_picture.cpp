// zstep diff of a picture, or a table of depths or polygons, of another program: beside a run, or beside a scene alone.
#include <algorithm>
#include <array>
#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include "sim/cli/diff.hpp"
#include "sim/cli/long_work.hpp"
#include "sim/cli/messages.hpp"
#include "sim/cli/traces.hpp"
#include "sim/cli/words.hpp"
#include "sim/cost/bounds.hpp"
#include "traces/image/exr.hpp"
#include "traces/image/read_image.hpp"
#include "traces/image/tables.hpp"
#include "sim/pages/pictures.hpp"
#include "sim/pages/page.hpp"
#include "sim/words/escaped.hpp"
#include "sim/words/judged.hpp"
#include "sim/words/numbers.hpp"
#include "traces/check/check.hpp"
#include "traces/error.hpp"
#include "traces/formulas/rounding.hpp"
#include "traces/mistakes/in_pixels.hpp"
#include "traces/replay/replay.hpp"
#include "traces/text.hpp"

namespace zstep::cli {

namespace {

using Json = nlohmann::ordered_json;

constexpr double most_grey = 65535;

/// What a file has of each pixel, the top row first.
struct Table {
  std::int32_t width = 0, height = 0;
  bool float32 = false;
  std::vector<std::uint8_t> rgb{};
  std::vector<std::int32_t> whole{};
  std::vector<double> numbers{};
  bool shares = false;  ///< the numbers are from 0, for the least depth that there can be, to 1, for the greatest
};
/// ".png" of "a.png" and of "A.PNG".
std::string ending_of(const std::string& path) {
  std::string ending = std::filesystem::path(path).extension().string();
  for (char& c : ending)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  return ending;
}

Table read_table(const std::string& path) {
  Table table;
  const std::string extension = ending_of(path);
  const auto grey = extension == ".png" ? read_grey16(path) : std::nullopt;
  if (grey) {
    table.width = grey->width, table.height = grey->height, table.shares = true;
    for (const std::uint16_t value : grey->values) table.numbers.push_back(value / most_grey);
  } else if (is_image(path)) {
    Image image = read_image(path);
    table.width = image.width, table.height = image.height, table.rgb = std::move(image.rgb);
  } else if (extension == ".pfm" || extension == ".exr") {
    const Pfm pfm = extension == ".pfm" ? read_pfm(path) : read_exr(path);
    table.width = pfm.width, table.height = pfm.height, table.float32 = true;
    table.numbers.assign(pfm.values.begin(), pfm.values.end());
  } else {
    const Npy npy = read_npy(path);
    table.width = npy.width, table.height = npy.height;
    table.float32 = std::holds_alternative<std::vector<float>>(npy.values);
    if (const auto* whole = std::get_if<std::vector<std::int32_t>>(&npy.values)) table.whole = *whole;
    else std::visit([&](const auto& values) { table.numbers.assign(values.begin(), values.end()); }, npy.values);
  }
  return table;
}

/// Makes depths of the shares of their range that a grey picture has; how far off they may be then.
double to_depths(Table& table, const Scene& scene, Conventions::Depth depth) {
  if (!table.shares) return 0;
  const double least = formulas::least_depth(scene, depth), range = depth_range(scene, depth);
  for (double& number : table.numbers) number = least + range * number;
  return range / most_grey;  // whichever way it was rounded
}

}  // namespace

bool is_picture(const std::string& path) {
  constexpr std::array<std::string_view, 3> extensions{".npy", ".pfm", ".exr"};
  return is_image(path) || std::find(extensions.begin(), extensions.end(), ending_of(path)) != extensions.end();
}

int diff_with_picture(const DiffOptions& options) {
  const Trace a = open_trace(options.a);
  Replay end(a);
  end.go_to(a.size());
  const Picture& picture = end.state().picture;
  const Raster& raster = a.scene().raster;
  PicturePair pictures;
  pictures.a = image_of(picture, a.scene(), 1);
  Precision precision = precision_of(a);
  Table table = read_table(options.b);
  check_sizes(raster.width, raster.height, table.width, table.height, options.b);
  if (!table.whole.empty()) throw InputError(options.b, "has whole numbers", "give depths as float32 or float64");
  if (!table.rgb.empty()) {
    pictures.b = {table.width, table.height, std::move(table.rgb)};
    pictures.difference = diff::compare_colors(pictures.a.rgb, pictures.b.rgb);
  } else {
    precision.absolute = std::max(precision.absolute, to_depths(table, a.scene(), a.header().conventions.depth));
    if (table.float32) precision.relative = std::max(precision.relative, formulas::rounding_of_float32);
    precision.depths =
        compare::held_to_bounds(a, table.float32 ? NumberFormat::float32 : a.header().conventions.number_format).depths;
    const auto same = [](double z) { return z; };
    if (raster.y_up && precision.depths) {  // tables of depths have the top row first
      auto turned = std::make_shared<DepthBounds>(*precision.depths);
      turned->of_pixel = top_row_first<double>(turned->of_pixel, raster.width, raster.height, true, same);
      precision.depths = std::move(turned);
    }
    pictures.difference =
        diff::compare_depths(top_row_first<double>(picture.depth, raster.width, raster.height, raster.y_up, same),
                             table.numbers, precision, diff::buffers_of(a, picture).empty);
  }
  pictures.map = map_of(pictures.difference.apart, raster.width, raster.height, false);
  diff::DiffReport report;
  report.precision = precision;
  const DiffText text{printable(a.name()), printable(options.b), {}, {}, pictures_text(pictures.difference)};
  write_diff_page(options, text, report, pictures);
  const diff::BufferDifference& found = pictures.difference;
  if (options.json) {
    print_diff_json(text, report, found);
  } else {
    fmt::print("A: {}\nB: {}\n{}\n", text.name_a, text.name_b, text.pictures);
    if (found.first) {
      const auto x = *found.first % raster.width, row = *found.first / raster.width;
      const auto y = raster.y_up ? raster.height - 1 - row : row;
      fmt::print("The first from the top is ({}, {}):\n  zstep explain {} {} {}\n", x, y,
                 printable(shell_word(options.a)), x, y);
    }
  }
  return found.colors + found.depths == 0 ? exit_code::done : exit_code::finding;
}

// A picture beside its scene: as it should be, and as the known mistakes would have it.

namespace {

struct Given {
  Scene scene;
  Header header;
  std::string name;
  std::optional<NumberFormat> number_format{};  ///< where it is said
};
Given scene_beside(const DiffOptions& options) {
  if (is_trace(options.b)) {
    if (const std::string given = options.run.given(); !given.empty())
      throw InputError(given, "is for scenes, but this is a trace, which has its own conventions", "leave it out");
    const Trace trace = open_trace(options.b);
    const Header& header = trace.header();
    const bool says_format = header.declares(Convention::number_format);
    return {trace.scene(), header, printable(trace.name()),
            says_format ? std::optional(header.conventions.number_format) : std::nullopt};
  }
  RunOptions run = options.run;
  run.scene = options.b;
  Run prepared = prepare(run);
  Header header = header_of(prepared);
  std::string name = printable(prepared.scene.name);
  const bool says_format = run.conventions.words.contains("number_format");
  const auto format = says_format ? std::optional(header.conventions.number_format) : std::nullopt;
  return {std::move(prepared.scene), std::move(header), std::move(name), format};
}

/// The background of a table of depths, where it is a number: the one that most pixels have, if none is nearer or none
/// is farther.
std::optional<double> background_of(const std::vector<double>& depths) {
  constexpr std::int64_t least = 4;
  std::map<double, std::int64_t> counts;
  for (const double z : depths)
    if (std::isfinite(z)) ++counts[z];
  if (counts.empty()) return std::nullopt;
  for (const auto& end : {*counts.begin(), *counts.rbegin()}) {
    const auto has_no_more = [&](const auto& one) { return one.second <= end.second; };
    if (end.second >= least && std::all_of(counts.begin(), counts.end(), has_no_more)) return end.first;
  }
  return std::nullopt;
}

mistakes::Seen seen_in(Table& table) {
  mistakes::Seen seen;
  seen.width = table.width, seen.height = table.height;
  for (std::size_t at = 0; at + 2 < table.rgb.size(); at += 3)
    seen.colors.push_back({table.rgb[at], table.rgb[at + 1], table.rgb[at + 2]});
  seen.polygons = std::move(table.whole);
  for (std::int32_t& polygon : seen.polygons) polygon = std::max(polygon, no_polygon);
  seen.empty = background_of(table.numbers), seen.unit = table.shares ? 1 / most_grey : 0;
  seen.depths = std::move(table.numbers);
  return seen;
}

/// How many pixels a drawing has otherwise than the picture: "3 of 4 096 pixels".
std::string pixels_text(const mistakes::Likeness& likeness) {
  return fmt::format("{} of {}", grouped(likeness.differ), counted(likeness.sure, "pixel", "pixels"));
}

std::vector<mistakes::Mistake> made_in(const mistakes::Likeness& likeness) {
  std::vector<mistakes::Mistake> made;
  for (const mistakes::Way& way : likeness.ways) made.push_back(way.mistake);
  return made;
}

/// As the first line of a trace has them: `"cull": false and "ties": "last"`.
std::string conventions_text(const mistakes::Likeness& likeness) {
  std::vector<std::string> texts;
  for (const auto& [key, word] : likeness.conventions)
    texts.push_back(fmt::format("\"{}\": {}", key, word == "true" || word == "false" ? word : '"' + word + '"'));
  return enumerate(texts, "and");
}

/// The likest few, each mistake once: where some explain all of it those alone.
std::vector<mistakes::Likeness> shown_of(const std::vector<mistakes::Likeness>& found) {
  constexpr std::size_t most = 3;
  std::vector<mistakes::Likeness> shown;
  for (auto one = found.begin() + 1; one != found.end() && shown.size() < most; ++one) {
    if (!shown.empty() && shown.front().differ == 0 && one->differ > 0) break;
    const bool is_new = std::none_of(shown.begin(), shown.end(), [&](const mistakes::Likeness& other) {
      return !other.ways.empty() && made_in(other) == made_in(*one);
    });
    if (is_new) shown.push_back(*one);
  }
  return shown;
}

Json json_of(const DiffOptions& options, const Given& given, const mistakes::Likeness& right,
             const std::vector<mistakes::Likeness>& shown) {
  Json likely = Json::array(), otherwise = Json::array();
  for (const mistakes::Likeness& one : shown) {
    Json conventions = Json::object(), ids = Json::array();
    for (const auto& [key, word] : one.conventions) conventions[key] = word;
    for (const mistakes::Mistake mistake : made_in(one)) ids.push_back(mistakes::text_of(mistake).id);
    Json entry = ids.empty() ? conventions : Json{{"mistakes", ids}};
    if (!ids.empty() && !conventions.empty()) entry["conventions"] = conventions;
    entry["differ"] = one.differ, entry["pixels"] = one.sure;
    (ids.empty() ? otherwise : likely).push_back(std::move(entry));
  }
  return {{"a", options.a},         {"b", given.name},  {"pixels", right.sure},
          {"differ", right.differ}, {"likely", likely}, {"conventions", otherwise}};
}

void print_likeness(const mistakes::Likeness& one) {
  const std::string with = conventions_text(one);
  if (one.ways.empty()) {
    fmt::print("With {} {} would.\n", with,
               one.differ == 0 ? "none" : fmt::format("{} of {}", grouped(one.differ), grouped(one.sure)));
    return;
  }
  mistakes::Diagnosis likely{{one.ways.front().mistake}, {}};
  if (one.ways.size() > 1) likely.also = one.ways.back().mistake;
  fmt::print("\nSo drawn{} {}:\n  {}\n", with.empty() ? "" : fmt::format(", and with {},", with),
             one.differ == 0 ? "it is this very picture" : fmt::format("{} differ", pixels_text(one)),
             fmt::join(likely_in_words(likely), "\n  "));
}

}  // namespace

int diff_of_picture(const DiffOptions& options) {
  const Given given = scene_beside(options);
  Table table = read_table(options.a);
  const Raster& raster = given.scene.raster;
  check_sizes(table.width, table.height, raster.width, raster.height, options.b);
  // Of what the file has, and of what the program computed in: a picture does not say.
  const bool is_narrow = given.number_format ? *given.number_format == NumberFormat::float32 : table.numbers.empty();
  const double roundoff = table.float32 || is_narrow ? 0x1p-24 : 0x1p-53;
  const mistakes::Seen seen = seen_in(table);
  Watch watch;
  const std::vector<mistakes::Likeness> found =
      mistakes::likenesses(given.scene, given.header, roundoff, seen, [&](double share) {
        watch.show(fmt::format("drawing the scene with each mistake and convention: {} % (Ctrl-C stops)",
                               static_cast<int>(100 * share)));
        return false;
      });
  watch.clear_line();
  const mistakes::Likeness& right = found.front();
  const std::vector<mistakes::Likeness> shown = shown_of(found);
  const int code = right.differ == 0 ? exit_code::done : exit_code::finding;
  if (options.json) {
    fmt::print("{}\n", json_of(options, given, right, shown).dump(2));
    return code;
  }
  fmt::print("A: {}\nB: {}, {}x{} pixels, as it should be drawn\n", printable(options.a), given.name, raster.width,
             raster.height);
  if (right.differ == 0) {
    fmt::print("The picture is right: none of {} differs but by rounding.\n", counted(right.sure, "pixel", "pixels"));
    return code;
  }
  fmt::print("{} differ by more than rounding.\n", pixels_text(right));
  if (shown.empty() || shown.front().differ > 0)
    fmt::print("No known mistake, no other convention, and no two of them explain all of it{}\n",
               shown.empty() ? ", nor half of it." : ". These come nearest:");
  for (const mistakes::Likeness& one : shown) print_likeness(one);
  return code;
}

}  // namespace zstep::cli
