#include "traces/file/block.hpp"

namespace zstep {

Bytes BlockEncoder::take() {
  Bytes packed;
  packed.reserve(info_.count + 4096);
  put_varint(packed, info_.count);
  packed.insert(packed.end(), tokens_.begin(), tokens_.begin() + info_.count);
  for (std::size_t column = 0; column < column_count; ++column) {
    if (columns_[column].empty()) continue;
    // Columns go by name, so that a vocabulary with other fields in another order still finds its own.
    put_text(packed, column == misses_column ? std::string("*") : std::string(slot_name(column)));
    put_varint(packed, columns_[column].size());
    packed.insert(packed.end(), columns_[column].begin(), columns_[column].end());
    columns_[column].clear();
  }
  const std::int64_t next = info_.first_position + info_.count;
  info_ = BlockInfo{};
  info_.first_position = next;
  registers_ = Registers(increments_);
  return packed;
}

StepKinds kinds_of(const Page& page) {
  StepKinds kinds;
  kinds.fill(unknown_kind);
  for (const StepInfo& step : page) kinds[step.id] = step.kind;
  return kinds;
}

BlockDecoder::BlockDecoder(std::span<const std::uint8_t> packed, std::uint32_t count, const StepKinds& kinds,
                           bool increments)
    : registers_(increments), kinds_(kinds) {
  ByteReader in(packed);
  if (in.varint() != count) throw MalformedBytes("a block with another number of events than it says");
  tokens_ = in.take(count);
  while (!in.empty()) {
    const std::string name = in.text();
    std::size_t column = misses_column;
    if (name != "*") {
      column = 0;
      while (column < slot_count && slot_name(column) != name) ++column;
      if (column == slot_count) throw MalformedBytes("a column \"" + name + "\" that no event has");
    }
    columns_[column] = ByteReader(in.take(in.count()));
  }
}

void put_block_info(Bytes& out, const BlockInfo& info) {
  put_u64(out, static_cast<std::uint64_t>(info.first_position));
  put_u32(out, info.count);
  for (const std::int32_t bound : {info.x_min, info.x_max, info.y_min, info.y_max})
    put_u32(out, static_cast<std::uint32_t>(bound));
  put_varint(out, info.marks.size());
  std::uint32_t last_offset = 0;
  std::int32_t last_polygon = 0;
  for (const BlockInfo::Mark& mark : info.marks) {
    put_varint(out, mark.offset - last_offset);
    put_varint(out, zigzag(static_cast<std::int32_t>(static_cast<std::uint32_t>(mark.polygon) -
                                                     static_cast<std::uint32_t>(last_polygon))));
    last_offset = mark.offset;
    last_polygon = mark.polygon;
  }
}

BlockInfo take_block_info(ByteReader& in) {
  BlockInfo info;
  info.first_position = static_cast<std::int64_t>(in.u64());
  info.count = in.u32();
  if (info.count > block_events) throw MalformedBytes("a block of more than 65 536 events");
  for (std::int32_t* bound : {&info.x_min, &info.x_max, &info.y_min, &info.y_max})
    *bound = static_cast<std::int32_t>(in.u32());
  const std::size_t marks = in.count(2);
  if (marks > info.count) throw MalformedBytes("more marks than events in a block");
  std::uint32_t offset = 0, polygon = 0;
  for (std::size_t i = 0; i < marks; ++i) {
    const std::uint64_t further = in.varint();
    if ((i > 0 && further == 0) || further >= info.count - offset) throw MalformedBytes("a mark outside its block");
    offset += static_cast<std::uint32_t>(further);
    polygon += static_cast<std::uint32_t>(unzigzag(static_cast<std::uint32_t>(in.varint())));
    info.marks.push_back({offset, static_cast<std::int32_t>(polygon)});
  }
  return info;
}

}  // namespace zstep
