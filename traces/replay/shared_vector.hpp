// A vector that copies share until one of them changes.
#pragma once

#include <cstddef>
#include <memory>
#include <vector>

namespace zstep {

/// Check-points of a replay copy all that a method has at hand; most of it did not change since the last one.
template <class T>
class SharedVector {
 public:
  const std::vector<T>& all() const {
    static const std::vector<T> none;
    return items_ ? *items_ : none;
  }
  std::size_t size() const { return all().size(); }
  bool empty() const { return all().empty(); }
  const T& operator[](std::size_t i) const { return all()[i]; }
  const T& back() const { return all().back(); }
  auto begin() const { return all().begin(); }
  auto end() const { return all().end(); }

  /// The vector, to be changed: this copy's own from now on.
  std::vector<T>& edit() {
    if (!items_) items_ = std::make_shared<std::vector<T>>();
    else if (items_.use_count() > 1) items_ = std::make_shared<std::vector<T>>(*items_);
    return *items_;
  }
  void clear() { items_.reset(); }

  bool shares_with(const SharedVector& other) const { return items_ == other.items_; }

 private:
  std::shared_ptr<std::vector<T>> items_;
};

}  // namespace zstep
