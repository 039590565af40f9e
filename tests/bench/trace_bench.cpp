// Prints what a trace costs: recording against an untraced run, bytes and time an event, opening, seeking, stepping.
// Medians of runs that take turns, all in one process.
//
//     trace_bench [SCENE [WIDTHxHEIGHT]]        default: teapot:8 640x480
#include <fmt/core.h>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <random>
#include <string>
#include <vector>

#include "algorithms/catalog/catalog.hpp"
#include "algorithms/scene/load.hpp"
#include "algorithms/z_buffer/z_buffer.hpp"
#include "traces/file/visit.hpp"
#include "traces/replay/replay.hpp"

using namespace zstep;

namespace {

double seconds_of(const auto& work) {
  const auto begin = std::chrono::steady_clock::now();
  work();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
}

/// The value below which this share of the samples lies.
double quantile(std::vector<double> samples, double share) {
  std::sort(samples.begin(), samples.end());
  return samples[static_cast<std::size_t>(share * static_cast<double>(samples.size() - 1))];
}

}  // namespace

int main(int argc, char** argv) {
  const std::string name = argc > 1 ? argv[1] : "teapot:8";
  SceneFile file = load_scene(name);
  ViewOptions view;
  if (argc > 2) {
    const std::string size = argv[2];
    view.width = std::stoi(size);
    view.height = std::stoi(size.substr(size.find('x') + 1));
  }
  const Scene scene = look_at_scene(std::move(file.scene), view);
  const Method& taught = method("z-buffer");
  const std::filesystem::path path = std::filesystem::temp_directory_path() / "zstep_trace_bench.ztrace";

  constexpr int runs = 7;
  std::vector<double> untraced, traced, decoding, opening;
  NullRecorder none;
  for (int run = 0; run < runs; ++run) {
    untraced.push_back(seconds_of([&] { z_buffer::run(scene, file.conventions, none); }));
    traced.push_back(seconds_of([&] {
      TraceRecorder recorder(path, header_for(taught, file.conventions), scene);
      taught.record(scene, file.conventions, recorder);
      recorder.finish();
    }));
    opening.push_back(seconds_of([&] { Trace::open(path); }));
    const Trace trace = Trace::open(path);
    std::int64_t touched = 0;
    trace.visit(0, trace.size(), [](std::int64_t, std::uint8_t, const auto&) { return true; });  // checks every block
    decoding.push_back(seconds_of([&] {
      trace.visit(0, trace.size(), [&]<class E>(std::int64_t, std::uint8_t, const E& event) {
        if constexpr (requires { event.x; }) touched += event.x;
        return true;
      });
    }));
    if (touched == 42) fmt::print(" ");
  }
  const Trace trace = Trace::open(path);
  const auto events = static_cast<double>(trace.size());
  fmt::print("{} at {}x{}: {} polygons, {} events\n", scene.name, scene.raster.width, scene.raster.height,
             scene.polygons.size(), trace.size());
  fmt::print("  untraced run                   {:8.2f} ms\n", 1e3 * quantile(untraced, 0.5));
  fmt::print("  recording to a file / untraced {:8.2f}\n", quantile(traced, 0.5) / quantile(untraced, 0.5));
  fmt::print("  bytes an event on disk         {:8.3f}\n",
             static_cast<double>(std::filesystem::file_size(path)) / events);
  fmt::print("  decode, unpacking included     {:8.2f} ns an event\n", 1e9 * quantile(decoding, 0.5) / events);
  fmt::print("  open                           {:8.2f} ms\n", 1e3 * quantile(opening, 0.5));

  Replay replay(trace);
  fmt::print("  first run to the end           {:8.2f} ms\n", 1e3 * seconds_of([&] { replay.go_to(trace.size()); }));
  std::mt19937_64 random(1);
  std::vector<double> seeks, back;
  for (int i = 0; i < 300; ++i) {
    const auto target = static_cast<std::int64_t>(random() % static_cast<std::uint64_t>(trace.size()));
    seeks.push_back(seconds_of([&] { replay.go_to(target); }));
  }
  fmt::print("  random seek, median            {:8.2f} ms\n", 1e3 * quantile(seeks, 0.5));
  fmt::print("  random seek, p99               {:8.2f} ms\n", 1e3 * quantile(seeks, 0.99));
  replay.go_to(trace.size() / 2);
  constexpr int steps = 10000;
  const double all = seconds_of([&] {
    for (int i = 0; i < steps; ++i) replay.step_back();
  });
  fmt::print("  a step back, mean of {}     {:8.2f} us\n", steps, 1e6 * all / steps);
  std::filesystem::remove(path);
}
