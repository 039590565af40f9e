// Rays: boxes and cells, the plane of a facet, the point on it, and what a ray brings back (002, "Simple Ray Tracing").
#include "sim/words/explain_parts.hpp"
#include "sim/answers/seen_point.hpp"
#include "traces/formulas/of_colors.hpp"

namespace zstep::words {
namespace {

std::string point(double x, double y, double z) { return fmt::format("({}, {}, {})", number(x), number(y), number(z)); }

std::string facet_name(const Telling& t, std::int32_t facet) {
  if (facet < 0 || facet >= std::ssize(t.scene.facets)) return "nothing";
  return t.label(t.scene.facets[facet].polygon);
}

/// "X = X_0 + t·dX", the point at t.
std::string point_at_t() {
  return "X = " + in_symbols([](auto&& name) { return formulas::on_ray(name("X_0"), name("t"), name("dX")); });
}
std::string along_normal() {
  return in_symbols([](auto&& name) {
    return formulas::dot<Shown>({name("A"), name("B"), name("C")}, {name("dX"), name("dY"), name("dZ")});
  });
}
std::string above_plane() {
  return in_symbols([](auto&& name) {
    return -formulas::plane_value(name("A"), name("B"), name("C"), name("D"), name("X_0"), name("Y_0"), name("Z_0"));
  });
}

std::string box_name(std::int32_t box) { return fmt::format("box {}", box); }

}  // namespace

void tell(Telling& t, const BoxMake& e) {
  t.say(e.parent < 0 ? fmt::format("{} is made{}.", box_name(e.box), e.box == 0 ? ": the first" : "")
                     : fmt::format("{} is made inside {}.", box_name(e.box), box_name(e.parent)));
  t.out.sentence[0] = 'B';
  t.formula(fmt::format("x {} to {},  y {} to {},  z {} to {}", number(e.x_min), number(e.x_max), number(e.y_min),
                        number(e.y_max), number(e.z_min), number(e.z_max)));
}

void tell(Telling& t, const BoxHold& e) {
  t.say(fmt::format("A facet of {} is in {}, and in no smaller box.", facet_name(t, e.facet), box_name(e.box)));
}

void tell(Telling& t, const GridMake& e) {
  t.say(fmt::format("Space is divided into {} \u00d7 {} \u00d7 {} cells of equal size.", e.cells_x, e.cells_y,
                    e.cells_z));
  t.formula(fmt::format("x {} to {},  y {} to {},  z {} to {}", number(e.x_min), number(e.x_max), number(e.y_min),
                        number(e.y_max), number(e.z_min), number(e.z_max)));
}

void tell(Telling& t, const CellHold& e) {
  t.say(fmt::format("The box of a facet of {} meets cell ({}, {}, {}): it goes in there.", facet_name(t, e.facet),
                    e.cell_x, e.cell_y, e.cell_z));
}

void tell(Telling& t, const RayBegin& e) {
  const std::string pixel = fmt::format("({}, {})", e.x, e.y);
  switch (e.role) {
    case RayRole::eye:
      t.say(fmt::format("A ray is cast from the eye through the {} of pixel {}.", seen_point(t.scene.raster), pixel));
      break;
    case RayRole::reflected:
      t.say("What does the facet mirror? A ray goes on where a mirror would send it.");
      break;
    case RayRole::transmitted:
      t.say("What lies behind the facet? A ray goes on through it, bent by refraction.");
      break;
    case RayRole::shadow:
      t.say("Does the light shine here? A ray is cast to it: t = 1 is the light.");
      break;
  }
  const Shown from("X_0", 0, point(e.x_0, e.y_0, e.z_0)), along("dX", 0, point(e.dir_x, e.dir_y, e.dir_z));
  t.formula("X = " + formulas::on_ray(from, Shown("t", 0, "t"), along).equation());
}

void tell(Telling& t, const CellVisit& e) {
  t.say(
      fmt::format("The ray enters cell ({}, {}, {}); only what is in there is tested.", e.cell_x, e.cell_y, e.cell_z));
  t.formula(fmt::format("from t = {} to t = {}", number(e.t_enter), number(e.t_leave)));
  t.value("t_enter", e.t_enter);
  t.value("t_leave", e.t_leave);
}

void tell(Telling& t, const BoxTest& e) {
  const auto [enter, leave] = tell_apart(e.t_enter, e.t_leave);
  if (!(e.t_enter <= e.t_leave)) {
    if (e.hit)
      t.doubt(fmt::format("The trace says that the ray meets {}, but t_enter = {} > {} = t_leave.", box_name(e.box),
                          enter, leave));
    t.say(fmt::format("The ray misses {}: it would enter the last of its slabs only after it has left the first.",
                      box_name(e.box)));
    t.formula(fmt::format("t_enter = {} > {} = t_leave", enter, leave), "t_enter");
  } else if (e.hit) {
    t.say(fmt::format("The ray meets {}: what is inside must be tested.", box_name(e.box)));
    t.formula(fmt::format("t_enter = {} \u2264 {} = t_leave", enter, leave), "t_enter");
  } else {
    t.say(fmt::format("The ray meets {}, but something nearer is known already: nothing inside can be seen.",
                      box_name(e.box)));
    t.formula(fmt::format("t_enter = {} lies beyond the t that is kept", number(e.t_enter)), "t_enter");
  }
  t.value("t_enter", e.t_enter);
  t.value("t_leave", e.t_leave);
}

void tell(Telling& t, const RayPlane& e) {
  const std::string who = facet_name(t, e.facet);
  if (std::isnan(e.t)) {
    t.say(fmt::format("The ray runs along the plane of {}: it never meets it.", who));
    t.formula(fmt::format("{} = {}{}", along_normal(), number(e.denominator),
                          e.denominator == 0 ? "" : ", which is 0 to rounding"),
              "denominator");
    return;
  }
  if (e.t < 0) t.say(fmt::format("The plane of {} lies behind the ray's start.", who));
  else t.say(fmt::format("The ray meets the plane of {} at t = {}.", who, number(e.t)));
  t.gives("t", "t", Shown(above_plane(), e.numerator) / Shown("(" + along_normal() + ")", e.denominator), e.t);
  t.value("numerator", e.numerator);
  t.value("denominator", e.denominator);
  t.value("t", e.t);
}

namespace {

/// What the ray kept before this hit: the last of its hits that was the nearest then.
const RayHit* kept_before(const Telling& t) {
  const std::vector<RayHit>& hits = t.machine.rays.hits;
  for (std::size_t k = hits.size() - (hits.empty() ? 0 : 1); k-- > 0;)
    if (hits[k].nearest) return &hits[k];
  return nullptr;
}

/// Why a hit inside its facet is kept, or not.
std::string why_kept(Telling& t, const RayHit& e, const std::string& who) {
  const RayHit* kept = kept_before(t);
  const std::string inside = fmt::format("The point lies inside {}", who);
  if (kept == nullptr)
    return e.nearest ? inside + ", the first that the ray meets: it is kept." : inside + ", and it is not kept.";
  const auto [here, before] = tell_apart(e.t, kept->t);
  const std::string other = facet_name(t, kept->facet);
  const Comparison& comparison = t.trace.header().comparison;
  const bool wins = comparison.wins(e.t, kept->t);
  if (e.t != kept->t || wins == e.nearest)  // of a tie the order in the file may decide otherwise
    t.formula(fmt::format("t {0} t kept:  {1} {0} {2}  is {3}", comparison.sign(), here, before, wins));
  if (e.t == kept->t) {
    if (e.nearest != (e.facet < kept->facet))
      return inside + (e.nearest ? fmt::format(", just as near as {}: a tie, and it takes its place.", other)
                                 : fmt::format(", just as near as {}: a tie, and {} stays.", other, other));
    return inside + fmt::format(", just as near as {}: a tie, and {}, the first of the two in the file, {}.", other,
                                e.nearest ? who : other, e.nearest ? "is kept" : "stays");
  }
  return inside + (e.nearest ? fmt::format(", nearer than {}, which was kept so far: it is kept.", other)
                             : fmt::format(", but {} is nearer: it is not kept.", other));
}

/// Where what is kept and the numbers part.
void check_kept(Telling& t, const RayHit& e) {
  const RayHit* kept = kept_before(t);
  const RayBegin* ray = formulas::detail::ray_at_work(t.at);
  const std::string who = facet_name(t, e.facet);
  if (e.nearest && !e.inside)
    return t.contradict(fmt::format("The point lies outside {}, and yet the trace keeps it.", who));
  if (!e.inside) return;
  if (kept == nullptr) {
    const bool should = !e.nearest && ray && ray->role == RayRole::eye;
    if (should)
      t.contradict(
          fmt::format("The point lies inside {}, and nothing nearer is known, but the trace does not keep it.", who));
    return;
  }
  const double behind = t.trace.header().comparison.behind(e.t, kept->t);
  const auto [its, other] = tell_apart(e.t, kept->t);
  if (e.nearest && behind > 0)
    t.contradict(
        fmt::format("The point lies inside {} at t = {}, and the trace keeps it, though {} at t = {} is nearer.", who,
                    its, facet_name(t, kept->facet), other));
  if (!e.nearest && behind < 0)
    t.contradict(fmt::format("The point lies inside {} at t = {}, nearer than {} at t = {}, but the trace keeps {}.",
                             who, its, facet_name(t, kept->facet), other, facet_name(t, kept->facet)));
}

}  // namespace

void tell(Telling& t, const RayHit& e) {
  const std::string who = facet_name(t, e.facet);
  t.say(e.inside ? why_kept(t, e, who) : fmt::format("The point lies outside {}.", who));
  check_kept(t, e);
  t.formula(fmt::format("{} = {}", point_at_t(), point(e.x_hit, e.y_hit, e.z_hit)));
  t.value("t", e.t);
  t.derive(e);
  t.hold_derived("x_hit", "x_hit", e.x_hit);
  t.hold_derived("y_hit", "y_hit", e.y_hit);
  t.hold_derived("z_hit", "z_hit", e.z_hit);
}

void tell(Telling& t, const RayEnd& e) {
  const RayRow* ended = nullptr;
  for (const RayRow& row : t.machine.rays.tree)
    if (row.entry.ray == e.ray) ended = &row;
  const std::string tests = e.tests == 1 ? "1 facet was tested" : fmt::format("{} facets were tested", e.tests);
  if (ended && ended->entry.role == RayRole::shadow)
    t.say(e.nearest_facet < 0
              ? fmt::format("Nothing is between the point and the light; {}.", tests)
              : fmt::format("{} is between the point and the light; {}.", facet_name(t, e.nearest_facet), tests));
  else if (e.nearest_facet < 0) t.say(fmt::format("The ray meets nothing; {}.", tests));
  else t.say(fmt::format("The ray meets {} first, at t = {}; {}.", facet_name(t, e.nearest_facet), number(e.t), tests));
  if (ended && ended->entry.role == RayRole::shadow) return;
  t.formula(fmt::format("it brings back red {}, green {}, blue {}", number(e.red), number(e.green), number(e.blue)));
  const auto back = formulas::detail::light_back(e, t.at);
  if (!back || (e.red == 0 && e.green == 0 && e.blue == 0)) return;  // to some programs colours are nothing
  const double light[] = {e.red, e.green, e.blue};
  const char* names[] = {"red", "green", "blue"};
  for (std::size_t k = 0; k < 3; ++k) t.gives(names[k], names[k], back->channel<Shown>(k), light[k]);
}

}  // namespace zstep::words
