// The chain behind a number: every formula of it gives the number beside it, and it ends at the lines of the file.
#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <map>
#include <set>
#include <sstream>
#include <string>

#include <fmt/format.h>

#include "algorithms/scene/load.hpp"
#include "sim/answers/explain_value.hpp"
#include "tests/folder.hpp"
#include "tests/golden/golden.hpp"
#include "tests/where.hpp"

using namespace zstep;
using answers::Chain, answers::ChainLink, answers::ChainValue, answers::explain_value, answers::Question;

namespace {

const ChainLink* link_with(const Chain& chain, const std::string& what) {
  const auto found = std::find_if(chain.links.begin(), chain.links.end(),
                                  [&](const ChainLink& link) { return link.what.find(what) != std::string::npos; });
  return found == chain.links.end() ? nullptr : &*found;
}

/// Every formula gives its number; every operand is the number of the link that it names.
void check_numbers(const Chain& chain) {
  for (const ChainLink& link : chain.links)
    for (const ChainValue& value : link.values) {
      CAPTURE(link.step);
      CAPTURE(link.what);
      CAPTURE(answers::line_text(value));
      if (!value.formula.empty()) {
        CAPTURE(answers::evaluate(value));
        CHECK(answers::holds(value));
        if (value.exact) CHECK((answers::evaluate(value) == value.value || std::isnan(value.value)));
      }
      for (const answers::Operand& operand : value.operands) {
        if (operand.link < 0) continue;
        const ChainLink& other = chain.links.at(static_cast<std::size_t>(operand.link));
        const auto told = std::find_if(other.values.begin(), other.values.end(),
                                       [&](const ChainValue& one) { return one.name == operand.name; });
        REQUIRE(told != other.values.end());
        CHECK((told->value == operand.value || (std::isnan(told->value) && std::isnan(operand.value))));
      }
    }
}

}  // namespace

TEST_SUITE("explain a value") {
  TEST_CASE("of every field of steps of every golden trace: each formula gives its number") {
    std::map<std::string, int> asked;  // of each kind and field, in all traces
    test::for_each_golden([&](const std::string& name, const Trace& trace) {
      CAPTURE(name);
      std::map<std::pair<std::size_t, std::string>, int> here;
      const std::int64_t stride = std::max<std::int64_t>(1, trace.size() / 700);
      for (std::int64_t step = 1; step <= trace.size(); step += stride) {
        const std::size_t kind = trace.event(step).event.index();
        for (const std::string& field : answers::fields_of_step(trace, step)) {
          int& times = here[{kind, field}];
          if (++times > 3 && times % 64 != 0) continue;
          CAPTURE(step);
          CAPTURE(field);
          const Chain chain = explain_value(trace, Question{step, field});
          REQUIRE_FALSE(chain.links.empty());
          check_numbers(chain);
          ++asked[field];
        }
      }
    });
    CHECK(asked.size() > 60);
  }

  TEST_CASE("the depth of a pixel ends at the lines of the file, by every method") {
    struct Case {
      const char *method, *scene;
    };
    for (const Case one : std::array<Case, 10>{{{"z-buffer", "pyramid.toml"},
                                                {"scan-line", "pyramid.toml"},
                                                {"painter", "pyramid.toml"},
                                                {"depth-sort", "pyramid.toml"},
                                                {"bsp", "pyramid.toml"},
                                                {"warnock", "pyramid.toml"},
                                                {"ray-casting", "pyramid.toml"},
                                                {"ray-tracing", "mirror.toml"},
                                                {"transparency", "pyramid.toml"},
                                                {"shadow-buffer", "lamp.toml"}}}) {
      const std::string method = one.method;
      CAPTURE(method);
      Scene scene = load_scene(test::in_checkout("lessons/scenes/") + std::string(one.scene)).scene;
      scene.raster.width = scene.raster.height = 9;
      scene = look_at_scene(std::move(scene), {});
      const Trace trace = test::recorded_by(one.method, scene);
      int pixels = 0;
      for (std::int32_t y = 0; y < 9; ++y)
        for (std::int32_t x = 0; x < 9; ++x) {
          const Chain chain = explain_value(trace, answers::of_pixel(trace.size(), {x, y}));
          if (chain.links.empty()) continue;
          ++pixels;
          check_numbers(chain);
          CHECK_FALSE(chain.cut);
          std::set<std::string> lines;
          for (const ChainLink& link : chain.links)
            if (link.step == 0 && link.source.find(".toml:") != std::string::npos && link.what.starts_with("vertex"))
              lines.insert(link.source);
          CHECK_FALSE(lines.empty());
        }
      CHECK(pixels > 8);
    }
  }

  TEST_CASE("of a mesh that was placed and fitted: back to the numbers that stand in the mesh's own line") {
    const test::Folder folder;
    const std::string file = folder.write(
        "placed.toml",
        "[[polygon]]\npoints = [[-2, -2, -3], [2, -2, -3], [0, 2, -3]]\n[[mesh]]\nfile = \"" +
            test::in_checkout("tests/data/meshes/house.off") +
            "\"\n"
            "scale = [0.3, 0.7, 1.5]\nrotate = [20, 0, 90]\ntranslate = [0.1, 0, 2]\n[[mesh]]\nbuiltin = \"cube\"\n");
    const Scene loaded = load_scene(file).scene;
    for (const bool fit : {false, true}) {
      CAPTURE(fit);
      ViewOptions view;
      view.width = view.height = 24;
      view.fit = fit;
      const Scene scene = look_at_scene(loaded, view);
      const Trace trace = test::recorded_by("z-buffer", scene);
      std::set<std::string> ends;
      for (std::int32_t y = 0; y < 24; ++y)
        for (std::int32_t x = 0; x < 24; ++x) {
          const Chain chain = explain_value(trace, answers::of_pixel(trace.size(), {x, y}));
          check_numbers(chain);
          for (const ChainLink& link : chain.links) {
            if (link.step != 0) continue;
            CAPTURE(link.what);
            for (const ChainValue& value : link.values) {
              if (!value.formula.empty()) {
                CHECK(value.exact);
                continue;  // it goes on to where it comes from
              }
              // The end: the number as the file has it.
              CHECK_FALSE(link.source.empty());
              ends.insert(link.source.substr(0, link.source.find(':')));
              if (!link.source.starts_with("house.off")) continue;
              const auto line = static_cast<std::size_t>(std::stoi(link.source.substr(link.source.find(':') + 1)));
              std::ifstream mesh(test::in_checkout("tests/data/meshes/house.off"));
              std::string text;
              for (std::size_t k = 0; k < line; ++k) std::getline(mesh, text);
              std::istringstream numbers(text);
              std::array<double, 3> point{};
              for (double& number : point) numbers >> number;
              CHECK(value.value == point[static_cast<std::size_t>(value.name[0] - 'x')]);
            }
          }
        }
      CHECK(ends == std::set<std::string>{"cube", "house.off", "placed.toml"});
    }
  }

  TEST_CASE("lecture 004, eight by eight: z = x + y + 1, to the digit") {
    const Trace trace = open_jsonl(test::in_checkout("tests/golden/delhi.jsonl"));
    for (std::int32_t x = 0; x < 5; ++x) {
      // The second triangle was last drawn over row 1, where z = x + 2.
      const Chain chain = explain_value(trace, answers::of_pixel(trace.size(), {x, 1}));
      REQUIRE_FALSE(chain.links.empty());
      CHECK(chain.links[0].values[0].value == x + 1 + 1);
    }
    const Chain chain = explain_value(trace, Question{219, "z"});
    const ChainLink* depth = link_with(chain, "depth at x = 1 on the span");
    REQUIRE(depth);
    CHECK(depth->step == 218);
    CHECK(answers::line_text(depth->values[0]) ==
          "z = z_L + (z_R \u2212 z_L)\u00b7(x \u2212 x_L)/(x_R \u2212 x_L) = 4 + (7 \u2212 4)\u00b7(1 \u2212 0)/(3 "
          "\u2212 0) = 5");
    const ChainLink* edge = link_with(chain, "active edge e1 on scan line 3");
    REQUIRE(edge);
    CHECK(edge->step == 211);
    CHECK(answers::line_text(edge->values[0]) ==
          "z = z_0 + (z_1 \u2212 z_0)\u00b7(y \u2212 y_0)/(y_1 \u2212 y_0) = 2 + (7 \u2212 2)\u00b7(3 \u2212 1)/(6 "
          "\u2212 1) = 4");
    REQUIRE(link_with(chain, "edge e1 in the edge table"));
    CHECK(link_with(chain, "edge e1 in the edge table")->step == 157);
    const ChainLink* vertex = link_with(chain, "vertex 5 of the scene");
    REQUIRE(vertex);
    CHECK(vertex->step == 0);
    CHECK(vertex->values[1].value == 2);
    CHECK(vertex->depth == 5);
  }

  TEST_CASE("the stored depth that a fragment lost to has a chain of its own") {
    const Trace trace = open_jsonl(test::in_checkout("tests/golden/pyramid-behind.jsonl"));
    const auto lost = trace.next(0, [](const RecordedEvent& event) {
      const auto* compare = get_if<DepthCompare>(&event.event);
      return compare && !compare->nearer;
    });
    REQUIRE(lost);
    const DepthCompare compare = get<DepthCompare>(trace.event(*lost).event);
    const auto wrote = trace.previous(*lost, [&](const RecordedEvent& event) {
      const auto* write = get_if<DepthWrite>(&event.event);
      return write && write->x == compare.x && write->y == compare.y;
    });
    REQUIRE(wrote);
    const Chain chain = explain_value(trace, Question{*lost, "nearer"});
    CHECK(std::count_if(chain.links.begin(), chain.links.end(),
                        [&](const ChainLink& link) { return link.step == *wrote; }) == 1);
    CHECK(chain.links[0].values[0].value == 0);
    // Of both polygons there is a span.
    CHECK(std::count_if(chain.links.begin(), chain.links.end(),
                        [](const ChainLink& link) { return link.what.starts_with("span of"); }) == 2);
    const ChainValue& stored =
        chain.links[static_cast<std::size_t>(chain.links[0].values[0].operands.at(1).link)].values[0];
    REQUIRE(stored.operands.size() == 1);
    CHECK(chain.links.at(static_cast<std::size_t>(stored.operands[0].link)).step == *wrote);
    check_numbers(chain);
  }

  TEST_CASE("whether the light reaches a point is a condition with its numbers") {
    const Scene scene = look_at_scene(load_scene(test::in_checkout("lessons/scenes/lamp.toml")).scene, {});
    for (const char* bias : {"", "0", "40"}) {
      Conventions conventions;
      if (*bias != 0) conventions.options["bias"] = bias;
      CAPTURE(bias);
      const Trace trace = test::recorded_by("shadow-buffer", scene, conventions);
      std::array<int, 2> conditions{};
      int asked = 0;
      for (std::int64_t step = 1; step <= trace.size(); ++step) {
        const auto* compare = get_if<ShadowCompare>(&trace.event(step).event);
        if (!compare || ++asked % 31 != 0) continue;
        const bool lit = compare->lit;
        const Chain chain = explain_value(trace, Question{step, "lit"});
        REQUIRE_FALSE(chain.links.empty());
        const ChainValue& value = chain.links[0].values[0];
        CAPTURE(answers::line_text(value));
        CHECK(answers::holds(value));
        CHECK(value.condition);
        if (value.formula.empty()) {
          CHECK_FALSE(lit);  // beside the light's picture
          continue;
        }
        CHECK(value.formula == "z_v - bias <= z_shadow");
        const double thousandths = *bias == 0 ? 10 : std::stod(bias);
        CHECK(value.operands.at(1).value == doctest::Approx(value.operands.at(0).value * thousandths / 1000));
        ++conditions[lit];
      }
      CHECK(conditions[0] > 0);
      CHECK(conditions[1] > 0);
    }
  }

  TEST_CASE("a row of what the state holds is the last step that made it") {
    const Trace trace = open_jsonl(test::in_checkout("tests/golden/delhi.jsonl"));
    const auto place = answers::place_of(trace, answers::made_by<EdgeStep>(219, "x_edge", {{"edge", 1}}));
    REQUIRE(place);
    CHECK(place->step == 211);
    CHECK_FALSE(answers::place_of(trace, answers::made_by<EdgeStep>(219, "x_edge", {{"edge", 77}})));
    CHECK_FALSE(answers::place_of(trace, Question{219, "no_such_field"}));
    CHECK(explain_value(trace, Question{0, ""}).links.empty());
    CHECK(explain_value(trace, answers::of_pixel(trace.size(), {7, 7})).links.empty());
  }

  TEST_CASE("a coordinate of a vertex, from any of its stages") {
    const Trace trace = open_jsonl(test::in_checkout("tests/golden/pyramid.jsonl"));
    const auto asked = [&](const char* field) {
      return explain_value(trace, answers::of_vertex(trace.size(), 2, field));
    };
    const Chain screen = asked("y_s");
    REQUIRE(screen.links.size() == 4);
    for (std::size_t i = 0; i + 1 < screen.links.size(); ++i)
      CHECK(screen.links[i].step == screen.links[i + 1].step + (i < 2 ? 1 : screen.links[i].step));
    CHECK(screen.links.back().values.size() == 3);
    CHECK(asked("z").links.size() == 3);
    REQUIRE(asked("x_w").links.size() == 1);
    CHECK(asked("x_w").links[0].step == 0);
    CHECK(asked("x_w").links[0].values[0].value == trace.scene().points[2].x);
    check_numbers(screen);
  }

  TEST_CASE("a number that its formula does not give is noticed") {
    ChainValue value{"z", 3, "a + b*(c - 1)", {{"a", 1, -1, ""}, {"b", 2, -1, ""}, {"c", 2, -1, ""}}, true, false,
                     "",  ""};
    CHECK(answers::holds(value));
    value.value = 3.0000001;
    CHECK_FALSE(answers::holds(value));
    value.exact = false;
    CHECK_FALSE(answers::holds(value));
    value.value = 3 + 1e-12;
    CHECK(answers::holds(value));
    value.formula = "a +";
    CHECK_THROWS(answers::evaluate(value));
    value.formula = "max(a, -b) <= sqrt(4)";
    CHECK(answers::evaluate(value) == 1);
    CHECK(answers::numbers_text(value) == "max(1, \u22122) \u2264 sqrt(4)");
    value.operands[0].value = -1;
    value.formula = "a*b - a";
    CHECK(answers::numbers_text(value) == "\u22121\u00b72 \u2212 (\u22121)");
  }

  TEST_CASE("what a fixed-point number cannot hold is said to be rounded, or cut off") {
    for (const auto& [rounding, expected] : {std::pair(Conventions::Rounding::nearest, " = 2.4, rounded to 2"),
                                             {Conventions::Rounding::down, " = 2.4, cut off to 2"}}) {
      SceneFile file = load_scene(test::in_checkout("lessons/scenes/ramp.toml"));
      file.conventions.number_format = NumberFormat::fixed16;
      file.conventions.interpolation = Conventions::Interpolation::increments;
      file.conventions.rounding = rounding;
      const Trace trace = test::recorded_by("z-buffer", file.scene, file.conventions);
      std::int64_t step = 1;  // the first span of the ramp
      while (!holds<SpanBegin>(trace.event(step).event) || get<SpanBegin>(trace.event(step).event).dz_dx == 0) ++step;
      const Chain chain = explain_value(trace, Question{step, "dz_dx"});
      CHECK(answers::line_text(chain.links.at(0).values.at(0)).ends_with(expected));
    }
  }
}
