// The one table of all methods.
#include <doctest/doctest.h>

#include <algorithm>
#include <set>
#include <string>

#include "algorithms/catalog/catalog.hpp"
#include "traces/error.hpp"

using namespace zstep;

TEST_SUITE("catalog") {
  TEST_CASE("every method has an id of its own, a title, a paper, and a page whose steps can be told apart") {
    std::set<std::string> ids;
    for (const Method& method : methods()) {
      CHECK(ids.insert(std::string(method.id)).second);
      CHECK(&zstep::method(method.id) == &method);
      CHECK(!method.title.empty());
      CHECK(!method.paper.empty());
      std::set<int> steps;
      for (const StepInfo& step : method.page()) {
        CHECK(step.id < step_limit);
        CHECK(step.kind < kind_count);
        CHECK(!step.text.empty());
        CHECK(steps.insert(step.id).second);
      }
      CHECK(!steps.empty());

      Conventions conventions;
      conventions.cull = false;
      const Header header = header_for(method, conventions);
      CHECK(header.algorithm == method.id);
      CHECK(header.conventions == conventions);
      // Lines of options that are off may be left out.
      const Page page = method.page();
      for (const StepInfo& step : header.page) CHECK(std::find(page.begin(), page.end(), step) != page.end());
      CHECK((method.page_for || header.page == page));
      CHECK(header.writer.rfind("zstep ", 0) == 0);
    }
  }

  TEST_CASE("under a parallel camera no line of a page divides by z_v or asks where the eye is") {
    int said = 0;
    for (const Method& method : methods()) {
      const Page page = header_for(method, {}, Camera::Kind::orthographic).page;
      const Page usual = header_for(method, {}).page;
      REQUIRE(page.size() == usual.size());
      for (std::size_t k = 0; k < page.size(); ++k) {
        CHECK(page[k].id == usual[k].id);
        CHECK(page[k].text.find("/z_v") == std::string::npos);
        CHECK(page[k].text.find("p \u2212 e") == std::string::npos);
        said += page[k].text != usual[k].text;
      }
    }
    CHECK(said > 20);
  }

  TEST_CASE("an unknown id is an error that lists the known ones") {
    std::string what;
    try {
      method("zbuffer");
    } catch (const InputError& error) {
      what = error.what();
    }
    CHECK(what.find("z-buffer") != std::string::npos);
    CHECK(what.find("zbuffer") != std::string::npos);
  }
}
