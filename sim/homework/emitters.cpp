
#include "sim/homework/emitters.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "traces/conventions.hpp"
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
  for_each_convention([&](std::string_view key, auto) { conventions[std::string(key)] = Json::object(); });
  definitions["header"] = {
      {"description", "the first line, where a program declares how it computes"},
      {"type", "object"},
      {"properties", {{"ztrace", {{"const", 1}}}, {"conventions", {{"type", "object"}, {"properties", conventions}}}}},
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

/// "int x, int y, double z" — or without types.
template <class Text>
std::string listed(std::span<const FieldOfKind> parameters, Text&& text, std::string_view between = ", ") {
  std::string all;
  for (const FieldOfKind& one : parameters) all += (all.empty() ? "" : std::string(between)) + text(one);
  return all;
}
std::string name_of(const FieldOfKind& one) { return std::string(one.name); }

std::string in_c(const StepFields& f) {
  constexpr ByEnum<FieldOfKind::Type, std::string_view, 4> types{"int", "double", "int", "const char*"};
  const std::string parameters =
      listed(f.fields, [&](const FieldOfKind& one) { return fmt::format("{} {}", types[one.type], one.name); });
  const std::string fields = listed(
      f.fields, [](const FieldOfKind& one) { return fmt::format("{}:{}", one.name, "irbw"[index_of(one.type)]); }, " ");
  const std::string head =
                        fmt::format("static inline void emit_{}({})", f.step, parameters.empty() ? "void" : parameters),
                    body = fmt::format("emit_step(\"{}\", \"{}\"{}{});", f.step, fields, f.fields.empty() ? "" : ", ",
                                       listed(f.fields, name_of));
  const bool short_enough = head.size() + body.size() + 5 <= 120;
  return head + (short_enough ? " { " + body + " }\n" : " {\n  " + body + " }\n");
}

std::string in_python(const StepFields& f) {
  return fmt::format("def {}({}):  # {}\n    _step(\"{}\"{}{})\n", f.step, listed(f.fields, name_of), f.meaning, f.step,
                     f.fields.empty() ? "" : ", ",
                     listed(f.fields, [](const FieldOfKind& one) { return fmt::format("{0}={0}", one.name); }));
}

std::string in_javascript(const StepFields& f) {
  return fmt::format("exports.{} = ({}) => step(\"{}\", {{ {} }});\n", f.step, listed(f.fields, name_of), f.step,
                     listed(f.fields, name_of));
}

std::string in_java(const StepFields& f) {
  constexpr ByEnum<FieldOfKind::Type, std::string_view, 4> types{"int", "double", "boolean", "String"};
  std::string name;
  for (std::size_t i = 0; i < f.step.size(); ++i)
    if (f.step[i] != '_') name += i > 0 && f.step[i - 1] == '_' ? upper_case(f.step[i]) : f.step[i];
  const std::string parameters =
      listed(f.fields, [&](const FieldOfKind& one) { return fmt::format("{} {}", types[one.type], one.name); });
  return fmt::format("  static void {}({}) {{\n    step(\"{}\"{}{}); }}\n", name, parameters, f.step,
                     f.fields.empty() ? "" : ", ",
                     listed(f.fields, [](const FieldOfKind& one) { return fmt::format("\"{0}\", {0}", one.name); }));
}

constexpr std::string_view c_begin =
    R"(/* Writes a run, a line a step, to standard output; zstep grades it. Depths may be INFINITY. C99 and C++. */
#ifndef EMIT_H
#define EMIT_H
#include <math.h>
#include <stdarg.h>
#include <stdio.h>

/* fields: "x:i z:r nearer:b why:w": int, double, 0 or 1, text */
static inline void emit_step(const char* step, const char* fields, ...) {
  va_list values;
  va_start(values, fields);
  printf("{\"step\":\"%s\"", step);
  while (*fields) {
    printf(",\"");
    while (*fields != ':') putchar(*fields++);
    printf("\":");
    if (fields[1] == 'i') printf("%d", va_arg(values, int));
    if (fields[1] == 'b') printf(va_arg(values, int) ? "true" : "false");
    if (fields[1] == 'w') printf("\"%s\"", va_arg(values, const char*));
    if (fields[1] == 'r') {
      double value = va_arg(values, double);
      if (isinf(value)) printf(value > 0 ? "\"inf\"" : "\"-inf\"");
      else if (isnan(value)) printf("\"nan\"");
      else printf("%.17g", value);
    }
    fields += fields[2] == ' ' ? 3 : 2;
  }
  va_end(values);
  printf("}\n");
}

)";
constexpr std::string_view python_begin =
    R"("""Writes a run, a line a step, to standard output; zstep grades it. Depths may be math.inf."""
import json
import math

def _step(name, **fields):
    for key, value in fields.items():
        if isinstance(value, float) and not math.isfinite(value):
            fields[key] = str(value)
    print(json.dumps({"step": name, **fields}))

)";
constexpr std::string_view javascript_begin =
    R"(// Writes a run, a line a step, to standard output; zstep grades it. Depths may be Infinity.
const numbers = { Infinity: "inf", "-Infinity": "-inf", NaN: "nan" };

function step(name, fields) {
  const line = JSON.stringify({ step: name, ...fields }, (key, value) =>
    typeof value === "number" && !Number.isFinite(value) ? numbers[value] : value);
  process.stdout.write(line + "\n");
}

)";
constexpr std::string_view java_begin =
    R"(/** Writes a run, a line a step, to standard output; zstep grades it. Depths may be infinite. */
final class Emit {
  private Emit() {}

  private static String text(Object value) {
    if (value instanceof String) return "\"" + value + "\"";
    if (!(value instanceof Double)) return value.toString();
    double real = (Double) value;
    if (Double.isNaN(real)) return "\"nan\"";
    return Double.isInfinite(real) ? (real > 0 ? "\"inf\"" : "\"-inf\"") : value.toString();
  }
  private static void step(String name, Object... fields) {
    StringBuilder line = new StringBuilder("{\"step\":\"" + name + "\"");
    for (int i = 0; i < fields.length; i += 2) line.append(",\"" + fields[i] + "\":" + text(fields[i + 1]));
    System.out.println(line.append("}"));
  }

)";

}  // namespace

std::string emitter(Language language, const std::vector<StepInfo>& steps) {
  std::string text;
  const auto all = [&](std::string_view begin, auto function, std::string_view end) {
    text = begin;
    for (const StepInfo& step : steps) text += function(fields_of_step(step));
    text += end;
  };
  switch (language) {
    case Language::c:
      all(c_begin, in_c, "\n#endif\n");
      break;
    case Language::python:
      all(python_begin, in_python, "");
      break;
    case Language::javascript:
      all(javascript_begin, in_javascript, "");
      break;
    case Language::java:
      all(java_begin, in_java, "}\n");
      break;
  }
  while (text.ends_with("\n\n")) text.pop_back();
  return text;
}

}  // namespace zstep::homework
