// One pixel: z–x interpolation, attributes, the compare, the two writes (000, "The algorithm"; 004 for the tie), and
// what the light reaches (004).

#include <algorithm>
#include <optional>

#include "sim/words/explain_parts.hpp"
#include "traces/file/header.hpp"
#include "traces/formulas/attributes.hpp"
#include "traces/formulas/shading.hpp"
#include "traces/formulas/half_space.hpp"
#include "traces/formulas/of_shadows.hpp"

namespace zstep::words {
namespace {

std::string pixel(std::int32_t x, std::int32_t y) { return fmt::format("({}, {})", x, y); }

/// The pixel before, whose depth the increment was added to.
std::optional<Fragment> pixel_before(const Telling& t, const DepthInterpolate& e) {
  for (std::int64_t p = t.after.position - 1; p >= 1 && p > t.after.position - 16; --p) {
    const Event& event = t.trace.event(p).event;
    if (const auto* last = get_if<DepthInterpolate>(&event)) {
      if (last->y == e.y && last->x == e.x - 1) return Fragment{last->x, last->y, last->z, 0, no_polygon, no_ink, {}};
      return std::nullopt;
    }
    if (holds<SpanBegin>(event)) return std::nullopt;
  }
  return std::nullopt;
}

/// What the pseudo-code calls the buffer that this step compares with or writes to: "zbuffer", or "line" of a single
/// scan line.
bool by_line(const Telling& t) { return depth_buffer(t.trace.header()) == DepthBuffer::line; }
std::string buffer_of(const Telling& t) { return by_line(t) ? "line" : "zbuffer"; }
/// The same in a sentence.
std::string buffer_name(const Telling& t) { return by_line(t) ? "line buffer" : "depth buffer"; }
/// Its index: "x,y", or of a single scan line "x".
std::string pixel_of(const Telling& t, const std::string& x, const std::string& y) {
  return by_line(t) ? x : x + "," + y;
}

/// The depth that one of the few steps before this one found for the pixel; nullopt where none did.
template <class E>
std::optional<double> depth_just_before(const Telling& t, std::int32_t x, std::int32_t y) {
  for (std::int64_t p = t.after.position - 1; p >= 1 && p >= t.after.position - 3; --p) {
    const Event& event = t.trace.event(p).event;
    if (const auto* found = get_if<E>(&event))
      return found->x == x && found->y == y ? std::optional(found->z) : std::nullopt;
  }
  return std::nullopt;
}
std::optional<double> interpolated_at(const Telling& t, std::int32_t x, std::int32_t y) {
  return depth_just_before<DepthInterpolate>(t, x, y);
}
std::optional<double> compared_at(const Telling& t, std::int32_t x, std::int32_t y) {
  return depth_just_before<DepthCompare>(t, x, y);
}

/// Glass that is nearer: what is mixed in, and does not take the pixel for itself. nullopt for what hides all behind
/// it.
std::optional<double> glass_here(const Telling& t) {
  const bool mixes = records<ColorBlend>(t.trace.header());
  const std::int32_t at_work = t.at_work();
  const std::size_t polygon = at_work;
  if (!mixes || at_work < 0 || polygon >= t.scene.polygons.size()) return std::nullopt;
  const double opacity = t.scene.polygons[polygon].material->opacity;
  return opacity < 1 ? std::optional(opacity) : std::nullopt;
}

/// What the depth buffer was cleared to last; nullopt where no clearing is recorded.
std::optional<double> cleared_to(const Telling& t) {
  const auto clears = t.trace.clears();
  const auto after = std::upper_bound(clears.begin(), clears.end(), t.after.position);
  if (after == clears.begin()) return std::nullopt;
  return get<BuffersClear>(t.trace.event(*std::prev(after)).event).z;
}

/// Does the run have steps that say whose a pixel is?
bool records_owners(const Telling& t) {
  return t.trace.has(kind_of<PixelWrite>) || t.trace.has(kind_of<PixelPaint>) || t.trace.has(kind_of<ColorBlend>);
}

/// What is stored where a depth is compared, as far as it can be named.
struct Stored {
  double z = no_depth;
  bool empty = true;                   ///< the frame shows the background
  bool cleared = true;                 ///< the depth buffer holds what it was cleared to
  std::string who = "what is stored";  ///< "A", "what the depth buffer was cleared to"
};
Stored stored_of(const Telling& t, const Fragment& f) {
  Stored is{f.stored, f.stored_polygon == no_polygon, false, t.label(f.stored_polygon)};
  is.cleared = cleared_to(t).value_or(t.trace.header().empty_depth()) == f.stored;
  if (is.empty)
    is.who = is.cleared          ? fmt::format("what the {} was cleared to", buffer_name(t))
             : records_owners(t) ? "the depth that was written here without a colour"
                                 : "the depth that is stored here";
  return is;
}

/// Why a depth is nearer: "nearer than A", or that nothing is there which it could lie behind.
std::string nearer_text(const Stored& is, double z, const std::string& buffer) {
  if (z == is.z && !is.empty) return fmt::format("as near as {}, and of equals the last one stays", is.who);
  if (!is.cleared) return "nearer than " + is.who;
  if (!is.empty) return fmt::format("{} was drawn here, but the {} still holds what it was cleared to", is.who, buffer);
  return std::isinf(is.z) ? "nothing was drawn here yet"
                          : fmt::format("the {} was cleared to that, and nothing was drawn here yet", buffer);
}

/// The colour that is written to a pixel together with a compare.
struct Written {
  std::int64_t step = 0;
  std::int32_t polygon = no_polygon;
  bool unknown = false;  ///< the trace ends before, or has no steps that say so
  bool depth = false;    ///< the depth is written
};
template <class E>
bool is_at(const Event& event, std::int32_t x, std::int32_t y) {
  const E* found = get_if<E>(&event);
  return found && found->x == x && found->y == y;
}
Written write_of(const Telling& t, const DepthCompare& e) {
  const auto colour = [&](std::int64_t step) -> std::optional<Written> {
    const Event& event = t.trace.event(step).event;
    if (is_at<PixelWrite>(event, e.x, e.y)) return Written{step, get<PixelWrite>(event).polygon};
    if (is_at<ColorBlend>(event, e.x, e.y)) return Written{step, get<ColorBlend>(event).polygon};
    return std::nullopt;
  };
  bool depth = false;
  for (std::int64_t step = t.after.position + 1; step <= t.trace.size(); ++step) {
    if (const auto written = colour(step)) return *written;
    if (!is_at<DepthWrite>(t.trace.event(step).event, e.x, e.y)) break;
    depth = true;
    if (step == t.trace.size()) return {0, no_polygon, true, depth};
  }
  if (t.after.position == t.trace.size() || !records_owners(t)) return {0, no_polygon, true, depth};
  // Some programs write first and compare then.
  if (t.after.position > 1)
    if (const auto written = colour(t.after.position - 1)) return *written;
  return {0, no_polygon, false, depth};
}

/// "so pixel (1, 3) becomes A", as far as the trace has it.
std::string becomes_text(const Telling& t, const DepthCompare& e, const Written& written) {
  const std::string where = pixel(e.x, e.y);
  const bool named = t.polygon() != no_polygon;
  if (written.step != 0 && named && written.polygon != t.polygon())
    return fmt::format("so pixel {} should become {}, but step {} writes {}", where, t.here(), grouped(written.step),
                       t.label(written.polygon));
  if (written.step != 0 || (written.unknown && named))
    return fmt::format("so pixel {} becomes {}", where, written.step != 0 ? t.label(written.polygon) : t.here());
  return named ? fmt::format("so pixel {} should become {}, but {} is written", where, t.here(),
                             written.depth ? "its depth alone" : "nothing")
               : fmt::format("so pixel {} should be written, but the trace neither names a polygon nor writes one",
                             where);
}

}  // namespace

void tell(Telling& t, const DepthInterpolate& e) {
  t.say(fmt::format("At pixel {} polygon {} is at depth {}.", pixel(e.x, e.y), t.here(), number(e.z)));
  t.value(t.z, e.z);
  if (formulas::detail::weights_at(t.at, e.x, e.y) != nullptr) {
    t.derive(e);
    t.follows(t.z, "z", e.z);
    return;
  }
  if (!t.at.span_of(e)) return;
  if (t.at.adds_slopes()) t.derive_from(e, [&](MethodState& machine) { machine.fragment = pixel_before(t, e); });
  else t.derive(e);
  t.depth_on_span(e.z);
}

void tell(Telling& t, const DepthCompare& e) {
  const Fragment* f = t.machine.fragment ? &*t.machine.fragment : nullptr;
  const Stored is = f ? stored_of(t, *f) : Stored{};
  const Comparison& comparison = t.trace.header().comparison;
  const double stored = f ? f->stored : comparison.farthest();
  const auto [z, before] = tell_apart(e.z, stored);
  const bool numbers_say = f ? comparison.wins(e.z, stored) : e.nearer;
  const std::string_view sign = comparison.sign(), relation = e.z < stored ? "<" : e.z > stored ? ">" : "=";
  const auto glass = glass_here(t);
  const Written written = write_of(t, e);
  const std::string where = pixel(e.x, e.y), drawn = t.polygon() == no_polygon
                                                         ? "the polygon at work, which the trace does not name,"
                                                         : t.here();
  if (numbers_say != e.nearer) {
    const std::string undeclared = undeclared_text(t.trace.header(), e.z == stored),
                      says = e.nearer ? "nearer" : "not nearer";
    const std::string holds = fmt::format("{} {} {} is {}", z, sign, before, numbers_say ? "true" : "false");
    const std::string ought =
        fmt::format(": {} {} {}", drawn, numbers_say ? "should win over" : "should not win over", is.who);
    t.contradict(fmt::format("The trace says {} at pixel {}, although {}{}.", says, where, holds,
                             undeclared.empty() ? ought : "; " + undeclared));
  } else if (e.nearer && glass) {
    t.say(fmt::format(
        "{} {} {}: {}, so {} is seen at pixel {}; through its glass, of opacity {}, so is what lies behind: the two "
        "are mixed.",
        z, relation, before, std::isinf(stored) ? "nothing that is opaque was drawn here" : "nearer than " + is.who,
        drawn, where, number(*glass)));
  } else if (e.nearer) {
    t.say(fmt::format("{} {} {}: {}, {}.", z, relation, before, nearer_text(is, e.z, buffer_name(t)),
                      becomes_text(t, e, written)));
    const bool as_found =
        written.unknown || (written.step != 0 && (t.polygon() == no_polygon || written.polygon == t.polygon()));
    if (!as_found) t.out.doubt = t.out.sentence;
  } else if (written.step != 0 && written.step > t.after.position) {
    t.contradict(fmt::format("{} {} {}: {} is not nearer than {} at pixel {}, and step {} writes {} all the same.", z,
                             relation, before, drawn, is.who, where, grouped(written.step), t.label(written.polygon)));
  } else if (e.z == stored) {
    t.say(is.cleared || is.empty ? fmt::format("{} = {}: equal to {}, so pixel {} stays.", z, before, is.who, where)
          : t.trace.header().declares(Convention::ties)
              ? fmt::format("{} = {}: a tie, and {} was first, so pixel {} stays.", z, before, is.who, where)
              : fmt::format("{} = {}: a tie with {}, and the trace says not nearer, so pixel {} stays.", z, before,
                            is.who, where));
  } else {
    t.say(is.cleared || is.empty ? fmt::format("{} {} {}: {} is not nearer than {} at pixel {}, nothing is written.", z,
                                               relation, before, drawn, is.who, where)
                                 : fmt::format("{} {} {}: {} is hidden behind {} at pixel {}, nothing is written.", z,
                                               relation, before, drawn, is.who, where));
  }
  const std::string buffer = buffer_of(t) + "[" + pixel_of(t, "x", "y") + "]";
  t.formula(
      fmt::format("{} {} {}:  {} {} {}  is {}", t.z, sign, buffer, z, sign, before, numbers_say ? "true" : "false"));
  t.owns(t.z, t.at_work());
  if (f) t.owns(buffer, f->stored_polygon);
  t.value(t.z, e.z);
  if (const auto interpolated = interpolated_at(t, e.x, e.y))
    t.taken_over("compares", e.z, "interpolated", *interpolated);
  if (f) t.value(buffer, stored);
}

void tell(Telling& t, const DepthWrite& e) {
  const Fragment* f = t.machine.fragment ? &*t.machine.fragment : nullptr;
  const std::string where = buffer_name(t) + " at " + (by_line(t) ? fmt::format("x = {}", e.x) : pixel(e.x, e.y));
  if (f) {
    const auto [z, before] = tell_apart(e.z, f->stored);
    t.say(fmt::format("The {} takes {}; it held {}.", where, z, before));
  } else {
    t.say(fmt::format("The {} takes {}.", where, number(e.z)));
  }
  t.owns(fmt::format("{}[{}]", buffer_of(t), pixel_of(t, std::to_string(e.x), std::to_string(e.y))), t.at_work());
  t.formula(
      fmt::format("{}[{}] = {}", buffer_of(t), pixel_of(t, std::to_string(e.x), std::to_string(e.y)), number(e.z)));
  t.value(t.z, e.z);
  if (const auto compared = compared_at(t, e.x, e.y); compared && !t.taken_over("writes", e.z, "compared", *compared)) {
    const auto [written, held] = tell_apart(e.z, *compared);
    t.say(fmt::format("The {} takes {}, though {} was compared.", where, written, held));
  }
}

void tell(Telling& t, const ColorBlend& e) {
  const Fragment* f = t.machine.fragment && t.machine.fragment->x == e.x && t.machine.fragment->y == e.y
                          ? &*t.machine.fragment
                          : nullptr;
  const Color over = t.scene.polygons.at(e.polygon).color;
  const Color result{static_cast<std::uint8_t>(e.r8), static_cast<std::uint8_t>(e.g8), static_cast<std::uint8_t>(e.b8)};
  const auto text = [](Color color) { return fmt::format("({}, {}, {})", color.red, color.green, color.blue); };
  t.value("α", e.opacity);
  t.say(e.opacity >= 1 ? fmt::format("{} is opaque: pixel {} takes its colour.", t.label(e.polygon), pixel(e.x, e.y))
                       : fmt::format("{} is laid over what pixel {} shows, and hides {} of it.", t.label(e.polygon),
                                     pixel(e.x, e.y), number(e.opacity)));
  const auto mixed = [&](const std::string& top, const std::string& bottom) {
    return formulas::laid_over(Shown("α", e.opacity), Shown("colour of " + t.label(e.polygon), 0, top),
                               Shown("frame[x,y]", 0, bottom));
  };
  if (!f) {
    t.formula(fmt::format("{} = {}", mixed("", "").symbols(), text(result)));
    return;
  }
  const Color under = f->stored_ink != no_ink           ? color_of(f->stored_ink)
                      : f->stored_polygon == no_polygon ? t.scene.background
                                                        : t.scene.polygons.at(f->stored_polygon).color;
  t.formula(fmt::format("{} = {}", mixed(text(over), text(under)).equation(), text(result)));
  const auto off = [&](std::uint8_t top, std::uint8_t bottom, std::uint8_t is) {
    return std::abs(formulas::laid_over<double>(e.opacity, top, bottom) - is) > 0.5 + 1e-9;
  };
  if (off(over.red, under.red, result.red) || off(over.green, under.green, result.green) ||
      off(over.blue, under.blue, result.blue))
    t.doubt(fmt::format("The trace records {}, which is not this mixture rounded to whole numbers.", text(result)));
}

void tell(Telling& t, const PixelWrite& e) {
  const Fragment* f = t.machine.fragment ? &*t.machine.fragment : nullptr;
  const Picture& picture = t.after.picture;
  if (!picture.ink.empty() && picture.ink[picture.at(e.x, e.y)] != no_ink) {
    t.say(fmt::format("{} is the nearest of what hides at pixel {}.", t.label(e.polygon), pixel(e.x, e.y)));
    t.formula(fmt::format("polygon[{},{}] = {}", e.x, e.y, t.label(e.polygon)));
    return;
  }
  t.say(f ? fmt::format("Pixel {} takes the colour of {}; it showed {}.", pixel(e.x, e.y), t.label(e.polygon),
                        t.label(f->stored_polygon))
          : fmt::format("Pixel {} takes the colour of {}.", pixel(e.x, e.y), t.label(e.polygon)));
  t.formula(fmt::format("frame[{},{}] = colour of {}", e.x, e.y, t.label(e.polygon)));
}

// An attribute on its way to a pixel: Blinn's hyperbolic interpolation (traces/formulas/attributes.hpp).

namespace {

/// What is interpolated of it, between the span's ends where there is one: their own numbers come from the edges.
void along_span(Telling& t, const formulas::Situation& at, const AttributeInterpolate& e, const std::string& name,
                std::string_view field, double recorded, const char* letter) {
  const DerivedField* found = t.derived_of(field);
  const auto span = at.span_of(e);
  formulas::detail::Plainly plainly;
  const auto end = [&](std::int32_t edge) {
    const auto here = formulas::detail::over_depth_on_edge(plainly, at, e, edge, "", "");
    return here ? std::optional((field == "over_z" ? here->over_z : here->one_over_z).value) : std::nullopt;
  };
  const auto left = found && span ? end(span->left_edge) : std::nullopt,
             right = found && span ? end(span->right_edge) : std::nullopt;
  if (!left || !right || formulas::detail::weights_at(at, e.x, e.y) || span->x_left == span->x_right) {
    t.follows(name, field, recorded);
    return;
  }
  const std::string of = letter;
  t.gives(name, field,
          formulas::on_line(Shown(of + "_L", *left), Shown(of + "_R", *right), Shown("x", e.x),
                            Shown("x_L", span->x_left), Shown("x_R", span->x_right)),
          recorded, found->formula.rounded());
}

}  // namespace

void tell(Telling& t, const AttributeInterpolate& e) {
  const bool divides = formulas::attribute_over_depth(t.scene, t.conventions);
  const formulas::Shading shading = formulas::shading_of(t.scene, t.conventions);
  const bool known = shading.is_known() && t.machine.component < shading.components();
  const std::string_view name =
      known && shading.components() > 1 ? shading.name(t.machine.component) : std::string_view("a");
  t.say(divides ? fmt::format("At pixel ({}, {}) {} = {}: a/z_v and 1/z_v are linear on the picture, a itself is not.",
                              e.x, e.y, name, number(e.attribute))
                : fmt::format("At pixel ({}, {}) {} = {}, interpolated as it stands.", e.x, e.y, name,
                              number(e.attribute)));
  State before;
  before.vertices = t.after.vertices, before.machine = t.machine, before.position = t.after.position - 1;
  if (before.machine.component > 0) --before.machine.component;
  else before.machine.attribute.reset();
  const formulas::Situation at = formulas::situation_of(t.trace, before);
  t.derived = derived_fields(e, at);
  if (!divides) {
    along_span(t, at, e, "a", "over_z", e.over_z, "a");
    t.value("a", e.attribute);
    return;
  }
  along_span(t, at, e, "a/z_v", "over_z", e.over_z, "p");
  along_span(t, at, e, "1/z_v", "one_over_z", e.one_over_z, "q");
  t.follows("a", "attribute", e.attribute);
  t.value("a/z_v", e.over_z);
  t.value("1/z_v", e.one_over_z);
  t.value("a", e.attribute);
}

// What the light reaches (004, "shadow buffer").

void tell(Telling& t, const PassBegin& e) {
  t.say(e.pass == Pass::light ? "First the scene is drawn as the light sees it: its depth buffer is the shadow buffer."
                              : "Now the scene is drawn as the eye sees it; the shadow buffer is kept.");
}

/// The compare in z_v as the light sees it, in which the bias is measured; nothing where the trace does not say the
/// bias.
void tell_as_distances(Telling& t, const ShadowCompare& point, double stored, bool lit) {
  const formulas::ShadowOptions options = formulas::shadow_options(t.conventions);
  if (!t.at.lamp || !options.declared || !std::isfinite(stored)) return;
  const double z_v = view_depth(*t.at.lamp, t.conventions, point.z_light),
               shadow = view_depth(*t.at.lamp, t.conventions, stored);
  const auto& found = t.after.machine.shadow_bias;
  const bool sloped = found && found->x == point.x && found->y == point.y;
  const double bias = sloped ? found->bias : formulas::light_bias(z_v, options.bias, 0.0, 0.0);
  t.formula(fmt::format("z_v \u2264 stored z_v + bias = {} + {}:  {} \u2264 {}  is {}", number(shadow), number(bias),
                        number(z_v), number(shadow + bias), lit));
}

void tell(Telling& t, const ShadowCompare& e) {
  const State& state = t.after;
  const std::int32_t polygon = state.picture.polygon[state.picture.at(e.x, e.y)];
  const double column = std::round(e.x_light), row = std::round(e.y_light);
  const bool inside = column >= 0 && column < state.light.width && row >= 0 && row < state.light.height;
  t.value("x'", e.x_light);
  t.value("y'", e.y_light);
  t.value("z_light", e.z_light);
  t.formula(fmt::format("x' = {}, y' = {}, z_light = {}", number(e.x_light), number(e.y_light), number(e.z_light)));
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
  tell_as_distances(t, e, stored, e.lit);
  t.value("shadow[x',y']", stored);
}

void tell(Telling& t, const ShadowBias& e) {
  const std::string polygon = t.label(t.after.picture.polygon[t.after.picture.at(e.x, e.y)]);
  const double slope = std::max(std::abs(e.dz_dx_light), std::abs(e.dz_dy_light));
  t.say(
      fmt::format("At pixel ({}, {}) {} may lie {} behind the shadow buffer and still be lit: its distance from the "
                  "light changes by {} from pixel to pixel of the light's picture.",
                  e.x, e.y, polygon, number(e.bias), number(slope)));
  t.formula(fmt::format("m = {} without its sign = {}",
                        std::abs(e.dz_dx_light) >= std::abs(e.dz_dy_light) ? "dz/dx" : "dz/dy", number(slope)));
  t.value("dz/dx", e.dz_dx_light);
  t.value("dz/dy", e.dz_dy_light);
  t.value("bias", e.bias);
  const auto point = formulas::detail::point_at_light(t.at, e.x, e.y);
  const formulas::ShadowOptions options = formulas::shadow_options(t.conventions);
  if (!point || !options.declared) return;
  const Shown z_v("z_v", point->seen.z.value), constant("constant", options.bias), factor("factor", options.slope_bias),
      m("m", slope);
  t.gives("bias", "bias", formulas::light_bias(z_v, constant, factor, m), e.bias);
}

void tell(Telling& t, const ShadowNeighbour& e) {
  const State& state = t.after;
  const std::string polygon = t.label(state.picture.polygon[state.picture.at(e.x, e.y)]);
  if (state.light.depth.empty())
    return t.say(fmt::format("A neighbour in the shadow buffer of pixel ({}, {}).", e.x, e.y));
  const std::size_t cell = state.light.at(e.x_shadow, e.y_shadow);
  const std::string there = t.label(state.light.polygon[cell]),
                    nearer = there == polygon ? "its own depth there" : there;
  t.say(fmt::format("Held against its neighbour shadow[{}, {}], {} is {}.", e.x_shadow, e.y_shadow, polygon,
                    e.lit ? "lit" : "dark: " + nearer + " is nearer to the light"));
  t.value("shadow[i,j]", state.light.depth[cell]);
  const bool known = t.machine.shadow && t.machine.shadow->x == e.x && t.machine.shadow->y == e.y;
  if (!known) return;
  const auto [z, shadow] = tell_apart(t.machine.shadow->z_light, state.light.depth[cell]);
  t.formula(fmt::format("shadow[{}, {}] = {};  {} {} it by more than the bias{}", e.x_shadow, e.y_shadow, shadow, z,
                        e.lit ? "is not behind" : "is behind", e.lit ? "" : ": dark"));
  tell_as_distances(t, *t.machine.shadow, state.light.depth[cell], e.lit);
}

void tell(Telling& t, const LightShare& e) {
  std::size_t lit = t.machine.shadow && t.machine.shadow->lit ? 1 : 0;
  for (const ShadowNeighbour& neighbour : t.machine.neighbours) lit += neighbour.lit ? 1 : 0;
  const std::int32_t across = formulas::shadow_options(t.conventions).across;
  t.say(fmt::format("{} of {} compares say lit: {} of the light reaches pixel ({}, {}).", lit, across * across,
                    e.share == 1   ? "all"
                    : e.share == 0 ? "none"
                                   : number(e.share),
                    e.x, e.y));
  t.gives("share", "share", Shown("lit", static_cast<double>(lit)) / Shown("k²", across * across), e.share);
}

namespace {

/// What makes a pixel's colour of the numbers that were interpolated there.
std::string by_shade(Telling& t, const ColorWrite& e) {
  using formulas::Shade;
  const formulas::Shading shading = formulas::shading_of(t.scene, t.conventions);
  const std::int32_t polygon = t.after.picture.polygon[t.after.picture.at(e.x, e.y)];
  if (!shading.is_known() || polygon == no_polygon) return "";
  std::array<double, 3> a = t.machine.components;
  if (shading.components() == 1) a[0] = t.machine.attribute->attribute;  // also of a pixel that is written twice
  const Texture* const texture = formulas::texture_of(t.scene, polygon);
  const auto in = [](bool dark, const char* part) {
    return fmt::format(": its polygon is in a {} {}", dark ? "dark" : "bright", part);
  };
  const auto lit = [&t](const formulas::Reflected& light) {
    t.value("diffuse", light.diffuse), t.value("highlight", light.highlight);
    constexpr double least_seen = 0.5 / 255;
    return fmt::format(": {} of its polygon's colour{}", number(light.diffuse),
                       light.highlight < least_seen ? "" : fmt::format(", and {} of white", number(light.highlight)));
  };
  switch (shading.shade) {
    case Shade::stripes:
    case Shade::scalar:
      return in(formulas::stripe_shade(a[0]) < 1, "stripe of a");
    case Shade::checker:
      return in(formulas::checker_shade(a[0], a[1]) < 1, "square of u and v");
    case Shade::colors:
      return ": 255 times the colour that was interpolated";
    case Shade::gouraud:
      return lit({a[0], a[1]});
    case Shade::phong:
      return lit(formulas::reflected(shading.lighting, {a[0], a[1], a[2]}));
    case Shade::nearest:
    case Shade::bilinear:
      break;
  }
  if (texture == nullptr) return ", that of its polygon, which has no texture";
  const formulas::OnTexture at = formulas::on_texture(*texture, a[0], a[1]);
  const double column = shading.shade == Shade::nearest ? std::floor(at.column) : at.column,
               row = shading.shade == Shade::nearest ? std::floor(at.row) : at.row;
  t.value("column", column), t.value("row", row);
  return shading.shade == Shade::nearest
             ? fmt::format(": that of texel ({}, {}) of its texture", column, row)
             : fmt::format(": mixed of the four texels round ({}, {})", number(column), number(row));
}

}  // namespace

void tell(Telling& t, const ColorWrite& e) {
  const bool shaded =
      t.machine.shadow && !t.machine.shadow->lit && t.machine.shadow->x == e.x && t.machine.shadow->y == e.y;
  const auto& share = t.machine.light_share;
  const bool partly = share && share->x == e.x && share->y == e.y && share->share > 0;
  const auto& attribute = t.machine.attribute;
  const bool striped = attribute && attribute->x == e.x && attribute->y == e.y;
  t.say(fmt::format("Pixel ({}, {}) takes the colour {}, {}, {}{}.", e.x, e.y, e.r8, e.g8, e.b8,
                    partly ? fmt::format(": {} of the light reaches its polygon", share->share == 1 ? "all" : "a part")
                    : shaded  ? ": its polygon is in shadow"
                    : striped ? by_shade(t, e)
                              : ""));
  t.formula(fmt::format("frame[{},{}] = ({}, {}, {})", e.x, e.y, e.r8, e.g8, e.b8));
}

}  // namespace zstep::words
