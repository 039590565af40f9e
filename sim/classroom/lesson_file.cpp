// A lesson's file: a TOML head between +++ lines, then stops, each a `## ` heading with its anchor.

#include "sim/classroom/lesson_file.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <fmt/core.h>
#include <optional>
#include <sstream>
#include <string>
#include <string_view>
#include <system_error>
#include <toml++/toml.h>
#include <utility>
#include <vector>

#include "algorithms/catalog/catalog.hpp"
#include "algorithms/catalog/changes.hpp"
#include "algorithms/scene/load.hpp"
#include "algorithms/scene/scene_file/toml_text.hpp"
#include "sim/classroom/anchor.hpp"
#include "sim/classroom/evaluate.hpp"
#include "sim/classroom/fill.hpp"
#include "sim/classroom/lesson.hpp"
#include "sim/classroom/lesson_blocks.hpp"
#include "sim/classroom/marking.hpp"
#include "traces/error.hpp"
#include "traces/file/files.hpp"
#include "traces/scene.hpp"
#include "traces/text.hpp"

namespace zstep::classroom {
namespace {

struct Head {
  const std::string& file;
  std::int32_t first_line;

  std::string at(const toml::source_region& source) const {
    return fmt::format("{}:{}", file, static_cast<std::int64_t>(source.begin.line) + first_line - 1);
  }

  void known_keys(const toml::table& table, std::string_view what, const std::vector<std::string_view>& keys) const {
    for (const auto& [key, value] : table) {
      const std::string_view name = key.str();
      bool known = false;
      std::string list;
      for (const std::string_view candidate : keys) {
        known = known || name == candidate;
        list += (list.empty() ? "" : ", ") + std::string(candidate);
      }
      if (!known) {
        throw InputError(at(key.source()), fmt::format("{} has no `{}`{}", what, name, did_you_mean(name, keys)),
                         "it may have " + list);
      }
    }
  }

  void text(const toml::table& table, std::string_view key, std::string& into) const {
    const toml::node* node = table.get(key);
    if (!node || !node->is_string() || node->as_string()->get().empty()) {
      throw InputError(node ? at(node->source()) : fmt::format("{}:{}", file, first_line),
                       fmt::format("the head needs a text for `{}`", key), fmt::format("write {} = \"…\"", key));
    }
    into = node->as_string()->get();
  }
  void number(const toml::table& table, std::string_view key, std::optional<double>& into) const {
    const toml::node* node = table.get(key);
    if (!node) return;
    const auto value = node->value<double>();
    if (!value || node->is_boolean() || !std::isfinite(*value)) {
      throw InputError(at(node->source()), fmt::format("`{}` is no number", key), fmt::format("write {} = 4", key));
    }
    into = *value;
  }
  void size(const toml::table& table, std::string_view key, std::optional<std::int32_t>& into) const {
    const toml::node* node = table.get(key);
    if (!node) return;
    const auto value = node->is_integer() ? node->value<std::int64_t>() : std::nullopt;
    if (!value || *value < 1 || *value > 4096) {
      throw InputError(at(node->source()), fmt::format("`{}` is not a number of pixels", key),
                       fmt::format("write {} = 16; at most 4096", key));
    }
    into = static_cast<std::int32_t>(*value);
  }
  std::optional<bool> truth(const toml::table& table, std::string_view key) const {
    const toml::node* node = table.get(key);
    if (!node) return std::nullopt;
    if (!node->is_boolean())
      throw InputError(at(node->source()), fmt::format("`{}` is no truth", key),
                       fmt::format("write {} = true or false", key));
    return node->as_boolean()->get();
  }
  template <std::size_t N>
  void word(const toml::table& table, std::string_view key, const std::array<std::string_view, N>& words,
            ConventionChoices& into) const {
    const toml::node* node = table.get(key);
    if (!node) return;
    std::string list;
    for (const std::string_view word : words) {
      if (node->is_string() && node->as_string()->get() == word) into.words[std::string(key)] = word;
      list += fmt::format("{}\"{}\"", list.empty() ? "" : " or ", word);
    }
    if (!into.words.contains(key))
      throw InputError(at(node->source()), fmt::format("`{}` has a value it does not know", key),
                       fmt::format("write {} = {}", key, list));
  }
  const toml::table& table(const toml::table& all, std::string_view key) const {
    static const toml::table none;
    const toml::node* node = all.get(key);
    if (!node) return none;
    if (!node->is_table())
      throw InputError(at(node->source()), fmt::format("`{}` is no table", key),
                       fmt::format("write [{}] on a line of its own", key));
    return *node->as_table();
  }
};

}  // namespace

void read_lesson_head(Lesson& lesson, const std::string& file, std::string_view head, std::int32_t line) {
  const Head read{file, line};
  scene::check_toml_depth(head, file, line);
  toml::table all;
  try {
    all = toml::parse(head);
  } catch (const toml::parse_error& error) {
    throw InputError(read.at(error.source()), fmt::format("the head is no TOML: {}", error.description()),
                     "write key = value lines");
  }
  read.known_keys(all, "a lesson's head",
                  {"title", "summary", "theme", "scene", "method", "camera", "raster", "conventions", "options"});
  read.text(all, "title", lesson.title);
  read.text(all, "summary", lesson.summary);
  if (all.contains("theme")) read.text(all, "theme", lesson.theme);
  read.text(all, "scene", lesson.scene);
  read.text(all, "method", lesson.method);

  const toml::table& camera = read.table(all, "camera");
  read.known_keys(camera, "[camera]", {"rho", "theta", "phi", "d", "window", "near", "far", "orthographic", "fit"});
  ViewOptions& view = lesson.view;
  read.number(camera, "rho", view.rho);
  read.number(camera, "theta", view.theta);
  read.number(camera, "phi", view.phi);
  read.number(camera, "d", view.d);
  read.number(camera, "window", view.window);
  read.number(camera, "near", view.near);
  read.number(camera, "far", view.far);
  view.orthographic = read.truth(camera, "orthographic");
  view.fit = read.truth(camera, "fit").value_or(false);

  const toml::table& raster = read.table(all, "raster");
  read.known_keys(raster, "[raster]", {"width", "height"});
  read.size(raster, "width", view.width);
  read.size(raster, "height", view.height);

  const toml::table& conventions = read.table(all, "conventions");
  read.known_keys(
      conventions, "[conventions]",
      {"depth", "interpolation", "coverage", "number_format", "rounding", "positions", "attribute", "cull"});
  for_each_convention([&]<class E>(std::string_view key, E Conventions::*) {
    read.word(conventions, key, words_of<E>, lesson.conventions.choices);
  });
  lesson.conventions.cull = read.truth(conventions, "cull");

  for (const auto& [name, value] : read.table(all, "options")) {
    if (!value.is_string())
      throw InputError(read.at(value.source()), fmt::format("the option `{}` is no text", name.str()),
                       fmt::format("write {} = \"…\", with a value as 'zstep list options' names them", name.str()));
    lesson.conventions.options[std::string(name.str())] = value.as_string()->get();
  }
}

}  // namespace zstep::classroom

namespace zstep {

using namespace classroom;

namespace {

constexpr std::size_t largest_file = 1 << 20;

bool is_utf8(std::string_view text) {
  for (std::size_t i = 0; i < text.size();) {
    const std::uint8_t byte = byte_of(text[i]);
    const std::size_t more = byte < 0x80 ? 0 : (byte >> 5) == 6 ? 1 : (byte >> 4) == 14 ? 2 : (byte >> 3) == 30 ? 3 : 9;
    if (byte == 0 || more == 9 || i + more >= text.size() + (more == 0)) return false;
    for (std::size_t k = 1; k <= more; ++k)
      if (!continues_character(text[i + k])) return false;
    i += more + 1;
  }
  return true;
}

/// "lessons/4-z-buffer.md" -> "z-buffer": the number only orders the folder.
std::string id_of(const std::filesystem::path& path) {
  const std::string stem = path.stem().string();
  const std::size_t word = stem.find_first_not_of("0123456789-_");
  return word == std::string::npos ? stem : stem.substr(word);
}

class Reader {
 public:
  Reader(Lesson& lesson, Lines& lines) : lesson_(lesson), lines_(lines) {}

  void read() {
    for (; lines_.at < lines_.all.size(); ++lines_.at) {
      const std::string_view text = lines_.text();
      if (starts_with(text, "## ")) begin_stop();
      else if (starts_with(text, "# "))
        lines_.fail("a heading with one #", "the title stands in the head; a stop's heading has ##");
      else if (starts_with(text, ":::")) block();
      else narration();
    }
    if (lesson_.stops.empty())
      throw InputError(lines_.file, "the lesson has no stop", "write `## Heading {at: start}` and its text");
    for (Stop& stop : lesson_.stops) finish(stop);
  }

 private:
  /// "(12, 15)" or "2 3 4 5": whole numbers of a picture or a scene, which is not known yet; none of anything else.
  static std::vector<std::int32_t> whole_numbers(std::string_view text) {
    std::vector<std::int32_t> numbers;
    for (std::size_t at = 0; at < text.size();) {
      const std::size_t digit = text.find_first_not_of("(), ", at);
      if (digit == std::string_view::npos) break;
      std::int32_t number = 0;
      const auto [end, error] = std::from_chars(text.data() + digit, text.data() + text.size(), number);
      if (error != std::errc() || number < 0) return {};
      numbers.push_back(number);
      at = static_cast<std::size_t>(end - text.data());
    }
    return numbers;
  }

  /// "runs/first.jsonl", "bias = 0, pcf = 1" or "scenes/foot.toml, bias = 0".
  RunBeside read_beside(std::string_view text) const {
    RunBeside beside;
    while (!text.empty()) {
      const std::size_t comma = std::min(text.find(','), text.size());
      const std::string part(trim(text.substr(0, comma)));
      text.remove_prefix(std::min(comma + 1, text.size()));
      if (part.find('=') != std::string::npos) {
        read_change(part, lines_.where(lines_.at) + ":");
        beside.changes.push_back(part);
        continue;
      }
      std::error_code unreadable;
      const std::vector<BuiltIn> built_in = built_in_scenes();
      const bool known =
          std::filesystem::is_regular_file(lesson_.path.parent_path() / part, unreadable) ||
          std::any_of(built_in.begin(), built_in.end(), [&](const BuiltIn& one) { return one.name == part; });
      if (!beside.file.empty() || !known)
        lines_.fail(fmt::format("there is no run `{}`", part),
                    "give the path of its .jsonl from the lesson's folder, that of a scene, or a change as `bias = 0`");
      beside.file = part;
    }
    return beside;
  }

  /// What a stop shows, as "focus: edge-table", "pixel: (12, 15)", "viewing: T_2" or "beside: runs/first.jsonl".
  void read_shown(std::string_view text, Stop& stop) const {
    const std::string_view value = trim(text.substr(std::min(text.size(), text.find(':') + 1)));
    if (starts_with(text, "focus:") && !value.empty()) {
      stop.focus = value;
      std::replace(stop.focus.begin(), stop.focus.end(), '-', '_');
      return;
    }
    if (starts_with(text, "viewing:") && value.size() == 3 && starts_with(value, "T_") &&
        ((value[2] >= '1' && value[2] <= '4') || value[2] == 'v')) {
      stop.viewing_step = value[2] == 'v' ? 5 : value[2] - '0';
      return;
    }
    if (starts_with(text, "order:") && !value.empty()) return read_orders(value, stop);
    if (starts_with(text, "depths:") && !value.empty()) {
      stop.depths = value;
      return;
    }
    const std::vector<std::int32_t> numbers = whole_numbers(value);
    if (starts_with(text, "pixel:") && numbers.size() == 2) {
      stop.pixel = {numbers[0], numbers[1]};
      return;
    }
    if (starts_with(text, "pixels:") && !value.empty()) {
      stop.pixels.steps = value;
      stop.pixels.steps_line = lines_.number();
      return;
    }
    if (starts_with(text, "beside:") && !value.empty()) {
      if (stop.beside.size() == 2) lines_.fail("a third run beside", "show two at most");
      stop.beside.push_back(read_beside(value));
      return;
    }
    if (starts_with(text, "label:") && !value.empty()) return read_labels(value, stop);
    if (starts_with(text, "close:") && !value.empty()) {
      stop.close = value;
      return;
    }
    if (starts_with(text, "window:") && !value.empty()) return read_window(value, stop);
    lines_.fail(fmt::format("`{}` is left over in the anchor", text),
                "after ; write `focus:`, `viewing:`, `order:`, `depths:`, `pixel:`, `pixels:`, `label:`, `close:`, "
                "`window:` or `beside:` as docs/writing-a-lesson.md says");
  }

  /// "T_2 T_1, T_1 T_2".
  void read_orders(std::string_view text, Stop& stop) const {
    stop.orders.emplace_back();
    for (std::size_t at = 0; at < text.size(); ++at) {
      if (text[at] == ',') stop.orders.emplace_back();
      if (text[at] == ',' || text[at] == ' ') continue;
      const std::string_view one = text.substr(at, 3);
      if (one.size() < 3 || !starts_with(one, "T_") || one[2] < '1' || one[2] > '4')
        lines_.fail(fmt::format("`order: {}` is not made of T_1 to T_4", text),
                    "write products, as in `order: T_2 T_1, T_1 T_2`");
      stop.orders.back().push_back(one[2] - '0');
      at += 2;
    }
    if (std::ranges::any_of(stop.orders, [](const auto& order) { return order.empty(); }))
      lines_.fail(fmt::format("`order: {}` has a comma too many", text),
                  "write orders as in `order: T_2 T_1, T_1 T_2`");
  }

  /// "V_5, V_0 = 5, 4-5-6, V_01 = 0>1, U, plane = C, scan line 8"; of several lines after each other the first has the
  /// name.
  void read_labels(std::string_view text, Stop& stop) const {
    const auto vertex = [](std::string_view name) -> std::int32_t {
      name = trim(name);
      if (starts_with(name, "V_")) name.remove_prefix(2);
      std::int32_t number = -1;
      const auto [end, error] = std::from_chars(name.data(), name.data() + name.size(), number);
      return error == std::errc() && end == name.data() + name.size() ? number : -1;
    };
    while (!text.empty()) {
      const std::size_t comma = std::min(text.size(), text.find(','));
      const std::string_view one = trim(text.substr(0, comma));
      text.remove_prefix(std::min(text.size(), comma + 1));
      constexpr std::string_view line = "scan line ";
      if (starts_with(one, line)) {
        const std::int32_t number = vertex(one.substr(line.size()));
        if (number < 0) lines_.fail(fmt::format("`{}` is no label", one), "write `scan line 8`");
        stop.labels.emplace_back().name = one;
        stop.labels.back().scan_line = number;
        continue;
      }
      const std::size_t is = one.find('=');
      const std::string_view what = is == std::string_view::npos ? one : trim(one.substr(is + 1));
      StopLabel label;
      std::size_t to = what.find_first_of("->");
      label.vertex = vertex(what.substr(0, to));
      if (is != std::string_view::npos) label.name = trim(one.substr(0, is));
      else if (to == std::string_view::npos) label.name = one;
      if (label.vertex < 0 && is != std::string_view::npos) label.plane_of = what;
      if (to == std::string_view::npos) stop.labels.push_back(label);
      while (to != std::string_view::npos) {
        const std::size_t next = what.find_first_of("->", to + 1);
        label.to = vertex(what.substr(to + 1, next == std::string_view::npos ? next : next - to - 1));
        label.arrow = what[to] == '>';
        if (label.vertex < 0 || label.to < 0)
          lines_.fail(fmt::format("`{}` is no label", one),
                      "write `V_5`, `V_0 = 5`, `4-5-6`, `V_01 = 0>1` or a polygon");
        stop.labels.push_back(label);
        const std::int32_t end = label.to;
        label = {}, label.vertex = end;
        to = next;
      }
    }
  }

  /// "-25 15 -20 30 10": left, right, bottom, top, distance; then the far plane, or α.
  void read_window(std::string_view text, Stop& stop) const {
    constexpr std::string_view alpha = "α";
    const bool angle = text.size() > alpha.size() && text.substr(text.size() - alpha.size()) == alpha;
    std::istringstream in{std::string(text.substr(0, text.size() - (angle ? alpha.size() : 0)))};
    std::vector<double> numbers;
    for (double number = 0; in >> number;) numbers.push_back(number);
    const auto at = [&](std::size_t k) { return k < numbers.size() ? numbers[k] : 0; };
    stop.window = StopWindow{at(0), at(1), at(2), at(3), at(4), at(5), angle};
    if (!in.eof() || numbers.size() < 5 || numbers.size() > 6 || !(at(0) < at(1)) || !(at(2) < at(3)) || !(at(4) > 0))
      lines_.fail(fmt::format("`{}` is no window", text),
                  "write left, right, bottom, top and distance, `-25 15 -20 30 10`");
  }

  void begin_stop() {
    const std::string_view text = trim(lines_.text().substr(3));
    std::size_t open = text.rfind("{at:");
    if (open == std::string_view::npos) open = text.rfind("{before:");
    if (open == std::string_view::npos || text.back() != '}') {
      lines_.fail(
          fmt::format("the stop `{}` has no anchor", text),
          "end its heading with {at: step}, {before: step where condition}, {at: here}, {at: start} or {at: end}");
    }
    Stop stop;
    stop.heading = trim(text.substr(0, open));
    if (stop.heading.empty()) lines_.fail("the stop has no heading", "write a few words before its anchor");
    std::string_view anchor = text.substr(open + 1, text.size() - open - 2);
    std::size_t semicolon = anchor.find(';');
    std::string_view more = semicolon == std::string_view::npos ? std::string_view{} : anchor.substr(semicolon);
    anchor = trim(anchor.substr(0, semicolon));
    for (; !more.empty(); more = semicolon == std::string_view::npos ? std::string_view{} : more.substr(semicolon)) {
      more.remove_prefix(1);
      semicolon = more.find(';');
      read_shown(trim(more.substr(0, semicolon)), stop);
    }
    stop.anchor = anchor;
    parse_anchor(stop.anchor, lines_.where(lines_.at));
    stop.line = lines_.number();
    stop.text_line = stop.line + 1;
    lesson_.stops.push_back(std::move(stop));
  }

  void narration() {
    const std::string_view text = lines_.text();
    const bool blank = trim(text).empty();
    if (lesson_.stops.empty()) {
      if (!blank) lines_.fail("text before the first stop", "write `## Heading {at: start}` above it");
      return;
    }
    Stop& stop = lesson_.stops.back();
    if (stop.task && !blank) lines_.fail("text after a task", "put it before the task, or into a stop of its own");
    if (stop.marking && !blank)
      lines_.fail("text after what is to be marked", "put it before the block, or into a stop of its own");
    if (stop.question && !blank)
      lines_.fail("text after a question", "put it before the question, or into a stop of its own");
    if (starts_with(trim(text), "```")) return code(stop);
    append_line(stop.text, text);
  }

  /// A fenced block goes in whole: what looks like a heading in it is none.
  void code(Stop& stop) {
    const std::size_t opened = lines_.at;
    do {
      append_line(stop.text, lines_.text());
      if (++lines_.at == lines_.all.size())
        throw InputError(lines_.where(opened), "a code block is not closed", "add a line with ```");
    } while (!starts_with(trim(lines_.text()), "```"));
    append_line(stop.text, lines_.text());
  }

  void block() {
    const std::string_view name = trim(lines_.text().substr(3));
    if (lesson_.stops.empty())
      lines_.fail(fmt::format("{}{} before the first stop", name == "notes" ? "" : "a ", name),
                  "write `## Heading {at: start}` above it");
    read_block(lines_, lesson_.stops.back());
  }

  void finish(Stop& stop) const {
    stop.text = strip_lines(stop.text, stop.text_line);
    if (stop.text.empty() && !stop.question && !stop.task && !stop.marking) {
      throw InputError(fmt::format("{}:{}", lines_.file, stop.line), "the stop says nothing",
                       "write a sentence or a question under it");
    }
  }

  Lesson& lesson_;
  Lines& lines_;
};

std::string read_file(const std::filesystem::path& path) {
  std::string text = read_whole(path, largest_file, "name a Markdown file, or a lesson that `zstep list` shows",
                                "no lesson is so large");
  note_input(path);
  return text;
}

std::vector<Line> split_lines(std::string_view text, const std::string& file) {
  std::vector<Line> lines;
  if (starts_with(text, "\xEF\xBB\xBF")) text.remove_prefix(3);
  while (!text.empty()) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    std::string_view line = text.substr(0, end);
    if (!line.empty() && line.back() == '\r') line.remove_suffix(1);
    lines.push_back({line, size32(lines) + 1});
    if (!is_utf8(line))
      throw InputError(fmt::format("{}:{}", file, lines.size()), "the line is not UTF-8", "save the file as UTF-8");
    text.remove_prefix(std::min(end + 1, text.size()));
  }
  return lines;
}

/// Names in anchors and braces against the method's page, before anything runs.
void check_stops(const Lesson& lesson, const std::string& file) {
  Conventions conventions;
  lesson.conventions.choices.apply(conventions);
  conventions.options = lesson.conventions.options;
  const Page page = header_for(method(lesson.method), conventions).page;
  std::uint8_t kind = no_kind;
  for (const Stop& stop : lesson.stops) {
    const Place place{file, stop.line};
    const Anchor anchor = parse_anchor(stop.anchor, place.str());
    check_anchor(anchor, page, place.str());
    if (anchor.kind == Anchor::Kind::step) kind = require_step(page, anchor.step, place.str()).kind;
    else if (anchor.kind != Anchor::Kind::here) kind = no_kind;
    check_fill(stop.heading, place, kind, page);
    if (!stop.depths.empty())
      for (const Expression& depth : parse_list(stop.depths, place.str()))
        if (check(depth, kind, page, place.str()) != Quantity::Type::number)
          throw InputError(place.str(), "a depth to be marked is no number", "write view depths, `depths: near, 18`");
    check_fill(stop.text, {file, stop.text_line}, kind, page);
    if (stop.task) {
      const std::string done = Place{file, stop.task->done_line}.str();
      if (check(parse_expression(stop.task->done, done), no_kind, page, done) != Quantity::Type::truth)
        throw InputError(done, fmt::format("`{}` is neither true nor false", stop.task->done),
                         "write a condition, as `frame(3, 2) == \"A\"`");
      check_fill(stop.task->text, {file, stop.task->text_line}, kind, page);
      check_fill(stop.task->now, {file, stop.task->now_line}, no_kind, page);
      for (const std::string& hint : stop.task->hints) check_fill(hint, {file, stop.task->line}, kind, page);
    }
    if (stop.marking) {
      check_marking(*stop.marking, page, file);
      check_fill(stop.marking->text, {file, stop.marking->text_line}, kind, page);
      check_fill(stop.marking->why, {file, stop.marking->why_line}, kind, page);
      for (const std::string& hint : stop.marking->hints) check_fill(hint, {file, stop.marking->line}, kind, page);
    }
    if (stop.notes) check_fill(stop.notes->text, {file, stop.notes->text_line}, kind, page);
    if (!stop.question) continue;
    check_fill(stop.question->text, {file, stop.question->line}, kind, page);
    for (const Answer& answer : stop.question->answers) {
      check_fill(answer.text, {file, answer.line}, kind, page);
      check_fill(answer.reply, {file, answer.reply_line}, kind, page);
    }
  }
}

void make_printable(Lesson& lesson) {
  for (std::string* line : {&lesson.id, &lesson.title, &lesson.summary, &lesson.theme}) *line = printable(*line);
  const auto mend = [](std::string& text) { text = printable_lines(text); };
  for (Stop& stop : lesson.stops) {
    mend(stop.heading);
    mend(stop.text);
    if (stop.task) {
      mend(stop.task->text), mend(stop.task->now);
      for (std::string& hint : stop.task->hints) mend(hint);
    }
    if (stop.marking) {
      mend(stop.marking->text), mend(stop.marking->why);
      for (std::string& hint : stop.marking->hints) mend(hint);
    }
    if (stop.notes) mend(stop.notes->text);
    if (!stop.question) continue;
    mend(stop.question->text);
    for (Answer& answer : stop.question->answers) mend(answer.text), mend(answer.reply);
  }
}

}  // namespace

Lesson load_lesson(const std::filesystem::path& path) {
  Lesson lesson;
  lesson.path = path;
  lesson.id = id_of(path);
  const std::string file = path.string();
  const std::string text = read_file(path);
  Lines lines{file, split_lines(text, file)};

  if (lines.all.empty() || trim(lines.text()) != "+++")
    throw InputError(file + ":1", "the lesson has no head", "begin with a line +++, then title = \"…\"");
  std::size_t close = 1;
  std::string head;
  while (close < lines.all.size() && trim(lines.all[close].text) != "+++") {
    head += lines.all[close++].text;
    head += '\n';
  }
  if (close == lines.all.size())
    throw InputError(file + ":1", "the head is not closed", "add a second line +++ after it");
  read_lesson_head(lesson, file, head, 2);
  lines.at = close + 1;
  Reader(lesson, lines).read();
  check_stops(lesson, file);
  make_printable(lesson);
  return lesson;
}

}  // namespace zstep
