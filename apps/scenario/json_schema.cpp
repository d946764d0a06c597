// SPDX-License-Identifier: GPL-3.0-or-later
#include "apps/scenario/json_schema.hpp"

#include "apps/scenario/key_list.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace plekton::apps {
namespace {

using Json = nlohmann::ordered_json;
using Kind = ValueType::Kind;
using Chosen = std::map<std::string, std::string>;

/// A number in SI units within a range.
Json number_in(const Range& range) {
  Json schema{{"type", "number"}};
  if (std::isfinite(range.low)) schema[range.with_low ? "minimum" : "exclusiveMinimum"] = range.low;
  if (std::isfinite(range.high))
    schema[range.with_high ? "maximum" : "exclusiveMaximum"] = range.high;
  return schema;
}

/// A number in SI units, or a text with a unit.
Json quantity_schema(const Quantity& quantity, const std::vector<std::string>& words) {
  Json alternatives = Json::array({number_in(quantity.range)});
  alternatives.push_back({{"type", "string"}, {"pattern", R"(^[ \t]*[+-]?[.0-9])"}});
  if (!words.empty()) alternatives.push_back({{"enum", words}});
  return {{"anyOf", std::move(alternatives)}};
}

Json list_of(Json item, std::size_t least, std::size_t most) {
  Json schema{{"type", "array"}, {"items", std::move(item)}, {"minItems", least}};
  if (most > 0) schema["maxItems"] = most;
  return schema;
}

/// A list whose entries have a schema each.
Json tuple_of(Json items) {
  const std::size_t count = items.size();
  return {
      {"type", "array"}, {"prefixItems", std::move(items)}, {"items", false}, {"minItems", count}};
}

Json whole_number_schema(std::int64_t low, std::int64_t high) {
  return {{"type", "integer"}, {"minimum", low}, {"maximum", high}};
}

Json whole_numbers_schema(const ValueType& type) {
  Json items = Json::array();
  for (const std::int64_t low : type.low) items.push_back(whole_number_schema(low, type.high));
  return tuple_of(std::move(items));
}

Json schema_of(const ValueType& type);

Json table_schema(const ValueType& type) {
  Json schema{{"type", "object"}};
  if (type.members.empty()) return schema;
  for (const auto& [name, member] : type.members) {
    schema["properties"][name] = schema_of(member);
    schema["required"].push_back(name);
  }
  schema["additionalProperties"] = false;
  return schema;
}

Json schema_of(const ValueType& type) {
  switch (type.kind) {
    case Kind::quantity:
      return quantity_schema(type.quantity, type.words);
    case Kind::quantities:
      return list_of(quantity_schema(type.quantity, {}), 1, 0);
    case Kind::vector:
      return list_of(quantity_schema(type.quantity, {}), 3, 3);
    case Kind::vectors:
      return list_of(list_of(quantity_schema(type.quantity, {}), 3, 3), type.least, 0);
    case Kind::pairs:
      return list_of(tuple_of(Json::array(
                         {quantity_schema(type.quantity, {}), quantity_schema(type.second, {})})),
                     1, 0);
    case Kind::whole_number:
      return whole_number_schema(type.low.front(), type.high);
    case Kind::whole_numbers:
      return whole_numbers_schema(type);
    case Kind::whole_rows:
      return list_of(whole_numbers_schema(type), 1, 0);
    case Kind::truth:
      return {{"type", "boolean"}};
    case Kind::text:
      return {{"type", "string"}, {"minLength", 1}};
    case Kind::texts:
      return list_of({{"type", "string"}, {"minLength", 1}}, 1, 0);
    case Kind::word:
      return {{"enum", type.words}};
    case Kind::table:
      break;
  }
  return table_schema(type);
}

/// A key with what editors show of it.
Json schema_of(const ListedKey& key) {
  Json schema;
  if (key.types.size() == 1) {
    schema = schema_of(key.types.front());
  } else {
    for (const ValueType& type : key.types) schema["anyOf"].push_back(schema_of(type));
  }
  schema["description"] =
      fmt::format("{}\n{}; default: {}", key.what, kind_text(key), key.standard);
  const Json standard = Json::parse(key.standard, nullptr, false);
  if (!standard.is_discarded()) schema["default"] = standard;
  return schema;
}

/// Whether the other keys of its table go by this one.
bool is_deciding(std::string_view key) {
  return key == "kind" || key == "law";
}

/// Those below a path, as in "loads[].", with the rest of theirs.
std::vector<ListedKey> keys_below(const std::string& path, const Chosen& chosen) {
  std::vector<ListedKey> keys;
  for (ListedKey& key : listed_keys(chosen)) {
    if (!key.path.starts_with(path)) continue;
    key.path.erase(0, path.size());
    keys.push_back(std::move(key));
  }
  return keys;
}

Json object_schema(const std::string& path, const Chosen& chosen);

/// One alternative for each word of a key that the others go by.
Json alternatives_of(const std::string& path, const Chosen& chosen, const ListedKey& key) {
  Json schema{{"type", "object"}};
  for (const std::string& word : key.types.front().words) {
    Chosen with_word = chosen;
    with_word[path + key.path] = word;
    Json alternative = object_schema(path, with_word);
    Json& decided = alternative["properties"][key.path];
    decided = {{"const", word}, {"description", decided["description"]}};
    // Where nothing is said it is the default, and no other one.
    const bool is_default = key.standard == fmt::format("\"{}\"", word);
    Json& required = alternative["required"];
    const bool is_there = std::find(required.begin(), required.end(), key.path) != required.end();
    if (!is_default && !is_there) required.push_back(key.path);
    if (required.empty()) alternative.erase("required");
    schema["oneOf"].push_back(std::move(alternative));
  }
  return schema;
}

/// A part of a path, "rotate", "sieves[]" or "NAME", as a property of the table it is in.
void add_part(Json& table, const std::string& path, const std::string& part, const Chosen& chosen) {
  Json schema = object_schema(path + part + '.', chosen);
  if (part == "NAME") {
    table["additionalProperties"] = std::move(schema);
  } else if (part.ends_with("[]")) {
    table["properties"][part.substr(0, part.size() - 2)] = {{"type", "array"},
                                                            {"items", std::move(schema)}};
  } else {
    table["properties"][part] = std::move(schema);
  }
}

Json object_schema(const std::string& path, const Chosen& chosen) {
  const std::vector<ListedKey> keys = keys_below(path, chosen);
  for (const ListedKey& key : keys) {
    if (is_deciding(key.path) && !chosen.contains(path + key.path))
      return alternatives_of(path, chosen, key);
  }
  Json schema{{"type", "object"}, {"properties", Json::object()}, {"additionalProperties", false}};
  std::vector<std::string> parts;
  for (const ListedKey& key : keys) {
    const std::size_t dot = key.path.find('.');
    const std::string part = key.path.substr(0, dot);
    if (dot == std::string::npos) {
      schema["properties"][part] = schema_of(key);
      if (key.is_required()) schema["required"].push_back(part);
    } else if (std::find(parts.begin(), parts.end(), part) == parts.end()) {
      parts.push_back(part);
      add_part(schema, path, part, chosen);
    }
  }
  return schema;
}

/// The same where any of its keys may be left out.
Json partial(Json schema) {
  if (schema.is_object()) {
    schema.erase("required");
    if (schema.contains("oneOf")) {
      schema["anyOf"] = std::move(schema["oneOf"]);
      schema.erase("oneOf");
    }
  }
  if (schema.is_structured())
    for (Json& part : schema) part = partial(std::move(part));
  return schema;
}

/// A stage says again what changes, as it stands outside of the stages; which ends a scenario is
/// said by the stages then.
void add_changes_of_stages(Json& schema) {
  Json& stage = schema["properties"]["stages"]["items"];
  for (const char* table : {"simulation", "materials", "contacts", "membranes", "rigid_bodies",
                            "grains", "planes", "loads", "output"})
    stage["properties"][table] = partial(schema["properties"][table]);
  for (const char* removed : {"plane", "load", "rigid_body"})
    stage["properties"]["remove"]["items"]["properties"][removed] = {
        {"type", "string"}, {"minLength", 1}, {"description", "name of what is taken out"}};
  Json& required = schema["properties"]["simulation"]["required"];
  required.erase(std::remove(required.begin(), required.end(), "duration"), required.end());
  schema["if"] = {{"not", {{"required", {"stages"}}}}};
  schema["then"] = {{"properties", {{"simulation", {{"required", {"duration"}}}}}}};
}

}  // namespace

Json scenario_schema() {
  Json schema{
      {"$schema", "https://json-schema.org/draft/2020-12/schema"},
      {"title", "Plekton scenario"},
      {"description",
       "What a scenario may say, from the reader itself. plekton check knows more: what keys "
       "have to do with each other, and with files."}};
  schema.update(object_schema("", {}));
  schema["required"].push_back("simulation");
  add_changes_of_stages(schema);
  return schema;
}

}  // namespace plekton::apps
