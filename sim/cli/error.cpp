// zstep error: how far the depths of a run are from the exact ones.
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <memory>
#include <optional>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "sim/answers/origin/chain.hpp"
#include "sim/cli/commands.hpp"
#include "sim/cli/long_work.hpp"
#include "sim/cli/messages.hpp"
#include "sim/cli/outputs.hpp"
#include "sim/cli/table.hpp"
#include "sim/cli/traces.hpp"
#include "sim/cli/words.hpp"
#include "sim/cost/bounds.hpp"
#include "traces/image/png.hpp"
#include "traces/image/tables.hpp"
#include "sim/pages/page.hpp"
#include "sim/words/escaped.hpp"
#include "sim/words/explain.hpp"
#include "sim/words/numbers.hpp"
#include "traces/error.hpp"
#include "traces/math/portable_math.hpp"
#include "traces/math/whole.hpp"
#include "traces/oracle/attribute_errors.hpp"
#include "traces/oracle/errors.hpp"
#include "traces/text.hpp"
#if ZSTEP_HAS_VIEWER
#include "sim/viewer/charts/chart.hpp"
#endif

namespace zstep::cli {
namespace {

using Json = nlohmann::ordered_json;
using oracle::ErrorOf, oracle::Errors;

struct ErrorOptions {
  std::string trace, picture, table, plot;
  bool all = false, json = false;
};

constexpr std::size_t most_polygons = 10;

/// What rounding may do, by theory, under the conventions that the header declares.
struct Allowed {
  double largest = 0;              ///< of all pixels, in units of depth
  std::int64_t held = 0;           ///< pixels whose stored depth has a bound
  std::int64_t beyond = 0;         ///< of these, whose stored depth is farther off than its own bound
  std::int64_t turned_beyond = 0;  ///< pixels where a depth of a compare that goes the other way is,
                                   ///< or has no bound
};
/// Nothing where no Z-buffer draws the scene so, or the header does not say in which numbers, or where nothing that it
/// draws is at the pixels of the run.
std::optional<Allowed> allowed_in(const Trace& trace, const Errors& errors) {
  const auto bounds = compare::bounds_in(trace);
  if (!bounds) return std::nullopt;
  constexpr double unbounded = std::numeric_limits<double>::infinity();
  Allowed allowed;
  std::map<std::int32_t, std::optional<double>> viewing;  // by facet
  const auto of_viewing = [&](std::int32_t facet) -> std::optional<double> {
    if (facet < 0) return 0;
    const auto [known, is_new] = viewing.try_emplace(facet);
    if (is_new) known->second = compare::viewing_bound(trace, facet);
    return known->second;
  };
  for (std::size_t pixel = 0; pixel < errors.turned.size(); ++pixel) {
    const auto& [off, facet] = errors.turned[pixel];
    if (!errors.fighting[pixel]) continue;
    const auto more = of_viewing(facet);
    const double bound = more ? bounds->of_any[pixel] + *more : unbounded;
    allowed.turned_beyond += !(off <= bound && bound < unbounded);
  }
  for (std::size_t pixel = 0; pixel < bounds->of_pixel.size(); ++pixel) {
    const double off = std::abs(errors.depth_error_of_pixel[pixel]);
    if (std::isnan(off) || errors.polygon_of_pixel[pixel] != bounds->picture.polygon[pixel]) continue;
    const auto more = of_viewing(errors.scene_facet_of_pixel[pixel]);
    if (!more) continue;
    const double bound = bounds->of_pixel[pixel] + *more;
    ++allowed.held;
    allowed.largest = std::max(allowed.largest, bound);
    allowed.beyond += off > bound;
  }
  if (allowed.held == 0) return std::nullopt;
  return allowed;
}
/// Are the depths that a run stores within their bounds?
std::string allowed_text(const Allowed& allowed, const Errors& errors) {
  const std::int64_t stored = std::ssize(errors.polygon_of_pixel) -
                              std::count(errors.polygon_of_pixel.begin(), errors.polygon_of_pixel.end(), no_polygon);
  if (allowed.beyond == 1) return "1 stored depth is beyond its bound, which rounding alone does not explain";
  if (allowed.beyond > 1)
    return fmt::format("{} stored depths are beyond their bounds, which rounding alone does not explain",
                       grouped(allowed.beyond));
  if (allowed.held == stored) return "every stored depth is within its own bound";
  return fmt::format("of {} {} a bound, and {} within it", counted(stored, "stored depth", "stored depths"),
                     counted(allowed.held, "has", "have"), allowed.held == 1 ? "is" : "are");
}

/// Where compares go the other way with exact depths, and with them pixels: does rounding that a right program may have
/// explain it all?
bool rounding_turns(const Errors& errors, const std::optional<Allowed>& allowed) {
  return allowed && errors.all.decided_wrong > 0 && allowed->turned_beyond == 0 && allowed->beyond == 0 &&
         errors.wrong_pixels <= errors.fighting_pixels;
}

/// What the header would have to declare for the compares that are left open.
const char* undeclared_comparison(const Header& header) {
  return header.declares(Convention::nearer) ? "which of equal depths wins" : "which depth is nearer";
}

/// "0.5", "12", "3.4e6": errors in last digits range from less than one to many.
std::string digits(double value) {
  return value < 1e5 || std::isinf(value) ? number(value, 2, true) : fmt::format("{:.1e}", value);
}
/// Three digits: "9.3e-08", "∞".
std::string in_depth(double value) { return std::isinf(value) ? number(value) : fmt::format("{:.3g}", value); }

/// Why nothing in a run can be held against exact depths, and what would mend it.
InputError nothing_exact(const std::string& path, const Trace& trace) {
  if (!trace.has(AtPixel::depth))
    return InputError(path, "records no depth that is computed at a pixel",
                      "print the steps for depth_interpolate or depth_compare, or those for rays");
  if (trace.has(kind_of<RayEnd>))
    return InputError(path, "has no ray that meets something and paints its pixel", "print ray_end before pixel_paint");
  if (!trace.has(kind_of<PolygonBegin>) && !trace.has(kind_of<EdgeTableInsert>))
    return InputError(path, "does not say which polygon its depths are of", "print polygon_begin before them");
  return InputError(path, "has depths only of polygons whose plane gives none: seen edge-on, or not the scene's",
                    "look at the scene with 'zstep info'");
}

/// What the last bit of the depth buffer is worth: in fixed point always the same, else a last digit at the depth.
std::string buffer_text(const Errors& errors) {
  if (errors.unit == 0) return "one ulp is the last bit of the depth buffer at that depth";
  return fmt::format("one ulp is the last bit of the depth buffer: {:.3g}, 1/(2^{} - 1) of its range", errors.unit,
                     bits_of(errors.format));
}

/// Attributes, held against those of the polygons.
void print_attributes(const Trace& trace) {
  const oracle::AttributeErrors attribute = oracle::attribute_errors_of(trace);
  if (attribute.attributes > 0)
    fmt::print("{} compared with the polygons' own: largest error {}{}, root mean square {}; by rounding alone {}\n",
               counted(attribute.attributes, "attribute", "attributes"), in_depth(attribute.largest),
               attribute.largest == 0 ? "" : fmt::format(", at step {}", attribute.largest_step),
               in_depth(attribute.root_mean_square()), in_depth(attribute.rounding));
  if (attribute.not_judged > 0)
    fmt::print("{} exactly\n",
               counted(attribute.not_judged, "attribute is left out: nothing in the run says what it is",
                       "attributes are left out: nothing in the run says what they are"));
  fmt::print("\n");
}

void print_text(const Trace& trace, const ErrorOptions& options, const Errors& errors,
                const std::optional<Allowed>& allowed) {
  const Header& header = trace.header();
  const std::string format =
      header.declares(Convention::number_format)
          ? std::string(word_of(errors.format))
          : fmt::format("{}, which its header does not declare ({})", word_of(errors.format), errors.format_text);
  fmt::print("{}: {} compared with the exact ones, in ulps (units in the last place) of {}\n", printable(trace.name()),
             counted(errors.all.depths, "depth", "depths"), format);
  if (errors.by_polygon > 0)
    fmt::print("{} of them with the plane of the polygon: the run has no span with its two edges there\n",
               grouped(errors.by_polygon));
  if (errors.not_judged > 0)
    fmt::print("{} exactly\n", counted(errors.not_judged, "depth is left out: nothing in the run says what it is",
                                       "depths are left out: nothing in the run says what they are"));
  if (errors.not_finite > 0)
    fmt::print("{} no finite number, the first at step {}\n", counted(errors.not_finite, "depth is", "depths are"),
               errors.not_finite_step);
  if (errors.stored_not_finite > 0)
    fmt::print("{} no finite number, the first at step {}\n",
               counted(errors.stored_not_finite, "depth that is written is", "depths that are written are"),
               errors.stored_not_finite_step);
  const auto at_step = [](std::int64_t step) { return step > 0 ? fmt::format(", at step {}", step) : ""; };
  fmt::print("largest error {}{}, root mean square {}; {}{}\n", digits(errors.all.largest),
             at_step(errors.steepest_step), digits(errors.all.root_mean_square()),
             errors.all.largest == 0 ? "every depth is exact"
                                     : fmt::format("at most {} in depth", in_depth(errors.all.largest_depth)),
             at_step(errors.deepest_step));
  fmt::print("{}\n", buffer_text(errors));
  if (allowed)
    fmt::print("rounding can change a depth by at most {:.3g}; {}\n", allowed->largest, allowed_text(*allowed, errors));
  fmt::print("with exact depths {} go the other way",
             counted(errors.all.decided_wrong, "compare would", "compares would"));
  if (header.declares(Convention::nearer))
    fmt::print(", and {} show another polygon", counted(errors.wrong_pixels, "pixel would", "pixels would"));
  if (errors.left_open > 0) fmt::print("; of {} more it cannot be told", grouped(errors.left_open));
  if (errors.left_open > 0 || !header.declares(Convention::nearer))
    fmt::print("{} the header does not declare {}", errors.left_open > 0 ? ", as" : ";", undeclared_comparison(header));
  if (rounding_turns(errors, allowed)) fmt::print("; no depth of these is beyond its bound, so rounding explains them");
  fmt::print("\n\n");
  if (trace.has(kind_of<AttributeInterpolate>)) print_attributes(trace);
  for (const oracle::WrongDecision& wrong : errors.decisions) {
    if (&wrong - errors.decisions.data() >= 3 && !options.all) break;
    fmt::print("pixel ({}, {}), {}: {} against {}; exactly {} against {}\n  zstep view {} --at {}\n", wrong.x, wrong.y,
               polygon_label(trace.scene(), wrong.polygon), answers::full_digits(wrong.z),
               answers::full_digits(wrong.stored), wrong.z_digits, wrong.stored_digits,
               printable(shell_word(options.trace)), wrong.step);
  }
  if (!errors.decisions.empty()) fmt::print("\n");
  std::vector<ErrorOf> rows = errors.polygons;
  std::stable_sort(rows.begin(), rows.end(),
                   [](const ErrorOf& one, const ErrorOf& other) { return one.largest > other.largest; });
  if (!options.all && rows.size() > most_polygons) rows.resize(most_polygons);
  fmt::print("{:<16} {:>10} {:>12} {:>12} {:>14} {:>8}\n", "polygon", "depths", "largest", "rms", "in depth", "wrong");
  for (const ErrorOf& row : rows)
    fmt::print("{:<16} {:>10} {:>12} {:>12} {:>14} {:>8}\n", polygon_label(trace.scene(), row.polygon), row.depths,
               digits(row.largest), digits(row.root_mean_square()), in_depth(row.largest_depth), row.decided_wrong);
  if (rows.size() < errors.polygons.size())
    fmt::print("… and {} more: --all prints them\n", grouped(errors.polygons.size() - rows.size()));
}

/// What is not finite becomes a word.

/// Steps begin at 1: 0 is none.
Json step_or_null(std::int64_t step) { return step > 0 ? Json(step) : Json(nullptr); }

Json json_of(const ErrorOf& of) {
  return Json{{"depths", of.depths},
              {"largest_digits", json_number(of.largest)},
              {"rms_digits", json_number(of.root_mean_square())},
              {"largest_depth", json_number(of.largest_depth)},
              {"largest_buffer_units", json_number(of.largest)},
              {"rms_buffer_units", json_number(of.root_mean_square())},
              {"decided_wrong", of.decided_wrong}};
}

void print_json(const Trace& trace, const Errors& errors, const std::optional<Allowed>& allowed) {
  Json all = json_of(errors.all);
  if (allowed) {
    all["bound"] = allowed->largest;
    all["held_to_bound"] = allowed->held, all["beyond_bound"] = allowed->beyond;
    all["pixels_turned_beyond_bound"] = allowed->turned_beyond;
  }
  all["trace"] = trace.name();
  all["number_format"] = word_of(errors.format);
  all["buffer_unit"] = errors.unit > 0 ? Json(errors.unit) : Json(nullptr);  // null: a last digit at each depth
  all["not_judged"] = errors.not_judged;
  all["by_polygon"] = errors.by_polygon;
  all["not_finite"] = errors.not_finite;
  all["stored_not_finite"] = errors.stored_not_finite;
  if (trace.has(kind_of<AttributeInterpolate>)) {
    const oracle::AttributeErrors attribute = oracle::attribute_errors_of(trace);
    all["attribute"] = Json{{"values", attribute.attributes},
                            {"largest", json_number(attribute.largest)},
                            {"rms", json_number(attribute.root_mean_square())},
                            {"rounding", json_number(attribute.rounding)},
                            {"not_judged", attribute.not_judged},
                            {"largest_at_step", step_or_null(attribute.largest_step)}};
  }
  all["largest_at_step"] = step_or_null(errors.steepest_step);
  all["largest_depth_at_step"] = step_or_null(errors.deepest_step);
  all["decided_open"] = errors.left_open;  // by conventions that the header does not declare
  all["wrong_pixels"] = trace.header().declares(Convention::nearer) ? Json(errors.wrong_pixels) : Json(nullptr);
  Json polygons = Json::array(), decisions = Json::array();
  for (const ErrorOf& of : errors.polygons) {
    Json one = json_of(of);
    one["polygon"] = of.polygon;
    polygons.push_back(one);
  }
  for (const oracle::WrongDecision& wrong : errors.decisions)
    decisions.push_back(Json{{"step", wrong.step},
                             {"x", wrong.x},
                             {"y", wrong.y},
                             {"polygon", wrong.polygon},
                             {"z", json_number(wrong.z)},
                             {"stored", json_number(wrong.stored)},
                             {"z_exact", wrong.z_exact},
                             {"stored_exact", wrong.stored_exact},
                             {"z_exact_digits", wrong.z_digits},
                             {"stored_exact_digits", wrong.stored_digits}});
  all["polygons"] = polygons;
  all["decisions"] = decisions;
  fmt::print("{}\n", all.dump(2));
}

/// White: no error; half grey: one last digit; black: a thousand and more. Hatched where no depth was judged.
Image picture_of(const std::vector<double>& errors, const Raster& raster) {
  Image image{raster.width, raster.height, {}};
  const auto same = [](double value) { return value; };
  const auto rows = top_row_first<double>(errors, raster.width, raster.height, raster.y_up, same);
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const auto x = i % static_cast<std::size_t>(raster.width), y = i / static_cast<std::size_t>(raster.width);
    double dark = 0;
    if (std::isnan(rows[i])) dark = (x + y) % 4 == 0 ? 0.25 : 0;
    else if (rows[i] != 0) dark = std::clamp(0.5 + portable::log10(std::abs(rows[i])) / 6, 0.1, 1.0);
    const auto light = nearest_byte(255 * (1 - dark));
    image.rgb.insert(image.rgb.end(), {light, light, light});
  }
  return image;
}

#if ZSTEP_HAS_VIEWER
/// The errors as they grow along spans and edges; n pixels from the beginning at n + 1, as the axis is logarithmic.
Drawing drift_of(const Trace& trace, const Errors& errors) {
  LineChart chart;
  chart.title = fmt::format("{}: how errors of depth add up", printable(trace.name()));
  chart.subtitle =
      fmt::format("Errors along the longest span, and of the first pixels along the longest edge, in ulps of {}.",
                  word_of(errors.format));
  chart.x_title = "1 + pixels from the first of the span, or lines from the first of the edge";
  chart.y_title = "ulps";
  const auto add = [&](const char* name, int look, const std::vector<double>& all) {
    LineChart::Line line{name, {}, look != 0, look};
    for (std::size_t n = 0; n < all.size(); ++n)
      if (all[n] > 0) line.points.emplace_back(static_cast<double>(n + 1), all[n]);
    if (!line.points.empty()) chart.lines.push_back(std::move(line));
  };
  add("along the span", 0, errors.along_span);
  add("along the edge", 1, errors.along_edge);
  for (std::size_t tick = 1; tick <= std::max(errors.along_span.size(), errors.along_edge.size()); tick *= 2)
    chart.x_ticks.push_back(static_cast<double>(tick));
  return draw_chart(chart);
}
#else
Drawing drift_of(const Trace&, const Errors&) { return {}; }
#endif

int run(const ErrorOptions& options) {
  std::vector<std::string> outputs = chart_outputs(options.plot);
  for (const std::string& path : {options.picture, options.table})
    if (!path.empty()) outputs.push_back(path);
  check_outputs({}, {options.trace}, outputs);
  const Trace trace = open_trace(options.trace);
  Watch watch;
  const Errors errors = oracle::errors_of(trace, [&](std::int64_t step) {
    watch.show(
        fmt::format("comparing with exact depths: step {} of {} (Ctrl-C stops)", grouped(step), grouped(trace.size())));
    return false;
  });
  watch.clear_line();
  if (errors.all.depths == 0) throw nothing_exact(options.trace, trace);
  const Raster& raster = trace.scene().raster;
  const std::optional<Allowed> allowed = allowed_in(trace, errors);
  if (options.json) print_json(trace, errors, allowed);
  else print_text(trace, options, errors, allowed);
  if (!options.picture.empty()) {
    const Image image = picture_of(errors.of_pixel, raster);
    write_png(options.picture, image.width, image.height, image.rgb);
    if (!options.json) say_written(options.picture, "errors of the stored depths: the darker, the larger");
  }
  if (!options.table.empty()) {
    const auto same = [](double value) { return value; };
    write_npy(
        options.table,
        std::span<const double>(top_row_first<double>(errors.of_pixel, raster.width, raster.height, raster.y_up, same)),
        raster.height, raster.width);
    if (!options.json)
      say_written(options.table, fmt::format("errors in ulps, float64 [{},{}]", raster.height, raster.width));
  }
  if (!options.plot.empty()) {
    const std::string said = write_chart(options.plot, drift_of(trace, errors));
    if (!options.json) say_written(options.plot, said);
  }
  const std::int64_t turned = rounding_turns(errors, allowed) ? 0 : errors.all.decided_wrong + errors.wrong_pixels;
  const std::int64_t found = turned + errors.not_finite + errors.stored_not_finite + (allowed ? allowed->beyond : 0);
  return found == 0 ? exit_code::done : exit_code::finding;
}

}  // namespace

void add_error(CLI::App& app, Action& action) {
  const auto options = std::make_shared<ErrorOptions>();
  CLI::App* command = app.add_subcommand("error", "How far are the depths of a run from the exact ones?");
  command->add_option("trace", options->trace, "A .ztrace or .jsonl file")->type_name("FILE.ztrace")->required();
  add_budget_options(*command);
  command->add_flag("--all", options->all, "Print all polygons, not ten, and a hundred wrong compares, not three");
  command->add_flag("--json", options->json, "Print JSON");
  command->add_option("--save", options->picture, "Write a picture of the errors")->type_name("FILE.png");
  command->add_option("--save-errors", options->table, "Write them as a table: float64 [H,W], NaN where there is none")
      ->type_name("FILE.npy");
  command->add_option("--plot", options->plot, "Draw how the errors grow along a span and an edge")
      ->type_name("FILE.png|.svg");
  command->footer(
      "Computes the depths of spans again, without rounding, from the vertices that the trace has on the raster;\n"
      "so too the vertices of pieces and the t of rays. Where the trace has no spans, it takes the planes of the\n"
      "polygons. It compares every depth and every decision with these.\n"
      "Exit code 1: with exact depths a compare would go the other way, or a pixel would show another polygon, and\n"
      "rounding does not explain it; a depth is no finite number; or a stored depth is farther off than rounding\n"
      "explains.\n"
      "\n"
      "Examples:\n"
      "  zstep error run.ztrace\n"
      "  zstep error run.ztrace --save error.png\n"
      "  zstep error run.ztrace --plot drift.png");
  command->callback([options, &action] { action = [options] { return run(*options); }; });
}

}  // namespace zstep::cli
