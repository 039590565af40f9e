// The completion scripts: the shell accepts them, and completing gives the words that the commands take.
#include <doctest/doctest.h>

#include <string>

#include "tests/cli/program.hpp"

using namespace zstep::test;

namespace {

bool have(const Folder& folder, const std::string& program) { return shell(folder, "command -v " + program).code == 0; }

/// What bash offers after these words; the last one is incomplete.
std::string offered(const Folder& folder, const std::string& words) {
  write_text(folder / "offer.bash",
             "source \"$1\"\nshift\nCOMP_WORDS=(\"$@\")\nCOMP_CWORD=$(($# - 1))\n_zstep\nprintf '%s\\n' "
             "\"${COMPREPLY[@]}\"\n");
  const Outcome outcome = shell(folder, "bash offer.bash ./zstep.bash zstep " + words);
  return "\n" + outcome.out;
}

bool has_line(const std::string& text, const std::string& line) {
  return text.find("\n" + line + "\n") != std::string::npos;
}

}  // namespace

TEST_CASE("bash completes commands, options, values, scenes and files") {
  const Folder folder;
  if (!have(folder, "bash")) return;
  REQUIRE(shell(folder, "\"$zstep\" completion bash > zstep.bash && bash -n zstep.bash").code == 0);
  CHECK(has_line(offered(folder, "re"), "render"));
  CHECK(has_line(offered(folder, "re"), "record"));
  CHECK_FALSE(has_line(offered(folder, "re"), "list"));
  CHECK(has_line(offered(folder, "record --si"), "--size"));
  CHECK(has_line(offered(folder, "record pyramid --depth ''"), "pseudodepth"));
  CHECK(has_line(offered(folder, "record pyramid --algorithm z"), "z-buffer"));
  CHECK(has_line(offered(folder, "render teap"), "teapot"));
  CHECK(has_line(offered(folder, "lesson z-"), "z-buffer"));
  CHECK(has_line(offered(folder, "completion f"), "fish"));
  write_text(folder / "teapot of mine.obj", "");
  CHECK(has_line(offered(folder, "render teap"), "teapot of mine.obj"));
  CHECK(has_line(offered(folder, "record pyramid -o teap"), "teapot of mine.obj"));
}

TEST_CASE("zsh and fish accept their scripts") {
  const Folder folder;
  CHECK(shell(folder, "\"$zstep\" completion zsh > zstep.zsh && \"$zstep\" completion fish > zstep.fish").code == 0);
  CHECK(times(text_of(folder / "zstep.zsh"), "--save-ids") == 2);
  CHECK(times(text_of(folder / "zstep.fish"), "-l save-ids") == 2);
  if (have(folder, "zsh")) CHECK(shell(folder, "zsh -n zstep.zsh").code == 0);
  if (have(folder, "fish")) CHECK(shell(folder, "fish -n zstep.fish").code == 0);
}
