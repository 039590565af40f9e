// JSON Lines in: line by line, with what is wrong gathered and the torn end of a crashed program's file set apart.
#include <algorithm>
#include <array>
#include <cstring>
#include <istream>
#include <span>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "traces/error.hpp"
#include "traces/events/slots.hpp"
#include "traces/file/check_events.hpp"
#include "traces/file/header_json.hpp"
#include "traces/file/json_members.hpp"
#include "traces/file/json_text.hpp"
#include "traces/file/jsonl.hpp"
#include "traces/file/quick_line.hpp"
#include "traces/near_word.hpp"
#include "traces/text.hpp"

namespace zstep {

using nlohmann::json;

namespace {

// The header line holds the scene. A parsed line takes up to thirty times its length in memory, more when it is nested
// without end, so both are bounded: what comes from others may be made to fill the machine.
constexpr std::size_t line_limit = std::size_t{24} << 20;

constexpr std::size_t most_faults = 10;  ///< that are told of one file

constexpr const char* mend_header = "the first line must be a trace's header, as docs/trace-format.md shows it";
constexpr const char* mend_event = "see the fields of each event in docs/trace-format.md";

/// A file's lines, of at most line_limit + 1 characters each: what comes from others may have no line end at all.
class Lines {
 public:
  explicit Lines(std::istream& in) : in_(in) {}
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

bool truth_from(const json& in, std::string_view name) {
  if (in.is_boolean()) return in.get<bool>();
  throw MalformedJson(in, "", fmt::format("\"{}\" is neither true nor false", name),
                      "write true or false, without quotes");
}

std::size_t word_from(const json& in, std::string_view name, std::span<const std::string_view> words) {
  if (in.is_string()) {
    const auto found = std::find(words.begin(), words.end(), in.get<std::string>());
    if (found != words.end()) return static_cast<std::size_t>(found - words.begin());
  }
  const std::string_view near = in.is_string() ? near_word(in.get_ref<const std::string&>(), words) : "";
  throw MalformedJson(in, "", fmt::format("\"{}\" can only be one of: {}", name, fmt::join(words, ", ")),
                      near.empty() ? "" : fmt::format("did you mean \"{}\"?", near));
}

std::int32_t whole_from(const json& in, std::string_view name) {
  // Programs in languages with one kind of number write 5.0 for 5.
  if (in.is_number()) {
    const double value = in.get<double>();
    if (value == static_cast<double>(static_cast<std::int64_t>(std::clamp(value, -3e9, 3e9))) && value >= INT32_MIN &&
        value <= INT32_MAX)
      return static_cast<std::int32_t>(value);
  }
  throw MalformedJson(in, "", fmt::format("\"{}\" is not a whole number", name));
}

template <class Value>
Value value_from(const json& in, std::string_view name) {
  if constexpr (std::is_same_v<Value, double>) return real_from_json(in, std::string(name).c_str());
  else if constexpr (std::is_same_v<Value, bool>) return truth_from(in, name);
  else if constexpr (std::is_enum_v<Value>) return static_cast<Value>(word_from(in, name, words_of<Value>));
  else return whole_from(in, name);
}

/// Throws when a line has other members than its step and these.
void refuse_others(const json& line, std::span<const std::string_view> fields, std::string_view kind) {
  for (const auto& item : line.items()) {
    const std::string& key = item.key();
    if (key == "step" || std::find(fields.begin(), fields.end(), key) != fields.end()) continue;
    throw MalformedJson(line, key, fmt::format("\"{}\" is no field of {}", key, kind),
                        near_word_or_list(key, fields, "its fields are"));
  }
}

template <class E>
E event_from(const json& line) {
  E event{};
  std::array<std::string_view, field_count<E>> names;
  for_each_index<E>([&]<std::size_t I>() { names[I] = field_at<E, I>.name; });
  for_each_index<E>([&]<std::size_t I>() {
    const auto found = line.find(std::string(names[I]));
    if (found == line.end()) {
      refuse_others(line, names, kind_text<E>.name);  // it is there under a misspelt name
      throw MalformedJson(line, "", fmt::format("\"{}\" is missing ({})", names[I], field_at<E, I>.meaning));
    }
    event.*field_at<E, I>.member = value_from<FieldValue<E, I>>(*found, names[I]);
  });
  if (line.size() != names.size() + 1) refuse_others(line, names, kind_text<E>.name);
  return event;
}

/// What a file ends with when the program that wrote it crashed: no whole object from some line on.
class Tail {
 public:
  struct Line {
    std::int64_t number;
    std::string text;
    json_text::Fault fault;
  };
  void add(std::int64_t line, std::string_view text, const json_text::Fault& fault) {
    if (count_++ == 0) line_ = line;
    if (first_.size() < most_faults) first_.push_back({line, std::string(text.substr(0, kept)), fault});
    last_ = json_text::shown(text, 80);
  }
  bool empty() const { return count_ == 0; }
  std::int64_t line() const { return line_; }
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
  std::int64_t line_ = 0, count_ = 0;
  std::vector<Line> first_;
  std::string last_;
};

/// A step that is well written, but no run on this scene can have.
struct ImpossibleStep : MalformedJson {
  using MalformedJson::MalformedJson;
};

class Reader {
 public:
  using Begin = std::function<TraceRecorder&(const Header&, Scene)>;
  Reader(std::istream& in, const std::string& name, const Begin& begin, std::string* impossible)
      : lines_(in), name_(name), begin_(begin), impossible_(impossible) {}

  std::optional<std::string> read() {
    std::string line;
    while (next(line)) {
      if (number_ == 1) check_encoding(line);
      if (line.size() > line_limit) {
        add(number_, {0, false, "the line is longer than 24 MiB",
                      "write one event a line; large scenes are recorded straight to a .ztrace"}, "");
        break;  // what follows is the rest of it
      }
      if (recorder_ != nullptr && read_quickly(line)) continue;
      if (line.find_first_not_of(" \t\r") != std::string::npos) take(line);
      if (ended_ || faults_.size() >= most_faults || (recorder_ == nullptr && !faults_.empty())) break;
    }
    if (recorder_ == nullptr && faults_.empty()) add(1, {0, false, "there is no header line", mend_header}, "");
    if (events_ == 0) give_up_tail();
    if (!faults_.empty()) {
      if (faults_.size() >= most_faults) faults_.push_back(name_ + ": there may be more mistakes; mend these first");
      throw InputError(faults_);
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
    if (faults_.size() >= most_faults) return;
    const auto [line, column] = json_text::line_and_column(text, fault.place, first);
    faults_.push_back(
        printable(InputError(fmt::format("{}:{}:{}", name_, line, column), fault.what, fault.mend).what()));
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
    EventCheck of_one = *check_;
    if (!visit_event([&](const auto& event) { return of_one(event).empty(); }, quick_event_.event)) return false;
    ++events_;
    if (faults_.empty())
      visit_event([&](const auto& event) { record_any(*recorder_, quick_event_.step, event); }, quick_event_.event);
    return true;
  }

  /// One line, or the several on which a pretty-printed object stands.
  void take(std::string& text) {
    const std::int64_t first = number_;
    json document;
    if (!parse(text, document)) return;
    give_up_tail();  // a whole object comes after it, so it is no end
    if (cut_off_)
      add(*cut_off_, {0, false, "the recording is said to be cut off here, but it goes on", "take this line out"}, "");
    cut_off_.reset();
    if (const auto repeated = json_text::repeated_key(text, document)) {
      add(first, {repeated->place, false, fmt::format("\"{}\" is given twice in one object", repeated->key),
                  "keep one of them"}, text);
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
      add_in(first, text, document, error);
      if (impossible_ == nullptr || faults_.size() != 1) return;
      *impossible_ = std::move(faults_.back());
      faults_.clear();
      ended_ = true;
    } catch (const MalformedJson& error) {
      add_in(first, text, document, error);
    }
  }

  void add_in(std::int64_t first, std::string_view text, const json& document, const MalformedJson& error) {
    const std::size_t place = json_text::place_of(text, document, error.at, error.key);
    add(first, {place, false, error.what(), error.mend.empty() ? usual_mend() : error.mend}, text);
  }
  const char* usual_mend() const { return recorder_ == nullptr ? mend_header : mend_event; }

  /// False where a text is no JSON, which is noted.
  bool parse(std::string& text, json& document) {
    try {
      document = parse_bounded(text);
      return true;
    } catch (const json::parse_error& error) {
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
  /// Says that it stands on several lines, and reads it all the same: what comes after it can be checked then.
  bool parse_gathered(std::int64_t first, const std::string& text, json& document) {
    give_up_tail();
    add(first, {0, false, "the object goes on over several lines",
                "write each object on one line; in Python: json.dumps(event), without indent"}, text);
    try {
      document = parse_bounded(text);
      return true;
    } catch (const json::exception&) {
      return false;
    } catch (const MalformedJson&) {
      return false;
    }
  }

  /// What looked like the file's end was none: its lines are mistakes.
  void give_up_tail() {
    for (const Tail::Line& line : tail_.give_up()) add(line.number, line.fault, line.text);
  }

  void begin(const json& document) {
    if (document.contains("step") && !document.contains("ztrace"))
      throw MalformedJson("the header line is missing: this is an event already", mend_header);
    json_members::Parts parts;
    Scene scene;
    parts.read([&] { header_ = header_from_json(document); });
    parts.read([&] {
      if (!document.contains("scene")) throw MalformedJson("\"scene\" is missing");
      scene = scene_from_json(document.at("scene"));
    });
    parts.done();
    check_.emplace(scene);
    for (const StepInfo& step : header_.page) step_names_.push_back(step.name);
    quick_.emplace(header_.page);
    recorder_ = &begin_(header_, std::move(scene));
  }

  void record(const json& document) {
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
    for_each_kind([&]<class E>() {
      if (kind_of<E> != step->kind) return;
      const E event = event_from<E>(document);
      EventCheck of_one = *check_;  // how often buffers are cleared is held against a block, once it is read
      if (const std::string fault = of_one(event); !fault.empty())
        throw ImpossibleStep(document, std::string(of_one.field()), fault, "it must be one of the scene's");
      ++events_;
      if (faults_.empty()) record_any(*recorder_, step->id, event);
    });
  }

  Lines lines_;
  const std::string& name_;
  const Begin& begin_;
  std::optional<std::string> ahead_;
  std::int64_t number_ = 0;  ///< of the line that was read last
  Header header_;
  std::vector<std::string_view> step_names_;
  std::optional<EventCheck> check_;
  std::optional<QuickLine> quick_;
  RecordedEvent quick_event_{};
  TraceRecorder* recorder_ = nullptr;
  std::optional<std::int64_t> cut_off_;  ///< the line that says so
  std::int64_t events_ = 0;
  std::string* impossible_;
  bool ended_ = false;  ///< at a step that cannot be
  Tail tail_;
  std::vector<std::string> faults_;
};

}  // namespace

std::optional<std::string> read_jsonl(std::istream& in, const std::string& name,
                                      const std::function<TraceRecorder&(const Header&, Scene)>& begin,
                                      std::string* impossible) {
  return Reader(in, name, begin, impossible).read();
}

}  // namespace zstep
