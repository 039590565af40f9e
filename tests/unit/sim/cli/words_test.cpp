// Words of a command line.
#include <doctest/doctest.h>

#include <string>
#include <vector>

#include "sim/cli/table.hpp"
#include "sim/cli/words.hpp"
#include "traces/error.hpp"

using namespace zstep::cli;

TEST_CASE("the nearest word is the one a typist meant") {
  const std::vector<std::string> known{"render", "record",        "info",   "list",
                                       "--size", "--size-window", "--save", "--save-ids"};
  CHECK(nearest("redner", known) == "render");
  CHECK(nearest("recod", known) == "record");
  CHECK(nearest("RENDER", known) == "render");
  CHECK(nearest("lsit", known) == "list");
  CHECK(nearest("--sise", known) == "--size");
  CHECK(nearest("-size", known) == "--size");
  CHECK(nearest("--save-idz", known) == "--save-ids");
  CHECK(nearest("rec", known) == "record");
  CHECK(nearest("banana", known).empty());
  CHECK(nearest("", known).empty());
  CHECK(nearest(std::string(100000, 'r'), known).empty());
  CHECK(did_you_mean("inof", known, "x") == "did you mean info?");
  CHECK(did_you_mean("zzz", known, "x") == "x");
}

TEST_CASE("numbers are read whole or not at all") {
  CHECK(parse_number("--d", "-2.5e1") == -25.0);
  CHECK(parse_number("--d", ".5") == 0.5);
  for (const std::string text : {"", " 1", "1 ", "1,5", "abc", "inf", "nan", "0x", "1e400", "--"}) {
    CAPTURE(text);
    CHECK_THROWS_AS(parse_number("--d", text), zstep::InputError);
  }
  CHECK(parse_whole("--at", "0", 0) == 0);
  CHECK(parse_whole("--at", "100000000000", 0) == 100000000000);
  for (const std::string text : {"", "-1", "1.0", "99999999999999999999"})
    CHECK_THROWS_AS(parse_whole("--at", text, 0), zstep::InputError);
  CHECK_THROWS_AS(parse_whole("--from", "0", 1), zstep::InputError);
  CHECK(parse_size("--size", "640x480")[1] == 480);
  CHECK(parse_size("--size", "1X2")[0] == 1);
  for (const std::string text : {"", "x", "4x", "x4", "4x4x4", "0x4", "4*4", "2147483648x1"})
    CHECK_THROWS_AS(parse_size("--size", text), zstep::InputError);
}

TEST_CASE("words and numbers for people") {
  CHECK(grouped(0) == "0");
  CHECK(grouped(999) == "999");
  CHECK(grouped(1000) == "1 000");
  CHECK(grouped(-1234567) == "-1 234 567");
  CHECK(counted(1, "step", "steps") == "1 step");
  CHECK(counted(12041, "step", "steps") == "12 041 steps");
  CHECK(enumerate(std::vector<std::string>{"a"}) == "a");
  CHECK(enumerate(std::vector<std::string>{"a", "b"}) == "a or b");
  CHECK(enumerate(std::vector<std::string>{"a", "b", "c"}, "and") == "a, b and c");
}

TEST_CASE("a table is as wide as its cells, counted in characters") {
  Table table({Table::Align::left, Table::Align::right});
  table.row({"name", "n"});
  table.row({"Größe", "12"});
  CHECK(table.text(1) == " name    n\n Größe  12\n");
}
