// Prints what traces of full size cost: recording against an untraced run, bytes and time an event, opening, seeking,
// stepping back, and asking. Medians of runs that take turns, all in one process, as one table in Markdown: that of
// the README.
//
//     zstep_bench_trace [WORKLOAD…]        default: all of them; `zstep_bench_trace list` names them
#include <malloc.h>
#include <unistd.h>

#include <fmt/format.h>

#include <chrono>
#include <filesystem>
#include <fstream>
#include <functional>
#include <optional>
#include <random>
#include <string>
#include <vector>

#include "algorithms/catalog/catalog.hpp"
#include "algorithms/ray_casting/ray_casting.hpp"
#include "algorithms/z_buffer/z_buffer.hpp"
#include "sim/answers/pixel_history.hpp"
#include "tests/bench/answers.hpp"
#include "tests/bench/crowds.hpp"
#include "tests/bench/seconds.hpp"
#include "traces/file/visit.hpp"
#include "traces/replay/replay.hpp"

using namespace zstep;

namespace {

/// The value below which this share of the samples lies.
double quantile(std::vector<double> samples, double share) {
  std::sort(samples.begin(), samples.end());
  return samples[static_cast<std::size_t>(share * static_cast<double>(samples.size() - 1))];
}

/// Memory of this process that is in use, in bytes.
double memory() {
  malloc_trim(0);
  std::ifstream in("/proc/self/statm");
  double pages = 0, resident = 0;
  in >> pages >> resident;
  return resident * static_cast<double>(sysconf(_SC_PAGESIZE));
}

struct Workload {
  std::string name, method;
  std::function<Scene()> scene;
  Conventions conventions{};
  /// The taught way without a trace; `render` is a faster one for some methods.
  void untraced(const Scene& input, const Conventions& how, NullRecorder& none) const {
    if (method == "z-buffer") z_buffer::run(input, how, none);
    else if (method == "ray-casting") ray_casting::run(input, how, none);
    else zstep::method(method).render(input, how, none);
  }
};

Scene teapot_at(int level, std::int32_t width, std::int32_t height) {
  ViewOptions view;
  view.width = width, view.height = height;
  return look_at_scene(load_scene("teapot:" + std::to_string(level)).scene, view);
}

std::vector<Workload> workloads() {
  Conventions both_sides;
  both_sides.cull = false;
  return {
      {"z-buffer, 48 copies of 3 552 triangles, 1024x768", "z-buffer",
       [] { return bench::crowd(bench::teapot(8), 48, 1024, 768); }, both_sides},
      {"z-buffer, 2 000 000 triangles, 1024x768", "z-buffer",
       [] {
         Scene scene = bench::torus(1000, 1000, true);
         bench::look(scene, 1024, 768);
         return scene;
       },
       both_sides},
      {"ray-casting, teapot:8, 320x240", "ray-casting", [] { return teapot_at(8, 320, 240); }},
      {"warnock, 48 copies, 1024x768", "warnock", [] { return bench::crowd(bench::teapot(8), 48, 1024, 768); },
       both_sides},
      {"bsp, teapot:20, 1024x768", "bsp", [] { return teapot_at(20, 1024, 768); }},
      {"depth-sort, teapot:60, 1024x768", "depth-sort", [] { return teapot_at(60, 1024, 768); }},
      {"scan-line, 16 copies, 1024x768", "scan-line", [] { return bench::crowd(bench::teapot(8), 16, 1024, 768); },
       both_sides},
  };
}

struct Figures {
  std::vector<std::pair<std::string, std::string>> rows;
  void add(const std::string& name, const std::string& value) {
    rows.emplace_back(name, value);
    fmt::print(stderr, "  {:50} {}\n", name, value);
  }
};

Figures measure(const Workload& workload) {
  const Scene scene = workload.scene();
  const Method& taught = method(workload.method);
  const std::filesystem::path path =
      std::filesystem::temp_directory_path() / fmt::format("zstep_trace_bench_{}.ztrace", getpid());
  Figures figures;

  constexpr int runs = 5;
  std::vector<double> untraced, traced;
  NullRecorder none;
  for (int run = 0; run < runs; ++run) {
    untraced.push_back(seconds_of([&] { workload.untraced(scene, workload.conventions, none); }));
    std::filesystem::remove(path);
    traced.push_back(seconds_of([&] {
      TraceRecorder recorder(path, header_for(taught, workload.conventions), scene);
      taught.record(scene, workload.conventions, recorder);
      recorder.finish();
    }));
    if (untraced.front() + traced.front() > 10) break;
  }
  const double before = memory();
  std::optional<Trace> opened;
  std::optional<Replay> replayed;
  const double open = seconds_of([&] {
    opened.emplace(Trace::open(path));
    replayed.emplace(*opened);
    replayed->go_to(1);
  });
  const Trace& trace = *opened;
  Replay& replay = *replayed;
  const auto events = static_cast<double>(trace.size());
  const double to_end = seconds_of([&] { replay.go_to(trace.size()); });

  double event_bytes = 0;
  for (const auto& block : trace.impl().blocks) event_bytes += static_cast<double>(block.place.size);
  const auto file_bytes = static_cast<double>(std::filesystem::file_size(path));
  figures.add("events", fmt::format("{:.1f} M", events / 1e6));
  figures.add("untraced run", fmt::format("{:.2f} s", quantile(untraced, 0.5)));
  figures.add("recording to a file / untraced run",
              fmt::format("{:.2f}", quantile(traced, 0.5) / quantile(untraced, 0.5)));
  figures.add("bytes an event on disk (with the scene)",
              fmt::format("{:.3f} ({:.3f})", event_bytes / events, file_bytes / events));

  std::vector<double> decoding;
  std::uint64_t touched = 0;  // of every field of every event, so that none of them is left out
  for (int run = 0; run < 3; ++run) {
    decoding.push_back(seconds_of([&] {
      trace.visit(0, trace.size(), [&]<class E>(std::int64_t, std::uint8_t, const E& event) {
        for_each_index<E>([&]<std::size_t I>() {
          const auto value = event.*field_at<E, I>.member;
          if constexpr (std::is_same_v<FieldValue<E, I>, double>) touched ^= bits_of(value);
          else touched += static_cast<std::uint64_t>(value);
        });
        return true;
      });
    }));
  }
  if (touched == 42) fmt::print(" ");
  figures.add("decode, unpacking included, every field read",
              fmt::format("{:.2f} ns an event", 1e9 * quantile(decoding, 0.5) / events));
  figures.add("open until the first picture", fmt::format("{:.3f} s", open));
  figures.add("from there to the last, the first time", fmt::format("{:.2f} s", to_end));

  std::mt19937_64 random(1);
  const auto some_step = [&] {
    return static_cast<std::int64_t>(random() % static_cast<std::uint64_t>(trace.size())) + 1;
  };
  std::vector<double> seeks;
  for (int i = 0; i < 300; ++i) {
    const std::int64_t target = some_step();
    seeks.push_back(1e3 * seconds_of([&] { replay.go_to(target); }));
  }
  figures.add("random seek with full state, median; p99",
              fmt::format("{:.1f} ms; {:.1f} ms", quantile(seeks, 0.5), quantile(seeks, 0.99)));
  replay.go_to(trace.size() / 2);
  constexpr int steps = 10000;
  const double back = seconds_of([&] {
    for (int i = 0; i < steps; ++i) replay.step_back();
  });
  figures.add("a step back, mean of 10 000", fmt::format("{:.1f} us", 1e6 * back / steps));

  const Raster& raster = scene.raster;
  std::optional<answers::FacetsNear> facets;
  const double preparing = seconds_of([&] { facets.emplace(trace); });
  std::vector<double> histories;
  std::size_t visits = 0;
  const auto some_pixel = [&] {
    return Trace::Pixel{static_cast<std::int32_t>(random() % static_cast<std::uint64_t>(raster.width)),
                        static_cast<std::int32_t>(random() % static_cast<std::uint64_t>(raster.height))};
  };
  for (int i = 0; i < 200; ++i) {
    const Trace::Pixel pixel = some_pixel();
    histories.push_back(1e3 * seconds_of([&] { visits += answers::pixel_history(trace, *facets, pixel).size(); }));
  }
  figures.add(
      "pixel history, median; p99",
      fmt::format("{:.2f} ms; {:.2f} ms (of {:.1f} entries; {:.0f} ms once, to prepare)", quantile(histories, 0.5),
                  quantile(histories, 0.99), static_cast<double>(visits) / 200, 1e3 * preparing));
  for (const auto& [name, value] : bench::measure_answers(trace, replay)) figures.add(name, value);

  const double after = memory();
  figures.add("memory beyond the file, an event",
              fmt::format("{:.2f} bytes ({:.0f} MB)", (after - before) / events, (after - before) / 1e6));

  std::int64_t rows = 0;
  const bench::LargestTable table = bench::largest_table(trace);
  const double query = seconds_of([&] { rows = bench::scan_by_sql(trace, table); });
  figures.add("full-table SQL scan, two columns",
              fmt::format("{:.1f} M rows/s (of {})", static_cast<double>(rows) / query / 1e6, table.name));
  std::filesystem::remove(path);
  return figures;
}

}  // namespace

int main(int argc, char** argv) {
  std::vector<Workload> wanted;
  for (const Workload& workload : workloads()) {
    bool take = argc == 1;
    for (int i = 1; i < argc; ++i) take = take || workload.name.find(argv[i]) != std::string::npos;
    if (argc == 2 && std::string(argv[1]) == "list") fmt::print("{}\n", workload.name);
    if (take) wanted.push_back(workload);
  }
  std::vector<Figures> columns;
  for (const Workload& workload : wanted) {
    fmt::print(stderr, "{}\n", workload.name);
    columns.push_back(measure(workload));
  }
  if (columns.empty()) return 0;
  fmt::print("| |");
  for (const Workload& workload : wanted) fmt::print(" {} |", workload.name);
  fmt::print("\n|---|");
  for (std::size_t i = 0; i < wanted.size(); ++i) fmt::print("---|");
  for (std::size_t row = 0; row < columns[0].rows.size(); ++row) {
    fmt::print("\n| {} |", columns[0].rows[row].first);
    for (const Figures& figures : columns) fmt::print(" {} |", figures.rows[row].second);
  }
  fmt::print("\n");
}
