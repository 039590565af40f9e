// The command line that opens a view again.
#include <doctest/doctest.h>

#include "sim/cli/run_options.hpp"
#include "sim/cli/show.hpp"
#include "sim/words/escaped.hpp"

using namespace zstep::cli;
using zstep::as_command;

TEST_CASE("the words of a command come back, quoted, without the step") {
  const auto back = [](const std::string& words) {
    CLI::App app;
    CLI::App* view = app.add_subcommand("view");
    RunOptions run;
    ShowOptions show;
    view->add_option("what", run.scene)->required();
    add_show_options(*view, show);
    add_run_options(*view, run);
    app.parse(words);
    return as_command(words_of(*view));
  };
  CHECK(back("view teapot") == "zstep view teapot");
  CHECK(back("view --at=40 teapot --no-cull --pixel 3,4 --lead slice") == "zstep view teapot --no-cull");
  CHECK(back("view 'my file.ztrace' --at 7") == "zstep view 'my file.ztrace'");
  for (const char* option :
       {"--no-cull", "--depth view", "--interpolation increments", "--coverage inclusive", "--near 2", "--far 9.5",
        "--fit", "--ortho", "--theta -30", "--size 64x48", "--presenter"}) {
    CAPTURE(option);
    CHECK(back(std::string("view teapot --at 3 ") + option) == std::string("zstep view teapot ") + option);
  }
}
