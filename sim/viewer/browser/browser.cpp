// The system around the window, where it is a page of a browser: what the page's own script does
// (sim/web/page/page.js).
#include <algorithm>
#include <memory>
#include <optional>
#include <string>
#include <utility>

#include <SDL.h>
#include <emscripten.h>

#include "sim/viewer/field.hpp"
#include "sim/viewer/loop.hpp"
#include "sim/viewer/settings.hpp"
#include "sim/viewer/system.hpp"

// clang-format off
EM_JS(void, page_copy, (const char* text), { Module.page.copy(UTF8ToString(text)); })
EM_JS(void, page_choose_file, (), { Module.page.chooseFile(); })
EM_JS(void, page_hand_over, (const char* file), { Module.page.handOver(UTF8ToString(file)); })
EM_JS(void, page_keep, (const char* text), { Module.page.keep(UTF8ToString(text)); })
EM_JS(void, page_arrived, (const char* link, int at_stop), { Module.page.arrived(UTF8ToString(link), at_stop !== 0); })
EM_JS(void, page_open_beside, (const char* link), { Module.page.openBeside(UTF8ToString(link)); })
EM_JS(void, page_typing_at, (int left, int top, int right, int bottom),
      { Module.page.typingAt(left, top, right, bottom); })
EM_JS(void, page_say, (const char* text), { Module.page.say(UTF8ToString(text)); })
EM_JS(void, page_show_tables, (const char* list), { Module.page.showTables(UTF8ToString(list)); })
EM_JS(void, page_offer_commands, (const char* list), { Module.page.offerCommands(UTF8ToString(list)); })
EM_JS(void, page_opened, (), { Module.page.opened = true; })
EM_JS(void, page_shown, (), { Module.page.shown(); })
EM_JS(void, page_doze, (double milliseconds), { Module.page.doze(milliseconds); })
EM_JS(void, page_closed, (), { Module.page.closed(); })
EM_JS(int, page_hidden, (), { return document.visibilityState === 'hidden' ? 1 : 0; })
EM_JS(char*, page_address, (), { return stringToNewUTF8(Module.page.address()); })
// clang-format on

namespace zstep::viewer::system {
namespace {

/// What the page turns; it lives as long as the page does, or until the window is closed.
std::unique_ptr<Loop> turned_by_page;
bool shown = false;

/// A second after the last event the page turns it no longer, until the next one or until something is due.
constexpr int awake = 60, almost_asleep = awake - 2;  // turns
int still = 0;                                        // turns in which there was nothing to do

void doze() {
  constexpr double least = 0.3, most = 5;  // seconds
  still = turned_by_page->rests_for() >= least ? still + 1 : 0;
  if (still < awake) return;
  emscripten_pause_main_loop();
  page_doze(1000 * std::min(most, turned_by_page->rests_for()));
}

void turn() {
  if (!turned_by_page) return;
  if (page_hidden()) return;  // Firefox turns a tab in the background now and then, and what plays would go on unseen
  if (turned_by_page->turn(Loop::May::go_on)) {
    if (!std::exchange(shown, true)) page_shown();
    return doze();
  }
  emscripten_cancel_main_loop();
  turned_by_page.reset();
  page_closed();
}

}  // namespace

void keep_turning(std::unique_ptr<Loop> loop) {
  turned_by_page = std::move(loop);
  page_opened();
  emscripten_set_main_loop(turn, 0, false);
}

void copy_text(const std::string& text) {
  SDL_SetClipboardText(text.c_str());  // what is pasted into a field comes from there
  page_copy(text.c_str());
}

std::string ask_for_file() {
  page_choose_file();
  return "";
}

std::string hand_over(const std::filesystem::path& file) {
  page_hand_over(file.c_str());
  return "among your downloads";
}

void kept(const std::filesystem::path& folder) { page_keep(progress_text(folder).c_str()); }

std::string address() {
  const std::unique_ptr<char, decltype(&std::free)> text(page_address(), &std::free);
  return text.get();
}

void arrived(const std::string& link, bool at_stop) { page_arrived(link.c_str(), at_stop ? 1 : 0); }

bool open_beside(const std::string& link) {
  page_open_beside(link.c_str());
  return true;
}

void typing_at(const std::optional<TypedLine>& line) {
  const TypedLine at = line.value_or(TypedLine());
  page_typing_at(at.left, at.top, at.right, at.bottom);
}

bool is_heard() { return true; }

void say(const std::string& text) { page_say(text.c_str()); }

void show_tables(const std::string& list) { page_show_tables(list.c_str()); }

void offer_commands(const std::string& list) { page_offer_commands(list.c_str()); }

}  // namespace zstep::viewer::system

extern "C" {

/// The page's address has become another link. 1: the window went there; 0: it shows something else, and the page is
/// to be opened anew.
EMSCRIPTEN_KEEPALIVE int zstep_go_to_link(const char* link) {
  using namespace zstep::viewer;
  return system::turned_by_page && system::turned_by_page->go_to_link(link) ? 1 : 0;
}

/// An event came, or else what was waited for is due.
EMSCRIPTEN_KEEPALIVE void zstep_wake(int by_event) {
  using namespace zstep::viewer;
  if (!system::turned_by_page) return;
  system::still = by_event != 0 ? 0 : system::almost_asleep;
  emscripten_resume_main_loop();
}

/// A button of the page stands for this command.
EMSCRIPTEN_KEEPALIVE void zstep_run(const char* command) {
  using namespace zstep::viewer;
  if (system::turned_by_page) system::turned_by_page->run(command);
}

/// A file was dropped on the page or chosen, and lies there now.
EMSCRIPTEN_KEEPALIVE void zstep_drop_file(const char* path) {
  SDL_Event event{};
  event.type = SDL_DROPFILE;
  event.drop.file = SDL_strdup(path);
  if (SDL_PushEvent(&event) < 1) SDL_free(event.drop.file);
}

/// The reader pastes this text.
EMSCRIPTEN_KEEPALIVE void zstep_paste(const char* text) {
  SDL_SetClipboardText(text);
  for (const std::uint32_t type : {SDL_KEYDOWN, SDL_KEYUP}) {
    SDL_Event event{};
    event.type = type;
    event.key.keysym.sym = SDLK_v;
    event.key.keysym.mod = KMOD_LCTRL;
    SDL_PushEvent(&event);
  }
}

/// A keyboard that is drawn on the screen took back so many characters, and then typed this text.
EMSCRIPTEN_KEEPALIVE void zstep_type(const char* text, int taken_back) {
  for (int k = 0; k < taken_back; ++k)
    for (const std::uint32_t type : {SDL_KEYDOWN, SDL_KEYUP}) {
      SDL_Event event{};
      event.type = type;
      event.key.keysym.sym = SDLK_BACKSPACE;
      SDL_PushEvent(&event);
    }
  for (const std::string& part : zstep::viewer::in_text_events(text)) {
    SDL_Event event{};
    event.type = SDL_TEXTINPUT;
    std::copy(part.begin(), part.end(), event.text.text);
    SDL_PushEvent(&event);
  }
}

/// The page may be gone soon: what is to be kept is kept now.
EMSCRIPTEN_KEEPALIVE void zstep_keep_now() {
  using namespace zstep::viewer;
  if (system::turned_by_page) system::turned_by_page->save_now();
}

}  // extern "C"
