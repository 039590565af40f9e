// A list of tasks, each done by the keyboard alone and by the mouse alone: both end with the same state and the same
// picture. Some of them again with the events of a display server, in the program itself.
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <functional>
#include <iterator>
#include <stdexcept>

#include <unistd.h>

#include <doctest/doctest.h>
#include <fmt/format.h>

#include "traces/image/png.hpp"
#include "sim/words/escaped.hpp"
#include "tests/viewer/hands/hands.hpp"
#include "tests/where.hpp"

using namespace zstep;
using zstep::test::Hands;
using zstep::test::HandTask;
namespace fs = std::filesystem;

namespace {

const std::vector<HandTask>& hand_tasks() {
  static const std::vector<HandTask> all = test::read_hand_tasks(test::in_checkout("tests/viewer/hands/tasks.txt"));
  return all;
}

/// A folder for what is kept from run to run and for what is saved.
fs::path fresh_folder() {
  const fs::path folder = fs::temp_directory_path() / fmt::format("zstep-hands-{}", getpid());
  fs::remove_all(folder);
  fs::create_directories(folder / "kept");
  setenv("XDG_CONFIG_HOME", (folder / "kept").c_str(), 1);
  fs::current_path(folder);
  // An ffmpeg that keeps the frames as they come.
  static const std::string path = std::getenv("PATH");
  fs::create_directories(folder / "bin");
  std::ofstream(folder / "bin/ffmpeg") << "#!/bin/sh\nfor last; do :; done\ncat > \"$last\"\n";
  fs::permissions(folder / "bin/ffmpeg", fs::perms::owner_all);
  setenv("PATH", ((folder / "bin").string() + ":" + path).c_str(), 1);
  return folder;
}

enum class Way { keys, mouse };

bool possible(const HandTask& task, Way way) { return !(way == Way::keys ? task.keys : task.mouse).empty(); }

/// The hands after a task; what was wrong on the way is said.
std::unique_ptr<Hands> do_task(const HandTask& task, Way way) {
  CAPTURE(task.name);
  const std::string by = way == Way::keys ? "by keys" : "by mouse";
  CAPTURE(by);
  auto hands = std::make_unique<Hands>(test::hand_start(task.from));
  bool before = true;
  for (const std::string& check : task.then) before = hands->holds(check) && before;
  CHECK_MESSAGE(!before, "all of what the task does is so before it is done");
  for (const std::string& step : way == Way::keys ? task.keys : task.mouse) try {
      way == Way::keys ? hands->by_keys(step) : hands->by_mouse(step);
    } catch (const std::exception& error) {
      FAIL_CHECK((step + ": " + error.what()));
      break;
    }
  hands->rest();
  for (const std::string& check : task.then) {
    CAPTURE(hands->state());
    CHECK_MESSAGE(hands->holds(check), check);
  }
  return hands;
}

void do_both_ways(std::size_t first, std::size_t end) {
  const char* only = std::getenv("ZSTEP_HANDS_TASK");
  for (std::size_t k = first; k < std::min(end, hand_tasks().size()); ++k) {
    const HandTask& task = hand_tasks()[k];
    if (only && task.name.find(only) == std::string::npos) continue;
    std::string state;
    test::Bytes picture;
    for (const Way way : {Way::keys, Way::mouse}) {
      if (!possible(task, way)) continue;
      fresh_folder();
      const std::unique_ptr<Hands> hands = do_task(task, way);
      const std::string now = hands->state();
      const test::Bytes shown = hands->picture();
      if (way == Way::mouse && possible(task, Way::keys)) {
        CAPTURE(task.name);
        CHECK(now == state);
        const bool same_picture = shown == picture;
        CHECK(same_picture);
        if (const char* folder = std::getenv("ZSTEP_HANDS_PICTURES"); folder && !same_picture) {
          write_png(fmt::format("{}/{}-keys.png", folder, k + 1), Hands::width, Hands::height, picture);
          write_png(fmt::format("{}/{}-mouse.png", folder, k + 1), Hands::width, Hands::height, shown);
        }
      }
      state = now, picture = shown;
    }
  }
}

std::string bytes_of(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

}  // namespace

TEST_CASE("the tasks are sixty, each done by keys or by mouse, and few in one way only") {
  std::size_t one_way = 0;
  for (const HandTask& task : hand_tasks()) {
    CAPTURE(task.name);
    CHECK((possible(task, Way::keys) || possible(task, Way::mouse)));
    one_way += possible(task, Way::keys) != possible(task, Way::mouse);
  }
  MESSAGE(hand_tasks().size() << " tasks, " << one_way << " of them in one way only");
  CHECK(hand_tasks().size() >= 60);
  CHECK(one_way <= 2);
}

// In parts, for as many processors.
TEST_CASE("tasks 1 to 20, by keys alone and by mouse alone, end alike") { do_both_ways(0, 20); }
TEST_CASE("tasks 21 to 40, by keys alone and by mouse alone, end alike") { do_both_ways(20, 40); }
TEST_CASE("tasks 41 to the last, by keys alone and by mouse alone, end alike") { do_both_ways(40, 1000); }

TEST_CASE("with a display server's events the program shows the bytes of the same task without one") {
  const char* driver = std::getenv("SDL_VIDEODRIVER");
  if (!driver || std::string(driver) != "x11" || !display_available() ||
      std::system("command -v xdotool >/dev/null") != 0) {
    MESSAGE("skipped: there is no display server, or no xdotool");
    return;
  }
  const bool all = std::getenv("ZSTEP_HANDS_ALL") != nullptr;
  int done = 0;
  for (const HandTask& task : hand_tasks())
    for (const Way way : {Way::keys, Way::mouse}) {
      if (!possible(task, way) || !(task.real || all) || !task.not_real.empty()) continue;
      CAPTURE(task.name);
      const std::string by = way == Way::keys ? "by keys" : "by mouse";
      CAPTURE(by);
      const fs::path folder = fresh_folder();
      const std::unique_ptr<Hands> hands = do_task(task, way);
      if (hands->holds("quit") || hands->holds("playing") || hands->holds("full-screen")) continue;
      write_png((folder / "expected.png").string(), Hands::width, Hands::height, hands->picture());
      std::ofstream script(folder / "script");
      for (const std::string& line : hands->real()) script << line << '\n';
      script.close();
      fs::remove_all(folder / "kept");  // as the task left it
      const std::string command =
          fmt::format("bash {} {} {} {}", shell_word(test::in_checkout("tests/viewer/hands/real.sh")),
                      shell_word(test::program_path()), shell_word(folder.string()), task.from);
      CHECK(std::system(command.c_str()) == 0);
      const std::string shown = bytes_of(folder / "shown.png");
      CHECK(!shown.empty());
      const bool same = shown == bytes_of(folder / "expected.png");
      CHECK(same);
      ++done;
    }
  MESSAGE(done << " times with real events");
  CHECK(done >= 10);
}
