// The index of a trace: what stands at the head of each block, once more and together (docs/trace-format.md).
#pragma once

#include "traces/file/chunk.hpp"

namespace zstep {

/// One block's entry: its chunk, where its frame begins, and its info.
inline void put_index_entry(Bytes& out, std::uint64_t offset, const EventsChunk& chunk,
                            std::span<const std::uint8_t> info) {
  put_varint(out, offset);
  put_varint(out, chunk.bytes.size());
  put_varint(out, chunk.frame_begins);
  out.insert(out.end(), info.begin(), info.end());
}

/// The index and the end of a file that is `offset` bytes long so far.
inline void put_index(Bytes& out, std::uint64_t offset, std::uint64_t blocks, std::span<const std::uint8_t> entries) {
  Bytes index;
  put_varint(index, blocks);
  index.insert(index.end(), entries.begin(), entries.end());
  put_chunk(out, index_tag, compress(index));
  const Bytes trailer = make_trailer(offset);
  out.insert(out.end(), trailer.begin(), trailer.end());
}

}  // namespace zstep
