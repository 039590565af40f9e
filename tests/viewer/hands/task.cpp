#include "tests/viewer/hands/task.hpp"

#include <fstream>
#include <sstream>
#include <stdexcept>

namespace zstep::test {
namespace {

std::string trimmed(const std::string& text) {
  const std::size_t first = text.find_first_not_of(' ');
  return first == std::string::npos ? "" : text.substr(first, text.find_last_not_of(' ') - first + 1);
}

std::vector<std::string> steps_in(const std::string& text) {
  std::vector<std::string> steps;
  std::istringstream in(text);
  for (std::string step; std::getline(in, step, ';');) steps.push_back(trimmed(step));
  return steps;
}

}  // namespace

std::vector<HandTask> read_hand_tasks(const std::string& path) {
  std::ifstream in(path);
  if (!in) throw std::runtime_error(path + " cannot be read");
  std::vector<HandTask> tasks;
  int number = 0;
  for (std::string line; std::getline(in, line);) {
    ++number;
    if (trimmed(line).empty() || line[0] == '#') continue;
    const std::size_t colon = line.find(": ");
    const std::string word = line.substr(0, colon),
                      rest = colon == std::string::npos ? "" : trimmed(line.substr(colon + 1));
    const auto wrong = [&](const std::string& what) {
      return std::runtime_error(path + ":" + std::to_string(number) + ": " + what);
    };
    if (rest.empty()) throw wrong("a line is a word, a colon and what belongs to it");
    if (word == "task") tasks.push_back({rest, {}, {}, {}, {}, {}, {}, false, number});
    else if (tasks.empty()) throw wrong("a task begins with its name");
    else if (word == "from") tasks.back().from = rest;
    else if (word == "keys") tasks.back().keys = steps_in(rest);
    else if (word == "mouse") tasks.back().mouse = steps_in(rest);
    else if (word == "then") tasks.back().then = steps_in(rest);
    else if (word == "not by keys") tasks.back().no_keys = rest;
    else if (word == "not by mouse") tasks.back().no_mouse = rest;
    else if (word == "real") tasks.back().real = true;
    else if (word == "not real") tasks.back().not_real = rest;
    else throw wrong("\"" + word + "\" is none of task, from, keys, mouse, then, not by keys, not by mouse, real");
  }
  for (const HandTask& task : tasks)
    if (task.from.empty() || task.then.empty() || task.keys.empty() == task.no_keys.empty() ||
        task.mouse.empty() == task.no_mouse.empty())
      throw std::runtime_error(path + ":" + std::to_string(task.line) + ": " + task.name +
                               " lacks from, then, or either steps or a reason for keys and for the mouse");
  return tasks;
}

HandStart hand_start(const std::string& from) {
  std::istringstream in(from);
  HandStart start;
  std::string word;
  in >> word >> start.name;
  start.lesson = word == "lesson";
  if (!start.lesson && word != "view") throw std::runtime_error(from + " is neither a lesson nor a view");
  while (in >> word)
    if (word == "--presenter") start.presenter = true;
    else if (word == "--algorithm") in >> start.method;
    else if (word == "--at") in >> start.at;
    else throw std::runtime_error(from + ": " + word + " is not known here");
  return start;
}

}  // namespace zstep::test
