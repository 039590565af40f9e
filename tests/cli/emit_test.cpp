// zstep emit: in every language that is installed here, a program that prints a run by the file, and what check says of
// it.
#include <doctest/doctest.h>

#include <sstream>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "tests/cli/program.hpp"

using namespace zstep::test;
using nlohmann::json;

namespace {

struct InLanguage {
  const char *id, *file, *needs, *program;
  const char* build;  ///< then ./run prints
  const char* off;    ///< the same, switched off
};

// The compare stands in each program's sixth line.
const std::vector<InLanguage> programs{
    {"c", "zstep.h", "cc --version",
     "#include \"zstep.h\"\nint main(void) {\n  zstep_header(0);\n  zstep_clear(INFINITY);\n"
     "  zstep_polygon(0, 0);\n  zstep_compare(1, 2, 5.0, 1);\n  zstep_write_depth(1, 2, 5.0);\n"
     "  zstep_write_pixel(1, 2, 0);\n  zstep_skip_edge(0, 1, \"horizontal\");\n  return 0;\n}\n",
     "cc -std=c99 -Wall -Wextra -Wpedantic -Werror $OFF -o run main.c -lm", "OFF=-DZSTEP_OFF"},
    {"cpp", "zstep.hpp", "c++ --version",
     "#include \"zstep.hpp\"\nint main() {\n  zstep::header();\n  zstep::clear(INFINITY);\n"
     "  zstep::polygon(0, 0);\n  zstep::compare(1, 2, 5.0, true);\n  zstep::write_depth(1, 2, 5.0);\n"
     "  zstep::write_pixel(1, 2, 0);\n  zstep::skip_edge(0, 1, \"horizontal\");\n}\n",
     "c++ -std=c++11 -Wall -Wextra -Wpedantic -Wconversion -Wshadow -Werror $OFF -o run main.cpp", "OFF=-DZSTEP_OFF"},
    {"python", "zstep.py", "python3 --version",
     "import math, os\nimport zstep\nzstep.on = 'OFF' not in os.environ\nzstep.header(); zstep.clear(math.inf)\n"
     "zstep.polygon(0, 0)\nzstep.compare(1.0, 2, 5, 1)\nzstep.write_depth(1, 2, 5.0)\n"
     "zstep.write_pixel(1, 2, 0)\nzstep.skip_edge(0, 1, 'horizontal')\n",
     "printf '#!/bin/sh\\npython3 main.py' > run && chmod +x run", "export OFF=1"},
    {"js", "zstep.js", "node --version",
     "const zstep = require('./zstep.js');\nif (process.env.OFF) zstep.on = false;\nzstep.header();\n"
     "zstep.clear(Infinity);\nzstep.polygon(0, 0);\nzstep.compare(1, 2, 5, true);\nzstep.write_depth(1, 2, 5);\n"
     "zstep.write_pixel(1, 2, 0);\nzstep.skip_edge(0, 1, 'horizontal');\n",
     "printf '#!/bin/sh\\nnode main.js' > run && chmod +x run", "export OFF=1"},
    {"java", "Zstep.java", "javac --version",
     "final class Main {\n  public static void main(String[] arguments) {\n"
     "    if (System.getenv(\"OFF\") != null) Zstep.on = false;\n    Zstep.header(); "
     "Zstep.clear(Double.POSITIVE_INFINITY);\n"
     "    Zstep.polygon(0, 0);\n    Zstep.compare(1, 2, 5.0, true);\n    Zstep.writeDepth(1, 2, 5.0);\n"
     "    Zstep.writePixel(1, 2, 0);\n    Zstep.skipEdge(0, 1, \"horizontal\");\n  }\n}\n",
     "javac -Xlint:all -Werror Main.java Zstep.java && printf '#!/bin/sh\\njava Main' > run && chmod +x run",
     "export OFF=1"},
    {"rust", "zstep.rs", "rustc --version",
     "mod zstep;\nfn main() {\n    zstep::header_given();\n    zstep::clear(f64::INFINITY);\n"
     "    zstep::polygon(0, 0);\n    zstep::compare(1, 2, 5.0, true);\n    zstep::write_depth(1, 2, 5.0);\n"
     "    zstep::write_pixel(1, 2, 0);\n    zstep::skip_edge(0, 1, \"horizontal\");\n}\n",
     "rustc --edition 2021 -D warnings -o run main.rs", "export ZSTEP_OFF=1"},
};

std::string main_of(const InLanguage& language) {
  const std::string extension = std::string(language.file).substr(std::string(language.file).find('.'));
  return language.id == std::string("java")  ? "Main.java"
         : language.id == std::string("c")   ? "main.c"
         : language.id == std::string("cpp") ? "main.cpp"
                                             : "main" + extension;
}

}  // namespace

TEST_CASE("emit: in each language a program prints a run that check takes, with the lines that printed it") {
  for (const InLanguage& language : programs) {
    CAPTURE(language.id);
    const Folder folder;
    if (shell(folder, language.needs).code != 0) {
      MESSAGE("not run, as it is not installed: " << language.needs);
      continue;
    }
    const Outcome made = run(folder, std::string("emit ") + language.id + " delhi -o .");
    CAPTURE(made.err);
    REQUIRE(made.code == 0);
    CHECK(has(made.out, std::string("wrote ./") + language.file + ": for "));
    CHECK(folder.names() == std::vector<std::string>{language.file});
    const std::string main = main_of(language);
    write_text(folder / main, language.program);
    const Outcome built = shell(folder, std::string(language.build) + " && ./run > run.jsonl");
    CAPTURE(built.err);
    CAPTURE(built.out);
    REQUIRE(built.code == 0);
    const std::string printed = text_of(folder / "run.jsonl");
    CAPTURE(printed.substr(printed.find('\n') + 1));
    const Outcome checked = run(folder, "check run.jsonl");
    CAPTURE(checked.out);
    CAPTURE(checked.err);
    CHECK(checked.code == 0);
    CHECK(has(checked.out, "run.jsonl: 6 steps"));
    // What was printed, and by which line.
    std::istringstream lines(printed);
    std::string line;
    std::vector<json> steps;
    while (std::getline(lines, line)) steps.push_back(json::parse(line));
    REQUIRE(steps.size() == 7);
    CHECK(steps[0] == json::parse(run(folder, "header delhi").out));
    CHECK(steps[1]["z"] == "inf");
    CHECK(steps[3] == json{{"step", "compare"}, {"x", 1}, {"y", 2}, {"z", 5.0}, {"nearer", true}, {"at", main + ":6"}});
    CHECK(steps[6]["why"] == "horizontal");
    CHECK(steps[6]["at"] == main + ":9");
    // A mistake is told with the line of the program.
    const Outcome wrong =
        shell(folder, "sed 's/\\(\"z\": *\\)5\\(.0\\)\\{0,1\\}\\(, *\"at\"\\)/\\16\\3/' run.jsonl | $zstep check -");
    CHECK(has(wrong.out, "printed at " + main + ":7: write_depth, pixel (1, 2)"));
    // Switched off it prints nothing.
    const Outcome off = shell(folder, std::string(language.off) + "; " + language.build + " && ./run");
    CAPTURE(off.err);
    CHECK(off.code == 0);
    CHECK(off.out.empty());
  }
}

TEST_CASE("emit: the header is read from a file that zstep header wrote, and what is not there is said") {
  for (const InLanguage& language : programs) {
    CAPTURE(language.id);
    const Folder folder;
    if (shell(folder, language.needs).code != 0) continue;
    REQUIRE(
        shell(folder, std::string("$zstep emit ") + language.id + " -o . && $zstep header delhi -o head.jsonl").code ==
        0);
    std::string program = language.program;
    const std::string id = language.id;
    const std::string given = id == "rust" ? "header_given()" : id == "c" ? "header(0)" : "header()";
    const auto with = [&](const std::string& file) {
      std::string text = program;
      text.replace(text.find(given), given.size(), "header(\"" + file + "\")");
      if (id == "java") text.replace(text.find("arguments)"), 10, "arguments) throws Exception");
      write_text(folder / main_of(language), text);
      return shell(folder, std::string(language.build) + " && ./run");
    };
    const Outcome right = with("head.jsonl");
    CAPTURE(right.err);
    CHECK(right.code == 0);
    CHECK(right.out.substr(0, right.out.find('\n') + 1) == text_of(folder / "head.jsonl"));
    const Outcome wrong = with("none.jsonl");
    CHECK(wrong.code != 0);
    CHECK(has(wrong.err, "none.jsonl"));
  }
}

TEST_CASE("emit: of every method there is a file in every language that compiles") {
  const Folder folder;
  const std::string methods = run(folder, "list methods").out;
  std::istringstream in(methods);
  int count = 0;
  for (std::string line; std::getline(in, line); ++count) {
    const std::string method = line.substr(2, line.find(' ', 2) - 2);
    CAPTURE(method);
    REQUIRE(shell(folder, "rm -rf e; mkdir e; for l in c cpp python js java rust; do $zstep emit $l --algorithm " +
                              method + " -o e > /dev/null || exit 1; done")
                .code == 0);
    for (const std::string compiles :
         {"cc -std=c99 -Wall -Wextra -Wpedantic -Werror -fsyntax-only -include e/zstep.h -x c /dev/null",
          "c++ -std=c++11 -Wall -Wextra -Wpedantic -Wshadow -Werror -fsyntax-only -include e/zstep.hpp -x c++ "
          "/dev/null",
          "python3 -c 'import sys; sys.path.insert(0, \"e\"); import zstep'", "node --check e/zstep.js",
          "javac -d e e/Zstep.java",
          "rustc --edition 2021 -D warnings --crate-type lib --emit metadata -o e/m e/zstep.rs"}) {
      CAPTURE(compiles);
      if (shell(folder, compiles.substr(0, compiles.find(' ')) + " --version").code != 0) continue;
      const Outcome outcome = shell(folder, compiles);
      CAPTURE(outcome.err);
      CHECK(outcome.code == 0);
    }
  }
  CHECK(count >= 10);
}

TEST_CASE("emit: what is wrong is said, and nothing is written") {
  const Folder folder;
  for (const auto& one :
       {std::pair("emit cobol -o .", "zstep emit: 'cobol' is not c, python, js, java, cpp or rust"),
        std::pair("emit pyton -o .", "did you mean python?"),
        std::pair("emit python --size 3x3 -o .", "--size: is of a scene; name the scene behind the language"),
        std::pair("emit python nowhere.toml -o .", "nowhere.toml"), std::pair("emit python -o none", "none"),
        std::pair("emit python", "--output is required")}) {
    const std::string typed = one.first;
    const Outcome refused = run(folder, typed);
    CAPTURE(typed);
    CAPTURE(refused.err);
    CHECK(refused.code == 2);
    CHECK(has(refused.err, one.second));
    CHECK(folder.names().empty());
  }
}
