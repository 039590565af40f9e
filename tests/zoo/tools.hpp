// What programs of the zoo share, as students share a small library: printing a step as JSON, and vectors.
#pragma once

#include <cmath>
#include <concepts>
#include <cstdio>
#include <string>

#include "tests/zoo/programs.hpp"

namespace zoo {

inline Point operator+(Point a, Point b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
inline Point operator-(Point a, Point b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
inline Point operator*(double k, Point a) { return {k * a.x, k * a.y, k * a.z}; }
inline double dot(Point a, Point b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
inline Point cross(Point a, Point b) { return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x}; }

/// What a program prints: print("ray_end", "ray", 3, "t", 0.5) is {"step":"ray_end","ray":3,"t":0.5}.
class Output {
 public:
  std::string text;

  template <class... Fields>
  void print(const char* step, Fields... fields) {
    text += "{\"step\":";
    add(step);
    add_fields(fields...);
    text += "}\n";
  }

 private:
  void add(const char* word) { text += '"' + std::string(word) + '"'; }
  void add(bool yes) { text += yes ? "true" : "false"; }
  void add(std::integral auto whole) { text += std::to_string(whole); }
  void add(double number) {
    if (std::isnan(number)) return add("nan");
    if (std::isinf(number)) return add(number < 0 ? "-inf" : "inf");
    char digits[40];
    std::snprintf(digits, sizeof digits, "%.17g", number);
    text += digits;
  }
  void add_fields() {}
  template <class Value, class... Rest>
  void add_fields(const char* key, Value value, Rest... rest) {
    text += ',';
    add(key);
    text += ':';
    add(value);
    add_fields(rest...);
  }
};

}  // namespace zoo
