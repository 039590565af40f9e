// Of a depth buffer is spoken where the method's own steps use one, and nowhere else.
#include <set>
#include <string>

#include <doctest/doctest.h>

#include "sim/words/explain.hpp"
#include "tests/golden/golden.hpp"
#include "traces/file/header.hpp"
#include "traces/replay/replay.hpp"

using namespace zstep;

namespace {

bool speaks_of_buffer(const std::string& text) {
  for (const char* word : {"depth buffer", "zbuffer", "every depth becomes"})
    if (text.find(word) != std::string::npos) return true;
  return false;
}

}  // namespace

TEST_CASE("a method has a depth buffer, a line of one, or none, by the steps that it can record") {
  for (const Method& method : methods()) {
    CAPTURE(method.id);
    const std::set<std::string_view> with{"z-buffer", "half-space", "shadow-buffer", "transparency"};
    CHECK(depth_buffer(header_for(method, {})) ==
          (with.contains(method.id) ? DepthBuffer::picture : DepthBuffer::none));
  }
  Conventions by_line;
  by_line.options["resolve"] = "line-buffer";
  CHECK(depth_buffer(header_for(method("scan-line"), by_line)) == DepthBuffer::line);
}

TEST_CASE("law: words tell of a depth buffer only where the method's steps use one") {
  std::set<std::string> without, with, by_line;
  test::for_each_golden([&](const std::string& name, const Trace& trace) {
    CAPTURE(name);
    const DepthBuffer buffer = depth_buffer(trace.header());
    std::set<std::string>& methods_so = buffer == DepthBuffer::none   ? without
                                        : buffer == DepthBuffer::line ? by_line
                                                                      : with;
    methods_so.insert(trace.header().algorithm);
    bool told = false;
    Replay replay(trace);
    while (replay.position() < trace.size()) {
      replay.step_forward();
      const auto step = replay.position();
      CAPTURE(step);
      const Explanation said = explain(trace, replay.state(), *replay.current());
      bool speaks = speaks_of_buffer(said.sentence);
      for (const std::string& line : said.formulas) speaks = speaks || speaks_of_buffer(line);
      CAPTURE(said.sentence);
      if (buffer != DepthBuffer::picture) REQUIRE_FALSE(speaks);
      told = told || speaks;
    }
    if (buffer == DepthBuffer::picture) CHECK(told);
  });
  CHECK(without.size() >= 8);
  CHECK(with.size() == 4);
  CHECK(by_line.size() == 1);
}

TEST_CASE("law: a plane in the world is written with the world's coordinates, and one on the raster with its depth") {
  int world = 0, raster = 0;
  test::for_each_golden([&](const std::string& name, const Trace& trace) {
    CAPTURE(name);
    const std::string z = depth_symbol(trace.scene(), trace.header().conventions);
    Replay replay(trace);
    while (replay.position() < trace.size()) {
      replay.step_forward();
      const auto step = replay.position();
      CAPTURE(step);
      const Explanation said = explain(trace, replay.state(), *replay.current());
      const bool in_world = cuts_in_world(trace.scene(), replay.state().machine);
      std::vector<std::string> lines = said.formulas;
      lines.push_back(said.sentence);
      for (const std::string& line : lines) {
        if (line.find("C\u00b7") == std::string::npos || line.find("dX") != std::string::npos) continue;  // a ray's
        CAPTURE(line);
        const bool is_world = line.find("C\u00b7z_w") != std::string::npos;
        // The back-face test is made in the world whatever comes after it.
        CHECK(is_world == (in_world || holds<FacingTest>(replay.current()->event)));
        if (!is_world) CHECK(line.find("C\u00b7" + z) != std::string::npos);
        ++(is_world ? world : raster);
      }
    }
  });
  CHECK(world > 0);
  CHECK(raster > 0);
}
