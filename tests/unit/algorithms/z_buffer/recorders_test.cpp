// Recording changes nothing, and what was recorded says everything.
#include <doctest/doctest.h>

#include <cstring>

#include "algorithms/catalog/catalog.hpp"
#include "algorithms/z_buffer/z_buffer.hpp"
#include "tests/unit/algorithms/scenes.hpp"
#include "traces/record/recorder.hpp"

using namespace zstep;

namespace {

Scene crowd(Camera::Kind kind) {
  test::Numbers random(3);
  Scene scene = test::cube(0.7);
  for (int i = 0; i < 30; ++i) test::add_polygon(scene, test::random_star(random, random.in_box(2), 1, 3 + i % 6));
  scene.raster = {120, 90, false};
  test::look(scene, kind, 3, 40, 60, 0.8, 6);
  return scene;
}

bool same_bits(const Picture& one, const Picture& other) {
  return one.polygon == other.polygon && one.depth.size() == other.depth.size() &&
         std::memcmp(one.depth.data(), other.depth.data(), one.depth.size() * sizeof(double)) == 0;
}

}  // namespace

TEST_SUITE("z_buffer/recorders") {
  TEST_CASE("with every recorder and every convention the picture has the same bits, and its writes rebuild it") {
    for (const auto kind : {Camera::Kind::perspective, Camera::Kind::orthographic}) {
      const Scene scene = crowd(kind);
      for (int option = 0; option < 16; ++option) {
        Conventions conventions;
        conventions.depth = static_cast<Conventions::Depth>(option & 1);
        conventions.interpolation = static_cast<Conventions::Interpolation>(option >> 1 & 1);
        conventions.coverage = static_cast<Conventions::Coverage>(option >> 2 & 1);
        conventions.cull = (option >> 3 & 1) != 0;

        NullRecorder nothing;
        CountRecorder count;
        CollectRecorder collect;
        const Method& method = zstep::method("z-buffer");
        TraceRecorder trace(header_for(method, conventions), scene);
        const Picture picture = method.render(scene, conventions, nothing);
        CHECK(same_bits(picture, method.count(scene, conventions, count)));
        CHECK(same_bits(picture, z_buffer::run(scene, conventions, collect)));
        CHECK(same_bits(picture, method.record(scene, conventions, trace)));

        std::int64_t counted = 0;
        for (const std::int64_t number : count.count) counted += number;
        CHECK(counted == static_cast<std::int64_t>(collect.events.size()));
        CHECK(trace.size() == counted);
        trace.finish();

        Picture rebuilt(scene.raster.width, scene.raster.height);
        for (const DepthWrite& write : collect.all<DepthWrite>()) rebuilt.depth[rebuilt.at(write.x, write.y)] = write.z;
        for (const PixelWrite& write : collect.all<PixelWrite>())
          rebuilt.polygon[rebuilt.at(write.x, write.y)] = write.polygon;
        CHECK(same_bits(picture, rebuilt));
      }
    }
  }

  TEST_CASE("the same bits with every compiler") {
    test::Numbers random(2026);  // and nothing of the mathematics library but square roots
    Scene scene;
    scene.raster = {64, 48, false};
    for (int i = 0; i < 20; ++i) {
      test::add_polygon(scene, std::vector<glm::dvec3>{random.in_box(2), random.in_box(2), random.in_box(2)});
    }
    test::look(scene, Camera::Kind::perspective, {0.3, -2.5, 0.7}, {0.1, 0.2, 0}, 0.4, 5);
    std::uint64_t hash = 14695981039346656037u;  // FNV-1a
    for (int option = 0; option < 4; ++option) {
      Conventions conventions;
      conventions.cull = false;
      conventions.depth = static_cast<Conventions::Depth>(option & 1);
      conventions.interpolation = static_cast<Conventions::Interpolation>(option >> 1);
      NullRecorder record;
      const Picture picture = z_buffer::run(scene, conventions, record);
      std::vector<unsigned char> bytes(picture.depth.size() * sizeof(double));
      std::memcpy(bytes.data(), picture.depth.data(), bytes.size());
      for (const unsigned char byte : bytes) hash = (hash ^ byte) * 1099511628211u;
    }
    CHECK(hash == 1554539946843021559u);
  }

  TEST_CASE("the depth along a span is the formula's, to the bit") {
    const Scene scene = crowd(Camera::Kind::perspective);
    CollectRecorder record;
    z_buffer::run(scene, {}, record);
    SpanBegin span{};
    std::int64_t pixels = 0;
    for (const CollectedEvent& collected : record.events) {
      if (const auto* begin = get_if<SpanBegin>(&collected.event)) span = *begin;
      const auto* pixel = get_if<DepthInterpolate>(&collected.event);
      if (!pixel) continue;
      const double z =
          span.x_right == span.x_left
              ? span.z_left
              : span.z_left + (span.z_right - span.z_left) * (pixel->x - span.x_left) / (span.x_right - span.x_left);
      REQUIRE(pixel->z == z);
      REQUIRE(pixel->y == span.y);
      ++pixels;
    }
    CHECK(pixels > 1000);
  }

  TEST_CASE("the order of steps: a compare after its interpolation, a write after a compare that won") {
    const Scene scene = crowd(Camera::Kind::perspective);
    CollectRecorder record;
    z_buffer::run(scene, {}, record);
    REQUIRE(holds<BuffersClear>(record.events.at(0).event));
    for (std::size_t i = 1; i < record.events.size(); ++i) {
      const Event &event = record.events[i].event, &before = record.events[i - 1].event;
      if (holds<DepthCompare>(event)) REQUIRE(holds<DepthInterpolate>(before));
      if (holds<DepthWrite>(event)) REQUIRE(get<DepthCompare>(before).nearer);
      if (holds<PixelWrite>(event)) REQUIRE(holds<DepthWrite>(before));
    }
  }
}
