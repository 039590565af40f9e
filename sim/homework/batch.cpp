#include "sim/homework/batch.hpp"

#include <algorithm>
#include <memory>
#include <new>
#include <optional>
#include <span>
#include <system_error>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "sim/homework/pictures.hpp"
#include "sim/homework/reports.hpp"
#include "sim/homework/run_programs.hpp"
#include "traces/image/file.hpp"
#include "sim/words/escaped.hpp"
#include "traces/error.hpp"
#include "traces/file/container.hpp"
#include "traces/file/files.hpp"
#include "traces/text.hpp"

namespace zstep::homework {

namespace {

namespace fs = std::filesystem;

constexpr int taken_over = 10;  ///< the exit code of a child that had nothing to do

/// One name in the folder of the submissions.
struct Entry {
  fs::path path;
  std::string name;
  std::string refused;       ///< why it is not even opened
  std::uintmax_t bytes = 0;  ///< of what it has
};

const char* kind_of_file(fs::file_type type) {
  switch (type) {
    case fs::file_type::symlink:
      return "is a link, and links are not followed";
    case fs::file_type::fifo:
      return "is a pipe";
    case fs::file_type::socket:
      return "is a socket";
    case fs::file_type::block:
    case fs::file_type::character:
      return "is a device";
    default:
      return "cannot be read";
  }
}

/// Names that a shell, a table or another system would take for something else.
bool is_plain_name(const std::string& name) { return printable(name) == name && name.find('\\') == std::string::npos; }

/// Looks at a submission without opening a file of it.
Entry look_at(const fs::directory_entry& found, const Homework& homework) {
  Entry entry;
  entry.path = found.path();
  entry.name = found.path().filename().string();
  std::error_code error;
  if (!is_plain_name(entry.name)) {
    entry.refused = "its name has characters that do not show, or a \\: rename it";
    return entry;
  }
  const fs::file_type type = found.symlink_status(error).type();
  if (type == fs::file_type::regular) {
    entry.bytes = found.file_size(error);
    return entry;
  }
  if (type != fs::file_type::directory) {
    entry.refused = kind_of_file(type);
    return entry;
  }
  fs::directory_iterator files(entry.path, error);
  if (error) entry.refused = "cannot be read: " + error.message();
  for (; !error && files != fs::directory_iterator(); files.increment(error)) {
    const std::string file = files->path().filename().string();
    if (std::none_of(homework.tasks.begin(), homework.tasks.end(),
                     [&](const Task& task) { return file.starts_with(task.name + "."); }))
      continue;
    std::error_code ignored;
    const fs::file_type kind = files->symlink_status(ignored).type();
    if (kind == fs::file_type::regular) entry.bytes += files->file_size(ignored);
    else if (kind != fs::file_type::directory)
      entry.refused = fmt::format("{} {}", printable(file), kind_of_file(kind));
  }
  return entry;
}

/// What is graded is held in memory anyway, where the budget of the submission ends it.
constexpr std::uintmax_t no_limit = std::uintmax_t{1} << 40;

std::string digest_of(std::string_view text) {
  constexpr Tag digest{'D', 'I', 'G', 'E'};
  return fmt::format("{:016x}",
                     checksum_of(digest, std::span(reinterpret_cast<const std::uint8_t*>(text.data()), text.size())));
}

/// Changes when what is to be done or how it is graded does.
std::string key_of(const Homework& homework, const std::string& scene) {
  std::string all = ZSTEP_VERSION "\n" + scene + "\n" + read_whole(homework.folder / "homework.toml", no_limit);
  for (const Task& task : homework.tasks)
    all += task.name + "\n" +
           jsonl_header(header_for(*homework.method, task.conventions, task.scene.camera.kind), task.scene) + "\n";
  return digest_of(all);
}

/// Changes when a file of the submission does that is graded.
std::string key_of(const Entry& entry, const Homework& homework, const std::string& scene) {
  std::string all = entry.name + "\n";
  for (const Task& task : homework.tasks) {
    if (!scene.empty() && task.name != scene) continue;
    const fs::path file = run_of(entry.path, homework, task, !scene.empty());
    if (!file.empty())
      all += fmt::format("{} {} {}\n", task.name, digest_of(read_whole(file, no_limit)), how_it_ended(file, false));
    for (const fs::path& picture : pictures_of(entry.path, task))
      all += fmt::format("{} {}\n", picture.filename().string(), digest_of(read_whole(picture, no_limit)));
  }
  return digest_of(all);
}

/// In the child: grades a submission, unless that was done, and keeps what it earned.
int grade_one(const Entry& entry, const Homework& homework, const BatchOptions& options,
              const std::string& homework_key, const fs::path& kept, const References& references) {
  const auto refuse = [&](const std::string& key, const std::string& why) {
    keep_refused(kept, key, why);
    return 0;
  };
  std::string key = homework_key;
  try {
    std::optional<Homework> own;  // with the student's own scenes
    if (homework.seeded()) {
      // A folder is called as its student; of a file, what comes before the ending.
      const fs::path called = fs::is_directory(entry.path) ? entry.path.filename() : entry.path.stem();
      own = load_homework(homework.folder, called.string());
      key = key_of(*own, options.scene);
    }
    const Homework& graded = own ? *own : homework;
    key += key_of(entry, graded, options.scene);
    if (is_kept(kept, key)) return taken_over;
    const Assessment all = assess(graded, entry.path, options.scene, nullptr, own ? nullptr : &references);
    std::vector<OwnRun> runs;
    for (const Graded& task : all.tasks)
      if (task.own) runs.push_back(*task.own);
    keep(kept, key, report_json(all), runs);
    return 0;
  } catch (const InputError& error) {
    return refuse(key, error.what());
  } catch (const std::bad_alloc&) {
    return refuse(key, "needs more memory than a submission may take; --memory allows it more");
  }
}

/// Where students have scenes of their own, what they handed in for them is not the same.
std::vector<AlikeRuns> alike_in(const Batch& batch, const Homework& homework, const References& references) {
  if (!homework.seeded()) return {};
  std::vector<HandedIn> all;
  for (const Result& result : batch.results) all.push_back({result.name, result.own});
  std::vector<Sketch> right_public;
  for (const Task& task : homework.tasks)
    if (!task.made)
      if (const auto right = references.find(task, task.conventions))
        right_public.push_back(sketch_of(*right, homework.parts));
  return alike_runs(all, right_public);
}

Result of_refused(const std::string& name, const std::string& why) {
  Result result;
  result.name = name, result.state = Result::State::ungradable, result.why = why;
  return result;
}

}  // namespace

Batch grade_batch(const Homework& homework, const BatchOptions& options,
                  const std::function<void(std::size_t, std::size_t)>& on_progress) {
  std::error_code error;
  fs::directory_iterator folder(options.submissions, error);
  if (error)
    throw InputError(options.submissions.string(), "cannot be read: " + error.message(),
                     "give the folder with one file or one folder for each student");
  fs::create_directories(options.results, error);
  if (error)
    throw InputError(options.results.string(), "cannot be made: " + error.message(), "write the gradebook elsewhere");
  Batch batch;
  std::vector<Entry> entries;
  for (const fs::directory_entry& found : folder) {
    if (found.path().filename().string().starts_with('.')) ++batch.left_out;
    else entries.push_back(look_at(found, homework));
  }
  std::sort(entries.begin(), entries.end(), [](const Entry& a, const Entry& b) { return a.name < b.name; });
  const std::string key = key_of(homework, options.scene);
  const std::size_t scenes = options.scene.empty() ? homework.tasks.size() : 1;
  for (const Task& task : homework.tasks)
    if (task.name == options.scene) batch.share = homework.share(task);
  const References references(homework);  // recorded once, before the children that share them

  std::vector<std::unique_ptr<Child>> running;
  std::vector<std::size_t> places;  // of the entries that they grade
  batch.results.resize(entries.size());
  std::size_t next = 0, done = 0;
  const auto file_of = [&](const Entry& entry) { return options.results / (file_name_of(entry.name) + ".json"); };
  while (done < entries.size()) {
    while (next < entries.size() && running.size() < static_cast<std::size_t>(options.jobs)) {
      const Entry& entry = entries[next];
      if (!entry.refused.empty()) {
        batch.results[next] = of_refused(entry.name, entry.refused);
        ++done;
      } else {
        running.push_back(std::make_unique<Child>(limits_for(entry.bytes, options.seconds, options.memory), [&] {
          return grade_one(entry, homework, options, key, file_of(entry), references);
        }));
        places.push_back(next);
      }
      ++next;
    }
    on_progress(done, entries.size());
    if (running.empty()) continue;
    Child::wait_for_one(running);
    for (std::size_t i = running.size(); i-- > 0;) {
      if (!running[i]->ended()) continue;
      const Entry& entry = entries[places[i]];
      const Child& child = *running[i];
      batch.taken_over += child.code() == taken_over;
      // A process that did not come to its end left no result of this time behind.
      if (child.code() == 0 || child.code() == taken_over)
        batch.results[places[i]] = read_kept(file_of(entry), entry.name, homework, scenes);
      else
        batch.results[places[i]] =
            of_refused(entry.name, "the grading " + (child.why().empty() ? "failed" : child.why()) +
                                       (child.said().empty() ? "" : ": " + printable(child.said())));
      running.erase(running.begin() + i);
      places.erase(places.begin() + i);
      ++done;
    }
  }
  on_progress(done, entries.size());
  batch.alike = alike_in(batch, homework, references);
  return batch;
}

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
