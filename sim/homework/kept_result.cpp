#include "sim/homework/kept_result.hpp"

#include <algorithm>
#include <span>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "sim/image/file.hpp"
#include "sim/words/percent.hpp"
#include "traces/error.hpp"
#include "traces/file/chunk.hpp"
#include "traces/text.hpp"

namespace zstep::homework {

namespace {

namespace fs = std::filesystem;
using KeptJson = nlohmann::ordered_json;

void write_kept(const fs::path& path, const KeptJson& json) {
  const std::string text = printable_json(json.dump(1, ' ', false, KeptJson::error_handler_t::replace)) + "\n";
  rewrite_file(path, std::span(reinterpret_cast<const std::uint8_t*>(text.data()), text.size()));
}

KeptJson json_of(const Sketch& sketch) {
  return {{"least", sketch.least}, {"steps", sketch.steps}, {"numbers", sketch.numbers}, {"whole", sketch.whole}};
}
Sketch sketch_from(const KeptJson& json) {
  Sketch sketch;
  json.at("least").get_to(sketch.least);
  json.at("steps").get_to(sketch.steps);
  json.at("numbers").get_to(sketch.numbers);
  json.at("whole").get_to(sketch.whole);
  return sketch;
}

std::string first_line(const std::string& text) { return text.substr(0, text.find('\n')); }

/// What a scene's run is filed under: that its program crashed, a line that cannot be read, its first wrong step, or
/// what it lacks.
std::optional<Result::First> first_of(const KeptJson& scene, const std::string& called) {
  if (scene.contains("ended"))
    return Result::First{called, "", "crash", "", first_line(scene.at("ended").get<std::string>())};
  if (scene.contains("unreadable")) {
    const KeptJson& faults = scene.at("unreadable").at("faults");
    return Result::First{called, "", "a line that cannot be read", "",
                         faults.empty() ? "" : faults.front().get<std::string>()};
  }
  if (scene.contains("first")) {
    const KeptJson& first = scene.at("first");
    const auto text = [&](const char* key) { return first.at(key).get<std::string>(); };
    return Result::First{called, text("where"), text("step"), text("subject"), text("what")};
  }
  for (const KeptJson& part : scene.at("parts"))
    for (const KeptJson& loss : part.at("lost")) {
      const std::string steps = loss.at("steps").get<std::string>();
      return Result::First{called, "", steps.empty() ? part.at("name").get<std::string>() : steps, "",
                           loss.at("text").get<std::string>()};
    }
  return std::nullopt;
}

KeptJson kept_json(const fs::path& path) {
  constexpr std::uintmax_t largest = 64 << 20;
  const std::vector<std::uint8_t> bytes = read_file(path, largest);
  return KeptJson::parse(bytes.begin(), bytes.end());
}

}  // namespace

std::string file_name_of(const std::string& name) {
  constexpr std::size_t longest = 120;
  const std::string_view all = name;
  const std::string file = percent_encoded(all.substr(0, 1), "") +
                           percent_encoded(all.substr(std::min<std::size_t>(1, all.size())), "._-@+ ");
  if (file.size() <= longest) return file;
  const std::span bytes(reinterpret_cast<const std::uint8_t*>(name.data()), name.size());
  return fmt::format("{}%{:016x}", file.substr(0, longest), checksum_of(Tag{'N', 'A', 'M', 'E'}, bytes));
}

void keep(const fs::path& path, const std::string& key, const std::string& report, const std::vector<OwnRun>& own) {
  KeptJson json{{"key", key}, {"report", KeptJson::parse(report)}};
  for (const OwnRun& run : own)
    json["own"].push_back({{"scene", run.scene}, {"run", json_of(run.run)}, {"right", json_of(run.right)}});
  write_kept(path, json);
}
void keep_refused(const fs::path& path, const std::string& key, const std::string& why) {
  write_kept(path, {{"key", key}, {"why", why}});
}

bool is_kept(const fs::path& path, const std::string& key) {
  try {
    const KeptJson json = kept_json(path);
    return json.at("key") == key && (json.contains("report") || json.contains("why"));
  } catch (const std::exception&) {
    return false;  // none yet, or one that somebody changed
  }
}

Result read_kept(const fs::path& path, const std::string& name, const Homework& homework, std::size_t scenes) {
  Result result;
  result.name = name;
  result.file = path.string();
  try {
    const KeptJson json = kept_json(path);
    if (json.contains("why")) {
      result.state = Result::State::ungradable;
      result.why = json.at("why").get<std::string>();
      return result;
    }
    const KeptJson& report = json.at("report");
    std::size_t judged = 0, missing = 0;
    for (const KeptJson& scene : report.at("scenes")) {
      const std::string state = scene.at("state").get<std::string>(), called = scene.at("scene").get<std::string>();
      judged += state == "judged", missing += state == "missing";
      if (scene.contains("why"))
        result.why +=
            fmt::format("{}{}: {}", result.why.empty() ? "" : "; ", called, scene.at("why").get<std::string>());
      const KeptJson& parts = scene.at("parts");
      if (state == "judged") result.parts.resize(homework.parts.size());
      for (std::size_t part = 0; part < parts.size() && part < result.parts.size(); ++part) {
        result.parts[part].points += parts[part].at("points").get<double>();
        result.parts[part].most += parts[part].at("of").get<double>();
      }
      if (result.mistake.empty() && scene.contains("mistake") && (!result.first || result.first->scene == called))
        result.mistake = scene.at("mistake").at("name").get<std::string>();
      if (!result.first) result.first = first_of(scene, called);
    }
    if (report.at("scenes").size() < scenes) result.why += "there is a run of one scene alone";
    result.state = judged == scenes                        ? Result::State::graded
                   : judged > 0                            ? Result::State::partly
                   : missing == report.at("scenes").size() ? Result::State::missing
                                                           : Result::State::ungradable;
    if (result.state == Result::State::missing) result.why = "nothing was handed in";
    result.points = report.at("points").get<double>();
    if (json.contains("own"))
      for (const KeptJson& run : json.at("own"))
        result.own.push_back(
            {run.at("scene").get<std::string>(), sketch_from(run.at("run")), sketch_from(run.at("right"))});
    return result;
  } catch (const nlohmann::json::exception&) {
    throw InputError(path.string(), "was not written by zstep grade", "remove it, and grade again");
  }
}

}  // namespace zstep::homework
