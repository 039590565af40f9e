#include "sim/viewer/model/inquiry.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "sim/words/numbers.hpp"
#include "traces/error.hpp"

namespace zstep::viewer {

namespace {

constexpr std::size_t most_shown = 1000;
constexpr double patience = 5;  // seconds, as the window waits

std::string text_of(const query::Value& value) {
  if (const auto* whole = std::get_if<std::int64_t>(&value)) return std::to_string(*whole);
  if (const auto* real = std::get_if<double>(&value)) return number(*real);
  if (const auto* text = std::get_if<std::string>(&value)) return *text;
  return "";
}

std::optional<double> number_of(const query::Value& value) {
  if (const auto* whole = std::get_if<std::int64_t>(&value)) return static_cast<double>(*whole);
  if (const auto* real = std::get_if<double>(&value)) return *real;
  return std::nullopt;
}

std::optional<std::size_t> place_of(const std::vector<std::string>& names, const std::string& name) {
  const auto found = std::find(names.begin(), names.end(), name);
  return found == names.end() ? std::nullopt : std::optional(static_cast<std::size_t>(found - names.begin()));
}

// The columns of an answer that mean something to the viewer.
struct KnownColumns {
  std::optional<std::size_t> step, x, y;
  explicit KnownColumns(const std::vector<std::string>& names)
      : step(place_of(names, "step")), x(place_of(names, "x")), y(place_of(names, "y")) {}

  std::optional<Cell> pixel(std::span<const query::Value> row, const Raster& raster) const {
    if (!x || !y) return std::nullopt;
    const auto column = number_of(row[*x]), line = number_of(row[*y]);
    if (!column || !line || !(*column >= 0 && *column < raster.width && *line >= 0 && *line < raster.height))
      return std::nullopt;
    return Cell{static_cast<std::int32_t>(*column), static_cast<std::int32_t>(*line)};
  }
};

}  // namespace

void Inquiry::ask(const std::string& sql, const std::function<bool()>& stop) {
  sql_ = sql;
  wrong_ = false;
  columns_.clear(), rows_.clear(), steps_.clear(), pixels_.clear();
  heat_.reset();
  const Raster& raster = trace_.scene().raster;
  std::int64_t count = 0;
  bool late = false, stopped = false;
  std::optional<KnownColumns> places;
  std::optional<std::size_t> painted;  // the first column of numbers that is neither place nor step
  try {
    if (!database_) database_ = std::make_unique<query::Database>(trace_);
    query::Limits limits;
    if (stop) limits.stop = stop;
    else limits.seconds = patience;
    database_->run(
        sql, limits,
        [&](const std::vector<std::string>& names) {
          columns_ = names;
          places.emplace(names);
          if (!places->x || !places->y) return;
          heat_ = HeatMap{
              "rows", std::vector<double>(pixel_count(raster.width, raster.height), std::nan("")), 0, 0, "", false, -1};
        },
        [&](std::span<const query::Value> row) {
          ++count;
          const std::optional<Cell> pixel = places->pixel(row, raster);
          if (heat_ && count == 1) {
            for (std::size_t i = 0; i < row.size() && !painted; ++i)
              if (i != places->x && i != places->y && i != places->step && number_of(row[i])) painted = i;
            if (painted) heat_->name = columns_[*painted];
          }
          if (heat_ && pixel) {
            double& value = heat_->values[pixel_at(pixel->x, pixel->y, raster.width)];
            if (!painted) value = std::isnan(value) ? 1 : value + 1;
            else value = number_of(row[*painted]).value_or(std::nan(""));
          }
          if (rows_.size() >= most_shown) return true;
          std::vector<std::string> texts;
          for (const query::Value& value : row) texts.push_back(text_of(value));
          rows_.push_back(std::move(texts));
          const auto* step = places->step ? std::get_if<std::int64_t>(&row[*places->step]) : nullptr;
          steps_.push_back(step && *step >= 0 && *step <= trace_.size() ? std::optional(*step) : std::nullopt);
          pixels_.push_back(pixel);
          return true;
        });
  } catch (const InputError& error) {
    note_ = error.what();
    if (note_.starts_with("query: ")) note_.erase(0, 7);
    wrong_ = true;
    columns_.clear(), rows_.clear(), heat_.reset();
    return;
  } catch (const query::Stopped& why) {
    (why.by_time ? late : stopped) = true;
  }
  if (heat_) {
    double least = std::numeric_limits<double>::infinity(), most = -least;
    for (const double value : heat_->values)
      if (std::isfinite(value)) least = std::min(least, value), most = std::max(most, value);
    if (least <= most) heat_->least = least, heat_->most = most;
    else heat_.reset();
  }
  note_ = count == 1 ? "1 row" : fmt::format("{} rows", grouped(count));
  if (stopped) note_ = fmt::format("stopped; {} so far", note_);
  if (late) note_ = fmt::format("not done after {:g} seconds; {} so far", patience, note_);
  if (count > std::ssize(rows_)) note_ += fmt::format("; the first {} are shown", grouped(std::ssize(rows_)));
}

std::optional<std::int64_t> Inquiry::step_of(std::size_t row) const {
  return row < steps_.size() ? steps_[row] : std::nullopt;
}
std::optional<Cell> Inquiry::pixel_of(std::size_t row) const {
  return row < pixels_.size() ? pixels_[row] : std::nullopt;
}

}  // namespace zstep::viewer
