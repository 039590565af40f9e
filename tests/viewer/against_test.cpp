// Two runs in one window: at the same moment by meaning, and marked where they differ.
#include <doctest/doctest.h>
#include <unistd.h>

#include <fstream>

#include "sim/viewer/model/against.hpp"
#include "sim/viewer/pictures.hpp"
#include "tests/golden/golden.hpp"
#include "tests/viewer/drive.hpp"
#include "tests/where.hpp"

using namespace zstep;
using namespace zstep::viewer;

namespace {

Trace from_text(const std::string& text) {
  const auto path = std::filesystem::temp_directory_path() / ("zstep_against_" + std::to_string(getpid()) + ".jsonl");
  std::ofstream(path) << text;
  Trace trace = open_jsonl(path);
  std::filesystem::remove(path);
  return trace;
}

/// The worked example, and the same with a line less and with one depth changed.
struct Pair {
  Trace a, b;
  diff::DiffReport report;
  AgainstRun with;

  explicit Pair(bool missing)
      : a(open_jsonl(test::in_checkout("tests/golden/delhi.jsonl"))),
        b(from_text(altered(test::jsonl_of(a), missing))),
        report(diff::compare(a, b)),
        with{&b, &report, true} {}

  static std::string altered(std::string text, bool missing) {
    const std::string line = missing ? "{\"step\":\"write_pixel\",\"x\":1,\"y\":2,\"polygon\":1}\n"
                                     : "{\"step\":\"interpolate_z\",\"x\":2,\"y\":2,\"z\":5.0}\n";
    const std::size_t at = text.find(line);
    REQUIRE(at != std::string::npos);
    return text.replace(at, line.size(), missing ? "" : "{\"step\":\"interpolate_z\",\"x\":2,\"y\":2,\"z\":4.5}\n");
  }
};

}  // namespace

TEST_CASE("the second run goes where the first one is: the same step, or the last before it") {
  const Pair runs(true);
  Session session(runs.a, nullptr);
  Against against(session, runs.with);
  REQUIRE(runs.b.size() == runs.a.size() - 1);
  const auto gone = against.next_cause(1);
  REQUIRE(gone);
  for (std::int64_t at = 0; at <= runs.a.size(); ++at) {
    session.go_to(at);
    against.follow();
    CAPTURE(at);
    CHECK(against.session().position() == (at < gone->a ? at : at - 1));
  }
  session.go_to(gone->a);
  against.follow();
  CHECK(against.marks_of_a().told(session).note.find("A has this step, B does not") != std::string::npos);
  CHECK(against.marks_of_b().told(against.session()).note.find("this run does not have") != std::string::npos);
  // The pixel was not written in B: from here on it differs.
  REQUIRE(against.pixels().size() == 1);
  CHECK(against.pixels()[0].pixel == static_cast<std::int64_t>(session.state().picture.at(1, 2)));
  CHECK(against.pixels()[0].filled);
}

TEST_CASE("keys lead to the next cause, the next difference and the first pixel that differs") {
  const Pair runs(false);
  App app(runs.a, nullptr, {}, 1280, 720);
  app.show_against(runs.with);
  (void)test::picture(app);
  Session& s = app.session();
  test::send_text(app, ".");
  const std::int64_t cause = s.position();
  REQUIRE(holds<DepthInterpolate>(s.event()->event));
  const StepMarks::Told& told = app.ui().marks->told(s);
  REQUIRE(told.lines.size() == 1);
  CHECK(told.lines[0].find("z = 5") == 0);
  CHECK(told.note.find("B computes it wrongly from its own operands") != std::string::npos);
  std::int64_t last = cause, count = 1;
  for (test::send_text(app, ">"); s.position() != last; test::send_text(app, ">")) last = s.position(), ++count;
  CHECK(count == static_cast<std::int64_t>(runs.report.alignment.differences.size()));
  CHECK(s.message == "There is no later difference.");
  test::send_text(app, "#");
  CHECK(s.message.find("same at the end") != std::string::npos);

  const Pair other(true);
  App shown(other.a, nullptr, {}, 1280, 720);
  shown.show_against(other.with);
  (void)test::picture(shown);
  test::send_text(shown, "#");
  CHECK(shown.session().selected == Cell{1, 2});
  CHECK(shown.session().position() == other.report.causes[0].first.a);
}

TEST_CASE("law: two runs in one window look the same, walked to or jumped to, and differences are marked in both") {
  const Pair runs(true);
  App walked(runs.a, nullptr, {}, 1280, 720);
  walked.show_against(runs.with);
  const std::int64_t cause = runs.report.causes[0].first.a;
  walked.session().go_to(cause - 4);
  PictureOptions options;
  options.against = &runs.with;
  const std::uint32_t bad = to_pixel(light_theme().bad) & 0xffffffu;
  for (int i = 0; i < 8; ++i) {
    test::press(walked, SDLK_RIGHT);
    walked.frame();
    const std::int64_t at = walked.session().position();
    CAPTURE(at);
    const bool same = test::picture(walked) == Pictures(runs.a, options).at(at).rgb;
    CHECK(same);
  }
  CHECK(test::count_of(test::picture(walked), bad) > 100);
  // Opened without a step it is where they first part.
  const bool at_cause = Pictures(runs.a, options).at(-1).rgb == Pictures(runs.a, options).at(cause).rgb;
  CHECK(at_cause);
}
