#include "tests/cli/result_rules.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <regex>
#include <set>
#include <vector>

#include <nlohmann/json.hpp>

#include "tests/cli/program.hpp"

namespace zstep::test {

using nlohmann::json;

namespace {

using Words = std::set<std::string>;

void check_keys(const json& object, const Words& allowed) {
  REQUIRE(object.is_object());
  for (const auto& item : object.items()) CHECK_MESSAGE(allowed.contains(item.key()), item.key());
}
void check_word(const json& object, const char* key, const Words& allowed) {
  if (!object.contains(key)) return;
  REQUIRE(object[key].is_string());
  CHECK_MESSAGE(allowed.contains(object[key].get<std::string>()), key, ": ", object[key].dump());
}
void check_texts(const json& object, const Words& keys) {
  for (const std::string& key : keys)
    if (object.contains(key)) CHECK_MESSAGE(object[key].is_string(), key);
}
/// A number, and no NaN that JSON writes as null.
double number_in(const json& object, const char* key) {
  CAPTURE(key);
  REQUIRE(object[key].is_number());
  const auto number = object[key].get<double>();
  CHECK(std::isfinite(number));
  return number;
}

const Words visible{"hidden", "after_due_date", "after_published", "visible"};
const Words formats{"text", "html", "simple_format", "md", "ansi"};

/// The number that an attribute of the test suite has.
int counted(const std::string& suite, const std::string& attribute) {
  std::smatch found;
  REQUIRE(std::regex_search(suite, found, std::regex(" " + attribute + "=\"([0-9]+)\"")));
  return std::stoi(found[1]);
}

/// The first tag that is not closed, or closes what was not opened last.
std::string not_closed(const std::string& page) {
  static const std::regex tag(R"(<(/?)([a-z][a-z0-9]*)[^>]*>)");
  const std::string alone = " meta br img ";
  std::vector<std::string> open;
  for (std::sregex_iterator at(page.begin(), page.end(), tag), end; at != end; ++at) {
    const std::string name = (*at)[2];
    if (has(alone, " " + name + " ")) continue;
    if ((*at)[1].length() == 0) {
      open.push_back(name);
    } else {
      if (open.empty() || open.back() != name) return "</" + name + ">";
      open.pop_back();
    }
  }
  return open.empty() ? "" : "<" + open.back() + ">";
}

}  // namespace

void check_gradescope(const std::string& text) {
  REQUIRE(json::accept(text));
  const json result = json::parse(text);
  check_keys(result, {"score", "execution_time", "output", "output_format", "test_output_format", "test_name_format",
                      "visibility", "stdout_visibility", "extra_data", "tests", "leaderboard"});
  CHECK((result.contains("score") || result.contains("tests")));  // at least one
  if (result.contains("score")) CHECK(number_in(result, "score") >= 0);
  if (result.contains("execution_time")) CHECK(number_in(result, "execution_time") >= 0);
  check_texts(result, {"output"});
  check_word(result, "output_format", formats);
  for (const char* key : {"visibility", "stdout_visibility"}) check_word(result, key, visible);
  if (result.contains("extra_data")) CHECK(result["extra_data"].is_object());
  if (!result.contains("tests")) return;
  REQUIRE(result["tests"].is_array());
  for (const json& test : result["tests"]) {
    check_keys(test, {"score", "max_score", "status", "name", "name_format", "number", "output", "output_format",
                      "tags", "visibility", "extra_data"});
    // Without a score of its own, the whole one needs each test's.
    if (!result.contains("score")) CHECK(test.contains("score"));
    if (test.contains("score")) CHECK(number_in(test, "score") <= number_in(test, "max_score") + 1e-12);
    check_texts(test, {"name", "number", "output"});
    check_word(test, "status", {"passed", "failed"});
    check_word(test, "output_format", formats);
    // One test that is hidden hides the points of all from the student.
    check_word(test, "visibility", {"visible"});
  }
}

void check_prairielearn(const std::string& text) {
  CHECK(text.size() < 1'000'000);
  REQUIRE(json::accept(text));
  const json result = json::parse(text);
  check_keys(result, {"gradable", "score", "message", "output", "images", "tests", "format_errors"});
  check_texts(result, {"message", "output"});
  if (result.contains("gradable")) REQUIRE(result["gradable"].is_boolean());
  if (result.value("gradable", true)) {
    const double score = number_in(result, "score");
    CHECK((score >= 0 && score <= 1));
  } else {
    REQUIRE(result["format_errors"].is_array());
    CHECK_FALSE(result["format_errors"].empty());
    for (const json& error : result["format_errors"]) CHECK(error.is_string());
  }
  for (const char* key : {"images"})
    if (result.contains(key))
      for (const json& image : result[key]) check_keys(image, {"url", "label"});
  if (!result.contains("tests")) return;
  REQUIRE(result["tests"].is_array());
  std::size_t with_points = 0;
  for (const json& test : result["tests"]) {
    check_keys(test, {"name", "description", "points", "max_points", "message", "output", "images"});
    check_texts(test, {"name", "description", "message", "output"});
    CHECK(test.contains("points") == test.contains("max_points"));
    if (!test.contains("points")) continue;
    ++with_points;
    CHECK(number_in(test, "points") <= number_in(test, "max_points") + 1e-12);
  }
  CHECK((with_points == 0 || with_points == result["tests"].size()));
}

void check_junit(const std::string& text) {
  CHECK(text.starts_with("<?xml"));
  CHECK(counted(text, "tests") == times(text, "<testcase "));
  CHECK(counted(text, "failures") == times(text, "<failure "));
  CHECK(counted(text, "errors") == times(text, "<error "));
  CHECK(times(text, "<testsuite ") == 1);
  CHECK(times(text, "<testcase ") == times(text, "</testcase>") + times(text, "/>"));
  for (std::size_t at = text.find('<'); at != std::string::npos; at = text.find('<', at + 1)) {
    const std::string tag = text.substr(at + 1, 20);
    const bool known = tag.starts_with("?xml ") || tag.starts_with("testsuite") || tag.starts_with("/testsuite") ||
                       tag.starts_with("testcase") || tag.starts_with("/testcase") || tag.starts_with("error ") ||
                       tag.starts_with("/error") || tag.starts_with("failure ") || tag.starts_with("/failure");
    CHECK_MESSAGE(known, tag);
  }
  for (std::size_t at = text.find('&'); at != std::string::npos; at = text.find('&', at + 1)) {
    const std::string entity = text.substr(at, text.find(';', at) + 1 - at);
    CHECK_MESSAGE((entity == "&lt;" || entity == "&gt;" || entity == "&amp;" || entity == "&quot;" ||
                   entity == "&apos;" || entity.starts_with("&#")),
                  entity);
  }
}

void check_page(const std::string& page) {
  CAPTURE(page);
  CHECK(page.starts_with("<!doctype html>\n<html lang=\"en\">"));
  CHECK(not_closed(page).empty());
  for (const char* never : {"<script", "src=\"http", "href=", "@import", "url(", "\x1b"}) CHECK_FALSE(has(page, never));
  CHECK(times(page, "<h1>") == 1);
  CHECK(times(page, "<img ") == times(page, "\" alt=\""));
  CHECK_FALSE(has(page, "alt=\"\""));
  CHECK(times(page, "<th>") == 0);
  CHECK(times(page, "<th ") == times(page, "<th scope="));
}

void check_result(const std::string& format, const std::string& text) {
  CAPTURE(format);
  if (format == "gradescope") check_gradescope(text);
  if (format == "prairielearn") check_prairielearn(text);
  if (format == "junit") check_junit(text);
  if (format == "html") check_page(text);
  if (format == "json") CHECK(json::accept(text));
}

}  // namespace zstep::test
