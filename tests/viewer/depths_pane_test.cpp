// A depth buffer is shown where the method has one; elsewhere the depths of what is shown, which do not lead.
#include <doctest/doctest.h>

#include <string>

#include "algorithms/catalog/catalog.hpp"
#include "sim/viewer/panes/pane.hpp"
#include "sim/viewer/panes/workspace.hpp"
#include "traces/file/header.hpp"

using namespace zstep;
using namespace zstep::viewer;

TEST_CASE("law: a pane is titled depth buffer where the method has one, and only that pane leads by itself") {
  int with = 0, without = 0;
  for (const Method& method : methods()) {
    CAPTURE(method.id);
    const Header header = header_for(method, {});
    const Pane* depths = depth_pane_of(header);
    const bool buffer = depth_buffer(header) == DepthBuffer::picture;
    if (!depths) {
      CHECK_FALSE(buffer);
      continue;
    }
    CHECK((std::string(depths->title) == "DEPTH BUFFER") == buffer);
    CHECK(std::string(depths->id) == "depth");  // lessons and links name both so
    bool leads = false;
    for (const Pane& pane : workspace(header, "").leading) leads = leads || std::string(pane.id) == "depth";
    if (!buffer) CHECK_FALSE(leads);
    ++(buffer ? with : without);
  }
  CHECK(with == 4);
  CHECK(without >= 6);
}
