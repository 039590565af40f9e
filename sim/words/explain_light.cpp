// What the light reaches (004, "shadow buffer").
#include "sim/words/explain_parts.hpp"
#include "traces/formulas/attributes.hpp"

namespace zstep::words {

void tell(Telling& t, const PassBegin& e) {
  t.say(e.pass == Pass::light ? "First the scene is drawn as the light sees it: its depth buffer is the shadow buffer."
                              : "Now the scene is drawn as the eye sees it; the shadow buffer is kept.");
}

void tell(Telling& t, const ShadowCompare& e) {
  const State& state = t.after;
  const std::int32_t polygon = state.picture.polygon[state.picture.at(e.x, e.y)];
  const double column = std::round(e.x_light), row = std::round(e.y_light);
  const bool inside = column >= 0 && column < state.light.width && row >= 0 && row < state.light.height;
  t.value("x'", e.x_light);
  t.value("y'", e.y_light);
  t.value("z_light", e.z_light);
  t.formula(fmt::format("x' = {}, y' = {} in the light's picture, z_light = {}", number(e.x_light), number(e.y_light),
                        number(e.z_light)));
  if (!inside) {
    t.say(fmt::format("The point of {} at pixel ({}, {}) lies beside the light's window: dark.", t.label(polygon), e.x,
                      e.y));
    return;
  }
  const std::size_t cell = state.light.at(static_cast<std::int32_t>(column), static_cast<std::int32_t>(row));
  const double stored = state.light.depth[cell];
  const auto [z, shadow] = tell_apart(e.z_light, stored);
  const std::string what = e.lit ? fmt::format("the light reaches {}", t.label(polygon))
                                 : fmt::format("{} is nearer to the light, so {} is in shadow",
                                               t.label(state.light.polygon[cell]), t.label(polygon));
  t.say(fmt::format("At pixel ({}, {}) {}.", e.x, e.y, what));
  if (!e.lit && t.trace.header().comparison.behind(e.z_light, stored) < 0)
    t.contradict(
        fmt::format("The trace says that {} is in shadow at pixel ({}, {}), but its depth, {}, is less than the {} "
                    "that the light sees there.",
                    t.label(polygon), e.x, e.y, z, shadow));
  t.formula(fmt::format("shadow[{}, {}] = {};  {} {} it {}", number(column), number(row), shadow, z,
                        e.lit ? "is not behind" : "is behind",
                        e.lit ? "by more than the bias" : "by more than the bias: dark"));
  t.value("shadow[x',y']", stored);
}

void tell(Telling& t, const ColorWrite& e) {
  const bool shaded =
      t.machine.shadow && !t.machine.shadow->lit && t.machine.shadow->x == e.x && t.machine.shadow->y == e.y;
  const auto& attribute = t.machine.attribute;
  const bool striped = attribute && attribute->x == e.x && attribute->y == e.y;
  const bool dark = striped && formulas::stripe_shade(attribute->attribute) < 1;
  t.say(fmt::format("Pixel ({}, {}) takes the colour {}, {}, {}{}.", e.x, e.y, e.r8, e.g8, e.b8,
                    shaded    ? ": its polygon is in shadow"
                    : dark    ? ": its polygon is in a dark stripe of a"
                    : striped ? ": its polygon is in a bright stripe of a"
                              : ""));
  t.formula(fmt::format("frame[{},{}] = ({}, {}, {})", e.x, e.y, e.r8, e.g8, e.b8));
}

}  // namespace zstep::words
