
#include "sim/homework/emitters.hpp"

#include <algorithm>
#include <utility>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "sim/homework/emitter_texts.hpp"
#include "traces/conventions.hpp"
#include "traces/file/jsonl.hpp"
#include "traces/file/source_places.hpp"
#include "traces/text.hpp"

namespace zstep::homework {

namespace {

using Json = nlohmann::ordered_json;

Json schema_of(const FieldOfKind& field) {
  Json schema{{"description", field.meaning}};
  switch (field.type) {
    case FieldOfKind::Type::whole:
      schema["type"] = "integer";
      break;
    case FieldOfKind::Type::truth:
      schema["type"] = "boolean";
      break;
    case FieldOfKind::Type::word:
      schema["enum"] = field.words;
      break;
    case FieldOfKind::Type::real:
      schema["anyOf"] = Json::array({{{"type", "number"}}, {{"enum", {"inf", "-inf", "nan"}}}});
      break;
  }
  return schema;
}

Json schema_of(const StepFields& step) {
  Json properties{{"step", {{"const", step.step}}}}, required = Json::array({"step"});
  for (const FieldOfKind& field : step.fields) {
    properties[std::string(field.name)] = schema_of(field);
    required.push_back(field.name);
  }
  properties[at_key] = {{"description", "the place in the program that printed the step, as raster.cpp:417"},
                        {"type", "string"},
                        {"minLength", 1},
                        {"maxLength", SourcePlaces::longest}};
  return {{"description", step.meaning},
          {"type", "object"},
          {"properties", properties},
          {"required", required},
          {"additionalProperties", false}};
}

}  // namespace

StepFields fields_of_step(const StepInfo& step) {
  return {step.name, std::string(description_of_kind(step.kind).meaning), fields_of_kind(step.kind)};
}

std::string run_schema(const std::vector<StepInfo>& steps) {
  Json names = Json::array(), cases = Json::array(), definitions;
  for (const StepInfo& step : steps) {
    const StepFields fields = fields_of_step(step);
    names.push_back(fields.step);
    definitions[fields.step] = schema_of(fields);
    cases.push_back({{"if", {{"properties", {{"step", {{"const", fields.step}}}}}}},
                     {"then", {{"$ref", "#/$defs/" + fields.step}}}});
  }
  Json conventions;
  const auto one_of = [&](std::string_view key, Json words) {
    conventions[std::string(key)] = {{"enum", std::move(words)}};
  };
  for_each_convention([&]<class E>(std::string_view key, E Conventions::*) {
    Json words = words_of<E>;
    if constexpr (std::is_same_v<E, NumberFormat>) words.push_back("as computed");
    one_of(key, words);
  });
  one_of("pixel_centre", words_of<WrittenAs::Centre>), one_of("view_coordinates", words_of<WrittenAs::Axes>);
  one_of("nearer", {"smaller", "greater"}), one_of("ties", {"first", "last"});
  conventions["cull"] = {{"type", "boolean"}};
  conventions["initial_depth"] = {{"anyOf", Json::array({{{"type", "number"}}, {{"enum", {"inf", "-inf"}}}})}};
  conventions["options"] = {{"type", "object"}, {"additionalProperties", {{"type", "string"}}}};
  definitions["header"] = {
      {"description", "the first line, where a program declares how it computes"},
      {"type", "object"},
      {"properties",
       {{"ztrace", {{"const", 1}}},
        {"conventions", {{"type", "object"}, {"properties", conventions}, {"additionalProperties", false}}}}},
      {"required", {"ztrace"}}};
  definitions["any_step"] = {
      {"type", "object"}, {"properties", {{"step", {{"enum", names}}}}}, {"required", {"step"}}, {"allOf", cases}};
  const Json schema{{"$schema", "https://json-schema.org/draft/2020-12/schema"},
                    {"title", "A line of a run"},
                    {"if", {{"type", "object"}, {"required", {"ztrace"}}}},
                    {"then", {{"$ref", "#/$defs/header"}}},
                    {"else", {{"$ref", "#/$defs/any_step"}}},
                    {"$defs", definitions}};
  return schema.dump(1) + "\n";
}

namespace {

/// A step's function.
struct Call {
  std::string function, label;  ///< "compare", and how a run names the step: with its module where two have the name
  StepFields of;
  std::span<const std::string_view> reserved;  ///< words of the language that fields may be called

  /// The name of a field's parameter.
  std::string parameter(const FieldOfKind& field) const {
    const bool taken = std::find(reserved.begin(), reserved.end(), field.name) != reserved.end();
    return std::string(field.name) + (taken ? "_" : "");
  }
};

/// "int x, int y, double z" — or without types.
template <class Text>
std::string listed(std::span<const FieldOfKind> parameters, Text&& text, std::string_view between = ", ") {
  std::string all;
  for (const FieldOfKind& one : parameters) all += (all.empty() ? "" : std::string(between)) + text(one);
  return all;
}
std::string name_of(const FieldOfKind& one) { return std::string(one.name); }
/// ", x, y, z": behind other arguments.
template <class Text>
std::string listed_behind(std::span<const FieldOfKind> parameters, Text&& text) {
  return (parameters.empty() ? "" : ", ") + listed(parameters, text);
}
using Texts = ByEnum<FieldOfKind::Type, std::string_view, 4>;

std::string in_c(const Call& call) {
  constexpr Texts types{"int", "double", "int", "const char*"};
  const std::string fields = listed(
      call.of.fields, [](const FieldOfKind& one) { return fmt::format("{}:{}", one.name, "irbw"[index_of(one.type)]); },
      " ");
  return fmt::format("#define $name_{}({}) $NAME_STEP(\"{}\", \"{}\"{})\n", call.function,
                     listed(call.of.fields, name_of), call.label, fields,
                     listed_behind(call.of.fields, [&](const FieldOfKind& one) {
                       return fmt::format("({})({})", types[one.type], one.name);
                     }));
}

std::string in_cpp(const Call& call) {
  constexpr Texts types{"int", "double", "bool", "const char*"};
  std::string parameters =
      listed(call.of.fields, [&](const FieldOfKind& one) { return fmt::format("{} {}", types[one.type], one.name); });
  parameters += parameters.empty() ? "" : ", ";
  return fmt::format(
      "/// {}\ninline void {}({}Place at = {{__builtin_FILE(), __builtin_LINE()}}) {{\n"
      "  if (on) step(\"{}\", at{});\n}}\n",
      call.of.meaning, call.function, parameters, call.label, listed_behind(call.of.fields, [](const FieldOfKind& one) {
        return fmt::format("Field{{\"{0}\", {0}}}", one.name);
      }));
}

/// On one line where there is room.
std::string on_one_line(const std::string& head, std::string_view between, const std::string& body) {
  const bool fits = head.size() + 1 + body.size() <= 120;
  return head + (fits ? " " : std::string(between)) + body + "\n";
}

std::string in_python(const Call& call) {
  constexpr Texts values{"_whole({})", "_real({})", "bool({})", "{}"};
  const auto parameter = [&](const FieldOfKind& one) { return call.parameter(one); };
  const std::string fields = listed(call.of.fields, [&](const FieldOfKind& one) {
    return fmt::format("\"{}\": {}", one.name, fmt::format(fmt::runtime(values[one.type]), parameter(one)));
  });
  return on_one_line(fmt::format("def {}({}):", call.function, listed(call.of.fields, parameter)),
                     fmt::format("  # {}\n    ", call.of.meaning),
                     fmt::format("_step(\"{}\", {{{}}})", call.label, fields));
}

std::string in_javascript(const Call& call) {
  return fmt::format("exports.{} = ({}) => step(\"{}\", {{ {} }});\n", call.function, listed(call.of.fields, name_of),
                     call.label, listed(call.of.fields, name_of));
}

std::string in_java(const Call& call) {
  constexpr Texts types{"int", "double", "boolean", "String"};
  std::string name;
  for (std::size_t i = 0; i < call.function.size(); ++i)
    if (call.function[i] != '_')
      name += i > 0 && call.function[i - 1] == '_' ? upper_case(call.function[i]) : call.function[i];
  const std::string parameters =
      listed(call.of.fields, [&](const FieldOfKind& one) { return fmt::format("{} {}", types[one.type], one.name); });
  const std::string values =
      listed_behind(call.of.fields, [](const FieldOfKind& one) { return fmt::format("\"{0}\", {0}", one.name); });
  return on_one_line(fmt::format("  static void {}({}) {{", name, parameters), "\n    ",
                     fmt::format("step(\"{}\"{}); }}", call.label, values));
}

std::string in_rust(const Call& call) {
  constexpr Texts types{"i32", "f64", "bool", "&str"}, values{"Whole", "Real", "Truth", "Word"};
  const std::string parameters = listed(call.of.fields, [&](const FieldOfKind& one) {
    return fmt::format("{}: {}", call.parameter(one), types[one.type]);
  });
  return fmt::format("/// {}\n#[track_caller]\npub fn {}({}) {{\n    step(\"{}\", &[{}]);\n}}\n", call.of.meaning,
                     call.function, parameters, call.label, listed(call.of.fields, [&](const FieldOfKind& one) {
                       return fmt::format("(\"{}\", Value::{}({}))", one.name, values[one.type], call.parameter(one));
                     }));
}

/// A text as a language writes it, in pieces: no compiler has to take a long one. What is beyond ASCII is written as
/// JSON does, which the text is.
std::string in_pieces(const std::string& json) {
  constexpr std::size_t most = 80;
  std::string pieces;
  for (std::size_t at = 0; at < json.size(); at += most) {
    std::string piece;
    for (const char c : json.substr(at, most))
      piece += c == '"' || c == '\\' ? std::string("\\") + c : std::string(1, c);
    pieces += fmt::format("\n  \"{}\",", piece);
  }
  return pieces;
}

struct LanguageParts {
  std::string_view begin, header, header_given, end;
  std::string (*function)(const Call&);
  std::vector<std::string_view> reserved;  ///< that a step or a field may be called
};
LanguageParts parts_of(Language language) {
  using namespace emitter_texts;
  switch (language) {
    case Language::c:
      return {c_begin, c_header, "", "#endif\n", in_c, {}};
    case Language::cpp:
      return {cpp_begin, cpp_header, "", "\n}  // namespace $name\n", in_cpp, {}};
    case Language::javascript:
      return {javascript_begin, javascript_header, "", "", in_javascript, {}};
    case Language::java:
      return {java_begin, java_header, java_header_given, "}\n", in_java, {}};
    case Language::rust:
      return {rust_begin, rust_header, rust_header_given, "", in_rust, {"box", "move"}};
    case Language::python:
      break;
  }
  return {python_begin, python_header, "", "", in_python, {"pass"}};
}

void replace_all(std::string& text, std::string_view what, std::string_view by) {
  for (std::size_t at = text.find(what); at != std::string::npos; at = text.find(what, at + by.size()))
    text.replace(at, what.size(), by);
}

std::vector<Call> calls_of(const std::vector<StepInfo>& steps, std::span<const std::string_view> reserved) {
  std::vector<Call> calls;
  for (const StepInfo& step : steps) {
    const auto same = std::count_if(steps.begin(), steps.end(), [&](const StepInfo& s) { return s.name == step.name; });
    Call call{step.name, step_label(steps, step), fields_of_step(step), reserved};
    if (same > 1) call.function = step.module + "_" + step.name;
    if (std::find(reserved.begin(), reserved.end(), call.function) != reserved.end()) call.function += "_";
    calls.push_back(std::move(call));
  }
  return calls;
}

}  // namespace

std::string emitter_file(Language language, std::string_view name) {
  const std::string file = fmt::format("{}.{}", name, languages[index_of(language)].extension);
  return language == Language::java ? with_capital(file) : file;
}

std::string emitter(Language language, const std::vector<StepInfo>& steps, const std::optional<std::string>& header,
                    std::string_view name) {
  const LanguageParts parts = parts_of(language);
  std::string text(parts.begin);
  for (const Call& call : calls_of(steps, parts.reserved)) text += parts.function(call);
  if (header) text += parts.header;
  if (header && !header->empty()) text += parts.header_given;
  text += parts.end;
  std::string upper, title(name);
  for (const char c : name) upper += upper_case(c);
  title[0] = upper[0];
  replace_all(text, "$name", name);
  replace_all(text, "$NAME", upper);
  replace_all(text, "$Name", title);
  const std::string pieces = in_pieces(header.value_or(""));
  replace_all(text, "$header0", pieces + "0");
  replace_all(text, "$header", pieces);
  return text;
}

}  // namespace zstep::homework
