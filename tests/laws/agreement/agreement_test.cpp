// The law of agreement: on every scene of the set, every exact method shows the same polygon at every pixel, but for
// pixels within 1.5/256 px of an edge and depths that are equal to 1e-5. Each is held against what is nearest by brute
// force, so they agree with each other and with the truth; each pixel at which two differ is explained besides.
#include <doctest/doctest.h>

#include <algorithm>
#include <sstream>
#include <string>
#include <vector>

#include "sim/truth/explain_difference.hpp"
#include "tests/laws/agreement/exact_methods.hpp"
#include "tests/laws/agreement/scenes.hpp"

using namespace zstep;
using namespace zstep::compare;
using namespace zstep::test;

namespace {

Conventions conventions_of(const AgreementScene& subject) {
  Conventions conventions;
  conventions.cull = subject.cull;
  return conventions;
}

void hold(const Truth& truth, const AgreementScene& subject, const Conventions& conventions, const Picture& picture) {
  const Verdict verdict = hold_against_truth(truth, subject.scene, conventions, picture);
  INFO(verdict.complaints());
  CHECK(verdict.unexplained == 0);
  CHECK(verdict.wrong_depths == 0);
  // So few that the rule cannot hide a fault.
  const bool few = verdict.explained() * 20 <= truth.width() * truth.height();
  CHECK((few || subject.open));
}

// The values of an option that must not change the picture: all its words, or some of its numbers.
std::vector<std::string> given_values(const Option& option) {
  std::vector<std::string> values;
  if (option.words.empty()) {
    for (const std::int64_t value : {option.least, option.least + (option.most - option.least) / 3,
                                     std::min<std::int64_t>(option.most, option.least + 20)}) {
      values.push_back(std::to_string(value));
    }
    return values;
  }
  std::istringstream words{std::string(option.words)};
  for (std::string word; std::getline(words, word, '|');) values.push_back(word);
  return values;
}

}  // namespace

TEST_CASE("law: every exact method shows the nearest polygon at every pixel, with its depth, and so all agree") {
  const std::vector<const Method*> exact = exact_methods();
  int pixels = 0, differing = 0;
  for (const AgreementScene& subject : agreement_scenes()) {
    CAPTURE(subject.name);
    const Truth truth(subject.scene, subject.cull);
    const Conventions conventions = conventions_of(subject);
    const Picture first = drawn(*exact.front(), subject.scene, conventions);
    for (const Method* m : exact) {
      CAPTURE(m->id);
      const Picture picture = drawn(*m, subject.scene, conventions);
      hold(truth, subject, conventions, picture);

      const Verdict verdict = explain_difference(truth, first, picture);
      INFO(verdict.complaints());
      CHECK(verdict.unexplained == 0);
      pixels += truth.width() * truth.height();
      differing += static_cast<int>(verdict.differences.size());
    }
  }
  MESSAGE(exact.size(), " methods on ", agreement_scenes().size(), " scenes: ", pixels, " pixels, of which ", differing,
          " differ from ", exact.front()->title, "'s, each explained");
}

TEST_CASE("law: options that leave the picture as it is change it at edges and ties only") {
  int runs = 0;
  for (const AgreementScene& subject : agreement_scenes()) {
    if (!subject.small) continue;
    CAPTURE(subject.name);
    const Truth truth(subject.scene, subject.cull);
    for (const Method* m : exact_methods()) {
      CAPTURE(m->id);
      for (const Option& option : m->options) {
        if (!option.same_picture) continue;
        CAPTURE(option.name);
        for (const std::string& value : given_values(option)) {
          CAPTURE(value);
          Conventions conventions = conventions_of(subject);
          conventions.options[std::string(option.name)] = value;
          hold(truth, subject, conventions, drawn(*m, subject.scene, conventions));
          ++runs;
        }
      }
    }
  }
  MESSAGE(runs, " runs with an option");
}

namespace {

/// The scan-line method interpolates in its variant with a line's depth buffer only.
Conventions interpolating(const Method& method, Conventions conventions) {
  if (method.id == "scan-line") conventions.options["resolve"] = "line-buffer";
  return conventions;
}

}  // namespace

TEST_CASE("law: increments and inclusive coverage change the picture at edges and ties only") {
  for (const AgreementScene& subject : agreement_scenes()) {
    if (!subject.small) continue;
    CAPTURE(subject.name);
    const Truth truth(subject.scene, subject.cull);
    for (const Method* m : exact_methods()) {
      if (!m->interpolates) continue;
      CAPTURE(m->id);
      Conventions conventions = interpolating(*m, conventions_of(subject));
      conventions.interpolation = Conventions::Interpolation::increments;
      if (!can_draw(*m, lit_for(*m, subject.scene), conventions)) {
        CHECK(m->id == "half-space");  // which has neither
        continue;
      }
      hold(truth, subject, conventions, drawn(*m, subject.scene, conventions));
      conventions.coverage = Conventions::Coverage::inclusive;
      hold(truth, subject, conventions, drawn(*m, subject.scene, conventions));
    }
  }
}

TEST_CASE("law: methods that are known to fail do, and are found out") {
  for (const Method& m : methods()) {
    if (m.exact || m.gives == Gives::lines || m.needs == Needs::surface) continue;
    CAPTURE(m.id);
    int wrong = 0;
    for (const AgreementScene& subject : agreement_scenes()) {
      const Conventions conventions = conventions_of(subject);
      const Truth truth(subject.scene, subject.cull);
      wrong += hold_against_truth(truth, subject.scene, conventions, drawn(m, subject.scene, conventions), false)
                   .unexplained;
    }
    MESSAGE(m.title, ": ", wrong, " wrong pixels");
    CHECK(wrong > 100);
  }
}

TEST_CASE("law: z_v interpolated along the raster is inexact under perspective, and is found to differ") {
  for (const Method* m : exact_methods()) {
    if (!m->interpolates) continue;
    CAPTURE(m->id);
    int scenes = 0, wrong_polygons = 0, wrong_depths = 0;
    for (const AgreementScene& subject : agreement_scenes()) {
      if (subject.scene.camera.kind != Camera::Kind::perspective) continue;
      const Truth truth(subject.scene, subject.cull);
      Conventions conventions = interpolating(*m, conventions_of(subject));
      conventions.depth = Conventions::Depth::view;
      const Verdict verdict =
          hold_against_truth(truth, subject.scene, conventions, drawn(*m, subject.scene, conventions));
      ++scenes, wrong_polygons += verdict.unexplained, wrong_depths += verdict.wrong_depths;
      if (subject.name == "soup of large triangles") CHECK(verdict.unexplained > 20);
      if (subject.name == "a single polygon") CHECK(verdict.wrong_depths > 100);
    }
    MESSAGE(m->title, " with z_v on ", scenes, " scenes: ", wrong_polygons, " pixels with a wrong polygon, ",
            wrong_depths, " wrong depths");
  }
}

TEST_CASE("law: in parallel projection z_v is exact") {
  for (const AgreementScene& subject : agreement_scenes()) {
    if (subject.scene.camera.kind != Camera::Kind::orthographic) continue;
    CAPTURE(subject.name);
    const Truth truth(subject.scene, subject.cull);
    for (const Method* m : exact_methods()) {
      if (!m->interpolates) continue;
      CAPTURE(m->id);
      Conventions conventions = interpolating(*m, conventions_of(subject));
      conventions.depth = Conventions::Depth::view;
      hold(truth, subject, conventions, drawn(*m, subject.scene, conventions));
    }
  }
}
