#include "traces/codec/block_encoder.hpp"

#include <utility>

#include "traces/codec/columns.hpp"
#include "traces/codec/foreteller.hpp"
#include "traces/codec/runs.hpp"

namespace zstep {

using namespace codec;

struct BlockEncoder::State {
  State(const Scene& scene, const Conventions& conventions) : facts(scene, conventions), foreteller(facts) {}

  /// One event by its token, and its fields as far as they were not foretold.
  template <class E>
  void write(std::uint8_t step, const E& event);
  void write(bool painted, const LoggedRun& run);

  Facts facts;
  Foreteller foreteller;
  std::int64_t first_position = 0;
  RunSteps steps;
  BlockInfo info;
  Bytes tokens;
  std::array<Bytes, column_count> columns;
};

BlockEncoder::BlockEncoder(const Scene& scene, const Conventions& conventions) : state_(std::make_unique<State>(scene, conventions)) {}
BlockEncoder::~BlockEncoder() = default;

template <class E>
void BlockEncoder::State::write(std::uint8_t step, const E& event) {
  std::uint32_t missed = 0;
  std::array<std::uint64_t, field_count<E>> residual;  // written before it is read, where `missed` says so
  E told;
  for_each_index<E>([&]<std::size_t I>() {
    constexpr auto member = field_at<E, I>.member;
    const auto guess = foreteller.guess<E, I>(told);
    if constexpr (std::is_same_v<FieldValue<E, I>, double>) residual[I] = difference(bits_of(event.*member), bits_of(guess));
    else residual[I] = static_cast<std::uint32_t>(static_cast<std::int32_t>(event.*member)) - static_cast<std::uint32_t>(guess);
    told.*member = event.*member;
    missed |= static_cast<std::uint32_t>(residual[I] != 0) << I;
  });
  tokens.push_back(missed != 0 ? static_cast<std::uint8_t>(step | missed_bit) : step);
  if (missed != 0) {
    put_varint(columns[misses_column], missed);
    for_each_index<E>([&]<std::size_t I>() {
      if ((missed >> I & 1u) == 0) return;
      Bytes& column = columns[slot_at<E, I>];
      if constexpr (std::is_same_v<FieldValue<E, I>, double>) put_counted(column, residual[I]);
      else put_varint(column, zigzag(static_cast<std::int32_t>(static_cast<std::uint32_t>(residual[I]))));
    });
  }
  foreteller.learn(event);
  steps.learn<E>(step);
  info.steps.add(step);
  if constexpr (requires {
                  event.x;
                  event.y;
                }) {
    info.tiles.touch(event.x, event.y);
  } else if constexpr (std::is_same_v<E, PolygonBegin> || std::is_same_v<E, PieceDraw>) {
    info.marks.push_back({info.count, event.polygon});
  }
  ++info.count;
}

void BlockEncoder::State::write(bool painted, const LoggedRun& run) {
  tokens.push_back(painted ? paints_token : fragments_token);
  put_u8(columns[counts_column], static_cast<std::uint8_t>(run.count));
  const std::int32_t end = run.x + static_cast<std::int32_t>(run.count);
  foreteller.set_whole(slot_of("x"), end - 1);
  foreteller.set_real(slot_of("z"), run.z);
  info.tiles.touch(run.x, end, foreteller.whole(slot_of("y")));
  if (painted) {
    info.steps.add(steps.paint);
    info.count += run.count;
    return;
  }
  put_low_bytes(columns[nearer_column], run.nearer, (run.count + 7) / 8);
  foreteller.set_whole(slot_of("nearer"), static_cast<std::int32_t>(run.nearer >> (run.count - 1) & 1u));
  for (std::size_t i = 0; i < (run.nearer != 0 ? 4u : 2u); ++i) info.steps.add(steps.fragment[i]);
  info.count += 2 * (run.count + static_cast<std::uint32_t>(std::popcount(run.nearer)));
}

BlockEncoder::Packed BlockEncoder::pack(const EventLog& log) {
  State& block = *state_;
  block.info = BlockInfo{};
  block.info.first_position = block.first_position;
  block.info.tiles = Tiles(block.facts.scene().raster);
  block.foreteller.forget();
  block.steps = RunSteps{};
  block.tokens.clear();
  for (Bytes& column : block.columns) column.clear();

  log.for_each([&](bool painted, const LoggedRun& run) { block.write(painted, run); },
               [&](std::uint8_t step, const auto& event) { block.write(step, event); });
  block.first_position += block.info.count;

  Packed packed;
  packed.bytes.reserve(block.tokens.size() + 4096);
  put_varint(packed.bytes, block.info.count);
  put_varint(packed.bytes, block.tokens.size());
  packed.bytes.insert(packed.bytes.end(), block.tokens.begin(), block.tokens.end());
  for (std::size_t column = 0; column < column_count; ++column) {
    const Bytes& bytes = block.columns[column];
    if (bytes.empty()) continue;
    // Columns go by name, so that a vocabulary with other fields in another order still finds its own.
    put_text(packed.bytes, std::string(column_name(column)));
    put_varint(packed.bytes, bytes.size());
    packed.bytes.insert(packed.bytes.end(), bytes.begin(), bytes.end());
  }
  packed.info = std::move(block.info);
  return packed;
}

}  // namespace zstep
