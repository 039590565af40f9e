#include "sim/homework/assess.hpp"

#include <algorithm>
#include <set>

#include <fmt/format.h>

#include "sim/homework/pictures.hpp"
#include "sim/homework/run_programs.hpp"
#include "sim/words/derived.hpp"
#include "sim/words/judged.hpp"
#include "traces/error.hpp"
#include "traces/events/fields.hpp"
#include "traces/file/files.hpp"
#include "traces/file/jsonl.hpp"
#include "traces/formulas/walk.hpp"
#include "traces/grade/grade.hpp"
#include "traces/record/trace_recorder.hpp"
#include "traces/replay/replay.hpp"

namespace zstep::homework {

namespace {

namespace fs = std::filesystem;

constexpr std::uintmax_t largest_run = std::uintmax_t{1} << 30;

/// A step of a run: the state before it, and what its fields are and follow from.
struct Side {
  std::string name, subject;
  std::vector<FieldText> fields;
};
Side side_of(const Trace& trace, std::int64_t step, std::uint16_t fields) {
  const RecordedEvent recorded = trace.event(step);
  const StepInfo* info = find_step(trace.header().page, recorded.step);
  Side side{info ? info->name : "", {}, {}};
  Replay replay(trace);
  formulas::look_before(trace, replay, step, [&](const formulas::Situation& before) {
    side.subject = subject_of(recorded.event, before);
    side.fields = fields_in_words(recorded.event, before, fields);
  });
  return side;
}

std::string_view text_of(grade::Numbering numbering) {
  switch (numbering) {
    case grade::Numbering::polygons_from_1:
      return "Polygons are numbered from 0, in the order of the file; yours begin with 1.";
    case grade::Numbering::vertices_from_1:
      return "Vertices are numbered from 0, in the order of the file's points; yours begin with 1.";
    case grade::Numbering::vertices_of_polygon:
      return "A vertex has the number of its point in the file, the same in each polygon; yours are counted anew in "
             "each.";
    case grade::Numbering::as_scene:
      break;
  }
  return "";
}

/// Does the run begin polygon 0, or name vertex 0?
bool names_number_0(const Trace& run, grade::Numbering numbering) {
  const bool of_polygons = numbering == grade::Numbering::polygons_from_1;
  bool found = false;
  run.each(0, run.size(), [&](std::int64_t, const RecordedEvent& recorded) {
    if (of_polygons && !holds<PolygonBegin>(recorded.event)) return true;
    for (const FieldOfKind& field : fields_of_kind(recorded.event.index()))
      found = found || (field.name.starts_with(of_polygons ? "polygon" : "vertex") && field.read(recorded.event) == 0);
    return !found;
  });
  return found;
}

/// How the run numbers things: by what was read of it, or by what lets it be read to its end where its numbers do not.
grade::Numbering numbering_of(const Runs& runs, const Task& task, const fs::path& file, GivenRun given) {
  const grade::Numbering told = grade::numbering_of(runs.submission);
  if (told != grade::Numbering::as_scene || runs.impossible.empty()) return told;
  for (const grade::Numbering numbering : {grade::Numbering::polygons_from_1, grade::Numbering::vertices_from_1}) {
    const Scene scene = grade::numbered_from_1(task.scene, numbering);
    given.scene = &scene;
    std::string impossible;
    PassedOver passed_over;
    try {
      const Trace run = open_given_run(file, impossible, given, passed_over);
      if (impossible.empty() && !names_number_0(run, numbering)) return numbering;
    } catch (const InputError&) {  // of such a scene, as of a surface, points cannot be numbered otherwise
    }
  }
  return told;
}

FirstWrong in_words(const Runs& runs, const grade::Divergence& first) {
  FirstWrong words;
  words.at = std::min(first.step, runs.submission.size());
  if (const auto& parts = first.parts) {
    if (!parts->only_b()) {
      const Side ours = side_of(*runs.reference, parts->a, parts->fields);
      words.step = ours.name, words.subject = ours.subject, words.expected = ours.fields;
    }
    if (!parts->only_a()) {
      const Side theirs = side_of(runs.submission, parts->b, parts->fields);
      words.step = theirs.name, words.subject = theirs.subject, words.found = theirs.fields;
    }
    words.missing = parts->only_a();
    words.what = parts->only_a()   ? "This step is missing."
                 : parts->only_b() ? "This step should not be there."
                                   : "This step has other numbers than it should.";
  }
  if (const auto& order = first.too_early) {
    const Side before = side_of(runs.submission, order->before, 0);
    words.what = fmt::format("This step comes too early: {}, {}, must come first. {}", before.name, before.subject,
                             why_too_early(*order));
  }
  if (first.fault) {
    Replay replay(runs.submission);
    const Event event = runs.submission.event(first.step).event;
    FaultText text;
    formulas::look_before(runs.submission, replay, first.step,
                          [&](const formulas::Situation& before) { text = fault_text(*first.fault, event, before); });
    if (words.step.empty()) {
      const StepInfo* info = find_step(runs.submission.header().page, first.fault->line);
      words.step = info ? info->name : "", words.subject = text.subject;
    }
    words.what = what_is_wrong(*first.fault, text);
    // What it should follow from stands in that sentence; it does not follow.
    for (FieldText& field : words.found) field.formula.clear();
    if (!words.what.ends_with('.')) words.what += '.';
  }
  if (const std::string_view numbers = text_of(runs.numbering); !numbers.empty())
    words.what += " " + std::string(numbers);
  if (!first.parts || !first.parts->only_a()) words.where = place_of_step(runs.submission, words.at);
  return words;
}

/// Of steps that nothing can be said of: why, and how to mend it.
std::string note_of_unknown_edges(const Trace& run) {
  const std::set<std::uint8_t> kinds = grade::kinds_of_unknown_edges(run);
  if (kinds.empty()) return "";
  std::string names;
  for (const StepInfo& step : run.header().page)
    if (kinds.contains(step.kind)) names += (names.empty() ? "" : ", ") + step.name;
  return fmt::format(
      "{} name edges, and the run has no edge table that says which: they are left aside until it is "
      "printed, too.",
      names);
}

std::string names_of(const std::vector<fs::path>& files) {
  std::string names;
  for (const fs::path& file : files) names += (names.empty() ? "" : ", ") + file.filename().string();
  return names;
}

/// What a run of no steps gets, but for the pixels.
void grade_from_pictures(const Homework& homework, const Task& task, const std::vector<fs::path>& pictures,
                         Graded& graded) {
  check_run(*homework.method, task.scene, task.conventions, pictures.front().string());
  const Trace reference = reference_run(*homework.method, task.scene, task.conventions);
  TraceRecorder recorder(reference.header(), task.scene);
  recorder.finish();
  const Trace nothing = Trace::from_bytes(recorder.take_bytes(), "no steps");
  const PictureGrade found = grade_pictures(reference, pictures);
  graded.counts = grade::judge(reference, nothing, homework.parts).parts;
  bool others = false;
  for (std::size_t part = 0; part < homework.parts.size(); ++part)
    if (homework.parts[part].level == grade::Level::buffers) graded.counts[part] = found.count(homework.parts[part]);
    else others = others || graded.counts[part].all() > 0;
  graded.first = found.first;
  graded.from_picture = true;
  graded.state = Graded::State::judged;
  if (others) graded.why = fmt::format("there are no steps in {}: only the picture is graded", names_of(pictures));
}

Graded grade_task(const Homework& homework, const Task& task, const fs::path& submission, const fs::path& file,
                  const std::vector<fs::path>& pictures, const References* known) {
  Graded graded;
  graded.task = &task;
  const bool by_pixels = std::any_of(homework.parts.begin(), homework.parts.end(),
                                     [](const grade::Part& part) { return part.level == grade::Level::buffers; });
  if (file.empty() && (pictures.empty() || !by_pixels)) {
    graded.why = fmt::format("there is no {}.jsonl", task.name);
    // It was handed in, and something went wrong before there was a run.
    graded.ended = how_it_ended(submission / (task.name + ".jsonl"), task.hidden);
    if (!graded.ended.empty()) graded.state = Graded::State::unreadable;
    if (!pictures.empty()) graded.why += fmt::format("; {} cannot be graded here, only steps", names_of(pictures));
    return graded;
  }
  graded.file = (file.empty() ? pictures.front() : file).string();
  if (!file.empty() && !pictures.empty())
    graded.note = fmt::format("The run is graded; {} is left aside.", names_of(pictures));
  if (!file.empty()) graded.ended = how_it_ended(file, task.hidden);
  try {
    if (file.empty()) {
      grade_from_pictures(homework, task, pictures, graded);
      return graded;
    }
    const HeldTo held = grade::held_to(homework.digits, homework.free);
    const auto judged = [&](const Runs& runs) {
      return grade::judge(*runs.reference, runs.submission, homework.parts, held);
    };
    Runs runs = runs_of(homework, task, file, Look::at_what_is_there, known);
    grade::Judgement found = judged(runs);
    // A run that broke off is right up to its end, and does nothing else before.
    const bool ends_early = found.first && found.first->step > runs.submission.size() &&
                            std::all_of(found.parts.begin(), found.parts.end(),
                                        [](const grade::PartCount& part) { return part.additional == 0; });
    const bool broke_off = !graded.ended.empty() || ends_early;
    graded.passed_over = runs.passed_over;
    graded.breaks_off = !runs.impossible.empty() || !runs.submission.warnings().empty();
    if (!runs.left_out.empty() && broke_off) {
      runs = runs_of(homework, task, file, Look::at_all, known);
      found = judged(runs);
    }
    graded.left_out = runs.left_out;
    if (const std::string note = note_of_unknown_edges(runs.submission); !note.empty())
      graded.note += (graded.note.empty() ? "" : " ") + note;
    graded.state = Graded::State::judged;
    graded.steps = runs.submission.size();
    if (task.made)
      graded.own = {task.name, sketch_of(runs.submission, homework.parts), sketch_of(*runs.reference, homework.parts)};
    graded.counts = found.parts;
    // What was not read may be there.
    if (!runs.impossible.empty() || runs.passed_over.any())
      for (grade::PartCount& count : graded.counts)
        for (grade::Loss& loss : count.lost)
          if (loss.why == grade::Loss::Why::never || loss.why == grade::Loss::Why::missing)
            loss.why = grade::Loss::Why::not_reached;
    if (!runs.impossible.empty()) {
      graded.why = "the run is judged up to a step that cannot be: " + runs.impossible;
      if (const std::string_view numbers = text_of(runs.numbering); !numbers.empty())
        graded.why += ". " + std::string(numbers);
    }
    if (runs.impossible.empty() && !runs.submission.warnings().empty()) graded.why = runs.submission.warnings().front();
    if (const Precision& written = found.checked.precision;
        graded.why.empty() && found.first && written.held && !precision_of(*runs.reference, held).held)
      graded.why = fmt::format("the numbers are {}: print more of their digits, as %.17g does", written.text);
    if (found.first && !runs.impossible.empty() && found.first->step > runs.submission.size()) {
      // Nothing is wrong before the step that cannot be.
      graded.ends = std::move(found.ends);
    } else if (found.first) {
      graded.first = in_words(runs, *found.first);
      graded.first->mistake = grade::mistake_in(*runs.reference, runs.submission, found, &graded.first->either);
      graded.ends = std::move(found.ends);
    }
  } catch (const InputError& error) {
    graded.state = Graded::State::unreadable;
    graded.why = error.what();
  }
  return graded;
}

}  // namespace

std::vector<std::string> mistake_lines(const FirstWrong& first) {
  if (!first.mistake) return {};
  return likely_in_words({{first.mistake->mistake}, first.mistake->also});
}

fs::path run_of(const fs::path& submission, const Homework& homework, const Task& task, bool meant) {
  std::error_code ignored;
  if (fs::is_directory(submission, ignored)) {
    const fs::path file = submission / (task.name + ".jsonl");
    // What a link leads to is not the student's, and the report would quote it.
    return fs::is_regular_file(fs::symlink_status(file, ignored)) ? file : fs::path();
  }
  if (!fs::is_regular_file(submission, ignored))
    throw InputError(submission.string(), "there is no such file or folder",
                     fmt::format("give the run, as {}.jsonl, or the folder that holds it", task.name));
  if (!pictures_of(submission, task).empty()) return {};
  if (meant || homework.tasks.size() == 1) return submission;
  std::string names;
  for (const Task& one : homework.tasks) {
    if (scene_of(submission) == one.name) return &one == &task ? submission : fs::path();
    names += (names.empty() ? "" : ", ") + one.name + ".jsonl";
  }
  throw InputError(submission.string(), "is named after no scene of the homework",
                   fmt::format("call it as one of these, or give the folder: {}", names));
}

Trace reference_of(const Homework& homework, const Task& task) {
  return reference_run(*homework.method, task.scene, task.conventions);
}

References::References(const Homework& homework) {
  for (const Task& task : homework.tasks)
    by_task_[task.name] = std::make_shared<const Trace>(reference_of(homework, task));
}

std::shared_ptr<const Trace> References::find(const Task& task, const Conventions& conventions) const {
  const auto found = by_task_.find(task.name);
  return found != by_task_.end() && found->second->header().conventions == conventions ? found->second : nullptr;
}

namespace {

/// The parts that a run has no step of; their kinds are added to `kinds`. None where it has no step of any.
std::vector<std::string> parts_left_out(const Homework& homework, const Trace& run, std::set<std::uint8_t>& kinds) {
  std::vector<std::string> names;
  bool any_there = false;
  for (const grade::Part& part : homework.parts) {
    const bool is_there =
        std::any_of(part.kinds.begin(), part.kinds.end(), [&](std::uint8_t kind) { return run.has(kind); });
    any_there = any_there || is_there;
    if (part.kinds.empty() || is_there) continue;
    names.push_back(part.name);
    kinds.insert(part.kinds.begin(), part.kinds.end());
  }
  if (!any_there) names.clear();
  return names;
}

}  // namespace

Runs runs_of(const Homework& homework, const Task& task, const fs::path& file, Look look, const References* known) {
  note_input(file);
  std::error_code ignored;
  if (fs::file_size(file, ignored) > largest_run)
    throw InputError(file.string(), "is larger than 1 GiB", "print each step once, and nothing else");
  if (fs::file_size(file, ignored) == 0)
    throw InputError(file.string(), "is empty", "print each step to standard output, one a line, as the hand-out says");
  const Header header = header_for(*homework.method, task.conventions, task.scene.camera.kind);
  GivenRun given = grade::given_run(header, task.scene, homework.free);
  std::string impossible;
  PassedOver passed_over;
  Trace submission = open_given_run(file, impossible, given, passed_over);
  std::set<std::uint8_t> kinds;
  std::vector<std::string> left_out;
  const bool broke_off = !impossible.empty() || !submission.warnings().empty() || passed_over.any();
  if (look == Look::at_what_is_there && !broke_off) left_out = parts_left_out(homework, submission, kinds);
  if (!left_out.empty()) {
    given.review = [all = given.review, &kinds](const Header& declared) {
      Header left = all(declared);
      std::erase_if(left.page, [&](const StepInfo& step) { return kinds.contains(step.kind); });
      return left;
    };
    submission = open_given_run(file, impossible, given, passed_over);
  }
  const Conventions& conventions = submission.header().conventions;
  check_run(*homework.method, task.scene, conventions, file.string());
  std::shared_ptr<const Trace> reference = known ? known->find(task, conventions) : nullptr;
  if (!reference) reference = std::make_shared<const Trace>(reference_run(*homework.method, task.scene, conventions));
  Runs runs{std::move(reference), std::move(submission), impossible, left_out, passed_over};
  runs.numbering = numbering_of(runs, task, file, given);
  return runs;
}

std::string Graded::shown() const {
  std::string text = ended;
  const auto add = [&](const std::string& more) {
    if (!more.empty()) text += (text.empty() ? "" : "\n") + more;
  };
  if (passed_over.any() && task->hidden) {
    add("some of its lines cannot be read, and earn nothing");
  } else if (passed_over.any()) {
    for (const std::string& fault : passed_over.faults) add(fault);
    std::int64_t lines = 0;
    for (const PassedOver::Range& range : passed_over.lines) lines += range.last - range.first + 1;
    add((lines == 1 ? "This line cannot be read, and earns nothing"
                    : fmt::format("{} lines cannot be read, and earn nothing", lines)) +
        (passed_over.gave_up ? "; what comes after the last of them was not read." : "."));
  }
  if (!task->hidden || state == State::missing || state == State::stopped || from_picture) add(why);
  else if (state == State::unreadable) add("the run cannot be read");
  else if (!why.empty()) add("the run ends early, or is judged up to a step that cannot be");
  return text;
}

bool Graded::is_whole() const {
  return state == State::judged &&
         std::all_of(counts.begin(), counts.end(), [](const grade::PartCount& count) { return count.lost.empty(); });
}

double Assessment::most(const Graded& task, std::size_t part) const {
  return homework->share(*task.task) * homework->parts[part].points();
}
double Assessment::points(const Graded& task, std::size_t part) const {
  if (task.counts.empty()) return 0;
  const grade::Part& of = homework->parts[part];
  const grade::PartCount& count = task.counts[part];
  return homework->share(*task.task) * (count.computation_points(of) + count.value_points(of));
}
double Assessment::points() const {
  double all = 0;
  for (const Graded& task : tasks)
    for (std::size_t part = 0; part < homework->parts.size(); ++part) all += points(task, part);
  return all;
}
double Assessment::most() const {
  double all = 0;
  for (const Graded& task : tasks) all += homework->share(*task.task) * homework->points();
  return all;
}
bool Assessment::gradable() const {
  return std::any_of(tasks.begin(), tasks.end(),
                     [](const Graded& task) { return task.state == Graded::State::judged; });
}

namespace {

/// Where several mistakes make the same numbers in one scene, it is the one that is named in another scene; and where a
/// step is missing, which says little by itself, the one by which it is missing there.
void decide_by_other_scenes(Assessment& all) {
  std::set<mistakes::Mistake> named;
  for (const Graded& task : all.tasks)
    if (task.first && task.first->mistake && !task.first->mistake->also) named.insert(task.first->mistake->mistake);
  for (Graded& task : all.tasks) {
    if (!task.first) continue;
    std::erase_if(task.first->either, [&](mistakes::Mistake one) { return !named.contains(one); });
    if (task.first->either.size() == 1) task.first->mistake.emplace().mistake = task.first->either.front();
    if (task.first->mistake || !task.first->missing) continue;
    const auto other = std::find_if(all.tasks.begin(), all.tasks.end(), [&](const Graded& one) {
      return one.first && one.first->missing && one.first->mistake && one.first->step == task.first->step;
    });
    if (other != all.tasks.end()) task.first->mistake = other->first->mistake;
  }
}

}  // namespace

Assessment assess(const Homework& homework, const fs::path& submission, const std::string& only,
                  const std::function<void(const Task&)>& on_task, const References* known) {
  Assessment all{&homework, submission.string(), {}};
  for (const Task& task : homework.tasks) {
    if (!only.empty() && task.name != only) continue;
    const fs::path file = run_of(submission, homework, task, !only.empty());
    const std::vector<fs::path> pictures = pictures_of(submission, task);
    if (file.empty() && pictures.empty() && fs::is_regular_file(submission)) continue;  // it is another scene's
    if (on_task) on_task(task);
    all.tasks.push_back(grade_task(homework, task, submission, file, pictures, known));
  }
  decide_by_other_scenes(all);
  return all;
}

Assessment not_graded(const Homework& homework, const fs::path& submission, const std::string& only,
                      const std::string& why) {
  Assessment all{&homework, submission.string(), {}};
  for (const Task& task : homework.tasks) {
    if (!only.empty() && task.name != only) continue;
    Graded graded;
    graded.task = &task;
    graded.state = Graded::State::stopped;
    graded.why = why;
    all.tasks.push_back(std::move(graded));
  }
  return all;
}

}  // namespace zstep::homework
