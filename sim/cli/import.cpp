// zstep import: JSON Lines, as programs write them, into a trace; and a program's log, of which each line is a step,
// into a run.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <iostream>
#include <memory>
#include <optional>
#include <sstream>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "sim/cli/commands.hpp"
#include "sim/cli/long_work.hpp"
#include "sim/cli/outputs.hpp"
#include "sim/cli/run_options.hpp"
#include "sim/cli/words.hpp"
#include "traces/image/file.hpp"
#include "traces/error.hpp"
#include "traces/events/fields.hpp"
#include "traces/file/check_events.hpp"
#include "traces/file/jsonl.hpp"
#include "traces/file/trace.hpp"
#include "traces/file/written.hpp"
#include "traces/math/portable_math.hpp"
#include "traces/record/trace_recorder.hpp"
#include "traces/text.hpp"

namespace zstep::cli {
namespace {

struct ImportOptions {
  std::string from, to;
  std::string step, columns;  ///< of a log
  RunOptions run;
};

int import_trace(const ImportOptions& options) {
  const bool standard_input = options.from == "-" || options.from == "/dev/stdin";
  check_outputs({}, {standard_input ? "/dev/stdin" : options.from}, {options.to});
  InputFile from = standard_input ? InputFile::standard_input() : InputFile(options.from);
  if (const auto cut = import_jsonl(std::move(from), options.to)) complain_incomplete(*cut);
  say_written(options.to, counted(Trace::open(options.to).size(), "step", "steps"));
  return exit_code::done;
}

constexpr std::string_view column_of_polygon = "polygon", column_left_out = "_";

/// A log's columns, by the fields of the step that each line is.
class Columns {
 public:
  /// Throws InputError at `where` where they are not those of the step.
  Columns(const StepInfo& step, const std::vector<std::string>& names, const std::string& where) : names_(names) {
    std::vector<std::string> fields{std::string(column_of_polygon)};
    for (const FieldOfKind& field : fields_of_kind(step.kind)) fields.emplace_back(field.name);
    for (std::size_t at = 0; at < names.size(); ++at) {
      if (names[at] == column_left_out) continue;
      if (std::find(fields.begin(), fields.end(), names[at]) == fields.end())
        throw InputError(
            where, fmt::format("{} has no field '{}'", step.name, names[at]),
            did_you_mean(names[at], fields,
                         fmt::format("it has {}; a column that is none of these is _", enumerate(fields, "and"))));
      if (std::count(names.begin(), names.end(), names[at]) > 1)
        throw InputError(where, fmt::format("names '{}' twice", names[at]), "keep one of them; call the other _");
    }
    for (const FieldOfKind& field : fields_of_kind(step.kind))
      if (!has(field.name) && !(step.kind == kind_of<DepthCompare> && field.name == "nearer"))
        throw InputError(where, fmt::format("lacks '{}', {}", field.name, field.meaning),
                         fmt::format("print it, too, and name its column; {} has {}", step.name,
                                     enumerate({fields.data() + 1, fields.size() - 1}, "and")));
  }
  bool has(std::string_view name) const { return std::find(names_.begin(), names_.end(), name) != names_.end(); }
  const std::vector<std::string>& names() const { return names_; }

 private:
  std::vector<std::string> names_;
};

std::string_view trimmed(std::string_view text) {
  while (!text.empty() && (text.front() == ' ' || text.front() == '\t')) text.remove_prefix(1);
  while (!text.empty() && (text.back() == ' ' || text.back() == '\t' || text.back() == '\r')) text.remove_suffix(1);
  return text;
}

/// What stands between semicolons, else commas, else spaces.
std::vector<std::string_view> cells_of(std::string_view line) {
  std::vector<std::string_view> cells;
  line = trimmed(line);
  const char between = line.find(';') != line.npos ? ';' : line.find(',') != line.npos ? ',' : ' ';
  for (std::size_t at = 0; at <= line.size();) {
    const std::size_t end =
        std::min(between == ' ' ? line.find_first_of(" \t", at) : line.find(between, at), line.size());
    cells.push_back(trimmed(line.substr(at, end - at)));
    at = between == ' ' ? std::min(line.find_first_not_of(" \t", end), line.size() + 1) : end + 1;
  }
  return cells;
}

std::optional<double> number_in(std::string_view cell) {
  double value = 0;
  if (!cell.empty() && cell.front() == '+') cell.remove_prefix(1);
  if (!cell.empty() && read_number(cell, value) == cell.size()) return value;
  // As C prints them: inf and nan.
  const std::string word(cell);
  if (word.empty() || word.find_first_of("0123456789") != word.npos) return std::nullopt;
  char* end = nullptr;
  value = std::strtod(word.c_str(), &end);
  return *end == '\0' ? std::optional(value) : std::nullopt;
}

/// A cell as its field has it; throws InputError without a place.
double value_of(const FieldOfKind& field, std::string_view cell) {
  using Type = FieldOfKind::Type;
  const auto fault = [&](const std::string& what, const std::string& mend) {
    return InputError(std::string(field.name), fmt::format("'{}' {}", cell, what), mend);
  };
  const std::optional<double> number = number_in(cell);
  switch (field.type) {
    case Type::real:
      if (!number) throw fault("is no number", "write it with a point, as 0.25, or as inf");
      return *number;
    case Type::whole:
      if (!number || *number != std::floor(*number) || std::abs(*number) > 2147483647)
        throw fault("is no whole number", "count from 0, and print it with %d");
      return *number;
    case Type::truth:
      if (cell == "1" || cell == "true") return 1;
      if (cell == "0" || cell == "false") return 0;
      throw fault("is neither true nor false", "write true and false, or 1 and 0");
    case Type::word:
      break;
  }
  const auto word = std::find(field.words.begin(), field.words.end(), cell);
  if (word == field.words.end())
    throw fault("is none of its words",
                fmt::format("write {}", enumerate(std::vector<std::string>(field.words.begin(), field.words.end()))));
  return static_cast<double>(word - field.words.begin());
}

/// A log becomes a run: a step a line, and a step that begins a polygon wherever the column of polygons changes.
class LogReader {
 public:
  LogReader(const ImportOptions& options, const Run& run, std::string name)
      : name_(std::move(name)), scene_(run.scene), header_(header_of(run, name_)), recorder_(header_, scene_) {
    std::vector<std::string> known;
    for (const StepInfo& step : header_.page) known.push_back(step.name);
    step_ = find_step(header_.page, options.step);
    if (step_ == nullptr)
      throw InputError("--as", fmt::format("{} has no step '{}'", header_.title, options.step),
                       did_you_mean(options.step, known, "it has " + enumerate(known, "and")));
    for (const StepInfo& step : header_.page)
      if (step.kind == kind_of<PolygonBegin>) begin_ = &step;
    if (!options.columns.empty()) {
      std::vector<std::string> names;
      for (const std::string_view cell : cells_of(options.columns)) names.emplace_back(cell);
      columns_.emplace(*step_, names, "--columns");
    }
    for (std::int32_t facet = 0; facet < std::ssize(scene_.facets); ++facet) {
      const std::int32_t polygon = scene_.facets[static_cast<std::size_t>(facet)].polygon;
      first_facet_.resize(std::max<std::size_t>(first_facet_.size(), static_cast<std::size_t>(polygon) + 1), -1);
      std::int32_t& first = first_facet_[static_cast<std::size_t>(polygon)];
      if (first < 0) first = facet;
    }
    depths_.assign(static_cast<std::size_t>(scene_.raster.width) * static_cast<std::size_t>(scene_.raster.height),
                   header_.empty_depth());
  }

  Trace read(std::istream& in) {
    std::vector<char> line(longest_line + 1);
    while (in.peek() != std::istream::traits_type::eof()) {
      in.getline(line.data(), static_cast<std::streamsize>(line.size()));
      ++number_;
      if (in.fail())
        throw InputError(place(), fmt::format("is longer than {} characters", longest_line), "write one step a line");
      take(line.data());
      if (faults_.size() >= most_faults) break;
    }
    if (faults_.empty() && recorder_.size() == 0)
      throw InputError(name_, "has no line with a step", "print one line a step, as: 12 7 0.25 3");
    if (faults_.size() >= most_faults) faults_.push_back(name_ + ": there may be more mistakes; mend these first");
    if (!faults_.empty()) throw InputErrors(faults_);
    recorder_.finish();
    return Trace::from_bytes(recorder_.take_bytes(), name_);
  }
  bool computes_nearer() const { return step_->kind == kind_of<DepthCompare> && columns_ && !columns_->has("nearer"); }

 private:
  static constexpr std::size_t longest_line = 4096, most_faults = 10;

  static Header header_of(const Run& run, const std::string& name) {
    Header header = cli::header_of(run);
    header.writer = name;
    return header;
  }
  std::string place() const { return fmt::format("{}:{}", name_, number_); }

  void take(std::string_view line) {
    line = trimmed(line);
    if (line.empty() || line.front() == '#') return;
    const std::vector<std::string_view> cells = cells_of(line);
    const bool first = std::exchange(first_, false);
    const bool names = first && std::none_of(cells.begin(), cells.end(), [](std::string_view cell) {
                         return number_in(cell) || cell.find('=') != cell.npos;
                       });
    if (names && columns_) return;
    if (names || !columns_) {
      if (!names)
        throw InputError(place(), "does not name the columns",
                         "name them with --columns, as --columns x,y,z,polygon, or in the log's first line");
      columns_.emplace(*step_, std::vector<std::string>(cells.begin(), cells.end()), place());
      return;
    }
    try {
      record(cells);
    } catch (const InputError& error) {
      faults_.push_back(fmt::format("{}: {}", place(), error.what()));
    }
  }

  void record(const std::vector<std::string_view>& cells) {
    const std::vector<std::string>& names = columns_->names();
    if (cells.size() != names.size())
      throw InputError("the line",
                       fmt::format("has {}, not {}", counted(std::ssize(cells), "column", "columns"), names.size()),
                       "print the same columns in each line, or leave this one out of the log");
    Event event = event_of_kind(step_->kind);
    std::optional<std::int32_t> polygon;
    for (std::size_t at = 0; at < cells.size(); ++at) {
      if (names[at] == column_left_out) continue;
      std::string_view cell = cells[at];  // or "x=12"
      if (cell.starts_with(names[at]) && cell.substr(names[at].size()).starts_with('='))
        cell.remove_prefix(names[at].size() + 1);
      const FieldOfKind* field = field_of_kind(step_->kind, names[at]);
      if (field != nullptr) field->write(event, value_of(*field, cell));
      if (names[at] == column_of_polygon)
        polygon = static_cast<std::int32_t>(value_of(*field_of_kind(kind_of<PolygonBegin>, column_of_polygon), cell));
    }
    if (polygon && polygon != at_work_) begin(*polygon);
    turn(event, header_, scene_.camera, scene_.raster, Turned::as_own);
    check(event);
    if (auto* compare = get_if<DepthCompare>(&event)) {
      double& stored = depths_[static_cast<std::size_t>(compare->y) * static_cast<std::size_t>(scene_.raster.width) +
                               static_cast<std::size_t>(compare->x)];
      if (!columns_->has("nearer")) compare->nearer = header_.comparison.wins(compare->z, stored);
      if (compare->nearer) stored = compare->z;
    }
    record_any(recorder_, step_->id, event);
  }

  void begin(std::int32_t polygon) {
    if (begin_ == nullptr)
      throw InputError("polygon", fmt::format("{} has no step that begins a polygon", header_.title),
                       "call this column _");
    if (polygon < 0 || polygon >= std::ssize(first_facet_))
      throw InputError(
          "polygon", fmt::format("there is no polygon {}", polygon),
          fmt::format("the scene has {}, numbered from 0", counted(std::ssize(first_facet_), "polygon", "polygons")));
    const Event event = PolygonBegin{polygon, first_facet_[static_cast<std::size_t>(polygon)]};
    check(event);
    record_any(recorder_, begin_->id, event);
    at_work_ = polygon;
  }
  void check(const Event& event) const {
    EventCheck of_one(scene_);
    const std::string fault = visit_event([&](const auto& known) { return of_one(known); }, event);
    if (!fault.empty())
      throw InputError(std::string(of_one.field()), fault, "it must be one of the scene's, numbered from 0");
  }

  std::string name_;
  const Scene& scene_;
  Header header_;
  TraceRecorder recorder_;
  const StepInfo* step_ = nullptr;
  const StepInfo* begin_ = nullptr;  ///< that begins a polygon
  std::optional<Columns> columns_;
  std::vector<std::int32_t> first_facet_;  ///< by polygon
  std::vector<double> depths_;             ///< the nearest so far, by pixel
  std::optional<std::int32_t> at_work_;
  std::int64_t number_ = 0;
  bool first_ = true;
  std::vector<std::string> faults_;
};

int import_log(const ImportOptions& options) {
  if (options.run.scene.empty())
    throw InputError("zstep import", "needs the scene that the log is of", "add --scene SCENE");
  const bool standard_input = options.from == "-";
  if (!options.to.empty())
    check_outputs({}, {standard_input ? "/dev/stdin" : options.from, options.run.scene}, {options.to});
  InputFile from = standard_input ? InputFile::standard_input() : InputFile(options.from);
  const std::string name = from.name();
  const Run run = prepare_within_budget(options.run);
  InputStream in(std::move(from));
  LogReader reader(options, run, name);
  const Trace trace = reader.read(in);
  if (reader.computes_nearer())
    fmt::print(stderr, "note: the log has no column nearer: each is what the depths before it give ({})\n",
               trace.header().comparison.sign());
  if (options.to.empty()) {
    write_jsonl(trace, std::cout);
    std::cout.flush();
    return exit_code::done;
  }
  std::ostringstream lines;
  write_jsonl(trace, lines);
  const std::string text = std::move(lines).str();
  const std::filesystem::path to = options.to;
  if (to.extension() == ".ztrace") {
    std::istringstream again(text);
    std::optional<TraceRecorder> recorder;
    Scene scene;
    read_jsonl(again, name, [&](const Header& header, Scene its) -> TraceRecorder& {
      scene = std::move(its);
      return recorder.emplace(header, scene);
    });
    recorder->finish();
    write_file(to, recorder->take_bytes());
  } else {
    write_file(to, std::span(reinterpret_cast<const std::uint8_t*>(text.data()), text.size()));
  }
  say_written(options.to, counted(trace.size(), "step", "steps"));
  return exit_code::done;
}

int import_any(const ImportOptions& options) {
  if (!options.step.empty()) return import_log(options);
  const std::string of_log = !options.columns.empty()     ? "--columns"
                             : !options.run.scene.empty() ? "--scene"
                                                          : options.run.given();
  if (!of_log.empty()) throw InputError(of_log, "is of a log", "say which step its lines are: add --as compare");
  if (options.to.empty()) throw InputError("zstep import", "--output is required", "name the trace: -o FILE.ztrace");
  return import_trace(options);
}

}  // namespace

void add_import(CLI::App& app, Action& action) {
  const auto options = std::make_shared<ImportOptions>();
  CLI::App* command = app.add_subcommand("import", "Turn JSON Lines, or the lines of a log, into a trace");
  command->add_option("file", options->from, "The JSON Lines file, or a log, or - for standard input")
      ->type_name("FILE")
      ->required();
  command->add_option("-o,--output", options->to, "The trace to write; of a log a .jsonl will do, or none, to print it")
      ->type_name("FILE.ztrace")
      ->group("Output");
  command->add_option("--as", options->step, "The file is a log: each of its lines is this step, as compare")
      ->type_name("STEP")
      ->group("A log");
  command
      ->add_option("--columns", options->columns,
                   "What stands in its lines: fields of the step, polygon, and _ for what is left out (default: its "
                   "first line names them)")
      ->type_name("NAME,...")
      ->group("A log");
  command->add_option("--scene", options->run.scene, "The scene that was drawn")
      ->type_name("SCENE|MESH")
      ->group("A log");
  add_run_options(*command, options->run);
  add_written_options(*command, options->run);
  add_limit_options(*command);
  command->footer(
      "An existing file is replaced; nothing is written when the input has a mistake. The columns of a log stand "
      "between\n"
      "commas, semicolons or spaces, as 12 or as x=12. A step that begins a polygon is put wherever its number "
      "changes.\n"
      "\n"
      "Examples:\n"
      "  zstep import homework.jsonl -o homework.ztrace\n"
      "  python3 my_zbuffer.py | zstep import - -o homework.ztrace\n"
      "  zstep import log.csv --as compare --columns x,y,z,polygon --scene delhi -o run.jsonl");
  command->callback([options, &action] { action = [options] { return import_any(*options); }; });
}

}  // namespace zstep::cli
