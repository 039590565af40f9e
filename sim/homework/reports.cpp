// The report that a student reads: one page, by which the points can be worked out by hand; and the formats in which
// courses read results.

#include "sim/homework/reports.hpp"

#include <algorithm>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "sim/homework/report_words.hpp"
#include "sim/words/escaped.hpp"
#include "traces/text.hpp"

namespace zstep::homework {

namespace {

/// "computed 12 of 15: 4 of 5; right 10 of 15: 3.33 of 5"
std::string shares_text(const Homework& homework, const Graded& task, std::size_t index) {
  const grade::Part& part = homework.parts[index];
  const grade::PartCount& count = task.counts[index];
  const double share = homework.share(*task.task);
  if (task.from_picture && part.level != grade::Level::buffers && count.all() > 0)
    return fmt::format("there are no steps: 0 of {}", points_text(share * part.points()));
  std::string text;
  const auto add = [&](const char* word, std::int64_t of, double points, double most) {
    if (most > 0)
      text += fmt::format("{}{} {} of {}: {} of {}", text.empty() ? "" : "; ", word, of, count.all(),
                          points_text(share * points, share * most), points_text(share * most));
  };
  add("computed", count.computed, count.computation_points(part), part.computation);
  if (count.in_halves() && part.value > 0)
    text +=
        fmt::format("right colours {}, right depths {}, of {} each: {} of {}", count.halves->colors,
                    count.halves->depths, count.all(),
                    points_text(share * count.value_points(part), share * part.value), points_text(share * part.value));
  else
    add(part.level == grade::Level::buffers ? "right pixels" : "right", count.same, count.value_points(part),
        part.value);
  if (const std::string lost = losses_text(homework, count, task.task->hidden); !lost.empty())
    text += fmt::format("\n{:28}{}", "", lost);
  return text;
}

/// Each line two letters in.
std::string indented(const std::string& lines) {
  std::string text = "  ";
  for (const char letter : printable_lines(lines)) text += letter == '\n' ? "\n  " : std::string(1, letter);
  return text + "\n";
}

std::string task_text(const Assessment& all, const Graded& task) {
  const Homework& homework = *all.homework;
  double points = 0, most = 0;
  for (std::size_t part = 0; part < homework.parts.size(); ++part)
    points += all.points(task, part), most += all.most(task, part);
  std::string text = fmt::format(
      "{}: {}{} points\n", printable(task.task->name),
      task.state == Graded::State::judged ? points_text(points, most) + " of " : "no grade, of ", points_text(most));
  if (task.state == Graded::State::missing) return text + fmt::format("  Nothing was handed in: {}.\n", task.shown());
  if (task.state == Graded::State::unreadable) return text + "  This cannot be graded:\n" + indented(task.shown());
  if (task.state == Graded::State::stopped) return text + indented(task.shown());
  if (!task.shown().empty() && &task != said_first(all)) text += indented(task.shown());
  if (!task.note.empty()) text += indented(task.note);
  for (std::size_t part = 0; part < homework.parts.size(); ++part)
    text += fmt::format("  {} {:<22} {}\n", task.counts[part].lost.empty() ? "ok" : "  ",
                        printable(homework.parts[part].name), shares_text(homework, task, part));
  return text;
}

/// What works, a line for each scene that is not all right, as far as a first page has room.
std::string what_works_text(const Assessment& all) {
  const Homework& homework = *all.homework;
  constexpr std::size_t room = 8;
  std::string right, lines;
  std::size_t count = 0;
  for (const Graded& task : all.tasks) {
    const std::string name = printable(task.task->name);
    if (is_right(task)) {
      right += (right.empty() ? "" : ", ") + name;
      continue;
    }
    if (++count > room) continue;
    std::string parts;
    for (std::size_t part = 0; part < homework.parts.size(); ++part)
      if (part < task.counts.size() && task.counts[part].lost.empty())
        parts += (parts.empty() ? "" : ", ") + printable(homework.parts[part].name);
    lines += fmt::format("{}: {}\n", name,
                         task.state != Graded::State::judged ? "no grade; why is said below"
                         : parts.empty()                     ? "no part is wholly right yet"
                                                             : "right are " + parts);
  }
  if (count > room) lines += fmt::format("and {} scenes more\n", count - room);
  return (right.empty() ? "" : "All right: " + right + "\n") + lines;
}

/// The first wrong step, and what there is to know of it.
std::string first_wrong_text(const Graded& wrong, const std::string& command) {
  const FirstWrong& first = *wrong.first;
  std::string text = fmt::format("\nThe first thing to look at, in {}{}:\n  {}{}\n  {}\n", printable(wrong.task->name),
                                 first.where.empty() ? "" : ", " + first.where, first.step,
                                 first.subject.empty() ? "" : ", " + first.subject, first.what);
  for (const FieldText& field : first.expected) text += fmt::format("  expected  {}\n", field.line());
  for (const FieldText& field : first.found) text += fmt::format("  yours     {}\n", field.line());
  for (const std::string& line : mistake_lines(first)) text += fmt::format("  {}\n", line);
  if (wrong.from_picture) return text;  // it has no steps that a window could show
  return text + fmt::format("  {} --scene {} --view\n", command, shell_word(wrong.task->name));
}

/// Where only hidden scenes are wrong: the mistake, without a number of theirs.
std::string hidden_wrong_text(const Assessment& all) {
  std::string text;
  for (const Graded& task : all.tasks) {
    if (!task.first || !text.empty()) continue;
    for (const std::string& line : mistake_lines(*task.first)) text += fmt::format("  {}\n", line);
  }
  return text.empty() ? "" : "\nA scene that is hidden shows what is wrong:\n" + text;
}

}  // namespace

std::string report_text(const Assessment& all, const std::string& command) {
  const Homework& homework = *all.homework;
  std::string text = fmt::format("{}: {}\n", printable(homework.title), printable(all.submission));
  text += all.gradable()
              ? fmt::format("{} of {} points\n\n", points_text(all.points(), all.most()), points_text(all.most()))
              : "Nothing here could be graded, so there are no points yet.\n\n";
  if (const std::string first = said_first_text(all); !first.empty() && all.gradable())
    text += printable_lines(first) + "\n\n";
  if (homework.left_out > 0) text += "The hidden scenes are not here; their points are not counted.\n\n";
  if (all_right(all)) text += "Every step is right.\n";
  else if (all.gradable()) text += what_works_text(all);
  if (const Graded* wrong = first_to_mend(all)) text += first_wrong_text(*wrong, command);
  else text += hidden_wrong_text(all);
  if (const std::string next = next_part_text(all); !next.empty()) text += "\n" + printable(next) + "\n";
  if (all.gradable()) text += "\nHow the points come about\n";
  for (const Graded& task : all.tasks) text += task_text(all, task);
  return text;
}

// The formats in which courses read results. Of a hidden scene they hold the points, and no numbers of its run.

namespace {

using Json = nlohmann::ordered_json;

std::string dumped(const Json& json) {
  return printable_json(json.dump(2, ' ', false, Json::error_handler_t::replace)) + "\n";
}

std::vector<std::string> lines_of(const std::vector<FieldText>& fields) {
  std::vector<std::string> lines;
  for (const FieldText& field : fields) lines.push_back(field.line());
  return lines;
}

std::string first_text(const FirstWrong& first) {
  std::string text = first.where + (first.where.empty() ? "" : ": ") + first.step;
  if (!first.subject.empty()) text += ", " + first.subject;
  text += "\n" + first.what + "\n";
  for (const FieldText& field : first.expected) text += "expected  " + field.line() + "\n";
  for (const FieldText& field : first.found) text += "yours     " + field.line() + "\n";
  for (const std::string& line : mistake_lines(first)) text += line + "\n";
  return text;
}

/// What is said of a part on a task, in one line.
std::string message(const Assessment& all, const Graded& task, std::size_t part) {
  if (task.state != Graded::State::judged) return task.shown();
  const grade::PartCount& count = task.counts[part];
  const grade::Part& of = all.homework->parts[part];
  if (task.from_picture && of.level != grade::Level::buffers && count.all() > 0) return "there are no steps";
  const std::string steps = of.level == grade::Level::buffers ? "pixels" : "steps";
  std::string text = fmt::format("{} of {} {} are right", count.same, count.all(), steps);
  if (count.in_halves())
    text = fmt::format("right colours {}, right depths {}, of {} {} each", count.halves->colors, count.halves->depths,
                       count.all(), steps);
  if (of.computation > 0) text += fmt::format(", {} follow from their own operands", count.computed);
  if (const std::string lost = losses_text(*all.homework, count, false); !lost.empty()) text += ". " + lost;
  return text;
}

/// The same of a scene that students do not have: nothing is counted.
std::string hidden_message(const Assessment& all, const Graded& task, std::size_t part) {
  const std::string shown = task.shown();
  const std::string lost = part < task.counts.size() ? losses_text(*all.homework, task.counts[part], true) : "";
  return shown + (shown.empty() || lost.empty() ? "" : "\n") + lost;
}

/// Calls visit(name, task, part) for each part of each task.
template <class Visit>
void for_each_test(const Assessment& all, Visit&& visit) {
  for (const Graded& task : all.tasks)
    for (std::size_t part = 0; part < all.homework->parts.size(); ++part)
      visit(fmt::format("{}: {}", task.task->name, all.homework->parts[part].name), task, part);
}

/// What there is to know of a run that was judged: how its program ended, where it breaks off. Ends its line.
std::string shown_line(const Graded& task) {
  const std::string shown = task.shown();
  return shown.empty() ? "" : shown + "\n";
}

/// The first thing that is wrong and may be shown, or why nothing could be graded.
std::string overview(const Assessment& all) {
  std::string begin = said_first_text(all);
  if (!begin.empty()) begin += "\n";
  if (all.homework->left_out > 0) begin += "The hidden scenes are not here; their points are not counted.\n";
  if (const Graded* task = first_to_mend(all))
    return begin + fmt::format("The first thing to look at, in {}:\n{}{}", task->task->name, first_text(*task->first),
                               task == said_first(all) ? "" : shown_line(*task));
  if (const std::string next = next_part_text(all); !next.empty()) return begin + next;
  for (const Graded& task : all.tasks)
    if (const std::string why = task.shown(); !why.empty() && &task != said_first(all))
      return begin + fmt::format("{}: {}", task.task->name, why);
  const bool shown_right = std::all_of(all.tasks.begin(), all.tasks.end(), [](const Graded& task) {
    return is_right(task) || (task.task->hidden && task.state == Graded::State::judged);
  });
  return begin + (shown_right ? "Every step that is shown is right." : "");
}

}  // namespace

std::string report_json(const Assessment& all) {
  Json tasks = Json::array();
  for (const Graded& task : all.tasks) {
    Json one{{"scene", task.task->name},
             {"hidden", task.task->hidden},
             {"state", word_of_state(task.state)},
             {"file", task.file},
             {"steps", task.steps}};
    if (!task.why.empty()) one["why"] = task.why;
    if (!task.ended.empty()) one["ended"] = task.ended;
    if (!task.note.empty()) one["note"] = task.note;
    if (task.passed_over.any())
      one["unreadable"] = {{"lines", task.passed_over.lines.size()},
                           {"faults", task.passed_over.faults},
                           {"rest_not_read", task.passed_over.gave_up}};
    if (task.breaks_off) one["breaks_off"] = true;
    if (task.from_picture) one["from_picture"] = true;
    if (!task.left_out.empty()) one["left_out"] = task.left_out;
    Json parts = Json::array();
    for (std::size_t part = 0; part < task.counts.size(); ++part) {
      const grade::PartCount& count = task.counts[part];
      parts.push_back({{"name", all.homework->parts[part].name},
                       {"expected", count.expected},
                       {"additional", count.additional},
                       {"computed", count.computed},
                       {"right", count.same},
                       {"points", all.points(task, part)},
                       {"of", all.most(task, part)}});
      if (count.halves)
        parts.back()["right_colors"] = count.halves->colors, parts.back()["right_depths"] = count.halves->depths;
      Json lost = Json::array();
      for (const grade::Loss& loss : count.lost)
        lost.push_back({{"why", word_of(loss.why)},
                        {"steps", steps_of(*all.homework, loss)},
                        {"count", loss.count},
                        {"text", loss_text(*all.homework, loss, false)}});
      parts.back()["lost"] = lost;
    }
    one["parts"] = parts;
    if (task.first)
      one["first"] = {{"at", task.first->at},
                      {"step", task.first->step},
                      {"subject", task.first->subject},
                      {"where", task.first->where},
                      {"what", task.first->what},
                      {"expected", lines_of(task.first->expected)},
                      {"found", lines_of(task.first->found)}};
    if (task.first && task.first->mistake) {
      const auto said_of = [](mistakes::Mistake mistake) {
        const mistakes::MistakeText& text = mistakes::text_of(mistake);
        return Json{{"id", text.id},
                    {"name", text.name},
                    {"question", text.question},
                    {"lesson", text.lesson},
                    {"stop", text.stop}};
      };
      one["mistake"] = said_of(task.first->mistake->mistake);
      if (const auto& also = task.first->mistake->also) one["mistake"]["also"] = said_of(*also);
    }
    tasks.push_back(one);
  }
  return dumped({{"homework", all.homework->title},
                 {"submission", all.submission},
                 {"gradable", all.gradable()},
                 {"hidden_left_out", all.homework->left_out},
                 {"points", all.points()},
                 {"of", all.most()},
                 {"scenes", tasks}});
}

std::string report_gradescope(const Assessment& all, double seconds) {
  Json tests = Json::array();
  for_each_test(all, [&](const std::string& name, const Graded& task, std::size_t part) {
    const double points = all.points(task, part), most = all.most(task, part);
    tests.push_back({{"name", name},
                     {"score", points},
                     {"max_score", most},
                     {"status", part < task.counts.size() && task.counts[part].lost.empty() ? "passed" : "failed"},
                     {"output", task.task->hidden ? hidden_message(all, task, part) : message(all, task, part)},
                     {"output_format", "text"},
                     {"visibility", "visible"}});
  });
  return dumped({{"score", all.points()},
                 {"execution_time", seconds},
                 {"output", overview(all)},
                 {"output_format", "text"},
                 {"visibility", "visible"},
                 {"stdout_visibility", "hidden"},
                 {"tests", tests},
                 {"extra_data", {{"gradable", all.gradable()}}}});
}

std::string report_prairielearn(const Assessment& all) {
  // It takes no results of 1 MB, in which quotes take two bytes. All texts share this room:
  const auto shared = [](std::string text, std::size_t count) {
    const std::size_t most = 200'000 / std::max<std::size_t>(1, count);
    return text.size() <= most ? text : text.substr(0, most) + " …";
  };
  if (!all.gradable()) {
    Json errors = Json::array();
    for (const Graded& task : all.tasks)
      errors.push_back(shared(fmt::format("{}: {}", task.task->name, task.shown()), all.tasks.size()));
    return dumped({{"gradable", false}, {"format_errors", errors}, {"message", "Nothing could be graded."}});
  }
  const std::size_t count = all.tasks.size() * all.homework->parts.size();
  Json tests = Json::array();
  for_each_test(all, [&](const std::string& name, const Graded& task, std::size_t part) {
    tests.push_back(
        {{"name", name},
         {"points", all.points(task, part)},
         {"max_points", all.most(task, part)},
         {"message", shared(task.task->hidden ? hidden_message(all, task, part) : message(all, task, part), count)}});
  });
  Json result{
      {"gradable", true},
      {"score", all.points() / all.most()},
      {"message", fmt::format("{} of {} points", points_text(all.points(), all.most()), points_text(all.most()))},
      {"output", overview(all)}};
  if (count <= 2000) result["tests"] = tests;
  else result["output"] = fmt::format("There are too many parts to list their points.\n{}", overview(all));
  return dumped(result);
}

std::string report_junit(const Assessment& all) {
  std::string cases;
  int failures = 0, errors = 0, count = 0;
  for_each_test(all, [&](const std::string&, const Graded& task, std::size_t part) {
    ++count;
    const bool unread = task.state != Graded::State::judged;
    const bool right = part < task.counts.size() && task.counts[part].lost.empty();
    cases += fmt::format("  <testcase classname=\"{}\" name=\"{}\"", markup(task.task->name),
                         markup(all.homework->parts[part].name));
    if (right && !unread) {
      cases += "/>\n";
      return;
    }
    (unread ? errors : failures)++;
    std::string more = unread ? "" : shown_line(task);
    if (!task.task->hidden && task.first) more += first_text(*task.first);
    cases += fmt::format("><{0} message=\"{1}\">{2}</{0}></testcase>\n", unread ? "error" : "failure",
                         markup(printable(message(all, task, part))), markup(printable_lines(more)));
  });
  return fmt::format(
      "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
      "<testsuite name=\"{}\" tests=\"{}\" failures=\"{}\" errors=\"{}\">\n{}</testsuite>\n",
      markup(printable(all.homework->title)), count, failures, errors, cases);
}

}  // namespace zstep::homework
