// What is known of things by their numbers.
#pragma once

#include <cstddef>
#include <cstdint>
#include <unordered_map>
#include <vector>

namespace zstep::diff {

/// Numbers that a run gives one after another are looked up in a vector, any others in a map. What was never set is
/// T{}.
template <class T>
class ByNumber {
 public:
  T operator[](std::int32_t number) const {
    if (is_dense(number)) return dense_[index(number)];
    if (sparse_.empty()) return T{};
    const auto found = sparse_.find(number);
    return found == sparse_.end() ? T{} : found->second;
  }
  T& edit(std::int32_t number) {
    if (is_dense(number)) return dense_[index(number)];
    if (number < 0 || index(number) > 2 * dense_.size() + few) return sparse_[number];
    dense_.resize(index(number) + 1);
    std::erase_if(sparse_, [&](const auto& entry) {
      const bool moves = is_dense(entry.first);
      if (moves) dense_[index(entry.first)] = entry.second;
      return moves;
    });
    return dense_[index(number)];
  }

 private:
  static constexpr std::size_t few = 4096;
  static std::size_t index(std::int32_t number) { return static_cast<std::size_t>(number); }
  bool is_dense(std::int32_t number) const { return number >= 0 && index(number) < dense_.size(); }

  std::vector<T> dense_;
  std::unordered_map<std::int32_t, T> sparse_;
};

}  // namespace zstep::diff
