// Every homework that comes with zstep: what it says is there, its solution gets all points, its starters run.
#include <doctest/doctest.h>

#include <algorithm>
#include <filesystem>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "tests/cli/program.hpp"
#include "tests/where.hpp"

using namespace zstep::test;
using nlohmann::json;
namespace fs = std::filesystem;

namespace {

std::vector<std::string> methods_with_homework() {
  std::vector<std::string> methods;
  for (const fs::directory_entry& entry : fs::directory_iterator(in_checkout("lessons/homework")))
    if (entry.is_directory()) methods.push_back(entry.path().filename().string());
  std::sort(methods.begin(), methods.end());
  return methods;
}
/// The one file in a folder with this extension that emit.* is not.
std::string program_in(const fs::path& folder, const std::string& extension) {
  for (const fs::directory_entry& entry : fs::directory_iterator(folder))
    if (entry.path().extension() == extension && entry.path().stem() != "emit") return entry.path().filename().string();
  return "";
}
bool there_is_program(const Folder& folder, const std::string& program) {
  return shell(folder, program + " --version").code == 0;
}

}  // namespace

TEST_CASE("templates: each solution gets all points, and each starter runs and earns something less") {
  CHECK(methods_with_homework().size() >= 7);
  for (const std::string& method : methods_with_homework()) {
    CAPTURE(method);
    const Folder folder;
    REQUIRE(run(folder, "homework new " + method + " hw").code == 0);
    CHECK(text_of(folder / "hw/class/make_class.py") == text_of(in_checkout("lessons/homework/make_class.py")));
    const Outcome tried = run(folder, "homework try hw");
    CHECK_MESSAGE(tried.code == 0, tried.out << tried.err);
    const std::string hand_out = text_of(folder / "hw/handout.md");
    const json schema = json::parse(text_of(folder / "hw/starter/run.schema.json"));
    const json& steps = schema["$defs"]["any_step"]["properties"]["step"]["enum"];
    for (const char* file : {"emit.h", "emit.py", "emit.js", "Emit.java"})
      CHECK_MESSAGE(times(text_of(folder / ("hw/starter/" + std::string(file))), "\n") <= 80, file);
    for (const json& step : steps)
      CHECK_MESSAGE(has(hand_out, '`' + step.get<std::string>() + '`'), step.get<std::string>());
    if (!there_is_program(folder, "python3")) continue;
    const std::string solution = program_in(folder / "hw/solution", ".py");
    const auto run_all = [&](const std::string& program) {
      return shell(folder, "rm -rf runs; mkdir runs; for s in hw/scenes/*.txt hw/hidden/*.txt; do " + program +
                               " $s > runs/$(basename $s .txt).jsonl || exit 1; done");
    };
    const Outcome ran = run_all("python3 hw/solution/" + solution);
    CAPTURE(ran.err);
    CHECK(ran.code == 0);
    const Outcome graded = run(folder, "grade --homework hw runs");
    CAPTURE(graded.out);
    CHECK(graded.code == 0);
    CHECK(has(graded.out, "Every step is right."));
    std::vector<std::string> starters{"python3 hw/starter/" + program_in(folder / "hw/starter", ".py")};
    if (there_is_program(folder, "node"))
      starters.push_back("node hw/starter/" + program_in(folder / "hw/starter", ".js"));
    if (there_is_program(folder, "c++")) {
      const Outcome compiled =
          shell(folder, "c++ -std=c++17 -Wall -o first hw/starter/" + program_in(folder / "hw/starter", ".cpp"));
      CHECK_MESSAGE(compiled.code == 0, compiled.err);
      starters.emplace_back("./first");
    }
    for (const std::string& starter : starters) {
      CAPTURE(starter);
      CHECK(run_all(starter).code == 0);
      const json all = json::parse(run(folder, "grade --homework hw runs --format json").out);
      CHECK(all["gradable"] == true);
      CHECK(all["points"].get<double>() < 0.05 * all["of"].get<double>());
    }
  }
}

TEST_CASE("templates: the picture alone earns the first part, in each") {
  for (const std::string& method : methods_with_homework()) {
    CAPTURE(method);
    const Folder folder;
    REQUIRE(run(folder, "homework new " + method + " hw").code == 0);
    std::string scene;
    for (const fs::directory_entry& entry : fs::directory_iterator(folder / "hw/scenes"))
      if (entry.path().extension() == ".toml") scene = entry.path().stem().string();
    const bool lines = method == "floating-horizon";  // it has no polygons and no depths
    const Outcome drawn =
        run(folder, "render hw/scenes/" + scene + ".toml --algorithm " + method +
                        (lines ? " --option sides=off --save " + scene + ".png"
                               : " --no-cull --save-ids " + scene + ".npy --save-depth-raw " + scene + ".depth.npy"));
    CAPTURE(drawn.err);
    REQUIRE(drawn.code == 0);
    REQUIRE(shell(folder, "mkdir runs && mv " + scene + ".* runs").code == 0);
    const Outcome graded = run(folder, "grade --homework hw runs --scene " + scene);
    CAPTURE(graded.out);
    CHECK(has(graded.out, lines ? "ok picture   " : "ok picture and depths"));
    const std::string page = text_of(folder / "hw/handout.html");
    CHECK(has(page, "<figcaption>The picture"));
    CHECK(has(page, "<figcaption>The depths") == !lines);
  }
}

TEST_CASE("templates: a picture of lines is graded by its ink, and no numbers of polygons are taken for it") {
  const Folder folder;
  REQUIRE(run(folder, "homework new floating-horizon hw").code == 0);
  REQUIRE(shell(folder, "mkdir runs").code == 0);
  REQUIRE(run(folder,
              "render hw/scenes/valley.toml --algorithm floating-horizon --option sides=off --option "
              "horizons=one --save runs/valley.png")
              .code == 0);
  const Outcome graded = run(folder, "grade --homework hw runs --scene valley");
  CAPTURE(graded.out);
  CHECK(graded.code == 1);
  CHECK(has(graded.out, "the colour 213, 94, 0"));
  CHECK_FALSE(has(graded.out, "right pixels 0 of"));
  REQUIRE(run(folder, "render hw/scenes/valley.toml --save-ids runs/valley.npy").code == 0);  // a Z-buffer's
  fs::remove(folder / "runs/valley.png");
  CHECK(has(run(folder, "grade --homework hw runs --scene valley").out, "give the picture as .png"));
}
