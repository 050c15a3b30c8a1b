#include "formats/core/json.h"

#include <algorithm>

namespace oriel {
namespace {

const Json kNothing;

bool is_named(const Json& value) {
  return value.is_array() && value.size() == 2 && value[std::size_t{0}].is_string();
}

}  // namespace

Json::Json(bool value) noexcept : kind_(Kind::kBoolean) {
  data_.boolean = value;
}
Json::Json(int value) noexcept : Json(static_cast<long long>(value)) {}
Json::Json(long value) noexcept : Json(static_cast<long long>(value)) {}
Json::Json(long long value) noexcept : kind_(Kind::kInteger) {
  data_.integer = value;
}
Json::Json(unsigned value) noexcept : Json(static_cast<unsigned long long>(value)) {}
Json::Json(unsigned long value) noexcept : Json(static_cast<unsigned long long>(value)) {}
Json::Json(unsigned long long value) noexcept : kind_(Kind::kUnsigned) {
  data_.natural = value;
}
Json::Json(float value) noexcept : Json(static_cast<double>(value)) {}
Json::Json(double value) noexcept : kind_(Kind::kReal) {
  data_.real = value;
}
Json::Json(const char* value) : Json(std::string(value)) {}
Json::Json(std::string_view value) : Json(std::string(value)) {}
Json::Json(std::string value) {
  data_.string = new std::string(std::move(value));
  kind_ = Kind::kString;
}

Json::Json(std::initializer_list<Json> values)
    : Json(std::all_of(values.begin(), values.end(), is_named) ? object(values) : array(values)) {}

Json Json::array(std::initializer_list<Json> values) {
  Json out;
  out.data_.array = new Array(values);
  out.kind_ = Kind::kArray;
  return out;
}

Json Json::object(std::initializer_list<Json> members) {
  Json out;
  out.data_.object = new Object;
  out.kind_ = Kind::kObject;
  out.data_.object->reserve(members.size());
  for (const Json& member : members)
    if (!out.contains(member.at(0).get<std::string>()))
      out[*member.at(0).data_.string] = member.at(1);  // the first counts
  return out;
}

Json::Json(const Json& other) : data_(other.data_) {
  if (other.is_string()) data_.string = new std::string(*other.data_.string);
  if (other.is_array()) data_.array = new Array(*other.data_.array);
  if (other.is_object()) data_.object = new Object(*other.data_.object);
  kind_ = other.kind_;
}

Json& Json::operator=(const Json& other) {
  return *this = Json(other);
}

Json& Json::operator=(Json&& other) noexcept {
  Json taken(std::move(other));  // which may be a part of what is replaced
  std::swap(kind_, taken.kind_);
  std::swap(data_, taken.data_);
  return *this;
}

void Json::drop() noexcept {
  if (is_string()) delete data_.string;
  if (is_array()) delete data_.array;
  if (is_object()) delete data_.object;
}

Result<Json> Json::parse(std::span<const std::byte> text, const std::string& where) {
  return parse(std::string_view(reinterpret_cast<const char*>(text.data()), text.size()), where);
}

std::size_t Json::size() const {
  return is_null() ? 0 : is_array() ? data_.array->size() : is_object() ? data_.object->size() : 1;
}

const Json* Json::find(std::string_view name) const {
  for (const JsonMember& member : items())
    if (member.name == name) return &member.value;
  return nullptr;
}
Json* Json::find(std::string_view name) {
  return const_cast<Json*>(std::as_const(*this).find(name));
}

const Json& Json::operator[](std::string_view name) const {
  const Json* member = find(name);
  return member ? *member : kNothing;
}
const Json& Json::operator[](std::size_t index) const {
  return is_array() && index < size() ? (*data_.array)[index] : kNothing;
}
Json& Json::operator[](std::string_view name) {
  if (is_null()) *this = object();
  if (!is_object()) throw JsonError(fmt::format("found {}, expected an object with \"{}\"", name_of_kind(), name));
  if (Json* member = find(name)) return *member;
  return data_.object->emplace_back(std::string(name), Json()).value;
}
Json& Json::operator[](std::size_t index) {
  if (is_null()) *this = array();
  if (!is_array()) throw JsonError(fmt::format("found {}, expected an array", name_of_kind()));
  if (index >= size()) data_.array->resize(index + 1);
  return (*data_.array)[index];
}

const Json& Json::at(std::string_view name) const {
  if (!is_object()) throw JsonError(fmt::format("found {}, expected an object with \"{}\"", name_of_kind(), name));
  if (const Json* member = find(name)) return *member;
  throw JsonError(fmt::format("found no \"{}\", expected one", name));
}
const Json& Json::at(std::size_t index) const {
  if (!is_array()) throw JsonError(fmt::format("found {}, expected an array", name_of_kind()));
  if (index >= size()) throw JsonError(fmt::format("found an array of {}, expected more than {}", size(), index));
  return (*data_.array)[index];
}
Json& Json::at(std::size_t index) {
  return const_cast<Json&>(std::as_const(*this).at(index));
}

const Json* Json::begin() const {
  return is_array() ? data_.array->data() : nullptr;
}
const Json* Json::end() const {
  return is_array() ? data_.array->data() + data_.array->size() : nullptr;
}
Json* Json::begin() {
  return const_cast<Json*>(std::as_const(*this).begin());
}
Json* Json::end() {
  return const_cast<Json*>(std::as_const(*this).end());
}
const std::vector<JsonMember>& Json::items() const {
  static const Object none;
  return is_object() ? *data_.object : none;
}

Json& Json::push_back(Json value) {
  if (is_null()) *this = array();
  if (!is_array()) throw JsonError(fmt::format("found {}, expected an array", name_of_kind()));
  return data_.array->emplace_back(std::move(value));
}

void Json::update(const Json& other) {
  for (const auto& [name, value] : other.items()) (*this)[name] = value;
}

void Json::erase(std::string_view name) {
  if (is_object()) std::erase_if(*data_.object, [name](const JsonMember& member) { return member.name == name; });
}

Json Json::sorted() const {
  Json out = *this;
  if (out.is_array())
    for (Json& element : *out.data_.array) element = element.sorted();
  if (out.is_object()) {
    for (JsonMember& member : *out.data_.object) member.value = member.value.sorted();
    std::ranges::sort(*out.data_.object, {}, &JsonMember::name);
  }
  return out;
}

const char* Json::name_of_kind() const {
  static constexpr const char* names[] = {"null",     "true or false", "a number", "a number",
                                          "a number", "a string",      "an array", "an object"};
  return names[static_cast<std::size_t>(kind_)];
}

bool Json::equals(const Json& other) const {
  if (is_number() && other.is_number()) {
    if (!is_number_float() && !other.is_number_float()) {
      const auto negative = [](const Json& n) { return n.kind_ == Kind::kInteger && n.data_.integer < 0; };
      return negative(*this) == negative(other) && data_.natural == other.data_.natural;
    }
    return get<double>() == other.get<double>();
  }
  if (kind_ != other.kind_) return false;
  if (is_boolean()) return data_.boolean == other.data_.boolean;
  if (is_string()) return *data_.string == *other.data_.string;
  if (is_array()) return *data_.array == *other.data_.array;
  return size() == other.size() && std::all_of(items().begin(), items().end(), [&](const JsonMember& member) {
           const Json* same = other.find(member.name);
           return same && *same == member.value;
         });
}

template <class T>
T Json::number(const char* type) const {
  if (kind_ == Kind::kInteger) return static_cast<T>(data_.integer);
  if (kind_ == Kind::kUnsigned) return static_cast<T>(data_.natural);
  if (kind_ == Kind::kReal) return static_cast<T>(data_.real);
  throw JsonError(fmt::format("found {}, expected {}", name_of_kind(), type));
}

template <class T>
std::vector<T> Json::numbers() const {
  if (!is_array()) throw JsonError(fmt::format("found {}, expected an array", name_of_kind()));
  std::vector<T> out;
  for (const Json& element : *this) out.push_back(element.get<T>());
  return out;
}

template <>
bool Json::get<bool>() const {
  if (!is_boolean()) throw JsonError(fmt::format("found {}, expected true or false", name_of_kind()));
  return data_.boolean;
}
template <>
int Json::get<int>() const {
  return number<int>("a number");
}
template <>
unsigned Json::get<unsigned>() const {
  return number<unsigned>("a number");
}
template <>
long Json::get<long>() const {
  return number<long>("a number");
}
template <>
unsigned long Json::get<unsigned long>() const {
  return number<unsigned long>("a number");
}
template <>
float Json::get<float>() const {
  return number<float>("a number");
}
template <>
double Json::get<double>() const {
  return number<double>("a number");
}
template <>
std::string Json::get<std::string>() const {
  if (!is_string()) throw JsonError(fmt::format("found {}, expected a string", name_of_kind()));
  return *data_.string;
}
template <>
Json Json::get<Json>() const {
  return *this;
}
template <>
std::vector<int> Json::get<std::vector<int>>() const {
  return numbers<int>();
}
template <>
std::vector<double> Json::get<std::vector<double>>() const {
  return numbers<double>();
}
template <>
std::vector<std::string> Json::get<std::vector<std::string>>() const {
  return numbers<std::string>();
}
std::string Json::value(std::string_view name, const char* otherwise) const {
  return value(name, std::string(otherwise));
}

}  // namespace oriel
