// JSON against a JSON Schema: as much of the standard as ours use, and a complaint about what is not known here.
#pragma once

#include <fmt/format.h>

#include <set>
#include <string>

#include "formats/core/json.h"

namespace oriel::testing {

class JsonSchema {
 public:
  explicit JsonSchema(Json schema) : schema_(std::move(schema)) {}

  // What is wrong, with its place; empty: nothing.
  std::string complaint(const Json& value) const { return check(schema_, value, "$"); }

 private:
  static bool is_type(const std::string& type, const Json& value) {
    return type == "object"    ? value.is_object()
           : type == "array"   ? value.is_array()
           : type == "string"  ? value.is_string()
           : type == "integer" ? value.is_number_integer()
           : type == "number"  ? value.is_number()
           : type == "boolean" ? value.is_boolean()
                               : type == "null" && value.is_null();
  }

  // "#/a/b": a member of a member of the schema.
  const Json& referred(const std::string& path) const {
    const Json* here = &schema_;
    for (std::size_t at = path.find('/'), end = 0; at != path.npos; at = end) {
      end = path.find('/', at + 1);
      here = &here->at(path.substr(at + 1, end == path.npos ? end : end - at - 1));
    }
    return *here;
  }

  std::string check(const Json& schema, const Json& value, const std::string& at) const {
    static const std::set<std::string> known{
        "$schema", "title", "description", "type", "required", "properties",          "items",
        "const",   "enum",  "properties",  "$ref", "$defs",    "additionalProperties"};
    for (const auto& [key, unused] : schema.items())
      if (!known.contains(key)) return fmt::format("{}: the schema says {}, which nobody checks", at, key);
    if (schema.contains("$ref")) return check(referred(schema["$ref"].get<std::string>()), value, at);
    if (schema.contains("const") && value != schema["const"]) return fmt::format("{}: found {}", at, value.dump());
    if (schema.contains("enum") &&
        std::find(schema["enum"].begin(), schema["enum"].end(), value) == schema["enum"].end())
      return fmt::format("{}: found {}, expected one of {}", at, value.dump(), schema["enum"].dump());
    if (schema.contains("type")) {
      const Json types = schema["type"].is_array() ? schema["type"] : Json::array({schema["type"]});
      bool fits = false;
      for (const Json& type : types) fits = fits || is_type(type.get<std::string>(), value);
      if (!fits) return fmt::format("{}: found {}, expected {}", at, value.dump().substr(0, 80), types.dump());
    }
    if (value.is_object()) return check_members(schema, value, at);
    if (value.is_array() && schema.contains("items"))
      for (std::size_t i = 0; i < value.size(); ++i)
        if (const auto bad = check(schema["items"], value[i], fmt::format("{}[{}]", at, i)); !bad.empty()) return bad;
    return {};
  }

  std::string check_members(const Json& schema, const Json& value, const std::string& at) const {
    const Json properties = schema.value("properties", Json::object());
    for (const Json& name : schema.value("required", Json::array()))
      if (!value.contains(name.get<std::string>())) return fmt::format("{}: {} is missing", at, name.dump());
    for (const auto& [name, member] : value.items()) {
      if (properties.contains(name)) {
        if (const auto bad = check(properties[name], member, at + "." + name); !bad.empty()) return bad;
      } else if (schema.contains("additionalProperties") && schema["additionalProperties"] == false) {
        return fmt::format("{}: found {}, which the schema does not know", at, name);
      }
    }
    return {};
  }

  Json schema_;
};

}  // namespace oriel::testing
