#include "sim/classroom/lesson_blocks.hpp"

#include <algorithm>
#include <optional>

#include <fmt/core.h>

#include "algorithms/catalog/changes.hpp"
#include "sim/classroom/expression.hpp"
#include "traces/error.hpp"
#include "traces/math/portable_math.hpp"

namespace zstep::classroom {

void Lines::fail(std::string_view what, std::string_view mend) const { throw InputError(where(at), what, mend); }

bool starts_with(std::string_view text, std::string_view start) { return text.substr(0, start.size()) == start; }

void append_line(std::string& text, std::string_view line) {
  text += line;
  text += '\n';
}

std::string strip_lines(const std::string& text, std::int32_t& line) {
  std::size_t first = 0;
  while (first < text.size() && (text[first] == '\n' || text[first] == ' ')) line += text[first++] == '\n';
  const std::size_t last = text.find_last_not_of(" \n");
  return last == std::string::npos ? std::string() : text.substr(first, last + 1 - first);
}

namespace {

constexpr double most_minutes = 90;  // of one stop

/// What stands after "done:" on the line, if the line begins so.
std::optional<std::string> after_key(const Lines& lines, std::string_view key) {
  const std::string_view text = lines.text();
  if (!starts_with(text, key)) return std::nullopt;
  const std::string rest(trim(text.substr(key.size())));
  if (rest.empty()) lines.fail(fmt::format("nothing stands after `{}`", key), "write it on the same line");
  return rest;
}

/// A hint, as many line ends after the block's first line as in the file: so a complaint about it counts its lines
/// from there. They go when it is filled.
std::string on_its_line(const Lines& lines, std::int32_t block, const std::string& hint) {
  return std::string(lines.number() - block, '\n') + hint;
}

/// Calls `read` at each line up to the one that closes the block.
template <class Read>
void each_line(Lines& lines, std::string_view name, Read&& read) {
  const std::size_t opened = lines.at;
  while (true) {
    if (++lines.at == lines.all.size() || starts_with(lines.text(), "## "))
      throw InputError(lines.where(opened), fmt::format("the {} is not closed", name),
                       "add a line `:::` after its last line");
    if (trim(lines.text()) == ":::") return;
    read();
  }
}

// --- A task: what is to be tried; then `done:`, `now:`, `hint:` and `solution:`, each on a line of its own.

void read_task_line(const Lines& lines, Task& task) {
  if (const auto done = after_key(lines, "done:")) {
    if (!task.done.empty()) lines.fail("a second `done:`", "join the two with `and`");
    task.done = *done, task.done_line = lines.number();
  } else if (const auto now = after_key(lines, "now:")) {
    task.now = *now, task.now_line = lines.number();
  } else if (const auto hint = after_key(lines, "hint:")) {
    task.hints.push_back(on_its_line(lines, task.line, *hint));
  } else if (auto solution = after_key(lines, "solution:")) {
    read_change(*solution, lines.where(lines.at) + ":");
    task.solution.push_back(*std::move(solution));
  } else if (task.done.empty()) {
    append_line(task.text, lines.text());
  } else if (!trim(lines.text()).empty()) {
    lines.fail("a line that does not belong to the task", "begin it with `now:`, `hint:` or `solution:`");
  }
}

Task read_task(Lines& lines) {
  Task task;
  const std::string where = lines.where(lines.at);
  task.line = lines.number(), task.text_line = task.line + 1;
  each_line(lines, "task", [&] { read_task_line(lines, task); });
  task.text = strip_lines(task.text, task.text_line);
  if (task.text.empty()) throw InputError(where, "the task asks for nothing", "write it under `::: task`");
  if (task.done.empty())
    throw InputError(where, "the task is never done", "add a line as `done: frame(3, 2) == \"A\"`");
  if (task.solution.empty())
    throw InputError(where, "the task has no solution", "add a line as `solution: theta = 60`");
  return task;
}

// --- A marking: what is to be marked; then which steps say what is right, `hint:` and `why:`.

/// "first_row(edge) of insert_edge where edge == 2".
void read_steps(const Lines& lines, Marking& marking, Marking::Kind kind, const std::string& text) {
  if (!marking.steps.empty()) lines.fail("a second line that says what is right", "join the two with `or`");
  marking.kind = kind, marking.steps = text, marking.steps_line = lines.number();
  if (kind == Marking::Kind::pixels) return;
  const std::size_t of = text.find(" of ");
  if (of == std::string::npos)
    lines.fail(fmt::format("`{}` does not say what is taken of a step", text),
               kind == Marking::Kind::order ? "write `order: polygon of draw`"
                                            : "write `scan line: first_row(edge) of insert_edge`");
  marking.value = trim(std::string_view(text).substr(0, of));
  marking.steps = trim(std::string_view(text).substr(of + 4));
}

void read_marking_line(const Lines& lines, Marking& marking) {
  if (const auto pixels = after_key(lines, "pixels:")) {
    read_steps(lines, marking, Marking::Kind::pixels, *pixels);
  } else if (const auto scan_line = after_key(lines, "scan line:")) {
    read_steps(lines, marking, Marking::Kind::scan_line, *scan_line);
  } else if (const auto order = after_key(lines, "order:")) {
    read_steps(lines, marking, Marking::Kind::order, *order);
  } else if (const auto hint = after_key(lines, "hint:")) {
    marking.hints.push_back(on_its_line(lines, marking.line, *hint));
  } else if (const auto why = after_key(lines, "why:")) {
    if (!marking.why.empty()) lines.fail("a second `why:`", "say it in one line");
    marking.why = *why, marking.why_line = lines.number();
  } else if (marking.steps.empty()) {
    append_line(marking.text, lines.text());
  } else if (!trim(lines.text()).empty()) {
    lines.fail("a line that does not belong to what is marked", "begin it with `hint:` or `why:`");
  }
}

Marking read_marking(Lines& lines) {
  Marking marking;
  const std::string where = lines.where(lines.at);
  marking.line = lines.number(), marking.text_line = marking.line + 1;
  each_line(lines, "mark", [&] { read_marking_line(lines, marking); });
  marking.text = strip_lines(marking.text, marking.text_line);
  if (marking.text.empty()) throw InputError(where, "nothing is asked to be marked", "write it under `::: mark`");
  if (marking.steps.empty())
    throw InputError(where, "nothing says which marks are right",
                     "add a line as `pixels: compare where polygon == \"A\"`, `scan line: first_row(edge) of "
                     "insert_edge` or `order: polygon of draw`");
  if (marking.why.empty())
    throw InputError(where, "nothing says why the marks are right", "add a line `why:` with the reason");
  return marking;
}

// --- A question: what is asked; then answers, `- [x]` the right one, each with its reply below it.

void read_question_line(const Lines& lines, Question& question) {
  const std::string_view text = lines.text(), bare = trim(text);
  const bool marked = starts_with(text, "- [x] ") || starts_with(text, "- [X] ");
  if (marked || starts_with(text, "- [ ] ")) {
    Answer answer;
    answer.right = marked;
    answer.text = trim(text.substr(6));
    answer.line = lines.number();
    question.answers.push_back(std::move(answer));
  } else if (starts_with(text, "- ")) {
    lines.fail("an answer without its box", "write `- [ ] wrong answer` or `- [x] right answer`");
  } else if (question.answers.empty()) {
    append_line(question.text, text);
  } else if (starts_with(bare, ">")) {
    Answer& answer = question.answers.back();
    if (answer.reply.empty()) answer.reply_line = lines.number();
    append_line(answer.reply, trim(bare.substr(1)));
  } else if (!bare.empty()) {
    Answer& answer = question.answers.back();
    if (!answer.reply.empty())
      lines.fail("a line that is neither answer nor reply", "begin a reply's lines with `  > `");
    answer.text += '\n';
    answer.text += bare;
  }
}

Question read_question(Lines& lines) {
  Question question;
  const std::string where = lines.where(lines.at);
  question.line = lines.number() + 1;
  each_line(lines, "question", [&] { read_question_line(lines, question); });
  question.text = strip_lines(question.text, question.line);
  if (question.text.empty()) throw InputError(where, "the question asks nothing", "write it under `::: question`");
  if (question.answers.size() < 2)
    throw InputError(where, "the question has fewer than two answers", "write `- [ ] wrong` and `- [x] right`");
  const auto right = std::count_if(question.answers.begin(), question.answers.end(),
                                   [](const Answer& answer) { return answer.right; });
  if (right != 1)
    throw InputError(where, fmt::format("the question has {} right answers", right), "mark exactly one with [x]");
  for (Answer& answer : question.answers) {
    const std::string line = fmt::format("{}:{}", lines.file, answer.line);
    if (answer.text.empty()) throw InputError(line, "the answer is empty", "write it after its box");
    if (trim(answer.reply).empty())
      throw InputError(line, "the answer has no reply", "say under it, after `  > `, why it is so or is not");
    answer.reply = strip_lines(answer.reply, answer.reply_line);
  }
  return question;
}

// --- Notes: what the speaker reads; `minutes:` on a line of its own.

double read_minutes(const Lines& lines, const std::string& text) {
  double minutes = 0;
  if (read_number(text, minutes) != text.size() || !(minutes > 0 && minutes <= most_minutes))
    lines.fail(fmt::format("`{}` is not a number of minutes", text), "write for example `minutes: 1.5`");
  return minutes;
}

SpeakerNotes read_notes(Lines& lines) {
  SpeakerNotes notes;
  const std::string where = lines.where(lines.at);
  notes.line = lines.number(), notes.text_line = notes.line + 1;
  each_line(lines, "notes block", [&] {
    const auto minutes = after_key(lines, "minutes:");
    if (minutes && notes.minutes > 0) lines.fail("a second `minutes:`", "add the two up");
    if (minutes) notes.minutes = read_minutes(lines, *minutes);
    append_line(notes.text, minutes ? "" : lines.text());  // the lines of what follows stay where they are
  });
  notes.text = strip_lines(notes.text, notes.text_line);
  if (notes.text.empty()) throw InputError(where, "the notes say nothing", "write them under `::: notes`");
  return notes;
}

}  // namespace

void read_block(Lines& lines, Stop& stop) {
  const std::string_view name = trim(lines.text().substr(3));
  if (name.empty()) lines.fail("`:::` closes nothing", "remove it, or open a question with `::: question`");
  if (name != "question" && name != "task" && name != "mark" && name != "notes")
    lines.fail(fmt::format("a block of the unknown kind `{}`", name),
               "write `::: question`, `::: task`, `::: mark` or `::: notes`");
  if (name == "notes") {
    if (stop.notes) lines.fail("second notes at one stop", "join the two");
    stop.notes = read_notes(lines);
    return;
  }
  const std::string_view there = stop.question ? "question" : stop.task ? "task" : stop.marking ? "mark" : "";
  if (there == name)
    lines.fail(fmt::format("a second {} at one stop", name),
               "give it a stop of its own; {at: here} stays at the same place");
  if (!there.empty())
    lines.fail(fmt::format("a {} and a {} at one stop", there, name), "give one of them a stop of its own");
  if (name == "question") stop.question = read_question(lines);
  else if (name == "task") stop.task = read_task(lines);
  else stop.marking = read_marking(lines);
}

}  // namespace zstep::classroom
