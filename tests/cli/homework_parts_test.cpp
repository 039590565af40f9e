// A homework follows homework.toml: whatever parts are taken out of it, it can still be handed out, and asks for the
// rest alone.
#include <doctest/doctest.h>

#include <algorithm>
#include <filesystem>
#include <regex>
#include <set>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "tests/cli/small_homework.hpp"

using namespace zstep::test;
using nlohmann::json;
namespace fs = std::filesystem;

namespace {

using Names = std::set<std::string>;

/// homework.toml from its first [[part]] on, part by part; `before` gets what comes before these.
std::vector<std::string> parts_in(const std::string& toml, std::string& before) {
  std::vector<std::string> parts;
  std::size_t begin = toml.find("[[part]]");
  before = toml.substr(0, begin);
  while (begin < toml.size()) {
    const std::size_t end = std::min(toml.find("[[part]]", begin + 1), toml.size());
    parts.push_back(toml.substr(begin, end - begin));
    begin = end;
  }
  return parts;
}

/// The steps that a program is asked to print.
Names asked_in(const Folder& folder) {
  return json::parse(text_of(folder / "hw/starter/run.schema.json"))["$defs"]["any_step"]["properties"]["step"]["enum"]
      .get<Names>();
}

/// What a text has in the first group of a pattern, of these names.
Names found_in(const std::string& text, const char* pattern, const Names& of) {
  const std::regex one(pattern);
  Names found;
  for (std::sregex_iterator at(text.begin(), text.end(), one), end; at != end; ++at)
    if (of.contains((*at)[1])) found.insert((*at)[1]);
  return found;
}

/// With the first public scene alone, and one starter: what is tried is tried many times.
void keep_little(const Folder& folder, const std::string& method) {
  REQUIRE(run(folder, "homework new " + method + " hw").code == 0);
  std::string toml = text_of(folder / "hw/homework.toml");
  for (std::size_t at = toml.find("[[scene]]", toml.find("[[scene]]") + 1); at != std::string::npos;
       at = toml.find("[[scene]]", toml.find("[[scene]]") + 1)) {
    if (toml[at - 1] == ' ') break;  // in a comment
    toml.erase(at, toml.find("\n\n", at) + 2 - at);
  }
  write_text(folder / "hw/homework.toml", toml);
  for (const auto& entry : fs::directory_iterator(folder / "hw/starter"))
    if (entry.path().stem() != "emit" && (entry.path().extension() == ".cpp" || entry.path().extension() == ".js"))
      fs::remove(entry.path());
}

}  // namespace

TEST_CASE("homework parts: each part and each pair can be taken out, and all follows") {
  if (!fs::exists("/usr/bin/python3")) return;
  for (const char* method :
       {"z-buffer", "scan-line", "ray-casting", "depth-sort", "bsp", "warnock", "floating-horizon"}) {
    CAPTURE(method);
    const Folder folder;
    keep_little(folder, method);
    std::string before;
    const std::vector<std::string> parts = parts_in(text_of(folder / "hw/homework.toml"), before);
    REQUIRE(parts.size() >= 5);
    REQUIRE(shell(folder, "cp -r hw whole").code == 0);
    const Names all = asked_in(folder);
    Names ever;
    for (std::size_t i = 0; i < parts.size(); ++i)
      for (std::size_t k = i; k < parts.size(); ++k) {
        std::string toml = before, out;
        for (std::size_t at = 0; at < parts.size(); ++at) (at == i || at == k ? out : toml) += parts[at];
        CAPTURE(out);
        fs::remove_all(folder / "hw");
        REQUIRE(shell(folder, "cp -r whole hw").code == 0);
        write_text(folder / "hw/homework.toml", toml);
        const Outcome refreshed = run(folder, "homework refresh hw");
        CHECK_MESSAGE(refreshed.code == 0, refreshed.err);
        const Names asked = asked_in(folder);
        for (const std::string& step : all)
          if (!asked.contains(step)) ever.insert(step);
        CHECK(found_in(text_of(folder / "hw/handout.md"), "`([a-z_0-9]+)`", all) == asked);
        for (const auto& entry : fs::directory_iterator(folder / "hw/starter")) {
          if (entry.path().extension() != ".py") continue;
          const std::string starter = text_of(entry.path());
          for (const std::string& step : found_in(starter, R"((?:emit\.|def )([a-z_0-9]+)\()", all))
            CHECK_MESSAGE(asked.contains(step), step << " in " << entry.path().string());
        }
        // The beginnings are run where one part is out, which takes as long again.
        if (i != k)
          for (const char* mine : {"hw/starter", "hw/handout.md", "hw/handout.html"}) fs::remove_all(folder / mine);
        const Outcome tried = run(folder, "homework try hw");
        CHECK_MESSAGE(tried.code == 0, tried.out << tried.err);
        CHECK(has(tried.out, "It can be handed out."));
      }
    CHECK(ever.size() >= 4);
  }
}

TEST_CASE("homework parts: what stands in a block for no step of the method is refused at its line") {
  const Folder folder;
  REQUIRE(run(folder, "homework new z-buffer hw").code == 0);
  const std::string handout = text_of(folder / "hw/handout.md");
  const auto refused = [&](const std::string& text, const std::string& message) {
    write_text(folder / "hw/handout.md", text + handout);
    const Outcome outcome = run(folder, "homework refresh hw");
    CHECK(outcome.code == 2);
    CHECK(times(outcome.err, "\n") == 1);
    CHECK_MESSAGE(has(outcome.err, message), outcome.err);
    CHECK(text_of(folder / "hw/handout.md") == text + handout);
  };
  refused("<!-- for spam -->\n<!-- end -->\n", "handout.md:1: begins a block for 'spam', which is no step");
  refused("\n<!-- for span -->\n", "begins a block in a block");
  refused("\n<!-- end -->\n", "handout.md:2: ends a block that was not begun");
  write_text(folder / "hw/handout.md", handout + "<!-- for span -->\n");
  CHECK(has(run(folder, "homework refresh hw").err, "begins a block that has no end"));
}

TEST_CASE("homework parts: what an instructor wrote stays, and points may be any") {
  const Folder folder;
  keep_little(folder, "z-buffer");
  const std::string mine = "Hand in by Friday. `span` is a word of ours.\n";
  write_text(folder / "hw/handout.md", mine + text_of(folder / "hw/handout.md"));
  std::string toml = text_of(folder / "hw/homework.toml");
  toml.erase(toml.find("[[part]]\nname = \"spans\""),
             toml.find("[[part]]\nname = \"edge table\"") - toml.find("[[part]]\nname = \"spans\""));
  toml = std::regex_replace(toml, std::regex("value = 10\n"), "value = 7.25\n");
  write_text(folder / "hw/homework.toml", toml);
  REQUIRE(run(folder, "homework refresh hw").code == 0);
  CHECK(text_of(folder / "hw/handout.md").starts_with(mine));
  const Outcome tried = run(folder, "homework try hw");
  CHECK_MESSAGE(tried.code == 0, tried.out);
  CHECK(has(tried.out, "44.5 points"));
  // The text of a part that is put back is missed.
  write_text(folder / "hw/homework.toml", toml + "\n[[part]]\nname = \"spans\"\nsteps = [\"span\"]\nvalue = 1\n");
  write_text(folder / "hw/handout.md",
             std::regex_replace(text_of(folder / "hw/handout.md"), std::regex("`span`"), "span"));
  REQUIRE(run(folder, "homework refresh hw").code == 0);
  CHECK(has(run(folder, "homework try hw").out, "--  handout.md does not name the step span, of the part 'spans'"));
}
