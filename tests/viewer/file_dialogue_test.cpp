// The desktop's dialogue for a file: what is chosen is dropped on the window.
#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <fstream>

#include <SDL.h>
#include <doctest/doctest.h>

#include "sim/viewer/desktop/file_dialogue.hpp"
#include "tests/folder.hpp"

using namespace zstep;
using namespace zstep::viewer;

namespace {

/// For as long as it lives, a desktop that has this program alone. Shells are found by their full paths.
class Desktop {
 public:
  Desktop(const std::string& program, const std::string& script) : before_(std::getenv("PATH")) {
    std::ofstream(folder_ / program) << "#!/bin/sh\n" << script << "\n";
    std::filesystem::permissions(folder_ / program, std::filesystem::perms::owner_all);
    setenv("PATH", folder_.path().c_str(), 1);
  }
  ~Desktop() { setenv("PATH", before_.c_str(), 1); }

 private:
  test::Folder folder_;
  std::string before_;
};

/// The file that is dropped within a while, or nothing.
std::string dropped(int milliseconds) {
  SDL_Event event;
  while (SDL_WaitEventTimeout(&event, milliseconds) != 0)
    if (event.type == SDL_DROPFILE) {
      const std::string path = event.drop.file;
      SDL_free(event.drop.file);
      return path;
    }
  return "";
}

}  // namespace

TEST_CASE("the file that is chosen in the desktop's dialogue comes as one that is dropped") {
  REQUIRE(SDL_InitSubSystem(SDL_INIT_VIDEO) == 0);
  SDL_EventState(SDL_DROPFILE, SDL_ENABLE);
  SUBCASE("zenity") {
    const Desktop desktop("zenity", "echo \"/a folder/mesh of zenity.obj\"");
    CHECK(dialogue_command("/x")[0] == "zenity");
    FileDialogue dialogue;
    REQUIRE(dialogue.ask("/x"));
    CHECK(dropped(5000) == "/a folder/mesh of zenity.obj");
  }
  SUBCASE("kdialog, in the folder that is asked for") {
    const Desktop desktop("kdialog", "echo \"$4\"scene.toml");
    FileDialogue dialogue;
    REQUIRE(dialogue.ask("/my scenes"));
    CHECK(dropped(5000) == "/my scenes/scene.toml");
  }
  SUBCASE("none is chosen: nothing comes, and it can be asked again") {
    const Desktop desktop("zenity", "echo /x; exit 1");
    FileDialogue dialogue;
    REQUIRE(dialogue.ask("/x"));
    CHECK(dropped(400) == "");
    REQUIRE(dialogue.ask("/x"));
    CHECK(dropped(400) == "");
  }
  SUBCASE("one that is open is ended with the window") {
    const Desktop desktop("zenity", "exec /bin/sleep 60");
    const auto begun = std::chrono::steady_clock::now();
    {
      FileDialogue dialogue;
      REQUIRE(dialogue.ask("/x"));
      REQUIRE(dialogue.ask("/x"));
    }
    CHECK(std::chrono::steady_clock::now() - begun < std::chrono::seconds(20));
  }
  SUBCASE("a desktop without one") {
    const Desktop desktop("another", "");
    FileDialogue dialogue;
    CHECK_FALSE(dialogue.ask("/x"));
  }
  SDL_QuitSubSystem(SDL_INIT_VIDEO);
}
