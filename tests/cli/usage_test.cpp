// Help, versions, and command lines with a mistake in them: one line that says what is wrong and how to mend it, exit
// 2.
#include <doctest/doctest.h>

#include <string>
#include <vector>

#include "tests/cli/program.hpp"

using namespace zstep::test;

namespace {

const std::vector<std::string> commands{"list", "lesson", "view",   "render",          "record",
                                        "info", "dump",   "import", "compare-methods", "completion"};

void check_complaint(const Folder& folder, const std::string& arguments, const std::vector<std::string>& parts) {
  CAPTURE(arguments);
  const Outcome outcome = run(folder, arguments);
  CHECK(outcome.code == 2);
  CHECK(outcome.out.empty());
  CHECK(times(outcome.err, "\n") == 1);
  CHECK(outcome.err.find("; ") != std::string::npos);
  for (const std::string& part : parts) {
    CAPTURE(outcome.err);
    CAPTURE(part);
    CHECK(outcome.err.find(part) != std::string::npos);
  }
  CHECK(folder.names().empty());
}

}  // namespace

TEST_CASE("help is there for zstep and for every command, with examples") {
  const Folder folder;
  const Outcome help = run(folder, "--help");
  CHECK(help.code == 0);
  CHECK(help.err.empty());
  for (const std::string& command : commands) {
    CAPTURE(command);
    CHECK(help.out.find("\n  " + command) != std::string::npos);
    const Outcome own = run(folder, command + " --help");
    CHECK(own.code == 0);
    CHECK(own.out.find("Usage: zstep " + command) != std::string::npos);
    CHECK(own.out.find("Examples:\n  ") != std::string::npos);
  }
  CHECK(run(folder, "--version").out.substr(0, 6) == "zstep ");
  CHECK(run(folder, "--version").code == 0);
}

TEST_CASE("commands are printed as the launcher was called") {
  const Folder folder;
  const std::string typed = "ZSTEP_CALLED=../clone/zstep \"$zstep\" ";
  const std::string help = shell(folder, typed + "record --help").out;
  CHECK(help.find("Usage: ../clone/zstep record ") != std::string::npos);
  CHECK(help.find("\n  ../clone/zstep view run.ztrace") != std::string::npos);
  CHECK(shell(folder, typed + "--help").out.find("zstep shows how") == 0);
  CHECK(shell(folder, typed + "list --sise").err ==
        "../clone/zstep list: there is no option --sise; '../clone/zstep list --help' names them\n");
  CHECK(shell(folder, typed + "info no.ztrace").err.find("make one: ../clone/zstep record SCENE -o run.ztrace") !=
        std::string::npos);
}

TEST_CASE("the examples in the help are command lines that zstep knows") {
  const Folder folder;
  int tried = 0;
  for (const std::string& command : commands) {
    const std::string help = run(folder, command + " --help").out;
    std::size_t at = help.find("Examples:");
    while ((at = help.find("\n  ", at)) != std::string::npos) {
      at += 3;
      const std::string line = help.substr(at, help.find('\n', at) - at);
      const std::size_t name = line.find("zstep ");
      REQUIRE(name != std::string::npos);
      // A mistake in an option's name is found before files are looked for, so the examples need none.
      std::string words = line.substr(name + 6);
      words = words.substr(0, words.find_first_of(">|)"));
      CAPTURE(words);
      CHECK(run(folder, words + " --help").code == 0);
      ++tried;
    }
  }
  CHECK(tried >= 20);
}

TEST_CASE("a mistyped command, option, scene, word or method is answered with the nearest one there is") {
  const Folder folder;
  check_complaint(folder, "recrod teapot", {"zstep: there is no command 'recrod'", "did you mean record?"});
  check_complaint(folder, "qqq", {"there is no command 'qqq'", "the commands are list"});
  check_complaint(folder, "run.ztrace", {"there is no command 'run.ztrace'", "zstep view run.ztrace"});
  check_complaint(folder, "render teapot --sise 64x64",
                  {"zstep render: there is no option --sise", "did you mean --size?"});
  check_complaint(folder, "render teapot --save-id=x.npy", {"no option --save-id", "did you mean --save-ids?"});
  check_complaint(folder, "render teapot -x", {"there is no option -x"});
  check_complaint(folder, "--colour", {"zstep: there is no option --colour", "'zstep --help' names them"});
  check_complaint(folder, "render teapt",
                  {"teapt: there is no such file and no built-in scene", "did you mean teapot?"});
  check_complaint(folder, "record pyramd -o run.ztrace", {"did you mean pyramid?"});
  check_complaint(folder, "render xyzzy", {"'zstep list scenes'"});
  check_complaint(folder, "render nothing.obj", {"nothing.obj: there is no such file"});
  check_complaint(folder, "render teapot --depth veiw", {"--depth: 'veiw' is not pseudodepth", "did you mean view?"});
  check_complaint(folder, "render teapot --coverage all", {"--coverage: 'all' is not", "top-left", "ceil-floor"});
  check_complaint(folder, "render teapot --algorithm zbuffer",
                  {"--algorithm: 'zbuffer' is not", "did you mean z-buffer?"});
  check_complaint(folder, "list lesons", {"did you mean lessons?"});
  check_complaint(folder, "lesson z-bufer --screenshot a.png",
                  {"z-bufer: there is no such lesson", "did you mean z-buffer"});
  check_complaint(folder, "completion tcsh", {"'tcsh' is not bash, zsh or fish"});
}

TEST_CASE("numbers that are none, and impossible ones, are said to be so") {
  const Folder folder;
  check_complaint(folder, "render pyramid --rho far", {"--rho: 'far' is not a number"});
  check_complaint(folder, "render pyramid --rho 4m", {"--rho: '4m' is not a number"});
  check_complaint(folder, "render pyramid --theta nan", {"--theta: 'nan' is not a number"});
  check_complaint(folder, "render pyramid --phi 1e999", {"--phi: '1e999' is not a finite number"});
  check_complaint(folder, "render pyramid --size 640", {"--size: '640' is not WIDTHxHEIGHT", "--size 640x480"});
  check_complaint(folder, "render pyramid --size 0x10", {"--size: '0x10' is not WIDTHxHEIGHT"});
  check_complaint(folder, "render pyramid --size -4x4", {"--size"});
  check_complaint(folder, "render pyramid --size 99999999999x4", {"--size"});
  check_complaint(folder, "render pyramid --size 1000000x1000000", {"1000000"});
  check_complaint(folder, "render pyramid --near 5 --far 2", {"near"});
  check_complaint(folder, "render pyramid --rho 0", {"rho"});
  check_complaint(folder, "render pyramid --window 0", {"window"});
  check_complaint(folder, "render pyramid --enlarge 0", {"--enlarge: '0'"});
  check_complaint(folder, "render pyramid --enlarge 999999", {"--enlarge"});
}

TEST_CASE("what is missing is named, with the way to the help") {
  const Folder folder;
  check_complaint(folder, "record", {"zstep record", "required", "'zstep record --help'"});
  check_complaint(folder, "record teapot -o", {"zstep record: -o needs a value", "write -o FILE.ztrace"});
  check_complaint(folder, "render teapot --save --size 8x8", {"--save needs a value"});
  check_complaint(folder, "render teapot --rho 1 --rho=2", {"--rho is given twice"});
  check_complaint(folder, "info", {"zstep info", "required"});
  check_complaint(folder, "import run.jsonl", {"zstep import", "-o", "required"});
  check_complaint(folder, "render teapot pyramid", {"zstep render", "pyramid"});
  check_complaint(folder, "info none.ztrace", {"none.ztrace: there is no such file"});
}

TEST_CASE("angles may be negative") {
  const Folder folder;
  const Outcome outcome = run(folder, "render pyramid --theta -30 --phi 60 --size 16x16");
  CHECK(outcome.err.empty());
  CHECK(outcome.code == 0);
  CHECK(run(folder, "render pyramid --theta=-30 --phi 60 --size 16x16 --save b.png").code == 0);
  CHECK(text_of(folder / "pyramid.png") == text_of(folder / "b.png"));
}

TEST_CASE("whatever an argument holds, a complaint is one line") {
  const Folder folder, other;
  REQUIRE(run(other, "record delhi -o run.ztrace").code == 0);
  const std::string trace = "'" + (other / "run.ztrace").string() + "' ";
  for (const std::string& arguments : std::vector<std::string>{"find " + trace + "'z <\n'",
                                                               "find " + trace + "'z <\r3 +'",
                                                               "find " + trace + "'frame(1,\n99999)'",
                                                               "render delhi --change 'theta =\nx'",
                                                               "render delhi --change 'no\nthing = 3'",
                                                               "query " + trace + "'select \n nothing from nowhere'",
                                                               "query " + trace + "'drop\ntable x'",
                                                               "why-not " + trace + "'A\nB'",
                                                               "history " + trace + "'3\n' 3",
                                                               "explain " + trace + "'3\n4'",
                                                               "render 'no\nscene'",
                                                               "render 'no\nscene.toml'",
                                                               "info 'a\nb.ztrace'",
                                                               "render 'y = sin(\nx'",
                                                               "render delhi --size '3\n4'",
                                                               "render delhi --algorithm 'z\nb'",
                                                               "render delhi --option 'a\n=b'",
                                                               "render delhi --save 'none\n/a.png'",
                                                               "'re\nnder'",
                                                               "render delhi '--si\nze'",
                                                               "lesson 'z\nb'",
                                                               "grade --homework 'h\nw' x",
                                                               "list 'a\nb'",
                                                               "check 'a\nb.jsonl'",
                                                               "import 'a\nb.jsonl' -o c.ztrace"}) {
    CAPTURE(arguments);
    const Outcome outcome = run(folder, arguments);
    CAPTURE(outcome.err);
    CHECK(outcome.code == 2);
    CHECK(times(outcome.err, "\n") == 1);
    CHECK_FALSE(has(outcome.err, "\r"));
    CHECK_FALSE(has(outcome.out, "\r"));
  }
  // Several mistakes of one file are a line each, whatever its name.
  write_text(other / "a\nb.jsonl", "{\"zstep\": 1}\n{\n[\n");
  const Outcome outcome = run(other, "info 'a\nb.jsonl'");
  CHECK(outcome.code == 2);
  CHECK(times(outcome.err, "\n") == times(outcome.err, "a\\nb.jsonl:"));
}

TEST_CASE("outputs that cannot be written are refused before the work, and nothing is left behind") {
  const Folder folder;
  check_complaint(folder, "render pyramid --save none/a.png", {"none/a.png: there is no folder none"});
  check_complaint(folder, "record pyramid -o none/run.ztrace", {"none/run.ztrace: there is no folder none"});
  check_complaint(folder, "record pyramid -o run.ztrace --save-ids none/a.npy",
                  {"none/a.npy: there is no folder none"});
  check_complaint(folder, "render pyramid --save .", {"is a folder"});
  check_complaint(folder, "render pyramid --save a.png --save-ids ./a.png", {"is asked for twice"});
  if (std::filesystem::exists("/dev/full")) {
    for (const std::string command : {"render pyramid --save /dev/full", "record pyramid -o /dev/full"}) {
      const Outcome outcome = run(folder, command);
      CHECK(outcome.code == 4);
      CHECK(outcome.err.find("/dev/full: ") == 0);
      CHECK(times(outcome.err, "\n") == 1);
    }
  }
}

TEST_CASE("an output never overwrites its input") {
  const Folder folder;
  const std::string triangle = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
  write_text(folder / "a.obj", triangle);
  for (const std::string option : {"render a.obj --save a.obj", "record a.obj -o a.obj", "record a.obj -o ./a.obj"}) {
    const Outcome outcome = run(folder, option);
    CHECK(outcome.code == 2);
    CHECK(outcome.err.find("would overwrite the input") != std::string::npos);
    CHECK(text_of(folder / "a.obj") == triangle);
  }
  CHECK(folder.names().size() == 1);
}
