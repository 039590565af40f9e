// Near-identical runs of scenes that are each student's own: named on the page of the class, and nothing else is.
#include <doctest/doctest.h>

#include <filesystem>
#include <string>
#include <vector>

#include "tests/cli/homework_runs.hpp"

using namespace zstep::test;

namespace {

namespace fs = std::filesystem;

const std::vector<std::string> students{"ana", "bo", "carl", "dora", "eve", "fred", "gil"};
const std::string heading = "<h2>Near-identical runs</h2>";

/// hw with the public scene crossing and one of each student's own; in right/ the right run of each student's.
void set_up_own(const Folder& folder) {
  set_up_runs(folder);
  std::string text = text_of(folder / "hw/homework.toml");
  replace_first(text, "[[part]]", "[[scene]]\ngenerate = \"triangles\"\nname = \"own\"\nlosing = [5, 60]\n\n[[part]]");
  write_text(folder / "hw/homework.toml", text);
  std::string names;
  for (const std::string& student : students) names += student + "\n";
  write_text(folder / "names.txt", names);
  const Outcome made = shell(folder,
                             "$zstep homework seed hw --for names.txt -o students --seed one && mkdir right && "
                             "for s in $(cat names.txt); do $zstep record students/$s/scenes/own.toml --coverage "
                             "top-left -o own.ztrace && $zstep dump own.ztrace --jsonl | tail -n +2 > right/$s.jsonl "
                             "|| exit 1; done");
  CAPTURE(made.err);
  REQUIRE(made.code == 0);
}
void hand_in_own(const Folder& folder, const std::string& student, const std::string& run) {
  fs::create_directories(folder / ("class/" + student));
  write_text(folder / ("class/" + student + "/own.jsonl"), run);
}
std::string right_own(const Folder& folder, const std::string& student) {
  return text_of(folder / ("right/" + student + ".jsonl"));
}
/// Every compare says that it is nearer, as one who forgot to compare.
std::string always_nearer(std::string run) {
  for (std::size_t at; (at = run.find("\"nearer\":false")) != std::string::npos;)
    run.replace(at, 14, "\"nearer\":true");
  return run;
}
std::string class_page(const Folder& folder) {
  const Outcome graded = run(folder, "grade --homework hw --batch class -o book.csv --report class.html");
  CAPTURE(graded.err);
  REQUIRE(graded.code <= 1);
  return text_of(folder / "class.html");
}

}  // namespace

TEST_CASE("alike: runs that their scenes make alike, and runs of scenes of the own, are not named") {
  const Folder folder;
  set_up_own(folder);
  // The same public scenes have the same right run; the same mistake gives other numbers on other scenes.
  for (const char* student : {"ana", "bo"}) {
    hand_in_own(folder, student, right_own(folder, student));
    for (const char* scene : {"triangle", "crossing", "neighbours"})
      fs::copy(folder / ("runs/" + std::string(scene) + ".jsonl"),
               folder / ("class/" + std::string(student) + "/" + scene + ".jsonl"));
  }
  for (const char* student : {"carl", "dora"}) hand_in_own(folder, student, always_nearer(right_own(folder, student)));
  // Hardly begun: the same steps whatever the scene is, with the same few numbers.
  std::string begun = "{\"step\":\"clear\",\"z\":\"inf\"}\n";
  for (int y = 0; y < 12; ++y)
    for (int x = 0; x < 14; ++x)
      begun += "{\"step\":\"compare\",\"x\":" + std::to_string(x) + ",\"y\":" + std::to_string(y) +
               ",\"z\":0.5,\"nearer\":true}\n";
  for (const char* student : {"eve", "fred"}) hand_in_own(folder, student, begun);
  CHECK_FALSE(has(class_page(folder), heading));
  // Files mixed up: the run of a public scene under the name of one's own.
  for (const char* student : {"eve", "gil"}) hand_in_own(folder, student, text_of(folder / "runs/crossing.jsonl"));
  CHECK_FALSE(has(class_page(folder), heading));
}

TEST_CASE("alike: the run of another student's scene is named with what is the same, and no points change") {
  const Folder folder;
  set_up_own(folder);
  for (const char* student : {"ana", "bo", "fred"}) hand_in_own(folder, student, right_own(folder, student));
  class_page(folder);
  const std::string before = text_of(folder / "book.csv");
  // Written otherwise: a header, blanks, and the other order of its lines.
  const std::string ana = right_own(folder, "ana");
  std::string other = "{\"ztrace\":1,\"writer\":\"carl\"}\n" + ana;
  for (std::size_t at = 0; (at = other.find("\":", at)) != std::string::npos; at += 3) other.insert(at + 2, " ");
  hand_in_own(folder, "carl", other);
  // With some lines left out.
  std::string fewer;
  std::size_t line = 0;
  for (std::size_t begin = 0; begin < ana.size(); ++line) {
    const std::size_t end = ana.find('\n', begin) + 1;
    if (line % 20 != 7) fewer += ana.substr(begin, end - begin);
    begin = end;
  }
  hand_in_own(folder, "dora", fewer);
  // A wrong run that two hand in; and one that is right for somebody who handed in another.
  hand_in_own(folder, "eve", always_nearer(right_own(folder, "bo")));
  hand_in_own(folder, "gil", right_own(folder, "fred").substr(0, right_own(folder, "fred").size() / 2));
  const std::string page = class_page(folder);
  CAPTURE(page.substr(page.find(heading)));
  REQUIRE(has(page, heading));
  const std::size_t begin = page.find(heading);
  const std::string table = page.substr(begin, page.find("</table>", begin) - begin);
  CHECK(has(table, "<tr><th scope=\"row\">own</th><td>ana, carl, dora</td><td>about 9"));
  CHECK(has(table, " steps that hold numbers; right on the scene of ana</td></tr>"));
  CHECK_FALSE(has(table, "gil"));  // half a run is not nearly the same
  CHECK(times(table, "<tr><th scope=\"row\">") == 2);
  CHECK(has(table, "<td>bo, eve</td>"));
  CHECK(has(table, "no points depend on it"));
  for (const std::string row : {"ana", "bo", "fred"}) {
    const std::size_t at = before.find("\"" + row + "\"");
    CHECK(has(text_of(folder / "book.csv"), before.substr(at, before.find('\n', at) - at)));
  }
  // What is kept says the same.
  CHECK(class_page(folder) == page);
  // The same to the last number, handed in by many; the one whose scene it is handed in something else.
  hand_in_own(folder, "ana", "{\"step\":\"clear\",\"z\":\"inf\"}\n");
  fs::remove_all(folder / "class/dora");
  for (int k = 0; k < 30; ++k) hand_in_own(folder, "x" + std::to_string(k), ana);
  const std::string many = class_page(folder);
  CHECK(has(many, "<td>carl, x0, x1, x10, "));
  CHECK(has(many, ", x8, x9</td><td>all "));
  CHECK(has(many, " steps that hold numbers; right on the scene of ana</td></tr>"));
}
