// Vectors and lists in pieces, which copies share until one of them changes: a copy costs a pointer a piece, and then
// what differs. States are copied often, as check-points and key frames, and little of them changes in between.
#pragma once

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <memory>
#include <utility>
#include <vector>

namespace zstep {

template <class T>
class SharedChunks {
 public:
  static constexpr std::size_t chunk_bytes = 32768, chunk_size = std::bit_floor(chunk_bytes / sizeof(T));

  std::size_t size() const { return size_; }
  bool empty() const { return size_ == 0; }
  const T& operator[](std::size_t i) const {
    const Chunk& chunk = chunks_[i / chunk_size];
    return chunk ? (*chunk)[i % chunk_size] : untouched_;
  }
  const T& back() const { return (*this)[size_ - 1]; }

  class Iterator {
   public:
    using iterator_category = std::forward_iterator_tag;
    using value_type = T;
    using difference_type = std::ptrdiff_t;
    using pointer = const T*;
    using reference = const T&;

    Iterator() = default;
    Iterator(const SharedChunks& all, std::size_t at) : all_(&all), at_(at) {}
    reference operator*() const { return (*all_)[at_]; }
    pointer operator->() const { return &(*all_)[at_]; }
    Iterator& operator++() {
      ++at_;
      return *this;
    }
    Iterator operator++(int) { return {*all_, at_++}; }
    bool operator==(const Iterator& other) const { return at_ == other.at_; }

   private:
    const SharedChunks* all_ = nullptr;
    std::size_t at_ = 0;
  };
  Iterator begin() const { return {*this, 0}; }
  Iterator end() const { return {*this, size_}; }

  /// An item, to be changed: its chunk is this copy's own from now on.
  T& edit(std::size_t i) { return own(i / chunk_size)[i % chunk_size]; }
  void push_back(T item) {
    const std::size_t chunk = size_ / chunk_size;
    if (chunk == chunks_.size()) chunks_.emplace_back();
    own(chunk).push_back(std::move(item));
    ++size_;
  }
  void pop_back() { resize(size_ - 1); }
  /// New items are T{}, and take no memory while whole chunks of them are.
  void resize(std::size_t size) {
    const std::size_t at_edge = std::min(size, size_) / chunk_size;
    if (at_edge < chunks_.size() && chunks_[at_edge])
      own(at_edge).resize(std::min(size - at_edge * chunk_size, chunk_size));
    chunks_.resize((size + chunk_size - 1) / chunk_size);
    size_ = size;
  }
  void clear() {
    const bool keep = !chunks_.empty() && chunks_[0] && chunks_[0].use_count() == 1;  // its memory is soon wanted again
    if (keep) chunks_[0]->clear();
    chunks_.resize(keep ? 1 : 0);
    size_ = 0;
  }

  bool shares_with(const SharedChunks& other) const { return size_ == other.size_ && chunks_ == other.chunks_; }
  /// Calls each(const std::vector<T>&) for the chunks that this alone holds of both.
  template <class Each>
  void for_each_beyond(const SharedChunks& other, Each&& each) const {
    for (std::size_t i = 0; i < chunks_.size(); ++i)
      if (chunks_[i] && !(i < other.chunks_.size() && other.chunks_[i] == chunks_[i])) each(std::as_const(*chunks_[i]));
  }
  /// Shares the chunks whose items are the same as the other's: `same(const T&, const T&)`.
  template <class Same>
  void share(const SharedChunks& other, Same&& same) {
    for (std::size_t i = 0; i < std::min(chunks_.size(), other.chunks_.size()); ++i) {
      if (chunks_[i] == other.chunks_[i] || !chunks_[i] || !other.chunks_[i]) continue;
      if (std::equal(chunks_[i]->begin(), chunks_[i]->end(), other.chunks_[i]->begin(), other.chunks_[i]->end(), same))
        chunks_[i] = other.chunks_[i];
    }
  }

 private:
  using Chunk = std::shared_ptr<std::vector<T>>;  ///< null: all of it T{}

  std::vector<T>& own(std::size_t number) {
    Chunk& chunk = chunks_[number];
    if (!chunk) chunk = std::make_shared<std::vector<T>>(std::min(size_ - number * chunk_size, chunk_size));
    else if (chunk.use_count() > 1) chunk = std::make_shared<std::vector<T>>(*chunk);
    return *chunk;
  }

  inline static const T untouched_{};

  std::size_t size_ = 0;
  std::vector<Chunk> chunks_;
};

// A list in pieces, which copies share until one of them changes, into whose middle items go, and whose items are found
// by a number that each has for itself.

/// `T::*key`: an item's number, from 0; no two items have the same one.
template <class T, std::int32_t T::*key>
class SharedList {
 public:
  static constexpr std::size_t longest = 512;  ///< items of a piece; one more, and it becomes two

  std::size_t size() const { return size_; }
  bool empty() const { return size_ == 0; }
  /// In as many steps as there are pieces; go through a list by its iterators.
  const T& operator[](std::size_t place) const {
    const auto [piece, at] = find(place);
    return pieces_[piece].items()[at];
  }
  bool contains(std::int32_t number) const {
    return number >= 0 && number < std::ssize(homes_) && homes_[index(number)] != nowhere;
  }
  /// Where the item of a number stands, which the list contains.
  std::size_t place_of(std::int32_t number) const {
    const std::uint32_t home = homes_[index(number)];
    std::size_t place = 0;
    auto piece = pieces_.begin();
    for (; piece->home != home; ++piece) place += piece->items().size();
    const auto item =
        std::find_if(piece->items().begin(), piece->items().end(), [&](const T& one) { return one.*key == number; });
    return place + static_cast<std::size_t>(item - piece->items().begin());
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
    reference operator*() const { return list_->pieces_[piece_].items()[at_]; }
    pointer operator->() const { return &**this; }
    Iterator& operator++() {
      if (++at_ == list_->pieces_[piece_].items().size()) ++piece_, at_ = 0;
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

  /// Its number must stay as it is.
  T& edit(std::size_t place) {
    const auto [piece, at] = find(place);
    return own(piece)[at];
  }
  /// Before what stands at `place`, or at the end.
  void insert(std::size_t place, T item) {
    if (pieces_.empty()) add_piece(0, {});
    const auto [piece, at] = place < size_ ? find(place) : std::pair{pieces_.size() - 1, pieces_.back().items().size()};
    settle(item, pieces_[piece].home);
    std::vector<T>& items = own(piece);
    items.insert(items.begin() + at, std::move(item));
    ++size_;
    if (items.size() <= longest) return;
    const auto half = items.begin() + (items.size() / 2);
    std::vector<T> rest(half, items.end());
    items.erase(half, items.end());
    add_piece(piece + 1, std::move(rest));
  }
  void erase(std::size_t place) {
    const auto [piece, at] = find(place);
    std::vector<T>& items = own(piece);
    settle(items[at], nowhere);
    items.erase(items.begin() + at);
    --size_;
    if (items.empty()) pieces_.erase(pieces_.begin() + piece);
  }

  bool shares_with(const SharedList& other) const {
    return size_ == other.size_ &&
           std::equal(pieces_.begin(), pieces_.end(), other.pieces_.begin(), other.pieces_.end(),
                      [](const Piece& one, const Piece& its) { return one.shared == its.shared; });
  }
  /// Calls each(const std::vector<…>&) for what this alone holds of both: its pieces, and where its items are found.
  template <class Each>
  void for_each_beyond(const SharedList& other, Each&& each) const {
    std::vector<const std::vector<T>*> theirs;
    for (const Piece& piece : other.pieces_) theirs.push_back(&piece.items());
    std::sort(theirs.begin(), theirs.end());
    for (const Piece& piece : pieces_)
      if (!std::binary_search(theirs.begin(), theirs.end(), &piece.items())) each(piece.items());
    homes_.for_each_beyond(other.homes_, each);
  }

 private:
  struct Piece {
    std::uint32_t home = 0;                  ///< its own number, whichever its place
    std::shared_ptr<std::vector<T>> shared;  ///< never empty
    const std::vector<T>& items() const { return *shared; }
  };
  static constexpr std::uint32_t nowhere = 0;

  static std::size_t index(std::int32_t number) { return number; }
  std::pair<std::size_t, std::size_t> find(std::size_t place) const {
    std::size_t piece = 0;
    for (; place >= pieces_[piece].items().size(); ++piece) place -= pieces_[piece].items().size();
    return {piece, place};
  }
  std::vector<T>& own(std::size_t number) {
    std::shared_ptr<std::vector<T>>& shared = pieces_[number].shared;
    if (shared.use_count() > 1) shared = std::make_shared<std::vector<T>>(*shared);
    return *shared;
  }
  void settle(const T& item, std::uint32_t home) {
    if (homes_.size() <= index(item.*key)) homes_.resize(index(item.*key) + 1);
    homes_.edit(index(item.*key)) = home;
  }
  void add_piece(std::size_t number, std::vector<T> items) {
    const std::uint32_t home = ++last_home_;
    for (const T& item : items) settle(item, home);
    pieces_.insert(pieces_.begin() + number, Piece{home, std::make_shared<std::vector<T>>(std::move(items))});
  }

  std::size_t size_ = 0;
  std::vector<Piece> pieces_;
  SharedChunks<std::uint32_t> homes_;  ///< by an item's number, the piece that it is in
  std::uint32_t last_home_ = nowhere;
};

}  // namespace zstep
