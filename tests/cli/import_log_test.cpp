// zstep import --as: the lines of a program's log become the steps of a run.
#include <doctest/doctest.h>

#include <string>

#include "tests/cli/program.hpp"

using namespace zstep::test;

namespace {

const std::string as_compare = "import log --as compare --scene delhi ";

std::string without_header(const std::string& run) { return run.substr(run.find('\n') + 1); }

const std::string steps =
    R"({"step":"polygon","polygon":0,"facet":0}
{"step":"compare","x":1,"y":2,"z":5.0,"nearer":true}
{"step":"compare","x":2,"y":2,"z":5.0,"nearer":true}
{"step":"polygon","polygon":1,"facet":1}
{"step":"compare","x":1,"y":2,"z":6.5,"nearer":false}
)";

}  // namespace

TEST_CASE("import --as: columns between commas, semicolons or spaces, with names or without, are the same run") {
  const Folder folder;
  for (const char* log : {"1,2,5,0\n2,2,5,0\n1,2,6.5,1\n", "1;2;5;0\r\n2;2;5;0\r\n1;2;6.5;1\r\n",
                          "# mine\n\n 1 2  5.0 0\n2\t2\t5\t0\n1 2 6.5 1",
                          "x=1 y=2 z=5 polygon=0\nx=2 y=2 z=5 polygon=0\nx=1 y=2 z=6.5 polygon=1\n",
                          "column,row,depth,which\n1,2,5,0\n2,2,5,0\n1,2,6.5,1\n"}) {
    CAPTURE(log);
    write_text(folder / "log", log);
    const Outcome made = run(folder, as_compare + "--columns x,y,z,polygon");
    CAPTURE(made.err);
    CHECK(made.code == 0);
    CHECK(without_header(made.out) == steps);
    CHECK(made.err == "note: the log has no column nearer: each is what the depths before it give (<)\n");
  }
  write_text(folder / "log", "polygon,t,z,y,x,nearer\n0,9,5,2,1,1\n0,9,5,2,2,true\n1,9,6.5,2,1,0\n");
  CHECK(has(run(folder, as_compare).err,
            "log:1: compare has no field 't'; it has polygon, x, y, z and nearer; a column"));
  const Outcome named = run(folder, as_compare + "--columns polygon,_,z,y,x,nearer");
  CHECK(without_header(named.out) == steps);
  CHECK(named.err.empty());
}

TEST_CASE("import --as: the run is written, checked and read from standard input") {
  const Folder folder;
  write_text(folder / "log", "x y z polygon\n1 2 5 0\n2 2 5 0\n1 2 6.5 1\n");
  const Outcome made = run(folder, as_compare + "-o run.jsonl");
  CHECK(made.code == 0);
  CHECK(has(made.out, "wrote run.jsonl: 5 steps"));
  CHECK(without_header(text_of(folder / "run.jsonl")) == steps);
  CHECK(run(folder, as_compare + "-o run.ztrace").code == 0);
  CHECK(without_header(run(folder, "dump run.ztrace --jsonl").out) == steps);
  CHECK(has(run(folder, "check run.jsonl").out, "run.jsonl: 5 steps"));
  CHECK(without_header(shell(folder, "$zstep import - --as compare --scene delhi < log").out) == steps);
  // Another step of another method, whose words are its own.
  write_text(folder / "log", "0 1 horizontal\n1 2 between_rows\n");
  CHECK(has(run(folder, "import log --as skip_edge --columns vertex_0,vertex_1,why --scene delhi").out,
            "{\"step\":\"skip_edge\",\"vertex_0\":1,\"vertex_1\":2,\"why\":\"between_rows\"}\n"));
}

TEST_CASE("import --as: each bad line is told with its place and its cure, and nothing is written") {
  const Folder folder;
  write_text(folder / "run.jsonl", "before");
  const auto error = [&](const std::string& log, const std::string& options = "--columns x,y,z,polygon") {
    write_text(folder / "log", log);
    const Outcome made = run(folder, as_compare + options + " -o run.jsonl");
    CHECK(made.code == 2);
    CHECK(text_of(folder / "run.jsonl") == "before");
    CHECK(folder.names() == std::vector<std::string>{"log", "run.jsonl"});
    return made.err;
  };
  CHECK(
      error("1,2,5,0\n1,2,5\n1,2,z,0\n1.5,2,5,0\n900,2,5,0\n1,2,5,77\nhello\n") ==
      "log:2: the line: has 3 columns, not 4; print the same columns in each line, or leave this one out of the log\n"
      "log:3: z: 'z' is no number; write it with a point, as 0.25, or as inf\n"
      "log:4: x: '1.5' is no whole number; count from 0, and print it with %d\n"
      "log:5: x: column 900 lies outside the raster; it must be one of the scene's, numbered from 0\n"
      "log:6: polygon: there is no polygon 77; the scene has 2 polygons, numbered from 0\n"
      "log:7: the line: has 1 column, not 4; print the same columns in each line, or leave this one out of the log\n");
  std::string many;
  for (int line = 0; line < 20; ++line) many += "1\n";
  CHECK(times(error(many), "\n") == 11);
  CHECK(has(error(many), "log: there may be more mistakes; mend these first\n"));
  CHECK(error("", "--columns x,y,z") == "log: has no line with a step; print one line a step, as: 12 7 0.25 3\n");
  CHECK(error("1,2,3\n", "") ==
        "log:1: does not name the columns; name them with --columns, as --columns x,y,z,polygon, or in the log's first "
        "line\n");
  CHECK(has(error("1,2\n", "--columns x,y"), "--columns: lacks 'z', the new depth; print it, too"));
  CHECK(has(error("1,2\n", "--columns x,x,y,z"), "--columns: names 'x' twice"));
  CHECK(has(error("1,2\n", "--columns x,yy,z"), "--columns: compare has no field 'yy'; did you mean y?"));
  CHECK(has(error(std::string(5000, '1')), "log:1: is longer than 4096 characters"));
  write_text(folder / "log", "1,2,5,0\n");
  for (const auto& one :
       {std::pair("import log --as comapre --columns x,y,z --scene delhi",
                  "--as: Z-buffer has no step 'comapre'; did you mean compare?"),
        std::pair("import log --as compare", "zstep import: needs the scene that the log is of; add --scene SCENE"),
        std::pair("import log --columns x,y", "--columns: is of a log; say which step its lines are: add --as compare"),
        std::pair("import log", "zstep import: --output is required; name the trace: -o FILE.ztrace"),
        std::pair("import log --size 3x3 -o a.ztrace", "--size: is of a log")}) {
    const Outcome refused = run(folder, one.first);
    CHECK(refused.code == 2);
    CHECK(has(refused.err, one.second));
  }
}
