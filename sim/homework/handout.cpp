#include "sim/homework/handout.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <optional>
#include <regex>
#include <set>
#include <sstream>
#include <vector>

#include "algorithms/catalog/catalog.hpp"
#include "sim/classroom/markdown.hpp"
#include "sim/homework/assess.hpp"
#include "sim/pages/page.hpp"
#include "sim/pages/pictures.hpp"
#include "traces/error.hpp"
#include "traces/replay/replay.hpp"
#include "traces/text.hpp"

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
    if (is_capital(c)) step += {'_', lower_case(c)};
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

namespace {

namespace fs = std::filesystem;

/// "scenes/triangle.txt", "scenes/*.txt", "emit.py", "starter/"; not "SCENE.txt", which stands for others.
bool is_name(const std::string& word) {
  static const std::regex name(R"([\w.*-]+(/[\w.*-]+)*\.(py|js|cpp|c|h|java|toml|txt|md)|([\w.-]+/)+)");
  static const std::regex stands_for(R"(.*\b[A-Z]{2,}\b.*)");
  return std::regex_match(word, name) && !std::regex_match(word, stands_for);
}

bool is_there(const fs::path& folder, const std::string& name) {
  std::error_code ignored;
  if (name.find('*') == std::string::npos) return fs::exists(folder / name, ignored);
  std::string pattern;
  for (const char c : fs::path(name).filename().string())
    pattern += c == '*' ? "[^/]*" : std::string(c == '.' ? "\\" : "") + c;
  const std::regex any(pattern);
  for (const auto& entry : fs::directory_iterator((folder / name).parent_path(), ignored))
    if (std::regex_match(entry.path().filename().string(), any)) return true;
  return false;
}

}  // namespace

std::vector<std::pair<int, std::string>> missing_in_handout(const std::string& page, const fs::path& folder) {
  std::vector<std::pair<int, std::string>> missing;
  std::set<std::string> seen;
  const auto look_at = [&](int line, const std::string& text) {
    std::istringstream words(text);
    for (std::string word; words >> word;) {
      if (word == ">" || word == "-o") {
        words >> word;  // it is made by the command
        continue;
      }
      if (!is_name(word) || !seen.insert(word).second) continue;
      if (!is_there(folder, word) && !is_there(folder / "starter", word)) missing.emplace_back(line, word);
    }
  };
  std::istringstream in(page);
  bool commands = false, block = false;
  int number = 0;
  for (std::string line; std::getline(in, line);) {
    ++number;
    if (line.starts_with("```")) {
      block = !block;
      commands = block && (line == "```" || line == "```sh" || line == "```bash" || line == "```console");
    } else if (block) {
      if (commands) look_at(number, line);
    } else {
      static const std::regex span("`([^`]+)`");
      for (std::sregex_iterator at(line.begin(), line.end(), span), end; at != end; ++at) look_at(number, (*at)[1]);
    }
  }
  return missing;
}

namespace {

std::string runs_html(const std::vector<TextRun>& runs) {
  std::string html;
  for (const TextRun& run : runs) {
    std::string text = shown(run.text);
    for (std::size_t at = text.find('\n'); at != std::string::npos; at = text.find('\n', at + 4))
      text.replace(at, 1, "<br>");
    const auto put_in = [&](bool wanted, const char* element) {
      if (wanted) text = fmt::format("<{0}>{1}</{0}>", element, text);
    };
    put_in(run.code, "code");
    put_in(run.italic, "em");
    put_in(run.bold, "strong");
    html += text;
  }
  return html;
}

/// Lists come flat, with their depths; in a page they lie in each other.
class Lists {
 public:
  /// Closes those that are deeper.
  std::string down_to(std::size_t depth) {
    std::string html;
    while (open_.size() > depth) {
      html += fmt::format("</li></{}>\n", open_.back());
      open_.pop_back();
    }
    return html;
  }
  std::string item(const TextBlock& block) {
    const char* element = block.number != 0 ? "ol" : "ul";
    const std::size_t depth = std::max(1, block.depth);
    std::string html = down_to(depth);
    if (open_.size() == depth && std::string_view(open_.back()) != element) html += down_to(depth - 1);
    if (open_.size() == depth) html += "</li>\n";
    for (; open_.size() < depth; open_.push_back(element))
      html += block.number > 1 ? fmt::format("<ol start=\"{}\">\n", block.number) : fmt::format("<{}>\n", element);
    return html + "<li>";
  }

 private:
  std::vector<const char*> open_;
};

std::string markdown_html(std::string_view markdown) {
  using Kind = TextBlock::Kind;
  std::string html;
  Lists lists;
  for (const TextBlock& block : parse_markdown(markdown)) {
    if (block.kind == Kind::item) {
      html += lists.item(block) + runs_html(block.runs);
      continue;
    }
    html += lists.down_to(static_cast<std::size_t>(block.depth));
    switch (block.kind) {
      case Kind::heading:
        html += fmt::format("<h{0}>{1}</h{0}>\n", block.level, runs_html(block.runs));
        break;
      case Kind::code:
        html += fmt::format("<pre>{}</pre>\n", shown(block.runs.empty() ? "" : block.runs.front().text));
        break;
      case Kind::quote:
        html += fmt::format("<blockquote><p>{}</p></blockquote>\n", runs_html(block.runs));
        break;
      case Kind::rule:
        html += "<hr>\n";
        break;
      default:
        html += fmt::format("<p>{}</p>\n", runs_html(block.runs));
        break;
    }
  }
  return html + lists.down_to(0);
}

std::string size_of(const Task& task, const Picture& picture, bool curves) {
  const auto count = [](auto number, const char* one) {
    return fmt::format("{} {}{}", number, one, number == 1 ? "" : "s");
  };
  return fmt::format("{} × {} pixels, ", picture.width, picture.height) +
         (curves ? count(task.scene.surface->rows, "curve") + " of " + count(task.scene.surface->columns, "sample")
                 : count(task.scene.polygons.size(), "polygon"));
}

std::string scene_html(const Method& method, const Task& task, const Trace& reference) {
  Replay replay(reference);
  replay.go_to(reference.size());
  const Picture& picture = replay.state().picture;
  DepthRange range;
  range.include(picture);
  const bool curves = method.needs == Needs::surface;
  const std::string picture_alone =
      fmt::format("<h3>{}</h3>\n<p>{}.</p>\n", shown(task.name), size_of(task, picture, curves)) +
      figure(image_of(picture, task.scene, 1), "The picture", picture_in_words(picture, task.scene) + ".");
  if (method.gives == Gives::lines) return picture_alone;
  return picture_alone + figure(depths_of(picture, task.scene.raster.y_up, range),
                                "The depths: the smaller z, the darker; a stroke where nothing is drawn",
                                depths_in_words(picture) + ".");
}

}  // namespace

std::string handout_html(const Homework& homework, std::string_view markdown) {
  std::string html = page_begin(homework.title) + markdown_html(without_block_lines(markdown));
  const References references(homework);
  std::string scenes;
  for (const Task& task : homework.tasks)
    if (const auto reference = references.find(task, task.conventions); reference && !task.hidden)
      scenes += scene_html(*homework.method, task, *reference);
  if (!scenes.empty()) html += "<h2>What a right program draws</h2>\n" + scenes;
  return html.append(page_end);
}

}  // namespace zstep::homework
