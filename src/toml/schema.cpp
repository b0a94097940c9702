#include "src/toml/schema.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "src/toml/keys_page.hpp"

namespace barchan {
namespace {

using Json = nlohmann::ordered_json;

constexpr const char* kLength =
    R"(^\s*[-+]?[0-9.]+([eE][-+]?[0-9]+)?\s*(d|m|cm|mm|um)\s*$)";  // "3 d", "0.2 mm"

Json one_of(const Json::array_t& kinds) { return {{"anyOf", kinds}}; }

Json array_of(const Json& element, std::size_t count) {
  return {{"type", "array"}, {"items", element}, {"minItems", count}, {"maxItems", count}};
}

/// Schema of a number in its range, or of a length with its unit.
Json number_in(const Key& key, Form::Of of) {
  const bool whole = of != Form::Of::number;
  const Range& range = key.range;
  Json number{{"type", whole ? "integer" : "number"}};
  const auto bound = [&](double value) { return whole ? Json(std::int64_t(value)) : Json(value); };
  if (range.min > -Range::infinite)
    number["minimum"] = bound(range.min);
  else if (of == Form::Of::natural)
    number["minimum"] = 0;
  if (range.above_min) number["exclusiveMinimum"] = true;
  if (range.max < Range::infinite) number["maximum"] = bound(range.max);
  if (range.below_max) number["exclusiveMaximum"] = true;
  if (key.unit != "m") return number;
  return one_of({number, {{"type", "string"}, {"pattern", kLength}}});
}

Json schema_of(const Key& key, const Form& form);

Json single(const Key& key, const Form& form) {
  Json::array_t parts;
  for (const Form& part : form.parts) parts.push_back(schema_of(key, part));
  switch (form.of) {
    case Form::Of::choice:
      return {{"enum", form.names}};
    case Form::Of::truth:
      return {{"type", "boolean"}};
    case Form::Of::integer:
    case Form::Of::natural:
    case Form::Of::number:
      return number_in(key, form.of);
    case Form::Of::positive:
      return {{"type", "integer"}, {"minimum", 1}};
    case Form::Of::text: {
      Json text{{"type", "string"}};
      if (key.range.max < Range::infinite) text["maxLength"] = std::int64_t(key.range.max);
      return text;
    }
    case Form::Of::any_of:
      return one_of(parts);
    case Form::Of::list:
      return {{"type", "array"}, {"items", parts.front()}};
    case Form::Of::tuple:
      return array_of(parts, parts.size());
  }
  return Json::object();
}

Json schema_of(const Key& key, const Form& form) {
  return form.count > 0 ? array_of(single(key, form), form.count) : single(key, form);
}

Json schema_of(const Section& section, const Key& key, const Config& defaults) {
  Json value = schema_of(key, key.form);
  if (key.by_default == kAutomatic) value = one_of({value, {{"enum", Json::array({kAutomatic})}}});
  const std::string unit = key.unit.empty() ? "" : fmt::format(" [{}]", key.unit);
  const std::string like = section.like.empty() || !key.by_default.empty()
                               ? ""
                               : fmt::format("; default as in `[{}]`", section.like);
  value["description"] = key.meaning + unit + like;
  const std::string text = key.text(defaults, 0).value_or("");
  const Json preset = key.by_default.empty() ? Json::parse(text, nullptr, false)
                                             : Json(key.by_default);  // values of TOML are of JSON
  const bool none = key.by_default == kNoDefault || preset.is_discarded() || preset == "" ||
                    preset == Json::array();
  if (like.empty() && !key.required && !none) value["default"] = preset;
  return value;
}

/// Sections directly within one ("": the file).
std::vector<const Section*> inner_of(const std::string& outer, const Sections& table) {
  std::vector<const Section*> inner;
  for (const Section& section : table) {
    const std::size_t dot = section.name.rfind('.');
    if ((dot == section.name.npos ? "" : section.name.substr(0, dot)) == outer)
      inner.push_back(&section);
  }
  return inner;
}

std::string last_name(const Section& section) {
  return section.name.substr(section.name.rfind('.') + 1);
}

Json required_keys(const Section& section) {
  Json names = Json::array();
  for (const Key& key : section.keys) {
    if (key.required) names.push_back(key.name);
  }
  return names;
}

Json object_of(const Section& section, const Sections& table, const Config& defaults) {
  Json keys = Json::object();
  for (const Key& key : section.keys) keys[key.name] = schema_of(section, key, defaults);
  for (const Section* inner : inner_of(section.name, table)) {
    Json part = object_of(*inner, table, defaults);
    if (inner->repeated()) {
      const Json names = required_keys(*inner);
      if (!names.empty()) part["required"] = names;
      part = {{"type", "array"}, {"items", part}};
      if (inner->most < 1'000'000) part["maxItems"] = inner->most;
    }
    Json& place = keys[last_name(*inner)];
    place = place.is_null() ? part : one_of({place, part});
  }
  Json object{{"type", "object"}, {"additionalProperties", false}, {"properties", keys}};
  if (!section.meaning.empty()) object["description"] = section.meaning;
  return object;
}

/// Requirements of a section, unless the case takes over another one.
Json required_in(const Section& section, const Sections& table) {
  Json names = required_keys(section), parts = Json::object();
  for (const Section* inner : inner_of(section.name, table)) {
    if (inner->repeated()) continue;
    if (inner->required) names.push_back(last_name(*inner));
    if (const Json part = required_in(*inner, table); !part.empty())
      parts[last_name(*inner)] = part;
  }
  Json rule = Json::object();
  if (!names.empty()) rule["required"] = names;
  if (!parts.empty()) rule["properties"] = parts;
  return rule;
}

}  // namespace

std::string case_schema(const Sections& table) {
  const Section file{.name = ""};
  Json schema{{"$schema", "http://json-schema.org/draft-04/schema#"},
              {"title", "A case of Barchan"}};
  schema.update(object_of(file, table, *with_every_section(table)));
  const Json based{{"required", Json::array({"case"})},
                   {"properties", {{"case", {{"required", Json::array({"base"})}}}}}};
  schema.update(one_of({required_in(file, table), based}));
  return schema.dump(2) + "\n";
}

}  // namespace barchan
