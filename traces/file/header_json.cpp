#include "traces/file/header_json.hpp"

#include <cmath>

#include "traces/events/vocabulary.hpp"
#include "traces/file/json_members.hpp"

namespace zstep {

using namespace json_members;
using nlohmann::ordered_json;

namespace {

constexpr std::array<std::string_view, 2> depth_words{"pseudodepth", "view"};
constexpr std::array<std::string_view, 2> interpolation_words{"direct", "increments"};
constexpr std::array<std::string_view, 2> coverage_words{"top_left", "inclusive"};

}  // namespace

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
  throw MalformedJson(fmt::format("\"{}\" is not a number (\"inf\", \"-inf\" and \"nan\" are written as texts)", what));
}

ordered_json header_to_json(const Header& header) {
  ordered_json steps = ordered_json::array();
  for (const StepInfo& step : header.page) {
    ordered_json entry;
    entry["id"] = step.id;
    entry["module"] = step.module;
    entry["name"] = step.name;
    for_each_kind([&]<class E>() {
      if (kind_of<E> == step.kind) entry["event"] = kind_text<E>.name;
    });
    entry["indent"] = step.indent;
    entry["text"] = step.text;
    steps.push_back(std::move(entry));
  }
  ordered_json out;
  out["ztrace"] = 1;
  out["writer"] = header.writer;
  out["algorithm"] = header.algorithm;
  out["title"] = header.title;
  out["conventions"] = {
      {"depth", word(header.conventions.depth, depth_words)},
      {"interpolation", word(header.conventions.interpolation, interpolation_words)},
      {"coverage", word(header.conventions.coverage, coverage_words)},
      {"cull", header.conventions.cull},
      {"number_format", "float64"},
      {"pixel_centre", "integer"},
      {"nearer", "smaller"},
      {"ties", "first"},
  };
  for (const auto& [name, value] : header.conventions.options) out["conventions"]["options"][name] = value;
  out["steps"] = std::move(steps);
  return out;
}

Header header_from_json(const json& in) {
  const std::int32_t version = whole(in, "ztrace");
  Header header;
  header.writer = text_or(in, "writer", "an unnamed program");
  if (version != 1)
    throw MalformedJson(
        fmt::format("it has version {} and was written by {}; this zstep reads version 1", version, header.writer));
  header.algorithm = text(in, "algorithm");
  header.title = text_or(in, "title", header.algorithm);
  const json conventions = in.contains("conventions") ? in.at("conventions") : json::object();
  if (!conventions.is_object()) throw MalformedJson("\"conventions\" is not an object");
  header.conventions.depth = word_or(conventions, "depth", depth_words, Conventions::Depth::pseudodepth);
  header.conventions.interpolation =
      word_or(conventions, "interpolation", interpolation_words, Conventions::Interpolation::direct);
  header.conventions.coverage = word_or(conventions, "coverage", coverage_words, Conventions::Coverage::top_left);
  header.conventions.cull = truth_or(conventions, "cull", true);
  if (conventions.contains("options")) {
    const json& options = conventions.at("options");
    if (!options.is_object()) throw MalformedJson("\"options\" is not an object");
    for (const auto& [name, value] : options.items()) {
      if (!value.is_string()) throw MalformedJson(fmt::format("the option \"{}\" is not a text", name));
      header.conventions.options[name] = value.get<std::string>();
    }
  }
  std::array<bool, step_limit> taken{};
  for (const json& entry : list(in, "steps")) {
    StepInfo step;
    const std::int32_t id = whole(entry, "id");
    if (id < 0 || id >= step_limit) throw MalformedJson(fmt::format("step id {} is not below {}", id, step_limit));
    if (taken[static_cast<std::size_t>(id)]) throw MalformedJson(fmt::format("step id {} stands twice", id));
    taken[static_cast<std::size_t>(id)] = true;
    step.id = static_cast<std::uint8_t>(id);
    step.module = text_or(entry, "module", "");
    step.name = text(entry, "name");
    step.text = text_or(entry, "text", step.name);
    const std::int32_t indent = whole_or(entry, "indent", 0);
    if (indent < 0 || indent > 32)
      throw MalformedJson(fmt::format("step \"{}\" is indented {} deep", step.name, indent));
    step.indent = static_cast<std::uint8_t>(indent);
    const std::string kind = text(entry, "event");
    bool known = false;
    for_each_kind([&]<class E>() {
      if (kind_text<E>.name != kind) return;
      step.kind = kind_of<E>;
      known = true;
    });
    if (!known)
      throw MalformedJson(
          fmt::format("step \"{}\" records \"{}\", a kind of event this zstep does not know; {} wrote it", step.name,
                      kind, header.writer));
    header.page.push_back(std::move(step));
  }
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
