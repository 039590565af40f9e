// Inside a page of others: what leads and the transport, and nothing that opens over them.
#include <doctest/doctest.h>

#include "sim/viewer/app.hpp"
#include "tests/viewer/drive.hpp"
#include "tests/viewer/words/some_runs.hpp"

using namespace zstep;
using namespace zstep::viewer;

namespace {

Settings embedded_settings() {
  Settings settings;
  settings.embedded = true;
  return settings;
}

}  // namespace

TEST_CASE("embed: what leads has all of the window but the timeline, and keys step") {
  const Trace trace = test::record_run("pyramid");
  App app(trace, nullptr, embedded_settings(), 640, 400);
  app.session().go_to(300);
  app.set_lead("depth");
  app.settle();
  const Motion::Place stage = app.stage_place();
  CHECK(stage.at.y < 16);
  CHECK(stage.size.x > 620);
  CHECK(stage.size.y > 250);
  const test::Bytes before = test::picture(app);
  test::press(app, SDLK_RIGHT);
  CHECK(app.session().position() == 301);
  CHECK(test::picture(app) != before);
}

TEST_CASE("embed: no menu, list, page or drawer opens, by whatever key or button of the mouse") {
  const Trace trace = test::record_run("pyramid");
  App app(trace, nullptr, embedded_settings(), 640, 400);
  app.session().go_to(300);
  app.settle();
  const test::Bytes before = test::picture(app);
  for (const SDL_Keycode key : {SDLK_F1, SDLK_F10, SDLK_SLASH, SDLK_g, SDLK_h, SDLK_w, SDLK_e, SDLK_QUOTE})
    for (const auto modifiers : {KMOD_NONE, KMOD_LSHIFT, KMOD_LCTRL}) {
      test::press(app, key, static_cast<std::uint16_t>(modifiers));
      app.frame();
      CHECK(app.overlay() == Overlay::none);
      CHECK(app.drawer() == Drawer::none);
    }
  SDL_Event button{};
  button.type = SDL_MOUSEBUTTONDOWN;
  button.button.button = SDL_BUTTON_RIGHT;
  button.button.x = 300, button.button.y = 100;
  test::send(app, button);
  app.frame();
  button.type = SDL_MOUSEBUTTONUP;
  test::send(app, button);
  app.settle();
  CHECK(app.overlay() == Overlay::none);
  app.open_start();
  CHECK(app.overlay() == Overlay::none);

  App whole(trace, nullptr, {}, 640, 400);  // with everything, the same keys do open something
  test::press(whole, SDLK_F10);
  CHECK(whole.overlay() != Overlay::none);
}

TEST_CASE("embed: the button leads to the same place with everything") {
  const Trace trace = test::record_run("pyramid");
  App app(trace, nullptr, embedded_settings(), 1280, 720);
  app.opened_by = {"view", "pyramid", "--embed"};
  app.session().go_to(300);
  app.settle();
  CHECK(app.link() == "#scene=pyramid&embed=1&step=300");
  CHECK(app.link_of_whole() == "#scene=pyramid&step=300");
  app.end_embedding();
  app.settle();
  CHECK(app.link() == "#scene=pyramid&step=300");
  CHECK(app.stage_place().at.y > 16);
}
