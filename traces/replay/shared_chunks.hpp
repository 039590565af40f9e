// A long vector in pieces, which copies share until one of them changes: a copy costs a pointer a piece, and then what
// differs. States are copied often, as check-points and key frames, and little of them changes in between.
#pragma once

#include <algorithm>
#include <bit>
#include <cstddef>
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

}  // namespace zstep
