#include "traces/math/read_number.hpp"

#include <cmath>
#include <cstdlib>
#include <string>

namespace zstep {
namespace {

/// How many digits there are from `at` on.
std::size_t digits(std::string_view text, std::size_t at) {
  std::size_t end = at;
  while (end < text.size() && text[end] >= '0' && text[end] <= '9') ++end;
  return end - at;
}

}  // namespace

std::size_t read_number(std::string_view text, double& value) {
  const auto is = [&](std::size_t at, std::string_view signs) {
    return at < text.size() && signs.find(text[at]) != std::string_view::npos;
  };
  std::size_t end = is(0, "-") ? 1 : 0;
  const std::size_t whole = digits(text, end);
  end += whole;
  const std::size_t part = is(end, ".") ? digits(text, end + 1) : 0;
  if (whole + part == 0) return 0;
  if (is(end, ".")) end += 1 + part;
  if (is(end, "eE")) {
    const std::size_t sign = is(end + 1, "+-") ? 1 : 0, power = digits(text, end + 1 + sign);
    if (power > 0) end += 1 + sign + power;
  }
  const double read = std::strtod(std::string(text.substr(0, end)).c_str(), nullptr);
  if (!std::isfinite(read)) return 0;
  value = read;
  return end;
}

}  // namespace zstep
