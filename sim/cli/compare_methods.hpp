// What compare-methods and its table have in common.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "sim/cli/run_options.hpp"
#include "sim/cost/comparison.hpp"
#include "traces/image/png.hpp"
#include "sim/words/numbers.hpp"

namespace zstep::cli {

struct CompareOptions {
  RunOptions run;
  std::string methods, sweep, csv, plot;  ///< empty: not given
  std::vector<std::string> modes;
  double limit = 60;  ///< seconds a method
  bool steps = false, table = false, quick = false;
};

/// "a,b": a and b.
std::vector<std::string> parts_of(const std::string& text, char between);

/// The files asked for.
std::vector<std::string> compare_outputs(const CompareOptions& options);
/// Writes the CSV and the chart, as far as they were asked for, and prints a line for each.
void write_comparison(const CompareOptions& options, const std::string& csv, const std::function<Drawing()>& chart);

/// The methods' numbers as a chart. Throws InputError where the viewer, which draws it, was not built.
Drawing chart_of(const Scene& scene, const std::vector<compare::Compared>& methods, double limit);

/// --modes and --sweep: ways of interpolating.
int compare_modes(const CompareOptions& options);

/// --table: the lecture's table and today's numbers beside it.
int compare_table(const CompareOptions& options);

/// "16.4 KiB"; "?" where memory cannot be counted.
std::string bytes_text(std::int64_t bytes);

}  // namespace zstep::cli
