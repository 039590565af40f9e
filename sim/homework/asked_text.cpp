#include "sim/homework/asked_text.hpp"

#include <algorithm>
#include <cctype>
#include <optional>
#include <regex>
#include <set>
#include <vector>

#include <fmt/format.h>

#include "traces/error.hpp"
#include "traces/near_word.hpp"

namespace zstep::homework {

namespace {

/// Calls visit(line with its end, number from 1) for each line.
template <class Visit>
void each_line(std::string_view text, Visit&& visit) {
  int number = 0;
  for (std::size_t begin = 0; begin < text.size();) {
    const std::size_t end = std::min(text.find('\n', begin), text.size() - 1) + 1;
    visit(std::string(text.substr(begin, end - begin)), ++number);
    begin = end;
  }
}

/// What a block is for: the words of the line that begins it.
std::optional<std::vector<std::string>> block_words(const std::string& line) {
  static const std::regex begin(R"(\s*<!--\s*for\s+([a-z0-9_]+(?:[,\s]+[a-z0-9_]+)*)\s*-->\s*)"), word("[a-z0-9_]+");
  std::smatch found;
  if (!std::regex_match(line, found, begin)) return std::nullopt;
  const std::string list = found[1];
  std::vector<std::string> words;
  for (std::sregex_iterator at(list.begin(), list.end(), word), none; at != none; ++at) words.push_back(at->str());
  return words;
}
bool ends_block(const std::string& line) {
  static const std::regex end(R"(\s*<!--\s*end\s*-->\s*)");
  return std::regex_match(line, end);
}

/// "insert_edge" of "insertEdge", as Java calls it.
std::string step_of_call(const std::string& call) {
  std::string step;
  for (const char c : call)
    if (std::isupper(static_cast<unsigned char>(c)))
      step += {'_', static_cast<char>(std::tolower(static_cast<unsigned char>(c)))};
    else step += c;
  return step;
}

}  // namespace

std::string handout_asked(const Homework& homework, std::string_view text, const std::string& file) {
  constexpr std::string_view buffers = "buffers";
  std::set<std::string> asked;
  std::vector<std::string_view> known{buffers};
  for (const StepInfo& step : homework.page) known.push_back(step.name);
  for (const StepInfo& step : homework.steps) asked.insert(step.name);
  for (const grade::Part& part : homework.parts)
    if (part.level == grade::Level::buffers) asked.emplace(buffers);

  std::string kept;
  int begun = 0;  // the line of the block at work, 0 outside of one
  bool wanted = true;
  const auto at = [&](int line) { return fmt::format("{}:{}", file, line); };
  each_line(text, [&](const std::string& line, int number) {
    if (const auto words = block_words(line)) {
      if (begun > 0) throw InputError(at(number), "begins a block in a block", "end the other one: <!-- end -->");
      for (const std::string& word : *words)
        if (std::find(known.begin(), known.end(), word) == known.end())
          throw InputError(at(number), fmt::format("begins a block for '{}', which is no step", word),
                           near_word_or_list(word, known, "the steps are"));
      begun = number;
      wanted = std::any_of(words->begin(), words->end(), [&](const std::string& one) { return asked.contains(one); });
      if (wanted) kept += line;
    } else if (ends_block(line)) {
      if (begun == 0) throw InputError(at(number), "ends a block that was not begun", "take the line out");
      if (wanted) kept += line;
      begun = 0, wanted = true;
    } else if (wanted) {
      kept += line;
    }
  });
  if (begun > 0) throw InputError(at(begun), "begins a block that has no end", "end it: <!-- end -->");
  return kept;
}

std::string without_block_lines(std::string_view text) {
  std::string kept;
  each_line(text, [&](const std::string& line, int) {
    if (!block_words(line) && !ends_block(line)) kept += line;
  });
  return kept;
}

std::string starter_asked(const Homework& homework, std::string_view text) {
  static const std::regex comment(R"(\s*(#|//))"), call(R"(\b(?:emit[._]|Emit\.)(\w+)\()");
  std::string kept;
  each_line(text, [&](const std::string& line, int) {
    bool calls = false, asked = false;
    if (std::regex_search(line, comment, std::regex_constants::match_continuous))
      for (std::sregex_iterator at(line.begin(), line.end(), call), none; at != none; ++at) {
        const std::string step = step_of_call((*at)[1]);
        const auto is_it = [&](const StepInfo& one) { return one.name == step; };
        if (std::none_of(homework.page.begin(), homework.page.end(), is_it)) continue;
        calls = true;
        asked = asked || std::any_of(homework.steps.begin(), homework.steps.end(), is_it);
      }
    if (!calls || asked) kept += line;
  });
  return kept;
}

}  // namespace zstep::homework
