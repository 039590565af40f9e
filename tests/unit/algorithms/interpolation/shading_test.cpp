// What attributes of vertices make of a polygon's colour: that each shade is recorded, replayed and judged, and is what
// it says.
#include "traces/formulas/shading.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

#include <doctest/doctest.h>
#include <nlohmann/json.hpp>

#include "algorithms/catalog/catalog.hpp"
#include "algorithms/half_space/half_space.hpp"
#include "algorithms/interpolation/interpolation.hpp"
#include "algorithms/scene/load.hpp"
#include "sim/answers/explain_value.hpp"
#include "tests/golden/golden.hpp"
#include "tests/unit/algorithms/scenes.hpp"
#include "tests/where.hpp"
#include "traces/check/check.hpp"
#include "traces/error.hpp"
#include "traces/file/header_json.hpp"
#include "traces/file/scene_bytes.hpp"
#include "traces/replay/replay.hpp"

using namespace zstep;

namespace {

Conventions shaded_by(std::string_view shade) {
  Conventions conventions;
  conventions.attribute = Conventions::Attribute::perspective;
  conventions.options[formulas::shade_key] = shade;
  return conventions;
}
Scene prepared(const std::string& name, const Conventions& conventions, std::int32_t width, std::int32_t height) {
  SceneFile file = load_scene(name);
  prepare_for_shade(file, conventions);
  ViewOptions view;
  view.width = width, view.height = height;
  return look_at_scene(std::move(file.scene), view);
}
Scene textured(const Conventions& conventions) {
  return prepared(test::in_checkout("tests/golden/textured.toml"), conventions, 40, 30);
}
Picture drawn_by(const std::string& name, const Scene& scene, const Conventions& conventions) {
  NullRecorder nothing;
  return name == "z-buffer" ? interpolation::run(scene, conventions, nothing)
                            : half_space::run(scene, conventions, nothing);
}

/// The run with one byte of one colour, of those that are told by a formula, another one.
Trace with_one_byte_wrong(const Trace& trace) {
  TraceRecorder recorder(trace.header(), trace.scene());
  std::int64_t left = 40;
  trace.each(0, trace.size(), [&](std::int64_t, const RecordedEvent& recorded) {
    Event event = recorded.event;
    if (auto* write = get_if<ColorWrite>(&event); write && --left == 0)
      write->g8 = static_cast<std::uint8_t>(write->g8 > 100 ? write->g8 - 9 : write->g8 + 9);
    record_any(recorder, recorded.step, event);
    return true;
  });
  recorder.finish();
  return Trace::from_bytes(recorder.take_bytes(), "one byte wrong");
}

constexpr std::array<formulas::Shade, 8> all_shades = values_of<formulas::Shade>;

}  // namespace

TEST_CASE("shades: each is recorded, replayed and never doubted, and one byte wrong is found") {
  for (const formulas::Shade shade : all_shades)
    for (const char* name : {"z-buffer", "half-space"}) {
      const std::string word(word_of(shade));
      CAPTURE(word);
      CAPTURE(name);
      const Conventions conventions = shaded_by(word);
      const Scene scene = textured(conventions);
      check_run(method(name), scene, conventions);
      const Trace trace = test::recorded_by(name, scene, conventions);
      CHECK(trace.scene() == scene);
      const CheckReport report = check(trace);
      for (const Cause& cause : report.causes)
        FAIL_CHECK("step " << cause.first.step << ": " << cause.first.field << " " << cause.first.recorded << " for "
                           << cause.first.expected);
      Replay replay(trace);
      replay.go_to(trace.size());
      CHECK(replay.state().picture == drawn_by(name, scene, conventions));
      const CheckReport found = check(with_one_byte_wrong(trace));
      REQUIRE(found.causes.size() == 1);
      CHECK(found.causes.front().first.field == "g8");
    }
}

TEST_CASE("shades: a scene's attributes and textures are the same through JSON and through bytes") {
  const Scene scene = textured(shaded_by("bilinear"));
  REQUIRE(scene.attributes.size() == 4);
  REQUIRE(scene.textures.size() == 1);
  CHECK(scene.textures[0].texels[5] == Color{255, 0, 255});
  CHECK(scene_from_json(scene_to_json(scene)) == scene);
  const auto bytes = scene_to_bytes(scene);
  CHECK(scene_from_bytes(bytes) == scene);
}

TEST_CASE("shades: textures and attributes of a header that cannot be are refused with a reason") {
  const nlohmann::json right = scene_to_json(textured(shaded_by("bilinear")));
  const auto refused = [&](auto&& change) {
    nlohmann::json wrong = right;
    change(wrong);
    try {
      scene_from_json(wrong);
    } catch (const MalformedJson& error) {
      return std::string(error.what());
    }
    return std::string("taken");
  };
  using Json = nlohmann::json;
  CHECK(refused([](Json& j) { j["textures"][0]["texels"] = "ff"; }).find("has 2 digits") != std::string::npos);
  CHECK(refused([](Json& j) { j["textures"][0]["texels"].get_ref<std::string&>()[3] = 'g'; }).find("hexadecimal") !=
        std::string::npos);
  CHECK(refused([](Json& j) { j["textures"][0]["width"] = 0; }).find("0 x 2 texels") != std::string::npos);
  CHECK(refused([](Json& j) { j["textures"][0]["width"] = 1 << 30; }).find("texels") != std::string::npos);
  CHECK(refused([](Json& j) { j["textures"] = Json::array(); }).find("texture 0") != std::string::npos);
  CHECK(refused([](Json& j) { j["polygons"][0]["texture"] = -7; }).find("texture -7") != std::string::npos);
  CHECK(refused([](Json& j) { j["attributes"][0]["components"] = 0; }).find("0 components") != std::string::npos);
  CHECK(refused([](Json& j) { j["attributes"][0]["of_point"].erase(0); }).find("for each point") != std::string::npos);
  CHECK(refused([](Json& j) { j["attributes"][0]["of_point"][0] = 99; }).find("no value 99") != std::string::npos);
  CHECK(refused([](Json& j) { j["attributes"][0]["values"][0] = "inf"; }).find("number inf") != std::string::npos);
  CHECK(refused([](Json& j) { j["attributes"][1]["name"] = j["attributes"][0]["name"]; }).find("two attributes") !=
        std::string::npos);
}

TEST_CASE("shades: where a program writes no polygon a pixel's colour is explained all the same") {
  for (const formulas::Shade shade : all_shades) {
    const Conventions conventions = shaded_by(word_of(shade));
    const Trace whole = test::recorded_by("half-space", textured(conventions), conventions);
    TraceRecorder recorder(whole.header(), whole.scene());
    whole.each(0, whole.size(), [&](std::int64_t, const RecordedEvent& recorded) {
      if (!holds<PixelWrite>(recorded.event)) record_any(recorder, recorded.step, recorded.event);
      return true;
    });
    recorder.finish();
    const Trace trace = Trace::from_bytes(recorder.take_bytes(), "no polygon written");
    int explained = 0;
    trace.each(0, trace.size(), [&](std::int64_t at, const RecordedEvent& recorded) {
      if (holds<ColorWrite>(recorded.event) && ++explained < 20)
        CHECK(!answers::explain_value(trace, {at, "r8"}).links.empty());
      return explained < 20;
    });
    CHECK(explained > 10);
  }
}

TEST_CASE("shades: an image of one colour gives that colour, and at the centres of texels mixed is as nearest") {
  Texture one{"", 5, 3, std::vector<Color>(15, Color{10, 200, 77})};
  Texture noise{"", 4, 4, {}};
  for (int k = 0; k < 16; ++k) noise.texels.push_back({static_cast<std::uint8_t>(15 * k), 0, 0});
  for (double u = -2; u < 2; u += 0.137)
    for (double v = -2; v < 2; v += 0.171) {
      CHECK(formulas::nearest_texel(one, u, v) == Color{10, 200, 77});
      double green = 0, parts = 0;
      const formulas::FourTexels four = formulas::four_texels(one, u, v);
      for (std::size_t i = 0; i < 4; ++i) green += four.part[i] * four.color[i].green, parts += four.part[i];
      CHECK(green == doctest::Approx(200));
      CHECK(parts == doctest::Approx(1));
    }
  for (int x = -4; x < 8; ++x)
    for (int y = -4; y < 8; ++y) {
      const double u = (x + 0.5) / 4, v = (y + 0.5) / 4;
      const formulas::FourTexels four = formulas::four_texels(noise, u, v);
      CHECK(four.part[0] == 1);
      CHECK(four.color[0] == formulas::nearest_texel(noise, u, v));
    }
  // The lower left corner is the first texel of the last row.
  CHECK(formulas::nearest_texel(noise, 0, 0) == noise.texels[12]);
  CHECK(formulas::nearest_texel(noise, 0.999, 0.999) == noise.texels[3]);
}

TEST_CASE("shades: light is that of Lambert and Phong, and none comes from behind") {
  const formulas::Lighting lighting{{0, 0, 1}, {0, 0, 1}};
  CHECK(formulas::reflected(lighting, {0, 0, 7}).diffuse == doctest::Approx(1));
  CHECK(formulas::reflected(lighting, {0, 0, 7}).highlight == doctest::Approx(0.5));
  const double slanted = std::sqrt(0.5);  // 60 degrees off would have r behind: at 45 r is across
  CHECK(formulas::reflected(lighting, {1, 0, 1}).diffuse == doctest::Approx(0.2 + 0.8 * slanted));
  CHECK(formulas::reflected(lighting, {1, 0, 1}).highlight == doctest::Approx(0));
  // At 10 degrees r is 20 degrees off.
  const double ten = 10 * std::acos(-1) / 180;
  CHECK(formulas::reflected(lighting, {std::sin(ten), 0, std::cos(ten)}).highlight ==
        doctest::Approx(0.5 * std::pow(std::cos(2 * ten), 32)));
  for (const glm::dvec3 away : {glm::dvec3(0, 0, -1), glm::dvec3(0), glm::dvec3(1, 0, 0)}) {
    CHECK(formulas::reflected(lighting, away).diffuse == doctest::Approx(0.2));
    CHECK(formulas::reflected(lighting, away).highlight == 0);
  }
}

TEST_CASE("shades: vertices without a normal have that of the polygons round them, and colours lose their light") {
  const Conventions phong = shaded_by("phong");
  // A regular solid's normals go straight out.
  const Scene solid = prepared("dodecahedron", phong, 20, 20);
  const VertexAttribute* normals = attribute_named(solid, normal_attribute);
  REQUIRE(normals != nullptr);
  for (std::int32_t point = 0; point < size32(solid.points); ++point) {
    const auto value = static_cast<std::size_t>(normals->value_of(0, point));
    const glm::dvec3 n(normals->values[3 * value], normals->values[3 * value + 1], normals->values[3 * value + 2]);
    CHECK(glm::dot(n, formulas::unit(solid.points[static_cast<std::size_t>(point)])) == doctest::Approx(1));
  }
  const Scene teapot = prepared("teapot:2", phong, 20, 20);
  CHECK(std::all_of(teapot.polygons.begin(), teapot.polygons.end(),
                    [&](const Polygon& p) { return p.color == teapot.polygons.front().color; }));
  CHECK(load_scene("teapot:2").scene.attributes.empty());
}

TEST_CASE("shades: Phong sees the highlight in the middle of a square whose corners do not, and Gouraud does not") {
  Scene scene;
  scene.camera.kind = Camera::Kind::screen;
  scene.raster = {21, 21};
  scene.points = {{0, 0, 1}, {21, 0, 1}, {21, 21, 1}, {0, 21, 1}};
  scene.polygons = {{std::string("A"), Color{100, 0, 0}}};
  scene.facets = {{0, 0, 4}};
  scene.corners = {0, 1, 2, 3};
  VertexAttribute normal{normal_attribute, 3, {}, {}, {0, 1, 2, 3}, {}};
  for (const glm::dvec3& p : scene.points)
    normal.values.insert(normal.values.end(), {p.x / 10.5 - 1, p.y / 10.5 - 1, -1});
  scene.attributes = {normal};
  const auto middle = [&](const char* shade) {
    Conventions c = shaded_by(shade);
    c.attribute = Conventions::Attribute::linear, c.cull = false;
    return color_at(drawn_by("z-buffer", scene, c), scene, 10 * 21 + 10);
  };
  CHECK(middle("phong").green > 80);
  CHECK(middle("gouraud").green == 0);
}

TEST_CASE("shades: what a scene lacks is refused, and so is a shade of nothing") {
  for (const char* shade : {"colors", "checker", "nearest", "bilinear", "scalar"}) {
    CAPTURE(shade);
    const Conventions conventions = shaded_by(shade);
    CHECK_THROWS_AS(check_run(method("z-buffer"), prepared("cube", conventions, 20, 20), conventions), InputError);
  }
  Conventions none = shaded_by("phong");
  none.attribute = Conventions::Attribute::none;
  CHECK_THROWS_AS(check_run(method("z-buffer"), prepared("cube", none, 20, 20), none), InputError);
}
