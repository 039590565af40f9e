// The pictures of every exact method that gives surfaces against Embree's rays, by the rule of the law of agreement:
// where two differ, the pixel's centre lies within 1.5/256 px of an edge of what can be seen there, or depths are equal
// to 1e-5. Embree computes in float32; where it sees the same polygon, its depth must be the method's to 1e-5 of it and
// to what a shift of the ray by the last bits of float32 coordinates makes of it.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "algorithms/catalog/catalog.hpp"
#include "algorithms/scene/load.hpp"
#include "tests/embree/embree.hpp"
#include "sim/truth/explain_difference.hpp"
#include "tests/laws/agreement/scenes.hpp"

using namespace zstep;
using namespace zstep::compare;
using namespace zstep::test;

namespace {

struct Sum {
  int pixels = 0, drawn = 0, at_edges = 0, ties = 0;
  double worst_depth = 0;
};

Scene seen(Scene scene, double rho, double theta, double phi, bool orthographic) {
  ViewOptions options;
  options.rho = rho, options.theta = theta, options.phi = phi;
  options.d = rho, options.orthographic = orthographic;
  options.width = 200, options.height = 150;
  options.fit = true;
  return look_at_scene(std::move(scene), options);
}

void hold_depths(const Truth& truth, const Scene& scene, const Conventions& conventions, const Picture& picture,
                 const Picture& embrees, Sum& sum) {
  const double shift = truth.width() * 0x1p-22;  // pixels: four roundings of a float32 at the raster's width
  int wrong = 0;
  for (std::int32_t y = 0; y < truth.height(); ++y) {
    for (std::int32_t x = 0; x < truth.width(); ++x) {
      const std::size_t pixel = picture.at(x, y);
      const std::int32_t polygon = picture.polygon[pixel];
      if (polygon == no_polygon || polygon != embrees.polygon[pixel]) continue;
      const double ours = view_depth(scene.camera, conventions, picture.depth[pixel]), theirs = embrees.depth[pixel];
      double slope = 0;
      bool edge = false;
      for (const Candidate& facet : truth.at(x, y)) {
        if (facet.polygon == polygon) slope = std::max(slope, facet.slope), edge = edge || !facet.sure();
      }
      const double difference = std::abs(ours - theirs) / ours;
      if (difference <= tie_tolerance) sum.worst_depth = std::max(sum.worst_depth, difference);
      else if (!edge && std::abs(ours - theirs) > tie_tolerance * ours + 2 * shift * slope) ++wrong;
    }
  }
  CHECK(wrong == 0);
}

void hold_against_embree(const Scene& scene, Sum& sum) {
  Conventions conventions;
  conventions.cull = false;
  const Truth truth(scene, conventions.cull);
  const Picture embrees = cast_with_embree(scene);
  NullRecorder nothing;
  for (const Method& m : methods()) {
    if (!m.exact || m.gives != Gives::surfaces) continue;
    CAPTURE(m.id);
    const Picture picture = m.render(scene, conventions, nothing);
    const Verdict verdict = explain_difference(truth, picture, embrees);
    INFO(verdict.complaints());
    CHECK(verdict.unexplained == 0);
    CHECK(verdict.equal > truth.width() * truth.height() / 10);
    CHECK(verdict.explained() <= verdict.equal / 200);  // so few that the rule cannot hide a fault
    hold_depths(truth, scene, conventions, picture, embrees, sum);
    sum.pixels += truth.width() * truth.height(), sum.drawn += verdict.equal;
    sum.at_edges += verdict.at_edges, sum.ties += verdict.ties;
  }
}

}  // namespace

TEST_SUITE("embree") {
  TEST_CASE("teapot, n-gons and a soup of triangles, from three cameras each, perspective and parallel") {
    struct View {
      double rho, theta, phi;
    };
    struct Subject {
      std::string name;
      Scene scene;
    };
    const std::vector<Subject> subjects{
        {"teapot", load_scene("teapot").scene}, {"n-gons", n_gon_mesh()}, {"soup", triangle_soup(1000, 0.25, 5)}};
    for (const Subject& subject : subjects) {
      CAPTURE(subject.name);
      Sum sum;
      for (const View view : {View{3, 30, 60}, View{2.5, 200, 80}, View{4, -75, 25}}) {
        CAPTURE(view.theta);
        for (const bool orthographic : {false, true})
          hold_against_embree(seen(subject.scene, view.rho, view.theta, view.phi, orthographic), sum);
      }
      MESSAGE(subject.name, ": of ", sum.pixels, " pixels ", sum.drawn, " show the same polygon, depths to ",
              sum.worst_depth, "; at edges ", sum.at_edges, ", ties ", sum.ties);
    }
    MESSAGE(embree_version());
  }
}
