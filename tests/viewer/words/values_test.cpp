// Law: a number that is shown with all its digits, under the cursor, is the one that its name says.
#include <bit>
#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <string>

#include <doctest/doctest.h>

#include "sim/words/explain.hpp"
#include "tests/golden/golden.hpp"
#include "tests/viewer/words/printed.hpp"
#include "traces/formulas/shading.hpp"
#include "traces/formulas/walk.hpp"
#include "traces/replay/replay.hpp"

using namespace zstep;
using namespace zstep::test;

namespace {

/// The fields that a name stands for; where there is none, it is the field's own.
const std::map<std::string, std::string>& field_names() {
  static const std::map<std::string, std::string> names{{"1/m", "dx_dy"},
                                                        {"dz/dx", "dz_dx"},
                                                        {"dz/dy", "dz_dy"},
                                                        {"x_L", "x_left"},
                                                        {"x_R", "x_right"},
                                                        {"z_L", "z_left"},
                                                        {"z_R", "z_right"},
                                                        {"A", "plane_a"},
                                                        {"B", "plane_b"},
                                                        {"C", "plane_c"},
                                                        {"D", "plane_d"},
                                                        {"x'", "x_light"},
                                                        {"y'", "y_light"},
                                                        {"\u03b1", "opacity"},
                                                        {"share", "coverage"},
                                                        {"at the eye", "value"},
                                                        {"nearest corner", "value"},
                                                        {"a/z_v", "over_z"},
                                                        {"1/z_v", "one_over_z"},
                                                        {"a", "attribute"},
                                                        {"(p - e).n", "view_dot_normal"},
                                                        {"plane at eye", "plane_at_eye"},
                                                        {"projected n_z", "projected_normal_z"},
                                                        {"other low", "other_low"},
                                                        {"other high", "other_high"}};
  return names;
}

/// What a name says of a step: its field's value, or that of the state which it is about. None where it is computed.
struct Says {
  const Event& event;
  const State& state;
  const formulas::Situation at;
  std::string name;

  std::optional<double> number() const {
    const auto fields = fields_by_name(event);
    std::string field = name;
    if (const auto known = field_names().find(name); known != field_names().end()) field = known->second;
    const bool of_depth = name == "z" || name == "z*" || name == "z_v" || name == "z_r";
    for (const std::string& one : {field, field + "_edge", field + "_cut", field + "_at", field + "_curve"})
      if (const auto found = fields.find(one); found != fields.end() && one != "x") return found->second;
    if (of_depth)
      for (const char* one : {"z", "z_edge", "z_cut", "constant"})
        if (const auto found = fields.find(one); found != fields.end()) return found->second;
    if (fields.contains("constant")) return fields.at("constant");
    return visit_event([&](const auto& e) { return of_state(e); }, event);
  }

 private:
  template <class E>
  std::optional<double> of_state(const E& e) const {
    const MethodState& machine = state.machine;
    if constexpr (std::is_same_v<E, DepthCompare>) return machine.fragment->stored;
    if constexpr (std::is_same_v<E, EdgeFunction>) return name == "A" ? e.edge_a : name == "B" ? e.edge_b : e.edge_c;
    if constexpr (std::is_same_v<E, InsideTest>) return name == "E_0" ? e.e_0 : name == "E_1" ? e.e_1 : e.e_2;
    if constexpr (std::is_same_v<E, SampleTest>) return name == "S_0" ? e.s_0 : name == "S_1" ? e.s_1 : e.s_2;
    if constexpr (std::is_same_v<E, SampleDepth>) {
      const auto& before = machine.triangle.before;
      return before.polygon == no_polygon ? at.header.empty_depth() : before.z;
    }
    if constexpr (std::is_same_v<E, TileDepthTest>) return name == "nearest z" ? e.z_nearest : e.z_farthest;
    if constexpr (std::is_same_v<E, EdgeEnter>) return name == "x" ? at.edge(e.edge)->x_edge : at.edge(e.edge)->z_edge;
    if constexpr (std::is_same_v<E, HorizonTest>)
      return name == "upper[x]" ? machine.horizon.here->upper : machine.horizon.here->lower;
    if constexpr (std::is_same_v<E, ListInsert>) return at.piece(e.piece)->extent->z_max;
    if constexpr (std::is_same_v<E, ColorWrite>) {
      const formulas::Shading shading = formulas::shading_of(at.scene, at.header.conventions);
      const auto [a_0, a_1, a_2] = machine.components;
      if (name == "diffuse" || name == "highlight") {
        const bool at_pixel = shading.shade == formulas::Shade::phong;
        const formulas::Reflected light =
            at_pixel ? formulas::reflected(shading.lighting, {a_0, a_1, a_2}) : formulas::Reflected{a_0, a_1};
        return name == "diffuse" ? light.diffuse : light.highlight;
      }
      if (name == "column" || name == "row") {  // the golden traces have one image, mixed
        const formulas::OnTexture here = formulas::on_texture(at.scene.textures.front(), a_0, a_1);
        return name == "column" ? here.column : here.row;
      }
    }
    if constexpr (std::is_same_v<E, OutlineVertex>) {
      const auto p = at.on_raster(e.vertex);
      return name == "x_s" ? p->x : name == "y_s" ? p->y : p->z;
    }
    return std::nullopt;
  }
};

}  // namespace

TEST_CASE("law: a number with all its digits is the one that its name says") {
  std::set<std::string> computed;
  int held = 0;
  for_each_golden([&](const std::string& golden, const Trace& trace) {
    CAPTURE(golden);
    Replay replay(trace);
    while (replay.position() < trace.size()) {
      replay.step_forward();
      const Event event = replay.current()->event;
      const auto step = replay.position();
      CAPTURE(step);
      const formulas::Situation at = formulas::situation_of(trace, replay.state());
      for (const auto& value : explain(trace, replay.state(), *replay.current()).values) {
        CAPTURE(value.first);
        const auto said = Says{event, replay.state(), at, value.first}.number();
        if (!said) computed.insert(value.first);
        if (said) REQUIRE(std::bit_cast<std::uint64_t>(value.second) == std::bit_cast<std::uint64_t>(*said));
        held += said.has_value();
      }
    }
  });
  std::string all;
  for (const std::string& name : computed) all += name + ";";
  CHECK(all == "d_0;d_1;dz/dx;dz/dy;shadow[i,j];shadow[x',y'];");
  CHECK(held > 10'000);
}
