// Laws of grading, over all homeworks: points are missing where and only where a reason is given, and the reason stands
// in every report.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <set>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "sim/homework/assess.hpp"
#include "sim/homework/report_words.hpp"
#include "sim/homework/reports.hpp"
#include "tests/cli/homework_runs.hpp"
#include "tests/cli/program.hpp"
#include "traces/events/fields.hpp"
#include "traces/file/jsonl.hpp"

using namespace zstep;
using namespace zstep::test;
using nlohmann::json;
namespace fs = std::filesystem;

namespace {

const std::vector<std::string> with_homework{"z-buffer", "scan-line", "ray-casting",     "depth-sort",
                                             "bsp",      "warnock",   "floating-horizon"};

/// A new homework, with its right runs.
struct Set {
  Folder folder;
  homework::Homework given;
  homework::References references;
  explicit Set(const std::string& method) : given(made(folder, method)), references(given) {
    fs::create_directory(folder / "runs");
  }
  static homework::Homework made(const Folder& folder, const std::string& method) {
    REQUIRE(run(folder, "homework new " + method + " hw").code == 0);
    return homework::load_homework(folder / "hw");
  }
  /// Writes the right runs, each line as `changed` makes it; an empty one is left out.
  void write(const std::function<std::string(const RecordedEvent&, std::string)>& changed) const {
    for (const homework::Task& task : given.tasks) {
      const auto right = references.find(task, task.conventions);
      std::string text;
      right->each(0, right->size(), [&](std::int64_t, const RecordedEvent& recorded) {
        const std::string line = changed(recorded, jsonl_event(right->header(), right->scene(), recorded));
        if (!line.empty()) text += line + "\n";
        return true;
      });
      write_text(folder / ("runs/" + task.name + ".jsonl"), text);
    }
  }
  homework::Assessment graded() const { return homework::assess(given, folder / "runs", "", nullptr, &references); }
};

/// How many steps of these kinds have nothing but NaN by right, as the point of two outlines that do not overlap.
std::int64_t without_numbers(const Trace& trace, const std::vector<std::uint8_t>& kinds) {
  std::int64_t count = 0;
  trace.each(0, trace.size(), [&](std::int64_t, const RecordedEvent& recorded) {
    if (std::find(kinds.begin(), kinds.end(), recorded.event.index()) == kinds.end()) return true;
    count += visit_event(
        []<class E>(const E& e) {
          bool none = true;
          for_each_field<E>([&](const auto& field) {
            if constexpr (std::is_same_v<std::remove_cvref_t<decltype(e.*field.member)>, double>)
              none = none && std::isnan(e.*field.member);
          });
          return none;
        },
        recorded.event);
    return true;
  });
  return count;
}

/// Points are missing where and only where there is a reason.
void hold_law(const homework::Assessment& all) {
  for (const homework::Graded& task : all.tasks)
    for (std::size_t part = 0; part < task.counts.size(); ++part) {
      CAPTURE(task.task->name);
      CAPTURE(all.homework->parts[part].name);
      CHECK((all.points(task, part) < all.most(task, part)) == !task.counts[part].lost.empty());
      for (const grade::Loss& loss : task.counts[part].lost) CHECK(loss.count > 0);
    }
  if (homework::all_right(all)) CHECK(all.points() == doctest::Approx(all.most()));
}

}  // namespace

TEST_CASE("grade law: right runs have all points, no reason, and are all right") {
  for (const std::string& method : with_homework) {
    CAPTURE(method);
    const Set set(method);
    set.write([](const RecordedEvent&, std::string line) { return line; });
    const homework::Assessment all = set.graded();
    hold_law(all);
    CHECK(homework::all_right(all));
    CHECK(all.points() == all.most());
    CHECK(has(homework::report_text(all, "zstep grade"), "Every step is right."));
  }
}

TEST_CASE("grade law: a run without any one kind of step is not all right, and each report says what it lacks") {
  for (const std::string& method : with_homework) {
    const Set set(method);
    for (const grade::Part& part : set.given.parts)
      for (const std::uint8_t kind : part.kinds) {
        set.write([&](const RecordedEvent& recorded, std::string line) {
          return recorded.event.index() == kind ? "" : line;
        });
        const homework::Assessment all = set.graded();
        const std::string name = homework::steps_of(set.given, {grade::Loss::Why::never, kind, 1});
        CAPTURE(method);
        CAPTURE(name);
        hold_law(all);
        CHECK(all.points() < all.most());
        CHECK_FALSE(homework::all_right(all));
        const std::string text = homework::report_text(all, "zstep grade"), page = homework::report_html(all, "zstep");
        CHECK_FALSE(has(text, "Every step is right."));
        CHECK_FALSE(has(page, "Every step is right."));
        CHECK(has(text, name + ": not printed"));
        CHECK(has(page, name + ": not printed"));
        CHECK_FALSE(has(homework::report_gradescope(all, 0), "Every step that is shown is right."));
        bool said = false;
        const json report = json::parse(homework::report_json(all));
        for (const json& scene : report["scenes"])
          for (const json& of : scene["parts"]) {
            CHECK((of["points"].get<double>() < of["of"].get<double>()) == !of["lost"].empty());
            for (const json& loss : of["lost"]) said = said || (loss["why"] == "never" && loss["steps"] == name);
          }
        CHECK(said);
      }
  }
}

TEST_CASE("grade law: numbers that are none earn nothing for their computation, nor as depths") {
  for (const std::string& method : with_homework) {
    const Set set(method);
    set.write([](const RecordedEvent& recorded, std::string line) {
      json step = json::parse(line);
      for (const FieldOfKind& field : fields_of_kind(recorded.event.index()))
        if (field.type == FieldOfKind::Type::real) step[std::string(field.name)] = "nan";
      return step.dump();
    });
    const homework::Assessment all = set.graded();
    CAPTURE(method);
    hold_law(all);
    for (const homework::Graded& task : all.tasks)
      for (std::size_t part = 0; part < task.counts.size(); ++part) {
        const grade::Part& of = set.given.parts[part];
        CAPTURE(task.task->name);
        CAPTURE(of.name);
        const grade::PartCount& count = task.counts[part];
        if (count.halves) CHECK(count.halves->depths == 0);
        const auto has_numbers = [](std::uint8_t kind) {
          const auto fields = fields_of_kind(kind);
          return std::any_of(fields.begin(), fields.end(),
                             [](const FieldOfKind& field) { return field.type == FieldOfKind::Type::real; });
        };
        if (of.level != grade::Level::buffers && std::all_of(of.kinds.begin(), of.kinds.end(), has_numbers) &&
            count.expected > 0 && of.computation > 0)
          CHECK(count.computed <= without_numbers(*set.references.find(*task.task, task.task->conventions), of.kinds));
      }
  }
}
