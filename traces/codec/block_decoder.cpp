#include "traces/codec/block_decoder.hpp"

#include <limits>

#include "traces/codec/foretell.hpp"

namespace zstep {

using namespace codec;

namespace {

template <class Value, class Raw>
Value checked(Raw value) {
  if constexpr (std::is_same_v<Value, bool>) {
    if (value != 0 && value != 1) throw MalformedBytes("a truth value that is neither 0 nor 1");
    return value != 0;
  } else if constexpr (std::is_enum_v<Value>) {
    if (value < 0 || static_cast<std::size_t>(value) >= words_of<Value>.size()) throw MalformedBytes("an unknown word");
    return static_cast<Value>(value);
  } else {
    return value;
  }
}

}  // namespace

StepMeanings::StepMeanings(const Page& page) : row(page) {
  kind.fill(unknown_kind);
  for (const StepInfo& step : page) kind[step.id] = step.kind;
}

BlockDecoder::BlockDecoder(std::span<const std::uint8_t> packed, std::uint32_t count, const StepMeanings& meanings,
                           const SceneGeometry& facts)
    : foreteller_(facts), meanings_(meanings), row_(meanings.row), left_(count) {
  ByteReader in(packed);
  if (in.varint() != count) throw MalformedBytes("a block with another number of events than it says");
  tokens_ = in.take(in.count());
  for (std::size_t next = 0; !in.empty();) {
    const std::string name = in.text();
    std::size_t looked = 0;  // they mostly stand in this order
    while (looked < column_count && column_name((next + looked) % column_count) != name) ++looked;
    if (looked == column_count) throw MalformedBytes("a column \"" + name + "\" that no event has");
    next = (next + looked) % column_count;
    columns_[next] = ByteReader(in.take(in.count()));
  }
}

const Row& BlockDecoder::take_row(std::uint8_t token) {
  if ((token & missed_bit) != 0 || !row_.steps.known() || !foreteller_.guess_row(row_))
    throw MalformedBytes("a scan line that cannot be");
  count_down(Row::events());
  foreteller_.learn_row(row_);
  return row_;
}

std::uint32_t BlockDecoder::take_count(std::uint8_t token) {
  const std::uint32_t count = columns_[counts_column].u8();
  const std::int64_t last = std::int64_t{foreteller_.whole(slot_of("x"))} + count;
  if ((token & missed_bit) != 0 || count == 0 || count > run_limit || !foreteller_.in_span() ||
      last > std::numeric_limits<std::int32_t>::max())
    throw MalformedBytes("a run of pixels that cannot be");
  foreteller_.set_whole(slot_of("x"), static_cast<std::int32_t>(last));
  return count;
}

FragmentRun BlockDecoder::take_fragments(std::uint8_t token) {
  FragmentRun run;
  run.count = take_count(token);
  run.x = foreteller_.whole(slot_of("x")) - static_cast<std::int32_t>(run.count) + 1;
  run.y = foreteller_.whole(slot_of("y"));
  run.nearer = columns_[nearer_column].low_bytes((run.count + 7) / 8);
  if (run.count < run_limit && run.nearer >> run.count != 0)
    throw MalformedBytes("an outcome of a compare that was not made");
  run.polygon = foreteller_.whole(slot_of("polygon"));
  run.steps = steps_.fragment;
  for (std::size_t i = 0; i < (run.nearer != 0 ? 4u : 2u); ++i)
    if (run.steps[i] == unknown_step) throw MalformedBytes("a run of pixels before the first pixel");
  count_down(run.events());
  run.span = &foreteller_.span();
  run.increments = foreteller_.increments();
  run.before = foreteller_.real(slot_of("z"));
  foreteller_.set_real(slot_of("z"), run.depth(run.count - 1));
  foreteller_.set_whole(slot_of("nearer"), run.is_nearer(run.count - 1) ? 1 : 0);
  return run;
}

PaintRun BlockDecoder::take_paints(std::uint8_t token) {
  PaintRun run;
  run.count = take_count(token);
  run.x = foreteller_.whole(slot_of("x")) - static_cast<std::int32_t>(run.count) + 1;
  run.y = foreteller_.whole(slot_of("y"));
  run.polygon = foreteller_.whole(slot_of("polygon"));
  run.step = steps_.paint;
  if (run.step == unknown_step) throw MalformedBytes("a run of pixels before the first pixel");
  count_down(run.events());
  run.span = &foreteller_.span();
  run.increments = foreteller_.increments();
  run.before = foreteller_.real(slot_of("z"));
  double z = run.before;
  run.for_each([&](std::uint32_t, std::int32_t, double depth) {
    z = depth;
    return true;
  });
  foreteller_.set_real(slot_of("z"), z);
  return run;
}

template <class E>
E BlockDecoder::take_one(std::uint8_t step, bool missed) {
  const auto mask = missed ? static_cast<std::uint32_t>(columns_[misses_column].varint()) : 0u;
  if (mask >> field_count<E> != 0) throw MalformedBytes("a miss of a field that the event does not have");
  E event;
  for_each_index<E>([&]<std::size_t I>() {
    using Value = FieldValue<E, I>;
    auto value = foreteller_.guess<E, I>(event);
    if ((mask >> I & 1u) != 0) {
      ByteReader& column = columns_[slot_at<E, I>];
      if constexpr (std::is_same_v<Value, double>) {
        value = double_of(undo_difference(take_counted(column), bits_of(value)));
      } else {
        const auto residual = static_cast<std::uint32_t>(unzigzag(static_cast<std::uint32_t>(column.varint())));
        value = static_cast<std::int32_t>(static_cast<std::uint32_t>(value) + residual);
      }
    }
    event.*field_at<E, I>.member = checked<Value>(value);
  });
  foreteller_.learn(event);
  steps_.learn<E>(step);
  return event;
}

#define ZSTEP_INSTANTIATE(E) template E BlockDecoder::take_one<E>(std::uint8_t, bool);
ZSTEP_EVERY_KIND(ZSTEP_INSTANTIATE)
#undef ZSTEP_INSTANTIATE

}  // namespace zstep
