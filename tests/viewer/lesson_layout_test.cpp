// A lesson's own layout: what it shows and leaves out, how much of the window its pictures have, and the way to the
// laboratory and back.
#include <algorithm>
#include <array>
#include <cctype>
#include <cstdlib>
#include <map>
#include <optional>
#include <string>

#include <doctest/doctest.h>
#include <fmt/format.h>

#include "sim/classroom/chart_table.hpp"
#include "sim/classroom/lesson.hpp"
#include "sim/classroom/markdown.hpp"
#include "sim/viewer/commands.hpp"
#include "sim/viewer/description.hpp"
#include "sim/viewer/panes/happened.hpp"
#include "sim/viewer/panes/workspace.hpp"
#include "sim/words/explain.hpp"
#include "tests/viewer/drive.hpp"
#include "tests/viewer/letters.hpp"
#include "tests/viewer/words/some_runs.hpp"
#include "traces/scene.hpp"

using namespace zstep;
using namespace zstep::viewer;

namespace {

struct Shown {
  int width, height;
  bool presenter;
  double ground;  ///< at most so much of the window is empty, on average over the stops that are looked at
};
constexpr Shown looks[] = {
    {1280, 720, false, 0.25}, {1920, 1080, true, 0.24}, {1024, 768, false, 0.28}, {3840, 2160, false, 0.30}};

double stage_share(App& app, const Shown& look) {
  return static_cast<double>(app.stage_place().size.x * app.stage_place().size.y) / (look.width * look.height);
}

/// The part of the window that is empty: of its squares of two lines' height those that are wholly of the ground.
double ground_share(App& app) {
  const auto of = [](ImU32 color) { return std::array{color & 255u, color >> 8 & 255u, color >> 16 & 255u}; };
  const auto pane = of(app.ui().colors().pane), window = of(app.ui().colors().window);
  const test::Bytes& rgb = app.renderer().rgb();
  const int width = app.renderer().width(), side = static_cast<int>(2 * app.ui().em);
  const auto is_ground = [&](int x, int y) {
    const std::uint8_t* at =
        &rgb[3 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x))];
    return std::equal(pane.begin(), pane.end(), at) || std::equal(window.begin(), window.end(), at);
  };
  int empty = 0, all = 0;
  for (int y = 0; y + side <= app.renderer().height(); y += side)
    for (int x = 0; x + side <= width; x += side, ++all) {
      bool ground = true;
      for (int k = 0; k < side * side && ground; ++k) ground = is_ground(x + k % side, y + k / side);
      empty += ground;
    }
  return static_cast<double>(empty) / all;
}

/// A symbol of one letter whose "_" is drawn instead of setting what follows below the line: z_v, and not write_pixel.
bool has_raw_subscript(const std::string& words) {
  const auto is_part = [&](std::size_t at) {
    return at < words.size() && (std::isalnum(static_cast<unsigned char>(words[at])) != 0 || words[at] == '_');
  };
  for (std::size_t bar = words.find('_'); bar != std::string::npos; bar = words.find('_', bar + 1)) {
    std::size_t end = bar + 1;
    while (is_part(end)) ++end;
    if (bar > 0 && is_part(bar - 1) && (bar < 2 || !is_part(bar - 2)) && end - bar >= 2 && end - bar <= 4) return true;
  }
  return false;
}

/// Letters that stand far apart may be read as two words.
std::string without_blanks(std::string text) {
  std::erase(text, ' ');
  return text;
}

/// What is drawn, line by line as the letters stand, without what is set apart or below the line.
std::string lines_drawn(const test::Letters& drawn) {
  std::string text;
  std::size_t word = drawn.words.size();
  float end = 0;
  for (const test::Letter& letter : drawn.all) {
    if (letter.word != word) text += (letter.first.x < end ? "\n" : "") + drawn.words[word = letter.word];
    end = letter.last.x;
  }
  std::erase_if(text, [](char c) { return c == ' ' || c == '_'; });
  return text;
}

}  // namespace

TEST_CASE("law: a lesson's pictures have 45 % of the window and keep their place, and nothing is said twice") {
  std::map<int, std::pair<double, int>> ground;
  const bool all = std::getenv("ZSTEP_ALL_SIZES") != nullptr;
  std::size_t turn = 0;
  for (Lesson& lesson : all_lessons()) {
    const Trace trace = run_lesson(lesson);
    CAPTURE(lesson.id);
    // Lines of code may begin alike, and are broken where the pane ends.
    const auto may_be_said = [&](const std::string& words) {
      const auto begin_so = std::count_if(
          trace.header().page.begin(), trace.header().page.end(),
          [&](const StepInfo& step) { return without_blanks(step.text).starts_with(without_blanks(words)); });
      return std::max<std::ptrdiff_t>(1, begin_so);
    };
    for (const Shown& look : looks) {
      // Each lesson in one size; with ZSTEP_ALL_SIZES set in all of them, at every stop.
      if (!all && &look != &looks[turn % std::size(looks)]) continue;
      CAPTURE(look.width);
      Settings settings;
      settings.presenter = look.presenter;
      App app(trace, &lesson, settings, look.width, look.height);
      std::optional<Motion::Place> place;  // where the stop asks for nothing else
      const int first = all ? 0 : static_cast<int>(turn % 3), step = all ? 1 : look.width > 2000 ? 9 : 4;
      for (int stop = first; stop < size32(lesson.stops); stop += step) {
        CAPTURE(stop);
        app.session().to_stop(stop);
        app.settle();
        CHECK(stage_share(app, look) >= 0.45);
        ground[look.width].first += ground_share(app), ++ground[look.width].second;
        if (lesson.stops[stop].focus.empty()) {
          const Motion::Place now = app.stage_place();
          if (place)
            CHECK((place->at.x == now.at.x && place->at.y == now.at.y && place->size.x == now.size.x &&
                   place->size.y == now.size.y));
          place = now;
        }
        const test::Letters drawn = test::letters_of(app.ui().fonts);
        for (const std::string& words : drawn.words) CHECK_MESSAGE(!has_raw_subscript(words), words);
        std::map<std::string, int> said;
        for (const std::string& words : drawn.words)
          if (std::count(words.begin(), words.end(), ' ') >= 6 && words.find("\u221e \u221e") == std::string::npos &&
              std::any_of(words.begin(), words.end(), [](char c) { return c >= 'a' && c <= 'z'; }))
            CHECK_MESSAGE(++said[words] <= may_be_said(words), words);
      }
    }
    ++turn;
  }
  for (const Shown& look : looks) {
    const auto& [sum, count] = ground[look.width];
    const auto mean = sum / count;
    CAPTURE(look.width);
    CAPTURE(mean);
    CHECK(mean <= (all ? std::min(0.25, look.ground) : look.ground));
  }
}

TEST_CASE("law: a stop that asks about a step of another subject tells nothing of the step before") {
  int foreign = 0, kept = 0;
  for (Lesson& lesson : all_lessons()) {
    const Trace trace = run_lesson(lesson);
    App app(trace, &lesson, {}, 1280, 720);
    for (int stop = 0; stop < size32(lesson.stops); ++stop) {
      const Stop& asks = lesson.stops[static_cast<std::size_t>(stop)];
      if (!asks.question || asks.event <= asks.position || asks.position == 0) continue;
      app.session().to_stop(stop);
      const RecordedEvent last = trace.event(asks.position), next = trace.event(asks.event);
      const auto of_last = pixel_of(last.event), of_next = pixel_of(next.event);
      CAPTURE(lesson.id);
      CAPTURE(stop);
      const bool tells = app.session().event_told() != nullptr;
      // Of pixels at least the test knows whether they are the same.
      if (of_last && of_next) CHECK(tells == (of_last->x == of_next->x && of_last->y == of_next->y));
      ++(tells ? kept : foreign);
      if (tells) continue;
      app.settle();
      const std::vector<std::string> words = test::letters_of(app.ui().fonts).words;
      CHECK(std::find(words.begin(), words.end(), "WHAT JUST HAPPENED") == words.end());
      const StepInfo& line = *find_step(trace.header().page, last.step);
      CHECK(std::find(words.begin(), words.end(), line.module + "." + line.name) == words.end());
    }
  }
  CHECK(foreign > 40);
  CHECK(kept > 40);
}

TEST_CASE("Shift+P leads from a lesson's layout to every pane and back, and the bytes are those of before") {
  Lesson lesson = find_lesson("z-buffer");
  const Trace trace = run_lesson(lesson);
  App app(trace, &lesson, {}, 1280, 720);
  app.session().to_stop(4);
  const test::Bytes before = test::picture(app);
  CHECK_FALSE(app.ui().laboratory);
  test::press(app, SDLK_p, KMOD_LSHIFT);
  CHECK(test::picture(app) != before);
  CHECK(app.ui().laboratory);
  test::press(app, SDLK_p, KMOD_LSHIFT);
  CHECK(test::picture(app) == before);
  App alone(trace, nullptr, {}, 1280, 720);
  test::press(alone, SDLK_p, KMOD_LSHIFT);
  alone.settle();
  CHECK(alone.ui().laboratory);
  CHECK(alone.session().message.find("no lesson") != std::string::npos);
}

TEST_CASE("of formulas that are too long for their place the last are shown, and the code beside them") {
  Lesson lesson = find_lesson("perspective-correct");
  const Trace trace = run_lesson(lesson);
  for (const Shown& look : looks) {
    Settings settings;
    settings.presenter = look.presenter;
    App app(trace, &lesson, settings, look.width, look.height);
    app.session().to_stop(4);
    app.settle();
    const std::vector<std::string> words = test::letters_of(app.ui().fonts).words;
    const auto said = [&](const char* word) { return std::find(words.begin(), words.end(), word) != words.end(); };
    CAPTURE(look.width);
    CHECK(said("WHAT JUST HAPPENED"));
    // In the narrow window the formulas just have room, all three, and the code has none.
    if (look.width == 1024) CHECK((said("1.4") && said("1.6")));
    else CHECK(said("PSEUDO-CODE"));
    CHECK(std::count(words.begin(), words.end(), "0.875") == 1);  // a, which those before it lead to
  }
}

TEST_CASE("law: other runs have their pictures where the stop says so, in any window, and are described") {
  constexpr struct { int width, height; } windows[] = {{1280, 720}, {1024, 768}, {390, 844}, {844, 390}};
  int beside = 0;
  for (Lesson& lesson : all_lessons()) {
    const auto shows = [](const Stop& stop) { return !stop.beside.empty(); };
    if (std::none_of(lesson.stops.begin(), lesson.stops.end(), shows)) continue;
    const Trace trace = run_lesson(lesson);
    CAPTURE(lesson.id);
    for (const auto& window : windows) {
      CAPTURE(window.width);
      App app(trace, &lesson, {}, window.width, window.height);
      for (const Stop& stop : lesson.stops) {
        app.session().to_stop(static_cast<int>(&stop - lesson.stops.data()));
        app.settle();
        CAPTURE(stop.heading);
        const test::Letters drawn = test::letters_of(app.ui().fonts);
        const auto words_with = [&](const std::string& part) {
          return std::count_if(drawn.words.begin(), drawn.words.end(),
                               [&](const std::string& word) { return word.find(part) != std::string::npos; });
        };
        if (window.width == 1280) CHECK(words_with("ANOTHER RUN") == std::ssize(stop.beside));
        for (const RunBeside& run : stop.beside) CHECK(words_with(run.name().substr(0, 10)) > 0);
        const std::string said = describe_step(app);
        std::ptrdiff_t described = 0;
        for (std::size_t at = 0; (at = said.find(" of another run, ", at)) != std::string::npos; ++at) ++described;
        CHECK(described == std::ssize(stop.beside));
        beside += static_cast<int>(stop.beside.size());
      }
    }
  }
  CHECK(beside >= 8 * 4);
}

TEST_CASE("what a stop marks is seen in its picture, and not beyond the stop") {
  int marked = 0;
  for (Lesson& lesson : all_lessons()) {
    if (std::none_of(lesson.stops.begin(), lesson.stops.end(),
                     [](const Stop& stop) { return stop.pixel || !stop.labels.empty() || !stop.pixels.steps.empty(); }))
      continue;
    const Trace trace = run_lesson(lesson);
    Lesson plain = lesson;
    for (Stop& stop : plain.stops) stop.pixel.reset(), stop.labels.clear(), stop.pixels.right.clear();
    App marks(trace, &lesson, {}, 1280, 720), none(trace, &plain, {}, 1280, 720);
    for (std::size_t k = 0; k < lesson.stops.size(); ++k) {
      const Stop& stop = lesson.stops[k];
      for (App* app : {&marks, &none}) app->session().to_stop(static_cast<int>(k)), app->settle();
      CAPTURE(lesson.id);
      CAPTURE(stop.heading);
      const bool marks_any = stop.pixel || !stop.labels.empty() || !stop.pixels.right.empty();
      CHECK((marks.renderer().rgb() != none.renderer().rgb()) == marks_any);
      marked += marks_any;
      if (stop.pixel) CHECK(marks.session().cell_looked_at(true) == Cell{stop.pixel->x, stop.pixel->y});
      marks.session().move(Unit::event, stop.position == trace.size() ? -1 : 1);
      if (!marks.session().speaks()) CHECK(!marks.session().cell_looked_at(true));
    }
  }
  CHECK(marked >= 15);
}

TEST_CASE("a scan line and the axes of the eye are named where the text names them, and a vertex once") {
  const auto named = [](const char* id, int stop, const std::string& name) {
    Lesson lesson = find_lesson(id);
    const Trace trace = run_lesson(lesson);
    App app(trace, &lesson, {}, 1280, 720);
    REQUIRE(app.show_only(lesson.stops.at(static_cast<std::size_t>(stop)).focus == "scene" ? "scene" : "frame"));
    app.session().to_stop(stop);
    app.settle();
    const std::vector<std::string> words = test::letters_of(app.ui().fonts).words;
    return std::count(words.begin(), words.end(), name);
  };
  CHECK(named("edge-table", 1, "scan line 8") == 1);
  CHECK(named("edge-table", 2, "scan line 8") == 0);
  constexpr int by_rulers = 2;
  CHECK(named("write-your-own", 8, "5") == by_rulers + 1);
  CHECK(named("viewing", 2, "v") == 3);  // below x, y and z
  CHECK(named("viewing", 1, "v") == 0);
}

TEST_CASE("where formulas give way the one that the stop speaks of stays") {
  Lesson lesson = find_lesson("back-faces");
  const Trace trace = run_lesson(lesson);
  App app(trace, &lesson, {}, 1280, 720);
  app.session().to_stop(5);  // the determinant, and not the normal after projection that the step tells of last
  app.settle();
  const std::vector<std::string> words = test::letters_of(app.ui().fonts).words;
  const auto said = [&](const char* part) {
    return std::any_of(words.begin(), words.end(),
                       [&](const std::string& word) { return word.find(part) != std::string::npos; });
  };
  CHECK(said("negative faces away"));
  CHECK_FALSE(said("after projection"));
}

TEST_CASE("law: the formula that stays is the one of which the stop speaks most") {
  int chosen = 0;
  for (Lesson& lesson : all_lessons()) {
    const Trace trace = run_lesson(lesson);
    App app(trace, &lesson, {}, 1280, 720);
    for (std::size_t k = 0; k < lesson.stops.size(); ++k) {
      app.session().to_stop(static_cast<int>(k));
      const RecordedEvent* event = app.session().event();
      if (!event) continue;
      const Explanation told = explain(trace, app.session().state(), *event);
      const std::vector<std::size_t> order = order_of_giving_way(app.session(), told);
      if (told.formulas.size() < 2) {
        CHECK(order.empty());
        continue;
      }
      REQUIRE(order.size() + 1 == told.formulas.size());
      const auto named = [&](std::size_t n) { return how_named(lesson.stops[k], told.formulas[n], told.given[n]); };
      std::size_t stays = 0;
      while (std::ranges::find(order, stays) != order.end()) ++stays;
      for (const std::size_t n : order) {
        CAPTURE(told.formulas[n]);
        CHECK(named(n) <= named(stays));
        if (named(n) == named(stays)) CHECK(n > stays);
      }
      if (stays > 0) ++chosen;
    }
  }
  CHECK(chosen >= 10);
  // The question is about E_1, which is −2; the step tells of E_0 first.
  Lesson lesson = find_lesson("more-samples");
  const Trace trace = run_lesson(lesson);
  Settings settings;
  settings.presenter = true;
  App app(trace, &lesson, settings, 1920, 1080);
  for (const auto& [stop, kept] : {std::pair(2, "S_1 = "), {3, "E_1 = "}}) {
    app.session().to_stop(stop);
    app.settle();
    const Explanation told = explain(trace, app.session().state(), *app.session().event());
    const std::vector<std::size_t> order = order_of_giving_way(app.session(), told);
    CHECK(std::ranges::find(order, 1) == order.end());
    CHECK(told.formulas[1].starts_with(kept));
  }
}

TEST_CASE("a stop that is come to through all before it is the picture that opens there") {
  Lesson lesson = find_lesson("clipping");  // two of its stops stand at the last step, one of them to look back
  const Trace trace = run_lesson(lesson);
  App app(trace, &lesson, {}, 1280, 720);
  for (int stop = 0; stop < size32(lesson.stops); ++stop) {
    CAPTURE(stop);
    app.session().to_stop(stop);
    App opened(trace, &lesson, {}, 1280, 720);
    opened.session().to_stop(stop);
    const bool same = test::picture(app) == test::picture(opened);
    CHECK(same);
  }
}

TEST_CASE("law: no line of a table or of code in a lesson's text is broken") {
  for (Lesson& lesson : all_lessons()) {
    const Trace trace = run_lesson(lesson);
    CAPTURE(lesson.id);
    for (const Shown& look : {looks[0], looks[2]}) {
      CAPTURE(look.width);
      App app(trace, &lesson, {}, look.width, look.height);
      for (const Stop& stop : lesson.stops) {
        std::string code;
        for (const TextBlock& block : parse_markdown(stop.text))
          if (block.kind == TextBlock::Kind::code) code += block.runs.front().text + "\n";
        if (code.empty()) continue;
        app.session().to_stop(static_cast<int>(&stop - lesson.stops.data()));
        app.settle();
        const std::string drawn = lines_drawn(test::letters_of(app.ui().fonts));
        for (std::size_t at = 0, next = 0; at < code.size(); at = next + 1) {
          next = code.find('\n', at);
          std::string line = code.substr(at, next - at);
          std::erase_if(line, [](char c) { return c == ' ' || c == '_'; });
          CHECK_MESSAGE(drawn.find(line) != std::string::npos, stop.heading << ": " << code.substr(at, next - at));
        }
      }
    }
  }
}

TEST_CASE("law: a chart names its lines and its axes, and tells no answer before the question has one") {
  int charts = 0, asked = 0;
  for (Lesson& lesson : all_lessons()) {
    if (std::none_of(lesson.stops.begin(), lesson.stops.end(), [](const Stop& s) { return s.focus == "chart"; }))
      continue;
    const Trace trace = run_lesson(lesson);
    App app(trace, &lesson, {}, 1280, 720);
    REQUIRE(app.show_only("chart"));
    for (int stop = 0; stop < size32(lesson.stops); ++stop) {
      if (lesson.stops[stop].focus != "chart") continue;
      CAPTURE(stop);
      bool own = false;
      const auto table = classroom::chart_of(lesson, stop, own);
      REQUIRE(table);
      const auto seen = [&] {
        app.settle();
        return lines_drawn(test::letters_of(app.ui().fonts));
      };
      const auto has = [](const std::string& drawn, const std::string& words) {
        return drawn.find(without_blanks(words)) != std::string::npos;
      };
      app.session().to_stop(stop);
      const std::string before = seen();
      ++charts;
      CHECK(has(before, table->up));
      CHECK(has(before, table->across));
      const std::optional<Question>& question = lesson.stops[stop].question;
      const auto unknown = std::find(table->columns.begin(), table->columns.end(), std::nullopt);
      const bool asks = own && question && unknown != table->columns.end();
      for (const auto& row : table->rows)
        CHECK(has(before, row.name) ==
              (!asks || row.values[static_cast<std::size_t>(unknown - table->columns.begin())]));
      if (!asks) continue;
      ++asked;
      for (int k = 0; k < size32(question->answers); ++k) CHECK_FALSE(has(before, question->answers[k].text));
      for (int k = size32(question->answers) - 1; k >= 0; --k) {  // the right one comes last
        app.session().answer(k);
        const std::string after = seen();
        CHECK(has(after, question->answers[k].text));
        for (const auto& row : table->rows) CHECK(has(after, row.name));
        CHECK(describe_step(app).find("at " + question->answers[k].text) != std::string::npos);
      }
    }
  }
  CHECK(charts >= 8);
  CHECK(asked == 1);
}
