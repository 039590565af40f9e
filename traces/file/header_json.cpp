#include "traces/file/header_json.hpp"

#include <algorithm>
#include <cmath>

#include "traces/events/fields.hpp"
#include "traces/events/vocabulary.hpp"
#include "traces/file/json_text.hpp"

namespace zstep {

using namespace json_members;
using nlohmann::ordered_json;

namespace {

constexpr const char* axes_key = "view_coordinates";
constexpr std::array<std::string_view, 2> nearer_words{"smaller", "greater"};
constexpr std::array<std::string_view, 2> tie_words{"first", "last"};

/// Which numbers they are is then found out from their digits, as where the header has none.
constexpr std::string_view as_computed = "as computed";
constexpr auto number_words = [] {
  std::array<std::string_view, words_of<NumberFormat>.size() + 1> words{};
  std::copy(words_of<NumberFormat>.begin(), words_of<NumberFormat>.end(), words.begin());
  words.back() = as_computed;
  return words;
}();

/// In the order in which a header has them.
constexpr ByEnum<Convention, std::string_view, 8> convention_keys{"depth",         "interpolation", "coverage", "cull",
                                                                  "number_format", "pixel_centre",  "nearer",   "ties"};
// An array takes a list that is too short, and leaves the rest empty.
static_assert(!convention_keys.back().empty());
constexpr std::string_view key_of(Convention convention) { return convention_keys[convention]; }

ordered_json conventions_to_json(const Header& header) {
  const Conventions& c = header.conventions;
  ordered_json out = ordered_json::object();
  const auto put = [&](Convention which, ordered_json value) {
    if (header.declares(which)) out[std::string(key_of(which))] = std::move(value);
  };
  put(Convention::depth, word_of(c.depth));
  put(Convention::interpolation, word_of(c.interpolation));
  put(Convention::coverage, word_of(c.coverage));
  put(Convention::cull, c.cull);
  put(Convention::number_format, word_of(c.number_format));
  // These are stated where they differ from what every program does that does not think of them.
  if (c.rounding != Conventions{}.rounding) out["rounding"] = word_of(c.rounding);
  if (c.positions != Conventions{}.positions) out["positions"] = word_of(c.positions);
  if (c.attribute != Conventions{}.attribute) out["attribute"] = word_of(c.attribute);
  if (header.written.axes != WrittenAs{}.axes) out[axes_key] = word_of(header.written.axes);
  put(Convention::pixel_centre, word_of(header.written.centre));
  put(Convention::nearer, word(header.comparison.nearer, nearer_words));
  put(Convention::ties, word(header.comparison.ties, tie_words));
  if (header.initial_depth) out["initial_depth"] = real_to_json(*header.initial_depth);
  for (const auto& [name, value] : c.options) out["options"][name] = value;
  return out;
}

void read_options(const json& in, Conventions& conventions) {
  if (!in.contains("options")) return;
  const json& options = in.at("options");
  if (!options.is_object()) throw MalformedJson(in, "options", "\"options\" is not an object");
  for (const auto& [name, value] : options.items()) {
    if (!value.is_string()) throw MalformedJson(options, name, fmt::format("the option \"{}\" is not a text", name));
    conventions.options[name] = value.get<std::string>();
  }
}

void read_conventions(const json& in, Header& header) {
  Conventions& c = header.conventions;
  Parts parts;
  parts.read([&] {
    known_keys(in, "\"conventions\"",
               {"depth", "interpolation", "coverage", "cull", "number_format", "rounding", "positions", "attribute",
                axes_key, "pixel_centre", "nearer", "ties", "initial_depth", "options"});
  });
  for_each_convention([&]<class E>(const char* key, E Conventions::*member) {
    static_assert(!words_of<E>.back().empty(), "fewer words than values");
    parts.read([&] {
      if constexpr (!std::is_same_v<E, NumberFormat>) c.*member = word_or(in, key, words_of<E>, c.*member);
      else if (const auto number = word_or(in, key, number_words, std::size_t{0}); number < words_of<E>.size())
        c.*member = values_of<E>[number];
      else header.undeclared |= bit_of(Convention::number_format);
    });
  });
  parts.read([&] { c.cull = truth_or(in, "cull", c.cull); });
  WrittenAs& written = header.written;
  parts.read([&] { written.centre = word_or(in, "pixel_centre", words_of<WrittenAs::Centre>, written.centre); });
  parts.read([&] { written.axes = word_or(in, axes_key, words_of<WrittenAs::Axes>, written.axes); });
  parts.read([&] { header.comparison.nearer = word_or(in, "nearer", nearer_words, header.comparison.nearer); });
  parts.read([&] { header.comparison.ties = word_or(in, "ties", tie_words, header.comparison.ties); });
  parts.read([&] {
    if (!in.contains("initial_depth")) return;
    header.initial_depth = real(in, "initial_depth");
    if (std::isnan(*header.initial_depth)) throw MalformedJson(in, "initial_depth", "\"initial_depth\" is no number");
  });
  parts.read([&] { read_options(in, c); });
  parts.done();
  for (std::size_t k = 0; k < convention_keys.size(); ++k)
    if (!in.contains(std::string(convention_keys[k]))) header.undeclared |= static_cast<std::uint8_t>(1u << k);
}

std::uint8_t kind_named(const json& entry, const std::string& step, const std::string& writer) {
  const std::string kind = text(entry, "event");
  const auto names = kind_names();
  const auto found = std::find(names.begin(), names.end(), kind);
  if (found != names.end()) return static_cast<std::uint8_t>(found - names.begin());
  const std::string_view near = near_word(kind, names);
  throw MalformedJson(entry, "event",
                      fmt::format("step \"{}\" records \"{}\", a kind of event this zstep does not know; {} wrote it",
                                  step, kind, writer),
                      near.empty() ? "" : fmt::format("did you mean \"{}\"? docs/trace-format.md has them all", near));
}

StepInfo step_from_json(const json& entry, const std::string& writer, std::array<bool, step_limit>& taken) {
  known_keys(entry, "a step", {"id", "module", "name", "event", "indent", "text"});
  StepInfo step;
  const std::int32_t id = whole(entry, "id");
  if (id < 0 || id >= step_limit)
    throw MalformedJson(entry, "id", fmt::format("step id {} is not below {}", id, step_limit));
  if (taken[id]) throw MalformedJson(entry, "id", fmt::format("step id {} stands twice", id));
  taken[id] = true;
  step.id = static_cast<std::uint8_t>(id);
  step.module = text_or(entry, "module", "");
  step.name = text(entry, "name");
  step.text = text_or(entry, "text", step.name);
  const std::int32_t indent = whole_or(entry, "indent", 0);
  if (indent < 0 || indent > 32)
    throw MalformedJson(entry, "indent", fmt::format("step \"{}\" is indented {} deep", step.name, indent));
  step.indent = static_cast<std::uint8_t>(indent);
  step.kind = kind_named(entry, step.name, writer);
  return step;
}

}  // namespace

std::string_view Comparison::sign() const {
  if (nearer == Nearer::smaller) return ties == Ties::first ? "<" : "\u2264";
  return ties == Ties::first ? ">" : "\u2265";
}

json parse_bounded(const std::string& text) {
  constexpr std::size_t short_text = 4096;
  constexpr int nesting_limit = 8;
  if (text.size() <= short_text) return json::parse(text);
  return json::parse(text, [](int depth, json::parse_event_t, json&) {
    if (depth > nesting_limit) throw MalformedJson("it is nested too deeply");
    return true;
  });
}

ordered_json real_to_json(double value) {
  if (std::isnan(value)) return "nan";
  if (std::isinf(value)) return value > 0 ? "inf" : "-inf";
  return value;
}

double real_from_json(const json& value, const char* what) {
  if (value.is_number()) return value.get<double>();
  if (value == "inf") return no_depth;
  if (value == "-inf") return -no_depth;
  if (value == "nan") return std::nan("");
  throw MalformedJson(value, "",
                      fmt::format("\"{}\" is not a number (\"inf\", \"-inf\" and \"nan\" are written as texts)", what));
}

ordered_json header_to_json(const Header& header) {
  ordered_json steps = ordered_json::array();
  for (const StepInfo& step : header.page) {
    ordered_json entry;
    entry["id"] = step.id;
    entry["module"] = step.module;
    entry["name"] = step.name;
    entry["event"] = description_of_kind(step.kind).name;
    entry["indent"] = step.indent;
    entry["text"] = step.text;
    steps.push_back(std::move(entry));
  }
  ordered_json out;
  out["ztrace"] = 1;
  out["writer"] = header.writer;
  out["algorithm"] = header.algorithm;
  out["title"] = header.title;
  out["conventions"] = conventions_to_json(header);
  out["steps"] = std::move(steps);
  return out;
}

Header header_from_json(const json& in, const Header* defaults) {
  const std::int32_t version = whole(in, "ztrace");
  Header header;
  header.writer = text_or(in, "writer", "an unnamed program");
  if (version != 1)
    throw MalformedJson(
        in, "ztrace",
        fmt::format("it has version {} and was written by {}; this zstep reads version 1", version, header.writer));
  Parts parts;
  parts.read([&] {
    known_keys(in, "a trace's header", {"ztrace", "writer", "algorithm", "title", "conventions", "steps", "scene"});
  });
  parts.read([&] {
    header.algorithm = defaults ? text_or(in, "algorithm", defaults->algorithm) : text(in, "algorithm");
    header.title = text_or(in, "title", header.algorithm);
  });
  static const json none = json::object();
  parts.read([&] { read_conventions(in.contains("conventions") ? in.at("conventions") : none, header); });
  std::array<bool, step_limit> taken{};
  parts.read([&] {
    if (defaults && !in.contains("steps")) {
      header.page = defaults->page;
      return;
    }
    for (const json& entry : list(in, "steps"))
      parts.read([&] { header.page.push_back(step_from_json(entry, header.writer, taken)); });
  });
  parts.done();
  return header;
}

const StepInfo* find_step(const Page& page, std::uint8_t id) {
  for (const StepInfo& step : page) {
    if (step.id == id) return &step;
  }
  return nullptr;
}

const StepInfo* find_step(const Page& page, std::string_view name) {
  for (const StepInfo& step : page) {
    if (step.name == name || (name.size() == step.module.size() + 1 + step.name.size() &&
                              name.substr(0, step.module.size()) == step.module && name[step.module.size()] == '.' &&
                              name.substr(step.module.size() + 1) == step.name)) {
      return &step;
    }
  }
  return nullptr;
}

}  // namespace zstep
