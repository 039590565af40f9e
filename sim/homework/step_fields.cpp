#include "sim/homework/step_fields.hpp"

#include <nlohmann/json.hpp>

#include "traces/conventions.hpp"

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

}  // namespace zstep::homework
