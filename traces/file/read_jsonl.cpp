// JSON Lines in: line by line, with what is wrong gathered and the torn end of a crashed program's file set apart.
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "traces/file/check_events.hpp"
#include "traces/file/event_json.hpp"
#include "traces/file/header_json.hpp"
#include "traces/file/json_members.hpp"
#include "traces/file/json_text.hpp"
#include "traces/file/jsonl.hpp"
#include "traces/file/jsonl_lines.hpp"
#include "traces/file/quick_line.hpp"
#include "traces/near_word.hpp"
#include "traces/outcome.hpp"
#include "traces/text.hpp"

namespace zstep {

using nlohmann::json;

namespace {

constexpr const char* mend_header = "the first line must be a trace's header, as docs/trace-format.md shows it";
constexpr const char* mend_event = "see the fields of each event in docs/trace-format.md";

/// A step that is well written, but no run on this scene can have.
struct ImpossibleStep : MalformedJson {
  using MalformedJson::MalformedJson;
};

class Reader {
 public:
  using Begin = std::function<TraceRecorder&(const Header&, Scene)>;
  Reader(std::istream& in, const std::string& name, const Begin& begin, std::string* impossible,
         GivenRun* given)
      : lines_(in), name_(name), begin_(begin), given_(given), impossible_(impossible) {}

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
    if (faults_.empty()) record_any(*recorder_, quick_event_.step, quick_event_.event);
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
    for (const TornTail::Line& line : tail_.give_up()) add(line.number, line.fault, line.text);
  }

  void begin(const json& document) {
    const bool no_header = document.contains("step") && !document.contains("ztrace");
    if (no_header && given_ == nullptr)
      throw MalformedJson("the header line is missing: this is an event already", mend_header);
    json_members::Parts parts;
    Scene scene;
    if (!no_header) parts.read([&] { header_ = header_from_json(document, given_ ? given_->header : nullptr); });
    if (given_ == nullptr) parts.read([&] {
      if (!document.contains("scene")) throw MalformedJson("\"scene\" is missing");
      scene = scene_from_json(document.at("scene"));
    });
    parts.done();
    if (given_ != nullptr) {
      given_->without_header = no_header;
      if (no_header) header_ = *given_->header, header_.undeclared = 0xff;
      header_ = given_->review(header_);
      scene = *given_->scene;
    }
    check_.emplace(scene);
    for (const StepInfo& step : header_.page) step_names_.push_back(step.name);
    quick_.emplace(header_.page);
    recorder_ = &begin_(header_, std::move(scene));
    if (no_header) record(document);
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
    const Event event = event_from_json(step->kind, document);
    EventCheck of_one = *check_;  // how often buffers are cleared is held against a block, once it is read
    if (const std::string fault = visit_event([&](const auto& e) { return of_one(e); }, event); !fault.empty())
      throw ImpossibleStep(document, std::string(of_one.field()), fault, "it must be one of the scene's");
    ++events_;
    if (faults_.empty()) record_any(*recorder_, step->id, event);
  }

  TextLines lines_;
  const std::string& name_;
  const Begin& begin_;
  GivenRun* given_;
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
  TornTail tail_;
  std::vector<std::string> faults_;
};

}  // namespace

std::optional<std::string> read_jsonl(std::istream& in, const std::string& name,
                                      const std::function<TraceRecorder&(const Header&, Scene)>& begin,
                                      std::string* impossible, GivenRun* given) {
  return Reader(in, name, begin, impossible, given).read();
}

}  // namespace zstep
