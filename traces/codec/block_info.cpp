#include "traces/codec/block_info.hpp"

#include <algorithm>

namespace zstep {

Tiles::Tiles(const Raster& raster) : width_(raster.width), height_(raster.height) {
  while ((std::max(width_, height_) - 1) >> shift_ >= across) ++shift_;
}

void Tiles::put(Bytes& out) const {
  const int rows = height_ > 0 ? ((height_ - 1) >> shift_) + 1 : 0;
  for (int row = 0; row < rows; ++row) put_u32(out, rows_[static_cast<std::size_t>(row)]);
}

void Tiles::take(ByteReader& in) {
  const int rows = height_ > 0 ? ((height_ - 1) >> shift_) + 1 : 0;
  for (int row = 0; row < rows; ++row) rows_[static_cast<std::size_t>(row)] = in.u32();
}

namespace {

constexpr std::uint32_t keeps_to_marks_bit = 1u << 31;  ///< in the number of events
static_assert(block_events < keeps_to_marks_bit);

void put_box(Bytes& out, const Box& box) {
  put_varint(out, box.empty() ? 0u : box.right - box.left + 1u);
  if (box.empty()) return;
  put_varint(out, box.left);
  put_varint(out, box.top);
  put_varint(out, static_cast<unsigned>(box.bottom - box.top));
}

Box take_box(ByteReader& in, const Raster& raster) {
  const std::uint64_t width = in.varint();
  Box box;
  if (width == 0) return box;
  const std::uint64_t left = in.varint(), top = in.varint(), down = in.varint();
  const auto columns = static_cast<std::uint64_t>(raster.width), rows = static_cast<std::uint64_t>(raster.height);
  if (left >= columns || width > columns - left || top >= rows || down >= rows - top)
    throw MalformedBytes("a block that reaches beyond the raster");
  box.left = static_cast<std::uint16_t>(left), box.right = static_cast<std::uint16_t>(left + width - 1);
  box.top = static_cast<std::uint16_t>(top), box.bottom = static_cast<std::uint16_t>(top + down);
  return box;
}

}  // namespace

void put_block_info(Bytes& out, const BlockInfo& info) {
  put_u64(out, static_cast<std::uint64_t>(info.first_position));
  put_u32(out, info.count | (info.keeps_to_marks ? keeps_to_marks_bit : 0u));
  for (const std::uint64_t word : info.steps.words()) put_u64(out, word);
  info.tiles.put(out);
  put_box(out, info.lead);
  put_varint(out, info.marks.size());
  std::uint32_t last_offset = 0;
  std::int32_t last_polygon = 0;
  for (const BlockInfo::Mark& mark : info.marks) {
    put_varint(out, mark.offset - last_offset);
    put_varint(out, zigzag(static_cast<std::int32_t>(static_cast<std::uint32_t>(mark.polygon) -
                                                     static_cast<std::uint32_t>(last_polygon))));
    put_box(out, mark.box);
    last_offset = mark.offset;
    last_polygon = mark.polygon;
  }
}

BlockInfo take_block_info(ByteReader& in, const Raster& raster) {
  BlockInfo info;
  info.first_position = static_cast<std::int64_t>(in.u64());
  const std::uint32_t count = in.u32();
  info.count = count & ~keeps_to_marks_bit, info.keeps_to_marks = (count & keeps_to_marks_bit) != 0;
  if (info.count > block_events)
    throw MalformedBytes("a block of more than " + std::to_string(block_events) + " events");
  for (std::uint64_t& word : info.steps.words()) word = in.u64();
  info.tiles = Tiles(raster);
  info.tiles.take(in);
  info.lead = take_box(in, raster);
  const std::size_t marks = in.count(3);
  if (marks > info.count) throw MalformedBytes("more marks than events in a block");
  info.marks.reserve(marks);
  std::uint32_t offset = 0, polygon = 0;
  for (std::size_t i = 0; i < marks; ++i) {
    const std::uint64_t further = in.varint();
    if ((i > 0 && further == 0) || further >= info.count - offset) throw MalformedBytes("a mark outside its block");
    offset += static_cast<std::uint32_t>(further);
    polygon += static_cast<std::uint32_t>(unzigzag(static_cast<std::uint32_t>(in.varint())));
    info.marks.push_back({offset, static_cast<std::int32_t>(polygon), take_box(in, raster)});
  }
  return info;
}

}  // namespace zstep
