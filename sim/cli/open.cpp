#include "sim/cli/open.hpp"

#include <fmt/format.h>

#include "algorithms/catalog/catalog.hpp"
#include "algorithms/fast/z_buffer.hpp"
#include "algorithms/scene/load.hpp"
#include "sim/classroom/lesson.hpp"
#include "sim/cli/messages.hpp"
#include "sim/cli/run_options.hpp"
#include "sim/cli/traces.hpp"
#include "sim/words/numbers.hpp"
#include "sim/words/shell_word.hpp"
#include "traces/error.hpp"

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

std::unique_ptr<Opened> opened(OtherRun run, std::vector<std::string> by, std::string note = {}) {
  if (!run.whole)
    note += fmt::format("{}Cut off after {} steps, so the picture is not done.", note.empty() ? "" : " ",
                        grouped(run.trace.size()));
  return std::make_unique<Opened>(Opened{std::move(run.trace), {}, std::move(by), std::move(note)});
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
      return opened(record_patiently(by, run.scene, run.conventions), words);
    }
    note = fmt::format("{} cannot draw this scene, so it is drawn by the {}.", by.title, run.method->title);
  }
  return opened(record_patiently(*run.method, run.scene, run.conventions), words, note);
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
                      static_cast<int>(lesson.stops.size()),
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

}  // namespace zstep::cli
