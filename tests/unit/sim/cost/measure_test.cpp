// Measuring a method: in a process of its own, with a limit, its memory counted.
#include <doctest/doctest.h>

#include <chrono>
#include <memory>
#include <stdexcept>
#include <thread>
#include <vector>

#include "algorithms/scene/load.hpp"
#include "sim/cost/allocation_peak.hpp"
#include "sim/cost/measure.hpp"

using namespace zstep;
using namespace zstep::compare;

namespace {

void no_tick(double) {}

std::vector<std::uint8_t> sleep_long() {
  std::this_thread::sleep_for(std::chrono::seconds(30));
  return {};
}

}  // namespace

TEST_SUITE("compare/measure") {
  TEST_CASE("work apart returns its bytes, many of them too") {
    for (const std::size_t size : {std::size_t{0}, std::size_t{3}, std::size_t{1} << 20}) {
      const Apart apart = run_apart([size] { return std::vector<std::uint8_t>(size, 7); }, 20, no_tick);
      CHECK(apart.end == Apart::End::done);
      CHECK(apart.bytes == std::vector<std::uint8_t>(size, 7));
    }
  }

  TEST_CASE("work that fails says why") {
    const Apart apart =
        run_apart([]() -> std::vector<std::uint8_t> { throw std::runtime_error("no such luck"); }, 20, no_tick);
    CHECK(apart.end == Apart::End::failed);
    CHECK(apart.what == "no such luck");
  }

#if !defined(_WIN32)
  TEST_CASE("work that takes too long is stopped") {
    const auto start = std::chrono::steady_clock::now();
    CHECK(run_apart(sleep_long, 0.05, no_tick).end == Apart::End::out_of_time);
    CHECK(std::chrono::steady_clock::now() - start < std::chrono::seconds(10));
  }

  TEST_CASE("what a tick throws stops the work, too") {
    struct Enough {};
    const auto start = std::chrono::steady_clock::now();
    CHECK_THROWS_AS(run_apart(sleep_long, 20, [](double) { throw Enough{}; }), Enough);
    CHECK(std::chrono::steady_clock::now() - start < std::chrono::seconds(10));
  }

  TEST_CASE("memory: the most that was held at once, not the sum") {
    const AllocationPeak watch;
    for (int i = 0; i < 10; ++i) {
      const std::vector<char> some(100'000);
      const auto more = std::make_unique<char[]>(50'000);
    }
    if (watch.peak() < 0) return;  // under sanitizers
    CHECK(watch.peak() >= 150'000);
    CHECK(watch.peak() < 160'000);
    struct alignas(64) Wide {
      char bytes[64];
    };
    const std::vector<Wide> wide(10'000);
    CHECK(watch.peak() >= 640'000);
    CHECK(watch.peak() < 660'000);
  }
#endif

  TEST_CASE("a method's picture, counts and memory") {
    const Scene scene = look_at_scene(load_scene("pyramid").scene, {});
    MeasureOptions options;
    options.enough = 0;
    const Measured measured = measure(method("z-buffer"), scene, {}, options, no_tick);
    REQUIRE(measured.done());
    NullRecorder nothing;
    CountRecorder counts;
    CHECK(measured.picture == method("z-buffer").render(scene, {}, nothing));
    method("z-buffer").count(scene, {}, counts);
    CHECK(measured.count == counts.count);
    CHECK(measured.steps() > 1000);
    CHECK(measured.seconds.size() == 3);
    CHECK(measured.median_seconds() > 0);
    if (measured.heap < 0) return;  // under sanitizers and on Windows
    const std::int64_t picture = 32 * 32 * static_cast<std::int64_t>(sizeof(std::int32_t) + sizeof(double));
    CHECK(measured.heap > picture);
    CHECK(measured.heap < picture + 100'000);
  }

  TEST_CASE("the median") {
    Measured measured;
    measured.seconds = {3, 1, 2};
    CHECK(measured.median_seconds() == 2);
    measured.seconds = {4, 1, 2, 3};
    CHECK(measured.median_seconds() == 2.5);
  }
}
