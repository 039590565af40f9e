// Tasks for the programs of the zoo, and their runs as traces.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "tests/zoo/programs.hpp"
#include "traces/diff/diff.hpp"
#include "traces/file/trace.hpp"

namespace zstep::test {

/// Triangles whose vertices lie on eighths of a pixel, so that which centres lie on an edge is exact in float32, too.
zoo::Task triangles(std::uint64_t seed, int count, int size);
/// Two triangles in one plane, one that shares a border with one of them, and one behind them.
zoo::Task ties();
/// Polygons that are concave, and whose edges cross.
zoo::Task concave();
/// What a program of the zoo in another language prints for each task, as "by_line.py" or "barycentric.js": all of them
/// in one start of its interpreter, which takes longer than a run.
std::vector<std::string> printed_by_file(const char* file, std::span<const zoo::Task> tasks);
std::string printed_by_file(const char* file, const zoo::Task& task);
bool there_is_python();
bool there_is_node();
/// What all the programs say of themselves: the first line of a run.
std::string head(const zoo::Task& task, const char* number_format, const char* interpolation);
/// A scene as the programs are given it.
zoo::Task task_of(const Scene& scene);
/// What `triangles` and their like are to zstep: a scene in screen coordinates.
Scene scene_of(const zoo::Task& task);
/// The first line of a run of any method: its own page, so that programs may use the names of its steps.
std::string head(const std::string& method, const Scene& scene, const Conventions& conventions);
/// A run as it was printed, header and all; up to a step that cannot be, where `impossible` is there to be told of it.
Trace trace_of(const std::string& text, std::string* impossible = nullptr);
/// The first line, from 1, in which two texts differ; 0 where they do not.
std::int64_t first_difference(const std::string& right, const std::string& wrong);
/// The first span, pixel or write from this step on: what a mistake with edges is seen by.
std::int64_t shown_at(const Trace& run, std::int64_t step);
/// Is this where the runs part: at the step or before it shows, or by the step that the right run has in its place?
bool is_at(const diff::Cause& cause, const Trace& reference, const diff::Alignment& alignment, const Trace& right,
           std::int64_t step, std::int64_t shows);

}  // namespace zstep::test
