// Links: what they stand for, that they say the same as a command line, and that what comes from anywhere does no harm.
#include <doctest/doctest.h>

#include <random>
#include <string>
#include <vector>

#include "sim/words/link.hpp"
#include "tests/cli/program.hpp"
#include "traces/error.hpp"

using namespace zstep::test;
using zstep::InputError;
using zstep::link_of;
using zstep::words_of_link;
using Words = std::vector<std::string>;

namespace {

std::string why_not(const std::string& link) {
  try {
    words_of_link(link);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

}  // namespace

TEST_CASE("a link stands for the words of a command, and those for the link") {
  CHECK(words_of_link("#lesson=z-buffer&step=867&pixel=13,6&pane=slice&theme=dark") ==
        Words{"lesson", "z-buffer", "--at=867", "--pixel=13,6", "--lead=slice", "--dark"});
  CHECK(words_of_link("https://example.org/a/b/?q=1#scene=teapot:16&method=bsp&option=root%3Drandom&no-cull=on") ==
        Words{"view", "teapot:16", "--algorithm=bsp", "--option=root=random", "--no-cull"});
  CHECK(words_of_link("#scene=pyramid&change=vertex+3+%3D+1+0+2") ==
        Words{"view", "pyramid", "--change=vertex 3 = 1 0 2"});
  CHECK(words_of_link("#lesson=z-buffer&stop=3") == Words{"lesson", "z-buffer", "--at=stop 3"});
  CHECK(words_of_link("#embed=1&lesson=z-buffer&step=867&pane=slice") ==
        Words{"lesson", "z-buffer", "--embed", "--at=867", "--lead=slice"});
  // A stop stands at a step: the step counts, whichever is named first.
  CHECK(words_of_link("#lesson=z-buffer&stop=3&step=40") == Words{"lesson", "z-buffer", "--at=40"});
  CHECK(words_of_link("#lesson=z-buffer&step=40&stop=3") == Words{"lesson", "z-buffer", "--at=40"});
  CHECK(words_of_link("#&lesson=z-buffer&&") == Words{"lesson", "z-buffer"});

  const std::vector<Words> commands = {
      {"lesson", "z-buffer", "--at=867", "--pixel=13,6", "--lead=slice", "--dark"},
      {"lesson", "z-buffer", "--at=stop 3", "--light", "--presenter"},
      {"lesson", "z-buffer", "--embed", "--at=867", "--lead=slice"},
      {"view", "teapot:16", "--algorithm=bsp", "--option=root=random", "--size=64x48", "--ortho", "--fit"},
      {"view", "pyramid", "--change=vertex 3 = 1 0 2", "--change=a&b=#%+\"<script>\u00e9", "--number-format=float32"},
      {"view", "pyramid", "--race=z-buffer,bsp:root=random", "--race-by=operations", "--at=50%"},
      {"view", "pyramid", "--rho=5", "--theta=20.5", "--phi=-3e-7", "--d=2", "--window=1", "--near=-1", "--far=9"}};
  for (const Words& words : commands) {
    const auto link = link_of(words);
    REQUIRE(link);
    CAPTURE(*link);
    CHECK(zstep::is_link(*link));
    CHECK(words_of_link(*link) == words);
    CHECK(link->find_first_of("\"<> ") == std::string::npos);
  }
  CHECK(link_of(Words{"view", "pyramid", "--at", "7", "--dark"}) == "#scene=pyramid&step=7&theme=dark");
}

TEST_CASE("a link names no file and asks for nothing that is written, large or unknown") {
  CHECK_FALSE(link_of(Words{"view", "run.ztrace"}));
  CHECK_FALSE(link_of(Words{"view", "/tmp/mesh"}));
  CHECK_FALSE(link_of(Words{"check", "pyramid"}));
  CHECK_FALSE(link_of(Words{"view", "pyramid", "--screenshot", "a.png"}));
  CHECK_FALSE(link_of(Words{"view", "pyramid", "--change", std::string(5000, 'x')}));
  CHECK(has(why_not("#lesson=../secret"), "not the name of a lesson"));
  CHECK(has(why_not("#scene=%2Fetc%2Fpasswd"), "not the name of a scene"));
  CHECK(has(why_not("#scene=y+%3D+sin(x)"), "not the name of a scene"));
  CHECK(has(why_not("#scene=teapot:1600"), "not the name of a scene"));
  CHECK(has(why_not("#scene=--help"), "not the name of a scene"));
  CHECK(has(why_not("#scene=cube&screenshot=a.png"), "nothing that a link says"));
  CHECK(has(why_not("#scene=cube&against=a.ztrace"), "nothing that a link says"));
  CHECK(has(why_not("#scene=cube&size=100000x100000"), "no raster"));
  CHECK(has(why_not("#scene=cube&size=9223372036854775807x3"), "no raster"));
  CHECK(has(why_not("#scene=cube&size=-3x-3"), "no raster"));
  CHECK(has(why_not("#scene=cube&them=dark"), "did you mean theme?"));
  CHECK(has(why_not("#scene=cube&theme=red"), "neither dark nor light"));
  CHECK(has(why_not("#scene=cube&ortho=1"), "is not on"));
  CHECK(has(why_not("#scene=cube&embed=on"), "is not 1"));
  CHECK(has(why_not("#embed=1&step=3"), "what to open"));
  CHECK(has(why_not("#scene=cube&lesson=z-buffer"), "two things"));
  CHECK(has(why_not("#step=3"), "what to open"));
  CHECK(has(why_not("#scene=cube&step=%4"), "half a sign"));
  CHECK(has(why_not("#scene=cube&step=%zz"), "half a sign"));
  CHECK(has(why_not("#scene=cube&step=1%0A2"), "no letter"));
  CHECK(has(why_not("#scene=cube&step"), "no value"));
  CHECK(has(why_not("#scene=cube&change=" + std::string(5000, 'x')), "at most 4096 are read"));
}

TEST_CASE("whatever a link holds, it becomes words that a link may say, or one line") {
  const std::vector<std::string> seeds = {"#lesson=z-buffer&stop=3&step=867&pixel=13,6&pane=slice&theme=dark",
                                          "#embed=1&lesson=z-buffer&step=867&pane=slice",
                                          "#scene=teapot:16&method=bsp&option=root%3Drandom&size=64x48&no-cull=on",
                                          "#scene=pyramid&change=vertex+3+%3D+1+0+2&race=bsp,z-buffer&race-by=time"};
  std::mt19937 random(7);
  const auto below = [&](std::size_t n) { return static_cast<std::size_t>(random()) % n; };
  std::size_t good = 0, bad = 0;
  for (int k = 0; k < 20000; ++k) {
    std::string link = seeds[below(seeds.size())];
    for (std::size_t n = 1 + below(3); n > 0; --n) {
      const std::size_t at = 1 + below(link.size() - 1);
      switch (below(4)) {
        case 0:
          link[at] = static_cast<char>(below(256));
          break;
        case 1:
          link.erase(at, 1 + below(4));
          break;
        case 2:
          link.insert(at, 1, "&=%#+-"[below(6)]);
          break;
        default:
          link.insert(at, link.substr(below(link.size()), below(20)));
      }
      if (link.size() < 2) link = "#x";
    }
    try {
      const Words words = words_of_link(link);
      ++good;
      REQUIRE((words[0] == "lesson" || words[0] == "view"));
      REQUIRE(words[1].find_first_of("/.\\ ") == std::string::npos);
      for (std::size_t w = 2; w < words.size(); ++w) {
        REQUIRE(words[w].starts_with("--"));
        for (const char* no : {"--screenshot", "--describe", "--against", "--seconds", "--memory", "--size-window"})
          REQUIRE_FALSE(words[w].starts_with(no));
      }
      REQUIRE((!link_of(words) || words_of_link(*link_of(words)) == words));
    } catch (const InputError& error) {
      ++bad;
      const std::string line = error.what();
      REQUIRE(line.find('\n') == std::string::npos);
    }
  }
  CHECK(good > 1000);
  CHECK(bad > 1000);
}

TEST_CASE("a link opens the picture that its command opens") {
  const Folder folder;
  const auto same = [&](const std::string& link, const std::string& command) {
    CAPTURE(link);
    const Outcome by_link = shell(folder, "\"$zstep\" '" + link + "' --screenshot link.png");
    CHECK_MESSAGE(by_link.code == 0, by_link.err);
    REQUIRE(shell(folder, "\"$zstep\" " + command + " --screenshot command.png").code == 0);
    CHECK(shell(folder, "cmp link.png command.png").code == 0);
  };
  same("#lesson=z-buffer&step=867&theme=dark", "lesson z-buffer --at 867 --dark");
  same("https://example.org/zstep/#lesson=z-buffer&stop=3", "lesson z-buffer --at 'stop 3'");
  same("#scene=pyramid&method=bsp&step=20&change=theta+%3D+70&pixel=4,7&pane=tree",
       "view pyramid --algorithm bsp --at 20 --change 'theta = 70' --pixel 4,7 --lead tree");
  same("#embed=1&lesson=z-buffer&step=867&pane=slice", "lesson z-buffer --embed --at 867 --lead slice");
  const Outcome unknown = shell(folder, "\"$zstep\" '#lesson=zbuffer' --screenshot no.png");
  CHECK(unknown.code == 2);
  CHECK(has(unknown.err, "did you mean z-buffer?"));
  const Outcome no_pixel = shell(folder, "\"$zstep\" '#scene=cube&pixel=999,1' --screenshot no.png");
  CHECK(no_pixel.code == 2);
  CHECK(has(no_pixel.err, "they count from 0"));
  const Outcome no_pane = shell(folder, "\"$zstep\" '#scene=cube&pane=nothing' --screenshot no.png");
  CHECK(no_pane.code == 2);
  CHECK(has(no_pane.err, "no pane 'nothing' can lead here"));
  CHECK(shell(folder, "test ! -e no.png").code == 0);
}

TEST_CASE("a link that asks for too long a run gets its beginning, and is told so") {
  const Folder folder;
  const Outcome cut = run(folder, "'#scene=teapot:16&method=ray-casting&size=1024x768&step=100%25' --describe");
  CHECK_MESSAGE(cut.code == 0, cut.err);
  CHECK(has(cut.out, "Cut off after 4"));
}
