// What presenter mode shows of the pseudo-code: enough to say what comes next.
#include <doctest/doctest.h>

#include <algorithm>
#include <string>

#include "algorithms/catalog/catalog.hpp"
#include "sim/viewer/model/label_spots.hpp"

using namespace zstep;
using viewer::lines_near;

TEST_CASE("a class sees the line at work, what it stands in, and always something that may come next") {
  for (const Method& one : methods()) {
    const Page page = one.page();
    for (std::size_t now = 0; now < page.size(); ++now) {
      const std::string method_name(one.id), line = page[now].text;
      CAPTURE(method_name);
      CAPTURE(line);
      const std::vector<bool> shown = lines_near(page, now);
      REQUIRE(shown.size() == page.size());
      CHECK(shown[now]);
      std::size_t body_end = now + 1;
      while (body_end < page.size() && page[body_end].indent > page[now].indent) ++body_end;
      std::uint8_t indent = page[now].indent;
      bool others = false, others_shown = false;
      for (std::size_t i = page.size(); i-- > 0;) {
        const bool around = i < now && page[i].indent < indent;
        if (around) {
          indent = page[i].indent;
          CHECK(shown[i]);
        } else if (i < now || i >= body_end) {
          others = true;
          others_shown = others_shown || shown[i];
        } else {
          CHECK(shown[i]);
        }
      }
      CHECK(others_shown == others);
    }
  }
}

TEST_CASE("a line that stands in its block alone is shown with what comes after the block") {
  const Page page = method("warnock").page();
  const auto line = [&](const std::string& begin) {
    const auto found =
        std::find_if(page.begin(), page.end(), [&](const StepInfo& step) { return step.text.rfind(begin, 0) == 0; });
    REQUIRE(found != page.end());
    return static_cast<std::size_t>(found - page.begin());
  };
  const std::vector<bool> shown = lines_near(page, line("it surrounds this one, too"));
  CHECK(shown[line("settle(area)")]);
  CHECK(shown[line("for each other polygon")]);
  CHECK_FALSE(shown[line("P goes into the polygon table")]);
}
