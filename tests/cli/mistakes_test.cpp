// A class of students, each with one wrong line, is graded: the report names the mistake of each.
#include <doctest/doctest.h>

#include <cstdlib>
#include <string>

#include <nlohmann/json.hpp>

#include "tests/cli/program.hpp"

using namespace zstep::test;
using nlohmann::json;

namespace {

bool in(const Folder& folder, const std::string& command) {
  return std::system(("cd '" + folder.path().string() + "' && " + command).c_str()) == 0;
}

}  // namespace

TEST_CASE("grade: of a class of thirty, each is told the own mistake") {
  if (std::system("python3 --version >/dev/null 2>&1") != 0) return;
  const Folder folder;
  REQUIRE(run(folder, "homework new z-buffer hw").code == 0);
  REQUIRE(in(folder, "python3 hw/class/make_class.py class && mkdir runs"));
  int students = 0, right = 0, none = 0, wrong = 0;
  std::string table;
  for (const auto& entry : std::filesystem::directory_iterator(folder / "class")) {
    const std::string student = entry.path().filename().string(), mistake = student.substr(3);
    ++students;
    CAPTURE(student);
    for (const char* scene : {"scenes/triangle", "scenes/crossing", "scenes/neighbours", "hidden/overlap"})
      in(folder, "python3 class/" + student + "/zbuffer.py hw/" + scene + ".txt > runs/$(basename " + scene +
                     ").jsonl 2>/dev/null");
    const json report = json::parse(run(folder, "grade --homework hw runs --format json").out);
    CHECK(report["gradable"] == (mistake != "prints-nothing"));
    CHECK((report["points"] == doctest::Approx(65)) == (mistake == "right"));
    if (mistake == "right" || mistake == "crashes" || mistake == "prints-nothing") {
      for (const json& task : report["scenes"]) CHECK_FALSE(task.contains("mistake"));
      continue;
    }
    bool named = false;
    for (const json& task : report["scenes"]) {
      if (!task.contains("first")) continue;
      const std::string name = task.contains("mistake") ? task["mistake"]["id"].get<std::string>() : "";
      named = named || name == mistake;
      (name == mistake ? right : name.empty() ? none : wrong)++;
      if (name != mistake)
        table += "\n" + student + ": " + (name.empty() ? "no name" : name) + " in " + task["scene"].get<std::string>();
    }
    CHECK(named);
  }
  CHECK(students == 30);
  MESSAGE(right, " of ", right + none + wrong, " named rightly, ", none, " not, ", wrong, " wrongly", table);
  CHECK(right >= 0.95 * (right + none + wrong));
}
