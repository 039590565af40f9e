// A long vector in pieces, which copies share until one of them changes: a copy costs a pointer a piece, and what differs.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <memory>
#include <vector>

namespace zstep {

template <class T>
class SharedChunks {
 public:
  static constexpr std::size_t chunk_size = 512;
  using Chunk = std::array<T, chunk_size>;

  std::size_t size() const { return size_; }
  bool empty() const { return size_ == 0; }
  const T& operator[](std::size_t i) const {
    static const T untouched{};
    const std::shared_ptr<Chunk>& chunk = chunks_[i / chunk_size];
    return chunk ? (*chunk)[i % chunk_size] : untouched;
  }

  /// An item, to be changed: its chunk is this copy's own from now on.
  T& edit(std::size_t i) {
    std::shared_ptr<Chunk>& chunk = chunks_[i / chunk_size];
    if (!chunk) chunk = std::make_shared<Chunk>();
    else if (chunk.use_count() > 1) chunk = std::make_shared<Chunk>(*chunk);
    return (*chunk)[i % chunk_size];
  }
  /// New items are T{}, and take no memory while whole chunks of them are.
  void resize(std::size_t size) {
    const std::size_t filled = (size_ + chunk_size - 1) / chunk_size * chunk_size;
    chunks_.resize((size + chunk_size - 1) / chunk_size);
    const std::size_t last = std::min(size, filled);
    if (size_ < last && chunks_[size_ / chunk_size]) std::fill_n(&edit(size_), last - size_, T{});
    size_ = size;
  }
  void push_back(const T& item) {
    resize(size_ + 1);
    edit(size_ - 1) = item;
  }
  void pop_back() { resize(size_ - 1); }

  bool shares_with(const SharedChunks& other) const { return size_ == other.size_ && chunks_ == other.chunks_; }
  /// What this alone holds of both, in bytes.
  std::size_t bytes_beyond(const SharedChunks& other) const {
    std::size_t bytes = 0;
    for (std::size_t i = 0; i < chunks_.size(); ++i)
      if (chunks_[i] && !(i < other.chunks_.size() && other.chunks_[i] == chunks_[i])) bytes += sizeof(Chunk);
    return bytes;
  }
  /// Shares the chunks whose items are the same as the other's: `same(const T&, const T&)`.
  template <class Same>
  void share(const SharedChunks& other, Same&& same) {
    for (std::size_t i = 0; i < std::min(chunks_.size(), other.chunks_.size()); ++i) {
      if (chunks_[i] == other.chunks_[i] || !chunks_[i] || !other.chunks_[i]) continue;
      if (std::equal(chunks_[i]->begin(), chunks_[i]->end(), other.chunks_[i]->begin(), same)) chunks_[i] = other.chunks_[i];
    }
  }

 private:
  std::size_t size_ = 0;
  std::vector<std::shared_ptr<Chunk>> chunks_;  ///< null: all of it T{}
};

}  // namespace zstep
