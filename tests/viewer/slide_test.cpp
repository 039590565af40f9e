// What is saved for slides: the same pixels as the window, letters as text, and a caption.
#include <doctest/doctest.h>

#include <string>

#include "tests/viewer/drive.hpp"
#include "tests/viewer/words/some_runs.hpp"

using namespace zstep;
using namespace zstep::viewer;

namespace {

/// All that stands in its texts, a space between each two.
std::string texts_of(const std::string& svg) {
  std::string all;
  for (std::size_t at = svg.find("<text "); at != svg.npos; at = svg.find("<text ", at)) {
    at = svg.find('>', at) + 1;
    all += svg.substr(at, svg.find("</text>", at) - at) + " ";
  }
  return all;
}

bool within(const std::string& text, const std::string& part) { return text.find(part) != text.npos; }

}  // namespace

TEST_CASE("a picture of the window has its pixels, and its words as text") {
  const Trace trace = test::record_run("pyramid", test::of_size(25, 25));
  App app(trace, nullptr, {}, 1280, 720);
  app.session().go_to(316);
  const test::Bytes seen = test::picture(app);
  const Drawing drawing = app.of_window();
  CHECK(drawing.width == 1280);
  CHECK(drawing.height == 720);
  CHECK(drawing.rgb == seen);
  CHECK(drawing.svg == app.of_window().svg);
  const std::string words = texts_of(drawing.svg);
  CHECK(within(words, "FRAMEBUFFER"));
  CHECK(within(words, "step 316 of"));
  CHECK(within(drawing.svg, "<image "));  // the buffers are pixels
  CHECK(within(drawing.svg, "<path "));
}

TEST_CASE("a slide is what leads with its caption, and the window is as before") {
  const Trace trace = test::record_run("pyramid", test::of_size(25, 25));
  for (const bool drawer : {false, true})
    for (const WindowSize size : {WindowSize{1280, 720}, WindowSize{1024, 600}}) {
      App app(trace, nullptr, {}, size.width, size.height);
      app.session().go_to(316);
      if (drawer) app.open_why();
      const test::Bytes before = test::picture(app);
      const ImVec2 stage = app.stage_place().size;
      const Drawing slide = app.slide();
      CHECK(test::picture(app) == before);
      CHECK(slide.width >= static_cast<int>(stage.x));
      CHECK(slide.width < static_cast<int>(stage.x) + 40);
      CHECK(slide.height <= size.height);
      CHECK(slide.rgb.size() == static_cast<std::size_t>(slide.width) * static_cast<std::size_t>(slide.height) * 3);
      const std::string words = texts_of(slide.svg);
      CHECK(within(words, "Z-buffer \u00b7 "));
      CHECK(within(words, "step 316 \u00b7 "));
      CHECK_FALSE(within(words, "Menu"));
    }
}

TEST_CASE("where nothing leads there is no slide, and it is said") {
  const Trace trace = test::record_run("pyramid", test::of_size(25, 25));
  App app(trace, nullptr, {}, 1280, 720);
  app.offer([] { return std::vector<Offer>{{Offer::What::method, "bsp", "BSP tree", ""}}; });
  app.open_start();
  app.settle();
  CHECK_THROWS_WITH(app.slide(), "a slide: no picture leads here; save a picture of the window (Ctrl+S)");
}
