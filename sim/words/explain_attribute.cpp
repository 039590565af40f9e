// An attribute on its way to a pixel: Blinn's hyperbolic interpolation (traces/formulas/attributes.hpp).
#include "sim/words/explain_parts.hpp"
#include "traces/formulas/attributes.hpp"

namespace zstep::words {

void tell(Telling& t, const AttributeInterpolate& e) {
  const bool divides = formulas::attribute_over_depth(t.scene, t.conventions);
  t.say(divides ? fmt::format("At pixel ({}, {}) a = {}: a/z and 1/z are linear on the picture, a itself is not.", e.x,
                              e.y, number(e.attribute))
                : fmt::format("At pixel ({}, {}) a = {}, interpolated as it stands.", e.x, e.y, number(e.attribute)));
  t.derive(e);
  if (!divides) {
    t.follows("a", "over_z", e.over_z);
    t.value("a", e.attribute);
    return;
  }
  t.follows("a/z", "over_z", e.over_z);
  t.follows("1/z", "one_over_z", e.one_over_z);
  t.follows("a", "attribute", e.attribute);
  t.value("a/z", e.over_z);
  t.value("1/z", e.one_over_z);
  t.value("a", e.attribute);
}

}  // namespace zstep::words
