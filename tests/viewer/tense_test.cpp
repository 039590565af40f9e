// What is asked of the whole run says, at a step before its end, what holds there and what is still to come; and a
// lesson whose run was changed goes on.
#include <doctest/doctest.h>

#include <algorithm>
#include <string>

#include "sim/classroom/lesson.hpp"
#include "sim/viewer/panes/sweep.hpp"
#include "sim/viewer/stage.hpp"
#include "sim/viewer/window.hpp"
#include "tests/viewer/drive.hpp"
#include "tests/viewer/letters.hpp"
#include "tests/viewer/made_anew.hpp"
#include "tests/where.hpp"

using namespace zstep;
using namespace zstep::viewer;

namespace {

/// Is this a part of something that is written in the last frame?
bool is_written(App& app, const std::string& part) {
  app.settle();
  const test::Letters drawn = test::letters_of(app.ui().fonts);
  return std::any_of(drawn.words.begin(), drawn.words.end(),
                     [&](const std::string& word) { return word.find(part) != std::string::npos; });
}

ViewerOptions changing() {
  ViewerOptions options;
  options.run_changed = test::made_anew;
  return options;
}

struct InLesson {
  explicit InLesson(const char* id) : lesson(find_lesson(id)), trace(run_lesson(lesson)) {}
  Lesson lesson;
  Trace trace;
};

}  // namespace

TEST_CASE("why not tells at a step what the pixel shows there, and that the step that decides is still to come") {
  const Trace trace = test::record_run("pyramid-behind");
  App app(trace, nullptr, {}, 1280, 720);
  app.session().go_to(trace.clears()[0]);
  app.session().select(Cell{15, 12});
  app.open_why();
  app.ask_why(0);
  REQUIRE(app.why().step > app.session().position());
  const std::string early = app.at_this_step(Cell{15, 12}, app.why().step);
  CHECK(early.find("At this step pixel (15, 12) shows the background. Step ") == 0);
  CHECK(early.find("which decides it, is still to come. At the end of the run:") != std::string::npos);
  CHECK(is_written(app, "shows"));
  CHECK(is_written(app, "come:"));
  app.session().go_to(app.why().step);
  CHECK(app.at_this_step(Cell{15, 12}, app.why().step).find("to come") == std::string::npos);
  app.session().go_to(trace.size());
  CHECK(app.at_this_step(Cell{15, 12}, app.why().step).empty());
  CHECK_FALSE(is_written(app, "come:"));
}

TEST_CASE("a pixel's history says what is still to come of it") {
  const Trace trace = test::record_run("pyramid-behind");
  App app(trace, nullptr, {}, 1280, 720);
  app.session().go_to(trace.clears()[0]);
  app.session().select(Cell{15, 12});
  test::press(app, SDLK_h);
  REQUIRE(app.history().size() == 4);
  CHECK(is_written(app, "yet"));  // nothing happened to it yet, 4 still to come
  CHECK(is_written(app, "come:"));
  app.session().go_to(trace.size());
  CHECK_FALSE(is_written(app, "come:"));
}

TEST_CASE("undo of the last change shows what was opened as its lesson left it, and marks nothing") {
  InLesson in("z-buffer");
  ViewerOptions options = changing();
  options.lesson = &in.lesson;
  Stage stage(in.trace, options, Settings{}, 1280, 720);
  stage.app().session().to_stop(4);
  const std::int64_t left = stage.app().session().position();
  stage.change({"theta", "80"}, false);
  REQUIRE(!stage.app().changed().pixels.empty());
  test::press(stage.app(), SDLK_LEFT);  // the reader moves on in the changed run
  stage.undo(1);
  REQUIRE(stage.changes().empty());
  REQUIRE(stage.app().session().lesson());
  CHECK(stage.app().session().position() == left);
  CHECK(stage.app().session().stop() == 4);
  for (const std::int64_t at : {std::int64_t{0}, left, in.trace.size()}) {
    stage.app().session().go_to(at);
    stage.app().settle();
    CHECK(stage.app().ui().pixel_marks == nullptr);
    CHECK(stage.app().ui().before == nullptr);
  }
}

TEST_CASE("a changed run marks at each moment only pixels that are otherwise by then") {
  const Trace trace = test::record_run("pyramid");
  const ViewerOptions options = changing();
  Stage stage(trace, options, Settings{}, 1280, 720);
  stage.app().session().go_to(trace.size() / 2);
  stage.change({"theta", "80"}, false);
  App& app = stage.app();
  app.session().go_to(0);
  app.settle();
  CHECK(app.ui().pixel_marks == nullptr);  // an empty frame has nothing to be marked
  app.session().go_to(app.session().size());
  app.settle();
  REQUIRE(app.ui().pixel_marks != nullptr);
  CHECK(app.ui().pixel_marks->size() == app.changed().pixels.size());
}

TEST_CASE("from a changed run N goes on with the lesson that waits, and what was changed can be made again") {
  InLesson in("z-buffer");
  ViewerOptions options = changing();
  options.lesson = &in.lesson;
  Stage stage(in.trace, options, Settings{}, 1280, 720);
  stage.app().session().to_stop(4);
  stage.change({"theta", "80"}, false);
  REQUIRE_FALSE(stage.app().session().lesson());
  test::press(stage.app(), SDLK_ESCAPE);
  test::press(stage.app(), SDLK_n);
  stage.serve();
  REQUIRE(stage.app().session().lesson());
  CHECK(stage.app().session().stop() == 5);
  CHECK(stage.changes().empty());
  CHECK(stage.app().session().message.find("no lesson") == std::string::npos);
  stage.undo(-1);
  CHECK(stage.changes() == std::vector<Change>{{"theta", "80"}});
}

TEST_CASE(
    "a lesson that was read to its end, or is shown to a class, begins at its first stop, and else where it was left") {
  InLesson in("z-buffer");
  Settings settings;
  const auto place = [&](int stop) {
    settings.remember(place_key(in.trace), in.lesson.stops[static_cast<std::size_t>(stop)].position);
    return place_to_go_on(settings, in.trace, &in.lesson);
  };
  const int last = static_cast<int>(in.lesson.stops.size()) - 1;
  CHECK(place(5) == in.lesson.stops[5].position);
  CHECK_FALSE(place(last));
  settings.presenter = true;
  CHECK_FALSE(place(5));
  CHECK(place_to_go_on(settings, in.trace, nullptr) == in.lesson.stops[5].position);
}

TEST_CASE("on one screen the notes leave the first window to be seen, and lie inside the screen") {
  for (const auto& [width, height] : {std::pair{1366, 768}, {1920, 1080}, {800, 600}}) {
    const SDL_Rect usable{10, 20, width, height}, at = place_beside(usable, 1100, 700);
    CHECK(at.w <= std::max(320, width / 2));
    CHECK(at.h <= std::max(200, height / 2));
    CHECK(at.x >= usable.x);
    CHECK(at.x + at.w == usable.x + usable.w);
    CHECK(at.y + at.h == usable.y + usable.h);
  }
}

TEST_CASE("a question mark on the start page opens the sheet of keys, and Esc comes back to the page") {
  const Trace trace = test::record_run("pyramid");
  App app(trace, nullptr, {}, 1280, 720);
  app.open_start();
  test::send_text(app, "?");
  CHECK(app.overlay() == Overlay::keys);
  CHECK(app.typed.empty());
  test::press(app, SDLK_ESCAPE);
  CHECK(app.overlay() == Overlay::start);
  test::type(app, "b");
  test::send_text(app, "?");  // in what is typed it is a letter
  CHECK(app.overlay() == Overlay::start);
}

TEST_CASE("Shift+E asks where the depth of the selected pixel comes from, and not that of another one at work") {
  const Trace trace = test::record_run("pyramid-behind");
  App app(trace, nullptr, {}, 1280, 720);
  app.session().go_to(trace.size());
  app.session().select(Cell{15, 12});
  test::press(app, SDLK_e, KMOD_SHIFT);
  REQUIRE(app.drawer() == Drawer::explain);
  REQUIRE(!app.chain().links.empty());
  const Picture& picture = app.session().state().picture;
  CHECK(app.chain().links.front().values.front().value == picture.depth[picture.at(15, 12)]);
  app.session().go_to(trace.clears()[0]);
  app.open(Drawer::none);
  test::press(app, SDLK_e, KMOD_SHIFT);
  CHECK(app.drawer() == Drawer::none);
  CHECK(app.session().message.find("no depth") != std::string::npos);
}

TEST_CASE(
    "law: x_L and x_R are drawn where they are, on the scale of pixel centres, and cross nothing that stands in "
    "pixels") {
  const Trace trace = test::record_run("pyramid");
  App app(trace, nullptr, {}, 1280, 720);
  int spans = 0;
  for (std::int64_t at = 1; at <= trace.size(); ++at) {
    const Event event = trace.event(at).event;
    const auto* span = get_if<SpanBegin>(&event);
    if (!span) continue;
    app.session().go_to(at);
    const RasterMap map(trace.scene().raster, app.ui().view, 1280, 1280);
    app.settle();
    const auto ends = span_ends(app.ui(), map, {0, 0});
    REQUIRE(ends);
    // A pixel's centre is where its number stands.
    CHECK(ends->left == doctest::Approx(map.px(0) + span->x_left * map.cell));
    CHECK(ends->right == doctest::Approx(map.px(0) + span->x_right * map.cell));
    CHECK(ends->top < map.py(span->y));
    CHECK(ends->end > map.py(span->y));
    const float letters = app.ui().fonts.bold->FontSize / 2, middle = static_cast<float>(map.py(span->y));
    REQUIRE(ends->line.size() == 1);  // nothing stands in pixels here
    CHECK(ends->line[0].at.x == doctest::Approx(ends->left));
    CHECK(ends->line[0].size.x == doctest::Approx(ends->right - ends->left));
    CHECK(std::abs(ends->line[0].at.y + ends->line[0].size.y / 2 - middle) <= 1);
    // In pieces between what stands in pixels.
    const float wide = static_cast<float>(map.cell) / 2;
    const auto broken =
        span_ends(app.ui(), map, {0, 0}, [&](std::int32_t x, std::int32_t) { return x % 2 ? wide : 0; });
    for (const SpanEnds::Box& part : broken->line) {
      CHECK(part.at.x >= ends->left - 0.01f);
      CHECK(part.at.x + part.size.x <= ends->right + 0.01f);
      for (std::int32_t x = 1; x < map.width; x += 2) {
        const float place = static_cast<float>(map.px(x));
        CHECK((part.at.x + part.size.x <= place - wide / 2 || part.at.x >= place + wide / 2));
      }
    }
    for (const SpanEnds::Box& stroke : ends->strokes) {
      const float x = stroke.at.x + stroke.size.x / 2;
      CHECK(std::min(std::abs(x - ends->left), std::abs(x - ends->right)) <= 1);
      CHECK((stroke.at.y + stroke.size.y < middle - letters || stroke.at.y > middle + letters));
    }
    ++spans;
  }
  CHECK(spans > 20);
}
