// What one method alone records is known by name in few places: its folder, its theme of events with their formulas and
// replay, its pane, and a handful of files besides.
#include <doctest/doctest.h>

#include <cctype>
#include <filesystem>
#include <fstream>
#include <map>
#include <set>
#include <string>
#include <utility>

#include <fmt/format.h>

#include "tests/where.hpp"
#include "traces/events/vocabulary.hpp"

namespace fs = std::filesystem;

namespace {

using Words = std::set<std::string>;

/// The words of a file's code, without its comments and its texts.
Words words_of(const fs::path& path) {
  std::ifstream in(path);
  Words words;
  for (std::string line; std::getline(in, line);) {
    std::string word;
    bool quoted = false;
    for (std::size_t i = 0; i <= line.size(); ++i) {
      const char c = i < line.size() ? line[i] : '\n';
      if (quoted && c == '\\') ++i;
      else if (c == '"') quoted = !quoted;
      else if (!quoted && c == '/' && i + 1 < line.size() && line[i + 1] == '/') break;
      else if (!quoted && (std::isalnum(static_cast<unsigned char>(c)) || c == '_')) {
        word += c;
        continue;
      }
      if (!word.empty()) words.insert(word);
      word.clear();
    }
    if (!word.empty()) words.insert(word);
  }
  return words;
}

/// By path from the root, all code of the program.
const std::map<std::string, Words>& code() {
  static const std::map<std::string, Words> all = [] {
    std::map<std::string, Words> files;
    const fs::path root = zstep::test::in_checkout("");
    for (const char* folder : {"traces", "algorithms", "sim"})
      for (const fs::directory_entry& entry : fs::recursive_directory_iterator(root / folder))
        if (entry.path().extension() == ".hpp" || entry.path().extension() == ".cpp")
          files[fs::relative(entry.path(), root).generic_string()] = words_of(entry.path());
    return files;
  }();
  return all;
}

/// The names of all kinds of event.
Words kinds() {
  Words names;
#define ZSTEP_NAME(E) names.insert(#E);
  ZSTEP_EVERY_KIND(ZSTEP_NAME)
#undef ZSTEP_NAME
  return names;
}

std::string theme_of(const std::string& kind) {
  for (const auto& [file, words] : code())
    if (file.starts_with("traces/events/") && words.contains("Fields") && words.contains(kind))
      return fs::path(file).stem().string();
  return "";
}

/// The folders of the engine that record a kind, with " and " between: of one method, or of what many share.
std::string recorded_in(const std::string& kind) {
  Words folders;
  for (const auto& [file, words] : code())
    if (file.starts_with("algorithms/") && words.contains(kind))
      folders.insert(file.substr(11, file.find('/', 11) - 11));
  std::string text;
  for (const std::string& folder : folders) text += (text.empty() ? "" : " and ") + folder;
  return text;
}

/// Where a theme's kinds have their place: the vocabulary, formulas, the mistakes that are made with them, replay,
/// panes, and the methods that record them.
bool at_home(const std::string& file) {
  for (const char* folder :
       {"algorithms/", "traces/events/", "traces/formulas/", "traces/mistakes/", "traces/replay/", "sim/viewer/panes/"})
    if (file.starts_with(folder)) return true;
  return false;
}

Words files_that_name(const Words& some) {
  Words files;
  for (const auto& [file, words] : code())
    for (const std::string& kind : some)
      if (!at_home(file) && words.contains(kind)) files.insert(file);
  return files;
}

}  // namespace

TEST_CASE("what one method alone records is named in at most 10 files besides its own") {
  std::map<std::pair<std::string, std::string>, Words> groups;  // by theme and by who records
  for (const std::string& kind : kinds()) {
    CAPTURE(kind);
    REQUIRE(!theme_of(kind).empty());
    REQUIRE(!recorded_in(kind).empty());
    groups[{theme_of(kind), recorded_in(kind)}].insert(kind);
  }
  std::size_t of_one = 0;
  for (const auto& [group, names] : groups) {
    const std::string &theme = group.first, &folders = group.second;
    // Viewing, pieces and scan lines are stages of many methods, and a pixel's own kinds what all pictures are made of.
    const Words stages{"viewing", "pieces", "scan_conversion", "interpolation"};
    const bool shared = folders.find(" and ") != std::string::npos || stages.contains(folders) || theme == "pixels";
    const Words files = files_that_name(names);
    std::string text;
    for (const std::string& file : files) text += "\n  " + file;
    fmt::print("{:<16} {:>3} files name what {} records\n", theme, files.size(), folders);
    if (shared) continue;
    ++of_one;
    CHECK_MESSAGE(files.size() <= 10, theme, " of ", folders, ": ", files.size(), text);
  }
  CHECK(of_one > 7);
}
