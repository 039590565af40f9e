// Running a lesson: its method on its scene, then its stops against the trace.
#include <algorithm>
#include <fmt/format.h>
#include <set>

#include "algorithms/catalog/catalog.hpp"
#include "algorithms/catalog/changes.hpp"
#include "sim/classroom/anchor.hpp"
#include "sim/classroom/chart_table.hpp"
#include "sim/classroom/evaluate.hpp"
#include "sim/classroom/fill.hpp"
#include "sim/classroom/lesson.hpp"
#include "sim/classroom/marking.hpp"
#include "traces/error.hpp"
#include "traces/file/jsonl.hpp"
#include "traces/record/trace_recorder.hpp"
#include "traces/replay/replay.hpp"

namespace zstep {

using namespace classroom;

namespace {

/// A scene with a file's ending lies beside the lesson; a bare word is a built-in scene.
std::string scene_path(const Lesson& lesson, const std::string& scene) {
  static const std::set<std::string> endings{".toml", ".obj", ".off", ".ply", ".stl"};
  const std::filesystem::path path(scene);
  if (endings.count(path.extension().string()) == 0 || path.is_absolute()) return scene;
  return (lesson.path.parent_path() / path).string();
}

Conventions with_options(Conventions conventions, const ConventionOptions& options) {
  options.choices.apply(conventions);
  if (options.cull) conventions.cull = *options.cull;
  for (const auto& [name, value] : options.options) conventions.options[name] = value;
  return conventions;
}

Trace recorded(const Method& run, const Scene& scene, const Conventions& conventions, const std::string& name) {
  TraceRecorder record(header_for(run, conventions, scene.camera.kind), scene);
  run.record(scene, conventions, record);
  record.finish();
  return Trace::from_bytes(record.take_bytes(), name);
}

/// `own`: the run of the lesson itself.
Trace run_beside(const Lesson& lesson, const RunBeside& beside, const Trace& own, const std::string& where) {
  const std::filesystem::path file = lesson.path.parent_path() / beside.file;
  if (std::filesystem::path(beside.file).has_extension() && file.extension() != ".toml") return open_jsonl(file);
  std::string drawn_by = lesson.method;
  std::vector<Change> changes;
  for (const std::string& written : beside.changes)
    if (const Change change = read_change(written); change.name == "method") drawn_by = change.value;
    else changes.push_back(change);
  const Method& run = method(drawn_by);
  Scene scene = own.scene();
  Conventions conventions = own.header().conventions;
  if (!beside.file.empty()) {
    SceneFile other = load_scene(scene_path(lesson, beside.file));
    conventions = other.conventions;
    prepare_for_shade(other, conventions);
    scene = look_at_scene(std::move(other.scene), {});
  }
  for (const Change& change : changes) make_change(run, change, scene, conventions, where);
  check_run(run, scene, conventions, where);
  return recorded(run, scene, conventions, beside.name());
}

/// What a stop has named or shown large is there, and its words name what its pictures name.
void check_shown(const Stop& stop, const Scene& scene, const std::string& place) {
  const auto is_polygon = [&](const std::string& name) {
    return std::any_of(scene.polygons.begin(), scene.polygons.end(),
                       [&](const auto& one) { return *one.name == name; });
  };
  const auto is_direction = [&](const std::string& name) {  // of light at a vertex with a normal
    return (name == "r" || name == "v") &&
           std::any_of(scene.attributes.begin(), scene.attributes.end(),
                       [](const VertexAttribute& one) { return one.name == normal_attribute; });
  };
  std::string words = stop.heading + stop.text;
  if (stop.question) {
    words += stop.question->text;
    for (const Answer& answer : stop.question->answers) words += answer.text;
  }
  for (const StopLabel& label : stop.labels) {
    const std::string& polygon = label.plane_of.empty() ? label.name : label.plane_of;
    const bool known = label.scan_line >= 0 ? label.scan_line < scene.raster.height
                       : label.vertex < 0   ? is_polygon(polygon) || is_direction(label.name)
                                            : std::max(label.vertex, label.to) < std::ssize(scene.points);
    if (!known)
      throw InputError(place, fmt::format("the scene has no `{}` to label", label.name),
                       "name a vertex, a polygon or a scan line of it");
    if (words.find(label.name) == std::string::npos)
      throw InputError(place, fmt::format("`{}` is labelled, and the stop does not speak of it", label.name),
                       "leave it out");
  }
  if (!stop.close.empty() && !is_polygon(stop.close))
    throw InputError(place, fmt::format("the scene has no polygon `{}` to come close to", stop.close),
                     "name one of it");
}

}  // namespace

std::string RunBeside::name() const {
  std::string all = std::filesystem::path(file).extension().empty() ? file : "";  // of a built-in scene its name
  for (const std::string& change : changes)
    if (file.empty() || read_change(change).name != "method") all += (all.empty() ? "" : ", ") + change;
  return all.empty() ? file : all;
}

TaskState state_of(const Task& task, const Trace& trace) {
  Replay replay(trace);
  const Place at{"", task.done_line};
  TaskState state;
  try {
    state.done = holds(parse_expression(task.done, at.str()), Moment(replay, nullptr, trace.size(), at.str()));
  } catch (const InputError&) {
    // A run in which there is no such thing does not do it.
  }
  if (state.done || task.now.empty()) return state;
  try {
    state.now = fill(task.now, {"", task.now_line}, replay, nullptr, trace.size());
  } catch (const InputError&) {
  }
  return state;
}

void resolve_lesson(Lesson& lesson, const Trace& trace) {
  const std::string file = lesson.path.string();
  Replay replay(trace);
  Spot spot;
  bool has_chart = false;
  for (Stop& stop : lesson.stops) {
    const Place place{file, stop.line};
    spot = resolve_anchor(parse_anchor(stop.anchor, place.str()), spot, replay, place.str());
    stop.position = spot.position;
    stop.event = spot.event;
    const std::optional<RecordedEvent> event = spot.event > 0 ? std::optional(trace.event(spot.event)) : std::nullopt;
    const auto filled = [&](const std::string& text, std::int32_t line) {
      return fill(text, {file, line}, replay, event ? &*event : nullptr, spot.position);
    };
    stop.heading = filled(stop.heading, stop.line);
    for (RunBeside& beside : stop.beside) {
      for (const Stop& other : lesson.stops)
        for (const RunBeside& made : other.beside)
          if (made.run && made.file == beside.file && made.changes == beside.changes) beside.run = made.run;
      if (!beside.run)
        beside.run = std::make_shared<const Trace>(run_beside(lesson, beside, trace, Place{file, stop.line}.str()));
    }
    stop.marked_depths.clear();
    if (!stop.depths.empty())
      for (const Expression& depth : parse_list(stop.depths, place.str()))
        stop.marked_depths.push_back(
            evaluate(depth, Moment(replay, event ? &*event : nullptr, spot.position, place.str())).number);
    const Scene& scene = trace.scene();
    if (stop.pixel && (stop.pixel->x >= scene.raster.width || stop.pixel->y >= scene.raster.height))
      throw InputError(place.str(), fmt::format("there is no pixel ({}, {})", stop.pixel->x, stop.pixel->y),
                       fmt::format("x is less than {}, y less than {}", scene.raster.width, scene.raster.height));
    if (!stop.pixels.steps.empty()) resolve_marking(stop.pixels, replay, 0, file);
    stop.names = names_in(stop.text, {file, stop.text_line});
    stop.text = filled(stop.text, stop.text_line);
    has_chart = chart_table(stop.text, {file, stop.text_line}) || has_chart;
    if (stop.focus == "chart" && !has_chart)
      throw InputError(place.str(), "there is no table for `focus: chart`",
                       "write one, here or at a stop before, in a block that opens with ``` and what its numbers are");
    check_shown(stop, trace.scene(), place.str());
    if (stop.task) {
      stop.task->text = filled(stop.task->text, stop.task->text_line);
      for (std::string& hint : stop.task->hints) hint = trim(filled(hint, stop.task->line));
      if (state_of(*stop.task, trace).done)
        throw InputError(Place{file, stop.task->done_line}.str(), "the lesson's own run does the task already",
                         "give a condition that holds only after a change");
    }
    if (stop.marking) {
      stop.marking->text = filled(stop.marking->text, stop.marking->text_line);
      stop.marking->why = filled(stop.marking->why, stop.marking->why_line);
      for (std::string& hint : stop.marking->hints) hint = trim(filled(hint, stop.marking->line));
      resolve_marking(*stop.marking, replay, stop.position, file);
    }
    if (stop.notes) stop.notes->text = filled(stop.notes->text, stop.notes->text_line);
    if (!stop.question) continue;
    stop.question->text = filled(stop.question->text, stop.question->line);
    for (Answer& answer : stop.question->answers) {
      answer.text = filled(answer.text, answer.line);
      answer.reply = filled(answer.reply, answer.reply_line);
    }
  }
}

Trace run_lesson(Lesson& lesson) {
  const Method& run = method(lesson.method);
  SceneFile file = load_scene(scene_path(lesson, lesson.scene));
  const Conventions conventions = with_options(file.conventions, lesson.conventions);
  prepare_for_shade(file, conventions);
  const Scene scene = look_at_scene(std::move(file.scene), lesson.view);
  check_run(run, scene, conventions, lesson.path.string());
  if (lesson.conventions.cull && !can_cull(run, scene))
    throw InputError(lesson.path.string(), "cull means nothing for this method and scene",
                     "leave it out of [conventions]");
  Trace trace = recorded(run, scene, conventions, "lesson " + lesson.id);
  resolve_lesson(lesson, trace);
  return trace;
}

}  // namespace zstep
