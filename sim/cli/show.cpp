#include "sim/cli/show.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "algorithms/catalog/catalog.hpp"
#include "algorithms/fast/z_buffer.hpp"
#include "algorithms/scene/files/read_mesh.hpp"
#include "algorithms/scene/load.hpp"
#include "sim/classroom/lesson.hpp"
#include "sim/cli/commands.hpp"
#include "sim/cli/compare_methods.hpp"
#include "sim/cli/long_work.hpp"
#include "sim/cli/messages.hpp"
#include "sim/cli/run_options.hpp"
#include "sim/cli/traces.hpp"
#include "sim/cli/words.hpp"
#include "traces/image/file.hpp"
#include "sim/places/typed_place.hpp"
#include "sim/words/escaped.hpp"
#include "sim/words/numbers.hpp"
#include "traces/error.hpp"
#include "traces/file/files.hpp"
#include "traces/scene.hpp"

namespace zstep::cli {
namespace {

/// As small as it is shown; a screen scene as large as it is.
Image picture_of(const std::string& name) {
  const SceneFile file = load_scene(name);
  ViewOptions view;
  if (file.scene.camera.kind != Camera::Kind::screen) view.width = 52, view.height = 39;
  const Scene scene = look_at_scene(file.scene, view);
  const Picture picture = z_buffer::run_fast(scene, file.conventions);
  Image image{picture.width, picture.height, {}};
  for (std::size_t at = 0; at < picture.polygon.size(); ++at) {
    const Color color = color_at(picture, scene, at);
    image.rgb.insert(image.rgb.end(), {color.red, color.green, color.blue});
  }
  return image;
}

/// A scene's run, on its finished picture where the scene is a mesh.
std::unique_ptr<Opened> opened(OtherRun run, std::vector<std::string> by, const std::string& of_scene = "",
                               std::string note = {}) {
  const bool finished = run.whole && scene::mesh_format(of_scene);
  if (!run.whole)
    note += fmt::format("{}Cut off after {} steps, so the picture is not done.", note.empty() ? "" : " ",
                        grouped(run.trace.size()));
  return std::make_unique<Opened>(
      Opened{.trace = std::move(run.trace), .opened_by = std::move(by), .note = std::move(note), .finished = finished});
}

std::unique_ptr<Opened> open_lesson(const std::string& name) {
  Lesson lesson = find_lesson(name);
  Trace trace = run_lesson(lesson);
  return std::make_unique<Opened>(
      Opened{std::move(trace), std::move(lesson), std::vector<std::string>{"lesson", name}, {}});
}

std::unique_ptr<Opened> open_scene(const Trace& now, const std::string& name) {
  if (name.ends_with(".md")) return open_lesson(name);
  if (is_trace(name)) {
    std::string impossible;
    Trace trace = open_to_judge(name, impossible, Cost::free);
    std::string note = impossible.empty() ? "" : "It is shown up to a step that cannot be: " + impossible;
    return std::make_unique<Opened>(
        Opened{std::move(trace), {}, std::vector<std::string>{"view", name}, std::move(note), std::move(impossible)});
  }
  RunOptions options;
  options.scene = name;
  const Run run = prepare(options);  // by the Z-buffer, which draws every scene
  std::vector<std::string> words = {"view", name};
  const std::string id = now.header().algorithm;
  std::string note =
      fmt::format("Drawn by the {}, as the method of the run before is none of zstep's.", run.method->title);
  for (const Method& by : methods()) {
    if (by.id != id) continue;
    if (can_draw(by, run.scene, run.conventions)) {
      if (by.id != run.method->id) words.insert(words.end(), {"--algorithm", id});
      return opened(record_patiently(by, run.scene, run.conventions), words, name);
    }
    note = fmt::format("{} cannot draw this scene, so it is drawn by the {}.", by.title, run.method->title);
  }
  return opened(record_patiently(*run.method, run.scene, run.conventions), words, name, note);
}

}  // namespace

std::vector<Offer> all_offers() {
  std::vector<Offer> offers;
  int number = 0;
  for (const Lesson& lesson : all_lessons())
    offers.push_back({Offer::What::lesson,
                      lesson.id,
                      lesson.title,
                      lesson.summary,
                      size32(lesson.stops),
                      ++number,
                      {},
                      lesson.theme,
                      reading_minutes(lesson)});
  for (const Method& one : methods())
    offers.push_back({Offer::What::method, std::string(one.id), std::string(one.title), std::string(one.paper)});
  for (const BuiltIn& scene : built_in_scenes())
    offers.push_back({Offer::What::scene, std::string(scene.name), std::string(scene.name),
                      std::string(scene.description), 0, 0, picture_of(std::string(scene.name))});
  return offers;
}

std::unique_ptr<Opened> open_offer(const Trace& now, const Offer& offer) {
  switch (offer.what) {
    case Offer::What::lesson:
      return open_lesson(offer.id);
    case Offer::What::method:
      return opened(record_by(method(offer.id), now), {});
    case Offer::What::scene:
      break;
  }
  return open_scene(now, offer.id);
}

void add_place_options(CLI::App& command, ShowOptions& options) {
  options.command = &command;
  command
      .add_option(
          "--at", options.at,
          "Open at this step (0 is before the first), this part of the trace, this bookmark, or any place that G takes")
      ->type_name("STEP|PERCENT%|BOOKMARK")
      ->group("Viewer");
  command.add_option("--pixel", options.pixel, "Select this pixel of the raster")->type_name("X,Y")->group("Viewer");
  command.add_option("--lead", options.lead, "This pane leads on the stage: frame, depth, slice, pseudo-code, ...")
      ->type_name("PANE")
      ->group("Viewer");
  CLI::Option* dark = command.add_flag("--dark", options.dark, "Dark colours, this time");
  dark->group("Viewer");
  command.add_flag("--light", options.light, "Light colours, this time")->group("Viewer")->excludes(dark);
  command.add_flag("--presenter", options.presenter, "Large text, for a lecture hall, this time")->group("Viewer");
  command
      .add_flag("--embed", options.embed, "Only what leads and the buttons to step, as inside a page of lecture notes")
      ->group("Viewer");
}

void add_show_options(CLI::App& command, ShowOptions& options) {
  add_place_options(command, options);
  command
      .add_option("--screenshot", options.screenshot,
                  "Write the window as a picture instead of opening it; needs no display")
      ->type_name("FILE.png")
      ->group("Viewer");
  command
      .add_flag("--describe", options.describe,
                "Print what is shown at the step instead of opening it, all in words, for a screen reader")
      ->group("Viewer");
  command.add_option("--pane", options.pane, "The screenshot shows one pane: frame, depth, pseudo-code, ...")
      ->type_name("PANE")
      ->group("Viewer");
  command.add_flag("--patient", options.patient)->group("");
  const auto take_size = [&options](const std::string& text) {
    const auto [width, height] = parse_size("--size-window", text);
    if (width > 16384 || height > 16384)
      throw InputError("--size-window", fmt::format("{} is larger than any screen", text), "give at most 16384x16384");
    options.width = width;
    options.height = height;
  };
  command.add_option_function<std::string>("--size-window", take_size, "Size of the window (default 1280x720)")
      ->type_name("WxH")
      ->group("Viewer");
  add_budget_options(command);
}

void add_notes_option(CLI::App& command, ShowOptions& options) {
  command
      .add_flag("--notes", options.notes, "The speaker's notes in a second window; the screenshot is a picture of them")
      ->group("Viewer");
}

void add_race_options(CLI::App& command, ShowOptions& options) {
  command
      .add_option("--race", options.race,
                  "Methods side by side on this scene, two to four: z-buffer,bsp, or with something other than usual, "
                  "bsp:root=random; --at is then a place of their clock")
      ->type_name("METHOD,...")
      ->group("Viewer");
  const auto take_clock = [&options](const std::string& text) {
    const std::vector<std::string> words(compare::words_of_measures.begin(), compare::words_of_measures.end());
    options.race_by = words[parse_choice("--race-by", text, words)];
  };
  command
      .add_option_function<std::string>("--race-by", take_clock,
                                        "What their clock counts (default operations); time is measured here and now")
      ->type_name(fmt::format("{}", fmt::join(compare::words_of_measures, "|")))
      ->needs("--race")
      ->group("Viewer");
}

std::vector<std::string> words_of(const CLI::App& command) {
  std::vector<std::string> words = {command.get_name()}, options;
  for (const CLI::Option* option : command.get_options()) {
    const auto names_place = [&](const char* name) { return option->check_lname(name); };
    if (option->count() == 0 || names_place("at") || names_place("pixel") || names_place("lead") ||
        names_place("race") || names_place("race-by") || names_place("patient"))
      continue;
    if (option->get_items_expected_max() == 0) {
      options.push_back(option->get_name());
      continue;
    }
    for (const std::string& value : option->results()) {
      const bool named = !option->get_lnames().empty();
      if (named) options.push_back(option->get_name());
      (named ? options : words).push_back(value);
    }
  }
  words.insert(words.end(), options.begin(), options.end());
  return words;
}

std::string without_display() {
  return "these work without one: zstep list, render, record, info, dump, import, and view or lesson with --screenshot "
         "FILE.png";
}

void check_can_show(const ShowOptions& options) {
#if ZSTEP_HAS_VIEWER
  if (!options.screenshot.empty()) return check_writable(options.screenshot), begin_budget(0);
  if (options.describe) return begin_budget(0);
  if (!display_available())
    throw InputError("zstep", "no window can be opened here: there is no display", without_display());
#else
  (void)options;
  throw InputError("zstep", "this zstep was built without the viewer",
                   "install SDL2 and Dear ImGui and build again with -DZSTEP_VIEWER=ON");
#endif
}

namespace {

places::Place place_of(const Trace& trace, const std::string& at, const std::string& option, const Lesson* lesson) {
  const places::Bookmarks marks(trace, lesson);
  places::Place place = places::find_place({trace, marks, lesson, 0}, at, option);
  if (place.pixel)
    throw InputError(
        option, fmt::format("({}, {}) is a pixel, and a step is needed", place.pixel->x, place.pixel->y),
        fmt::format("zstep history FILE {} {} names the steps that touch it", place.pixel->x, place.pixel->y));
  if (place.step > trace.size())
    throw InputError(option, fmt::format("the trace ends at step {}", trace.size()), "give a smaller one");
  return place;
}

}  // namespace

std::int64_t step_of(const Trace& trace, const std::string& at, const std::string& option, const Lesson* lesson) {
  return place_of(trace, at, option, lesson).step;
}

void check_view(bool view, const ShowOptions& options, const std::vector<std::string>& inputs) {
  if (view) {
    for (const std::string& input : inputs) note_input(input);
    return check_can_show(options);
  }
  for (const CLI::Option* option : options.command->get_options())
    if (option->count() > 0 && option->get_group() == "Viewer")
      throw InputError(option->get_name(), "is of the viewer", "add --view");
}

namespace {

/// Where the clock of a race is to stand: a number of what it counts, or a share of all of it.
[[maybe_unused]] RaceAsked race_of(const ShowOptions& options) {
  RaceAsked race;
  race.entrants = parts_of(options.race, ',');
  race.clock = compare::Measure::steps;
  while (word_of(race.clock) != options.race_by)
    race.clock = static_cast<compare::Measure>(static_cast<int>(race.clock) + 1);
  std::string at = options.at.empty() ? "0" : options.at;
  race.of_all = at.back() == '%';
  if (race.of_all) at.pop_back();
  else if (race.clock == compare::Measure::time && !options.at.empty())
    throw InputError("--at " + options.at, "is no place of a race by time", "give a share of it, as 50%");
  race.at = parse_number("--at", at) / (race.of_all ? 100 : 1);
  if (race.at < 0) throw InputError("--at " + options.at, "lies before the beginning of the race", "give 0 or more");
  return race;
}

}  // namespace

std::optional<Trace::Pixel> pixel_selected(const ShowOptions& options, const Raster& raster) {
  const std::string& text = options.pixel;
  if (text.empty()) return std::nullopt;
  const std::vector<std::string> parts = parts_of(text, ',');
  if (parts.size() != 2) throw InputError("--pixel " + text, "is no pixel", "write --pixel X,Y, as 13,6");
  const std::int64_t x = parse_whole("--pixel", parts[0], 0), y = parse_whole("--pixel", parts[1], 0);
  if (x >= raster.width || y >= raster.height)
    throw InputError("--pixel " + text, fmt::format("the raster has {}x{} pixels", raster.width, raster.height),
                     "they count from 0");
  return Trace::Pixel{static_cast<std::int32_t>(x), static_cast<std::int32_t>(y)};
}

#if ZSTEP_HAS_VIEWER
namespace {

ViewerOptions viewer_options(const Trace& trace, const ShowOptions& options, const ShownWith& with) {
  places::Place place;
  if (!options.race.empty() && with.against)
    throw InputError("--race", "does not go with --against", "open one run, and race methods on its scene");
  if (options.notes && !(options.pane.empty() && options.race.empty()))
    throw InputError("--notes", "does not go with --pane and --race", "leave out one of them");
  if (!options.race.empty() && !options.pane.empty())
    throw InputError("--race", "does not go with --pane", "leave out one of them");
  if (!options.at.empty() && options.race.empty()) place = place_of(trace, options.at, "--at", with.lesson);
  ViewerOptions viewer;
  if (!options.race.empty()) viewer.race = race_of(options);
  else if (!options.at.empty()) viewer.at = place.step, viewer.stop = place.stop;
  if (!options.screenshot.empty()) viewer.screenshot = options.screenshot;
  if (options.screenshot.empty() && !options.pane.empty())
    throw InputError("--pane", "is of a screenshot", "add --screenshot FILE.png");
  viewer.pane = options.pane;
  const bool sized = options.command != nullptr && options.command->count("--size-window") > 0;
  if (sized || viewer.screenshot) viewer.size = WindowSize{options.width, options.height};
  if (options.dark || options.light) viewer.dark = options.dark;
  viewer.presenter = options.presenter;
  viewer.embed = options.embed;
  viewer.notes = options.notes;
  viewer.lesson = with.lesson;
  viewer.checked = with.checked;
  viewer.against = with.against;
  viewer.other_method = record_other_method;
  viewer.run_changed = run_changed;
  viewer.run_watched = run_watched;
  viewer.offers = all_offers;
  viewer.open = open_offer;
  viewer.at_start = with.at_start;
  viewer.kept = with.kept;
  viewer.pixel = pixel_selected(options, trace.scene().raster);
  viewer.lead = options.lead;
  viewer.finished = with.finished && with.whole;
  if (!with.whole)
    viewer.note = fmt::format("Cut off after {} steps, so the picture is not done.", grouped(trace.size()));
  if (options.command != nullptr) viewer.opened_by = words_of(*options.command);
  return viewer;
}

}  // namespace
#endif

void check_opens(const Trace& trace, const ShowOptions& options) {
#if ZSTEP_HAS_VIEWER
  ShowOptions place = options;
  place.command = nullptr;  // it may have no window
  described(trace, viewer_options(trace, place, {}));
#else
  if (!options.at.empty()) step_of(trace, options.at);
#endif
}

int show(const Trace& trace, const ShowOptions& options, const ShownWith& with) {
  check_can_show(options);
#if ZSTEP_HAS_VIEWER
  const ViewerOptions viewer = viewer_options(trace, options, with);
  if (options.describe) fmt::print("{}", described(trace, viewer));
  if (options.describe && options.screenshot.empty()) return exit_code::done;
  const int code = run_viewer(trace, viewer);
  if (code == exit_code::done && viewer.screenshot)
    say_written(options.screenshot,
                fmt::format("{}, {}x{} pixels", options.notes ? "the speaker's notes" : "the viewer", options.width,
                            options.height));
  return code;
#else
  (void)trace;
  (void)with;
  return exit_code::mistake;
#endif
}

}  // namespace zstep::cli
