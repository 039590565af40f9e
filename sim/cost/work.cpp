#include "sim/cost/work.hpp"

#include <algorithm>
#include <numeric>

#include "traces/formulas/follows.hpp"

namespace zstep::compare {
namespace {

struct WorkRow {
  Work work;
  std::string_view word, kinds;
};
constexpr std::array<WorkRow, work_count> work_rows{{
    {Work::vertices, "vertices transformed", "view_transform projection viewport_transform"},
    {Work::planes, "planes, boxes, rays", "plane_slopes plane_equation extent box_make grid_make ray_begin"},
    {Work::tests, "tests",
     "facing_test clip_test clip_vertex vertex_side side_test extent_test overlap_test root_candidate eye_side "
     "area_bin "
     "area_decide box_test cell_visit ray_plane ray_hit span_winner horizon_test line_against"},
    {Work::cuts, "cuts", "clip_cross split_vertex implied_edge line_cross line_hide horizon_cross"},
    {Work::edges, "edges and spans", "edge_table_insert edge_step span_begin span_flags"},
    {Work::depths, "interpolations", "depth_interpolate attribute_interpolate plane_depth"},
    {Work::compares, "depth compares", "depth_compare shadow_compare"},
    {Work::writes, "writes",
     "depth_write pixel_write pixel_paint color_write color_blend coverage_add horizon_move line_piece"},
    {Work::bookkeeping, "bookkeeping",
     "buffers_clear polygon_begin polygon_reject outline_vertex edge_table_skip scan_line_begin edge_enter edge_retire "
     "edge_swap pass_begin tables_begin piece_make piece_draw saved list_insert list_remove list_mark pair_begin "
     "node_make node_add node_skip flag_flip area_begin box_hold cell_hold ray_end curve_begin curve_segment "
     "line_begin"},
}};

constexpr std::array<Work, kind_count> all_kinds() {
  std::array<Work, kind_count> works{};
  std::size_t named = 0;
  for_each_kind([&]<class E>() {
    for (const WorkRow& row : work_rows)
      formulas::for_each_word(row.kinds, [&](std::string_view kind) {
        if (kind == kind_text<E>.name) works[kind_of<E>] = row.work, ++named;
      });
  });
  if (named != kind_count) throw "each kind of event has its place in the table above, once";
  return works;
}
constexpr std::array<Work, kind_count> works_of_kinds = all_kinds();

constexpr std::int64_t between_sums = 4096;

}  // namespace

std::string_view word_of(Work work) { return work_rows[static_cast<std::size_t>(work)].word; }
Work work_of(std::uint8_t kind) { return works_of_kinds[kind]; }

std::int64_t operations(const WorkCounts& counts) {
  return std::accumulate(counts.begin(), counts.end(), std::int64_t{0}) -
         counts[static_cast<std::size_t>(Work::bookkeeping)];
}

WorkCounts work_in(const Page& page, const std::array<std::int64_t, step_limit>& count) {
  WorkCounts counts{};
  for (const StepInfo& step : page) counts[static_cast<std::size_t>(work_of(step.kind))] += count[step.id];
  return counts;
}

WorkDone::WorkDone(const Trace& trace) {
  kinds_.reserve(static_cast<std::size_t>(trace.size()));
  WorkCounts now{};
  trace.each(0, trace.size(), [&](std::int64_t, const RecordedEvent& recorded) {
    if (kinds_.size() % between_sums == 0) sums_.push_back(now);
    kinds_.push_back(work_of(static_cast<std::uint8_t>(recorded.event.index())));
    ++now[static_cast<std::size_t>(kinds_.back())];
    return true;
  });
  sums_.push_back(now);
}

WorkCounts WorkDone::at(std::int64_t position) const {
  position = std::clamp<std::int64_t>(position, 0, static_cast<std::int64_t>(kinds_.size()));
  const std::int64_t from = position / between_sums * between_sums;
  WorkCounts counts = sums_[static_cast<std::size_t>(position / between_sums)];
  for (std::int64_t k = from; k < position; ++k)
    ++counts[static_cast<std::size_t>(kinds_[static_cast<std::size_t>(k)])];
  return counts;
}

std::int64_t WorkDone::position_of(std::int64_t wanted) const {
  if (wanted <= 0) return 0;
  const auto size = static_cast<std::int64_t>(kinds_.size());
  const auto after =
      std::partition_point(sums_.begin(), sums_.end(), [&](const WorkCounts& sum) { return operations(sum) < wanted; });
  std::int64_t position = std::clamp<std::int64_t>((after - sums_.begin() - 1) * between_sums, 0, size);
  std::int64_t done = operations(at(position));
  for (; position < size && done < wanted; ++position)
    done += kinds_[static_cast<std::size_t>(position)] != Work::bookkeeping;
  return position;
}

}  // namespace zstep::compare
