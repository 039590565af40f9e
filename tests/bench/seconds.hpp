// How long something takes.
#pragma once

#include <chrono>
#include <ctime>

/// By the clock on the wall.
inline double seconds_of(const auto& work) {
  const auto begin = std::chrono::steady_clock::now();
  work();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
}

/// By what the process was given of the processors, all its threads together: where others use the machine.
inline double processor_seconds_of(const auto& work) {
  const std::clock_t begin = std::clock();
  work();
  return static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC;
}
