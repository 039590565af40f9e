// A block: up to 16 384 events, packed by column, readable without any other block.
//
// An event costs one token byte, its step id. When a field was not as foretold, the token's top bit is set, the column
// `*` holds which fields, and each such value goes to the column of its name. A scan line whose beginning, two edges
// and span are as foretold is one token. The pixels of a span, foretold whole, are runs: one token for up to 64 of
// them, their number, and a bit for the outcome of each compare.
#pragma once

#include <memory>

#include "traces/codec/block_info.hpp"
#include "traces/file/header.hpp"
#include "traces/record/event_log.hpp"

namespace zstep {

inline constexpr std::uint8_t missed_bit = 0x80;

class BlockEncoder {
 public:
  /// The scene must live as long as the encoder does. `first_position`: how many events come before the first block.
  BlockEncoder(const Scene& scene, const Header& header, std::int64_t first_position = 0);
  ~BlockEncoder();

  struct Packed {
    BlockInfo info;
    Bytes bytes;  ///< before compression
  };
  /// Packs what stands in a log that was closed, as the block that follows the one before. It lives until the next.
  const Packed& pack(const EventLog& log);

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace zstep
