#include "sim/homework/step_fields.hpp"

#include <type_traits>

#include <nlohmann/json.hpp>

#include "traces/conventions.hpp"
#include "traces/events/slots.hpp"
#include "traces/events/vocabulary.hpp"

namespace zstep::homework {

namespace {

using Json = nlohmann::ordered_json;

Json schema_of(const StepField& field) {
  Json schema{{"description", field.meaning}};
  switch (field.type) {
    case FieldType::whole:
      schema["type"] = "integer";
      break;
    case FieldType::truth:
      schema["type"] = "boolean";
      break;
    case FieldType::word:
      schema["enum"] = field.words;
      break;
    case FieldType::real:
      schema["anyOf"] = Json::array({{{"type", "number"}}, {{"enum", {"inf", "-inf", "nan"}}}});
      break;
  }
  return schema;
}

Json schema_of(const StepFields& step) {
  Json properties{{"step", {{"const", step.step}}}}, required = Json::array({"step"});
  for (const StepField& field : step.fields) {
    properties[field.name] = schema_of(field);
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
  StepFields found{step.name, "", {}};
  std::uint8_t kind = 0;
  for_each_kind([&]<class E>() {
    if (kind++ != step.kind) return;
    found.meaning = kind_text<E>.meaning;
    for_each_index<E>([&]<std::size_t I>() {
      using Value = FieldValue<E, I>;
      constexpr auto field = field_at<E, I>;
      StepField one{std::string(field.name), FieldType::whole, std::string(field.meaning), {}};
      if constexpr (std::is_enum_v<Value>) {
        one.type = FieldType::word;
        for (const std::string_view word : words_of<Value>) one.words.emplace_back(word);
      } else if constexpr (std::is_same_v<Value, bool>) {
        one.type = FieldType::truth;
      } else if constexpr (std::is_same_v<Value, double>) {
        one.type = FieldType::real;
      }
      found.fields.push_back(std::move(one));
    });
  });
  return found;
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

}  // namespace zstep::homework
