// Bookmarks and their file: back as they went in, and hostile ones refused in a line.
#include <doctest/doctest.h>

#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>

#include "sim/places/bookmarks.hpp"
#include "tests/folder.hpp"
#include "tests/golden/golden.hpp"
#include "tests/unit/algorithms/scene/input_error.hpp"
#include "tests/where.hpp"

using namespace zstep;
using places::Bookmark, places::Bookmarks;
namespace fs = std::filesystem;

namespace {

/// A copy of a golden trace in a folder of its own, which goes with it.
struct Copy {
  test::Folder folder;
  fs::path file = folder / "run.jsonl", marks = folder / "run.jsonl.marks";
  Copy() { fs::copy_file(test::in_checkout("tests/golden/delhi.jsonl"), file); }
  ~Copy() {
    std::error_code ignored;
    fs::permissions(folder.path(), fs::perms::owner_all, ignored);
  }
  void write(const std::string& text) const { std::ofstream(marks, std::ios::binary) << text; }
  std::string read() const {
    std::ostringstream text;
    text << std::ifstream(marks, std::ios::binary).rdbuf();
    return text.str();
  }
};

}  // namespace

TEST_SUITE("places") {
  TEST_CASE("bookmarks stand in a file that a person can read, and come back from it") {
    const Copy copy;
    const Trace trace = open_jsonl(copy.file);
    Bookmarks marks(trace);
    CHECK(marks.all().empty());
    CHECK_FALSE(fs::exists(copy.marks));
    marks.set(219, "  the first tie ");
    marks.set(31, "Ätna ∞");
    marks.set(231, "the first tie");  // the name moves
    marks.set(0, "before it");
    CHECK(copy.read() == "# bookmarks of run.jsonl\n0 before it\n31 Ätna ∞\n231 the first tie\n");
    CHECK(Bookmarks(trace).all() == marks.all());
    CHECK(Bookmarks(trace).find("the first tie") == 231);
    CHECK_FALSE(marks.find("the second"));
    marks.remove(0);
    marks.remove(7);
    CHECK(Bookmarks(trace).all() == std::vector<Bookmark>{{31, "Ätna ∞"}, {231, "the first tie"}});
    copy.write("\r\n# mine\r\n 12\tby hand \r\n\n");
    CHECK(Bookmarks(trace).all() == std::vector<Bookmark>{{12, "by hand"}});
  }

  TEST_CASE("a file that holds something else is refused with its line, and names that cannot be kept") {
    const Copy copy;
    const Trace trace = open_jsonl(copy.file);
    const auto refused = [&](const std::string& text, const std::string& part) {
      CAPTURE(part);
      copy.write(text);
      const std::string said = test::input_error([&] { Bookmarks{trace}; });
      CAPTURE(said);
      CHECK(said.find(part) != std::string::npos);
      CHECK(said.find('\n') == std::string::npos);
    };
    refused("1 a\nb\n", "marks:2: does not begin with a step");
    refused("-1 a\n", "marks:1: does not begin with a step");
    refused("99999999999999999999999 a\n", "marks:1: does not begin");
    refused("12a\n", "marks:1: does not begin");
    refused("12\n", "marks:1: a bookmark needs a name");
    refused("12 34\n", "would be a step");
    refused("253 beyond\n", "beyond the trace's end, 252");
    refused("1 a\n2 a\n", "marks:2: its name was given before");
    refused("1 \x1b[31mred\n", "cannot be shown");
    refused("1 \xff\xfe\n", "cannot be shown");
    refused("1 \xc3\n", "cannot be shown");
    refused(std::string("1 a\0b\n", 6), "cannot be shown");
    refused("1 " + std::string(201, 'a') + "\n", "more than 200 letters");
    refused(std::string((1u << 20) + 1, '#'), "is larger than 1 MiB");
    std::string many;
    for (int i = 0; i <= 10'000; ++i) many += "1 n" + std::to_string(i) + "\n";
    refused(many, "more than 10000 bookmarks");
    copy.write("");
    Bookmarks marks(trace);
    for (const char* name : {"", "  ", "12", "#a", "a\nb"})
      CHECK(test::input_error([&] { marks.set(1, name); }).starts_with("bookmark: "));
    CHECK(marks.all().empty());
  }

  TEST_CASE("a run without a file keeps no bookmarks, and says what to do") {
    const Trace trace = test::record_again(open_jsonl(test::in_checkout("tests/golden/delhi.jsonl")));
    Bookmarks marks(trace);
    CHECK(test::input_error([&] { marks.set(1, "a"); }).find("zstep record") != std::string::npos);
    CHECK(marks.all().empty());
  }
}
