// Questions to the trace in SQL, as the viewer's box keeps them: the answer's rows, where each leads, and what can be
// painted of it.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "sim/query/database.hpp"
#include "sim/viewer/model/session.hpp"

namespace zstep::viewer {

/// A number for each pixel that an answer names; NaN for the others.
struct HeatMap {
  std::string name;            ///< of the column, "count(*)"; "rows" where the answer has no number besides x and y
  std::vector<double> values;  ///< [height*width]
  double least = 0, most = 0;
  std::string meaning;      ///< of a number, "colours written"; may be empty
  bool polygons = false;    ///< the numbers are polygons, shown in their colours
  std::int64_t until = -1;  ///< counted up to this step; -1: the whole run
  double share(double value) const { return most > least ? (value - least) / (most - least) : 1; }
};

class Inquiry {
 public:
  /// The trace must outlive it.
  explicit Inquiry(const Trace& trace) : trace_(trace) {}

  /// Asks; what comes of it stands in columns(), rows() and note(). `stop` is asked now and then, and true ends the
  /// question; without it, it ends after some seconds.
  void ask(const std::string& sql, const std::function<bool()>& stop = nullptr);

  const std::string& sql() const { return sql_; }  ///< that was asked last
  const std::vector<std::string>& columns() const { return columns_; }
  const std::vector<std::vector<std::string>>& rows() const { return rows_; }  ///< the first of them
  const std::string& note() const { return note_; }                            ///< how many there are, or what is wrong
  bool is_wrong() const { return wrong_; }

  /// Where a row leads: its `step`, and the pixel of its `x` and `y`.
  std::optional<std::int64_t> step_of(std::size_t row) const;
  std::optional<Cell> pixel_of(std::size_t row) const;
  /// All rows as a picture, where the answer has columns x and y.
  const std::optional<HeatMap>& heat() const { return heat_; }

 private:
  const Trace& trace_;
  std::unique_ptr<query::Database> database_;  // made when first asked
  std::string sql_, note_;
  std::vector<std::string> columns_;
  std::vector<std::vector<std::string>> rows_;
  std::vector<std::optional<std::int64_t>> steps_;
  std::vector<std::optional<Cell>> pixels_;
  std::optional<HeatMap> heat_;
  bool wrong_ = false;
};

}  // namespace zstep::viewer
