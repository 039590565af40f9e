// zstep explain, of a pixel that is shaded by its polygon's attribute: its colour, and what made that.
#include <algorithm>

#include <doctest/doctest.h>

#include "sim/answers/explain_value.hpp"
#include "tests/golden/golden.hpp"
#include "tests/where.hpp"
#include "traces/replay/replay.hpp"

using namespace zstep;
using answers::Chain, answers::ChainLink, answers::ChainValue;

namespace {

const ChainValue* value_called(const ChainLink& link, std::string_view name) {
  const auto found =
      std::find_if(link.values.begin(), link.values.end(), [&](const ChainValue& value) { return value.name == name; });
  return found == link.values.end() ? nullptr : &*found;
}

TEST_CASE(
    "explain: a shaded pixel leads to its colour and to its attribute, from there to the vertices, at any moment") {
  for (const char* golden : {"with-attribute", "with-attribute-linear"}) {
    const Trace trace = open_jsonl(test::in_checkout("tests/golden") + "/" + golden + ".jsonl");
    int shaded = 0;
    trace.each(0, trace.size(), [&](std::int64_t step, const RecordedEvent& recorded) {
      const auto* write = get_if<ColorWrite>(&recorded.event);
      if (!write) return true;
      CAPTURE(step);
      ++shaded;
      Replay replay(trace);
      replay.go_to(step);
      const double a = replay.state().machine.attribute->attribute;
      const Chain chain = answers::explain_value(trace, answers::of_pixel(step, {write->x, write->y}));
      CHECK(chain.links.front().what.starts_with("depth"));
      const auto of_step = [&](std::int64_t wanted) {
        return std::find_if(chain.links.begin(), chain.links.end(),
                            [&](const ChainLink& link) { return link.step == wanted; });
      };
      const auto colour = of_step(step), attribute = of_step(step - 1);
      REQUIRE(colour != chain.links.end());
      REQUIRE(attribute != chain.links.end());
      CHECK(colour->parent == 0);
      CHECK(attribute->parent == colour - chain.links.begin());
      REQUIRE(value_called(*colour, "red"));
      REQUIRE(value_called(*colour, "blue"));
      CHECK(value_called(*colour, "red")->value == write->r8);
      CHECK(value_called(*colour, "blue")->value == write->b8);
      REQUIRE(value_called(*attribute, "attribute"));
      CHECK(value_called(*attribute, "attribute")->value == a);
      bool from_vertex = false;
      for (const ChainLink& link : chain.links) {
        from_vertex = from_vertex || (link.step == 0 && link.what.starts_with("vertex"));
        for (const ChainValue& value : link.values) CHECK(answers::holds(value));
      }
      CHECK(from_vertex);
      CHECK_FALSE(chain.cut);
      return true;
    });
    CHECK(shaded > 5);
    // Before the first pixel is shaded there is nothing to tell.
    CHECK(answers::explain_value(trace, answers::of_pixel(1, {0, 0})).links.empty());
  }
}

TEST_CASE("explain: of a step that interpolates an attribute it is the attribute that is meant") {
  const Trace trace = open_jsonl(test::in_checkout("tests/golden/with-attribute.jsonl"));
  const auto step = trace.next<AttributeInterpolate>(0, [](const auto&) { return true; });
  REQUIRE(step);
  const Chain chain = answers::explain_value(trace, answers::Question{*step});
  REQUIRE(!chain.links.empty());
  CHECK(chain.links[0].values[0].name == "attribute");
}

}  // namespace
