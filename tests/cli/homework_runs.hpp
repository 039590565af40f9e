// A homework, and runs for it that are right to begin with.
#pragma once

#include <doctest/doctest.h>

#include <string>

#include "tests/cli/program.hpp"

namespace zstep::test {

/// In `folder`: the homework hw of the Z-buffer, and in runs/ a right run of each scene as JSON Lines without a header.
inline void set_up_runs(const Folder& folder) {
  REQUIRE(run(folder, "homework new z-buffer hw").code == 0);
  REQUIRE(shell(folder,
                "mkdir runs; for scene in hw/scenes/*.toml hw/hidden/*.toml; do name=$(basename $scene .toml); "
                "$zstep record $scene -o $name.ztrace && $zstep dump $name.ztrace --jsonl | tail -n +2 > "
                "runs/$name.jsonl && rm $name.ztrace || exit 1; done")
              .code == 0);
}

inline void replace_first(std::string& text, const std::string& from, const std::string& to) {
  const std::size_t at = text.find(from);
  REQUIRE(at != std::string::npos);
  text.replace(at, from.size(), to);
}

}  // namespace zstep::test
