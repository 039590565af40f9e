#include "sim/words/numbers.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <vector>

#include <fmt/format.h>

#include "traces/math/portable_math.hpp"
#include "traces/math/whole.hpp"

namespace zstep {

std::string hex_text(double value) {
  if (value == 0) return std::signbit(value) ? "-0x0p+0" : "0x0p+0";
  return fmt::format("{:a}", value);
}

namespace {

constexpr const char* minus_sign = "\u2212";

/// A real minus sign where a number or its exponent is negative; "−0.00" is written "0.00".
std::string with_minus(std::string text) {
  if (!text.empty() && text[0] == '-' && text.find_first_of("123456789") == std::string::npos) text.erase(0, 1);
  for (std::size_t at = text.find('-'); at != std::string::npos; at = text.find('-', at))
    text.replace(at, 1, minus_sign);
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
  const double scale = portable::pow(10.0, decimals);
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
  std::string text = needs_exponent(value) ? fmt::format("{:.{}e}", value, std::max(2, at_most_decimals - 2))
                                           : fmt::format("{:.{}f}", value, at_most_decimals);
  if (text.find('e') == std::string::npos && text.find('.') != std::string::npos) {
    text.erase(text.find_last_not_of('0') + 1);
    if (text.back() == '.') text.pop_back();
  }
  return with_minus(text);
}

std::string factor(double value) {
  const double magnitude = std::abs(value);
  if (!(magnitude >= 1e-4 && magnitude < 0.1)) return number(value);
  return number(value, usual_decimals - 1 - floor_int(portable::log10(magnitude)), true);
}

int decimals_needed(std::span<const double> values, int at_most) {
  int needed = 0;
  for (const double value : values) {
    if (!std::isfinite(value)) continue;
    while (needed < at_most && std::abs(rounded(value, needed) - value) > 1e-9 * std::max(1.0, std::abs(value)))
      ++needed;
    if (needed == at_most) break;
  }
  if (needed < at_most) return needed;
  // Not short: two decimals, or as many as tell the values apart.
  std::vector<double> sorted{0};  // what is seen with all decimals is told apart from 0, too
  const double least = 0.5 * portable::pow(10.0, -at_most);
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
  return with_minus(decimal) + " (" + hex_text(value) + ")";
}

std::vector<std::pair<std::size_t, std::size_t>> numbers_in(std::string_view text) {
  std::vector<std::pair<std::size_t, std::size_t>> places;
  const auto digit = [&](std::size_t at) { return at < text.size() && text[at] >= '0' && text[at] <= '9'; };
  const auto starts = [&](std::size_t at, std::string_view with) {
    return text.substr(std::min(at, text.size())).starts_with(with);
  };
  const auto digits_from = [&](std::size_t at) {
    while (digit(at)) ++at;
    return at;
  };
  const std::string_view minus = minus_sign;
  bool in_name = false;
  for (std::size_t at = 0; at < text.size();) {
    // A sign belongs to the number unless it stands between two.
    const bool after_operand = at > 0 && (digit(at - 1) || text[at - 1] == ')' || text[at - 1] == ']' || in_name);
    std::size_t end = starts(at, minus) && !after_operand ? at + minus.size() : at;
    if (in_name || !(digit(end) || starts(end, "\u221e"))) {
      const char c = text[at];
      in_name = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_' || c == '*' ||
                (in_name && (digit(at) || (c == '.' && digit(at + 1))));
      if (c == '*') in_name = at > 0 && text[at - 1] == 'z';  // z*, a depth's name
      ++at;
      continue;
    }
    if (digit(end)) {
      end = digits_from(end);
      if (end < text.size() && text[end] == '.' && digit(end + 1)) end = digits_from(end + 1);
      const std::size_t power = starts(end, "e") ? end + (starts(end + 1, minus) ? 1 + minus.size()
                                                          : starts(end + 1, "+") ? 2
                                                                                 : 1)
                                                 : text.size();
      if (digit(power)) end = digits_from(power);
    } else {
      end += std::string_view("\u221e").size();
    }
    places.emplace_back(at, end - at);
    at = end;
  }
  return places;
}

bool shown_as(double value, std::string_view text) {
  std::string plain(text);
  for (std::size_t at = plain.find(minus_sign); at != std::string::npos; at = plain.find(minus_sign, at))
    plain.replace(at, std::string_view(minus_sign).size(), "-");
  if (plain.find("\u221e") != std::string::npos) return std::isinf(value) && (value < 0) == (plain[0] == '-');
  char* rest = nullptr;
  const double written = std::strtod(plain.c_str(), &rest);
  if (rest == plain.c_str() || *rest != '\0' || !std::isfinite(value)) return false;
  const std::size_t power = std::min(plain.find('e'), plain.size()), point = plain.find('.');
  const int decimals = point == std::string::npos ? 0 : static_cast<int>(power - point) - 1;
  const double unit = portable::pow(10.0, (power < plain.size() ? std::atoi(plain.c_str() + power + 1) : 0) - decimals);
  return std::abs(value - written) <= 0.5 * unit * (1 + 1e-9);
}

std::string grouped(std::int64_t value) {
  std::string digits = std::to_string(value < 0 ? -value : value);
  for (std::size_t at = digits.size(); at > 3; at -= 3) digits.insert(at - 3, "\u00a0");
  return value < 0 ? minus_sign + digits : digits;
}

std::string three_digits(double value) {
  const int decimals = value >= 100 ? 0 : value >= 10 ? 1 : value >= 1 ? 2 : 3;
  return fmt::format("{:.{}f}", value, decimals);
}

std::string seconds_text(double seconds) {
  if (seconds < 0.1e-3) return three_digits(seconds * 1e6) + " µs";
  return seconds < 1 ? three_digits(seconds * 1000) + " ms" : three_digits(seconds) + " s";
}

}  // namespace zstep
