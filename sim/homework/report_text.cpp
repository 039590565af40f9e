// The report that a student reads: one page, by which the points can be worked out by hand.
#include <fmt/format.h>

#include "sim/homework/report_words.hpp"
#include "sim/homework/reports.hpp"
#include "sim/words/shell_word.hpp"
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

}  // namespace zstep::homework
