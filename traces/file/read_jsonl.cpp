// JSON Lines in: line by line, with what is wrong gathered and the torn end of a crashed program's file set apart.

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <istream>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "traces/error.hpp"
#include "traces/events/fields.hpp"
#include "traces/file/check_events.hpp"
#include "traces/file/event_json.hpp"
#include "traces/file/files.hpp"
#include "traces/file/header_json.hpp"
#include "traces/file/json_text.hpp"
#include "traces/file/jsonl.hpp"
#include "traces/file/lenient.hpp"
#include "traces/file/source_places.hpp"
#include "traces/file/written.hpp"
#include "traces/formulas/coverage.hpp"
#include "traces/formulas/outlines.hpp"
#include "traces/text.hpp"

namespace zstep {

// The lines of a file of JSON Lines, and those that a torn one ends with.

/// The header line holds the scene. A parsed line takes up to thirty times its length in memory, more when it is nested
/// without end, so both are bounded: what comes from others may be made to fill the machine.
inline constexpr std::size_t line_limit = std::size_t{24} << 20;

inline constexpr std::size_t most_faults = 10;  ///< that are reported of one file
/// That are passed over of a run that is judged: it takes long to say of a line why it cannot be read.
inline constexpr std::size_t most_passed_over = 100'000;

/// A file's lines, of at most line_limit + 1 characters each: what comes from others may have no line end at all.
class TextLines {
 public:
  explicit TextLines(std::istream& in) : in_(in) {}
  bool next(std::string& line) {
    line.clear();
    for (;;) {
      if (at_ == end_ && !fill()) return !line.empty();
      const char* from = block_.data() + at_;
      const std::size_t room = std::min(end_ - at_, line_limit + 1 - line.size());
      const void* const found = std::memchr(from, '\n', room);
      const std::size_t length = found ? static_cast<std::size_t>(static_cast<const char*>(found) - from) : room;
      line.append(from, length);
      at_ += length + (found != nullptr);
      if (found || line.size() > line_limit) return true;
    }
  }

 private:
  bool fill() {
    at_ = 0;
    end_ = static_cast<std::size_t>(
        std::max<std::streamsize>(0, in_.rdbuf()->sgetn(block_.data(), static_cast<std::streamsize>(block_.size()))));
    return end_ > 0;
  }
  std::istream& in_;
  std::vector<char> block_ = std::vector<char>(std::size_t{1} << 18);
  std::size_t at_ = 0, end_ = 0;
};

/// What a file ends with when the program that wrote it crashed: no whole object from some line on.
class TornTail {
 public:
  struct Line {
    std::int64_t number;
    std::string text;
    json_text::Fault fault;
  };
  void add(std::int64_t line, std::string_view text, const json_text::Fault& fault) {
    if (count_++ == 0) line_ = line;
    last_line_ = line;
    if (first_.size() < most_faults) first_.push_back({line, std::string(text.substr(0, kept)), fault});
    last_ = json_text::shown(text, 80);
  }
  bool empty() const { return count_ == 0; }
  std::int64_t line() const { return line_; }
  std::int64_t last_line() const { return last_line_; }
  /// "Traceback (most recent call last):", …, "ZeroDivisionError: division by zero"
  std::string quoted() const {
    std::string text = fmt::format("\u201c{}\u201d", json_text::shown(first_.front().text, 80));
    if (count_ == 3) text += fmt::format(", \u201c{}\u201d", json_text::shown(first_[1].text, 80));
    if (count_ > 3) text += ", \u2026";
    if (count_ > 1) text += fmt::format(", \u201c{}\u201d", last_);
    return text;
  }
  /// Its first lines, when more came that was whole: they are mistakes then.
  std::vector<Line> give_up() {
    count_ = 0;
    return std::exchange(first_, {});
  }

 private:
  static constexpr std::size_t kept = 4096;
  std::int64_t line_ = 0, last_line_ = 0, count_ = 0;
  std::vector<Line> first_;
  std::string last_;
};

using nlohmann::json;

namespace {

constexpr const char* mend_header = "the first line must be a trace's header, as docs/trace-format.md shows it";
constexpr const char* mend_event = "see the fields of each event in docs/trace-format.md";

bool ends_value(char c) { return c == ',' || c == '}' || c == ' ' || c == '\t' || c == '\r'; }

std::optional<double> number_in(const json& line, const char* key) {
  const auto found = line.find(key);
  if (found == line.end() || !found->is_number()) return std::nullopt;
  return found->get<double>();
}

/// Not there, null, or called what languages call 0/0.
bool is_no_number(const json& line, const char* key) {
  const auto found = line.find(key);
  if (found == line.end() || found->is_null()) return true;
  return found->is_string() && std::find(words_of_no_number.begin(), words_of_no_number.end(),
                                         found->get_ref<const std::string&>()) != words_of_no_number.end();
}

/// A step that is well written, but no run on this scene can have.
struct ImpossibleStep : MalformedJson {
  using MalformedJson::MalformedJson;
};

class Reader {
 public:
  using Begin = std::function<TraceRecorder&(const Header&, Scene)>;
  Reader(std::istream& in, const std::string& name, const Begin& begin, std::string* impossible, GivenRun* given,
         PassedOver* passed_over, StepLines* step_lines)
      : lines_(in),
        name_(name),
        begin_(begin),
        given_(given),
        passed_over_(passed_over),
        step_lines_(step_lines),
        impossible_(impossible) {}

  std::optional<std::string> read() {
    std::string line;
    while (next(line)) {
      if (number_ == 1) check_encoding(line);
      if (line.size() > line_limit) {
        add(number_,
            {0, false, "the line is longer than 24 MiB",
             "write one event a line; large scenes are recorded straight to a .ztrace"},
            "");
        if (passed_over_) passed_over_->gave_up = true;
        break;  // what follows is the rest of it
      }
      if (recorder_ != nullptr && read_quickly(line)) continue;
      if (line.find_first_not_of(" \t\r") != std::string::npos) take(line);
      if (ended_ || faults_.size() >= most_faults || (recorder_ == nullptr && !faults_.empty())) break;
      if (passed_over_ && passed_over_->lines.size() >= most_passed_over) {
        passed_over_->gave_up = true;
        break;
      }
    }
    if (events_ == 0) give_up_tail();
    if (passed_over_ && events_ == 0) faults_ = passed_over_->faults;
    if (recorder_ == nullptr && faults_.empty())
      faults_.push_back(fault_text(1, {0, false, "there is no header line", mend_header}, ""));
    if (!faults_.empty()) {
      if (faults_.size() >= most_faults) faults_.push_back(name_ + ": there may be more mistakes; mend these first");
      throw InputErrors(faults_);
    }
    if (cut_off_)
      return fmt::format("{}:{}: the recording was cut off before its end; {} steps could be read", name_, *cut_off_,
                         events_);
    if (tail_.empty()) return std::nullopt;
    return fmt::format("{}:{}: the recording was cut off here, at {}; {} steps could be read", name_, tail_.line(),
                       tail_.quoted(), events_);
  }

 private:
  bool next(std::string& line) {
    if (ahead_) {
      line = std::move(*ahead_);
      ahead_.reset();
    } else if (!lines_.next(line)) {
      return false;
    }
    ++number_;
    return true;
  }
  /// The line after, which stays the next one; nullptr at the end of the file.
  const std::string* peek() {
    std::string line;
    if (!ahead_ && lines_.next(line)) ahead_ = std::move(line);
    return ahead_ ? &*ahead_ : nullptr;
  }

  /// A mistake in a text that begins at this line.
  void add(std::int64_t first, const json_text::Fault& fault, std::string_view text) {
    if (passed_over_) pass_over({first, first + std::count(text.begin(), text.end(), '\n')});
    std::vector<std::string>& faults = passed_over_ ? passed_over_->faults : faults_;
    if (faults.size() < most_faults) faults.push_back(fault_text(first, fault, text));
  }
  std::string fault_text(std::int64_t first, const json_text::Fault& fault, std::string_view text) const {
    const auto [line, column] = json_text::line_and_column(text, fault.place, first);
    return printable(InputError(fmt::format("{}:{}:{}", name_, line, column), fault.what, fault.mend).what());
  }
  /// Of a line there may be more than one thing to say.
  void pass_over(PassedOver::Range range) {
    std::vector<PassedOver::Range>& lines = passed_over_->lines;
    if (lines.empty() || lines.back().last < range.first) lines.push_back(range);
    else lines.back().last = std::max(lines.back().last, range.last);
  }

  void check_encoding(std::string& line) const {
    const auto starts = [&](std::string_view bytes) { return line.compare(0, bytes.size(), bytes) == 0; };
    const bool zeros = line.size() > 1 && (line[0] == '\0' || line[1] == '\0');
    if (starts("\xff\xfe") || starts("\xfe\xff") || zeros)
      throw InputError(fmt::format("{}:1:1", name_), "the file is UTF-16",
                       "save it as UTF-8; in PowerShell: python prog.py | Out-File -Encoding utf8 run.jsonl");
    if (starts("\xef\xbb\xbf")) line.erase(0, 3);  // UTF-8, as some editors mark it
    const std::size_t first = line.find_first_not_of(" \t\r");
    if (first != std::string::npos && line[first] == '[')
      throw InputError(
          fmt::format("{}:1:{}", name_, first + 1), "the file is one list",
          "write each object on a line of its own, without the brackets around all and the commas between");
  }

  /// Takes a line as nearly all are; false where something about it is to be said.
  bool read_quickly(std::string& line) {
    if (!tail_.empty() || cut_off_ || !quick_->read(line, quick_event_)) return false;
    give_numbers_of_span(quick_event_.event);
    turn(quick_event_.event, header_, camera_, raster_, Turned::as_own);
    EventCheck of_one = *check_;
    if (!visit_event([&](const auto& event) { return of_one(event).empty(); }, quick_event_.event)) return false;
    const SourcePlaces& places = recorder_->places();
    const std::optional<std::string_view>& place = quick_->place();
    const bool known = !place || (!place->empty() && places.goes_on(quick_event_.step, *place));
    if (!known && !places.fault_of(*place).empty()) return false;
    keep(quick_event_.step, quick_event_.event, place.value_or(""));
    return true;
  }

  void keep(std::uint8_t step, const Event& event, std::string_view place) {
    ++events_;
    if (!faults_.empty()) return;
    record_any(*recorder_, step, event);
    recorder_->places().add(events_, step, place);
    if (step_lines_) step_lines_->add(events_, number_);
  }

  void give_numbers_of_span(Event& event) const {
    if (passed_over_) give_numbers_of_empty(event, raster_.width, header_.conventions.coverage);
  }

  /// One line, or the several on which a pretty-printed object stands.
  void take(std::string& text) {
    const std::int64_t first = number_;
    json document;
    if (!parse(text, document)) return;
    give_up_tail();  // a whole object comes after it, so it is no end
    at_header_ = recorder_ == nullptr;
    if (cut_off_)
      add(*cut_off_, {0, false, "the recording is said to be cut off here, but it goes on", "take this line out"}, "");
    cut_off_.reset();
    if (const auto repeated = json_text::repeated_key(text, document)) {
      add(first,
          {repeated->place, false, fmt::format("\"{}\" is given twice in one object", repeated->key),
           "keep one of them"},
          text);
      return;
    }
    if (recorder_ != nullptr && document.is_object() && document.size() == 1 && document.contains(cut_off_key)) {
      cut_off_ = first;
      return;
    }
    try {
      if (!document.is_object()) throw MalformedJson("is not a JSON object", "write one JSON object a line");
      if (recorder_ == nullptr) begin(document);
      else record(document);
    } catch (const MalformedParts& parts) {
      for (const MalformedJson& part : parts.all) add_in(first, text, document, part);
    } catch (const ImpossibleStep& error) {
      if (impossible_ == nullptr || !faults_.empty()) return add_in(first, text, document, error);
      *impossible_ = fault_text(first, fault_in(text, document, error), text);
      ended_ = true;
    } catch (const MalformedJson& error) {
      add_in(first, text, document, error);
    }
  }

  void add_in(std::int64_t first, std::string_view text, const json& document, const MalformedJson& error) {
    add(first, fault_in(text, document, error), text);
  }
  json_text::Fault fault_in(std::string_view text, const json& document, const MalformedJson& error) const {
    const std::size_t place = json_text::place_of(text, document, error.at, error.key);
    return {place, false, error.what(), error.mend.empty() ? usual_mend() : error.mend};
  }
  const char* usual_mend() const { return at_header_ ? mend_header : mend_event; }

  /// False where a text is no JSON, which is noted.
  bool parse(std::string& text, json& document) {
    try {
      document = parse_bounded(text);
      return true;
    } catch (const json::parse_error& error) {
      if (is_judged() && parse_span_of_no_width(text, document)) return true;
      const json_text::Fault fault = json_text::fault_at(text, error.byte > 0 ? error.byte - 1 : 0);
      const std::int64_t first = number_;
      if (fault.unfinished && gather(text)) return parse_gathered(first, text, document);
      const std::size_t begin = text.find_first_not_of(" \t\r");
      if (recorder_ != nullptr && (fault.unfinished || text[begin] != '{'))
        return tail_.add(number_, text, fault), false;
      give_up_tail();
      add(number_, fault, text);
    } catch (const json::exception&) {
      give_up_tail();
      add(number_, {0, false, "a number is too large", "a double ends at 1.8e308; what is more is \"inf\""}, text);
    } catch (const MalformedJson& error) {
      give_up_tail();
      add(number_, {0, false, error.what(), usual_mend()}, text);
    }
    return false;
  }

  /// What 0/0 is called stands bare in it.
  bool parse_span_of_no_width(std::string& text, json& document) const {
    auto quoted = with_words_quoted(text);
    if (!quoted) return false;
    try {
      json line = parse_bounded(*quoted);
      if (!as_trace_has_it(line, page())) return false;
      document = std::move(line), text = std::move(*quoted);
      return true;
    } catch (const json::exception&) {
    } catch (const MalformedJson&) {
    }
    return false;
  }
  /// Who judges a run takes what right programs may print otherwise.
  bool is_judged() const { return passed_over_ != nullptr || impossible_ != nullptr; }
  const Page& page() const { return recorder_ == nullptr && given_ ? given_->header->page : header_.page; }

  /// Adds the lines on which an object goes on that ends at none; false where it does not go on.
  bool gather(std::string& text) {
    if (const std::string* more = peek(); more == nullptr || !json_text::goes_on(*more)) return false;
    std::string line;
    for (int open = json_text::open_brackets(text); open > 0 && text.size() <= line_limit && next(line);) {
      text += '\n' + line;
      open += json_text::open_brackets(line);
    }
    return true;
  }
  /// Says that it stands on several lines, and reads it all the same: what comes after it can be checked then. Who
  /// judges a run takes it as it is.
  bool parse_gathered(std::int64_t first, const std::string& text, json& document) {
    give_up_tail();
    const auto complain = [&] {
      add(first,
          {0, false, "the object goes on over several lines",
           "write each object on one line; in Python: json.dumps(event), without indent"},
          text);
    };
    if (!passed_over_) complain();
    try {
      document = parse_bounded(text);
      return true;
    } catch (const json::exception&) {
    } catch (const MalformedJson&) {
    }
    if (passed_over_) complain();
    return false;
  }

  /// What looked like the file's end was none: its lines are mistakes.
  void give_up_tail() {
    if (tail_.empty()) return;
    const PassedOver::Range all{tail_.line(), tail_.last_line()};
    for (const TornTail::Line& line : tail_.give_up()) add(line.number, line.fault, line.text);
    if (passed_over_) pass_over(all);
  }

  void begin(json& document) {
    const bool no_header = document.contains("step") && !document.contains("ztrace");
    if (no_header && given_ == nullptr)
      throw MalformedJson("the header line is missing: this is an event already", mend_header);
    json_members::Parts parts;
    Scene scene;
    if (!no_header) parts.read([&] { header_ = header_from_json(document, given_ ? given_->header : nullptr); });
    if (given_ == nullptr)
      parts.read([&] {
        if (!document.contains("scene")) throw MalformedJson("\"scene\" is missing");
        scene = scene_from_json(document.at("scene"));
      });
    if (const std::string_view kind = kind_that_cannot_turn(header_); !kind.empty())
      parts.read([&] {
        throw MalformedJson(document, "conventions",
                            fmt::format("a run with \"{}\" must have pixel centres at integers and left-handed view "
                                        "coordinates",
                                        kind),
                            "write its numbers so, and take \"pixel_centre\" and \"view_coordinates\" out");
      });
    if (passed_over_ == nullptr) parts.done();
    turn(header_, Turned::as_own);
    turn(scene, header_, Turned::as_own);
    if (given_ != nullptr) {
      given_->without_header = no_header || parts.any();
      if (given_->without_header) header_ = *given_->header, header_.undeclared = 0xff;
      header_ = given_->review(header_);
      scene = *given_->scene;
    }
    at_header_ = !no_header;
    camera_ = scene.camera, raster_ = scene.raster;
    check_.emplace(scene);
    for (const StepInfo& step : header_.page) step_names_.push_back(step.name);
    quick_.emplace(header_.page);
    recorder_ = &begin_(header_, std::move(scene));
    parts.done();
    at_header_ = false;
    if (no_header) record(document);
  }

  void record(json& document) {
    const auto found = document.find("step");
    if (found == document.end())
      throw MalformedJson(document, "", "\"step\" is missing", "an event names a step of the header's list");
    if (!found->is_string())
      throw MalformedJson(document, "step", "\"step\" is not a text", "an event names a step of the header's list");
    const auto& name = found->get_ref<const std::string&>();
    const StepInfo* step = find_step(header_.page, std::string_view(name));
    if (step == nullptr)
      throw MalformedJson(document, "step", fmt::format("there is no step \"{}\" in the header's list", name),
                          near_word_or_list(name, {step_names_.data(), step_names_.size()}, "its steps are"));
    if (is_judged()) as_trace_has_it(document, header_.page);
    Event event = event_from_json(step->kind, document);
    give_numbers_of_span(event);
    turn(event, header_, camera_, raster_, Turned::as_own);
    EventCheck of_one = *check_;  // how often buffers are cleared is held against a block, once it is read
    if (const std::string fault = visit_event([&](const auto& e) { return of_one(e); }, event); !fault.empty())
      throw ImpossibleStep(document, std::string(of_one.field()), fault,
                           "it must be one of the scene's, numbered from 0");
    keep(step->id, event, place_in(document));
  }

  std::string_view place_in(const json& document) const {
    const auto found = document.find(at_key);
    if (found == document.end()) return "";
    constexpr const char* mend = "write the program's file and line, as \"raster.cpp:417\", or leave it out";
    if (!found->is_string()) throw MalformedJson(document, at_key, fmt::format("\"{}\" is not a text", at_key), mend);
    const std::string_view place = found->get_ref<const std::string&>();
    if (const std::string fault = recorder_->places().fault_of(place); !fault.empty())
      throw MalformedJson(document, at_key, fmt::format("\"{}\" {}", at_key, fault), mend);
    return place;
  }

  TextLines lines_;
  const std::string& name_;
  const Begin& begin_;
  GivenRun* given_;
  PassedOver* passed_over_;  ///< for who judges: then a line that cannot be read is noted here, and costs itself alone
  StepLines* step_lines_;    ///< where to note at which lines steps stand; or null
  std::optional<std::string> ahead_;
  std::int64_t number_ = 0;  ///< of the line that was read last
  Header header_;
  std::vector<std::string_view> step_names_;
  Camera camera_;  ///< of the scene
  Raster raster_;
  std::optional<EventCheck> check_;
  std::optional<QuickLine> quick_;
  RecordedEvent quick_event_{};
  TraceRecorder* recorder_ = nullptr;
  bool at_header_ = true;
  std::optional<std::int64_t> cut_off_;  ///< the line that says so
  std::int64_t events_ = 0;
  std::string* impossible_;
  bool ended_ = false;  ///< at a step that cannot be
  TornTail tail_;
  std::vector<std::string> faults_;
};

}  // namespace

std::optional<std::string> read_jsonl(std::istream& in, const std::string& name,
                                      const std::function<TraceRecorder&(const Header&, Scene)>& begin,
                                      std::string* impossible, GivenRun* given, StepLines* lines) {
  return Reader(in, name, begin, impossible, given, nullptr, lines).read();
}

Trace open_given_run(const std::filesystem::path& path, std::string& impossible, GivenRun& given,
                     PassedOver& passed_over) {
  InputStream in{InputFile(path)};
  passed_over = {};
  Scene kept;
  std::optional<TraceRecorder> recorder;
  const auto begin = [&](const Header& header, Scene scene) -> TraceRecorder& {
    kept = std::move(scene);
    return recorder.emplace(header, kept);
  };
  const std::string name = path.string();
  StepLines lines;
  const auto cut = Reader(in, name, begin, &impossible, &given, &passed_over, &lines).read();
  recorder->finish(!cut);
  Trace trace = Trace::from_bytes(recorder->take_bytes(), name, cut.value_or(""));
  trace.lines_are(std::move(lines));
  return trace;
}

std::optional<std::string> with_words_quoted(std::string_view text) {
  std::string quoted;
  bool in_text = false, any = false;
  for (std::size_t at = 0; at < text.size(); ++at) {
    const char c = text[at];
    quoted += c;
    if (in_text && c == '\\' && at + 1 < text.size()) {
      quoted += text[++at];
      continue;
    }
    in_text = in_text != (c == '"');
    if (in_text || c != ':') continue;
    std::size_t begin = at + 1;
    while (begin < text.size() && text[begin] == ' ') ++begin;
    for (const std::string_view word : words_of_no_number) {
      const std::size_t end = begin + word.size();
      if (end >= text.size() || text.substr(begin, word.size()) != word || !ends_value(text[end])) continue;
      quoted += '"' + std::string(word) + '"';
      at = end - 1;
      any = true;
      break;
    }
  }
  if (!any) return std::nullopt;
  return quoted;
}

bool as_trace_has_it(json& line, const Page& page) {
  if (!line.is_object()) return false;
  const auto name = line.find("step");
  if (name == line.end() || !name->is_string()) return false;
  const StepInfo* step = find_step(page, std::string_view(name->get_ref<const std::string&>()));
  if (step == nullptr) return false;
  bool changed = false;
  for (const OtherWord& other : other_words) {
    if (description_of_kind(step->kind).name != other.kind) continue;
    const auto found = line.find(std::string(other.field));
    if (found == line.end() || !found->is_string() || found->get_ref<const std::string&>() != other.word) continue;
    *found = std::string(other.as), changed = true;
  }
  if (step->kind == kind_of<SpanBegin> && is_no_number(line, "dz_dx")) {
    const auto left = number_in(line, "x_left"), right = number_in(line, "x_right");
    if (left && right && *left == *right) line["dz_dx"] = 0.0, changed = true;
  }
  return changed;
}

namespace {

/// The pixels between two edges, within the raster.
struct Pixels {
  std::int32_t first, last;
};
Pixels pixels_between(double x_left, double x_right, std::int32_t width, Conventions::Coverage coverage) {
  return {std::max(0, formulas::limited_column(formulas::first_pixel(x_left, coverage), width)),
          formulas::limited_column(formulas::last_pixel(x_right, coverage) + 1, width) - 1};
}

/// Pixels from one x to another: what is drawn of a scan line between two edges.
template <class E>
concept BetweenEdges = requires(E e) {
  e.x_left, e.x_right, e.first, e.last;
};

/// True where it has changed.
template <BetweenEdges E>
bool give_pixels_of_empty(E& event, std::int32_t width, Conventions::Coverage coverage) {
  if (event.first <= event.last && event.last >= 0 && event.first < width) return false;
  const Pixels pixels = pixels_between(event.x_left, event.x_right, width, coverage);
  if (pixels.first <= pixels.last) return false;  // it has some
  event.first = pixels.first, event.last = pixels.last;
  return true;
}

}  // namespace

void give_numbers_of_empty(Event& event, std::int32_t width, Conventions::Coverage coverage) {
  visit_event(
      [&]<class E>(E& e) {
        if constexpr (BetweenEdges<E>) {
          if (!give_pixels_of_empty(e, width, coverage)) return;
          if constexpr (requires { e.dz_dx; }) {
            const bool of_no_width = e.x_left == e.x_right;
            e.dz_dx = of_no_width ? 0 : formulas::slope(e.z_left, e.z_right, e.x_left, e.x_right);
          }
        }
      },
      event);
}

}  // namespace zstep
