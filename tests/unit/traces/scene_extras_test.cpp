// Materials, light, surface and where its points come from travel in both forms of a trace, and nothing impossible is
// read back.
#include <doctest/doctest.h>

#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <string>

#include "tests/unit/traces/some_trace.hpp"
#include "traces/file/header_json.hpp"
#include "traces/file/scene_bytes.hpp"

using namespace zstep;

namespace {

/// some_scene() with all that a scene can have.
Scene rich_scene() {
  Scene scene = some_scene();
  scene.points[2] = {0, 9, 3};
  scene.polygons.push_back({"C", {9, 9, 9}, 0, Material{1, 1, 10}});
  scene.polygons[0].material = Material{0.25, 0.5, 1.5};
  scene.light = Light{{1, 2, 8}, {0, 1.0 / 3, 0}, 0.75, 2, 20};
  scene.surface = Surface{"sin(x) * z", -1, 1, 0, 0.1, 3, 1};
  Placement turned{0, 2, "house.off", 5};
  turned.linear = {{0, 0.5, 0}, {-1.0 / 3, 0, 0}, {0, 0, -0.0}};
  turned.offset = {1, 0, 1e-300};
  scene.placements = {turned, {2, 1, "cube", 9}};
  scene.fit = Fit{{0.1, -2, 3}, 1.0 / 7};
  for (const glm::dvec3& point : scene.points) scene.file_points.push_back(point / 3.0);
  return scene;
}

Scene through_json(const Scene& scene) { return scene_from_json(nlohmann::json::parse(scene_to_json(scene).dump())); }
Scene through_bytes(const Scene& scene) { return scene_from_bytes(scene_to_bytes(scene)); }

/// What both readers say about a scene that was changed so; they must agree.
std::string said(const std::function<void(Scene&)>& change) {
  Scene scene = rich_scene();
  change(scene);
  const auto message = [](const auto& call) -> std::string {
    try {
      call();
    } catch (const std::exception& error) {
      return error.what();
    }
    return "";
  };
  const std::string of_bytes = message([&] { through_bytes(scene); });
  CHECK(message([&] { through_json(scene); }) == of_bytes);
  return of_bytes;
}

}  // namespace

TEST_CASE("scene: materials, light, surface and origins come back to the bit") {
  const Scene scene = rich_scene();
  CHECK(through_json(scene) == scene);
  CHECK(through_bytes(scene) == scene);
  for (int without = 0; without < 32; ++without) {
    Scene less = scene;
    if ((without & 1) != 0) less.light.reset();
    if ((without & 2) != 0) less.surface.reset();
    if ((without & 4) != 0)
      for (Polygon& polygon : less.polygons) polygon.material = Material{};
    if ((without & 8) != 0) less.placements.clear();
    if ((without & 16) != 0) less.fit.reset(), less.file_points.clear();
    CHECK(through_json(less) == less);
    CHECK(through_bytes(less) == less);
  }
}

TEST_CASE("scene: which placement a point comes from") {
  Scene scene = rich_scene();
  scene.points.resize(6);
  scene.placements = {{1, 2, "a"}, {3, 0, "nothing"}, {4, 1, "b"}};
  const std::array<std::string, 6> wanted{"", "a", "a", "", "b", ""};
  for (std::int32_t point = 0; point < 6; ++point) {
    const Placement* placement = placement_of(scene, point);
    CHECK((placement ? placement->source : "") == wanted[static_cast<std::size_t>(point)]);
  }
}

TEST_CASE("scene: one without materials, light and surface says nothing of them") {
  const Scene plain = some_scene();
  const std::string text = scene_to_json(plain).dump();
  for (const char* key :
       {"opacity", "reflectance", "refraction", "light", "surface", "placements", "fit", "file_points", "attributes"})
    CHECK(text.find(key) == std::string::npos);
  Scene lit = plain;
  lit.light = Light{{1, 2, 8}, {0, 0, 0}, 1, 1, 2};
  const Bytes before = scene_to_bytes(plain), after = scene_to_bytes(lit);
  REQUIRE(after.size() > before.size());
  CHECK(Bytes(after.begin(), after.begin() + static_cast<std::ptrdiff_t>(before.size())) == before);
}

TEST_CASE("scene: impossible materials, lights and surfaces are refused") {
  constexpr double infinite = std::numeric_limits<double>::infinity(), nan = std::numeric_limits<double>::quiet_NaN();
  const auto says = [](const std::function<void(Scene&)>& change, const std::string& part) {
    const std::string message = said(change);
    CAPTURE(message);
    CHECK(message.find(part) != std::string::npos);
  };
  for (const double value : {-0.1, 1.1, nan, infinite, -infinite}) {
    says([&](Scene& s) { s.polygons[1].material = Material{value}; }, "polygon 1 has an opacity of");
    says([&](Scene& s) { s.polygons[0].material = Material{0.25, value}; }, "polygon 0 has a reflectance of");
  }
  for (const double value : {0.0, -1.0, 11.0, nan, infinite})
    says([&](Scene& s) { s.polygons[2].material = Material{1, 0, value}; }, "polygon 2 has a refraction of");

  for (const double value : {0.0, -1.0, nan, infinite}) {
    says([&](Scene& s) { s.light->window = value; }, "the light has a window of");
    says([&](Scene& s) { s.light->near = value; }, "the light has planes at");
    says([&](Scene& s) { s.light->far = value; }, "the light has planes at");
  }
  says([](Scene& s) { s.light->near = s.light->far; }, "the light has planes at");
  says([](Scene& s) { s.light->target = s.light->position; }, "the light stands at its target");
  says([&](Scene& s) { s.light->position.y = infinite; }, "the light stands at its target");
  says([&](Scene& s) { s.light->target.z = nan; }, "the light stands at its target");

  says([](Scene& s) { s.surface->columns = 2; }, "the surface has 2 x 1 samples, but there are 3 points");
  says([](Scene& s) { s.surface->rows = 0; }, "the surface has 3 x 0 samples");
  says([](Scene& s) { s.surface->columns = s.surface->rows = -3; }, "the surface has -3 x -3 samples");
  says([](Scene& s) { s.surface->columns = s.surface->rows = 2'000'000'000; },
       "the surface has 2000000000 x 2000000000");
  says([](Scene& s) { s.surface->formula = ""; }, "a formula of 0 characters");
  says([](Scene& s) { s.surface->formula.assign(201, 'x'); }, "a formula of 201 characters");
  says([](Scene& s) { s.surface->x_max = s.surface->x_min; }, "a range that does not go from");
  says([&](Scene& s) { s.surface->z_min = nan; }, "a range that does not go from");
  says([&](Scene& s) { s.surface->x_max = infinite; }, "a range that does not go from");

  says([](Scene& s) { s.file_points.pop_back(); }, "as many points in files as points");
  says([](Scene& s) { s.file_points.clear(); }, "it is fitted, but what its points were before is missing");
  for (const double value : {0.0, -1.0, nan, infinite})
    says([&](Scene& s) { s.fit->radius = value; }, "it is fitted from a ball of radius");
  says([&](Scene& s) { s.fit->centre.y = nan; }, "it is fitted from a ball");
  says([](Scene& s) { s.placements[1].point_count = 2; }, "a placement is of points that do not exist");
  says([](Scene& s) { s.placements[1].point_count = 2'147'483'647; }, "a placement is of points that do not exist");
  says([](Scene& s) { s.placements[1].point_count = -1; }, "placements overlap");
  says([](Scene& s) { s.placements[1].first_point = 1; }, "placements overlap");
  says([](Scene& s) { s.placements[0].first_point = -1; }, "placements overlap");
  says([&](Scene& s) { s.placements[0].linear[1][2] = infinite; }, "a placement has a number that is none");
  says([&](Scene& s) { s.placements[0].offset.x = nan; }, "a placement has a number that is none");
}

TEST_CASE("scene: materials cut off, too many or of no polygon are refused") {
  const auto said_of = [](const Bytes& bytes) -> std::string {
    try {
      scene_from_bytes(bytes);
    } catch (const std::exception& error) {
      return error.what();
    }
    return "";
  };
  const Bytes plain = scene_to_bytes(some_scene());
  const auto with = [&](const std::string& document, const std::vector<std::uint64_t>& lengths) {
    Bytes bytes = plain;
    put_text(bytes, document);
    for (const std::uint64_t length : lengths) {
      put_varint(bytes, length);
      for (const double value : {1.0, 0.0, 1.0}) put_u64(bytes, bits_of(value));
    }
    put_varint(bytes, 0);  // placements
    put_varint(bytes, 0);  // points of files
    return bytes;
  };
  CHECK(said_of(with("{}", {2})) == "");
  CHECK(said_of(with("{}", {1, 1})) == "");
  CHECK(said_of(with("{}", {0, 2})).find("a material of no polygon") != std::string::npos);
  CHECK(said_of(with("{}", {3})).find("a material of no polygon") != std::string::npos);
  CHECK(said_of(with("{}", {~std::uint64_t{0}})).find("a material of no polygon") != std::string::npos);
  CHECK(said_of(with("{}", {1})) != "");
  Bytes more = with("{}", {2});
  more.push_back(0);
  CHECK(said_of(more).find("followed by something") != std::string::npos);
  more[more.size() - 3] = 1;  // one placement, and then no more
  CHECK(said_of(more).find("ends too early") != std::string::npos);
  more = with("{}", {2});
  more.back() = 9;
  CHECK(said_of(more).find("a count larger than the data") != std::string::npos);
  CHECK(said_of(with("[1]", {2})) == "");
  CHECK(said_of(with("{\"light\":7}", {2})).find("is not an object") != std::string::npos);
  CHECK(said_of(with("{\"surface\":{}}", {2})).find("\"formula\" is missing") != std::string::npos);
  CHECK(said_of(with("{", {2})) != "");
  CHECK(said_of(with(std::string(5000, ' ') + "{}", {2})).find("more than 4 KiB") != std::string::npos);
  const Bytes whole =
      with("{\"light\":{\"position\":[1,2,3],\"target\":[0,0,0],\"window\":1,\"near\":1,\"far\":2}}", {1, 1});
  CHECK(said_of(whole) == "");
  for (std::size_t size = plain.size() + 1; size < whole.size(); ++size)
    CHECK(said_of(Bytes(whole.begin(), whole.begin() + static_cast<std::ptrdiff_t>(size))) != "");
}
