// Where something begins to go wrong while one number moves: looked for between samples, by halving.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

namespace zstep::compare {

struct Sample {
  double at = 0;           ///< what was moved
  std::int64_t wrong = 0;  ///< how much was wrong there
};

struct Threshold {
  enum class Kind : std::uint8_t {
    none,        ///< nothing is wrong at any sample
    everywhere,  ///< the first sample is wrong already: it begins before
    found,
  };
  /// Where farther on less is wrong: what was found then is a threshold, not the one.
  struct Fall {
    Sample from, to;
  };
  Kind kind = Kind::none;
  double at = 0;  ///< wrong here, and right a thousandth before
  std::optional<Fall> fall;
};

/// `samples` go from where little is wrong to where much is, all above 0; `wrong_at` measures between them. What is
/// measured counts for `fall`, too.
inline Threshold threshold_of(std::vector<Sample> samples, const std::function<std::int64_t(double)>& wrong_at) {
  constexpr double fine = 1e-3;
  Threshold threshold;
  std::size_t first = 0;
  while (first < samples.size() && samples[first].wrong == 0) ++first;
  if (first == samples.size()) return threshold;
  threshold.kind = first == 0 ? Threshold::Kind::everywhere : Threshold::Kind::found;
  if (first > 0) {
    const auto far_apart = [&] {
      const double right = samples[first - 1].at, wrong = samples[first].at;
      return right > wrong * (1 + fine) || wrong > right * (1 + fine);
    };
    while (far_apart()) {
      const double middle = (samples[first - 1].at + samples[first].at) / 2;
      const Sample between{middle, wrong_at(middle)};
      samples.insert(samples.begin() + static_cast<std::ptrdiff_t>(first), between);
      if (between.wrong == 0) ++first;
    }
  }
  threshold.at = samples[first].at;
  for (std::size_t k = first + 1; k < samples.size() && !threshold.fall; ++k)
    if (samples[k].wrong < samples[k - 1].wrong) threshold.fall = {samples[k - 1], samples[k]};
  return threshold;
}

}  // namespace zstep::compare
