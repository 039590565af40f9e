// The law of agreement on random meshes of n-gons, and on the mesh that first broke it.
#include <string>

#include "algorithms/scene/load.hpp"
#include "sim/truth/explain_difference.hpp"
#include "tests/laws/agreement/exact_methods.hpp"
#include "tests/laws/agreement/n_gons.hpp"
#include "tests/where.hpp"

using namespace zstep;
using namespace zstep::compare;
using namespace zstep::test;

namespace {

void hold(const Scene& scene, bool cull, int& explained, int& pixels) {
  Conventions conventions;
  conventions.cull = cull;
  const Truth truth(scene, cull);
  for (const Method* m : exact_methods()) {
    CAPTURE(m->id);
    const Verdict verdict = hold_against_truth(truth, scene, conventions, drawn(*m, scene, conventions));
    INFO(verdict.complaints());
    CHECK(verdict.holds());
    explained += verdict.explained(), pixels += truth.width() * truth.height();
  }
}

void hold_meshes(const std::string& name) {
  constexpr std::uint64_t meshes = 100;
  int explained = 0, pixels = 0;
  for (const NGonKind& kind : n_gon_kinds()) {
    if (kind.name != name) continue;
    for (std::uint64_t seed = 1; seed <= meshes; ++seed) {
      CAPTURE(seed);
      for (const Scene& view : two_views(kind.make(seed), seed)) hold(view, seed % 3 == 0, explained, pixels);
    }
  }
  MESSAGE(name, ": ", pixels, " pixels, ", explained, " at edges or ties");
  CHECK(pixels > 0);
  CHECK(explained * 50 <= pixels);  // so few that the rule cannot hide a fault
}

}  // namespace

TEST_CASE("law: on a polygon that is cut, and not quite planar, depth sort does not take its parts for others") {
  ViewOptions options;
  options.width = 160, options.height = 120;
  options.rho = 3, options.theta = -45, options.phi = 120;
  options.orthographic = true;
  options.near = 0.5, options.far = 10;
  const Scene scene = look_at_scene(load_scene(in_checkout("tests/data/meshes/two-facets.off")).scene, options);
  int explained = 0, pixels = 0;
  hold(scene, false, explained, pixels);
}

TEST_CASE("law: n-gons agree: not planar") { hold_meshes("not planar"); }
TEST_CASE("law: n-gons agree: nearly planar") { hold_meshes("nearly planar"); }
TEST_CASE("law: n-gons agree: concave") { hold_meshes("concave"); }
TEST_CASE("law: n-gons agree: thin") { hold_meshes("thin"); }
TEST_CASE("law: n-gons agree: through each other") { hold_meshes("through each other"); }
TEST_CASE("law: n-gons agree: nearly coplanar") { hold_meshes("nearly coplanar"); }
TEST_CASE("law: n-gons agree: pages of a book") { hold_meshes("pages of a book"); }
TEST_CASE("law: n-gons agree: a sheet") { hold_meshes("a sheet"); }
TEST_CASE("law: n-gons agree: an almost flat sheet") { hold_meshes("an almost flat sheet"); }
