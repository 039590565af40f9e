// How far two runs do the same steps in the same order: there, what a step is about need not be found out.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <unordered_set>

#include "traces/diff/align.hpp"
#include "traces/diff/identity.hpp"

namespace zstep::diff {

/// Beyond so many differences the comparison ends.
inline constexpr std::size_t most_differences = 20'000'000;

/// By kind: whether both runs record it.
using Both = std::array<bool, kind_count>;

/// Polygons that were begun. Who works scan line by scan line comes back to them.
class Begun {
 public:
  bool again(const Event& event) {
    if (holds<BuffersClear>(event) || holds<PassBegin>(event)) polygons_.clear();
    const auto* polygon = get_if<PolygonBegin>(&event);
    return polygon && !polygons_.insert(polygon->polygon).second;
  }

 private:
  std::unordered_set<std::int32_t> polygons_;
};

struct InStep {
  std::int64_t a = 0, b = 0;  ///< the last steps that are the same
  Identity of_a, of_b;        ///< what the runs call things by then
  Begun begun;
  bool identical = false;   ///< to the end, and byte for byte
  bool told_to_end = false;
};

/// Goes through both runs until their steps part, but for numbers that came out otherwise, and takes note of pairs and
/// differences.
InStep go_in_step(const Trace& a, const Trace& b, const Both& both, Alignment& found,
                  const std::function<bool(double)>& on_way);

/// Steps a and b are the same, and so are those after them, so many in all.
void extend(std::vector<Match>& matches, std::int64_t a, std::int64_t b, std::int64_t count);

}  // namespace zstep::diff
