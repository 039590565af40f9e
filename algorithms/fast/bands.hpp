// A picture in bands of rows, which threads draw at the same time: each goes through all outlines in their order, so
// every pixel sees its polygons in the order of the taught loop.
#pragma once

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <exception>
#include <mutex>
#include <system_error>
#include <thread>
#include <vector>

#include "algorithms/fast/z_buffer_outlines.hpp"
#include "traces/scene.hpp"

namespace zstep::simd {

/// Calls work(part) once for each part from 0 on, on this thread and up to threads - 1 others at the same time; on
/// fewer where the system gives no more. What a part throws is thrown here, when all threads have ended.
template <class Work>
void parallel_for(int threads, std::size_t parts, Work&& work) {
  std::atomic<std::size_t> next = 0;
  std::exception_ptr fault;
  std::mutex faults;
  const auto take_parts = [&] {
    try {
      for (std::size_t part = next++; part < parts; part = next++) work(part);
    } catch (...) {
      const std::lock_guard<std::mutex> lock(faults);
      if (!fault) fault = std::current_exception();
      next = parts;
    }
  };
  std::vector<std::thread> others;
  others.reserve(threads > 1 ? threads - 1 : 0);
  try {
    for (int k = 1; k < threads && static_cast<std::size_t>(k) < parts; ++k) others.emplace_back(take_parts);
  } catch (const std::system_error&) {  // no thread is to be had
  }
  take_parts();
  for (std::thread& other : others) other.join();
  if (fault) std::rethrow_exception(fault);
}

}  // namespace zstep::simd

namespace zstep::z_buffer {

/// What one thread draws: all outlines, on the rows of its band. It touches no memory of other rows.
struct Fill {
  const Outlines& all;
  Picture& picture;
  std::int32_t first_row, end_row;
  bool clear_first;
};

inline int threads_for(const Raster& raster, int wanted) {
  constexpr int most = 16, rows_worth_it = 64;
  if (wanted > 0) return std::clamp(wanted, 1, std::max(1, raster.height));
  const int there = static_cast<int>(std::thread::hardware_concurrency());
  return std::clamp(std::min(there, raster.height / rows_worth_it), 1, most);
}

/// More than threads, as some have more to draw; and each small enough to stay near the processor while it is drawn.
inline std::int32_t bands_for(const Raster& raster, int threads) {
  constexpr std::int64_t near_by = 1 << 20;  // bytes
  constexpr std::int64_t of_pixel = sizeof(double) + sizeof(std::int32_t);
  const std::int64_t bytes = of_pixel * raster.width * raster.height;
  const std::int64_t shared = threads == 1 ? 1 : 4 * std::int64_t{threads};
  return static_cast<std::int32_t>(
      std::min<std::int64_t>(std::max(shared, bytes / near_by), std::max(1, raster.height / 8)));
}

inline void clear_band(Fill& fill) {
  if (!fill.clear_first) return;
  const std::size_t first = fill.picture.at(0, fill.first_row), end = fill.picture.at(0, fill.end_row);
  std::fill(fill.picture.depth.data() + first, fill.picture.depth.data() + end, no_depth);
  std::fill(fill.picture.polygon.data() + first, fill.picture.polygon.data() + end, no_polygon);
}

/// `fill_band`: draws all outlines into one Fill. `wanted`: threads, 0 for as many as are worth it.
template <class FillBand>
void draw_in_bands(const Scene& scene, const Conventions& conventions, Picture& picture, int wanted,
                   FillBand&& fill_band) {
  const Raster& raster = scene.raster;
  const bool kept = picture.width == raster.width && picture.height == raster.height;
  if (kept) picture.ink.clear();
  else picture = Picture(raster.width, raster.height);

  const int threads = threads_for(raster, wanted);
  const std::int32_t bands = bands_for(raster, threads);
  const std::size_t parts = threads;
  Outlines all(scene, conventions, parts);
  // To begin a thread takes as long as some thousands of these.
  const int viewing = scene.points.size() < 30'000 ? 1 : threads, finding = scene.facets.size() < 4'000 ? 1 : threads;
  simd::parallel_for(viewing, parts, [&](std::size_t part) { all.view(part); });
  simd::parallel_for(finding, parts, [&](std::size_t part) { all.find(part); });
  all.finish();
  simd::parallel_for(threads, static_cast<std::size_t>(bands), [&](std::size_t band) {
    const auto row_of = [&](std::size_t k) {
      return static_cast<std::int32_t>(std::int64_t{raster.height} * static_cast<std::int64_t>(k) / bands);
    };
    Fill fill{all, picture, row_of(band), row_of(band + 1), kept};
    fill_band(fill);
  });
}

}  // namespace zstep::z_buffer
