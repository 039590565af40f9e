#include "sim/homework/handout_words.hpp"

#include <regex>
#include <set>
#include <sstream>

namespace zstep::homework {

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

}  // namespace zstep::homework
