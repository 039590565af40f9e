// A value that is T{} nearly everywhere it could stand: names and materials of polygons, of which a mesh has millions.
#pragma once

#include <concepts>
#include <memory>
#include <type_traits>
#include <utility>

namespace zstep {

/// Takes the room of a pointer, and memory only where it is anything else than T{}. Read it as one reads an optional.
template <class T>
class Rare {
 public:
  Rare() = default;
  template <class U>
  requires(std::convertible_to<U, T> && !std::same_as<std::remove_cvref_t<U>, Rare>) Rare(U&& value)
      : Rare(std::in_place, T(std::forward<U>(value))) {}
  Rare(const Rare& other) : value_(other.value_ ? std::make_unique<T>(*other.value_) : nullptr) {}
  Rare(Rare&&) noexcept = default;
  Rare& operator=(const Rare& other) { return *this = Rare(other); }
  Rare& operator=(Rare&&) noexcept = default;
  Rare& operator=(T value) { return *this = Rare(std::in_place, std::move(value)); }
  ~Rare() = default;

  const T& operator*() const { return value_ ? *value_ : usual_; }
  const T* operator->() const { return &**this; }
  bool is_usual() const { return !value_; }

  friend bool operator==(const Rare& a, const Rare& b) { return *a == *b; }

 private:
  Rare(std::in_place_t, T value) : value_(value == T{} ? nullptr : std::make_unique<T>(std::move(value))) {}

  inline static const T usual_{};
  std::unique_ptr<T> value_;  ///< null: T{}
};

}  // namespace zstep
