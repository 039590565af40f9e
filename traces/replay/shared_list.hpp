// A list in pieces, which copies share until one of them changes, and into whose middle items go.
#pragma once

#include <algorithm>
#include <cstddef>
#include <iterator>
#include <memory>
#include <utility>
#include <vector>

namespace zstep {

template <class T>
class SharedList {
 public:
  static constexpr std::size_t longest = 512;  ///< items of a piece; one more, and it becomes two

  std::size_t size() const { return size_; }
  bool empty() const { return size_ == 0; }
  /// In as many steps as there are pieces; go through a list by its iterators.
  const T& operator[](std::size_t place) const {
    const auto [piece, at] = find(place);
    return (*pieces_[piece])[at];
  }

  class Iterator {
   public:
    using iterator_category = std::forward_iterator_tag;
    using value_type = T;
    using difference_type = std::ptrdiff_t;
    using pointer = const T*;
    using reference = const T&;

    Iterator() = default;
    Iterator(const SharedList& list, std::size_t piece) : list_(&list), piece_(piece) {}
    reference operator*() const { return (*list_->pieces_[piece_])[at_]; }
    pointer operator->() const { return &**this; }
    Iterator& operator++() {
      if (++at_ == list_->pieces_[piece_]->size()) ++piece_, at_ = 0;
      return *this;
    }
    Iterator operator++(int) {
      Iterator before = *this;
      ++*this;
      return before;
    }
    bool operator==(const Iterator& other) const { return piece_ == other.piece_ && at_ == other.at_; }

   private:
    const SharedList* list_ = nullptr;
    std::size_t piece_ = 0, at_ = 0;
  };
  Iterator begin() const { return {*this, 0}; }
  Iterator end() const { return {*this, pieces_.size()}; }

  T& edit(std::size_t place) {
    const auto [piece, at] = find(place);
    return own(piece)[at];
  }
  /// Before what stands at `place`, or at the end.
  void insert(std::size_t place, T item) {
    if (pieces_.empty()) pieces_.push_back(std::make_shared<std::vector<T>>());
    auto [piece, at] = place < size_ ? find(place) : std::pair{pieces_.size() - 1, pieces_.back()->size()};
    std::vector<T>& items = own(piece);
    items.insert(items.begin() + static_cast<std::ptrdiff_t>(at), std::move(item));
    ++size_;
    if (items.size() <= longest) return;
    const auto half = items.begin() + static_cast<std::ptrdiff_t>(items.size() / 2);
    auto rest = std::make_shared<std::vector<T>>(half, items.end());
    items.erase(half, items.end());
    pieces_.insert(pieces_.begin() + static_cast<std::ptrdiff_t>(piece) + 1, std::move(rest));
  }
  void erase(std::size_t place) {
    const auto [piece, at] = find(place);
    std::vector<T>& items = own(piece);
    items.erase(items.begin() + static_cast<std::ptrdiff_t>(at));
    --size_;
    if (items.empty()) pieces_.erase(pieces_.begin() + static_cast<std::ptrdiff_t>(piece));
  }

  bool shares_with(const SharedList& other) const { return size_ == other.size_ && pieces_ == other.pieces_; }
  /// Calls each(const std::vector<T>&) for the pieces that this alone holds of both.
  template <class Each>
  void for_each_beyond(const SharedList& other, Each&& each) const {
    auto theirs = other.pieces_;
    std::sort(theirs.begin(), theirs.end());
    for (const Piece& piece : pieces_)
      if (!std::binary_search(theirs.begin(), theirs.end(), piece)) each(std::as_const(*piece));
  }

 private:
  using Piece = std::shared_ptr<std::vector<T>>;  ///< never empty

  std::pair<std::size_t, std::size_t> find(std::size_t place) const {
    std::size_t piece = 0;
    for (; place >= pieces_[piece]->size(); ++piece) place -= pieces_[piece]->size();
    return {piece, place};
  }
  std::vector<T>& own(std::size_t number) {
    Piece& piece = pieces_[number];
    if (piece.use_count() > 1) piece = std::make_shared<std::vector<T>>(*piece);
    return *piece;
  }

  std::size_t size_ = 0;
  std::vector<Piece> pieces_;
};

}  // namespace zstep
