#include "sim/viewer/words/numbers.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <vector>

#include <fmt/format.h>

namespace zstep {
namespace {

constexpr const char* minus_sign = "\u2212";

/// A real minus sign where a number or its exponent is negative; "−0.00" is written "0.00".
std::string with_minus(std::string text) {
  if (!text.empty() && text[0] == '-' && text.find_first_of("123456789") == std::string::npos) text.erase(0, 1);
  for (std::size_t at = text.find('-'); at != std::string::npos; at = text.find('-', at)) text.replace(at, 1, minus_sign);
  return text;
}

bool needs_exponent(double value) {
  const double magnitude = std::abs(value);
  return magnitude >= 1e9 || (magnitude != 0 && magnitude < 1e-4);
}

std::string not_finite(double value) {
  if (std::isnan(value)) return "undefined";
  return value < 0 ? "\u2212\u221e" : "\u221e";
}

double rounded(double value, int decimals) {
  const double scale = std::pow(10.0, decimals);
  return std::round(value * scale) / scale;
}

}  // namespace

std::string number(double value, int decimals) {
  if (!std::isfinite(value)) return not_finite(value);
  if (std::abs(value) >= 1e9) return with_minus(fmt::format("{:.{}e}", value, std::max(decimals, 2)));
  return with_minus(fmt::format("{:.{}f}", value, decimals));
}

std::string cell_number(double value, int decimals) {
  if (value == 0 || !std::isfinite(value) || rounded(value, decimals) != 0) return number(value, decimals);
  std::string text = fmt::format("{:.0e}", value);
  for (const std::size_t zero = text.find('e') + 2; text[zero] == '0' && zero + 1 < text.size();) text.erase(zero, 1);
  return with_minus(text);
}

std::string number(double value, int at_most_decimals, bool shorten) {
  if (!shorten) return number(value, at_most_decimals);
  if (!std::isfinite(value)) return not_finite(value);
  std::string text = needs_exponent(value) ? fmt::format("{:.2e}", value) : fmt::format("{:.{}f}", value, at_most_decimals);
  if (text.find('e') == std::string::npos && text.find('.') != std::string::npos) {
    text.erase(text.find_last_not_of('0') + 1);
    if (text.back() == '.') text.pop_back();
  }
  return with_minus(text);
}

std::string factor(double value) {
  const double magnitude = std::abs(value);
  if (!(magnitude >= 1e-4 && magnitude < 0.1)) return number(value);
  return number(value, usual_decimals - 1 - static_cast<int>(std::floor(std::log10(magnitude))), true);
}

int decimals_needed(std::span<const double> values, int at_most) {
  int needed = 0;
  for (const double value : values) {
    if (!std::isfinite(value)) continue;
    while (needed < at_most && std::abs(rounded(value, needed) - value) > 1e-9 * std::max(1.0, std::abs(value))) ++needed;
    if (needed == at_most) break;
  }
  if (needed < at_most) return needed;
  // Not short: two decimals, or as many as tell the values apart.
  std::vector<double> sorted{0};  // what is seen with all decimals is told apart from 0, too
  const double least = 0.5 * std::pow(10.0, -at_most);
  for (const double value : values)
    if (std::isfinite(value) && std::abs(value) >= least) sorted.push_back(value);
  std::sort(sorted.begin(), sorted.end());
  sorted.erase(std::unique(sorted.begin(), sorted.end()), sorted.end());
  for (int decimals = std::min(2, at_most); decimals < at_most; ++decimals) {
    bool distinct = true;
    for (std::size_t i = 1; i < sorted.size() && distinct; ++i)
      distinct = rounded(sorted[i - 1], decimals) != rounded(sorted[i], decimals);
    if (distinct) return decimals;
  }
  return at_most;
}

std::pair<std::string, std::string> tell_apart(double a, double b) {
  for (int decimals = usual_decimals; decimals <= 17; ++decimals) {
    std::pair<std::string, std::string> texts{number(a, decimals, true), number(b, decimals, true)};
    if (a == b || std::isnan(a) || std::isnan(b) || texts.first != texts.second) return texts;
  }
  return {with_minus(fmt::format("{:.17g}", a)), with_minus(fmt::format("{:.17g}", b))};
}

std::string exact(double value) {
  if (!std::isfinite(value)) return not_finite(value);
  std::string decimal;
  for (int digits = 1; digits <= 17; ++digits) {
    decimal = fmt::format("{:.{}g}", value, digits);
    if (std::strtod(decimal.c_str(), nullptr) == value) break;
  }
  return with_minus(decimal) + " (" + fmt::format("{:a}", value) + ")";
}

std::string grouped(std::int64_t value) {
  std::string digits = std::to_string(value < 0 ? -value : value);
  for (std::size_t at = digits.size(); at > 3; at -= 3) digits.insert(at - 3, "\u00a0");
  return value < 0 ? minus_sign + digits : digits;
}

}  // namespace zstep
