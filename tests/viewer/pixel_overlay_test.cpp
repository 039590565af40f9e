// What is painted over the frame for each pixel, the range of the depth's colours, and the histogram: by keys.
#include <cmath>

#include <doctest/doctest.h>

#include "sim/viewer/panes/legend.hpp"
#include "tests/viewer/drive.hpp"
#include "tests/viewer/words/some_runs.hpp"

using namespace zstep;
using namespace zstep::viewer;
using answers::Count;

TEST_CASE("O turns through what is counted for each pixel, and it follows the step") {
  const Trace trace = test::record_run("pyramid-behind");
  App app(trace, nullptr, {}, 1280, 720);
  app.session().go_to(trace.size());
  const test::Bytes plain = test::picture(app);
  std::vector<test::Bytes> seen{plain};
  for (std::size_t k = 0; k < answers::count_kinds; ++k) {
    test::press(app, SDLK_o);
    seen.push_back(test::picture(app));
    REQUIRE(app.ui().heat);
    CHECK(app.pixel_overlay().shown() == static_cast<Count>(k));
    CHECK(app.ui().heat->until == trace.size());
    answers::PixelCounts counts(trace);
    counts.count_to(trace.size());
    const auto& expected = counts.of(static_cast<Count>(k));
    for (std::size_t i = 0; i < expected.size(); ++i) {
      const double value = app.ui().heat->values[i];
      CHECK((std::isnan(value) ? expected[i] <= 0 : value == expected[i]));
    }
  }
  for (std::size_t a = 0; a < seen.size(); ++a)
    for (std::size_t b = 0; b < a; ++b) CHECK(seen[a] != seen[b]);
  // The step decides: at the beginning nothing was counted.
  app.session().go_to(0);
  app.settle();
  CHECK(app.ui().heat->until == 0);
  for (const double value : app.ui().heat->values) CHECK(std::isnan(value));
  test::press(app, SDLK_o);
  app.settle();
  CHECK_FALSE(app.ui().heat);
  test::press(app, SDLK_o, KMOD_LSHIFT);
  app.settle();
  CHECK(app.pixel_overlay().shown() == Count::covers);
  test::press(app, SDLK_ESCAPE);
  CHECK_FALSE(app.ui().heat);
  CHECK_FALSE(app.pixel_overlay().shown());
  app.session().go_to(trace.size());
  app.session().message.clear();
  CHECK(test::picture(app) == plain);
}

TEST_CASE("an answer's picture and a count take each other's place") {
  const Trace trace = test::record_run("pyramid-behind");
  App app(trace, nullptr, {}, 1280, 720);
  app.session().go_to(trace.size());
  test::press(app, SDLK_o);
  app.settle();
  test::press(app, SDLK_q);
  test::type(app, "select x, y from depth_compare");
  test::press(app, SDLK_RETURN);
  app.settle();
  CHECK(app.ui().heat->name == "overdraw");
  const test::Bytes counted = test::picture(app);
  test::press(app, SDLK_TAB);
  const test::Bytes answered = test::picture(app);
  CHECK(app.ui().heat->name == "rows");
  CHECK_FALSE(app.pixel_overlay().shown());
  CHECK(answered != counted);
  test::press(app, SDLK_TAB);
  CHECK_FALSE(app.ui().heat);
  CHECK(test::count_of(test::picture(app), 0x0072b2) >
        test::count_of(answered, 0x0072b2) + 1000);  // F's colour is back at the same step
}

TEST_CASE("R says so where there are no depths, for good or yet") {
  const Trace lines = test::record_run_by("hidden-line", "pyramid-behind");
  App app(lines, nullptr, {}, 1280, 720);
  app.session().go_to(lines.size());
  test::press(app, SDLK_r);
  CHECK(app.session().message.find("There are no depths in this trace") == 0);
  CHECK(app.ui().range_mode == Ui::RangeMode::whole);
  const Trace trace = test::record_run("pyramid-behind");
  App empty(trace, nullptr, {}, 1280, 720);
  test::press(empty, SDLK_r);
  CHECK(empty.session().message.find("No depths are shown yet") == 0);
  CHECK(empty.ui().range_mode == Ui::RangeMode::fitted);
}

TEST_CASE("R fits the colours to what is shown, Shift+R takes a range, I draws how depths are spread") {
  const Trace trace = test::record_run("pyramid-behind");
  App app(trace, nullptr, {}, 1280, 720);
  app.session().go_to(1000);
  const test::Bytes whole = test::picture(app);
  test::press(app, SDLK_r);
  CHECK(app.ui().range_mode == Ui::RangeMode::fitted);
  CHECK(test::picture(app) != whole);
  test::press(app, SDLK_r, KMOD_LSHIFT);
  test::type(app, "0.5 0.1");
  test::press(app, SDLK_RETURN);
  CHECK(app.drawer() == Drawer::range);
  CHECK_FALSE(app.wrong.empty());
  for (int i = 0; i < 7; ++i) test::press(app, SDLK_BACKSPACE);
  test::type(app, "-.1 0.6");
  test::press(app, SDLK_RETURN);
  CHECK(app.drawer() == Drawer::none);
  CHECK(app.ui().range_mode == Ui::RangeMode::by_hand);
  CHECK(app.ui().hand_range.near == -0.1);
  CHECK(app.ui().hand_range.far == 0.6);
  const test::Bytes by_hand = test::picture(app);
  test::press(app, SDLK_i);
  CHECK(test::picture(app) != by_hand);
  test::press(app, SDLK_r, KMOD_LSHIFT);
  test::press(app, SDLK_RETURN);
  CHECK(app.ui().range_mode == Ui::RangeMode::whole);

  const Picture& picture = app.session().picture();
  const DepthRange fitted = fitted_range(picture, app.session().header());
  std::int32_t drawn = 0, beside = 0;
  for (const double z : picture.depth) {
    if (!std::isfinite(z)) continue;
    ++drawn, beside += z < 0.2 || z > 0.6;
    CHECK(fitted.near <= z);
    CHECK(fitted.far >= z);
  }
  const auto sum = [](const Histogram& h) {
    std::int32_t all = 0;
    for (const std::int32_t bin : h.bins) {
      all += bin;
      CHECK(bin <= h.most);
    }
    return all;
  };
  CHECK(sum(histogram_of(picture, fitted, 10)) == drawn);
  const Histogram part = histogram_of(picture, {0.2, 0.6, true}, 7);
  CHECK(part.nearer + part.farther == beside);
  CHECK(sum(part) + beside == drawn);
  CHECK(beside > 0);
  const Histogram greater = histogram_of(picture, {0.6, 0.2, true}, 7);  // where the greater depth is nearer
  CHECK(greater.nearer == part.farther);
  CHECK(greater.farther == part.nearer);
  CHECK(sum(greater) == sum(part));
}
