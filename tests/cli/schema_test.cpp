// run.schema.json: what it demands of a line, and that what programs print has it.
#include <doctest/doctest.h>

#include <algorithm>
#include <set>
#include <sstream>
#include <string>

#include <nlohmann/json.hpp>

#include "tests/cli/program.hpp"

using namespace zstep::test;
using nlohmann::json;

namespace {

bool is_of(const json& value, const json& schema) {
  if (schema.contains("anyOf"))
    return std::any_of(schema["anyOf"].begin(), schema["anyOf"].end(),
                       [&](const json& one) { return is_of(value, one); });
  if (schema.contains("const")) return value == schema["const"];
  if (schema.contains("enum"))
    return std::find(schema["enum"].begin(), schema["enum"].end(), value) != schema["enum"].end();
  const std::string type = schema["type"];
  if (type == "integer")
    return value.is_number() && value.get<double>() == static_cast<double>(static_cast<long>(value.get<double>()));
  return type == "boolean"  ? value.is_boolean()
         : type == "number" ? value.is_number()
         : type == "string" ? value.is_string()
                            : value.is_object();
}
/// As far as run.schema.json goes: types, words, required members, and no others.
bool holds(const json& schema, const json& line) {
  if (!line.is_object()) return false;
  if (line.contains("ztrace")) {
    const json& known = schema["$defs"]["header"]["properties"]["conventions"]["properties"];
    const json conventions = line.value("conventions", json::object());
    return line["ztrace"] == 1 &&
           std::all_of(conventions.items().begin(), conventions.items().end(), [&](const auto& one) {
             return known.contains(one.key()) && is_of(one.value(), known[one.key()]);
           });
  }
  if (!line.contains("step") || !is_of(line["step"], schema["$defs"]["any_step"]["properties"]["step"])) return false;
  const json& step = schema["$defs"][line["step"].get<std::string>()];
  for (const json& name : step["required"])
    if (!line.contains(name.get<std::string>())) return false;
  for (const auto& item : line.items())
    if (!step["properties"].contains(item.key()) || !is_of(item.value(), step["properties"][item.key()])) return false;
  return true;
}

}  // namespace

TEST_CASE("schema: each line of a right run holds, and what zstep refuses does not") {
  const Folder folder;
  REQUIRE(run(folder, "homework new z-buffer hw").code == 0);
  const json schema = json::parse(text_of(folder / "hw/starter/run.schema.json"));
  const Outcome made = shell(folder,
                             "$zstep record hw/scenes/crossing.toml -o a.ztrace && "
                             "$zstep dump a.ztrace --jsonl | grep -v outline > a.jsonl");
  REQUIRE(made.code == 0);
  std::istringstream lines(text_of(folder / "a.jsonl"));
  std::set<std::string> seen;
  int count = 0;
  for (std::string line; std::getline(lines, line); ++count) {
    const json one = json::parse(line);
    CAPTURE(line);
    CHECK(holds(schema, one));
    if (one.contains("step")) seen.insert(one["step"].get<std::string>());
  }
  CHECK(count > 300);
  // (The outline of a polygon is zstep's own to print.) The schema knows all steps that the homework asks for, and no
  // others.
  std::set<std::string> known;
  for (const json& name : schema["$defs"]["any_step"]["properties"]["step"]["enum"]) known.insert(name);
  for (const std::string& step : seen) CHECK(known.contains(step));
  CHECK(known.size() == schema["$defs"].size() - 2);
  CHECK(known.size() == 13);

  const std::string right = R"({"step":"compare","x":3,"y":2,"z":0.5,"nearer":true})";
  std::string all;
  struct Case {
    const char *from, *to;
    bool good;
  };
  const Case cases[] = {
      {"3", "3", true},
      {"0.5", "\"inf\"", true},
      {"3", "3.0", true},
      {"3", "3.5", false},
      {"3", "\"3\"", false},
      {"true", "1", false},
      {"0.5", "\"far\"", false},
      {"\"x\":3,", "", false},
      {"\"x\"", "\"X\"", false},
      {"compare", "comp", false},
      {"0.5", "0.5,\"w\":1", false},
      {"0.5", "null", false},
      {"true", "true,\"at\":\"a.c:1\"", true},
      {"true", "true,\"at\":7", false},
  };
  const auto changed = [&](const Case& one) {
    std::string line = right;
    return line.replace(line.find(one.from), std::string(one.from).size(), one.to);
  };
  for (const Case& one : cases) {
    const std::string line = changed(one);
    CAPTURE(line);
    CHECK(holds(schema, json::parse(line)) == one.good);
    // And so does zstep.
    write_text(folder / "crossing.jsonl", line + "\n");
    CHECK((run(folder, "grade --homework hw crossing.jsonl --scene crossing").code != 2) == one.good);
    all += line + "\n";
  }
  // The first line: each convention by its words.
  const std::string head = R"({"ztrace":1,"conventions":{"depth":"reversed","ties":"last","initial_depth":"-inf"}})";
  const Case heads[] = {
      {"reversed", "zero_to_one", true},
      {"reversed", "zero", false},
      {"\"last\"", "true", false},
      {"ties", "tie", false},
      {"-inf", "-Inf", false},
      {"\"-inf\"", "1", true},
      {"ties\":\"last", "number_format\":\"as computed", true},
      {"ties\":\"last\"", "cull\":false", true},
      {"ties\":\"last\"", "options\":{\"fill\":\"non-zero\"}", true},
  };
  for (const Case& one : heads) {
    std::string line = head;
    line.replace(line.find(one.from), std::string(one.from).size(), one.to);
    CAPTURE(line);
    CHECK(holds(schema, json::parse(line)) == one.good);
    all += line + "\n";
  }
  for (const char* options : {"pyramid --like opengl", "pyramid --like tinyrenderer --as-computed",
                              "pyramid --option fill=non-zero --initial-depth 1 --positions subpixels"})
    CHECK(holds(schema, json::parse(run(folder, std::string("header ") + options).out)));
  // Another program's judgement of the same lines.
  if (shell(folder, "python3 -c 'import jsonschema; jsonschema.Draft202012Validator'").code != 0) {
    MESSAGE("python3 has no jsonschema: not run");
    return;
  }
  write_text(folder / "cases.jsonl", all);
  write_text(folder / "judge.py",
             "import json, jsonschema\n"
             "schema = json.load(open('hw/starter/run.schema.json'))\n"
             "jsonschema.Draft202012Validator.check_schema(schema)\n"
             "judge = jsonschema.Draft202012Validator(schema)\n"
             "assert all(judge.is_valid(json.loads(line)) for line in open('a.jsonl'))\n"
             "print(''.join('01'[judge.is_valid(json.loads(line))] for line in open('cases.jsonl')))\n");
  const Outcome judged = shell(folder, "python3 judge.py");
  CAPTURE(judged.err);
  CHECK(judged.out == "11100000000010100001111\n");
}
