// zstep header: what it is told is declared, and what reads the line goes by it.
#include <doctest/doctest.h>

#include <string>

#include <nlohmann/json.hpp>

#include "tests/cli/program.hpp"

using namespace zstep::test;

namespace {

nlohmann::json head_of(const Folder& folder, const std::string& options) {
  const Outcome outcome = run(folder, "header " + options);
  CAPTURE(outcome.err);
  REQUIRE(outcome.code == 0);
  return nlohmann::json::parse(outcome.out);
}

TEST_CASE("header: each option is declared as it is given, and nothing else changes") {
  const Folder folder;
  const auto plain = head_of(folder, "delhi");
  CHECK(plain["writer"] == "a program");
  const auto& usual = plain["conventions"];
  CHECK(usual["nearer"] == "smaller");
  CHECK(usual["ties"] == "first");
  CHECK(usual["number_format"] == "float64");
  CHECK(!usual.contains("initial_depth"));

  const auto given =
      head_of(folder, "delhi --writer mine --nearer greater --ties last --initial-depth -3 --coverage ceil-floor");
  CHECK(given["writer"] == "mine");
  auto expected = usual;
  expected["nearer"] = "greater", expected["ties"] = "last", expected["initial_depth"] = -3.0;
  expected["coverage"] = "ceil_floor";
  CHECK(given["conventions"] == expected);
  CHECK(given["scene"] == plain["scene"]);
  CHECK(given["steps"] == plain["steps"]);
  CHECK(head_of(folder, "delhi --nearer smaller --ties first") == plain);

  // Which depth is nearer goes by --depth, unless it is said.
  CHECK(head_of(folder, "pyramid --depth reversed")["conventions"]["nearer"] == "greater");
  CHECK(head_of(folder, "pyramid --depth reversed --nearer smaller")["conventions"]["nearer"] == "smaller");
  CHECK(head_of(folder, "pyramid --positions integer")["conventions"]["positions"] == "integer");

  CHECK(head_of(folder, "delhi --as-computed")["conventions"]["number_format"] == "as computed");
  CHECK(run(folder, "header delhi --as-computed --number-format float32").code == 2);
  CHECK(run(folder, "header delhi --ties second").code == 2);
}

TEST_CASE("header: a run goes by it, and what it leaves out is not declared") {
  const Folder folder;
  const auto info = [&](const std::string& options) {
    write_text(folder / "run.jsonl", run(folder, "header delhi " + options).out +
                                         "{\"step\":\"compare\",\"x\":1,\"y\":1,\"z\":5,\"nearer\":true}\n");
    return run(folder, "info run.jsonl").out;
  };
  CHECK(times(info("--nearer greater"), "the greater depth wins") == 1);
  CHECK(times(info("--ties last"), "of equal depths the last") == 1);
  CHECK(times(info("--as-computed"), "not declared") == 1);
  CHECK(times(info(""), "not declared") == 0);
}

}  // namespace

TEST_CASE("header: what a scene or an option says of depths is declared, and a method that does not have it says so") {
  const Folder folder;
  write_text(folder / "s.toml",
             "[camera]\nrho = 8\nnear = 2\nfar = 20\n[options]\nties = \"last\"\ninitial_depth = \"far\"\ndepth = "
             "\"zero_to_one\"\n[[polygon]]\npoints = [[0, -1, -1], [0, 1, -1], [0, 0, 1]]\n");
  const auto conventions = head_of(folder, "s.toml")["conventions"];
  CHECK(conventions["ties"] == "last");
  CHECK(conventions["initial_depth"] == 1);
  CHECK(head_of(folder, "s.toml --ties first")["conventions"]["ties"] == "first");
  CHECK(run(folder, "record s.toml -o s.ztrace").code == 0);
  CHECK(run(folder, "info s.ztrace").out.find("options        initial-depth=far, ties=last") != std::string::npos);
  CHECK(run(folder, "check s.ztrace").code == 0);
  const Outcome refused = run(folder, "render s.toml --algorithm bsp --depth pseudodepth");
  CHECK(refused.code == 2);
  CHECK(refused.err.find("s.toml: its [options] ask for initial-depth = far, which bsp does not have") == 0);
}
