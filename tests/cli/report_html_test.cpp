// zstep grade --format html: one page of one submission.
#include <doctest/doctest.h>

#include <regex>
#include <string>

#include "tests/cli/homework_runs.hpp"
#include "tests/cli/result_rules.hpp"

using namespace zstep::test;

namespace {

/// The points of all parts on a page, added up as a student would.
double added_up(const std::string& page) {
  static const std::regex product(R"(([0-9]+)/([0-9]+) × ([0-9.]+) = )");
  double sum = 0;
  for (std::sregex_iterator at(page.begin(), page.end(), product), end; at != end; ++at)
    sum += std::stod((*at)[1]) / std::stod((*at)[2]) * std::stod((*at)[3]);
  return sum;
}

}  // namespace

TEST_CASE(
    "grade html: what works, the first wrong step with both numbers and pictures, and points to work out by hand") {
  const Folder folder;
  set_up_runs(folder);
  std::string lines = text_of(folder / "runs/crossing.jsonl");
  replace_first(lines, "\"nearer\":true", "\"nearer\":false");
  write_text(folder / "runs/crossing.jsonl", lines);
  const Outcome outcome = run(folder, "grade --homework hw runs --format html -o page.html");
  CAPTURE(outcome.err);
  CHECK(outcome.code == 1);
  const std::string page = text_of(folder / "page.html");
  check_page(page);
  CHECK(page.find("<h2>What works</h2>") < page.find("<h2>Look at this first</h2>"));
  CHECK(page.find("<h2>Look at this first</h2>") < page.find("<h2>Points by part</h2>"));
  CHECK(has(page, "<li>triangle: everything</li>"));
  CHECK(has(page, "In crossing, runs/crossing.jsonl:"));
  CHECK(has(page, "<tr><th scope=\"row\"><code>nearer</code></th><td><code>true</code>"));
  CHECK(has(page, "<code>false</code>"));
  CHECK(has(page, "zstep grade --homework hw runs --scene crossing --view"));
  CHECK(times(page, "<img src=\"data:image/png;base64,iVBORw0KGgo") == 5);
  CHECK(has(page, "alt=\"The picture, expected. 14 × 12 pixels: "));
  CHECK(has(page, "alt=\"The depths, yours. "));
  std::smatch total;
  REQUIRE(std::regex_search(page, total, std::regex("<strong>([0-9.]+) of 65 points</strong>")));
  CHECK(std::stod(total[1]) < 65);
  // The hidden scene, all right, is worth a quarter and shows no numbers.
  CHECK(added_up(page) + 65.0 / 4 == doctest::Approx(std::stod(total[1])).epsilon(0.001));
}

TEST_CASE("grade html: a hidden scene shows its points and nothing else") {
  const Folder folder;
  set_up_runs(folder);
  std::string lines = text_of(folder / "runs/overlap.jsonl");
  replace_first(lines, "\"nearer\":true", "\"nearer\":false");
  write_text(folder / "runs/overlap.jsonl", lines + "{\"step\":\"write_pixel\",\"x\":99,\"y\":0,\"polygon\":0}\n");
  const Outcome outcome = run(folder, "grade --homework hw runs --format html");
  CHECK(outcome.code == 1);
  check_page(outcome.out);
  CHECK(has(outcome.out, "overlap (a hidden scene): 1"));
  CHECK_FALSE(has(outcome.out, "Look at this first"));
  CHECK_FALSE(has(outcome.out, "<img"));
  CHECK_FALSE(has(outcome.out, "(99"));
  CHECK_FALSE(has(outcome.out, "Every step is right"));
  const std::string hidden = outcome.out.substr(outcome.out.find("overlap (a hidden"));
  CHECK_FALSE(has(hidden, "×"));
}

TEST_CASE("grade html: nothing that a submission says acts in the page") {
  const Folder folder;
  set_up_runs(folder);
  const std::string bad = "<script>alert(1)<\\/script><img src=x onerror=alert(1)>\\u202e\\u001b[31m";
  write_text(folder / "crossing.jsonl", "{\"step\":\"" + bad + "\"}\n");
  const Outcome unread = run(folder, "grade --homework hw crossing.jsonl --format html");
  CHECK(unread.code == 2);
  check_page(unread.out);
  CHECK(has(unread.out, "&lt;script&gt;"));
  CHECK(has(unread.out, "could be graded"));
  CHECK_FALSE(has(unread.out, "\u202e"));
  // A folder's name, too.
  const std::string name = "<b onclick=\"x\">&'";
  std::filesystem::create_directory(folder / name);
  std::filesystem::copy_file(folder / "runs/triangle.jsonl", folder / name / "triangle.jsonl");
  const Outcome named = run(folder, "grade --homework hw \"<b onclick=\\\"x\\\">&'\" --format html");
  check_page(named.out);
  CHECK(has(named.out, "&lt;b onclick=&quot;x&quot;&gt;&amp;"));
  CHECK_FALSE(has(named.out, "<b "));
}
