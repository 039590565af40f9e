// Work in parts, shared by several threads.
#pragma once

#include <atomic>
#include <cstddef>
#include <exception>
#include <mutex>
#include <system_error>
#include <thread>
#include <vector>

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
  others.reserve(static_cast<std::size_t>(threads > 1 ? threads - 1 : 0));
  try {
    for (int k = 1; k < threads && static_cast<std::size_t>(k) < parts; ++k) others.emplace_back(take_parts);
  } catch (const std::system_error&) {  // no thread is to be had
  }
  take_parts();
  for (std::thread& other : others) other.join();
  if (fault) std::rethrow_exception(fault);
}

}  // namespace zstep::simd
