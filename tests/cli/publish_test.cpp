// zstep publish: a page with a run inside, which nothing in the run leaves, and which names nobody's folders.
#include <doctest/doctest.h>

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "sim/pages/packed.hpp"
#include "tests/cli/homework_runs.hpp"
#include "tests/cli/program.hpp"
#include "tests/where.hpp"
#include "traces/file/container.hpp"

using namespace zstep::test;
using zstep::seven_bits;
using Bytes = std::vector<std::uint8_t>;

namespace {

/// What sim/web/page/packed.js does.
std::string bytes_of(const std::string& text, std::size_t count) {
  std::string bytes;
  unsigned held = 0, bits = 0;
  const auto put = [&](unsigned group) {
    held = held << 7 | group, bits += 7;
    if (bits < 8) return;
    bits -= 8;
    bytes.push_back(static_cast<char>(held >> bits));
    held &= (1u << bits) - 1;
  };
  for (std::size_t at = 0; at < text.size(); ++at) {
    const auto first = static_cast<unsigned char>(text[at]);
    if (first < 128) {
      put(first);
      continue;
    }
    const unsigned letter = (first & 31u) << 6 | (static_cast<unsigned char>(text[++at]) & 63u);
    put(static_cast<unsigned char>("\0\r<"[(letter - 256) / 128]));
    put(letter % 128);
  }
  REQUIRE(bytes.size() >= count);
  bytes.resize(count);
  return bytes;
}

std::string between(const std::string& text, const std::string& begin, const std::string& end) {
  const std::size_t from = text.find(begin);
  REQUIRE(from != text.npos);
  return text.substr(from + begin.size(), text.find(end, from + begin.size()) - from - begin.size());
}

/// Writes the file that a page holds under this name.
void unpack(const Folder& folder, const std::string& page, const std::string& name, const std::string& to) {
  const std::string element = between(page, "data-name=\"" + name + "\" ", "</script>");
  const std::string count = between(element, "data-bytes=\"", "\"");
  write_text(folder / "packed.gz", bytes_of(element.substr(element.find('>') + 1), std::stoul(count)));
  REQUIRE(shell(folder, "gzip -dc packed.gz > '" + to + "'").code == 0);
}

const std::string page_begin = "<!doctype html><title>zstep</title>\n", page_end = "<script>run()</script>\n";
std::string mark() { return "<!-- zstep publish " + std::to_string(zstep::trace_version) + " -->\n"; }

/// A folder with a page as ./zstep web makes one, and two runs.
struct Clone : Folder {
  Clone() {
    std::filesystem::create_directory(*this / "site");
    write_text(*this / "site/publish.html", page_begin + mark() + page_end);
    REQUIRE(zstep::test::run(*this, "record pyramid-behind -o run.ztrace").code == 0);
    REQUIRE(zstep::test::run(*this, "dump run.ztrace --jsonl > run.jsonl").code == 0);
  }
};

std::string words_of(const std::string& page) {
  return between(page, "<script type=\"application/json\" id=\"published\">", "</script>");
}

}  // namespace

TEST_CASE("bytes inside a page are letters that HTML leaves alone, and come back") {
  Bytes all;
  for (unsigned first = 0; first < 256; ++first)
    for (unsigned second = 0; second < 256; ++second)
      all.push_back(static_cast<std::uint8_t>(first)), all.push_back(static_cast<std::uint8_t>(second));
  std::vector<Bytes> tried = {all, {}, Bytes(1000, 0), Bytes(1000, 255), Bytes(999, '<'), Bytes(7, '\r')};
  for (unsigned byte = 0; byte < 256; ++byte)  // at the end, after every number of left-over bits
    for (std::size_t before = 0; before < 8; ++before) {
      tried.emplace_back(before, std::uint8_t{0x7f});
      tried.back().push_back(static_cast<std::uint8_t>(byte));
    }
  for (const Bytes& bytes : tried) {
    const std::string text = seven_bits(bytes);
    REQUIRE(text.find('\0') == text.npos);
    REQUIRE(text.find_first_of("<\r") == text.npos);
    REQUIRE(text.size() <= bytes.size() * 8 / 7 + 2);
    REQUIRE(bytes_of(text, bytes.size()) == std::string(bytes.begin(), bytes.end()));
  }
  // What one_page.py makes of the program is the same.
  const Folder folder;
  write_text(folder / "all", std::string(all.begin(), all.end()));
  const Outcome python = shell(folder, "python3 -c \"import sys; sys.dont_write_bytecode = True; sys.path.insert(0, '" +
                                           in_checkout("sim/web") +
                                           "'); import one_page; open('text', 'wb').write("
                                           "one_page.seven_bits(open('all', 'rb').read()).encode())\"");
  REQUIRE_MESSAGE(python.code == 0, python.err);
  CHECK(text_of(folder / "text") == seven_bits(all));
}

TEST_CASE("a page holds the run as it was recorded, and the words that open it") {
  const Clone clone;
  const Outcome made =
      run(clone, "publish run.ztrace --site site --at 50% --pixel 3,4 --lead depth --dark -o page.html");
  REQUIRE_MESSAGE(made.code == 0, made.err);
  CHECK(has(made.out, "wrote page.html: "));
  CHECK(made.err.empty());
  const std::string page = text_of(clone / "page.html");
  CHECK(page.starts_with(page_begin));
  CHECK(page.ends_with(page_end));
  CHECK_FALSE(has(page, "<!--"));
  CHECK(has(words_of(page), R"(["view","run.ztrace","--at=)"));
  CHECK(has(words_of(page), R"(,"--pixel=3,4","--lead=depth","--dark"],"files":["run.ztrace"]})"));
  unpack(clone, page, "run.ztrace", "again.ztrace");
  CHECK(shell(clone, "cmp run.ztrace again.ztrace").code == 0);

  REQUIRE(shell(clone, "ZSTEP_SITE=site \"$zstep\" publish run.jsonl --check -o page.html").code == 0);
  const std::string judged = text_of(clone / "page.html");
  CHECK(has(words_of(judged), R"(["check","run.jsonl","--view"],"files":["run.jsonl"]})"));
  unpack(clone, judged, "run.jsonl", "again.jsonl");
  CHECK(shell(clone, "cmp run.jsonl again.jsonl").code == 0);

  std::filesystem::create_directory(clone / "ada");
  std::filesystem::copy_file(clone / "run.ztrace", clone / "ada/run.ztrace");
  REQUIRE(run(clone, "publish run.ztrace --against ada/run.ztrace --site site -o page.html").code == 0);
  const std::string both = text_of(clone / "page.html");
  CHECK(has(words_of(both), R"(["diff","run.ztrace","b-run.ztrace","--view"],"files":["run.ztrace","b-run.ztrace"]})"));
  CHECK_FALSE(has(both, "ada"));
}

TEST_CASE("a page names no folder of the computer that it was made on") {
  const Clone clone;
  const std::string here = clone.path().string();
  std::filesystem::create_directory(clone / "secret");
  write_text(clone / "secret/tri.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n");
  REQUIRE(run(clone, "record " + here + "/secret/tri.off -o " + here + "/secret/own.ztrace").code == 0);
  REQUIRE(run(clone, "dump secret/own.ztrace --jsonl > secret/own.jsonl").code == 0);
  REQUIRE(has(text_of(clone / "secret/own.jsonl"), here));  // else this shows nothing
  REQUIRE(shell(clone, "head -c -40 secret/own.ztrace > secret/cut.ztrace").code == 0);
  for (const std::string name : {"own.ztrace", "own.jsonl", "cut.ztrace"}) {
    CAPTURE(name);
    const Outcome made = run(clone, "publish " + here + "/secret/" + name + " --site " + here + "/site -o page.html");
    CHECK(made.code == (name == "cut.ztrace" ? 3 : 0));
    const std::string page = text_of(clone / "page.html");
    CHECK_FALSE(has(page, here));
    CHECK_FALSE(has(page, "secret"));
    std::filesystem::create_directory(clone / "there");
    unpack(clone, page, name, "there/" + name);
    const std::string events = "' | tail -n +2";
    const std::string dump = name == "own.jsonl" ? "cat 'DIR/own.jsonl" : "\"$zstep\" dump --jsonl 'DIR/" + name;
    const auto lines = [&](const std::string& folder) {
      std::string line = dump + "'";
      line.replace(line.find("DIR"), 3, folder);
      return shell(clone, line + " 2>err");
    };
    const Outcome was = lines("secret"), is = lines("there");
    const std::string header = is.out.substr(0, is.out.find('\n'));
    CHECK_FALSE(has(header, "secret"));
    CHECK(has(header, R"("source":"tri.off")"));
    CHECK(is.code == was.code);
    CHECK(is.out.substr(header.size()) == was.out.substr(was.out.find('\n')));
    CHECK_FALSE(has(text_of(clone / "err"), "index is damaged"));
    std::filesystem::remove_all(clone / "there");
  }
}

TEST_CASE("nothing in a run leaves the script element that holds it") {
  const Clone clone;
  std::string lines = text_of(clone / "run.jsonl");
  const std::string bad = "</script><script>alert(1)</script><!--";
  const std::size_t writer = lines.find("\"writer\":\"");
  REQUIRE(writer != lines.npos);
  lines.insert(writer + 10, bad);
  const std::string name = "a\"<img src=x onerror=1>&'.jsonl";
  write_text(clone / name, lines);
  const Outcome made = shell(clone, R"("$zstep" publish a*.jsonl --site site -o page.html)");
  REQUIRE_MESSAGE(made.code == 0, made.err);
  const std::string page = text_of(clone / "page.html");
  CHECK(times(page, "<script") == 3);
  CHECK(times(page, "</script>") == 3);
  CHECK(times(page, "<!--") == 0);
  CHECK(times(page, "<img") == 0);
  CHECK(has(page, R"(data-name="a&quot;&lt;img src=x onerror=1&gt;&amp;)"));
  CHECK(has(words_of(page), R"(["view","a\"\u003cimg src=x onerror=1>&'.jsonl"])"));
  // A name that looks like an option.
  std::filesystem::copy_file(clone / "run.ztrace", clone / "--help.ztrace");
  REQUIRE(shell(clone, R"("$zstep" publish ./--help.ztrace --site site -o page.html)").code == 0);
  CHECK(has(words_of(text_of(clone / "page.html")), R"(["view","run--help.ztrace"])"));
}

TEST_CASE("what cannot be published is told in one line, and leaves no page") {
  const Clone clone;
  const auto wrong = [&](const std::string& arguments, const std::string& told) {
    CAPTURE(arguments);
    const Outcome outcome = run(clone, "publish " + arguments);
    CHECK(outcome.code == 2);
    CHECK_MESSAGE(has(outcome.err, told), outcome.err);
    CHECK(times(outcome.err, "\n") == 1);
    CHECK_FALSE(std::filesystem::exists(clone / "page.html"));
  };
  wrong("run.ztrace --site nowhere -o page.html", "./zstep web -o site makes one");
  wrong("pyramid --site site -o page.html", "record it first: zstep record SCENE -o run.ztrace");
  wrong("no.ztrace --site site -o page.html", "there is no such file");
  wrong("run.ztrace --site site --at 999999 -o page.html", "the trace ends at step");
  wrong("run.ztrace --site site --pixel 999,1 -o page.html", "they count from 0");
  wrong("run.ztrace --site site --lead nothing -o page.html", "no pane 'nothing' can lead here");
  wrong("run.ztrace --site site -o nowhere/page.html", "there is no folder");
  wrong("run.ztrace --site site -o run.ztrace", "run.ztrace");
  wrong("run.ztrace --site site --check --race z-buffer,bsp -o page.html", "leave out one of them");
  REQUIRE(run(clone, "record pyramid --size 9x9 -o small.ztrace").code == 0);
  wrong("run.ztrace --against small.ztrace --site site -o page.html", "record both with one --size");
  write_text(clone / "site/publish.html", page_begin + "<!-- zstep publish 1 -->\n" + page_end);
  wrong("run.ztrace --site site -o page.html", "was made by another zstep");
  write_text(clone / "site/publish.html", page_begin + mark() + mark() + page_end);
  wrong("run.ztrace --site site -o page.html", "./zstep web -o FOLDER makes one");
  write_text(clone / "site/publish.html", page_begin + page_end);
  wrong("run.ztrace --site site -o page.html", "is no page that a run can be put into");
}

TEST_CASE("a page that is larger than mail takes is made, and told") {
  const Clone clone;
  write_text(clone / "site/publish.html", page_begin + mark() + std::string(6'000'000, ' ') + page_end);
  const Outcome made = run(clone, "publish run.ztrace --site site -o page.html");
  CHECK(made.code == 0);
  CHECK(has(made.out, "6.0 MB"));
  CHECK(has(made.err, "at most 5.0 MB"));
  CHECK(times(made.err, "\n") == 1);
}

TEST_CASE("grade --steps: the report leads to a page that compares both runs, of what may be shown") {
  const Folder folder;
  set_up_runs(folder);
  std::filesystem::create_directory(folder / "site");
  write_text(folder / "site/publish.html", page_begin + mark() + page_end);
  std::filesystem::create_directories(folder / "to show");
  const std::string grade =
      "grade --homework hw runs --format html -o page.html --site site --steps 'to show/steps.html'";
  const auto lies = [&](const char* run_file) {
    std::string lines = text_of(folder / run_file);
    replace_first(lines, "\"nearer\":true", "\"nearer\":false");
    write_text(folder / run_file, lines);
  };

  // All is right, or what is wrong is hidden: nothing to step through, and no page.
  const Outcome right = run(folder, grade);
  REQUIRE(right.code == 0);
  CHECK(has(right.err, "to show/steps.html: was not written, as no step that may be shown is wrong"));
  CHECK_FALSE(has(text_of(folder / "page.html"), "Step through"));
  lies("runs/overlap.jsonl");
  REQUIRE(run(folder, grade).code == 1);
  CHECK_FALSE(has(text_of(folder / "page.html"), "Step through"));
  CHECK_FALSE(std::filesystem::exists(folder / "to show/steps.html"));

  lies("runs/crossing.jsonl");
  const Outcome outcome = run(folder, grade);
  CAPTURE(outcome.err);
  REQUIRE(outcome.code == 1);
  CHECK(has(outcome.out, "wrote to show/steps.html: both runs, from there on"));
  CHECK(has(text_of(folder / "page.html"), "<a href=\"to%20show/steps.html\">Step through both runs from here</a>"));
  const std::string page = text_of(folder / "to show/steps.html");
  CHECK(has(words_of(page), R"("words":["diff","expected.jsonl","yours.jsonl","--view"])"));
  CHECK_FALSE(has(page, folder.path().string()));
  unpack(folder, page, "expected.jsonl", "expected.jsonl");
  unpack(folder, page, "yours.jsonl", "yours.jsonl");
  CHECK(run(folder, "check expected.jsonl").code == 0);
  const Outcome apart = run(folder, "diff expected.jsonl yours.jsonl");
  CHECK(apart.code == 1);
  CHECK(has(apart.out, "compare"));
  for (const char* file : {"expected.jsonl", "yours.jsonl"})
    CHECK_FALSE(has(text_of(folder / file), folder.path().string()));

  const auto refused = [&](const std::string& words, const char* what) {
    const Outcome said = run(folder, "grade --homework hw " + words);
    CHECK(said.code == 2);
    CHECK_MESSAGE(has(said.err, what), said.err);
  };
  refused("runs --steps s.html --site site", "--steps: is a page that a report of HTML leads to; add --format html");
  refused("runs --site site", "--site: is of the page of both runs; add --steps FILE.html");
  refused("runs --format html -o page.html --steps page.html --site site", "page.html");
  refused("runs --format html -o p.html --steps s.html --site nowhere", "there is no page to put a run into");
  refused("--batch runs -o g.csv --steps s.html", "--steps: is of one submission");
}
