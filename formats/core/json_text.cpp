// JSON as text. The only place that sees nlohmann's library.
#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>
#include <ostream>

#include "formats/core/json.h"

namespace oriel {
namespace {

using Written = nlohmann::ordered_json;

Written written(const Json& json) {
  if (json.is_array()) {
    Written::array_t out;
    out.reserve(json.size());
    for (const Json& element : json) out.push_back(written(element));
    return out;
  }
  if (json.is_object()) {
    Written::object_t out;
    Written::object_t::Container& members = out;  // whose emplace_back() does not search for the name
    members.reserve(json.size());
    for (const auto& [name, value] : json.items()) members.emplace_back(name, written(value));
    return out;
  }
  if (json.is_string()) return json.get<std::string>();
  if (json.is_boolean()) return json.get<bool>();
  if (json.is_number_unsigned()) return json.get<std::uint64_t>();
  if (json.is_number_integer()) return json.get<std::int64_t>();
  if (json.is_number()) return json.get<double>();
  return nullptr;
}

// What nlohmann says, without its own code in brackets.
std::string reason(const std::exception& e) {
  const std::string_view text = e.what();
  const std::size_t bracket = text.find("] ");
  return std::string(bracket == std::string_view::npos ? text : text.substr(bracket + 2));
}

bool has_repeated(const std::vector<JsonMember>& members) {
  std::vector<std::string_view> names;
  names.reserve(members.size());
  for (const JsonMember& member : members) names.push_back(member.name);
  std::ranges::sort(names);
  return std::ranges::adjacent_find(names) != names.end();
}

// Of members of one name the last value stays, at the first one's place.
void drop_repeated(std::vector<JsonMember>& members) {
  std::vector<JsonMember> kept;
  std::map<std::string, std::size_t> places;
  for (JsonMember& member : members) {
    const auto [place, added] = places.try_emplace(member.name, kept.size());
    if (added)
      kept.push_back(std::move(member));
    else
      kept[place->second].value = std::move(member.value);
  }
  members = std::move(kept);
}

}  // namespace

// Makes a value of what nlohmann's parser meets.
class JsonReader {
 public:
  explicit JsonReader(std::size_t bytes) : bytes_(bytes) {}

  bool null() { return add(Json()); }
  bool boolean(bool value) { return add(value); }
  bool number_integer(std::int64_t value) { return add(value); }
  bool number_unsigned(std::uint64_t value) { return add(value); }
  bool number_float(double value, const std::string&) { return add(value); }
  bool string(std::string& value) { return add(std::move(value)); }
  bool binary(Written::binary_t&) { return false; }  // no part of JSON
  bool start_object(std::size_t) { return open(Json::object()); }
  bool start_array(std::size_t) { return open(Json::array()); }
  bool key(std::string& name) {
    open_.back()->data_.object->emplace_back(std::move(name), Json());
    return true;
  }
  bool end_object() {
    std::vector<JsonMember>& members = *open_.back()->data_.object;
    if (has_repeated(members)) drop_repeated(members);
    return end_array();
  }
  bool end_array() {
    open_.pop_back();
    return true;
  }
  bool parse_error(std::size_t at, const std::string&, const nlohmann::detail::exception& e) {
    const bool syntax = dynamic_cast<const nlohmann::detail::parse_error*>(&e) != nullptr;
    error_ = syntax ? fmt::format("found invalid JSON at byte {} of {}: {}", at, bytes_, reason(e))
                    : fmt::format("found invalid JSON: {}", reason(e));
    return false;
  }

  Json root;
  const std::string& error() const { return error_; }

 private:
  // Where the value is kept: pointers in open_ stay good, as only the innermost grows.
  Json* place(Json&& value) {
    if (open_.empty()) return &(root = std::move(value));
    Json& within = *open_.back();
    if (within.is_array()) return &within.data_.array->emplace_back(std::move(value));
    return &(within.data_.object->back().value = std::move(value));
  }
  bool add(Json&& value) { return place(std::move(value)) != nullptr; }
  bool open(Json&& value) {
    if (open_.size() == Json::kMaxDepth) {
      error_ = fmt::format("found JSON nested deeper than {} levels, expected less", Json::kMaxDepth);
      return false;
    }
    open_.push_back(place(std::move(value)));
    return true;
  }
  std::size_t bytes_;
  std::vector<Json*> open_;
  std::string error_;
};

Result<Json> Json::parse(std::string_view text, const std::string& where) {
  JsonReader reader(text.size());
  try {
    if (!nlohmann::json::sax_parse(text.begin(), text.end(), &reader)) return invalid(where, "{}", reader.error());
  } catch (const std::bad_alloc&) {
    return fail(ErrorCode::kRuntime, where, "not enough memory for {} bytes of JSON", text.size());
  }
  return std::move(reader.root);
}

std::string Json::dump(int indent) const {
  return written(*this).dump(indent, ' ', false, Written::error_handler_t::replace);
}

std::string Json::dump_ascii() const {
  return written(*this).dump(-1, ' ', true, Written::error_handler_t::replace);
}

std::ostream& operator<<(std::ostream& out, const Json& json) {
  return out << json.dump();
}

}  // namespace oriel
